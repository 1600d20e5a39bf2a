//! Counting cells: closed forms where there are some, the two tests against each other, and points on every kind of edge.
#![cfg(feature = "study")]
#![allow(clippy::unwrap_used, reason = "a test that cannot be set up should stop there")]

#[path = "support/shapes.rs"]
mod shapes;

use ga_physics::geometry::cell_counting::{CellCounting, CellError, Inside, MOST_CELLS};
use ga_physics::geometry::mass_properties::{ClosedMesh, MassProperties};
use ga_physics::geometry::mesh::Mesh;
use shapes::*;

const POINTS: CellCounting = CellCounting { cells: 8, inside: Inside::Parity, own_inertia: false };

fn count(how: CellCounting, mesh: &Mesh) -> MassProperties {
    how.mass_properties(ClosedMesh::new(mesh).unwrap()).unwrap()
}

/// n³ point masses on a lattice have 1/12 (1 - 1/n²) of second moments, and all of it with their own inertia.
#[test]
fn an_aligned_cube_is_low_by_the_square_of_the_cell_without_its_own_inertia() {
    for cells in [1, 3, 8, 10] {
        for inside in [Inside::HalfSpaces, Inside::Parity] {
            let how = CellCounting { cells, inside, own_inertia: false };
            let points = count(how, &cube());
            let whole = count(CellCounting { own_inertia: true, ..how }, &cube());
            let n = f64::from(cells);
            assert!((points.volume - 1.0).abs() < 1e-15 && points.centre.x.abs() < 1e-15, "{points:?}");
            for i in 0..3 {
                let [low, right] = [points, whole].map(|found| 6.0 * found.inertia_unit_density[i][i]);
                assert!((1.0 - low - 1.0 / (n * n)).abs() < 1e-14, "{cells} cells: {low}");
                assert!((right - 1.0).abs() < 1e-14, "{cells} cells: {right}");
            }
        }
    }
}

#[test]
fn both_tests_agree_on_every_convex_body() {
    let far = [0.3, -0.7, 11.0];
    for (name, solid) in [
        ("cube", cube()),
        ("tetrahedron", regular_tetrahedron()),
        ("corner tetrahedron", corner_tetrahedron()),
        ("icosphere", icosphere(1)),
        ("turned plate", stretched_and_turned(&cube(), [1.0, 0.7, 0.2])),
        ("moved tetrahedron", moved(&regular_tetrahedron(), far)),
    ] {
        for cells in [1, 2, 4, 7, 8, 16] {
            let how = CellCounting { cells, ..POINTS };
            let closed = ClosedMesh::new(&solid).unwrap();
            let half_spaces = CellCounting { inside: Inside::HalfSpaces, ..how }.mass_properties(closed);
            assert_eq!(half_spaces, how.mass_properties(closed), "{name}, {cells} cells");
        }
    }
}

/// Centres on facets, edges and vertices, rays through edges and vertices and within facets: a box cut into parts through the
/// centres of its cells loses none of them and counts none twice.
#[test]
fn parts_that_share_a_face_share_no_cell() {
    // Centres stand at odd multiples of 1/8; 8 cells of the whole.
    let whole = cuboid([-1.0; 3], [1.0; 3]);
    let how = |cells| CellCounting { cells, ..POINTS };
    assert_eq!(count(how(8), &whole).volume, 8.0);
    // Six tetrahedra about the diagonal: its cells' centres lie on all the inner faces, edges and the diagonal.
    let corner = |bits: u32| [0, 1, 2].map(|axis| if bits >> axis & 1 == 1 { 1.0 } else { -1.0 });
    for cells in [1, 2, 5, 8] {
        let mut sum = 0.0;
        for [a, b] in [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]] {
            let vertices = [corner(0), corner(a), corner(b), corner(7)];
            let part = mesh(&vertices, &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]);
            sum += part_on_the_grid_of(&whole, &part, cells);
        }
        // Cells, but for the rounding of their size.
        let n = f64::from(cells);
        assert!((sum * (n / 2.0).powi(3) - n.powi(3)).abs() < 1e-9, "{cells} cells: {sum}");
    }
}

/// The volume of the cells of a part, on the grid of the whole: beside it stand the whole and the whole inside out, which
/// cancel, and hold the bounding box.
fn part_on_the_grid_of(whole: &Mesh, part: &Mesh, cells: u32) -> f64 {
    let together = joined(part, &joined(whole, &reversed(whole)));
    CellCounting { cells, ..POINTS }
        .mass_properties(ClosedMesh::new(&together).unwrap())
        .map_or(0.0, |found| found.volume)
}

#[test]
fn a_hole_and_a_dent_need_parity() {
    // Half-spaces see nothing of a torus, and of the L its corner square only.
    let how = CellCounting { cells: 24, inside: Inside::HalfSpaces, own_inertia: false };
    let (ring, l) = (torus(16, 8), l_prism());
    assert_eq!(how.mass_properties(ClosedMesh::new(&ring).unwrap()), Err(CellError::NothingInside(24)));
    assert!((count(how, &l).volume - 1.0).abs() < 1e-12, "{:?}", count(how, &l));
    let parity = CellCounting { inside: Inside::Parity, own_inertia: true, ..how };
    let exact = ClosedMesh::new(&l).unwrap().mass_properties().unwrap();
    let found = count(parity, &l);
    assert!((found.volume - exact.volume).abs() < 1e-12 && (found.centre.y - exact.centre.y).abs() < 1e-12);
    assert!((found.inertia_unit_density[0][1] - exact.inertia_unit_density[0][1]).abs() < 1e-12);
    let exact = ClosedMesh::new(&ring).unwrap().mass_properties().unwrap();
    assert!((count(parity, &ring).volume / exact.volume - 1.0).abs() < 0.03);
}

/// Erratic, and on the whole of the first order at least: a turned cube and a ball.
#[test]
fn errors_shrink_with_the_cells() {
    for solid in [stretched_and_turned(&cube(), [1.0; 3]), icosphere(2)] {
        let exact = ClosedMesh::new(&solid).unwrap().mass_properties().unwrap();
        let error = |cells| (count(CellCounting { cells, ..POINTS }, &solid).volume / exact.volume - 1.0).abs();
        let [coarse, fine] = [[7, 8, 9], [30, 32, 34]].map(|cells| cells.map(error).into_iter().fold(0.0, f64::max));
        assert!(fine < 0.25 * coarse && fine > 1e-5 && coarse < 0.1, "{coarse:e} {fine:e}");
    }
}

#[test]
fn what_cannot_be_counted_says_why() {
    let solid = cube();
    let closed = ClosedMesh::new(&solid).unwrap();
    for cells in [0, MOST_CELLS + 1, u32::MAX] {
        assert_eq!(CellCounting { cells, ..POINTS }.mass_properties(closed), Err(CellError::Cells(cells)));
    }
    let sliver = stretched_and_turned(&cube(), [1.0, 1.0, 1e-6]);
    let slips = POINTS.mass_properties(ClosedMesh::new(&sliver).unwrap());
    assert_eq!(slips, Err(CellError::NothingInside(8)));
    for size in [1e-90, 1e90] {
        let extreme = cuboid([0.0; 3], [size; 3]);
        assert_eq!(POINTS.mass_properties(ClosedMesh::new(&extreme).unwrap()), Err(CellError::NoBox));
    }
}
