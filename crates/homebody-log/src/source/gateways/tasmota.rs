//! The console's log of a device with Tasmota: which messages of MQTT it has sent.
//!
//! Its lines tell the time of day alone. The day comes from the `Time` that its telemetry has, or from the file's name. All lines without a
//! message are about the device itself.

use crate::error::{LogError, place_of};
use crate::log::ColumnRole;
use crate::source::gathered::Gathered;
use crate::source::instant::dateless::{DayCounter, time_of_day};
use crate::source::instant::{InstantReader, LogInstant};
use crate::source::json::payload::{GatewayMessage, Payloads};
use crate::source::json::said::Object;
use crate::source::lines::LineReader;
use crate::source::messages::FormMessage;
use crate::source::reading::LogReading;
use crate::source::start::FileStart;
use crate::source::{LogForm, Shows};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{DAY, Span, WallTime};
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "tasmota",
    what: "the console log of a Tasmota device; the day comes from its telemetry, or from the file's name",
    shows,
    read,
};

/// A text is one with this many lines that look like it.
const ENOUGH: usize = 2;

/// A device that does not know the time counts from 1970: an instant within thirty years of that is passed over.
const FIRST: WallTime = WallTime::EPOCH.saturating_add(DAY.saturating_mul(30 * 365));

fn shows(start: &FileStart) -> Shows {
    let mut instants = InstantReader::default();
    let lines: Vec<_> = start.lines().collect();
    let found = lines.iter().filter_map(|line| parts(line, &mut instants));
    let has_message = lines.iter().any(|line| message(line).is_some());
    Shows::rows_if(has_message && found.take(ENOUGH).count() == ENOUGH)
}

/// The time of day, and what follows the three letters of a part of the program.
fn parts<'l>(line: &'l str, instants: &mut InstantReader) -> Option<(Span, &'l str)> {
    let (time, rest) = line.trim().split_once(' ')?;
    let (part, _) = rest.split_once(": ")?;
    let is_part = part.len() == 3 && part.bytes().all(|byte| byte.is_ascii_uppercase() || byte.is_ascii_digit());
    is_part.then_some(())?;
    Some((time_of_day(time, instants)?, rest))
}

/// The topic and the payload of a message in a line.
fn message(line: &str) -> Option<(&str, &str)> {
    let (_, message) = line.split_once("MQT: ")?;
    let (topic, payload) = message.split_once(" = ")?;
    let payload = payload.trim_end();
    topic.contains('/').then(|| (topic, payload.strip_suffix(" (retained)").unwrap_or(payload)))
}

/// The instant that a payload says it was made at, if its device knows it.
fn made(payload: &str, instants: &mut InstantReader) -> Option<WallTime> {
    let object: Object = serde_json::from_str(payload).ok()?;
    match instants.read(object.get("Time")?.as_str()?)? {
        LogInstant::Local(at) if at > FIRST => Some(at),
        _ => None,
    }
}

/// The days of a file, from its first line on: by the first payload that tells one, or by the file's name.
fn days(path: &Path) -> Result<(DayCounter, bool), LogError> {
    let mut lines = LineReader::open(path)?;
    let (mut days, mut instants) = (DayCounter::from(None), InstantReader::default());
    while let Some((_, text)) = lines.next_text()? {
        let Some((time, rest)) = parts(&text, &mut instants) else { continue };
        days.at(time);
        if let Some(told) = message(rest).and_then(|(_, payload)| made(payload, &mut instants)) {
            days.tell(time, told);
            return Ok((DayCounter::from(days.first()), true));
        }
    }
    Ok((DayCounter::from_path(path), false))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let (mut days, is_told) = days(path)?;
    let mut lines = LineReader::open(path)?;
    let (mut payloads, mut instants) = (Payloads::default(), InstantReader::default());
    let mut out = Gathered::as_they_come(path, reading);
    match is_told {
        true => out.column("Time in payloads", ColumnRole::Time, "it has the day, which the lines do not have"),
        false => {
            out.column("the file's name", ColumnRole::Time, "it has the day of the first line; each midnight adds one")
        }
    }
    out.column("the time of day", ColumnRole::Time, "the form has it there");
    out.column("the topic", ColumnRole::Sensor, "the form has it there");
    out.column("the keys of payloads", ColumnRole::OneSensor, "each is a reading of the device that the topic names");
    while let Some((line, text)) = lines.next_text()? {
        if text.trim().is_empty() {
            continue;
        }
        let Some((time, rest)) = parts(&text, &mut instants) else {
            out.reading.skip(line, "it begins with no time of day and no part of Tasmota".into());
            continue;
        };
        let at = days.at(time);
        let Some((topic, payload)) = message(rest) else {
            out.count("lines about the device itself");
            continue;
        };
        let at = match made(payload, &mut instants) {
            Some(told) => {
                days.tell(time, told);
                days.at(time)
            }
            None => at,
        };
        let Some(instant) = at else {
            return Err(LogError::no_log(place_of(path), FormMessage::Dateless { program: "Tasmota" }));
        };
        payloads.text(&GatewayMessage { line, instant, topic, is_zigbee: false }, payload, &mut out)?;
    }
    out.end()
}
