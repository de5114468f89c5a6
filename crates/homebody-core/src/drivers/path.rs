//! Acts out a path description.
//!
//! A resident walks the straight legs of the file, waits, moves on the spot and stays away, step by step.
//!
//! We assume that the file has passed its checks, and that a day lasts 24 hours from the scenario's start, so that a
//! time of day after a change to daylight saving time is an hour off.
//!
//! The nested steps become one flat list in which the end of a repeat jumps back to its first step. The driver keeps
//! its place in the list and one entry for each open repeat, so an endless path needs no more memory than a short one.
//! All times within a walk are counted from its beginning, so rounding to microseconds never adds up.
//!
//! Left out: walls and other people. A path leads where its file says.

pub mod form;

use crate::calendar::time_of_day;
use crate::drivers::{Driver, Next, Surroundings};
use crate::geometry::Point;
use crate::motion::{MotionSegment, MotionState};
use crate::plan::Plan;
use crate::posture::Posture;
use crate::time::{DAY, RunTime, Span};
use form::{PathFile, PathStep};
use std::ops::Deref;
use std::sync::Arc;

/// Highest speed of a walk (our choice): a person who would need more arrives late.
pub(crate) const GREATEST_SPEED_MPS: f64 = 10.0;

/// A resident who follows a path description.
#[derive(Clone, Debug)]
pub struct PathDriver {
    /// Shared, so that a copy of a run does not copy the path.
    steps: Arc<[FlatStep]>,
    /// From local midnight to the scenario's start.
    start_of_day: Span,
    /// The step that is being done; past the end once all is done.
    step: usize,
    under_way: Option<UnderWay>,
    /// The repeats that are open, outermost first.
    passes: Vec<RepeatPass>,
    at: Point,
    posture: Posture,
}

#[derive(Clone, Debug, PartialEq)]
enum FlatStep {
    Go {
        to: Vec<Point>,
        tempo: Tempo,
    },
    Stay {
        lasts: Lasts,
        pastime: Pastime,
    },
    Activity(Option<String>),
    /// The steps up to the matching `Again` are done several times, or for ever.
    Repeat {
        times: Option<u32>,
    },
    /// The end of a repeat, with the index of its first step.
    Again {
        first: usize,
    },
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Tempo {
    /// Metres a second.
    Pace(f64),
    /// The whole walk takes this long.
    Within(Lasts),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Lasts {
    For(Span),
    /// Up to the next such time of day, since midnight.
    Until(Span),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Pastime {
    Still(Posture),
    Stirring { posture: Posture, every: Span, lasting: Span, amplitude_m: f64 },
    Away,
}

#[derive(Clone, Copy, Debug)]
enum UnderWay {
    Walk(LegWalk),
    Stay { begin: RunTime, end: RunTime, pastime: Pastime },
}

#[derive(Clone, Copy, Debug)]
struct LegWalk {
    begin: RunTime,
    end: RunTime,
    speed_mps: f64,
    waypoint: usize,
    covered_m: f64,
}

#[derive(Clone, Copy, Debug)]
struct RepeatPass {
    began: RunTime,
    /// Passes to do, this one included; `None` without end.
    left: Option<u32>,
}

/// A path whose places and times of day are found. One of a [`Scenario`](crate::scenario::load::Scenario) has passed its checks
/// besides.
#[derive(Clone, Debug, PartialEq)]
pub struct ResolvedPath {
    file: PathFile,
    steps: Arc<[FlatStep]>,
    start: Point,
}

impl ResolvedPath {
    /// Resolves the names of a file of a resident with this pace in a home; `None` for an unknown place or an invalid
    /// time of day.
    pub fn new(file: PathFile, plan: &Plan, pace_mps: f64) -> Option<ResolvedPath> {
        let mut steps = Vec::new();
        flatten(&file.steps, plan, pace_mps, &mut steps)?;
        let start = plan.spot(&file.start)?;
        Some(ResolvedPath { steps: steps.into(), start, file })
    }
}

impl Deref for ResolvedPath {
    type Target = PathFile;

    fn deref(&self) -> &PathFile {
        &self.file
    }
}

impl PathDriver {
    /// The driver of a path; `start_of_day` is the time from local midnight to the scenario's start.
    pub fn new(path: &ResolvedPath, start_of_day: Span) -> PathDriver {
        PathDriver {
            steps: path.steps.clone(),
            start_of_day,
            step: 0,
            under_way: None,
            passes: Vec::new(),
            at: path.start,
            posture: path.posture,
        }
    }

    /// The movement from `now` on; at the end of the steps, a rest for ever.
    fn after(&mut self, now: RunTime) -> Next {
        let steps = Arc::clone(&self.steps);
        while let Some(step) = steps.get(self.step) {
            let (under_way, waypoints) = match step {
                FlatStep::Go { to, tempo } => {
                    (self.under_way.unwrap_or_else(|| self.set_out(to, *tempo, now)), &to[..])
                }
                FlatStep::Stay { lasts, pastime } => {
                    let stay = || UnderWay::Stay { begin: now, end: self.end_of(*lasts, now), pastime: *pastime };
                    (self.under_way.unwrap_or_else(stay), &[][..])
                }
                FlatStep::Activity(name) => {
                    self.step += 1;
                    return Next::Activity(name.clone());
                }
                FlatStep::Repeat { times } => {
                    self.passes.push(RepeatPass { began: now, left: *times });
                    self.step += 1;
                    continue;
                }
                FlatStep::Again { first } => {
                    self.step = self.after_pass(*first, now);
                    continue;
                }
            };
            let span = match under_way {
                UnderWay::Walk(walk) => self.stride(walk, waypoints, now),
                UnderWay::Stay { begin, end, pastime } => {
                    self.under_way = Some(under_way);
                    self.stay(begin, end, pastime, now)
                }
            };
            if let Some(span) = span {
                return Next::Segment(span);
            }
            self.under_way = None;
            self.step += 1;
        }
        let doing = MotionState::Rest { at: self.at };
        Next::Segment(MotionSegment { begin: now, end: RunTime::NEVER, doing, posture: self.posture })
    }

    /// Begins a walk. One to where the resident already is takes no time, unless the file says when
    /// it ends: then the resident stands there until then.
    fn set_out(&self, waypoints: &[Point], tempo: Tempo, now: RunTime) -> UnderWay {
        let (mut length_m, mut from) = (0.0, self.at);
        for &to in waypoints {
            length_m += from.distance(to);
            from = to;
        }
        let end = match tempo {
            Tempo::Pace(mps) => later(now, length_m / mps),
            // A walk from 07:30 that ends at 07:30 ends tomorrow.
            Tempo::Within(Lasts::Until(time)) => self.end_of(Lasts::Until(time), now.saturating_add(Span::MICROSECOND)),
            Tempo::Within(lasts) => self.end_of(lasts, now),
        };
        if length_m == 0.0 {
            return UnderWay::Stay { begin: now, end, pastime: Pastime::Still(Posture::Standing) };
        }
        // However short, a walk takes time: the body is never in two places at once.
        let end = end.max(now.saturating_add(Span::MICROSECOND)).max(later(now, length_m / GREATEST_SPEED_MPS));
        let speed_mps = match tempo {
            Tempo::Pace(mps) => mps,
            Tempo::Within(_) => length_m / (end - now).seconds(),
        };
        UnderWay::Walk(LegWalk { begin: now, end, speed_mps, waypoint: 0, covered_m: 0.0 })
    }

    fn stride(&mut self, mut walk: LegWalk, waypoints: &[Point], now: RunTime) -> Option<MotionSegment> {
        let (from, mut to, mut end) = (self.at, self.at, now);
        while let Some(&waypoint) = waypoints.get(walk.waypoint) {
            let covered_m = walk.covered_m + to.distance(waypoint);
            let last = walk.waypoint + 1 == waypoints.len();
            let reached = if last { walk.end } else { later(walk.begin, covered_m / walk.speed_mps).min(walk.end) };
            // A leg without length, or shorter than a microsecond's walk, is one with its neighbour:
            // a stride always takes time.
            if end > now && reached > end && covered_m > walk.covered_m {
                break;
            }
            (to, end) = (waypoint, reached);
            walk.covered_m = covered_m;
            walk.waypoint += 1;
        }
        if end <= now {
            return None;
        }
        self.under_way = Some(UnderWay::Walk(walk));
        (self.at, self.posture) = (to, Posture::Standing);
        Some(MotionSegment { begin: now, end, doing: MotionState::Stride { from, to }, posture: self.posture })
    }

    /// The next span of a stay from `begin` to `end`; `None` at its end.
    fn stay(&mut self, begin: RunTime, end: RunTime, pastime: Pastime, now: RunTime) -> Option<MotionSegment> {
        if end <= now {
            return None;
        }
        let at = self.at;
        let (until, doing, posture) = match pastime {
            Pastime::Still(posture) => (end, MotionState::Rest { at }, posture),
            Pastime::Away => (end, MotionState::Away, Posture::Standing),
            Pastime::Stirring { every, lasting, amplitude_m, posture } => {
                let began = now - (now - begin) % every;
                let ended = began.saturating_add(lasting);
                if now < ended {
                    (ended, MotionState::InPlace { at, amplitude_m }, posture)
                } else {
                    (began.saturating_add(every), MotionState::Rest { at }, posture)
                }
            }
        };
        self.posture = posture;
        Some(MotionSegment { begin: now, end: until.min(end), doing, posture })
    }

    fn after_pass(&mut self, first: usize, now: RunTime) -> usize {
        let beyond = self.step + 1;
        let Some(pass) = self.passes.last_mut() else { return beyond };
        // A pass that took no time changed nothing, and neither would the next ones.
        if pass.began == now && pass.left.is_none() {
            return self.steps.len();
        }
        pass.left = pass.left.map(|left| left - 1);
        if pass.began == now || pass.left == Some(0) {
            self.passes.pop();
            return beyond;
        }
        pass.began = now;
        first
    }

    /// The end of a span that begins now.
    fn end_of(&self, lasts: Lasts, now: RunTime) -> RunTime {
        match lasts {
            Lasts::For(span) => now.saturating_add(span),
            Lasts::Until(time) => {
                let time_now = (now.since_zero() % DAY + self.start_of_day) % DAY;
                now.saturating_add((time - time_now).rem_euclid(DAY))
            }
        }
    }
}

impl Driver for PathDriver {
    fn next(&mut self, around: &Surroundings) -> Next {
        self.after(around.now())
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}

/// Appends the steps as a flat list, with each repeat between `Repeat` and `Again`.
fn flatten(steps: &[PathStep], plan: &Plan, pace_mps: f64, flat: &mut Vec<FlatStep>) -> Option<()> {
    for step in steps {
        match step {
            PathStep::Go(go) => {
                let to = go.to.iter().map(|spot| plan.spot(spot)).collect::<Option<_>>()?;
                let tempo = match (go.pace_mps, go.in_s, &go.arrive_at) {
                    (Some(mps), _, _) => Tempo::Pace(mps),
                    (None, None, None) => Tempo::Pace(pace_mps),
                    (None, in_s, arrive_at) => Tempo::Within(lasts(in_s, arrive_at)?),
                };
                flat.push(FlatStep::Go { to, tempo });
            }
            PathStep::Wait(wait) => {
                let posture = wait.posture;
                let pastime = match &wait.stir {
                    None => Pastime::Still(posture),
                    Some(stir) => Pastime::Stirring {
                        posture,
                        every: Span::from_seconds(stir.every_s).max(Span::MICROSECOND),
                        lasting: Span::from_seconds(stir.for_s.min(stir.every_s)),
                        amplitude_m: stir.amplitude_m,
                    },
                };
                flat.push(FlatStep::Stay { lasts: lasts(wait.for_s, &wait.until)?, pastime });
            }
            PathStep::Repeat(repeat) => {
                flat.push(FlatStep::Repeat { times: repeat.times });
                let first = flat.len();
                flatten(&repeat.steps, plan, pace_mps, flat)?;
                flat.push(FlatStep::Again { first });
            }
            PathStep::Activity(name) => flat.push(FlatStep::Activity((!name.is_empty()).then(|| name.clone()))),
            PathStep::Away(away) => {
                flat.push(FlatStep::Stay { lasts: lasts(away.for_s, &away.until)?, pastime: Pastime::Away });
            }
        }
    }
    Some(())
}

fn lasts(for_s: Option<f64>, until: &Option<String>) -> Option<Lasts> {
    Some(match (for_s, until) {
        (Some(for_s), _) => Lasts::For(Span::from_seconds(for_s)),
        (None, Some(until)) => Lasts::Until(time_of_day(until)?),
        (None, None) => Lasts::For(Span::ZERO),
    })
}

fn later(begin: RunTime, span_s: f64) -> RunTime {
    begin.saturating_add(Span::from_seconds(span_s))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::point;
    use crate::time::{HOUR, SECOND};
    use serde_json::{Value, json};

    /// A driver that starts at (0, 0) at seven in the morning, with a pace of 0.5 m/s.
    fn driver(steps: Value) -> PathDriver {
        let home = json!({
            "name": "a room", "walls": [], "rooms": [{ "name": "room", "outline": [[0, 0], [9, 0], [9, 9], [0, 9]] }],
            "places": [{ "name": "sink", "at": [3, 4] }],
        });
        let path = json!({ "start": [0, 0], "steps": steps });
        let home = serde_json::from_value(home).unwrap();
        let path = ResolvedPath::new(serde_json::from_value(path).unwrap(), &Plan::new(&home), 0.5);
        PathDriver::new(&path.unwrap(), 7 * HOUR)
    }

    #[test]
    fn rejects_paths_to_unknown_places() {
        let home = json!({ "name": "a room", "walls": [], "rooms": [{ "name": "room", "outline": [[0, 0], [9, 0], [9, 9]] }] });
        let plan = Plan::new(&serde_json::from_value(home).unwrap());
        let is_path = |start: Value, steps: Value| {
            let file = serde_json::from_value(json!({ "start": start, "steps": steps })).unwrap();
            ResolvedPath::new(file, &plan, 0.5).is_some()
        };
        let again = |step: Value| json!([{ "repeat": { "steps": [step] } }]);
        assert!(is_path(json!("room"), again(json!({ "wait": { "until": "07:30" } }))));
        assert!(!is_path(json!("sink"), json!([])));
        assert!(!is_path(json!("room"), again(json!({ "go": { "to": ["room", "sink"] } }))));
        assert!(!is_path(json!("room"), again(json!({ "away": { "until": "25:00" } }))));
    }

    /// The movements up to the first span that ends at `until` or later, checked to have no gaps.
    fn spans(driver: &mut PathDriver, until: Span) -> Vec<MotionSegment> {
        let (mut now, mut at, mut spans) = (RunTime::START, driver.at, Vec::new());
        while now.since_zero() < until {
            match driver.after(now) {
                Next::Segment(span) if span.end == RunTime::NEVER => {
                    assert_eq!(span.doing, MotionState::Rest { at: driver.at });
                    break;
                }
                Next::Segment(span) => {
                    assert_eq!(span.begin, now);
                    assert!(span.end > span.begin);
                    match span.doing {
                        MotionState::Stride { from, .. } => assert_eq!(from, at),
                        MotionState::Rest { at: here } | MotionState::InPlace { at: here, .. } => assert_eq!(here, at),
                        MotionState::Away => {}
                    }
                    now = span.end;
                    at = driver.at;
                    spans.push(span);
                }
                _ => {}
            }
        }
        spans
    }

    fn done(begin: RunTime) -> Next {
        let doing = MotionState::Rest { at: Point::ZERO };
        Next::Segment(MotionSegment { begin, end: RunTime::NEVER, doing, posture: Posture::Standing })
    }

    fn ends(spans: &[MotionSegment]) -> Vec<Span> {
        spans.iter().map(|span| span.end.since_zero()).collect()
    }

    #[test]
    fn waypoints_are_reached_to_the_microsecond() {
        let thirds = json!([{ "go": { "to": [[0.1, 0], [0.2, 0], [0.3, 0]], "pace_mps": 0.3 } }]);
        assert_eq!(ends(&spans(&mut driver(thirds), HOUR)), [333_333, 666_667, 1_000_000].map(Span::from_micros));

        let to_the_sink = json!([{ "go": { "to": ["sink"] } }]);
        let stride = MotionState::Stride { from: Point::ZERO, to: point([3.0, 4.0]) };
        let only = MotionSegment {
            begin: RunTime::START,
            end: RunTime::START + 10 * SECOND,
            doing: stride,
            posture: Posture::Standing,
        };
        assert_eq!(spans(&mut driver(to_the_sink), HOUR), [only]);

        let in_ten_seconds = json!([{ "go": { "to": [[1, 0], [4, 0]], "in_s": 10 } }]);
        assert_eq!(ends(&spans(&mut driver(in_ten_seconds), HOUR)), [5 * SECOND / 2, 10 * SECOND]);

        let by_half_past = json!([{ "go": { "to": [[1, 0], [4, 0]], "arrive_at": "07:30" } }]);
        assert_eq!(ends(&spans(&mut driver(by_half_past), HOUR)), [HOUR / 8, HOUR / 2]);

        let by_now = json!([{ "go": { "to": [[4, 0]], "arrive_at": "07:00" } }]);
        assert_eq!(ends(&spans(&mut driver(by_now), HOUR)), [DAY]);
    }

    #[test]
    fn many_waypoints_do_not_drift() {
        let waypoints: Vec<_> = (1..=100_000).map(|i| json!([f64::from(i % 2) * 0.125, 0])).collect();
        let spans = spans(&mut driver(json!([{ "go": { "to": waypoints, "pace_mps": 0.3 } }])), DAY);
        assert_eq!(spans.len(), 100_000);
        assert_eq!(spans[99_998].end.micros(), 41_666_250_000);
        assert_eq!(spans[99_999].end.micros(), 41_666_666_667);
    }

    #[test]
    fn legs_without_length_are_no_strides() {
        let here = json!([{ "go": { "to": [[0, 0], [0, 0]] } }]);
        assert_eq!(driver(here).after(RunTime::START), done(RunTime::START));
        let with_stops = json!([{ "go": { "to": [[0, 0], [1, 0], [1, 0], [2, 0], [2, 0]] } }]);
        assert_eq!(ends(&spans(&mut driver(with_stops), HOUR)), [2 * SECOND, 4 * SECOND]);
        let with_specks = json!([{ "go": { "to": [[1e-9, 0], [1, 0], [1, 1e-9], [2, 0], [2, 1e-9]], "in_s": 4 } }]);
        let mut speck_driver = driver(with_specks);
        assert_eq!(ends(&spans(&mut speck_driver, HOUR)), [2 * SECOND, 4 * SECOND]);
        assert_eq!(speck_driver.at, point([2.0, 1e-9]));
        let stand = json!([{ "go": { "to": [[0, 0]], "in_s": 5 } }]);
        let rest = MotionState::Rest { at: Point::ZERO };
        let only = MotionSegment {
            begin: RunTime::START,
            end: RunTime::START + 5 * SECOND,
            doing: rest,
            posture: Posture::Standing,
        };
        assert_eq!(spans(&mut driver(stand), HOUR), [only]);
    }

    #[test]
    fn repeats_nest() {
        let steps = json!([
            { "repeat": { "times": 3, "steps": [
                { "repeat": { "times": 2, "steps": [{ "go": { "to": [[1, 0], [0, 0]], "pace_mps": 1 } }] } },
                { "wait": { "for_s": 10, "posture": "sitting" } },
            ] } },
            { "away": { "for_s": 60 } },
        ]);
        let spans = spans(&mut driver(steps), DAY);
        assert_eq!(spans.len(), 3 * (2 * 2 + 1) + 1);
        assert_eq!(spans[4].posture, Posture::Sitting);
        assert_eq!(spans[14].end.since_zero(), 3 * 14 * SECOND);
        assert_eq!((spans[15].end.since_zero(), spans[15].doing), (102 * SECOND, MotionState::Away));
    }

    #[test]
    fn an_endless_path_takes_no_more_memory_after_ten_years() {
        let mut driver = driver(json!([{ "repeat": { "steps": [
            { "go": { "to": ["sink"], "arrive_at": "07:30" } },
            { "repeat": { "times": 3, "steps": [{ "go": { "to": [[4, 4], [3, 4]] } }] } },
            { "go": { "to": [[0, 0]] } },
            { "wait": { "until": "22:30", "stir": { "every_s": 600, "for_s": 4 } } },
        ] } }]));
        let (mut now, mut most_open) = (RunTime::START, 0);
        let ten_years = RunTime::START + 3_652 * DAY;
        while now < ten_years {
            let Next::Segment(span) = driver.after(now) else { panic!("the path has ended at {now}") };
            assert!(span.begin == now && span.end > now);
            now = span.end;
            most_open = most_open.max(driver.passes.capacity());
        }
        assert!(most_open <= 4);
        assert_eq!(now, ten_years + HOUR / 2, "the last night's walk arrives at 07:30");
    }

    #[test]
    fn a_wait_cuts_its_last_stir() {
        let steps = json!([{ "wait": { "for_s": 62, "posture": "lying", "stir": {
            "every_s": 30, "for_s": 4, "amplitude_m": 0.1,
        } } }]);
        let spans = spans(&mut driver(steps), HOUR);
        assert_eq!(ends(&spans), [4, 30, 34, 60, 62].map(|s| s * SECOND));
        for (index, span) in spans.iter().enumerate() {
            let stir = MotionState::InPlace { at: Point::ZERO, amplitude_m: 0.1 };
            assert_eq!(span.doing, if index % 2 == 0 { stir } else { MotionState::Rest { at: Point::ZERO } });
            assert_eq!(span.posture, Posture::Lying);
        }
    }

    #[test]
    fn until_is_the_next_such_time_of_day() {
        let until = |time: &str| ends(&spans(&mut driver(json!([{ "wait": { "until": time } }])), DAY));
        assert_eq!(until("07:30"), [HOUR / 2]);
        assert_eq!(until("06:59:59.5"), [DAY - SECOND / 2]);
        assert_eq!(until("00:00"), [17 * HOUR]);
        assert!(until("07:00").is_empty());

        let nights = json!([{ "repeat": { "times": 2, "steps": [
            { "wait": { "until": "23:00" } }, { "away": { "until": "06:00" } },
        ] } }]);
        assert_eq!(ends(&spans(&mut driver(nights), 3 * DAY)), [16, 23, 40, 47].map(|hours| hours * HOUR));
    }

    #[test]
    fn activities_take_no_time() {
        let mut driver = driver(json!([{ "activity": "tea" }, { "activity": "" }, { "wait": { "for_s": 1 } }]));
        assert_eq!(driver.after(RunTime::START), Next::Activity(Some("tea".into())));
        assert_eq!(driver.after(RunTime::START), Next::Activity(None));
        assert!(matches!(driver.after(RunTime::START), Next::Segment(_)));
        assert_eq!(driver.after(RunTime::START + SECOND), done(RunTime::START + SECOND));
        assert_eq!(driver.after(RunTime::START + SECOND), done(RunTime::START + SECOND));
    }

    #[test]
    fn a_loop_that_takes_no_time_ends() {
        let steps = json!([{ "repeat": { "steps": [{ "activity": "x" }, { "go": { "to": [[0, 0]] } }] } }]);
        let mut endless = driver(steps);
        assert_eq!(endless.after(RunTime::START), Next::Activity(Some("x".into())));
        assert_eq!(endless.after(RunTime::START), done(RunTime::START));

        let steps = json!([
            { "repeat": { "times": u32::MAX, "steps": [{ "wait": { "until": "07:00" } }] } },
            { "wait": { "for_s": 1 } },
        ]);
        assert_eq!(ends(&spans(&mut driver(steps), HOUR)), [SECOND]);
    }

    #[test]
    fn times_without_end_saturate() {
        let steps = json!([{ "repeat": { "steps": [{ "wait": { "for_s": 1e300 } }] } }]);
        let mut driver = driver(steps);
        assert!(matches!(driver.after(RunTime::START), Next::Segment(MotionSegment { end: RunTime::NEVER, .. })));
    }

    #[test]
    fn a_copy_continues_as_the_original() {
        let mut original = driver(json!([{ "repeat": { "steps": [
            { "go": { "to": [[1, 0], [1, 1], [0, 0]] } }, { "wait": { "for_s": 7, "stir": { "every_s": 2, "for_s": 1 } } },
        ] } }]));
        let mut now = RunTime::START;
        for _ in 0..100 {
            let mut copy = original.clone();
            let next = original.after(now);
            assert_eq!(copy.after(now), next);
            let Next::Segment(span) = next else { panic!("the path has ended") };
            now = span.end;
        }
    }
}
