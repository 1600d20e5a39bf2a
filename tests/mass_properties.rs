//! Volume, centre and inertia of meshes, against exact rational arithmetic on the same coordinates and closed forms.
#![allow(clippy::unwrap_used, reason = "a test that cannot be set up should stop there")]

#[path = "support/exact.rs"]
mod exact;
#[path = "support/shapes.rs"]
mod shapes;

use exact::{ExactMass, error, exact_mass};
use ga_physics::geometry::mass_properties::{
    ClosedMesh, MassError, MassProperties, PrincipalAxes, mass_properties, principal_axes,
};
use ga_physics::geometry::mesh::Mesh;
use ga_physics::nalgebra::{Matrix3, Quaternion, UnitQuaternion};
use num_traits::ToPrimitive;
use shapes::*;

/// The promised relative error.
const PROMISED: f64 = 1e-14;
/// What is reached by double-double sums: the last rounding, half an ulp, and a little. Held to it so that a loss of digits
/// shows long before the promise.
const CAREFUL: f64 = f64::EPSILON;
/// What is reached by bounded f64 sums: their roundings average out, far below the bound on them.
const FAST: f64 = 2.0 * f64::EPSILON;

/// Relative errors of volume, centre (of its distance from the origin, or of the size if that is larger) and inertia (of
/// its largest entry).
fn errors(mesh: &Mesh, found: &MassProperties, exact: &ExactMass) -> [f64; 3] {
    let volume = error(found.volume, &exact.volume).abs() / exact.volume.to_f64().unwrap();
    let c = [found.centre.x, found.centre.y, found.centre.z];
    let off = (0..3).map(|i| error(c[i], &exact.centre[i]).abs()).fold(0.0, f64::max);
    let size = mesh.vertices.iter().flat_map(|p| [p.x, p.y, p.z]).fold(0.0f64, |m, x| m.max(x.abs()));
    let largest = (0..3).map(|i| exact.inertia[i][i].to_f64().unwrap()).fold(0.0, f64::max);
    let entries = (0..9).map(|k| error(found.inertia_unit_density[k / 3][k % 3], &exact.inertia[k / 3][k % 3]).abs());
    [volume, off / size, entries.fold(0.0, f64::max) / largest]
}

fn solids() -> Vec<(&'static str, Mesh)> {
    vec![
        ("cube", cube()),
        ("regular tetrahedron", regular_tetrahedron()),
        ("corner tetrahedron", corner_tetrahedron()),
        ("icosphere(3)", icosphere(3)),
        ("torus 48x24", torus(48, 24)),
        ("L prism", l_prism()),
        ("plate 1:1e-3, turned", stretched_and_turned(&cube(), [1.0, 0.7, 1e-3])),
        ("disc 1:1e-5, turned", stretched_and_turned(&icosphere(2), [1.0, 0.7, 1e-5])),
        ("rod 1:1e-4, turned", stretched_and_turned(&icosphere(2), [1.0, 1e-4, 1e-4])),
    ]
}

#[test]
fn matches_exact_rationals_at_any_distance() {
    println!("| solid | distance | volume | centre | inertia |\n|---|---|---|---|---|");
    for (name, solid) in solids() {
        for distance in [0.0, 1.0, 1e3, 1e4, 1e6] {
            let placed = moved(&solid, [0.6 * distance, -0.64 * distance, 0.48 * distance]);
            let found = mass_properties(&placed).unwrap();
            let relative = errors(&placed, &found, &exact_mass(&placed));
            println!("| {name} | {distance:e} | {:.1e} | {:.1e} | {:.1e} |", relative[0], relative[1], relative[2]);
            let reached = if placed.triangles.len() < 64 { CAREFUL } else { FAST };
            for (quantity, value) in ["volume", "centre", "inertia"].iter().zip(relative) {
                assert!(
                    value <= reached && reached <= PROMISED,
                    "{name} at {distance}: relative error of the {quantity} {value:e}"
                );
            }
        }
    }
}

/// The same formulas in plain f64 about the world origin: what distance costs there.
#[test]
fn plain_sums_about_the_origin_lose_a_digit_or_more_for_each_of_distance() {
    let mut worst = vec![];
    for distance in [0.0, 1e2, 1e4] {
        let placed = moved(&torus(48, 24), [0.6 * distance, -0.64 * distance, 0.48 * distance]);
        let volume_6: f64 = placed
            .triangles
            .iter()
            .map(|&t| {
                let [a, b, c] = placed.corners(t);
                a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x)
            })
            .sum();
        let exact = exact_mass(&placed).volume;
        worst.push((error(volume_6 / 6.0, &exact) / exact.to_f64().unwrap()).abs());
    }
    assert!(worst[0] < 1e-13 && worst[1] > 1e-11 && worst[2] > 1e-7, "{worst:?}");
}

/// A mesh that was checked is not checked again, and gives the same bits.
#[test]
fn a_checked_mesh_has_the_same_mass_properties() {
    let solid = torus(20, 12);
    let closed = ClosedMesh::new(&solid).unwrap();
    assert_eq!(closed.mass_properties(), mass_properties(&solid));
    assert!(matches!(ClosedMesh::new(&mesh(&[[0.0; 3]; 3], &[[0, 1, 2]])), Err(MassError::NotClosed { .. })));
}

#[test]
fn oracle_knows_the_closed_forms() {
    let third = |n: i64, d: i64| num_rational::BigRational::new(n.into(), d.into());
    let cube = exact_mass(&cube());
    assert_eq!(
        (cube.volume, cube.inertia[0][0].clone(), cube.inertia[0][1].clone()),
        (third(1, 1), third(1, 6), third(0, 1))
    );
    // Second moments at the right angle: V/10 on the diagonal, V/20 beside it. Moved to the centre (1/4, 1/4, 1/4):
    // V (1/10 - 1/16) = 1/160 and V (1/20 - 1/16) = -1/480.
    let corner = exact_mass(&corner_tetrahedron());
    assert_eq!(corner.volume, third(1, 6));
    assert_eq!(corner.centre, [third(1, 4), third(1, 4), third(1, 4)]);
    assert_eq!((corner.inertia[2][2].clone(), corner.inertia[1][2].clone()), (third(1, 80), third(1, 480)));
    let l = exact_mass(&l_prism());
    assert_eq!((l.volume, l.centre), (third(3, 1), [third(5, 6), third(5, 6), third(1, 2)]));
}

#[test]
fn inertia_is_symmetric_and_signed_like_minus_the_product_moment() {
    // Most of the L lies off the diagonal x = y: its product moment about the centre is negative, -∫xy positive.
    let inertia = mass_properties(&l_prism()).unwrap().inertia_unit_density;
    assert!((inertia[0][1] - 1.0 / 3.0).abs() < 1e-15, "{inertia:?}");
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        assert_eq!(inertia[i][j].to_bits(), inertia[j][i].to_bits());
    }
}

#[test]
fn the_order_and_rotation_of_triangles_do_not_matter_to_the_last_digits() {
    let mut shuffled = torus(20, 12);
    let found = mass_properties(&shuffled).unwrap();
    shuffled.triangles.reverse();
    shuffled.triangles.iter_mut().for_each(|t| t.rotate_left(1));
    let again = mass_properties(&shuffled).unwrap();
    assert!((found.volume - again.volume).abs() <= f64::EPSILON * found.volume);
}

#[test]
fn what_has_no_mass_properties_is_an_error_that_says_why() {
    let mut open = cube();
    open.triangles.pop();
    assert!(matches!(mass_properties(&open), Err(MassError::NotClosed { .. })));
    let mut flipped = cube();
    flipped.triangles[3].swap(0, 1);
    assert!(matches!(mass_properties(&flipped), Err(MassError::NotOriented { .. })));
    assert_eq!(mass_properties(&reversed(&cube())), Err(MassError::InsideOut { volume: -1.0 }));
    let sheet = mesh(&[[0.1, 0.2, 0.3], [1.1, 0.4, 0.5], [0.3, 1.7, 0.7]], &[[0, 1, 2], [0, 2, 1]]);
    assert_eq!(mass_properties(&sheet), Err(MassError::NoVolume));
    let flat = cuboid([0.1, 0.2, 0.3], [1.1, 1.3, 0.3]);
    assert_eq!(mass_properties(&flat), Err(MassError::NoVolume));
    assert!(matches!(mass_properties(&cuboid([0.0; 3], [1e60; 3])), Err(MassError::OutOfRange { .. })));
    assert!(matches!(mass_properties(&cuboid([0.0; 3], [1e-60; 3])), Err(MassError::OutOfRange { .. })));
}

#[test]
fn a_solid_of_one_rounding_of_thickness_still_has_its_volume() {
    let thin = cuboid([0.0, 0.0, 1.0], [1.0, 1.0, 1.0 + f64::EPSILON]);
    assert_eq!(mass_properties(&thin).unwrap().volume, f64::EPSILON);
}

/// `axes^T inertia axes` is diagonal with the moments, the axes are orthonormal and right-handed.
fn assert_principal(inertia: [[f64; 3]; 3], found: &PrincipalAxes) {
    let axes = found.axes.map(|v| [v.e1, v.e2, v.e3]);
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let largest = inertia.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
        let unit = if i == j { 1.0 } else { 0.0 };
        assert!((dot(axes[i], axes[j]) - unit).abs() < 1e-14, "not orthonormal: {axes:?}");
        let image = inertia.map(|row| dot(row, axes[j]));
        assert!((dot(axes[i], image) - unit * found.moments[i]).abs() <= 1e-14 * largest, "{found:?} of {inertia:?}");
    }
    let [u, v, w] = axes;
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    assert!(dot(cross, w) > 0.999, "left-handed: {axes:?}");
    assert!(found.moments.is_sorted(), "{:?}", found.moments);
}

#[test]
fn principal_axes_diagonalise() {
    for (name, solid) in solids() {
        let inertia = mass_properties(&solid).unwrap().inertia_unit_density;
        println!("{name}");
        assert_principal(inertia, &principal_axes(inertia).unwrap());
    }
    for inertia in [
        [[3.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]],
        [[2.0, -1.0, -1.0], [-1.0, 2.0, -1.0], [-1.0, -1.0, 2.0]],
        [[1.0, 1e-9, 0.0], [1e-9, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[1e-200, 2e-201, 0.0], [2e-201, 1e-200, 0.0], [0.0, 0.0, 1e-200]],
        [[1e200, 2e199, 1e198], [2e199, 1e200, 0.0], [1e198, 0.0, 1e200]],
        [[0.0; 3]; 3],
    ] {
        assert_principal(inertia, &principal_axes(inertia).unwrap());
    }
}

#[test]
fn equal_moments_keep_the_given_axes() {
    let axes = principal_axes(mass_properties(&cube()).unwrap().inertia_unit_density).unwrap().axes;
    assert_eq!(axes.map(|v| [v.e1, v.e2, v.e3]), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(principal_axes([[f64::NAN; 3]; 3]), Err(MassError::InertiaNotFinite));
}

/// The greatest entry of `I a - lambda a` over the three axes, in exact arithmetic, relative to the largest moment.
fn residual(inertia: [[f64; 3]; 3], found: &PrincipalAxes) -> f64 {
    let exact = |x: f64| num_rational::BigRational::from_float(x).unwrap();
    let mut worst = 0.0f64;
    for (axis, moment) in found.axes.iter().map(|v| [v.e1, v.e2, v.e3]).zip(found.moments) {
        for (row, x) in inertia.iter().zip(axis) {
            let image = (0..3).map(|j| exact(row[j]) * exact(axis[j])).sum::<num_rational::BigRational>();
            worst = worst.max((image - exact(moment) * exact(x)).to_f64().unwrap().abs());
        }
    }
    worst / found.moments[2]
}

#[test]
fn equal_and_nearly_equal_moments_leave_residuals_of_a_few_roundings() {
    let mut worst = 0.0f64;
    for moments in
        [[1.0, 1.0, 1.0], [1.0, 1.0, 2.0], [1.0, 2.0, 2.0], [1.0, 2.0, 3.0], [1e-6, 1.0, 1.0], [0.5, 0.5, 1.0]]
    {
        for split in [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3] {
            for turn in 0..20 {
                let moments = [moments[0], moments[1] * (1.0 + split), moments[2] * (1.0 + 3.0 * split)];
                // Angles of the golden ratio leave no turn near another.
                let q = [1.0, 2.0, 3.0, 4.0].map(|k: f64| (1.618_033_988_749_895 * k * f64::from(turn) + k * k).sin());
                let r = UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3]));
                let r = r.to_rotation_matrix();
                let matrix = r * Matrix3::from_diagonal(&moments.into()) * r.transpose();
                let inertia = [0, 1, 2].map(|i| [0, 1, 2].map(|j| matrix[(i.max(j), i.min(j))]));
                let found = principal_axes(inertia).unwrap();
                worst = worst.max(residual(inertia, &found));
            }
        }
    }
    assert!(worst <= 1e-15, "{worst:e}");
}
