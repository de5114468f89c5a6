//! The others in the home, as one sees them: which seats are taken, who is in the way, who stands at the door.
//!
//! Everybody is asked one after the other, and whoever has set out for a seat has it: the end of a movement counts as much
//! as where a body is. So no two bodies come to one seat, whoever is asked first.
//!
//! Pets are in nobody's way: people step over them.

use super::places::{Places, Spot};
use homebody_core::drivers::{Body, Surroundings};
use homebody_core::geometry::{self, Point};
use homebody_core::home::plan::Plan;
use homebody_core::ids::{ResidentId, ThingId};
use homebody_core::role::Role;
use homebody_core::scenario::path::Posture;
use std::sync::Arc;

homebody_core::numbers! {
    /// Distance from a seat, a side of a bed or a place to stand within which a person occupies it.
    static TAKEN_M = "company.taken": 0.4, "m", [0.05, 1.5];
    /// Smallest distance to another person who stands, as a share of the sum of both radii.
    static ELBOWS = "company.elbows": 0.8, "1", [0.0, 2.0];
    /// Distance from the door within which a person stands at it.
    static AT_DOOR_M = "company.at_door": 1.5, "m", [0.3, 5.0];
}

/// Who comes no nearer by more than this stands still.
const LEAST_M: f64 = 1e-6;

/// Everybody of a run, as far as it matters to who meets them.
#[derive(Clone, Debug, Default)]
pub struct People {
    /// By resident, visitors last: whether it is a person.
    pub are_people: Vec<bool>,
    /// Who visits, by whom they visit and what the host's routine calls them.
    pub visitors: Vec<(ResidentId, usize, String)>,
    /// How many people live there.
    pub residents: usize,
}

/// Who else is there now.
#[derive(Clone, Debug)]
pub struct Company {
    people: Arc<People>,
    others: Vec<Body>,
    radius_m: f64,
    elbows: f64,
    taken_m: f64,
    at_door_m: f64,
    is_door_open: bool,
}

impl Company {
    pub fn new(people: Arc<People>, radius_m: f64, numbers: &homebody_core::numbers::Numbers) -> Company {
        let [elbows, taken_m, at_door_m] = [&ELBOWS, &TAKEN_M, &AT_DOOR_M].map(|number| numbers.of(number));
        let (others, is_door_open) = (Vec::new(), false);
        Company { people, others, radius_m, elbows, taken_m, at_door_m, is_door_open }
    }

    /// Looks round.
    pub fn look(&mut self, around: &Surroundings, places: &Places) {
        self.others.clear();
        if self.people.are_people.len() < 2 {
            return;
        }
        let is_person = |body: &Body| self.people.are_people.get(body.resident.index()).is_none_or(|&is| is);
        self.others.extend(around.others().filter(is_person));
        self.is_door_open = places.thing(Role::FrontDoor).is_some_and(|thing| around.is_on(ThingId(thing)));
    }

    pub fn is_alone(&self) -> bool {
        self.others.is_empty()
    }

    /// Where the others are.
    pub fn places(&self) -> Vec<Point> {
        self.others.iter().map(|other| other.at).collect()
    }

    /// Whether somebody is at home.
    pub fn is_there(&self, who: ResidentId) -> bool {
        self.others.iter().any(|other| other.resident == who)
    }

    /// Whether somebody is at a place, comes to it or is only just leaving it.
    pub fn is_occupied(&self, at: Point) -> bool {
        self.others.iter().any(|other| nearness(other, at) < self.taken_m)
    }

    /// Whether several people live there, who share beds and sofas.
    pub fn shares_home(&self) -> bool {
        self.people.residents > 1
    }

    /// Whether somebody has the place, or is on the way to it.
    pub fn is_taken(&self, at: Point) -> bool {
        self.others.iter().any(|other| other.to.distance(at) < self.taken_m)
    }

    /// Whether somebody is in a room, or about to be.
    pub fn is_anybody_in(&self, room: usize, plan: &Plan) -> bool {
        self.others.iter().any(|other| plan.room_at(other.to) == Some(room))
    }

    /// Whether somebody who sits or lies would have to be climbed over.
    pub fn sits_between(&self, from: Point, to: Point) -> bool {
        let sits = |other: &&Body| other.posture != Posture::Standing;
        self.others.iter().filter(sits).any(|other| geometry::distance_to_segment(other.at, from, to) < self.taken_m)
    }

    /// Who stands or comes in the way of a step, if anybody does who is not left behind by it. `squeezed`: one goes past as
    /// near as so many times the usual distance.
    pub fn in_the_way(&self, from: Point, to: Point, squeezed: f64) -> Option<&Body> {
        self.others.iter().find(|other| {
            let near = geometry::distance_between_segments((from, to), (other.at, other.to));
            other.posture == Posture::Standing
                && near < self.reach_m(other) * squeezed
                && near < from.distance(other.at) - LEAST_M
        })
    }

    /// Where to step instead so that one passes by who is in the way: to the right before the left.
    pub fn ways_round(&self, other: &Body, from: Point, to: Point, squeezed: f64) -> [Point; 4] {
        /// Factor on the necessary room (our choice): a hand's breadth more.
        const ROOM: f64 = 1.05;
        let ahead = (to - from).normalize_or_zero();
        let reach_m = self.reach_m(other) * squeezed * ROOM;
        [-1.0, 1.0, -1.25, 1.25].map(|sign| {
            let beside = other.to + ahead.perp() * (sign * reach_m);
            beside + ahead * (to - beside).dot(ahead).min(0.0)
        })
    }

    /// Whether nobody is near enough to be touched.
    pub fn has_room(&self, at: Point) -> bool {
        self.others.iter().all(|other| nearness(other, at) > 2.0 * self.reach_m(other))
    }

    fn reach_m(&self, other: &Body) -> f64 {
        (self.radius_m + other.build.radius_m) * self.elbows
    }

    /// Whether somebody is at home.
    pub fn is_here(&self, who: ResidentId) -> bool {
        self.others.iter().any(|other| other.resident == who)
    }

    /// Whether somebody lies on the floor.
    pub fn lies(&self, who: ResidentId) -> bool {
        self.others.iter().any(|other| other.resident == who && other.posture == Posture::Down)
    }

    /// Whether somebody comes by who lies in a room: whoever visits looks for them, whoever lives there has to come in.
    pub fn finds(&self, room: Option<usize>, plan: &Plan) -> bool {
        let visits = |other: &Body| self.people.visitors.iter().any(|(id, ..)| *id == other.resident);
        let comes = |other: &Body| other.posture == Posture::Standing && plan.room_at(other.to) == room;
        self.others.iter().any(|other| visits(other) || comes(other))
    }

    /// Whether somebody stands at the open door to let one in.
    pub fn opens(&self, who: ResidentId, door: &Spot) -> bool {
        let is_at_door = |other: &&Body| other.resident == who && other.at.distance(door.at) < self.at_door_m;
        self.is_door_open && self.others.iter().find(is_at_door).is_some_and(|other| other.posture == Posture::Standing)
    }

    /// Whether somebody else is busy in the kitchen: at a cold breakfast the stove is off.
    pub fn cooks(&self, stove: &Spot) -> bool {
        /// Distance within which things are used to and fro, as stove, sink and counter (our choice).
        const KITCHEN_M: f64 = 3.0;
        let is_cook = |other: &Body| other.posture == Posture::Standing && other.at.distance(stove.at) < KITCHEN_M;
        self.others.iter().any(is_cook)
    }

    /// Who is the visitor of this name to somebody.
    pub fn visitor(&self, host: usize, name: &str) -> Option<ResidentId> {
        let visitor = self.people.visitors.iter().find(|(_, of, called)| *of == host && called == name);
        visitor.map(|(id, ..)| *id)
    }
}

/// How near somebody is to a point, or will be as soon as the present movement ends.
fn nearness(other: &Body, at: Point) -> f64 {
    geometry::distance_to_segment(at, other.at, other.to)
}
