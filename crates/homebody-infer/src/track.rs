//! The way that somebody may have gone, as a path that can be acted out.

use crate::smooth::Guess;
use crate::states::{Kind, State};
use homebody_core::geometry::Point;
use homebody_core::random::Stream;
use homebody_core::scenario::path::{
    Go, MOST_STEPS, PathFile, Posture, Repeat, Span, Spot, Step, StirFile, Wait, count,
};
use homebody_core::time::{DAY, Micros, SECOND, micros, seconds};
use homebody_walk::Mesh;

/// Where one body was, as far as it has been told.
#[derive(Clone, Debug, Default)]
pub struct Track {
    legs: Vec<Leg>,
}

/// A span in one place.
#[derive(Clone, Debug, PartialEq)]
struct Leg {
    begin: Micros,
    place: Place,
    /// When it was seen to move while it stayed.
    stirs: Vec<Micros>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Out,
    Stay(Point, Posture),
    /// On the way.
    Pass(Point),
}

/// Time below which a standing person is still on the way (our choice).
const STOP: Micros = 3 * SECOND;
/// Duration of an observed movement, at the time of the sensor's event (our choice).
const STIR: Micros = SECOND;
/// A shorter movement is none.
const LEAST_STIR: Micros = SECOND / 20;
/// Distance that the moving part of the body covers (our choice): enough for a sensor that looks there.
const STIR_M: f64 = 0.4;
/// Distance below which a person is already at the place (our choice).
const HERE_M: f64 = 0.05;
/// Highest speed of a walk (our choice).
const FASTEST_MPS: f64 = 1.5;
/// Shortest remaining stay, when a stay is shortened to make time for a walk (our choice).
const SHORTEST: Micros = SECOND / 2;

impl Place {
    fn of(state: &State) -> Place {
        match (state.kind, state.at) {
            (Kind::Walks, Some(at)) => Place::Pass(at),
            (_, Some(at)) => Place::Stay(at, state.posture),
            (_, None) => Place::Out,
        }
    }

    fn at(self) -> Option<Point> {
        match self {
            Place::Out => None,
            Place::Stay(at, _) | Place::Pass(at) => Some(at),
        }
    }
}

impl Track {
    /// Adds where the body was at an instant later than all before; `moved` says that a sensor saw it move then.
    pub fn add(&mut self, at: Micros, guess: &Guess, moved: bool) {
        let place = Place::of(guess.state);
        if self.legs.last().is_none_or(|last| last.place != place) {
            // Between two instants it changed places in the middle.
            let begin = self.legs.last().map_or(0, |last| last.begin.max(at - SECOND / 2));
            self.legs.push(Leg { begin, place, stirs: Vec::new() });
        }
        if let Some(last) = self.legs.last_mut().filter(|_| moved) {
            last.stirs.push(at);
        }
    }

    /// Whether the body was at home at all.
    pub fn is_ever_home(&self) -> bool {
        self.legs.iter().any(|leg| leg.place != Place::Out)
    }

    /// The path of who went so until `end`: through the rooms by `mesh`, whose ways no wall is in. Who never came home is away
    /// from a point of the first room. Of a way that is too long for a path, so many whole days as fit; how many microseconds that
    /// is comes with it.
    pub fn path(&self, mesh: &Mesh, end: Micros) -> (PathFile, Micros) {
        let legs = self.stops(end);
        let first = legs.iter().find_map(|(_, place, _)| place.at());
        let first = first.unwrap_or_else(|| mesh.free_point(0, &mut Stream::named(1, "track")));
        let mut walk = Walk { mesh, at: first, now: 0, since: 0, steps: Vec::new(), days: Vec::new() };
        for (number, (begin, place, stirs)) in legs.iter().enumerate() {
            let until = legs.get(number + 1).map_or(end, |next| next.0);
            walk.leg(*begin, until, *place, stirs);
        }
        walk.end_day();
        let mut length = end;
        let mut steps = 0;
        let all = std::mem::take(&mut walk.days).into_iter();
        let fits = |(_, step): &(Micros, Step)| {
            steps += count(std::slice::from_ref(step));
            steps <= MOST_STEPS
        };
        let days: Vec<Step> = all.clone().take_while(fits).map(|(_, step)| step).collect();
        if let Some((begin, _)) = all.as_slice().get(days.len()) {
            length = begin / DAY * DAY;
        }
        let posture = match legs.first() {
            Some((_, Place::Stay(_, posture), _)) => *posture,
            _ => Posture::Standing,
        };
        (PathFile { schema: None, start: Spot::At(first.into()), posture, steps: days }, length)
    }

    /// The legs, of which those that are too short to stop for are on the way.
    fn stops(&self, end: Micros) -> Vec<(Micros, Place, &[Micros])> {
        let until = |number: usize| self.legs.get(number + 1).map_or(end, |next| next.begin);
        let of = |(number, leg): (usize, &Leg)| {
            let place = match leg.place {
                Place::Stay(at, Posture::Standing) if until(number) - leg.begin < STOP => Place::Pass(at),
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

/// A path that is being made.
struct Walk<'a> {
    mesh: &'a Mesh,
    at: Point,
    now: Micros,
    /// The steps of the day since when, and those of the days before.
    since: Micros,
    steps: Vec<Step>,
    days: Vec<(Micros, Step)>,
}

impl Walk<'_> {
    fn leg(&mut self, begin: Micros, until: Micros, place: Place, stirs: &[Micros]) {
        if self.since / DAY != begin / DAY {
            self.end_day();
        }
        match place {
            Place::Out => {
                if until > self.now {
                    let for_s = Some(seconds(until - self.now));
                    self.steps.push(Step::Away(Span { for_s, until: None }));
                    self.now = until;
                }
            }
            // Who walks and comes to nowhere else moves about there.
            Place::Pass(to) if self.at.distance(to) < HERE_M => self.wait(until, Posture::Standing, true),
            Place::Pass(to) => self.go(to, until),
            Place::Stay(to, posture) => {
                self.go(to, self.now.max(begin));
                for &stir in stirs {
                    self.wait(stir - STIR, posture, false);
                    self.wait(stir + STIR / 2, posture, true);
                }
                self.wait(until - SHORTEST, posture, false);
            }
        }
    }

    /// Walks to a point, to be there at an instant if that is possible.
    fn go(&mut self, to: Point, by: Micros) {
        let Some(way) = self.mesh.path(self.at, to).filter(|_| self.at.distance(to) > 1e-3) else { return };
        let from = std::iter::once(self.at).chain(way.iter().copied());
        let length_m: f64 = from.zip(&way).map(|(a, b)| a.distance(*b)).sum();
        let takes = (by - self.now).max(micros(length_m / FASTEST_MPS)).max(1);
        let to_all = way.iter().map(|&point| Spot::At(point.into())).collect();
        self.steps.push(Step::Go(Go { to: to_all, pace_mps: None, in_s: Some(seconds(takes)), arrive_at: None }));
        (self.at, self.now) = (way.last().copied().unwrap_or(to), self.now + takes);
    }

    fn wait(&mut self, until: Micros, posture: Posture, stirs: bool) {
        let span = until - self.now;
        if span <= 0 {
            return;
        }
        let stir = (stirs && span >= LEAST_STIR).then(|| StirFile {
            every_s: seconds(span).max(0.1),
            for_s: seconds(span),
            amplitude_m: STIR_M,
        });
        self.steps.push(Step::Wait(Wait { for_s: Some(seconds(span)), until: None, posture, stir }));
        self.now = until;
    }

    /// A day's steps are one step of the path, so that paths of any length have few of them.
    fn end_day(&mut self) {
        /// No list of a path is longer.
        const MOST: usize = 10_000;
        let mut steps = std::mem::take(&mut self.steps);
        while !steps.is_empty() {
            let rest = steps.split_off(steps.len().min(MOST));
            self.days.push((self.since, Step::Repeat(Repeat { times: Some(1), steps })));
            steps = rest;
        }
        self.since = self.now;
    }
}
