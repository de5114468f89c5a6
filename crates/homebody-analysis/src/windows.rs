//! A log cut into windows of one length, for recognisers to be trained on: what each sensor said in a window, and what somebody did.
//!
//! A row is of one resident and one window. Windows begin where the clock on the wall shows a whole multiple of their length: those of a
//! day at midnight, those of an hour at full hours. Where clocks are set, a window has as much less or more as they are set by, as a day has
//! 23 or 25 hours; of an hour that comes twice, and of what is shorter, both are windows. The features of a row are those of the log alone, and so the same for all residents: how often each sensor said something that is no end, and which spoke last.
//! Its label is the activity that the truth tells for most of the window.
//!
//! Left out: who of several people it was that a sensor saw. That is what `label` joins, row by row.

use crate::dates::{ahead, instant};
use crate::signs::{Meanings, Says};
use homebody_core::time::{Micros, seconds};
use homebody_log::source::Activity;
use homebody_log::{Event, Life, Log};
use jiff::tz::TimeZone;
use std::ops::Range;

/// Largest number of windows (our choice): those of a minute for twenty years.
pub const MOST: i64 = 10_000_000;

/// Windows of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Windows {
    /// The names of the sensors, in the order of `counts`.
    pub sensors: Vec<String>,
    /// In order of their beginnings, and of residents.
    pub rows: Vec<Window>,
}

/// What was said in a window, and what one resident did.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// When it begins, on the log's clock.
    pub begin: Micros,
    /// Whose activity the label is; none where nobody is known.
    pub resident: Option<usize>,
    /// The activity for most of the window.
    pub label: Option<String>,
    /// Where somebody was for most of the window.
    pub room: Option<String>,
    /// By sensor: how often it said something that is no end.
    pub counts: Vec<u32>,
    /// Which sensor spoke last, in this window or before.
    pub last: Option<u32>,
}

homebody_core::messages! {
    /// Problems with the windows of a log.
    #[derive(Clone, PartialEq, Eq)]
    pub enum WindowMessage in "window" {
        /// A window covers a part of the log. Its length is a number of seconds, and at least a microsecond.
        NoLength {
            /// The length, in microseconds.
            length_us: Micros,
        } error "no-length" ("a window cannot be {seconds} s long", seconds = seconds(*length_us))
            hint ("choose a length above 0");
        /// Each window is a row of the answer. The limit of their number protects the memory.
        TooMany {
            /// The number of windows.
            windows: i64,
        } error "too-many" ("the log has {windows} windows of this length, and the limit is {MOST}")
            hint ("choose a longer window");
    }
}

/// Cuts a log into windows of a length, from its first row to its last; `lives` are on its clock. `zone` is that of the wall that they are
/// cut by; where the log's own clock is that on the wall, it is UTC.
///
/// # Errors
///
/// If there would be more than [`MOST`], or the length is not above 0.
pub fn windows(log: &Log, lives: &[Life], span: Micros, zone: &TimeZone) -> Result<Windows, WindowMessage> {
    if span <= 0 {
        return Err(WindowMessage::NoLength { length_us: span });
    }
    let events = log.in_order();
    let (Some(first), Some(last)) = (events.first(), events.last()) else {
        return Ok(Windows { sensors: log.sensors.clone(), rows: Vec::new() });
    };
    let (first, last) = (first.at, last.at);
    let many = last.div_euclid(span) - first.div_euclid(span) + 1;
    if many > MOST {
        return Err(WindowMessage::TooMany { windows: many });
    }
    let mut wall = Wall::new(zone, first);
    let mut within = wall.first(first, span);
    let meanings = Meanings::of(log);
    let counts_for = |event: &Event| !matches!(meanings.says(event), Says::Ends | Says::Closes | Says::Unknown);
    let nobody = [Life::default()];
    let people = if lives.is_empty() { &nobody[..] } else { lives };
    let mut rows = Vec::new();
    let (mut next, mut spoke) = (0, None);
    loop {
        let mut counts = vec![0; log.sensors.len()];
        while let Some(event) = events.get(next).filter(|event| event.at < within.end) {
            counts[event.sensor as usize] += u32::from(counts_for(event));
            spoke = Some(event.sensor);
            next += 1;
        }
        for (index, life) in people.iter().enumerate() {
            rows.push(Window {
                begin: within.start,
                resident: (!lives.is_empty()).then_some(index),
                label: longest(&life.activities, &within),
                room: longest(&life.rooms, &within),
                counts: counts.clone(),
                last: spoke,
            });
        }
        if within.end > last {
            return Ok(Windows { sensors: log.sensors.clone(), rows });
        }
        within = within.end..wall.next(within.end, span);
    }
}

/// A stretch over which the clocks of a zone are not set: how far they are ahead of UTC, and when they are set next.
struct Wall<'z> {
    zone: &'z TimeZone,
    ahead: Micros,
    /// `Micros::MAX` if never.
    until: Micros,
}

impl<'z> Wall<'z> {
    /// The stretch with an instant in it.
    fn new(zone: &'z TimeZone, at: Micros) -> Wall<'z> {
        let at = instant(at);
        let until = zone.following(at).next().map_or(Micros::MAX, |set| set.timestamp().as_microsecond());
        Wall { zone, ahead: ahead(at, zone), until }
    }

    /// Which multiple of a length the clock on the wall was at last.
    fn number(&self, at: Micros, span: Micros) -> i64 {
        at.saturating_add(self.ahead).div_euclid(span)
    }

    /// When it shows a multiple of a length.
    fn begin(&self, number: i64, span: Micros) -> Micros {
        number.saturating_mul(span).saturating_sub(self.ahead)
    }

    /// The window with an instant in it.
    fn first(&mut self, at: Micros, span: Micros) -> Range<Micros> {
        let mut begin = self.begin(self.number(at, span), span);
        // As of the beginning of the day, or of what is longer, on which clocks were set before the instant.
        let mut stretch = Wall { zone: self.zone, ..*self };
        let mut seen = at;
        while let Some(set) = self.zone.preceding(instant(seen)).next().map(|set| set.timestamp().as_microsecond())
            && set >= begin
        {
            let before = Wall::new(self.zone, set - 1);
            if before.is_cut(&stretch, span) {
                begin = set;
                break;
            }
            begin = before.begin(before.number(set - 1, span), span);
            (stretch, seen) = (before, set);
        }
        begin..self.next(at, span)
    }

    /// When the window with an instant in it ends.
    fn next(&mut self, at: Micros, span: Micros) -> Micros {
        if at >= self.until {
            *self = Wall::new(self.zone, at);
        }
        let mut from = at;
        loop {
            let end = self.begin(self.number(from, span) + 1, span);
            if end < self.until {
                return end;
            }
            let set = self.until;
            let after = Wall::new(self.zone, set);
            let is_cut = self.is_cut(&after, span);
            *self = after;
            if is_cut {
                return set;
            }
            from = set;
        }
    }

    /// Whether a window ends as clocks are set from this stretch to the next: they leave its last multiple behind, or show a whole number of
    /// windows again.
    fn is_cut(&self, next: &Wall<'_>, span: Micros) -> bool {
        let by = next.ahead - self.ahead;
        let is_whole = by != 0 && by % span == 0;
        self.number(self.until - 1, span) != next.number(self.until, span) || is_whole
    }
}

/// What goes on for most of a span; of two as long, what came first.
fn longest(spans: &[Activity], within: &Range<Micros>) -> Option<String> {
    let first = spans.partition_point(|span| span.end <= within.start);
    let mut best: Option<(Micros, &str)> = None;
    for span in spans[first..].iter().take_while(|span| span.begin < within.end) {
        let lasts = span.end.min(within.end) - span.begin.max(within.start);
        if best.is_none_or(|(most, _)| lasts > most) {
            best = Some((lasts, &span.name));
        }
    }
    best.map(|(_, name)| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;
    use jiff::Timestamp;

    #[test]
    fn a_window_counts_what_begins_and_is_labelled_by_what_lasts_longest() {
        let event = |at_s: i64, sensor, value| Event { at: at_s * SECOND, sensor, value };
        let log = Log {
            sensors: vec!["bed".into(), "hall".into()],
            values: vec!["ON".into(), "OFF".into()],
            events: vec![event(61, 0, 0), event(62, 0, 1), event(70, 1, 0), event(185, 0, 0)],
            ..Log::default()
        };
        let doing = |name: &str, begin_s: i64, end_s: i64| Activity {
            name: name.into(),
            begin: begin_s * SECOND,
            end: end_s * SECOND,
        };
        let activities = vec![doing("sleeping", 0, 85), doing("walking", 85, 118)];
        let life = Life { resident: "ada".into(), activities, rooms: Vec::new() };
        let cut = windows(&log, std::slice::from_ref(&life), 60 * SECOND, &TimeZone::UTC).unwrap();
        let told: Vec<_> =
            cut.rows.iter().map(|row| (row.begin / SECOND, row.counts.clone(), row.label.as_deref())).collect();
        assert_eq!(
            told,
            [(60, vec![1, 1], Some("walking")), (120, vec![0, 0], None), (180, vec![1, 0], None)],
            "33 s of walking are more than 25 s of sleep in the first"
        );
        assert_eq!(cut.rows[1].last, Some(1), "who spoke last is known on");
        let nobody = windows(&log, &[], 60 * SECOND, &TimeZone::UTC).unwrap();
        assert_eq!((nobody.rows.len(), nobody.rows[0].resident), (3, None));
        assert!([0, 1].iter().all(|&span| windows(&log, &[], span, &TimeZone::UTC).is_err()));
    }

    /// On the wall of a zone, the beginnings of windows of so many hours and how long each is but the last.
    fn cut(zone: &str, begin: &str, hours: i64, span: Micros) -> Vec<(String, i64)> {
        let (zone, begin) = (TimeZone::get(zone).unwrap(), begin.parse::<Timestamp>().unwrap().as_microsecond());
        let event = |hour: i64| Event { at: begin + hour * 3600 * SECOND, sensor: 0, value: 0 };
        let events = (0..=hours).map(event).collect();
        let log = Log { sensors: vec!["bed".into()], values: vec!["ON".into()], events, ..Log::default() };
        let rows = windows(&log, &[], span, &zone).unwrap().rows;
        assert_eq!(rows.iter().map(|row| i64::from(row.counts[0])).sum::<i64>(), hours + 1, "each row is in one");
        let told = |at: Micros| instant(at).to_zoned(zone.clone()).strftime("%d %H:%M").to_string();
        rows.windows(2).map(|pair| (told(pair[0].begin), (pair[1].begin - pair[0].begin) / (60 * SECOND))).collect()
    }

    #[test]
    fn windows_begin_by_the_clock_on_the_wall() {
        const HOUR: Micros = 3600 * SECOND;
        let told = |windows: &[(&str, i64)]| -> Vec<(String, i64)> {
            windows.iter().map(|&(begin, lasts)| (begin.to_owned(), lasts)).collect()
        };
        // Clocks are set on at 2:00 on the 8th: a day of 23 hours, and no hour from 2 to 3.
        let days = cut("America/Chicago", "2009-03-07T18:00:00Z", 72, 24 * HOUR);
        assert_eq!(days, told(&[("07 00:00", 1440), ("08 00:00", 1380), ("09 00:00", 1440)]));
        let hours = cut("America/Chicago", "2009-03-08T06:30:00Z", 4, HOUR);
        assert_eq!(hours, told(&[("08 00:00", 60), ("08 01:00", 60), ("08 03:00", 60), ("08 04:00", 60)]));
        // Back at 2:00 on 1 November: 25 hours, and the hour from 1 to 2 twice. A log may begin after that.
        let days = cut("America/Chicago", "2009-11-01T20:00:00Z", 24, 24 * HOUR);
        assert_eq!(days, told(&[("01 00:00", 1500)]));
        let hours = cut("America/Chicago", "2009-11-01T06:30:00Z", 3, HOUR);
        assert_eq!(hours, told(&[("01 01:00", 60), ("01 01:00", 60), ("01 02:00", 60)]));
        assert_eq!(cut("Asia/Kolkata", "2026-01-01T00:00:00Z", 2, HOUR), told(&[("01 05:00", 60), ("01 06:00", 60)]));
        // By half an hour, and at midnight, which does not come on that day.
        let hours = cut("Australia/Lord_Howe", "2025-10-04T14:00:00Z", 2, HOUR);
        assert_eq!(hours, told(&[("05 00:00", 60), ("05 01:00", 60), ("05 02:30", 30)]));
        let days = cut("Asia/Beirut", "2024-03-29T22:30:00Z", 48, 24 * HOUR);
        assert_eq!(days, told(&[("30 00:00", 1440), ("31 01:00", 1380)]));
    }
}
