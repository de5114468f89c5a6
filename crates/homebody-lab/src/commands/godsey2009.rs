use crate::godsey2009::{GodseyExperiment, LENGTH_S};
use homebody::shared::{Failure, ResultOutput};
use homebody_picture::{FiringLane, Reference, TotalsLine, firing_chart, totals_chart};

/// Repeat the experiment of Godsey & Skubic 2009 with one sensor
///
/// One person walks past one motion sensor at three speeds and two distances.
#[derive(clap::Args)]
#[command(after_long_help = "Example:\n  homebody-lab godsey2009 --json figures.json --svg firings.svg")]
pub struct Godsey2009LabArguments {
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = 2009)]
    seed: u64,
    #[command(flatten)]
    output: ResultOutput,
}

impl Godsey2009LabArguments {
    pub fn run(self) -> Result<(), Failure> {
        let output = self.output.check(["", "totals"], &[])?;
        let experiment = GodseyExperiment::run(self.seed)?;
        output.write(&experiment, [&|| firings(&experiment), &|| totals(&experiment)])
    }
}

/// The paper's figure 4: firings over time, portions A, B and C.
fn firings(experiment: &GodseyExperiment) -> String {
    let activities: Vec<FiringLane> = experiment
        .activities
        .iter()
        .map(|activity| FiringLane {
            label: format!("{} m/s, {:.2} m", activity.speed_mps, activity.distance_m),
            portion: activity.portion,
            firings_s: activity.fired_s.clone(),
        })
        .collect();
    firing_chart("Firings of one sensor, five minutes each", &activities, LENGTH_S)
}

/// The dependence of the total on assumptions, which the paper does not state.
fn totals(experiment: &GodseyExperiment) -> String {
    let rows = experiment.totals.chunk_by(|a, b| a.assumptions.turn_s == b.assumptions.turn_s);
    let lines: Vec<TotalsLine> = rows
        .map(|row| TotalsLine {
            label: format!("turns of {} s", row[0].assumptions.turn_s),
            points: row.iter().map(|total| (total.assumptions.walk_m, total.firings as f64)).collect(),
        })
        .collect();
    let published = Reference { label: "published".into(), total: experiment.published.firings as f64 };
    totals_chart("Total firings by length of the walk", ["length of the walk, m", "firings"], &lines, Some(&published))
}
