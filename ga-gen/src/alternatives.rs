//! Several lowerings, the cheapest wins.
//!
//! A lowering asks its [`Plan`] at every point where there are several ways to go on, and goes the first way unless the
//! plan says otherwise. [`cheapest`] lowers once by the empty plan, then tries the other ways point by point and keeps
//! each change that makes the program cheaper.

use crate::program::{Counts, Program};

/// Which way to take at each point, and how many there were.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    wanted: Vec<usize>,
    /// The way at points beyond.
    otherwise: usize,
    taken: Vec<usize>,
    ways: Vec<usize>,
}

impl Plan {
    fn new(wanted: Vec<usize>, otherwise: usize) -> Self {
        Self { wanted, otherwise, taken: vec![], ways: vec![] }
    }

    /// The way to take at the next point; the last where there are fewer.
    pub fn choose(&mut self, ways: usize) -> usize {
        let way = self.wanted.get(self.ways.len()).copied().unwrap_or(self.otherwise).min(ways - 1);
        self.ways.push(ways);
        self.taken.push(way);
        way
    }
}

/// Beyond this many points the first ways are taken: a formula with so many sandwiches is better cut into several.
const MOST_POINTS: usize = 24;

/// What a program costs: divisions and roots first, each as dear as many products.
#[must_use]
pub fn cost(counts: Counts) -> (usize, usize) {
    (counts.div + counts.sqrt, counts.operations())
}

/// The cheapest result of lowering by any plan that was tried; `None` where the first has none.
///
/// # Errors
/// Those of the lowering.
pub fn cheapest<R, E>(
    mut lower: impl FnMut(Plan) -> Result<Option<(R, Plan)>, E>,
    program: impl Fn(&R) -> &Program,
) -> Result<Option<R>, E> {
    let Some((mut best, mut plan)) = lower(Plan::default())? else { return Ok(None) };
    // Products that pay only together: the same way everywhere.
    let most = plan.ways.iter().copied().max().unwrap_or(1);
    let uniform = if plan.ways.len() > 1 { 1..most } else { 1..1 };
    for way in uniform {
        improve(&mut lower, &program, Plan::new(vec![], way), &mut best, &mut plan)?;
    }
    let mut point = 0;
    while point < plan.ways.len().min(MOST_POINTS) {
        for way in (0..plan.ways[point]).filter(|way| plan.taken[point] != *way).collect::<Vec<_>>() {
            let mut wanted = plan.taken.clone();
            wanted[point] = way;
            improve(&mut lower, &program, Plan::new(wanted, plan.otherwise), &mut best, &mut plan)?;
        }
        point += 1;
    }
    Ok(Some(best))
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
