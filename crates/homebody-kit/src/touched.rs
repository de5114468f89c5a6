//! A run that is lived while it is touched from outside: what is asked for is done, or refused.

use crate::error::Error;
use crate::outside::{Asked, FromOutside, Refusal, Wish};
use crate::run::LiveRun;
use homebody_core::outside::MOST_DEEDS;
use homebody_core::recording::Recording;
use homebody_core::time::Micros;
use homebody_log::RunLog;

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
