//! Names as a text of the CASAS homes has them, where blanks part what is in a line.

/// A name without blanks; where it has some, each word begins with a capital.
pub fn one_word(name: &str) -> String {
    let words: Vec<&str> =
        name.split(|c: char| c.is_whitespace() || c.is_control()).filter(|w| !w.is_empty()).collect();
    match words[..] {
        [] => "_".into(),
        [word] => word.into(),
        _ => words.into_iter().map(capitalised).collect(),
    }
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_one_word() {
        for (name, word) in [
            ("bedroom motion", "BedroomMotion"),
            ("M001", "M001"),
            ("a\tb\nc", "ABC"),
            (" door ", "door"),
            ("über bett", "ÜberBett"),
            (" ", "_"),
        ] {
            assert_eq!(one_word(name), word);
        }
    }
}
