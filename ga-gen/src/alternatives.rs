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
    ways: Vec<usize>,
}

impl Plan {
    fn new(wanted: Vec<usize>) -> Self {
        Self { wanted, ways: vec![] }
    }

    /// The way to take at the next point.
    pub fn choose(&mut self, ways: usize) -> usize {
        let way = self.wanted.get(self.ways.len()).copied().unwrap_or(0);
        self.ways.push(ways);
        // A way that was there under another plan may have gone.
        if way < ways { way } else { 0 }
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
    let mut point = 0;
    while point < plan.ways.len().min(MOST_POINTS) {
        for way in 1..plan.ways[point] {
            let mut wanted = plan.wanted.clone();
            wanted.resize(point.max(wanted.len()), 0);
            wanted.truncate(point);
            wanted.push(way);
            if let Some((other, used)) = lower(Plan::new(wanted))?
                && cost(program(&other).counts()) < cost(program(&best).counts())
            {
                (best, plan) = (other, used);
            }
        }
        point += 1;
    }
    Ok(Some(best))
}
