//! A path: spots that exist, ways that are free, times that can be kept.

use super::{Report, Surroundings, at, blocking, is_within, solid_name};
use crate::drivers::path::GREATEST_SPEED_MPS;
use crate::geometry::{self, Point};
use crate::home::plan::{Plan, Solid};
use crate::problem::{Problem, counted};
use crate::scenario::calendar::time_of_day;
use crate::scenario::path::MOST_STEPS;
use crate::scenario::path::{Go, PathFile, Repeat, Spot, Step, StirFile};
use crate::scenario::resident::ResidentFile;
use crate::scenario::source::Source;
use crate::time::{DAY, Micros, micros, seconds};

/// Lowest speed of a walk that still arrives when intended (our choice): at this speed a room takes several minutes.
const LEAST_SPEED_MPS: f64 = 0.01;

/// Largest number of moves a second (our choice): with more, the truth has too many rows to be useful.
const MOST_MOVES_PER_S: f64 = 100.0;

/// Largest number of moves of repetitions with any speed (our choice).
const FEW_MOVES: f64 = 1_000.0;

/// Shorter ways may take no time at all, rounded to microseconds.
const LEAST_WAY_M: f64 = 1e-4;

pub fn check(
    source: &Source,
    file: &PathFile,
    resident: &ResidentFile,
    surroundings: &Surroundings,
    problems: &mut Vec<Problem>,
) {
    if file.steps_and_waypoints() > MOST_STEPS {
        let what = format!("the path has more than {MOST_STEPS} steps and waypoints together");
        let hint = "let what comes again be repeated, or say a life as a routine";
        problems.push(source.problem("/steps", what, Some(hint.into())));
        return;
    }
    let mut walk = Walk { report: Report { source, problems }, surroundings, resident };
    let start = walk.spot("/start", &file.start, &format!("{} starts", resident.name));
    walk.steps("/steps", &file.steps, start);
}

struct Walk<'a> {
    report: Report<'a>,
    surroundings: &'a Surroundings<'a>,
    resident: &'a ResidentFile,
}

/// What a list of steps comes to.
struct Outcome {
    /// Where it ends; nothing where that is not known.
    end: Option<Point>,
    /// Whether it comes to an end at all.
    ends: bool,
    /// Whether it surely takes time, apart from the way to its first spot.
    takes_time: bool,
    /// How many moves it has, and how many seconds they last; infinite where that is not known, or until a time of day.
    moves: f64,
    lasts_s: f64,
    /// The time of day at its end, in microseconds since midnight; nothing where that is not known.
    clock: Option<Micros>,
}

impl Walk<'_> {
    fn steps(&mut self, pointer: &str, steps: &[Step], from: Option<Point>) -> Outcome {
        let mut outcome = Outcome { end: from, ends: true, takes_time: false, moves: 0.0, lasts_s: 0.0, clock: None };
        let mut has_walked = false;
        for (index, step) in steps.iter().enumerate() {
            let place = format!("{pointer}/{index}");
            if !outcome.ends {
                let hint = "the steps before it are repeated for ever: say how many \"times\"";
                self.report.hinted(&place, "this step is never reached", hint);
                outcome.ends = true;
            }
            let before = outcome.end;
            match step {
                Step::Go(go) => {
                    let length = self.go(&format!("{place}/go"), go, &mut outcome, has_walked);
                    let timed = go.in_s.is_some() || go.arrive_at.is_some();
                    outcome.takes_time |= timed || length.is_none_or(|length| length > LEAST_WAY_M);
                    let pace_mps = go.pace_mps.unwrap_or(self.resident.pace_mps);
                    let by_pace = length.filter(|_| go.arrive_at.is_none()).map(|length| length / pace_mps);
                    outcome.moves += go.to.len() as f64;
                    outcome.lasts_s += go.in_s.or(by_pace).unwrap_or(f64::INFINITY);
                    has_walked = true;
                }
                Step::Wait(wait) => {
                    outcome.clock =
                        self.span(&format!("{place}/wait"), wait.for_s, wait.until.as_deref(), outcome.clock);
                    if let Some(stir) = &wait.stir {
                        self.stir(&format!("{place}/wait/stir"), stir);
                    }
                    // Until a time that it is already takes none.
                    outcome.takes_time |= wait.until.is_none();
                    outcome.moves += 1.0;
                    outcome.lasts_s += wait.for_s.unwrap_or(f64::INFINITY);
                }
                Step::Away(span) => {
                    outcome.clock =
                        self.span(&format!("{place}/away"), span.for_s, span.until.as_deref(), outcome.clock);
                    outcome.takes_time |= span.until.is_none();
                    outcome.moves += 1.0;
                    outcome.lasts_s += span.for_s.unwrap_or(f64::INFINITY);
                }
                Step::Repeat(repeat) => {
                    let inner = self.repeat(&format!("{place}/repeat"), repeat, before);
                    outcome.end = inner.end;
                    outcome.ends = inner.ends;
                    outcome.takes_time |= inner.takes_time;
                    let times = repeat.times.map_or(f64::INFINITY, f64::from);
                    outcome.moves += inner.moves * times;
                    outcome.lasts_s += inner.lasts_s * times;
                    outcome.clock = inner.clock;
                    if let Some((_, first)) = first_spot(&repeat.steps) {
                        let way = before.zip(self.find(first)).map(|(before, first)| before.distance(first));
                        outcome.takes_time |= has_walked && way.is_none_or(|length| length > LEAST_WAY_M);
                        has_walked = true;
                    }
                }
                Step::Activity(_) => outcome.moves += 1.0,
            }
        }
        outcome
    }

    fn repeat(&mut self, pointer: &str, repeat: &Repeat, from: Option<Point>) -> Outcome {
        let mut outcome = self.steps(&format!("{pointer}/steps"), &repeat.steps, from);
        if repeat.times == Some(1) || !outcome.ends {
            return outcome;
        }
        // The second round begins where the first ended.
        if let Some((path, spot)) = first_spot(&repeat.steps) {
            let first = self.find(spot);
            let back = outcome.end.zip(first);
            if let Some((end, first)) = back {
                self.leg(&format!("{pointer}/steps{path}"), end, first, spot, " when it is repeated");
            }
            outcome.takes_time |= back.is_none_or(|(end, first)| end.distance(first) > LEAST_WAY_M);
        }
        if !outcome.takes_time {
            let hint = "let it wait, or walk somewhere else and back";
            self.report.hinted(pointer, "the steps that are repeated take no time", hint);
        } else if outcome.moves > outcome.lasts_s * MOST_MOVES_PER_S
            && outcome.moves * repeat.times.map_or(f64::INFINITY, f64::from) > FEW_MOVES
        {
            let what = format!(
                "{} in {} s, again and again: nobody makes more than {MOST_MOVES_PER_S} a second",
                counted(outcome.moves as usize, "move", "moves"),
                outcome.lasts_s
            );
            self.report.hinted(pointer, what, "let them take longer, or repeat them less often");
        }
        outcome.ends = repeat.times.is_some();
        outcome
    }

    /// Walks on from where the steps before end; gives the length of the way that every repetition walks, if it is known.
    fn go(&mut self, pointer: &str, go: &Go, outcome: &mut Outcome, count_first: bool) -> Option<f64> {
        let (mut whole, mut repeated) = (Some(0.0), Some(0.0));
        for (index, spot) in go.to.iter().enumerate() {
            let place = format!("{pointer}/to/{index}");
            let to = self.spot(&place, spot, "this waypoint is");
            let length = outcome.end.zip(to).map(|(from, to)| {
                self.leg(&place, from, to, spot, "");
                from.distance(to)
            });
            whole = whole.zip(length).map(|(sum, length)| sum + length);
            if index > 0 || count_first {
                repeated = repeated.zip(length).map(|(sum, length)| sum + length);
            }
            outcome.end = to;
        }
        outcome.clock = self.tempo(pointer, go, whole, outcome.clock);
        repeated
    }

    /// Whether a walk of this length, begun at this time of day, can be kept; gives the time of day at its end.
    fn tempo(&mut self, pointer: &str, go: &Go, length: Option<f64>, clock: Option<Micros>) -> Option<Micros> {
        let given =
            [("pace_mps", go.pace_mps.is_some()), ("in_s", go.in_s.is_some()), ("arrive_at", go.arrive_at.is_some())];
        let mut given = given.into_iter().filter(|(_, is_given)| *is_given).map(|(key, _)| key);
        if let (Some(first), Some(second)) = (given.next(), given.next()) {
            let what = format!("a walk cannot have both {first:?} and {second:?}");
            self.report.hinted(&format!("{pointer}/{second}"), what, "keep the one that is meant");
        }
        let arrival = go.arrive_at.as_ref().and_then(|time| self.time_of_day(&format!("{pointer}/arrive_at"), time));
        // Whoever sets out at 07:30 to arrive at 07:30 means tomorrow.
        let until_arrival =
            arrival.zip(clock).map(|(arrival, clock)| seconds((arrival - clock - 1).rem_euclid(DAY) + 1));
        let (key, span) = if go.in_s.is_some() { ("in_s", go.in_s) } else { ("arrive_at", until_arrival) };
        if let Some((span, length)) = span.zip(length) {
            let hint = format!("at {} m/s it takes {:.0} s", self.resident.pace_mps, length / self.resident.pace_mps);
            let place = format!("{pointer}/{key}");
            if length / span > GREATEST_SPEED_MPS {
                let what = format!("{length:.1} m in {span} s would be faster than {GREATEST_SPEED_MPS} m/s");
                self.report.hinted(&place, what, hint);
            } else if key == "arrive_at" && length > LEAST_WAY_M && length / span < LEAST_SPEED_MPS {
                let what = format!("{length:.1} m would take {:.1} hours, until that time of day", span / 3600.0);
                self.report.hinted(&place, what, hint);
            }
        }
        let lasts = go.in_s.or(length.map(|length| length / go.pace_mps.unwrap_or(self.resident.pace_mps)));
        arrival.or_else(|| Some((clock? + micros(lasts?)).rem_euclid(DAY)))
    }

    /// Whether it says how long; gives the time of day at the end of a span that begins at this one.
    fn span(
        &mut self,
        pointer: &str,
        for_s: Option<f64>,
        until: Option<&str>,
        clock: Option<Micros>,
    ) -> Option<Micros> {
        match (for_s, until) {
            (None, None) => self.report.add(pointer, "how long? give \"for_s\" or \"until\""),
            (Some(_), Some(_)) => {
                let hint = "keep the one that is meant";
                self.report.hinted(&format!("{pointer}/until"), "\"for_s\" and \"until\" cannot both be given", hint);
            }
            _ => {}
        }
        match until {
            Some(until) => self.time_of_day(&format!("{pointer}/until"), until),
            None => Some((clock? + micros(for_s?)).rem_euclid(DAY)),
        }
    }

    fn stir(&mut self, pointer: &str, stir: &StirFile) {
        if stir.for_s > stir.every_s {
            let what = format!("a stir of {} s cannot come every {} s", stir.for_s, stir.every_s);
            self.report.hinted(&format!("{pointer}/for_s"), what, "\"for_s\" is at most \"every_s\"");
        }
    }

    fn time_of_day(&mut self, pointer: &str, text: &str) -> Option<Micros> {
        let time = time_of_day(text);
        if time.is_none() {
            let hint = "write it as \"07:30\" or \"07:30:15.5\", from \"00:00\" to \"23:59:59.999999\"";
            self.report.hinted(pointer, format!("{text:?} is no time of day"), hint);
        }
        time
    }

    /// Where a spot is; nothing if it is unknown, or nowhere a person can be.
    fn spot(&mut self, pointer: &str, spot: &Spot, subject: &str) -> Option<Point> {
        let home = self.surroundings.home?;
        if let Spot::Place(name) = spot {
            let seats = home.furniture.iter().filter(|piece| piece.enterable).map(|piece| &piece.name);
            let rooms = home.rooms.iter().map(|room| &room.name);
            let known = home.places.iter().map(|place| &place.name).chain(seats).chain(rooms).map(String::as_str);
            if !known.clone().any(|place| place == name) {
                let hint = match home.furniture.iter().any(|piece| piece.name == *name) {
                    true => Some("nobody can be where it stands: add a place beside it".into()),
                    false => self.report.did_you_mean(name, known),
                };
                let what = format!("the home has no place {name:?}");
                self.report.problems.push(self.report.source.problem(pointer, what, hint));
                return None;
            }
        }
        let (plan, to) = (self.surroundings.plan?, self.find(spot)?);
        // A place that nobody can be at is a problem of the home, not of every path that goes there.
        let blamed = matches!(spot, Spot::Place(name) if home.places.iter().any(|place| place.name == *name));
        if plan.distance_outside(to) > super::TOLERANCE_M {
            if !blamed {
                self.report.add(pointer, format!("{subject} at {}, outside the home", at(to)));
            }
            return None;
        }
        if let Some(solid) = blocking(plan, to) {
            if !blamed {
                self.report.add(pointer, format!("{subject} inside {}", solid_name(home, solid)));
            }
            return None;
        }
        Some(to)
    }

    fn find(&self, spot: &Spot) -> Option<Point> {
        self.surroundings.plan?.spot(spot)
    }

    fn leg(&mut self, pointer: &str, from: Point, to: Point, spot: &Spot, when: &str) {
        let (Some(home), Some(plan)) = (self.surroundings.home, self.surroundings.plan) else { return };
        let Some(solid) = stop_on_way(plan, from, to) else { return };
        let goal = match spot {
            Spot::At(_) => at(to),
            Spot::Place(name) => format!("{name:?}"),
        };
        let what = format!("the way from {} to {goal} runs through {}{when}", at(from), solid_name(home, solid));
        self.report.hinted(pointer, what, "add waypoints around it, such as one in a door");
    }
}

/// The first spot that the steps walk to, with its pointer relative to the list.
fn first_spot(steps: &[Step]) -> Option<(String, &Spot)> {
    steps.iter().enumerate().find_map(|(index, step)| match step {
        Step::Go(go) => Some((format!("/{index}/go/to/0"), go.to.first()?)),
        Step::Repeat(repeat) => {
            let (path, spot) = first_spot(&repeat.steps)?;
            Some((format!("/{index}/repeat/steps{path}"), spot))
        }
        _ => None,
    })
}

/// The first solid that the straight way enters, rather than only touches.
fn stop_on_way(plan: &Plan, from: Point, to: Point) -> Option<&Solid> {
    let entered = plan.solids.iter().filter(|solid| solid.stops_bodies).filter_map(|solid| {
        let (enter, leave) = geometry::segment_inside_convex(&solid.outline, from, to)?;
        is_within(solid, from.lerp(to, (enter + leave) / 2.0)).then_some((enter, solid))
    });
    entered.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, solid)| solid)
}
