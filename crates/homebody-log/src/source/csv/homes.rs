//! The homes of a table's rows: one home alone is read.

use super::layout::{TableLayout, refused};
use crate::error::LogError;
use crate::files::plain::text;
use crate::limits::beginning;
use crate::source::messages::TableMessage;
use crate::source::options::TableOptions;
use crate::source::records::{Record, RecordReader};
use std::collections::BTreeSet;
use std::path::Path;

/// So many homes are named.
const NAMED: usize = 10;

/// Largest number of homes that are counted.
const MOST_HOMES: usize = 10_000;

/// Decides which rows are read.
pub(crate) enum HomeFilter {
    /// No column says which home a row is of, or all are read together.
    All,
    Asked {
        column: usize,
        home: Vec<u8>,
    },
    /// There is to be one home alone: the first.
    One {
        column: usize,
        home: Option<Vec<u8>>,
    },
}

impl HomeFilter {
    pub fn new(layout: &TableLayout, options: &TableOptions) -> HomeFilter {
        let asked = options.home.as_ref().and_then(|home| home.home.as_deref());
        match (layout.home, asked) {
            (None, _) | (_, Some("*")) => HomeFilter::All,
            (Some(column), Some(home)) => HomeFilter::Asked { column, home: home.as_bytes().to_owned() },
            (Some(column), None) => HomeFilter::One { column, home: None },
        }
    }

    /// Whether a row is read; `None` if it is of a second home.
    #[inline]
    pub fn admit(&mut self, record: &Record) -> Option<bool> {
        match self {
            HomeFilter::All => Some(true),
            HomeFilter::Asked { column, home } => Some(cell(record, *column) == home),
            HomeFilter::One { column, home } => match (cell(record, *column), &home) {
                (b"", _) => Some(true),
                (cell, Some(home)) => (cell == home).then_some(true),
                (cell, None) => {
                    *home = Some(cell.to_owned());
                    Some(true)
                }
            },
        }
    }
}

fn cell(record: &Record, column: usize) -> &[u8] {
    record.get(column).unwrap_or_default().trim_ascii()
}

/// Refuses a table of several homes, and names them.
pub(crate) fn several(path: &Path, layout: &TableLayout) -> LogError {
    let homes = layout.home.map(|column| homes_in(path, layout, column)).unwrap_or_default();
    let name = layout.home.map(|column| layout.uses[column].column.clone()).unwrap_or_default();
    let count = homes.len();
    let named: Vec<String> = homes.iter().take(NAMED).map(|home| beginning(home)).collect();
    let more = if count > NAMED { format!(" and {} more", count - NAMED) } else { String::new() };
    let first = homes.first().map_or("", String::as_str);
    let (column, homes) = (format!("the column {}", beginning(&name)), format!("{}{more}", named.join(", ")));
    refused(path, TableMessage::SeveralHomes { column, homes, key: name, first: first.into() })
}

/// Refuses a table without a row of the home that is asked for.
pub(crate) fn without(path: &Path, layout: &TableLayout, column: usize, home: &[u8]) -> LogError {
    let homes = homes_in(path, layout, column);
    let homes = homes.iter().take(NAMED).map(|home| beginning(home)).collect();
    let column = format!("the column {}", beginning(&layout.uses[column].column));
    refused(path, TableMessage::NoSuchHome { column, home: beginning(&text(home)), homes })
}

fn homes_in(path: &Path, layout: &TableLayout, column: usize) -> BTreeSet<String> {
    let mut homes = BTreeSet::new();
    let Ok(mut records) = RecordReader::open(path) else { return homes };
    while let Ok(Some((line, record))) = records.next(&mut |_| false) {
        let home = cell(record, column);
        if line >= layout.first_line && !home.is_empty() && homes.len() < MOST_HOMES {
            let home = text(home);
            if !homes.contains(&*home) {
                homes.insert(home.into_owned());
            }
        }
    }
    homes
}
