//! The `ga-physics` command; see `ga_physics::cli`.

fn main() -> std::process::ExitCode {
    ga_physics::cli::main()
}
