//! Rows that come out of order, put into the order of time: intervals tell an OFF before the next ON.
//!
//! So many rows wait that whole files of such forms fit. A larger one is in order as far as its rows are not further apart.

use super::instant::Instant;
use super::reading::Reading;
use crate::error::LogError;
use crate::limits::MOST_WAITING;
use foldhash::{HashMap, HashMapExt};
use homebody_core::time::Micros;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Rows that wait until no earlier one can come.
pub(super) struct InOrder {
    /// Instants, and in which order rows came, which they keep at one instant.
    waiting: BinaryHeap<Reverse<(Micros, u64, Row)>>,
    come: u64,
    sensors: Vec<String>,
    known: HashMap<String, u32>,
}

/// A row by its line, its sensor, whether it is an ON, and whether it has a zone.
type Row = (u64, u32, bool, bool);

/// What the two ends of an interval say.
pub(super) const ON: &str = "ON";
pub(super) const OFF: &str = "OFF";

impl InOrder {
    pub fn new() -> InOrder {
        InOrder { waiting: BinaryHeap::new(), come: 0, sensors: Vec::new(), known: HashMap::new() }
    }

    /// Takes an interval of a sensor: an ON and an OFF, or none of them.
    pub fn interval(
        &mut self,
        line: u64,
        (begin, end): (Instant, Instant),
        sensor: &str,
        reading: &mut Reading<'_>,
    ) -> Result<(), LogError> {
        let [(on, is_utc), (off, ends_utc)] = [begin, end].map(|instant| match instant {
            Instant::Local(at) => (at, false),
            Instant::Utc(at) => (at, true),
        });
        if off < on || is_utc != ends_utc {
            reading.skip(line, super::reading::ENDS_BEFORE.into());
            return Ok(());
        }
        let number = match self.known.get(sensor) {
            Some(&number) => number,
            None => {
                let number = self.sensors.len() as u32;
                self.known.insert(sensor.to_owned(), number);
                self.sensors.push(sensor.to_owned());
                number
            }
        };
        for (at, is_on) in [(on, true), (off, false)] {
            self.waiting.push(Reverse((at, self.come, (line, number, is_on, is_utc))));
            self.come += 1;
        }
        while self.waiting.len() > MOST_WAITING {
            self.first(reading)?;
        }
        Ok(())
    }

    /// Hands over all that still wait.
    pub fn end(mut self, reading: &mut Reading<'_>) -> Result<(), LogError> {
        while self.first(reading)? {}
        Ok(())
    }

    /// Hands over the earliest row, if there is one.
    fn first(&mut self, reading: &mut Reading<'_>) -> Result<bool, LogError> {
        let Some(Reverse((at, _, (line, sensor, is_on, is_utc)))) = self.waiting.pop() else { return Ok(false) };
        let instant = if is_utc { Instant::Utc(at) } else { Instant::Local(at) };
        reading.event(line, instant, &self.sensors[sensor as usize], if is_on { ON } else { OFF })?;
        Ok(true)
    }
}
