//! `homebody convert`: carry a log from one form into another.

use super::read_log::{Mapped, tell_remarks};
use super::replacing::Replacing;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::tell;
use crate::progress;
use homebody_analysis::look::{Looker, looked};
use homebody_core::problem::counted;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::scheme::{SCHEMES, SchemeRow};
use homebody_log::fresh::same_file;
use homebody_log::source::{Form, forms};
use homebody_log::truth::tables;
use homebody_log::{Activity, Life, RunClock, Transfer, Url, convert, lives};
use indicatif::ProgressBar;
use std::path::{Path, PathBuf};

/// What the forms of a log are, for a help.
pub fn forms_of_logs() -> String {
    let form = |row: SchemeRow| format!("  {:<32} {}\n", format!("{}:{}", row.name, row.at), row.what);
    let forms = SCHEMES.map(form).concat();
    format!("Forms:\n{forms}\nA log that is named by its path alone is known by how it begins.")
}

/// What the forms are in which logs are read, for a help.
fn forms_of_sources() -> String {
    let form = |form: &Form| format!("  {:<15} {}\n", format!("{}:", form.name), form.what);
    forms().map(form).collect()
}

/// The columns of a log that is written anew.
pub const LOG_COLUMNS: &str = "seq, fired_at, sensor, value";

/// Carries a log from one form into another. Instants stay the same to the microsecond, and names and values what they
/// were, as far as the form can write them: that of CASAS knows local time only, and no blanks in names.
///
/// What the log tells of activities goes along: in CASAS as notes where they begin and end, else on the rows and, whole, in a
/// table of their own: in SQLite the table activity, in CSV a file beside the log, such as week.activity.csv.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody convert log.db --to casas:log.txt
  homebody convert runs/tigerplace-1 --to csv:week.csv
  homebody convert aruba.txt --to sqlite:aruba.db
  homebody convert runs/tigerplace-1 --to casas:labelled.txt --activities
  homebody convert kasteren --to csv:kasteren.csv
  homebody convert network.db --mapping logger.json --to casas:network.txt

{forms}

Forms that are read:
{read}
Columns: {LOG_COLUMNS}, and activity where some are known; in SQLite in the table firing,
behind run_id. The form of CASAS has time, sensor and value, without a header.

Rows that are not understood are left out, and told. No file of a run's folder is replaced.

{EXIT_CODES}.", forms = forms_of_logs(), read = forms_of_sources()))]
pub struct Arguments {
    #[command(flatten)]
    log: Mapped,
    /// Where to: sqlite:FILE, csv:FILE, jsonl:- and so on, as listed below
    #[arg(long, value_name = "URL")]
    to: Url,
    /// Take the activities from the truth beside the log, which else stays apart from it
    #[arg(long)]
    activities: bool,
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
        let text = self.log.text();
        keep(&self.to, &named.place.files())?;
        let (looker, mut log) = looked(Looker::new(None), &mut |take| named.stream(take))?;
        if self.activities {
            let truth =
                named.truth().ok_or_else(|| Failure::Io(format!("no truth lies beside {text}\n  hint: {NO_TRUTH}")))?;
            log.activities = told_activities(&lives(&truth, &RunClock::as_told())?);
        }
        let look = looker.look(&named.name, named.place.form().name, &log, &|_| None, None);
        log.remarks.clone_from(&look.remarks);
        tell_remarks(text, &log);
        for skipped in &log.problems {
            tell(format_args!("{}: left out: {}", skipped.place(text), skipped.why));
        }
        let unsaid = log.skipped.saturating_sub(log.problems.len() as u64);
        if unsaid > 0 {
            tell(format_args!("{text}: {unsaid} more lines were left out"));
        }
        let how = self.replacing.how(&self.to);
        let zone = &self.time_zone;
        let transfer = Transfer { from: &named.place, mapping: &named.mapping, to: &self.to, name: text, zone, how };
        let progress = rows_bar(log.rows);
        let rows = convert(&transfer, &log, |rows| progress.set_position(rows));
        progress.finish_and_clear();
        let rows = rows?;
        let sensors = counted(log.sensors.len(), "sensor", "sensors");
        tell(format_args!("{}: {} of {sensors}", self.to, counted(rows as usize, "row", "rows")));
        for (count, one, many) in [
            (log.activities.len(), "activity", "activities"),
            (look.repeated as usize, "message that says again what was on", "messages that say again what was on"),
            (
                look.missing as usize,
                "message that something ends that had not begun",
                "messages that something ends that had not begun",
            ),
            (look.set_back as usize, "time the clock was set back", "times the clock was set back"),
        ] {
            if count > 0 {
                tell(format_args!("  {}", counted(count, one, many)));
            }
        }
        Ok(())
    }
}

const NO_TRUTH: &str = "name the folder of a run that has its truth; without --activities the log's own go along";

/// What residents did, by their numbers where there are several: `R1_` stands before what the first of them does.
fn told_activities(lives: &[Life]) -> Vec<Activity> {
    let of_life = |(number, life): (usize, &Life)| {
        let prefix = if lives.len() > 1 { format!("R{}_", number + 1) } else { String::new() };
        let named = |of: &Activity| Activity { name: format!("{prefix}{}", of.name), ..of.clone() };
        life.activities.iter().map(named).collect::<Vec<_>>()
    };
    let mut all: Vec<Activity> = lives.iter().enumerate().flat_map(of_life).collect();
    all.sort_by_key(|of| of.begin);
    all
}

/// Makes sure that an output does not replace what the command reads.
pub fn keep(to: &Url, sources: &[PathBuf]) -> Result<(), Failure> {
    let is_in = |source: &PathBuf| match to.file() {
        Some(file) => same_file(source, file),
        // The run of a data set is in a folder of it.
        None => to.is_data_set() && source.ancestors().any(|folder| same_file(folder, to.path())),
    };
    if sources.iter().any(is_in) {
        return Err(Failure::Io(format!("{to} cannot become itself\n  hint: name another file")));
    }
    Ok(())
}

/// The files of a truth.
pub fn files_of(truth: &Url) -> Vec<PathBuf> {
    truth.files(&tables()).into_iter().chain(truth.file().map(Path::to_owned)).collect()
}

/// A bar that shows how many rows have been written.
pub fn rows_bar(rows: u64) -> ProgressBar {
    progress::bar(rows, "{bar:40} {percent:>3} %  {human_pos} rows  {eta} left")
}
