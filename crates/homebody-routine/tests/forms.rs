//! Every form of sentence with its meaning.
//!
//! `forms.txt` holds sentences, each with the routine in short below it. `HOMEBODY_REWRITE=1` regenerates it.

#![allow(clippy::disallowed_methods, reason = "a test may read and write files; the crate may not")]

use crate::generated::is_generated;
use crate::home::{short, understood};
use std::fs;
use std::path::Path;

#[test]
fn every_form_of_sentence_has_its_listed_meaning() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/forms.txt");
    let table = fs::read_to_string(&path).unwrap();
    let mut found = String::new();
    for line in table.lines().filter(|line| !line.starts_with("    ")) {
        found += line;
        found += "\n";
        if !line.is_empty() && !line.starts_with('#') {
            // The meaning of accompanying sentences is left out.
            let text = line.replace(" | ", "\n");
            found += &format!("    {}\n", understood_alone(&text));
        }
    }
    is_generated("crates/homebody-routine/tests/forms.txt", &found);
}

/// Adds the sentences that a sentence refers to.
fn understood_alone(text: &str) -> String {
    const OTHERS: &str = "\
she gets up at 06:45
she prepares breakfast, then eats
she eats lunch
she eats dinner
she takes a shower
she takes her pills
she watches television
she does the laundry
she leaves the apartment for 1 to 12 hours
";
    let needs_others =
        ["after", "before", "with", "henever", "If", "home", "during", "while", "over breakfast", "at breakfast"]
            .iter()
            .any(|word| text.contains(word));
    if !needs_others {
        return short(&understood(text));
    }
    let all = short(&understood(&format!("{OTHERS}{text}")));
    let others = short(&understood(OTHERS));
    all.replacen(&format!("{others} & "), "", 1)
}
