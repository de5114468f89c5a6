//! Problems of the user's input: all at once, each with its place and a hint.

pub use crate::problems::Problems;
use serde::Serialize;
use serde_json::{Map, Value};
use std::fmt;

/// The severity of a message.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The command does not do what was asked.
    #[default]
    Error,
    /// The command continues, and its result may not be what was meant.
    Warning,
}

impl Severity {
    /// The word before a message.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
        }
    }
}

/// An error or a remark that can be shown to people and read by programs.
pub trait Diagnose {
    /// Its code, text, hint and data.
    fn diagnostic(&self) -> Diagnostic;
}

/// A message for people and programs: its code, its words, what to do, and where in a file it is about.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Diagnostic {
    /// The stable code, such as `log::exists`; `homebody explain` has more about it.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub code: &'static str,
    /// The severity.
    pub severity: Severity,
    /// The file, as the scenario names it; empty for a message about no file.
    pub file: String,
    /// Line, counted from 1; 0 for the file as a whole.
    pub line: u32,
    /// Column in characters, counted from 1; 0 for the file as a whole.
    pub column: u32,
    /// The problem.
    pub what: String,
    /// The way to solve it, such as the nearest known name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// The change that solves it, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fix: Option<Box<Fix>>,
    /// The values that the text quotes, by name.
    #[serde(skip_serializing_if = "Map::is_empty")]
    pub data: Map<String, Value>,
    /// The line of the file, where the problem is on a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub excerpt: Option<Excerpt>,
}

/// A diagnostic that a file has caused.
pub type Problem = Diagnostic;

/// A change that solves a problem. A program can offer it without reading the hint.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Fix {
    /// Replace the words or the JSON string at the place of the problem.
    Replace {
        /// The new words.
        with: String,
    },
    /// Let residents enter a piece of furniture: set its `"enterable"` to `true`.
    LetEnter {
        /// The name of the piece.
        furniture: String,
    },
    /// Add a piece to the `"furniture"` of the home.
    Add {
        /// The piece, as `home.json` has it.
        piece: Value,
        /// The room that the piece stands in.
        room: Option<String>,
    },
}

/// The way to solve a problem: the words of the hint and, where one change is enough, that change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Advice {
    /// The hint.
    pub text: String,
    /// The change.
    pub fix: Option<Box<Fix>>,
}

/// The part of a source line around a problem.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Excerpt {
    /// The text, without control characters.
    pub text: String,
    /// The number of characters of the text before the problem.
    pub before: u32,
    /// The number of characters with the problem, at least one.
    #[serde(skip_serializing_if = "is_one")]
    pub width: u32,
}

fn is_one(width: &u32) -> bool {
    *width == 1
}

/// Largest number of problems of a file in a report (our choice): a file with errors throughout would hide the others.
pub const MOST_PER_FILE: usize = 100;

/// Largest number of problems of a URL in a report (our choice): a URL has a dozen parts.
pub const MOST_PER_URL: usize = 20;

/// The words between a text and its hint.
const BEFORE_HINT: &str = "\n  hint: ";

/// Largest length of a message, in bytes (our choice). A longer one, such as one with a long quotation, is cut.
const LONGEST_MESSAGE_BYTES: usize = 600;

impl Diagnostic {
    /// A message that is about no file, with the data that it quotes.
    pub fn new(
        code: &'static str,
        severity: Severity,
        what: impl Into<String>,
        advice: Option<Advice>,
        data: Vec<(&'static str, Value)>,
    ) -> Diagnostic {
        let mut what = what.into();
        let (mut hint, fix) = advice.map_or((None, None), |Advice { text, fix }| (Some(text), fix));
        if let (None, Some(at)) = (&hint, what.find(BEFORE_HINT)) {
            hint = Some(what[at + BEFORE_HINT.len()..].to_owned());
            what.truncate(at);
        }
        let data = data.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        Diagnostic { code, severity, what, hint, fix, data, ..Diagnostic::default() }
    }

    /// A problem with a file as a whole. A hint given here takes the place of the message's own hint and fix.
    pub fn of_file(file: &str, message: impl Into<Diagnostic>, hint: Option<String>) -> Diagnostic {
        let message = message.into();
        let fix = if hint.is_some() { None } else { message.fix };
        let (what, hint) = (readable(message.what), hint.or(message.hint).map(readable));
        Diagnostic { file: file.into(), what, hint, fix, ..message }
    }

    /// The hint and the fix together.
    pub fn advice(&self) -> Option<Advice> {
        self.hint.clone().map(|text| Advice { text, fix: self.fix.clone() })
    }

    /// The hint without the words that only describe the fix.
    pub fn hint_before_fix(&self) -> Option<&str> {
        let hint = self.hint.as_deref()?;
        let Some(Fix::Add { piece, room }) = self.fix.as_deref() else { return Some(hint) };
        let rest =
            hint.strip_suffix(addition(piece, room.as_deref()).as_str()).and_then(|rest| rest.strip_suffix("; "));
        Some(rest.unwrap_or(hint))
    }

    /// The text, and the hint on a line of its own.
    pub fn text(&self) -> String {
        match &self.hint {
            Some(hint) => format!("{}{BEFORE_HINT}{hint}", self.what),
            None => self.what.clone(),
        }
    }

    /// The message as plain text with its source line and carets under the place.
    pub fn render(&self) -> String {
        let mut text = format!("{}\n", self.headline());
        if let Some(excerpt) = &self.excerpt {
            text += &format!("{:>5} | {}\n", self.line, excerpt.text);
            let (before, carets) = (" ".repeat(excerpt.before as usize), "^".repeat(excerpt.width as usize));
            text += &format!("{:>5} | {before}{carets}\n", "");
        }
        if let Some(hint) = &self.hint {
            text += &format!("  hint: {hint}\n");
        }
        text
    }

    fn headline(&self) -> String {
        format!("{}{}{}", self.position(), self.label(), self.what)
    }

    /// The file and the place in it, as they stand before a text.
    fn position(&self) -> String {
        match (self.file.as_str(), self.line) {
            ("", _) => String::new(),
            (file, 0) => format!("{file}: "),
            (file, line) => format!("{file}:{line}:{}: ", self.column),
        }
    }

    /// The severity and the code, as they stand before a text.
    pub fn label(&self) -> String {
        match self.code {
            "" => String::new(),
            code => format!("{}[{code}]: ", self.severity.word()),
        }
    }
}

impl Advice {
    /// The advice to write another name, which is nearly the one at the place of the problem.
    pub fn meant(name: &str) -> Advice {
        Advice::from(format!("did you mean {name:?}?")).with_fix(Some(Fix::Replace { with: name.to_owned() }.into()))
    }

    /// The advice to add a piece of furniture that the home lacks, in a place that is free.
    pub fn addition(piece: Value, room: Option<String>) -> Advice {
        let text = addition(&piece, room.as_deref());
        Advice::from(text).with_fix(Some(Fix::Add { piece, room }.into()))
    }

    /// The advice of a message, which may be words alone.
    pub fn from_option(advice: Option<impl Into<Advice>>) -> Option<Advice> {
        advice.map(Into::into)
    }

    /// The same words with this fix.
    pub fn with_fix(self, fix: Option<Box<Fix>>) -> Advice {
        Advice { fix, ..self }
    }

    /// The same fix with more words before its own.
    pub fn after(self, words: &str) -> Advice {
        Advice { text: format!("{words}{}", self.text), ..self }
    }
}

/// The words of the hint to add a piece of furniture to a room.
fn addition(piece: &Value, room: Option<&str>) -> String {
    let room = room.map(|room| format!(" in {room:?}")).unwrap_or_default();
    let piece = piece.to_string().replace("\":", "\": ").replace(',', ", ");
    format!("there is room{room}: add to \"furniture\" {piece}")
}

impl From<String> for Advice {
    fn from(text: String) -> Advice {
        Advice { text, fix: None }
    }
}

impl From<&str> for Advice {
    fn from(text: &str) -> Advice {
        text.to_owned().into()
    }
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// A text of a caller of the library, without a code.
impl From<String> for Diagnostic {
    fn from(what: String) -> Diagnostic {
        Diagnostic::new("", Severity::Error, what, None, Vec::new())
    }
}

impl From<&str> for Diagnostic {
    fn from(what: &str) -> Diagnostic {
        what.to_owned().into()
    }
}

impl Diagnose for Diagnostic {
    fn diagnostic(&self) -> Diagnostic {
        self.clone()
    }
}

impl std::error::Error for Diagnostic {}

impl Excerpt {
    /// The part of a line around a byte with a problem that fits next to a line number. A line may be as long as its
    /// file, so the rest of it is not read.
    pub fn around(line: &str, at: usize) -> Excerpt {
        const WIDTH: usize = 120;
        const BEFORE: usize = 80;
        /// A character has at most so many bytes.
        const WIDEST_BYTES: usize = 4;
        let at = boundary_before(line, at);
        // Blanks at the end say nothing; a line that ends further away than that is cut all the same.
        let end = boundary_before(line, at + (WIDTH + 1) * WIDEST_BYTES);
        let line = if end == line.len() { line.trim_end() } else { &line[..end] };
        let at = at.min(line.len());
        let start = match line.chars().nth(WIDTH) {
            None => 0,
            Some(_) => line[..at].char_indices().rev().nth(BEFORE - 1).map_or(0, |(start, _)| start),
        };
        let text = line[start..].chars().take(WIDTH).map(|c| if c.is_control() { ' ' } else { c }).collect();
        Excerpt { text, before: line[start..at].chars().count() as u32, width: 1 }
    }

    /// The same with a number of characters underlined, as far as they are visible.
    pub fn underlining(self, width: usize) -> Excerpt {
        let left = self.text.chars().count().saturating_sub(self.before as usize);
        Excerpt { width: width.min(left).max(1) as u32, ..self }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}{}", self.position(), self.text())
    }
}

/// The nearest place at or before a byte offset at which a character begins, or the text ends.
pub fn boundary_before(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

/// A message that may quote any input, made readable: without control characters other than line ends, and without its
/// middle if it is longer than 600 bytes.
pub fn readable(mut text: String) -> String {
    if text.contains(|c: char| c.is_control() && c != '\n') {
        text = text.chars().map(|c| if c.is_control() && c != '\n' { ' ' } else { c }).collect();
    }
    if text.len() > LONGEST_MESSAGE_BYTES {
        let (first, last) = (LONGEST_MESSAGE_BYTES / 2, text.len() - LONGEST_MESSAGE_BYTES / 3);
        text.replace_range(boundary_before(&text, first)..boundary_before(&text, last), " ... ");
    }
    text
}

/// Whether a character is invisible and a terminal may act on it: control characters, those that change the direction of a line, those
/// without width, and unusual ends of lines.
pub fn is_unseen(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(c, '\u{115f}' | '\u{1160}' | '\u{3164}' | '\u{ffa0}')
        || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// A count and its noun, such as `2 rooms`.
pub fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knows_invisible_characters() {
        for c in
            ['\u{1b}', '\u{9b}', '\u{200b}', '\u{202e}', '\u{2066}', '\u{2028}', '\u{feff}', '\u{e0041}', '\u{3164}']
        {
            assert!(is_unseen(c), "{}", c.escape_unicode());
        }
        assert!(!"Öz 好 é ‘a’ – → █ ° 👵".contains(is_unseen));
    }

    /// A message with this advice.
    fn advised(advice: Advice) -> Diagnostic {
        Diagnostic::new("door::unknown", Severity::Error, "there is no such door", Some(advice), Vec::new())
    }

    #[test]
    fn a_name_that_was_meant_is_a_hint_and_a_fix() {
        let advice = Advice::meant("front \"door\"");
        assert_eq!(advice.text, r#"did you mean "front \"door\""?"#);
        assert_eq!(advice.fix, Some(Box::new(Fix::Replace { with: "front \"door\"".into() })));
        let problem = advised(advice.clone());
        assert_eq!(problem.advice(), Some(advice.clone()));
        assert_eq!(problem.hint_before_fix(), Some(&*advice.text));
        let json = serde_json::to_value(&problem).unwrap();
        assert_eq!(json["fix"], serde_json::json!({ "kind": "replace", "with": "front \"door\"" }));
        assert!(serde_json::to_value(advised("name a door".into())).unwrap().get("fix").is_none());
    }

    #[test]
    fn another_hint_takes_the_fix_away() {
        let meant = || advised(Advice::meant("front door"));
        assert!(Diagnostic::of_file("home.json", meant(), None).fix.is_some());
        let other = Diagnostic::of_file("home.json", meant(), Some("draw a door".into()));
        assert_eq!((other.hint.as_deref(), other.fix), (Some("draw a door"), None));
    }

    #[test]
    fn separates_a_hint_from_the_piece_that_it_adds() {
        let piece = serde_json::json!({ "name": "bed", "at": [0.5, 1.5], "enterable": true });
        let advice = Advice::addition(piece.clone(), Some("hall".into())).after("add a bed; ");
        let words =
            r#"there is room in "hall": add to "furniture" {"name": "bed", "at": [0.5, 1.5], "enterable": true}"#;
        assert_eq!(advice.to_string(), format!("add a bed; {words}"));
        assert_eq!(advice.fix, Some(Box::new(Fix::Add { piece, room: Some("hall".into()) })));
        assert_eq!(advised(advice).hint_before_fix(), Some("add a bed"));
    }

    #[test]
    fn a_message_is_readable_whatever_it_quotes() {
        assert_eq!(readable("\"é\" is none\n  hint: write it".into()), "\"é\" is none\n  hint: write it");
        assert_eq!(readable("a\u{1b}[31m\u{0}b\r".into()), "a [31m b ");
        let long = readable(format!("{:?} is no number", "é".repeat(10_000)));
        assert!(long.len() <= 600 && long.starts_with("\"é") && long.ends_with("is no number"), "{long}");
    }
}
