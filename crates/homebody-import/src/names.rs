//! Unique names, as the check requires: it ignores case and blanks around them.

use std::collections::{BTreeMap, BTreeSet};

/// Largest number of characters of a name before its number: a home's names have at most 100.
const LONGEST: usize = 90;

#[derive(Default)]
pub struct NamePool {
    taken: BTreeSet<String>,
    last: BTreeMap<String, usize>,
}

impl NamePool {
    pub fn is_free(&self, name: &str) -> bool {
        !self.taken.contains(&name.to_lowercase())
    }

    /// A unique name: the wanted one, with a number if it is taken; without a wanted one, `kind` with a number.
    pub fn give(&mut self, wanted: &str, kind: &str) -> String {
        let wanted = clean(wanted);
        let (name, is_named) = if wanted.is_empty() { (kind.to_owned(), false) } else { (wanted, true) };
        if is_named && self.taken.insert(name.to_lowercase()) {
            return name;
        }
        let last = self.last.entry(name.to_lowercase()).or_insert(usize::from(is_named));
        loop {
            *last += 1;
            let numbered = format!("{name} {last}");
            if self.taken.insert(numbered.to_lowercase()) {
                return numbered;
            }
        }
    }
}

/// The name in one line, without characters that break a table or a terminal.
pub fn clean(name: &str) -> String {
    let plain: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let words: Vec<&str> = plain.split_whitespace().collect();
    words.join(" ").chars().take(LONGEST).collect::<String>().trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taken_and_missing_names_get_numbers() {
        let mut names = NamePool::default();
        let given = ["Chair", " chair", "chair 2", "", "\u{7}", "Chair"].map(|name| names.give(name, "piece"));
        assert_eq!(given, ["Chair", "chair 2", "chair 2 2", "piece 1", "piece 2", "Chair 3"]);
        assert!(names.give(&"long ".repeat(100), "piece").chars().count() <= LONGEST);
    }
}
