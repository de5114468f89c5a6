//! A log in a file of text: whether every line is a row of it, and where rows are numbered, whether each number is there once.

use crate::check::{Check, CheckOptions, RowNumbers};
use crate::error::LogError;
use crate::read::{self, LogSource};
use crate::registry;
use crate::source::TruthValue;
use crate::source::table_files::ReadTable;
use crate::table::{Column, ColumnKind, Table};
use homebody_core::problem::counted;
use homebody_core::scenario::scheme::{NoPlace, OUTPUT};
use std::path::Path;

pub(crate) fn examine(place: &LogSource, asked: &CheckOptions) -> Result<Vec<Check>, LogError> {
    if place.path() == Path::new(OUTPUT) {
        let what = format!("{place} passes rows on, and stores none");
        return Err(NoPlace { what, hint: "name a file".into() }.into());
    }
    let log = match read::survey(place, asked.mapping) {
        Ok(log) => log,
        Err(error) => return Ok(vec![Check::of_error("file", &error)]),
    };
    let mut checks = Vec::new();
    let rows = counted(log.rows as usize, "row", "rows");
    let check = match log.problems.first() {
        None => Check::ok("file", format!("{rows} of {}", counted(log.sensors.len(), "sensor", "sensors"))),
        Some(first) => Check::wrong(
            "file",
            format!(
                "{rows}; cannot read {}, the first is line {}: {}",
                counted(log.skipped as usize, "line", "lines"),
                first.line,
                first.why
            ),
            "a file that ends in half a line was cut off: homebody run --resume FOLDER completes it",
        ),
    };
    let read = registry::built_in_with_form(place.form()).and_then(|row| row.table);
    let numbers = read.and_then(|read| numbered(place.path(), read, asked));
    checks.push(Check { rows: Some(log.rows).filter(|_| numbers.is_none()), ..check });
    checks.extend(
        log.remarks.iter().map(|remark| Check::warning("file", remark.clone(), "check the program that wrote it")),
    );
    checks.extend(numbers);
    Ok(checks)
}

fn numbered(path: &Path, read: ReadTable, asked: &CheckOptions) -> Option<Check> {
    let name = asked.mapping.columns.seq.clone();
    let column = Column { name, kind: ColumnKind::Integer, unit: "", about: "the number of the row" };
    let table = Table { name: String::new(), about: "", columns: vec![column], is_numbered: true, is_frequent: true };
    let mut numbers = RowNumbers::default();
    // A line of another table ends this; the first check has reported it.
    let _ = read(path, &table, &mut |values| {
        if let [TruthValue::Integer(number)] = values {
            numbers.push(*number);
        }
        Ok(())
    });
    // A log of another program has none.
    (numbers.rows() > 0).then(|| numbers.check("this log"))
}
