//! The words of names, however people and catalogues join them.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_end_where_capitals_and_signs_are() {
        assert_eq!(words(&["eTeks#bedsideTable"]), ["e", "teks", "bedside", "table"]);
        assert_eq!(words(&["Bed 140x190", "Scopia#child_chair"]), ["bed", "x", "scopia", "child", "chair"]);
        assert_eq!(words(&["Fenêtre", "WC"]), ["fenêtre", "wc"]);
        assert!(words(&["", " 12 "]).is_empty());
    }
}
