//! The database of Domoticz: the states of switches and contacts and the readings of meters, under the names of their devices.
//!
//! The table `DeviceStatus` names a device and says what kind of switch it is; `LightingLog` has a row for each thing that a
//! switch said, the other tables one for each reading. Their times are local. Left out: what Domoticz sums up for each day.

use super::messages::FormMessage;
use super::reading::{LogReading, open};
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::{LogError, place_of};
use crate::files::database::{connect, has_column, list, tables, text};
use crate::log::SensorInfo;
use homebody_core::scenario::logger::LoggerFile;
use rusqlite::Connection;
use std::collections::BTreeMap;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "domoticz",
    what: "the database of Domoticz, domoticz.db: the states of its switches, contacts and meters",
    shows,
    read,
};

fn shows(start: &FileStart) -> Shows {
    let has_tables = || -> rusqlite::Result<bool> {
        let tables = tables(&connect(&start.path)?)?;
        Ok(NEEDED.iter().all(|needed| tables.iter().any(|name| name == needed)))
    };
    Shows::rows_if(start.is_sqlite() && has_tables().is_ok_and(|has| has))
}

/// The tables that make it one.
const NEEDED: [&str; 2] = ["DeviceStatus", "LightingLog"];

/// Tables and columns of readings, the words behind the device's name, and the unit.
const READINGS: [(&str, &str, &str, &str); 6] = [
    ("Temperature", "Temperature", "", "°C"),
    ("Temperature", "Humidity", " humidity", "%"),
    ("Percentage", "Percentage", "", "%"),
    ("UV", "Level", "", ""),
    ("Fan", "Speed", "", ""),
    ("Meter", "Value", "", ""),
];

struct DomoticzDevice {
    name: String,
    switch: i64,
}

fn devices(connection: &Connection) -> rusqlite::Result<BTreeMap<i64, DomoticzDevice>> {
    let device = |row: &rusqlite::Row| {
        let (id, name) = (row.get(0)?, text(row.get_ref(1)?).trim().to_owned());
        Ok((id, DomoticzDevice { name, switch: row.get::<_, Option<i64>>(2)?.unwrap_or(0) }))
    };
    let all = list(connection, "SELECT ID, Name, SwitchType FROM DeviceStatus ORDER BY ID", [], device)?;
    let mut devices = BTreeMap::from_iter(all);
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    devices.values().for_each(|device| *counts.entry(device.name.clone()).or_default() += 1);
    for (id, device) in &mut devices {
        if device.name.is_empty() || counts[&device.name] > 1 {
            device.name = format!("{} {id}", device.name).trim().to_owned();
        }
    }
    Ok(devices)
}

/// Whether a kind of switch is a contact, as Domoticz numbers them: contacts and contacts of doors.
fn is_contact(switch: i64) -> bool {
    matches!(switch, 2 | 11)
}

/// The kind of sensor for a kind of switch, as `home.json` writes it; empty for kinds that Homebody lacks.
fn kind(switch: i64) -> &'static str {
    match switch {
        8 => "motion",
        switch if is_contact(switch) => "contact",
        _ => "",
    }
}

/// The state for the number of a switch: 0 is off; 1 and the levels of dimmed lights are on.
fn said(number: i64, switch: i64) -> &'static str {
    match (number, is_contact(switch)) {
        (0, true) => "CLOSE",
        (_, true) => "OPEN",
        (0, false) => "OFF",
        (_, false) => "ON",
    }
}

/// The query for all rows in the order of time: the index of the reading or -1 for a switch, the time, the device, the number.
fn rows_of(connection: &Connection) -> rusqlite::Result<String> {
    let tables = tables(connection)?;
    let mut parts = vec!["SELECT -1, Date AS at, DeviceRowID, nValue FROM LightingLog".to_owned()];
    for (number, (table, column, ..)) in READINGS.iter().enumerate() {
        if has_column(connection, table, column)? && tables.iter().any(|name| name == table) {
            parts.push(format!("SELECT {number}, Date, DeviceRowID, {column} FROM {table} WHERE {column} IS NOT NULL"));
        }
    }
    Ok(format!("{} ORDER BY at", parts.join(" UNION ALL ")))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    open(path)?;
    let database = |error| LogError::database(path, error);
    let connection = connect(path).map_err(database)?;
    let there = tables(&connection).map_err(database)?;
    if NEEDED.iter().any(|needed| there.iter().all(|name| name != needed)) {
        return Err(LogError::no_log(place_of(path), FormMessage::NoDevices));
    }
    let devices = devices(&connection).map_err(database)?;
    let has_humidity = humid(&connection).map_err(database)?;
    let mut statement = connection.prepare(&rows_of(&connection).map_err(database)?).map_err(database)?;
    let mut rows = statement.query([]).map_err(database)?;
    let mut known: BTreeMap<(i64, i64), String> = BTreeMap::new();
    let mut line = 0;
    while let Some(row) = rows.next().map_err(database)? {
        line += 1;
        let (of, id): (i64, i64) = (row.get(0).map_err(database)?, row.get(2).map_err(database)?);
        let device = devices.get(&id);
        let switch = device.map_or(0, |device| device.switch);
        let table = usize::try_from(of).ok().and_then(|of| READINGS.get(of));
        // Those that measure warmth alone have zeros for humidity.
        if table.is_some_and(|(_, column, ..)| *column == "Humidity") && !has_humidity.contains(&id) {
            continue;
        }
        let cell = text(row.get_ref(3).map_err(database)?);
        let value = match table {
            Some(_) => cell,
            None => said(cell.parse().unwrap_or(0), switch).into(),
        };
        let sensor = known.entry((of, id)).or_insert_with(|| {
            let name = device.map_or_else(|| format!("device {id}"), |device| device.name.clone());
            let (behind, unit) = table.map_or(("", ""), |(.., behind, unit)| (*behind, *unit));
            let id = format!("{name}{behind}");
            let unit = Some(unit.to_owned()).filter(|unit| !unit.is_empty());
            let kind = if table.is_none() { kind(switch) } else { "" };
            reading.know(SensorInfo { unit, ..SensorInfo::of_kind(&id, kind, &[]) });
            id
        });
        let time = text(row.get_ref(1).map_err(database)?);
        reading.row(line, &time, sensor, &value)?;
    }
    Ok(())
}

fn humid(connection: &Connection) -> rusqlite::Result<Vec<i64>> {
    if !has_column(connection, "Temperature", "Humidity")? {
        return Ok(Vec::new());
    }
    list(connection, "SELECT DISTINCT DeviceRowID FROM Temperature WHERE Humidity > 0", [], |row| row.get(0))
}
