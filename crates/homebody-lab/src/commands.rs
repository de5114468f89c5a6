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
struct LabArguments {
    #[command(subcommand)]
    command: LabCommand,
    /// How to write progress, notes and errors to standard error
    #[arg(long, global = true, value_enum, default_value_t, value_name = "FORM")]
    log_format: LogFormat,
}

macro_rules! commands {
    ($($name:ident($arguments:ty),)*) => {
        #[derive(clap::Subcommand)]
        enum LabCommand {
            $($name($arguments),)*
            Explain(ExplainLabArguments),
        }

        impl LabCommand {
            fn run(self) -> Result<(), Failure> {
                match self {
                    $(LabCommand::$name(arguments) => arguments.run(),)*
                    LabCommand::Explain(arguments) => shared::explain(arguments.code, catalogue::all()),
                }
            }
        }
    };
}

commands! {
    Godsey2009(godsey2009::Godsey2009LabArguments),
    Sphere(sphere::SphereLabArguments),
    DailyLife(daily_life::DailyLifeLabArguments),
    Claims(claims::ClaimsLabArguments),
    Conditions(conditions::ConditionsLabArguments),
    Possible(possible::PossibleLabArguments),
    Realism(realism::RealismLabArguments),
    Recogniser(recogniser::RecogniserLabArguments),
    Locate(locate::LocateLabArguments),
    Measures(measures::MeasuresLabArguments),
    Alerts(alerts::AlertsLabArguments),
    Falls(falls::FallsLabArguments),
    RoundTrip(round_trip::RoundTripLabArguments),
    SensorFaults(sensor_faults::SensorFaultsLabArguments),
}

/// Explain a message of an experiment by its code
#[derive(clap::Args)]
#[command(after_help = "Example:\n  homebody-lab explain experiment::no-data")]
struct ExplainLabArguments {
    /// The code of a message, or the part before `::` (default: list all messages of the experiments)
    #[arg(value_name = "CODE")]
    code: Option<String>,
}

/// Evaluates each case, on all processors, and shows the progress. The results are in the order of the cases.
fn evaluate_each<C: Sync, T: Send, E: Into<Failure>>(
    cases: &[C],
    noun: &str,
    ask: impl Fn(&C) -> Result<T, E> + Sync,
) -> Result<Vec<T>, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().build();
    let pool = pool.map_err(|error| SimulationError::Threads { why: error.to_string() })?;
    let template = format!("{{bar:40}} {{pos}} of {{len}} {noun}  {{eta}} left");
    shared::show(cases.len() as u64, &template, |progress| {
        let ask = |case: &C| ask(case).map_err(Into::into).inspect(|_| progress.inc(1));
        pool.install(|| cases.par_iter().map(ask).collect())
    })
}

pub fn command() -> clap::Command {
    <LabArguments as clap::CommandFactory>::command()
}

/// Runs the experiment of a command line, whose first word is the program's name. Returns the exit code. No thread may run before.
pub fn run(words: Vec<OsString>) -> u8 {
    shared::prepare();
    let LabArguments { command, log_format } = LabArguments::parse_from(words);
    shared::write_messages_as(log_format);
    shared::exit_code(command.run())
}
