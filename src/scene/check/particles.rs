//! Mistakes in particles, chains and nets: their values, counts and names, and where they are.

use std::collections::{HashMap, HashSet};

use toml::Spanned;

use super::Checker;
use crate::algebra::g3::Vector;
use crate::scene::description::{Chain, Net, NetFixed, Particle, Scene};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::particles::{MAX_PARTICLES, Roster, count, is_fixed, normal, steps};
use crate::scene::read::Damage;
use crate::scene::values::Numbers;

impl Checker {
    /// The values of all particles; then they are listed, if there are not too many of them.
    pub(super) fn particles(&mut self, scene: &Scene, damage: &Damage) -> Option<Roster> {
        for (idx, particle) in scene.particle.iter().enumerate() {
            self.particle(particle);
            if !damage.of("particle", idx) {
                self.particle_completeness(particle);
            }
        }
        scene.chain.iter().for_each(|chain| self.chain(chain));
        scene.net.iter().for_each(|net| self.net(net));
        let particles = count(scene);
        if particles > MAX_PARTICLES {
            let largest_net = scene.net.iter().map(|net| net.columns.span()).next();
            let place = largest_net.or(scene.chain.iter().map(|chain| chain.particles.span()).next());
            let message = format!("the scene has {particles:.3e} particles, more than {MAX_PARTICLES:.0e}");
            self.report(Diagnostic { span: place, ..Diagnostic::new(message) }.help("make chains and nets coarser"));
            return None;
        }
        let roster = Roster::of(scene);
        self.taken_names(scene, &roster);
        Some(roster)
    }

    fn particle(&mut self, particle: &Particle) {
        self.name("particle", &particle.name);
        if let Some(mass) = &particle.mass_kg {
            self.positive("mass_kg", mass, "for a particle that never moves write `fixed = true`");
        }
        self.finite("position_m", &particle.position_m);
        self.finite("velocity_m_s", &particle.velocity_m_s);
    }

    fn particle_completeness(&mut self, particle: &Particle) {
        let name = particle.name.get_ref();
        if particle.fixed && *particle.velocity_m_s.get_ref() != Numbers([0.0; 3]) {
            let diagnostic = Diagnostic::new(format!("`{name}` is fixed and has a velocity"));
            let diagnostic = diagnostic.at(particle.velocity_m_s.span()).label("must be zero for a fixed particle");
            self.report(diagnostic.help("remove `velocity_m_s` or `fixed = true`"));
        }
        if !particle.fixed && particle.mass_kg.is_none() {
            let diagnostic = Diagnostic::new(format!("`{name}` has no mass")).at(particle.name.span());
            let diagnostic = diagnostic.label("this particle");
            self.report(diagnostic.help("add `mass_kg = ..`, or `fixed = true` if it never moves"));
        }
    }

    fn chain(&mut self, chain: &Chain) {
        self.name("chain", &chain.name);
        self.positive("mass_kg", &chain.mass_kg, "the mass of each particle");
        let enough = self.at_least("particles", &chain.particles, 2, "a chain has two ends");
        let finite = self.finite("from_m", &chain.from_m) & self.finite("to_m", &chain.to_m);
        let name = chain.name.get_ref();
        if finite && chain.from_m.get_ref() == chain.to_m.get_ref() {
            let diagnostic =
                Diagnostic::new(format!("both ends of `{name}` are at one place: its links have no length"));
            self.report(diagnostic.at(chain.to_m.span()).label("the same as `from_m`").help("move one end"));
        } else if let ([first, second, ..], true) = (&chain.fixed[..], enough && *chain.particles.get_ref() > 2)
            && first.get_ref() != second.get_ref()
        {
            let message = format!("`{name}` is taut between two fixed ends: no particle of it can move");
            let diagnostic = Diagnostic::new(message).at(second.span());
            self.report(diagnostic.help("free one end, or use a [[net]] of one row with a `fold_rad`"));
        }
    }

    fn net(&mut self, net: &Net) {
        self.name("net", &net.name);
        self.positive("mass_kg", &net.mass_kg, "the mass of each particle");
        let columns = self.at_least("columns", &net.columns, 1, "a net of one particle has 1 column and 1 row");
        let rows = self.at_least("rows", &net.rows, 1, "a net of one particle has 1 column and 1 row");
        self.finite("corner_m", &net.corner_m);
        let lists = self.finite("column_step_m", &net.column_step_m) & self.finite("row_step_m", &net.row_step_m);
        let folds = self.fold("fold_rad", &net.fold_rad) & self.fold("row_fold_rad", &net.row_fold_rad);
        let fixed = columns && rows && self.net_fixed(net);
        let few = f64::from(*net.columns.get_ref()) * f64::from(*net.rows.get_ref()) <= MAX_PARTICLES;
        if lists && folds && columns && rows && self.net_steps(net) && fixed && few {
            self.taut_net(net);
        }
    }

    fn fold(&mut self, key: &str, fold: &Spanned<f64>) -> bool {
        let Some(angle) = self.number(key, fold) else {
            return false;
        };
        let fits = angle.abs() < std::f64::consts::FRAC_PI_2;
        if !fits {
            let message = format!("`{key}` must lie between -pi/2 and pi/2, not {angle:?}");
            let diagnostic = Diagnostic::new(message).at(fold.span());
            self.report(diagnostic.help("0.3 folds a little; at pi/2 every second particle would fall on one another"));
        }
        fits
    }

    fn net_steps(&mut self, net: &Net) -> bool {
        let (column_step, row_step) = steps(net);
        for (key, step, value) in
            [("column_step_m", column_step, &net.column_step_m), ("row_step_m", row_step, &net.row_step_m)]
        {
            if step == Vector::default() {
                let diagnostic = Diagnostic::new(format!("`{key}` is zero: the links of the net have no length"));
                self.report(diagnostic.at(value.span()).help("it leads from a particle to the next, in m"));
                return false;
            }
        }
        let folded = *net.fold_rad.get_ref() != 0.0 || *net.row_fold_rad.get_ref() != 0.0;
        let wide = *net.columns.get_ref() > 1 && *net.rows.get_ref() > 1;
        if (folded || wide) && normal(column_step, row_step).is_none() {
            let diagnostic = Diagnostic::new("`column_step_m` and `row_step_m` are parallel: they span no net");
            let diagnostic = diagnostic.at(net.row_step_m.span()).label("parallel to `column_step_m`");
            self.report(diagnostic.help("let them be at an angle, for example [0.1, 0, 0] and [0, 0.1, 0]"));
            return false;
        }
        true
    }

    fn net_fixed(&mut self, net: &Net) -> bool {
        let (columns, rows) = (*net.columns.get_ref(), *net.rows.get_ref());
        let outside = |fixed: &&Spanned<NetFixed>| matches!(fixed.get_ref(), NetFixed::Cell([c, r]) if *c >= columns || *r >= rows);
        let found = net.fixed.iter().find(outside);
        if let Some(fixed) = found {
            let message = format!("`{}` has no such particle", net.name.get_ref());
            let diagnostic = Diagnostic::new(message).at(fixed.span()).label("[column, row], from 0");
            let (last_column, last_row) = (columns - 1, rows - 1);
            self.report(diagnostic.help(format!("columns are 0 to {last_column}, rows 0 to {last_row}")));
        }
        found.is_none()
    }

    /// A straight row or column between two fixed particles cannot move, and its constraint forces are not determined.
    fn taut_net(&mut self, net: &Net) {
        let (columns, rows) = (*net.columns.get_ref(), *net.rows.get_ref());
        let straight_rows = *net.fold_rad.get_ref() == 0.0;
        let straight_columns = *net.row_fold_rad.get_ref() == 0.0;
        let row = (0..rows).filter(|_| straight_rows).find_map(|r| {
            let [a, b] = gap((0..columns).map(|c| is_fixed(net, c, r)))?;
            Some(([a, r], [b, r], "row", "fold_rad"))
        });
        let column = || {
            (0..columns).filter(|_| straight_columns).find_map(|c| {
                let [a, b] = gap((0..rows).map(|r| is_fixed(net, c, r)))?;
                Some(([c, a], [c, b], "column", "row_fold_rad"))
            })
        };
        if let Some(([c0, r0], [c1, r1], line, key)) = row.or_else(column) {
            let name = net.name.get_ref();
            let message = format!(
                "the {line} from `{name}.{c0}.{r0}` to `{name}.{c1}.{r1}` is taut between two fixed particles: it cannot move"
            );
            let place = net.fixed.last().map_or(net.name.span(), Spanned::span);
            let diagnostic = Diagnostic::new(message).at(place);
            self.report(diagnostic.help(format!("fold it, `{key} = 0.3`, or fix fewer particles")));
        }
    }

    fn name(&mut self, what: &str, name: &Spanned<String>) {
        if name.get_ref().trim().is_empty() {
            let diagnostic = Diagnostic::new(format!("the name of a {what} is empty")).at(name.span());
            self.report(diagnostic.help("give it a name of its own"));
        }
    }

    fn at_least(&mut self, key: &str, value: &Spanned<u32>, least: u32, help: &str) -> bool {
        let count = *value.get_ref();
        if count < least {
            let diagnostic = Diagnostic::new(format!("`{key}` must be at least {least}, not {count}"));
            self.report(diagnostic.at(value.span()).help(help));
        }
        count >= least
    }

    fn taken_names(&mut self, scene: &Scene, roster: &Roster) {
        let bodies: HashSet<&str> = scene.body.iter().map(|body| body.name.get_ref().as_str()).collect();
        let of_bodies = roster.groups.iter().enumerate().filter(|(_, group)| bodies.contains(group.name.as_str()));
        let of_bodies = of_bodies.map(|(index, group)| (index, group.name.clone()));
        for (index, name) in roster.taken.iter().cloned().chain(of_bodies) {
            // An empty name is a mistake of its own.
            if name.trim().is_empty() {
                continue;
            }
            let place = roster.groups[index].named_at.clone();
            let diagnostic = Diagnostic::new(format!("the name `{name}` is taken")).at(place);
            let diagnostic = diagnostic.label("by an earlier body, particle, chain or net");
            self.report(diagnostic.help("forces, constraints and outputs refer to them by name"));
        }
    }

    /// Particles at one place, where that has no meaning.
    pub(super) fn coincident(&mut self, roster: &Roster, because: &str) {
        let mut seen: HashMap<[u64; 3], usize> = HashMap::new();
        for index in 0..roster.len() {
            let position = <[f64; 3]>::from(roster.position[index]);
            if !position.iter().all(|x| x.is_finite()) {
                continue;
            }
            // -0 and 0 are one place.
            let key = position.map(|x| (x + 0.0).to_bits());
            let Some(first) = seen.insert(key, index).filter(|first| roster.can_move([*first, index])) else {
                continue;
            };
            let (a, b) = (&roster.names[first], &roster.names[index]);
            let group = roster.group_of(index);
            // A default has no place: the name then says where.
            let place = if group.placed_at == (0..0) { &group.named_at } else { &group.placed_at };
            let diagnostic =
                Diagnostic::new(format!("`{a}` and `{b}` are at one place, where {because} has no direction"));
            self.report(diagnostic.at(place.clone()).help("move one of them, or give the force a `softening_m`"));
            return;
        }
    }
}

/// Two fixed ones next to each other in a line with free ones between, if there are.
fn gap(fixed: impl Iterator<Item = bool>) -> Option<[u32; 2]> {
    let mut last = None;
    for (index, is) in (0_u32..).zip(fixed) {
        if !is {
            continue;
        }
        if let Some(last) = last.filter(|last| index - last > 1) {
            return Some([last, index]);
        }
        last = Some(index);
    }
    None
}
