//! `homebody measure`: what somebody has been doing, day by day.

use super::answer::Answer;
use super::read_log::read_log;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::tell;
use homebody_analysis::density::Asked;
use homebody_analysis::measures::Measures;
use homebody_kit::LogWithRun;
use homebody_picture::measures_picture;
use std::path::PathBuf;

/// Says and draws what somebody has been doing, day by day: time in bed and sleep, visits to the bathroom, showers, meals,
/// outings, ways and how fast they were walked, sitting, density, and how even the days are.
///
/// The log of a run knows the rooms of its sensors, --home tells those of another; without it names tell them. A night counts
/// to the day on which it ends. With --resident the same is taken
/// from what a resident did, where the truth of the run is there.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody measure runs/tigerplace-1 --png measures.png
  homebody measure casas:tm000.txt --csv measures.csv
  homebody measure log.csv --home scenarios/tigerplace --json

What each measure is, with its unit and its source, stands in \"measures\" of the JSON and in
docs/measures.md. Of what is not known a day has no value.

{EXIT_CODES}."))]
pub struct Arguments {
    #[command(flatten)]
    measured: Measured,
    /// Write a table with a row for each day and a column for each measure
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    answer: Answer,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        let read = self.measured.read()?;
        let answer = self.answer.check_beside([""], self.csv.as_deref(), &read.sources)?;
        let measures = self.measured.measures(&read)?;
        answer.give_beside(&measures, [&|| measures_picture(&measures)], &|| measures.csv())
    }
}

/// A log that is measured.
#[derive(clap::Args)]
pub struct Measured {
    /// A log: a file, the folder of a run or of a data set, or FORM:FILE
    log: String,
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
    /// The resident from whose life the measures are taken, if one is asked for.
    pub fn resident(&self) -> Option<&str> {
        self.resident.as_deref()
    }

    /// Reads the log, with its sensors in their rooms.
    pub fn read(&self) -> Result<LogWithRun, Failure> {
        let mut read = read_log(&self.log, self.time_zone.as_deref())?;
        if let Some(home) = &self.home
            && read.place_in(&homebody_kit::Source::at(home)?.scenario()?) == 0
        {
            let (log, home) = (&self.log, home.display());
            let hint = format!("homebody look {log} --home {home} tells what each has");
            return Err(Failure::usage(format!("{log}: none of its sensors is one of this home\n  hint: {hint}")));
        }
        Ok(read)
    }

    /// Measures it.
    pub fn measures(&self, read: &LogWithRun) -> Result<Measures, Failure> {
        if let Some(resident) = &self.resident {
            return lived(read, resident);
        }
        let residents: Vec<&str> = read.lives.iter().map(|life| life.resident.as_str()).collect();
        if residents.len() > 1 {
            let all = residents.join(", ");
            let hint = "--resident NAME tells of one";
            tell(format_args!("{}: its measures are of all who are there: {all}; {hint}", read.name));
        }
        let asked = Asked { recorded: read.recorded.clone(), ..Asked::default() };
        Measures::heard(&read.name, &read.log, &read.rooms, &asked)
            .map_err(|why| Failure::usage(format!("{}: {why}", &self.log)))
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
    let times = || read.log.events.iter().map(|event| event.at);
    let of_log = times().min().zip(times().max()).map(|(first, last)| first..last + 1);
    let recorded = read.recorded.clone().or(of_log).unwrap_or(0..0);
    Ok(Measures::lived(&format!("{}, {resident}", read.name), life, recorded))
}
