//! `homebody measure`: what somebody has been doing, day by day.

use super::answer::Answer;
use super::density::no_map;
use super::for_programs::{ForPrograms, row};
use super::read_log::{HowRead, read_any_length};
use crate::failure::{EXIT_CODES, Failure};
use crate::print::tell;
use homebody_analysis::measures::{Beside, Day, Measures};
use homebody_core::names::capitalised;
use homebody_kit::LogWithRun;
use homebody_log::records::Records;
use homebody_picture::measures_picture;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Says and draws what somebody has been doing, day by day: time in bed and sleep, visits to the bathroom, showers, meals,
/// outings, visitors, ways and how fast they were walked, sitting, density, and how even the days are.
///
/// The log of a run knows the rooms of its sensors and how far apart they are, --home tells those of another; without it names
/// tell rooms, and speeds in metres a second are not known. A night counts
/// to the day on which it ends. With --resident the same is taken
/// from what a resident did, where the truth of the run is there.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody measure runs/tigerplace-1 --png measures.png
  homebody measure casas:tm000.txt --csv measures.csv
  homebody measure log.csv --home scenarios/tigerplace --json
  homebody measure runs/tigerplace-1 --out sqlite:care.db --out fhir:observations.json

What each measure is, with its unit and its source, stands in \"measures\" of the JSON and in
docs/reference/measures.md. Of what is not known a day has no value.

{EXIT_CODES}."))]
pub struct Arguments {
    #[command(flatten)]
    measured: Measured,
    /// Write a table with a row for each day and a column for each measure
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    programs: ForPrograms,
    #[command(flatten)]
    answer: Answer,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let read = self.measured.read()?;
        let answer = self.answer.check_beside([""], self.csv.as_deref(), &read.sources)?;
        self.programs.check(true, &read.sources, self.answer.replaces())?;
        let measures = self.measured.measures(&read)?;
        let patient = self.measured.subject(&read);
        self.programs.store(&records(&measures), &|| measures.fhir(&patient), self.answer.replaces())?;
        let picture = || measures_picture(&measures);
        match self.programs.is_printed() {
            true => answer.give_to_files(&measures, [&picture], &|| measures.csv()),
            false => answer.give_beside(&measures, [&picture], &|| measures.csv()),
        }
    }
}

/// A row for each measure of each day.
fn records(measures: &Measures) -> Records {
    let of_day = |day: &Day| {
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
pub struct Measured {
    /// A log: a file, the folder of a run or of a data set, or FORM:FILE
    log: String,
    #[command(flatten)]
    how: HowRead,
    /// The scenario with the home of the log, which tells which room each sensor is in
    #[arg(long, value_name = "SCENARIO")]
    home: Option<PathBuf>,
    /// Take the measures from what this resident did, as the truth of the run tells it, instead of from the log
    #[arg(long, value_name = "NAME")]
    resident: Option<String>,
    /// The home's time zone, for logs in UTC; a run knows its own
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
}

impl Measured {
    /// Whom they are about.
    pub fn subject(&self, read: &LogWithRun) -> String {
        self.resident.as_deref().map_or_else(|| read.subject(), capitalised)
    }

    /// Whether there is anything where the log is looked for.
    pub fn is_there(&self) -> bool {
        let file = self.log.split_once(':').map_or(self.log.as_str(), |(_, file)| file);
        Path::new(file).exists() || Path::new(&self.log).exists()
    }

    /// Reads the log, with its sensors in their rooms.
    pub fn read(&self) -> Result<LogWithRun, Failure> {
        let mut read = read_any_length(&self.log, self.time_zone.as_deref(), &self.how)?;
        let Some(home) = &self.home else { return Ok(read) };
        let placed = read.place_in(&homebody_kit::Source::at(home)?.scenario()?);
        let (log, home, sensors) = (&self.log, home.display(), read.log.sensors.len());
        let hint = format!("homebody look {log} --home {home} tells what each has");
        if placed == 0 {
            return Err(Failure::usage(format!("{log}: none of its sensors is one of this home\n  hint: {hint}")));
        }
        if placed * 2 < sensors {
            tell(format_args!(
                "warning: {log}: only {placed} of its {sensors} sensors are of this home\n  hint: {hint}"
            ));
        }
        Ok(read)
    }

    /// Measures it.
    pub fn measures(&self, read: &LogWithRun) -> Result<Measures, Failure> {
        if let Some(resident) = &self.resident {
            return lived(read, resident);
        }
        read.measures().map_err(|why| no_map(&self.log, read, &why))
    }
}

/// The measures of what a resident did.
fn lived(read: &LogWithRun, resident: &str) -> Result<Measures, Failure> {
    let Some(life) = read.lives.iter().find(|life| life.resident == resident) else {
        let known: Vec<&str> = read.lives.iter().map(|life| life.resident.as_str()).collect();
        let hint = match known.is_empty() {
            true => "there is no truth beside this log; homebody run writes one".to_owned(),
            false => format!("the residents are {}", known.join(", ")),
        };
        return Err(Failure::usage(format!("--resident {resident:?}: the truth has no such resident\n  hint: {hint}")));
    };
    let of_log = read.rows_span().map(|(first, last)| first..last + 1);
    let recorded = read.recorded.clone().or(of_log).unwrap_or(0..0);
    let beside = Beside { company: read.company(), ..Beside::default() };
    Ok(Measures::lived_beside(&format!("{}, {resident}", read.name), life, &beside, recorded))
}
