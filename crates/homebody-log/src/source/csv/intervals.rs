//! Tables with a start and an end in each row: pyadlml's activities `start_time,end_time,activity` and its older devices, the
//! activities of Orange4Home, tables of a start and a duration, and ours next to a log in CSV.

use super::cells::is_off;
use super::layout::{RowColumns, TableLayout};
use super::pick::EndColumn;
use super::row_parts::know_named;
use crate::error::LogError;
use crate::files::plain::text;
use crate::limits::beginning;
use crate::source::in_order::InOrder;
use crate::source::instant::LogInstant;
use crate::source::instant::date_parts::no_instant;
use crate::source::reading::LogReading;
use crate::source::records::Record;
use crate::text::unescaped;
use homebody_core::problem::counted;
use homebody_core::time::{DAY, SECOND, Span, WallTime};

pub(crate) struct Intervals<'l> {
    layout: &'l TableLayout,
    order: InOrder,
    time: Vec<u8>,
    sensor: Vec<u8>,
    /// The number of intervals in which something was off.
    off: usize,
}

impl<'l> Intervals<'l> {
    pub fn for_layout(layout: &'l TableLayout) -> Intervals<'l> {
        Intervals { layout, order: InOrder::new(), time: Vec::new(), sensor: Vec::new(), off: 0 }
    }

    pub fn take(&mut self, line: u64, record: &Record, reading: &mut LogReading<'_>) -> Result<(), LogError> {
        let RowColumns::Intervals { end, sensor, value, is_of_activities } = &self.layout.rows else { return Ok(()) };
        let begin = text(self.layout.time.text(record, &mut self.time));
        let Some(from) = instant(self.layout, &begin, reading) else {
            reading.skip(line, no_instant(&begin));
            return Ok(());
        };
        let (EndColumn::At(column) | EndColumn::After(column, _)) = *end;
        let told = text(record.get(column).unwrap_or_default().trim_ascii());
        let to = match *end {
            EndColumn::At(_) => instant(self.layout, &told, reading),
            EndColumn::After(_, unit) => length(&told, unit).map(|length| from.after(length)),
        };
        let Some(to) = to else {
            let what = if matches!(end, EndColumn::At(_)) { "date and time" } else { "duration" };
            reading.skip(line, format!("{} is no {what}", beginning(&told)));
            return Ok(());
        };
        let name = text(sensor.name(record, &mut self.sensor));
        let name = unescaped(name.trim());
        // Between two intervals that are on, one that is off says nothing new.
        let is_on = value.is_none_or(|value| !is_off(text(record.get(value).unwrap_or_default()).trim()));
        match () {
            () if *is_of_activities => reading.span(line, from, to, name),
            () if is_on => {
                know_named(self.layout, record, name, reading);
                self.order.interval(line, (from, to), name, reading)?;
            }
            () => self.off += 1,
        }
        Ok(())
    }

    pub fn end(self, reading: &mut LogReading<'_>) -> Result<(), LogError> {
        if self.off > 0 {
            let count = counted(self.off, "interval says", "intervals say");
            reading
                .log
                .remarks
                .push(format!("{count} that a sensor was off: between those that are on this is nothing new"));
        }
        self.order.end(reading)
    }
}

fn instant(layout: &TableLayout, text: &str, reading: &mut LogReading<'_>) -> Option<LogInstant> {
    match layout.time.is_since_start {
        true => text.trim().parse::<f64>().ok().filter(|seconds| (0.0..1e8).contains(seconds)).map(since_start),
        false => reading.instants.read(text),
    }
}

fn since_start(seconds: f64) -> LogInstant {
    LogInstant::Local(WallTime::EPOCH + SECOND.scaled(seconds))
}

/// A duration: a number of units, or `00:00:40` with days before it or not, as in `0 days 00:00:40`.
fn length(text: &str, unit: Span) -> Option<Span> {
    if let Ok(number) = text.replace(',', ".").parse::<f64>() {
        return (0.0..1e12).contains(&number).then(|| unit.scaled(number));
    }
    let (days, text) = match text.split_once(" day") {
        Some((days, rest)) => {
            (days.trim().parse::<i64>().ok()?, rest.trim_start_matches('s').trim_start_matches(',').trim())
        }
        None => (0, text),
    };
    let mut parts =
        text.split(':').map(|part| part.trim().parse::<f64>().ok().filter(|part| (0.0..1e6).contains(part)));
    let (hours, minutes, seconds) = (parts.next()??, parts.next()??, parts.next().unwrap_or(Some(0.0))?);
    let whole = SECOND.scaled((hours * 60.0 + minutes) * 60.0 + seconds);
    (parts.next().is_none() && (0..100_000).contains(&days)).then(|| days * DAY + whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_numbers_or_times() {
        for (text, seconds) in [
            ("40", Some(40.0)),
            ("2.5", Some(2.5)),
            ("2,5", Some(2.5)),
            ("00:00:40", Some(40.0)),
            ("1:30", Some(5400.0)),
            ("0 days 00:00:40.5", Some(40.5)),
            ("1 day, 0:00:01", Some(86_401.0)),
            ("-3", None),
            ("ON", None),
            ("1:2:3:4", None),
        ] {
            assert_eq!(length(text, SECOND).map(Span::seconds), seconds, "{text}");
        }
        assert_eq!(length("250", Span::from_millis(1)), Some(SECOND / 4));
    }
}
