//! `homebody label`: a log with the ground truth of each row.

use super::convert::{LOG_COLUMNS, files_of, forms_of_logs, refuse_inputs, show_rows};
use super::log_input::{LogArguments, print_remarks, warn_of_incomplete};
use super::messages::LogContentMessage;
use super::replacing::Replacing;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{counted, grouped, tell};
use homebody_core::calendar::Calendar;
use homebody_log::label;
use homebody_log::{Labelled, Transfer, Url, truth_at};

/// Add the ground truth to each row of a log, to train recognisers
///
/// Each row gets the resident who caused it, the room and the activity of that resident, and the cause of the event.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody label runs/tigerplace-1 --out labelled.csv
  homebody label week.csv truth.db --out casas:labelled.txt
  homebody label log.db csv:truth.csv --out labelled.db

{forms}

The ground truth is a file or database that the run wrote: its SQLite file; csv:FILE, jsonl:FILE,
parquet:FILE or arrow:FILE with a file for each table, such as truth.cause.csv; a data set,
parquet:FOLDER; or postgresql://USER@HOST/DATABASE.

Columns: {LOG_COLUMNS}, then
  resident  the resident who caused the event; empty if no resident did
  room      the room of that resident; empty between rooms
  activity  the activity of that resident
  cause     movement, act, reading, duplicate or false
  thing     the piece of furniture or door of an act
In SQLite they are in the table labelled, after the column run_id. The form of CASAS has time, sensor, value
and activity, without a header.

The log must be complete and unchanged, because Homebody matches rows by number. Homebody does not
replace files of a run's folder.

{EXIT_CODES}.", forms = forms_of_logs()))]
pub struct LabelArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Ground truth of the same run: a database, or csv:FILE and so on (default: the ground truth in the run folder)
    truth: Option<String>,
    /// Destination: FILE.csv, FILE.db, casas:FILE and so on, as listed below
    #[arg(short, long, value_name = "DESTINATION", help_heading = "Output")]
    out: Url,
    /// Time zone of the output, if the log is in UTC and the form of the output has only local time
    #[arg(long, value_name = "ZONE", default_value = "UTC")]
    time_zone: String,
    #[command(flatten)]
    replacing: Replacing,
}

impl LabelArguments {
    pub fn run(self) -> Result<(), Failure> {
        Calendar::zone(&self.time_zone).map_err(Failure::asked)?;
        let named = self.log.find()?;
        let Some(truth) = self.truth.as_deref().map(truth_at).or_else(|| named.truth()) else {
            return Err(Failure::file(LogContentMessage::NoTruth { log: named.place.to_string(), command: "label" }));
        };
        refuse_inputs(&self.out, &[named.place.files(), files_of(&truth)].concat())?;
        let log = named.survey()?;
        let unfinished = named.incomplete();
        if let Some(run) = unfinished.as_ref().filter(|run| run.is_killed) {
            let (log, resume) = (self.log.to_string(), run.folder.clone());
            return Err(Failure::file(LogContentMessage::UnequalEnds { log, resume }));
        }
        warn_of_incomplete(self.log.text(), unfinished.as_ref());
        print_remarks(self.log.text(), &log);
        let how = self.replacing.how(&self.out);
        let (name, zone) = (self.log.text(), &self.time_zone);
        let transfer = Transfer { from: &named.place, mapping: &named.mapping, to: &self.out, name, zone, how };
        let clock = named.clock_beside(&truth);
        let labelled = show_rows(log.rows, |progress| label(&transfer, &log, &truth, &clock, progress))?;
        let Labelled { rows, somebodys, nobodys, unexplained } = labelled;
        let (rows, by, others) = (counted(rows, "row", "rows"), grouped(somebodys), grouped(nobodys));
        tell(format_args!("{}: {rows}, {by} caused by a resident, {others} by no resident", self.out));
        if unexplained > 0 {
            tell(format_args!("{} without a cause in the ground truth", counted(unexplained, "row", "rows")));
        }
        Ok(())
    }
}
