//! What somebody does at the keys.

use crate::event::ThingUse;
use crate::geometry::Point;
use crate::home::plan::Plan;
use crate::ids::ThingId;
use crate::scenario::input::{Key, KeysFile, UseFile};
use crate::scenario::path::Posture;

/// What somebody does at the keys from an instant on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Input {
    /// The keys that are held down from then on.
    pub held: Held,
    /// How the body holds itself from then on; who sits or lies does not walk.
    pub posture: Posture,
    /// What is used at that instant.
    pub uses: Vec<ThingUse>,
}

impl Input {
    /// The input that a line of a file describes, which has passed its checks.
    pub fn written(line: &KeysFile, plan: &Plan) -> Input {
        let act = |used: &UseFile| Some(ThingUse { thing: ThingId::of(plan.thing(&used.thing)?), on: used.on });
        Input {
            held: line.held.iter().copied().collect(),
            posture: line.posture,
            uses: line.uses.iter().filter_map(act).collect(),
        }
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
    pub fn direction(self) -> Point {
        let axis = |towards, away| f64::from(self.has(towards)) - f64::from(self.has(away));
        Point::new(axis(Key::Right, Key::Left), axis(Key::Up, Key::Down)).normalize_or_zero()
    }

    /// What the pace is multiplied by.
    pub fn haste(self) -> f64 {
        (if self.has(Key::Fast) { 2.0 } else { 1.0 }) * (if self.has(Key::Slow) { 0.5 } else { 1.0 })
    }
}
