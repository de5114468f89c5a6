//! The command `homebody`: a table of contents. Each command is a file in `commands`. The program is `main.rs`; whoever has it inside of
//! another program, as Python has, calls [`run`].

mod commands;
mod failure;
mod installation;
mod length;
pub mod messages;
mod pace;
mod print;
mod progress;
mod signals;
mod start;
mod prometheus;
mod watched;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, Parser};
use commands::Command;
use failure::{EXIT_CODES, Failure};
use homebody_core::problem::{Diagnostic, counted};
use homebody_core::scenario::scheme::without_password;
use homebody_kit::{TRUST, VERSION};
use print::{Told, tell, tell_as};
use std::ffi::OsString;

/// Simulates homes wired with sensors and the people who live in them.
#[derive(Parser)]
#[command(version = VERSION, arg_required_else_help = true, after_help = format!("{EXAMPLES}\n\n{EXIT_CODES},\n{SIGNALS}"))]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// How what is said besides is told on standard error
    #[arg(long = "log", global = true, value_enum, default_value_t, value_name = "FORM")]
    told: Told,
}

const EXAMPLES: &str = "\
Examples:
  homebody new my-home --template tigerplace   start from an apartment that works
  homebody check my-home                       everything that is wrong with it, at once
  homebody run my-home                         live it, into SQLite
  homebody coverage my-home --png map.png      see what the sensors see";

const SIGNALS: &str =
    "129, 130 or 143 a run was ended early by SIGHUP, SIGINT or SIGTERM, and what was lived is stored.";

/// Does what the words of a command line ask for, of which the first is the program's name. Returns the exit code; nothing else may
/// have begun a thread before.
pub fn run(words: Vec<OsString>) -> u8 {
    signals::outlive_full_files();
    homebody_kit::elsewhere::install_all();
    let arguments = match Arguments::try_parse_from(&words) {
        Ok(arguments) => arguments,
        Err(error) => return refuse(&with_meant(error, &words), &words),
    };
    tell_as(arguments.told);
    match arguments.command.run(Arguments::command) {
        Ok(()) => 0,
        Err(failure) => report(&failure),
    }
}

/// The error, with a tip that works: where clap proposes an argument that is refused, too, that one's tips stand in its place.
fn with_meant(mut error: clap::Error, words: &[OsString]) -> clap::Error {
    let text = |value: Option<&ContextValue>| match value {
        Some(ContextValue::String(text)) => Some(text.clone()),
        _ => None,
    };
    let written = text(error.get(ContextKind::InvalidArg));
    let Some((written, meant)) = written.zip(text(error.get(ContextKind::SuggestedArg))) else { return error };
    let replaced = |word: &OsString| match word.to_string_lossy().strip_prefix(&written) {
        Some("") => OsString::from(&meant),
        Some(value) if value.starts_with('=') => OsString::from(format!("{meant}{value}")),
        _ => word.clone(),
    };
    let Err(other) = Arguments::try_parse_from(words.iter().map(replaced)) else { return error };
    let is_refused = text(other.get(ContextKind::InvalidArg)).is_some_and(|arg| arg.starts_with(&meant));
    if let Some(tips) = other.get(ContextKind::Suggested).filter(|_| is_refused) {
        error.remove(ContextKind::SuggestedArg);
        error.insert(ContextKind::Suggested, tips.clone());
    }
    error
}

/// Tells what is wrong with the words of the command. They are quoted, but for the passwords that somebody wrote into them.
fn refuse(error: &clap::Error, words: &[OsString]) -> u8 {
    let value = |word: String| match word.strip_prefix("--").and_then(|word| word.split_once('=')) {
        Some((_, value)) => value.to_owned(),
        None => word,
    };
    let values = words.iter().map(|word| value(word.to_string_lossy().into_owned()));
    let secret: Vec<String> = values.filter(|value| without_password(value) != value.as_str()).collect();
    if secret.is_empty() {
        error.exit();
    }
    let quoted = error.render().to_string();
    let told = secret.iter().fold(quoted, |told, value| told.replace(value.as_str(), &without_password(value)));
    tell(format_args!("{}", told.trim_end()));
    2
}

/// Tells people on standard error, and scripts by the exit code.
fn report(failure: &Failure) -> u8 {
    match failure {
        Failure::Problems(problems) => {
            let said = problems.render().replace(TRUST, &format!("{TRUST}, by --trust"));
            tell(format_args!("{said}\n{}", counted(problems.0.len(), "problem", "problems")));
            2
        }
        Failure::Usage(what) => {
            tell(format_args!("error: {what}"));
            2
        }
        Failure::Io(what) => {
            tell(format_args!("error: {what}"));
            1
        }
        Failure::Coded(message, code) => {
            tell(format_args!("{}", in_full(message)));
            *code
        }
        Failure::Signal(code) => *code,
    }
}

/// A message with its severity and code before it.
fn in_full(message: &Diagnostic) -> String {
    match message.code {
        "" => format!("error: {message}"),
        _ => format!("{}{message}", message.label()),
    }
}
