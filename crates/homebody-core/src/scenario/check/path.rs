//! A path: spots that exist, ways that are free, times that can be kept.

use super::{HomeInCheck, ProblemReport, at as written, blocking, is_within, solid_name};
use crate::calendar::{TimeMessage, time_of_day};
use crate::drivers::path::GREATEST_SPEED_MPS;
use crate::drivers::path::form::{Go, MOST_STEPS, PathFile, PathStep, Repeat, StirFile};
use crate::geometry::{self, Point};
use crate::nearest::suggestion;
use crate::plan::form::Spot;
use crate::plan::{Plan, Solid};
use crate::problem::Problem;
use crate::resident::ResidentFile;
use crate::scenario::source::JsonSource;
use crate::time::{DAY, Span};

crate::messages! {
    /// Problems with paths.
    pub enum PathMessage in "path" {
        /// A path of this length is better written as a routine, or as steps in a `repeat`.
        TooManySteps { most: usize }
            error "too-many-steps" ("the path has more than {most} steps and waypoints together")
            hint ("put steps that recur into a \"repeat\", or write a routine");
        /// A `repeat` without `times` never ends, so no step after it is done.
        Unreached error "unreached-step" ("this step is never reached")
            hint ("give the \"repeat\" before it a number of \"times\"");
        /// All repetitions would happen at the same instant.
        NoTime error "repeat-takes-no-time" ("the repeated steps take no time")
            hint ("add a \"wait\", or walk to another place and back");
        /// The ground truth stores each movement, and a person does not make so many in a second.
        TooManyMoves {
            /// The number of movements in each repetition.
            moves: usize,
            lasts_s: f64,
            /// The largest number of movements in a second.
            most_per_s: f64,
        } error "too-many-moves"
            ("the repeated steps have {moves} movements in {lasts_s} s, but a person makes at most {most_per_s} per second")
            hint ("let the steps take longer, or repeat them fewer \"times\"");
        /// The pace, the duration and the time of arrival of a walk depend on each other, so a path gives one of them.
        TwoTempos { first: &'static str, second: &'static str }
            error "two-tempos" ("a walk cannot have both {first:?} and {second:?}")
            hint ("remove one of them");
        /// A body does not move faster than a sprinter.
        TooFast { length_m: f64, span_s: f64, most_mps: f64, pace_mps: f64 }
            error "too-fast" ("{length_m:.1} m in {span_s} s would be faster than {most_mps} m/s")
            hint ("give the walk more time: at {pace_mps} m/s it takes {usual_s:.0} s", usual_s = length_m / pace_mps);
        /// A body that moves more slowly than 0.01 m/s does not arrive when the path means it to. Often the time of arrival is on the next day
        /// by mistake.
        TooSlow { length_m: f64, span_s: f64, pace_mps: f64 } error "too-slow"
            ("the walk of {length_m:.1} m has {hours:.1} hours until the time in \"arrive_at\", and this is too slow", hours = span_s / 3600.0)
            hint ("give an earlier time, or add a \"wait\" before the walk: at {pace_mps} m/s it takes {usual_s:.0} s", usual_s = length_m / pace_mps);
        /// A wait and an absence have a duration or an end.
        NoSpan error "no-duration" ("this step has neither \"for_s\" nor \"until\"")
            hint ("give one of them");
        /// A wait and an absence have a duration or an end, not both.
        TwoSpans error "two-durations" ("\"for_s\" and \"until\" cannot both be given")
            hint ("remove one of them");
        /// A small movement ends before the next begins.
        LongStir {
            for_s: f64,
            /// The time from one movement to the next.
            every_s: f64,
        } error "long-stir" ("a small movement of {for_s} s cannot repeat every {every_s} s")
            hint ("set \"for_s\" to at most \"every_s\"");
        /// A path goes to places, enterable furniture and rooms, by the names in `home.json`.
        UnknownPlace { place: String, nearest: Option<String>, known: Vec<String> }
            error "unknown-place" ("the home has no place {place:?}")
            advice (suggestion(nearest, known));
        /// A body cannot be inside this piece of furniture. Only enterable furniture, such as beds and chairs, is a place.
        NotEnterable { furniture: String }
            error "not-enterable" ("a path cannot go to {furniture:?}, because no resident can enter it")
            hint ("add a place in front of it to \"places\" of the home, and go there");
        /// A path stays in the rooms of the home. Use the step `away` for an absence.
        Outside { subject: String, at: Point }
            error "outside-home" ("{subject} at {at}, outside the home", at = written(*at))
            hint ("choose a point in a room");
        /// The point is inside a wall, a closed door or a piece of furniture.
        Blocked {
            subject: String,
            /// The wall, door or piece of furniture.
            by: String,
        } error "blocked" ("{subject} inside {by}")
            hint ("choose a point where a person can stand");
        /// A path goes in straight lines from waypoint to waypoint. This line crosses a wall, a closed door or a piece of furniture.
        WayBlocked {
            from: String,
            to: String,
            /// The wall, door or piece of furniture.
            by: String,
            /// Whether the line is walked in repetitions only.
            is_repeated: bool,
        } error "way-blocked"
            ("the way from {from} to {to} runs through {by}{when}", when = if *is_repeated { " when it is repeated" } else { "" })
            hint ("add waypoints around it, such as one in a door");
    }
}

/// Lowest speed of a walk that still arrives when intended (our choice): at this speed a room takes several minutes.
const LEAST_SPEED_MPS: f64 = 0.01;

/// Largest number of moves a second (our choice): with more, the truth has too many rows to be useful.
const MOST_MOVES_PER_S: f64 = 100.0;

/// Largest number of moves of repetitions with any speed (our choice).
const FEW_MOVES: f64 = 1_000.0;

/// Shorter ways may take no time at all, rounded to microseconds.
const LEAST_WAY_M: f64 = 1e-4;

pub fn check(
    source: &JsonSource,
    file: &PathFile,
    resident: &ResidentFile,
    surroundings: &HomeInCheck,
    problems: &mut Vec<Problem>,
) {
    if file.steps_and_waypoints() > MOST_STEPS {
        problems.push(source.problem("/steps", PathMessage::TooManySteps { most: MOST_STEPS }, None));
        return;
    }
    let mut walk = PathCheck { report: ProblemReport { source, problems }, surroundings, resident };
    let start = walk.spot("/start", &file.start, &format!("{} starts", resident.name));
    walk.steps("/steps", &file.steps, start);
}

struct PathCheck<'a> {
    report: ProblemReport<'a>,
    surroundings: &'a HomeInCheck<'a>,
    resident: &'a ResidentFile,
}

struct StepsOutcome {
    end: Option<Point>,
    /// Whether it comes to an end at all.
    ends: bool,
    /// Whether it surely takes time, without the way to its first spot.
    takes_time: bool,
    /// The number of moves, and their length in seconds; infinite if unknown, or until a time of day.
    moves: f64,
    lasts_s: f64,
    /// The time of day at its end, if known.
    clock: Option<Span>,
}

impl PathCheck<'_> {
    fn steps(&mut self, pointer: &str, steps: &[PathStep], from: Option<Point>) -> StepsOutcome {
        let mut outcome =
            StepsOutcome { end: from, ends: true, takes_time: false, moves: 0.0, lasts_s: 0.0, clock: None };
        let mut has_walked = false;
        for (index, step) in steps.iter().enumerate() {
            let place = format!("{pointer}/{index}");
            if !outcome.ends {
                self.report.add(&place, PathMessage::Unreached);
                outcome.ends = true;
            }
            let before = outcome.end;
            match step {
                PathStep::Go(go) => {
                    let length = self.go(&format!("{place}/go"), go, &mut outcome, has_walked);
                    let timed = go.in_s.is_some() || go.arrive_at.is_some();
                    outcome.takes_time |= timed || length.is_none_or(|length| length > LEAST_WAY_M);
                    let pace_mps = go.pace_mps.unwrap_or(self.resident.pace_mps);
                    let by_pace = length.filter(|_| go.arrive_at.is_none()).map(|length| length / pace_mps);
                    outcome.moves += go.to.len() as f64;
                    outcome.lasts_s += go.in_s.or(by_pace).unwrap_or(f64::INFINITY);
                    has_walked = true;
                }
                PathStep::Wait(wait) => {
                    self.stay(&format!("{place}/wait"), wait.for_s, wait.until.as_deref(), &mut outcome);
                    if let Some(stir) = &wait.stir {
                        self.stir(&format!("{place}/wait/stir"), stir);
                    }
                }
                PathStep::Away(span) => {
                    self.stay(&format!("{place}/away"), span.for_s, span.until.as_deref(), &mut outcome);
                }
                PathStep::Repeat(repeat) => {
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
                PathStep::Activity(_) => outcome.moves += 1.0,
            }
        }
        outcome
    }

    fn stay(&mut self, pointer: &str, for_s: Option<f64>, until: Option<&str>, outcome: &mut StepsOutcome) {
        outcome.clock = self.span(pointer, for_s, until, outcome.clock);
        // Until a time that it is already takes none.
        outcome.takes_time |= until.is_none();
        outcome.moves += 1.0;
        outcome.lasts_s += for_s.unwrap_or(f64::INFINITY);
    }

    fn repeat(&mut self, pointer: &str, repeat: &Repeat, from: Option<Point>) -> StepsOutcome {
        let mut outcome = self.steps(&format!("{pointer}/steps"), &repeat.steps, from);
        if repeat.times == Some(1) || !outcome.ends {
            return outcome;
        }
        // The second round begins where the first ended.
        if let Some((path, spot)) = first_spot(&repeat.steps) {
            let first = self.find(spot);
            let back = outcome.end.zip(first);
            if let Some((end, first)) = back {
                self.leg(&format!("{pointer}/steps{path}"), end, first, spot, true);
            }
            outcome.takes_time |= back.is_none_or(|(end, first)| end.distance(first) > LEAST_WAY_M);
        }
        if !outcome.takes_time {
            self.report.add(pointer, PathMessage::NoTime);
        } else if outcome.moves > outcome.lasts_s * MOST_MOVES_PER_S
            && outcome.moves * repeat.times.map_or(f64::INFINITY, f64::from) > FEW_MOVES
        {
            let (moves, lasts_s) = (outcome.moves as usize, outcome.lasts_s);
            self.report.add(pointer, PathMessage::TooManyMoves { moves, lasts_s, most_per_s: MOST_MOVES_PER_S });
        }
        outcome.ends = repeat.times.is_some();
        outcome
    }

    /// Walks on from the end of the steps before; returns the length of the way in each repetition, if known.
    fn go(&mut self, pointer: &str, go: &Go, outcome: &mut StepsOutcome, count_first: bool) -> Option<f64> {
        let (mut whole, mut repeated) = (Some(0.0), Some(0.0));
        for (index, spot) in go.to.iter().enumerate() {
            let place = format!("{pointer}/to/{index}");
            let to = self.spot(&place, spot, "this waypoint is");
            let length = outcome.end.zip(to).map(|(from, to)| {
                self.leg(&place, from, to, spot, false);
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

    /// Whether a walk of this length, begun at this time of day, is possible; returns the time of day at its end.
    fn tempo(&mut self, pointer: &str, go: &Go, length: Option<f64>, clock: Option<Span>) -> Option<Span> {
        let given =
            [("pace_mps", go.pace_mps.is_some()), ("in_s", go.in_s.is_some()), ("arrive_at", go.arrive_at.is_some())];
        let mut given = given.into_iter().filter(|(_, is_given)| *is_given).map(|(key, _)| key);
        if let (Some(first), Some(second)) = (given.next(), given.next()) {
            self.report.add(&format!("{pointer}/{second}"), PathMessage::TwoTempos { first, second });
        }
        let arrival = go.arrive_at.as_ref().and_then(|time| self.time_of_day(&format!("{pointer}/arrive_at"), time));
        // A walk that begins at 07:30 and arrives at 07:30 arrives tomorrow.
        let at_least = Span::MICROSECOND;
        let until_arrival = arrival
            .zip(clock)
            .map(|(arrival, clock)| ((arrival - clock - at_least).rem_euclid(DAY) + at_least).seconds());
        let (key, span) = if go.in_s.is_some() { ("in_s", go.in_s) } else { ("arrive_at", until_arrival) };
        if let Some((span_s, length_m)) = span.zip(length) {
            let (place, pace_mps) = (format!("{pointer}/{key}"), self.resident.pace_mps);
            if length_m / span_s > GREATEST_SPEED_MPS {
                let most_mps = GREATEST_SPEED_MPS;
                self.report.add(&place, PathMessage::TooFast { length_m, span_s, most_mps, pace_mps });
            } else if key == "arrive_at" && length_m > LEAST_WAY_M && length_m / span_s < LEAST_SPEED_MPS {
                self.report.add(&place, PathMessage::TooSlow { length_m, span_s, pace_mps });
            }
        }
        let lasts = go.in_s.or(length.map(|length| length / go.pace_mps.unwrap_or(self.resident.pace_mps)));
        arrival.or_else(|| Some((clock? + Span::from_seconds(lasts?)).rem_euclid(DAY)))
    }

    /// Whether it has a duration; returns the time of day at the end of a span that begins at this one.
    fn span(&mut self, pointer: &str, for_s: Option<f64>, until: Option<&str>, clock: Option<Span>) -> Option<Span> {
        match (for_s, until) {
            (None, None) => self.report.add(pointer, PathMessage::NoSpan),
            (Some(_), Some(_)) => self.report.add(&format!("{pointer}/until"), PathMessage::TwoSpans),
            _ => {}
        }
        match until {
            Some(until) => self.time_of_day(&format!("{pointer}/until"), until),
            None => Some((clock? + Span::from_seconds(for_s?)).rem_euclid(DAY)),
        }
    }

    fn stir(&mut self, pointer: &str, stir: &StirFile) {
        if stir.for_s > stir.every_s {
            let message = PathMessage::LongStir { for_s: stir.for_s, every_s: stir.every_s };
            self.report.add(&format!("{pointer}/for_s"), message);
        }
    }

    fn time_of_day(&mut self, pointer: &str, text: &str) -> Option<Span> {
        let time = time_of_day(text);
        if time.is_none() {
            self.report.add(pointer, TimeMessage::InvalidTimeOfDay { text: text.to_owned() });
        }
        time
    }

    /// The position of a spot; `None` if it is unknown, or not a place for a person.
    fn spot(&mut self, pointer: &str, spot: &Spot, subject: &str) -> Option<Point> {
        let home = self.surroundings.home?;
        if let Spot::Place(name) = spot {
            let seats = home.furniture.iter().filter(|piece| piece.enterable).map(|piece| &piece.name);
            let rooms = home.rooms.iter().map(|room| &room.name);
            let known = home.places.iter().map(|place| &place.name).chain(seats).chain(rooms).map(String::as_str);
            if !known.clone().any(|place| place == name) {
                let place = name.clone();
                if home.furniture.iter().any(|piece| piece.name == *name) {
                    self.report.add(pointer, PathMessage::NotEnterable { furniture: place });
                } else {
                    let (nearest, known) = self.report.names_for(name, known);
                    self.report.add(pointer, PathMessage::UnknownPlace { place, nearest, known });
                }
                return None;
            }
        }
        let (plan, to) = (self.surroundings.plan?, self.find(spot)?);
        // A blocked place is a problem of the home, not of every path that goes there.
        let blamed = matches!(spot, Spot::Place(name) if home.places.iter().any(|place| place.name == *name));
        if plan.distance_outside(to) > super::TOLERANCE_M {
            if !blamed {
                self.report.add(pointer, PathMessage::Outside { subject: subject.to_owned(), at: to });
            }
            return None;
        }
        if let Some(solid) = blocking(plan, to) {
            if !blamed {
                let (subject, by) = (subject.to_owned(), solid_name(home, solid));
                self.report.add(pointer, PathMessage::Blocked { subject, by });
            }
            return None;
        }
        Some(to)
    }

    fn find(&self, spot: &Spot) -> Option<Point> {
        self.surroundings.plan?.spot(spot)
    }

    fn leg(&mut self, pointer: &str, from: Point, to: Point, spot: &Spot, is_repeated: bool) {
        let (Some(home), Some(plan)) = (self.surroundings.home, self.surroundings.plan) else { return };
        let Some(solid) = stop_on_way(plan, from, to) else { return };
        let (from, by) = (written(from), solid_name(home, solid));
        let to = match spot {
            Spot::At(_) => written(to),
            Spot::Place(name) => format!("{name:?}"),
        };
        self.report.add(pointer, PathMessage::WayBlocked { from, to, by, is_repeated });
    }
}

/// The first spot that the steps walk to, with its pointer relative to the list.
fn first_spot(steps: &[PathStep]) -> Option<(String, &Spot)> {
    steps.iter().enumerate().find_map(|(index, step)| match step {
        PathStep::Go(go) => Some((format!("/{index}/go/to/0"), go.to.first()?)),
        PathStep::Repeat(repeat) => {
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
