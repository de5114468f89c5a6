//! `homebody convert`: carry a log from one form into another.

use crate::failure::{EXIT_CODES, Failure};
use crate::print::tell;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::scheme::{SCHEMES, SchemeRow};
use homebody_kit::NamedLog;
use homebody_log::fresh::same_file;
use homebody_log::truth::tables;
use homebody_log::{How, Log, Transfer, Url, convert};
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};

/// What the forms of a log are, for a help.
pub fn forms_of_logs() -> String {
    let form = |row: SchemeRow| format!("  {:<12} {}\n", format!("{}:{}", row.name, row.at), row.what);
    let forms = SCHEMES.map(form).concat();
    format!("Forms:\n{forms}\nA log that is named by its path alone is known by how it begins.")
}

/// The columns of a log that is written anew.
pub const LOG_COLUMNS: &str = "seq, fired_at, sensor, value";

/// Carries a log from one form into another. Instants stay the same to the microsecond, and names and values what they
/// were, as far as the form can write them: that of CASAS knows local time only, and no blanks in names.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody convert log.db --to casas:log.txt
  homebody convert runs/tigerplace-1 --to csv:week.csv
  homebody convert aruba.txt --to sqlite:aruba.db

{forms}

Columns: {LOG_COLUMNS}; in SQLite in the table firing, behind run_id.
The form of CASAS has time, sensor and value, without a header.

Rows that are not understood are left out, and told. No file of a run's folder is replaced.

{EXIT_CODES}.", forms = forms_of_logs()))]
pub struct Arguments {
    /// The log: the folder of its run, a file, or sqlite:FILE, csv:FILE or casas:FILE
    log: String,
    /// Where to: sqlite:FILE, csv:FILE or casas:FILE
    #[arg(long, value_name = "URL")]
    to: Url,
    /// The time zone in which a log in UTC is written where only local time is known
    #[arg(long, default_value = "UTC")]
    time_zone: String,
    /// Replace a file that exists
    #[arg(long)]
    force: bool,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        Calendar::zone(&self.time_zone).map_err(Failure::usage)?;
        let named = NamedLog::find(&self.log)?;
        keep(&self.to, &[&named.place])?;
        let log = named.survey()?;
        tell_remarks(&self.log, &log);
        for skipped in &log.problems {
            tell(format_args!("{}:{}: left out: {}", self.log, skipped.line, skipped.why));
        }
        let unsaid = log.skipped.saturating_sub(log.problems.len() as u64);
        if unsaid > 0 {
            tell(format_args!("{}: {unsaid} more lines were left out", self.log));
        }
        let how = if self.force { How::Replace } else { How::New };
        let (name, zone) = (&self.log, &self.time_zone);
        let transfer = Transfer { from: &named.place, mapping: &named.mapping, to: &self.to, name, zone, how };
        let progress = rows_bar(log.rows);
        let rows = convert(&transfer, &log, |rows| progress.set_position(rows));
        progress.finish_and_clear();
        let rows = rows?;
        tell(format_args!("{}: {rows} rows of {} sensors", self.to, log.sensors.len()));
        Ok(())
    }
}

/// Makes sure that an output does not replace what the command reads.
pub fn keep(to: &Url, sources: &[&Url]) -> Result<(), Failure> {
    let mut read = sources.iter().flat_map(|source| source.files(&tables()).into_iter().chain(own_file(source)));
    if read.any(|source| to.file().is_some_and(|to| same_file(&source, to))) {
        return Err(Failure::Io(format!("{to} cannot become itself\n  hint: name another file")));
    }
    Ok(())
}

fn own_file(url: &Url) -> Option<PathBuf> {
    url.file().map(Path::to_owned)
}

/// A bar that shows how many rows have been written, where somebody looks.
pub fn rows_bar(rows: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {human_pos} rows  {eta} left");
    ProgressBar::new(rows).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Tells what of a log was left out, but for single lines.
pub fn tell_remarks(name: &str, log: &Log) {
    log.remarks.iter().for_each(|remark| tell(format_args!("{name}: {remark}")));
}
