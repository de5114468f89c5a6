//! A cat or a dog: it sleeps, roams, eats, and is most active at dawn and dusk.
//!
//! A pet adds movement low above the floor to a log, at hours at which people are still.
//!
//! We assume sleep in bouts of about an hour and a quarter, and between them short rounds to the bowl, to a window or
//! without a goal, and rests. Cats sleep 12 to 16 hours a day and are most active at dawn and dusk; all parameters are our
//! choice.
//!
//! The pet uses the same rooms and routes as people, with a low body that sensors see accordingly.
//!
//! Left out: jumping, playing with people, walks of dogs, and all sentences of a routine about a pet except its pace.

use super::body::WalkingBody;
use super::manner::Manner;
use super::places::{HomePlace, HomePlaces};
use super::resident_routine::ResidentRoutine;
use homebody_core::activity;
use homebody_core::drivers::{Driver, Next, Surroundings};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::numbers::Numbers;
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::time::{DAY, HOUR, RunTime, Span};
use homebody_walk::{WanderStyle, Wanderers};
use std::collections::VecDeque;
use std::sync::Arc;

homebody_core::numbers! {
    /// Probability that a pet sleeps after an activity, at dawn and dusk.
    static SLEEPS_LIVELY = "pet.sleeps_lively": 0.15, "1", [0.0, 1.0];
    /// Probability that a pet sleeps after an activity, at other hours.
    static SLEEPS = "pet.sleeps": 0.35, "1", [0.0, 1.0];
    /// Probability that a pet that does not sleep rests where it is.
    static RESTS = "pet.rests": 0.6, "1", [0.0, 1.0];
    /// Median duration of a pet's sleep.
    static SLEEP_MIN = "pet.sleep": 65.0, "min", [1.0, 600.0];
    /// Median duration of a pet's rest.
    static REST_MIN = "pet.rest": 25.0, "min", [0.1, 600.0];
    /// Median duration of a pet's stop at a place.
    static STOP_MIN = "pet.stop": 3.0, "min", [0.1, 120.0];
    /// Median duration of a pet's round without a goal.
    static ROUND_S = "pet.round": 60.0, "s", [1.0, 3_600.0];
    /// Standard deviation of the logarithm of a pet's durations.
    static SPREAD = "pet.spread": 0.6, "1", [0.0, 2.0];
}

#[derive(Clone, Debug)]
pub struct PetDriver {
    places: Arc<HomePlaces>,
    body: WalkingBody,
    numbers: Numbers,
    stream: Stream,
    ready: VecDeque<Next>,
    /// Manner and end of the current stay.
    stay: Option<(Manner, RunTime)>,
    stirs: bool,
    asleep: bool,
    midnight: RunTime,
}

impl PetDriver {
    pub fn new(life: Arc<ResidentRoutine>, places: Arc<HomePlaces>, mut body: WalkingBody) -> PetDriver {
        if let Some(spot) = places.for_role(Role::Basket) {
            body.place(HomePlace { posture: Posture::Standing, ..spot.clone() }, Posture::Standing);
        }
        let stream = life.stream("pet");
        let (midnight, numbers) = (life.midnight(0), life.numbers.clone());
        PetDriver {
            places,
            body,
            numbers,
            stream,
            ready: VecDeque::new(),
            stay: None,
            stirs: false,
            asleep: true,
            midnight,
        }
    }

    fn step(&mut self, now: RunTime) -> Next {
        loop {
            if let Some(next) = self.ready.pop_front() {
                if let Next::Segment(next) = &next {
                    self.body.follow(next);
                }
                return next;
            }
            match self.stay {
                Some((manner, end)) if now < end => self.stay(manner, end, now),
                _ => self.decide(now),
            }
        }
    }

    fn stay(&mut self, manner: Manner, end: RunTime, now: RunTime) {
        let stirs = self.stirs;
        self.stirs = !stirs;
        let span = if stirs { manner.bout(&mut self.stream) } else { manner.gap(1.0, &mut self.stream) };
        let at = self.body.at();
        let doing =
            if stirs { MotionState::InPlace { at, amplitude_m: manner.amplitude_m } } else { MotionState::Rest { at } };
        let end = end.min(now.saturating_add(span));
        // Curled up, it has the lowest posture. On furniture it does not, because pads and strips would detect it as a
        // person.
        let posture = if self.asleep { Posture::Lying } else { Posture::Standing };
        self.ready.push_back(Next::Segment(MotionSegment { begin: now, end, doing, posture }));
    }

    fn decide(&mut self, now: RunTime) {
        // Hours since the run's first midnight.
        let hour = (now - self.midnight).rem_euclid(DAY).ratio(HOUR);
        let numbers = self.numbers.clone();
        let of = |number| numbers.of(number);
        let lively = (5.0..8.0).contains(&hour) || (18.0..22.0).contains(&hour);
        let sleeps = !self.asleep && self.stream.chance(of(if lively { &SLEEPS_LIVELY } else { &SLEEPS }));
        let rests = !sleeps && !self.asleep && self.stream.chance(of(&RESTS));
        self.asleep = sleeps;
        let name = match (sleeps, rests) {
            (true, _) => activity::SLEEPING,
            (false, true) => activity::RESTING,
            (false, false) => activity::ROAMING,
        };
        let to = match (sleeps, self.stream.unit()) {
            (true, share) if share < 0.4 => self.any(Role::Basket),
            (true, share) if share < 0.7 => self.any(Role::Sofa),
            (true, _) => self.any(Role::Bed),
            (false, _) if rests => self.body.spot().cloned().or_else(|| self.any(Role::Basket)),
            (false, share) if share < 0.3 => self.places.for_role(Role::FoodBowl).cloned(),
            (false, share) if share < 0.7 => {
                let stations = self.places.stations();
                stations.get((self.stream.unit() * stations.len() as f64) as usize).map(|one| one.spot.clone())
            }
            (false, _) => None,
        };
        match to {
            Some(spot) => {
                let spot = HomePlace { posture: Posture::Standing, ..spot };
                let moves = self.body.go(&spot, now, hour, 1.0, &mut self.stream).unwrap_or_default();
                let arrival = moves.last().map_or(now, |last| last.end);
                // On the way to its basket it is awake.
                self.ready.extend((!moves.is_empty()).then(|| Next::Activity(Some(activity::ROAMING.into()))));
                self.ready.extend(moves.into_iter().map(Next::Segment));
                self.ready.push_back(Next::Activity(Some(name.into())));
                let (manner, median_min) = match (sleeps, rests) {
                    (true, _) => (Manner::CURLED_UP, of(&SLEEP_MIN)),
                    (false, true) => (Manner::STILL, of(&REST_MIN)),
                    (false, false) => (Manner::BUSY, of(&STOP_MIN)),
                };
                let lasts = Span::from_seconds(self.stream.lognormal(median_min * 60.0, of(&SPREAD)));
                self.stay = Some((manner.with_numbers(&self.numbers), arrival + lasts));
            }
            None => {
                self.ready.push_back(Next::Activity(Some(name.into())));
                let lasts = Span::from_seconds(self.stream.lognormal(of(&ROUND_S), of(&SPREAD)));
                let moves = self.body.wander(
                    WanderStyle::Random,
                    lasts,
                    now,
                    hour,
                    1.0,
                    Wanderers::default(),
                    &mut self.stream,
                );
                self.ready.extend(moves.into_iter().map(Next::Segment));
                self.stay = None;
            }
        }
        self.stirs = false;
    }

    /// A random place of a role, of any resident.
    fn any(&mut self, role: Role) -> Option<HomePlace> {
        let all = self.places.all_for(role);
        match all.len() {
            0 => self.places.for_role(role).cloned(),
            1 => Some(all[0].clone()),
            many => all.get((self.stream.unit() * many as f64) as usize).map(|&spot| spot.clone()),
        }
    }
}

impl Driver for PetDriver {
    fn next(&mut self, around: &Surroundings) -> Next {
        self.step(around.now())
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}
