//! Mistakes in constraints: their values, the particles that they name, and whether the start keeps them.

use std::collections::HashMap;
use std::ops::Range;

use toml::Spanned;

use super::Checker;
use crate::algebra::cga::Point;
use crate::scene::description::{Constraint, Scene};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::particles::{Held, Roster, held};
use crate::scene::read::Damage;
use crate::scene::suggest;

/// A start may break a constraint or joint by this much of its length. Numbers are written with ten digits or more where they
/// are meant exactly, and the first projection takes away what is left; what is off by more is meant otherwise.
pub(super) const OFF_BY: f64 = 1e-9;

/// A coordinate is off by half an ulp as it is read, and a distance by that of six coordinates, each at most the largest.
const ROUNDING: f64 = 3.0 * f64::EPSILON;

/// How many names a message lists.
const LISTED: usize = 12;

impl Checker {
    pub(super) fn constraints(&mut self, scene: &Scene, roster: &Roster, damage: &Damage) {
        let mut linked: HashMap<[usize; 2], f64> = HashMap::new();
        for [a, b] in &roster.links {
            linked.insert([*a, *b], roster.position[*a].distance_sq_to(roster.position[*b]).sqrt());
        }
        for constraint in &scene.constraint {
            let before = self.found.len();
            self.constraint_values(constraint);
            if damage.of_particles() || self.found.len() > before {
                continue;
            }
            self.constraint_targets(constraint, roster, &mut linked);
            if self.found.len() == before {
                self.kept_at_start(constraint, roster);
            }
        }
    }

    fn constraint_values(&mut self, constraint: &Constraint) {
        const DIRECTION: &str = "for example [0, 0, 1]";
        let given = "leave it out for the one at the start";
        match constraint {
            Constraint::Distance(it) => {
                it.length_m.as_ref().map(|length| self.positive("length_m", length, given));
            }
            Constraint::DistanceToPoint(it) => {
                self.finite("point_m", &it.point_m);
                it.length_m.as_ref().map(|length| self.positive("length_m", length, given));
            }
            Constraint::OnPlane(it) => {
                it.point_m.as_ref().map(|point| self.finite("point_m", point));
                self.direction("normal", &it.normal, DIRECTION);
            }
            Constraint::OnSphere(it) => {
                self.finite("centre_m", &it.centre_m);
                it.radius_m.as_ref().map(|radius| self.positive("radius_m", radius, given));
            }
            Constraint::OnLine(it) => {
                it.point_m.as_ref().map(|point| self.finite("point_m", point));
                self.direction("direction", &it.direction, DIRECTION);
            }
            Constraint::OnCircle(it) => {
                self.finite("centre_m", &it.centre_m);
                it.radius_m.as_ref().map(|radius| self.positive("radius_m", radius, given));
                self.direction("normal", &it.normal, DIRECTION);
            }
        }
    }

    /// Whom it holds; each pair may be held once.
    fn constraint_targets(&mut self, constraint: &Constraint, roster: &Roster, linked: &mut HashMap<[usize; 2], f64>) {
        let Constraint::Distance(it) = constraint else {
            let name = particle(constraint);
            let Some(range) = self.particles_of(name, roster) else {
                return;
            };
            if range.clone().all(|index| roster.fixed[index]) {
                let message = format!("`{}` is fixed: there is nothing to hold", name.get_ref());
                let diagnostic = Diagnostic::new(message).at(name.span());
                self.report(diagnostic.help("remove the constraint, or `fixed` of the particle"));
            }
            return;
        };
        let Some([a, b]) = self.pair(&it.a, &it.b, roster) else {
            return;
        };
        let names = format!("`{}` and `{}`", it.a.get_ref(), it.b.get_ref());
        let apart = roster.position[a].distance_sq_to(roster.position[b]).sqrt();
        let length = it.length_m.as_ref().map_or(apart, |length| *length.get_ref());
        if !roster.can_move([a, b]) {
            let diagnostic =
                Diagnostic::new(format!("{names} are both fixed, {apart} m apart: there is nothing to hold"));
            self.report(diagnostic.at(it.b.span()).help("remove the constraint, or let one of them move"));
        } else if let Some(known) = linked.insert([a.min(b), a.max(b)], length) {
            let differ = (known - length).abs() > OFF_BY * known;
            let message = match differ {
                true => format!("{names} cannot be both {known} m and {length} m apart"),
                false => format!("the distance of {names} is held twice"),
            };
            let place = it.length_m.as_ref().map_or(it.b.span(), Spanned::span);
            let diagnostic = Diagnostic::new(message).at(place).label("already linked above, or by a chain or net");
            self.report(diagnostic.help("keep one of the two"));
        } else if apart == 0.0 {
            let diagnostic = Diagnostic::new(format!("{names} are at one place: their link has no length"));
            self.report(diagnostic.at(it.b.span()).help("move one of them"));
        }
    }

    /// Positions and velocities at the start, of the first particle that does not keep the constraint.
    fn kept_at_start(&mut self, constraint: &Constraint, roster: &Roster) {
        for held in held(constraint, roster) {
            let name = match constraint {
                Constraint::Distance(it) => &it.b,
                _ => particle(constraint),
            };
            let found = misplaced(constraint, &held, roster).or_else(|| moving_off(&held, roster));
            if let Some(diagnostic) = found {
                let place = length_of(constraint).map_or(name.span(), Spanned::span);
                let diagnostic = if diagnostic.span.is_none() { diagnostic.at(place) } else { diagnostic };
                return self.report(diagnostic);
            }
        }
    }

    /// Two different particles by their names.
    pub(super) fn pair(&mut self, a: &Spanned<String>, b: &Spanned<String>, roster: &Roster) -> Option<[usize; 2]> {
        let found = (self.particle_of(a, roster), self.particle_of(b, roster));
        let (Some(first), Some(second)) = found else {
            return None;
        };
        if first == second {
            let diagnostic = Diagnostic::new(format!("`{}` is joined to itself", a.get_ref())).at(b.span());
            self.report(diagnostic.label("the same particle").help("name two different ones"));
            return None;
        }
        Some([first, second])
    }

    fn particle_of(&mut self, name: &Spanned<String>, roster: &Roster) -> Option<usize> {
        let range = self.particles_of(name, roster)?;
        if range.len() == 1 {
            return Some(range.start);
        }
        let group = name.get_ref();
        let first = roster.names.get(range.start).map_or("", String::as_str);
        let diagnostic = Diagnostic::new(format!("`{group}` has {} particles, and one is needed", range.len()));
        self.report(diagnostic.at(name.span()).help(format!("name one of them, for example `{first}`")));
        None
    }

    /// The particles that a name stands for; if there are none, says so.
    pub(super) fn particles_of(&mut self, name: &Spanned<String>, roster: &Roster) -> Option<Range<usize>> {
        let wanted = name.get_ref();
        let found = roster.all(wanted);
        if found.is_none() {
            self.report(unknown(wanted, roster).at(name.span()));
        }
        found
    }
}

fn unknown(wanted: &str, roster: &Roster) -> Diagnostic {
    let diagnostic = Diagnostic::new(format!("no particle is named `{wanted}`"));
    let holds = |name: &str| wanted.strip_prefix(name).is_some_and(|rest| rest.starts_with('.'));
    if let Some(group) = roster.groups.iter().find(|group| group.many && holds(&group.name)) {
        let ends = [group.range.start, group.range.end.saturating_sub(1)].map(|index| &roster.names[index]);
        return diagnostic
            .label(format!("`{}` has no such", group.name))
            .help(format!("its particles are `{}` to `{}`", ends[0], ends[1]));
    }
    let names = || roster.groups.iter().map(|group| group.name.as_str());
    let diagnostic = match suggest::closest(wanted, names()) {
        Some(near) => diagnostic.label(format!("did you mean `{near}`?")),
        None => diagnostic.label("not known"),
    };
    let more = if roster.groups.len() > LISTED { ", .." } else { "" };
    diagnostic.help(match roster.groups.is_empty() {
        true => "the scene has no particles".to_owned(),
        false => format!("the particles are {}{more}", suggest::list(names().take(LISTED))),
    })
}

/// The name in a constraint on one particle.
fn particle(constraint: &Constraint) -> &Spanned<String> {
    match constraint {
        Constraint::Distance(it) => &it.a,
        Constraint::DistanceToPoint(it) => &it.particle,
        Constraint::OnPlane(it) => &it.particle,
        Constraint::OnSphere(it) => &it.particle,
        Constraint::OnLine(it) => &it.particle,
        Constraint::OnCircle(it) => &it.particle,
    }
}

fn length_of(constraint: &Constraint) -> Option<&Spanned<f64>> {
    match constraint {
        Constraint::Distance(it) => it.length_m.as_ref(),
        Constraint::DistanceToPoint(it) => it.length_m.as_ref(),
        Constraint::OnSphere(it) => it.radius_m.as_ref(),
        Constraint::OnCircle(it) => it.radius_m.as_ref(),
        Constraint::OnPlane(_) | Constraint::OnLine(_) => None,
    }
}

/// What a distance may be off by: of its own size, and of the coordinates.
pub(super) fn allowed(size: f64, points: [Point<f64>; 2]) -> f64 {
    let largest = points.iter().flat_map(|point| <[f64; 3]>::from(*point)).fold(0.0, |max, x| f64::max(max, x.abs()));
    OFF_BY * size + ROUNDING * largest
}

fn misplaced(constraint: &Constraint, held: &Held, roster: &Roster) -> Option<Diagnostic> {
    if let Held::Pair { a, b, length } = *held {
        let (from, to) = (roster.position[a], roster.position[b]);
        let apart = from.distance_sq_to(to).sqrt();
        return ((apart - length).abs() > allowed(length, [from, to])).then(|| {
            let (a, b) = (&roster.names[a], &roster.names[b]);
            Diagnostic::new(format!("`{a}` and `{b}` are {apart} m apart at the start, not {length} m"))
                .label(format!("{:.3e} m off", (apart - length).abs()))
                .help("leave `length_m` out, or move one of them")
        });
    }
    let centre = match *held {
        Held::ToPoint { point: centre, .. }
        | Held::Sphere { centre, .. }
        | Held::Circle { centre, .. }
        | Held::Plane { point: centre, .. }
        | Held::Line { point: centre, .. } => centre,
        Held::Pair { .. } => return None,
    };
    let Some((index, nearest)) = held.nearest(roster) else {
        let name = particle(constraint);
        let message = format!("`{}` is in the centre of what should hold it: there is no direction", name.get_ref());
        return Some(Diagnostic::new(message).at(name.span()).help("move it away from the centre"));
    };
    let at = roster.position[index];
    let size = at.distance_sq_to(centre).sqrt().max(nearest.distance_sq_to(centre).sqrt());
    let off = at.distance_sq_to(nearest).sqrt();
    (off > allowed(size, [at, centre])).then(|| {
        let from = match constraint {
            Constraint::OnPlane(_) => "the plane",
            Constraint::OnLine(_) => "the line",
            Constraint::OnCircle(_) => "the circle",
            Constraint::OnSphere(_) => "the sphere",
            _ => "where `length_m` holds it",
        };
        let free = match constraint {
            Constraint::OnPlane(_) | Constraint::OnLine(_) => "leave `point_m` out",
            Constraint::OnSphere(_) | Constraint::OnCircle(_) => "leave `radius_m` out",
            _ => "leave `length_m` out",
        };
        // A plane of a circle that the particle is not in stays, whatever the radius.
        let in_plane = match *held {
            Held::Circle { centre, normal, .. } => {
                (centre.displacement_to(at) | normal).abs() <= allowed(size, [at, centre])
            }
            _ => true,
        };
        let [x, y, z] = <[f64; 3]>::from(nearest);
        let there = format!("move it to [{x}, {y}, {z}]");
        Diagnostic::new(format!("`{}` is {off:.3e} m away from {from} at the start", roster.names[index]))
            .label(format!("{off:.3e} m off"))
            .help(if in_plane { format!("{free}, or {there}") } else { there })
    })
}

/// A start whose velocity leaves the constraint: no force, however large, would keep it.
fn moving_off(held: &Held, roster: &Roster) -> Option<Diagnostic> {
    let (name, velocity) = match *held {
        Held::Pair { a, b, .. } => (b, roster.velocity[b] - roster.velocity[a]),
        Held::ToPoint { particle, .. }
        | Held::Plane { particle, .. }
        | Held::Sphere { particle, .. }
        | Held::Line { particle, .. }
        | Held::Circle { particle, .. } => (particle, roster.velocity[particle]),
    };
    let speed = velocity.norm_sq().sqrt();
    let kept = held.barred(roster).into_iter().fold(velocity, |v, n| v - n * (v | n));
    let off = (velocity - kept).norm_sq().sqrt();
    (off > OFF_BY * speed).then(|| {
        let help = match held {
            Held::Pair { .. } => "take away the part of their relative velocity that is along the link".to_owned(),
            _ => {
                let [x, y, z] = <[f64; 3]>::from(kept);
                format!("the nearest velocity that it allows is [{x}, {y}, {z}]")
            }
        };
        Diagnostic::new(format!("`{}` moves against what holds it, at {off:.3e} m/s at the start", roster.names[name]))
            .label("forbids this velocity")
            .help(help)
    })
}
