//! Free text that becomes statements about a resident.

use super::{Draft, SentenceView};
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A text about a resident, and who answers the prompts about it. It has no `Debug`, which would print the key.
#[derive(Clone, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct FreeTextRequest {
    pub draft: Draft,
    /// The routine of the resident.
    pub file: String,
    pub text: String,
    pub by: Answerer,
}

#[derive(Clone, Deserialize, TS)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Answerer {
    /// The server of a language model.
    Model {
        /// Null for a server on the machine of Homebody.
        url: Option<String>,
        /// The name of the model; null for the only one of the server.
        name: Option<String>,
        /// It goes to the address of `url` only, and is not stored.
        key: Option<String>,
    },
    /// Any assistant, by hand: its answers so far, in the order of their prompts.
    Assistant { answers: Vec<String> },
}

/// The latest text of a home, and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FreeTextView {
    /// Each text has another.
    pub number: u32,
    /// The routine of the resident.
    pub file: String,
    pub state: FreeTextState,
    /// The round that is at work, from 1.
    pub round: u32,
    /// The model and its address, without a key.
    pub model: Option<String>,
    /// A warning that others can read the key on its way, in sentences.
    pub warning: Option<String>,
    pub rounds: Vec<RoundView>,
    /// The next prompt for an assistant; null if nothing more is to be asked.
    pub prompt: Option<String>,
    /// The lines of the best round; empty before the first.
    pub lines: Vec<DraftLineView>,
    /// Sentences of the text that the answer leaves out.
    pub left_out: Vec<String>,
    /// The reason why a run with all statements stops.
    pub run_stops: Option<String>,
    /// The reason of a failure, in sentences.
    pub problem: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub problem_code: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum FreeTextState {
    /// The scenario is read, and the server is looked for.
    Beginning,
    /// The model writes.
    Asking,
    /// An answer is read and simulated.
    Checking,
    Done,
    Failed,
    Stopped,
}

/// The findings in an answer.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, TS)]
pub struct RoundView {
    pub problems: Vec<String>,
    /// Differences between statements and their simulation.
    pub differences: Vec<String>,
}

/// A source in the text, and the statements that are made of it.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DraftLineView {
    pub source: String,
    pub is_in_text: bool,
    pub statements: Vec<DraftStatementView>,
    pub assumed: Vec<String>,
    pub cannot_be_said: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DraftStatementView {
    /// The sentence of the model.
    pub text: String,
    /// The reason why it is refused.
    pub refused: Option<String>,
    /// Its meaning, as canonical sentences with their numbers.
    pub sentences: Vec<SentenceView>,
    /// The expectation and the result of a simulation that differs.
    pub difference: Option<[String; 2]>,
}

/// The lines that a person accepts.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct AcceptLines {
    /// The text that the person has seen.
    pub number: u32,
    /// By line.
    pub accepted: Vec<bool>,
}

/// The routine of accepted lines.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct AcceptedView {
    pub text: String,
    /// Statements that need one that was not accepted; they are comments in the text.
    pub lost: Vec<String>,
}
