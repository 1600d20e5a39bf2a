//! Closed forms of solids against the integrals over their triangulations, which know none of them, and in their limits.
#![allow(clippy::unwrap_used, reason = "a test that cannot be set up should stop there")]

#[path = "support/shapes.rs"]
mod shapes;

use ga_physics::geometry::mass_properties::{MassProperties, mass_properties};
use ga_physics::geometry::mesh::Mesh;
use ga_physics::geometry::solids::{SolidError, ball, capsule, cone, cuboid, cylinder};
use shapes::cuboid as box_between;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The solid that a profile (r, z), from the bottom of the axis to its top, sweeps about z, with `n` facets around.
/// The first and last points lie on the axis, the others do not.
fn turned(profile: &[[f64; 2]], n: u32) -> Mesh {
    let rings = u32::try_from(profile.len()).unwrap() - 2;
    let mut vertices = vec![[0.0, 0.0, profile[0][1]]];
    for &[r, z] in &profile[1..=rings as usize] {
        vertices.extend((0..n).map(|i| {
            let (sin, cos) = (f64::from(i) / f64::from(n) * TAU).sin_cos();
            [r * cos, r * sin, z]
        }));
    }
    vertices.push([0.0, 0.0, profile[rings as usize + 1][1]]);
    let top = u32::try_from(vertices.len()).unwrap() - 1;
    let mut triangles = vec![];
    for i in 0..n {
        let at = |ring: u32, i: u32| 1 + ring * n + i % n;
        triangles.extend([[0, at(0, i + 1), at(0, i)], [top, at(rings - 1, i), at(rings - 1, i + 1)]]);
        for ring in 1..rings {
            let [a, b] = [at(ring - 1, i), at(ring - 1, i + 1)];
            triangles.extend([[a, b, at(ring, i + 1)], [a, at(ring, i + 1), at(ring, i)]]);
        }
    }
    shapes::mesh(&vertices, &triangles)
}

/// Points on a quarter circle about (0, z), from one angle above the equator to another.
fn arc(radius: f64, z: f64, [from, to]: [f64; 2], n: u32) -> Vec<[f64; 2]> {
    let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(n);
    (0..=n).map(|i| [radius * at(i).cos(), z + radius * at(i).sin()]).collect()
}

fn meshed_ball(n: u32) -> Mesh {
    turned(&arc(0.7, 0.0, [-FRAC_PI_2, FRAC_PI_2], n), 2 * n)
}

fn meshed_capsule(n: u32) -> Mesh {
    let mut profile = arc(0.3, -0.55, [-FRAC_PI_2, 0.0], n);
    profile.extend(arc(0.3, 0.55, [0.0, FRAC_PI_2], n));
    turned(&profile, 4 * n)
}

fn meshed_cylinder(n: u32) -> Mesh {
    turned(&[[0.0, -0.6], [0.4, -0.6], [0.4, 0.6], [0.0, 0.6]], 2 * n)
}

fn meshed_cone(n: u32) -> Mesh {
    turned(&[[0.0, 0.0], [0.4, 0.0], [0.0, 1.3]], 2 * n)
}

/// Volume, height of the centre, transverse and axial moments.
fn numbers(found: &MassProperties) -> [f64; 4] {
    let i = found.inertia_unit_density;
    [found.volume, found.centre.z, i[0][0], i[2][2]]
}

/// Halving the facets quarters the error, and what is left after that is removed is smaller still: order two, and towards
/// the closed form.
#[test]
fn fine_triangulations_tend_to_the_closed_forms() {
    type Meshed = fn(u32) -> Mesh;
    let cases: [(&str, MassProperties, Meshed); 4] = [
        ("ball", ball(0.7).unwrap(), meshed_ball),
        ("capsule", capsule(0.3, 1.1).unwrap(), meshed_capsule),
        ("cylinder", cylinder(0.4, 1.2).unwrap(), meshed_cylinder),
        ("cone", cone(0.4, 1.3).unwrap(), meshed_cone),
    ];
    for (name, exact, meshed) in cases {
        let [coarse, fine] = [16, 32].map(|n| numbers(&mass_properties(&meshed(n)).unwrap()));
        for ((exact, coarse), fine) in numbers(&exact).into_iter().zip(coarse).zip(fine) {
            let [coarse, fine] = [coarse - exact, fine - exact];
            println!("{name}: {exact:.6}, errors {coarse:.2e} {fine:.2e}");
            if fine.abs() < 1e-14 {
                continue; // A centre at the origin, or at height/4 of any pyramid.
            }
            assert!((3.9..4.1).contains(&(coarse / fine)), "{name}: {exact} order of {coarse:e}, {fine:e}");
            // Terms of the fourth power of the facets' angle, at most pi/32, with a factor that is 1.1 at most here.
            let left = (4.0 * fine - coarse) / 3.0;
            assert!(left.abs() < 2.0 * (PI / 32.0).powi(4) * exact, "{name}: {exact} is missed by {left:e}");
        }
    }
}

#[test]
fn a_box_is_its_mesh() {
    for size in [[1.0, 1.0, 1.0], [0.3, 1.7, 2.9], [1e-6, 1.0, 1e3]] {
        let meshed = mass_properties(&box_between(size.map(|x| -0.5 * x), size.map(|x| 0.5 * x))).unwrap();
        let found = cuboid(size).unwrap();
        assert_close(found.volume, meshed.volume);
        for i in 0..3 {
            assert_close(found.inertia_unit_density[i][i], meshed.inertia_unit_density[i][i]);
        }
        assert_eq!(found.centre, meshed.centre);
    }
}

/// Five roundings or so.
fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(), "{found:e} is not {expected:e}");
}

/// Sizes whose powers are exact leave only pi and the fractions to be rounded.
#[test]
fn known_numbers() {
    let check = |found: MassProperties, expected: [f64; 4]| {
        numbers(&found).into_iter().zip(expected).for_each(|(found, expected)| assert_close(found, expected));
    };
    check(ball(1.0).unwrap(), [4.188790204786391, 0.0, 1.6755160819145565, 1.6755160819145565]);
    check(cylinder(2.0, 3.0).unwrap(), [12.0 * PI, 0.0, 21.0 * PI, 24.0 * PI]);
    check(cone(2.0, 4.0).unwrap(), [16.0 / 3.0 * PI, 1.0, 6.4 * PI, 6.4 * PI]);
    // Cylinder 4 pi, ball 4/3 pi: 4 (1/4 + 16/12) + 4/3 (2/5 + 3/2 + 4) and 4/2 + 8/15.
    check(capsule(1.0, 4.0).unwrap(), [16.0 / 3.0 * PI, 0.0, 14.2 * PI, 38.0 / 15.0 * PI]);
}

#[test]
fn flat_and_thin_limits() {
    // A lamina has the sum of two moments as the third; a rod l²/12, a ball's 2/5 r² when nothing is between its halves.
    let tiny = 1e-20;
    let [volume, _, transverse, axial] = numbers(&cylinder(2.0, tiny).unwrap());
    assert_close(2.0 * transverse, axial);
    assert_close(axial / volume, 2.0);
    let [volume, _, transverse, axial] = numbers(&cone(2.0, tiny).unwrap());
    assert_close(2.0 * transverse, axial);
    assert_close(axial / volume, 1.2);
    let plate = cuboid([2.0, 3.0, tiny]).unwrap().inertia_unit_density;
    assert_close(plate[0][0] + plate[1][1], plate[2][2]);
    for rod in [cylinder(tiny, 3.0), capsule(tiny, 3.0), cuboid([tiny, tiny, 3.0])] {
        let [volume, _, transverse, axial] = numbers(&rod.unwrap());
        assert_close(transverse / volume, 0.75);
        assert!(axial > 0.0 && axial / transverse < 1e-38);
    }
    for (capsule, ball) in numbers(&capsule(2.0, tiny).unwrap()).into_iter().zip(numbers(&ball(2.0).unwrap())) {
        assert_close(capsule, ball);
    }
}

#[test]
fn the_ends_of_the_range_are_finite_and_beyond_them_is_an_error() {
    let (low, high) = (1e-50, 1e50);
    for (a, b) in [(low, low), (low, high), (high, low), (high, high)] {
        for found in [ball(a), cuboid([a, b, a]), capsule(a, b), cylinder(a, b), cone(a, b)] {
            let found = found.unwrap();
            let i = found.inertia_unit_density;
            assert!([found.volume, i[0][0], i[1][1], i[2][2]].iter().all(|x| x.is_normal() && *x > 0.0), "{found:?}");
            // No moment exceeds the sum of the others by more than their rounding.
            assert!(i[2][2] <= (i[0][0] + i[1][1]) * (1.0 + 4.0 * f64::EPSILON));
        }
    }
    for wrong in [0.0, -0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        for found in
            [ball(wrong), cuboid([1.0, wrong, 1.0]), capsule(1.0, wrong), cylinder(wrong, 1.0), cone(1.0, wrong)]
        {
            assert!(matches!(found, Err(SolidError::NotPositive { value, .. }) if value.to_bits() == wrong.to_bits()));
        }
    }
    for far in [1e-51, 1e51, f64::MIN_POSITIVE, 5e-324, f64::MAX] {
        for found in [ball(far), cuboid([1.0, 1.0, far]), capsule(far, 1.0), cylinder(1.0, far), cone(far, 1.0)] {
            assert!(matches!(found, Err(SolidError::OutOfRange { value, .. }) if value == far));
        }
    }
    let told = cone(1.0, -2.0).unwrap_err().to_string();
    assert_eq!(told, "the height is -2.0 m: it must be a positive, finite number");
}
