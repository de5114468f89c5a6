//! Rows of a log, taken one by one: the meaning of each, and the spans that they open and close. Nothing here keeps all rows.

use crate::signs::{Kind, Says, Tally, is_number, kinds_of, says};
use homebody_core::time::Micros;
use homebody_log::{Event, Log};

/// A row that says something other than a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// When, in microseconds since 1970 on the clock on the wall.
    pub at: Micros,
    /// The sensor, by its number in the log.
    pub sensor: u32,
    /// Its meaning.
    pub says: Says,
}

/// The meanings of the values of a log, each looked up once.
struct Words(Vec<(Says, bool)>);

impl Words {
    fn of(log: &Log) -> Words {
        Words(log.values.iter().map(|value| (says(value), is_number(value))).collect())
    }

    /// The meaning of a row, and whether its value is a number; `None` for a row that was added after the log was read.
    fn said(&self, event: &Event) -> Option<(Says, bool)> {
        self.0.get(event.value as usize).copied()
    }
}

/// Counts of the rows of each sensor so far, by their look.
pub struct Tallies {
    words: Words,
    tallies: Vec<Tally>,
}

impl Tallies {
    /// For a log before its first row.
    pub fn new(log: &Log) -> Tallies {
        Tallies { words: Words::of(log), tallies: vec![Tally::default(); log.sensors.len()] }
    }

    /// Takes a row, in the order of time. Returns the row if it says something other than a number.
    pub fn take(&mut self, event: &Event) -> Option<Row> {
        let (says, is_number) = self.words.said(event)?;
        self.tallies.get_mut(event.sensor as usize)?.take(event.at, says, is_number);
        (says != Says::Else).then_some(Row { at: event.at, sensor: event.sensor, says })
    }

    /// The kinds of the sensors, by their names and by the rows so far.
    pub fn kinds(&self, called: &[String]) -> Vec<Kind> {
        kinds_of(&called.iter().map(String::as_str).zip(&self.tallies).collect::<Vec<_>>())
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

impl Ongoing {
    /// For so many sensors, all off. Spans shorter than `least` are not kept.
    pub fn new(sensors: usize, least: Micros) -> Ongoing {
        Ongoing { sensors: vec![OfSensor::default(); sensors], least }
    }

    /// Takes a row. A sensor that never says that something ends has instants.
    pub fn take(&mut self, row: &Row) {
        let of = &mut self.sensors[row.sensor as usize];
        match row.says {
            Says::Begins | Says::Opens => {
                of.since = of.since.or(Some(row.at));
                if !of.ends && self.least == 0 {
                    of.spans.push((row.at, row.at));
                }
            }
            Says::Ends | Says::Closes => {
                of.ends = true;
                let is_kept = |begin: &Micros| row.at - begin >= self.least;
                of.spans.extend(of.since.take().filter(is_kept).map(|begin| (begin, row.at)));
            }
            Says::Else => {}
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

/// The parts of spans that lie outside others; both in order of time.
pub fn without(spans: &[Span], others: &[Span]) -> Vec<Span> {
    let mut left = Vec::new();
    let mut first = 0;
    for &(begin, end) in spans {
        while others.get(first).is_some_and(|other| other.1 <= begin) {
            first += 1;
        }
        let mut from = begin;
        for other in others[first..].iter().take_while(|other| other.0 < end) {
            if other.0 > from {
                left.push((from, other.0));
            }
            from = from.max(other.1);
        }
        if from < end {
            left.push((from, end));
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(rows: &[(Micros, Says)]) -> Ongoing {
        let mut ongoing = Ongoing::new(1, 0);
        rows.iter().for_each(|&(at, says)| ongoing.take(&Row { at, sensor: 0, says }));
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
        open.take(&Row { at: 100, sensor: 0, says: Ends });
        assert_eq!(open.spans(0, Some(200)), [(1, 1), (1, 3), (5, 7)]);
        open.retain(|span| span.1 > 3);
        assert_eq!(open.spans(0, None), [(5, 7)]);
    }
}
