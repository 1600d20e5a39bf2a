//! Mass properties by counting cells against the exact integrals: a Markdown table of relative errors and times.
//!
//! `cargo run --release --example cell_counting`; a minute.

use ga_physics::algebra::cga::Point;
use ga_physics::geometry::cell_counting::{CellCounting, Inside};
use ga_physics::geometry::mass_properties::{ClosedMesh, MassProperties};
use ga_physics::geometry::mesh::Mesh;
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let cube = block([1.0, 1.0, 1.0])?;
    let turned = Mesh::new(cube.vertices.iter().map(|&p| turn(p)).collect(), cube.triangles.clone())?;
    let cases = [
        ("cube, aligned", cube, Inside::HalfSpaces),
        ("cube, turned", turned.clone(), Inside::HalfSpaces),
        ("cube, turned", turned, Inside::Parity),
        ("ball of 120 facets", ball(6, 12)?, Inside::HalfSpaces),
        ("ball of 120 facets", ball(6, 12)?, Inside::Parity),
        ("torus of 2304 facets", torus(48, 24)?, Inside::Parity),
    ];
    println!("| solid | test | cells | volume | inertia, cells as points | inertia, with their own | ms | exact, ms |");
    println!("|---|---|---|---|---|---|---|---|");
    for (name, mesh, inside) in &cases {
        for cells in [8, 16, 32, 64, 128] {
            let start = Instant::now();
            let exact = ClosedMesh::new(mesh)?.mass_properties()?;
            let exact_ms = start.elapsed().as_secs_f64() * 1e3;
            let start = Instant::now();
            let count = |own_inertia| CellCounting { cells, inside: *inside, own_inertia };
            let points = count(false).mass_properties(ClosedMesh::new(mesh)?)?;
            let ms = start.elapsed().as_secs_f64() * 1e3;
            let whole = count(true).mass_properties(ClosedMesh::new(mesh)?)?;
            println!(
                "| {name} | {inside:?} | {cells} | {:+.1e} | {:+.1e} | {:+.1e} | {ms:.1} | {exact_ms:.3} |",
                points.volume / exact.volume - 1.0,
                worst(&points, &exact),
                worst(&whole, &exact)
            );
        }
    }
    Ok(())
}

/// The difference of inertias of the largest size, relative to the largest entry.
fn worst(found: &MassProperties, exact: &MassProperties) -> f64 {
    let entries = |m: &MassProperties| m.inertia_unit_density.into_iter().flatten();
    let largest = entries(exact).fold(0.0, f64::max);
    let differences = entries(found).zip(entries(exact)).map(|(found, exact)| (found - exact) / largest);
    differences.fold(0.0, |worst: f64, x| if x.abs() > worst.abs() { x } else { worst })
}

fn block(size: [f64; 3]) -> Result<Mesh, Box<dyn Error>> {
    let corner =
        |bits: usize| Point::from([0, 1, 2].map(|axis| size[axis] * if bits >> axis & 1 == 1 { 0.5 } else { -0.5 }));
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Ok(Mesh::new((0..8).map(corner).collect(), triangles)?)
}

/// By one radian about (1, 2, 3).
fn turn(p: Point<f64>) -> Point<f64> {
    use ga_physics::algebra::g3::{Rotor, Vector};
    let rotor = Rotor::from_axis_angle(Vector::new(1.0, 2.0, 3.0), 1.0).unwrap_or_default();
    let v = rotor.apply(Vector::new(p.x, p.y, p.z));
    Point::new(v.e1, v.e2, v.e3)
}

/// The unit sphere by latitude and longitude: 2 n (m - 1) facets.
fn ball(m: u32, n: u32) -> Result<Mesh, Box<dyn Error>> {
    let angle = |i: u32, of: u32, all: f64| (f64::from(i) / f64::from(of) * all).sin_cos();
    let mut vertices = vec![Point::new(0.0, 0.0, -1.0)];
    for (i, j) in (1..m).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let ((r, z), (s, c)) = (angle(i, m, std::f64::consts::PI), angle(j, n, std::f64::consts::TAU));
        vertices.push(Point::new(r * c, r * s, -z));
    }
    vertices.push(Point::new(0.0, 0.0, 1.0));
    let (at, top) = (|i: u32, j: u32| 1 + i * n + j % n, (m - 1) * n + 1);
    let mut triangles = vec![];
    for j in 0..n {
        triangles.extend([[0, at(0, j + 1), at(0, j)], [top, at(m - 2, j), at(m - 2, j + 1)]]);
        for i in 0..m - 2 {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Ok(Mesh::new(vertices, triangles)?)
}

/// Radii 1 and 0.4 about the z axis, `n` by `m` quads.
fn torus(n: u32, m: u32) -> Result<Mesh, Box<dyn Error>> {
    let turn = |i: u32, of: u32| (f64::from(i) / f64::from(of) * std::f64::consts::TAU).sin_cos();
    let (mut vertices, mut triangles) = (vec![], vec![]);
    for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
        let ((su, cu), (sv, cv)) = (turn(i, n), turn(j, m));
        vertices.push(Point::new((1.0 + 0.4 * cv) * cu, (1.0 + 0.4 * cv) * su, 0.4 * sv));
        let at = |i: u32, j: u32| (i % n) * m + j % m;
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    Ok(Mesh::new(vertices, triangles)?)
}
