//! Multivectors as text: `0.7071 - 0.7071 e12`. A precision holds for every number (`{:.4}`); a width does not apply.

use crate::algebra::Scalar;
use core::fmt::{self, Write};

/// A sum of blades: what is constant first, then every number that is not 0 with the name of its blade; `0` if nothing
/// is left.
///
/// # Errors
/// That of the output.
pub fn terms<T: Scalar + PartialEq + fmt::Display>(
    f: &mut fmt::Formatter<'_>,
    constants: &str,
    numbers: &[(T, &str)],
) -> fmt::Result {
    f.write_str(constants)?;
    let mut is_first = constants.is_empty();
    for (value, blade) in numbers.iter().filter(|(value, _)| *value != T::ratio(0, 1)) {
        number(&mut Signed { out: f, is_first, is_start: true }, value)?;
        if *blade != "s" {
            write!(f, " {blade}")?;
        }
        is_first = false;
    }
    if is_first { f.write_str("0") } else { Ok(()) }
}

/// Numbers by name, for types with coefficients that follow from others: `x = 1, y = 2, z = 3`.
///
/// # Errors
/// That of the output.
pub fn named<T: Scalar + fmt::Display>(
    f: &mut fmt::Formatter<'_>,
    _constants: &str,
    numbers: &[(T, &str)],
) -> fmt::Result {
    for (index, (value, name)) in numbers.iter().enumerate() {
        let separator = if index == 0 { "" } else { ", " };
        write!(f, "{separator}{name} = ")?;
        number(&mut Signed { out: f, is_first: true, is_start: true }, value)?;
    }
    Ok(())
}

fn number<T: fmt::Display>(signed: &mut Signed<'_, '_>, value: &T) -> fmt::Result {
    match signed.out.precision() {
        Some(precision) => write!(signed, "{value:.precision$}"),
        None => write!(signed, "{value}"),
    }
}

/// Sets the sign of a number apart as the operator between two terms. It reads the text, because scalars need no order.
struct Signed<'a, 'f> {
    out: &'a mut fmt::Formatter<'f>,
    is_first: bool,
    is_start: bool,
}

impl Write for Signed<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        if !self.is_start || text.is_empty() {
            return self.out.write_str(text);
        }
        self.is_start = false;
        let magnitude = text.strip_prefix('-');
        self.out.write_str(match (self.is_first, magnitude.is_some()) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        })?;
        self.out.write_str(magnitude.unwrap_or(text))
    }
}
