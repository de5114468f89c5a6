//! Moves a body by held keys through the physics.
//!
//! What it does: sixty times a second the body tries to move the way the keys point, runs into
//! walls, furniture, closed doors and other people, and slides along them.
//!
//! What we assume: a body is a ball seen from above, and nothing it runs into gives way.
//!
//! How: see [`obstacles`] for how far a body gets in a step. A step ends at a whole microsecond
//! counted from the scenario's start, so steps never drift.
//!
//! What is left out: turning, getting up to speed, postures, and leaving the home: a door that leads
//! out stops the body even when it is open.

mod obstacles;

use super::{Body, Move, Next};
use crate::event::Doing;
use crate::geometry::Point;
use crate::home::plan::Plan;
use crate::scenario::input::{InputFile, Key};
use crate::scenario::path::Posture;
use crate::time::{Micros, SECOND, micros, seconds};
use obstacles::Obstacles;
use std::collections::VecDeque;

/// As the paper's game engine: sixty updates a second.
const STEPS_PER_SECOND: Micros = 60;

/// Less than this in a step is the noise of the engine's `f32`, not movement: a body that pushes
/// against a wall keeps still.
const STILL_M: f64 = 1e-5;

/// A resident whose body is moved by held keys.
#[derive(Clone, Debug)]
pub struct LiveDriver {
    keys: KeyTrack,
    pace_mps: f64,
    at: Point,
    obstacles: Obstacles,
}

impl LiveDriver {
    /// The driver of a body that stands at `start`.
    pub fn new(plan: &Plan, start: Point, radius_m: f64, pace_mps: f64, keys: KeyTrack) -> LiveDriver {
        LiveDriver { keys, pace_mps, at: start, obstacles: Obstacles::new(plan, radius_m) }
    }

    /// From `at` on exactly these keys are held, whatever else was to come.
    pub fn hold(&mut self, at: Micros, keys: Held) {
        self.keys.hold(at, keys);
    }

    /// What the resident does from `now` on; `others` are the bodies to run into.
    pub fn next(&mut self, now: Micros, others: &[Body]) -> Next {
        let held = self.keys.held_at(now);
        let velocity = held.direction() * (self.pace_mps * held.haste());
        let step_end = step_from(now.saturating_add(1));
        let end = if velocity != Point::ZERO || self.keys.open {
            step_end
        } else {
            match self.keys.next_change() {
                Some(change) => step_from(change),
                None => return Next::Done,
            }
        };
        if end <= now {
            return Next::Done;
        }
        let mut doing = Doing::Rest { at: self.at };
        if velocity != Point::ZERO {
            let (from, to) = (self.at, self.obstacles.slide(self.at, velocity * seconds(end - now), others));
            if from.distance(to) >= STILL_M {
                self.at = to;
                doing = Doing::Stride { from, to };
            }
        }
        Next::Move(Move { begin: now, end, doing, posture: Posture::Standing })
    }

    /// Where the body is, and how, at the end of the spans handed out so far.
    pub fn pose(&self) -> (Point, Posture) {
        (self.at, Posture::Standing)
    }
}

/// The first end of a step at or after an instant.
fn step_from(at: Micros) -> Micros {
    let within = at % SECOND;
    let steps = (within * STEPS_PER_SECOND + SECOND - 1) / SECOND;
    (at - within).saturating_add(steps * SECOND / STEPS_PER_SECOND)
}

/// Which keys are held, and when that changes.
#[derive(Clone, Debug)]
pub struct KeyTrack {
    held: Held,
    /// The changes to come, in order of time.
    coming: VecDeque<(Micros, Held)>,
    /// Whether changes that are not known yet may come: then no rest is longer than a step.
    open: bool,
}

impl KeyTrack {
    /// The keys of a file; nothing comes after its last line.
    pub fn written(input: &InputFile) -> KeyTrack {
        let mut coming: Vec<_> =
            input.keys.iter().map(|keys| (micros(keys.at_s), keys.held.iter().copied().collect())).collect();
        coming.sort_by_key(|&(at, _)| at);
        KeyTrack { held: Held::default(), coming: coming.into(), open: false }
    }

    /// No keys yet: they come while the run goes on.
    pub fn live() -> KeyTrack {
        KeyTrack { held: Held::default(), coming: VecDeque::new(), open: true }
    }

    fn hold(&mut self, at: Micros, held: Held) {
        while self.coming.back().is_some_and(|&(later, _)| later >= at) {
            self.coming.pop_back();
        }
        self.coming.push_back((at, held));
    }

    fn held_at(&mut self, now: Micros) -> Held {
        while let Some(&(at, held)) = self.coming.front()
            && at <= now
        {
            self.held = held;
            self.coming.pop_front();
        }
        self.held
    }

    fn next_change(&self) -> Option<Micros> {
        self.coming.front().map(|&(at, _)| at)
    }
}

/// A set of keys that are held down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Held(u8);

impl FromIterator<Key> for Held {
    fn from_iter<T: IntoIterator<Item = Key>>(keys: T) -> Held {
        Held(keys.into_iter().fold(0, |held, key| held | 1 << key as u8))
    }
}

impl Held {
    fn has(self, key: Key) -> bool {
        self.0 & 1 << key as u8 != 0
    }

    /// Where the keys point, of length 1; opposite keys cancel out.
    fn direction(self) -> Point {
        let axis = |towards, away| f64::from(self.has(towards)) - f64::from(self.has(away));
        Point::new(axis(Key::Right, Key::Left), axis(Key::Up, Key::Down)).normalize_or_zero()
    }

    /// What the pace is multiplied by.
    fn haste(self) -> f64 {
        (if self.has(Key::Fast) { 2.0 } else { 1.0 }) * (if self.has(Key::Slow) { 0.5 } else { 1.0 })
    }
}
