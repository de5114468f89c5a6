//! The naive simulation: looks sixty times a second, compares, counts. Tests compare the kernel with it, and benchmarks
//! use it as the baseline.
//!
//! There are two kinds of looks: [`paper`], with the physics engine casting every ray of every sensor, and [`brute`],
//! plain arithmetic on the same beams.

pub mod brute;
pub mod paper;

use homebody_core::event::{Firing, Value};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::ids::SensorId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::random::Stream;
use homebody_core::sensors::timing::FiringTiming;
use homebody_core::time::{RunTime, SECOND};

/// Reports the sensors that notice a change since the last look.
pub trait Eye {
    /// `bodies` are the present poses; `changed[i]` is set if sensor i notices a change.
    fn look(&mut self, bodies: &[Pose], changed: &mut [bool]);
}

/// A body at an instant. While it stirs, its radius shrinks by an amplitude and recovers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    pub at: Point,
    pub radius_m: f64,
}

/// The game loop of Godsey & Skubic 2009: collects input, steps the physics, and updates all objects by the time
/// passed.
pub struct Loop<E> {
    eye: E,
    counters: Vec<Counter>,
    changed: Vec<bool>,
    update: i64,
    /// Simulated time between two updates, as a multiple of 1/60 s.
    speed: i64,
    remainder: Remainder,
    seq: u64,
}

/// A counter's treatment of the time between its end and the update that notices it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remainder {
    /// The next wait begins at the end, so delays do not add up.
    Kept,
    /// The next wait begins at the update, as in a plain counter.
    Lost,
}

impl<E: Eye> Loop<E> {
    /// A loop at `speed` times real time: its step grows with its speed, as in the paper.
    pub fn new(eye: E, home: &Home, seed: u64, speed: i64, remainder: Remainder) -> Loop<E> {
        let counter = |sensor: &homebody_core::sensors::Sensor| Counter {
            timing: sensor.timing,
            stream: Stream::named(seed, &format!("sensor/{}/timing", sensor.name)),
            state: DetectorState::Idle,
            last_seen: None,
        };
        let counters: Vec<Counter> = home.sensors.iter().map(counter).collect();
        Loop { eye, changed: vec![false; counters.len()], counters, update: 0, speed, remainder, seq: 0 }
    }

    pub fn next_update(&self) -> RunTime {
        RunTime::START + self.update * self.speed * SECOND / 60
    }

    /// One update: compares the present bodies with the last ones, and adds firings.
    pub fn update(&mut self, bodies: &[Pose], firings: &mut Vec<Firing>) {
        let now = self.next_update();
        self.eye.look(bodies, &mut self.changed);
        // The first look has nothing to compare with.
        let first = self.update == 0;
        for (sensor, counter) in self.counters.iter_mut().enumerate() {
            counter.update(now, self.changed[sensor] && !first, self.remainder, |at| {
                firings.push(Firing { seq: self.seq, at, sensor: SensorId::new(sensor), value: Value::Fire });
                self.seq += 1;
            });
        }
        self.update += 1;
    }

    /// Runs some residents until `until`.
    pub fn run(&mut self, players: &mut [Player], until: RunTime, firings: &mut Vec<Firing>) {
        let mut poses = Vec::with_capacity(players.len());
        while self.next_update() < until {
            let now = self.next_update();
            poses.clear();
            poses.extend(players.iter_mut().map(|life| life.pose(now)));
            self.update(&poses, firings);
        }
    }
}

/// One sensor's counter with the timing of the paper, checked once an update.
struct Counter {
    timing: FiringTiming,
    stream: Stream,
    state: DetectorState,
    last_seen: Option<RunTime>,
}

enum DetectorState {
    Idle,
    Delay { fire: RunTime },
    Wait { decide: RunTime },
}

impl Counter {
    fn update(&mut self, now: RunTime, changed: bool, remainder: Remainder, mut fire: impl FnMut(RunTime)) {
        let counted_from = |due| if remainder == Remainder::Kept { due } else { now };
        loop {
            match self.state {
                DetectorState::Idle if changed => {
                    self.state = DetectorState::Delay { fire: now + self.stream.span(self.timing.first_fire) };
                }
                DetectorState::Delay { fire: at } if now >= at => {
                    let at = counted_from(at);
                    fire(at);
                    self.state = DetectorState::Wait { decide: at + self.stream.span(self.timing.refire) };
                }
                DetectorState::Wait { decide } if now >= decide => {
                    let seen = if changed { Some(now) } else { self.last_seen };
                    if seen.is_some_and(|seen| seen >= decide - self.timing.persist) {
                        let at = counted_from(decide);
                        fire(at);
                        self.state = DetectorState::Wait { decide: at + self.stream.span(self.timing.refire) };
                    } else {
                        self.state = DetectorState::Idle;
                    }
                }
                _ => break,
            }
        }
        if changed {
            self.last_seen = Some(now);
        }
    }
}

/// The place of a resident by planned moves.
#[derive(Clone)]
pub struct Player<'a> {
    moves: &'a [MotionSegment],
    next: usize,
    looks: u32,
    radius_m: f64,
}

impl<'a> Player<'a> {
    /// The moves follow each other without gaps; the radius is in metres.
    pub fn new(moves: &'a [MotionSegment], radius_m: f64) -> Player<'a> {
        Player { moves, next: 0, looks: 0, radius_m }
    }

    /// The body at an instant, which must not be earlier than at the last call. The last move continues.
    fn pose(&mut self, now: RunTime) -> Pose {
        while self.next + 1 < self.moves.len() && self.moves[self.next].end <= now {
            self.next += 1;
            self.looks = 0;
        }
        self.looks += 1;
        let MotionSegment { begin, end, doing, .. } = &self.moves[self.next];
        match *doing {
            MotionState::Stride { from, to } => {
                let at = from + (to - from) * (now.min(*end) - *begin).ratio(*end - *begin);
                Pose { at, radius_m: self.radius_m }
            }
            MotionState::InPlace { at, amplitude_m } => {
                let breath = if self.looks.is_multiple_of(2) { 0.0 } else { amplitude_m.min(self.radius_m / 2.0) };
                Pose { at, radius_m: self.radius_m - breath }
            }
            MotionState::Rest { at } => Pose { at, radius_m: self.radius_m },
            MotionState::Away => Pose { at: Point::splat(1e6), radius_m: self.radius_m },
        }
    }
}
