//! What somebody did, beside the rows of a log that is written anew: as a table of its own, and on the rows themselves.

use super::Log;
use crate::limits::LONGEST_VALUE;
use crate::table::{Cell, Column, ColumnKind, Table, TextPool};
use homebody_core::time::{RunTime, WallTime};
use homebody_timeline::Episode;
use std::collections::VecDeque;

/// The table of activities, which has them whole. In CSV it is a file beside the log, in the form of pyadlml.
pub const SPANS: &str = "activity";

/// Its columns.
pub const SPAN_COLUMNS: [&str; 3] = ["start_time", "end_time", LABEL];

/// The column in which rows have the label of what goes on.
pub(crate) const LABEL: &str = "activity";

/// Beside the label in a form that notes where an activity begins and ends: which of the two it is.
pub(crate) const CHANGE: &str = "change";

/// What parts the labels of several activities that go on at once.
const AND: &str = "|";

/// The table of activities.
pub(crate) fn table() -> Table {
    let [begin, end, label] = SPAN_COLUMNS;
    let column = |name: &str, kind, about| Column { name: name.into(), kind, unit: "", about };
    Table {
        name: SPANS.into(),
        about: "what somebody did",
        columns: vec![
            column(begin, ColumnKind::Instant, "from when"),
            column(end, ColumnKind::Instant, "until when"),
            column(label, ColumnKind::Text, "what it was"),
        ],
        is_numbered: false,
        is_frequent: false,
    }
}

/// The cells of an activity, whose instants are told from `start`.
pub(crate) fn cells(activity: &Episode<WallTime>, start: WallTime, texts: &mut TextPool) -> [Cell; 3] {
    let name = Cell::Text(texts.id(&activity.label));
    let since_start = |at: WallTime| Cell::Instant(RunTime::START + (at - start));
    [since_start(activity.begin()), since_start(activity.end()), name]
}

/// What goes on at each row: activities in the order of their begins, asked for at instants that mostly rise.
pub(crate) struct GoingOn<'a> {
    all: &'a [Episode<WallTime>],
    /// The first that has not begun yet.
    next: usize,
    now: Vec<usize>,
    at: WallTime,
}

impl<'a> GoingOn<'a> {
    pub fn of(log: &'a Log) -> GoingOn<'a> {
        GoingOn { all: &log.activities, next: 0, now: Vec::new(), at: WallTime::MIN }
    }

    /// The labels of what goes on at an instant, if anything does; no more of them than a cell may be long.
    pub fn at(&mut self, at: WallTime) -> Option<String> {
        if at < self.at {
            (self.next, self.now) = (0, Vec::new());
        }
        self.at = at;
        while let Some(activity) = self.all.get(self.next).filter(|activity| activity.begin() <= at) {
            if activity.end() > at {
                self.now.push(self.next);
            }
            self.next += 1;
        }
        self.now.retain(|&index| self.all[index].end() > at);
        let mut label = String::new();
        for &index in &self.now {
            let name = &self.all[index].label;
            if !label.is_empty() && label.len() + name.len() < LONGEST_VALUE {
                label += AND;
                label += name;
            } else if label.is_empty() {
                label.clone_from(name);
            }
        }
        (!label.is_empty()).then_some(label)
    }
}

/// The notes that activities begin and end, one for a row at most: at the first row from then on that has none yet. Where fewer
/// rows are left than notes, they come earlier than that.
pub(crate) struct RowNotes<'a> {
    left: VecDeque<(WallTime, &'a str, &'static str)>,
}

impl<'a> RowNotes<'a> {
    /// None where a log has fewer rows than notes.
    pub fn of(log: &'a Log) -> Option<RowNotes<'a>> {
        let mut notes = Vec::with_capacity(2 * log.activities.len());
        for Episode { label, time } in &log.activities {
            // What ends makes room for what begins at this instant.
            let last = if time.begin == time.end { 2 } else { 0 };
            notes.extend([(time.begin, 1, label.as_str(), "begin"), (time.end, last, label.as_str(), "end")]);
        }
        notes.sort_by_key(|&(at, order, ..)| (at, order));
        let left = notes.into_iter().map(|(at, _, name, change)| (at, name, change)).collect();
        (log.rows >= 2 * log.activities.len() as u64).then_some(RowNotes { left })
    }

    /// The note of a row: what it is about, and what becomes of it. `rows_left` counts this row, too.
    pub fn of_row(&mut self, at: WallTime, rows_left: u64) -> Option<(&'a str, &'static str)> {
        let (from, name, change) = *self.left.front()?;
        if from > at && rows_left > self.left.len() as u64 {
            return None;
        }
        self.left.pop_front();
        Some((name, change))
    }
}
