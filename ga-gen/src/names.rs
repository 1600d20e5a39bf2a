//! What to say about a name that does not exist.

/// Names farther than a third of their length, in edits, are no help.
const NEAR: usize = 3;

/// The known name that is nearest to a given one, if it is near: a few edits, or one the beginning of the other.
#[must_use]
pub(crate) fn closest<'a>(name: &str, known: &'a [String]) -> Option<&'a str> {
    let lower = name.to_lowercase();
    let distance = |other: &str| strsim::osa_distance(&lower, &other.to_lowercase());
    let nearest = known.iter().min_by_key(|other| distance(other))?;
    let edits = name.chars().count().div_ceil(NEAR);
    let begins =
        |other: &&String| name.len() > 1 && other.len() > 1 && (other.starts_with(name) || name.starts_with(*other));
    let near = (distance(nearest) <= edits).then_some(nearest).or_else(|| known.iter().find(begins));
    near.map(String::as_str)
}

/// The fault, with the nearest name, or else all of them.
#[must_use]
pub(crate) fn unknown(fault: &str, name: &str, known: &[String]) -> String {
    match closest(name, known) {
        Some(near) => format!("{fault}; did you mean `{near}`?"),
        None if known.is_empty() => fault.into(),
        None => format!("{fault}; there are {}", known.join(", ")),
    }
}
