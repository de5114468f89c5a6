//! The commands, one file each, all in the same shape: the arguments as a struct, with a `run`.

mod alerts;
mod anonymise;
mod answer;
mod calibrate;
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
mod experiment;
pub mod explain;
mod falls;
mod find;
pub mod fleet;
mod follow;
mod for_programs;
mod health;
mod import;
mod label;
mod live;
mod lived;
mod look;
mod measure;
mod mqtt;
mod new;
mod numbers;
mod parts;
mod place;
mod plan;
mod read_log;
mod realism;
mod replacing;
mod replay;
mod routine;
mod run;
mod scenario;
mod schema;
mod serve;
mod silhouettes;
mod strip;
mod summarise;
mod translate;

use crate::failure::Failure;
use clap::Subcommand;

#[derive(Subcommand)]
pub enum Command {
    /// Live a scenario and store what its sensors say
    Run(run::Arguments),
    /// Live a home on the world's clock, for as long as nobody stops it
    Live(live::Arguments),
    /// Live thousands of homes at once on the world's clock, to see what a back end bears
    Fleet(fleet::Arguments),
    /// Live a recording again, byte for byte
    Replay(replay::Arguments),
    /// Report everything that is wrong with a scenario
    Check(check::Arguments),
    /// Check, explain and try routines: lives in plain language
    Routine(routine::Arguments),
    /// Open a page on which a scenario is seen, driven and played
    Serve(serve::Arguments),
    /// Draw the floor plan of a home
    Plan(plan::Arguments),
    /// Say where in the home the sensors see, with a map
    Coverage(coverage::Arguments),
    /// List what is put up in a home, with places, heights and angles; two layouts side by side; a sheet to print
    Parts(parts::Arguments),
    /// List the motion sensors that can be picked for a home, with what is known of each
    Devices(devices::Arguments),
    /// Say what a log holds, and what is odd about it, with a map
    Look(look::Arguments),
    /// Walk a log back through the plan of its home: who was where, and how sure that is
    Translate(translate::Arguments),
    /// Say what is wrong with the sensors of a home, by its log
    Health(health::Arguments),
    /// Fit a scenario to the log of its home, and hold it against days that it was not fitted to
    Calibrate(calibrate::Arguments),
    /// Compare the firings of two logs
    Compare(compare::Arguments),
    /// Say how near a log is to a real one, and what gives it away
    Realism(realism::Arguments),
    /// Say how much somebody moves in each hour of each day, with a map
    Density(density::Arguments),
    /// Say what somebody has been doing day by day: bed, bathroom, meals, outings, pace, with a picture
    Measure(measure::Arguments),
    /// Say what is different from before in what somebody does
    Alerts(alerts::Arguments),
    /// Say in sentences how somebody has been doing of late, and what has changed
    Summarise(summarise::Arguments),
    /// Find when something was so, over a whole log: somebody in a room, something on, nothing stirring, falls, lost messages, alerts
    Find(find::Arguments),
    /// Find falls in the silhouettes that a run's cameras have kept, and say how sure that is
    Falls(falls::Arguments),
    /// Show the silhouettes that a run's cameras have kept, as pictures, a film or a table
    Silhouettes(silhouettes::Arguments),
    /// Propose where sensors go in a home, and say what each additional one buys
    Place(place::Arguments),
    /// Say what happened on one day, with a chart
    Day(day::Arguments),
    /// Show moments of a run side by side, as a film strip
    Strip(strip::Arguments),
    /// Do an experiment again that was done in the real world
    Experiment(experiment::Arguments),
    /// Carry a log from one form into another
    Convert(convert::Arguments),
    /// Write a log anew so that it no longer says whose it is
    Anonymise(anonymise::Arguments),
    /// Join a log with the truth of its run, for recognisers to be trained on
    Label(label::Arguments),
    /// Say what is wrong with an installation, a log, a truth, a database, a broker or a run's folder
    Doctor(doctor::Arguments),
    /// Tidy a broker of MQTT up that homes were told to
    Mqtt(mqtt::Arguments),
    /// Write the JSON Schemas of the scenario files into a folder
    Schema(schema::Arguments),
    /// List the numbers that the models are made of, and that a scenario may set
    Numbers(numbers::Arguments),
    /// Begin a scenario of your own from a template
    New(new::Arguments),
    /// Begin a scenario of your own from a plan of Sweet Home 3D
    Import(import::Arguments),
    /// Explain a message by its code
    Explain(explain::Arguments),
    /// Print what makes a shell complete the command line
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
            Command::Parts(arguments) => arguments.run(),
            Command::Devices(arguments) => arguments.run(),
            Command::Look(arguments) => arguments.run(),
            Command::Translate(arguments) => arguments.run(),
            Command::Health(arguments) => arguments.run(),
            Command::Calibrate(arguments) => arguments.run(),
            Command::Compare(arguments) => arguments.run(),
            Command::Realism(arguments) => arguments.run(),
            Command::Density(arguments) => arguments.run(),
            Command::Measure(arguments) => arguments.run(),
            Command::Alerts(arguments) => arguments.run(),
            Command::Summarise(arguments) => arguments.run(),
            Command::Find(arguments) => arguments.run(),
            Command::Falls(arguments) => arguments.run(),
            Command::Silhouettes(arguments) => arguments.run(),
            Command::Place(arguments) => arguments.run(),
            Command::Day(arguments) => arguments.run(),
            Command::Strip(arguments) => arguments.run(),
            Command::Experiment(arguments) => arguments.run(),
            Command::Convert(arguments) => arguments.run(),
            Command::Anonymise(arguments) => arguments.run(),
            Command::Label(arguments) => arguments.run(),
            Command::Doctor(arguments) => arguments.run(),
            Command::Mqtt(arguments) => arguments.run(),
            Command::Schema(arguments) => arguments.run(),
            Command::Numbers(arguments) => arguments.run(),
            Command::New(arguments) => arguments.run(),
            Command::Import(arguments) => arguments.run(),
            Command::Explain(arguments) => arguments.run(),
            Command::Completions(arguments) => arguments.run(whole()),
        }
    }
}
