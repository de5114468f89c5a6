//! A body that goes everywhere in a home and does everything there, about equally often.
//!
//! Order and hours are random and resemble no habits, so that the counts describe the sensors and not a person.

use homebody_core::drivers::{Driver, Next, Surroundings};
use homebody_core::event::ThingUse;
use homebody_core::home::Home;
use homebody_core::ids::ThingId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_walk::Mesh;
use homebody_walk::body::WalkingBody;
use homebody_walk::manner::Manner;
use homebody_walk::places::{HomePlace, HomePlaces};
use std::collections::VecDeque;
use std::sync::Arc;

/// The activity of resting in the ground truth, as opposed to doing something.
pub(crate) const RESTS: &str = "rests";

/// Probabilities that the body goes out, and that it stands somewhere on the floor (our choice).
const OUT: f64 = 0.1;
const FLOOR: f64 = 0.3;
/// Probability that a thing at a place is used (our choice).
const USES: f64 = 0.6;
/// Medians of the durations of its activities, in seconds, and standard deviations of their logarithms (our choice).
const OUT_S: [f64; 2] = [900.0, 1.0];
const STANDS_S: [f64; 2] = [20.0, 1.2];
const BUSY_S: [f64; 2] = [90.0, 1.2];
const STILL_S: [f64; 2] = [900.0, 1.0];
const AT_THE_DOOR: Span = SECOND.times(5);
const AT_A_LOSS: Span = SECOND.times(10);

#[derive(Clone, Debug)]
pub(crate) struct RandomWalkModel {
    home: Arc<Home>,
    places: Arc<HomePlaces>,
    spots: Vec<HomePlace>,
    body: WalkingBody,
    is_placed: bool,
    /// When the planned segments end.
    until: RunTime,
    planned: VecDeque<Next>,
    stream: Stream,
}

impl RandomWalkModel {
    pub fn new(
        home: Arc<Home>,
        places: Arc<HomePlaces>,
        spots: Vec<HomePlace>,
        mesh: Arc<Mesh>,
        pace_mps: f64,
        seed: u64,
    ) -> RandomWalkModel {
        let body = WalkingBody::new(home.clone(), mesh, pace_mps);
        let stream = Stream::named(seed, "rover");
        let until = RunTime::START;
        RandomWalkModel { home, places, spots, body, is_placed: false, until, planned: VecDeque::new(), stream }
    }

    fn plan(&mut self) {
        let chance = self.stream.unit();
        let door = self.places.for_role(Role::FrontDoor).filter(|spot| spot.is_reachable).cloned();
        match door {
            Some(door) if chance < OUT => self.go_out(&door),
            _ if chance < OUT + FLOOR || self.spots.is_empty() => self.stand(),
            _ => {
                let chosen = self.any(self.spots.len());
                let spot = self.spots[chosen].clone();
                self.stay(&spot);
            }
        }
    }

    fn any(&mut self, count: usize) -> usize {
        ((self.stream.unit() * count as f64) as usize).min(count.saturating_sub(1))
    }

    fn lasts(&mut self, [median_s, spread]: [f64; 2]) -> Span {
        Span::from_seconds(self.stream.lognormal(median_s, spread)).max(SECOND)
    }

    /// Returns false without a way.
    fn go(&mut self, spot: &HomePlace) -> bool {
        if !self.is_placed {
            self.is_placed = true;
            self.body.place(spot.clone(), spot.posture);
            return true;
        }
        const NOON: f64 = 12.0;
        match self.body.go(spot, self.until, NOON, 1.0, &mut self.stream) {
            Some(moves) => {
                moves.into_iter().for_each(|one| self.push(one));
                true
            }
            None => {
                self.hold(MotionState::Rest { at: self.body.at() }, AT_A_LOSS);
                false
            }
        }
    }

    fn push(&mut self, segment: MotionSegment) {
        self.until = segment.end;
        self.body.follow(&segment);
        self.planned.push_back(Next::Segment(segment));
    }

    fn hold(&mut self, doing: MotionState, lasts: Span) {
        let (begin, end) = (self.until, self.until + lasts.max(Span::MICROSECOND));
        let posture = if doing == MotionState::Away { Posture::Standing } else { self.body.posture() };
        self.push(MotionSegment { begin, end, doing, posture });
    }

    fn stir(&mut self, manner: Manner, lasts: Span) {
        let manner = manner.with_numbers(&self.home.numbers);
        let end = self.until + lasts;
        let at = self.body.at();
        let mut moves = true;
        while self.until < end {
            let (doing, span) = match moves {
                true => (MotionState::InPlace { at, amplitude_m: manner.amplitude_m }, manner.bout(&mut self.stream)),
                false => (MotionState::Rest { at }, manner.gap(1.0, &mut self.stream)),
            };
            self.hold(doing, span.min(end - self.until));
            moves = !moves;
        }
    }

    fn uses(&mut self, thing: u32, on: bool) {
        self.planned.push_back(Next::Use(ThingUse { thing: ThingId(thing), on }));
    }

    fn stand(&mut self) {
        let room = self.any(self.home.plan.rooms.len());
        let at = self.body.mesh().free_point(room, &mut self.stream);
        if self.go(&HomePlace::to_stand(at, room)) {
            let lasts = self.lasts(STANDS_S);
            self.stir(Manner::BUSY, lasts);
        }
    }

    fn stay(&mut self, spot: &HomePlace) {
        if !self.go(spot) {
            return;
        }
        let thing = self.places.thing_named(&spot.name).filter(|_| self.stream.chance(USES));
        if let Some(thing) = thing {
            self.uses(thing, true);
        }
        let kinds = 1 + self.any(3);
        for _ in 0..kinds {
            let rests = spot.posture != Posture::Standing && self.stream.chance(0.5);
            self.planned.push_back(Next::Activity(rests.then(|| RESTS.to_owned())));
            let lasts = self.lasts(if rests { STILL_S } else { BUSY_S });
            let manner = self.manner(spot.posture, rests);
            self.stir(manner, lasts);
        }
        self.planned.push_back(Next::Activity(None));
        if let Some(thing) = thing {
            self.uses(thing, false);
        }
    }

    fn manner(&mut self, posture: Posture, rests: bool) -> Manner {
        let of: &[Manner] = match (posture, rests) {
            (Posture::Lying, true) => &[Manner::ASLEEP],
            (Posture::Lying, false) => &[Manner::AWAKE_IN_BED],
            (Posture::Sitting, true) => &[Manner::STILL, Manner::READING],
            (Posture::Sitting, false) => &[Manner::EATING, Manner::TALKING, Manner::ON_TOILET],
            (Posture::Down, _) => &[Manner::FALLEN],
            (Posture::Standing | Posture::Bending | Posture::Kneeling, _) => &[Manner::BUSY, Manner::WASHING],
        };
        of[self.any(of.len())]
    }

    fn go_out(&mut self, door: &HomePlace) {
        if !self.go(door) {
            return;
        }
        let thing = self.places.thing(Role::FrontDoor);
        for goes_out in [true, false] {
            if let Some(thing) = thing {
                self.uses(thing, true);
            }
            self.stir(Manner::BUSY, AT_THE_DOOR);
            if let Some(thing) = thing {
                self.uses(thing, false);
            }
            if goes_out {
                let lasts = self.lasts(OUT_S);
                self.hold(MotionState::Away, lasts);
                self.body.place(door.clone(), Posture::Standing);
            }
        }
    }
}

impl Driver for RandomWalkModel {
    fn next(&mut self, around: &Surroundings) -> Next {
        self.until = self.until.max(around.now());
        loop {
            match self.planned.pop_front() {
                Some(next) => return next,
                None => self.plan(),
            }
        }
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}
