//! The rows of a log as text, for those who watch a run: the very ones that a logger of the same mapping stores.

use super::instant_writer::InstantWriter;
use super::log_row::{LogRow, Messages};
use super::mapping::ShownTexts;
use crate::error::LogError;
use homebody_core::calendar::Calendar;
use homebody_core::event::Firing;
use homebody_core::ids::SensorId;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::RunTime;

/// Turns a run's firings into the rows of its log. A copy continues as the original.
#[derive(Clone)]
pub struct LogRows {
    messages: Messages,
    shown: ShownTexts,
    clock: InstantWriter,
    rows: Vec<LogRow>,
}

/// A row as a log shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowText {
    /// The rows of a run are numbered from 0.
    pub seq: u64,
    /// The time that the log gives it.
    pub at: RunTime,
    /// Which sensor it is of.
    pub sensor: SensorId,
    /// That time as the log writes it.
    pub time: String,
    /// The id of the sensor in the log.
    pub id: String,
    /// The value, as in the log.
    pub value: String,
}

impl LogRows {
    /// Of a run of this seed, for the sensors of these names, in their order; wrong names are refused as a logger refuses them.
    pub fn new(file: &LoggerFile, seed: u64, sensors: &[String], calendar: &Calendar) -> Result<LogRows, LogError> {
        Ok(LogRows {
            messages: Messages::new(&file.messages, seed, sensors),
            shown: ShownTexts::new(file, sensors)?,
            clock: InstantWriter::new(calendar, file.time),
            rows: Vec::new(),
        })
    }

    /// The rows of all firings from the last `until` to this one, which are given in their order.
    pub fn of(&mut self, firings: &[Firing], until: RunTime) -> impl Iterator<Item = RowText> {
        self.rows.clear();
        for firing in firings {
            self.messages.firing(firing, &mut self.rows);
        }
        self.messages.quiet(until, &mut self.rows);
        let LogRows { shown, clock, rows, .. } = self;
        rows.iter().map(|row| {
            let mut buffer = String::new();
            RowText {
                seq: row.seq,
                at: row.at,
                sensor: row.sensor,
                time: clock.text(row.at).into(),
                id: shown.sensors[row.sensor.index()].clone(),
                value: shown.value(row.value, &mut buffer).into(),
            }
        })
    }
}
