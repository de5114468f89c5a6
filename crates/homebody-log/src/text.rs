//! Texts for files: one word where blanks separate columns, and a `'` before formulas, which a spreadsheet would run.
//!
//! Names of sensors are untrusted text. A text that looks like a formula has a `'` before it in CSV, which spreadsheets take for "this is
//! text". A number, such as -3.5, is not a formula. Reading removes the `'` in files of any origin. A logger's `spreadsheet_safe` only
//! decides whether formulas of the log and of the truth get one; those in `sensors.csv` always do.

use std::borrow::Cow;

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

/// The first characters of formulas, and those that spreadsheets skip before one.
const BEGINS: [char; 6] = ['=', '+', '-', '@', '\t', '\r'];

/// A text as it stands in a cell of a log or a truth that is safe, or is not.
pub(crate) fn spreadsheet_cell(text: &str, is_safe: bool) -> Cow<'_, str> {
    if is_safe || is_escaped(text) { escaped(text) } else { text.into() }
}

/// A text as it stands in a cell that is safe.
pub fn escaped(text: &str) -> Cow<'_, str> {
    // A text that looks escaped is escaped once more, so that each text is read back unchanged.
    match is_formula(text) || is_escaped(text) {
        true => format!("'{text}").into(),
        false => text.into(),
    }
}

pub(crate) fn unescaped(cell: &str) -> &str {
    if is_escaped(cell) { &cell[1..] } else { cell }
}

pub(crate) fn unescaped_bytes(cell: &[u8]) -> &[u8] {
    match cell {
        [b'\'', text @ ..] if is_escaped(&String::from_utf8_lossy(cell)) => text,
        _ => cell,
    }
}

fn is_escaped(cell: &str) -> bool {
    cell.starts_with('\'') && is_formula(cell.trim_start_matches('\''))
}

fn is_formula(text: &str) -> bool {
    text.starts_with(BEGINS) && text.parse::<f64>().is_err()
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

    #[test]
    fn formulas_are_escaped_and_come_back() {
        for (text, cell) in [
            ("=1+1", "'=1+1"),
            ("+A1", "'+A1"),
            ("-cmd|' /C calc'!A0", "'-cmd|' /C calc'!A0"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("\t=1", "'\t=1"),
            ("'=1", "''=1"),
            ("''=1", "'''=1"),
            ("-3.5", "-3.5"),
            ("'tis", "'tis"),
            ("bedroom motion", "bedroom motion"),
            ("", ""),
        ] {
            assert_eq!(escaped(text), cell);
            assert_eq!(unescaped(&escaped(text)), text, "{cell}");
            assert_eq!(unescaped(&spreadsheet_cell(text, false)), text, "{cell}");
        }
    }
}
