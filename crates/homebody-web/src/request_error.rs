//! Refused requests: their status, their messages, and the sentences that the page shows.

use crate::messages::PageMessage;
use crate::wire::{RefusedView, RunNotice};
use axum::Json;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use homebody_core::problem::{Diagnose, Diagnostic, readable};
use serde_json::Value;
use std::fmt::Display;
use std::path::{MAIN_SEPARATOR, Path};

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RequestError {
    pub status: StatusCode,
    pub message: Diagnostic,
}

impl RequestError {
    pub fn new(status: StatusCode, message: impl Diagnose) -> RequestError {
        RequestError { status, message: message.diagnostic() }
    }

    pub fn internal(error: impl Display) -> RequestError {
        RequestError::new(StatusCode::INTERNAL_SERVER_ERROR, PageMessage::System { why: error.to_string() })
    }
}

impl IntoResponse for RequestError {
    fn into_response(self) -> Response {
        let what = sentence(&self.message);
        let code = code_of(&self.message);
        (self.status, Json(RefusedView { code, what, data: self.message.data })).into_response()
    }
}

/// The run, day or home does not exist.
pub fn not_found(message: impl Diagnose) -> RequestError {
    RequestError::new(StatusCode::NOT_FOUND, message)
}

pub fn no_run(run: &str) -> RequestError {
    not_found(PageMessage::NoRun { run: readable(run.to_owned()) })
}

/// The request is invalid, or a file of the run or home cannot be read or written.
pub fn unprocessable(message: impl Diagnose) -> RequestError {
    RequestError::new(StatusCode::UNPROCESSABLE_ENTITY, message)
}

/// An error of the system about a file of the run or home.
pub fn failed(error: impl Display) -> RequestError {
    unprocessable(PageMessage::System { why: error.to_string() })
}

pub fn code_of(message: &Diagnostic) -> Option<String> {
    (!message.code.is_empty()).then(|| message.code.to_owned())
}

/// The text and the hint of a message, as sentences.
pub fn sentence(message: &Diagnostic) -> String {
    // Problems with files name their places, and a list of problems has a line for each.
    if message.code.is_empty() || !message.file.is_empty() || message.what.contains('\n') {
        return shortened(&message.to_string());
    }
    let sentences = [Some(&message.what), message.hint.as_ref()].into_iter().flatten();
    shortened(&sentences.map(|text| as_sentence(text)).collect::<Vec<_>>().join(" "))
}

/// A message as a bad note of the page.
pub fn note(message: &Diagnostic) -> RunNotice {
    RunNotice::Note { text: sentence(message), bad: true, code: code_of(message) }
}

/// A text with a capital letter at its start, unless it starts with a name, and a full stop at its end.
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

/// The page has room for a few lines.
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
