//! How much of a run is lived at once. What happens in it has to fit into memory, and somebody may do a million things a second.

use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::time::{Micros, SECOND};
use std::time::{Duration, Instant};

/// First stretch of a run, before the number of its events is known (our choice).
const FIRST: Micros = SECOND / 100;

/// Number of firings and facts after which the next stretch is shorter (our choice): they take some megabytes.
const MANY_EVENTS: usize = 20_000;

/// Number of firings and facts after which a stretch ends, whatever drivers decide (our choice): they take some tens of
/// megabytes.
const MOST_EVENTS: usize = 200_000;

/// Lives a run stretch by stretch: the more happens, the shorter they are. It changes nothing of what is lived.
#[derive(Clone, Debug)]
pub struct Stretch {
    span: Micros,
    longest: Micros,
    /// No stretch shall take longer to live than this.
    within: Duration,
}

impl Stretch {
    /// At most so many microseconds at once, however little happens.
    pub fn new(longest: Micros) -> Stretch {
        Stretch { span: FIRST.min(longest), longest, within: Duration::MAX }
    }

    /// The same for who has else to do: a stretch that takes longer to live than `within` is followed by a shorter one.
    pub fn within(self, within: Duration) -> Stretch {
        Stretch { within, ..self }
    }

    /// Lives a stretch, at most until `until`, and adds to `events` what happens in it.
    ///
    /// # Errors
    ///
    /// As [`Run::advance`].
    pub fn live(&mut self, run: &mut Run, until: Micros, events: &mut Events) -> Result<(), DriverError> {
        let (before, begun) = (events.len(), Instant::now());
        let until = until.min(run.now().saturating_add(self.span));
        let lived = run.advance_within(until, before + MOST_EVENTS, events);
        self.brought(events.len() - before, begun.elapsed());
        lived
    }

    /// Takes in how much has happened in the last stretch, and how long it took to live it.
    fn brought(&mut self, events: usize, took: Duration) {
        let too_much = (events / MANY_EVENTS).max((took.as_nanos() / self.within.as_nanos()) as usize);
        if too_much > 0 {
            self.span = (self.span / (too_much + 1) as Micros).max(1);
        } else if events < MANY_EVENTS / 4 && took < self.within / 4 {
            self.span = (self.span * 2).min(self.longest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_grow_while_little_happens_and_shrink_where_much_does_or_it_takes_long() {
        const SOON: Duration = Duration::from_millis(1);
        let mut stretch = Stretch::new(3600 * SECOND).within(20 * SOON);
        let mut after = |times: usize, events, took| {
            (0..times).for_each(|_| stretch.brought(events, took));
            stretch.span
        };
        assert_eq!(after(1, 100, SOON), 2 * FIRST);
        assert_eq!(after(30, 100, SOON), 3600 * SECOND);
        assert_eq!(after(1, MANY_EVENTS * 3 / 4, SOON), 3600 * SECOND);
        assert_eq!(after(1, 100, 10 * SOON), 3600 * SECOND);
        assert_eq!(after(1, MANY_EVENTS, SOON), 1800 * SECOND);
        assert_eq!(after(1, 100, 40 * SOON), 600 * SECOND);
        assert_eq!(after(60, 2 * MANY_EVENTS, SOON), 1, "a run always goes on");
        let mut patient = Stretch::new(3600 * SECOND);
        (0..30).for_each(|_| patient.brought(100, 1000 * SOON));
        assert_eq!(patient.span, 3600 * SECOND, "who has nothing else to do has time");
    }
}
