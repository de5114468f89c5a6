//! Event logs in XES: activities, in the form of processes. They have no sensors.
//!
//! An event has a name, a time and, if both ends are there, whether it is a start or a completion. An event without its other end becomes
//! an activity of length zero.
//!
//! The XML is read tag by tag, and only the names of open events in a trace are kept. Left out: extensions, classifiers, and attributes
//! inside of attributes.

use super::instant::LogInstant;
use super::reading::{LogReading, open};
use super::start::FileStart;
use super::{LogForm, Shows};
use crate::error::{LengthMessage, LogError};
use crate::limits::{LONGEST_ROW_BYTES, LONGEST_VALUE};
use crate::log::ColumnRole;
use crate::source::instant::date_parts::no_instant;
use homebody_core::scenario::logger::LoggerFile;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "xes",
    what: "an event log in XES: activities with their starts and ends, without sensors",
    shows,
    read,
};

fn shows(start: &FileStart) -> Shows {
    let mut lines = start.lines();
    let is_xml = start.lines().next().is_some_and(|line| line.starts_with('<'));
    match is_xml && lines.any(|line| line.contains("<log")) {
        true => Shows::Activities,
        false => Shows::Nothing,
    }
}

#[derive(Default)]
struct XesEvent {
    line: u64,
    name: Option<String>,
    time: Option<String>,
    transition: String,
}

/// Largest number of activities of a trace that have begun and not ended (our choice).
const MOST_OPEN: usize = 1000;

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    for (key, role) in [
        ("time:timestamp", ColumnRole::Time),
        ("concept:name", ColumnRole::Label),
        ("lifecycle:transition", ColumnRole::End),
    ] {
        reading.column(key, role, "its key");
    }
    let mut file = BufReader::new(open(path)?);
    let (mut text, mut line) = (Vec::new(), 1);
    let mut event: Option<XesEvent> = None;
    let mut begun: Vec<(String, LogInstant, u64)> = Vec::new();
    loop {
        text.clear();
        while !is_whole(&text) {
            let left = (LONGEST_ROW_BYTES + 1 - text.len()) as u64;
            let read = file.by_ref().take(left).read_until(b'>', &mut text);
            if read.map_err(|error| LogError::file(path, error))? == 0 {
                break;
            }
            if text.len() > LONGEST_ROW_BYTES {
                return Err(LogError::too_long(path, line, LengthMessage::Tag));
            }
        }
        if text.is_empty() {
            break;
        }
        let all = String::from_utf8_lossy(last_tag(&text));
        let tag = if is_comment(&text) { "" } else { all.trim_end_matches('>').trim() };
        line += text.iter().filter(|&&byte| byte == b'\n').count() as u64;
        match tag.split(|c: char| c.is_whitespace() || c == '/').next().unwrap_or_default() {
            "event" => {
                // One whose end is not told is over by now.
                let before = event.replace(XesEvent { line, ..XesEvent::default() });
                before.into_iter().for_each(|event| take(event, &mut begun, reading));
            }
            "" if tag == "/event" => match event.take() {
                Some(event) => take(event, &mut begun, reading),
                None => reading.skip(line, "an event ends that has not begun".into()),
            },
            "" if tag == "/trace" => {
                event.take().into_iter().for_each(|event| take(event, &mut begun, reading));
                close(&mut begun, reading);
            }
            "string" | "date" => {
                if let (Some(event), Some(key)) = (&mut event, attribute(tag, "key")) {
                    let value = attribute(tag, "value");
                    match key.as_str() {
                        "concept:name" => event.name = value,
                        "time:timestamp" => event.time = value,
                        "lifecycle:transition" => event.transition = value.unwrap_or_default(),
                        _ => {}
                    }
                }
            }
            _ => {}
        }
    }
    event.take().into_iter().for_each(|event| take(event, &mut begun, reading));
    close(&mut begun, reading);
    Ok(())
}

/// Whether a text ends with a tag: a `>` in quotes or in a comment does not end one. No tag has a `<` in it, so that an open quote costs
/// its own tag alone.
fn is_whole(text: &[u8]) -> bool {
    match is_comment(text) {
        true => text.ends_with(b"-->"),
        false => text.ends_with(b">") && last_tag(text).iter().filter(|&&byte| byte == b'"').count() % 2 == 0,
    }
}

fn is_comment(text: &[u8]) -> bool {
    text.trim_ascii_start().starts_with(b"<!--")
}

/// The text after the last `<`.
fn last_tag(text: &[u8]) -> &[u8] {
    text.iter().rposition(|&byte| byte == b'<').map_or(text, |at| &text[at + 1..])
}

fn take(event: XesEvent, begun: &mut Vec<(String, LogInstant, u64)>, reading: &mut LogReading<'_>) {
    let XesEvent { line, name, time, transition } = event;
    let (Some(name), Some(time)) = (name, time) else {
        reading.skip(line, "the event has no name or no time".into());
        return;
    };
    let Some(at) = reading.instants.read(&time) else {
        reading.skip(line, no_instant(&time));
        return;
    };
    let open = begun.iter().position(|(open, ..)| *open == name);
    match (transition.to_ascii_lowercase().as_str(), open) {
        ("start", open) => {
            // One that is begun again has no end of its own.
            if let Some((name, begin, line)) = open.map(|open| begun.swap_remove(open)) {
                reading.span(line, begin, begin, &name);
            }
            match begun.len() < MOST_OPEN {
                true => begun.push((name, at, line)),
                false => reading.span(line, at, at, &name),
            }
        }
        (_, Some(open)) => {
            let (name, begin, _) = begun.swap_remove(open);
            reading.span(line, begin, at, &name);
        }
        (_, None) => reading.span(line, at, at, &name),
    }
}

/// An open event has no length.
fn close(begun: &mut Vec<(String, LogInstant, u64)>, reading: &mut LogReading<'_>) {
    for (name, at, line) in begun.drain(..) {
        reading.span(line, at, at, &name);
    }
}

/// An attribute of a tag; None where it is not there, or too long for a name.
fn attribute(tag: &str, wanted: &str) -> Option<String> {
    let mut rest = tag;
    loop {
        let equals = rest.find('=')?;
        let name = rest[..equals].trim_end().rsplit(char::is_whitespace).next()?;
        let value = rest[equals + 1..].trim_start();
        let quote = value.chars().next().filter(|quote| ['"', '\''].contains(quote))?;
        let value = &value[1..];
        let end = value.find(quote)?;
        if name == wanted {
            return (end <= LONGEST_VALUE).then(|| unescaped(&value[..end]));
        }
        rest = &value[end + 1..];
    }
}

fn unescaped(text: &str) -> String {
    let known = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    known.iter().fold(text.to_owned(), |text, (escape, letter)| text.replace(escape, letter))
}
