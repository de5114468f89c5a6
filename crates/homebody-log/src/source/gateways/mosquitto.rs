//! Messages of MQTT as `mosquitto_sub -F '%I %t %p'` prints them: an instant, a topic and a payload in each line, parted by blanks.
//!
//! Each key of a payload in JSON is a reading of its own. A text whose payloads are all words is read as one of CASAS.

use crate::error::LogError;
use crate::limits::beginning;
use crate::log::ColumnRole;
use crate::source::gathered::Gathered;
use crate::source::instant::{InstantReader, LogInstant};
use crate::source::json::payload::{GatewayMessage, Payloads};
use crate::source::lines::LineReader;
use crate::source::reading::LogReading;
use crate::source::start::FileStart;
use crate::source::{LogForm, Shows};
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "mosquitto",
    what: "MQTT messages as mosquitto_sub -F '%I %t %p' prints them: a timestamp, a topic and a JSON payload in each line",
    shows,
    read,
};

/// The form is known by this many lines.
const LOOKED_AT: usize = 10;

fn shows(start: &FileStart) -> Shows {
    let mut instants = InstantReader::default();
    let lines: Vec<_> = start.lines().take(LOOKED_AT).collect();
    let parted: Vec<_> = lines.iter().map(|line| parts(line, &mut instants)).collect();
    let has_object = parted.iter().flatten().any(|(_, _, payload)| payload.starts_with('{'));
    // One that is cut or odd does not hide what the others are.
    let most = 2 * parted.iter().filter(|parts| parts.is_some()).count() > parted.len();
    Shows::rows_if(has_object && most)
}

/// The instant, the topic and the payload of a line.
fn parts<'l>(line: &'l str, instants: &mut InstantReader) -> Option<(LogInstant, &'l str, &'l str)> {
    let line = line.trim();
    let (first, rest) = line.split_once(char::is_whitespace)?;
    let (instant, rest) = match instants.read(first) {
        Some(instant) => (instant, rest),
        None => {
            let (second, behind) = rest.trim_start().split_once(char::is_whitespace)?;
            (instants.read(&format!("{first} {second}"))?, behind)
        }
    };
    let (topic, payload) = rest.trim_start().split_once(char::is_whitespace)?;
    let payload = payload.trim_start();
    (topic.contains('/') || payload.starts_with('{')).then_some((instant, topic, payload))
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut lines = LineReader::open(path)?;
    let (mut payloads, mut instants) = (Payloads::default(), InstantReader::default());
    let mut out = Gathered::as_they_come(path, reading);
    out.column("what each line begins with", ColumnRole::Time, "it is an instant");
    out.column("the topic", ColumnRole::Sensor, "it is behind the instant, and has a slash");
    out.column("the keys of payloads", ColumnRole::OneSensor, "each is a reading of the device that the topic names");
    while let Some((line, text)) = lines.next_text()? {
        if text.trim().is_empty() {
            continue;
        }
        match parts(&text, &mut instants) {
            Some((instant, topic, payload)) => {
                payloads.text(&GatewayMessage { line, instant, topic, is_zigbee: false }, payload, &mut out)?;
            }
            None => out.reading.skip(line, format!("{} is no instant, topic and payload", beginning(text.trim()))),
        }
    }
    out.end()
}
