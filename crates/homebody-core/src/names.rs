//! The words of names, as people and programs write them.

/// The words of a name, in small letters: `MainEntryway`, `BedroomADoor` and `front door motion` all have theirs.
pub fn words(name: &str) -> Vec<String> {
    let letters: Vec<char> = name.chars().collect();
    let mut words = vec![String::new()];
    for (index, &letter) in letters.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| letters[before]);
        let after = letters.get(index + 1);
        let begins = letter.is_uppercase()
            && before.is_some_and(|before| {
                before.is_lowercase() || before.is_uppercase() && after.is_some_and(|after| after.is_lowercase())
            });
        let turns = before.is_some_and(|before| before.is_numeric() != letter.is_numeric());
        if begins || turns || !letter.is_alphanumeric() {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut().filter(|_| letter.is_alphanumeric()) {
            word.extend(letter.to_lowercase());
        }
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

/// A name as a sentence begins with it.
pub fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_words() {
        for (name, wanted) in [
            ("MainEntryway", "main entryway"),
            ("BedroomADoor", "bedroom a door"),
            ("front door motion", "front door motion"),
            ("M001", "m 001"),
            ("hall_PIR-2", "hall pir 2"),
            ("eTeks#bedsideTable", "e teks bedside table"),
            ("Bed 140x190", "bed 140 x 190"),
            ("Fenêtre", "fenêtre"),
            ("", ""),
        ] {
            assert_eq!(words(name).join(" "), wanted);
        }
    }

    #[test]
    fn known_words_are_found_in_the_ways_of_languages() {
        let has = |name: &str, known: &str| has_any(&words(name), known);
        assert!(has("Washing machine", "washer washing+machine") && !has("Coffee machine", "washer washing+machine"));
        assert!(has("Doppelbett 180", "bed -bett") && !has("Bettkasten", "bed -bett"));
        assert!(has("双人床", "床") && has("Chairs", "chair") && !has("Chairman", "chair"));
    }
}
