//! Which number of a table's dates is the day: `02/03/2009` is read in the order that its rows decide, or not at all.

use super::cells::{CellCounts, DateOrders, Reads};
use super::first_rows::FirstRows;
use super::pick::TimeColumns;
use crate::files::plain::text;
use crate::limits::beginning;
use crate::source::messages::TableMessage;
use crate::source::options::DateOrder;
use crate::source::records::RecordReader;
use std::path::Path;

/// The number of dates that must follow on the day before to decide.
const DECIDING_DAYS: usize = 2;

/// Largest number of rows that are read if the first ones do not decide.
const MOST_ROWS: usize = 2_000_000;

/// The order of day and month, if dates are written in numbers with the year last, and what decides it.
///
/// # Errors
///
/// A message, where nothing decides.
pub(crate) fn order_of(
    path: &Path,
    first: &FirstRows,
    time: &TimeColumns,
    asked: Option<DateOrder>,
) -> Result<(Option<DateOrder>, Option<String>), TableMessage> {
    let mut orders = first.cells[time.column].order;
    orders.of_twelve += time.of_day.map_or(0, |of_day| first.cells[of_day].order.of_twelve);
    if orders.day + orders.month + orders.both == 0 {
        return Ok((None, None));
    }
    if asked.is_some() {
        return Ok((asked, Some("--dates says the order of its dates".into())));
    }
    // A damaged year among dates with the year first: the reader skips that line.
    let cells = &first.cells[time.column];
    if 2 * (orders.day + orders.month + orders.both) < cells.instants + cells.dates {
        return Ok((None, None));
    }
    let name = beginning(&first.names[time.column]);
    if orders.day > 0 && orders.month > 0 {
        let (day_first, month_first) = (orders.day, orders.month);
        return Err(TableMessage::MixedDates { column: name, day_first, month_first });
    }
    let found = by_numbers(orders).or_else(|| by_days(first, time.column)).or_else(|| by_habit(orders));
    match found.or_else(|| further(path, first.first_line, time.column)) {
        Some((order, because)) => Ok((Some(order), Some(because))),
        None => {
            let example = first.column(time.column).find(|cell| !cell.trim().is_empty()).unwrap_or_default();
            Err(TableMessage::OpenDates { column: name, example: beginning(example) })
        }
    }
}

/// No month has a number above 12.
fn by_numbers(orders: DateOrders) -> Option<(DateOrder, String)> {
    match (orders.day, orders.month) {
        (0, 0) => None,
        (day, 0) => {
            Some((DateOrder::DayFirst, format!("the day is first: {day} dates have a second number of a month alone")))
        }
        (0, month) => Some((
            DateOrder::MonthFirst,
            format!("the month is first: {month} dates have a first number of a month alone"),
        )),
        _ => None,
    }
}

/// A log has a day after the other.
fn by_days(first: &FirstRows, column: usize) -> Option<(DateOrder, String)> {
    let mut reads = Reads::new();
    let mut days = |order| reads.next_days(first.column(column), order);
    let (day, month) = (days(DateOrder::DayFirst), days(DateOrder::MonthFirst));
    let because = |what: &str, count: usize| format!("the {what} is first: so {count} dates follow on the day before");
    match () {
        () if day >= DECIDING_DAYS && month == 0 => Some((DateOrder::DayFirst, because("day", day))),
        () if month >= DECIDING_DAYS && day == 0 => Some((DateOrder::MonthFirst, because("month", month))),
        () => None,
    }
}

/// Points are between numbers where the day comes first; a clock of twelve hours goes with dates parted by `/` that begin with the
/// month.
fn by_habit(orders: DateOrders) -> Option<(DateOrder, String)> {
    match () {
        () if orders.with_points > 0 => {
            Some((DateOrder::DayFirst, "the day is first, as in all dates with points".into()))
        }
        () if orders.of_twelve > 0 => {
            Some((DateOrder::MonthFirst, "the month is first, as usual with AM and PM".into()))
        }
        () => None,
    }
}

/// The first date further down that has one order alone.
fn further(path: &Path, first_line: u64, column: usize) -> Option<(DateOrder, String)> {
    let mut records = RecordReader::open(path).ok()?;
    let mut reads = Reads::new();
    for _ in 0..MOST_ROWS {
        let (line, record) = records.next(&mut |_| false).ok()??;
        if line < first_line {
            continue;
        }
        let cell = text(record.get(column).unwrap_or_default()).into_owned();
        let Some((order, _)) = by_numbers(CellCounts::count(std::iter::once(cell.as_str()), &mut reads).order) else {
            continue;
        };
        let what = if order == DateOrder::DayFirst { "day" } else { "month" };
        return Some((order, format!("the {what} is first: line {line} has {}", beginning(cell.trim()))));
    }
    None
}
