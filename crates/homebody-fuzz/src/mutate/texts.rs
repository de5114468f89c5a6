//! Names and other texts that somebody has not thought of.

use crate::dice::Dice;

const ODD: [&str; 28] = [
    "",
    " ",
    ".",
    "..",
    "../../outside",
    "/etc/passwd",
    "C:\\outside",
    "a\\b",
    "a/b",
    "a\nb",
    "a\rb",
    "\u{0}",
    "\u{1b}]0;title\u{7}",
    "=1+1",
    "+cmd|' /C calc'!A0",
    "-2",
    "@sum(1)",
    "\"; drop table firing; --",
    "'; --",
    "$(touch outside)",
    "%s%n%x",
    "<script>alert(1)</script>",
    "\u{202e}txet",
    "\u{feff}",
    "ﬀ ß İ ı",
    "e\u{301}\u{301}\u{301}",
    "CON",
    "null",
];

/// An odd text, a long one, or `text` with something odd in it.
pub fn other(text: &str, dice: &mut Dice) -> String {
    match dice.below(5) {
        0 | 1 => (*dice.one(&ODD)).to_owned(),
        2 => dice.one(&["x", "é", "a ", "\u{1f474}"]).repeat(dice.size(100_000)),
        3 => format!("{text}{}", dice.one(&ODD)),
        _ => {
            let mut chars: Vec<char> = text.chars().collect();
            let part = dice.part(chars.len());
            chars.splice(part, dice.one(&ODD).chars());
            chars.into_iter().collect()
        }
    }
}
