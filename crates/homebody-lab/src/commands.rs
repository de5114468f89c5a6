//! The command line of `homebody-lab`: a subcommand for each experiment.

mod alerts;
mod claims;
mod conditions;
mod daily_life;
mod falls;
mod godsey2009;
mod locate;
mod measures;
mod possible;
mod realism;
mod recogniser;
mod round_trip;
mod sensor_faults;
mod sphere;

use crate::catalogue;
use clap::Parser;
use homebody::shared::{self, Failure, LogFormat};
use homebody_simulation::{SimulationError, VERSION};
use rayon::prelude::*;
use std::ffi::OsString;

/// Repeat an experiment that validates Homebody
///
/// Each experiment compares results of Homebody with published figures, with logs of real homes, or with the ground truth of simulated
/// homes.
#[derive(clap::Parser)]
#[command(
    name = "homebody-lab",
    version = VERSION,
    arg_required_else_help = true,
    after_long_help = "Examples:
  homebody-lab godsey2009 --svg firings.svg
  homebody-lab sphere --data sphere_challenge --svg rooms.svg
  homebody-lab daily-life --people 20 --days 14 --png people.png
  homebody-lab claims --json claims.json
  homebody-lab conditions
  homebody-lab possible
  homebody-lab realism --data casas --json realism.json
  homebody-lab locate --json locate.json
  homebody-lab measures --homes 8
  homebody-lab alerts --people 200 --json alerts.json
  homebody-lab falls --cases 100
  homebody-lab round-trip --homes 40
  homebody-lab sensor-faults --homes 10
  homebody-lab recogniser --data uci
  homebody-lab explain experiment::no-data"
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// How to write progress, notes and errors to standard error
    #[arg(long, global = true, value_enum, default_value_t, value_name = "FORM")]
    log_format: LogFormat,
}

macro_rules! commands {
    ($($name:ident($($module:ident)::+)),*) => {
        #[derive(clap::Subcommand)]
        enum Command {
            $($name($($module)::+::Arguments),)*
            Explain(ExplainArguments),
        }

        impl Command {
            fn run(self) -> Result<(), Failure> {
                match self {
                    $(Command::$name(arguments) => arguments.run(),)*
                    Command::Explain(arguments) => shared::explain(arguments.code, catalogue::all()),
                }
            }
        }
    };
}

commands! {
    Godsey2009(godsey2009),
    Sphere(sphere),
    DailyLife(daily_life),
    Claims(claims),
    Conditions(conditions),
    Possible(possible),
    Realism(realism),
    Recogniser(recogniser),
    Locate(locate),
    Measures(measures),
    Alerts(alerts),
    Falls(falls),
    RoundTrip(round_trip),
    SensorFaults(sensor_faults)
}

/// Explain a message of an experiment by its code
#[derive(clap::Args)]
#[command(after_help = "Example:\n  homebody-lab explain experiment::no-data")]
struct ExplainArguments {
    /// The code of a message, or the part before `::` (default: list all messages of the experiments)
    #[arg(value_name = "CODE")]
    code: Option<String>,
}

/// Asks something of each case, on all processors, and shows the progress. The answers are in the order of the cases.
fn ask_each<C: Sync, T: Send, E: Into<Failure>>(
    cases: &[C],
    noun: &str,
    ask: impl Fn(&C) -> Result<T, E> + Sync,
) -> Result<Vec<T>, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().build();
    let pool = pool.map_err(|error| SimulationError::Threads { why: error.to_string() })?;
    let progress = shared::bar(cases.len() as u64, &format!("{{bar:40}} {{pos}} of {{len}} {noun}  {{eta}} left"));
    let ask = |case: &C| {
        let answer = ask(case).map_err(Into::into);
        progress.inc(1);
        answer
    };
    let answers = pool.install(|| cases.par_iter().map(ask).collect());
    progress.finish_and_clear();
    answers
}

/// The whole command line.
pub fn command() -> clap::Command {
    <Arguments as clap::CommandFactory>::command()
}

/// Runs the experiment of a command line, whose first word is the program's name. Returns the exit code. No thread may run before.
pub fn run(words: Vec<OsString>) -> u8 {
    shared::prepare();
    let Arguments { command, log_format } = Arguments::parse_from(words);
    shared::write_messages_as(log_format);
    shared::exit_code(command.run())
}
