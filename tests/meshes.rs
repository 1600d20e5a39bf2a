//! Mesh checks on good meshes and on ones broken here on purpose: each finding, its place and its severity.
#![allow(clippy::unwrap_used, reason = "a test that cannot be set up should stop there")]

#[path = "support/shapes.rs"]
mod shapes;

use ga_physics::geometry::mass_properties::{MassError, mass_properties};
use ga_physics::geometry::mesh::{Mesh, MeshError};
use ga_physics::geometry::mesh_checks::{MeshReport, Severity, check};
use shapes::*;

fn has(report: &MeshReport, severity: Severity, words: &str) -> bool {
    report.messages.iter().any(|m| m.severity == severity && m.text.contains(words))
}

/// The report has exactly one error, with these words.
fn assert_only_error(report: &MeshReport, words: &str) {
    let errors: Vec<_> = report.messages.iter().filter(|m| m.severity == Severity::Error).collect();
    assert!(errors.len() == 1 && errors[0].text.contains(words), "expected `{words}`, found {:?}", report.messages);
    assert!(!report.usable_as_body && !report.convex);
}

#[test]
fn sound_solids_are_usable_and_convex_where_they_are() {
    let far = [1e4, -2e4, 3e4];
    for (name, solid, convex) in [
        ("cube", cube(), true),
        ("regular tetrahedron", regular_tetrahedron(), true),
        ("corner tetrahedron", corner_tetrahedron(), true),
        ("icosphere", icosphere(2), true),
        ("box far away", moved(&cuboid([0.0; 3], [1.0, 0.5, 0.25]), far), true),
        ("sliver", cuboid([0.0, 0.0, 1.0], [1.0, 1.0, 1.0 + f64::EPSILON]), true),
        ("torus", torus(24, 12), false),
        ("L prism", l_prism(), false),
        ("L prism far away", moved(&l_prism(), far), false),
    ] {
        let report = check(&solid);
        assert!(
            report.closed && report.oriented && report.manifold && report.usable_as_body,
            "{name}: {:?}",
            report.messages
        );
        assert_eq!(report.convex, convex, "{name}: {:?}", report.messages);
        assert!(report.messages.iter().all(|m| m.severity == Severity::Note), "{name}: {:?}", report.messages);
        let mass = mass_properties(&solid).unwrap();
        assert_eq!((report.volume, report.mass_properties), (Some(mass.volume), Some(mass)), "{name}");
    }
}

/// Euler: V - E + F is 2 on a sphere and 0 on a torus.
#[test]
fn counts_satisfy_euler() {
    for (solid, characteristic) in [(cube(), 2), (icosphere(2), 2), (torus(24, 12), 0)] {
        let n = check(&solid).counts;
        assert_eq!(i64::try_from(n.vertices + n.triangles).unwrap() - i64::try_from(n.edges).unwrap(), characteristic);
    }
}

#[test]
fn a_hole_is_found_and_located() {
    let mut open = icosphere(1);
    let [a, b, _] = open.triangles.pop().unwrap();
    let report = check(&open);
    assert_only_error(&report, "not closed: 3 edges with an odd number of triangles, in 1 boundary");
    let text = &report.messages[0].text;
    let p = open.vertices[a.min(b) as usize];
    assert!(text.contains(&format!("({:?}, {:?}, {:?})", p.x, p.y, p.z)) && text.contains("close the holes"), "{text}");
    assert!(!report.closed && report.oriented && report.manifold && report.volume.is_none());
}

#[test]
fn a_crack_is_told_from_a_hole() {
    // One triangle gets a corner of its own, one rounding away.
    let mut cracked = moved(&icosphere(1), [3.0, 0.0, 0.0]);
    let [a, ..] = cracked.triangles[0];
    let p = cracked.vertices[a as usize];
    cracked.vertices.push(point(p.x.next_up(), p.y, p.z));
    cracked.triangles[0][0] = u32::try_from(cracked.vertices.len() - 1).unwrap();
    let report = check(&cracked.welded());
    let gap = format!("{:.1e} m apart", p.x.next_up() - p.x);
    assert_only_error(&report, "this is a crack");
    assert!(report.messages[0].text.contains(&gap), "{}", report.messages[0].text);
}

/// Two boundary vertices at the ends of one short edge are where they should be.
#[test]
fn a_short_edge_is_no_crack() {
    let report = check(&mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1e-9, 0.0]], &[[0, 1, 2]]));
    assert_only_error(&report, "close the holes");
}

#[test]
fn flipped_facets_are_counted_and_named() {
    let mut flipped = icosphere(1);
    for i in [7, 20] {
        flipped.triangles[i].swap(0, 1);
    }
    let report = check(&flipped);
    assert!(report.closed && !report.oriented && report.volume.is_none());
    assert_only_error(&report, "2 triangles wound against the rest, the first is triangle 7");
}

#[test]
fn a_moebius_strip_has_one_side() {
    let vertices: Vec<[f64; 3]> = (0..10u32)
        .map(|i| {
            let (s, c) = (f64::from(i / 2) * 0.4 * std::f64::consts::PI).sin_cos();
            [c, s, if i % 2 == 0 { 0.2 } else { -0.2 }]
        })
        .collect();
    // Five quads; the last joins the ends with a half turn.
    let mut triangles: Vec<[u32; 3]> =
        (0..4).flat_map(|i| [[2 * i, 2 * i + 1, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 2]]).collect();
    triangles.extend([[8, 9, 0], [8, 0, 1]]);
    let report = check(&mesh(&vertices, &triangles));
    assert!(has(&report, Severity::Error, "one side only"), "{:?}", report.messages);
}

#[test]
fn inside_out_has_a_negative_volume() {
    let report = check(&reversed(&cube()));
    assert!(report.closed && report.oriented && report.manifold);
    assert_eq!(report.volume, Some(-1.0));
    assert_only_error(&report, "inside out");
}

#[test]
fn sheets_have_no_volume() {
    let turned = stretched_and_turned(&cuboid([0.1; 3], [1.1, 1.3, 0.1]), [1.0; 3]);
    assert!(check(&turned).closed);
    // Turned, the sheet is no longer flat to the last bit; its volume, whatever the sign, is far below its area times an ulp.
    assert!(check(&turned).volume.unwrap().abs() < 1e-15);
    let flat = cuboid([0.1; 3], [1.1, 1.3, 0.1]);
    let report = check(&flat.welded());
    assert_eq!(report.volume, Some(0.0));
    assert!(has(&report, Severity::Error, "encloses no volume"), "{:?}", report.messages);
}

#[test]
fn a_pinched_vertex_is_a_warning() {
    // Two tetrahedra that share the origin.
    let both = joined(&corner_tetrahedron(), &reversed(&mirrored(&corner_tetrahedron()))).welded();
    let report = check(&both);
    assert!(report.closed && report.oriented && report.usable_as_body && !report.manifold && !report.convex);
    assert_eq!((report.counts.pinched_vertices, report.counts.patches), (1, 2));
    assert!(has(&report, Severity::Warning, "(0.0, 0.0, 0.0), with 2 fans"), "{:?}", report.messages);
    assert!((report.volume.unwrap() - 1.0 / 3.0).abs() < 1e-15);
}

/// The mesh through the origin, inside out.
fn mirrored(mesh: &Mesh) -> Mesh {
    Mesh::new(mesh.vertices.iter().map(|p| point(-p.x, -p.y, -p.z)).collect(), mesh.triangles.clone()).unwrap()
}

#[test]
fn boxes_touching_along_an_edge_bound_a_solid() {
    let both = joined(&cuboid([0.0; 3], [1.0; 3]), &cuboid([1.0, 1.0, 0.0], [2.0, 2.0, 1.0])).welded();
    let report = check(&both);
    assert!(report.closed && report.oriented && report.usable_as_body && !report.manifold && !report.convex);
    assert_eq!((report.counts.crowded_edges, report.volume), (1, Some(2.0)));
    assert!(has(&report, Severity::Warning, "with 4 triangles; their directions cancel"), "{:?}", report.messages);
    assert_eq!(mass_properties(&both).unwrap().centre, point(1.0, 1.0, 0.5));
}

#[test]
fn a_surface_there_twice_is_refused() {
    let mut twice = joined(&cube(), &cube());
    // As two shells of their own vertices it is two bodies in one place, which indices cannot tell; welded it is found.
    assert!(!check(&twice).convex);
    twice = twice.welded();
    let report = check(&twice);
    assert_only_error(&report, "12 sets of triangles on the same three vertices with the same sense, 2 in the first");
    assert_eq!(report.counts.duplicate_triangles, 12);
}

#[test]
fn degenerate_triangles_are_named_and_harmless() {
    let mut odd = cube();
    odd.triangles.push([3, 3, 5]);
    let report = check(&odd);
    assert!(report.usable_as_body && report.manifold && report.convex, "{:?}", report.messages);
    assert!(has(&report, Severity::Warning, "1 triangle with the same vertex twice"), "{:?}", report.messages);
    assert_eq!(report.volume, Some(1.0));

    // A facet's diagonal is given a middle vertex on one side only; a triangle of zero area closes the gap.
    let mut split = cube();
    let [a, b, c] = split.triangles[0];
    let [p, q] = [a, c].map(|i| split.vertices[i as usize]);
    let m = u32::try_from(split.vertices.len()).unwrap();
    split.vertices.push(point(0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z)));
    split.triangles[0] = [a, b, m];
    split.triangles.extend([[b, c, m], [a, m, c]]);
    let report = check(&split);
    assert!(report.usable_as_body && report.manifold && report.convex, "{:?}", report.messages);
    assert!(has(&report, Severity::Warning, "1 triangle of zero area"), "{:?}", report.messages);
    // Pushed in, the same vertex makes a dent, and the solid is not convex.
    split.vertices[m as usize].z += 1e-3;
    assert!(!check(&split).convex);
}

#[test]
fn unused_vertices_are_a_note() {
    let mut extra = cube();
    extra.vertices.push(point(9.0, 9.0, 9.0));
    let report = check(&extra);
    assert!(
        report.usable_as_body && report.convex && has(&report, Severity::Note, "1 vertex not used"),
        "{:?}",
        report.messages
    );
}

#[test]
fn a_cavity_is_usable_and_not_convex() {
    let hollow = joined(&cuboid([-1.0; 3], [1.0; 3]), &reversed(&cube()));
    let report = check(&hollow);
    assert!(report.usable_as_body && report.manifold && !report.convex);
    assert_eq!(report.volume, Some(7.0));
    assert!(has(&report, Severity::Warning, "right for a cavity"), "{:?}", report.messages);
}

#[test]
fn what_is_convex_at_every_edge_need_not_be_convex() {
    let great = great_icosahedron();
    let report = check(&great);
    assert_eq!((report.counts.triangles, report.counts.edges, report.counts.vertices), (20, 30, 12));
    assert!(report.usable_as_body && report.manifold && !report.convex);
    assert!(has(&report, Severity::Note, "within or over one another"), "{:?}", report.messages);
    // Two solids, each convex: apart, and one within the other.
    for other in [moved(&cube(), [3.0, 0.0, 0.0]), cuboid([-0.1; 3], [0.1; 3])] {
        let report = check(&joined(&cube(), &other));
        assert!(report.usable_as_body && !report.convex, "{:?}", report.messages);
    }
}

#[test]
fn convexity_is_exact_to_the_last_bit() {
    // A square roof on a box: its top vertex level with the roof, one rounding above, one below.
    let mut tent = cuboid([0.0; 3], [1.0; 3]);
    let top = u32::try_from(tent.vertices.len()).unwrap();
    tent.vertices.push(point(0.5, 0.5, 1.0));
    tent.triangles.retain(|t| !t.iter().all(|&i| i >= 4));
    tent.triangles.extend([[4, 5, 8], [5, 7, 8], [7, 6, 8], [6, 4, 8]]);
    for (height, convex) in [(1.0, true), (1f64.next_up(), true), (1f64.next_down(), false)] {
        tent.vertices[top as usize].z = height;
        let report = check(&tent);
        assert!(report.usable_as_body && report.convex == convex, "{height:e}: {:?}", report.messages);
    }
}

#[test]
fn welding_joins_equal_numbers_only() {
    let vertices = [
        [0.0, 0.0, 0.0],
        [-0.0, 0.0, -0.0],
        [1.0, 0.0, 0.0],
        [1.0f64.next_up(), 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, -0.0],
    ];
    let welded = mesh(&vertices, &[[0, 2, 4], [1, 3, 4], [5, 4, 1]]).welded();
    assert_eq!(welded.vertices.len(), 4);
    assert_eq!(welded.triangles, [[0, 1, 3], [0, 2, 3], [1, 3, 0]]);
    assert!(
        Mesh::new(vec![point(0.0, 0.0, 0.0)], vec![[0, 1, 0]])
            .is_err_and(|e| matches!(e, MeshError::IndexOutOfRange { index: 1, .. }))
    );
    assert!(Mesh::new(vec![], vec![]).is_err_and(|e| e == MeshError::NoTriangles));
    assert!(
        Mesh::new(vec![point(0.0, f64::NAN, 0.0)], vec![[0, 0, 0]])
            .is_err_and(|e| matches!(e, MeshError::NotFinite { vertex: 0, .. }))
    );
}

/// The quick check of mass properties and the thorough one of the report agree on every mesh with one triangle missing,
/// turned over or there twice.
#[test]
fn quick_and_thorough_checks_agree() {
    let whole = icosphere(1);
    for i in 0..whole.triangles.len() {
        let (mut open, mut flipped, mut doubled, mut split) =
            (whole.clone(), whole.clone(), whole.clone(), whole.clone());
        open.triangles.remove(i);
        flipped.triangles[i].swap(1, 2);
        doubled.triangles.push(whole.triangles[i]);
        // A corner named twice: the facet is left out, and leaves a hole.
        split.triangles[i][1] = split.triangles[i][0];
        for damaged in [open, flipped, doubled, split] {
            let report = check(&damaged);
            assert!(!(report.closed && report.oriented));
            match mass_properties(&damaged) {
                Err(MassError::NotClosed { .. }) => assert!(!report.closed),
                Err(MassError::NotOriented { .. }) => assert!(report.closed && !report.oriented),
                other => panic!("{other:?}"),
            }
        }
    }
    let touching = joined(&cuboid([0.0; 3], [1.0; 3]), &cuboid([1.0, 1.0, 0.0], [2.0, 2.0, 1.0])).welded();
    assert_eq!(mass_properties(&touching).unwrap().volume, 2.0);
}
