//! Rows of a log, taken one by one: the meaning of each, and the spans that they open and close. Nothing here keeps all rows.

use crate::signs::{Beforehand, Kind, Meanings, RowMeaning, Says, SensorTally};
use homebody_core::time::{Interval, Span, WallTime};
use homebody_log::{Event, Log};

/// A row that says something other than a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateRow {
    pub at: WallTime,
    /// The sensor, by its number in the log.
    pub sensor: u32,
    /// Its meaning after the rows of its sensor before it.
    pub said: RowMeaning,
}

pub struct Tallies {
    meanings: Meanings,
    beforehand: Beforehand,
    tallies: Vec<SensorTally>,
    gaps: Vec<Interval<WallTime>>,
}

impl Tallies {
    pub fn new(log: &Log) -> Tallies {
        let tallies = vec![SensorTally::default(); log.sensors.len()];
        Tallies {
            meanings: Meanings::from_log(log),
            beforehand: Beforehand::from_log(log),
            tallies,
            gaps: log.gaps.clone(),
        }
    }

    /// Takes a row, in the order of time. Returns the row if it says something other than a number.
    pub fn take(&mut self, event: &Event) -> Option<StateRow> {
        let (says, is_number) = self.meanings.said(event)?;
        let said = self.tallies.get_mut(event.sensor as usize)?.take(event.at, says, is_number, &self.gaps);
        (says != Says::Else).then_some(StateRow { at: event.at, sensor: event.sensor, said })
    }

    pub fn kinds(&self) -> Vec<Kind> {
        let taken = self.beforehand.taken(&self.tallies.iter().collect::<Vec<_>>());
        taken.into_iter().map(|taken| taken.kind).collect()
    }
}

/// The times in which the sensors of a log report that something is on. Rows come in the order of time.
#[derive(Clone, Debug, Default)]
pub struct Ongoing {
    sensors: Vec<SensorSpans>,
    /// Shorter spans are not kept.
    least: Span,
}

#[derive(Clone, Debug, Default)]
struct SensorSpans {
    since: Option<WallTime>,
    /// It has reported an end.
    ends: bool,
    spans: Vec<Interval<WallTime>>,
}

impl SensorSpans {
    /// Ends an open span, and keeps it unless it is shorter than `least`.
    fn end(&mut self, at: WallTime, least: Span) {
        let is_kept = |begin: &WallTime| self.ends && at - *begin >= least;
        self.spans.extend(self.since.take().filter(is_kept).map(|begin| Interval::new(begin, at)));
    }
}

impl Ongoing {
    pub fn new(sensors: usize, least: Span) -> Ongoing {
        Ongoing { sensors: vec![SensorSpans::default(); sensors], least }
    }

    /// Takes a row. A sensor that reports no end has instants.
    pub fn take(&mut self, row: &StateRow) {
        let of = &mut self.sensors[row.sensor as usize];
        if let Some(unknown) = row.said.unknown_from {
            of.end(unknown, self.least);
        }
        match row.said.says {
            Says::Begins | Says::Opens => {
                of.since = of.since.or(Some(row.at));
                if !of.ends && self.least == Span::ZERO && !row.said.is_restored {
                    of.spans.push(Interval::instant(row.at));
                }
            }
            Says::Ends | Says::Closes => {
                of.ends = true;
                of.end(row.at, self.least);
            }
            Says::Unknown | Says::Else => {}
        }
    }

    pub fn end_all(&mut self, at: WallTime) {
        for of in &mut self.sensors {
            if let Some(since) = of.since.take().filter(|&since| of.ends && since <= at) {
                of.spans.push(Interval::new(since, at));
            }
        }
    }

    pub fn retain(&mut self, keeps: impl Fn(&Interval<WallTime>) -> bool) {
        self.sensors.iter_mut().for_each(|of| of.spans.retain(&keeps));
    }

    /// The spans of a sensor, in order. An open span ends at an instant, if one is given.
    pub fn spans(&self, sensor: usize, until: Option<WallTime>) -> Vec<Interval<WallTime>> {
        let SensorSpans { since, ends, spans } = &self.sensors[sensor];
        let open = since.filter(|_| *ends).zip(until).map(|(since, until)| Interval::new(since, until));
        let mut all = spans.clone();
        all.extend(open.filter(|open| !open.is_empty()));
        // An instant from before the first end lies within a span.
        all.sort_unstable();
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(at: i64, says: Says) -> StateRow {
        StateRow {
            at: WallTime::from_micros(at),
            sensor: 0,
            said: RowMeaning { says, unknown_from: None, is_restored: false },
        }
    }

    #[test]
    fn a_span_ends_where_the_state_is_not_known_and_a_restored_state_begins_none() {
        let mut ongoing = Ongoing::new(1, Span::ZERO);
        let at = WallTime::from_micros;
        let said = |says, unknown_from: Option<i64>, is_restored| RowMeaning {
            says,
            unknown_from: unknown_from.map(at),
            is_restored,
        };
        let rows = [
            (1, said(Says::Begins, None, false)),
            (2, said(Says::Ends, None, false)),
            (10, said(Says::Begins, None, false)),
            (14, said(Says::Unknown, Some(14), false)),
            (90, said(Says::Begins, Some(14), true)),
            (95, said(Says::Ends, None, false)),
        ];
        rows.iter().for_each(|&(micros, said)| ongoing.take(&StateRow { at: at(micros), sensor: 0, said }));
        assert_eq!(spans(&ongoing, None), [(1, 1), (1, 2), (10, 14), (90, 95)]);
    }

    fn spans(ongoing: &Ongoing, until: Option<i64>) -> Vec<(i64, i64)> {
        let spans = ongoing.spans(0, until.map(WallTime::from_micros));
        spans.iter().map(|span| (span.begin.micros(), span.end.micros())).collect()
    }

    fn taken(rows: &[(i64, Says)]) -> Ongoing {
        let mut ongoing = Ongoing::new(1, Span::ZERO);
        rows.iter().for_each(|&(at, says)| ongoing.take(&row(at, says)));
        ongoing
    }

    #[test]
    fn a_span_ends_with_its_row_or_where_nothing_is_known() {
        use Says::{Begins, Ends};
        assert_eq!(spans(&taken(&[(1, Begins), (5, Begins)]), Some(9)), [(1, 1), (5, 5)]);
        let mut open = taken(&[(1, Begins), (3, Ends), (5, Begins)]);
        assert_eq!(spans(&open, None), [(1, 1), (1, 3)]);
        assert_eq!(spans(&open, Some(9)), [(1, 1), (1, 3), (5, 9)]);
        open.end_all(WallTime::from_micros(7));
        open.take(&row(100, Ends));
        assert_eq!(spans(&open, Some(200)), [(1, 1), (1, 3), (5, 7)]);
        open.retain(|span| span.end.micros() > 3);
        assert_eq!(spans(&open, None), [(5, 7)]);
    }
}
