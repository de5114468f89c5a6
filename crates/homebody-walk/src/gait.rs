//! Walking along a path: speed, setting off, turning and stopping; getting up and sitting down.
//!
//! A walk sets off, goes at one speed, slows down before sharp turns and its end, and turns sharply on the spot. The
//! body moves on the spot for some seconds while it gets up or sits down.
//!
//! We assume the speeds of people of 86 years in their homes: on average a person's own pace, from walk to walk with the
//! spread that Kaye et al. (2012) saw between persons, faster in the morning, slower in the evening. A person who is
//! frail or has a walking aid is slower, varies more, and takes longer to set off, turn, get up and sit down.
//!
//! The speed of a walk is lognormal. Speeding up evenly from nothing over a stretch takes as long as going through it at
//! half the speed, so it is one stride at half the speed, and slowing down likewise. All times are counted from the
//! beginning of the walk, so rounding to microseconds never adds up.
//!
//! Left out: the sway of the trunk, 2 to 5 cm to each side at every other step, which is smaller than what a motion sensor
//! tells apart; single steps; slower walking in gentle bends; the turn before the first step.

use homebody_core::geometry::Point;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::numbers::Numbers;
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::time::{RunTime, Span};
use std::f64::consts::PI;

homebody_core::numbers! {
    /// Standard deviation of the logarithm of speeds at home: sqrt(ln(1 + (0.15 / 0.65)^2)), for a mean of 0.65 m/s and
    /// a standard deviation of 0.15 (Kaye et al. 2012).
    static SPREAD = "gait.spread": 0.227_8, "1", [0.0, 0.6];
    /// Lowest walking speed of any person (after Kaye et al. 2012).
    static SLOWEST_MPS = "gait.slowest": 0.2, "m/s", [0.02, 0.6];
    /// Highest walking speed at home of a person with a pace of 0.65 m/s; in proportion for other paces (after Kaye et
    /// al. 2012).
    static FASTEST_MPS = "gait.fastest": 1.2, "m/s", [0.7, 3.0];
    /// Factor on speeds in the morning (direction after Kaye et al. 2012).
    static MORNING = "gait.morning": 1.05, "1", [0.5, 1.5];
    /// Factor on speeds in the evening and at night (direction after Kaye et al. 2012).
    static EVENING = "gait.evening": 0.95, "1", [0.5, 1.5];
    /// Largest share of the speed that frailty removes: from 0.65 m/s to household ambulation, 0.4 m/s and less, with
    /// the spread.
    static FRAIL_SLOWER = "gait.frail_slower": 0.35, "1", [0.0, 0.9];
    /// Largest share that frailty adds to the spread of speeds (Kaye et al. 2012: more variable with a walking aid).
    static FRAIL_SPREAD = "gait.frail_spread": 0.5, "1", [0.0, 3.0];
    /// Acceleration to the usual speed without frailty: within two steps (a social force with tau = 0.5 s gives the
    /// same).
    static ACCELERATION_MPS2 = "gait.acceleration": 1.0, "m/s2", [0.1, 5.0];
    /// Acceleration to the usual speed of a frail person.
    static FRAIL_ACCELERATION_MPS2 = "gait.frail_acceleration": 0.5, "m/s2", [0.1, 5.0];
    /// Duration of a turn by 180 degrees on the spot, without frailty.
    static HALF_TURN_S = "gait.half_turn": 2.0, "s", [0.2, 20.0];
    /// Duration of a turn by 180 degrees on the spot of a frail person.
    static FRAIL_HALF_TURN_S = "gait.frail_half_turn": 3.0, "s", [0.2, 20.0];
    /// Shortest duration of getting up and of sitting down, from 65 years on.
    static TRANSFER_LEAST_S = "gait.transfer_least": 2.0, "s", [0.2, 20.0];
    /// Longest duration of getting up and of sitting down, from 65 years on.
    static TRANSFER_MOST_S = "gait.transfer_most": 3.0, "s", [0.2, 20.0];
    /// Shortest duration of getting up and of sitting down of a frail person.
    static FRAIL_TRANSFER_LEAST_S = "gait.frail_transfer_least": 3.0, "s", [0.2, 60.0];
    /// Longest duration of getting up and of sitting down of a frail person.
    static FRAIL_TRANSFER_MOST_S = "gait.frail_transfer_most": 5.0, "s", [0.2, 60.0];
    /// Distance that the trunk moves forward in getting up and sitting down.
    static TRANSFER_AMPLITUDE_M = "gait.transfer_amplitude": 0.4, "m", [0.0, 1.0];
    /// Distance that shoulders and arms move in a turn on the spot.
    static TURN_AMPLITUDE_M = "gait.turn_amplitude": 0.3, "m", [0.0, 1.0];
    /// Angle above which a turn is made on the spot.
    static SHARP_TURN_DEG = "gait.sharp_turn": 60.0, "°", [10.0, 180.0];
}

/// The pace whose greatest speed [`FASTEST_MPS`] is: the mean of Kaye et al. (2012).
const USUAL_PACE_MPS: f64 = 0.65;

/// Length below which a leg has no direction to turn to, and distance from a corner within which changes of speed
/// happen at it (our choice).
const SHORT_M: f64 = 0.05;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gait {
    pub speed_mps: f64,
    pub acceleration_mps2: f64,
    pub half_turn_s: f64,
    pub sharp_turn_rad: f64,
    pub turn_amplitude_m: f64,
}

impl Gait {
    /// Draws two values. `pace_mps` is the person's usual speed, `hour_of_day` 0 to 24, `frailty` 0 to 1.
    pub fn for_walk(pace_mps: f64, hour_of_day: f64, frailty: f64, numbers: &Numbers, stream: &mut Stream) -> Gait {
        let frailty = frailty.clamp(0.0, 1.0);
        let time_of_day = match hour_of_day {
            hour if (5.0..12.0).contains(&hour) => numbers.of(&MORNING),
            hour if (12.0..18.0).contains(&hour) => 1.0,
            _ => numbers.of(&EVENING),
        };
        let spread = numbers.of(&SPREAD) * (1.0 + numbers.of(&FRAIL_SPREAD) * frailty);
        let mean_mps = pace_mps * time_of_day * (1.0 - numbers.of(&FRAIL_SLOWER) * frailty);
        let speed_mps = stream.lognormal(mean_mps * libm::exp(-spread * spread / 2.0), spread);
        let fastest_mps = numbers.of(&FASTEST_MPS);
        let fastest_mps = fastest_mps.max(pace_mps * (fastest_mps / USUAL_PACE_MPS));
        let of = |hale, frail| between([numbers.of(hale), numbers.of(frail)], frailty);
        Gait {
            speed_mps: speed_mps.min(fastest_mps).max(numbers.of(&SLOWEST_MPS)),
            acceleration_mps2: of(&ACCELERATION_MPS2, &FRAIL_ACCELERATION_MPS2),
            half_turn_s: of(&HALF_TURN_S, &FRAIL_HALF_TURN_S),
            sharp_turn_rad: numbers.of(&SHARP_TURN_DEG).to_radians(),
            turn_amplitude_m: numbers.of(&TURN_AMPLITUDE_M),
        }
    }
}

/// Strides and turns along a path: the corners after `from`, as [`Mesh::path`](crate::Mesh::path) gives them. An empty path
/// takes no time.
pub fn walk(path: &[Point], from: Point, begin: RunTime, gait: &Gait) -> Vec<MotionSegment> {
    let mut legs = Vec::new();
    let mut at = from;
    for &to in path.iter().filter(|to| to.is_finite()) {
        if to != at {
            legs.push((at, to));
            at = to;
        }
    }
    let mut walk = WalkBuilder { moves: Vec::new(), begin, now: begin, passed_s: 0.0 };
    let mut first = 0;
    for last in 0..legs.len() {
        let turn = legs.get(last + 1).map_or(0.0, |next| turn(legs[last], *next));
        if last + 1 == legs.len() || turn > gait.sharp_turn_rad {
            walk.stretch(&legs[first..=last], gait);
            first = last + 1;
        }
        if turn > gait.sharp_turn_rad {
            let doing = MotionState::InPlace { at: legs[last].1, amplitude_m: gait.turn_amplitude_m };
            walk.add(doing, gait.half_turn_s * turn / PI);
        }
    }
    walk.moves
}

/// Rising where the body sat or lay: 2 to 3 s, up to 5 s at a frailty of 1, unless the parameters differ. Draws one value.
pub fn rise(at: Point, begin: RunTime, frailty: f64, numbers: &Numbers, stream: &mut Stream) -> MotionSegment {
    sit(at, begin, frailty, Posture::Standing, numbers, stream)
}

/// Sitting or lying down, as long as rising. Draws one value.
pub fn sit(
    at: Point,
    begin: RunTime,
    frailty: f64,
    posture: Posture,
    numbers: &Numbers,
    stream: &mut Stream,
) -> MotionSegment {
    let frailty = frailty.clamp(0.0, 1.0);
    let of = |hale, frail| between([numbers.of(hale), numbers.of(frail)], frailty);
    let least_s = of(&TRANSFER_LEAST_S, &FRAIL_TRANSFER_LEAST_S);
    let span_s = stream.between(least_s, of(&TRANSFER_MOST_S, &FRAIL_TRANSFER_MOST_S));
    let doing = MotionState::InPlace { at, amplitude_m: numbers.of(&TRANSFER_AMPLITUDE_M) };
    MotionSegment { begin, end: begin.saturating_add(Span::from_seconds(span_s)), doing, posture }
}

struct WalkBuilder {
    moves: Vec<MotionSegment>,
    begin: RunTime,
    now: RunTime,
    /// Not rounded, so that errors do not add up.
    passed_s: f64,
}

impl WalkBuilder {
    fn stretch(&mut self, legs: &[(Point, Point)], gait: &Gait) {
        let length: f64 = legs.iter().map(|(a, b)| a.distance(*b)).sum();
        let starting_m = gait.speed_mps * gait.speed_mps / (2.0 * gait.acceleration_mps2);
        // Too short to reach the speed: it accelerates and brakes, at half the greatest speed on average.
        if length <= 2.0 * starting_m + SHORT_M {
            let speed = gait.speed_mps.min((gait.acceleration_mps2 * length).sqrt()) / 2.0;
            for &(from, to) in legs {
                self.add(MotionState::Stride { from, to }, from.distance(to) / speed);
            }
            return;
        }
        let mut covered = 0.0;
        for &(from, to) in legs {
            let leg = from.distance(to);
            let mut at = 0.0;
            for (until, speed) in [
                (starting_m, gait.speed_mps / 2.0),
                (length - starting_m, gait.speed_mps),
                (f64::INFINITY, gait.speed_mps / 2.0),
            ] {
                let mut to_cut = (until - covered).min(leg);
                if leg - to_cut < SHORT_M {
                    to_cut = leg;
                }
                if to_cut - at < SHORT_M.min(leg - at) {
                    continue;
                }
                let point = |along: f64| if along < leg { from + (to - from) * (along / leg) } else { to };
                self.add(MotionState::Stride { from: point(at), to: point(to_cut) }, (to_cut - at) / speed);
                at = to_cut;
                if at >= leg {
                    break;
                }
            }
            covered += leg;
        }
    }

    fn add(&mut self, doing: MotionState, span_s: f64) {
        self.passed_s += span_s;
        let end = self.begin.saturating_add(Span::from_seconds(self.passed_s)).max(self.now + Span::MICROSECOND);
        self.moves.push(MotionSegment { begin: self.now, end, doing, posture: Posture::Standing });
        self.now = end;
    }
}

/// In radians.
fn turn(leg: (Point, Point), next: (Point, Point)) -> f64 {
    let (before, after) = (leg.1 - leg.0, next.1 - next.0);
    if before.length() < SHORT_M || after.length() < SHORT_M {
        return 0.0;
    }
    libm::atan2(before.perp_dot(after), before.dot(after)).abs()
}

/// Interpolates by frailty, 0 to 1.
fn between([hale, frail]: [f64; 2], frailty: f64) -> f64 {
    hale + (frail - hale) * frailty
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;

    const GAIT: Gait = Gait {
        speed_mps: 1.0,
        acceleration_mps2: 1.0,
        half_turn_s: 2.0,
        sharp_turn_rad: PI / 3.0,
        turn_amplitude_m: 0.3,
    };

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    fn walked(path: &[Point], begin: RunTime, gait: &Gait) -> Vec<MotionSegment> {
        let moves = walk(path, Point::ZERO, begin, gait);
        let (mut now, mut at) = (begin, Point::ZERO);
        for step in &moves {
            assert!(step.begin == now && step.end > now && step.posture == Posture::Standing);
            now = step.end;
            match step.doing {
                MotionState::Stride { from, to } => {
                    assert_eq!(from, at);
                    at = to;
                }
                MotionState::InPlace { at: here, .. } => assert_eq!(here, at),
                _ => panic!("neither stride nor stir: {step:?}"),
            }
        }
        assert_eq!(at, path.last().copied().unwrap_or_default());
        moves
    }

    fn spans(moves: &[MotionSegment]) -> Vec<f64> {
        moves.iter().map(|step| (step.end - step.begin).seconds()).collect()
    }

    #[test]
    fn a_walk_sets_off_goes_and_stops() {
        // 0.5 m of setting off and of stopping, each in 1 s, and 3 m at 1 m/s.
        let moves = walked(&[p(4.0, 0.0)], RunTime::START + 5 * SECOND, &GAIT);
        assert_eq!(spans(&moves), [1.0, 3.0, 1.0]);
        assert_eq!(moves[0].doing, MotionState::Stride { from: Point::ZERO, to: p(0.5, 0.0) });
    }

    #[test]
    fn a_short_walk_does_not_reach_the_speed() {
        assert_eq!(spans(&walked(&[p(0.25, 0.0)], RunTime::START, &GAIT)), [1.0]);
        assert_eq!(walked(&[], RunTime::START, &GAIT).len(), 0);
        assert_eq!(walked(&[Point::ZERO], RunTime::START, &GAIT).len(), 0);
        assert_eq!(walked(&[p(1e-9, 0.0)], RunTime::START, &GAIT).len(), 1);
    }

    #[test]
    fn gentle_bends_cost_one_stride_each_and_sharp_turns_a_stop() {
        let gentle = walked(&[p(2.0, 0.0), p(4.0, 1.0), p(6.0, 1.0)], RunTime::START, &GAIT);
        assert_eq!(gentle.len(), 5);
        let sharp = walked(&[p(2.0, 0.0), p(2.0, 2.0)], RunTime::START, &GAIT);
        assert_eq!(spans(&sharp), [1.0; 7]);
        assert!(matches!(sharp[3].doing, MotionState::InPlace { .. }));
    }

    #[test]
    fn no_stride_is_needlessly_short_and_none_is_lost() {
        let mut stream = Stream::named(1, "paths");
        for _ in 0..500 {
            let path: Vec<Point> =
                (0..1 + stream.poisson(4.0)).map(|_| p(stream.between(-5.0, 5.0), stream.between(-5.0, 5.0))).collect();
            let gait = Gait::for_walk(0.65, stream.between(0.0, 24.0), stream.unit(), &Numbers::default(), &mut stream);
            let moves = walked(&path, RunTime::from_micros(77), &gait);
            let stops = moves.iter().filter(|step| matches!(step.doing, MotionState::InPlace { .. })).count();
            assert!(moves.len() <= path.len() + 2 + 3 * stops, "{} moves for {}", moves.len(), path.len());
            let length: f64 = [Point::ZERO].iter().chain(&path).zip(&path).map(|(a, b)| a.distance(*b)).sum();
            let strides = moves.iter().map(|step| match step.doing {
                MotionState::Stride { from, to } => from.distance(to),
                _ => 0.0,
            });
            assert!((strides.sum::<f64>() - length).abs() < 1e-9);
            let fastest = moves.iter().map(|step| match step.doing {
                MotionState::Stride { from, to } => from.distance(to) / (step.end - step.begin).seconds(),
                _ => 0.0,
            });
            assert!(fastest.fold(0.0, f64::max) <= gait.speed_mps * 1.001);
        }
    }

    #[test]
    fn speeds_are_those_of_old_people_at_home() {
        let mut stream = Stream::named(1, "speeds");
        let mut speeds = |pace, hour, frailty| -> (f64, f64) {
            let drawn: Vec<f64> = (0..20_000)
                .map(|_| Gait::for_walk(pace, hour, frailty, &Numbers::default(), &mut stream).speed_mps)
                .collect();
            assert!(drawn.iter().all(|speed| (0.2..=1.2).contains(speed)));
            let mean = drawn.iter().sum::<f64>() / drawn.len() as f64;
            let variance = drawn.iter().map(|speed| (speed - mean) * (speed - mean)).sum::<f64>() / drawn.len() as f64;
            (mean, variance.sqrt())
        };
        let (mean, sd) = speeds(0.65, 15.0, 0.0);
        assert!((mean - 0.65).abs() < 0.005 && (sd - 0.15).abs() < 0.005, "{mean} {sd}");
        let (morning, evening) = (speeds(0.65, 8.0, 0.0).0, speeds(0.65, 20.0, 0.0).0);
        assert!((morning / evening - 1.05 / 0.95).abs() < 0.01, "{morning} {evening}");
        let (frail, frail_sd) = speeds(0.65, 15.0, 1.0);
        assert!(frail < 0.66 * 0.66 && frail_sd / frail > sd / mean, "{frail} {frail_sd}");
    }

    #[test]
    fn getting_up_takes_seconds_and_longer_if_frail() {
        let mut stream = Stream::named(1, "chair");
        for _ in 0..200 {
            let hale = rise(p(1.0, 2.0), RunTime::START + SECOND, 0.0, &Numbers::default(), &mut stream);
            let frail =
                sit(p(1.0, 2.0), RunTime::START + SECOND, 1.0, Posture::Sitting, &Numbers::default(), &mut stream);
            assert!((2.0..=3.0).contains(&(hale.end - hale.begin).seconds()) && hale.posture == Posture::Standing);
            assert!((3.0..=5.0).contains(&(frail.end - frail.begin).seconds()) && frail.posture == Posture::Sitting);
        }
    }
}
