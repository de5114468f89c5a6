//! A table as psql prints it: a line of names, a line of dashes, then rows whose cells are parted by `|`. So the X10 network of
//! MavPad was kept, with the columns mark, zone, number, state, level, source and info.

use super::columns::ColumnPlaces;
use super::lines::LineReader;
use super::messages::FormMessage;
use super::reading::LogReading;
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::{LogError, place_of};
use crate::log::{ColumnRole, ColumnUse};
use homebody_core::scenario::logger::LoggerFile;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "psql",
    what: "a table as psql prints it, with cells separated by |: the X10 network of MavPad, or a log with common column names",
    shows,
    read,
};

/// The places of the parts of a row.
enum LogColumns {
    /// A time, a zone and a number that are the sensor together, its state, and its level where it has no state.
    X10 {
        time: usize,
        zone: usize,
        number: usize,
        state: usize,
        level: Option<usize>,
    },
    Usual(ColumnPlaces),
}

fn columns(heading: &str, file: &LoggerFile) -> Option<LogColumns> {
    let names: Vec<String> = heading.split('|').map(|name| name.trim().to_owned()).collect();
    let place = |wanted: &str| names.iter().position(|name| name.eq_ignore_ascii_case(wanted));
    let x10 = || {
        let (time, zone, number) = (place("mark")?, place("zone")?, place("number")?);
        Some(LogColumns::X10 { time, zone, number, state: place("state")?, level: place("level") })
    };
    x10().or_else(|| ColumnPlaces::by_name(&names, file).map(LogColumns::Usual))
}

impl LogColumns {
    fn record(&self, heading: &str, levels: &X10Levels, reading: &mut LogReading<'_>) {
        let names: Vec<&str> = heading.split('|').map(str::trim).collect();
        let mut column = |place: usize, role: ColumnRole, because: &str| reading.column(names[place], role, because);
        match self {
            LogColumns::X10 { time, zone, number, state, level } => {
                column(*time, ColumnRole::Time, ColumnUse::HEADING);
                column(*zone, ColumnRole::Sensor, ColumnUse::HEADING);
                column(*number, ColumnRole::Sensor, ColumnUse::HEADING);
                column(*state, ColumnRole::Value, "the state of sensors that have several");
                if let Some(level) = level {
                    let zones: Vec<&str> = levels.zones.iter().map(String::as_str).collect();
                    let because = match zones.is_empty() {
                        true => "where there is no state".to_owned(),
                        false => format!("in zone {} it varies while the state stays", zones.join(", ")),
                    };
                    column(*level, ColumnRole::Value, &because);
                }
            }
            LogColumns::Usual(places) => {
                column(places.time, ColumnRole::Time, ColumnUse::HEADING);
                column(places.sensor, ColumnRole::Sensor, ColumnUse::HEADING);
                column(places.value, ColumnRole::Value, ColumnUse::HEADING);
                if let Some(label) = places.label {
                    column(label, ColumnRole::Label, ColumnUse::HEADING);
                }
            }
        }
    }
}

/// The sensors of an X10 network whose level is their reading: it varies while their state is always one.
#[derive(Default)]
struct X10Levels {
    /// By zone and number, whether the level is the reading, for sensors in the beginning.
    sensors: BTreeMap<(String, String), bool>,
    zones: BTreeSet<String>,
}

impl X10Levels {
    fn find(start: &FileStart) -> X10Levels {
        let mut lines = start.lines();
        let known = lines.next().and_then(|heading| columns(&heading, &LoggerFile::default()));
        let Some(LogColumns::X10 { zone, number, state, level: Some(level), .. }) = known else {
            return X10Levels::default();
        };
        let mut said: BTreeMap<(String, String), [BTreeSet<String>; 2]> = BTreeMap::new();
        for line in lines.filter(|line| !is_rule(line) && !is_count(line)) {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            let cell = |place: usize| cells.get(place).copied().unwrap_or_default().to_owned();
            let of = said.entry((cell(zone), cell(number))).or_default();
            for (different, cell) in of.iter_mut().zip([cell(state), cell(level)]).filter(|(_, cell)| !cell.is_empty())
            {
                different.insert(cell);
            }
        }
        let varied = said.iter().filter(|(_, [states, levels])| states.len() > 1 || levels.len() > 1);
        let tells = |[states, levels]: &[BTreeSet<String>; 2]| states.len() <= 1 && levels.len() > 1;
        let sensors: BTreeMap<_, _> = varied.map(|(of, said)| (of.clone(), tells(said))).collect();
        let zones_where = |tells: bool| {
            let those = sensors.iter().filter(move |(_, of)| **of == tells);
            those.map(|((zone, _), _)| zone.clone()).collect::<BTreeSet<_>>()
        };
        let zones = zones_where(true).difference(&zones_where(false)).cloned().collect();
        X10Levels { sensors, zones }
    }

    fn tells(&self, zone: &str, number: &str) -> bool {
        let of = self.sensors.get(&(zone.to_owned(), number.to_owned()));
        of.copied().unwrap_or_else(|| self.zones.contains(zone))
    }
}

fn is_rule(line: &str) -> bool {
    let line = line.trim();
    line.contains('+') && line.bytes().all(|byte| b"-+".contains(&byte))
}

fn shows(start: &FileStart) -> Shows {
    let mut lines = start.lines();
    let is_heading = lines.next().is_some_and(|line| columns(&line, &LoggerFile::default()).is_some());
    Shows::rows_if(is_heading && lines.next().is_some_and(|line| is_rule(&line)))
}

fn read(path: &Path, file: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut lines = LineReader::open(path)?;
    let mut known = None;
    let levels = X10Levels::find(&FileStart::read(path)?);
    while let Some((number, line)) = lines.next_text()? {
        let line = line.trim();
        if line.is_empty() || is_rule(line) || is_count(line) {
            continue;
        }
        let Some(known) = &known else {
            known = columns(line, file);
            known.iter().for_each(|known| known.record(line, &levels, reading));
            if known.is_none() {
                return Err(LogError::no_log(place_of(path), FormMessage::PsqlColumns));
            }
            continue;
        };
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let cell = |place: usize| cells.get(place).copied().unwrap_or_default();
        match known {
            LogColumns::X10 { time, zone, number: of, state, level } => {
                let sensor = format!("{}{}", cell(*zone), cell(*of));
                let (state, level) = (cell(*state), level.map(cell).unwrap_or_default());
                let is_level = state.is_empty() || (!level.is_empty() && levels.tells(cell(*zone), cell(*of)));
                let value = if is_level { level } else { state };
                // Either alone names no sensor.
                let sensor = if cell(*zone).is_empty() || cell(*of).is_empty() { "" } else { &sensor };
                reading.row(number, cell(*time), sensor, value)?;
            }
            LogColumns::Usual(places) => {
                let is_row = reading.row(number, cell(places.time), cell(places.sensor), cell(places.value))?;
                if let (true, Some(label)) = (is_row, places.label) {
                    reading.label(Some(cell(label)).filter(|label| !label.is_empty()));
                }
            }
        }
    }
    Ok(())
}

/// Whether a line is the last one, which says how many rows there are: `(123 rows)`.
fn is_count(line: &str) -> bool {
    let inner = line.strip_prefix('(').and_then(|line| line.strip_suffix(" rows)").or(line.strip_suffix(" row)")));
    inner.is_some_and(|count| count.bytes().all(|byte| byte.is_ascii_digit()))
}
