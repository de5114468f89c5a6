//! `homebody measures`: measures of daily life, day by day.

use super::density::no_map;
use super::log_input::LogArguments;
use super::result_output::ResultOutput;
use super::row_destinations::{RowDestinations, row};
use crate::failure::{EXIT_CODES, Failure};
use crate::print::warn;
use homebody_analysis::measures::{DayMeasures, Measures, TruthDetails};
use homebody_core::names::capitalised;
use homebody_core::time::{Interval, Span, WallTime};
use homebody_log::records::Records;
use homebody_picture::measures_picture;
use homebody_query::LoadedLog;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

homebody_core::messages! {
    /// Problems with the measures of a log.
    pub enum MeasuresMessage in "measures" {
        /// The sensors of the log and those of the home have different names, so Homebody knows no room of a sensor. Perhaps the log is
        /// of another home, or it has ids in place of names.
        OtherHome { log: String, home: PathBuf } error "other-home"
            ("the home in {home} has none of the sensors of {log}", home = home.display())
            hint ("homebody inspect {log} --home {home} lists the sensors of both", home = home.display());
        /// Homebody knows the rooms of less than half of the sensors. Measures of rooms leave out the events of the others.
        FewSensors { log: String, home: PathBuf, placed: usize, sensors: usize } warning "few-sensors"
            ("the home in {home} has only {placed} of the {sensors} sensors of {log}", home = home.display())
            hint ("homebody inspect {log} --home {home} lists the sensors of both", home = home.display());
        /// With `--resident`, measures come from the ground truth, which names the residents of the run.
        NoResident { resident: String, known: Vec<String> } error "no-resident"
            ("--resident {resident:?}: the ground truth has no such resident")
            advice (Some(match known.is_empty() {
                true => "leave out --resident: this log has no ground truth, which homebody run writes".to_owned(),
                false => format!("the residents are {}", known.join(", ")),
            }));
    }
}

/// Compute daily measures: sleep, bathroom, meals, outings, gait
///
/// The measures are time in bed and sleep, bathroom visits, showers, meals, outings, visitors, walks and walking speed, sitting,
/// motion density, and the regularity of days. A night counts for the day on which it ends.
///
/// A run knows the rooms of its sensors and their distances; --home sets them for another log. Without it, names decide the rooms, and
/// walking speed is unknown. With --resident, the measures come from the ground truth instead of the log.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody measures runs/tigerplace-1 --png measures.png
  homebody measures casas:tm000.txt --csv measures.csv
  homebody measures log.csv --home scenarios/tigerplace --json
  homebody measures runs/tigerplace-1 --out care.db --out fhir:observations.json

\"measures\" in the JSON and docs/reference/measures.md define each measure, with its unit and its
source. A day has no value for an unknown measure.

{EXIT_CODES}."))]
pub struct MeasuresArguments {
    #[command(flatten)]
    measured: MeasuresSource,
    /// Write a CSV file with a row for each day and a column for each measure
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    programs: RowDestinations,
    #[command(flatten)]
    output: ResultOutput,
}

impl MeasuresArguments {
    pub fn run(self) -> Result<(), Failure> {
        let read = self.measured.read()?;
        let output = self.output.check_with_table([""], self.csv.as_deref(), &read.sources)?;
        let output = output.silent_if(self.programs.is_printed());
        self.programs.check(true, &read.sources, self.output.replaces())?;
        let measures = self.measured.measures(&read)?;
        let patient = self.measured.subject(&read);
        self.programs.store(&records(&measures), &|| measures.fhir(&patient), self.output.replaces())?;
        output.write_with_table(&measures, [&|| measures_picture(&measures)], &|| measures.csv())
    }
}

fn records(measures: &Measures) -> Records {
    let of_day = |day: &DayMeasures| {
        let known = measures.measures.iter().zip(&day.values).filter_map(|(measure, value)| Some((measure, (*value)?)));
        let date = day.date.to_string();
        let rows: Vec<Map<String, Value>> = known
            .map(|(measure, value)| {
                let is_guess = measures.guesses.contains(&measure.name);
                row(&json!({
                    "log": measures.name, "date": date, "measure": measure.name,
                    "value": value, "unit": measure.unit, "is_guess": is_guess
                }))
            })
            .collect();
        rows
    };
    let columns = &["log", "date", "measure", "value", "unit", "is_guess"];
    Records { kind: "measure", columns, rows: measures.days.iter().flat_map(of_day).collect() }
}

/// A log that is measured.
#[derive(clap::Args)]
pub struct MeasuresSource {
    #[command(flatten)]
    log: LogArguments,
    /// Scenario with the home of the log, for the rooms of its sensors
    #[arg(long, value_name = "SCENARIO")]
    home: Option<PathBuf>,
    /// Compute the measures of this resident from the ground truth instead of the log
    #[arg(long, value_name = "NAME")]
    resident: Option<String>,
    /// The home's time zone, for a log in UTC; not needed for a run folder, which stores it
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
}

impl MeasuresSource {
    pub fn subject(&self, read: &LoadedLog) -> String {
        self.resident.as_deref().map_or_else(|| read.subject(), capitalised)
    }

    pub fn is_there(&self) -> bool {
        let file = self.log.text().split_once(':').map_or(self.log.text(), |(_, file)| file);
        Path::new(file).exists() || Path::new(self.log.text()).exists()
    }

    /// Reads the log, with the rooms of its sensors.
    pub fn read(&self) -> Result<LoadedLog, Failure> {
        let mut read = self.log.read_any_length(self.time_zone.as_deref())?;
        let Some(home) = &self.home else { return Ok(read) };
        let placed = read.place_in(&homebody_simulation::ScenarioSource::at(home)?.scenario()?);
        let (log, home, sensors) = (self.log.to_string(), home.clone(), read.log.sensors.len());
        if placed == 0 {
            return Err(Failure::asked(MeasuresMessage::OtherHome { log, home }));
        }
        if placed * 2 < sensors {
            warn(MeasuresMessage::FewSensors { log, home, placed, sensors });
        }
        Ok(read)
    }

    pub fn measures(&self, read: &LoadedLog) -> Result<Measures, Failure> {
        if let Some(resident) = &self.resident {
            return true_measures(read, resident);
        }
        read.measures().map_err(|why| no_map(self.log.text(), read, &why))
    }
}

/// The span from the first row of a log to its last one, inclusive.
pub fn within(read: &LoadedLog) -> Option<Interval<WallTime>> {
    read.rows_span().map(|rows| Interval::new(rows.begin, rows.end + Span::MICROSECOND))
}

fn true_measures(read: &LoadedLog, resident: &str) -> Result<Measures, Failure> {
    let Some(person) = read.timeline.people.iter().find(|person| person.name == resident) else {
        let known = read.timeline.people.iter().map(|person| person.name.clone()).collect();
        return Err(Failure::asked(MeasuresMessage::NoResident { resident: resident.to_owned(), known }));
    };
    let recorded = read.recorded.or_else(|| within(read)).unwrap_or_default();
    let beside = TruthDetails { company: read.company(), ..TruthDetails::default() };
    Ok(Measures::from_detailed_truth(&format!("{}, {resident}", read.name), person, &beside, recorded))
}
