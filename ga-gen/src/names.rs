//! What to say about a name that does not exist.

/// Names farther than a third of their length, in edits, are no help.
const NEAR: usize = 3;

/// The known name that is nearest to a given one, if it is near.
#[must_use]
pub(crate) fn closest<'a>(name: &str, known: &'a [String]) -> Option<&'a str> {
    let lower = name.to_lowercase();
    let distance = |other: &str| strsim::osa_distance(&lower, &other.to_lowercase());
    let nearest = known.iter().min_by_key(|other| distance(other))?;
    (distance(nearest) <= name.chars().count().div_ceil(NEAR)).then_some(nearest)
}

/// The fault, with the nearest name, and all of them.
#[must_use]
pub(crate) fn unknown(fault: &str, name: &str, known: &[String]) -> String {
    let near = closest(name, known).map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
    let all = if known.is_empty() { String::new() } else { format!(" There are {}", known.join(", ")) };
    match (near.is_empty(), all.is_empty()) {
        (true, true) => fault.into(),
        (true, false) => format!("{fault}; there are {}", known.join(", ")),
        (false, _) => format!("{fault}{near}{all}"),
    }
}
