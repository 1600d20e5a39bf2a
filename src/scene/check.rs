//! Mistakes in a scene that show without geometry: signs, missing values, contradictions, names.
//!
//! Every mistake is reported, none stops the search. Volumes, convexity and overlap at the start
//! are the builder's to judge.

use std::collections::HashMap;

use toml::Spanned;

use crate::scene::SceneSource;
use crate::scene::description::{Body, Orientation, Scene, Shape};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::read::Damage;
use crate::scene::values::Numbers;

mod forces;
mod held;
mod inertia;
mod joints;
mod methods;
mod particles;
mod relations;
mod solver;
mod springs;

/// The largest number of steps of a run. One body takes about a microsecond a step, so that a run
/// of this many lasts at least a quarter of an hour; more is nearly always a slip in `dt_s`.
pub const MAX_STEPS: f64 = 1e9;

/// All mistakes in `scene`, in no particular order.
pub(crate) fn check(scene: &Scene, source: &SceneSource, damage: &Damage) -> Vec<Diagnostic> {
    let mut checker = Checker { found: Vec::new() };
    checker.times(scene, damage);
    checker.solver(scene);
    checker.method(scene);
    checker.finite("gravity_m_s2", &scene.gravity_m_s2);
    checker.restitution(&scene.contact.restitution);
    checker.names(&scene.body);
    for (idx, body) in scene.body.iter().enumerate() {
        checker.body(body);
        if !damage.of("body", idx) {
            checker.completeness(body);
        }
        if let Some(Shape::Mesh(mesh)) = &body.shape {
            checker.mesh_file(&mesh.file, source);
        }
    }
    let roster = checker.particles(scene, damage);
    for force in &scene.force {
        checker.force(force, scene);
    }
    checker.force_targets(scene, roster.as_ref(), damage);
    checker.joints(scene, damage);
    if let Some(roster) = &roster {
        checker.constraints(scene, roster, damage);
    }
    checker.found
}

/// The diagnostics of one scene as they accumulate.
struct Checker {
    found: Vec<Diagnostic>,
}

impl Checker {
    fn report(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    /// Whether all numbers are finite; if not, says so.
    fn finite<const N: usize>(&mut self, key: &str, value: &Spanned<Numbers<N>>) -> bool {
        let bad = value.get_ref().0.into_iter().find(|x| !x.is_finite());
        if let Some(bad) = bad {
            self.report(not_finite(key, bad).at(value.span()));
        }
        bad.is_none()
    }

    /// The number if it is finite; if not, says so.
    fn number(&mut self, key: &str, value: &Spanned<f64>) -> Option<f64> {
        let x = *value.get_ref();
        if x.is_finite() {
            return Some(x);
        }
        self.report(not_finite(key, x).at(value.span()));
        None
    }

    /// The number if it is finite and positive; if not, says so with the remedy.
    fn positive(&mut self, key: &str, value: &Spanned<f64>, help: &str) -> Option<f64> {
        let x = self.number(key, value)?;
        if x > 0.0 {
            return Some(x);
        }
        let diagnostic = Diagnostic::new(format!("`{key}` must be positive, not {x:?}"));
        self.report(diagnostic.at(value.span()).label("must be greater than 0").help(help));
        None
    }

    fn restitution(&mut self, value: &Spanned<f64>) {
        let Some(e) = self.number("restitution", value) else {
            return;
        };
        if !(0.0..=1.0).contains(&e) {
            let message = format!("`restitution` must lie in 0 to 1, not {e:?}");
            let diagnostic = Diagnostic::new(message).at(value.span()).label("not in 0 to 1");
            self.report(diagnostic.help("1 is elastic, 0 lets bodies not rebound"));
        }
    }

    fn names(&mut self, bodies: &[Body]) {
        let mut seen = HashMap::new();
        for (idx, body) in bodies.iter().enumerate() {
            let name = body.name.get_ref();
            if name.trim().is_empty() {
                let diagnostic = Diagnostic::new("the name of a body is empty");
                self.report(diagnostic.at(body.name.span()).help("give it a name of its own"));
            } else if let Some(first) = seen.insert(name, idx) {
                let (first, second) = (first + 1, idx + 1);
                let message = format!("two bodies are named `{name}`: number {first} and {second}");
                let diagnostic = Diagnostic::new(message).at(body.name.span());
                let diagnostic = diagnostic.label("taken by an earlier body");
                self.report(diagnostic.help("forces and outputs refer to bodies by name"));
            }
        }
    }

    /// The values of a body, one by one.
    fn body(&mut self, body: &Body) {
        if let Some(mass) = &body.mass_kg {
            let help = "for a body that never moves write `fixed = true` and no mass";
            self.positive("mass_kg", mass, help);
        }
        if let Some(given) = &body.inertia_kg_m2 {
            self.found.extend(inertia::mistake(given));
        }
        self.finite("position_m", &body.position_m);
        self.finite("velocity_m_s", &body.velocity_m_s);
        self.positive("scale", &body.scale, "1 leaves the shape as it is, 2 doubles its lengths");
        self.angular_velocity(body);
        match &body.orientation {
            Some(Orientation::AxisAngle(rotation)) => {
                let help = "name the axis of the rotation, for example [0, 0, 1]";
                self.direction("axis", &rotation.axis, help);
                self.number("angle_rad", &rotation.angle_rad);
            }
            Some(Orientation::Rotor(rotor)) => {
                self.direction("rotor", rotor, "[1, 0, 0, 0] is the aligned orientation");
            }
            None => {}
        }
        if let Some(shape) = &body.shape {
            self.shape(shape);
        }
    }

    fn angular_velocity(&mut self, body: &Body) {
        let given = [("omega_world_rad_s", &body.omega_world_rad_s), ("omega_body_rad_s", &body.omega_body_rad_s)];
        for (key, omega) in given {
            if let Some(omega) = omega {
                self.finite(key, omega);
            }
        }
        if let (Some(world), Some(in_body)) = (&body.omega_world_rad_s, &body.omega_body_rad_s) {
            let name = body.name.get_ref();
            let message = format!("the angular velocity of `{name}` is given twice");
            // The later of the two, so that the message stands where the second was written.
            let (span, other) = if world.span().start > in_body.span().start {
                (world.span(), "omega_body_rad_s")
            } else {
                (in_body.span(), "omega_world_rad_s")
            };
            let diagnostic = Diagnostic::new(message).at(span);
            let diagnostic = diagnostic.label(format!("already given by `{other}`"));
            self.report(diagnostic.help("keep one of `omega_world_rad_s` and `omega_body_rad_s`"));
        }
    }

    /// Says if a list has no direction, or one that is lost when its length is computed.
    fn direction<const N: usize>(&mut self, key: &str, value: &Spanned<Numbers<N>>, help: &str) {
        if !self.finite(key, value) {
            return;
        }
        let numbers = value.get_ref().0;
        let length_sq: f64 = numbers.iter().map(|x| x * x).sum();
        let diagnostic = if numbers == [0.0; N] {
            Diagnostic::new(format!("`{key}` is zero and has no direction")).help(help)
        } else if !length_sq.is_normal() {
            // The square under- or overflows: a unit vector made with it would be wrong or NaN.
            Diagnostic::new(format!("the length of `{key}` cannot be computed"))
                .help("its length does not matter: write numbers of about 1")
        } else {
            return;
        };
        self.report(diagnostic.at(value.span()));
    }

    fn shape(&mut self, shape: &Shape) {
        let help = "lengths are in m; use `fixed` and `plane` for a flat obstacle";
        match shape {
            Shape::Box(shape) => {
                let size = &shape.size_m;
                let bad = size.get_ref().0.into_iter().find(|edge| *edge <= 0.0);
                if let (true, Some(edge)) = (self.finite("size_m", size), bad) {
                    let message = format!("the edges of a box must be positive, not {edge:?}");
                    self.report(Diagnostic::new(message).at(size.span()).help(help));
                }
            }
            Shape::Pyramid(pyramid) => {
                self.positive("base_m", &pyramid.base_m, help);
                self.positive("height_m", &pyramid.height_m, help);
            }
            Shape::Tetrahedron(tetrahedron) => {
                let vertices = &tetrahedron.vertices_m;
                let bad = vertices.get_ref().0.into_iter().flatten().find(|x| !x.is_finite());
                if let Some(bad) = bad {
                    self.report(not_finite("vertices_m", bad).at(vertices.span()));
                }
            }
            Shape::Ball(ball) => {
                self.positive("radius_m", &ball.radius_m, help);
            }
            Shape::Capsule(capsule) => {
                self.positive("radius_m", &capsule.radius_m, help);
                self.positive("length_m", &capsule.length_m, "a capsule without a cylinder is a `shape.ball`");
            }
            Shape::Cylinder(cylinder) => {
                self.positive("radius_m", &cylinder.radius_m, help);
                self.positive("length_m", &cylinder.length_m, help);
            }
            Shape::Cone(cone) => {
                self.positive("radius_m", &cone.radius_m, help);
                self.positive("height_m", &cone.height_m, help);
            }
            Shape::Mesh(_) => {}
            Shape::Plane(plane) => {
                self.direction("normal", &plane.normal, "[0, 0, 1] is a floor");
            }
        }
    }

    fn mesh_file(&mut self, file: &Spanned<String>, source: &SceneSource) {
        let path = source.resolve(file.get_ref());
        let message = if file.get_ref().is_empty() {
            "the name of the mesh file is empty".to_owned()
        } else if path.is_dir() {
            format!("the mesh file `{}` is a directory", path.display())
        } else if !path.exists() {
            format!("the mesh file `{}` does not exist", path.display())
        } else {
            return;
        };
        let help = "the path is relative to the directory of the scene file";
        self.report(Diagnostic::new(message).at(file.span()).help(help));
    }
}

fn not_finite(key: &str, value: f64) -> Diagnostic {
    Diagnostic::new(format!("`{key}` must be finite, not {value:?}")).label("not a finite number")
}
