//! Orders to a run from outside: each is applied, or refused.

use super::Simulation;
use super::output::RunOutput;
use crate::error::SimulationError;
use crate::interventions::{InterventionRequest, OrderedIntervention, Refusal, TimedIntervention};
use homebody_core::outside::MOST_INTERVENTIONS;
use homebody_core::problem::Diagnostic;
use homebody_core::time::RunTime;

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
        TooMany error "too-many" ("this run already has {MOST_INTERVENTIONS} orders")
            hint ("write frequent events into routines and the link file");
        /// A run takes one order after the other, and a limited number of them wait.
        Busy error "busy" ("too many commands are waiting for this run")
            hint ("send the command again later");
        /// The broker gets the events of this run in real time, as other programs expect it.
        RealTime error "real-time" ("this broker takes events in real time only")
            hint ("choose at most 1 for \"times\", or add ?allow-fast=true to the URL of the broker");
        /// A run has a range of speeds.
        Speed { times: f64 } error "speed" ("a run cannot go {times} times as fast as the clock")
            hint ("choose 0.1 to 1000 for \"times\"");
    }
}

impl From<OrderMessage> for Refusal {
    fn from(message: OrderMessage) -> Refusal {
        let message = Diagnostic::from(message);
        Refusal::new(message.what, message.hint.unwrap_or_default())
    }
}

impl Simulation {
    /// Applies the requested interventions, once the recording has them.
    pub(super) fn take_orders(&mut self) -> Result<(), SimulationError> {
        let Some(mut output) = self.output.take() else { return Ok(()) };
        let mut done = Vec::new();
        for InterventionRequest { intervention, answer } in self.paced.requests() {
            match self.may_change(&output).and_then(|()| self.apply(intervention, &mut output)) {
                Ok(at) => done.push((answer, at)),
                Err(refusal) => answer(Err(refusal)),
            }
        }
        let RunOutput { log, recording, .. } = &output;
        let noted = match log {
            Some(log) if !done.is_empty() => log.note(recording),
            _ => Ok(()),
        };
        self.output = Some(output);
        noted?;
        done.into_iter().for_each(|(answer, at)| answer(Ok(at)));
        Ok(())
    }

    fn apply(&mut self, intervention: OrderedIntervention, output: &mut RunOutput) -> Result<RunTime, Refusal> {
        let at_us = self.run.now();
        let intervention = intervention.at(at_us, self.scenario.home.numbers());
        self.run.check_intervention(&intervention)?;
        let done = TimedIntervention { at_us, intervention };
        // A resumed run may have later orders that are not repeated yet.
        let orders = &mut output.recording.outside;
        let place = orders.partition_point(|other| other.at_us <= at_us);
        orders.insert(place, done.clone());
        self.run.intervene([done]);
        Ok(at_us)
    }

    /// The part that is stored already cannot change.
    fn may_change(&self, output: &RunOutput) -> Result<(), Refusal> {
        if self.recording.is_complete() {
            return Err(OrderMessage::Replay.into());
        }
        if self.is_over() {
            return Err(OrderMessage::Over.into());
        }
        let is_new = output.log.as_ref().is_none_or(|log| log.is_past_replayed_part());
        if !is_new || self.paced.is_behind(self.run.now()) {
            return Err(OrderMessage::CatchesUp.into());
        }
        if output.recording.outside.len() >= MOST_INTERVENTIONS {
            return Err(OrderMessage::TooMany.into());
        }
        Ok(())
    }
}
