//! How much of a life is lived at once, and in all, where somebody waits for it: what happens in it has to fit into memory, and
//! somebody may do a million things a second.

use homebody_core::event::Events;
use homebody_core::time::{Micros, SECOND};
use homebody_kit::Cancel;

/// About so many events are held at once (ours).
const EVENTS: usize = 50_000;

/// How much is lived first, in microseconds (ours); as much more as nothing happens.
const FIRST: Micros = SECOND / 100;

/// So many events are lived for one answer (ours): some seconds of work, and many times what a home has in a year.
const MOST_EVENTS: usize = 50_000_000;

/// So many things are told in one answer (ours).
pub const MOST_TOLD: usize = 200_000;

/// How much is lived at once: the more happens, the less. It changes nothing of what is lived.
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

    /// This is what came of the last one.
    pub fn brought(&mut self, events: &Events) {
        let count = count(events);
        if count > EVENTS {
            self.span = (self.span / (count / EVENTS + 1) as Micros).max(1);
        } else if count < EVENTS / 4 {
            self.span = (self.span * 2).min(self.longest);
        }
    }
}

/// How much is lived for one answer.
pub struct Effort<'c> {
    pub stretch: Stretch,
    cancel: &'c Cancel,
    events: usize,
}

impl Effort<'_> {
    /// No longer than somebody waits for it, and at most `longest` microseconds at once.
    pub fn new(cancel: &Cancel, longest: Micros) -> Effort<'_> {
        Effort { stretch: Stretch::new(longest), cancel, events: 0 }
    }

    /// This is what came of the last stretch.
    pub fn brought(&mut self, events: &Events) {
        self.stretch.brought(events);
        self.events += count(events);
    }

    /// Why it goes no further, in a sentence; `told` is how much the answer tells already.
    pub fn ends(&self, told: usize) -> Option<String> {
        if self.cancel.is_cancelled() {
            Some("Nobody waits for the rest.".into())
        } else if told > MOST_TOLD {
            Some(format!("It tells of {MOST_TOLD} things and no more."))
        } else if self.events > MOST_EVENTS {
            Some(format!("More than {} million things have happened by then.", MOST_EVENTS / 1_000_000))
        } else {
            None
        }
    }
}

fn count(events: &Events) -> usize {
    events.firings.len() + events.facts.len()
}
