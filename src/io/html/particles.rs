//! The particles of a run, in the page: who they are, what ties them together, what they stay on, and where they are.

use super::{BASE64, f32_bytes, u32_bytes};
use base64::Engine as _;
use serde_json::{Value, json};

/// The particles of a run. Lists are by particle unless they say otherwise.
#[derive(Debug, Clone, Default)]
pub struct ParticlesView {
    /// Names.
    pub names: Vec<String>,
    /// Names of what the scene calls by one name: a particle, a chain, a net; and how many particles each has, in order.
    pub groups: Vec<(String, usize)>,
    /// Which never move: drawn as squares.
    pub fixed: Vec<bool>,
    /// Masses, kg: a particle of more mass is drawn larger. What is not positive counts as the least.
    pub masses: Vec<f64>,
    /// Pairs of particles to join by a line.
    pub links: Vec<[usize; 2]>,
    /// Pairs of particles to join by a spring.
    pub springs: Vec<[usize; 2]>,
    /// Particles to join to a point of the world, m.
    pub tethers: Vec<(usize, [f64; 3])>,
    /// Points of the world that are marked, m.
    pub centres: Vec<[f64; 3]>,
    /// What particles stay on, drawn lightly.
    pub guides: Vec<Guide>,
    /// Per frame and particle: x, y, z, world, m.
    pub positions: Vec<Vec<[f64; 3]>>,
}

/// What particles stay on; normals and directions need not be of unit length.
#[derive(Debug, Clone)]
pub enum Guide {
    /// A plane.
    Plane {
        /// A point of it, world, m.
        point: [f64; 3],
        /// Its normal.
        normal: [f64; 3],
    },
    /// A sphere.
    Sphere {
        /// Its centre, world, m.
        centre: [f64; 3],
        /// Its radius, m.
        radius: f64,
    },
    /// A line.
    Line {
        /// A point of it, world, m.
        point: [f64; 3],
        /// Its direction.
        direction: [f64; 3],
    },
    /// A circle.
    Circle {
        /// Its centre, world, m.
        centre: [f64; 3],
        /// Its radius, m.
        radius: f64,
        /// The normal of its plane.
        normal: [f64; 3],
    },
}

/// Everything but the positions; points relative to the scene's centre.
pub(super) fn index(view: &ParticlesView, centre: [f64; 3]) -> Value {
    let relative = |point: [f64; 3]| -> [f64; 3] { core::array::from_fn(|i| point[i] - centre[i]) };
    let pairs = |list: &[[usize; 2]]| BASE64.encode(u32_bytes(list.iter().flatten().map(|i| number(*i))));
    let fixed = view.fixed.iter().enumerate().filter(|(_, fixed)| **fixed).map(|(i, _)| number(i));
    json!({
        "names": view.names,
        "groups": view.groups,
        "fixed": BASE64.encode(u32_bytes(fixed)),
        "sizes": BASE64.encode(f32_bytes(sizes(&view.masses).into_iter())),
        "links": pairs(&view.links),
        "springs": pairs(&view.springs),
        "tethered": BASE64.encode(u32_bytes(view.tethers.iter().map(|(particle, _)| number(*particle)))),
        "anchors": view.tethers.iter().map(|(_, point)| relative(*point)).collect::<Vec<_>>(),
        "centres": view.centres.iter().map(|point| relative(*point)).collect::<Vec<_>>(),
        "guides": view.guides.iter().map(|guide| match guide {
            Guide::Plane { point, normal } => json!({ "plane": { "point": relative(*point), "normal": normal } }),
            Guide::Sphere { centre, radius } => json!({ "sphere": { "centre": relative(*centre), "radius": radius } }),
            Guide::Line { point, direction } => {
                json!({ "line": { "point": relative(*point), "direction": direction } })
            }
            Guide::Circle { centre, radius, normal } => {
                json!({ "circle": { "centre": relative(*centre), "radius": radius, "normal": normal } })
            }
        }).collect::<Vec<_>>(),
    })
}

/// A particle's number; one that is out of range is drawn nowhere, and 2^32 particles do not fit in a page anyway.
fn number(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

/// Relative diameters: by the cube root of the mass, as of balls of one density, 1 for the largest.
fn sizes(masses: &[f64]) -> Vec<f64> {
    let sound = |mass: f64| if mass > 0.0 && mass.is_finite() { mass } else { 0.0 };
    let largest = masses.iter().map(|mass| sound(*mass)).fold(0.0, f64::max);
    let size = |mass: &f64| if largest > 0.0 { (sound(*mass) / largest).cbrt() } else { 1.0 };
    masses.iter().map(size).collect()
}

/// Frame by frame, particle by particle; exactly one position for each, NaN where the recording has none.
pub(super) fn positions(view: &ParticlesView, frames: usize, centre: [f64; 3]) -> impl Iterator<Item = f64> + '_ {
    (0..frames).flat_map(move |frame| {
        (0..view.names.len()).flat_map(move |particle| {
            let position = view.positions.get(frame).and_then(|positions| positions.get(particle));
            let position = position.unwrap_or(&[f64::NAN; 3]);
            core::array::from_fn::<f64, 3, _>(|i| position[i] - centre[i])
        })
    })
}
