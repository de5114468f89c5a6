//! The statements of a routine, for the form that writes them.

use super::{Draft, ProblemView, SentenceView};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use ts_rs::TS;

/// The statements of a routine in the order of its text.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct StatementsView {
    /// Of other files; a routine with problems has the statements that are understood.
    pub problems: Vec<ProblemView>,
    pub statements: Vec<StatementView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct StatementView {
    /// Of its sentences. A person may have several, and several statements may have the same one.
    pub places: Vec<SentencePlace>,
    #[ts(type = "Record<string, unknown>")]
    pub statement: Value,
    /// As they would be written, without the other statements of the same sentence.
    pub sentences: Vec<String>,
}

/// The place of a sentence, with its full stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
pub struct SentencePlace {
    /// From 1.
    pub line: u32,
    /// In characters, from 1.
    pub column: u32,
    /// In characters.
    pub length: u32,
}

/// A statement to be written into a routine.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct WriteStatement {
    pub draft: Draft,
    pub file: String,
    #[ts(type = "Record<string, unknown>")]
    pub statement: Value,
    /// The statement that it replaces; null for a new one.
    pub instead: Option<ReplacedStatement>,
    /// The line, from 1, after which a new sentence stands.
    pub line: u32,
}

/// A statement as a form was opened with it.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct ReplacedStatement {
    /// In its routine, from 0.
    pub number: u32,
    #[ts(type = "Record<string, unknown>")]
    pub statement: Value,
}

/// The sentences of a statement, their meaning, and the changes that write them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct WrittenStatementView {
    /// As they are written, without the other statements of the same sentence.
    pub sentences: Vec<String>,
    /// The interpretation of the sentences in their routine.
    pub meaning: Vec<SentenceView>,
    /// The faults of the fields, all of them. Values that no sentence says are among them.
    pub faults: Vec<FieldFaultView>,
    /// Problems that the sentences cause, in the words of the program.
    pub problems: Vec<ProblemView>,
    /// Warnings about the sentences.
    pub warnings: Vec<ProblemView>,
    /// In the order of the text; empty if the sentences cannot be written.
    pub edits: Vec<TextEditView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FieldFaultView {
    /// The JSON pointer of the field, such as `/when/lasts_s`; empty for the whole statement.
    pub field: String,
    pub what: String,
    pub hint: Option<String>,
}

/// A part of a text, and the text in its place. Lines and columns are counted from 1, columns in characters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, TS)]
pub struct TextEditView {
    pub line: u32,
    pub column: u32,
    pub to_line: u32,
    pub to_column: u32,
    pub insert: String,
}
