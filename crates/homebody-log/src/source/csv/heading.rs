//! The heading of a table: programs write titles, comments, and rows of other tables above it.
//!
//! The heading is the last row of names before the rows that have an instant, as most rows have as many cells.

use super::cells::{CellCounts, Reads, is_blank};
use crate::log::ColumnRole;
use crate::source::columns::role_of;
use crate::source::instant::date_parts::no_such_day;
use std::collections::{BTreeMap, BTreeSet};

pub(crate) type NumberedRow = (u64, Vec<String>);

/// Largest number of rows above the first one with an instant.
const MOST_ABOVE: usize = 60;

pub(crate) struct TableBeginning {
    pub names: Option<Vec<String>>,
    /// The first row behind the heading, by its place.
    pub first: usize,
    pub remarks: Vec<String>,
}

impl TableBeginning {
    /// That of a table; `is_heading` says of a first row whether it is one.
    pub fn find(
        rows: &[NumberedRow],
        is_heading: &mut dyn FnMut(&[String]) -> bool,
        reads: &mut Reads,
    ) -> Option<TableBeginning> {
        let width = usual_width(rows);
        let is_comment = |row: &[String]| row[0].starts_with('#') && (row.len() != width || row[0].len() > 1);
        let is_above = |(_, row): &&NumberedRow| width > 1 && (row.len() == 1 || is_comment(row) || is_separator(row));
        let above = rows.iter().take_while(is_above).count();
        let rest = rows.get(above..).filter(|rest| !rest.is_empty())?;
        let block = names_above(rest, width, reads);
        let found = block.as_ref().map(|block| joined(&rest[block.clone()], rest, reads));
        let (place, last) = match (&block, &found) {
            (Some(block), Some((at, _))) => (above + block.start + at, above + block.end),
            _ => (above, above + 1),
        };
        // A heading behind a mark of comments.
        let comment = above.checked_sub(1).map(|at| &rows[at].1).filter(|row| row.len() == width && width > 1);
        if let (Some(comment), None) = (comment, &block)
            && !is_heading(&rest[0].1)
        {
            let mut names = comment.clone();
            names[0] = names[0].trim_start_matches('#').trim().to_owned();
            if is_heading(&names) && names.iter().any(|name| role_of(name).is_some()) {
                return Some(TableBeginning { names: Some(names), first: above, remarks: passed(&rows[..above - 1]) });
            }
        }
        let names = match found {
            Some((_, names)) => Some(names),
            None => is_heading(&rest[0].1).then(|| rest[0].1.clone()),
        };
        let mut remarks = passed(&rows[..place]);
        if last > place + 1 {
            remarks.push(format!("lines {} to {} are its heading together", rows[place].0, rows[last - 1].0));
        }
        let first = if names.is_some() { last } else { place };
        Some(TableBeginning { names, first, remarks })
    }
}

/// Whether a row says which mark parts cells, as a spreadsheet's own `sep=;` does.
fn is_separator(row: &[String]) -> bool {
    row[0].trim_start_matches('"').to_lowercase().starts_with("sep=") && row[1..].iter().all(String::is_empty)
}

fn passed(rows: &[NumberedRow]) -> Vec<String> {
    let (Some((first, _)), Some((last, _))) = (rows.first(), rows.last()) else { return Vec::new() };
    let lines = if first == last { format!("line {first} is") } else { format!("lines {first} to {last} are") };
    vec![format!("{lines} above its heading, and passed over")]
}

/// The number of cells that most rows have.
fn usual_width(rows: &[NumberedRow]) -> usize {
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    rows.iter().for_each(|(_, row)| *counts.entry(row.len()).or_default() += 1);
    counts.into_iter().max_by_key(|(width, count)| (*count, *width)).map_or(0, |(width, _)| width)
}

/// The rows of names right above the first row with an instant; `None` where the first row of all decides.
fn names_above(rows: &[NumberedRow], width: usize, reads: &mut Reads) -> Option<std::ops::Range<usize>> {
    let times = times(rows, width, reads)?;
    let mut has_time = |row: &[String]| {
        times.iter().all(|&at| {
            let cells = CellCounts::count(row.get(at).map(String::as_str).into_iter(), reads);
            cells.moments() + cells.dates + cells.times > 0
        })
    };
    let first = rows.iter().take(MOST_ABOVE).position(|(_, row)| row.len() == width && has_time(row))?;
    let mut alone = Reads::new();
    let mut is_name = |cell: &String| {
        let cells = CellCounts::count(std::iter::once(cell.as_str()), &mut alone);
        // Numbers of devices are long.
        let is_of_device = cell.len() >= 6 && cell.bytes().all(|byte| byte.is_ascii_digit());
        is_of_device || cells.numbers + cells.moments() + cells.dates + cells.times == 0 && no_such_day(cell).is_none()
    };
    let mut are_names = |(_, row): &&NumberedRow| {
        let filled = row.iter().filter(|cell| !is_blank(cell)).count();
        row.len().abs_diff(width) <= 1 && 2 * filled >= width && filled > 1 && row.iter().all(&mut is_name)
    };
    let count = rows[..first].iter().rev().take_while(&mut are_names).count();
    let block = first - count..first;
    // A row without an instant whose names are repeated below is not a heading.
    let cells = |row: &'_ NumberedRow| -> Vec<(usize, String)> {
        row.1.iter().cloned().enumerate().filter(|(_, cell)| !is_blank(cell)).collect()
    };
    let below: BTreeSet<(usize, String)> = rows[first..].iter().flat_map(cells).collect();
    let is_data = |row: &NumberedRow| cells(row).iter().any(|cell| below.contains(cell));
    (first > 1 && count > 0 && !rows[block.clone()].iter().any(is_data)).then_some(block)
}

/// The column of instants, or those of the date and the time of day, by most rows.
fn times(rows: &[NumberedRow], width: usize, reads: &mut Reads) -> Option<Vec<usize>> {
    let whole = || rows.iter().filter(|(_, row)| row.len() == width);
    let mut of = |place: usize| CellCounts::count(whole().map(move |(_, row)| row[place].as_str()), reads);
    let columns: Vec<CellCounts> = (0..width).map(&mut of).collect();
    let find = |is: fn(&CellCounts) -> usize| columns.iter().position(|cells| cells.are_mostly(is(cells)));
    let instants = find(|cells| cells.instants).or_else(|| find(|cells| cells.epochs));
    let parts = || Some(vec![find(|cells| cells.dates)?, find(|cells| cells.times)?]);
    instants.map(|at| vec![at]).or_else(parts)
}

/// The names of columns by rows of names, and the first of these rows that counts: those of one row, or of two where one row has
/// the same name twice.
fn joined(block: &[NumberedRow], rows: &[NumberedRow], reads: &mut Reads) -> (usize, Vec<String>) {
    let cells = |place: usize| rows.iter().map(move |(_, row)| row.get(place).map_or("", String::as_str));
    let width = block.iter().map(|(_, row)| row.len()).max().unwrap_or(0);
    let time = (0..width).find(|&place| {
        let cells = CellCounts::count(cells(place), reads);
        cells.are_mostly(cells.moments()) || cells.are_mostly(cells.dates)
    });
    let is_of_time = |row: &[String]| {
        let name = time.and_then(|time| row.get(time));
        name.and_then(|name| role_of(name)).is_some_and(|(role, _)| role == ColumnRole::Time)
    };
    let differ = |row: &[String]| {
        let filled: Vec<&String> = row.iter().filter(|cell| !cell.is_empty()).collect();
        filled.iter().collect::<BTreeSet<_>>().len() == filled.len()
    };
    let both = |upper: &[String], lower: &[String]| -> Vec<String> {
        let cell = |row: &[String], place: usize| row.get(place).cloned().unwrap_or_default();
        (0..width).map(|at| format!("{} {}", cell(upper, at), cell(lower, at)).trim().to_owned()).collect()
    };
    let names: Vec<&[String]> = block.iter().map(|(_, row)| &row[..]).collect();
    let last = names.len() - 1;
    let of_time = names.iter().rposition(|row| is_of_time(row));
    // The last row may be of units: the first whose names differ is the heading.
    let alone = || names.iter().position(|row| row.len() == width && differ(row));
    if let Some(at) = of_time.or_else(alone) {
        return (at, names[at].to_vec());
    }
    let pairs = (0..last).flat_map(|upper| (upper + 1..=last).map(move |lower| (upper, lower)));
    let mut pairs = pairs.map(|(upper, lower)| (upper, both(names[upper], names[lower])));
    pairs.find(|(_, row)| differ(row)).unwrap_or_else(|| (last, names[last].to_vec()))
}
