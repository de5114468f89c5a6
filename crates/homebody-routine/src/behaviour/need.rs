//! Needs that build up until they are met.
//!
//! A need rises at a rate that depends on being awake, asleep or away, and interrupts the activity once it presses.
//!
//! We assume that the level rises steadily from 0 when it is met, and that it presses at a threshold drawn anew each time,
//! from a gamma distribution of mean 1 and shape 3, so that intervals between visits to the toilet have that distribution
//! (the shape is our choice).
//!
//! The instant of pressing is known in advance, so nothing is computed until then.
//!
//! Left out: the amount of drinks, and postponed needs.

use homebody_core::time::{DAY, RunTime, Span};

#[derive(Clone, Debug)]
pub struct NeedLevel {
    /// At `since`; 0 after it is met.
    level: f64,
    since: RunTime,
    /// Per day.
    rate: f64,
    threshold: f64,
}

impl NeedLevel {
    pub fn new(at: RunTime, threshold: f64) -> NeedLevel {
        NeedLevel { level: 0.0, since: at, rate: 0.0, threshold }
    }

    /// Per day, from now on.
    pub fn rise(&mut self, now: RunTime, rate: f64) {
        self.level = self.level_at(now);
        (self.since, self.rate) = (now, rate);
    }

    pub fn presses_at(&self) -> RunTime {
        let missing = self.threshold - self.level;
        if missing <= 0.0 {
            return self.since;
        }
        if self.rate <= 0.0 {
            return RunTime::NEVER;
        }
        let wait = missing / self.rate * DAY.micros() as f64;
        if wait > 1e15 { RunTime::NEVER } else { self.since.saturating_add(Span::from_micros(wait as i64 + 1)) }
    }

    /// It presses at 1.
    pub fn strength(&self, now: RunTime) -> f64 {
        self.level_at(now) / self.threshold
    }

    pub fn meet(&mut self, now: RunTime, threshold: f64) {
        (self.level, self.since, self.threshold) = (0.0, now, threshold);
    }

    fn level_at(&self, now: RunTime) -> f64 {
        self.level + self.rate * (now - self.since).micros() as f64 / DAY.micros() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_presses_when_it_has_risen_to_its_threshold() {
        let start = RunTime::START;
        let mut need = NeedLevel::new(start, 0.5);
        let presses_at = |need: &NeedLevel, at: RunTime| (need.presses_at() - at).abs() <= Span::MICROSECOND;
        assert_eq!(need.presses_at(), RunTime::NEVER);
        need.rise(start, 2.0);
        assert!(presses_at(&need, start + DAY / 4));
        // After an eighth of a day half of it is reached; at half the rate the rest takes a quarter.
        need.rise(start + DAY / 8, 1.0);
        assert!(presses_at(&need, start + DAY / 8 + DAY / 4));
        assert!((need.strength(start + DAY / 8) - 0.5).abs() < 1e-9);
        need.meet(start + DAY, 1.0);
        assert!(presses_at(&need, start + 2 * DAY));
    }

    #[test]
    fn a_need_that_presses_already_presses_now() {
        let mut need = NeedLevel::new(RunTime::START, 0.1);
        need.rise(RunTime::START, 1.0);
        need.rise(RunTime::START + DAY, 0.0);
        assert_eq!(need.presses_at(), RunTime::START + DAY);
    }
}
