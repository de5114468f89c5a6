//! Turns firings into rows: the firing alone, or an ON and, once the sensor has been quiet, an OFF.
//!
//! Only motion sensors are held; rows of others have the sensor's own values. A held sensor is ON from a firing while it was OFF until the
//! hold after its last firing; firings meanwhile only prolong it. The length of a hold differs from firing to firing, by `logger.json`: it
//! depends on the sensor's name and the firing's number alone. At one instant OFF comes before ON, and OFFs come in the order of sensors.

use homebody_core::event::{Firing, Value};
use homebody_core::ids::SensorId;
use homebody_core::random::Marks;
use homebody_core::scenario::logger::{LumpFile, MessagesFile};
use homebody_core::time::{RunTime, Span};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LogRow {
    /// The rows of a run are numbered from 0.
    pub seq: u64,
    pub at: RunTime,
    pub sensor: SensorId,
    pub value: Value,
    /// The firing that it came from; of an OFF that a hold ends with, the last that was held.
    pub firing: u64,
}

/// Turns firings into rows.
#[derive(Clone)]
pub(crate) struct Messages {
    hold: Option<MessageHold>,
    next_seq: u64,
}

#[derive(Clone)]
struct MessageHold {
    lengths: Lengths,
    /// By sensor, the firing that holds it; None while it is OFF.
    held: Vec<Option<HeldSensor>>,
    /// One entry for each sensor that is ON. A firing does not move its sensor's entry, so an entry may come up
    /// too early; it is then put back to where it belongs.
    due: BinaryHeap<Reverse<(RunTime, SensorId)>>,
}

#[derive(Clone)]
struct Lengths {
    span: Span,
    /// By lump, the share of firings up to its end, and its least and greatest part of the span; empty if all hold for the span.
    lumps: Vec<(f64, [f64; 2])>,
    /// By sensor.
    marks: Vec<Marks>,
}

impl Lengths {
    fn new(span: Span, lumps: &[LumpFile], seed: u64, sensors: &[String]) -> Lengths {
        let whole: f64 = lumps.iter().map(|lump| lump.share).sum();
        let up_to = lumps.iter().scan(0.0, |sum, lump| {
            *sum += lump.share / whole;
            Some((*sum, lump.parts))
        });
        let marks = sensors.iter().map(|name| Marks::named(seed, &format!("sensor/{name}/hold")));
        Lengths { span, lumps: if whole > 0.0 { up_to.collect() } else { Vec::new() }, marks: marks.collect() }
    }

    fn of(&self, firing: &Firing) -> Span {
        let Some((_, last)) = self.lumps.last() else { return self.span };
        let drawn = self.marks[firing.sensor.index()].of(firing.seq);
        let lump = self.lumps.iter().find(|(up_to, _)| drawn.unit(0) < *up_to).map_or(last, |(_, parts)| parts);
        let part = lump[0] + (lump[1] - lump[0]) * drawn.unit(1);
        Span::from_micros((self.span.micros() as f64 * part) as i64).max(Span::MICROSECOND)
    }
}

#[derive(Clone, Copy)]
struct HeldSensor {
    /// When it goes OFF unless it fires again.
    off_at: RunTime,
    row: u64,
    /// The firing that prolonged it last.
    firing: u64,
}

impl Messages {
    /// The messages of a run of this seed, of the sensors of these names.
    pub fn new(messages: &MessagesFile, seed: u64, sensors: &[String]) -> Messages {
        let lengths = match messages {
            MessagesFile::FireOnly => None,
            MessagesFile::OnOff(on_off) => Some((on_off.hold_s, &on_off.lumps[..])),
            MessagesFile::Occupancy(occupancy) => Some((occupancy.timeout_s, &[][..])),
        };
        let hold = lengths.map(|(span_s, lumps)| MessageHold {
            lengths: Lengths::new(Span::from_seconds(span_s), lumps, seed, sensors),
            held: vec![None; sensors.len()],
            due: BinaryHeap::new(),
        });
        Messages { hold, next_seq: 0 }
    }

    /// The rows of a firing: what has become due by then, then its own. Returns the number of the row that tells of it: its
    /// own, or the ON that it prolongs.
    pub fn firing(&mut self, firing: &Firing, rows: &mut Vec<LogRow>) -> u64 {
        let next_seq = &mut self.next_seq;
        if let Some(hold) = &mut self.hold {
            hold.release(firing.at, |at, sensor, held| push(rows, next_seq, at, sensor, Value::Off, held.firing));
            if firing.value == Value::Fire
                && let Some(row) = hold.prolong(firing, *next_seq)
            {
                return row;
            }
        }
        push(rows, next_seq, firing.at, firing.sensor, firing.value, firing.seq);
        *next_seq - 1
    }

    /// The rows due before `until`, given that no firing comes before it.
    pub fn quiet(&mut self, until: RunTime, rows: &mut Vec<LogRow>) {
        let next_seq = &mut self.next_seq;
        if let Some(hold) = &mut self.hold {
            hold.release(until - Span::MICROSECOND, |at, sensor, held| {
                push(rows, next_seq, at, sensor, Value::Off, held.firing)
            });
        }
    }
}

impl MessageHold {
    /// Turns OFF what is due at `now` or earlier.
    fn release(&mut self, now: RunTime, mut off: impl FnMut(RunTime, SensorId, HeldSensor)) {
        while let Some(&Reverse((at, sensor))) = self.due.peek() {
            if at > now {
                break;
            }
            self.due.pop();
            match self.held[sensor.index()].take() {
                Some(held) if held.off_at > at => {
                    self.held[sensor.index()] = Some(held);
                    self.due.push(Reverse((held.off_at, sensor)));
                }
                Some(held) => off(at, sensor, held),
                None => {}
            }
        }
    }

    /// Holds the sensor ON from this firing; the row that said ON if it was so before, else `row` will.
    fn prolong(&mut self, firing: &Firing, row: u64) -> Option<u64> {
        let held = &mut self.held[firing.sensor.index()];
        let before = held.map(|held| held.row);
        // A short hold does not end a longer one before.
        let off_at = (firing.at + self.lengths.of(firing)).max(held.map_or(RunTime::START, |held| held.off_at));
        *held = Some(HeldSensor { off_at, row: before.unwrap_or(row), firing: firing.seq });
        if before.is_none() {
            self.due.push(Reverse((off_at, firing.sensor)));
        }
        before
    }
}

fn push(rows: &mut Vec<LogRow>, next_seq: &mut u64, at: RunTime, sensor: SensorId, value: Value, firing: u64) {
    rows.push(LogRow { seq: *next_seq, at, sensor, value, firing });
    *next_seq += 1;
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::scenario::logger::OnOffFile;
    use homebody_core::time::{HOUR, SECOND};

    const SENSORS: u32 = 4;

    fn names() -> Vec<String> {
        (0..SENSORS).map(|sensor| format!("sensor {sensor}")).collect()
    }

    const ON: Value = Value::Fire;
    const OFF: Value = Value::Off;

    fn at(micros: i64) -> RunTime {
        RunTime::from_micros(micros)
    }

    fn on_off(hold: i64) -> MessagesFile {
        MessagesFile::OnOff(OnOffFile::exactly(hold as f64 / 1e6))
    }

    fn fires(seq: u64, sensor: u32, value: Value, micros: i64) -> Firing {
        Firing { seq, at: at(micros), sensor: SensorId(sensor), value }
    }

    /// Instants are microseconds.
    fn told(rows: &[LogRow]) -> Vec<(i64, u32, Value)> {
        rows.iter().map(|row| (row.at.micros(), row.sensor.0, row.value)).collect()
    }

    fn stored(firings: &[(i64, u32)], hold: i64, until: i64) -> Vec<(i64, u32, Value)> {
        let mut messages = Messages::new(&on_off(hold), 1, &names());
        let mut rows = Vec::new();
        for (seq, &(at, sensor)) in firings.iter().enumerate() {
            messages.firing(&fires(seq as u64, sensor, ON, at), &mut rows);
        }
        messages.quiet(at(until), &mut rows);
        assert!(rows.iter().enumerate().all(|(seq, row)| row.seq == seq as u64));
        told(&rows)
    }

    /// Looks at each microsecond and each sensor, and asks whether it has fired within the hold.
    fn reference(firings: &[(i64, u32)], hold: i64, until: i64) -> Vec<(i64, u32, Value)> {
        let mut rows = Vec::new();
        let mut on = [false; SENSORS as usize];
        for now in 0..until {
            let (mut offs, mut ons) = (Vec::new(), Vec::new());
            for sensor in 0..SENSORS {
                let held = firings.iter().any(|&(at, who)| who == sensor && at < now && now < at + hold);
                let fires = firings.contains(&(now, sensor));
                let was_on = on[sensor as usize];
                if was_on && !held {
                    offs.push((now, sensor, OFF));
                }
                if fires && (!was_on || !held) {
                    ons.push((now, sensor, ON));
                }
                on[sensor as usize] = held || fires;
            }
            rows.extend(offs.into_iter().chain(ons));
        }
        rows
    }

    #[test]
    fn firings_alone_are_stored_unchanged() {
        let mut messages = Messages::new(&MessagesFile::FireOnly, 1, &names());
        let mut rows = Vec::new();
        messages.firing(&fires(7, 1, ON, 5), &mut rows);
        messages.quiet(at(1_000_000_000), &mut rows);
        assert_eq!(rows, [LogRow { seq: 0, at: at(5), sensor: SensorId(1), value: ON, firing: 7 }]);
    }

    #[test]
    fn values_of_other_sensors_are_not_held() {
        let mut messages = Messages::new(&on_off(5), 1, &names());
        let mut rows = Vec::new();
        for (at, sensor, value) in [(0, 0, Value::Fire), (1, 1, Value::Open), (2, 1, Value::Open), (9, 1, Value::Close)]
        {
            messages.firing(&fires(at as u64, sensor, value, at), &mut rows);
        }
        let stored = told(&rows);
        let opened = [(1, 1, Value::Open), (2, 1, Value::Open)];
        assert_eq!(stored[..3], [(0, 0, ON), opened[0], opened[1]]);
        assert_eq!(stored[3..], [(5, 0, OFF), (9, 1, Value::Close)]);
    }

    #[test]
    fn a_hold_is_prolonged_and_off_comes_before_on() {
        let rows = stored(&[(0, 0), (3, 0), (8, 0), (8, 1), (9, 0)], 5, 15);
        assert_eq!(rows, [(0, 0, ON), (8, 0, OFF), (8, 0, ON), (8, 1, ON), (13, 1, OFF), (14, 0, OFF)]);
        assert_eq!(stored(&[(0, 0)], 5, 5), [(0, 0, ON)], "what is due at the end itself is not written");
    }

    /// Each firing by itself, an hour after the last: the lengths are those of the lumps, whatever other sensors do.
    #[test]
    fn holds_follow_the_lumps_of_the_file() {
        let file: OnOffFile = serde_json::from_value(serde_json::json!({ "hold_s": 4 })).unwrap();
        let lengths = |seed, sensors: &[String]| -> Vec<Span> {
            let mut messages = Messages::new(&MessagesFile::OnOff(file.clone()), seed, sensors);
            let mut rows = Vec::new();
            for seq in 0..20_000 {
                let sensor = SensorId::new(sensors.len() - 1);
                let at = RunTime::START + seq as i64 * HOUR;
                messages.firing(&Firing { seq, at, sensor, value: Value::Fire }, &mut rows);
                messages.quiet(at + 1000 * SECOND, &mut rows);
            }
            rows.chunks(2).map(|pair| pair[1].at - pair[0].at).collect()
        };
        let all = lengths(1, &names());
        assert_eq!(all, lengths(1, &names()[3..]));
        assert_ne!(all, lengths(2, &names()));
        let mut sorted = all;
        sorted.sort_unstable();
        let quantile = |share: f64| sorted[(sorted.len() as f64 * share) as usize].seconds();
        // 0.05 of 0.55 on the way from 3.8 to 4 s, half of 0.55, and 0.10 of 0.12 on the way from 4.2 to 4.5 s.
        for (share, expected) in [(0.05, 3.8182), (0.5, 3.9818), (0.95, 4.45)] {
            assert!((quantile(share) - expected).abs() < 0.03, "{share}: {}", quantile(share));
        }
        assert!(sorted[0] >= Span::from_millis(3800) && sorted[sorted.len() - 1] <= Span::from_millis(6400));
    }

    #[test]
    fn random_holds_agree_with_the_reference() {
        let mut state = 7_u64;
        let mut random = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        };
        for _ in 0..300 {
            let until = 60;
            let mut firings: Vec<(i64, u32)> =
                (0..random(40)).map(|_| (random(until) as i64, random(SENSORS.into()) as u32)).collect();
            firings.sort();
            firings.dedup();
            let hold = 1 + random(12) as i64;
            let until = until as i64 + random(12) as i64;
            assert_eq!(stored(&firings, hold, until), reference(&firings, hold, until), "{firings:?} held {hold}");
        }
    }
}
