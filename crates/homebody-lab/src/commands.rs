//! The command line of `homebody-lab`: a subcommand for each experiment.

mod alerts;
mod claims;
mod conditions;
mod daily_life;
mod evaluation;
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
mod statements;

use crate::catalogue;
use clap::Parser;
use homebody::shared::{self, Failure, LogFormat};
use homebody_simulation::VERSION;
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
  homebody-lab statements --count 5000 --seed 7
  homebody-lab conditions
  homebody-lab possible
  homebody-lab realism --data casas --json realism.json
  homebody-lab locate --json locate.json
  homebody-lab measures --homes 8
  homebody-lab alerts --people 400 --json alerts.json
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
    Statements(statements::StatementsLabArguments),
}

/// Explain a message of an experiment by its code
#[derive(clap::Args)]
#[command(after_help = "Example:\n  homebody-lab explain experiment::no-data")]
struct ExplainLabArguments {
    /// The code of a message, or the part before `::` (default: list all messages of the experiments)
    #[arg(value_name = "CODE")]
    code: Option<String>,
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
