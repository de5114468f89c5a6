//! The text of the CASAS smart homes: `2009-03-02 07:12:03.250000<TAB>BedroomMotion<TAB>ON`, with the activity behind it
//! where rows have labels, or `Cook begin` where an activity begins.
//!
//! Always local time. A sensor's name is one word there: `bedroom motion` becomes `BedroomMotion`.

use super::text::{TextSink, TextTarget};
use super::{Begin, Sink, Watermark};
use crate::error::{HoldMessage, LogError};
use crate::limits::beginning;
use crate::log::{CHANGE, LABEL};
use crate::table::{Batch, Cell, InstantWriter, TextId, apart, thousandths};
use crate::text::one_word;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::RunTime;

/// A text file of a row a line.
pub(crate) struct Casas {
    at: TextTarget,
    is_followed: bool,
    open: Option<OpenCasas>,
}

struct OpenCasas {
    file: TextSink,
    clock: InstantWriter,
    /// Texts as single words.
    texts: Vec<String>,
    /// The columns that are written, in their order.
    columns: Vec<usize>,
    /// The column that says whether an activity begins or ends: it follows the activity after a blank.
    change: Option<usize>,
    line: Vec<u8>,
    number: String,
    rows: u64,
}

impl Casas {
    /// One that `is_followed` has its name from its first line on.
    pub fn new(at: TextTarget, is_followed: bool) -> Casas {
        Casas { at, is_followed, open: None }
    }
}

/// What a line is made of, by the columns of a log and, behind them, the label.
const PARTS: [usize; 3] = [1, 2, 3];
impl Sink for Casas {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let [table] = begin.tables else {
            return Err(LogError::cannot_hold(self.at.place(), HoldMessage::CasasTruth));
        };
        let ids: Vec<String> = begin.run.sensors.iter().map(|sensor| sensor.id.clone()).collect();
        let words = ids.iter().map(|id| one_word(id)).collect();
        apart(&ids, &words)?;
        ids.iter().try_for_each(|id| can_be_told(&self.at, id))?;
        let change = table.column(CHANGE);
        let columns = PARTS.into_iter().chain(table.column(LABEL)).chain(change).collect();
        self.open = Some(OpenCasas {
            file: TextSink::begin(&self.at, begin.how, self.is_followed, begin.deadline)?,
            clock: InstantWriter::new(&begin.run.calendar, TimeFormat::Local),
            texts: Vec::new(),
            columns,
            change,
            line: Vec::new(),
            number: String::new(),
            rows: 0,
        });
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let stopped = || LogError::Stopped { place: self.at.place() };
        let OpenCasas { file, clock, texts, columns, change, line, number, rows } =
            self.open.as_mut().ok_or_else(stopped)?;
        for text in batch.texts_from(texts.len()) {
            can_be_told(&self.at, &text)?;
            texts.push(one_word(&text));
        }
        for row in batch.rows() {
            line.clear();
            for &column in columns.iter() {
                let part = match row.cells[column] {
                    // A row without a label ends before it.
                    Cell::Null => continue,
                    Cell::Instant(at) => clock.text(at),
                    Cell::Text(TextId(id)) => &texts[id as usize],
                    Cell::Thousandths(value) => {
                        thousandths(value, number);
                        number.as_str()
                    }
                    Cell::Integer(value) => {
                        *number = value.to_string();
                        number.as_str()
                    }
                    Cell::Real(value) => {
                        *number = value.to_string();
                        number.as_str()
                    }
                };
                if !line.is_empty() {
                    line.push(if *change == Some(column) { b' ' } else { b'\t' });
                }
                line.extend_from_slice(part.as_bytes());
            }
            line.push(b'\n');
            file.line(line)?;
            *rows += 1;
        }
        file.show()
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let Some(open) = &mut self.open else { return Ok(Watermark::none()) };
        let is_sure = open.file.make_durable()?;
        Ok(Watermark(vec![if is_sure { open.rows } else { 0 }]))
    }

    fn finish(&mut self, _end: RunTime) -> Result<(), LogError> {
        self.open.take().map_or(Ok(()), |open| open.file.finish())
    }
}

/// Refuses a text with characters that part lines and what is in them.
fn can_be_told(at: &TextTarget, text: &str) -> Result<(), LogError> {
    if !text.chars().any(char::is_control) {
        return Ok(());
    }
    Err(LogError::cannot_hold(at.place(), HoldMessage::ControlCharacters { text: beginning(text) }))
}
