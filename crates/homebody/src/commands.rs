//! The commands, one file each, all in the same shape: the arguments as a struct, with a `run`.

pub mod alerts;
mod anonymise;
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
mod early_warnings;
pub mod explain;
mod falls;
mod find;
mod fit;
pub mod fleet;
mod follow;
pub mod groups;
mod import;
mod inspect;
mod install_sheet;
mod label;
mod life;
mod live;
mod locate;
pub mod log_input;
pub mod measures;
pub mod messages;
mod mqtt;
mod new;
mod parameters;
mod plan;
mod realism;
mod replacing;
mod replay;
pub mod result_output;
mod routine;
mod row_destinations;
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
macro_rules! commands {
    ($($(#[$attribute:meta])* $name:ident($arguments:ty),)*) => {
        #[derive(Subcommand)]
        pub enum Command {
            $($(#[$attribute])* $name($arguments),)*
            Completions(completions::CompletionsArguments),
        }

        impl Command {
            /// Runs the command. `whole` is the command line of the program.
            pub fn run(self, whole: fn() -> clap::Command) -> Result<(), Failure> {
                match self {
                    $(Command::$name(arguments) => arguments.run(),)*
                    Command::Completions(arguments) => arguments.run(whole()),
                }
            }
        }
    };
}

commands! {
    Run(run::RunArguments),
    Live(live::LiveArguments),
    Fleet(fleet::FleetArguments),
    Replay(replay::ReplayArguments),
    Check(check::CheckArguments),
    Routine(routine::RoutineArguments),
    Life(life::LifeArguments),
    Serve(serve::ServeArguments),
    Plan(plan::PlanArguments),
    Coverage(coverage::CoverageArguments),
    InstallSheet(install_sheet::InstallSheetArguments),
    Devices(devices::DevicesArguments),
    Inspect(inspect::InspectArguments),
    Locate(locate::LocateArguments),
    SensorFaults(sensor_faults::SensorFaultsArguments),
    Fit(fit::FitArguments),
    Compare(compare::CompareArguments),
    Realism(realism::RealismArguments),
    Density(density::DensityArguments),
    Measures(measures::MeasuresArguments),
    Alerts(alerts::AlertsArguments),
    Summary(summary::SummaryArguments),
    Find(find::FindArguments),
    Falls(falls::FallsArguments),
    Silhouettes(silhouettes::SilhouettesArguments),
    SuggestSensors(suggest_sensors::SuggestSensorsArguments),
    Day(day::DayArguments),
    Storyboard(storyboard::StoryboardArguments),
    Convert(convert::ConvertArguments),
    #[command(visible_alias = "anonymize")]
    Anonymise(anonymise::AnonymiseArguments),
    Label(label::LabelArguments),
    Doctor(doctor::DoctorArguments),
    Mqtt(mqtt::MqttArguments),
    Schema(schema::SchemaArguments),
    Parameters(parameters::ParametersArguments),
    New(new::NewArguments),
    Import(import::ImportArguments),
    Explain(explain::ExplainArguments),
}
