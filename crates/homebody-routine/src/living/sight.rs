//! What somebody looks out for because a rule waits for it: what others use, who comes, whether it is dark.
//!
//! Where a rule does, what lasts is cut into pieces, and between them one looks. Nobody else pays for it.

use super::driver::RoutineDriver;
use super::script::{Interruptible, Step};
use super::watch::Watches;
use crate::routine::Trigger;
use homebody_core::drivers::{MotionSegment, Next, Surroundings};
use homebody_core::event::MotionState;
use homebody_core::ids::ThingId;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND};

/// Interval at which a person who looks out for something checks (our choice).
const LOOKS: Micros = SECOND;

impl RoutineDriver {
    /// Looks round, where rules need it.
    pub(super) fn look(&mut self, around: &Surroundings) {
        if !self.watches.needs_sight() {
            return;
        }
        let things = 0..self.home.plan.things.len() as u32;
        self.sight.on = things.map(|thing| around.is_on(ThingId(thing))).collect();
        let now = around.now();
        self.with_watches(|watches, resident| watches.look(|state| resident.is_so(state, now), now, &resident.life));
    }

    /// Does something with the rules that watch; they ask the resident what is so.
    pub(super) fn with_watches<T>(&mut self, what: impl FnOnce(&mut Watches, &RoutineDriver) -> T) -> T {
        let mut watches = std::mem::replace(&mut self.watches, Watches::none());
        let result = what(&mut watches, self);
        self.watches = watches;
        result
    }

    /// Whether something is so now.
    pub(super) fn is_so(&self, state: &Trigger, now: Micros) -> bool {
        let is_on = |thing: &str| {
            let thing = self.places.thing_named(thing);
            thing.is_some_and(|thing| self.sight.on.get(thing as usize).copied().unwrap_or(false))
        };
        match state {
            Trigger::On(thing) | Trigger::Rings(thing) => is_on(thing),
            Trigger::Dark(None) => self.home.is_dark(now),
            Trigger::Dark(Some(room)) => self.home.is_dark(now) && !is_on(room),
            Trigger::At(place) => self.is_at(place),
            Trigger::Company(None) => !self.company.is_alone(),
            Trigger::Company(Some(who)) => {
                self.company.visitor(self.host.index(), who).is_some_and(|visitor| self.company.is_there(visitor))
            }
            Trigger::Alone => self.company.is_alone(),
            Trigger::Sitting => self.body.posture() == Posture::Sitting,
            Trigger::InBed => self.body.posture() == Posture::Lying,
            Trigger::Doing(activity) => self.scripts.iter().any(|playing| playing.label == activity.label()),
            Trigger::Between(from, to) => {
                let time_s = self.hour(now) * 3_600.0;
                if from <= to { (*from..*to).contains(&time_s) } else { time_s >= *from || time_s < *to }
            }
            // Who is out answers nothing at home.
            Trigger::Away | Trigger::Done(_) | Trigger::Follows => false,
        }
    }

    fn is_at(&self, place: &str) -> bool {
        let place = place.to_lowercase();
        let room = self.body.room().map(|room| self.home.plan.rooms[room].name.to_lowercase());
        room.as_ref() == Some(&place) || self.body.spot().is_some_and(|spot| spot.name == place)
    }

    /// What is left of a movement that was cut, unless a rule breaks into it.
    pub(super) fn held_back(&mut self, now: Micros) -> Option<Next> {
        let rest = self.sight.rest.take()?;
        let is_due = self.rules_at() <= now && !matches!(rest.doing, MotionState::Stride { .. });
        let step = self.scripts.last_mut().and_then(|playing| playing.steps.front_mut());
        if let Some(Step::Stay(stay)) = step
            && is_due
            && stay.may != Interruptible::Nothing
        {
            stay.left = stay.left.saturating_add(rest.end - now);
            return None;
        }
        Some(self.hold_back(Next::Segment(rest)))
    }

    /// Keeps all but the first piece of a movement for later, where something is looked out for.
    pub(super) fn hold_back(&mut self, next: Next) -> Next {
        let Next::Segment(segment) = next else { return next };
        let until = segment.begin.saturating_add(LOOKS);
        if !self.watches.looks() || segment.end <= until || segment.doing == MotionState::Away {
            self.body.follow(&segment);
            return Next::Segment(segment);
        }
        let first = segment.until(until);
        self.body.follow(&first);
        let doing = match (&segment.doing, &first.doing) {
            (MotionState::Stride { to, .. }, MotionState::Stride { to: here, .. }) => {
                MotionState::Stride { from: *here, to: *to }
            }
            (other, _) => *other,
        };
        self.sight.rest = Some(MotionSegment { begin: until, doing, ..segment });
        Next::Segment(first)
    }
}
