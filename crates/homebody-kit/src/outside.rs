//! What is done to a run from outside while it is lived, by whoever may: a thing is used, a sensor fails, somebody falls.
//!
//! It is done at the instant to which the run has come. Before anything that comes of it is stored, it is in the run's recording:
//! so a run that is lived again, or gone on with, lives the same life.

use crate::error::Error;
use crate::pace::Paced;
use crate::run::LiveRun;
use homebody_core::numbers::Numbers;
pub use homebody_core::outside::{Deed, Failure, FromOutside, Refusal};
use homebody_core::outside::{LIES_MIN, MOST_DEEDS};
use homebody_core::recording::Recording;
use homebody_core::time::{Micros, micros};
use homebody_log::RunLog;

/// What somebody wants to be done now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wish {
    /// A thing is opened, closed, turned on or off.
    Use {
        /// Its name.
        thing: String,
        /// How it is afterwards: open or on, or closed or off.
        on: bool,
    },
    /// A sensor fails from now on.
    Fail {
        /// Its name in the home.
        sensor: String,
        /// How.
        failure: Failure,
        /// For how long, in microseconds; None for the rest of the run.
        lasts: Option<Micros>,
    },
    /// Somebody falls where they are.
    Fall {
        /// Their name.
        resident: String,
        /// How long they lie, in microseconds; None for as long as the number `outside.lies` says.
        lies: Option<Micros>,
    },
}

/// A wish, and who is told what has become of it: when it was done, in microseconds since the run's start, or why not. Whoever is
/// told nothing has asked a run that is over.
pub struct Asked {
    /// What is to be done.
    pub wish: Wish,
    /// It is called on the run's own thread, so it must not wait.
    pub answer: Box<dyn FnOnce(Result<Micros, Refusal>) + Send>,
}

impl Wish {
    /// What is done at an instant.
    fn at(self, now: Micros, numbers: &Numbers) -> Deed {
        match self {
            Wish::Use { thing, on } => Deed::Use { thing, on },
            Wish::Fail { sensor, failure, lasts } => {
                Deed::Fail { sensor, failure, until_us: lasts.map(|lasts| now.saturating_add(lasts)) }
            }
            Wish::Fall { resident, lies } => {
                let usual = || micros(numbers.of(&LIES_MIN) * 60.0);
                Deed::Fall { resident, lies_us: lies.unwrap_or_else(usual) }
            }
        }
    }
}

impl LiveRun {
    /// Does what was asked for, once the recording says so.
    pub(crate) fn hear_outside(&mut self, log: &RunLog, recording: &mut Recording) -> Result<(), Error> {
        let mut done = Vec::new();
        for Asked { wish, answer } in self.paced.asked() {
            match self.may_be_done(log, recording).and_then(|()| self.take_wish(wish, recording)) {
                Ok(at) => done.push((answer, at)),
                Err(refusal) => answer(Err(refusal)),
            }
        }
        if !done.is_empty() {
            log.note(recording)?;
        }
        done.into_iter().for_each(|(answer, at)| answer(Ok(at)));
        Ok(())
    }

    fn take_wish(&mut self, wish: Wish, recording: &mut Recording) -> Result<Micros, Refusal> {
        let at_us = self.run.now();
        let deed = wish.at(at_us, self.scenario.home.numbers());
        self.run.can_be_done(&deed)?;
        let done = FromOutside { at_us, deed };
        // Of a run that is gone on with, what was noted and not lived may come later.
        let place = recording.outside.partition_point(|other| other.at_us <= at_us);
        recording.outside.insert(place, done.clone());
        self.run.from_outside([done]);
        Ok(at_us)
    }

    /// What is stored already is not lived otherwise.
    fn may_be_done(&self, log: &RunLog, recording: &Recording) -> Result<(), Refusal> {
        if self.recording.is_complete() {
            return Err(Refusal::new(
                "this run is a recording that is lived again",
                "give orders to a run that is new",
            ));
        }
        if self.run.now() >= self.run.length() {
            return Err(Refusal::new("the run is over", "begin another"));
        }
        if !log.is_beyond_what_was_there() || self.paced.is_behind(self.run.now()) {
            let why = "the run is lived again up to where it was";
            return Err(Refusal::new(why, "say it again once it has caught up"));
        }
        if recording.outside.len() >= MOST_DEEDS {
            let why = format!("{MOST_DEEDS} things were done to this run already");
            return Err(Refusal::new(why, "write what happens often into routines and the link file"));
        }
        Ok(())
    }
}

/// So much is done between two looks at the clock (ours): what more is asked for waits.
const AT_ONCE: usize = 100;

impl Paced {
    /// What was asked for by now.
    fn asked(&mut self) -> Vec<Asked> {
        self.outside.iter().flat_map(|asked| asked.try_iter()).take(AT_ONCE).collect()
    }
}
