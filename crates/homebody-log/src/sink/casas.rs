//! The text of the CASAS smart homes: `2009-03-02 07:12:03.250000<TAB>BedroomMotion<TAB>ON`, with the activity behind it
//! where rows have labels, or `Cook begin` where an activity begins.
//!
//! Always local time. A sensor's name is one word there: `bedroom motion` becomes `BedroomMotion`.

use super::Begin;
use super::text::TextTarget;
use super::text_rows::{CellWriter, TextForm};
use crate::error::{HoldMessage, LogError};
use crate::limits::beginning;
use crate::log::{CHANGE, LABEL};
use crate::table::{BatchRow, InstantWriter, apart};
use crate::text::one_word;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::scenario::scheme::Scheme;

pub(crate) struct Casas {
    /// Texts as single words.
    cells: CellWriter,
    /// The columns that are written, in their order.
    columns: Vec<usize>,
    /// The column that says whether an activity begins or ends: it follows the activity after a blank.
    change: Option<usize>,
}

/// The columns of a log that a line has: time, sensor and message.
const PARTS: [usize; 3] = [1, 2, 3];

impl TextForm for Casas {
    const SCHEME: Scheme = Scheme::Casas;

    fn begin(at: &TextTarget, begin: &Begin) -> Result<Casas, LogError> {
        let [table] = &begin.tables[..] else {
            return Err(LogError::cannot_hold(at.place(), HoldMessage::CasasTruth));
        };
        let ids: Vec<String> = begin.run.sensors.iter().map(|sensor| sensor.id.clone()).collect();
        let words = ids.iter().map(|id| one_word(id)).collect();
        apart(&ids, &words)?;
        ids.iter().try_for_each(|id| refuse_controls(at, id))?;
        let change = table.column(CHANGE);
        let columns = PARTS.into_iter().chain(table.column(LABEL)).chain(change).collect();
        let clock = InstantWriter::new(&begin.run.calendar, TimeFormat::Local);
        Ok(Casas { cells: CellWriter::new(clock), columns, change })
    }

    fn learn(&mut self, at: &TextTarget, text: &str) -> Result<(), LogError> {
        refuse_controls(at, text)?;
        self.cells.texts.push(one_word(text));
        Ok(())
    }

    fn line(&mut self, row: &BatchRow, line: &mut Vec<u8>) {
        for &column in &self.columns {
            // A row without a label ends before it.
            let Some(part) = self.cells.text(row.cells[column]) else { continue };
            if !line.is_empty() {
                line.push(if self.change == Some(column) { b' ' } else { b'\t' });
            }
            line.extend_from_slice(part.as_bytes());
        }
    }
}

/// Refuses a text with characters that would break lines or columns.
fn refuse_controls(at: &TextTarget, text: &str) -> Result<(), LogError> {
    if !text.chars().any(char::is_control) {
        return Ok(());
    }
    Err(LogError::cannot_hold(at.place(), HoldMessage::ControlCharacters { text: beginning(text) }))
}
