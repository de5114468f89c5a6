//! The commands, one file each, all in the same shape: the arguments as a struct, with a `run`.

mod answer;
mod check;
mod compare;
mod completions;
mod convert;
mod coverage;
mod experiment;
mod live;
mod new;
mod plan;
mod replay;
mod run;
mod schema;

use crate::failure::Failure;
use clap::Subcommand;
use homebody_log::fresh::FreshFile;
use std::path::Path;

#[derive(Subcommand)]
pub enum Command {
    /// Live a scenario and store what its sensors say
    Run(run::Arguments),
    /// Live a recording again, byte for byte
    Replay(replay::Arguments),
    /// Report everything that is wrong with a scenario
    Check(check::Arguments),
    /// Draw the floor plan of a home
    Plan(plan::Arguments),
    /// Say where in the home the sensors see, with a map
    Coverage(coverage::Arguments),
    /// Compare the firings of two logs
    Compare(compare::Arguments),
    /// Do an experiment again that was done in the real world
    Experiment(experiment::Arguments),
    /// Carry a log from one form into another
    Convert(convert::Arguments),
    /// Write the JSON Schemas of the scenario files into a folder
    Schema(schema::Arguments),
    /// Begin a scenario of your own from a template
    New(new::Arguments),
    /// Print what makes a shell complete the command line
    Completions(completions::Arguments),
}

impl Command {
    pub fn run(self) -> Result<(), Failure> {
        match self {
            Command::Run(arguments) => arguments.run(),
            Command::Replay(arguments) => arguments.run(),
            Command::Check(arguments) => arguments.run(),
            Command::Plan(arguments) => arguments.run(),
            Command::Coverage(arguments) => arguments.run(),
            Command::Compare(arguments) => arguments.run(),
            Command::Experiment(arguments) => arguments.run(),
            Command::Convert(arguments) => arguments.run(),
            Command::Schema(arguments) => arguments.run(),
            Command::New(arguments) => arguments.run(),
            Command::Completions(arguments) => arguments.run(),
        }
    }
}

/// Prints the one JSON object that `--json` promises.
fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).map_err(Failure::usage)?;
    print_text(&(text + "\n"))
}

/// Prints on standard output; a reader that has gone away is no error.
fn print_text(text: &str) -> Result<(), Failure> {
    use std::io::{ErrorKind, Write};
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Io(format!("standard output: {error}"))),
        _ => Ok(()),
    }
}

/// Writes a whole file under its name or not at all; one that exists is replaced with `force` only.
fn write_file(path: &Path, bytes: &[u8], force: bool) -> Result<(), Failure> {
    let mut file = FreshFile::create(path, force)?;
    file.write(bytes)?;
    Ok(file.finish()?)
}

/// Tells people something on standard error; that nobody listens there is no error.
pub fn tell(text: impl std::fmt::Display) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}
