//! `homebody convert`: carry a log from one form into another.

use super::cohort::LIST;
use crate::failure::Failure;
use crate::print::tell;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::fresh::same_file;
use homebody_log::source::recognise;
use homebody_log::{How, Log, Url, convert, read};
use std::fs;
use std::path::{Path, PathBuf};

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
        let from = place(&self.log)?;
        let log = read(&from, &LoggerFile::default())?;
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
        let rows = convert(&log, &self.to, &self.log, &self.time_zone, how)?;
        tell(format_args!("{}: {rows} rows of {} sensors", self.to, log.sensors.len()));
        Ok(())
    }
}

/// Tells what of a log was left out, but for single lines.
pub fn tell_remarks(name: &str, log: &Log) {
    log.remarks.iter().for_each(|remark| tell(format_args!("{name}: {remark}")));
}

/// A log by its URL, by its path alone, or by the folder of its run.
pub fn place(text: &str) -> Result<Url, Failure> {
    let mut path = PathBuf::from(text);
    if path.join("log.db").is_file() {
        path.push("log.db");
    }
    if path.join(LIST).is_file() {
        return Err(Failure::Usage(cohort_is_no_log(&path)));
    }
    if path.is_dir() {
        let hint = "name the log itself, or the folder of a run that has one";
        return Err(Failure::Io(format!("{text} is a folder without a log.db\n  hint: {hint}")));
    }
    if path.exists() {
        return Ok(recognise(&path)?);
    }
    text.parse().or_else(|_| Ok(recognise(&path)?))
}

/// What is said where a cohort's folder is taken for a run's.
fn cohort_is_no_log(folder: &Path) -> String {
    let is_member = |path: &PathBuf| path.join("recording.json").is_file();
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let hint = match entries.filter(is_member).min() {
        Some(first) => format!("name one of them, such as {}", first.display()),
        None => "nobody of it has been lived".into(),
    };
    format!("{} is a cohort: each member has a log of their own\n  hint: {hint}", folder.display())
}
