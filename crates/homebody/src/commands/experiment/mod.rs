//! `homebody experiment`: what was measured in the real world, done again, and what is said, measured in lives.

mod alerts;
mod claims;
mod conditions;
mod daily_life;
mod falls;
mod godsey2009;
mod measures;
mod possible;
mod realism;
mod recogniser;
mod round_trip;
mod sensor_health;
mod sphere;
mod walk_back;

use crate::failure::Failure;

/// Does an experiment again that was done in the real world, or measures what routines come to, and says what agrees.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody experiment godsey2009 --svg firings.svg
  homebody experiment sphere --data sphere_challenge --svg rooms.svg
  homebody experiment daily-life --people 20 --days 14 --png people.png
  homebody experiment claims --json claims.json
  homebody experiment conditions
  homebody experiment possible
  homebody experiment realism --data casas --json realism.json
  homebody experiment walk-back --json walk-back.json
  homebody experiment measures --homes 8
  homebody experiment alerts --people 200 --json alerts.json
  homebody experiment falls --cases 100
  homebody experiment round-trip --homes 40
  homebody experiment sensor-health --homes 10
  homebody experiment recogniser --data uci")]
pub struct Arguments {
    #[command(subcommand)]
    experiment: Experiment,
}

#[derive(clap::Subcommand)]
enum Experiment {
    /// One sensor, one person, three paces, two distances: the paper's own experiment
    Godsey2009(godsey2009::Arguments),
    /// A real house whose sensors and whose resident's room were recorded, beside the same walks simulated
    Sphere(sphere::Arguments),
    /// Generated older adults lived at home, beside what was published of real ones
    DailyLife(daily_life::Arguments),
    /// What sentences of routines come to, beside their words
    Claims(claims::Arguments),
    /// What conditions do to a life, beside the sizes that their sources cite
    Conditions(conditions::Arguments),
    /// What cannot be, counted in lives: two on one spot, visits to nobody, meals before they are cooked
    Possible(possible::Arguments),
    /// Real homes beside a generated life that is sensed as they are
    Realism(realism::Arguments),
    /// Activities in a real flat, recognised by who has learnt from simulated days alone
    Recogniser(recogniser::Arguments),
    /// Where residents were, by their logs alone, beside the truth
    WalkBack(walk_back::Arguments),
    /// What residents did day by day, measured by their logs alone, beside the truth
    Measures(measures::Arguments),
    /// How soon alerts come after a condition has begun, and how often for nothing
    Alerts(alerts::Arguments),
    /// Falls and what looks like them, by the silhouettes of cameras
    Falls(falls::Arguments),
    /// Routines lived, their logs summarised, and each sentence held against the routine
    RoundTrip(round_trip::Arguments),
    /// What is wrong with sensors, by the logs of their homes alone, beside the faults that were planted
    SensorHealth(sensor_health::Arguments),
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
            Experiment::WalkBack(arguments) => arguments.run(),
            Experiment::Measures(arguments) => arguments.run(),
            Experiment::Alerts(arguments) => arguments.run(),
            Experiment::Falls(arguments) => arguments.run(),
            Experiment::RoundTrip(arguments) => arguments.run(),
            Experiment::SensorHealth(arguments) => arguments.run(),
        }
    }
}
