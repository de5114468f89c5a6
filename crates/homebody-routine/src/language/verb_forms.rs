//! Regular forms of English verbs.

/// "watches" of "watch".
pub fn third_person(verb: &str) -> String {
    let consonant_y = verb.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u']));
    match verb {
        "have" => "has".into(),
        "be" => "is".into(),
        _ if consonant_y.is_some() => format!("{}ies", consonant_y.unwrap_or_default()),
        _ if ["s", "sh", "ch", "x", "o", "z"].iter().any(|end| verb.ends_with(end)) => format!("{verb}es"),
        _ => format!("{verb}s"),
    }
}

/// "watching" of "watch".
pub fn gerund(verb: &str) -> String {
    match verb {
        "lie" => "lying".into(),
        _ if is_doubled(verb) => format!("{verb}{}ing", &verb[verb.len() - 1..]),
        _ => match verb.strip_suffix('e') {
            Some(stem) if !stem.ends_with(['e', 'i', 'o']) => format!("{stem}ing"),
            _ => format!("{verb}ing"),
        },
    }
}

/// "watched" of "watch".
pub fn regular(verb: &str) -> String {
    match verb.strip_suffix('y').filter(|stem| !stem.ends_with(['a', 'e', 'o', 'u'])) {
        Some(stem) => format!("{stem}ied"),
        None if verb.ends_with('e') => format!("{verb}d"),
        None if is_doubled(verb) => format!("{verb}{}ed", &verb[verb.len() - 1..]),
        None => format!("{verb}ed"),
    }
}

fn is_doubled(verb: &str) -> bool {
    let is_vowel = |c: &char| "aeiou".contains(*c);
    let letters: Vec<char> = verb.chars().collect();
    let vowels = letters.iter().filter(|c| is_vowel(c)).count();
    match letters.as_slice() {
        [.., before, last] => {
            verb.is_ascii() && vowels == 1 && is_vowel(before) && !is_vowel(last) && !"wxy".contains(*last)
        }
        _ => false,
    }
}
