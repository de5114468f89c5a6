//! The log of a command, its options, and notes on it.

use super::messages::LogContentMessage;
use crate::failure::Failure;
use crate::print::{counted, tell, warn};
use crate::progress::Working;
use homebody_log::log::{Clock, ColumnRole};
use homebody_log::source::{DateOrder, DecimalMark, HomeColumn, TableOptions};
use homebody_log::{Log, read_mapping};
use homebody_query::{IncompleteLog, LoadedLog, LogRef};
use std::fmt;
use std::path::PathBuf;

/// A log, and how its table is read.
#[derive(clap::Args)]
pub struct LogArguments {
    /// Log: a file, a run folder, a data set folder, or FORM:FILE
    log: String,
    #[command(flatten)]
    how: LogOptions,
}

impl LogArguments {
    pub fn text(&self) -> &str {
        &self.log
    }

    pub fn how(&self) -> &LogOptions {
        &self.how
    }

    pub fn read(&self, zone: Option<&str>) -> Result<LoadedLog, Failure> {
        read_log(&self.log, zone, &self.how)
    }

    pub fn read_any_length(&self, zone: Option<&str>) -> Result<LoadedLog, Failure> {
        read_any_length(&self.log, zone, &self.how)
    }

    pub fn find(&self) -> Result<LogRef, Failure> {
        self.how.find(&self.log)
    }
}

impl fmt::Display for LogArguments {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.log)
    }
}

/// The interpretation of a table, if its headings and rows do not determine it.
#[derive(clap::Args, Clone, Default)]
#[command(next_help_heading = "Input form")]
pub struct LogOptions {
    /// File such as logger.json with the table and column names of a database or CSV file, if the names are unusual
    #[arg(long, value_name = "FILE")]
    mapping: Option<PathBuf>,
    /// Read each column of the table as a sensor
    #[arg(long)]
    wide: bool,
    /// Column that names the home or person of each row, and the home to read; NAME=* reads all homes as one log
    #[arg(long, value_name = "NAME[=HOME]")]
    home_column: Option<String>,
    /// Order of day and month in dates such as 02/03/2009
    #[arg(long, value_enum, value_name = "ORDER")]
    dates: Option<Dates>,
    /// Decimal mark of numbers
    #[arg(long, value_enum, value_name = "MARK")]
    decimals: Option<Decimals>,
}

/// The number that comes first in a date.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Dates {
    /// 02/03/2009 is 2 March
    DayFirst,
    /// 02/03/2009 is 3 February
    MonthFirst,
}

/// The mark before decimals.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Decimals {
    /// 21,5
    Comma,
    /// 21.5
    Point,
}

impl LogOptions {
    /// Finds a log, with these options.
    pub fn find(&self, text: &str) -> Result<LogRef, Failure> {
        let mut named = LogRef::find(text)?;
        if let Some(path) = &self.mapping {
            named.mapping = read_mapping(path)?;
        }
        named.place = named.place.with_options(self.table_options());
        Ok(named)
    }

    /// Reads a log in the local time of its home.
    pub fn read(&self, text: &str, zone: Option<&str>) -> Result<LoadedLog, Failure> {
        Ok(LoadedLog::from_ref(self.find(text)?, zone)?)
    }

    fn table_options(&self) -> TableOptions {
        let home = self.home_column.as_ref().map(|text| match text.split_once('=') {
            Some((column, home)) => HomeColumn { column: column.to_owned(), home: Some(home.to_owned()) },
            None => HomeColumn { column: text.clone(), home: None },
        });
        let dates = self.dates.map(|dates| match dates {
            Dates::DayFirst => DateOrder::DayFirst,
            Dates::MonthFirst => DateOrder::MonthFirst,
        });
        let decimals = self.decimals.map(|decimals| match decimals {
            Decimals::Comma => DecimalMark::Comma,
            Decimals::Point => DecimalMark::Point,
        });
        TableOptions { is_wide: self.wide, home, dates, decimals }
    }
}

/// Reads a log in the local time of its home, and reports on standard error which parts are missing or guessed.
pub fn read_log(text: &str, zone: Option<&str>, how: &LogOptions) -> Result<LoadedLog, Failure> {
    read_with(text, || how.read(text, zone))
}

/// Reads a log of any length. The rows of a long one stay on disk.
pub fn read_any_length(text: &str, zone: Option<&str>, how: &LogOptions) -> Result<LoadedLog, Failure> {
    read_with(text, || Ok(LoadedLog::of_any_length(how.find(text)?, zone)?))
}

fn read_with(text: &str, read: impl FnOnce() -> Result<LoadedLog, Failure>) -> Result<LoadedLog, Failure> {
    let reading = Working::on(format!("reading {text}"));
    let read = read()?;
    drop(reading);
    print_remarks(text, &read.log);
    print_skipped(text, &read.log);
    warn_of_incomplete(text, read.incomplete.as_ref());
    if read.log.clock == Clock::Utc {
        tell(format_args!("{text}: times are in UTC; --time-zone sets the home's own zone"));
    }
    Ok(read)
}

pub fn print_skipped(text: &str, log: &Log) {
    if log.skipped > 0 {
        tell(format_args!("{text}: skipped {}; homebody inspect lists them", counted(log.skipped, "line", "lines")));
    }
}

/// Reports which columns were guessed by their cells.
fn print_guesses(name: &str, log: &Log) {
    let guessed = log.columns.iter().filter(|of| of.is_guess && !of.column.is_empty());
    let guessed: Vec<String> = guessed
        .filter_map(|of| {
            let what = match of.used_as {
                ColumnRole::Time => "time",
                ColumnRole::End => "end",
                ColumnRole::Sensor => "sensor",
                ColumnRole::Value => "value",
                ColumnRole::Label => "activity",
                _ => return None,
            };
            Some(format!("{} as the {what}", of.column))
        })
        .collect();
    if !guessed.is_empty() {
        let why = "homebody inspect explains this";
        tell(format_args!("{name}: guessed columns by their cells: {}; {why}", guessed.join(", ")));
    }
    if let Some(supplied) = log.columns.iter().find(|of| of.column.is_empty()) {
        tell(format_args!("{name}: {}", supplied.because));
    }
}

/// Warns of an incomplete run, whose log lacks its later rows.
pub fn warn_of_incomplete(text: &str, unfinished: Option<&IncompleteLog>) {
    if let Some(run) = unfinished {
        warn(LogContentMessage::IncompleteRun { log: text.to_owned(), resume: run.folder.clone() });
    }
}

/// Reports guesses about a log, and its missing parts except for single lines.
pub fn print_remarks(name: &str, log: &Log) {
    print_guesses(name, log);
    log.remarks.iter().for_each(|remark| tell(format_args!("{name}: {remark}")));
}
