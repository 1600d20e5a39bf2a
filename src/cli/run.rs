//! `ga-physics run`: load, build, simulate with a progress bar, write the files, print the table.

use super::Failure;
use super::conserved::Conserved;
use super::explain::explain;
use super::playback::{Cast, playback};
use super::table;
use crate::algebra::Real;
use crate::io::files::{WriteError, write_whole};
use crate::io::html;
use crate::io::summary::{self, BodySettings, BodyWork, ParticleSettings, ParticleWork, Settings, Summary};
use crate::io::tables;
use crate::particle::{Motion, Particles};
use crate::rigid;
use crate::scene::build::{Built, build};
use crate::scene::description::{Method, Scalar};
use crate::scene::plan::{self, BodySolverPlan, SolverPlan};
use crate::scene::{MAX_STEPS, Rejected, Scene, SceneSource, load};
use crate::simulation::{Event, Record, SimulationError, World, state_hash};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What to run, and how.
#[derive(Clone, Debug)]
pub(super) struct Options {
    /// The scene file.
    pub(super) scene: PathBuf,
    /// Where the files go; default `out/<scene>`.
    pub(super) out: Option<PathBuf>,
    /// `--set` texts.
    pub(super) sets: Vec<String>,
    /// Nothing on the terminal but errors.
    pub(super) quiet: bool,
}

/// Runs a scene.
///
/// # Errors
/// The user's input is wrong; the run failed, and what was recorded is written.
pub(super) fn run(options: &Options) -> Result<(), Failure> {
    let (scene, source) = load(&options.scene, &options.sets).map_err(Failure::rejected)?;
    match scene.solver.scalar {
        Scalar::F64 => run_in::<f64>(options, &scene, source),
        Scalar::F32 => run_in::<f32>(options, &scene, source),
    }
}

fn run_in<T: Real>(options: &Options, scene: &Scene, source: SceneSource) -> Result<(), Failure> {
    let built = match build::<T>(scene, &source) {
        Ok(built) => built,
        Err(diagnostics) => return Err(Failure::rejected(Rejected { source, diagnostics })),
    };
    let Built { setup, subject, body_solvers, looks, links, particles } = built;
    let cast = Cast::of(scene, looks, links, particles.as_ref());
    let out = options.out.clone().unwrap_or_else(|| Path::new("out").join(scene_name(&options.scene)));
    // Before the run: a directory that cannot be made should not cost a simulation.
    std::fs::create_dir_all(&out).map_err(|source| WriteError { path: out.clone(), source })?;
    let bodies = rigid::Motion::mixed(subject, &setup.bodies, &body_solvers);
    let mut world = World::new(setup, bodies.map_err(|reason| Failure::input(reason.to_string()))?);
    if let Some(particles) = particles {
        let solver = SolverPlan::of(scene).of_particles(plan::interval_s(scene));
        let mut motion = particles
            .motion(&solver, scene.dt_s.as_ref().map(|dt| *dt.get_ref()))
            .map_err(|reason| Failure::input(reason.to_string()))?;
        bearable(&motion, plan::steps(scene))?;
        motion.stop_at(*scene.duration_s.get_ref());
        world = world.with_particles(motion);
    }
    let bar = progress(options.quiet, plan::steps(scene));
    let started = Instant::now();
    let mut record = Record::default();
    let (steps, outcome) = simulate(&mut world, &mut record, scene, &bar);
    let wall_s = started.elapsed().as_secs_f64();
    bar.finish_and_clear();
    let failure = outcome.err().map(|error| explain(&error, &world, &cast));
    let summary = summarise(options, scene, &source, &cast, &world, &record, steps, wall_s, failure.clone());
    write_files(&out, &cast, &record, &summary)?;
    if !options.quiet {
        super::print(&table::table(&summary, &out))?;
    }
    match failure {
        Some(reason) => Err(Failure::run(format!("{reason}\nwhat was recorded until then is in {}", out.display()))),
        None => Ok(()),
    }
}

/// Substeps count as steps.
fn bearable<T: Real>(motion: &Motion<T>, steps: u64) -> Result<(), Failure> {
    #[expect(clippy::cast_precision_loss, reason = "a limit")]
    let all = motion.substeps().map_or(0.0, |substeps| substeps as f64 * steps as f64);
    if all <= MAX_STEPS {
        return Ok(());
    }
    Err(Failure::input(format!(
        "sweeps would take {all:.1e} substeps, more than {MAX_STEPS:.0e}: allow a larger `solver.violation`, give \
         `solver.substeps`, or set `solver.constraints = \"direct\"`"
    )))
}

/// The name of a scene: its file's, without the extension.
pub(super) fn scene_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned())
}

fn progress(quiet: bool, steps: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(
        Some(steps),
        if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() },
    );
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {pos}/{len} steps  {eta} left") {
        bar.set_style(style);
    }
    bar
}

/// Makes all steps; returns how many, and how it ended. The times are multiples of dt, so that they do not drift.
fn simulate<T: Real>(
    world: &mut World<T>,
    record: &mut Record,
    scene: &Scene,
    bar: &ProgressBar,
) -> (u64, Result<(), SimulationError>) {
    let (dt_s, duration_s) = (plan::interval_s(scene), *scene.duration_s.get_ref());
    let interval_s = plan::record_hz(scene).map_or(0.0, |hz| 1.0 / hz);
    let steps = plan::steps(scene);
    let mut frames = 1_u64;
    record.observe(world, true);
    for step in 1..=steps {
        #[expect(clippy::cast_precision_loss, reason = "steps are at most MAX_STEPS, far below 2^53")]
        let end_s = if step == steps { duration_s } else { step as f64 * dt_s };
        let mut events: Vec<Event> = Vec::new();
        let outcome = world.advance_to(end_s, &mut events);
        record.events.append(&mut events);
        // A frame is due at each multiple of the interval; the rounding of two products must not push it a step on.
        #[expect(clippy::cast_precision_loss, reason = "as above")]
        let due = end_s * (1.0 + 4.0 * f64::EPSILON) >= frames as f64 * interval_s;
        frames += u64::from(due);
        record.observe(world, due || step == steps || outcome.is_err());
        if let Err(error) = outcome {
            return (step - 1, Err(error));
        }
        bar.inc(1);
    }
    (steps, Ok(()))
}

#[expect(clippy::too_many_arguments, reason = "a summary is made of everything there is")]
fn summarise<T: Real>(
    options: &Options,
    scene: &Scene,
    source: &SceneSource,
    cast: &Cast,
    world: &World<T>,
    record: &Record,
    steps: u64,
    wall_s: f64,
    failure: Option<String>,
) -> Summary {
    let conserved = Conserved::of(scene, cast.links(), record);
    let drifts = record.drifts();
    Summary {
        scene: scene_name(&options.scene),
        bodies: scene.body.len(),
        particles: cast.particles.len(),
        steps,
        events: record.events.len(),
        sim_s: world.time_s(),
        wall_s,
        real_time_factor: world.time_s() / wall_s,
        energy_drift_rel: drifts.energy.filter(|_| conserved.energy),
        momentum_drift_rel: drifts.momentum.filter(|_| conserved.momentum),
        angular_momentum_drift_rel: drifts.angular_momentum.filter(|_| conserved.angular_momentum),
        max_penetration_m: record.max_penetration(),
        max_violation_m: record.max_violation(),
        max_distortion: record.max_distortion(),
        body_work: (!scene.body.is_empty()).then(|| body_work(scene, world)),
        particle_work: world.particles().map(particle_work),
        state_bytes_per_body: plan::state_bytes_per_body(&BodySolverPlan::of(scene), scene.solver.scalar),
        state_bytes_per_particle: Particles::<T>::bytes_per_particle(),
        state_hash: format!(
            "{:016x}",
            state_hash(world.bodies(), world.particles().map_or(&Particles::default(), Motion::state))
        ),
        failure,
        settings: Settings {
            duration_s: *scene.duration_s.get_ref(),
            dt_s: scene.dt_s.as_ref().map(|dt| *dt.get_ref()),
            record_hz: plan::record_hz(scene),
            formulation: scene.formulation.get_ref().name().into(),
            scalar: if size_of::<T>() == size_of::<f64>() { "f64".into() } else { "f32".into() },
            body_solvers: body_settings(scene),
            particle_solver: (!cast.particles.is_empty()).then(|| particle_settings(&SolverPlan::of(scene))),
            gravity_m_s2: scene.gravity_m_s2.get_ref().0,
            restitution: *scene.contact.restitution.get_ref(),
            overrides: source.overrides().to_vec(),
        },
    }
}

fn body_work<T: Real>(scene: &Scene, world: &World<T>) -> BodyWork {
    let (work, solvers) = (world.motion().work(), BodySolverPlan::of(scene));
    BodyWork {
        joints: solvers.iter().map(|solver| solver.joints).sum(),
        joint_rows: solvers.iter().map(|solver| solver.joint_rows).sum(),
        redundant_rows: world.motion().redundant(),
        asked_violation_m: world.motion().asked_violation_m(),
        redirected_drifts: world.motion().redirected(),
        rhs_evals: work.rhs_evals,
        accepted_steps: work.accepted,
        rejected_steps: work.rejected,
    }
}

fn body_settings(scene: &Scene) -> Vec<BodySettings> {
    let settings = |solver: BodySolverPlan| BodySettings {
        formulation: solver.formulation.name().into(),
        bodies: solver.bodies,
        method: solver.method.name().into(),
        step_s: (!solver.is_exact() && !solver.adaptive).then(|| plan::interval_s(scene)),
        rtol: solver.adaptive.then_some(solver.rtol),
        atol: solver.adaptive.then_some(solver.atol),
        state_bytes_per_body: solver.state_bytes_per_body,
    };
    BodySolverPlan::of(scene).into_iter().map(settings).collect()
}

fn particle_work<T: Real>(motion: &Motion<T>) -> ParticleWork {
    let work = motion.work();
    ParticleWork {
        constraints: motion.system().setup().constraints.len(),
        redundant_constraints: motion.system().redundant(),
        asked_violation_m: motion.system().asked_violation_m(),
        substeps: motion.substeps(),
        rhs_evals: work.rhs_evals,
        accepted_steps: work.accepted,
        rejected_steps: work.rejected,
    }
}

fn particle_settings(solver: &SolverPlan) -> ParticleSettings {
    let adaptive = |tolerance: f64| solver.adaptive.then_some(tolerance);
    ParticleSettings {
        method: solver.method.name().into(),
        rtol: adaptive(solver.rtol),
        atol: adaptive(solver.atol),
        constraints: solver.constraints.name().into(),
        stabilisation: solver.stabilisation.name().into(),
        violation: solver.violation,
        substeps: solver.substeps.filter(|_| solver.method == Method::Xpbd),
    }
}

fn write_files(out: &Path, cast: &Cast, record: &Record, summary: &Summary) -> Result<(), WriteError> {
    // The summary of an earlier run must not stand beside the tables of this one, if this one is killed in between.
    match std::fs::remove_file(out.join("summary.json")) {
        Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
            return Err(WriteError { path: out.join("summary.json"), source });
        }
        _ => {}
    }
    write_whole(&out.join("trajectory.csv"), |file| tables::trajectory(file, &cast.names(), &record.frames))?;
    write_whole(&out.join("energy.csv"), |file| tables::energy(file, &record.energies))?;
    write_whole(&out.join("events.csv"), |file| tables::events(file, &cast.bodies, &record.events))?;
    let page = html::render(&playback(&summary.scene, cast, record));
    write_whole(&out.join("run.html"), |file| file.write_all(page.as_bytes()))?;
    // Last: a summary says that all the files are there.
    write_whole(&out.join("summary.json"), |file| summary::write(file, summary))
}
