//! Falls: those of the routine, and those caused from outside.
//!
//! A stated fall follows walking, rising, sitting or lying, and ends there or next to the seat or bed; a person who
//! sinks down goes through the knees. Then the resident lies for a while, until found, or until they have crawled to
//! the telephone.
//!
//! An unplanned fall interrupts like a need. A walking or standing resident falls on the spot; a sitting or lying one
//! gets up first, and falls next to the chair or bed. Afterwards the activity continues.
//!
//! We assume that a visitor who comes while the host lies on the floor has a key, and that a found resident is helped up.
//!
//! Left out: ambulances, and days in hospital.

use super::driver::RoutineDriver;
use super::item::Item;
use super::manner::Manner;
use super::places::HomePlace;
use super::script::{ActivitySetting, ActivityStep, Interruptible, StayStep, script};
use crate::routine::{Activity, FallEnds, Falling, FallsFrom};
use homebody_core::activity::FALLEN;
use homebody_core::drivers::{Next, Surroundings};
use homebody_core::geometry::Point;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::role::Role;
use homebody_core::time::{DAY, MINUTE, RunTime, SECOND, Span};
use homebody_walk::{Gait, walk};
use std::collections::VecDeque;

/// Time to get up from the floor (our choice).
const GETS_UP: Span = MINUTE;

/// Time that a person sits or lies before a fall from there (our choice).
const BEFORE: Span = MINUTE;

/// Time on the knees of a person who sinks down (our choice).
const ON_KNEES: Span = SECOND.times(5);

/// Time after which a person who is not found gets up in any case (our choice).
const LONGEST: Span = DAY;

/// Interval at which a person on the floor looks round for others (our choice).
const LOOKS: Span = SECOND.times(20);

/// Duration of a call for help, and time until help arrives (our choice).
const CALLS: Span = MINUTE.times(3);
const HELP_COMES: Span = MINUTE.times(15);

/// Speed of crawling along the floor, of falling out of bed, and of sliding out of it, in metres a second (our choice).
const CRAWLS_MPS: f64 = 0.15;
const DROPS_MPS: f64 = 0.8;
const SLIDES_MPS: f64 = 0.25;

impl RoutineDriver {
    pub(super) fn fall_steps(
        &self,
        item: &Item,
        place: Option<&HomePlace>,
        setting: &mut ActivitySetting,
    ) -> VecDeque<ActivityStep> {
        let falling = item.falling.unwrap_or_default();
        let mut steps = self.before_fall(&falling, place, setting);
        if falling.slowly && !matches!(falling.from, FallsFrom::Seat | FallsFrom::Bed) {
            steps.push_back(stay(Posture::Kneeling, Manner::TURNING, ON_KNEES));
        }
        match falling.ends {
            FallEnds::Rises => steps.push_back(stay(Posture::Down, Manner::FALLEN, item.lasts)),
            FallEnds::Found => {
                steps.push_back(ActivityStep::LieUntilFound { left: LONGEST });
                steps.push_back(stay(Posture::Down, Manner::TURNING, MINUTE));
            }
            FallEnds::Phone => {
                steps.push_back(stay(Posture::Down, Manner::FALLEN, item.lasts));
                let telephone = self.places.for_role(Role::Telephone).and_then(|spot| self.beside(spot));
                steps.extend(telephone.map(|to| ActivityStep::AlongFloor { to: to.at, mps: CRAWLS_MPS }));
                steps.push_back(stay(Posture::Down, Manner::TALKING, CALLS));
                steps.push_back(stay(Posture::Down, Manner::FALLEN, HELP_COMES));
            }
        }
        steps.push_back(stay(Posture::Kneeling, Manner::TURNING, GETS_UP));
        if falling.from == FallsFrom::WayToToilet {
            steps.extend(script(&Activity::UseBathroom, None, 5 * MINUTE, None, setting));
        }
        steps
    }

    /// The steps up to the fall, which the ground truth then reports.
    fn before_fall(
        &self,
        falling: &Falling,
        place: Option<&HomePlace>,
        setting: &mut ActivitySetting,
    ) -> VecDeque<ActivityStep> {
        let is_seat = |spot: &&HomePlace| spot.posture != Posture::Standing;
        let seat = place.filter(is_seat).or_else(|| match falling.from {
            FallsFrom::Bed => self.places.for_role(Role::Bed),
            _ => self.places.for_role(Role::Armchair),
        });
        let name = ActivityStep::Name(FALLEN.into());
        let beside = seat.and_then(|seat| self.beside(seat));
        match (falling.from, seat, beside) {
            (FallsFrom::WayToToilet, ..) => {
                let to = self.way_to_toilet(setting);
                to.map(ActivityStep::Go).into_iter().chain([name]).collect()
            }
            (FallsFrom::Rising, Some(seat), Some(beside)) => {
                let sits = stay(seat.posture, Manner::STILL, BEFORE);
                [ActivityStep::Go(seat.clone()), sits, ActivityStep::Go(beside), name].into()
            }
            (FallsFrom::Seat | FallsFrom::Bed, Some(seat), Some(beside)) => {
                let sits = stay(seat.posture, Manner::STILL, BEFORE);
                let mps = if falling.slowly { SLIDES_MPS } else { DROPS_MPS };
                [ActivityStep::Go(seat.clone()), sits, name, ActivityStep::AlongFloor { to: beside.at, mps }].into()
            }
            _ => {
                let to = match place {
                    Some(place) if is_seat(&place) => self.beside(place),
                    Some(place) => Some(place.clone()),
                    // The fall occurs on the way somewhere.
                    None => self.station(setting),
                };
                to.map(ActivityStep::Go).into_iter().chain([name]).collect()
            }
        }
    }

    /// A random place of activities.
    pub(super) fn station(&self, setting: &mut ActivitySetting) -> Option<HomePlace> {
        let stations = self.places.stations();
        stations.get((setting.stream.unit() * stations.len() as f64) as usize).map(|one| one.spot.clone())
    }

    /// A point to stand next to a seat or a bed.
    fn beside(&self, spot: &HomePlace) -> Option<HomePlace> {
        let at = self.body.mesh().approach(spot.at)?;
        Some(HomePlace::to_stand(at, self.home.plan.room_at(at)?))
    }

    /// A point on the way to the nearest toilet, neither at its start nor at its end.
    fn way_to_toilet(&self, setting: &mut ActivitySetting) -> Option<HomePlace> {
        let toilet = self.places.nearest(Role::Toilet, setting.at)?;
        let mesh = self.body.mesh();
        let way: Vec<Point> = [setting.at].into_iter().chain(mesh.path(setting.at, toilet.at)?).collect();
        let length_m: f64 = way.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
        let mut left_m = length_m * setting.stream.between(0.3, 0.9);
        let mut at = *way.last()?;
        for leg in way.windows(2) {
            let leg_m = leg[0].distance(leg[1]);
            if left_m <= leg_m {
                at = leg[0].lerp(leg[1], left_m / leg_m.max(1e-9));
                break;
            }
            left_m -= leg_m;
        }
        let at = if mesh.is_free(at) { at } else { mesh.approach(toilet.at)? };
        Some(HomePlace::to_stand(at, self.home.plan.room_at(at)?))
    }

    /// Falls now and lies for this long. Visitors do not fall, because the host waits for them to leave.
    pub(super) fn fall_now(&mut self, around: &Surroundings, lies: Span) -> bool {
        let (now, Some(body), None) = (around.now(), around.body(), &self.visitor) else { return false };
        self.ready.clear();
        self.sight.rest = None;
        self.blocked.pauses = 0;
        // A further fall restarts the time on the floor.
        if self.scripts.last().is_some_and(|playing| playing.label == FALLEN) {
            self.scripts.pop();
        }
        let here = MotionState::Rest { at: body.at };
        self.body.follow(&MotionSegment { begin: now, end: now, doing: here, posture: body.posture });
        let steps = [
            ActivityStep::Name(FALLEN.into()),
            stay(Posture::Down, Manner::FALLEN, lies),
            stay(Posture::Kneeling, Manner::TURNING, GETS_UP),
        ];
        let stream = self.life.stream_of_day(self.agenda.day, &format!("outside/{now}/fall"));
        self.play(steps.into(), stream, FALLEN);
        self.watches.does(FALLEN, now, &self.life);
        let (hour, pace) = (self.hour(now), self.parameters.pace);
        if let Some(playing) = self.scripts.last_mut().filter(|_| body.posture != Posture::Standing) {
            let moves = self.body.get_up(now, hour, pace, &mut playing.stream);
            self.ready.extend(moves.into_iter().map(Next::Segment));
        }
        true
    }

    /// Crawls, or slides out of bed.
    pub(super) fn along_floor(&mut self, to: Point, mps: f64, now: RunTime) {
        let from = self.body.at();
        let path = self.body.mesh().path(from, to).unwrap_or_else(|| vec![to]);
        let gait = Gait {
            speed_mps: mps,
            acceleration_mps2: 4.0 * mps,
            half_turn_s: 4.0,
            sharp_turn_rad: std::f64::consts::PI,
            turn_amplitude_m: 0.1,
        };
        let low = walk(&path, from, now, &gait).into_iter().map(|one| MotionSegment { posture: Posture::Down, ..one });
        self.ready.extend(low.map(Next::Segment));
    }

    pub(super) fn lie_until_found(&mut self, left: Span) {
        let room = self.body.room();
        if left <= Span::ZERO || self.company.finds(room, &self.home.plan) {
            return;
        }
        let Some(playing) = self.scripts.last_mut() else { return };
        playing.steps.push_front(ActivityStep::LieUntilFound { left: left - LOOKS });
        playing.steps.push_front(stay(Posture::Down, Manner::FALLEN, LOOKS));
    }
}

fn stay(posture: Posture, manner: Manner, left: Span) -> ActivityStep {
    ActivityStep::Stay(StayStep { posture, manner, left, until: None, may: Interruptible::Nothing })
}
