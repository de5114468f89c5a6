//! Consideration for others: occupied seats, passing on the way, letting guests in and out, waiting for meals.
//!
//! A resident with an occupied seat takes another one, or waits. Two people who meet step aside where there is room, else
//! one waits, and after long enough squeezes past.

use super::body::THERE_M;
use super::current_activity::{BlockedWay, Playing, WalkPurpose};
use super::driver::RoutineDriver;
use super::item::Item;
use super::manner::Manner;
use super::places::HomePlace;
use super::script::{ActivityStep, AwaitedGuest, Interruptible, StayStep};
use crate::routine::Activity;
use homebody_core::activity::VISITING;
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
/// Largest number of waits, after which the person turns back for a while (our choice), and how much earlier those of a higher
/// rank do. Two who meet in a narrow place do not turn back together.
const PAUSES_AT_MOST: u32 = 40;
const EARLIER_BY_RANK: u32 = 7;
const PAUSES_AT_LEAST: u32 = 6;
/// Number of times that a person turns back at a place before they squeeze past the one in the way, some twenty minutes, and
/// before they pass at any distance (our choice). Two who block each other would stand there for ever.
const SQUEEZES_AFTER: u32 = 20;
const PASSES_AFTER: u32 = 30;
/// Share of the usual distance that is then kept (our choice).
const TIGHT: f64 = 0.7;
/// Distance from there within which they pass, and longest time from one turn to the next (our choice).
const PASSING_M: f64 = 2.0;
const TURNS_AGAIN: Span = MINUTE.times(5);
/// Share of the usual distance that is kept from a person who does not move (our choice).
const SQUEEZED: f64 = 0.75;
/// Distance after which a walking person checks the way again (our choice).
const PIECE_M: f64 = 0.6;
/// Time of one wait for a seat or a place (our choice).
const QUEUE: Span = SECOND.times(20);
/// Number of waits after which a person does something else for a while, and number of all waits (our choice): half an hour.
const WAITS_IN_A_ROW: u32 = 3;
const MOST_WAITS: u32 = 24;
/// Duration of something else that a person does (our choice).
const SOMETHING_ELSE: Span = MINUTE.times(3);
/// Distance that a waiting person keeps from places that others use (our choice).
const ASIDE_M: f64 = 0.6;
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
        let goal = self.body.spot();
        if goal.is_some_and(|goal| !self.is_free(goal, goal.at)) {
            return self.turn_away();
        }
        let is_nearly_there = goal.is_some_and(|goal| goal.at.distance(to) < THERE_M);
        if self.blocked.turns >= SQUEEZES_AFTER && self.is_still_blocked(now, here) {
            let passes = self.blocked.turns >= PASSES_AFTER;
            if passes || self.company.in_the_way(here, to, TIGHT).is_none() {
                return;
            }
        }
        if is_nearly_there {
            return self.last_steps(now, here, to);
        }
        let Some(other) = self.company.in_the_way(here, to, 1.0).copied() else {
            self.blocked.pauses = 0;
            return;
        };
        let patience = if other.at == other.to { PAUSES_FOR_STANDING } else { PAUSES_FOR_WALKING };
        let patience = patience + PAUSES_BY_RANK * self.rank;
        let squeezed = if self.blocked.pauses < patience { 1.0 } else { SQUEEZED };
        if let Some(way) = self.way_round(&other, here, to, squeezed) {
            return self.step_to(way);
        }
        self.wait_or_turn_back(now, here);
    }

    /// The last steps to a place: lets a passing person go first, and walks around a standing one.
    fn last_steps(&mut self, now: RunTime, here: Point, to: Point) {
        let Some(other) = self.company.in_the_way(here, to, SQUEEZED).copied() else { return };
        if other.at != other.to {
            self.wait_or_turn_back(now, here);
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
        let most = PAUSES_AT_MOST.saturating_sub(EARLIER_BY_RANK * self.rank).max(PAUSES_AT_LEAST);
        if self.blocked.pauses < most {
            self.blocked.pauses += 1;
            self.pause(now, here);
        } else {
            self.turn_back(now);
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

    /// No way past: the rest of the way follows later.
    fn turn_back(&mut self, now: RunTime) {
        let here = self.body.at();
        let turns = if self.is_still_blocked(now, here) { self.blocked.turns + 1 } else { 1 };
        self.blocked = BlockedWay { pauses: 0, turns, turned: now, at: here };
        self.ready.retain(|next| !matches!(next, Next::Segment(_)));
        if let Some(goal) = self.body.spot().cloned() {
            self.wait_for(goal, now);
        }
    }

    fn is_still_blocked(&self, now: RunTime, here: Point) -> bool {
        self.blocked.at.distance(here) < PASSING_M && now < self.blocked.turned.saturating_add(TURNS_AGAIN)
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
        let is_exclusive = |room: usize| self.places.is_bathroom(room) && self.body.room() != Some(room);
        let room = spot.room.filter(|&room| is_exclusive(room) && !self.stay.helps);
        if self.company.is_taken(at) || room.is_some_and(|room| self.company.is_room_occupied(room, &self.home.plan)) {
            return false;
        }
        let is_seat = spot.posture != Posture::Standing && !spot.sides.is_empty();
        let way = self.body.mesh().approach(at).filter(|_| is_seat);
        way.is_none_or(|way| !self.company.sits_between(way, at))
    }

    /// Waits for an occupied place: first stands aside, then does something else in between. Gives up after long enough.
    pub(super) fn wait_for(&mut self, spot: HomePlace, now: RunTime) {
        let Some(playing) = self.scripts.last_mut() else { return };
        // A place to step aside to is only one of many.
        if matches!(playing.steps.front(), Some(ActivityStep::Wait(_))) {
            return;
        }
        playing.waits += 1;
        if playing.waits > MOST_WAITS || playing.is_in_between {
            playing.waits = 0;
            return self.give_up(true, now);
        }
        if self.does_next_first(&spot) {
            return;
        }
        let Some(playing) = self.scripts.last_mut() else { return };
        let has_waited = playing.waits.is_multiple_of(WAITS_IN_A_ROW);
        if has_waited && playing.does_without_place() {
            return;
        }
        playing.steps.push_front(ActivityStep::Go(spot));
        self.wait_here_or_do_something(has_waited);
    }

    /// A wait, or, from time to time, something else that leaves no running water and no food on the stove.
    fn wait_here_or_do_something(&mut self, has_waited: bool) {
        let Some(playing) = self.scripts.last() else { return };
        let is_in_use = playing
            .steps
            .iter()
            .any(|step| matches!(step, ActivityStep::Act(thing, false) if self.watches.is_on(*thing)));
        let can_leave = !is_in_use && self.visitor.is_none() && !playing.is_in_between;
        let is_in_bed = self.body.posture() == Posture::Lying;
        if has_waited && can_leave {
            let key = format!("{SOMETHING}{}", self.times(&Activity::Other(SOMETHING.into())));
            self.begin(&Item::now(key, if is_in_bed { Activity::LieAwake } else { Activity::Relax }, SOMETHING_ELSE));
            let below = self.scripts.len().checked_sub(2).and_then(|index| self.scripts.get_mut(index));
            if let Some(below) = below {
                below.spot = None;
            }
            if let Some(playing) = self.scripts.last_mut() {
                (playing.is_in_between, playing.hears_the_bell) = (true, true);
                for step in &mut playing.steps {
                    if let ActivityStep::Stay(stay) = step {
                        stay.may = Interruptible::Rules;
                    }
                }
            }
            return;
        }
        let aside = self.place_aside();
        let posture = if aside.is_some() { Posture::Standing } else { self.body.posture() };
        let Some(playing) = self.scripts.last_mut() else { return };
        let wait = StayStep { posture, manner: Manner::STILL, left: QUEUE, until: None, may: Interruptible::Rules };
        playing.steps.push_front(ActivityStep::Wait(wait));
        if let Some(aside) = aside {
            playing.steps.push_front(ActivityStep::Go(aside));
        }
    }

    /// Of two places of one activity, such as sink and counter, takes the free one first.
    fn does_next_first(&mut self, spot: &HomePlace) -> bool {
        let Some(playing) = self.scripts.last() else { return false };
        if playing.walks != WalkPurpose::Cooking {
            return false;
        }
        let ways = playing.steps.iter().enumerate().filter(|(_, step)| matches!(step, ActivityStep::Go(_)));
        let ways: Vec<usize> = ways.map(|(index, _)| index).take(2).collect();
        let Some(&next) = ways.first() else { return false };
        let end = ways.get(1).copied().unwrap_or(playing.steps.len());
        let Some(ActivityStep::Go(other)) = playing.steps.get(next).cloned() else { return false };
        let turned = |from: usize, to: usize, wanted: bool| {
            playing.steps.range(from..to).filter_map(move |step| match step {
                ActivityStep::Act(thing, on) if *on == wanted => Some(*thing),
                _ => None,
            })
        };
        let belong = turned(0, next, true).any(|thing| turned(next, end, false).any(|other| other == thing));
        let only_moves =
            |step: &ActivityStep| matches!(step, ActivityStep::Act(..) | ActivityStep::Stay(_) | ActivityStep::Go(_));
        if belong || !playing.steps.range(..end).all(only_moves) || self.free_spot(other).is_none() {
            return false;
        }
        let Some(playing) = self.scripts.last_mut() else { return false };
        let blocked: Vec<ActivityStep> =
            [ActivityStep::Go(spot.clone())].into_iter().chain(playing.steps.drain(..next)).collect();
        for (index, step) in blocked.into_iter().enumerate() {
            playing.steps.insert(end - next + index, step);
        }
        true
    }

    /// A free point for a person who stands too near to another, or where others want to be; in the room, else in another.
    fn place_aside(&mut self) -> Option<HomePlace> {
        /// Number of points of a room, and of rooms, that are tried (our choice).
        const TRIES: usize = 20;
        const ROOMS: usize = 4;
        let (here, own) = (self.body.at(), self.body.room()?);
        let used = self.places.all().iter().filter(|spot| spot.posture == Posture::Standing && !spot.is_room);
        let used: Vec<Point> = used.map(|spot| spot.at).collect();
        let is_aside = |at: Point| self.company.has_room(at) && used.iter().all(|used| used.distance(at) > ASIDE_M);
        if self.body.posture() != Posture::Standing || is_aside(here) {
            return None;
        }
        let (mesh, plan) = (self.body.mesh().clone(), &self.home.plan);
        let mut rooms: Vec<(usize, Point)> = self
            .places
            .all()
            .iter()
            .filter(|spot| spot.is_room && spot.is_reachable)
            .filter_map(|spot| Some((spot.room?, spot.at)))
            .filter(|(room, _)| *room != own && !self.places.is_bathroom(*room))
            .collect();
        rooms.sort_by(|a, b| a.1.distance(here).total_cmp(&b.1.distance(here)));
        let stream = &mut self.scripts.last_mut()?.stream;
        for room in [own].into_iter().chain(rooms.into_iter().map(|(room, _)| room).take(ROOMS)) {
            let free = (0..TRIES)
                .map(|_| mesh.free_point(room, stream))
                .filter(|&at| is_aside(at) && plan.room_at(at) == Some(room));
            if let Some(at) = free.min_by(|a, b| a.distance(here).total_cmp(&b.distance(here))) {
                return Some(HomePlace::to_stand(at, room));
            }
        }
        None
    }

    /// The host waits at the door until the visitor is in, at the door or gone, or does not come in time.
    pub(super) fn await_visitor(&mut self, awaited: AwaitedGuest, left: Span) {
        let guest = self.scripts.last().and_then(|playing| playing.guest);
        let door = self.places.for_role(Role::FrontDoor);
        let is_at_door = |who| door.is_none_or(|door| self.company.is_at_door(who, door));
        let is_there = |who| match awaited {
            AwaitedGuest::In => self.company.is_here(who),
            AwaitedGuest::AtDoor => !self.company.is_here(who) || is_at_door(who),
            AwaitedGuest::Out => !self.company.is_here(who),
        };
        if guest.is_none_or(|guest| is_there(guest.who)) {
            return;
        }
        let posture = self.body.posture();
        let Some(playing) = self.scripts.last_mut() else { return };
        if left > Span::ZERO {
            playing.steps.push_front(ActivityStep::Await { guest: awaited, left: left - RING });
            playing.steps.push_front(staying(posture, Manner::TALKING, RING));
        } else if awaited == AwaitedGuest::In {
            // The visit is off, so the door is shut again.
            playing.steps.truncate(1);
        }
    }

    /// A place next to the door, for a host who leaves the doorway to a visitor.
    pub(super) fn beside_the_door(&self) -> Option<HomePlace> {
        /// Distance from it, in metres (our choice).
        const ASIDE_M: f64 = 0.8;
        let door = self.places.for_role(Role::FrontDoor)?;
        let around = (0..16).map(|part| door.at + geometry::direction(f64::from(part) * 22.5) * ASIDE_M);
        let is_open = |&at: &Point| {
            let mesh = self.body.mesh();
            mesh.is_free(at) && mesh.is_free((at + door.at) / 2.0) && self.home.plan.room_at(at) == door.room
        };
        // Out of the way of the visitor, which leads to a seat.
        let seat = self.places.for_role(Role::GuestSeat).and_then(|seat| self.body.mesh().path(door.at, seat.at));
        let way: Vec<Point> = std::iter::once(door.at).chain(seat.into_iter().flatten()).collect();
        let clear_m = |at: &Point| {
            let parts = way.windows(2).map(|part| geometry::distance_to_segment(*at, part[0], part[1]));
            parts.fold(f64::INFINITY, f64::min)
        };
        let open = around.into_iter().filter(is_open);
        let at = open.min_by(|one, other| clear_m(other).total_cmp(&clear_m(one)))?;
        Some(HomePlace::to_stand(at, door.room?))
    }

    /// Waits outside while the doorway is occupied. A visitor also waits for the host to open, and leaves otherwise.
    pub(super) fn ring(&mut self, left: Span, now: RunTime) {
        let is_visitor = self.visitor.is_some();
        let has_key = self.opens_the_door();
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
            playing.steps.push_front(staying(Posture::Standing, Manner::BUSY, RING));
            playing.steps.push_front(ActivityStep::Act(handle, true));
            playing.steps.push_front(ActivityStep::Name(VISITING.into()));
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

    /// Waits to eat while another person cooks.
    pub(super) fn await_meal(&mut self, left: Span) {
        let is_cooking = self.places.for_role(Role::Stove).is_some_and(|stove| self.company.cooks(stove));
        if !is_cooking || left <= Span::ZERO {
            return;
        }
        let Some(playing) = self.scripts.last_mut() else { return };
        playing.waits += 1;
        let has_waited = playing.waits.is_multiple_of(WAITS_IN_A_ROW);
        let lasts = if has_waited { SOMETHING_ELSE } else { QUEUE };
        playing.steps.push_front(ActivityStep::AwaitMeal { left: left - lasts });
        self.wait_here_or_do_something(has_waited);
    }

    /// Whether another person has turned a thing on or off already.
    pub(super) fn is_done_by_other(&self, thing: u32, on: bool) -> bool {
        self.places.thing(Role::FrontDoor) == Some(thing) && self.company.is_door(on)
    }
}

impl Playing {
    /// Leaves out an occupied place of an activity that has begun, such as the washbasin after a shower, unless a thing stays on or
    /// the activity ends there.
    fn does_without_place(&mut self) -> bool {
        let next = self.steps.iter().position(|step| matches!(step, ActivityStep::Go(_))).unwrap_or(self.steps.len());
        let is_plain = |step: &ActivityStep| matches!(step, ActivityStep::Act(..) | ActivityStep::Stay(_));
        let turned = |on: bool| {
            self.steps.range(..next).filter(move |step| matches!(step, ActivityStep::Act(_, is) if *is == on)).count()
        };
        let can = self.is_there && self.steps.range(..next).all(is_plain) && turned(true) == turned(false);
        if can {
            self.steps.drain(..next);
        }
        can
    }
}

/// The key of what fills a wait.
const SOMETHING: &str = "in between/";

/// A stay that only rules interrupt.
fn staying(posture: Posture, manner: Manner, left: Span) -> ActivityStep {
    ActivityStep::Stay(StayStep { posture, manner, left, until: None, may: Interruptible::Nothing })
}
