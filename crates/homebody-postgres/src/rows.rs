//! Rows as the server's binary COPY takes them, kept until they are committed.
//!
//! The format: a header, then for each row how many columns it has and, for each column, how many bytes and these bytes, all
//! numbers with the highest byte first, then -1 (<https://www.postgresql.org/docs/15/sql-copy.html>, binary format).

use crate::schema::InTable;
use bytes::{BufMut, Bytes, BytesMut};
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::{Span, UtcTime};
use homebody_log::table::{Batch, Cell, TextId, thousandths};
use std::sync::Arc;

/// From 1970 to 2000-01-01, where the server's count of microseconds begins.
pub(crate) const EPOCH_2000: Span = Span::from_micros(946_684_800_000_000);

/// The bytes before the rows: the signature, no flags, no extension.
const HEADER: &[u8] = b"PGCOPY\n\xff\r\n\0\0\0\0\0\0\0\0\0";

const TRAILER: &[u8] = &(-1_i16).to_be_bytes();

/// Bytes that are passed to the connection together (our choice).
const CHUNK_BYTES: usize = 1 << 16;

pub(crate) struct Encoder {
    run: i64,
    start: UtcTime,
    time: TimeFormat,
    texts: Vec<Arc<str>>,
    buffer: String,
}

#[derive(Clone, Default)]
pub(crate) struct CopyRows {
    pub count: u64,
    whole: Vec<Bytes>,
    last: BytesMut,
}

impl Encoder {
    pub fn new(run: i64, start: UtcTime, time: TimeFormat) -> Encoder {
        Encoder { run, start, time, texts: Vec::new(), buffer: String::new() }
    }

    /// Learns the texts of a batch. The error is a text that the server cannot hold.
    pub fn learn(&mut self, batch: &Batch) -> Result<(), Arc<str>> {
        let known = self.texts.len();
        self.texts.extend(batch.texts_from(known));
        let refused = self.texts[known..].iter().find(|text| text.contains('\0')).cloned();
        refused.map_or(Ok(()), |text| {
            self.texts.truncate(known);
            Err(text)
        })
    }

    pub fn of_run(&mut self, run: i64, start: UtcTime) {
        (self.run, self.start) = (run, start);
    }

    pub fn row(&mut self, cells: &[Cell], rows: &mut CopyRows) {
        let out = &mut rows.last;
        // The run's id comes first.
        out.put_i16(cells.len() as i16 + 1);
        out.put_i32(8);
        out.put_i64(self.run);
        for &cell in cells {
            self.cell(cell, out);
        }
        rows.count += 1;
        if out.len() >= CHUNK_BYTES {
            rows.whole.push(out.split().freeze());
        }
    }

    fn cell(&mut self, cell: Cell, out: &mut BytesMut) {
        match cell {
            Cell::Null => out.put_i32(-1),
            Cell::Integer(number) => {
                out.put_i32(8);
                out.put_i64(number);
            }
            Cell::Real(number) => {
                out.put_i32(8);
                out.put_f64(number);
            }
            Cell::Instant(at) => {
                out.put_i32(8);
                let epoch = self.start + at.since_zero();
                match self.time {
                    TimeFormat::Local | TimeFormat::LocalOffset | TimeFormat::Utc => {
                        out.put_i64((epoch - EPOCH_2000).micros());
                    }
                    // As SQLite keeps it, too.
                    TimeFormat::EpochS => out.put_f64(epoch.since_zero().seconds()),
                    TimeFormat::EpochMs => out.put_i64(epoch.micros().div_euclid(1000)),
                }
            }
            Cell::Text(TextId(id)) => text(&self.texts[id as usize], out),
            Cell::Thousandths(number) => {
                thousandths(number, &mut self.buffer);
                text(&self.buffer, out);
            }
        }
    }
}

fn text(text: &str, out: &mut BytesMut) {
    out.put_i32(text.len() as i32);
    out.put_slice(text.as_bytes());
}

impl CopyRows {
    pub fn copy(&self) -> impl Iterator<Item = Bytes> + use<> {
        let whole = self.whole.clone();
        let last = Bytes::copy_from_slice(&self.last);
        [Bytes::from_static(HEADER)].into_iter().chain(whole).chain([last, Bytes::from_static(TRAILER)])
    }

    /// The chunks of a COPY of them that will not change any more, from one of them on; the first is the header.
    pub fn whole_from(&self, first: usize) -> impl Iterator<Item = Bytes> + use<> {
        let whole = self.whole.clone();
        [Bytes::from_static(HEADER)].into_iter().chain(whole).skip(first)
    }

    pub fn bytes(&self) -> usize {
        self.whole.iter().map(Bytes::len).sum::<usize>() + self.last.len()
    }
}

pub(crate) fn copy_into(table: &InTable) -> String {
    format!("COPY {} ({}) FROM STDIN (FORMAT binary)", table.quoted, table.columns_quoted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::RunTime;
    use homebody_log::table::TextPool;

    #[test]
    fn encodes_a_row_for_the_server() {
        let mut texts = TextPool::default();
        let mut batch = Batch::default();
        batch.push(0, [Cell::Text(texts.id("hall"))]);
        let batch = batch.with(&texts);
        let mut encoder = Encoder::new(7, UtcTime::EPOCH + EPOCH_2000, TimeFormat::Utc);
        encoder.learn(&batch).unwrap();
        let mut rows = CopyRows::default();
        encoder.row(
            &[Cell::Null, Cell::Instant(RunTime::from_micros(5)), Cell::Text(TextId(0)), Cell::Thousandths(-1500)],
            &mut rows,
        );
        let expected = [
            HEADER,
            &5_i16.to_be_bytes(),
            &[0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0, 7],
            &[255; 4],
            &[0, 0, 0, 8, 0, 0, 0, 0, 0, 0, 0, 5],
            b"\0\0\0\x04hall\0\0\0\x04-1.5",
            TRAILER,
        ]
        .concat();
        let all: Vec<u8> = rows.copy().flatten().collect();
        assert_eq!(all, expected);
    }

    #[test]
    fn a_text_that_no_server_takes_is_found() {
        let mut texts = TextPool::default();
        let mut batch = Batch::default();
        batch.push(0, [Cell::Text(texts.id("a\0b"))]);
        assert!(Encoder::new(1, UtcTime::EPOCH, TimeFormat::Utc).learn(&batch.with(&texts)).is_err());
    }
}
