//! Refusals of requests: their messages, and the sentences that the page shows.

use crate::messages::PageMessage;
use crate::wire::Tell;
use homebody_core::problem::{Diagnose, Diagnostic};
use serde_json::Value;
use std::fmt::Display;
use std::path::{MAIN_SEPARATOR, Path};

/// The reason for a refusal, by its kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The run or its day does not exist.
    Unknown(Diagnostic),
    /// A file cannot be read or written, or the request is not valid.
    Damaged(Diagnostic),
    /// The log is not read so far yet.
    Early(Diagnostic),
}

/// A thing that was asked for does not exist.
pub fn unknown(message: impl Diagnose) -> Refusal {
    Refusal::Unknown(message.diagnostic())
}

/// A thing cannot be read, written or changed.
pub fn damaged(message: impl Diagnose) -> Refusal {
    Refusal::Damaged(message.diagnostic())
}

/// The same where the system reports an error.
pub fn failed(error: impl Display) -> Refusal {
    damaged(PageMessage::System { why: error.to_string() })
}

/// A message as the page shows it: its text and its hint as sentences.
pub fn sentence(message: &Diagnostic) -> String {
    // Problems with files name their places, and a list of problems has a line for each.
    if message.code.is_empty() || !message.file.is_empty() || message.what.contains('\n') {
        return shortened(&message.to_string());
    }
    let sentences = [Some(&message.what), message.hint.as_ref()].into_iter().flatten();
    shortened(&sentences.map(|text| as_sentence(text)).collect::<Vec<_>>().join(" "))
}

/// A message as a bad note of the page.
pub fn note(message: &Diagnostic) -> Tell {
    let code = (!message.code.is_empty()).then(|| message.code.to_owned());
    Tell::Note { text: sentence(message), bad: true, code }
}

/// A text with a capital letter at its start, where it starts with a word, and a full stop at its end.
fn as_sentence(text: &str) -> String {
    let word = text.split(' ').next().unwrap_or_default();
    let end = if text.ends_with(['.', '?', '!', '…']) { "" } else { "." };
    // The name of a file or place keeps its letters.
    let begins = usize::from(!word.is_empty() && word.bytes().all(|byte| byte.is_ascii_lowercase()));
    format!("{}{}{end}", text[..begins].to_ascii_uppercase(), &text[begins..])
}

/// A message without the path of a folder: the page knows the files in it by their names.
pub fn without(folder: &Path, message: Diagnostic) -> Diagnostic {
    replaced(message, &format!("{}{MAIN_SEPARATOR}", folder.display()), "")
}

/// A message with another text for a part of its texts.
pub fn replaced(mut message: Diagnostic, part: &str, by: &str) -> Diagnostic {
    for text in [Some(&mut message.what), message.hint.as_mut(), Some(&mut message.file)].into_iter().flatten() {
        *text = text.replace(part, by);
    }
    message.data.values_mut().for_each(|value| replace_in(value, part, by));
    message
}

fn replace_in(value: &mut Value, part: &str, by: &str) {
    match value {
        Value::String(text) => *text = text.replace(part, by),
        Value::Array(values) => values.iter_mut().for_each(|value| replace_in(value, part, by)),
        _ => {}
    }
}

/// Problems of a scenario can be many lines; the page has room for a few.
pub fn shortened(why: &str) -> String {
    const LONGEST: usize = 600;
    why.chars().take(LONGEST).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages::LibraryMessage;

    #[test]
    fn shows_messages_as_sentences() {
        let used = LibraryMessage::NameUsed { name: "flat".into() }.diagnostic();
        assert_eq!(sentence(&used), "The name flat is already in use here. Choose another name.");
        let invalid = LibraryMessage::InvalidName { name: "".into(), why: vec!["it is empty".into()] }.diagnostic();
        assert_eq!(sentence(&invalid), "\"\" is not a valid name for a home: it is empty.");
        let link = LibraryMessage::NotPlain { path: "conditions/link".into() }.diagnostic();
        assert!(sentence(&link).starts_with("conditions/link is a link"), "{}", sentence(&link));
        let folder = Path::new("runs");
        let path = folder.join("a-1").display().to_string();
        let inside = without(folder, PageMessage::NotRead { file: path, why: "it is damaged".into() }.diagnostic());
        assert_eq!((&inside.what[..], &inside.data["file"]), ("cannot read a-1: it is damaged", &"a-1".into()));
        let file = Diagnostic::of_file("home.json", PageMessage::NoteChanged, None);
        assert_eq!(sentence(&file), "home.json: this note was changed in another window");
    }
}
