//! Joins a log and the truth of its run into rows with labels: the person, the room, the activity, and the cause of the firing.
//!
//! Numbers join a row of the log to its firing, in each mode of messages: the truth has the row of each firing, and the last held firing
//! of each OFF that ends a hold. Room and activity are those of the resident when the sensor began to notice the cause, which a link may
//! have delayed.
//!
//! We assume that the log is whole and in its order, in any form; its sensors are compared with those of the truth. Both are read as
//! streams, so neither has to fit into memory. Instants are the run's own.

use super::{Besides, Transfer};
use crate::error::{LogError, OtherRunMessage};
use crate::limits::beginning;
use crate::log::{Event, Log};
use crate::read::stream;
use crate::table::{Cell, Column, ColumnKind, TextPool};
use crate::text::one_word;
use crate::truth::{Cause, Causes, LABEL_TABLES, RecordedTruth, timeline_of};
use crate::url::Url;
use homebody_core::time::TimeScale;
use homebody_timeline::Timeline;

/// The result of a join.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Labelled {
    /// Rows of the log, all of which are written.
    pub rows: u64,
    /// Rows that a person caused.
    pub somebodys: u64,
    /// Rows without a person as their cause: a reading, a false firing.
    pub nobodys: u64,
    /// Rows without a cause in the truth.
    pub unexplained: u64,
}

/// Writes the rows of a log with their labels from the truth of its run; `about` is the log's [`survey`](crate::read::survey), `scale`
/// reads the instants of the truth, and `progress` gets the number of written rows. After an error of log or truth, nothing is written.
///
/// # Errors
///
/// [`LogError::NoTruth`] if the place has no truth, [`LogError::Gaps`] if lines of the log are not understood, [`LogError::OtherRun`] if
/// the truth is of another run.
pub fn label(
    transfer: &Transfer,
    about: &Log,
    truth: &Url,
    scale: &TimeScale,
    mut progress: impl FnMut(u64),
) -> Result<Labelled, LogError> {
    if about.skipped > 0 {
        let (place, problems) = (transfer.from.to_string(), about.problems.clone());
        return Err(LogError::Gaps { place, problems, skipped: about.skipped });
    }
    let (place, truth) = (truth.to_string(), RecordedTruth::open(truth, &LABEL_TABLES)?);
    make_sure(transfer, about, Causes::of(&truth, scale)?, &place)?;
    let timeline = timeline_of(&truth, scale)?;
    let mut causes = Causes::of(&truth, scale)?;
    let mut labelled = Labelled::default();
    let mut label = |row: u64, _: &Event, _: &Log, texts: &mut TextPool, cells: &mut Vec<Cell>| {
        let cause = causes.of_row(row)?;
        match &cause {
            None => labelled.unexplained += 1,
            Some(Cause { resident: Some(_), .. }) => labelled.somebodys += 1,
            Some(Cause { resident: None, .. }) => labelled.nobodys += 1,
        }
        let mut text = |text: Option<&str>| text.map_or(Cell::Null, |text| Cell::Text(texts.id(text)));
        cells.extend(labels(cause.as_ref(), &timeline).map(&mut text));
        Ok(())
    };
    labelled.rows = transfer.write(about, besides(), &mut label, &mut progress)?;
    Ok(labelled)
}

/// The person, the room, the activity, the cause, and the thing that was used.
fn labels<'t>(cause: Option<&'t Cause>, timeline: &'t Timeline) -> [Option<&'t str>; 5] {
    let who = cause.and_then(|cause| cause.resident.as_deref());
    let at = cause.and_then(|cause| cause.seen_at);
    let person = who.and_then(|who| timeline.people.iter().find(|person| person.name == who)).zip(at);
    let room = person.and_then(|(person, at)| person.room_at(at));
    let activity = person.and_then(|(person, at)| person.activity_at(at));
    [who, room, activity, cause.map(|cause| cause.why.as_str()), cause.and_then(|cause| cause.thing.as_deref())]
}

fn besides() -> Besides<'static> {
    let label = |name: &str, about| Column { name: name.into(), kind: ColumnKind::Text, unit: "", about };
    Besides {
        table: Some(("labelled", "what a sensor said, with who it was, where, doing what, and why")),
        columns: vec![
            label("resident", "whose doing it was; empty where it was nobody's"),
            label("room", "the room that they were in; empty between rooms"),
            label("activity", "what they were doing"),
            label("cause", "movement, act, reading, duplicate or false"),
            label("thing", "what was used, of an act"),
        ],
        ..Besides::of_log()
    }
}

/// Makes sure that log and truth are of one run: that the truth tells of rows that there are, each of the same sensor.
fn make_sure(transfer: &Transfer, about: &Log, mut causes: Causes<'_>, truth: &str) -> Result<(), LogError> {
    let another = |why: OtherRunMessage| LogError::other_run(truth, why);
    match causes.last_row()? {
        Some(row) if row >= about.rows => {
            return Err(another(OtherRunMessage::FewerRows { row, rows: about.rows }));
        }
        None if about.rows > 0 => return Err(another(OtherRunMessage::NoRows)),
        _ => {}
    }
    let mut row = 0;
    stream(transfer.from, transfer.mapping, &mut |part| {
        for event in &part.events {
            let (sensor, named) = (causes.of_row(row)?.and_then(|cause| cause.sensor), part.sensor(event));
            if sensor.is_some_and(|sensor| sensor != named && one_word(&sensor) != named) {
                return Err(another(OtherRunMessage::OtherSensor { row, sensor: beginning(named) }));
            }
            row += 1;
        }
        Ok(())
    })?;
    Ok(())
}
