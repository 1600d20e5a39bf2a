//! Shows what `algebra!` and `#[formula]` generate: `ga-inspect [options] FILE [ITEM]`.

use ga_gen::inspect::{self, Format, InspectError};
use ga_gen::ledger;
use std::path::PathBuf;
use std::process::ExitCode;

const USAGE: &str = "\
usage: ga-inspect [--algebra FILE] [--format text|markdown|latex] [--blades] FILE [ITEM]
       ga-inspect [--algebra FILE] --ledger FILE

FILE holds `algebra!` or `#[formula]`. Without ITEM: the basis products and types of the algebra, and all items and
formulas with their cost. With ITEM: operands, products of their blades, formula, the other ways to compute it with their
cost, the program before and after each pass, generated Rust. Items are named like
  'Rotor*Rotor'  'Point^Point'  'Plane|Line'  'Plane&Line'  'Motor.apply(Point)'  Line.dual  Rotor.rev
  Even.grade2  'Round::from(Point)'  circumsphere

  --algebra FILE  where to look for the algebra of a formula, or one that another extends, after FILE and a sibling
                  named for it
  --format NAME   text (the default), markdown, or latex: a document that needs amsmath and longtable
  --blades        products of all basis blades: of the algebra, or of the operands however many they have
  --ledger        the cost of all items and formulas as a table with tabs";

#[derive(Default)]
struct Arguments {
    file: PathBuf,
    item: Option<String>,
    algebra: Option<PathBuf>,
    format: Format,
    blades: bool,
    ledger: bool,
}

fn arguments() -> Option<Arguments> {
    let mut arguments = Arguments::default();
    let mut positional = Vec::new();
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--algebra" => arguments.algebra = Some(words.next()?.into()),
            "--format" => arguments.format = Format::named(&words.next()?)?,
            "--blades" => arguments.blades = true,
            "--ledger" => arguments.ledger = true,
            _ if word.starts_with('-') => return None,
            _ => positional.push(word),
        }
    }
    let mut positional = positional.into_iter();
    arguments.file = positional.next()?.into();
    arguments.item = positional.next();
    // A ledger is of a whole file, in one format.
    let alone = arguments.item.is_none() && !arguments.blades && arguments.format == Format::default();
    (positional.next().is_none() && (!arguments.ledger || alone)).then_some(arguments)
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

fn text(arguments: &Arguments) -> Result<String, InspectError> {
    let inspected = inspect::load(&arguments.file, arguments.algebra.as_deref())?;
    let fault = |error| InspectError::Syntax(arguments.file.clone(), error);
    if arguments.ledger {
        return Ok(ledger::text(&ledger::rows(&inspected).map_err(fault)?));
    }
    let document = match &arguments.item {
        Some(item) => inspect::item(&inspected, item, &arguments.file, arguments.blades)?,
        None => inspect::overview(&inspected, arguments.blades).map_err(fault)?,
    };
    Ok(document.print(arguments.format))
}
