//! The timing of a log's motion sensors, and the losses of its link.
//!
//! | figure | definition |
//! |---|---|
//! | ON length | from an ON to the OFF after it |
//! | refiring | from an ON to the next of the same sensor, where that comes within `SOON` |
//! | repeated | the share of a sensor's rows that repeat its row before at once, within `AT_ONCE` |
//! | missing | the share of ONs after which no OFF comes before the next ON, repeated ones left out: of these messages one got lost |
//!
//! Units with a pulse hold each ON for the same time; others hold it for as long as movement continues, and the shortest ONs show the time
//! that they add. A log whose ONs last nearly the same from the first quarter to the third is taken for one of pulses.
//!
//! Left out: the reach of a sensor and its misses. Both change the number of its firings, and so do the places of people.

use crate::signs::{Kind, RowMeaning, Says, kinds, said};
use homebody_core::time::{MINUTE, SECOND, Span, WallTime};
use homebody_log::Log;
use serde::Serialize;
use std::fmt;

/// Time after which a refiring depends on the person, not on the sensor (our choice).
pub const SOON: Span = MINUTE;
/// Time within which a repeated row is a duplicate (our choice).
pub const AT_ONCE: Span = SECOND;
/// Smallest number of samples for quantiles (our choice).
const LEAST_SAMPLES: usize = 30;
/// Largest ratio of the third to the first quartile of ON durations that are pulses (our choice).
const PULSE: f64 = 1.3;

/// The 5th, the 25th, the 50th, the 75th and the 95th percentile, in seconds.
pub type Quantiles = [f64; 5];
const SHARES: Quantiles = [0.05, 0.25, 0.5, 0.75, 0.95];

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MotionTiming {
    pub all: SensorTiming,
    pub sensors: Vec<SensorTiming>,
    /// The share of rows that come twice.
    pub repeated: f64,
    /// The share of ONs without an OFF, or without the next ON.
    pub missing: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorTiming {
    /// Its id in the log; empty for all sensors.
    pub sensor: String,
    pub firings: usize,
    /// The lengths of ONs; `None` where the log has no OFFs, or too few ONs.
    pub on_s: Option<Quantiles>,
    pub refire_s: Option<Quantiles>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum HoldStyle {
    None,
    Pulse(f64),
    /// Each ON lasts as long as movement continues, and so much longer.
    Follow(f64),
}

impl SensorTiming {
    pub fn hold(&self) -> HoldStyle {
        match self.on_s {
            None => HoldStyle::None,
            Some([_, first, median, third, _]) if third <= PULSE * first => HoldStyle::Pulse(median),
            Some([shortest, ..]) => HoldStyle::Follow(shortest),
        }
    }
}

impl fmt::Display for SensorTiming {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let told = |of: Option<Quantiles>| match of {
            Some(of) => of.map(|s| format!("{s:.2}")).join(" "),
            None => "-".into(),
        };
        let hold = match self.hold() {
            HoldStyle::None => "no OFFs".to_owned(),
            HoldStyle::Pulse(s) => format!("pulses of {s:.2} s"),
            HoldStyle::Follow(s) => format!("ON while movement goes on, and {s:.2} s longer"),
        };
        writeln!(f, "{} ONs: {hold}", self.firings)?;
        writeln!(f, "ON lengths, 5 25 50 75 95 %: {} s", told(self.on_s))?;
        write!(f, "ON to ON, 5 25 50 75 95 %: {} s", told(self.refire_s))
    }
}

#[derive(Clone, Default)]
struct Samples {
    firings: usize,
    on_s: Vec<f64>,
    refire_s: Vec<f64>,
    /// The last row, and the last ON that is not a repetition.
    last: Option<(WallTime, Says)>,
    last_on: Option<WallTime>,
    is_on: bool,
    rows: usize,
    repeated: usize,
    missing: usize,
}

impl Samples {
    fn take(&mut self, at: WallTime, RowMeaning { says: said, unknown_from, is_restored }: RowMeaning) {
        if unknown_from.is_some() {
            (self.last, self.last_on, self.is_on) = (None, None, false);
        }
        if !matches!(said, Says::Begins | Says::Ends) || is_restored {
            return;
        }
        self.rows += 1;
        let is_repeated = self.last.is_some_and(|(before, what)| what == said && at - before <= AT_ONCE);
        self.last = Some((at, said));
        if is_repeated {
            self.repeated += 1;
            return;
        }
        match said {
            Says::Begins => {
                self.firings += 1;
                self.missing += usize::from(self.is_on);
                if let Some(before) = self.last_on.filter(|&before| at - before <= SOON) {
                    self.refire_s.push((at - before).seconds());
                }
                (self.is_on, self.last_on) = (true, Some(at));
            }
            Says::Ends => {
                if let Some(begin) = self.last_on.filter(|_| self.is_on) {
                    self.on_s.push((at - begin).seconds());
                }
                self.is_on = false;
            }
            _ => {}
        }
    }

    fn timing(&self, sensor: &str) -> SensorTiming {
        SensorTiming {
            sensor: sensor.to_owned(),
            firings: self.firings,
            on_s: quantiles(&self.on_s),
            refire_s: quantiles(&self.refire_s),
        }
    }
}

pub fn timing(log: &Log) -> MotionTiming {
    let kinds = kinds(log);
    let said = said(log);
    let mut order: Vec<usize> = (0..log.events.len()).collect();
    order.sort_by_key(|&row| log.events[row].at);
    let mut samples = vec![Samples::default(); log.sensors.len()];
    for row in order {
        let sensor = log.events[row].sensor as usize;
        if kinds[sensor] == Kind::Motion {
            samples[sensor].take(log.events[row].at, said[row]);
        }
    }
    let mut all = Samples::default();
    for one in &samples {
        all.firings += one.firings;
        all.rows += one.rows;
        all.repeated += one.repeated;
        all.missing += one.missing;
        all.on_s.extend(&one.on_s);
        all.refire_s.extend(&one.refire_s);
    }
    let has_ends = !all.on_s.is_empty();
    let share = |of: usize, whole: usize| if whole > 0 { of as f64 / whole as f64 } else { 0.0 };
    let motion = samples.iter().zip(&log.sensors).filter(|(one, _)| one.firings > 0);
    MotionTiming {
        all: all.timing(""),
        sensors: motion.map(|(one, name)| one.timing(name)).collect(),
        repeated: share(all.repeated, all.rows),
        missing: if has_ends { share(all.missing, all.firings) } else { 0.0 },
    }
}

fn quantiles(sample: &[f64]) -> Option<Quantiles> {
    if sample.len() < LEAST_SAMPLES {
        return None;
    }
    let mut sorted = sample.to_vec();
    sorted.sort_by(f64::total_cmp);
    Some(SHARES.map(|share| sorted[((sorted.len() - 1) as f64 * share).round() as usize]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_log::Event;

    /// A sensor that fires `count` times, every ten seconds, and is ON for as long as `on_s` says.
    fn log(count: i64, on_s: impl Fn(i64) -> f64) -> Log {
        let mut events = Vec::new();
        for number in 0..count {
            let at = crate::sample::at(number * 10);
            events.push(Event { at, sensor: 0, value: 0 });
            events.push(Event { at: at + Span::from_seconds(on_s(number)), sensor: 0, value: 1 });
        }
        Log { sensors: vec!["hall".into()], values: vec!["ON".into(), "OFF".into()], events, ..Log::default() }
    }

    #[test]
    fn separates_pulses_from_units_that_follow() {
        let pulse = timing(&log(100, |number| 4.0 + (number % 3) as f64 * 0.01));
        assert_eq!(pulse.all.hold(), HoldStyle::Pulse(4.01));
        let follow = timing(&log(100, |number| 1.1 + (number % 5) as f64));
        assert_eq!(follow.all.hold(), HoldStyle::Follow(1.1));
        assert_eq!(pulse.all.refire_s, Some([10.0; 5]));
        assert_eq!((pulse.repeated, pulse.missing, pulse.sensors.len()), (0.0, 0.0, 1));
    }

    #[test]
    fn a_log_without_offs_has_no_hold_and_misses_none() {
        let mut log = log(100, |_| 4.0);
        log.events.retain(|event| event.value == 0);
        let timing = timing(&log);
        assert_eq!((timing.all.hold(), timing.missing, timing.all.firings), (HoldStyle::None, 0.0, 100));
    }

    #[test]
    fn rows_that_come_twice_and_rows_that_are_missing_are_counted() {
        let mut log = log(100, |_| 4.0);
        let twice = Event { at: log.events[20].at + Span::from_millis(200), ..log.events[20] };
        log.events.push(twice);
        // The OFF of the thirtieth ON.
        log.events.remove(59);
        let timing = timing(&log);
        assert!((timing.repeated - 1.0 / 200.0).abs() < 1e-9, "{}", timing.repeated);
        assert!((timing.missing - 1.0 / 100.0).abs() < 1e-9, "{}", timing.missing);
        assert_eq!(timing.all.on_s.unwrap(), [4.0; 5]);
    }

    #[test]
    fn few_rows_tell_nothing() {
        let timing = timing(&log(10, |_| 4.0));
        assert_eq!((timing.all.on_s, timing.all.refire_s), (None, None));
    }
}
