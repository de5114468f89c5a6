//! `homebody anonymise`: a log without names, places and dates.

use super::convert::{refuse_inputs, show_rows};
use super::log_input::LogArguments;
use super::replacing::Replacing;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{counted, tell, write_file};
use homebody_analysis::look::{LogOverview, Looker, looked};
use homebody_analysis::signs::{Kind, Says, is_number, says};
use homebody_core::calendar::Calendar;
use homebody_log::anonymise;
use homebody_log::run::places::can_be_written;
use homebody_log::sink::csv_line;
use homebody_log::{Anonymising, Log, Transfer, Url};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Remove names, places and dates from a log
///
/// Homebody shifts dates by whole weeks and names each sensor by its kind and a number. It keeps values that are numbers or words of
/// sensors, such as ON, and drops activities, room names and all other text.
///
/// Days of the week, times of day and the resident's habits stay: a person who knows the resident may still recognise them.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody anonymise week.csv --out anonymous.csv
  homebody anonymise casas:home.txt --out anonymous.db --key key.csv
  homebody anonymise home-assistant_v2.db --out anonymous.csv --weeks -52

--key writes the original name of each sensor, as id,name: keep it secret. homebody inspect --sensors
reads it.

{EXIT_CODES}."))]
pub struct AnonymiseArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Destination: FILE.csv, FILE.db, casas:FILE and so on (homebody convert --help lists all forms)
    #[arg(short, long, value_name = "DESTINATION", help_heading = "Output")]
    out: Url,
    /// Shift dates by N weeks (default: the first week becomes that of 1 January 2001)
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(i64).range(-52_000..=52_000))]
    weeks: Option<i64>,
    /// Keep the activities of the log
    #[arg(long)]
    activities: bool,
    /// Write the original name of each sensor to a CSV file
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    key: Option<PathBuf>,
    /// Time zone of the output, if the log is in UTC and the form of the output has only local time
    #[arg(long, value_name = "ZONE", default_value = "UTC")]
    time_zone: String,
    #[command(flatten)]
    replacing: Replacing,
}

impl AnonymiseArguments {
    pub fn run(self) -> Result<(), Failure> {
        Calendar::zone(&self.time_zone).map_err(Failure::asked)?;
        let named = self.log.find()?;
        refuse_inputs(&self.out, &named.place.files())?;
        let key: Vec<&std::path::Path> = self.key.as_deref().into_iter().collect();
        can_be_written(&key, &named.place.files(), self.replacing.force)?;
        let (looker, log) = looked(Looker::new(None), &mut |take| named.stream(take))?;
        let look = looker.look(&named.name, named.place.form().name, &log, &|_| None, None);
        let names = names(&log, &look);
        let how = self.replacing.how(&self.out);
        let (from, mapping, zone) = (&named.place, &named.mapping, &self.time_zone);
        let transfer = Transfer { from, mapping, to: &self.out, name: ANONYMOUS, zone, how };
        let by = Anonymising {
            weeks: self.weeks,
            names: &names,
            keeps: &|value| is_number(value) || says(value) != Says::Else,
            with_activities: self.activities,
        };
        let done = show_rows(log.rows, |progress| anonymise(&transfer, &log, &by, progress))?;
        if let Some(path) = &self.key {
            write_file(path, key_of(&names, &log.sensors).as_bytes(), self.replacing.force)?;
            tell(format_args!("wrote {}, with the original name of each sensor: keep it secret", path.display()));
        }
        let (rows, sensors) = (counted(done.rows, "row", "rows"), counted(names.len() as u64, "sensor", "sensors"));
        tell(format_args!("{}: {rows} from {sensors}", self.out));
        if done.left_out > 0 {
            tell(format_args!("  dropped {} with other text", counted(done.left_out, "row", "rows")));
        }
        if log.skipped > 0 {
            tell(format_args!(
                "  skipped {} that Homebody cannot parse; homebody inspect lists them",
                counted(log.skipped, "line", "lines")
            ));
        }
        Ok(())
    }
}

const ANONYMOUS: &str = "anonymised";

/// A name for each sensor of a log: its kind and a number, in order of first appearance.
fn names(log: &Log, look: &LogOverview) -> Vec<String> {
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

fn key_of(names: &[String], ids: &[String]) -> String {
    let rows = names.iter().zip(ids).map(|(name, id)| csv_line([name.as_str(), id]) + "\n");
    std::iter::once("id,name\n".to_owned()).chain(rows).collect()
}
