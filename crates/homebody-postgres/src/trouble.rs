//! What errors of a server mean for people, and which of them pass.

use crate::server::{INSTEAD, Server};
use homebody_core::problem::readable;
use homebody_log::LogError;
use std::error::Error;
use std::time::Duration;

/// An error of what the user says about a server, which does not pass.
pub(crate) fn wrong(server: &Server, what: String, hint: &str) -> LogError {
    LogError::Destination {
        place: server.place.clone(),
        what: readable(what),
        hint: Some(readable(hint.to_owned())),
        passes: false,
        source: None,
    }
}

/// A run that is not there as this program has left it.
pub(crate) fn changed(server: &Server, what: &str) -> LogError {
    LogError::Changed { place: server.place.clone(), what: what.into() }
}

/// A text that PostgreSQL has no room for in its form.
pub(crate) fn unheld(server: &Server, text: &str) -> LogError {
    let what = readable(format!("the text {text:?}"));
    let hint = "PostgreSQL takes no NUL in texts: give the sensor another id";
    LogError::CannotHold { place: server.place.clone(), what, hint }
}

/// An error that is over once the server is back.
pub(crate) fn away(server: &Server, what: String) -> LogError {
    let hint = "start the server, or correct host and port";
    wrong(server, what, hint).passing()
}

/// A server that does not answer.
pub(crate) fn silent(server: &Server, waited: Duration) -> LogError {
    LogError::hangs(&server.place, waited)
}

/// What an error of the client means; `ignored` says why a file of passwords was not read.
pub(crate) fn told(server: &Server, error: &tokio_postgres::Error, ignored: Option<&str>) -> LogError {
    let reason = error.source().map_or_else(|| error.to_string(), |source| source.to_string());
    let Some(said) = error.as_db_error() else {
        let kind = error.to_string();
        // What is told of a password that is needed is the client's alone.
        if reason.contains("password missing") {
            return no_password(server, "the server wants a password".into(), ignored);
        }
        return match kind.as_str() {
            _ if kind.contains("TLS") => {
                let hint = "sslmode says how the connection is encrypted, sslrootcert by whose certificate";
                wrong(server, format!("no secret connection: {reason}"), hint)
            }
            _ if kind.contains("connecting") => away(server, format!("no server answers: {reason}")),
            _ if error.is_closed() || kind.contains("communicating") => {
                away(server, format!("the connection is lost: {reason}"))
            }
            _ => {
                wrong(server, format!("{kind}: {reason}"), "docs/how-to/postgresql.md says what is wanted of a server")
            }
        };
    };
    let code = said.code().code();
    let detail = said.detail().map_or_else(String::new, |detail| format!(" ({detail})"));
    let what = format!("{}{detail}", said.message());
    match code {
        "28P01" | "28000" => no_password(server, what, ignored),
        "3D000" => wrong(server, what, &format!("createdb {} makes it; or name another", server.database)),
        "42501" => wrong(server, what, "have an owner GRANT it to this user, or connect as another"),
        "25006" => wrong(
            server,
            what,
            "the server takes no changes: it stands by for another, or is set so; name one that does",
        )
        .passing(),
        "23505" => wrong(
            server,
            what,
            "another program has written rows of this run: let it come to its end, or use --replace-rows",
        ),
        _ if passes(code) => wrong(server, what, "it may pass: what was confirmed before is safe").passing(),
        _ => wrong(
            server,
            format!("{what} [{code}]"),
            said.hint().unwrap_or("docs/how-to/postgresql.md says what is wanted of a server"),
        ),
    }
}

fn no_password(server: &Server, what: String, ignored: Option<&str>) -> LogError {
    let ignored = ignored.map_or_else(String::new, |ignored| format!("; {ignored}"));
    wrong(server, format!("{what}{ignored}"), INSTEAD)
}

/// Whether an error of the server is over by itself, by its SQLSTATE: it was shut down, is starting, has no room or no
/// connections left, or others were in the way.
fn passes(code: &str) -> bool {
    ["08", "40", "53"].iter().any(|class| code.starts_with(class))
        || ["57P01", "57P02", "57P03", "57P05", "55P03", "25P03", "57014"].contains(&code)
}
