//! Several lowerings, the cheapest wins.
//!
//! A lowering asks its [`Plan`] at every point where there are several ways to go on, and goes the first way unless the
//! plan says otherwise. [`cheapest`] lowers once by the empty plan, then tries the other ways point by point and keeps
//! each change that makes the program cheaper.

use crate::program::{Counts, Program};

/// A point where there were several ways to go on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// What was to be computed.
    pub what: &'static str,
    /// The ways, by name.
    pub ways: Vec<&'static str>,
    /// The one that was taken.
    pub taken: usize,
}

/// Which way to take at each point, and what the choices were.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    wanted: Vec<usize>,
    /// The way at points beyond.
    otherwise: usize,
    made: Vec<Choice>,
}

impl Plan {
    fn new(wanted: Vec<usize>, otherwise: usize) -> Self {
        Self { wanted, otherwise, made: vec![] }
    }

    /// The way to take at the next point; the last where there are fewer.
    pub fn choose(&mut self, what: &'static str, ways: &[&'static str]) -> usize {
        let taken = self.wanted.get(self.made.len()).copied().unwrap_or(self.otherwise).min(ways.len() - 1);
        self.made.push(Choice { what, ways: ways.to_vec(), taken });
        taken
    }

    /// The choices that were made by this plan.
    #[must_use]
    pub fn made(&self) -> &[Choice] {
        &self.made
    }

    fn taken(&self) -> Vec<usize> {
        self.made.iter().map(|choice| choice.taken).collect()
    }

    /// A fresh plan that makes the same choices.
    #[must_use]
    pub fn again(&self) -> Self {
        Self::new(self.taken(), self.otherwise)
    }

    /// A fresh plan that makes the same choices but one.
    #[must_use]
    pub fn with(&self, point: usize, way: usize) -> Self {
        let mut wanted = self.taken();
        if let Some(choice) = wanted.get_mut(point) {
            *choice = way;
        }
        Self::new(wanted, self.otherwise)
    }
}

/// Beyond this many points the first ways are taken: a formula with so many sandwiches is better cut into several.
const MOST_POINTS: usize = 24;

/// What a program costs: divisions and roots first, each as dear as many products.
#[must_use]
pub fn cost(counts: Counts) -> (usize, usize) {
    (counts.div + counts.sqrt, counts.operations())
}

/// The cheapest result of lowering by any plan that was tried, with its plan; `None` where the first has none.
///
/// # Errors
/// Those of the lowering.
pub fn cheapest<R, E>(
    mut lower: impl FnMut(Plan) -> Result<Option<(R, Plan)>, E>,
    program: impl Fn(&R) -> &Program,
) -> Result<Option<(R, Plan)>, E> {
    let Some((mut best, mut plan)) = lower(Plan::default())? else { return Ok(None) };
    // Products that pay only together: the same way everywhere.
    let most = plan.made.iter().map(|choice| choice.ways.len()).max().unwrap_or(1);
    let uniform = if plan.made.len() > 1 { 1..most } else { 1..1 };
    for way in uniform {
        improve(&mut lower, &program, Plan::new(vec![], way), &mut best, &mut plan)?;
    }
    let mut point = 0;
    while point < plan.made.len().min(MOST_POINTS) {
        let Choice { ways, taken, .. } = plan.made[point].clone();
        for way in (0..ways.len()).filter(|way| *way != taken) {
            improve(&mut lower, &program, plan.with(point, way), &mut best, &mut plan)?;
        }
        point += 1;
    }
    Ok(Some((best, plan)))
}

/// Lowers by a plan, and keeps the result if it is cheaper.
fn improve<R, E>(
    lower: &mut impl FnMut(Plan) -> Result<Option<(R, Plan)>, E>,
    program: &impl Fn(&R) -> &Program,
    trial: Plan,
    best: &mut R,
    plan: &mut Plan,
) -> Result<(), E> {
    if let Some((other, used)) = lower(trial)?
        && cost(program(&other).counts()) < cost(program(best).counts())
    {
        (*best, *plan) = (other, used);
    }
    Ok(())
}
