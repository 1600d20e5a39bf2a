//! The geometry of joints: values, gradients and curvatures as rows over bodies, in f64.
//!
//! A body's six coordinates are the displacement of its centre of mass, in the world, and its rotation vector along its
//! *principal* axes: as a bivector Theta of components (e23, e31, e12), `R <- R exp(-Theta/2)`. So the inverse mass is
//! diagonal and constant, `W = (1/m, 1/I1, 1/I2, 1/I3)`, and multiplying and dividing by it loses no digits however
//! slender the body.
//!
//! A point at the arm r moves by `d + r . Theta`, so a value that changes by `n . dx` with the point has the gradient
//! `(n, r ^ n)`: a force and its torque. With `r' = r . Omega`, what is there of r'' without acceleration is
//! `(r . Omega) . Omega`. With the gap `g = x_b + r_b - x_a - r_a`, taken between centres of mass first:
//!
//! ```text
//! ball       C_i = g . e_i                                      C_i'' = g''_0 . e_i
//! hinge      and C_k = s (u_a . v_k), k = 1, 2                  C_k'' = s (u_a''_0 . v_k + 2 u_a' . v_k' + u_a . v_k''_0)
//! distance   C = (g² - l²) / (2 l)                              C'' = (g'² + g . g''_0) / l
//! ```
//!
//! for the axis u of a hinge and two directions v across it that are fixed in b. All values are in metres: s, the size of
//! the joint, is the root mean square distance of its body's mass from its point, the larger of the two.

use super::{Attachment, Inertia, Joint};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::constraint::Rows;

/// The coordinates of a body.
pub(super) const D: usize = 6;

const AXES: [Vector<f64>; 3] = [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0), Vector::new(0.0, 0.0, 1.0)];

/// Where a body is, and its principal axes in the world; or the world itself.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) position: Point<f64>,
    pub(super) axes: [Vector<f64>; 3],
}

impl Pose {
    /// A body's, from its orientation.
    pub(super) fn new<T: Real>(position: Point<f64>, rotor: Rotor<T>, principal: Rotor<f64>) -> Self {
        let turned = rotor.map(Real::to_f64) * principal;
        let rotor = turned.renormalise().unwrap_or(turned);
        Self { position, axes: AXES.map(|axis| rotor.apply(axis)) }
    }

    /// The principal axes in the world, by a map from the body.
    pub(super) fn axes_of(principal: Rotor<f64>, to_world: impl Fn(Vector<f64>) -> Vector<f64>) -> [Vector<f64>; 3] {
        AXES.map(|axis| to_world(principal.apply(axis)))
    }

    /// Of components along the principal axes, the vector in the world.
    #[inline]
    pub(super) fn to_world(&self, x: Vector<f64>) -> Vector<f64> {
        self.axes[0] * x.e1 + self.axes[1] * x.e2 + self.axes[2] * x.e3
    }

    /// The components of a vector of the world along the principal axes.
    #[inline]
    pub(super) fn to_body(&self, x: Vector<f64>) -> Vector<f64> {
        Vector::from(self.axes.map(|axis| axis | x))
    }

    /// The same of a bivector, whose components turn like those of the axial vector.
    #[inline]
    pub(super) fn plane_to_world(&self, b: Bivector<f64>) -> Bivector<f64> {
        Bivector::from(<[f64; 3]>::from(self.to_world(Vector::new(b.e23, b.e31, b.e12))))
    }

    #[inline]
    pub(super) fn plane_to_body(&self, b: Bivector<f64>) -> Bivector<f64> {
        Bivector::from(<[f64; 3]>::from(self.to_body(Vector::new(b.e23, b.e31, b.e12))))
    }
}

/// How a body moves, world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Twist {
    pub(super) velocity: Vector<f64>,
    pub(super) omega: Bivector<f64>,
}

/// One end of a joint: a point of a body, by its components along the principal axes, or of the world.
#[derive(Clone, Debug)]
pub(super) struct End {
    pub(super) body_idx: Option<usize>,
    pub(super) arm: Vector<f64>,
    ground: Pose,
}

impl End {
    fn new<T: Real>(at: Attachment<T>, principal: &[Rotor<f64>]) -> Self {
        match at {
            Attachment::World(position) => {
                Self { body_idx: None, arm: Vector::default(), ground: Pose { position, axes: AXES } }
            }
            Attachment::Body { body_idx, at_body } => Self {
                body_idx: Some(body_idx),
                arm: to_principal(Some(body_idx), at_body, principal),
                ground: Pose { position: Point::origin(), axes: AXES },
            },
        }
    }

    fn pose<'a>(&'a self, poses: &'a [Pose]) -> &'a Pose {
        self.body_idx.map_or(&self.ground, |body_idx| &poses[body_idx])
    }

    fn twist(&self, twists: &[Twist]) -> Twist {
        self.body_idx.map_or_else(Twist::default, |body_idx| twists[body_idx])
    }

    /// The root mean square distance of the body's mass from the point, m: `k² = r² + (I1 + I2 + I3) / (2 m)`.
    pub(super) fn size_m<T: Real>(&self, inertias: &[Inertia<T>]) -> Option<f64> {
        let inertia = inertias.get(self.body_idx?).filter(|inertia| inertia.inv_mass > T::zero())?;
        let trace: f64 = (0..3).map(|i| inertia.inertia_body[i][i].to_f64()).sum();
        Some((self.arm.norm_sq() + 0.5 * trace / inertia.mass.to_f64()).sqrt())
    }
}

/// The components along the principal axes of a vector in the frame of a body; the world has its own.
fn to_principal<T: Real>(body_idx: Option<usize>, x: Vector<T>, principal: &[Rotor<f64>]) -> Vector<f64> {
    let x = x.map(Real::to_f64);
    body_idx.map_or(x, |body_idx| principal[body_idx].rev().apply(x))
}

/// What is held between the ends.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Ball,
    /// The axis at a and at b, and what is across it at b.
    Hinge {
        axis_a: Vector<f64>,
        axis_b: Vector<f64>,
        across: [Vector<f64>; 2],
    },
    Distance {
        length: f64,
    },
}

/// A joint, ready to be evaluated.
#[derive(Clone, Debug)]
pub(super) struct Link {
    pub(super) a: End,
    pub(super) b: End,
    kind: Kind,
    pub(super) first_row: usize,
    pub(super) size_m: f64,
}

/// How far a joint is from being held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Violation {
    /// Between the points, m.
    pub(super) gap_m: f64,
    /// Between the axes of a hinge, 0 to pi.
    pub(super) angle_rad: f64,
}

/// A unit vector along this one, which is not zero; its largest component is taken out first, so that no square underflows.
fn unit(x: Vector<f64>) -> Vector<f64> {
    let x = x / x.e1.abs().max(x.e2.abs()).max(x.e3.abs());
    x / x.norm_sq().sqrt()
}

/// Two unit vectors orthogonal to a unit vector and to each other.
fn across(axis: Vector<f64>) -> [Vector<f64>; 2] {
    // From the coordinate axis that is farthest from it.
    let size = |x: &Vector<f64>| (*x | axis).abs();
    let far = AXES.into_iter().min_by(|x, y| size(x).total_cmp(&size(y))).unwrap_or_default();
    let first = unit(far - axis * (far | axis));
    [first, (axis ^ first).dual()]
}

impl Link {
    /// From a joint that was checked. `principal` are the rotors from the principal axes of the bodies to their own.
    pub(super) fn new<T: Real>(
        joint: &Joint<T>,
        first_row: usize,
        principal: &[Rotor<f64>],
        inertias: &[Inertia<T>],
    ) -> Self {
        let [a, b] = joint.ends().map(|end| End::new(end, principal));
        let size_m = [&a, &b].into_iter().filter_map(|end| end.size_m(inertias)).fold(0.0, f64::max);
        let kind = match *joint {
            Joint::Ball { .. } => Kind::Ball,
            Joint::Distance { length, .. } => Kind::Distance { length },
            Joint::Hinge { axis_a, axis_b, .. } => {
                let axis_a = unit(to_principal(a.body_idx, axis_a, principal));
                let axis_b = unit(to_principal(b.body_idx, axis_b, principal));
                Kind::Hinge { axis_a, axis_b, across: across(axis_b) }
            }
        };
        Self { a, b, kind, first_row, size_m }
    }

    /// How many rows.
    pub(super) fn rows(&self) -> usize {
        match self.kind {
            Kind::Ball => 3,
            Kind::Hinge { .. } => 5,
            Kind::Distance { .. } => 1,
        }
    }

    /// What a relative violation is relative to, m.
    pub(super) fn length_m(&self) -> f64 {
        match self.kind {
            Kind::Ball | Kind::Hinge { .. } => self.size_m,
            Kind::Distance { length } => length,
        }
    }

    /// The bodies that it holds, in the order of the gradients of each of its rows.
    pub(super) fn bodies(&self) -> impl Iterator<Item = usize> {
        [self.a.body_idx, self.b.body_idx].into_iter().flatten()
    }

    /// The vector from the point of a to that of b, with the difference of positions first.
    fn gap(&self, a: &Pose, b: &Pose) -> Vector<f64> {
        a.position.displacement_to(b.position) + b.to_world(self.b.arm) - a.to_world(self.a.arm)
    }

    /// Fills values and gradients.
    pub(super) fn evaluate(&self, poses: &[Pose], rows: &mut Rows<D>) {
        let (a, b) = (self.a.pose(poses), self.b.pose(poses));
        let gap = self.gap(a, b);
        match self.kind {
            Kind::Ball => self.fill_ball(rows, gap, a, b),
            Kind::Hinge { axis_a, across, .. } => {
                self.fill_ball(rows, gap, a, b);
                let u = a.to_world(axis_a);
                for (v_b, index) in across.into_iter().zip(self.first_row + 3..) {
                    let v = b.to_world(v_b);
                    let turn_a = (axis_a ^ a.to_body(v)) * self.size_m;
                    let turn_b = (v_b ^ b.to_body(u)) * self.size_m;
                    self.fill(rows, index, self.size_m * (u | v), [rotation(turn_a), rotation(turn_b)]);
                }
            }
            Kind::Distance { length } => {
                let distance = gap.norm_sq().sqrt();
                let value = (distance - length) * (distance + length) / (2.0 * length);
                self.fill_along(rows, self.first_row, value, gap / length, a, b);
            }
        }
    }

    fn fill_ball(&self, rows: &mut Rows<D>, gap: Vector<f64>, a: &Pose, b: &Pose) {
        for (axis, index) in AXES.into_iter().zip(self.first_row..) {
            self.fill_along(rows, index, gap | axis, axis, a, b);
        }
    }

    /// A row that changes by `n . dx` with the point of b, and by its negative with that of a.
    fn fill_along(&self, rows: &mut Rows<D>, index: usize, value: f64, n: Vector<f64>, a: &Pose, b: &Pose) {
        let (n_a, n_b) = (a.to_body(-n), b.to_body(n));
        let gradients = [join(-n, self.a.arm ^ n_a), join(n, self.b.arm ^ n_b)];
        self.fill(rows, index, value, gradients);
    }

    fn fill(&self, rows: &mut Rows<D>, index: usize, value: f64, gradients: [[f64; D]; 2]) {
        let row = rows.row_mut(index);
        *row.value = value;
        let held = [self.a.body_idx, self.b.body_idx].into_iter().zip(gradients).filter(|(body, _)| body.is_some());
        for (slot, (_, gradient)) in row.gradients.iter_mut().zip(held) {
            *slot = gradient;
        }
    }

    /// Fills `Jdot q'`, the parts of the values' second derivatives that are there without acceleration.
    pub(super) fn curve(&self, poses: &[Pose], twists: &[Twist], rows: &mut Rows<D>) {
        let (a, b) = (self.a.pose(poses), self.b.pose(poses));
        let (of_a, of_b) = (self.a.twist(twists), self.b.twist(twists));
        let (r_a, r_b) = (a.to_world(self.a.arm), b.to_world(self.b.arm));
        let twice = |x: Vector<f64>, twist: &Twist| (x | twist.omega) | twist.omega;
        let bent = twice(r_b, &of_b) - twice(r_a, &of_a);
        let mut set = |index: usize, curvature: f64| *rows.row_mut(self.first_row + index).curvature = curvature;
        if let Kind::Distance { length } = self.kind {
            let speed = of_b.velocity + (r_b | of_b.omega) - of_a.velocity - (r_a | of_a.omega);
            set(0, (speed.norm_sq() + (self.gap(a, b) | bent)) / length);
            return;
        }
        for (index, axis) in AXES.into_iter().enumerate() {
            set(index, bent | axis);
        }
        if let Kind::Hinge { axis_a, across, .. } = self.kind {
            let u = a.to_world(axis_a);
            for (index, v) in across.into_iter().map(|v| b.to_world(v)).enumerate() {
                let mixed = (u | of_a.omega) | (v | of_b.omega);
                let curvature = (twice(u, &of_a) | v) + 2.0 * mixed + (u | twice(v, &of_b));
                set(3 + index, self.size_m * curvature);
            }
        }
    }

    /// How far it is from being held. Its rows alone would take opposite axes of a hinge for aligned ones.
    pub(super) fn violation(&self, poses: &[Pose]) -> Violation {
        let (a, b) = (self.a.pose(poses), self.b.pose(poses));
        let gap_m = self.gap(a, b).norm_sq().sqrt();
        match self.kind {
            Kind::Ball => Violation { gap_m, angle_rad: 0.0 },
            Kind::Distance { length } => Violation { gap_m: (gap_m - length).abs(), angle_rad: 0.0 },
            Kind::Hinge { axis_a, axis_b, .. } => {
                let (u, v) = (a.to_world(axis_a), b.to_world(axis_b));
                // The arc cosine would lose half the digits of a small angle.
                let angle_rad = (u ^ v).norm_sq().sqrt().atan2(u | v);
                Violation { gap_m, angle_rad }
            }
        }
    }

    /// The worse of the gap and the angle times the size, m.
    pub(super) fn violation_m(&self, poses: &[Pose]) -> f64 {
        let Violation { gap_m, angle_rad } = self.violation(poses);
        // A sum remembers what is no number, a maximum does not.
        let worse = gap_m.max(self.size_m * angle_rad);
        if (gap_m + angle_rad).is_finite() { worse } else { f64::NAN }
    }
}

/// A displacement and a rotation as six coordinates; or a force and a torque.
pub(super) fn join(x: Vector<f64>, b: Bivector<f64>) -> [f64; D] {
    [x.e1, x.e2, x.e3, b.e23, b.e31, b.e12]
}

fn rotation(b: Bivector<f64>) -> [f64; D] {
    join(Vector::default(), b)
}

/// The displacement and the rotation.
pub(super) fn part([x, y, z, e23, e31, e12]: [f64; D]) -> (Vector<f64>, Bivector<f64>) {
    (Vector::new(x, y, z), Bivector::new(e23, e31, e12))
}
