//! Routines from free text: a care plan, a diary or a persona, through a language model.
//!
//! A [`Conversation`] takes the text and makes the prompts; it reads each answer, checks every sentence of it with the reader of routines,
//! and simulates some days. Problems and measured differences are the next prompt. A [`ModelServer`] answers prompts over HTTP; a
//! person with any assistant can do so, too. Only sentences that the reader accepts are in the [`LifeDraft`], each with its source
//! in the text. The command, the page and Python decide which of them are written.

mod messages;
pub mod catalogue;

mod free_text;
mod system_prompt;
mod model_answer;
mod life_draft;
mod side_by_side;
mod trial;
mod conversation;
mod rounds_file;
mod model_server;

pub use conversation::{Conversation, ConversationStage, MOST_ROUNDS};
pub use free_text::{FreeText, MOST_CHARACTERS};
pub use life_draft::{DraftLine, DraftStatement, LifeDraft};
pub use messages::{FreeTextError, FreeTextWarning, ModelMessage};
pub use model_server::{
    ChatMessage, KEY_VARIABLE, LOCAL_SERVERS, MOST_ANSWER_BYTES, ModelChoice, ModelServer, USUAL_TIMEOUT,
};
pub use rounds_file::{ConversationRound, RoundsFile};
