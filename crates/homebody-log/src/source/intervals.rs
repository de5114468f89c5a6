//! The intervals of van Kasteren's homes and of UCI's "ADLs Recognition Using Binary Sensors": the times at which a sensor was on, or an
//! activity lasted.
//!
//! A row is `start end id value` with the ids' names in the text above, or `start end location type place`, separated by any number of
//! tabs and blanks. Activities are in a text of their own, with a heading that says so.

use super::in_order::InOrder;
use super::instant::{InstantReader, LogInstant};
use super::lines::LineReader;
use super::reading::LogReading;
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::LogError;
use crate::limits::{LONGEST_ID, beginning};
use crate::log::ColumnRole;
use homebody_core::scenario::logger::LoggerFile;
use std::collections::BTreeMap;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "intervals",
    what: "rows of start, end and sensor, or of start, end and activity, separated by tabs or blanks: the homes of van Kasteren and \
           of the UCI ADL data",
    shows,
    read,
};

fn shows(start: &FileStart) -> Shows {
    let mut instants = InstantReader::default();
    let mut is_of_activities = false;
    for line in start.lines() {
        is_of_activities |= speaks_of_activities(&line);
        if interval(&line, &mut instants).is_some() {
            return if is_of_activities { Shows::Activities } else { Shows::Rows };
        }
    }
    Shows::Nothing
}

fn speaks_of_activities(heading: &str) -> bool {
    heading.to_ascii_lowercase().contains("activity")
}

/// The two ends of an interval, and what is behind them.
fn interval<'l>(line: &'l str, instants: &mut InstantReader) -> Option<((LogInstant, LogInstant), &'l str)> {
    let (begin, rest) = leading(line, instants)?;
    let (end, rest) = leading(rest, instants)?;
    Some(((begin, end), rest))
}

/// The instant that a text begins with: a date and a time.
fn leading<'l>(text: &'l str, instants: &mut InstantReader) -> Option<(LogInstant, &'l str)> {
    let text = text.trim_start();
    let date = text.find(char::is_whitespace)?;
    let time = date + text[date..].find(|c: char| !c.is_whitespace())?;
    let end = text[time..].find(char::is_whitespace).map_or(text.len(), |length| time + length);
    Some((instants.read(&text[..end])?, &text[end..]))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut lines = LineReader::open(path)?;
    let (mut names, mut order) = (BTreeMap::new(), InOrder::new());
    let (mut is_of_activities, mut is_heading) = (false, true);
    let mut instants = InstantReader::default();
    while let Some((number, line)) = lines.next_text()? {
        match interval(&line, &mut instants) {
            Some((ends, what)) => {
                if is_heading {
                    let of = if is_of_activities { ColumnRole::Label } else { ColumnRole::Sensor };
                    let parts =
                        [("the first date and time", ColumnRole::Time), ("the second date and time", ColumnRole::End)];
                    reading.columns_of_form(&parts);
                    reading.columns_of_form(&[("what is behind them", of)]);
                }
                is_heading = false;
                let what = called(what, &names);
                if what.is_empty() {
                    reading.skip(number, "nothing is behind start and end".into());
                } else if is_of_activities {
                    reading.span(number, ends.0, ends.1, &what);
                } else {
                    order.interval(number, ends, &what, reading)?;
                }
            }
            None if is_heading => {
                is_of_activities |= speaks_of_activities(&line);
                names.extend(named(&line));
            }
            // Lines of dashes or stars part what is in such a text; the last says how many rows there are.
            None if line.starts_with("Length:") => {}
            None if line.trim().bytes().all(|byte| b"-* \t".contains(&byte)) => {}
            None => reading.skip(number, format!("{} does not begin with start and end", beginning(line.trim()))),
        }
    }
    order.end(reading)
}

/// An id and its name, as in `[ 1]  'Microwave'` or `10:'go to bed'`.
fn named(heading: &str) -> Option<(String, String)> {
    let (id, name) = heading.split_once('\'')?;
    let id = id.trim_matches(|c: char| !c.is_ascii_digit());
    let name = name.split('\'').next()?.trim();
    let fits = !id.is_empty() && id.bytes().all(|byte| byte.is_ascii_digit()) && !name.is_empty();
    (fits && name.len() <= LONGEST_ID).then(|| (id.to_owned(), name.to_owned()))
}

/// The subject of a row: an id's name, or all the words, without the value that is always 1.
fn called(what: &str, names: &BTreeMap<String, String>) -> String {
    let words: Vec<&str> = what.split_whitespace().collect();
    match words[..] {
        [id] | [id, "1"] if id.bytes().all(|byte| byte.is_ascii_digit()) => {
            names.get(id).cloned().unwrap_or_else(|| id.to_owned())
        }
        _ => words.join(" "),
    }
}
