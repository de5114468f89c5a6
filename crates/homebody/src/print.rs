//! Output: results to standard output or a file, and notes, warnings and errors to standard error.

use crate::failure::Failure;
use homebody_core::messages::Diagnose;
use homebody_core::problem::{Diagnostic, is_unseen};
use homebody_log::LogError;
use homebody_log::files::fresh::FreshFile;
use jiff::Timestamp;
use std::borrow::Cow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

homebody_core::messages! {
    /// Errors of writing the result of a command.
    pub enum ResultMessage in "result" {
        /// Homebody cannot turn the result into JSON or CSV. This is an error of the program: report it with the command that you ran.
        NotWritten { why: String } error "not-written" ("cannot write the result: {why}");
        /// A program that reads rows from standard output expects rows only. The result or the report would be among them.
        StandardOutput {
            /// `result` or `report`.
            what: &'static str,
        } error "standard-output" ("rows and the {what} cannot both go to standard output")
            advice (Some(match *what {
                "report" => "leave out --json, or write the reports to a file: --report FILE".to_owned(),
                _ => "leave out --json: the result then goes to standard error".to_owned(),
            }));
        /// A FHIR bundle holds an observation for each measure. It has no place for alerts and sentences.
        Fhir error "fhir" ("--out fhir:FILE accepts measures only")
            hint ("write alerts and sentences to jsonl:FILE or sqlite:FILE, and use homebody measures for fhir:FILE");
    }
}

pub fn not_written(why: impl std::fmt::Display) -> Failure {
    Failure::asked(ResultMessage::NotWritten { why: why.to_string() })
}

/// A JSON object with its end of line.
pub fn json_text(value: &impl serde::Serialize) -> Result<String, Failure> {
    Ok(serde_json::to_string_pretty(value).map_err(not_written)? + "\n")
}

/// Prints the one JSON object that `--json` promises.
pub fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    print_json_text(&json_text(value)?)
}

/// Prints JSON text, such as one object per line.
pub fn print_json_text(text: &str) -> Result<(), Failure> {
    print_text(&escaped_json(text))
}

/// The same JSON with escapes for invisible characters: its value stays, and no terminal acts on them.
fn escaped_json(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")).collect())
}

/// A number with a comma before each three digits.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A count with commas and its noun, such as `498,309 rows`.
pub fn counted(number: u64, one: &str, many: &str) -> String {
    format!("{} {}", grouped(number), if number == 1 { one } else { many })
}

/// Prints on standard output. A reader that has closed it is not an error.
pub fn print_text(text: &str) -> Result<(), Failure> {
    use std::io::{ErrorKind, Write};
    match std::io::stdout().lock().write_all(seen(text).as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(LogError::file(Path::new("standard output"), error).into())
        }
        _ => Ok(()),
    }
}

/// Writes a whole file, or nothing. Replaces an existing file only with `force`.
pub fn write_file(path: &Path, bytes: &[u8], force: bool) -> Result<(), Failure> {
    Ok(FreshFile::write_whole(path, bytes, force)?)
}

/// Prints a note on standard error. A closed standard error is not an error.
pub fn tell(text: impl std::fmt::Display) {
    use std::io::Write;
    let text = text.to_string();
    let text = seen(&text);
    let _ = match IN_JSON.load(Ordering::Relaxed) {
        true => writeln!(std::io::stderr().lock(), "{}", as_json(&text, Timestamp::now())),
        false => writeln!(std::io::stderr().lock(), "{text}"),
    };
}

/// Prints a text; in JSON, its object also has the figures under this name.
pub fn tell_with(text: impl std::fmt::Display, name: &str, figures: &impl serde::Serialize) {
    tell_at(None, text, name, figures);
}

/// Prints a message with its severity and its code.
pub fn tell_message(message: &Diagnostic) {
    let label = match message.code {
        "" => format!("{}: ", message.severity.word()),
        _ => message.label(),
    };
    tell_at(Some(message.severity.word()), format!("{label}{message}"), "diagnostics", &[message]);
}

pub fn warn(message: impl Diagnose) {
    tell_message(&message.diagnostic());
}

/// Prints errors as a text with the file of each; in JSON also as a list.
pub fn tell_problems(text: impl std::fmt::Display, problems: &impl serde::Serialize) {
    tell_at(Some("error"), text, "diagnostics", problems);
}

fn tell_at(level: Option<&str>, text: impl std::fmt::Display, name: &str, figures: &impl serde::Serialize) {
    use std::io::Write;
    if !IN_JSON.load(Ordering::Relaxed) {
        return tell(text);
    }
    let mut object = as_json(&seen(&text.to_string()), Timestamp::now());
    if let Some(level) = level {
        object["level"] = level.into();
    }
    object[name] = serde_json::to_value(figures).unwrap_or_default();
    let _ = writeln!(std::io::stderr().lock(), "{object}");
}

/// The form of progress, notes and errors on standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum LogFormat {
    /// Lines of text.
    #[default]
    Text,
    /// One JSON object per line, with time, level and message.
    Json,
}

static IN_JSON: AtomicBool = AtomicBool::new(false);

pub fn tell_as(form: LogFormat) {
    IN_JSON.store(form == LogFormat::Json, Ordering::Relaxed);
}

fn as_json(text: &str, now: Timestamp) -> serde_json::Value {
    let levels = [("error", "error"), ("warning", "warning"), ("note", "info")];
    // A code may stand between the level and the text.
    let after = |text: &'_ str| match text.strip_prefix('[').and_then(|code| code.split_once("]: ")) {
        Some((_, text)) => Some(text.to_owned()),
        None => text.strip_prefix(": ").map(str::to_owned),
    };
    let named = levels.iter().find_map(|(begins, level)| Some((after(text.strip_prefix(begins)?)?, *level)));
    let (message, level) = named.unwrap_or((text.to_owned(), "info"));
    serde_json::json!({ "time": now.to_string(), "level": level, "message": message })
}

/// The text with an escape such as `\u{202e}` for each invisible character that a terminal acts on: names come from files of strangers.
fn seen(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c.escape_unicode().to_string())
}

fn escaped(text: &str, escape: impl Fn(char) -> String) -> Cow<'_, str> {
    let is_heeded = |c: char| is_unseen(c) && c != '\n' && c != '\t';
    if !text.contains(is_heeded) {
        return text.into();
    }
    text.chars().map(|c| if is_heeded(c) { escape(c) } else { c.into() }).collect::<String>().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_are_objects_in_json() {
        let told = |text| as_json(text, Timestamp::from_second(0).unwrap());
        let object = told("warning: the \"hall\"\nis dark");
        assert_eq!(object["level"], "warning");
        assert_eq!(
            (&object["message"], &object["time"]),
            (&"the \"hall\"\nis dark".into(), &"1970-01-01T00:00:00Z".into())
        );
        let coded = told("error[log::exists]: a.csv already exists");
        assert_eq!((&coded["message"], &coded["level"]), (&"a.csv already exists".into(), &"error".into()));
        assert_eq!((told("error: no")["level"].as_str(), told("so")["level"].as_str()), (Some("error"), Some("info")));
        assert!(!told("two\nlines").to_string().contains('\n'));
    }

    #[test]
    fn escapes_characters_that_terminals_act_on() {
        assert_eq!(seen("sensor\u{1b}[2J\u{7}\u{9b}1m, a\tb\r\n"), "sensor\\u{1b}[2J\\u{7}\\u{9b}1m, a\tb\\u{d}\n");
        for (heeded, shown) in [("\u{202e}", "\\u{202e}"), ("\u{2066}", "\\u{2066}"), ("\u{200b}", "\\u{200b}")] {
            assert_eq!(seen(&format!("hall {heeded}motion")), format!("hall {shown}motion"));
        }
        assert!(matches!(seen("hall motion, Öz 好\n"), Cow::Borrowed(_)));
        // JSON has its own escapes.
        let said = serde_json::json!({ "sensor": "a\u{202e}b\u{9b}\u{e0041}" });
        let text = escaped_json(&said.to_string()).into_owned();
        assert_eq!(text, r#"{"sensor":"a\u202eb\u009b\udb40\udc41"}"#);
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), said);
    }
}
