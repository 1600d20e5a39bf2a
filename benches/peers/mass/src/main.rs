//! Mass properties of meshes beside parry's: errors against exact rationals, times in turn in one process.
//!
//! parry checks nothing, so the integrals alone ([`ClosedMesh::mass_properties`]) stand beside it, and then both steps, the
//! check of the edges and the integrals. Coordinates count as exact; they were rounded where the mesh stands.
//!
//! `cargo run --release -p mass`; a Markdown table on the terminal.

#[path = "../../../../tests/support/exact.rs"]
mod exact;
#[path = "../../../../tests/support/shapes.rs"]
mod shapes;

use cpu_time::ThreadTime;
use exact::{ExactMass, error, exact_mass};
use ga_physics::geometry::mass_properties::{ClosedMesh, mass_properties};
use ga_physics::geometry::mesh::Mesh;
use num_traits::ToPrimitive;
use parry3d_f64::mass_properties::MassProperties as Peer;
use parry3d_f64::math::Vector;
use std::hint::black_box;
use std::time::Duration;

/// Each round times every way once.
const ROUNDS: usize = 41;
/// Far above the cost of reading the clock of a thread (some 0.3 us).
const LEAST_SAMPLE: Duration = Duration::from_millis(4);

/// Volume, centre, inertia.
type Found = (f64, [f64; 3], [[f64; 3]; 3]);

fn main() {
    let cases = [
        ("cube", shapes::cube()),
        ("regular tetrahedron", shapes::regular_tetrahedron()),
        ("corner tetrahedron", shapes::corner_tetrahedron()),
        ("icosphere", shapes::icosphere(4)),
        ("torus", shapes::torus(96, 48)),
        // Thin and turned, so that terms cancel: the bound asks for the careful sums.
        ("torus, flattened", shapes::stretched_and_turned(&shapes::torus(96, 48), [1.0, 1.0, 1e-6])),
    ];
    println!("Largest relative error of volume, centre and inertia.\n");
    println!("| solid | facets | distance | ga-physics | parry: volume | centre | inertia |");
    println!("|---|---|---|---|---|---|---|");
    for (name, solid) in &cases {
        for distance in [0.0, 1e2, 1e4] {
            print_errors(name, solid, distance);
        }
    }
    println!(
        "\nNanoseconds of processor time a facet, medians of {ROUNDS} rounds; ratios within a round, with their middle half.\n"
    );
    println!(
        "| solid | facets | distance | parry | integrals | check and integrals | integrals / parry | both / parry |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for (name, solid) in &cases[3..] {
        for distance in [0.0, 1e4] {
            print_times(name, solid, distance);
        }
    }
}

fn placed(solid: &Mesh, distance: f64) -> Mesh {
    if distance == 0.0 { solid.clone() } else { shapes::moved(solid, [0.6, -0.64, 0.48].map(|x| x * distance)) }
}

fn vertices(mesh: &Mesh) -> Vec<Vector> {
    mesh.vertices.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect()
}

fn print_errors(name: &str, solid: &Mesh, distance: f64) {
    let mesh = placed(solid, distance);
    let exact = exact_mass(&mesh);
    let ours = mass_properties(&mesh).expect("a closed solid");
    let ours = (ours.volume, [ours.centre.x, ours.centre.y, ours.centre.z], ours.inertia_unit_density);
    let peer = Peer::from_trimesh(1.0, &vertices(&mesh), &mesh.triangles);
    let matrix = peer.reconstruct_inertia_matrix();
    let entry = |i: usize, j: usize| matrix.col(j)[i];
    let inertia = [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)));
    let [volume, centre, inertia] = errors(&exact, (peer.mass(), peer.local_com.into(), inertia), distance);
    let largest = errors(&exact, ours, distance).into_iter().fold(0.0, f64::max);
    let facets = mesh.triangles.len();
    println!("| {name} | {facets} | {distance:.0} | {largest:.1e} | {volume:.1e} | {centre:.1e} | {inertia:.1e} |");
}

/// Of the volume; of the centre, relative to its distance or the size (1), and of the inertia, relative to its largest entry.
fn errors(exact: &ExactMass, (volume, centre, inertia): Found, distance: f64) -> [f64; 3] {
    let off = (0..3).map(|i| error(centre[i], &exact.centre[i]).abs()).fold(0.0, f64::max);
    let largest = (0..3).filter_map(|i| exact.inertia[i][i].to_f64()).fold(0.0, f64::max);
    let entries = (0..9).map(|k| error(inertia[k / 3][k % 3], &exact.inertia[k / 3][k % 3]).abs());
    let whole = exact.volume.to_f64().expect("in range");
    [error(volume, &exact.volume).abs() / whole, off / distance.max(1.0), entries.fold(0.0, f64::max) / largest]
}

fn print_times(name: &str, solid: &Mesh, distance: f64) {
    let mesh = placed(solid, distance);
    let points = vertices(&mesh);
    let closed = ClosedMesh::new(&mesh).expect("a closed solid");
    let peer = || {
        black_box(Peer::from_trimesh(1.0, black_box(&points), black_box(&mesh.triangles)));
    };
    let integrals = || {
        black_box(black_box(closed).mass_properties().is_ok());
    };
    let both = || {
        black_box(mass_properties(black_box(&mesh)).is_ok());
    };
    let ways: [&dyn Fn(); 3] = [&peer, &integrals, &both];
    let mut samples = vec![[0.0; 3]; ROUNDS];
    for (round, row) in samples.iter_mut().enumerate() {
        for turn in 0..ways.len() {
            let way = (turn + round) % ways.len();
            row[way] = time(ways[way]);
        }
    }
    let facets = mesh.triangles.len();
    let ns = |way: usize| quartiles(samples.iter().map(|row| 1e9 * row[way] / facets as f64))[1];
    let ratio = |way: usize| {
        let [low, median, high] = quartiles(samples.iter().map(|row| row[way] / row[0]));
        format!("{median:.2} ({low:.2} to {high:.2})")
    };
    let [parry, alone, checked] = [0, 1, 2].map(ns);
    let (alone_ratio, both_ratio) = (ratio(1), ratio(2));
    println!(
        "| {name} | {facets} | {distance:.0} | {parry:.1} | {alone:.1} | {checked:.1} | {alone_ratio} | {both_ratio} |"
    );
}

/// Seconds of one call, the mean over as many as fill a sample.
fn time(call: &dyn Fn()) -> f64 {
    let clock = ThreadTime::now();
    let mut calls = 0;
    while clock.elapsed() < LEAST_SAMPLE {
        call();
        calls += 1;
    }
    clock.elapsed().as_secs_f64() / f64::from(calls)
}

fn quartiles(values: impl Iterator<Item = f64>) -> [f64; 3] {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    [1, 2, 3].map(|quarter| values[(values.len() - 1) * quarter / 4])
}
