//! The rounds of a conversation in a file next to the routine. The routine can be made from it again without a model.

use crate::messages::FreeTextError;
use serde::{Deserialize, Serialize};

/// A prompt, its answer, and what was found in it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConversationRound {
    /// The request.
    pub prompt: String,
    /// The answer as it came.
    pub answer: String,
    /// The corrections that the model had to make.
    pub problems: Vec<String>,
    /// The differences between the statements and their simulation.
    pub differences: Vec<String>,
}

/// A conversation, and the lines that were accepted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoundsFile {
    /// The version of the program.
    pub program: String,
    /// The scenario, as the command named it.
    pub home: String,
    /// The resident.
    pub resident: String,
    /// The model and the address of its server, if one was asked.
    pub model: Option<String>,
    /// The text.
    pub text: String,
    /// The instructions before the text.
    pub system: String,
    /// In order.
    pub rounds: Vec<ConversationRound>,
    /// By line of the result: whether it was accepted.
    pub accepted: Vec<bool>,
}

impl RoundsFile {
    /// Reads the text of a file.
    ///
    /// # Errors
    ///
    /// [`FreeTextError::NotRounds`].
    pub fn read(text: &str) -> Result<RoundsFile, FreeTextError> {
        serde_json::from_str(text).map_err(|error| FreeTextError::NotRounds { why: error.to_string() })
    }
}
