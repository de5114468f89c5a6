//! The clocks of sensors whose messages bear the time of their own clock.
//!
//! Firings are reported in the order of their times. A firing from a clock that is behind has a past time when it
//! arrives. With such a clock, all firings are held back until none can come that belongs before them.

use crate::link::form::DriftFile;
use crate::time::{RunTime, Span};

/// A clock that is ahead or behind, and runs too fast or too slow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorClock {
    offset: Span,
    /// Microseconds gained in a microsecond.
    gain: f64,
}

impl SensorClock {
    /// The clock of a file, which has seconds and millionths.
    pub fn new(file: &DriftFile) -> SensorClock {
        SensorClock { offset: Span::from_seconds(file.offset_s), gain: file.ppm * 1e-6 }
    }

    /// The time that it shows at an instant; never less than before.
    pub fn shows(&self, at: RunTime) -> RunTime {
        at + self.offset + at.since_zero().scaled(self.gain)
    }

    /// The first instant at which it shows a later time.
    fn passes(&self, shown: RunTime) -> RunTime {
        // Rounding leaves this a few microseconds off at most.
        let since_start = (shown - self.offset).micros() as f64 / (1.0 + self.gain);
        let mut at = RunTime::from_micros(libm::round(since_start) as i64);
        while self.shows(at) <= shown {
            at += Span::MICROSECOND;
        }
        while self.shows(at - Span::MICROSECOND) > shown {
            at -= Span::MICROSECOND;
        }
        at
    }
}

/// The clocks of a home's sensors that differ from the logger's.
#[derive(Clone, Debug)]
pub struct SensorClocks {
    /// The clocks of the sensors that have one of their own, in no particular order.
    pub clocks: Vec<SensorClock>,
    /// The longest time that a message is under way.
    pub longest: Span,
}

impl SensorClocks {
    /// The time before which no firing can come, once the run has come to `now`.
    pub fn settled(&self, now: RunTime) -> RunTime {
        self.clocks.iter().map(|clock| clock.shows(now - self.longest)).fold(now, RunTime::min)
    }

    /// The instant after which nothing can come any more that bears a time up to this one.
    pub fn settles(&self, stamp: RunTime) -> RunTime {
        let passed = self.clocks.iter().map(|clock| clock.passes(stamp) + self.longest - Span::MICROSECOND);
        passed.fold(stamp, RunTime::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clock(ppm: f64, offset_s: f64) -> SensorClock {
        SensorClock::new(&DriftFile { sensor: String::new(), ppm, offset_s })
    }

    #[test]
    fn a_clock_shows_its_offset_and_what_it_has_gained() {
        let at = RunTime::from_micros;
        assert_eq!(clock(0.0, -2.0).shows(RunTime::START), at(-2_000_000));
        assert_eq!(clock(40.0, 2.0).shows(at(1_000_000_000)), at(1_002_040_000));
        assert_eq!(clock(-1000.0, 0.0).shows(at(1_000_000_000)), at(999_000_000));
    }

    #[test]
    fn no_firing_comes_before_the_settled_time() {
        let clocks = SensorClocks {
            clocks: vec![clock(40.0, 1.0), clock(-1000.0, 0.5), clock(0.0, -3.0), clock(999.0, 86_400.0)],
            longest: Span::from_micros(777),
        };
        for now in (0..200).map(|index| RunTime::from_micros(index * 7_654_321_987 + index % 3)) {
            let settled = clocks.settled(now);
            for stamp in [settled - Span::MICROSECOND, settled] {
                assert_eq!(clocks.settles(stamp) < now, stamp < settled, "{stamp} at {now}");
            }
            for clock in &clocks.clocks {
                assert!(clock.shows(now - clocks.longest) >= settled);
                assert!(clocks.settles(clock.shows(now)) >= now + clocks.longest);
            }
        }
    }
}
