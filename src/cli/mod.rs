//! The command line: arguments to one of the commands; exit codes.
//!
//! 0: done. 1: the run failed (what, when, what is kept). 2: the user's input is wrong.

mod conserved;
mod explain;
pub mod mesh;
mod playback;
mod run;
mod table;

use crate::io::files::WriteError;
use crate::scene::description::Scalar;
use crate::scene::{self, Rejected, plan, stderr_wants_colour};
use crate::study;
use clap::{Parser, Subcommand, ValueEnum};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Simulates rigid bodies with geometric algebra, and studies what that costs.
#[derive(Debug, Parser)]
#[command(version, about, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Simulate a scene and write its files: run.html to look at, CSV tables, a summary.
    Run {
        /// The scene, a TOML file.
        scene: PathBuf,
        /// Directory for the files [default: out/<scene>].
        #[arg(long)]
        out: Option<PathBuf>,
        /// Override a value of the scene, e.g. `dt_s=0.001`, `body.cube.mass_kg=2`; may be repeated.
        #[arg(long = "set", value_name = "PATH=VALUE")]
        sets: Vec<String>,
        /// Print nothing but errors.
        #[arg(long)]
        quiet: bool,
    },
    /// Say what a scene needs: what is modelled, what is left out and why, what it costs.
    Plan {
        /// The scene, a TOML file.
        scene: PathBuf,
        /// Override a value of the scene; may be repeated.
        #[arg(long = "set", value_name = "PATH=VALUE")]
        sets: Vec<String>,
        /// As JSON.
        #[arg(long)]
        json: bool,
    },
    /// Check a scene, with its meshes, without running it.
    Check {
        /// The scene, a TOML file.
        scene: PathBuf,
        /// Override a value of the scene; may be repeated.
        #[arg(long = "set", value_name = "PATH=VALUE")]
        sets: Vec<String>,
    },
    /// Print the JSON schema of scenes, for editors.
    Schema,
    /// Examine a mesh (OBJ, STL): is it a solid, its volume, centre, inertia, principal axes, enclosing sphere.
    Mesh {
        /// The mesh file.
        file: PathBuf,
        /// As JSON.
        #[arg(long)]
        json: bool,
        /// Keep the mass properties in FILE.mass.toml, which scenes use while the mesh is unchanged.
        #[arg(long)]
        save: bool,
    },
    /// Measure: `kernels` compares generated types with the dynamic multivector and with vector code, `solvers` what an
    /// error costs by which integrator, `formulations` rigid bodies as matrices, quaternions, rotors and motors.
    Study {
        /// Which studies [default: all].
        names: Vec<Study>,
        /// Seconds instead of minutes; wider spreads, fewer settings.
        #[arg(long)]
        quick: bool,
        /// Directory for the reports.
        #[arg(long, default_value = "out/study")]
        out: PathBuf,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Study {
    Kernels,
    Solvers,
    Formulations,
}

/// Why a command ends with a code other than 0.
#[derive(Debug)]
pub struct Failure {
    code: u8,
    message: String,
}

impl Failure {
    fn rejected(rejected: Rejected) -> Self {
        Self { code: 2, message: rejected.render(stderr_wants_colour()) }
    }

    fn input(message: String) -> Self {
        Self { code: 2, message: format!("error: {message}") }
    }

    fn run(message: String) -> Self {
        Self { code: 1, message: format!("error: {message}") }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        Self::run(error.to_string())
    }
}

/// Runs the command that the arguments name.
#[must_use]
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match dispatch(arguments.command) {
        Ok(code) => ExitCode::from(code),
        Err(failure) => {
            // Where standard error is closed, the exit code still says what happened.
            let _ = writeln!(std::io::stderr(), "{}", failure.message);
            ExitCode::from(failure.code)
        }
    }
}

fn dispatch(command: Command) -> Result<u8, Failure> {
    match command {
        Command::Run { scene, out, sets, quiet } => run::run(&run::Options { scene, out, sets, quiet }).map(|()| 0),
        Command::Plan { scene, sets, json } => print_plan(&scene, &sets, json).map(|()| 0),
        Command::Check { scene, sets } => check(&scene, &sets).map(|()| 0),
        Command::Schema => print(&scene::schema()).map(|()| 0),
        Command::Mesh { file, json, save } => {
            let mut text = Vec::new();
            let code = mesh::run(&mesh::Options { file, json, save }, &mut text)
                .map_err(|error| Failure::input(format!("{error:#}")))?;
            print(&String::from_utf8_lossy(&text))?;
            Ok(code)
        }
        Command::Study { names, quick, out } => study(&names, quick, &out).map(|()| 0),
    }
}

/// Prints to standard output. A reader that closes the pipe early, such as `head`, is no failure.
fn print(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    let written =
        out.write_all(text.as_bytes()).and_then(|()| if text.ends_with('\n') { Ok(()) } else { writeln!(out) });
    match written {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::run(format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

fn print_plan(path: &Path, sets: &[String], json: bool) -> Result<(), Failure> {
    let (scene, _) = scene::load(path, sets).map_err(Failure::rejected)?;
    let plan = plan::plan(&scene);
    if json {
        let text = serde_json::to_string_pretty(&plan).map_err(|error| Failure::run(error.to_string()))?;
        return print(&text);
    }
    print(&plan.to_string())
}

fn check(path: &Path, sets: &[String]) -> Result<(), Failure> {
    let (scene, source) = scene::load(path, sets).map_err(Failure::rejected)?;
    let built = match scene.solver.scalar {
        Scalar::F64 => scene::build::build::<f64>(&scene, &source).map(|built| built.particle_count()),
        Scalar::F32 => scene::build::build::<f32>(&scene, &source).map(|built| built.particle_count()),
    };
    let particles = built.map_err(|diagnostics| Failure::rejected(Rejected { source, diagnostics }))?;
    let particles = if particles == 0 { String::new() } else { format!("{particles} particles, ") };
    print(&format!("{}: {} bodies, {particles}nothing wrong", path.display(), scene.body.len()))
}

fn study(names: &[Study], quick: bool, out: &Path) -> Result<(), Failure> {
    let mut progress = |line: &str| eprintln!("{line}");
    let chosen = |study: &&Study| names.is_empty() || names.contains(study);
    for study in Study::value_variants().iter().filter(chosen) {
        let text = match study {
            Study::Kernels => study::kernels::run(quick, out, &mut progress).map(|report| report.text()),
            Study::Solvers => study::solvers::run(quick, out, &mut progress).map(|report| report.text()),
            Study::Formulations => study::formulations::run(quick, out, &mut progress).map(|report| report.text()),
        };
        print(&text.map_err(|error| Failure::run(error.to_string()))?)?;
    }
    Ok(())
}
