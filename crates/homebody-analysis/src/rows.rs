//! Rows of a log, taken one by one: the meaning of each, and the spans that they open and close. Nothing here keeps all rows.

use crate::signs::{Beforehand, Kind, Meanings, Said, Says, Tally};
use homebody_core::time::Micros;
use homebody_log::{Event, Log};

/// A row that says something other than a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// When, in microseconds since 1970 on the clock on the wall.
    pub at: Micros,
    /// The sensor, by its number in the log.
    pub sensor: u32,
    /// Its meaning after the rows of its sensor before it.
    pub said: Said,
}

/// Counts of the rows of each sensor so far, by their look.
pub struct Tallies {
    meanings: Meanings,
    beforehand: Beforehand,
    tallies: Vec<Tally>,
    gaps: Vec<Span>,
}

impl Tallies {
    /// For a log before its first row.
    pub fn new(log: &Log) -> Tallies {
        let tallies = vec![Tally::default(); log.sensors.len()];
        Tallies { meanings: Meanings::of(log), beforehand: Beforehand::of(log), tallies, gaps: log.gaps.clone() }
    }

    /// Takes a row, in the order of time. Returns the row if it says something other than a number.
    pub fn take(&mut self, event: &Event) -> Option<Row> {
        let (says, is_number) = self.meanings.said(event)?;
        let said = self.tallies.get_mut(event.sensor as usize)?.take(event.at, says, is_number, &self.gaps);
        (says != Says::Else).then_some(Row { at: event.at, sensor: event.sensor, said })
    }

    /// The kinds of the log's sensors, by all that is known of them and by the rows so far.
    pub fn kinds(&self) -> Vec<Kind> {
        let taken = self.beforehand.taken(&self.tallies.iter().collect::<Vec<_>>());
        taken.into_iter().map(|taken| taken.kind).collect()
    }
}

/// From when to when.
pub type Span = (Micros, Micros);

/// The spans over which the sensors of a log report that something is on. Rows come in the order of time.
#[derive(Clone, Debug, Default)]
pub struct Ongoing {
    sensors: Vec<OfSensor>,
    /// Shorter spans are not kept.
    least: Micros,
}

#[derive(Clone, Debug, Default)]
struct OfSensor {
    since: Option<Micros>,
    /// Whether it has ever reported an end.
    ends: bool,
    spans: Vec<Span>,
}

impl OfSensor {
    /// Ends an open span, which is kept unless it is shorter than `least`.
    fn end(&mut self, at: Micros, least: Micros) {
        let is_kept = |begin: &Micros| self.ends && at - begin >= least;
        self.spans.extend(self.since.take().filter(is_kept).map(|begin| (begin, at)));
    }
}

impl Ongoing {
    /// For so many sensors, all off. Spans shorter than `least` are not kept.
    pub fn new(sensors: usize, least: Micros) -> Ongoing {
        Ongoing { sensors: vec![OfSensor::default(); sensors], least }
    }

    /// Takes a row. A sensor that never says that something ends has instants.
    pub fn take(&mut self, row: &Row) {
        let of = &mut self.sensors[row.sensor as usize];
        if let Some(unknown) = row.said.unknown_from {
            of.end(unknown, self.least);
        }
        match row.said.says {
            Says::Begins | Says::Opens => {
                of.since = of.since.or(Some(row.at));
                if !of.ends && self.least == 0 && !row.said.is_restored {
                    of.spans.push((row.at, row.at));
                }
            }
            Says::Ends | Says::Closes => {
                of.ends = true;
                of.end(row.at, self.least);
            }
            Says::Unknown | Says::Else => {}
        }
    }

    /// Ends all open spans where a gap begins.
    pub fn end_all(&mut self, at: Micros) {
        for of in &mut self.sensors {
            if let Some(since) = of.since.take().filter(|&since| of.ends && since <= at) {
                of.spans.push((since, at));
            }
        }
    }

    /// Keeps only certain spans.
    pub fn retain(&mut self, keeps: impl Fn(&Span) -> bool) {
        self.sensors.iter_mut().for_each(|of| of.spans.retain(&keeps));
    }

    /// The spans of a sensor, in order. An open span ends at an instant, if one is given.
    pub fn spans(&self, sensor: usize, until: Option<Micros>) -> Vec<Span> {
        let OfSensor { since, ends, spans } = &self.sensors[sensor];
        let open = since.filter(|_| *ends).zip(until).filter(|(since, until)| since < until);
        let mut all = spans.clone();
        all.extend(open);
        // An instant from before the first end lies within a span.
        all.sort_unstable();
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(at: Micros, says: Says) -> Row {
        Row { at, sensor: 0, said: Said { says, unknown_from: None, is_restored: false } }
    }

    #[test]
    fn a_span_ends_where_the_state_is_not_known_and_a_restored_state_begins_none() {
        let mut ongoing = Ongoing::new(1, 0);
        let said = |says, unknown_from, is_restored| Said { says, unknown_from, is_restored };
        let rows = [
            (1, said(Says::Begins, None, false)),
            (2, said(Says::Ends, None, false)),
            (10, said(Says::Begins, None, false)),
            (14, said(Says::Unknown, Some(14), false)),
            (90, said(Says::Begins, Some(14), true)),
            (95, said(Says::Ends, None, false)),
        ];
        rows.iter().for_each(|&(at, said)| ongoing.take(&Row { at, sensor: 0, said }));
        assert_eq!(ongoing.spans(0, None), [(1, 1), (1, 2), (10, 14), (90, 95)]);
    }

    fn taken(rows: &[(Micros, Says)]) -> Ongoing {
        let mut ongoing = Ongoing::new(1, 0);
        rows.iter().for_each(|&(at, says)| ongoing.take(&row(at, says)));
        ongoing
    }

    #[test]
    fn a_span_ends_with_its_row_or_where_nothing_is_known() {
        use Says::{Begins, Ends};
        assert_eq!(taken(&[(1, Begins), (5, Begins)]).spans(0, Some(9)), [(1, 1), (5, 5)]);
        let mut open = taken(&[(1, Begins), (3, Ends), (5, Begins)]);
        assert_eq!(open.spans(0, None), [(1, 1), (1, 3)]);
        assert_eq!(open.spans(0, Some(9)), [(1, 1), (1, 3), (5, 9)]);
        open.end_all(7);
        open.take(&row(100, Ends));
        assert_eq!(open.spans(0, Some(200)), [(1, 1), (1, 3), (5, 7)]);
        open.retain(|span| span.1 > 3);
        assert_eq!(open.spans(0, None), [(5, 7)]);
    }
}
