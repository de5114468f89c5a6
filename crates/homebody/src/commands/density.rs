//! `homebody density`: motion density, hour by hour.

use super::log_input::{LogArguments, read_any_length};
use super::messages::{LogContentMessage, not_measurable};
use super::result_output::ResultOutput;
use crate::failure::Failure;
use crate::print::tell;
use homebody_analysis::dates;
use homebody_analysis::density::{DensityOptions, EntranceSource, NoMap, TexturedMap, density_of};
use homebody_core::nearest::nearest;
use homebody_core::problem::{Diagnostic, counted};
use homebody_core::time::Span;
use homebody_log::log::{ColumnRole, ColumnUse};
use homebody_picture::density_map;
use homebody_query::LoadedLog;
use homebody_simulation::run_length::span;
use std::collections::BTreeSet;
use std::path::PathBuf;

homebody_core::messages! {
    /// Problems with density maps.
    pub enum DensityMessage in "density" {
        /// `--door` names a sensor at the entrance, by its name in the log. Absences begin and end with its events.
        NoDoor { door: String, nearest: Option<String>, known: Vec<String> } error "no-door"
            ("--door {door:?}: no sensor has this name")
            advice (Some(match nearest {
                Some(nearest) => format!("did you mean {nearest:?}?"),
                None => format!("the sensors are {}", known.join(", ")),
            }));
        /// Measures and maps come from the events of sensors, above all of motion sensors. This log only lists what people did.
        OnlyActivities { log: String, activities: usize } error "only-activities"
            ("{log} has no rows of sensors, only {n}", n = counted(*activities, "activity", "activities"))
            hint ("homebody inspect {log} lists them");
    }
}

/// Map the motion density of each hour, with absences
///
/// This is the motion density map of Wang and Skubic (2008). Density is the number of firings of motion sensors per hour at home. An
/// OFF does not count.
///
/// An absence begins with an event at the entrance, if almost no events follow for half an hour. It ends with the next event at the
/// entrance.
/// Homebody picks the sensors at the entrance by their names, and the report lists them.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody density runs/tigerplace-1 --png density.png
  homebody density casas:tm000.txt --door MainEntryway --from 2016-07-12 --days 7 --csv density.csv
  homebody density runs/tigerplace-1 --compare real.csv --json")]
pub struct DensityArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Compare with this log: report the distance between the two maps, and draw both
    #[arg(long, value_name = "LOG")]
    compare: Option<String>,
    /// Sensor at the entrance (default: Homebody guesses it from the names of the sensors); repeatable
    #[arg(long, value_name = "SENSOR")]
    door: Vec<String>,
    /// Shortest time that counts as an absence, such as 10m or 2h
    #[arg(long, value_name = "DURATION", default_value = "30m", value_parser = span)]
    away_after: Span,
    /// First day of the map, such as 2009-03-02 (default: the first day of the log)
    #[arg(long, value_name = "DATE")]
    from: Option<dates::DayChoice>,
    /// Number of days (default: all days)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=3660))]
    days: Option<u32>,
    /// The home's time zone, for a log in UTC; not needed for a run folder, which stores it
    #[arg(long, value_name = "ZONE")]
    time_zone: Option<String>,
    /// Write the hours of the first log as CSV: date,hour,events,athome_h,density
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    output: ResultOutput,
}

impl DensityArguments {
    pub fn run(self) -> Result<(), Failure> {
        let zone = self.time_zone.as_deref();
        let log = self.log.read_any_length(zone)?;
        let other = self.compare.as_deref().map(|other| read_any_length(other, zone, self.log.how())).transpose()?;
        let sources: Vec<PathBuf> =
            [Some(&log), other.as_ref()].into_iter().flatten().flat_map(|log| log.sources.clone()).collect();
        let csv = self.csv.as_deref();
        let output = self.output.check_with_table([""], csv, &sources)?;

        let known: Vec<&LoadedLog> = [Some(&log), other.as_ref()].into_iter().flatten().collect();
        let problems: Vec<Diagnostic> = self.unknown_doors(&known).chain(self.unknown_day(&log)).collect();
        if !problems.is_empty() {
            return Err(Failure::all(problems));
        }
        let from = self.from.and_then(|from| from.within(log.dates()?));
        let days = self.days.map(|days| days as usize);
        let (doors, away_after) = (self.doors(&log), self.away_after);
        let asked = DensityOptions { doors, away_after, from, days, ..log.density_asked() };
        // The days of the other log are its own.
        let asked_of =
            |other: &LoadedLog| DensityOptions { doors: self.doors(other), away_after, days, ..other.density_asked() };
        let map = log.density(&asked).map_err(|why| no_map(self.log.text(), &log, &why))?;
        let against = other.as_ref().zip(self.compare.as_ref());
        let against =
            against.map(|(other, name)| other.density(&asked_of(other)).map_err(|why| no_map(name, other, &why)));
        let density = density_of(map, against.transpose()?);
        if [Some(&density.of), density.against.as_ref().map(|other| &other.of)].into_iter().flatten().any(is_by_name) {
            tell("note: guessed the sensors at the entrance by their names; --door SENSOR sets others");
        }
        for log in &known {
            let people = log.residents();
            if people.len() > 1 {
                tell(format_args!("note: {}: the density counts all residents: {}", log.name, people.join(", ")));
            }
        }
        output.write_with_table(&density, [&|| density_map(&density)], &|| density.of.map.csv())
    }

    fn doors(&self, log: &LoadedLog) -> Vec<String> {
        self.door.iter().filter(|door| log.log.sensors.contains(door)).cloned().collect()
    }

    fn unknown_doors(&self, logs: &[&LoadedLog]) -> impl Iterator<Item = Diagnostic> {
        let sensors = || logs.iter().flat_map(|log| log.log.sensors.iter().map(String::as_str));
        let unknown = self.door.iter().filter(move |door| !sensors().any(|sensor| sensor == **door));
        unknown.map(move |door| {
            let nearest = nearest(door, sensors()).map(str::to_owned);
            let known: BTreeSet<&str> = sensors().collect();
            let known = known.into_iter().map(str::to_owned).collect();
            Diagnostic::from(DensityMessage::NoDoor { door: door.clone(), nearest, known })
        })
    }

    fn unknown_day(&self, log: &LoadedLog) -> Option<Diagnostic> {
        let (asked, there) = (self.from?, log.dates()?);
        let problem = || {
            let [day, first, last] = [asked.to_string(), there.0.to_string(), there.1.to_string()];
            Diagnostic::from(LogContentMessage::NoDay { log: self.log.to_string(), day, first, last })
        };
        asked.within(there).is_none().then(problem)
    }
}

/// The failure of a log without a map and measures, with a hint.
pub fn no_map(name: &str, log: &LoadedLog, why: &NoMap) -> Failure {
    let activities = log.log.activities.len();
    let hint = match why {
        NoMap::TooLong(_) => "select a part with --from and --days".to_owned(),
        NoMap::Empty if activities > 0 => {
            return Failure::asked(DensityMessage::OnlyActivities { log: name.into(), activities });
        }
        NoMap::Disorder { .. } => format!("sort the rows of the log by time{}", sorting(name, &log.log.columns)),
        _ => String::new(),
    };
    let failure = not_measurable(name, why);
    if hint.is_empty() { failure } else { failure.advising(&hint) }
}

/// A command that sorts a CSV log by dates that start with the year; empty for other logs.
fn sorting(name: &str, columns: &[ColumnUse]) -> String {
    let is_time = |at: &usize| columns[*at].used_as == ColumnRole::Time;
    let keys: String = (0..columns.len()).filter(is_time).map(|at| format!(" -k{0},{0}", at + 1)).collect();
    let lower = name.to_lowercase();
    let (print, is_csv) = match lower.strip_suffix(".gz") {
        Some(unpacked) => ("zcat", unpacked.ends_with(".csv")),
        None => ("cat", lower.ends_with(".csv")),
    };
    let has_heading = columns.first().is_some_and(|of| of.column != "column 1");
    match is_csv && !keys.is_empty() {
        true if has_heading => format!(", as with {print} {name} | (sed -u 1q; LC_ALL=C sort -t,{keys}) > sorted.csv"),
        true => format!(", as with {print} {name} | LC_ALL=C sort -t,{keys} > sorted.csv"),
        false => String::new(),
    }
}

fn is_by_name(of: &TexturedMap) -> bool {
    of.map.entrance.chosen != EntranceSource::Asked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hint_sorts_rows_below_the_heading_by_time() {
        let column = |(column, used_as): &(&str, ColumnRole)| {
            let because = String::new();
            ColumnUse { column: (*column).into(), used_as: *used_as, because, is_guess: false }
        };
        let hint =
            |name: &str, columns: &[(&str, ColumnRole)]| sorting(name, &columns.iter().map(column).collect::<Vec<_>>());
        let headed = [("sensor", ColumnRole::Sensor), ("date", ColumnRole::Time), ("time", ColumnRole::Time)];
        assert_eq!(
            hint("log.csv.gz", &headed),
            ", as with zcat log.csv.gz | (sed -u 1q; LC_ALL=C sort -t, -k2,2 -k3,3) > sorted.csv"
        );
        let bare = [("column 1", ColumnRole::Time), ("column 2", ColumnRole::Sensor)];
        assert_eq!(hint("log.csv", &bare), ", as with cat log.csv | LC_ALL=C sort -t, -k1,1 > sorted.csv");
        assert_eq!((hint("log.db", &bare), hint("log.csv", &bare[1..])), (String::new(), String::new()));
    }
}
