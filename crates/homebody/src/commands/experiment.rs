//! `homebody experiment`: what was measured in the real world, done again.

use super::{print_json, print_text, write_file};
use crate::failure::Failure;
use homebody_log::fresh::all_can_be_written;
use homebody_study::godsey2009;
use homebody_study::picture::{Activity, Reference, TotalsLine, firing_chart, totals_chart};
use std::path::PathBuf;

/// Does an experiment again that was done in the real world, and says what agrees.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody experiment godsey2009 --svg firings.svg
  homebody experiment sphere --data sphere-challenge")]
pub struct Arguments {
    #[command(subcommand)]
    experiment: Experiment,
}

#[derive(clap::Subcommand)]
enum Experiment {
    /// One sensor, one person, three paces, two distances: the paper's own experiment
    Godsey2009(Godsey2009),
}

#[derive(clap::Args)]
struct Godsey2009 {
    /// The number all randomness comes from
    #[arg(long, default_value_t = 2009)]
    seed: u64,
    #[command(flatten)]
    output: Output,
}

#[derive(clap::Args)]
struct Output {
    /// Write all figures as one JSON object into this file, or on standard output without one
    #[arg(long, value_name = "FILE", num_args = 0..=1, default_missing_value = "-")]
    json: Option<PathBuf>,
    /// Draw the figure as SVG
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        match self.experiment {
            Experiment::Godsey2009(arguments) => arguments.run(),
        }
    }
}

impl Godsey2009 {
    fn run(self) -> Result<(), Failure> {
        let svg = self.output.svg.as_ref().map(|path| (path, path.with_extension("totals.svg")));
        let json = self.output.json.as_deref().filter(|path| path.as_os_str() != "-");
        let figures = svg.iter().flat_map(|(path, totals_path)| [path.as_path(), totals_path]);
        all_can_be_written(&figures.chain(json).collect::<Vec<_>>(), self.output.force)?;
        let experiment = godsey2009::Experiment::run(self.seed)?;
        if let Some((path, totals_path)) = &svg {
            write_file(path, firings(&experiment).as_bytes(), self.output.force)?;
            write_file(totals_path, totals(&experiment).as_bytes(), self.output.force)?;
        }
        self.output.tell(&experiment)
    }
}

impl Output {
    /// The figures as JSON where that is asked for, else for people.
    fn tell<E: serde::Serialize + std::fmt::Display>(&self, experiment: &E) -> Result<(), Failure> {
        match &self.json {
            Some(path) if path.as_os_str() == "-" => return print_json(experiment),
            Some(path) => {
                let text = serde_json::to_string_pretty(experiment).map_err(Failure::usage)? + "\n";
                write_file(path, text.as_bytes(), self.force)?;
            }
            None => {}
        }
        print_text(&experiment.to_string())
    }
}

/// The paper's figure 4: firings over time, portions A, B and C.
fn firings(experiment: &godsey2009::Experiment) -> String {
    let activities: Vec<Activity> = experiment
        .activities
        .iter()
        .map(|activity| Activity {
            label: format!("{} m/s at {:.2} m", activity.speed_mps, activity.distance_m),
            portion: activity.portion,
            firings_s: activity.fired_s.clone(),
        })
        .collect();
    firing_chart("Firings of one sensor, five minutes each", &activities, 300.0)
}

/// How the total depends on what the paper does not say.
fn totals(experiment: &godsey2009::Experiment) -> String {
    let rows = experiment.totals.chunk_by(|a, b| a.assumptions.turn_s == b.assumptions.turn_s);
    let lines: Vec<TotalsLine> = rows
        .map(|row| TotalsLine {
            label: format!("turns of {} s", row[0].assumptions.turn_s),
            points: row.iter().map(|total| (total.assumptions.walk_m, total.firings as f64)).collect(),
        })
        .collect();
    let published = Reference { label: "published".into(), total: experiment.published.firings as f64 };
    totals_chart(
        "Firings in all, by length of the walk",
        ["length of the walk, m", "firings"],
        &lines,
        Some(&published),
    )
}
