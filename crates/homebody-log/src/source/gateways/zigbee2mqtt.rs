//! The log of Zigbee2MQTT: which messages it has published. Versions 1 and 2 write it in their own ways.
//!
//! A line has a date and a time, and behind them `MQTT publish: topic '...', payload '...'`. All other lines are about the program itself.

use crate::error::{LogError, place_of};
use crate::log::{Clock, ColumnRole};
use crate::source::gathered::Gathered;
use crate::source::instant::{InstantReader, LogInstant};
use crate::source::json::payload::{GatewayMessage, Payloads};
use crate::source::lines::LineReader;
use crate::source::messages::FormMessage;
use crate::source::reading::LogReading;
use crate::source::start::FileStart;
use crate::source::{LogForm, Shows};
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

pub(crate) const FORM: LogForm =
    LogForm { name: "zigbee2mqtt", what: "the log of Zigbee2MQTT 1 or 2 with its published messages", shows, read };

/// The words before the topic of a published message, and those between topic and payload.
const PUBLISHES: &str = "MQTT publish: topic '";
const PAYLOAD: &str = "', payload '";

fn shows(start: &FileStart) -> Shows {
    let mut instants = InstantReader::default();
    let is_published = start.lines().any(|line| message(&line, &mut instants).is_some());
    let is_named = || {
        let named = start.lines().filter(|line| line.starts_with("Zigbee2MQTT:") || line.contains("z2m:")).count();
        named >= 2
    };
    Shows::rows_if(is_published || is_named())
}

/// The instant, the topic and the payload of a line that publishes a message.
fn message<'l>(line: &'l str, instants: &mut InstantReader) -> Option<(LogInstant, &'l str, &'l str)> {
    let (head, message) = line.split_once(PUBLISHES)?;
    let (topic, payload) = message.split_once(PAYLOAD)?;
    let payload = payload.trim_end();
    let payload = payload.strip_suffix('\'').unwrap_or(payload);
    let instant = head.match_indices('-').find_map(|(dash, _)| {
        let day = head.get(dash.checked_sub(4)?..)?;
        let (at, rest) = instants.leading(day.as_bytes())?;
        Some(LogInstant::told_by(if rest.starts_with(b"Z") { Clock::Utc } else { Clock::Local }, at))
    })?;
    Some((instant, topic, payload))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut lines = LineReader::open(path)?;
    let (mut payloads, mut instants) = (Payloads::default(), InstantReader::default());
    let mut out = Gathered::as_they_come(path, reading);
    out.column("the date and time before a message", ColumnRole::Time, "the form has it there");
    out.column("the topic", ColumnRole::Sensor, "the form has it there");
    out.column("the keys of payloads", ColumnRole::OneSensor, "each is a reading of the device that the topic names");
    let mut published = false;
    while let Some((line, text)) = lines.next_text()? {
        match message(&text, &mut instants) {
            Some((instant, topic, payload)) => {
                published = true;
                payloads.text(&GatewayMessage { line, instant, topic, is_zigbee: true }, payload, &mut out)?;
            }
            None if text.contains(PUBLISHES) => {
                out.reading.skip(line, "no date and time, or no payload is in it".into())
            }
            None if text.trim().is_empty() => {}
            None => out.count("lines about the program itself"),
        }
    }
    out.end()?;
    match published {
        true => Ok(()),
        false => Err(LogError::no_log(place_of(path), FormMessage::NoMessages)),
    }
}
