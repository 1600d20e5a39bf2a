//! The kernels on glam's double-precision types, as a user of glam would write them.

use ga_physics::algebra::cga::{Motor, Plane, Point};
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::study::kernels::{Kernel, Role, Way, inputs};
use glam::{DAffine3, DMat3, DQuat, DVec3};

const GLAM: Role = Role::Rival("glam f64");
/// Twelve numbers in the place of seven; no square root or product is left when a point is moved.
const AFFINE: Role = Role::Rival("glam affine f64");

pub(super) fn rotor_times_rotor(kernel: Kernel) -> Kernel {
    let inputs = inputs::rotor_pairs().into_iter().map(|(a, b)| (quaternion(a), quaternion(b))).collect();
    kernel.with(Way::rival(GLAM, inputs, |(a, b)| *a * *b, |q: &DQuat| vec![q.w, -q.x, -q.y, -q.z]))
}

pub(super) fn rotor_on_vector(kernel: Kernel) -> Kernel {
    let inputs = inputs::rotors_and_vectors().into_iter().map(|(r, x)| (quaternion(r), vector(x))).collect();
    kernel.with(Way::rival(GLAM, inputs, |(q, x)| *q * *x, |x: &DVec3| x.to_array().to_vec()))
}

pub(super) fn motor_on_point(kernel: Kernel) -> Kernel {
    let inputs = inputs::poses_and_points();
    let poses = inputs.iter().map(|((t, r), x)| (quaternion(*r), vector(*t), position(*x))).collect();
    let affine = inputs
        .iter()
        .map(|((t, r), x)| (DAffine3::from_rotation_translation(quaternion(*r), vector(*t)), position(*x)));
    kernel.with(Way::rival(GLAM, poses, |(q, t, x)| *q * *x + *t, |x: &DVec3| x.to_array().to_vec())).with(Way::rival(
        AFFINE,
        affine.collect(),
        |(pose, x)| pose.transform_point3(*x),
        |x| x.to_array().to_vec(),
    ))
}

pub(super) fn motor_times_motor(kernel: Kernel) -> Kernel {
    let poses = inputs::pose_pairs().into_iter().map(|pair| pair.map(|(t, r)| (quaternion(r), vector(t)))).collect();
    kernel.with(Way::rival(
        GLAM,
        poses,
        |[(q, t), (r, u)]: &[(DQuat, DVec3); 2]| (*q * *r, *q * *u + *t),
        |(q, t)| {
            let rotor = Rotor::new(q.w, -q.x, -q.y, -q.z);
            <[f64; 8]>::from(Motor::from_parts(Vector::new(t.x, t.y, t.z), rotor)).to_vec()
        },
    ))
}

/// `2 (b - a) . (x - a) = |b - a|²` and the same for c and d, by the inverse of a matrix.
pub(super) fn sphere_of_four_points(kernel: Kernel) -> Kernel {
    let inputs = inputs::tetrahedra().into_iter().map(|points| points.map(position)).collect();
    let sphere = |[a, b, c, d]: &[DVec3; 4]| {
        let (u, v, w) = (b - a, c - a, d - a);
        let squares = DVec3::new(u.length_squared(), v.length_squared(), w.length_squared());
        let radius = DMat3::from_cols(u, v, w).transpose().inverse() * (squares * 0.5);
        (a + radius, radius.length_squared())
    };
    kernel.with(Way::rival(GLAM, inputs, sphere, centre_and_square))
}

/// In the frame of the first point `(u×v) × (|v|² u - |u|² v) / (2 |u×v|²)`.
pub(super) fn circle_of_three_points(kernel: Kernel) -> Kernel {
    let inputs = inputs::triangles().into_iter().map(|points| points.map(position)).collect();
    let circle = |[a, b, c]: &[DVec3; 3]| {
        let (u, v) = (b - a, c - a);
        let normal = u.cross(v);
        let radius = normal.cross(u * v.length_squared() - v * u.length_squared()) * (0.5 / normal.length_squared());
        (a + radius, radius.length_squared())
    };
    kernel.with(Way::rival(GLAM, inputs, circle, centre_and_square))
}

/// Plücker coordinates: with the moment `m = p×d`, `x (n . d) = n×m + delta d`.
pub(super) fn line_meets_plane(kernel: Kernel) -> Kernel {
    let lines = inputs::planes_and_lines().into_iter().map(|(plane, points)| {
        let [p, q] = points.map(position);
        (normal(&plane), plane.ninf, q - p, p.cross(q))
    });
    kernel.with(Way::rival(
        GLAM,
        lines.collect(),
        |(n, delta, d, m)| (n.cross(*m) + *d * *delta) / n.dot(*d),
        |x: &DVec3| x.to_array().to_vec(),
    ))
}

pub(super) fn ray_meets_plane(kernel: Kernel) -> Kernel {
    let rays = inputs::planes_and_lines().into_iter().map(|(plane, points)| {
        let [p, q] = points.map(position);
        (normal(&plane), plane.ninf, p, q - p)
    });
    kernel.with(Way::rival(
        GLAM,
        rays.collect(),
        |(n, delta, p, d)| *p + *d * ((delta - n.dot(*p)) / n.dot(*d)),
        |x: &DVec3| x.to_array().to_vec(),
    ))
}

pub(super) fn balls_overlap(kernel: Kernel) -> Kernel {
    let balls = inputs::ball_pairs().into_iter().map(|pair| pair.map(|(centre, radius)| (position(centre), radius)));
    kernel.with(Way::rival(
        GLAM,
        balls.collect(),
        |[(a, r), (b, s)]: &[(DVec3, f64); 2]| a.distance_squared(*b) <= (r + s) * (r + s),
        |hit| vec![1.0, f64::from(*hit)],
    ))
}

fn centre_and_square((centre, radius_sq): &(DVec3, f64)) -> Vec<f64> {
    vec![centre.x, centre.y, centre.z, *radius_sq]
}

/// The quaternion `w + xi + yj + zk` is the rotor `w - x e23 - y e31 - z e12`.
fn quaternion(r: Rotor) -> DQuat {
    DQuat::from_xyzw(-r.e23, -r.e31, -r.e12, r.s)
}

fn vector(x: Vector) -> DVec3 {
    DVec3::new(x.e1, x.e2, x.e3)
}

fn position(x: Point) -> DVec3 {
    DVec3::new(x.x, x.y, x.z)
}

fn normal(plane: &Plane) -> DVec3 {
    DVec3::new(plane.e1, plane.e2, plane.e3)
}
