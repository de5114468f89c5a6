//! A log cut into windows of one length, to train recognisers: the messages of each sensor in a window, and the activity.
//!
//! A row is of one resident and one window. Windows begin where the clock on the wall shows a whole multiple of their length: those of a
//! day at midnight, those of an hour at full hours. A change of the clocks makes a window shorter or longer, as a day has 23 or 25 hours
//! then; of an hour that comes twice, and of shorter windows, both are windows. The features of a row are those of the log alone, and so
//! the same for all residents: the messages of each sensor that are not an end, and the last sensor. The label is the activity of the truth
//! for most of the window.
//!
//! Left out: the person whom a sensor saw, among several. That is the join of `label`, row by row.

use crate::dates::ahead;
use crate::signs::{Meanings, Says};
use homebody_core::time::{Interval, Span, UtcTime};
use homebody_log::{Event, Log};
use homebody_timeline::{Episode, PersonTimeline};
use jiff::tz::TimeZone;

/// Largest number of windows (our choice): those of a minute for twenty years.
pub const MOST: i64 = 10_000_000;

#[derive(Clone, Debug, PartialEq)]
pub struct Windows {
    /// The names of the sensors, in the order of `counts`.
    pub sensors: Vec<String>,
    /// In order of their beginnings, and of residents.
    pub rows: Vec<LogWindow>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct LogWindow {
    pub begin: UtcTime,
    /// The resident of the label; `None` where no resident is known.
    pub resident: Option<usize>,
    /// The activity for most of the window.
    pub label: Option<String>,
    /// The room for most of the window.
    pub room: Option<String>,
    /// By sensor: the messages that are not an end.
    pub counts: Vec<u32>,
    /// The last sensor with a message, in this window or before.
    pub last: Option<u32>,
}

homebody_core::messages! {
    /// Problems with the windows of a log.
    #[derive(Clone, PartialEq, Eq)]
    pub enum WindowMessage in "window" {
        /// A window covers a part of the log. Its length is a number of seconds, and at least a microsecond.
        NoLength { length_us: Span } error "no-length"
            ("a window cannot be {seconds} s long", seconds = length_us.seconds())
            hint ("choose a length above 0");
        /// Each window is a row of the answer. The limit of their number protects the memory.
        TooMany { windows: i64 } error "too-many"
            ("the log has {windows} windows of this length, and the limit is {MOST}")
            hint ("choose a longer window");
    }
}

/// Cuts a log into windows of a length, from its first row to its last. Windows begin by the wall of `zone`; if the zone of the log is
/// unknown, instants are those of a wall of UTC, and so is the zone.
pub fn windows(
    log: &Log<UtcTime>,
    people: &[PersonTimeline<UtcTime>],
    span: Span,
    zone: &TimeZone,
) -> Result<Windows, WindowMessage> {
    if span <= Span::ZERO {
        return Err(WindowMessage::NoLength { length_us: span });
    }
    let events = log.in_order();
    let (Some(first), Some(last)) = (events.first(), events.last()) else {
        return Ok(Windows { sensors: log.sensors.clone(), rows: Vec::new() });
    };
    let (first, last) = (first.at, last.at);
    let many = last.since_zero().div_euclid(span) - first.since_zero().div_euclid(span) + 1;
    if many > MOST {
        return Err(WindowMessage::TooMany { windows: many });
    }
    let mut wall = ZoneStretch::new(zone, first);
    let mut within = wall.first(first, span);
    let meanings = Meanings::from_log(log);
    let counts_for =
        |event: &Event<UtcTime>| !matches!(meanings.says(event), Says::Ends | Says::Closes | Says::Unknown);
    let is_known = !people.is_empty();
    let unknown = [PersonTimeline::default()];
    let people = if is_known { people } else { &unknown[..] };
    let mut rows = Vec::new();
    let (mut next, mut spoke) = (0, None);
    loop {
        let mut counts = vec![0; log.sensors.len()];
        while let Some(event) = events.get(next).filter(|event| event.at < within.end) {
            counts[event.sensor as usize] += u32::from(counts_for(event));
            spoke = Some(event.sensor);
            next += 1;
        }
        for (index, person) in people.iter().enumerate() {
            rows.push(LogWindow {
                begin: within.begin,
                resident: is_known.then_some(index),
                label: longest(&person.activities, within),
                room: longest(&person.rooms, within),
                counts: counts.clone(),
                last: spoke,
            });
        }
        if within.end > last {
            return Ok(Windows { sensors: log.sensors.clone(), rows });
        }
        within = Interval::new(within.end, wall.next(within.end, span));
    }
}

/// A stretch in which the clocks of a zone are not set: their offset from UTC, and the next change.
struct ZoneStretch<'z> {
    zone: &'z TimeZone,
    ahead: Span,
    until: UtcTime,
}

impl<'z> ZoneStretch<'z> {
    fn new(zone: &'z TimeZone, at: UtcTime) -> ZoneStretch<'z> {
        let until = zone.following(at.timestamp()).next().map_or(UtcTime::MAX, |set| set.timestamp().into());
        ZoneStretch { zone, ahead: ahead(at, zone), until }
    }

    /// The number of the last multiple of a length that the clock on the wall showed.
    fn number(&self, at: UtcTime, span: Span) -> i64 {
        at.saturating_add(self.ahead).since_zero().div_euclid(span)
    }

    /// The instant at which it shows a multiple of a length.
    fn begin(&self, number: i64, span: Span) -> UtcTime {
        UtcTime::EPOCH.saturating_add(span.saturating_mul(number)).saturating_sub(self.ahead)
    }

    fn first(&mut self, at: UtcTime, span: Span) -> Interval<UtcTime> {
        let mut begin = self.begin(self.number(at, span), span);
        // As of the beginning of the day, or of what is longer, on which clocks were set before the instant.
        let mut stretch = ZoneStretch { zone: self.zone, ..*self };
        let mut seen = at;
        while let Some(set) = self.zone.preceding(seen.timestamp()).next().map(|set| UtcTime::from(set.timestamp()))
            && set >= begin
        {
            let before = ZoneStretch::new(self.zone, set - Span::MICROSECOND);
            if before.is_cut(&stretch, span) {
                begin = set;
                break;
            }
            begin = before.begin(before.number(set - Span::MICROSECOND, span), span);
            (stretch, seen) = (before, set);
        }
        Interval::new(begin, self.next(at, span))
    }

    fn next(&mut self, at: UtcTime, span: Span) -> UtcTime {
        if at >= self.until {
            *self = ZoneStretch::new(self.zone, at);
        }
        let mut from = at;
        loop {
            let end = self.begin(self.number(from, span) + 1, span);
            if end < self.until {
                return end;
            }
            let set = self.until;
            let after = ZoneStretch::new(self.zone, set);
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
    fn is_cut(&self, next: &ZoneStretch<'_>, span: Span) -> bool {
        let by = next.ahead - self.ahead;
        let is_whole = by != Span::ZERO && by % span == Span::ZERO;
        self.number(self.until - Span::MICROSECOND, span) != next.number(self.until, span) || is_whole
    }
}

/// The label for most of an interval; of two as long, the first.
fn longest(episodes: &[Episode<UtcTime>], within: Interval<UtcTime>) -> Option<String> {
    let first = episodes.partition_point(|episode| episode.end() <= within.begin);
    let mut best: Option<(Span, &str)> = None;
    for episode in episodes[first..].iter().take_while(|episode| episode.begin() < within.end) {
        let lasts = episode.time.intersection(within).length();
        if best.is_none_or(|(most, _)| lasts > most) {
            best = Some((lasts, &episode.label));
        }
    }
    best.map(|(_, name)| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{HOUR, MINUTE, SECOND};
    use jiff::Timestamp;

    #[test]
    fn a_window_counts_what_begins_and_is_labelled_by_what_lasts_longest() {
        let at = |at_s: i64| UtcTime::EPOCH + at_s * SECOND;
        let event = |at_s: i64, sensor, value| Event { at: at(at_s), sensor, value };
        let log = Log {
            sensors: vec!["bed".into(), "hall".into()],
            values: vec!["ON".into(), "OFF".into()],
            events: vec![event(61, 0, 0), event(62, 0, 1), event(70, 1, 0), event(185, 0, 0)],
            ..Log::default()
        };
        let doing = |label: &str, begin_s: i64, end_s: i64| {
            Episode::new(label.to_owned(), Interval::new(at(begin_s), at(end_s)))
        };
        let activities = vec![doing("sleeping", 0, 85), doing("walking", 85, 118)];
        let ada = PersonTimeline { name: "ada".into(), activities, rooms: Vec::new() };
        let cut = windows(&log, std::slice::from_ref(&ada), MINUTE, &TimeZone::UTC).unwrap();
        let told: Vec<_> = cut
            .rows
            .iter()
            .map(|row| (row.begin.since_zero() / SECOND, row.counts.clone(), row.label.as_deref()))
            .collect();
        assert_eq!(
            told,
            [(60, vec![1, 1], Some("walking")), (120, vec![0, 0], None), (180, vec![1, 0], None)],
            "33 s of walking are more than 25 s of sleep in the first"
        );
        assert_eq!(cut.rows[1].last, Some(1), "who spoke last is known on");
        let nobody = windows(&log, &[], MINUTE, &TimeZone::UTC).unwrap();
        assert_eq!((nobody.rows.len(), nobody.rows[0].resident), (3, None));
        let too_short = [Span::ZERO, Span::MICROSECOND];
        assert!(too_short.iter().all(|&span| windows(&log, &[], span, &TimeZone::UTC).is_err()));
    }

    /// On the wall of a zone, the beginnings of windows of so many hours and how long each is but the last.
    fn cut(zone: &str, begin: &str, hours: i64, span: Span) -> Vec<(String, i64)> {
        let (zone, begin) = (TimeZone::get(zone).unwrap(), UtcTime::from(begin.parse::<Timestamp>().unwrap()));
        let event = |hour: i64| Event { at: begin + hour * HOUR, sensor: 0, value: 0 };
        let events = (0..=hours).map(event).collect();
        let log = Log { sensors: vec!["bed".into()], values: vec!["ON".into()], events, ..Log::default() };
        let rows = windows(&log, &[], span, &zone).unwrap().rows;
        assert_eq!(rows.iter().map(|row| i64::from(row.counts[0])).sum::<i64>(), hours + 1, "each row is in one");
        let told = |at: UtcTime| at.timestamp().to_zoned(zone.clone()).strftime("%d %H:%M").to_string();
        rows.windows(2).map(|pair| (told(pair[0].begin), (pair[1].begin - pair[0].begin) / MINUTE)).collect()
    }

    #[test]
    fn windows_begin_by_the_clock_on_the_wall() {
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
