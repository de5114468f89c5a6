//! The two texts that a sensor says in turn, where not both are known as words of states: `besetzt` and `frei` of a language that no
//! table has, or words of one maker alone. All else that has to do with rows is left.

use super::{Event, ValuePair};
use homebody_core::states::{Says, says};
use homebody_core::time::{Span, WallTime};

#[derive(Clone, Debug, Default)]
struct SensorTexts {
    values: [Option<u32>; 2],
    held: [Span; 2],
    /// The last row: when, and which of the two.
    last: Option<(WallTime, usize)>,
    rows: u64,
    turns: u64,
    /// Whether it says more than two texts.
    is_other: bool,
}

/// The texts of all sensors so far. It keeps no rows.
#[derive(Default)]
pub(crate) struct Pairs(Vec<SensorTexts>);

impl Pairs {
    /// Takes some more rows.
    pub fn take(&mut self, events: &[Event]) {
        for event in events {
            let sensor = event.sensor as usize;
            if self.0.len() <= sensor {
                self.0.resize(sensor + 1, SensorTexts::default());
            }
            self.0[sensor].take(event);
        }
    }

    /// The pairs with a text that is not a known state.
    pub fn end(self, values: &[String]) -> Vec<ValuePair> {
        let pair = |(sensor, texts): (usize, SensorTexts)| {
            let ([Some(first), Some(second)], false) = (texts.values, texts.is_other) else { return None };
            let said = [first, second].map(|value| &values[value as usize]);
            let is_text = said.iter().all(|text| text.parse::<f64>().is_err());
            let is_known = said.iter().all(|text| says(text).is_sign());
            // Some devices say `none` for nothing; other such words say that the sensor is gone.
            let is_gone = said.iter().any(|text| says(text) == Says::Unknown && !text.eq_ignore_ascii_case("none"));
            // Half of the rows and more begin the other state.
            let takes_turns = 2 * texts.turns >= texts.rows.saturating_sub(1);
            (is_text && !is_known && !is_gone).then_some(ValuePair {
                sensor: sensor as u32,
                values: [first, second],
                held: texts.held,
                takes_turns,
            })
        };
        self.0.into_iter().enumerate().filter_map(pair).collect()
    }
}

impl SensorTexts {
    fn take(&mut self, event: &Event) {
        if self.is_other {
            return;
        }
        let place = match self.values {
            [Some(first), _] if first == event.value => 0,
            [_, Some(second)] if second == event.value => 1,
            [None, _] => 0,
            [_, None] => 1,
            _ => {
                self.is_other = true;
                return;
            }
        };
        self.values[place] = Some(event.value);
        self.rows += 1;
        if let Some((at, before)) = self.last {
            self.turns += u64::from(before != place);
            // In a file whose newest row is first, a state holds until the row before it.
            let holds = if event.at >= at { before } else { place };
            self.held[holds] = self.held[holds].saturating_add((event.at - at).abs());
        }
        self.last = Some((event.at, place));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(rows: &[(i64, u32)], values: &[&str]) -> Vec<ValuePair> {
        let event = |&(at, value): &(i64, u32)| Event { at: WallTime::from_micros(at), sensor: 0, value };
        let events: Vec<Event> = rows.iter().map(event).collect();
        let mut pairs = Pairs::default();
        events.chunks(2).for_each(|some| pairs.take(some));
        pairs.end(&values.iter().map(ToString::to_string).collect::<Vec<_>>())
    }

    #[test]
    fn two_texts_in_turn_are_a_pair_unless_both_are_known() {
        let rows = [(0, 0), (2, 1), (10, 0), (13, 1), (20, 0)];
        let pair = ValuePair { sensor: 0, values: [0, 1], held: [5, 15].map(Span::from_micros), takes_turns: true };
        assert_eq!(pairs(&rows, &["zing", "zang"]), std::slice::from_ref(&pair));
        let newest_first: Vec<(i64, u32)> = rows.iter().rev().copied().collect();
        assert_eq!(pairs(&newest_first, &["zing", "zang"]), [pair]);
        assert_eq!((pairs(&rows, &["zing", "OFF"]).len(), pairs(&rows, &["pir", "none"]).len()), (1, 1));
        for known in [["ON", "OFF"], ["21.5", "zang"], ["ON", "unavailable"]] {
            assert_eq!(pairs(&rows, &known), [], "{known:?}");
        }
        assert_eq!(pairs(&[(0, 0), (1, 1), (2, 2)], &["a", "b", "c"]), []);
        assert!(!pairs(&[(0, 0), (1, 0), (2, 0), (3, 0), (4, 1)], &["a", "b"])[0].takes_turns);
    }
}
