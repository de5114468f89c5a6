//! A log that a command is given, and what is remarked on it.

use crate::failure::Failure;
use crate::print::tell;
use crate::progress::Working;
use homebody_kit::{LogWithRun, NamedLog, Unended};
use homebody_log::source::Clock;
use homebody_log::{Log, read_mapping};
use std::path::PathBuf;

/// A log, and what its table and columns are called.
#[derive(clap::Args)]
pub struct Mapped {
    /// The log: the folder of its run or of a data set, a file, or FORM:FILE
    log: String,
    /// A logger.json that names the table and columns of a database or a CSV file, where they are neither ours nor the usual ones
    #[arg(long, value_name = "FILE")]
    mapping: Option<PathBuf>,
}

impl Mapped {
    /// As it was named.
    pub fn text(&self) -> &str {
        &self.log
    }

    /// Finds it.
    pub fn find(&self) -> Result<NamedLog, Failure> {
        let mut named = NamedLog::find(&self.log)?;
        if let Some(path) = &self.mapping {
            named.mapping = read_mapping(path)?;
        }
        Ok(named)
    }
}

/// Reads a log on the clock on the wall of its home, and tells what is left out of it.
pub fn read_log(text: &str, zone: Option<&str>) -> Result<LogWithRun, Failure> {
    let reading = Working::on(format!("reading {text}"));
    let read = LogWithRun::read(text, zone)?;
    drop(reading);
    Ok(remarked(text, read))
}

/// The same of a log of any length: the rows of a long one are not in memory.
pub fn read_any_length(text: &str, zone: Option<&str>) -> Result<LogWithRun, Failure> {
    let reading = Working::on(format!("reading {text}"));
    let read = LogWithRun::of_any_length(NamedLog::find(text)?, zone)?;
    drop(reading);
    Ok(remarked(text, read))
}

fn remarked(text: &str, read: LogWithRun) -> LogWithRun {
    tell_remarks(text, &read.log);
    if read.log.skipped > 0 {
        tell(format_args!("{text}: {} lines were left out; homebody look says which", read.log.skipped));
    }
    tell_unfinished(text, read.unfinished.as_ref());
    if read.log.clock == Clock::Utc {
        tell(format_args!("{text}: its hours are those of UTC; --time-zone tells the home's own"));
    }
    read
}

/// Warns of a run that was not lived to its end, so that its log is a part of what it is going to be.
pub fn tell_unfinished(text: &str, unfinished: Option<&Unended>) {
    if let Some(run) = unfinished {
        tell(format_args!("warning: {text}: its run has not come to its end\n  hint: {}", go_on(run)));
    }
}

/// How a run comes to its end.
pub fn go_on(run: &Unended) -> String {
    format!("homebody run --resume {} goes on with it", run.folder.display())
}

/// Tells what of a log was left out, but for single lines.
pub fn tell_remarks(name: &str, log: &Log) {
    log.remarks.iter().for_each(|remark| tell(format_args!("{name}: {remark}")));
}
