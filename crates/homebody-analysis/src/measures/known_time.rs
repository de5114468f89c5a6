//! The known times of a log.
//!
//! A run knows the span of its recording. Another log is known from its first row to its last, except for gaps that its source
//! reports, and for silences of a day and more that no absence explains.

use super::timeline::{joined, within_h};
use crate::density::{Cell, SILENCE};
use crate::rows::Span;
use crate::signs::without;
use homebody_core::time::{DAY, Micros, SECOND};
use std::ops::Range;

const HOUR: Micros = 3600 * SECOND;
/// Unknown times are kept for so many days.
const KEPT: Micros = 16 * DAY;

/// The times of a log that are known, up to the current day.
pub struct KnownTime {
    recorded: Option<Range<Micros>>,
    gaps: Vec<Span>,
    first: Option<Micros>,
    last: Option<Micros>,
    /// The silence that ended with the first row of the day.
    broken: Option<Span>,
    unknown: Vec<Span>,
}

/// The known part of a day.
pub struct KnownDay {
    /// For how long anything is known of each hour, in hours.
    pub hours: [f64; 24],
    /// The unknown times, also of the days before.
    pub unknown: Vec<Span>,
    /// Until when the day is known.
    pub until: Micros,
}

impl KnownDay {
    /// Its hours, with no event counted yet.
    pub fn cells(&self) -> [Cell; 24] {
        self.hours.map(|recorded_h| Cell { recorded_h, ..Cell::default() })
    }
}

impl KnownTime {
    /// For a log with the span of its recording, if that is known, and with its gaps.
    pub fn new(recorded: Option<Range<Micros>>, gaps: &[Span]) -> KnownTime {
        KnownTime { recorded, gaps: gaps.to_vec(), first: None, last: None, broken: None, unknown: Vec::new() }
    }

    /// Takes that there is a row.
    pub fn take(&mut self, at: Micros) {
        self.first = self.first.or(Some(at));
        let last = self.last.unwrap_or(at);
        if at - last > SILENCE {
            self.broken = Some((last + 1, at));
        }
        self.last = Some(last.max(at));
    }

    /// When the first row was.
    pub fn first(&self) -> Option<Micros> {
        self.first
    }

    /// When the last row was.
    pub fn last(&self) -> Option<Micros> {
        self.last
    }

    /// Adds an unknown time.
    pub fn forget(&mut self, span: Span) {
        self.gaps.push(span);
        self.gaps.sort_unstable();
    }

    /// The instants of a day at which unknown times begin.
    pub fn breaks(&self, (begin, end): Span) -> Vec<Micros> {
        let gaps = self.gaps.iter().map(|gap| gap.0).filter(|at| (begin..end).contains(at));
        let mut breaks: Vec<Micros> = gaps.chain(self.broken.map(|silence| silence.0)).collect();
        breaks.sort_unstable();
        breaks
    }

    /// Whether the log's source reports a gap that begins at an instant.
    pub fn is_gap(&self, at: Micros) -> bool {
        self.gaps.iter().any(|gap| gap.0 == at)
    }

    /// Ends a day, and returns its known part. `next` is the instant of the next row, `away` has the absences.
    pub fn end_day(&mut self, begin: Micros, next: Option<Micros>, away: &[Span]) -> KnownDay {
        let end = begin + DAY;
        let mut unknown: Vec<Span> = self.gaps.clone();
        match &self.recorded {
            Some(recorded) => {
                // Rows beyond it were recorded, too.
                let first = self.first.map_or(recorded.start, |first| first.min(recorded.start));
                let last = self.last.map_or(recorded.end, |last| recorded.end.max(last + 1));
                unknown.extend([(begin, first), (last, end)]);
            }
            None => {
                unknown.extend(self.first.map(|first| (begin, first)));
                let is_away = |silence: &Span| away.iter().any(|span| span.0 < silence.0 && silence.1 <= span.1);
                unknown.extend(self.broken.filter(|silence| !is_away(silence)));
                let after = self.last.map_or(begin, |last| last + 1);
                let is_silent = next.is_none_or(|next| next - after >= SILENCE);
                if is_silent && !is_away(&(after, end)) {
                    unknown.push((after, end));
                }
            }
        }
        self.broken = None;
        let clipped = unknown.into_iter().map(|span| (span.0.max(begin), span.1.min(end)));
        let mut unknown: Vec<Span> = clipped.filter(|span| span.0 < span.1).collect();
        unknown.sort_unstable();
        let unknown = joined(unknown.into_iter(), 0);
        let known = without(&[(begin, end)], &unknown);
        let until = known.last().map_or(begin, |last| last.1);
        let hour = |hour: usize| {
            let from = begin + hour as Micros * HOUR;
            within_h(&known, (from, from + HOUR))
        };
        self.unknown.extend(unknown);
        self.unknown.retain(|span| span.1 > begin - KEPT);
        let unknown = joined(self.unknown.iter().copied(), 0);
        KnownDay { hours: std::array::from_fn(hour), unknown, until }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For how many hours anything is known of each day, by the hours of rows.
    fn known_h(rows: &[i64], gaps: &[Span], away: &[Span], days: i64) -> Vec<f64> {
        let mut known = KnownTime::new(None, gaps);
        let mut rows = rows.iter().map(|hour| hour * HOUR).peekable();
        let of_day = |day: i64| {
            while let Some(at) = rows.next_if(|at| *at < (day + 1) * DAY) {
                known.take(at);
            }
            let of_day = known.end_day(day * DAY, rows.peek().copied(), away);
            of_day.hours.iter().sum::<f64>().round()
        };
        (0..days).map(of_day).collect()
    }

    #[test]
    fn nothing_is_known_of_gaps_and_of_long_silences() {
        assert_eq!(known_h(&[2, 20, 30, 40], &[], &[], 2), [22.0, 16.0]);
        // No row comes for three days, from six in the morning on.
        let silent = [1, 6, 78, 90];
        assert_eq!(known_h(&silent, &[], &[], 4), [5.0, 0.0, 0.0, 12.0]);
        let away = [(6 * HOUR, 78 * HOUR)];
        assert_eq!(known_h(&silent, &[], &away, 4), [23.0, 24.0, 24.0, 18.0]);
        // A gap that the source reports counts, however short it is.
        assert_eq!(known_h(&[0, 8, 20, 24], &[(8 * HOUR, 20 * HOUR)], &[], 1), [12.0]);
    }
}
