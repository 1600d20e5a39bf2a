//! Shows what `algebra!` and `#[formula]` generate: `ga-inspect [--algebra FILE] FILE [ITEM]`.

use std::path::PathBuf;
use std::process::ExitCode;

const USAGE: &str = "\
usage: ga-inspect [--algebra FILE] FILE [ITEM]

FILE holds `algebra!` or `#[formula]`. Without ITEM: the basis products and types of the algebra, and all items and
formulas with their cost. With ITEM: operands, formula, operation counts and generated Rust. Items are named like
  'Rotor*Rotor'  'Point^Point'  'Plane|Line'  'Plane&Line'  'Motor.apply(Point)'  Line.dual  Rotor.rev
  Even.grade2  'Round::from(Point)'  circumsphere
The algebra of a formula, and one that another extends, is looked for by its name: in FILE, in a sibling named for it,
then in --algebra FILE.";

struct Arguments {
    file: PathBuf,
    item: Option<String>,
    algebra: Option<PathBuf>,
}

fn arguments() -> Option<Arguments> {
    let (mut positional, mut algebra) = (Vec::new(), None);
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--algebra" => algebra = Some(words.next()?.into()),
            _ if word.starts_with('-') => return None,
            _ => positional.push(word),
        }
    }
    let mut positional = positional.into_iter();
    let arguments = Arguments { file: positional.next()?.into(), item: positional.next(), algebra };
    positional.next().is_none().then_some(arguments)
}

fn main() -> ExitCode {
    if std::env::args().any(|word| word == "--help" || word == "-h") {
        println!("{USAGE}");
        return ExitCode::SUCCESS;
    }
    let Some(arguments) = arguments() else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    match text(&arguments) {
        Ok(text) => {
            use std::io::Write;
            // A reader that closes the pipe early, such as `head`, is no failure.
            let _ = std::io::stdout().write_all(text.as_bytes());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn text(arguments: &Arguments) -> Result<String, ga_gen::inspect::InspectError> {
    let inspected = ga_gen::inspect::load(&arguments.file, arguments.algebra.as_deref())?;
    match &arguments.item {
        Some(item) => ga_gen::inspect::item_text(&inspected, item, &arguments.file),
        None => ga_gen::inspect::overview(&inspected)
            .map_err(|error| ga_gen::inspect::InspectError::Syntax(arguments.file.clone(), error)),
    }
}
