//! `homebody convert`: write a log in another form.

use super::log_input::{LogArguments, print_remarks};
use super::messages::LogContentMessage;
use super::replacing::Replacing;
use crate::failure::{EXIT_CODES, Failure};
use crate::print::{counted, tell};
use crate::progress;
use homebody_analysis::look::{Looker, looked};
use homebody_core::calendar::Calendar;
use homebody_core::scenario::scheme::{SCHEMES, SchemeRow, known_extensions};
use homebody_core::time::{TimeScale, WallTime};
use homebody_log::convert;
use homebody_log::files::fresh::same_file;
use homebody_log::registry::forms;
use homebody_log::source::LogForm;
use homebody_log::table::truth::tables;
use homebody_log::{LogError, Transfer, Url, read_timeline};
use homebody_timeline::{Episode, Timeline};
use std::path::{Path, PathBuf};

pub fn forms_of_logs() -> String {
    let form = |row: SchemeRow| format!("  {:<32} {}\n", format!("{}:{}", row.name, row.at), row.what);
    let forms = SCHEMES.map(form).concat();
    format!(
        "Forms of logs:\n{forms}\nIf a destination has no form, its extension decides: {}.\n\
             Homebody recognises the form of an input file by its first lines.",
        known_extensions()
    )
}

fn forms_of_sources() -> String {
    let form = |form: &LogForm| format!("  {:<15} {}\n", format!("{}:", form.name), form.what);
    forms().map(form).collect()
}

pub const LOG_COLUMNS: &str = "seq, fired_at, sensor, value";

/// Convert a log to another form: CSV, SQLite, CASAS, Parquet and more
///
/// Instants stay exact to the microsecond. Names and values do not change, except in the form of CASAS, which has local
/// time only and no blanks in names.
///
/// Homebody also converts activities. In CASAS, they become notes at their start and end. Other forms have a column and a separate
/// table: `activity` in SQLite, and a second file such as week.activity.csv in CSV.
#[derive(clap::Args)]
#[command(after_long_help = format!("Examples:
  homebody convert log.db --out casas:log.txt
  homebody convert runs/tigerplace-1 --out week.csv
  homebody convert aruba.txt --out aruba.db
  homebody convert runs/tigerplace-1 --out casas:labelled.txt --activities
  homebody convert kasteren --out kasteren.csv.gz
  homebody convert network.db --mapping logger.json --out casas:network.txt

{forms}

Forms that Homebody reads:
{read}
Columns: {LOG_COLUMNS}, and activity if the log has activities. In SQLite they are in the table
firing, after the column run_id. The form of CASAS has time, sensor and value, without a header.

Homebody skips rows that it cannot parse, and reports them. It does not replace files of a run's
folder.

{EXIT_CODES}.", forms = forms_of_logs(), read = forms_of_sources()))]
pub struct ConvertArguments {
    #[command(flatten)]
    log: LogArguments,
    /// Destination: FILE.csv, FILE.db, jsonl:- and so on, as listed below
    #[arg(short, long, value_name = "DESTINATION", help_heading = "Output")]
    out: Url,
    /// Add the activities of the run's ground truth
    #[arg(long)]
    activities: bool,
    /// Time zone of the output, if the log is in UTC and the form of the output has only local time
    #[arg(long, value_name = "ZONE", default_value = "UTC")]
    time_zone: String,
    #[command(flatten)]
    replacing: Replacing,
}

impl ConvertArguments {
    pub fn run(self) -> Result<(), Failure> {
        Calendar::zone(&self.time_zone).map_err(Failure::asked)?;
        let named = self.log.find()?;
        let text = self.log.text();
        refuse_inputs(&self.out, &named.place.files())?;
        let (looker, mut log) = looked(Looker::new(None), &mut |take| named.stream(take))?;
        if self.activities {
            let no_truth = || LogContentMessage::NoTruth { log: text.to_owned(), command: "convert" };
            let truth = named.truth().ok_or_else(|| Failure::file(no_truth()))?;
            let scale = TimeScale::one();
            log.activities = numbered_activities(read_timeline(&truth, &scale)?.map(|at| scale.run_to_wall(at)));
        }
        let look = looker.look(&named.name, named.place.form().name, &log, &|_| None, None);
        log.remarks.clone_from(&look.remarks);
        print_remarks(text, &log);
        for skipped in &log.problems {
            tell(format_args!("{}: skipped: {}", skipped.place(text), skipped.why));
        }
        let unsaid = log.skipped.saturating_sub(log.problems.len() as u64);
        if unsaid > 0 {
            tell(format_args!("{text}: skipped {} more", counted(unsaid, "line", "lines")));
        }
        let how = self.replacing.how(&self.out);
        let zone = &self.time_zone;
        let transfer = Transfer { from: &named.place, mapping: &named.mapping, to: &self.out, name: text, zone, how };
        let rows = show_rows(log.rows, |progress| convert(&transfer, &log, progress))?;
        let sensors = counted(log.sensors.len() as u64, "sensor", "sensors");
        tell(format_args!("{}: {} from {sensors}", self.out, counted(rows, "row", "rows")));
        for (count, one, many) in [
            (log.activities.len() as u64, "activity", "activities"),
            (look.repeated, "repeated message: ON after ON", "repeated messages: ON after ON"),
            (look.missing, "missing message: OFF without ON", "missing messages: OFF without ON"),
            (look.set_back, "time that goes back", "times that go back"),
        ] {
            if count > 0 {
                tell(format_args!("  {}", counted(count, one, many)));
            }
        }
        Ok(())
    }
}

/// The activities of residents. With several residents, a prefix such as `R1_` has the number of the resident.
fn numbered_activities(mut timeline: Timeline<WallTime>) -> Vec<Episode<WallTime>> {
    if timeline.people.len() > 1 {
        for (number, person) in timeline.people.iter_mut().enumerate() {
            person.activities.iter_mut().for_each(|of| of.label = format!("R{}_{}", number + 1, of.label));
        }
    }
    timeline.into_activities()
}

pub fn refuse_inputs(to: &Url, sources: &[PathBuf]) -> Result<(), Failure> {
    let is_in = |source: &PathBuf| match to.file() {
        Some(file) => same_file(source, file),
        // The run of a data set is in a folder of it.
        None => to.is_data_set() && source.ancestors().any(|folder| same_file(folder, to.path())),
    };
    if sources.iter().any(is_in) {
        return Err(LogError::IsSource { place: to.to_string() }.into());
    }
    Ok(())
}

pub fn files_of(truth: &Url) -> Vec<PathBuf> {
    truth.files(&tables()).into_iter().chain(truth.file().map(Path::to_owned)).collect()
}

/// Shows a bar during work that reports the number of written rows.
pub fn show_rows<T>(rows: u64, work: impl FnOnce(&dyn Fn(u64)) -> T) -> T {
    let template = "{bar:40} {percent:>3} %  {human_pos} rows  {eta} left";
    progress::show(rows, template, |bar| work(&|rows| bar.set_position(rows)))
}
