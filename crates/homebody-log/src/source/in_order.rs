//! Rows that come out of order, put into the order of time: intervals tell an OFF before the next ON, and many forms have the rows
//! of each sensor together.
//!
//! So many rows wait that whole files of such forms fit. A larger one is in order as far as its rows are not further apart.

use super::instant::LogInstant;
use super::reading::LogReading;
use crate::error::LogError;
use crate::limits::MOST_WAITING;
use crate::log::Clock;
use foldhash::{HashMap, HashMapExt};
use homebody_core::time::WallTime;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Rows that wait until no earlier one can come.
pub(crate) struct InOrder {
    /// Instants, with the order of rows, which decides at one instant.
    waiting: BinaryHeap<Reverse<(WallTime, u64, WaitingRow)>>,
    come: u64,
    texts: Vec<String>,
    known: HashMap<String, u32>,
    /// The instant of the row that was handed over last.
    handed: WallTime,
    /// Rows that came after a later one had been handed over.
    late: u64,
    has_labels: bool,
}

/// A row by its line, its sensor, its value, its label, and its clock. A text stands by its number.
type WaitingRow = (u64, u32, u32, Option<u32>, Clock);

/// The values of the two ends of an interval.
pub(crate) const ON: &str = "ON";
pub(crate) const OFF: &str = "OFF";

impl InOrder {
    pub fn new() -> InOrder {
        InOrder {
            waiting: BinaryHeap::new(),
            come: 0,
            texts: Vec::new(),
            known: HashMap::new(),
            handed: WallTime::MIN,
            late: 0,
            has_labels: false,
        }
    }

    /// Takes an interval of a sensor: an ON and an OFF, or none of them.
    pub fn interval(
        &mut self,
        line: u64,
        (begin, end): (LogInstant, LogInstant),
        sensor: &str,
        reading: &mut LogReading<'_>,
    ) -> Result<(), LogError> {
        if end.on_wall() < begin.on_wall() || begin.clock() != end.clock() {
            reading.skip(line, crate::source::reading::ENDS_BEFORE.into());
            return Ok(());
        }
        self.row(line, begin, [sensor, ON], None, reading)?;
        self.row(line, end, [sensor, OFF], None, reading)
    }

    pub fn row(
        &mut self,
        line: u64,
        instant: LogInstant,
        [sensor, value]: [&str; 2],
        label: Option<&str>,
        reading: &mut LogReading<'_>,
    ) -> Result<(), LogError> {
        let at = instant.on_wall();
        let (sensor, value) = (self.number(sensor), self.number(value));
        self.has_labels |= label.is_some();
        let label = label.map(|label| self.number(label));
        self.late += u64::from(at < self.handed);
        self.waiting.push(Reverse((at, self.come, (line, sensor, value, label, instant.clock()))));
        self.come += 1;
        while self.waiting.len() > MOST_WAITING {
            self.first(reading)?;
        }
        Ok(())
    }

    fn number(&mut self, text: &str) -> u32 {
        match self.known.get(text) {
            Some(&number) => number,
            None => {
                let number = self.texts.len() as u32;
                self.known.insert(text.to_owned(), number);
                self.texts.push(text.to_owned());
                number
            }
        }
    }

    pub fn end(mut self, reading: &mut LogReading<'_>) -> Result<(), LogError> {
        while self.first(reading)? {}
        if self.late > 0 {
            let remark = format!(
                "{} rows come more than {MOST_WAITING} rows behind later ones, too far to be put into the order of time",
                self.late
            );
            reading.log.remarks.push(remark);
        }
        Ok(())
    }

    /// Hands over the earliest row, if there is one.
    fn first(&mut self, reading: &mut LogReading<'_>) -> Result<bool, LogError> {
        let Some(Reverse((at, _, (line, sensor, value, label, clock)))) = self.waiting.pop() else {
            return Ok(false);
        };
        self.handed = self.handed.max(at);
        let instant = LogInstant::told_by(clock, at);
        let text = |number: u32| &*self.texts[number as usize];
        let is_row = reading.event(line, instant, text(sensor), text(value))?;
        if is_row && self.has_labels {
            reading.label(label.map(text));
        }
        Ok(true)
    }
}
