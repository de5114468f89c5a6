//! Needs that build up until something is done about them.
//!
//! A need rises with time, at a rate that depends on whether one is awake, asleep or away, and interrupts what is done
//! once it presses.
//!
//! We assume that the level rises steadily from 0 when it is met, and that it presses at a threshold that is drawn anew
//! each time, from a gamma distribution of mean 1 and shape 3: visits to the toilet then have intervals of that
//! distribution (the shape is ours).
//!
//! The instant at which it will press is known at any time, so nothing is computed until then.
//!
//! Left out: what one drinks, and that needs which press are sometimes put off.

use homebody_core::time::{DAY, Micros, NEVER};

/// One need of one resident.
#[derive(Clone, Debug)]
pub struct Need {
    /// At `since`; 0 is met.
    level: f64,
    since: Micros,
    /// Rise a day.
    rate: f64,
    /// The level at which it presses.
    threshold: f64,
}

impl Need {
    /// A need that was met at an instant and presses at a threshold.
    pub fn new(at: Micros, threshold: f64) -> Need {
        Need { level: 0.0, since: at, rate: 0.0, threshold }
    }

    /// From now on it rises so much a day.
    pub fn rise(&mut self, now: Micros, rate: f64) {
        self.level = self.level_at(now);
        (self.since, self.rate) = (now, rate);
    }

    /// When it presses, if nothing changes.
    pub fn presses_at(&self) -> Micros {
        let missing = self.threshold - self.level;
        if missing <= 0.0 {
            return self.since;
        }
        if self.rate <= 0.0 {
            return NEVER;
        }
        let wait = missing / self.rate * DAY as f64;
        if wait > 1e15 { NEVER } else { self.since.saturating_add(wait as Micros + 1) }
    }

    /// How strong it is: 1 presses.
    pub fn strength(&self, now: Micros) -> f64 {
        self.level_at(now) / self.threshold
    }

    /// It is met, and presses next at another threshold.
    pub fn meet(&mut self, now: Micros, threshold: f64) {
        (self.level, self.since, self.threshold) = (0.0, now, threshold);
    }

    fn level_at(&self, now: Micros) -> f64 {
        self.level + self.rate * (now - self.since) as f64 / DAY as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_presses_when_it_has_risen_to_its_threshold() {
        let mut need = Need::new(0, 0.5);
        assert_eq!(need.presses_at(), NEVER);
        need.rise(0, 2.0);
        assert!((need.presses_at() - DAY / 4).abs() <= 1);
        // After an eighth of a day half of it is there; at half the rate the rest takes a quarter.
        need.rise(DAY / 8, 1.0);
        assert!((need.presses_at() - (DAY / 8 + DAY / 4)).abs() <= 1);
        assert!((need.strength(DAY / 8) - 0.5).abs() < 1e-9);
        need.meet(DAY, 1.0);
        assert!((need.presses_at() - 2 * DAY).abs() <= 1);
    }

    #[test]
    fn what_presses_already_presses_now() {
        let mut need = Need::new(0, 0.1);
        need.rise(0, 1.0);
        need.rise(DAY, 0.0);
        assert_eq!(need.presses_at(), DAY);
    }
}
