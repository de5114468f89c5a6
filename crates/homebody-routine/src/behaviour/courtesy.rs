//! Consideration for others: occupied seats, passing on the way, letting guests in and out, waiting for meals.
//!
//! A resident with an occupied seat takes another one, or waits. Two people who meet step aside where there is room, else
//! one waits, and after long enough squeezes past.

use super::body::THERE_M;
use super::driver::RoutineDriver;
use super::manner::Manner;
use super::places::HomePlace;
use super::script::{ActivityStep, Interruptible, StayStep};
use homebody_core::drivers::{Next, PlacedBody};
use homebody_core::geometry::{self, Point};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::role::Role;
use homebody_core::time::{MINUTE, RunTime, SECOND, Span};

/// Wait before the next attempt to pass (our choice).
const PAUSE: Span = Span::from_millis(500);
/// Number of waits for a person who stands, and for a person who walks (our choice).
const PAUSES_FOR_STANDING: u32 = 4;
const PAUSES_FOR_WALKING: u32 = 12;
/// Additional waits for each rank in the scenario's order of residents (our choice): the first one goes first.
const PAUSES_BY_RANK: u32 = 6;
/// Largest number of waits, after which the person turns back for a while (our choice).
const PAUSES_AT_MOST: u32 = 40;
/// Share of the usual distance that is kept from a person who does not move (our choice).
const SQUEEZED: f64 = 0.6;
/// Distance after which a walking person checks the way again (our choice).
const PIECE_M: f64 = 0.6;
/// Time of one wait for a seat or a place, and number of waits (our choice).
const QUEUE: Span = SECOND.times(20);
const MOST_QUEUES: u32 = 60;
/// Interval at which a person who rings checks whether the door opens (our choice).
const RING: Span = SECOND.times(4);

impl RoutineDriver {
    /// Before a stride: steps aside or waits for a person in the way, and leaves an occupied goal.
    pub(super) fn make_way(&mut self, now: RunTime) {
        let here = self.body.at();
        let Some(Next::Segment(segment)) = self.ready.front_mut() else { return };
        let (from, to) = match &mut segment.doing {
            MotionState::Stride { from, to } => (*from, *to),
            // After stepping aside, the person stops there.
            MotionState::InPlace { at, .. } | MotionState::Rest { at } => {
                *at = here;
                return;
            }
            MotionState::Away => return,
        };
        if from != here {
            self.walk_from(here);
        }
        if self.company.is_alone() {
            return;
        }
        let to = self.cut_stride(here, to);
        if let Some(goal) = self.body.spot() {
            if !self.is_free(goal, goal.at) {
                return self.turn_away();
            }
            if goal.at.distance(to) < THERE_M {
                if std::mem::take(&mut self.pushes_through) {
                    return;
                }
                return self.last_steps(now, here, to);
            }
        }
        if self.pushes_through {
            return;
        }
        let Some(other) = self.company.in_the_way(here, to, 1.0).copied() else {
            self.pauses = 0;
            return;
        };
        let patience = if other.at == other.to { PAUSES_FOR_STANDING } else { PAUSES_FOR_WALKING };
        let patience = patience + PAUSES_BY_RANK * self.rank;
        let squeezed = if self.pauses < patience { 1.0 } else { SQUEEZED };
        if let Some(way) = self.way_round(&other, here, to, squeezed) {
            return self.step_to(way);
        }
        self.wait_or_turn_back(now, here);
    }

    /// The last steps to a place: lets a passing person go first, and walks around a standing one.
    fn last_steps(&mut self, now: RunTime, here: Point, to: Point) {
        let Some(other) = self.company.in_the_way(here, to, SQUEEZED).copied() else { return };
        if other.at != other.to {
            if self.pauses < PAUSES_FOR_WALKING {
                self.pauses += 1;
                self.pause(now, here);
            }
        } else if let Some(way) = self.way_round(&other, here, to, SQUEEZED)
            && let Some(Next::Segment(whole)) = self.ready.front().cloned()
            && whole.end - whole.begin > Span::MICROSECOND
        {
            let half = whole.begin + (whole.end - whole.begin) / 2;
            let doing = MotionState::Stride { from: way, to };
            self.ready.insert(1, Next::Segment(MotionSegment { begin: half, doing, ..whole }));
            if let Some(Next::Segment(first)) = self.ready.front_mut() {
                (first.end, first.doing) = (half, MotionState::Stride { from: here, to: way });
            }
        } else {
            self.wait_or_turn_back(now, here);
        }
    }

    fn wait_or_turn_back(&mut self, now: RunTime, here: Point) {
        if self.pauses < PAUSES_AT_MOST {
            self.pauses += 1;
            self.pause(now, here);
        } else {
            self.turn_back();
        }
    }

    fn way_round(&self, other: &PlacedBody, here: Point, to: Point, squeezed: f64) -> Option<Point> {
        let mesh = self.body.mesh();
        let is_open = |&way: &Point| {
            let reaches = [0.5, 1.0].iter().all(|share| mesh.is_free(here + (way - here) * *share));
            reaches && self.company.in_the_way(here, way, squeezed).is_none()
        };
        self.company.ways_round(other, here, to, squeezed).into_iter().find(is_open)
    }

    /// With others at home, a long straight stride is cut, so that the resident looks up every few steps. Returns the end
    /// of the first piece.
    fn cut_stride(&mut self, here: Point, to: Point) -> Point {
        let length_m = here.distance(to);
        let Some(Next::Segment(whole)) = self.ready.front().filter(|_| length_m > PIECE_M * 1.5).cloned() else {
            return to;
        };
        let piece_us = (whole.end - whole.begin).micros() as f64 * PIECE_M / length_m;
        let (at, way) = (whole.begin + Span::from_micros(piece_us as i64), here + (to - here) * (PIECE_M / length_m));
        if at <= whole.begin || whole.end <= at {
            return to;
        }
        let part = |from, to, begin, end| {
            Next::Segment(MotionSegment { begin, end, doing: MotionState::Stride { from, to }, ..whole })
        };
        self.ready.pop_front();
        self.ready.push_front(part(way, to, at, whole.end));
        self.ready.push_front(part(here, way, whole.begin, at));
        way
    }

    /// Moves the start of the next stride here; a longer stride takes longer.
    fn walk_from(&mut self, here: Point) {
        if let Some(Next::Segment(MotionSegment { doing: MotionState::Stride { from, to }, begin, end, .. })) =
            self.ready.front_mut()
        {
            let longer = here.distance(*to) / from.distance(*to).max(0.05);
            *from = here;
            let later = (*end - *begin).share((longer - 1.0).max(0.0));
            *end += later;
            self.delay(1, later);
        }
    }

    /// Changes the goal of the next stride.
    fn step_to(&mut self, way: Point) {
        if let Some(Next::Segment(MotionSegment { doing: MotionState::Stride { from, to }, begin, end, .. })) =
            self.ready.front_mut()
        {
            let longer = from.distance(way) / from.distance(*to).max(0.05);
            *to = way;
            let later = (*end - *begin).share((longer - 1.0).max(0.0));
            *end += later;
            self.delay(1, later);
        }
    }

    fn pause(&mut self, now: RunTime, at: Point) {
        self.delay(0, PAUSE);
        let doing = MotionState::Rest { at };
        let rest = MotionSegment { begin: now, end: now + PAUSE, doing, posture: Posture::Standing };
        self.ready.push_front(Next::Segment(rest));
    }

    /// Delays all movements from this index on.
    fn delay(&mut self, from: usize, by: Span) {
        for next in self.ready.iter_mut().skip(from) {
            if let Next::Segment(segment) = next {
                segment.begin += by;
                segment.end += by;
            }
        }
    }

    /// The goal was occupied on the way: drops the rest of the way and looks for another place.
    fn turn_away(&mut self) {
        self.ready.retain(|next| !matches!(next, Next::Segment(_)));
        if let (Some(goal), Some(playing)) = (self.body.spot().cloned(), self.scripts.last_mut()) {
            playing.steps.push_front(ActivityStep::Go(goal));
        }
    }

    /// No way past: the rest of the way follows later. After turning back too often, the resident pushes through.
    fn turn_back(&mut self) {
        self.pauses = 0;
        self.ready.retain(|next| !matches!(next, Next::Segment(_)));
        let Some(goal) = self.body.spot().cloned() else { return };
        if !self.queue(goal.clone()) {
            self.pushes_through = true;
            if let Some(playing) = self.scripts.last_mut() {
                playing.steps.push_front(ActivityStep::Go(goal));
            }
        }
    }

    /// A free side of the place, or a free substitute; `None` if all are occupied.
    pub(super) fn free_spot(&mut self, spot: HomePlace) -> Option<HomePlace> {
        let of = |spot: &HomePlace| spot.sides_for(self.rank as usize, self.company.shares_home()).collect::<Vec<_>>();
        if let Some(at) = of(&spot).into_iter().find(|&at| self.is_free(&spot, at)) {
            return Some(HomePlace { at, ..spot });
        }
        let others = self.places.substitutes_for(&spot);
        others.into_iter().find_map(|other| {
            let at = of(other).into_iter().find(|&at| self.is_free(other, at))?;
            Some(HomePlace { at, ..other.clone() })
        })
    }

    /// Neither occupied nor blocked by a sitting person; a bathroom is for one at a time.
    fn is_free(&self, spot: &HomePlace, at: Point) -> bool {
        if self.company.is_alone() {
            return true;
        }
        let room = spot.room.filter(|&room| self.places.is_bathroom(room) && self.body.room() != Some(room));
        if self.company.is_taken(at) || room.is_some_and(|room| self.company.is_room_occupied(room, &self.home.plan)) {
            return false;
        }
        let is_seat = spot.posture != Posture::Standing && !spot.sides.is_empty();
        let way = self.body.mesh().approach(at).filter(|_| is_seat);
        way.is_none_or(|way| !self.company.sits_between(way, at))
    }

    /// Waits for an occupied place; false after waiting long enough.
    pub(super) fn queue(&mut self, spot: HomePlace) -> bool {
        self.queues += 1;
        if self.queues > MOST_QUEUES {
            self.queues = 0;
            return false;
        }
        let (posture, here) = (self.body.posture(), self.body.at());
        let waits_elsewhere = self.waiting_place(here);
        let Some(playing) = self.scripts.last_mut() else { return false };
        playing.steps.push_front(ActivityStep::Go(spot));
        let posture = if waits_elsewhere.is_some() { Posture::Standing } else { posture };
        playing.steps.push_front(staying(posture, Manner::STILL, QUEUE));
        if let Some(way) = waits_elsewhere {
            playing.steps.push_front(way);
        }
        true
    }

    /// A free point of the room for a resident who stands too near to another person.
    fn waiting_place(&mut self, here: Point) -> Option<ActivityStep> {
        /// Number of points of the room that are tried (our choice).
        const TRIES: usize = 20;
        if self.company.has_room(here) {
            return None;
        }
        let (mesh, room) = (self.body.mesh().clone(), self.body.room()?);
        let stream = &mut self.scripts.last_mut()?.stream;
        let at = (0..TRIES).map(|_| mesh.free_point(room, stream)).find(|&at| self.company.has_room(at))?;
        Some(ActivityStep::Go(HomePlace::to_stand(at, room)))
    }

    /// The host waits at the door until the visitor is in, or gone, or does not come in time.
    pub(super) fn await_visitor(&mut self, arrival: bool, left: Span) {
        let Some(visitor) = self.guest else { return };
        if self.company.is_here(visitor) == arrival {
            return;
        }
        let aside = if arrival { self.beside_the_door() } else { None };
        let posture = self.body.posture();
        let Some(playing) = self.scripts.last_mut() else { return };
        if left > Span::ZERO {
            if let Some(aside) = aside {
                playing.steps.push_front(ActivityStep::Await { arrival, left });
                playing.steps.push_front(ActivityStep::Go(aside));
                return;
            }
            playing.steps.push_front(ActivityStep::Await { arrival, left: left - RING });
            playing.steps.push_front(staying(posture, Manner::TALKING, RING));
        } else if arrival {
            // The visit is off, so the door is shut again.
            playing.steps.truncate(1);
        }
    }

    /// A place next to the door, for a host who blocks the doorway.
    fn beside_the_door(&self) -> Option<HomePlace> {
        /// Distance from it, in metres (our choice).
        const ASIDE_M: f64 = 0.8;
        let door = self.places.for_role(Role::FrontDoor)?;
        if self.body.at().distance(door.at) > ASIDE_M / 2.0 {
            return None;
        }
        let around = (0..16).map(|part| door.at + geometry::direction(f64::from(part) * 22.5) * ASIDE_M);
        let is_open = |&at: &Point| {
            let mesh = self.body.mesh();
            mesh.is_free(at) && mesh.is_free((at + door.at) / 2.0) && self.home.plan.room_at(at) == door.room
        };
        let at = around.into_iter().find(is_open)?;
        Some(HomePlace::to_stand(at, door.room?))
    }

    /// Waits outside while the doorway is occupied. A visitor also waits for the host to open, and leaves otherwise.
    pub(super) fn ring(&mut self, left: Span, now: RunTime) {
        let is_visitor = self.visitor.is_some();
        // A host who cannot come to the door needs help.
        let has_key = is_visitor && self.company.lies(self.host);
        let may_come_in = |door: &HomePlace| {
            let is_let_in = !is_visitor || has_key || self.company.opens(self.host, door);
            is_let_in && !self.company.is_occupied(door.at)
        };
        let door = self.places.for_role(Role::FrontDoor);
        let comes_in = door.is_none_or(may_come_in);
        let handle = self.places.thing(Role::FrontDoor).filter(|_| has_key && comes_in);
        let Some(playing) = self.scripts.last_mut() else { return };
        if let Some(handle) = handle {
            playing.steps.push_front(ActivityStep::Act(handle, false));
            playing.steps.push_front(ActivityStep::Act(handle, true));
        }
        if comes_in || (!is_visitor && left <= Span::ZERO) {
            return;
        }
        if left <= Span::ZERO {
            // No one opens.
            playing.steps.clear();
            return;
        }
        playing.steps.push_front(ActivityStep::Ring { left: left - RING });
        let doing = MotionState::Away;
        let outside = MotionSegment { begin: now, end: now + RING, doing, posture: Posture::Standing };
        self.ready.push_back(Next::Segment(outside));
    }

    /// Whether the host of a visitor is away.
    pub(super) fn is_host_away(&self) -> bool {
        self.visitor.is_some() && !self.stays_over && !self.company.is_here(self.host)
    }

    /// Waits to eat while another person cooks.
    pub(super) fn await_meal(&mut self, left: Span) {
        let is_cooking = self.places.for_role(Role::Stove).is_some_and(|stove| self.company.cooks(stove));
        if !is_cooking || left <= Span::ZERO {
            return;
        }
        let posture = self.body.posture();
        let Some(playing) = self.scripts.last_mut() else { return };
        playing.steps.push_front(ActivityStep::AwaitMeal { left: left - MINUTE / 3 });
        playing.steps.push_front(staying(posture, Manner::STILL, MINUTE / 3));
    }
}

/// A stay that only rules interrupt.
fn staying(posture: Posture, manner: Manner, left: Span) -> ActivityStep {
    ActivityStep::Stay(StayStep { posture, manner, left, until: None, may: Interruptible::Rules })
}
