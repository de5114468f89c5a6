//! Tables of activities under any name and heading: two instants and a label in each row.

use super::instant::{InstantReader, LogInstant};
use super::lines::LineReader;
use super::messages::FormMessage;
use super::reading::LogReading;
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::{LogError, place_of};
use crate::limits::beginning;
use crate::log::ColumnRole;
use crate::source::casas::words::{CasasTime, is_number, when};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::WallTime;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "labels",
    what: "rows of start, end and label, under a heading for activities or labels",
    shows,
    read,
};

fn shows(start: &FileStart) -> Shows {
    match LabelTable::find(start) {
        Some(LabelTable { is_named: true, .. }) => Shows::Activities,
        _ => Shows::Nothing,
    }
}

/// Words in headings of labels, and words in headings of sensors, in small letters.
const OF_LABELS: [&str; 13] = [
    "activity", "activities", "label", "labels", "annotation", "adl", "behavior", "behaviour", "task", "action",
    "truth", "actividad", "aktivität",
];
const OF_SENSORS: [&str; 12] =
    ["sensor", "sensors", "device", "item", "entity", "val", "value", "state", "location", "message", "pir", "type"];

/// Words in headings of the two ends, in small letters.
const OF_BEGINS: [&str; 5] = ["start", "begin", "from", "started", "onset"];
const OF_ENDS: [&str; 6] = ["end", "stop", "to", "until", "ended", "offset"];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LabelTable {
    /// The delimiter of the cells; None for blanks or tabs.
    delimiter: Option<char>,
    /// The column of the label among those behind the two ends.
    label: usize,
    /// Whether its heading says that it is one.
    pub is_named: bool,
}

/// The possible delimiters: blanks or tabs, commas, semicolons, bars.
const DELIMITERS: [Option<char>; 4] = [None, Some(','), Some(';'), Some('|')];

/// A row's two ends, and the cells behind them.
type LabelRow<'l> = ([LogInstant; 2], Vec<Cow<'l, str>>);

impl LabelTable {
    /// The table that begins so; None for any other text.
    pub fn find(start: &FileStart) -> Option<LabelTable> {
        let lines: Vec<Cow<str>> = start.lines().collect();
        let mut instants = InstantReader::default();
        let mut of_line = |line: &str| DELIMITERS.into_iter().find(|&by| delimited(line, by, &mut instants).is_some());
        let (first, delimiter) = lines.iter().find_map(|line| Some((line, of_line(line)?)))?;
        let rows: Vec<LabelRow> = lines.iter().filter_map(|line| delimited(line, delimiter, &mut instants)).collect();
        let heading: Vec<String> =
            lines.iter().take_while(|line| *line != first).map(|line| line.to_lowercase()).collect();
        let says = |wanted: &[&str]| {
            let mut words = heading.iter().flat_map(|line| line.split(|c: char| !c.is_alphanumeric()));
            words.any(|word| wanted.contains(&word))
        };
        let (is_named, is_of_sensors) = (says(&OF_LABELS), says(&OF_SENSORS));
        let has_ends = says(&OF_BEGINS) && says(&OF_ENDS);
        // The heading and a line cut off at the end do not count as rows.
        let others = lines.len() - rows.len() - heading.len();
        let forward = rows.iter().filter(|(ends, _)| ends_in_order(ends)).count();
        if rows.is_empty()
            || others * 5 > rows.len() + 5
            || forward * 10 < rows.len() * 8
            || (is_of_sensors && !is_named)
        {
            return None;
        }
        let most = rows.iter().map(|(_, cells)| cells.len()).max()?;
        let label = label_column(&heading, delimiter, &rows, most)?;
        (is_named || ((most == 1 || has_ends) && follow(&rows))).then_some(LabelTable { delimiter, label, is_named })
    }
}

/// The column of the label: the one that the heading calls so, else the first with words, else the first.
fn label_column(heading: &[String], delimiter: Option<char>, rows: &[LabelRow], most: usize) -> Option<usize> {
    let names: Vec<&str> = heading.last().map_or(Vec::new(), |line| match delimiter {
        Some(delimiter) => line.split(delimiter).map(|name| name.trim().trim_matches('"')).collect(),
        None => line.split('\t').map(str::trim).filter(|name| !name.is_empty()).collect(),
    });
    let has_labels = |name: &&str| name.split(|c: char| !c.is_alphanumeric()).any(|word| OF_LABELS.contains(&word));
    let named = names.iter().position(has_labels).and_then(|place| {
        // The two ends are before it, or one of them is not.
        place.checked_sub(names.len().checked_sub(most)?)
    });
    let has_words =
        |place: &usize| rows.iter().any(|(_, cells)| cells.get(*place).is_some_and(|cell| !is_number(cell)));
    let different = |place: &usize| {
        let cells: BTreeSet<&str> = rows.iter().filter_map(|(_, cells)| cells.get(*place)).map(AsRef::as_ref).collect();
        cells.len()
    };
    // Notes differ from row to row, a person is the same in many rows.
    let is_few = |place: &usize| rows.len() < 10 || different(place) * 2 <= rows.len();
    let most_different = |with_words: bool| {
        let those = (0..most).rev().filter(is_few).filter(|place| !with_words || has_words(place));
        those.max_by_key(different)
    };
    named.or_else(|| most_different(true)).or_else(|| most_different(false))
}

fn ends_in_order([begin, end]: &[LogInstant; 2]) -> bool {
    begin.clock() == end.clock() && begin.on_wall() <= end.on_wall()
}

/// Whether nearly each row begins when the one before it is over: people do one thing at a time, sensors are on at once.
fn follow(rows: &[LabelRow]) -> bool {
    let mut ends: Vec<[WallTime; 2]> = rows.iter().map(|(ends, _)| ends.map(LogInstant::on_wall)).collect();
    ends.sort_unstable();
    let apart = ends.windows(2).filter(|pair| pair[0][1] <= pair[1][0]).count();
    apart * 10 >= ends.len().saturating_sub(1) * 8
}

/// The two ends that a line has first, and the cells behind them.
fn delimited<'l>(line: &'l str, delimiter: Option<char>, instants: &mut InstantReader) -> Option<LabelRow<'l>> {
    let Some(delimiter) = delimiter else {
        let CasasTime { at: begin, behind, .. } = when(line.as_bytes(), instants)?;
        let CasasTime { at: end, behind, .. } = when(behind, instants)?;
        let behind = str::from_utf8(behind).ok()?.trim();
        let cells: Vec<Cow<str>> =
            behind.split('\t').map(str::trim).filter(|cell| !cell.is_empty()).map(Cow::Borrowed).collect();
        return (!cells.is_empty()).then_some(([begin, end], cells));
    };
    let cells: Vec<&str> = line.split(delimiter).map(|cell| cell.trim().trim_matches('"').trim()).collect();
    let first = cells.iter().position(|cell| cell.contains(':') && instants.read(cell).is_some())?;
    let [begin, end] = [first, first + 1].map(|place| cells.get(place).and_then(|cell| instants.read(cell)));
    let behind: Vec<Cow<str>> =
        cells[..first].iter().chain(cells.get(first + 2..)?).map(|cell| Cow::Borrowed(*cell)).collect();
    (!behind.is_empty()).then_some(([begin?, end?], behind))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let table = LabelTable::find(&FileStart::read(path)?)
        .ok_or_else(|| LogError::no_log(place_of(path), FormMessage::NoLabels))?;
    // For labels of a log, the columns stay those of the log.
    for (name, role) in [("start", ColumnRole::Time), ("end", ColumnRole::End), ("label", ColumnRole::Label)] {
        if reading.log.rows == 0 {
            reading.column(name, role, "each row has two instants and a label");
        }
    }
    let mut lines = LineReader::open(path)?;
    let (mut instants, mut has_begun) = (InstantReader::default(), false);
    while let Some((number, line)) = lines.next_text()? {
        match delimited(&line, table.delimiter, &mut instants) {
            Some((ends, cells)) => {
                has_begun = true;
                let label = cells.get(table.label).map_or("", AsRef::as_ref);
                reading.span(number, ends[0], ends[1], label);
            }
            None if has_begun && !line.trim().is_empty() => {
                reading.skip(number, format!("{} has no start, end and label", beginning(line.trim())));
            }
            None => {}
        }
    }
    Ok(())
}
