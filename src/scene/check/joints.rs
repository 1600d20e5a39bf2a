//! Mistakes in joints: their values, the bodies that they name, and whether the start keeps them.

use std::ops::Range;

use toml::Spanned;

use super::Checker;
use super::held::{OFF_BY, allowed};
use crate::algebra::g3::Vector;
use crate::scene::bodies::{End, Joined, Pose, joined};
use crate::scene::description::{DistanceJoint, Joint, Scene};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::read::Damage;
use crate::scene::values::Numbers;

/// The place of the second end of a joint in the text, or of the only one.
fn place(joint: &Joint) -> Range<usize> {
    let (a, b) = joint.names();
    b.unwrap_or(a).span()
}

impl Checker {
    pub(super) fn joints(&mut self, scene: &Scene, damage: &Damage) {
        for joint in &scene.joint {
            let before = self.found.len();
            self.joint_values(joint);
            let (a, b) = joint.names();
            self.linked(("joint", "a joint holds bodies; a [[constraint]] holds particles"), (a, b), scene, damage);
            if self.found.len() > before {
                continue;
            }
            if let Some(joined) = joined(joint, scene) {
                self.holds_something(joint, &joined);
                if self.found.len() == before {
                    let found = misplaced(joint, &joined).or_else(|| moving_off(joint, &joined, scene));
                    self.found.extend(found);
                }
            }
        }
    }

    fn joint_values(&mut self, joint: &Joint) {
        match joint {
            Joint::Ball(it) => {
                self.finite("point_m", &it.point_m);
            }
            Joint::Hinge(it) => {
                self.finite("point_m", &it.point_m);
                self.direction("axis", &it.axis, "name the axis of the hinge, for example [0, 1, 0]");
            }
            Joint::Distance(it) => {
                it.at_a_body_m.as_ref().map(|point| self.finite("at_a_body_m", point));
                it.length_m.as_ref().map(|x| self.positive("length_m", x, "leave it out for the one at the start"));
                self.second_end("distance", &it.a, it.b.as_ref(), it.at_b_body_m.as_ref(), it.to_m.as_ref());
            }
        }
    }

    /// A joint or spring from a body to either another one or a point of the world.
    pub(super) fn second_end(
        &mut self,
        what: &str,
        a: &Spanned<String>,
        b: Option<&Spanned<String>>,
        at_b: Option<&Spanned<Numbers<3>>>,
        to: Option<&Spanned<Numbers<3>>>,
    ) {
        for (key, point) in [("at_b_body_m", at_b), ("to_m", to)] {
            point.map(|point| self.finite(key, point));
        }
        match (b, at_b, to) {
            (Some(_), _, Some(to)) => {
                let diagnostic = Diagnostic::new(format!("the {what} has two second ends: `b` and `to_m`"));
                self.report(diagnostic.at(to.span()).help("keep `b` for a body, or `to_m` for a point of the world"));
            }
            (None, Some(at_b), _) => {
                let diagnostic = Diagnostic::new(format!("the {what} names no body `b` to have this point"));
                self.report(diagnostic.at(at_b.span()).help("add `b = ..`, or write `to_m` for a point of the world"));
            }
            (None, None, None) => {
                let diagnostic = Diagnostic::new(format!("the {what} has one end only")).at(a.span());
                self.report(
                    diagnostic.help("add `b = ..`, the name of a body, or `to_m = [x, y, z]`, a point of the world"),
                );
            }
            _ => {}
        }
    }

    /// The bodies of a link: known, different, not all fixed, of one formulation. `what` it is, and what else to write for
    /// particles.
    pub(super) fn linked(
        &mut self,
        (what, for_particles): (&str, &str),
        (a, b): (&Spanned<String>, Option<&Spanned<String>>),
        scene: &Scene,
        damage: &Damage,
    ) {
        let found: Vec<_> =
            [Some(a), b].into_iter().flatten().map(|name| self.body_of(name, for_particles, scene, damage)).collect();
        let (a_name, b_name) = (a.get_ref(), b.map_or("", |b| b.get_ref()));
        let place = b.unwrap_or(a).span();
        match found[..] {
            [Some(first), Some(second)] if first == second => {
                let diagnostic = Diagnostic::new(format!("`{a_name}` is joined to itself")).at(place);
                self.report(
                    diagnostic
                        .label("the same body")
                        .help("name two different ones; without `b` a joint is to the world"),
                );
            }
            [Some(first), Some(second)] if scene.body[first].fixed && scene.body[second].fixed => {
                let diagnostic =
                    Diagnostic::new(format!("`{a_name}` and `{b_name}` are both fixed: the {what} does nothing"));
                self.report(diagnostic.at(place).help(format!("remove the {what}, or let one of them move")));
            }
            [Some(first)] if scene.body[first].fixed => {
                let diagnostic = Diagnostic::new(format!("`{a_name}` is fixed: the {what} does nothing"));
                self.report(diagnostic.at(place).help(format!("remove the {what}, or `fixed = true` of the body")));
            }
            [Some(first), Some(second)] => self.one_formulation(scene, [first, second], what, place),
            _ => {}
        }
    }

    /// Bodies that act on one another are solved for together.
    fn one_formulation(&mut self, scene: &Scene, pair: [usize; 2], what: &str, place: Range<usize>) {
        let bodies = pair.map(|body_idx| &scene.body[body_idx]);
        let [first, second] = bodies.map(|body| scene.formulation_of(body).name());
        if first == second || bodies.iter().any(|body| body.fixed) {
            return;
        }
        let [a, b] = bodies.map(|body| body.name.get_ref());
        let message = format!("the {what} links `{a}`, by `{first}`, and `{b}`, by `{second}`");
        let diagnostic = Diagnostic::new(message).at(place).label("two formulations");
        self.report(diagnostic.help("bodies that act on one another need one `formulation`"));
    }

    /// The body of a name; if there is none, says so.
    fn body_of(
        &mut self,
        name: &Spanned<String>,
        for_particles: &str,
        scene: &Scene,
        damage: &Damage,
    ) -> Option<usize> {
        let found = scene.body_idx(name.get_ref());
        // The body may be the one whose name could not be read.
        if found.is_none() && !damage.of_names(scene) {
            let mut diagnostic = super::forces::unknown_body(name, scene);
            if is_particle(name.get_ref(), scene) {
                diagnostic =
                    Diagnostic::new(format!("`{}` is a particle", name.get_ref())).at(name.span()).help(for_particles);
            }
            self.report(diagnostic);
        }
        found
    }

    /// Whether a joint has a direction to act in.
    fn holds_something(&mut self, joint: &Joint, joined: &Joined) {
        if let Joined::Distance { ends: [a, b], .. } = joined
            && a.at == b.at
        {
            let diagnostic = Diagnostic::new("both ends of the distance are at one place: it has no direction");
            self.report(diagnostic.at(place(joint)).help("move one of them, or join them by a `ball`"));
        }
    }
}

/// Whether a name is that of a particle, chain or net, or of a particle of one.
pub(super) fn is_particle(name: &str, scene: &Scene) -> bool {
    let of = |known: &Spanned<String>| {
        name.strip_prefix(known.get_ref().as_str()).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    let single = scene.particle.iter().any(|particle| particle.name.get_ref() == name);
    single || scene.chain.iter().any(|chain| of(&chain.name)) || scene.net.iter().any(|net| of(&net.name))
}

/// A distance that is not the one at the start.
fn misplaced(joint: &Joint, joined: &Joined) -> Option<Diagnostic> {
    let (Joint::Distance(DistanceJoint { length_m: Some(given), .. }), Joined::Distance { ends: [a, b], length }) =
        (joint, joined)
    else {
        return None;
    };
    let apart = a.at.distance_sq_to(b.at).sqrt();
    ((apart - length).abs() > allowed(*length, [a.at, b.at])).then(|| {
        Diagnostic::new(format!("the ends of the distance are {apart} m apart at the start, not {length} m"))
            .at(given.span())
            .label(format!("{:.3e} m off", (apart - length).abs()))
            .help("leave `length_m` out, or move one of the bodies")
    })
}

/// An end in motion.
struct Moving<'a> {
    /// The body; none: the world, which stands still.
    body: Option<(&'a str, Pose)>,
    /// Of its point, m/s.
    velocity: Vector<f64>,
    /// The sum of the speeds that this velocity is made of, `|v| + |Omega| |r|`, m/s: rounding goes by it.
    speed: f64,
    /// As the axial vector, rad/s.
    omega: Vector<f64>,
}

impl<'a> Moving<'a> {
    fn of(end: End, scene: &'a Scene) -> Self {
        let body = end.moved_by().and_then(|(body_idx, _)| {
            let body = &scene.body[body_idx];
            Some((body.name.get_ref().as_str(), Pose::of(body)?))
        });
        let Some((_, pose)) = &body else {
            return Self { body: None, velocity: Vector::default(), speed: 0.0, omega: Vector::default() };
        };
        let velocity = pose.velocity_at(end.at);
        let omega = Vector::from(<[f64; 3]>::from(pose.omega_world));
        let speed = size(pose.velocity) + size(omega) * size(pose.position.displacement_to(end.at));
        Self { velocity, speed, omega, body }
    }
}

fn size(vector: Vector<f64>) -> f64 {
    vector.norm_sq().sqrt()
}

/// A start whose velocities the joint contradicts: no force, however large, would keep it.
fn moving_off(joint: &Joint, joined: &Joined, scene: &Scene) -> Option<Diagnostic> {
    let [a, b] = joined.ends().map(|end| Moving::of(end, scene));
    // The second one is put right, where it is no fixed one.
    let (still, moving) = if b.body.is_some() { (a, b) } else { (b, a) };
    let (name, pose) = moving.body.as_ref()?;
    let relative = moving.velocity - still.velocity;
    let off = match joined {
        Joined::Distance { ends: [a, b], .. } => {
            let way = a.at.displacement_to(b.at);
            way * ((relative | way) / way.norm_sq())
        }
        _ => relative,
    };
    let contradiction = |off: String, help: String| {
        let diagnostic = Diagnostic::new(format!("`{name}` moves against its joint, {off} at the start"));
        Some(diagnostic.at(place(joint)).label("forbids this motion").help(help))
    };
    if let Joint::Hinge(it) = joint {
        let axis = Vector::from(it.axis.get_ref().0);
        let about = moving.omega - still.omega;
        let kept = axis * ((about | axis) / axis.norm_sq());
        if size(about - kept) > OFF_BY * (size(moving.omega) + size(still.omega)) {
            let [x, y, z] = <[f64; 3]>::from(still.omega + kept);
            let help = format!("the nearest that it allows is `omega_world_rad_s = [{x}, {y}, {z}]`");
            return contradiction(format!("turning at {:.3e} rad/s across the axis", size(about - kept)), help);
        }
    }
    if size(off) > OFF_BY * (moving.speed + still.speed) {
        let [x, y, z] = <[f64; 3]>::from(pose.velocity - off);
        let help = format!("what fits its spin and the other end is `velocity_m_s = [{x}, {y}, {z}]`");
        return contradiction(format!("at {:.3e} m/s", size(off)), help);
    }
    None
}
