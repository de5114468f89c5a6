//! `homebody experiment`: published measurements repeated, and the program evaluated against its ground truth.

mod alerts;
mod claims;
mod conditions;
mod daily_life;
mod falls;
mod godsey2009;
mod measures;
pub mod messages;
mod possible;
mod realism;
mod recogniser;
mod round_trip;
mod sensor_health;
mod sphere;
mod walk_back;

use crate::failure::Failure;

/// Repeat an experiment that validates Homebody
///
/// Each experiment compares results of Homebody with published figures, with logs of real homes, or with the ground truth of simulated
/// homes.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody experiment godsey2009 --svg firings.svg
  homebody experiment sphere --data sphere_challenge --svg rooms.svg
  homebody experiment daily-life --people 20 --days 14 --png people.png
  homebody experiment claims --json claims.json
  homebody experiment conditions
  homebody experiment possible
  homebody experiment realism --data casas --json realism.json
  homebody experiment locate --json locate.json
  homebody experiment measures --homes 8
  homebody experiment alerts --people 200 --json alerts.json
  homebody experiment falls --cases 100
  homebody experiment round-trip --homes 40
  homebody experiment sensor-faults --homes 10
  homebody experiment recogniser --data uci")]
pub struct Arguments {
    #[command(subcommand)]
    experiment: Experiment,
}

#[derive(clap::Subcommand)]
enum Experiment {
    Godsey2009(godsey2009::Arguments),
    Sphere(sphere::Arguments),
    DailyLife(daily_life::Arguments),
    Claims(claims::Arguments),
    Conditions(conditions::Arguments),
    Possible(possible::Arguments),
    Realism(realism::Arguments),
    Recogniser(recogniser::Arguments),
    Locate(walk_back::Arguments),
    Measures(measures::Arguments),
    Alerts(alerts::Arguments),
    Falls(falls::Arguments),
    RoundTrip(round_trip::Arguments),
    SensorFaults(sensor_health::Arguments),
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        match self.experiment {
            Experiment::Godsey2009(arguments) => arguments.run(),
            Experiment::Sphere(arguments) => arguments.run(),
            Experiment::DailyLife(arguments) => arguments.run(),
            Experiment::Claims(arguments) => arguments.run(),
            Experiment::Conditions(arguments) => arguments.run(),
            Experiment::Possible(arguments) => arguments.run(),
            Experiment::Realism(arguments) => arguments.run(),
            Experiment::Recogniser(arguments) => arguments.run(),
            Experiment::Locate(arguments) => arguments.run(),
            Experiment::Measures(arguments) => arguments.run(),
            Experiment::Alerts(arguments) => arguments.run(),
            Experiment::Falls(arguments) => arguments.run(),
            Experiment::RoundTrip(arguments) => arguments.run(),
            Experiment::SensorFaults(arguments) => arguments.run(),
        }
    }
}
