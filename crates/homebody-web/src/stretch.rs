//! How much of a life is lived at once, and in all, where somebody waits for it: what happens in it has to fit into memory, and
//! somebody may do a million things a second.

use homebody_core::event::Events;
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_kit::Cancel;
use std::time::{Duration, Instant};

/// About so many events are held at once (ours).
const EVENTS: usize = 50_000;

/// So long is lived at once without a look at what else there is to do (ours).
const AT_ONCE: Duration = Duration::from_millis(20);

/// The first stretch, in microseconds (ours). Stretches become longer while little happens.
const FIRST: Micros = SECOND / 100;

/// So long is lived for one answer, and so much longer for each day of it (ours): many times what a home takes.
const PATIENCE: Duration = Duration::from_secs(5);
const PATIENCE_A_DAY: Duration = Duration::from_millis(100);

/// So many things are told in one answer (ours).
const MOST_TOLD: usize = 200_000;

/// How much is lived at once: the more happens, and the longer it takes, the less. It changes nothing of what is lived.
#[derive(Clone, Debug)]
pub struct Stretch {
    span: Micros,
    longest: Micros,
}

impl Stretch {
    /// At most so many microseconds at once.
    pub fn new(longest: Micros) -> Stretch {
        Stretch { span: FIRST.min(longest), longest }
    }

    /// Until when a life goes on from here.
    pub fn from(&self, now: Micros) -> Micros {
        now.saturating_add(self.span)
    }

    /// Takes in what happened in the last stretch, and how long it took to live it.
    pub fn brought(&mut self, events: &Events, took: Duration) {
        let count = events.firings.len() + events.facts.len();
        let too_much = (count / EVENTS).max((took.as_micros() / AT_ONCE.as_micros()) as usize);
        if too_much > 0 {
            self.span = (self.span / (too_much + 1) as Micros).max(1);
        } else if count < EVENTS / 4 && took < AT_ONCE / 4 {
            self.span = (self.span * 2).min(self.longest);
        }
    }
}

/// How much is lived for one answer.
pub struct Effort<'c> {
    stretch: Stretch,
    cancel: &'c Cancel,
    begun: Instant,
    /// Where the last stretch begins, and when it did.
    last: (Micros, Instant),
    /// How much has been lived, in microseconds.
    lived: Micros,
}

impl Effort<'_> {
    /// No longer than somebody waits for it, and at most `longest` microseconds at once.
    pub fn new(cancel: &Cancel, longest: Micros) -> Effort<'_> {
        let begun = Instant::now();
        Effort { stretch: Stretch::new(longest), cancel, begun, last: (0, begun), lived: 0 }
    }

    /// Until when a life goes on from here; or why not, in a sentence. `told` is how much the answer tells already.
    pub fn next(&mut self, now: Micros, told: usize) -> Result<Micros, String> {
        let patience = PATIENCE + PATIENCE_A_DAY * u32::try_from(self.lived / DAY).unwrap_or(u32::MAX);
        if self.cancel.is_cancelled() {
            Err("Nobody waits for the rest.".into())
        } else if told > MOST_TOLD {
            Err(format!("More than {MOST_TOLD} things are not told at once."))
        } else if self.begun.elapsed() > patience {
            Err(format!("To come so far has taken {} seconds: too much happens.", patience.as_secs()))
        } else {
            self.last = (now, Instant::now());
            Ok(self.stretch.from(now))
        }
    }

    /// Takes in what happened in the last stretch, which ended at `now`.
    pub fn brought(&mut self, events: &Events, now: Micros) {
        let (begin, since) = self.last;
        self.lived += now - begin;
        self.stretch.brought(events, since.elapsed());
    }
}
