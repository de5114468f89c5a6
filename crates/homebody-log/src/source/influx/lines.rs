//! InfluxDB's line protocol: `measurement,tag=value field=value,field="text" 1770012000000000000`.
//!
//! Instants are in seconds, milliseconds, microseconds or nanoseconds since 1970, which their size tells. An export has the rows of each
//! series together, so that they are put into the order of time.

use super::{InfluxPoint, Series};
use crate::error::LogError;
use crate::log::ColumnRole;
use crate::source::gathered::Gathered;
use crate::source::instant::{LogInstant, since_1970_whole};
use crate::source::lines::LineReader;
use crate::source::reading::LogReading;
use crate::source::start::FileStart;
use crate::source::{LogForm, Shows};
use homebody_core::scenario::logger::LoggerFile;
use std::path::Path;

pub(crate) const FORM: LogForm = LogForm {
    name: "influx-lines",
    what: "InfluxDB's line protocol: a measurement with tags, fields and a timestamp in each line",
    shows,
    read,
};

/// The form is known by this many lines.
const LOOKED_AT: usize = 10;

fn shows(start: &FileStart) -> Shows {
    let lines: Vec<_> = start.lines().filter(|line| !is_aside(line)).take(LOOKED_AT).collect();
    let points = lines.iter().filter(|line| point(line).is_ok()).count();
    Shows::rows_if(2 * points > lines.len())
}

/// Whether a line is a comment, or what an export has before its points.
fn is_aside(line: &str) -> bool {
    let line = line.trim();
    line.is_empty() || line.starts_with('#') || line.starts_with("CREATE DATABASE")
}

fn point(line: &str) -> Result<(InfluxPoint, LogInstant), &'static str> {
    let mut rest = line.trim();
    let (mut series, mut fields) = (Vec::new(), Vec::new());
    let mut ended = b',';
    while ended == b',' {
        let (part, end) = until(rest, b", ").ok_or("it has no fields")?;
        series.push(part);
        ended = rest.as_bytes()[end];
        rest = &rest[end + 1..];
    }
    let pair = |part: &str| {
        let (_, equals) = until(part, b"=")?;
        Some((unescaped(&part[..equals]), part[equals + 1..].to_owned())).filter(|(key, _)| !key.is_empty())
    };
    ended = b',';
    while ended == b',' {
        let (part, end) = until(rest, b", ").ok_or("it has no instant")?;
        let (name, value) = pair(part).ok_or("a field has no name or no value")?;
        fields.push((name, said(&value).ok_or("a field is no number, no text and no boolean")?));
        ended = rest.as_bytes()[end];
        rest = &rest[end + 1..];
    }
    let at = rest.trim().parse().ok().and_then(since_1970_whole).ok_or("its instant is no number since 1970")?;
    let [measurement, tags @ ..] = &series[..] else { return Err("it has no measurement") };
    let tags = tags.iter().map(|tag| pair(tag).map(|(key, value)| (key, unescaped(&value))));
    let tags = tags.collect::<Option<_>>().ok_or("a tag has no name or no value")?;
    match unescaped(measurement) {
        measurement if measurement.is_empty() => Err("it has no measurement"),
        measurement => Ok((InfluxPoint { measurement, tags, fields }, at)),
    }
}

/// The text before the first of these letters that is neither escaped nor in quotes, and its length.
fn until<'t>(text: &'t str, wanted: &[u8]) -> Option<(&'t str, usize)> {
    let (mut is_quoted, mut is_escaped, mut before) = (false, false, b',');
    for (at, &byte) in text.as_bytes().iter().enumerate() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' => is_escaped = true,
            b'"' if is_quoted => is_quoted = false,
            // A quote in a name means nothing; one behind the equals sign begins a text.
            b'"' if before == b'=' => is_quoted = true,
            byte if !is_quoted && wanted.contains(&byte) => return Some((&text[..at], at)),
            _ => {}
        }
        before = byte;
    }
    None
}

fn unescaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let is_escape = letter == '\\' && letters.peek().is_some_and(|next| ",= \"\\".contains(*next));
        plain.push(if is_escape { letters.next().unwrap_or(letter) } else { letter });
    }
    plain
}

/// A field's value as text: `1i` is 1, `t` is true, and a text has no quotes.
fn said(value: &str) -> Option<String> {
    if let Some(text) = value.strip_prefix('"') {
        return text.strip_suffix('"').map(unescaped);
    }
    match value {
        "t" | "T" | "true" | "True" | "TRUE" => return Some("true".into()),
        "f" | "F" | "false" | "False" | "FALSE" => return Some("false".into()),
        _ => {}
    }
    let number = value.strip_suffix(['i', 'u']).unwrap_or(value);
    number.parse::<f64>().ok().filter(|number| number.is_finite()).map(|_| number.to_owned())
}

fn read(path: &Path, _: &LoggerFile, reading: &mut LogReading<'_>) -> Result<(), LogError> {
    let mut lines = LineReader::open(path)?;
    let mut out = Gathered::in_order(path, reading);
    let mut series = Series::default();
    out.column("what each line ends with", ColumnRole::Time, "it is a number since 1970");
    while let Some((line, text)) = lines.next_text()? {
        if is_aside(&text) {
            continue;
        }
        match point(&text) {
            Ok((point, at)) => series.take(line, at, &point, &mut out)?,
            Err(why) => out.reading.skip(line, why.into()),
        }
    }
    out.end()
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::UtcTime;

    #[test]
    fn splits_a_line_outside_escapes_and_quotes() {
        let line =
            r#"my\ measure,room=living\,\ room,x\=y=1 value=21.5,note="a, \"b\" c=d",n=-3i,on=T 1770012000000000"#;
        let (point, at) = point(line).unwrap();
        assert_eq!(at, LogInstant::Utc(UtcTime::from_micros(1_770_012_000_000_000)));
        assert_eq!(point.measurement, "my measure");
        let told = |pairs: &[(String, String)]| {
            pairs.iter().map(|(key, value)| format!("{key}: {value}")).collect::<Vec<_>>().join("; ")
        };
        assert_eq!(told(&point.tags), "room: living, room; x=y: 1");
        assert_eq!(told(&point.fields), "value: 21.5; note: a, \"b\" c=d; n: -3; on: true");
    }

    #[test]
    fn lines_without_a_part_are_refused() {
        for line in [
            "",
            "a",
            "a value=1",
            "a,b value=1 1770012000",
            "a value 1770012000",
            "a value=on 1770012000",
            "a value=\"on 1770012000",
            "a value=1 12",
            "a value=1 never",
            ",a=b value=1 1770012000",
            "2026-02-02 06:00:00 M001 ON",
            "é=é é=é é",
        ] {
            assert!(point(line).is_err(), "{line}");
        }
    }
}
