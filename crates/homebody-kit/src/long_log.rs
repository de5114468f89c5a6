//! A log that is too long for memory: each pass over its rows reads it again.

use homebody_analysis::dates::on_wall;
use homebody_analysis::density::NoMap;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{Micros, SECOND};
use homebody_log::{Event, Log, LogError, Source, stream};
use jiff::tz::TimeZone;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A log with more rows is not kept in memory: so many take 32 MB.
pub const MOST_ROWS: usize = 2_000_000;

/// So many rows wait at most for earlier ones.
const MOST_WAITING: usize = 1 << 17;

/// No clock is set back by more.
const SET_BACK: Micros = 3 * 3600 * SECOND;

/// Takes rows one by one.
pub type TakeRow<'t> = &'t mut dyn FnMut(&Event) -> Result<(), NoMap>;

/// A long log in its place.
pub(crate) struct LongLog {
    place: Source,
    mapping: LoggerFile,
    /// The zone of the home, if the log is in UTC.
    zone: Option<TimeZone>,
    /// The instants of its first row and its last, on its own clock.
    span: (Micros, Micros),
}

/// The rows of a log in memory, unless they are too many.
#[derive(Default)]
pub(crate) struct Kept {
    events: Vec<Event>,
    span: Option<(Micros, Micros)>,
    is_long: bool,
}

impl Kept {
    /// Takes a part of the rows.
    pub fn take(&mut self, part: &Log) {
        let (times, begun) = (part.events.iter().map(|event| event.at), self.span);
        self.span = times
            .fold(begun, |span, at| span.map_or(Some((at, at)), |(first, last)| Some((first.min(at), last.max(at)))));
        self.is_long |= self.events.len() + part.events.len() > MOST_ROWS;
        match self.is_long {
            true => self.events = Vec::new(),
            false => self.events.extend_from_slice(&part.events),
        }
    }

    /// Gives a log its rows; if they are too many, returns the long log instead.
    pub fn give(self, log: &mut Log, place: &Source, mapping: &LoggerFile) -> Option<LongLog> {
        log.events = self.events;
        let span = self.span.filter(|_| self.is_long)?;
        Some(LongLog { place: place.clone(), mapping: mapping.clone(), zone: None, span })
    }
}

impl LongLog {
    /// Has its rows put on the wall of a zone.
    pub fn put_on_wall(&mut self, zone: &TimeZone) {
        self.zone = Some(zone.clone());
    }

    /// Its first row and its last, on the wall.
    pub fn span(&self) -> (Micros, Micros) {
        (self.on_wall(self.span.0), self.on_wall(self.span.1))
    }

    fn on_wall(&self, at: Micros) -> Micros {
        self.zone.as_ref().map_or(at, |zone| on_wall(at, zone))
    }

    /// Gives all its rows in the order of time.
    ///
    /// # Errors
    ///
    /// [`NoMap::Unread`] where it cannot be read again, [`NoMap::Disorder`] where its rows are farther out of order than some that
    /// wait can be put right, and those of `take`.
    pub fn rows(&self, take: TakeRow) -> Result<(), NoMap> {
        let mut waiting: BinaryHeap<Reverse<(Micros, u64, u32, u32)>> = BinaryHeap::with_capacity(MOST_WAITING + 1);
        let (mut come, mut given) = (0, Micros::MIN);
        let mut failed: Option<NoMap> = None;
        let mut give = |at: Micros, sensor: u32, value: u32| {
            let before = given;
            given = given.max(at);
            // When clocks are set back, an hour repeats.
            let is_order = at >= before || self.zone.is_some() && before - at <= SET_BACK;
            if is_order { take(&Event { at, sensor, value }) } else { Err(NoMap::Disorder(at, before)) }
        };
        let read = stream(self.place.clone(), &self.mapping, &mut |part| {
            for event in &part.events {
                waiting.push(Reverse((event.at, come, event.sensor, event.value)));
                come += 1;
                if waiting.len() > MOST_WAITING
                    && let Some(Reverse((at, _, sensor, value))) = waiting.pop()
                    && let Err(why) = give(self.on_wall(at), sensor, value)
                {
                    failed = Some(why);
                    // This error only ends the reading.
                    return Err(LogError::TooLong { place: String::new(), what: String::new() });
                }
            }
            Ok(())
        });
        match (failed, read) {
            (Some(why), _) => return Err(why),
            (None, Err(error)) => return Err(NoMap::Unread(error.to_string())),
            (None, Ok(_)) => {}
        }
        while let Some(Reverse((at, _, sensor, value))) = waiting.pop() {
            give(self.on_wall(at), sensor, value)?;
        }
        Ok(())
    }
}
