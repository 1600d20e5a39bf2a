//! The kernels written out on plain arrays: the vector formula with common terms taken out by hand.
//!
//! Quaternions are `[w, x, y, z]`, the rotor `w - x e23 - y e31 - z e12`.

use ga_physics::algebra::cga::{Motor, Plane};
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::study::kernels::{Kernel, Role, Way, inputs};

const HAND: Role = Role::Rival("hand f64");

type V = [f64; 3];
type Q = [f64; 4];

pub(super) fn rotor_times_rotor(kernel: Kernel) -> Kernel {
    let inputs = inputs::rotor_pairs().into_iter().map(|(a, b)| (quaternion(a), quaternion(b))).collect();
    kernel.with(Way::rival(HAND, inputs, |(a, b)| product(*a, *b), |q| rotor(*q).to_vec()))
}

pub(super) fn rotor_on_vector(kernel: Kernel) -> Kernel {
    let inputs = inputs::rotors_and_vectors().into_iter().map(|(r, x)| (quaternion(r), <V>::from(x))).collect();
    kernel.with(Way::rival(HAND, inputs, |(q, x)| turned(*q, *x), |x| x.to_vec()))
}

pub(super) fn motor_on_point(kernel: Kernel) -> Kernel {
    let inputs = inputs::poses_and_points().into_iter().map(|((t, r), x)| (quaternion(r), <V>::from(t), <V>::from(x)));
    kernel.with(Way::rival(HAND, inputs.collect(), |(q, t, x)| add(turned(*q, *x), *t), |x| x.to_vec()))
}

pub(super) fn motor_times_motor(kernel: Kernel) -> Kernel {
    let inputs = inputs::pose_pairs().into_iter().map(|pair| pair.map(|(t, r)| (quaternion(r), <V>::from(t))));
    kernel.with(Way::rival(
        HAND,
        inputs.collect(),
        |[(q, t), (r, u)]: &[(Q, V); 2]| (product(*q, *r), add(turned(*q, *u), *t)),
        |(q, t)| {
            let [s, e23, e31, e12] = rotor(*q);
            <[f64; 8]>::from(Motor::from_parts(Vector::from(*t), Rotor::new(s, e23, e31, e12))).to_vec()
        },
    ))
}

/// Cramer's rule in the frame of the first point: `(|u|² v×w + |v|² w×u + |w|² u×v) / (2 u . v×w)`.
pub(super) fn sphere_of_four_points(kernel: Kernel) -> Kernel {
    let inputs = inputs::tetrahedra().into_iter().map(|points| points.map(<V>::from)).collect();
    let sphere = |[a, b, c, d]: &[V; 4]| {
        let (u, v, w) = (subtract(*b, *a), subtract(*c, *a), subtract(*d, *a));
        let (vw, wu, uv) = (cross(v, w), cross(w, u), cross(u, v));
        let scale = 0.5 / dot(u, vw);
        let (p, q, r) = (dot(u, u) * scale, dot(v, v) * scale, dot(w, w) * scale);
        let radius = [0, 1, 2].map(|i| p * vw[i] + q * wu[i] + r * uv[i]);
        (add(*a, radius), dot(radius, radius))
    };
    kernel.with(Way::rival(HAND, inputs, sphere, centre_and_square))
}

/// In the frame of the first point `(u×v) × (|v|² u - |u|² v) / (2 |u×v|²)`; and by the Gram matrix, `2 G (s, t) = (u², v²)`,
/// in fewer operations, whose determinant cancels for slender triangles: an error of `eps/sin²` in the place of `eps/sin`.
pub(super) fn circle_of_three_points(kernel: Kernel) -> Kernel {
    let inputs: Vec<[V; 3]> = inputs::triangles().into_iter().map(|points| points.map(<V>::from)).collect();
    let circle = |[a, b, c]: &[V; 3]| {
        let (u, v) = (subtract(*b, *a), subtract(*c, *a));
        let (uu, vv) = (dot(u, u), dot(v, v));
        let normal = cross(u, v);
        let scale = 0.5 / dot(normal, normal);
        let radius = cross(normal, [0, 1, 2].map(|i| vv * u[i] - uu * v[i])).map(|x| x * scale);
        (add(*a, radius), dot(radius, radius))
    };
    let gram = |[a, b, c]: &[V; 3]| {
        let (u, v) = (subtract(*b, *a), subtract(*c, *a));
        let (uu, uv, vv) = (dot(u, u), dot(u, v), dot(v, v));
        let scale = 0.5 / (uu * vv - uv * uv);
        let (s, t) = (vv * (uu - uv) * scale, uu * (vv - uv) * scale);
        let radius = [0, 1, 2].map(|i| s * u[i] + t * v[i]);
        (add(*a, radius), dot(radius, radius))
    };
    kernel.with(Way::rival(HAND, inputs.clone(), circle, centre_and_square)).with(Way::rival(
        Role::Rival("hand Gram f64"),
        inputs,
        gram,
        centre_and_square,
    ))
}

/// Plücker coordinates: with the moment `m = p×d`, `x (n . d) = n×m + delta d`.
pub(super) fn line_meets_plane(kernel: Kernel) -> Kernel {
    let lines = inputs::planes_and_lines().into_iter().map(|(plane, points)| {
        let [p, q] = points.map(<V>::from);
        (normal(&plane), plane.ninf, subtract(q, p), cross(p, q))
    });
    let meet = |(n, delta, d, m): &(V, f64, V, V)| {
        let (across, scale) = (cross(*n, *m), 1.0 / dot(*n, *d));
        [0, 1, 2].map(|i| (across[i] + delta * d[i]) * scale)
    };
    kernel.with(Way::rival(HAND, lines.collect(), meet, |x| x.to_vec()))
}

pub(super) fn ray_meets_plane(kernel: Kernel) -> Kernel {
    let rays = inputs::planes_and_lines().into_iter().map(|(plane, points)| {
        let [p, q] = points.map(<V>::from);
        (normal(&plane), plane.ninf, p, subtract(q, p))
    });
    let meet = |(n, delta, p, d): &(V, f64, V, V)| {
        let t = (delta - dot(*n, *p)) / dot(*n, *d);
        [0, 1, 2].map(|i| p[i] + t * d[i])
    };
    kernel.with(Way::rival(HAND, rays.collect(), meet, |x| x.to_vec()))
}

pub(super) fn balls_overlap(kernel: Kernel) -> Kernel {
    let balls = inputs::ball_pairs().into_iter().map(|pair| pair.map(|(centre, radius)| (<V>::from(centre), radius)));
    let overlap = |[(a, r), (b, s)]: &[(V, f64); 2]| {
        let (d, sum) = (subtract(*a, *b), r + s);
        dot(d, d) <= sum * sum
    };
    kernel.with(Way::rival(HAND, balls.collect(), overlap, |hit| vec![1.0, f64::from(*hit)]))
}

fn product([w, x, y, z]: Q, [s, a, b, c]: Q) -> Q {
    [
        w * s - x * a - y * b - z * c,
        w * a + x * s + y * c - z * b,
        w * b - x * c + y * s + z * a,
        w * c + x * b - y * a + z * s,
    ]
}

/// `x + 2 w (u×x) + 2 u×(u×x)`
fn turned([w, i, j, k]: Q, x: V) -> V {
    let u = [i, j, k];
    let t = cross(u, x).map(|t| 2.0 * t);
    let s = cross(u, t);
    [0, 1, 2].map(|i| x[i] + w * t[i] + s[i])
}

fn add(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn subtract(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn centre_and_square((centre, radius_sq): &(V, f64)) -> Vec<f64> {
    vec![centre[0], centre[1], centre[2], *radius_sq]
}

fn quaternion(r: Rotor) -> Q {
    [r.s, -r.e23, -r.e31, -r.e12]
}

fn rotor([w, x, y, z]: Q) -> [f64; 4] {
    [w, -x, -y, -z]
}

fn normal(plane: &Plane) -> V {
    [plane.e1, plane.e2, plane.e3]
}
