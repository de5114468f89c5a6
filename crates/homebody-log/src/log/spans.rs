//! Activities in a log that is written anew: as a table of their own, and on the rows themselves.

use super::Log;
use crate::limits::LONGEST_VALUE;
use crate::table::{Cell, Column, ColumnKind, Table, TextPool};
use homebody_core::time::{RunTime, WallTime};
use homebody_timeline::Episode;
use std::collections::VecDeque;

/// The table of whole activities. In CSV it is a file next to the log, in the form of pyadlml.
pub const SPANS: &str = "activity";

/// Its columns.
pub const SPAN_COLUMNS: [&str; 3] = ["start_time", "end_time", LABEL];

/// The column of rows with the label of the activity.
pub(crate) const LABEL: &str = "activity";

/// Beside the label in a form that notes where an activity begins and ends: which of the two it is.
pub(crate) const CHANGE: &str = "change";

/// The separator of the labels of simultaneous activities.
const AND: &str = "|";

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

/// The cells of an activity, with instants since `start`.
pub(crate) fn cells(activity: &Episode<WallTime>, start: WallTime, texts: &mut TextPool) -> [Cell; 3] {
    let name = Cell::Text(texts.id(&activity.label));
    let since_start = |at: WallTime| Cell::Instant(RunTime::START + (at - start));
    [since_start(activity.begin()), since_start(activity.end()), name]
}

/// The activities at each row, for instants that mostly rise: activities in the order of their begins.
pub(crate) struct GoingOn<'a> {
    all: &'a [Episode<WallTime>],
    /// The first that has not begun yet.
    next: usize,
    now: Vec<usize>,
    at: WallTime,
}

impl<'a> GoingOn<'a> {
    pub fn for_log(log: &'a Log) -> GoingOn<'a> {
        GoingOn { all: &log.activities, next: 0, now: Vec::new(), at: WallTime::MIN }
    }

    /// The labels of the activities at an instant, if any, up to the length of a cell.
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

/// Notes of the begins and ends of activities, at most one for a row: at the first free row from then on. If fewer rows are left than
/// notes, they come earlier.
pub(crate) struct RowNotes<'a> {
    left: VecDeque<(WallTime, &'a str, &'static str)>,
}

impl<'a> RowNotes<'a> {
    /// None where a log has fewer rows than notes.
    pub fn for_log(log: &'a Log) -> Option<RowNotes<'a>> {
        let mut notes = Vec::with_capacity(2 * log.activities.len());
        for Episode { label, time } in &log.activities {
            // An end comes before a begin at this instant.
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
