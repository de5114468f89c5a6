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
}
