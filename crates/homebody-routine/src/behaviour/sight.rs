//! Polling of the states that rules wait for: things used by others, arrivals, darkness.
//!
//! Only with such rules, long segments are cut into pieces with a look between them.

use super::driver::RoutineDriver;
use super::script::{ActivityStep, Interruptible};
use super::watch::Watches;
use crate::routine::RuleTrigger;
use homebody_core::drivers::{Next, Surroundings};
use homebody_core::ids::ThingId;
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::time::{DAY, HOUR, RunTime, SECOND, Span};

/// Interval at which a person who looks out for something checks (our choice).
const LOOKS: Span = SECOND;

impl RoutineDriver {
    pub(super) fn look(&mut self, around: &Surroundings) {
        if !self.watches.needs_sight() {
            return;
        }
        let things = 0..self.home.plan.things.len() as u32;
        self.sight.on = things.map(|thing| around.is_on(ThingId(thing))).collect();
        let now = around.now();
        self.with_watches(|watches, resident| watches.look(|state| resident.is_so(state, now), now, &resident.life));
    }

    /// Calls the rules that watch, which ask the resident about states.
    pub(super) fn with_watches<T>(&mut self, what: impl FnOnce(&mut Watches, &RoutineDriver) -> T) -> T {
        let mut watches = std::mem::replace(&mut self.watches, Watches::none());
        let result = what(&mut watches, self);
        self.watches = watches;
        result
    }

    pub(super) fn is_so(&self, state: &RuleTrigger, now: RunTime) -> bool {
        let is_on = |thing: &str| {
            let thing = self.places.thing_named(thing);
            thing.is_some_and(|thing| self.sight.on.get(thing as usize).copied().unwrap_or(false))
        };
        match state {
            RuleTrigger::On(thing) | RuleTrigger::Rings(thing) => is_on(thing),
            RuleTrigger::Dark(None) => self.home.is_dark(now),
            RuleTrigger::Dark(Some(room)) => self.home.is_dark(now) && !is_on(room),
            RuleTrigger::At(place) => self.is_at(place),
            RuleTrigger::Company(None) => !self.company.is_alone(),
            RuleTrigger::Company(Some(who)) => {
                self.company.visitor(self.host.index(), who).is_some_and(|visitor| self.company.is_here(visitor))
            }
            RuleTrigger::Alone => self.company.is_alone(),
            RuleTrigger::Sitting => self.body.posture() == Posture::Sitting,
            RuleTrigger::InBed => self.body.posture() == Posture::Lying,
            RuleTrigger::Doing(activity) => self.scripts.iter().any(|playing| playing.label == activity.label()),
            RuleTrigger::Between(from, to) => {
                let time_s = self.hour(now) * 3_600.0;
                if from <= to { (*from..*to).contains(&time_s) } else { time_s >= *from || time_s < *to }
            }
            // Away from home, no rule is answered.
            RuleTrigger::Away | RuleTrigger::Done(_) | RuleTrigger::Follows | RuleTrigger::Wakes => false,
        }
    }

    /// The time of day in hours.
    pub(super) fn hour(&self, now: RunTime) -> f64 {
        (now - self.midnight).rem_euclid(DAY).ratio(HOUR)
    }

    fn is_at(&self, place: &str) -> bool {
        let place = place.to_lowercase();
        let room = self.body.room().map(|room| self.home.plan.rooms[room].name.to_lowercase());
        room.as_ref() == Some(&place) || self.body.spot().is_some_and(|spot| spot.name == place)
    }

    /// The rest of a movement that was cut, unless a rule interrupts it. A movement that others wait behind, such as rising
    /// before a walk, is finished: they begin where it ends.
    pub(super) fn held_back(&mut self, now: RunTime) -> Option<Next> {
        let rest = self.sight.rest.take()?;
        let is_last = self.ready.is_empty() && !matches!(rest.doing, MotionState::Stride { .. });
        let is_due = is_last && self.rules_at() <= now;
        let step = self.scripts.last_mut().and_then(|playing| playing.steps.front_mut());
        if let Some(ActivityStep::Stay(stay) | ActivityStep::Wait(stay)) = step
            && is_due
            && stay.may != Interruptible::Nothing
        {
            stay.left = stay.left.saturating_add(rest.end - now);
            return None;
        }
        Some(self.hold_back(Next::Segment(rest)))
    }

    /// Keeps all but the first piece of a movement for later, if a state is polled.
    pub(super) fn hold_back(&mut self, next: Next) -> Next {
        let Next::Segment(segment) = next else { return next };
        let until = segment.begin.saturating_add(LOOKS);
        if !self.watches.looks() || segment.end <= until || segment.doing == MotionState::Away {
            self.body.follow(&segment);
            return Next::Segment(segment);
        }
        let [first, rest] = segment.split(until);
        self.body.follow(&first);
        self.sight.rest = Some(rest);
        Next::Segment(first)
    }
}
