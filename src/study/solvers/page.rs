//! The net at three tolerances side by side: what a loose tolerance does, to look at.
//!
//! Nothing keeps the constraints but `d²C/dt² = 0`, the report's (24): what the integrator errs stays in the links, and grows.

use super::cases::{Case, LINK_M, net};
use crate::io::html::{self, ParticlesView, Playback};
use crate::ode::{Adaptive, CashKarp, Run, Stepper, Tolerance};
use crate::particle::{LinearSolver, Method, Rates, Solver, SolverError, Stabilisation, Steps, System};
use crate::study::{StudyError, rounded};

/// From loose to tight.
const TOLERANCES: [f64; 3] = [1e-2, 1e-4, 1e-8];
const SECONDS: u32 = 3;
/// Steps from one frame to the next; the tightest run takes some 20. Where a net runs away they get shorter without end.
const MOST_STEPS: u64 = 1000;
const FRAMES_PER_S: u32 = 60;
/// From one net to the next, m: the nets are 0.7 m wide and swing across.
const APART_M: f64 = 1.1;

/// The page.
///
/// # Errors
/// A solver cannot be used.
pub(super) fn page() -> Result<String, StudyError> {
    let case = net();
    let times_s: Vec<f64> = (0..=SECONDS * FRAMES_PER_S).map(|i| f64::from(i) / f64::from(FRAMES_PER_S)).collect();
    let mut view = ParticlesView { positions: vec![vec![]; times_s.len()], ..ParticlesView::default() };
    let mut title = String::from("Cash-Karp, no stabilisation");
    for rtol in TOLERANCES {
        if let Some(ended_s) = add(&mut view, &case, rtol, &times_s)? {
            title += &format!("; rtol {rtol:.0e} runs away at {ended_s:.2} s");
        }
    }
    let (bodies, poses, marks, energy) = (vec![], vec![vec![]; times_s.len()], vec![], vec![]);
    Ok(html::render(&Playback {
        scene: &title,
        bodies,
        times_s,
        poses,
        stretched: vec![],
        links: vec![],
        particles: view,
        marks,
        energy,
    }))
}

/// One more net, to the right of the others; when it ran away, s, if it did.
fn add(view: &mut ParticlesView, case: &Case, rtol: f64, times_s: &[f64]) -> Result<Option<f64>, StudyError> {
    let (begin, count) = (view.names.len(), case.start.len());
    let tolerance = Tolerance { rtol, atol: rtol };
    let solver = Solver {
        stabilisation: Stabilisation::None,
        ..case.solver(Method::CashKarp, Steps::Adaptive { tolerance }, LinearSolver::Direct)
    };
    let refused = |error| StudyError::Solver(SolverError::Setup(error));
    let mut system = System::new(case.setup.clone(), &case.start, &solver).map_err(refused)?;
    let start = (case.start.clone(), Rates::zeros(count));
    let stepper = Adaptive::<CashKarp, _, f64>::new(0.0, start.0, start.1, tolerance).map_err(SolverError::from)?;
    let mut stepper = stepper.with_max_steps(MOST_STEPS);
    let right = APART_M * (begin / count) as f64;
    let (mut worst_m, mut ended_s, mut state) = (0.0_f64, None, case.start.clone());
    for (time_s, frame) in times_s.iter().zip(&mut view.positions) {
        // A net that ran away stays where it was last seen; the title says so.
        let mut next = state.clone();
        if ended_s.is_none() && stepper.advance_to(&mut system, *time_s, &mut next).is_err() {
            ended_s = Some(stepper.time_s());
        }
        if ended_s.is_none() {
            state = next;
            worst_m = worst_m.max(system.worst_violation(&state).map_or(0.0, |(_, violation)| violation));
        }
        frame.extend(state.position.iter().map(|x| [x.x + right, x.y, x.z]));
    }
    let percent = 100.0 * worst_m / LINK_M;
    let percent = if percent < 0.1 { format!("{percent:.0e}") } else { rounded(percent) };
    view.groups.push((format!("rtol {rtol:.0e}: {percent} % off"), count));
    view.names.extend((0..count).map(|i| format!("rtol {rtol:.0e}, particle {i}")));
    view.fixed.extend(case.setup.masses.inv_mass.iter().map(|inv_mass| *inv_mass == 0.0));
    view.masses.extend(&case.setup.masses.mass);
    view.links.extend(case.links.iter().map(|[a, b]| [a + begin, b + begin]));
    Ok(ended_s)
}
