//! `homebody install-sheet`: the sensors of a home, for the installer.

use super::result_output::ResultOutput;
use super::scenario::ScenarioArguments;
use crate::failure::Failure;
use crate::print::{tell, write_file};
use homebody_analysis::coverage::{self, STEP_M};
use homebody_analysis::parts::{PartsList, SensorLayout, beside};
use homebody_core::resident::Build;
use homebody_core::scenario::load::Scenario;
use homebody_log::run::places::can_be_written;
use homebody_picture::{coverage_map, installing, pdf};
use homebody_simulation::ScenarioSource;
use std::path::PathBuf;

/// List the sensors of a home for the installer, with positions
///
/// Each line has the device, its distances from two walls, its mounting height and its direction. --compare sets two layouts side by
/// side: what each sees, and their differences. --pdf writes sheets to print: the plan with coverage and legend, then the list.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody install-sheet scenarios/tigerplace
  homebody install-sheet my-home --csv sensors.csv --pdf sheet.pdf
  homebody install-sheet my-home --compare my-home-with-six --json")]
pub struct InstallSheetArguments {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Compare with the sensors of this scenario
    #[arg(long, value_name = "SCENARIO")]
    compare: Option<PathBuf>,
    /// Write the list as CSV
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,
    /// Write sheets to print as PDF
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pdf: Option<PathBuf>,
    #[command(flatten)]
    output: ResultOutput,
}

impl InstallSheetArguments {
    pub fn run(self) -> Result<(), Failure> {
        let source = self.scenario.source()?;
        let scenario = source.scenario()?;
        let mut sources = source.paths(&scenario);
        let other = match &self.compare {
            None => None,
            Some(path) => {
                let source = ScenarioSource::at(path)?;
                let other = source.scenario()?;
                sources.extend(source.paths(&other));
                Some((path.display().to_string(), other))
            }
        };
        let output = self.output.check_with_table([""], self.csv.as_deref(), &sources)?;
        if let Some(path) = &self.pdf {
            can_be_written(&[path.as_path()], &sources, self.output.replaces())?;
        }
        let (home, build, parts) = (&scenario.home, build(&scenario), PartsList::from_home(&scenario.home));
        if let Some(path) = &self.pdf {
            let pages = installing(home, &coverage::of_home(home, build, STEP_M), &parts);
            let bytes = pdf(&home.name, &pages);
            let bytes = bytes.map_err(Failure::file)?;
            write_file(path, &bytes, self.output.replaces())?;
            tell(format_args!("wrote {}", path.display()));
        }
        let map = || {
            let seen = coverage::of_home(home, build, STEP_M);
            coverage_map(&seen.home, &seen.coverage, &seen.beams())
        };
        let table = || parts.csv();
        match other {
            None => output.write_with_table(&parts, [&map], &table),
            Some((path, other)) => {
                let one = SensorLayout { name: &self.scenario.name(), home, build };
                let two = SensorLayout { name: &path, home: &other.home, build };
                output.write_with_table(&beside([one, two]), [&map], &table)
            }
        }
    }
}

/// The body of the first resident, or an adult's in a home without residents.
pub fn build(scenario: &Scenario) -> Build {
    scenario.residents.first().map_or_else(Build::adult, |resident| Build::new(&resident.file))
}
