//! Rows as bytes: how many bytes follow, then the rows, each with its table, its firing and its cells. Texts stay in memory: a run
//! has few, and a text keeps its number.

use crate::table::{Batch, Cell, TextId};
use homebody_core::time::RunTime;
use std::io::{self, Read};

/// The number of a row without a firing.
const NONE: u64 = u64::MAX;

pub(crate) fn write_frame(batch: &Batch) -> Vec<u8> {
    let mut bytes = vec![0; 8];
    for row in batch.rows() {
        bytes.extend((row.table as u32).to_le_bytes());
        bytes.extend(row.firing.unwrap_or(NONE).to_le_bytes());
        bytes.extend((row.cells.len() as u32).to_le_bytes());
        for cell in row.cells {
            let (kind, value) = match *cell {
                Cell::Null => (0u8, 0),
                Cell::Instant(at) => (1, at.micros() as u64),
                Cell::Integer(number) => (2, number as u64),
                Cell::Real(number) => (3, number.to_bits()),
                Cell::Text(TextId(id)) => (4, u64::from(id)),
                Cell::Thousandths(number) => (5, number as u32 as u64),
            };
            bytes.push(kind);
            bytes.extend(value.to_le_bytes());
        }
    }
    let length = bytes.len() as u64 - 8;
    bytes[..8].copy_from_slice(&length.to_le_bytes());
    bytes
}

/// The next batch, and how many bytes it took; its texts are those of `last`.
pub(crate) fn read_frame(from: &mut impl Read, last: &Batch) -> io::Result<(Batch, u64)> {
    let length = u64::from_le_bytes(exactly(from)?);
    let mut bytes = vec![0; length as usize];
    from.read_exact(&mut bytes)?;
    let mut rest = &bytes[..];
    let mut batch = Batch::default();
    while !rest.is_empty() {
        let table = u32::from_le_bytes(exactly(&mut rest)?) as usize;
        let firing = u64::from_le_bytes(exactly(&mut rest)?);
        let width = u32::from_le_bytes(exactly(&mut rest)?);
        let mut cells = Vec::new();
        for _ in 0..width {
            let [kind] = exactly(&mut rest)?;
            let value = u64::from_le_bytes(exactly(&mut rest)?);
            cells.push(match kind {
                0 => Cell::Null,
                1 => Cell::Instant(RunTime::from_micros(value as i64)),
                2 => Cell::Integer(value as i64),
                3 => Cell::Real(f64::from_bits(value)),
                4 => Cell::Text(TextId(value as u32)),
                5 => Cell::Thousandths(value as u32 as i32),
                _ => return Err(io::ErrorKind::InvalidData.into()),
            });
        }
        match firing {
            NONE => batch.push(table, cells),
            firing => batch.push_of(firing, table, cells),
        }
    }
    Ok((batch.with_texts_of(last), length + 8))
}

fn exactly<const N: usize>(from: &mut impl Read) -> io::Result<[u8; N]> {
    let mut bytes = [0; N];
    from.read_exact(&mut bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::TextPool;

    #[test]
    fn rows_are_read_back_unchanged() {
        let mut texts = TextPool::default();
        let (hall, bath) = (texts.id("hall"), texts.id("bath"));
        let mut first = Batch::default();
        let numbers = [
            Cell::Integer(-3),
            Cell::Real(0.1),
            Cell::Thousandths(-250),
            Cell::Instant(RunTime::from_micros(-1)),
            Cell::Null,
        ];
        first.push_of(7, 0, numbers.into_iter().chain([Cell::Text(hall)]));
        let first = first.with(&texts);
        let mut second = Batch::default();
        second.push(2, [Cell::Text(bath)]);
        second.push(1, []);
        let second = second.with(&texts);
        let bytes = [write_frame(&first), write_frame(&second)].concat();
        let mut from = &bytes[..];
        for batch in [first, second.clone()] {
            let (read, _) = read_frame(&mut from, &second).unwrap();
            assert_eq!(read.rows().collect::<Vec<_>>(), batch.rows().collect::<Vec<_>>());
            assert_eq!(read.text(bath), "bath");
        }
        assert!(read_frame(&mut &bytes[..20], &second).is_err(), "one that was cut short");
    }
}
