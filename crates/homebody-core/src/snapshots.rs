//! Copies of the state of a run, made as it advances, so that going back does not start at the beginning.
//!
//! A copy of a [`Run`](crate::run::Run) continues exactly as the original, so a continued copy gives the same as a run
//! from the beginning. It is valid as long as seed, scenario and the input before its instant are the same: after a
//! change of one of these, start without copies.

use crate::time::{RunTime, Span};

/// Largest number of copies (our choice): with thinning, going back costs at most an eighth of the way.
pub const MOST: usize = 16;

/// Copies of a state at instants of a run, evenly spread over the run so far.
#[derive(Clone, Debug)]
pub struct Snapshots<T> {
    /// In order of their instants; never more than [`MOST`].
    kept: Vec<(RunTime, T)>,
    /// At least so far apart; it doubles whenever there would be too many.
    every: Span,
}

impl<T> Snapshots<T> {
    /// None yet; at first they are to be `every` apart.
    pub fn new(every: Span) -> Snapshots<T> {
        Snapshots { kept: Vec::new(), every: every.max(Span::MICROSECOND) }
    }

    /// Keeps a copy of the state that has come to `at`, if it is time for one: it is made only then.
    pub fn keep(&mut self, at: RunTime, copy: impl FnOnce() -> T) {
        if self.kept.len() == MOST && self.is_time(at) {
            self.every = self.every.saturating_mul(2);
            let mut number = 0;
            self.kept.retain(|_| {
                number += 1;
                number % 2 == 1
            });
        }
        if self.is_time(at) {
            self.kept.push((at, copy()));
        }
    }

    fn is_time(&self, at: RunTime) -> bool {
        self.kept.last().is_none_or(|(last, _)| at >= last.saturating_add(self.every))
    }

    /// The latest copy that is not after an instant; `None` if all are.
    pub fn nearest_before(&self, at: RunTime) -> Option<&T> {
        let later = self.kept.partition_point(|(kept, _)| *kept <= at);
        self.kept[..later].last().map(|(_, state)| state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(micros: i64) -> RunTime {
        RunTime::from_micros(micros)
    }

    fn instants(snapshots: &Snapshots<i64>) -> Vec<i64> {
        snapshots.kept.iter().map(|(at, _)| at.micros()).collect()
    }

    #[test]
    fn copies_are_few_and_evenly_spread_however_long_it_is() {
        let mut snapshots = Snapshots::new(Span::from_micros(10));
        let mut made = 0;
        for now in 0..100_000 {
            snapshots.keep(at(now), || {
                made += 1;
                now
            });
            let kept = instants(&snapshots);
            assert!(kept.len() <= MOST && kept[0] == 0);
            let gaps: Vec<i64> = kept.windows(2).map(|pair| pair[1] - pair[0]).collect();
            assert!(gaps.iter().all(|&gap| gap == gaps[0]), "{kept:?}");
            let behind = now - snapshots.nearest_before(at(now)).unwrap();
            assert!(behind <= (now / 8).max(10), "{behind} at {now}");
        }
        assert!(made < 150, "{made} copies were made");
    }

    #[test]
    fn the_nearest_before_is_never_after() {
        let mut snapshots = Snapshots::new(Span::from_micros(10));
        assert_eq!(snapshots.nearest_before(RunTime::MAX), None);
        for now in [5, 14, 15, 30] {
            snapshots.keep(at(now), || now);
        }
        assert_eq!(instants(&snapshots), [5, 15, 30]);
        for (when, nearest) in [(4, None), (5, Some(5)), (14, Some(5)), (15, Some(15)), (29, Some(15)), (999, Some(30))]
        {
            assert_eq!(snapshots.nearest_before(at(when)).copied(), nearest, "{when}");
        }
        // After going back, no copy is made twice.
        snapshots.keep(at(20), || 20);
        assert_eq!(instants(&snapshots), [5, 15, 30]);
    }
}
