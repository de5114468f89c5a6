//! Decides the use of each column of a table by their headings and by the cells of its first rows.
//!
//! | rows | evidence |
//! |---|---|
//! | events | an instant, a sensor whose name comes again, and a value or not |
//! | intervals | two instants, the second never earlier, or an instant and a duration |
//! | wide | an instant, and a number or a state under each other heading |
//!
//! A heading decides where its name is known and its cells do not speak against it. Any other table is refused with
//! what it lacks.

use super::cells::{CellCounts, is_off};
use super::dates::order_of;
use super::decimals::NumberForm;
use super::first_rows::FirstRows;
use super::measured::measured;
use super::pick::{EndColumn, Pick, TimeColumns};
use crate::error::{LogError, place_of};
use crate::files::plain;
use crate::limits::beginning;
use crate::log::{ColumnRole, ColumnUse};
use crate::source::columns::{ColumnPlaces, is_of_utc};
use crate::source::messages::TableMessage;
use crate::source::options::{DateOrder, TableOptions};
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

pub(crate) struct TableLayout {
    /// The line of the first row: the heading and all above it come before.
    pub first_line: u64,
    pub time: TimeColumns,
    pub order: Option<DateOrder>,
    pub rows: RowColumns,
    pub home: Option<usize>,
    pub label: Option<usize>,
    pub kind: Option<usize>,
    pub room: Option<usize>,
    pub unit: Option<usize>,
    pub numbers: NumberForm,
    /// Whether the heading of its time says that the clock is UTC's.
    pub is_utc: bool,
    /// Whether its instants are the numbers of days in a spreadsheet.
    pub has_day_numbers: bool,
    pub uses: Vec<ColumnUse>,
    pub remarks: Vec<String>,
}

pub(crate) enum RowColumns {
    Events {
        sensor: SensorColumns,
        /// `None`: each row is a firing.
        value: Option<usize>,
        /// Whether the columns have the names of a mapping.
        is_mapped: bool,
    },
    Intervals {
        end: EndColumn,
        sensor: SensorColumns,
        value: Option<usize>,
        is_of_activities: bool,
    },
    Wide {
        /// The columns whose cells stand before the heading in a sensor's name.
        prefix: Vec<usize>,
        sensors: Vec<WideSensor>,
    },
}

/// The place of the name of a row's sensor.
pub(crate) enum SensorColumns {
    /// In these columns, parted by a blank.
    Columns(Vec<usize>),
    Alone(String),
}

pub(crate) struct WideSensor {
    pub column: usize,
    pub name: String,
    /// Whether it has two states or a few words, so that only changes are rows.
    pub has_states: bool,
    /// The unit behind its numbers.
    pub unit: Option<String>,
}

impl TableLayout {
    /// That of a table; `None` of one that has no rows yet.
    ///
    /// # Errors
    ///
    /// [`LogError::NoLog`] with what speaks against a log of sensors, and what reading the first rows comes to.
    pub fn find(path: &Path, file: &LoggerFile, options: &TableOptions) -> Result<Option<TableLayout>, LogError> {
        let Some(first) = FirstRows::read(path, file)? else { return Ok(None) };
        let is_ours = |names: &[String]| ColumnPlaces::by_name(names, file).is_some_and(|places| places.is_mapped);
        match first.rows.is_empty() {
            true if is_ours(&first.names) => return Ok(None),
            true => return Err(refused(path, TableMessage::NoRows)),
            false => {}
        }
        decide(path, &first, file, options).map(Some).map_err(|why| refused(path, why))
    }
}

pub(crate) fn refused(path: &Path, why: TableMessage) -> LogError {
    LogError::no_log(place_of(path), why)
}

fn decide(
    path: &Path,
    first: &FirstRows,
    file: &LoggerFile,
    options: &TableOptions,
) -> Result<TableLayout, TableMessage> {
    if 2 * first.longer > first.rows.len() {
        return Err(TableMessage::MoreCells { names: first.names.len() });
    }
    let mut pick = Pick::from_rows(first);
    pick.home(options.home.as_ref())?;
    let mapped = ColumnPlaces::by_name(&first.names, file).filter(|places| places.is_mapped && first.has_heading);
    if let Some(ColumnPlaces { time, sensor, value, label, .. }) = mapped {
        pick.all_by_name([time, sensor, value], label);
        let rows =
            RowColumns::Events { sensor: SensorColumns::Columns(vec![sensor]), value: Some(value), is_mapped: true };
        return finish(path, pick, TimeColumns::at(time), rows, options);
    }
    let time = pick.time()?;
    pick.besides();
    if options.is_wide {
        pick.other_instants();
        let rows = wide(&mut pick, Vec::new())?;
        return finish(path, pick, time, rows, options);
    }
    pick.no_program_log()?;
    pick.no_other_list()?;
    let rows = match pick.end(&time) {
        Some(end) => intervals(path, &mut pick, &time, end)?,
        None => events_or_wide(path, &mut pick)?,
    };
    finish(path, pick, time, rows, options)
}

fn finish(
    path: &Path,
    mut pick: Pick,
    time: TimeColumns,
    rows: RowColumns,
    options: &TableOptions,
) -> Result<TableLayout, TableMessage> {
    let (order, because) = order_of(path, pick.first, &time, options.dates)?;
    if let Some(because) = because {
        pick.add_reason(time.column, &because);
    }
    let numbers: Vec<usize> = match &rows {
        RowColumns::Events { value, .. } | RowColumns::Intervals { value, .. } => value.iter().copied().collect(),
        RowColumns::Wide { sensors, .. } => sensors.iter().map(|sensor| sensor.column).collect(),
    };
    let columns = numbers;
    let numbers = NumberForm::find(pick.first, &columns, options.decimals)?;
    for &column in &columns {
        if let Some(because) = numbers.reason(column, pick.first) {
            pick.add_reason(column, &because);
        }
    }
    let names: &[usize] = match &rows {
        RowColumns::Events { sensor: SensorColumns::Columns(columns), .. }
        | RowColumns::Intervals { sensor: SensorColumns::Columns(columns), .. } => columns,
        RowColumns::Wide { prefix, .. } => prefix,
        _ => &[],
    };
    pick.check_home(names, options.home.is_some());
    let mut remarks: Vec<String> = pick.first.remarks.clone();
    remarks.append(&mut pick.remarks);
    let (is_utc, has_day_numbers) = (says_utc(&time, &mut pick), time.has_day_numbers);
    if time.is_since_start {
        remarks.push("its dates are not known: its seconds are those since 1 January 1970".to_owned());
    }
    let of = |role| pick.taken(role);
    Ok(TableLayout {
        first_line: pick.first.first_line,
        order,
        home: of(ColumnRole::Home),
        label: of(ColumnRole::Label),
        kind: of(ColumnRole::Kind),
        room: of(ColumnRole::Room),
        unit: of(ColumnRole::Unit),
        numbers,
        is_utc,
        has_day_numbers,
        uses: pick.uses(),
        remarks,
        time,
        rows,
    })
}

/// Whether the heading of the time says that its clock is UTC's.
fn says_utc(time: &TimeColumns, pick: &mut Pick) -> bool {
    let columns = [Some(time.column), time.of_day];
    let told =
        columns.into_iter().flatten().find(|&column| pick.first.has_heading && is_of_utc(&pick.first.names[column]));
    if let Some(column) = told {
        pick.add_reason(column, "its heading says that the clock is UTC's");
    }
    told.is_some()
}

fn intervals(path: &Path, pick: &mut Pick, time: &TimeColumns, end: EndColumn) -> Result<RowColumns, TableMessage> {
    let label = pick.taken(ColumnRole::Label);
    let sensor = pick.by_heading(ColumnRole::Sensor);
    if let Some(label) = label.or_else(|| sensor.is_none().then(|| pick.activities()).flatten()) {
        return Ok(RowColumns::Intervals {
            end,
            sensor: SensorColumns::Columns(vec![label]),
            value: None,
            is_of_activities: true,
        });
    }
    let Some(sensor) = pick.sensor(false)? else {
        return match pick.value_columns().is_empty() || time.is_since_start {
            true => Ok(RowColumns::Intervals { end, sensor: alone(path), value: None, is_of_activities: false }),
            false => {
                at_start(pick, end);
                wide(pick, Vec::new())
            }
        };
    };
    let value = pick.value(sensor);
    let sensors = pick.apart(sensor, value);
    pick.leftover_room();
    pick.no_keys(sensor, value)?;
    match value.filter(|&value| !time.is_since_start && !says_on(&pick.first.cells[value])) {
        Some(value) => {
            at_start(pick, end);
            Ok(events(sensors, Some(value)))
        }
        None => {
            Ok(RowColumns::Intervals { end, sensor: SensorColumns::Columns(sensors), value, is_of_activities: false })
        }
    }
}

/// Whether the values of intervals say no more than that something is on then, or else that it is not.
fn says_on(cells: &CellCounts) -> bool {
    cells.are(cells.switches) && cells.texts.keys().any(|text| !is_off(text))
}

/// Each row of intervals says its values at its start: they are more than that something is on.
fn at_start(pick: &mut Pick, end: EndColumn) {
    let (EndColumn::At(column) | EndColumn::After(column, _)) = end;
    let name = beginning(&pick.first.names[column]);
    pick.remarks.push(format!("each row says its values at its start: the ends or durations in {name} are left out"));
}

/// A sensor that no column names has the name of the file.
fn alone(path: &Path) -> SensorColumns {
    // A packed text has two endings.
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let name = name.split('.').find(|part| !part.is_empty()).unwrap_or("sensor");
    SensorColumns::Alone(channel_name(path, name).unwrap_or_else(|| name.to_owned()))
}

/// A channel by the table next to its file, as in UK-DALE: `3 kettle` for `channel_3.dat`.
fn channel_name(path: &Path, name: &str) -> Option<String> {
    /// Largest number of bytes of such a table (our choice).
    const LARGEST_BYTES: u64 = 1 << 16;
    let (_, number) = name.rsplit_once('_')?;
    let table = plain::read_text(&path.with_file_name("labels.dat"), LARGEST_BYTES).ok()?;
    let mut names = table.lines().filter_map(|line| line.trim().split_once(' '));
    names.find(|(of, name)| *of == number && !name.trim().is_empty()).map(|(_, name)| name.trim().to_owned())
}

fn events_or_wide(path: &Path, pick: &mut Pick) -> Result<RowColumns, TableMessage> {
    let columns = pick.value_columns();
    let named_value = pick.by_heading(ColumnRole::Value);
    let sensor = pick.sensor(columns.len() > 1)?;
    let Some(sensor) = sensor else {
        return match (named_value, columns.len()) {
            (Some(value), 0 | 1) if columns.iter().all(|column| *column == value) => one_sensor(path, pick, value),
            (_, 0) => Err(pick.lacks("sensor and value")),
            // Without headings two columns of numbers are a sensor and its value.
            (_, 2) if !pick.first.has_heading && pick.are_numbered_sensors(columns[0]) => {
                pick.take(columns[0], ColumnRole::Sensor, "its numbers come again, and the value follows");
                pick.take(columns[1], ColumnRole::Value, "it follows the sensor");
                Ok(events(vec![columns[0]], Some(columns[1])))
            }
            // A table of a time and a number alone.
            (None, 1) if !pick.first.has_heading && pick.free().len() == 1 => {
                pick.take(columns[0], ColumnRole::Value, "it follows the time, and no column names a sensor");
                Ok(RowColumns::Events { sensor: alone(path), value: Some(columns[0]), is_mapped: false })
            }
            _ => wide(pick, Vec::new()),
        };
    };
    let is_value = |column: &&usize| **column != sensor && !pick.describes(sensor, **column);
    let several = columns.iter().filter(is_value).count() > 1;
    if named_value.is_none() && several && pick.first.has_heading {
        return wide(pick, vec![sensor]);
    }
    let value = pick.value(sensor);
    match value {
        Some(value) => pick.no_lengths(sensor, value)?,
        None => pick.firings(sensor)?,
    }
    let label = value.and_then(|value| pick.label_behind(value));
    let sensors = pick.apart(sensor, value);
    if label.is_none() {
        pick.leftover_room();
    }
    pick.no_keys(sensor, value)?;
    Ok(events(sensors, value))
}

fn events(sensors: Vec<usize>, value: Option<usize>) -> RowColumns {
    RowColumns::Events { sensor: SensorColumns::Columns(sensors), value, is_mapped: false }
}

/// A table of a time and a value: a sensor alone.
fn one_sensor(path: &Path, pick: &mut Pick, value: usize) -> Result<RowColumns, TableMessage> {
    let cells = &pick.first.cells[value];
    match cells.are_mostly(cells.values()) {
        true => {
            pick.take(value, ColumnRole::Value, ColumnUse::HEADING);
            Ok(RowColumns::Events { sensor: alone(path), value: Some(value), is_mapped: false })
        }
        // `time,event`: the event names the sensor.
        false if cells.come_again() && cells.filled >= LEAST_CELLS => {
            pick.take(value, ColumnRole::Sensor, "its heading is that of events, and their names come again");
            pick.firings(value)?;
            Ok(events(vec![value], None))
        }
        false => Err(pick.lacks("sensor")),
    }
}

/// So many cells must come again before a column without a known heading names sensors of rows without values.
const LEAST_CELLS: usize = 4;

fn wide(pick: &mut Pick, prefix: Vec<usize>) -> Result<RowColumns, TableMessage> {
    for column in pick.free() {
        if let Some(because) = pick.no_value(column).filter(|_| !prefix.contains(&column)) {
            pick.take(column, ColumnRole::Unused, because);
        }
    }
    let free = pick.free();
    let has_numbers = free.iter().any(|&column| is_number(&pick.first.cells[column]));
    let mut sensors = Vec::new();
    for column in free.into_iter().filter(|column| !prefix.contains(column)) {
        let cells = &pick.first.cells[column];
        let (numbers, states) = (is_number(cells), cells.is_switch() || has_few_words(cells));
        // Of an appliance that nothing has switched on yet there are zeros alone.
        let has_states = states && !numbers || !has_numbers && cells.are(cells.switches);
        let because = match () {
            () if has_states => "its heading names the sensor: its cells are states, and each change is a row",
            () if numbers || cells.are_mostly(cells.values()) => "its heading names the sensor: each cell is a reading",
            () => continue,
        };
        let because =
            if pick.first.has_heading { because.to_owned() } else { because.replacen("its heading", "its place", 1) };
        pick.take(column, ColumnRole::OneSensor, &because);
        let unit = pick.first.column(column).find_map(|cell| measured(cell.trim()));
        let unit = unit.map(|(_, unit)| unit.to_owned()).filter(|unit| !unit.is_empty());
        sensors.push(WideSensor { column, name: pick.first.names[column].clone(), has_states, unit });
    }
    if sensors.is_empty() {
        return Err(pick.lacks("sensor and value"));
    }
    for &column in &prefix {
        let because = pick.reason_for_sensor(column);
        pick.take(column, ColumnRole::Sensor, &because);
    }
    Ok(RowColumns::Wide { prefix, sensors })
}

fn is_number(cells: &CellCounts) -> bool {
    cells.are_mostly(cells.numbers) && !cells.is_switch()
}

/// So few words are states.
const FEW_WORDS: usize = 12;

fn has_few_words(cells: &CellCounts) -> bool {
    cells.filled > 0
        && cells.numbers == 0
        && cells.texts.len() <= FEW_WORDS
        && cells.come_again()
        && cells.sentences == 0
}
