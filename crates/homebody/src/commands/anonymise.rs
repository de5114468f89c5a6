//! `homebody anonymise`: a log that no longer says whose it is.

use super::convert::{keep, rows_bar};
use super::read_log::Mapped;
use super::replacing::Replacing;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{tell, write_file};
use homebody_analysis::look::{Look, Looker, looked};
use homebody_analysis::signs::{Kind, Says, is_number, says};
use homebody_core::problem::counted;
use homebody_core::scenario::calendar::Calendar;
use homebody_log::places::can_be_written;
use homebody_log::sink::csv_line;
use homebody_log::{Anonymising, Log, Transfer, Url, anonymise};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Writes a log anew so that it no longer says whose it is: dates are shifted by whole weeks, sensors get names that say their
/// kind alone, and what they say stays if it is a number or a word of sensors, such as ON. Notes of activities, names of rooms and
/// all other text stay behind.
///
/// Days of the week and times of day stay, and how somebody lives shows: who knows them may know them still.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody anonymise week.csv --out csv:nobodys.csv
  homebody anonymise casas:home.txt --out sqlite:nobodys.db --key key.csv
  homebody anonymise home-assistant_v2.db --out csv:nobodys.csv --weeks -52

The key tells which sensor is which, as id,name: keep it to yourself. homebody look --sensors reads it.

{EXIT_CODES}."))]
pub struct Arguments {
    #[command(flatten)]
    log: Mapped,
    /// Where to: sqlite:FILE, csv:FILE or casas:FILE
    #[arg(long, value_name = "URL")]
    out: Url,
    /// Shift dates by so many weeks; without it the first week becomes that of 1 January 2001
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(i64).range(-52_000..=52_000))]
    weeks: Option<i64>,
    /// Keep the activities and their labels
    #[arg(long)]
    activities: bool,
    /// Write a table of which sensor is which
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
    /// The time zone in which a log in UTC is written where only local time is known
    #[arg(long, default_value = "UTC")]
    time_zone: String,
    #[command(flatten)]
    replacing: Replacing,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        Calendar::zone(&self.time_zone).map_err(Failure::asked)?;
        let named = self.log.find()?;
        keep(&self.out, &named.place.files())?;
        let key: Vec<&std::path::Path> = self.key.as_deref().into_iter().collect();
        can_be_written(&key, &named.place.files(), self.replacing.force)?;
        let (looker, log) = looked(Looker::new(None), &mut |take| named.stream(take))?;
        let look = looker.look(&named.name, named.place.form().name, &log, &|_| None, None);
        let names = names(&log, &look);
        let how = self.replacing.how(&self.out);
        let (from, mapping, zone) = (&named.place, &named.mapping, &self.time_zone);
        let transfer = Transfer { from, mapping, to: &self.out, name: NOBODYS, zone, how };
        let by = Anonymising {
            weeks: self.weeks,
            names: &names,
            keeps: &|value| is_number(value) || says(value) != Says::Else,
            with_activities: self.activities,
        };
        let progress = rows_bar(log.rows);
        let done = anonymise(&transfer, &log, &by, |rows| progress.set_position(rows));
        progress.finish_and_clear();
        let done = done?;
        if let Some(path) = &self.key {
            write_file(path, key_of(&names, &log.sensors).as_bytes(), self.replacing.force)?;
            tell(format_args!("{} tells which sensor is which: keep it to yourself", path.display()));
        }
        let (rows, sensors) = (counted(done.rows as usize, "row", "rows"), counted(names.len(), "sensor", "sensors"));
        tell(format_args!("{}: {rows} of {sensors}", self.out));
        if done.left_out > 0 {
            tell(format_args!("  {} rows of other text are left out", done.left_out));
        }
        if log.skipped > 0 {
            tell(format_args!("  {} lines were not understood; homebody look says which", log.skipped));
        }
        Ok(())
    }
}

/// What a log is called that is nobody's.
const NOBODYS: &str = "anonymised";

/// A name for each sensor of a log: its kind and a number, in the order in which they came.
fn names(log: &Log, look: &Look) -> Vec<String> {
    let kinds: BTreeMap<&str, Kind> = look.sensors.iter().map(|sensor| (sensor.id.as_str(), sensor.kind)).collect();
    let mut numbers: BTreeMap<&str, u32> = BTreeMap::new();
    let name = |id: &String| {
        let kind = kinds.get(id.as_str()).copied().unwrap_or(Kind::Reading).word();
        let number = numbers.entry(kind).or_default();
        *number += 1;
        format!("{kind}{number}")
    };
    log.sensors.iter().map(name).collect()
}

/// The table of names: which sensor has which.
fn key_of(names: &[String], ids: &[String]) -> String {
    let rows = names.iter().zip(ids).map(|(name, id)| csv_line([name.as_str(), id]) + "\n");
    std::iter::once("id,name\n".to_owned()).chain(rows).collect()
}
