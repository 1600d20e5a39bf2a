//! `run.html`: one file that plays a recorded run, offline.
//!
//! The page holds its own viewer (`viewer/`, inlined at compile time) and the recording as base64: nothing is
//! fetched, and the content security policy in the page forbids it. Positions are stored as `f32` relative to the
//! centre of the motion, so that a scene 1e6 m from the origin is drawn as sharply as one at the origin; times, marks
//! and energies stay `f64`.
//!
//! Conventions: SI units, z is up; the rotor `R = s + e23 + e31 + e12` acts as `x' = R x ~R`, `R = exp(-B phi/2)`.
//!
//! It does not simulate, resample or judge: a pose that is missing or not finite is stored as NaN, and the viewer
//! then shows the nearest finite pose, or hides the body where there is none. So with particles.

mod links;
mod particles;

pub use links::{Link, LinkEnd, LinkKind, Stretched};
pub use particles::{Guide, ParticlesView};

use std::collections::BTreeMap;

use base64::{Engine as _, engine::general_purpose::STANDARD as BASE64};
use serde_json::{Value, json};

/// Components of a pose: the centre of mass and the rotor.
pub const POSE_COMPONENTS: usize = 7;

/// A recorded run, ready to be drawn.
#[derive(Debug, Clone)]
pub struct Playback<'a> {
    /// The scene's name, shown as the page's heading.
    pub scene: &'a str,
    /// What is drawn, in the order of the poses.
    pub bodies: Vec<BodyView>,
    /// The time of each frame, s.
    pub times_s: Vec<f64>,
    /// Per frame and body: `x, y, z` of the centre of mass (world, m), then the rotor `s, e23, e31, e12`.
    pub poses: Vec<Vec<[f64; POSE_COMPONENTS]>>,
    /// Bodies that are drawn stretched.
    pub stretched: Vec<Stretched>,
    /// Joints and springs between bodies.
    pub links: Vec<Link>,
    /// The particles.
    pub particles: ParticlesView,
    /// Contacts to be marked.
    pub marks: Vec<Mark>,
    /// The energy curve; may be empty, and need not share the frames' times.
    pub energy: Vec<EnergySample>,
}

/// The surface of a body, in the body's frame, origin at the centre of mass, m.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A triangle mesh; triangles index `vertices`, anticlockwise seen from outside.
    Mesh {
        /// Corners, m.
        vertices: Vec<[f64; 3]>,
        /// Three indices each; a triangle with an index out of range is not drawn.
        triangles: Vec<[u32; 3]>,
    },
    /// An infinite plane through the body's position, drawn as a grid patch.
    Plane {
        /// The outward side; need not be of unit length.
        normal: [f64; 3],
    },
    /// A surface of revolution about the z axis.
    Revolution {
        /// Distances from the axis and heights, m, from below to above.
        profile: Vec<[f64; 2]>,
    },
    /// An ellipsoid along the body's axes; a body without a shape is drawn as its inertia ellipsoid.
    Ellipsoid {
        /// Semi-axes, m.
        semi_axes: [f64; 3],
    },
}

/// How one body is shown.
#[derive(Debug, Clone)]
pub struct BodyView {
    /// The body's name, shown as text whatever it holds.
    pub name: String,
    /// A body that never moves is drawn in grey.
    pub fixed: bool,
    /// Its surface.
    pub shape: Shape,
}

/// A contact between two bodies.
#[derive(Debug, Clone)]
pub struct Mark {
    /// When, s.
    pub time_s: f64,
    /// The first body's name.
    pub a: String,
    /// The second body's name.
    pub b: String,
    /// Where, world, m.
    pub point: [f64; 3],
    /// From `a` to `b`, unit, world.
    pub normal: [f64; 3],
    /// Along the normal, N s.
    pub impulse_n_s: f64,
    /// What happened: `impact`, `contact_persists`, ...
    pub kind: String,
}

/// The energy of the whole scene at one time.
#[derive(Debug, Clone, Copy)]
pub struct EnergySample {
    /// When, s.
    pub time_s: f64,
    /// Kinetic energy, J.
    pub kinetic_j: f64,
    /// Potential energy, J.
    pub potential_j: f64,
    /// Their sum, J.
    pub total_j: f64,
}

const TEMPLATE: &str = include_str!("viewer/viewer.html");
const STYLE: &str = include_str!("viewer/viewer.css");

/// The viewer's parts in the order in which they use each other; together they are one function.
const SCRIPTS: [&str; 14] = [
    include_str!("viewer/math.js"),
    include_str!("viewer/recording.js"),
    include_str!("viewer/geometry.js"),
    include_str!("viewer/camera.js"),
    include_str!("viewer/particles.js"),
    include_str!("viewer/stage.js"),
    include_str!("viewer/webgl.js"),
    include_str!("viewer/webgl_particles.js"),
    include_str!("viewer/canvas2d.js"),
    include_str!("viewer/links.js"),
    include_str!("viewer/overlay.js"),
    include_str!("viewer/plot.js"),
    include_str!("viewer/panel.js"),
    include_str!("viewer/viewer.js"),
];

/// The whole page as text; the same playback gives the same bytes.
///
/// Cost: one pass over the poses; the page takes about 37 bytes a pose, 16 bytes a position of a particle, and 110 KB for
/// the viewer.
#[must_use]
pub fn render(playback: &Playback<'_>) -> String {
    let centre = centre(playback);
    let mut names = Names::default();
    let (mark_numbers, mark_names) = marks(&playback.marks, &mut names);
    let index = index(playback, centre, names).to_string();
    let points = particles::positions(&playback.particles, playback.times_s.len(), centre);
    fill(
        TEMPLATE,
        &[
            ("title", &escape_html(playback.scene)),
            ("style", STYLE),
            ("script", &SCRIPTS.concat()),
            ("index", &escape_json(&index)),
            ("times", &BASE64.encode(f64_bytes(playback.times_s.iter().copied()))),
            ("poses", &BASE64.encode(f32_bytes(poses(playback, centre)))),
            ("points", &BASE64.encode(f32_bytes(points))),
            ("energy", &BASE64.encode(f64_bytes(energy(&playback.energy)))),
            ("marks", &BASE64.encode(f64_bytes(mark_numbers.into_iter()))),
            ("mark_names", &BASE64.encode(u32_bytes(mark_names.into_iter()))),
        ],
    )
}

/// The middle of the box round all finite positions of what moves; of everything where nothing moves.
fn centre(playback: &Playback<'_>) -> [f64; 3] {
    middle(playback, |fixed| !fixed).or_else(|| middle(playback, |_| true)).unwrap_or([0.0; 3])
}

/// The middle of the box round what is wanted, by whether it is fixed.
fn middle(playback: &Playback<'_>, wanted: impl Fn(bool) -> bool) -> Option<[f64; 3]> {
    let wanted = &wanted;
    let bodies = playback.poses.iter().flat_map(|frame| playback.bodies.iter().zip(frame));
    let bodies = bodies.filter(|(body, _)| wanted(body.fixed)).map(|(_, [x, y, z, ..])| [*x, *y, *z]);
    let view = &playback.particles;
    let particles = view.positions.iter().flat_map(|frame| view.fixed.iter().zip(frame));
    let particles = particles.filter(|(fixed, _)| wanted(**fixed)).map(|(_, position)| *position);
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for position in bodies.chain(particles).filter(|position| position.iter().all(|c| c.is_finite())) {
        for ((l, h), c) in low.iter_mut().zip(&mut high).zip(position) {
            *l = l.min(c);
            *h = h.max(c);
        }
    }
    // Halved before the sum: two finite ends must not overflow.
    let [cx, cy, cz] = core::array::from_fn(|i| low[i] / 2.0 + high[i] / 2.0);
    (cx.is_finite() && cy.is_finite() && cz.is_finite()).then_some([cx, cy, cz])
}

/// Everything but the long arrays: names, shapes, and which body has which.
fn index(playback: &Playback<'_>, centre: [f64; 3], names: Names) -> Value {
    let mut numbers = BTreeMap::new();
    let mut shapes = Vec::new();
    let bodies: Vec<Value> = playback
        .bodies
        .iter()
        .map(|body| {
            // A hundred equal cubes are one shape: the file stays small and the viewer draws them in one call.
            let shape = shape(&body.shape);
            let number = *numbers.entry(shape.to_string()).or_insert_with(|| {
                shapes.push(shape);
                shapes.len() - 1
            });
            json!({ "name": body.name, "fixed": body.fixed, "shape": number })
        })
        .collect();
    json!({
        "scene": playback.scene,
        "centre": centre,
        "bodies": bodies,
        "shapes": shapes,
        "stretches": links::stretches(playback),
        "links": links::index(&playback.links, centre),
        "particles": particles::index(&playback.particles, centre),
        "names": names.list,
    })
}

fn shape(shape: &Shape) -> Value {
    match shape {
        Shape::Mesh { vertices, triangles } => {
            let vertices = f32_bytes(vertices.iter().flatten().copied());
            let triangles = u32_bytes(triangles.iter().flatten().copied());
            json!({ "mesh": { "vertices": BASE64.encode(vertices), "triangles": BASE64.encode(triangles) } })
        }
        Shape::Plane { normal } => json!({ "plane": normal }),
        Shape::Revolution { profile } => json!({ "revolution": profile }),
        Shape::Ellipsoid { semi_axes } => json!({ "ellipsoid": semi_axes }),
    }
}

/// Frame by frame, body by body; exactly one pose for each, NaN where the recording has none.
fn poses<'a>(playback: &'a Playback<'_>, [cx, cy, cz]: [f64; 3]) -> impl Iterator<Item = f64> + 'a {
    const MISSING: [f64; POSE_COMPONENTS] = [f64::NAN; POSE_COMPONENTS];
    let n_bodies = playback.bodies.len();
    (0..playback.times_s.len()).flat_map(move |frame| {
        (0..n_bodies).flat_map(move |body| {
            let pose = playback.poses.get(frame).and_then(|poses| poses.get(body));
            let [x, y, z, s, e23, e31, e12] = *pose.unwrap_or(&MISSING);
            [x - cx, y - cy, z - cz, s, e23, e31, e12]
        })
    })
}

/// Distinct texts in order of first use, so that a long list of contacts repeats no name.
#[derive(Default)]
struct Names {
    list: Vec<String>,
    numbers: BTreeMap<String, u32>,
}

impl Names {
    fn number(&mut self, name: &str) -> u32 {
        if let Some(number) = self.numbers.get(name) {
            return *number;
        }
        // The viewer shows a number without a name as "?"; 2^32 distinct names do not fit in a page anyway.
        let number = u32::try_from(self.list.len()).unwrap_or(u32::MAX);
        self.list.push(name.to_owned());
        self.numbers.insert(name.to_owned(), number);
        number
    }
}

/// Eight numbers (time, point, normal, impulse) and three names (a, b, kind) a mark.
fn marks(marks: &[Mark], names: &mut Names) -> (Vec<f64>, Vec<u32>) {
    let mut numbers = Vec::with_capacity(8 * marks.len());
    let mut named = Vec::with_capacity(3 * marks.len());
    for mark in marks {
        numbers.push(mark.time_s);
        numbers.extend(mark.point);
        numbers.extend(mark.normal);
        numbers.push(mark.impulse_n_s);
        named.extend([&mark.a, &mark.b, &mark.kind].map(|name| names.number(name)));
    }
    (numbers, named)
}

fn energy(samples: &[EnergySample]) -> impl Iterator<Item = f64> + '_ {
    samples.iter().flat_map(|e| [e.time_s, e.kinetic_j, e.potential_j, e.total_j])
}

fn f64_bytes(values: impl Iterator<Item = f64>) -> Vec<u8> {
    values.flat_map(f64::to_le_bytes).collect()
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "a picture needs no more than f32, and its values are small: the scene's centre is taken off in f64"
)]
fn f32_bytes(values: impl Iterator<Item = f64>) -> Vec<u8> {
    values.flat_map(|value| (value as f32).to_le_bytes()).collect()
}

fn u32_bytes(values: impl Iterator<Item = u32>) -> Vec<u8> {
    values.flat_map(u32::to_le_bytes).collect()
}

/// JSON that can stand in a script element: without `<` no `</script` or `<!--` can arise, whatever a name holds.
fn escape_json(json: &str) -> String {
    // In JSON these characters occur in strings only, where \u.... means the same character.
    json.replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

fn escape_html(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\'', "&#39;")
        .replace('\u{2028}', "&#x2028;")
        .replace('\u{2029}', "&#x2029;")
}

/// Puts `parts` into the template's `{{name}}` places in one pass: what is put in is not looked at again, so a scene
/// called `{{script}}` stays a name.
fn fill(template: &str, parts: &[(&str, &str)]) -> String {
    let mut page = String::with_capacity(template.len() + parts.iter().map(|(_, part)| part.len()).sum::<usize>());
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        page.push_str(before);
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        for (_, part) in parts.iter().filter(|(key, _)| *key == name) {
            page.push_str(part);
        }
        rest = after;
    }
    page.push_str(rest);
    page
}
