//! A run that is lived while it is touched from outside: what is asked for is done, or refused.

use crate::error::Error;
use crate::outside::{Asked, FromOutside, Refusal, Wish};
use crate::run::LiveRun;
use homebody_core::outside::MOST_DEEDS;
use homebody_core::problem::Diagnostic;
use homebody_core::recording::Recording;
use homebody_core::time::Micros;
use homebody_log::RunLog;

homebody_core::messages! {
    /// Refusals of an order to a run.
    pub enum OrderMessage in "order" {
        /// A replay repeats a recording, so nothing can change it.
        Replay error "replay" ("a replay takes no orders")
            hint ("send orders to a new run");
        /// The run has reached its end.
        Over error "over" ("the run is over")
            hint ("start another run");
        /// A resumed run first repeats the part that is already stored, and this part cannot change.
        CatchesUp error "catches-up" ("the run is still repeating its stored part")
            hint ("send the order again when the run has caught up");
        /// A recording contains every order. The limit is our choice.
        TooMany error "too-many" ("this run already has {MOST_DEEDS} orders")
            hint ("write frequent events into routines and the link file");
        /// A run takes one order after the other, and a limited number of them wait.
        Busy error "busy" ("too many commands are waiting for this run")
            hint ("send the command again later");
        /// The broker gets the events of this run in real time, as other programs expect it.
        RealTime error "real-time" ("this broker takes events in real time only")
            hint ("choose at most 1 for \"times\", or add ?allow-fast=true to the URL of the broker");
        /// A run has a range of speeds.
        Speed {
            /// The factor asked for.
            times: f64,
        } error "speed" ("a run cannot go {times} times as fast as the clock")
            hint ("choose 0.1 to 1000 for \"times\"");
    }
}

impl From<OrderMessage> for Refusal {
    fn from(message: OrderMessage) -> Refusal {
        let message = Diagnostic::from(message);
        Refusal::new(message.what, message.hint.unwrap_or_default())
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
            return Err(OrderMessage::Replay.into());
        }
        if self.run.now() >= self.run.length() {
            return Err(OrderMessage::Over.into());
        }
        if !log.is_beyond_what_was_there() || self.paced.is_behind(self.run.now()) {
            return Err(OrderMessage::CatchesUp.into());
        }
        if recording.outside.len() >= MOST_DEEDS {
            return Err(OrderMessage::TooMany.into());
        }
        Ok(())
    }
}
