//! Joins a log and the truth of its run into rows with labels: who it was, in which room, doing what, and why the sensor
//! spoke.
//!
//! A row of the log is tied to the firing that it came from by numbers, in each mode of messages: the truth says for each
//! firing which row tells of it, and for each OFF that a hold ends with which firing it was that was held last. Room and
//! activity are those of the resident at the instant at which the cause began to be noticed, which a link may have delayed.
//!
//! We assume that the log is whole and in its order, in whatever form; its sensors are compared with those of the truth.

use crate::error::{LogError, place_of};
use crate::fresh::all_can_be_written;
use crate::mapping::Columns;
use crate::run_info::RunInfo;
use crate::sink::casas::one_word;
use crate::sink::{self, Begin, How};
use crate::source::{Activity, Cause, Clock, Log, lives, told_causes};
use crate::table::{Batch, Cell, Column, ColumnKind, Table, Texts};
use crate::url::Url;
use crate::writer::BATCH;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::Micros;
use std::path::Path;

/// What has become of a join.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Labelled {
    /// Rows of the log, all of which are written.
    pub rows: u64,
    /// Those that somebody caused.
    pub somebodys: u64,
    /// Those that nobody caused: a reading, a false firing.
    pub nobodys: u64,
    /// Those of which the truth says nothing.
    pub unexplained: u64,
}

/// Writes the rows of a log with what the truth of its run says of each; `name` is what the log is called.
pub fn label(log: &Log, truth: &Path, to: &Url, name: &str, zone: &str, how: How) -> Result<Labelled, LogError> {
    let causes = causes(log, truth)?;
    let lives = lives(truth)?;
    let (zone, time) = match log.clock {
        Clock::Local => ("UTC", TimeFormat::Local),
        Clock::Utc => (zone, TimeFormat::Utc),
    };
    let calendar = Calendar::new("1970-01-01T00:00:00", zone).map_err(LogError::Zone)?;
    let start = calendar.timestamp(0).as_microsecond();
    let columns = Columns::new(&LoggerFile::default())?;
    let tables = [labelled_table(&columns)];
    all_can_be_written(&to.file().into_iter().collect::<Vec<_>>(), how == How::Replace)?;
    let mut sink = sink::open(to);
    let run = RunInfo::plain(name, calendar, &log.sensors);
    sink.begin(&Begin { run: &run, tables: &tables, time, run_column: &columns.run, how })?;
    let mut texts = Texts::default();
    let (sensors, values) = (texts.ids(&log.sensors), texts.ids(&log.values));
    let mut labelled = Labelled::default();
    for (first, events) in log.events.chunks(BATCH).enumerate() {
        let mut batch = Batch::with_capacity(events.len(), tables[0].columns.len());
        for (seq, event) in (first * BATCH..).zip(events) {
            let cause = causes[seq].as_ref();
            let who = cause.and_then(|cause| cause.resident.as_deref());
            let at = cause.and_then(|cause| cause.seen_at);
            let life = who.and_then(|who| lives.iter().find(|life| life.resident == who));
            let room = life.zip(at).and_then(|(life, at)| span_at(&life.rooms, at));
            let activity = life.zip(at).and_then(|(life, at)| span_at(&life.activities, at));
            let why = cause.map(|cause| cause.why.as_str());
            let thing = cause.and_then(|cause| cause.thing.as_deref());
            match (cause.is_some(), who.is_some()) {
                (false, _) => labelled.unexplained += 1,
                (true, true) => labelled.somebodys += 1,
                (true, false) => labelled.nobodys += 1,
            }
            let mut text = |text: Option<&str>| text.map_or(Cell::Null, |text| Cell::Text(texts.id(text)));
            let labels = [text(who), text(room), text(activity), text(why), text(thing)];
            let sensor = Cell::Text(sensors[event.sensor as usize]);
            let value = Cell::Text(values[event.value as usize]);
            let row = [Cell::Integer(seq as i64), Cell::Instant(event.at - start), sensor, value];
            batch.push(0, row.into_iter().chain(labels));
        }
        sink.write(&batch.with(&texts))?;
    }
    sink.finish(log.events.last().map_or(0, |event| event.at - start))?;
    labelled.rows = log.events.len() as u64;
    Ok(labelled)
}

/// The columns of a log, and what the truth says of each row.
fn labelled_table(columns: &Columns) -> Table {
    let mut table = columns.log_table();
    let label = |name: &str, about| Column { name: name.into(), kind: ColumnKind::Text, unit: "", about };
    table.name = "labelled".into();
    table.about = "what a sensor said, with who it was, where, doing what, and why";
    table.columns.extend([
        label("resident", "whose doing it was; empty where it was nobody's"),
        label("room", "the room that they were in; empty between rooms"),
        label("activity", "what they were doing"),
        label("cause", "movement, act, reading, duplicate or false"),
        label("thing", "what was used, of an act"),
    ]);
    table
}

/// By row of the log, the cause of it, made sure to be of the same run.
fn causes(log: &Log, truth: &Path) -> Result<Vec<Option<Cause>>, LogError> {
    if log.skipped > 0 {
        let what = format!("{} lines of the log are not understood, so its rows cannot be counted", log.skipped);
        return Err(LogError::Changed { place: place_of(truth), what });
    }
    let mut causes: Vec<Option<Cause>> = vec![None; log.events.len()];
    let another = |what: String| LogError::Changed { place: place_of(truth), what };
    for cause in told_causes(truth)? {
        let (row, sensor) = (cause.row as usize, cause.sensor.clone());
        let Some(event) = log.events.get(row) else {
            return Err(another(format!("it tells of row {row}, and the log has {}", log.events.len())));
        };
        let named = log.sensor(event);
        if sensor.is_some_and(|sensor| sensor != named && one_word(&sensor) != named) {
            return Err(another(format!("its row {row} is of another sensor than {named:?}")));
        }
        // An ON tells of the firing that it began with; those that prolong it come later.
        causes[row].get_or_insert(cause);
    }
    Ok(causes)
}

/// What goes on at an instant.
fn span_at(spans: &[Activity], at: Micros) -> Option<&str> {
    let next = spans.partition_point(|span| span.begin <= at);
    spans[..next].last().filter(|span| at < span.end).map(|span| span.name.as_str())
}
