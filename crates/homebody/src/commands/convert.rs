//! `homebody convert`: carry a log from one form into another.

use crate::failure::Failure;
use crate::print::tell;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::LoggerFile;
use homebody_kit::place_of_log;
use homebody_log::fresh::same_file;
use homebody_log::{How, Log, Transfer, Url, convert, survey};
use indicatif::{ProgressBar, ProgressStyle};

/// Carries a log from one form into another. Instants stay the same to the microsecond, and names and values what they
/// were, as far as the form can write them: that of CASAS knows local time only, and no blanks in names.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody convert log.db --to casas:log.txt
  homebody convert aruba.txt --to sqlite:aruba.db")]
pub struct Arguments {
    /// The log: a file, or sqlite:FILE, csv:FILE or casas:FILE
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
        let from = place_of_log(&self.log)?;
        let mapping = LoggerFile::default();
        let log = survey(&from, &mapping)?;
        if from.file().zip(self.to.file()).is_some_and(|(one, other)| same_file(one, other)) {
            return Err(Failure::Io(format!("{} cannot become itself\n  hint: name another file", self.log)));
        }
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
        let transfer = Transfer { from: &from, mapping: &mapping, to: &self.to, name, zone, how };
        let progress = rows_bar(log.rows);
        let rows = convert(&transfer, &log, |rows| progress.set_position(rows));
        progress.finish_and_clear();
        let rows = rows?;
        tell(format_args!("{}: {rows} rows of {} sensors", self.to, log.sensors.len()));
        Ok(())
    }
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
