//! The command `homebody`: a table of contents. Each command is a file in `commands`. `main.rs` is the program; the Python package
//! calls [`run`].

mod commands;
mod failure;
mod installation;
mod metrics;
mod old_names;
mod pace;
mod print;
mod progress;
mod prometheus;
mod signals;
mod suggestions;
mod text_table;

pub mod messages {
    pub use crate::commands::catalogue::all;
}

/// Parts of commands for the program `homebody-lab`.
pub mod shared {
    pub use crate::commands::explain::explain;
    pub use crate::commands::log_input::{LogOptions, read_log};
    pub use crate::commands::measures::within;
    pub use crate::commands::messages::{not_comparable, not_measurable};
    pub use crate::commands::result_output::{JsonOutput, ResultOutput};
    pub use crate::commands::scenario::Trust;
    pub use crate::failure::Failure;
    pub use crate::print::{LogFormat, json_text, print_json, print_text, tell_as as write_messages_as, write_file};
    pub use crate::progress::show;
    pub use crate::text_table::TextTable;
    pub use crate::{exit_code, prepare};
}

pub use commands::groups::GROUPS as COMMAND_GROUPS;

use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, FromArgMatches, Parser};
use commands::{Command, groups};
use failure::{EXIT_CODES, Failure};
use homebody_core::problem::counted;
use homebody_core::scenario::scheme::without_password;
use homebody_simulation::{TRUST, VERSION};
use print::{LogFormat, tell, tell_as, tell_message, tell_problems};
use std::ffi::OsString;

/// Simulate homes with sensors and their older residents.
#[derive(Parser)]
#[command(
    version = VERSION,
    arg_required_else_help = true,
    after_help = "homebody help COMMAND explains a command, with examples.",
    after_long_help = format!("{EXAMPLES}\n\n{EXIT_CODES},\n{SIGNALS}")
)]
struct HomebodyArguments {
    #[command(subcommand)]
    command: Command,
    /// How to write progress, notes and errors to standard error
    #[arg(long, global = true, value_enum, default_value_t, value_name = "FORM")]
    log_format: LogFormat,
}

const EXAMPLES: &str = "\
Examples:
  homebody new my-home --template tigerplace   make a scenario from a template
  homebody check my-home                       list all its problems at once
  homebody run my-home                         simulate it; write log and ground truth
  homebody coverage my-home --png map.png      draw what the sensors see
  homebody help run                            explain a command";

const SIGNALS: &str =
    "129, 130 or 143 SIGHUP, SIGINT or SIGTERM ended a run early; what was simulated until then is stored.";

/// The command line: commands in groups, and old names as aliases.
pub fn command() -> clap::Command {
    let whole = old_names::with_aliases(HomebodyArguments::command());
    let template = groups::template(&whole);
    whole.help_template(template)
}

fn parse<'a>(
    mut whole: clap::Command,
    words: impl IntoIterator<Item = &'a OsString>,
) -> Result<HomebodyArguments, clap::Error> {
    let mut matches = whole.try_get_matches_from_mut(words)?;
    HomebodyArguments::from_arg_matches_mut(&mut matches).map_err(|error| error.format(&mut whole))
}

/// Runs the command of a command line, whose first word is the program's name. Returns the exit code. No thread may run before.
pub fn run(words: Vec<OsString>) -> u8 {
    prepare();
    let words = without_help_of_help(words);
    let whole = command();
    let notes = old_names::notes(&whole, &words);
    let arguments = match parse(whole, &words) {
        Ok(arguments) => arguments,
        Err(error) => {
            if let Some(gone) = old_names::gone(&words) {
                return exit_code(Err(gone));
            }
            notes.iter().for_each(tell);
            return refuse(&with_working_tip(error, &words), &words);
        }
    };
    tell_as(arguments.log_format);
    notes.iter().for_each(tell);
    exit_code(arguments.command.run(command))
}

/// Prepares the process for full files and installs the destinations. No thread may run before.
pub fn prepare() {
    signals::outlive_full_files();
    homebody_simulation::install_sinks();
}

pub fn exit_code(result: Result<(), Failure>) -> u8 {
    result.map_or_else(|failure| report(&failure), |()| 0)
}

/// `help --help` and `help run --help` are `help` and `help run`: clap knows no help of its command `help`.
fn without_help_of_help(mut words: Vec<OsString>) -> Vec<OsString> {
    if words.get(1).is_some_and(|word| word == "help") {
        words.retain(|word| word != "--help" && word != "-h");
    }
    words
}

/// The error with a tip that works. If clap proposes an argument that is refused, too, the tips of that one replace it.
fn with_working_tip(error: clap::Error, words: &[OsString]) -> clap::Error {
    let first = words.iter().skip(1).map(|word| word.to_string_lossy()).find(|word| !word.starts_with('-'));
    let mut error = suggestions::with_command(error, &command(), &first.unwrap_or_default());
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
    let Err(other) = parse(command(), &words.iter().map(replaced).collect::<Vec<_>>()) else { return error };
    let is_refused = text(other.get(ContextKind::InvalidArg)).is_some_and(|arg| arg.starts_with(&meant));
    if let Some(tips) = other.get(ContextKind::Suggested).filter(|_| is_refused) {
        error.remove(ContextKind::SuggestedArg);
        error.insert(ContextKind::Suggested, tips.clone());
    }
    error
}

/// Prints the problem with a command line and returns the exit code. The message quotes its words without passwords.
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
    let shown = secret.iter().fold(quoted, |shown, value| shown.replace(value.as_str(), &without_password(value)));
    tell(format_args!("{}", shown.trim_end()));
    2
}

fn report(failure: &Failure) -> u8 {
    match failure {
        Failure::Problems(problems) => {
            let said = problems.render().replace(TRUST, &format!("{TRUST}, by --trust"));
            let text = format!("{said}\n{}", counted(problems.0.len(), "problem", "problems"));
            tell_problems(text, problems);
            2
        }
        Failure::Coded(message, code) => {
            tell_message(message);
            *code
        }
        Failure::Signal(code) => *code,
    }
}
