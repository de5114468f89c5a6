//! The commands, one file each, all in the same shape: the arguments as a struct, with a `run`.

pub mod alerts;
mod anonymise;
pub mod answer;
pub mod catalogue;
mod check;
mod cohort;
mod compare;
mod completions;
mod convert;
mod coverage;
mod day;
mod density;
mod devices;
mod doctor;
pub mod explain;
mod falls;
mod find;
mod fit;
pub mod fleet;
mod follow;
mod for_programs;
pub mod groups;
mod import;
mod inspect;
mod install_sheet;
mod label;
mod live;
mod locate;
pub mod measures;
pub mod messages;
mod mqtt;
mod new;
mod parameters;
mod plan;
pub mod read_log;
mod realism;
mod replacing;
mod replay;
mod routine;
mod run;
mod run_messages;
mod run_output;
pub mod scenario;
mod schema;
mod sensor_faults;
mod serve;
mod silhouettes;
mod storyboard;
mod suggest_sensors;
mod summary;

use crate::failure::Failure;
use clap::Subcommand;

/// Each variant's summary is the first line of its arguments' documentation; [`groups`] orders them.
#[derive(Subcommand)]
pub enum Command {
    Run(run::RunArguments),
    Live(live::LiveArguments),
    Fleet(fleet::FleetArguments),
    Replay(replay::ReplayArguments),
    Check(check::Arguments),
    Routine(routine::Arguments),
    Serve(serve::Arguments),
    Plan(plan::Arguments),
    Coverage(coverage::Arguments),
    InstallSheet(install_sheet::Arguments),
    Devices(devices::Arguments),
    Inspect(inspect::Arguments),
    Locate(locate::Arguments),
    SensorFaults(sensor_faults::Arguments),
    Fit(fit::Arguments),
    Compare(compare::Arguments),
    Realism(realism::Arguments),
    Density(density::Arguments),
    Measures(measures::Arguments),
    Alerts(alerts::Arguments),
    Summary(summary::Arguments),
    Find(find::Arguments),
    Falls(falls::Arguments),
    Silhouettes(silhouettes::Arguments),
    SuggestSensors(suggest_sensors::Arguments),
    Day(day::Arguments),
    Storyboard(storyboard::Arguments),
    Convert(convert::Arguments),
    #[command(visible_alias = "anonymize")]
    Anonymise(anonymise::Arguments),
    Label(label::Arguments),
    Doctor(doctor::Arguments),
    Mqtt(mqtt::Arguments),
    Schema(schema::Arguments),
    Parameters(parameters::Arguments),
    New(new::Arguments),
    Import(import::Arguments),
    Explain(explain::Arguments),
    Completions(completions::Arguments),
}

impl Command {
    /// Runs it; `whole` is the command line that all of them belong to.
    pub fn run(self, whole: fn() -> clap::Command) -> Result<(), Failure> {
        match self {
            Command::Run(arguments) => arguments.run(),
            Command::Live(arguments) => arguments.run(),
            Command::Fleet(arguments) => arguments.run(),
            Command::Replay(arguments) => arguments.run(),
            Command::Check(arguments) => arguments.run(),
            Command::Routine(arguments) => arguments.run(),
            Command::Serve(arguments) => arguments.run(),
            Command::Plan(arguments) => arguments.run(),
            Command::Coverage(arguments) => arguments.run(),
            Command::InstallSheet(arguments) => arguments.run(),
            Command::Devices(arguments) => arguments.run(),
            Command::Inspect(arguments) => arguments.run(),
            Command::Locate(arguments) => arguments.run(),
            Command::SensorFaults(arguments) => arguments.run(),
            Command::Fit(arguments) => arguments.run(),
            Command::Compare(arguments) => arguments.run(),
            Command::Realism(arguments) => arguments.run(),
            Command::Density(arguments) => arguments.run(),
            Command::Measures(arguments) => arguments.run(),
            Command::Alerts(arguments) => arguments.run(),
            Command::Summary(arguments) => arguments.run(),
            Command::Find(arguments) => arguments.run(),
            Command::Falls(arguments) => arguments.run(),
            Command::Silhouettes(arguments) => arguments.run(),
            Command::SuggestSensors(arguments) => arguments.run(),
            Command::Day(arguments) => arguments.run(),
            Command::Storyboard(arguments) => arguments.run(),
            Command::Convert(arguments) => arguments.run(),
            Command::Anonymise(arguments) => arguments.run(),
            Command::Label(arguments) => arguments.run(),
            Command::Doctor(arguments) => arguments.run(),
            Command::Mqtt(arguments) => arguments.run(),
            Command::Schema(arguments) => arguments.run(),
            Command::Parameters(arguments) => arguments.run(),
            Command::New(arguments) => arguments.run(),
            Command::Import(arguments) => arguments.run(),
            Command::Explain(arguments) => arguments.run(),
            Command::Completions(arguments) => arguments.run(whole()),
        }
    }
}
