//! `homebody label`: a log with what the truth says of each row.

use super::convert::{LOG_COLUMNS, files_of, forms_of_logs, keep, rows_bar};
use super::read_log::{HowRead, go_on, tell_remarks, tell_unfinished};
use super::replacing::Replacing;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::tell;
use homebody_core::problem::counted;
use homebody_core::scenario::calendar::Calendar;
use homebody_log::{Labelled, Transfer, Url, label, truth_at};

/// What to do where the truth is not found.
const NAME_IT: &str = "name the run's truth after the log: its database, or csv:FILE, parquet:FILE and so on";

/// Joins a log with the truth of its run: each row with whose doing it was, in which room they were, what they were doing,
/// and why the sensor spoke. That is what recognisers are trained on.
#[derive(clap::Args)]
#[command(after_help = format!("Examples:
  homebody label runs/tigerplace-1 --to csv:labelled.csv
  homebody label week.csv truth.db --to casas:labelled.txt
  homebody label log.db csv:truth.csv --to sqlite:labelled.db

{forms}

The truth is what the run has left: its database; csv:FILE, jsonl:FILE, parquet:FILE or
arrow:FILE where --truth has made a file for each table, such as truth.cause.csv beside
truth.csv; a data set, parquet:FOLDER; or a database, postgresql://USER@HOST/DATABASE.

Columns: {LOG_COLUMNS}, then
  resident  whose doing it was; empty where it was nobody's
  room      the room that they were in; empty between rooms
  activity  what they were doing
  cause     movement, act, reading, duplicate or false
  thing     what was used, of an act
In SQLite they are in the table labelled, behind run_id. The form of CASAS has time, sensor,
value and activity, without a header.

The log must be whole, as its run has left it: rows are joined by their numbers. No file of
a run's folder is replaced.

{EXIT_CODES}.", forms = forms_of_logs()))]
pub struct Arguments {
    /// The log: the folder of its run, a file, or sqlite:FILE, csv:FILE or casas:FILE
    log: String,
    #[command(flatten)]
    how: HowRead,
    /// The truth of the same run: a database, or csv:FILE and so on; the one beside the log without it
    truth: Option<String>,
    /// Where to: sqlite:FILE, csv:FILE or casas:FILE
    #[arg(long, value_name = "URL")]
    to: Url,
    /// The time zone in which a log in UTC is written where only local time is known
    #[arg(long, default_value = "UTC")]
    time_zone: String,
    #[command(flatten)]
    replacing: Replacing,
}

impl Arguments {
    pub fn run(self) -> Result<(), Failure> {
        Calendar::zone(&self.time_zone).map_err(Failure::asked)?;
        let named = self.how.find(&self.log)?;
        let Some(truth) = self.truth.as_deref().map(truth_at).or_else(|| named.truth()) else {
            return Err(Failure::Io(format!("no truth lies beside {}\n  hint: {NAME_IT}", named.place)));
        };
        keep(&self.to, &[named.place.files(), files_of(&truth)].concat())?;
        let log = named.survey()?;
        let unfinished = named.unfinished();
        if let Some(run) = unfinished.as_ref().filter(|run| run.is_killed) {
            let what = "its run has not come to its end, so that its log and its truth may end at different rows";
            return Err(Failure::Io(format!("{}: {what}\n  hint: {} first", self.log, go_on(run))));
        }
        tell_unfinished(&self.log, unfinished.as_ref());
        tell_remarks(&self.log, &log);
        let how = self.replacing.how(&self.to);
        let (name, zone) = (&self.log, &self.time_zone);
        let transfer = Transfer { from: &named.place, mapping: &named.mapping, to: &self.to, name, zone, how };
        let progress = rows_bar(log.rows);
        let labelled = label(&transfer, &log, &truth, &named.clock_beside(&truth), |rows| progress.set_position(rows));
        progress.finish_and_clear();
        let Labelled { rows, somebodys, nobodys, unexplained } = labelled?;
        let rows = counted(rows as usize, "row", "rows");
        tell(format_args!("{}: {rows}, {somebodys} of somebody's doing, {nobodys} of nobody's", self.to));
        if unexplained > 0 {
            tell(format_args!("{unexplained} rows have no cause in the truth"));
        }
        Ok(())
    }
}
