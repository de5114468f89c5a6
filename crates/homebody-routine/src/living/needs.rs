//! The needs of one resident together: how fast each rises, and what is done when it presses.

use super::life::{Constitution, DayParameters, Life};
use super::need::Need;
use crate::routine::{Activity, PartOfDay};
use homebody_core::event::Need as Kind;
use homebody_core::random::Stream;
use homebody_core::time::Micros;

/// Toilet, thirst, hunger, tiredness.
#[derive(Clone, Debug)]
pub struct Needs {
    toilet: Need,
    thirst: Need,
    hunger: Need,
    tiredness: Need,
    asleep: bool,
    constitution: Constitution,
    /// A stream for each kind, so that a meal that is skipped leaves the toilet's thresholds as they are.
    streams: [Stream; 4],
}

/// So many times a day of waking it would press (ours, but for the toilet): a drink every four hours beside meals, a
/// snack after seven without one.
const THIRST: f64 = 24.0 / 4.0;
const HUNGER: f64 = 24.0 / 7.0;
/// Some seven hours after getting up, as naps have their peak at 14:30-15:00.
const TIREDNESS: f64 = 24.0 / 7.2;

/// All of them, in their own order.
const KINDS: [Kind; 4] = [Kind::Toilet, Kind::Thirst, Kind::Hunger, Kind::Tiredness];

/// Shape of the gamma distribution of thresholds (ours).
const SHAPE: f64 = 3.0;

/// Hours awake and asleep that visits a day and a night are counted over (ours).
const WAKING_H: f64 = 15.5;
const SLEEPING_H: f64 = 7.8;

/// Visits that are there anyway, first thing in the morning and before bed.
const ANYWAY: f64 = 2.0;

impl Needs {
    pub fn new(life: &Life, now: Micros) -> Needs {
        // Who naps by plan does not nap for being tired, too.
        let plans_naps =
            life.habits(0).any(|habit| habit.said.activity == Activity::Nap && habit.said.visitor.is_none());
        let naps = if plans_naps { 0.0 } else { life.constitution.naps };
        let constitution = Constitution { naps, ..life.constitution };
        let mut streams = KINDS.map(|kind| life.stream(&format!("needs/{kind:?}")));
        let [toilet, thirst, hunger, _] = streams.each_mut().map(|stream| Need::new(now, stream.gamma(SHAPE, 1.0)));
        Needs { toilet, thirst, hunger, tiredness: Need::new(now, 1.0), asleep: false, constitution, streams }
    }

    pub fn asleep(&self) -> bool {
        self.asleep
    }

    /// From now on at the rates of waking.
    /// The toilet's does not rise where visits are planned.
    pub fn waking(&mut self, now: Micros, parameters: &DayParameters, is_planned: bool) {
        self.asleep = false;
        // In a renewal process that begins anew a third of a visit is missing at this shape.
        let visits = (self.constitution.toilet_by_day - ANYWAY + 0.33).max(0.5);
        let toilet = visits * 24.0 / WAKING_H * parameters.oftener(&Activity::UseBathroom, Some(PartOfDay::Day));
        self.toilet.rise(now, if is_planned { 0.0 } else { toilet });
        self.thirst.rise(now, THIRST * parameters.oftener(&Activity::Drink, None));
        self.hunger.rise(now, HUNGER * parameters.oftener(&Activity::Snack, None));
        self.tiredness.rise(now, TIREDNESS);
    }

    /// From now on at the rates of the night.
    pub fn sleeping(&mut self, now: Micros, parameters: &DayParameters, is_planned: bool) {
        self.asleep = true;
        let visits = self.constitution.toilet_at_night + 0.33;
        let toilet = visits * 24.0 / SLEEPING_H * parameters.oftener(&Activity::UseBathroom, Some(PartOfDay::Night));
        self.toilet.rise(now, if is_planned { 0.0 } else { toilet });
        for need in [&mut self.thirst, &mut self.hunger, &mut self.tiredness] {
            need.rise(now, 0.0);
        }
    }

    /// Only tiredness rises while away: elsewhere there are toilets and meals, too, but no beds.
    pub fn pause(&mut self, now: Micros) {
        for need in [&mut self.toilet, &mut self.thirst, &mut self.hunger] {
            need.rise(now, 0.0);
        }
    }

    /// A night's sleep has met tiredness.
    pub fn wake(&mut self, now: Micros) {
        self.tiredness.meet(now, 1.0);
    }

    /// When the first of them presses.
    pub fn presses_at(&self) -> Micros {
        let awake = [&self.thirst, &self.hunger, &self.tiredness].map(Need::presses_at).into_iter().min();
        let awake = if self.asleep { None } else { awake };
        self.toilet.presses_at().min(awake.unwrap_or(Micros::MAX))
    }

    /// What is done about the one that presses now, the most urgent first; a need that is put off presses later.
    pub fn pressing(&mut self, now: Micros, hour: f64) -> Option<Activity> {
        if self.toilet.presses_at() <= now {
            return Some(Activity::UseBathroom);
        }
        if self.asleep {
            return None;
        }
        if self.thirst.presses_at() <= now {
            return Some(Activity::Drink);
        }
        if self.hunger.presses_at() <= now {
            return Some(Activity::Snack);
        }
        if self.tiredness.presses_at() > now {
            return None;
        }
        if (12.5..17.5).contains(&hour) && self.streams[Kind::Tiredness as usize].chance(self.constitution.naps) {
            return Some(Activity::Nap);
        }
        // Overcome, until tomorrow.
        self.tiredness.meet(now, 1.5);
        None
    }

    /// A need is met; how strong it was.
    pub fn meet(&mut self, kind: Kind, now: Micros) -> f64 {
        let threshold = if kind == Kind::Tiredness { 1.5 } else { self.streams[kind as usize].gamma(SHAPE, 1.0) };
        let need = match kind {
            Kind::Toilet => &mut self.toilet,
            Kind::Thirst => &mut self.thirst,
            Kind::Hunger => &mut self.hunger,
            Kind::Tiredness => &mut self.tiredness,
        };
        let strength = need.strength(now);
        need.meet(now, threshold);
        strength.min(1.0)
    }

    /// Nothing can be done about a need: it presses again as if it had been met.
    pub fn put_off(&mut self, kind: Kind, now: Micros) {
        self.meet(kind, now);
    }
}
