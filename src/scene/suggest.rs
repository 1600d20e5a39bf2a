//! "Did you mean": the closest of the possible names to one that does not exist.

/// The candidate closest to `name` in Damerau-Levenshtein distance, ignoring case, if it is close.
///
/// Close means at most a third of the characters differ (one in a name of up to five): looser, and
/// short names suggest unrelated ones (`box` for `fox`, but not for `cat`); tighter, and two
/// slips in a long key like `inertia_kgm^2` go unhelped. A name that is the beginning of one
/// candidate only (`mass` of `mass_kg`, the forgotten unit) suggests that one.
pub(crate) fn closest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = name.to_lowercase();
    let candidates: Vec<&str> = candidates.into_iter().collect();
    let allowed = (name.chars().count() / 3).max(1);
    let near = candidates
        .iter()
        .map(|&candidate| (strsim::damerau_levenshtein(&name, &candidate.to_lowercase()), candidate))
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate);
    near.or_else(|| {
        let mut begun = candidates.into_iter().filter(|c| !name.is_empty() && c.starts_with(&name));
        begun.next().filter(|_| begun.next().is_none())
    })
}

/// Quotes and joins names: `` `a`, `b`, `c` ``.
pub(crate) fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}
