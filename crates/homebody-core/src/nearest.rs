//! The known name that someone probably meant.

use crate::problem::Advice;

/// Number of characters above which no similar name is searched (our choice): a longer name is rarely mistyped by a
/// letter or two, and each comparison takes the square of the length.
const LONGEST_CHARS: usize = 40;

/// The known name most like this one, if any is like enough.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let is_short = |name: &str| name.len() <= 4 * LONGEST_CHARS && name.chars().count() <= LONGEST_CHARS;
    if !is_short(name) {
        return None;
    }
    let folded = name.trim().to_lowercase();
    let allowed = (folded.chars().count() / 3).max(1);
    let distance = |known: &str| {
        let known = known.to_lowercase();
        // `height` for `height_m` is a unit forgotten, not many letters wrong.
        let begins = folded.chars().count() >= 2 && known.strip_prefix(&folded).is_some_and(|r| r.starts_with('_'));
        if begins {
            return 1;
        }
        // The distance is at least the difference of the lengths.
        match known.chars().count().abs_diff(folded.chars().count()) {
            off if off > allowed => off,
            _ => strsim::damerau_levenshtein(&folded, &known),
        }
    };
    let known = known.into_iter().filter(|known| is_short(known)).map(|known| (distance(known), known));
    known.filter(|(distance, _)| *distance <= allowed).min_by_key(|(distance, _)| *distance).map(|(_, known)| known)
}

/// A hint shows at most this many known names (our choice).
const MOST_SHOWN: usize = 12;

/// The hint for an unknown name: the nearest known name, or some of the known names. `None` without known names.
pub fn suggestion(nearest: &Option<String>, known: &[String]) -> Option<Advice> {
    let few = &known[..known.len().min(MOST_SHOWN)];
    let more = if few.len() < known.len() { ", ..." } else { "" };
    match nearest {
        Some(near) => Some(Advice::meant(near)),
        None => (!known.is_empty()).then(|| format!("the known names are {}{more}", quoted(few)).into()),
    }
}

pub(super) fn quoted(names: &[String]) -> String {
    names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
}

/// Each name once, up to one more than a hint shows.
pub fn some_names<'a>(known: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut some: Vec<String> = Vec::new();
    for name in known {
        if some.len() > MOST_SHOWN {
            break;
        }
        if !some.iter().any(|other| other == name) {
            some.push(name.to_owned());
        }
    }
    some
}
