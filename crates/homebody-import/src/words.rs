//! The words that names are made of, in any of the ways in which people and catalogues join them, and known ones among them.

/// The words of some names, in small letters: `eTeks#bedsideTable` has `e`, `teks`, `bedside` and `table`.
pub fn words(names: &[&str]) -> Vec<String> {
    let mut words = Vec::new();
    for name in names {
        let (mut word, mut was_small) = (String::new(), false);
        for c in name.chars() {
            if !c.is_alphabetic() || c.is_uppercase() && was_small {
                words.push(std::mem::take(&mut word));
            }
            was_small = c.is_lowercase();
            word.extend(c.is_alphabetic().then_some(c).into_iter().flat_map(char::to_lowercase));
        }
        words.push(word);
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Whether any of some known words, with blanks between, is among the words.
///
/// `a+b` asks for both of two; `-bett` is also the end of a longer word, as in `Doppelbett`. Words in scripts without blanks
/// may stand anywhere in another. An English plural is its singular, too.
pub fn has_any(words: &[String], known: &str) -> bool {
    let has = |known: &str| words.iter().any(|word| is_word(word, known));
    known.split_whitespace().any(|known| known.split('+').all(has))
}

fn is_word(word: &str, known: &str) -> bool {
    /// Where the scripts begin that put no blanks between words: Chinese and Japanese.
    const WITHOUT_BLANKS: char = '\u{2e80}';
    match known.strip_prefix('-') {
        Some(end) => word.ends_with(end),
        None if known.starts_with(|c| c >= WITHOUT_BLANKS) => word.contains(known),
        None => word == known || word.strip_suffix('s') == Some(known),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_words_are_found_in_the_ways_of_languages() {
        let has = |name: &str, known: &str| has_any(&words(&[name]), known);
        assert!(has("Washing machine", "washer washing+machine") && !has("Coffee machine", "washer washing+machine"));
        assert!(has("Doppelbett 180", "bed -bett") && !has("Bettkasten", "bed -bett"));
        assert!(has("双人床", "床") && has("Chairs", "chair") && !has("Chairman", "chair"));
    }

    #[test]
    fn words_end_where_capitals_and_signs_are() {
        assert_eq!(words(&["eTeks#bedsideTable"]), ["e", "teks", "bedside", "table"]);
        assert_eq!(words(&["Bed 140x190", "Scopia#child_chair"]), ["bed", "x", "scopia", "child", "chair"]);
        assert_eq!(words(&["Fenêtre", "WC"]), ["fenêtre", "wc"]);
        assert!(words(&["", " 12 "]).is_empty());
    }
}
