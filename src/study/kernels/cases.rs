//! The kernels, each written in every way that is compared.
//!
//! Inputs are prepared before any clock starts, in the layout that each way works on: generated structs, dynamic
//! multivectors, nalgebra's types. All are made from the same numbers.

use super::{Kernel, Way};
use crate::algebra::cga::{self, Line, Motor, Plane, Point, Translator};
use crate::algebra::dynamic::{Dynamic, ToDynamic};
use crate::algebra::g3::{self, Rotor, Vector};
use crate::algebra::{Real, Scalar};
use crate::geometry::formulas;
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

/// Inputs of each kernel: enough that no branch predictor learns them by heart.
pub(super) const INPUTS: usize = 1024;

type Multi<M> = Dynamic<M, f64>;

/// All kernels.
#[must_use]
pub fn kernels() -> Vec<Kernel> {
    let mut random = Random(20_260_301);
    vec![
        rotor_times_rotor(&mut random),
        rotor_on_vector(&mut random),
        motor_on_point(&mut random),
        motor_times_motor(&mut random),
        sphere_of_four_points(&mut random),
        plane_meets_line(&mut random),
    ]
}

fn rotor_times_rotor(random: &mut Random) -> Kernel {
    fn product<T: Scalar>((a, b): &(Rotor<T>, Rotor<T>)) -> Rotor<T> {
        *a * *b
    }
    let inputs: Vec<_> = repeat(|| (random.rotor(), random.rotor()));
    Kernel::new("rotor * rotor", "R S")
        .with(Way::generated(&inputs, product, |r| numbers::<_, _, 4>(*r)))
        .with(Way::single(&inputs, |(a, b)| (a.map(single), b.map(single)), product, |r| numbers::<_, _, 4>(*r)))
        .with(Way::dynamic(
            &inputs,
            |(a, b)| [a.to_dynamic(), b.to_dynamic()],
            |[a, b]: &[Multi<g3::Algebra>; 2]| a * b,
            rotor_of,
        ))
        .with(Way::hand_written(
            &inputs,
            |(a, b)| (quaternion(a), quaternion(b)),
            |(a, b)| a * b,
            |q| vec![q.w, -q.i, -q.j, -q.k],
        ))
}

fn rotor_on_vector(random: &mut Random) -> Kernel {
    fn image<T: Scalar>((rotor, x): &(Rotor<T>, Vector<T>)) -> Vector<T> {
        rotor.apply(*x)
    }
    let inputs: Vec<_> = repeat(|| (random.rotor(), random.vector()));
    Kernel::new("rotor on vector", "R x ~R")
        .with(Way::generated(&inputs, image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::single(&inputs, |(a, b)| (a.map(single), b.map(single)), image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::dynamic(
            &inputs,
            |(rotor, x)| [rotor.to_dynamic(), x.to_dynamic()],
            |[rotor, x]: &[Multi<g3::Algebra>; 2]| rotor.apply(x),
            |x| coefficients(x, [0b001, 0b010, 0b100]),
        ))
        .with(Way::hand_written(
            &inputs,
            |(rotor, x)| (quaternion(rotor), euclidean(*x)),
            |(rotor, x)| rotor * x,
            |x| x.as_slice().to_vec(),
        ))
}

fn motor_on_point(random: &mut Random) -> Kernel {
    fn image<T: Scalar>((motor, x): &(Motor<T>, Point<T>)) -> Point<T> {
        motor.apply(*x)
    }
    let inputs: Vec<_> = repeat(|| (random.pose(), random.point()));
    let motors: Vec<_> = inputs.iter().map(|((t, r), x)| (translator(*t) * *r, *x)).collect();
    Kernel::new("motor on point", "M X ~M")
        .with(Way::generated(&motors, image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::single(&motors, |(a, b)| (a.map(single), b.map(single)), image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::dynamic(
            &motors,
            |(motor, x)| [motor.to_dynamic(), x.to_dynamic()],
            |[motor, x]: &[Multi<cga::Algebra>; 2]| motor.apply(x),
            |x| coefficients(x, [E1, E2, E3]),
        ))
        .with(Way::hand_written(
            &inputs,
            |(pose, x)| (isometry(pose), Point3::new(x.x, x.y, x.z)),
            |(pose, x)| pose * x,
            |x| x.coords.as_slice().to_vec(),
        ))
}

fn motor_times_motor(random: &mut Random) -> Kernel {
    fn product<T: Scalar>((a, b): &(Motor<T>, Motor<T>)) -> Motor<T> {
        *a * *b
    }
    let inputs: Vec<_> = repeat(|| (random.pose(), random.pose()));
    let motors: Vec<_> = inputs.iter().map(|((t, r), (u, s))| (translator(*t) * *r, translator(*u) * *s)).collect();
    Kernel::new("motor * motor", "M N")
        .with(Way::generated(&motors, product, |m| numbers::<_, _, 8>(*m)))
        .with(Way::single(&motors, |(a, b)| (a.map(single), b.map(single)), product, |m| numbers::<_, _, 8>(*m)))
        .with(Way::dynamic(
            &motors,
            |(a, b)| [a.to_dynamic(), b.to_dynamic()],
            |[a, b]: &[Multi<cga::Algebra>; 2]| a * b,
            motor_of,
        ))
        .with(Way::hand_written(
            &inputs,
            |(a, b)| (isometry(a), isometry(b)),
            |(a, b)| a * b,
            |pose| {
                let (t, q) = (pose.translation.vector, pose.rotation);
                numbers::<_, _, 8>(translator(Vector::new(t.x, t.y, t.z)) * Rotor::new(q.w, -q.i, -q.j, -q.k))
            },
        ))
}

fn sphere_of_four_points(random: &mut Random) -> Kernel {
    fn sphere<T: Scalar>([a, b, c, d]: &[Point<T>; 4]) -> cga::Sphere<T> {
        formulas::circumsphere(*a, *b, *c, *d)
    }
    let inputs: Vec<_> = repeat(|| random.tetrahedron());
    Kernel::new("sphere of four points", "dual(A ^ B ^ C ^ D), normalised")
        .with(Way::generated(&inputs, sphere, |s| numbers::<_, _, 4>(*s)))
        .with(Way::single(&inputs, |points| points.map(|p| p.map(single)), sphere, |s| numbers::<_, _, 4>(*s)))
        .with(Way::dynamic(
            &inputs,
            |points| points.map(|point| point.to_dynamic()),
            |[a, b, c, d]: &[Multi<cga::Algebra>; 4]| formulas::circumsphere_dynamic(a, b, c, d),
            sphere_of,
        ))
        .with(Way::hand_written(
            &inputs,
            |points| points.map(|p| Vector3::new(p.x, p.y, p.z)),
            circumsphere_by_vectors,
            |(centre, radius_sq)| vec![centre.x, centre.y, centre.z, *radius_sq],
        ))
}

/// The centre solves `2 (b - a) . (x - a) = |b - a|²` and the same for c and d, by Cramer's rule:
/// `x - a = (|u|² v×w + |v|² w×u + |w|² u×v) / (2 u . v×w)`.
fn circumsphere_by_vectors([a, b, c, d]: &[Vector3<f64>; 4]) -> (Vector3<f64>, f64) {
    let (u, v, w) = (b - a, c - a, d - a);
    let normal = v.cross(&w);
    let sum = normal * u.norm_squared() + w.cross(&u) * v.norm_squared() + u.cross(&v) * w.norm_squared();
    let radius = sum / (2.0 * u.dot(&normal));
    (a + radius, radius.norm_squared())
}

fn plane_meets_line(random: &mut Random) -> Kernel {
    fn meet<T: Scalar>((plane, line): &(Plane<T>, Line<T>)) -> cga::FlatPoint<T> {
        *plane | *line
    }
    /// `X ^ ninf = x ^ ninf + no ^ ninf`: the point is the ratio of coefficients.
    fn point(flat: &[f64]) -> Vec<f64> {
        flat.split_last().map(|(weight, rest)| rest.iter().map(|x| x / weight).collect()).unwrap_or_default()
    }
    let inputs: Vec<_> = repeat(|| random.plane_and_line());
    let flats: Vec<_> = inputs.iter().map(|(plane, [p, q])| (*plane, (*p ^ *q) ^ cga::Infinity)).collect();
    Kernel::new("plane meets line", "pi | L")
        .with(Way::generated(&flats, meet, |flat| point(&numbers::<_, _, 4>(*flat))))
        .with(Way::single(
            &flats,
            |(a, b)| (a.map(single), b.map(single)),
            meet,
            |flat| point(&numbers::<_, _, 4>(*flat)),
        ))
        .with(Way::dynamic(
            &flats,
            |(plane, line)| [plane.to_dynamic(), line.to_dynamic()],
            |[plane, line]: &[Multi<cga::Algebra>; 2]| plane | line,
            |flat| point(&[&coefficients(flat, [E1 | E, E2 | E, E3 | E])[..], &[-flat.coefficient(E | EBAR)]].concat()),
        ))
        .with(Way::hand_written(
            &inputs,
            |(plane, [p, q])| {
                let (p, q) = (Vector3::new(p.x, p.y, p.z), Vector3::new(q.x, q.y, q.z));
                (Vector3::new(plane.e1, plane.e2, plane.e3), plane.ninf, p, q - p)
            },
            // x = p + t d with n . x = delta
            |(n, delta, p, d)| p + d * ((delta - n.dot(p)) / n.dot(d)),
            |x| x.as_slice().to_vec(),
        ))
}

// The orthonormal basis of the dynamic multivector: `ninf = e + ebar`, `no = (ebar - e) / 2`.
const E1: u32 = 1;
const E2: u32 = 1 << 1;
const E3: u32 = 1 << 2;
const E: u32 = 1 << 3;
const EBAR: u32 = 1 << 4;

fn coefficients<M: crate::algebra::dynamic::Metric, const N: usize>(x: &Multi<M>, blades: [u32; N]) -> Vec<f64> {
    blades.map(|blade| x.coefficient(blade)).to_vec()
}

/// `e31 = -e13`.
fn rotor_of<M: crate::algebra::dynamic::Metric>(x: &Multi<M>) -> Vec<f64> {
    vec![x.coefficient(0), x.coefficient(E2 | E3), -x.coefficient(E1 | E3), x.coefficient(E1 | E2)]
}

/// A motor holds `ninf` but not `no`: the coefficient of `b e` is that of `b ninf`.
fn motor_of(x: &Multi<cga::Algebra>) -> Vec<f64> {
    [rotor_of(x), coefficients(x, [E1 | E, E2 | E, E3 | E, E1 | E2 | E3 | E])].concat()
}

/// `s = c + no + (c² - rho²)/2 ninf`, and the coefficient of `ninf` is half the sum of those of e and ebar.
fn sphere_of(s: &Multi<cga::Algebra>) -> Vec<f64> {
    let centre = coefficients(s, [E1, E2, E3]);
    let centre_sq: f64 = centre.iter().map(|x| x * x).sum();
    let rho_sq = centre_sq - (s.coefficient(E) + s.coefficient(EBAR));
    [centre, vec![rho_sq]].concat()
}

fn numbers<A: Into<[T; N]>, T: Real, const N: usize>(value: A) -> Vec<f64> {
    value.into().map(Real::to_f64).to_vec()
}

fn single(value: f64) -> f32 {
    Real::from_f64(value)
}

fn translator(t: Vector) -> Translator {
    Translator::by(t)
}

/// The quaternion `w + xi + yj + zk` is the rotor `w - x e23 - y e31 - z e12`.
fn quaternion(r: &Rotor) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(r.s, -r.e23, -r.e31, -r.e12))
}

fn euclidean(x: Vector) -> Vector3<f64> {
    Vector3::new(x.e1, x.e2, x.e3)
}

fn isometry((t, r): &(Vector, Rotor)) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(euclidean(*t)), quaternion(r))
}

fn repeat<I>(mut make: impl FnMut() -> I) -> Vec<I> {
    (0..INPUTS).map(|_| make()).collect()
}

/// SplitMix64 (Steele, Lea and Flood 2014): the same inputs on every machine.
struct Random(u64);

impl Random {
    /// Uniform in [-1, 1).
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let bits = (z ^ (z >> 31)) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector {
        Vector::from_fn(|_| self.number())
    }

    fn point(&mut self) -> Point {
        Point::from_fn(|_| self.number())
    }

    /// Uniform over the rotations: a direction in four dimensions, by rejection.
    fn rotor(&mut self) -> Rotor {
        loop {
            let [s, x, y, z]: [f64; 4] = std::array::from_fn(|_| self.number());
            let norm_sq = s * s + x * x + y * y + z * z;
            if (0.01..1.0).contains(&norm_sq) {
                let norm = norm_sq.sqrt();
                return Rotor::new(s / norm, x / norm, y / norm, z / norm);
            }
        }
    }

    fn pose(&mut self) -> (Vector, Rotor) {
        (self.vector(), self.rotor())
    }

    /// The corners of a regular tetrahedron, each shaken by up to a quarter of a coordinate: never nearly coplanar.
    fn tetrahedron(&mut self) -> [Point; 4] {
        let centre: [f64; 3] = std::array::from_fn(|_| self.number());
        [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]
            .map(|corner: [f64; 3]| Point::from_fn(|i| centre[i] + corner[i] + 0.25 * self.number()))
    }

    /// A plane, and two points of a line that meets it at more than 17 degrees.
    fn plane_and_line(&mut self) -> (Plane, [Point; 2]) {
        loop {
            let (normal, direction, start) = (self.vector(), self.vector(), self.point());
            let (n, d) = (euclidean(normal), euclidean(direction));
            if (0.1..1.0).contains(&n.norm()) && (0.1..1.0).contains(&d.norm()) {
                let n = n.normalize();
                if n.dot(&d).abs() > 0.3 * d.norm() {
                    let end = Point::new(start.x + d.x, start.y + d.y, start.z + d.z);
                    return (Plane::new(n.x, n.y, n.z, self.number()), [start, end]);
                }
            }
        }
    }
}
