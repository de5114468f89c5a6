//! The known name that someone probably meant.

/// The known name most like this one, if any is like enough.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let folded = name.trim().to_lowercase();
    let allowed = (folded.chars().count() / 3).max(1);
    let distance = |known: &str| {
        let known = known.to_lowercase();
        // `height` for `height_m` is a unit forgotten, not many letters wrong.
        let begins = folded.chars().count() >= 2 && known.strip_prefix(&folded).is_some_and(|r| r.starts_with('_'));
        if begins { 1 } else { strsim::damerau_levenshtein(&folded, &known) }
    };
    let known = known.into_iter().map(|known| (distance(known), known));
    known.filter(|(distance, _)| *distance <= allowed).min_by_key(|(distance, _)| *distance).map(|(_, known)| known)
}
