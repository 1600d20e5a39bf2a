//! What the other ways to compute something would have cost: one change to the plan that was taken, at a time.

use super::document::Table;
use super::report::Subject;
use crate::alternatives::{Choice, Plan};
use crate::formula::{self, Compiled};
use crate::frame;
use crate::header::Frame;
use crate::item::{self, Operation};
use crate::optimise::{Effort, optimise, stages};
use crate::program::{Builder, Counts, Program, Scaled};
use crate::spec::Spec;

/// A graph with its outputs.
struct Graph {
    builder: Builder,
    outputs: Vec<(String, Scaled)>,
}

impl Subject<'_> {
    fn effort(&self) -> Effort {
        match self {
            Self::Item(_) => Effort::Product,
            Self::Formula(_) => Effort::Whole,
        }
    }

    fn plan(&self) -> &Plan {
        match self {
            Self::Item(item) => &item.plan,
            Self::Formula(compiled) => &compiled.plan,
        }
    }

    /// The graph by a plan; `None` where it has no result.
    fn graph(&self, spec: &Spec, plan: Plan) -> Option<Graph> {
        match self {
            Self::Item(item) => item_graph(spec, item.operation, plan),
            Self::Formula(compiled) => {
                let (lowered, _) = formula::lower(spec, &compiled.formula, plan).ok()?;
                let outputs = formula::outputs(spec, &compiled.formula, &lowered.results);
                Some(Graph { builder: lowered.builder, outputs })
            }
        }
    }

    /// The program before and after each pass; none for a pass that is left out.
    pub(super) fn stages(&self, spec: &Spec) -> Vec<(&'static str, Option<Program>)> {
        let graph = self.graph(spec, self.plan().again());
        graph.map_or_else(Vec::new, |graph| stages(&graph.builder, &graph.outputs, self.effort()))
    }
}

fn item_graph(spec: &Spec, operation: Operation, plan: Plan) -> Option<Graph> {
    let (lowered, _) = item::lower_by(spec, operation, plan).ok()??;
    Some(Graph { builder: lowered.builder, outputs: lowered.fields })
}

/// The frames and, point by point, the ways of the plan, with their cost; `None` where there was one way only.
pub(super) fn table(spec: &Spec, subject: &Subject<'_>) -> Option<Table> {
    let mut rows = Vec::new();
    if let Subject::Formula(compiled) = subject {
        rows.extend(frames(spec, compiled));
    }
    for (point, Choice { what, ways, taken }) in subject.plan().made().iter().enumerate() {
        for (way, name) in ways.iter().enumerate() {
            let graph = subject.graph(spec, subject.plan().with(point, way));
            let counts = graph.map(|graph| optimise(&graph.builder, &graph.outputs, subject.effort()).counts());
            rows.push(row(format!("{}. {what}", point + 1), name, way == *taken, counts));
        }
    }
    let head = ["where", "way", "taken", "operations", "div", "sqrt"];
    (!rows.is_empty()).then(|| Table::new(head, 3..6, rows))
}

fn row(place: String, way: &str, taken: bool, counts: Option<Counts>) -> Vec<String> {
    let taken = if taken { "taken" } else { "" };
    let costs = match counts {
        Some(counts) => [counts.operations(), counts.div, counts.sqrt].map(|count| count.to_string()),
        None => ["none", "", ""].map(String::from),
    };
    [&[place, way.into(), taken.into()], &costs[..]].concat()
}

/// The cheapest program in the world and in the frame of each parameter where the formula has the same value there.
fn frames(spec: &Spec, compiled: &Compiled) -> Vec<Vec<String>> {
    let chosen = frame_name(&compiled.formula.source.options.frame);
    let mut world = compiled.formula.clone();
    world.source.options.frame = Frame::World;
    let Ok((first, _)) = formula::lower(spec, &world, Plan::default()) else { return vec![] };
    let mut rivals = vec![world.clone()];
    rivals.extend(frame::automatic(&world));
    if let Frame::Relative(_) = compiled.formula.source.options.frame {
        rivals.push(compiled.formula.clone());
    }
    let rows = rivals.iter().filter_map(|rival| {
        let other = formula::cheapest_in(spec, rival, &first.world).ok().flatten()?;
        let name = frame_name(&rival.source.options.frame);
        Some(row("frame".into(), &name, name == chosen, Some(other.program.counts())))
    });
    let rows: Vec<_> = rows.collect();
    // The world alone is no choice.
    if rows.len() > 1 { rows } else { vec![] }
}

fn frame_name(frame: &Frame) -> String {
    match frame {
        Frame::World => "world".into(),
        Frame::Local(origin) => format!("local = {origin}"),
        Frame::Relative(origin) => format!("relative = {origin}"),
    }
}
