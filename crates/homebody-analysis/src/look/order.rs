//! The order of a log's rows: that of time, the newest first, or sensor by sensor.

use homebody_core::time::{HOUR, Span, WallTime};
use homebody_log::Event;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Largest change of a clock that is set back (our choice).
const SET_BACK: Span = HOUR.times(3);

/// Largest number of rows that are put into order (our choice): they take 24 MB.
pub(super) const MOST_WAITING: u64 = 1 << 20;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RowOrder {
    /// The order of time, except where clocks were set back.
    OfTime,
    NewestFirst,
    BySensor,
    /// Another order, such as file by file or home by home.
    Another,
}

impl RowOrder {
    /// A sentence on the order of a log, and on whether it was sorted by time.
    pub fn remark(self, is_put_right: bool) -> Option<String> {
        let order = match self {
            RowOrder::OfTime => return None,
            RowOrder::NewestFirst => "its newest rows come first",
            RowOrder::BySensor => "its rows come sensor by sensor",
            RowOrder::Another => "its rows are out of the order of time",
        };
        Some(match is_put_right {
            true => format!("{order}: silences, missing rows and what is stuck are found in the order of time"),
            false => format!(
                "{order}, and they are too many to be put right here: silences, missing rows and what is stuck are not; sort them by time first"
            ),
        })
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct OrderCounts {
    last: Option<(WallTime, u32)>,
    first: WallTime,
    forward: u64,
    back: u64,
    /// The rows that are earlier than the one before, which is of the same sensor.
    back_within: u64,
    /// The largest time by which a row is earlier than the one before.
    most: Span,
    /// The times that rows of one sensor follow rows of another.
    turns: u64,
}

impl OrderCounts {
    pub fn take(&mut self, at: WallTime, sensor: u32) {
        if let Some((before, of)) = self.last {
            self.forward += u64::from(at > before);
            self.back += u64::from(at < before);
            self.back_within += u64::from(at < before && of == sensor);
            self.most = self.most.max(before - at);
            self.turns += u64::from(of != sensor);
        } else {
            self.first = at;
        }
        self.last = Some((at, sensor));
    }

    pub fn is_empty(&self) -> bool {
        self.last.is_none()
    }

    /// The rows that are earlier than the one before, and the largest difference.
    pub fn set_back(&self) -> (u64, Span) {
        (self.back, self.most)
    }

    pub fn order(&self, sensors: usize) -> RowOrder {
        let has_passed = self.last.is_some_and(|(last, _)| last >= self.first);
        match () {
            () if self.back == 0 => RowOrder::OfTime,
            () if self.back > self.forward && !has_passed => RowOrder::NewestFirst,
            () if self.back_within == 0 && self.turns + 1 == sensors as u64 => RowOrder::BySensor,
            () if self.most > SET_BACK => RowOrder::Another,
            () => RowOrder::OfTime,
        }
    }
}

/// Rows that wait to be sorted by time; those of one instant keep their order.
#[derive(Default)]
pub(super) struct RowBuffer {
    rows: BinaryHeap<Reverse<(WallTime, u64, u32, u32)>>,
    come: u64,
}

impl RowBuffer {
    /// Takes a row; returns the earliest one if too many wait.
    pub fn take(&mut self, event: &Event) -> Option<Event> {
        self.rows.push(Reverse((event.at, self.come, event.sensor, event.value)));
        self.come += 1;
        if self.rows.len() as u64 > MOST_WAITING { self.first() } else { None }
    }

    pub fn first(&mut self) -> Option<Event> {
        let Reverse((at, _, sensor, value)) = self.rows.pop()?;
        Some(Event { at, sensor, value })
    }
}
