//! The surroundings that a driver gets with each question.
//!
//! It is a view of the run at one instant. Nothing is computed before it is asked for, so a driver that does not look
//! costs nothing.

use crate::geometry::Point;
use crate::ids::{ResidentId, RoomId, ThingId};
use crate::motion::{MotionSegment, MotionState};
use crate::plan::Plan;
use crate::posture::Posture;
use crate::resident::Build;
use crate::time::RunTime;

/// The surroundings of a resident at the instant at which its driver is asked what comes next.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings<'a> {
    now: RunTime,
    resident: ResidentId,
    plan: &'a Plan,
    occupants: &'a [Occupant],
    on: &'a [bool],
}

/// A body in a run: its build and its movement.
#[derive(Clone, Debug, PartialEq)]
pub struct Occupant {
    /// The build of their body.
    pub build: Build,
    /// Of who has not been placed yet, one of no length.
    pub segment: MotionSegment,
}

/// A body in the home at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedBody {
    /// The resident with this body.
    pub resident: ResidentId,
    /// Metres, in the plan's coordinates.
    pub at: Point,
    /// The end of its present movement; the position of a body that stays.
    pub to: Point,
    /// The posture.
    pub posture: Posture,
    /// The build of the body.
    pub build: Build,
}

impl<'a> Surroundings<'a> {
    /// The view of `resident` at `now`. `occupants` are all bodies, by [`ResidentId`]; `on` holds the state of each of
    /// the plan's things, by [`ThingId`]: on or open. A run makes its own; this is for tests of drivers.
    pub fn new(
        now: RunTime,
        resident: ResidentId,
        plan: &'a Plan,
        occupants: &'a [Occupant],
        on: &'a [bool],
    ) -> Surroundings<'a> {
        Surroundings { now, resident, plan, occupants, on }
    }

    /// The instant: the end of the last segment, or the start of the run.
    pub fn now(&self) -> RunTime {
        self.now
    }

    /// The resident of this driver.
    pub fn resident(&self) -> ResidentId {
        self.resident
    }

    /// The plan of the home.
    pub fn plan(&self) -> &'a Plan {
        self.plan
    }

    /// The resident's own body where its last segment has left it; `None` while it is away, or before its first segment.
    pub fn body(&self) -> Option<PlacedBody> {
        self.body_of(self.resident)
    }

    /// The bodies of the others who are at home, in the order of their ids.
    pub fn others(&self) -> impl Iterator<Item = PlacedBody> + use<'a> {
        let Surroundings { resident, occupants, .. } = *self;
        let around = *self;
        let all = (0..occupants.len()).map(ResidentId::new);
        all.filter(move |&other| other != resident).filter_map(move |other| around.body_of(other))
    }

    /// The room that a point is in; `None` between rooms and outside.
    pub fn room_at(&self, at: Point) -> Option<RoomId> {
        self.plan.room_at(at).map(RoomId::new)
    }

    /// Whether a thing is on, or open, now.
    pub fn is_on(&self, thing: ThingId) -> bool {
        self.on.get(thing.index()).is_some_and(|&on| on)
    }

    fn body_of(&self, resident: ResidentId) -> Option<PlacedBody> {
        let Occupant { build, segment } = self.occupants.get(resident.index())?;
        let (at, to) = (segment.position(self.now)?, segment.to()?);
        Some(PlacedBody { resident, at, to, posture: segment.posture, build: *build })
    }
}

impl Occupant {
    /// A body without a place so far.
    pub fn new(build: Build) -> Occupant {
        let segment = MotionSegment {
            begin: RunTime::START,
            end: RunTime::START,
            doing: MotionState::Away,
            posture: Posture::Standing,
        };
        Occupant { build, segment }
    }
}
