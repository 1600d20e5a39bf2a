//! When two bodies that were apart first overlap: bisection on the overlap itself (report, 2.5.1 and Fig. 11).

/// A time span, in fractions of the step, at whose start the bodies are apart and at whose end they overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket {
    /// Apart.
    pub separated: f64,
    /// Overlapping.
    pub overlapping: f64,
}

/// Halves the step until the bracket is at most `width`, or until no number lies between its ends.
///
/// Precondition: apart at 0, overlapping at 1. Cost: `log2(1/width)` evaluations, at most 1074. The bracket holds *a*
/// change from apart to overlapping; one that is undone within the step may be missed, and with it an earlier impact.
///
/// # Errors
/// Whatever the evaluation fails with.
pub fn first_overlap<E>(width: f64, mut overlaps: impl FnMut(f64) -> Result<bool, E>) -> Result<Bracket, E> {
    let mut bracket = Bracket { separated: 0.0, overlapping: 1.0 };
    while bracket.overlapping - bracket.separated > width {
        let middle = bracket.separated + (bracket.overlapping - bracket.separated) * 0.5;
        if middle <= bracket.separated || middle >= bracket.overlapping {
            break;
        }
        if overlaps(middle)? {
            bracket.overlapping = middle;
        } else {
            bracket.separated = middle;
        }
    }
    Ok(bracket)
}
