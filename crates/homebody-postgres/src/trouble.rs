//! Errors of a server: their meaning for users, and whether they pass.

use crate::messages::{ContinueMessage, ServerMessage};
use crate::server::Server;
use homebody_core::problem::{Diagnostic, readable};
use homebody_log::LogError;
use std::error::Error;
use std::time::Duration;

pub(crate) fn wrong(server: &Server, message: impl Into<Diagnostic>) -> LogError {
    let message: Diagnostic = message.into();
    let (what, hint) = (readable(message.what), message.hint.map(readable));
    LogError::destination(server.place.as_str(), Diagnostic { what, hint, ..message })
}

/// A run that is not there as this program has left it.
pub(crate) fn changed(server: &Server, message: ContinueMessage) -> LogError {
    LogError::changed(server.place.as_str(), message)
}

/// A text that PostgreSQL has no room for in its form.
pub(crate) fn unheld(server: &Server, text: &str) -> LogError {
    LogError::cannot_hold(server.place.as_str(), ServerMessage::ZeroByte { text: text.into() })
}

/// An error that is over once the server is back.
pub(crate) fn away(server: &Server, message: ServerMessage) -> LogError {
    wrong(server, message).passing()
}

pub(crate) fn silent(server: &Server, waited: Duration) -> LogError {
    LogError::hangs(&server.place, waited)
}

/// The meaning of an error of the client; `ignored` is the reason why a password file was not read.
pub(crate) fn client_error(server: &Server, error: &tokio_postgres::Error, ignored: Option<&str>) -> LogError {
    let reason = error.source().map_or_else(|| error.to_string(), |source| source.to_string());
    let login = |answer: String| wrong(server, ServerMessage::Login { answer, ignored: ignored.map(str::to_owned) });
    let Some(said) = error.as_db_error() else {
        let kind = error.to_string();
        // The client alone reports that a password is needed.
        if reason.contains("password missing") {
            return login("the server wants a password".into());
        }
        return match kind.as_str() {
            _ if kind.contains("TLS") => wrong(server, ServerMessage::Tls { reason }),
            _ if kind.contains("connecting") => away(server, ServerMessage::NoServer { reason }),
            _ if error.is_closed() || kind.contains("communicating") => away(server, ServerMessage::Lost { reason }),
            _ => wrong(server, ServerMessage::Client { reason: format!("{kind}: {reason}") }),
        };
    };
    let code = said.code().code();
    let detail = said.detail().map_or_else(String::new, |detail| format!(" ({detail})"));
    let answer = format!("{}{detail}", said.message());
    match code {
        "28P01" | "28000" => login(answer),
        "3D000" => wrong(server, ServerMessage::NoDatabase { answer, database: server.database.clone() }),
        "42501" => wrong(server, ServerMessage::NoRight { answer }),
        "25006" => away(server, ServerMessage::ReadOnly { answer }),
        "23505" => wrong(server, ServerMessage::SameRows { answer }),
        _ if passes(code) => away(server, ServerMessage::Passing { answer }),
        _ => {
            let advice = said.hint().unwrap_or("see docs/how-to/postgresql.md for what a server needs").to_owned();
            wrong(server, ServerMessage::Answer { answer, sqlstate: code.to_owned(), advice })
        }
    }
}

/// Whether an error ends by itself, by its SQLSTATE: the server shuts down, starts, is out of space or connections, or others were in the
/// way.
fn passes(code: &str) -> bool {
    ["08", "40", "53"].iter().any(|class| code.starts_with(class))
        || ["57P01", "57P02", "57P03", "57P05", "55P03", "25P03", "57014"].contains(&code)
}
