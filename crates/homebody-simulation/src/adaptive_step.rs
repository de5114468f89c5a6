//! The size of the steps of a run. The events of a step must fit into memory, and a driver may do a million things a second.

use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::time::{RunTime, Span};
use std::time::{Duration, Instant};

/// First step of a run, before the number of its events is known (our choice).
const FIRST: Span = Span::from_millis(10);

/// Number of firings and facts after which the next step is shorter (our choice): they take some megabytes.
const MANY_EVENTS: usize = 20_000;

/// Number of firings and facts after which a step ends, whatever drivers decide (our choice): they take some tens of
/// megabytes.
const MOST_EVENTS: usize = 200_000;

/// Advances a run step by step: the more events, the shorter the steps. The size of the steps does not change the run.
#[derive(Clone, Debug)]
pub struct AdaptiveStep {
    span: Span,
    longest: Span,
    /// A step should take no more time than this.
    within: Duration,
}

impl AdaptiveStep {
    /// Steps of at most this length.
    pub fn new(longest: Span) -> AdaptiveStep {
        AdaptiveStep { span: FIRST.min(longest), longest, within: Duration::MAX }
    }

    /// The same with a limit of time: a step that takes longer is followed by a shorter one.
    pub fn within(self, within: Duration) -> AdaptiveStep {
        AdaptiveStep { within, ..self }
    }

    /// Advances a run by a step, at most until an instant, and appends its events.
    ///
    /// # Errors
    ///
    /// As [`Run::advance`].
    pub fn advance(&mut self, run: &mut Run, until: RunTime, events: &mut Events) -> Result<(), DriverError> {
        let (before, begun) = (events.len(), Instant::now());
        let until = until.min(run.now().saturating_add(self.span));
        let advanced = run.advance_within(until, before + MOST_EVENTS, events);
        self.adapt(events.len() - before, begun.elapsed());
        advanced
    }

    /// Sets the next step by the number of events of the last one, and by the time that it took.
    fn adapt(&mut self, events: usize, took: Duration) {
        let too_much = (events / MANY_EVENTS).max((took.as_nanos() / self.within.as_nanos()) as usize);
        if too_much > 0 {
            self.span = (self.span / (too_much + 1) as i64).max(Span::MICROSECOND);
        } else if events < MANY_EVENTS / 4 && took < self.within / 4 {
            self.span = (self.span * 2).min(self.longest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{HOUR, MINUTE};

    #[test]
    fn steps_grow_with_few_events_and_shrink_with_many_or_with_slow_ones() {
        const SOON: Duration = Duration::from_millis(1);
        let mut step = AdaptiveStep::new(HOUR).within(20 * SOON);
        let mut after = |times: usize, events, took| {
            (0..times).for_each(|_| step.adapt(events, took));
            step.span
        };
        assert_eq!(after(1, 100, SOON), 2 * FIRST);
        assert_eq!(after(30, 100, SOON), HOUR);
        assert_eq!(after(1, MANY_EVENTS * 3 / 4, SOON), HOUR);
        assert_eq!(after(1, 100, 10 * SOON), HOUR);
        assert_eq!(after(1, MANY_EVENTS, SOON), HOUR / 2);
        assert_eq!(after(1, 100, 40 * SOON), 10 * MINUTE);
        assert_eq!(after(60, 2 * MANY_EVENTS, SOON), Span::MICROSECOND, "a run always advances");
        let mut patient = AdaptiveStep::new(HOUR);
        (0..30).for_each(|_| patient.adapt(100, 1000 * SOON));
        assert_eq!(patient.span, HOUR, "a step without a limit of time ignores its duration");
    }
}
