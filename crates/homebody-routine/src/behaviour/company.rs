//! The other residents as one resident sees them: occupied seats, people in the way, people at the door.
//!
//! Residents decide one after the other, and one on the way to a seat already has it: the end of a movement counts as much
//! as the place of a body. So two bodies never go to one seat, whatever the order.
//!
//! Pets block no one: people step over them.

use super::places::{HomePlace, HomePlaces};
use homebody_core::drivers::{PlacedBody, Surroundings};
use homebody_core::geometry::{self, Point};
use homebody_core::ids::{ResidentId, ThingId};
use homebody_core::plan::Plan;
use homebody_core::posture::Posture;
use homebody_core::role::Role;
use std::sync::Arc;

homebody_core::numbers! {
    /// Distance from a seat, a side of a bed or a place to stand within which a person occupies it.
    static TAKEN_M = "company.taken": 0.45, "m", [0.05, 1.5];
    /// Smallest distance to another person who stands, as a share of the sum of both radii.
    static ELBOWS = "company.elbows": 1.0, "1", [0.0, 2.0];
    /// Distance from the door within which a person stands at it.
    static AT_DOOR_M = "company.at_door": 1.5, "m", [0.3, 5.0];
}

/// A smaller approach counts as standing still.
const LEAST_M: f64 = 1e-6;

#[derive(Clone, Debug, Default)]
pub struct HouseholdMembers {
    /// By resident, visitors last; false for pets.
    pub are_people: Vec<bool>,
    /// Id of the visitor, index of the host, and the name in the host's routine.
    pub visitors: Vec<(ResidentId, usize, String)>,
    /// Number of people, without visitors.
    pub residents: usize,
}

#[derive(Clone, Debug)]
pub struct Company {
    people: Arc<HouseholdMembers>,
    others: Vec<PlacedBody>,
    radius_m: f64,
    elbows: f64,
    taken_m: f64,
    at_door_m: f64,
    /// `None` in a household of one person without visitors.
    is_door_open: Option<bool>,
}

impl Company {
    pub fn new(people: Arc<HouseholdMembers>, radius_m: f64, numbers: &homebody_core::numbers::Numbers) -> Company {
        let [elbows, taken_m, at_door_m] = [&ELBOWS, &TAKEN_M, &AT_DOOR_M].map(|number| numbers.of(number));
        let (others, is_door_open) = (Vec::new(), None);
        Company { people, others, radius_m, elbows, taken_m, at_door_m, is_door_open }
    }

    pub fn look(&mut self, around: &Surroundings, places: &HomePlaces) {
        self.others.clear();
        if self.people.are_people.len() < 2 {
            return;
        }
        let is_person = |body: &PlacedBody| self.people.are_people.get(body.resident.index()).is_none_or(|&is| is);
        self.others.extend(around.others().filter(is_person));
        self.is_door_open = places.thing(Role::FrontDoor).map(|thing| around.is_on(ThingId(thing)));
    }

    pub fn has_visitors(&self) -> bool {
        !self.people.visitors.is_empty()
    }

    /// Whether the front door is open (true) or shut (false), as far as others may have left it so.
    pub fn is_door(&self, open: bool) -> bool {
        self.is_door_open == Some(open)
    }

    pub fn body(&self, who: ResidentId) -> Option<&PlacedBody> {
        self.others.iter().find(|other| other.resident == who)
    }

    /// Whether a person sits at a place.
    pub fn sits_at(&self, who: ResidentId, place: &HomePlace) -> bool {
        let sits = |other: &PlacedBody| {
            let seats = [place.at].into_iter().chain(place.sides.iter().copied());
            other.posture == Posture::Sitting && seats.into_iter().any(|at| at.distance(other.at) < self.taken_m)
        };
        self.body(who).is_some_and(sits)
    }

    pub fn is_at_door(&self, who: ResidentId, door: &HomePlace) -> bool {
        self.body(who).is_some_and(|other| other.at.distance(door.at) < self.at_door_m)
    }

    pub fn is_alone(&self) -> bool {
        self.others.is_empty()
    }

    pub fn places(&self) -> Vec<Point> {
        self.others.iter().map(|other| other.at).collect()
    }

    /// Occupied, or the end or start of a current movement.
    pub fn is_occupied(&self, at: Point) -> bool {
        self.others.iter().any(|other| nearness(other, at) < self.taken_m)
    }

    pub fn shares_home(&self) -> bool {
        self.people.residents > 1
    }

    /// Occupied, or the goal of a movement.
    pub fn is_taken(&self, at: Point) -> bool {
        self.others.iter().any(|other| other.to.distance(at) < self.taken_m)
    }

    /// In a room, or on the way into it.
    pub fn is_room_occupied(&self, room: usize, plan: &Plan) -> bool {
        self.others.iter().any(|other| plan.room_at(other.to) == Some(room))
    }

    /// Whether a sitting or lying person would have to be climbed over.
    pub fn sits_between(&self, from: Point, to: Point) -> bool {
        let sits = |other: &&PlacedBody| other.posture != Posture::Standing;
        self.others.iter().filter(sits).any(|other| geometry::distance_to_segment(other.at, from, to) < self.taken_m)
    }

    /// The person in the way of a step, unless the step leads away from them. `squeezed` is a factor on the usual distance.
    pub fn in_the_way(&self, from: Point, to: Point, squeezed: f64) -> Option<&PlacedBody> {
        self.others.iter().find(|other| {
            let near = geometry::distance_between_segments((from, to), (other.at, other.to));
            other.posture == Posture::Standing
                && near < self.reach_m(other) * squeezed
                && near < from.distance(other.at) - LEAST_M
        })
    }

    /// Steps around a person in the way: to the right first.
    pub fn ways_round(&self, other: &PlacedBody, from: Point, to: Point, squeezed: f64) -> [Point; 4] {
        /// Factor on the necessary room (our choice): a hand's breadth more.
        const ROOM: f64 = 1.05;
        let ahead = (to - from).normalize_or_zero();
        let reach_m = self.reach_m(other) * squeezed * ROOM;
        [-1.0, 1.0, -1.25, 1.25].map(|sign| {
            let beside = other.to + ahead.perp() * (sign * reach_m);
            beside + ahead * (to - beside).dot(ahead).min(0.0)
        })
    }

    pub fn has_room(&self, at: Point) -> bool {
        /// Factor on the distance that people in passing keep (our choice).
        const ROOM: f64 = 1.6;
        self.others.iter().all(|other| nearness(other, at) > ROOM * self.reach_m(other))
    }

    fn reach_m(&self, other: &PlacedBody) -> f64 {
        (self.radius_m + other.build.radius_m) * self.elbows
    }

    pub fn is_here(&self, who: ResidentId) -> bool {
        self.others.iter().any(|other| other.resident == who)
    }

    pub fn lies(&self, who: ResidentId) -> bool {
        self.others.iter().any(|other| other.resident == who && other.posture == Posture::Down)
    }

    /// Whether a person finds the resident on the floor of a room: visitors look for them, residents have to come in.
    pub fn finds(&self, room: Option<usize>, plan: &Plan) -> bool {
        let visits = |other: &PlacedBody| self.people.visitors.iter().any(|(id, ..)| *id == other.resident);
        let comes = |other: &PlacedBody| other.posture == Posture::Standing && plan.room_at(other.to) == room;
        self.others.iter().any(|other| visits(other) || comes(other))
    }

    /// Whether a person stands at the open door to let the visitor in.
    pub fn opens(&self, who: ResidentId, door: &HomePlace) -> bool {
        let is_standing = self.body(who).is_some_and(|other| other.posture == Posture::Standing);
        self.is_door(true) && is_standing && self.is_at_door(who, door)
    }

    /// Whether another person is busy at the stove, because a cold breakfast uses none.
    pub fn cooks(&self, stove: &HomePlace) -> bool {
        /// Distance within which things are used to and fro, as stove, sink and counter (our choice).
        const KITCHEN_M: f64 = 3.0;
        let is_cook =
            |other: &PlacedBody| other.posture == Posture::Standing && other.at.distance(stove.at) < KITCHEN_M;
        self.others.iter().any(is_cook)
    }

    pub fn visitor(&self, host: usize, name: &str) -> Option<ResidentId> {
        let visitor = self.people.visitors.iter().find(|(_, of, called)| *of == host && called == name);
        visitor.map(|(id, ..)| *id)
    }
}

/// Smallest distance now or at the end of the current movement.
fn nearness(other: &PlacedBody, at: Point) -> f64 {
    geometry::distance_to_segment(at, other.at, other.to)
}
