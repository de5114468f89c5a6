//! A plausible route of one body, as a path that a resident can follow.

use crate::smoother::Guess;
use crate::states::{BodyState, StateKind};
use homebody_core::drivers::path::form::{Go, MOST_STEPS, PathFile, PathSpan, PathStep, Repeat, StirFile, Wait, count};
use homebody_core::geometry::Point;
use homebody_core::plan::form::Spot;
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::time::{DAY, Interval, RunTime, SECOND, Span};
use homebody_walk::Mesh;

#[derive(Clone, Debug, Default)]
pub struct Track {
    legs: Vec<TrackLeg>,
}

#[derive(Clone, Debug, PartialEq)]
struct TrackLeg {
    begin: RunTime,
    place: TrackPlace,
    /// Instants of detected movement during a stay.
    stirs: Vec<RunTime>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum TrackPlace {
    Out,
    Stay(Point, Posture),
    Pass(Point),
}

/// Time below which a standing person is still on the way (our choice).
const STOP: Span = SECOND.times(3);
/// Duration of an observed movement, at the time of the sensor's event (our choice).
const STIR: Span = SECOND;
const LEAST_STIR: Span = Span::from_millis(50);
/// Distance that the moving part of the body covers (our choice): enough for a sensor that looks there.
const STIR_M: f64 = 0.4;
/// Distance below which a person is already at the place (our choice).
const HERE_M: f64 = 0.05;
/// Highest speed of a walk (our choice).
const FASTEST_MPS: f64 = 1.5;
/// Shortest remaining stay, when a stay is shortened to make time for a walk (our choice).
const SHORTEST: Span = Span::from_millis(500);

impl TrackPlace {
    fn from_state(state: &BodyState) -> TrackPlace {
        match (state.kind, state.at) {
            (StateKind::Walks, Some(at)) => TrackPlace::Pass(at),
            (_, Some(at)) => TrackPlace::Stay(at, state.posture),
            (_, None) => TrackPlace::Out,
        }
    }

    fn at(self) -> Option<Point> {
        match self {
            TrackPlace::Out => None,
            TrackPlace::Stay(at, _) | TrackPlace::Pass(at) => Some(at),
        }
    }
}

impl Track {
    pub fn add(&mut self, at: RunTime, guess: &Guess, moved: bool) {
        let place = TrackPlace::from_state(guess.state);
        if self.legs.last().is_none_or(|last| last.place != place) {
            // A change of place happens in the middle between two instants.
            let begin = self.legs.last().map_or(RunTime::START, |last| last.begin.max(at - SECOND / 2));
            self.legs.push(TrackLeg { begin, place, stirs: Vec::new() });
        }
        if let Some(last) = self.legs.last_mut().filter(|_| moved) {
            last.stirs.push(at);
        }
    }

    pub fn is_ever_home(&self) -> bool {
        self.legs.iter().any(|leg| leg.place != TrackPlace::Out)
    }

    /// The path until `end`, along the ways of `mesh`. A body that never came home is away from a point of the first room.
    /// A path that would be too long is cut to whole days; the covered time is returned.
    pub fn path(&self, mesh: &Mesh, end: RunTime) -> (PathFile, Span) {
        let legs = self.stops(end);
        let first = legs.iter().find_map(|(_, place, _)| place.at());
        let first = first.unwrap_or_else(|| mesh.free_point(0, &mut Stream::named(1, "track")));
        let (now, since) = (RunTime::START, RunTime::START);
        let mut walk = PathBuilder { mesh, at: first, now, since, steps: Vec::new(), days: Vec::new() };
        for (number, (begin, place, stirs)) in legs.iter().enumerate() {
            let until = legs.get(number + 1).map_or(end, |next| next.0);
            walk.leg(Interval::new(*begin, until), *place, stirs);
        }
        walk.end_day();
        let mut length = end.since_zero();
        let mut steps = 0;
        let all = std::mem::take(&mut walk.days).into_iter();
        let fits = |(_, step): &(RunTime, PathStep)| {
            steps += count(std::slice::from_ref(step));
            steps <= MOST_STEPS
        };
        let days: Vec<PathStep> = all.clone().take_while(fits).map(|(_, step)| step).collect();
        if let Some((begin, _)) = all.as_slice().get(days.len()) {
            length = begin.since_zero() / DAY * DAY;
        }
        let posture = match legs.first() {
            Some((_, TrackPlace::Stay(_, posture), _)) => *posture,
            _ => Posture::Standing,
        };
        (PathFile { schema: None, start: Spot::At(first.into()), posture, steps: days }, length)
    }

    /// Legs too short to stop for become part of the way.
    fn stops(&self, end: RunTime) -> Vec<(RunTime, TrackPlace, &[RunTime])> {
        let until = |number: usize| self.legs.get(number + 1).map_or(end, |next| next.begin);
        let of = |(number, leg): (usize, &TrackLeg)| {
            let place = match leg.place {
                TrackPlace::Stay(at, Posture::Standing) if until(number) - leg.begin < STOP => TrackPlace::Pass(at),
                place => place,
            };
            (leg.begin, place)
        };
        self.legs
            .iter()
            .enumerate()
            .map(of)
            .zip(&self.legs)
            .map(|((begin, place), leg)| (begin, place, &leg.stirs[..]))
            .collect()
    }
}

struct PathBuilder<'a> {
    mesh: &'a Mesh,
    at: Point,
    now: RunTime,
    since: RunTime,
    steps: Vec<PathStep>,
    days: Vec<(RunTime, PathStep)>,
}

impl PathBuilder<'_> {
    fn leg(&mut self, leg: Interval<RunTime>, place: TrackPlace, stirs: &[RunTime]) {
        let Interval { begin, end: until } = leg;
        if self.since.since_zero() / DAY != begin.since_zero() / DAY {
            self.end_day();
        }
        match place {
            TrackPlace::Out => {
                if until > self.now {
                    let for_s = Some((until - self.now).seconds());
                    self.steps.push(PathStep::Away(PathSpan { for_s, until: None }));
                    self.now = until;
                }
            }
            // A walk that ends where it began moves about there.
            TrackPlace::Pass(to) if self.at.distance(to) < HERE_M => self.wait(until, Posture::Standing, true),
            TrackPlace::Pass(to) => self.go(to, until),
            TrackPlace::Stay(to, posture) => {
                self.go(to, self.now.max(begin));
                for &stir in stirs {
                    self.wait(stir - STIR, posture, false);
                    self.wait(stir + STIR / 2, posture, true);
                }
                self.wait(until - SHORTEST, posture, false);
            }
        }
    }

    fn go(&mut self, to: Point, by: RunTime) {
        let Some(way) = self.mesh.path(self.at, to).filter(|_| self.at.distance(to) > 1e-3) else { return };
        let from = std::iter::once(self.at).chain(way.iter().copied());
        let length_m: f64 = from.zip(&way).map(|(a, b)| a.distance(*b)).sum();
        let takes = (by - self.now).max(Span::from_seconds(length_m / FASTEST_MPS)).max(Span::MICROSECOND);
        let to_all = way.iter().map(|&point| Spot::At(point.into())).collect();
        self.steps.push(PathStep::Go(Go { to: to_all, pace_mps: None, in_s: Some(takes.seconds()), arrive_at: None }));
        (self.at, self.now) = (way.last().copied().unwrap_or(to), self.now + takes);
    }

    fn wait(&mut self, until: RunTime, posture: Posture, stirs: bool) {
        let span = until - self.now;
        if span <= Span::ZERO {
            return;
        }
        let stir = (stirs && span >= LEAST_STIR).then(|| StirFile {
            every_s: span.seconds().max(0.1),
            for_s: span.seconds(),
            amplitude_m: STIR_M,
        });
        self.steps.push(PathStep::Wait(Wait { for_s: Some(span.seconds()), until: None, posture, stir }));
        self.now = until;
    }

    /// Each day becomes one step, because paths have a limited number of steps.
    fn end_day(&mut self) {
        const MOST: usize = 10_000;
        let mut steps = std::mem::take(&mut self.steps);
        while !steps.is_empty() {
            let rest = steps.split_off(steps.len().min(MOST));
            self.days.push((self.since, PathStep::Repeat(Repeat { times: Some(1), steps })));
            steps = rest;
        }
        self.since = self.now;
    }
}
