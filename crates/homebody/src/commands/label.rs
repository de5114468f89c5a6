//! `homebody label`: a log with what the truth says of each row.

use super::convert::{rows_bar, tell_remarks};
use crate::failure::Failure;
use crate::print::tell;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::LoggerFile;
use homebody_kit::place_of_log;
use homebody_log::fresh::same_file;
use homebody_log::places::TRUTH;
use homebody_log::{How, Labelled, Transfer, Url, label, survey};
use std::path::{Path, PathBuf};

/// Joins a log with the truth of its run: each row with whose doing it was, in which room they were, what they were doing,
/// and why the sensor spoke. That is what recognisers are trained on.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  homebody label runs/tigerplace-1 --to csv:labelled.csv
  homebody label week.csv truth.db --to casas:labelled.txt

Columns: those of the log, then resident, room, activity, cause and thing. The form of CASAS has the activity alone.")]
pub struct Arguments {
    /// The log: the folder of its run, a file, or sqlite:FILE, csv:FILE or casas:FILE
    log: String,
    /// The truth of the same run; truth.db beside the log without it
    truth: Option<PathBuf>,
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
        let beside = || from.file().unwrap_or(Path::new("")).with_file_name(TRUTH);
        let truth = self.truth.clone().unwrap_or_else(beside);
        if !truth.is_file() {
            return Err(Failure::io(&truth, "there is no such truth\n  hint: name the truth of the run after its log"));
        }
        let mut sources = from.file().into_iter().chain([truth.as_path()]);
        if sources.any(|source| self.to.file().is_some_and(|to| same_file(source, to))) {
            return Err(Failure::Io(format!("{} cannot become itself\n  hint: name another file", self.to)));
        }
        let mapping = LoggerFile::default();
        let log = survey(&from, &mapping)?;
        tell_remarks(&self.log, &log);
        let how = if self.force { How::Replace } else { How::New };
        let (name, zone) = (&self.log, &self.time_zone);
        let transfer = Transfer { from: &from, mapping: &mapping, to: &self.to, name, zone, how };
        let progress = rows_bar(log.rows);
        let labelled = label(&transfer, &log, &truth, |rows| progress.set_position(rows));
        progress.finish_and_clear();
        let Labelled { rows, somebodys, nobodys, unexplained } = labelled?;
        tell(format_args!("{}: {rows} rows, {somebodys} of somebody's doing, {nobodys} of nobody's", self.to));
        if unexplained > 0 {
            tell(format_args!("{unexplained} rows have no cause in the truth"));
        }
        Ok(())
    }
}
