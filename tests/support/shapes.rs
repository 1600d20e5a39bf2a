//! Meshes with known properties, made by the tests.
#![allow(dead_code, reason = "each test uses some of the shapes")]
#![allow(clippy::unwrap_used, reason = "a test that cannot be set up should stop there")]

use std::collections::HashMap;

use ga_physics::algebra::cga::Point;
use ga_physics::geometry::mesh::Mesh;

pub(crate) fn point(x: f64, y: f64, z: f64) -> Point<f64> {
    Point { x, y, z }
}

pub(crate) fn mesh(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Mesh {
    let vertices = vertices.iter().map(|&[x, y, z]| point(x, y, z)).collect();
    Mesh::new(vertices, triangles.to_vec()).unwrap()
}

/// The box between two corners.
pub(crate) fn cuboid(low: [f64; 3], high: [f64; 3]) -> Mesh {
    let pick = |bits: usize, axis: usize| {
        if bits >> axis & 1 == 1 { high[axis] } else { low[axis] }
    };
    let vertices: Vec<[f64; 3]> = (0..8).map(|bits| [pick(bits, 0), pick(bits, 1), pick(bits, 2)]).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    mesh(&vertices, &triangles)
}

/// The unit cube about the origin.
pub(crate) fn cube() -> Mesh {
    cuboid([-0.5; 3], [0.5; 3])
}

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

/// The tetrahedron of the origin and the three unit points.
pub(crate) fn corner_tetrahedron() -> Mesh {
    mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], &TETRAHEDRON)
}

/// The regular tetrahedron in the cube of side 2 about the origin.
pub(crate) fn regular_tetrahedron() -> Mesh {
    mesh(
        &[[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]],
        &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
    )
}

/// The twelve vertices of the icosahedron, not normalised.
fn icosahedron_vertices() -> Vec<[f64; 3]> {
    let phi = 0.5 * (1.0 + 5f64.sqrt());
    let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    (0..3)
        .flat_map(|axis| {
            signs.map(|[s, t]| {
                let mut v = [0.0, s, t * phi];
                v.rotate_right(axis);
                v
            })
        })
        .collect()
}

/// All triangles of three vertices at one mutual distance, the plane's normal pointing away from the centre.
fn triangles_of_side(vertices: &[[f64; 3]], side: f64) -> Vec<[u32; 3]> {
    let near = |i: u32, j: u32| {
        let (p, q) = (vertices[i as usize], vertices[j as usize]);
        ((0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt() - side).abs() < 1e-9
    };
    let n = u32::try_from(vertices.len()).unwrap();
    let mut triangles = Vec::new();
    for (i, j, k) in (0..n).flat_map(|i| (0..i).flat_map(move |j| (0..j).map(move |k| (i, j, k)))) {
        if near(i, j) && near(j, k) && near(k, i) {
            let [p, q, r] = [i, j, k].map(|i| vertices[i as usize]);
            let volume = p[0] * (q[1] * r[2] - q[2] * r[1])
                + p[1] * (q[2] * r[0] - q[0] * r[2])
                + p[2] * (q[0] * r[1] - q[1] * r[0]);
            triangles.push(if volume > 0.0 { [i, j, k] } else { [i, k, j] });
        }
    }
    triangles
}

/// The great icosahedron: every edge is convex, one shell, Euler characteristic 2, and it covers its centre seven times.
pub(crate) fn great_icosahedron() -> Mesh {
    let vertices = icosahedron_vertices();
    mesh(&vertices, &triangles_of_side(&vertices, 1.0 + 5f64.sqrt()))
}

/// The icosahedron, each face divided in four `levels` times, on the unit sphere.
pub(crate) fn icosphere(levels: usize) -> Mesh {
    let on_sphere = |v: [f64; 3]| {
        let l = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / l)
    };
    let mut vertices: Vec<[f64; 3]> = icosahedron_vertices();
    let mut triangles = triangles_of_side(&vertices, 2.0);
    vertices.iter_mut().for_each(|v| *v = on_sphere(*v));
    for _ in 0..levels {
        let mut middles = HashMap::new();
        let mut middle = |i: u32, j: u32| {
            *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                let (p, q) = (vertices[i as usize], vertices[j as usize]);
                vertices.push(on_sphere([p[0] + q[0], p[1] + q[1], p[2] + q[2]]));
                u32::try_from(vertices.len() - 1).unwrap()
            })
        };
        let divide = |&[a, b, c]: &[u32; 3]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        };
        triangles = triangles.iter().flat_map(divide).collect();
    }
    mesh(&vertices, &triangles)
}

/// A torus of radii 1 and 0.4 about the z axis, `n` by `m` quads.
pub(crate) fn torus(n: u32, m: u32) -> Mesh {
    let turn = |i: u32, n: u32| (f64::from(i) / f64::from(n) * std::f64::consts::TAU).sin_cos();
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
        let ((su, cu), (sv, cv)) = (turn(i, n), turn(j, m));
        vertices.push([(1.0 + 0.4 * cv) * cu, (1.0 + 0.4 * cv) * su, 0.4 * sv]);
        let at = |i: u32, j: u32| (i % n) * m + j % m;
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    mesh(&vertices, &triangles)
}

/// An L of three unit squares in the xy plane, one high: area 3, corner at the origin.
pub(crate) fn l_prism() -> Mesh {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let vertices: Vec<[f64; 3]> = [0.0, 1.0].iter().flat_map(|&z| outline.map(|[x, y]| [x, y, z])).collect();
    let mut triangles = Vec::new();
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]] {
        triangles.extend([[a, c, b], [a + 6, b + 6, c + 6]]);
    }
    for i in 0..6 {
        let j = (i + 1) % 6;
        triangles.extend([[i, j, j + 6], [i, j + 6, i + 6]]);
    }
    mesh(&vertices, &triangles)
}

/// The mesh turned about the axis (1, 2, 3) by one radian and scaled along the old axes first, so that no facet stays
/// parallel to an axis.
pub(crate) fn stretched_and_turned(mesh: &Mesh, scale: [f64; 3]) -> Mesh {
    let l = 14f64.sqrt();
    let (n, (s, c)) = ([1.0 / l, 2.0 / l, 3.0 / l], 1f64.sin_cos());
    let turn = |p: &Point<f64>| {
        let v = [p.x * scale[0], p.y * scale[1], p.z * scale[2]];
        let along = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
        let across = [n[1] * v[2] - n[2] * v[1], n[2] * v[0] - n[0] * v[2], n[0] * v[1] - n[1] * v[0]];
        let [x, y, z] = [0, 1, 2].map(|i| v[i] * c + across[i] * s + n[i] * along * (1.0 - c));
        point(x, y, z)
    };
    Mesh::new(mesh.vertices.iter().map(turn).collect(), mesh.triangles.clone()).unwrap()
}

/// The mesh moved, its coordinates rounded to f64 there.
pub(crate) fn moved(mesh: &Mesh, by: [f64; 3]) -> Mesh {
    let vertices = mesh.vertices.iter().map(|p| point(p.x + by[0], p.y + by[1], p.z + by[2])).collect();
    Mesh::new(vertices, mesh.triangles.clone()).unwrap()
}

/// All facets turned over.
pub(crate) fn reversed(mesh: &Mesh) -> Mesh {
    Mesh::new(mesh.vertices.clone(), mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect()).unwrap()
}

/// Both meshes as one, without welding.
pub(crate) fn joined(a: &Mesh, b: &Mesh) -> Mesh {
    let base = u32::try_from(a.vertices.len()).unwrap();
    let vertices = a.vertices.iter().chain(&b.vertices).copied().collect();
    let triangles = a.triangles.iter().copied().chain(b.triangles.iter().map(|t| t.map(|i| i + base))).collect();
    Mesh::new(vertices, triangles).unwrap()
}
