//! The known times of a log.
//!
//! A run knows the span of its recording. Another log is known from its first row to its last, except for gaps that its source
//! reports, and for silences of a day and more that no absence explains.

use super::timeline::within_h;
use crate::density::{DensityCell, SILENCE};
use homebody_core::time::{DAY, HOUR, Interval, Span, WallTime, union, without};

/// Time for which unknown times are kept.
const KEPT: Span = DAY.times(16);

/// The times of a log that are known, up to the current day.
#[derive(Default)]
pub struct KnownTime {
    recorded: Option<Interval<WallTime>>,
    gaps: Vec<Interval<WallTime>>,
    first: Option<WallTime>,
    last: Option<WallTime>,
    /// The silence that ended with the first row of the day.
    broken: Option<Interval<WallTime>>,
    unknown: Vec<Interval<WallTime>>,
}

pub struct KnownDay {
    pub hours: [f64; 24],
    pub unknown: Vec<Interval<WallTime>>,
    /// The end of the known part.
    pub until: WallTime,
}

impl KnownDay {
    pub fn cells(&self) -> [DensityCell; 24] {
        self.hours.map(|recorded_h| DensityCell { recorded_h, ..DensityCell::default() })
    }
}

impl KnownTime {
    pub fn new(recorded: Option<Interval<WallTime>>, gaps: &[Interval<WallTime>]) -> KnownTime {
        KnownTime { recorded, gaps: gaps.to_vec(), first: None, last: None, broken: None, unknown: Vec::new() }
    }

    pub fn take(&mut self, at: WallTime) {
        self.first = self.first.or(Some(at));
        let last = self.last.unwrap_or(at);
        if at - last > SILENCE {
            self.broken = Some(Interval::new(last + Span::MICROSECOND, at));
        }
        self.last = Some(last.max(at));
    }

    pub fn first(&self) -> Option<WallTime> {
        self.first
    }

    pub fn last(&self) -> Option<WallTime> {
        self.last
    }

    pub fn forget(&mut self, span: Interval<WallTime>) {
        self.gaps.push(span);
        self.gaps.sort_unstable();
    }

    pub fn breaks(&self, day: Interval<WallTime>) -> Vec<WallTime> {
        let gaps = self.gaps.iter().map(|gap| gap.begin).filter(|at| day.contains(*at));
        let mut breaks: Vec<WallTime> = gaps.chain(self.broken.map(|silence| silence.begin)).collect();
        breaks.sort_unstable();
        breaks
    }

    /// The log's source reports a gap that begins at an instant.
    pub fn is_gap(&self, at: WallTime) -> bool {
        self.gaps.iter().any(|gap| gap.begin == at)
    }

    /// Ends a day, and returns its known part. `next` is the instant of the next row, `away` has the absences.
    pub fn end_day(
        &mut self,
        day: Interval<WallTime>,
        next: Option<WallTime>,
        away: &[Interval<WallTime>],
    ) -> KnownDay {
        let mut unknown = self.gaps.clone();
        match self.recorded {
            Some(recorded) => {
                // Rows beyond it were recorded, too.
                let first = self.first.map_or(recorded.begin, |first| first.min(recorded.begin));
                let last = self.last.map_or(recorded.end, |last| recorded.end.max(last + Span::MICROSECOND));
                unknown.extend([Interval::new(day.begin, first), Interval::new(last, day.end)]);
            }
            None => {
                unknown.extend(self.first.map(|first| Interval::new(day.begin, first)));
                let is_away = |silence: &Interval<WallTime>| {
                    away.iter().any(|away| away.begin < silence.begin && silence.end <= away.end)
                };
                unknown.extend(self.broken.filter(|silence| !is_away(silence)));
                let after = self.last.map_or(day.begin, |last| last + Span::MICROSECOND);
                let is_silent = next.is_none_or(|next| next - after >= SILENCE);
                unknown.extend(Some(Interval::new(after, day.end)).filter(|silence| is_silent && !is_away(silence)));
            }
        }
        self.broken = None;
        let clipped = unknown.into_iter().map(|span| span.intersection(day));
        let unknown = union(clipped.filter(|span| !span.is_empty()));
        let known = without(&[day], &unknown);
        let until = known.last().map_or(day.begin, |last| last.end);
        let hour = |hour: usize| within_h(&known, Interval::starting(day.begin + hour as i64 * HOUR, HOUR));
        self.unknown.extend(unknown);
        self.unknown.retain(|span| span.end > day.begin - KEPT);
        let unknown = union(self.unknown.iter().copied());
        KnownDay { hours: std::array::from_fn(hour), unknown, until }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::span;

    fn hours(from: i64, to: i64) -> Interval<WallTime> {
        span(from * 3600, to * 3600)
    }

    /// The known hours of each day, by the hours of rows.
    fn known_h(rows: &[i64], gaps: &[Interval<WallTime>], away: &[Interval<WallTime>], days: i64) -> Vec<f64> {
        let mut known = KnownTime::new(None, gaps);
        let mut rows = rows.iter().map(|&hour| hours(hour, hour).begin).peekable();
        let of_day = |day: i64| {
            let day = hours(day * 24, day * 24 + 24);
            while let Some(at) = rows.next_if(|at| *at < day.end) {
                known.take(at);
            }
            let of_day = known.end_day(day, rows.peek().copied(), away);
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
        assert_eq!(known_h(&silent, &[], &[hours(6, 78)], 4), [23.0, 24.0, 24.0, 18.0]);
        // A gap that the source reports counts, however short it is.
        assert_eq!(known_h(&[0, 8, 20, 24], &[hours(8, 20)], &[], 1), [12.0]);
    }
}
