//! How things are on one day: what all changes in force come to.

use crate::routine::{Activity, Effect, PartOfDay, Shy};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::time::Micros;
use homebody_walk::Gains;
use std::collections::BTreeMap;

homebody_core::numbers! {
    /// Standard deviation over days of the logarithm of the amount of movement. In real homes, the firings per waking
    /// hour vary between days by 0.3 to 0.5 of their mean.
    pub(super) static DAY_SPREAD = "life.day_spread": 0.4, "1", [0.0, 2.0];
    /// Correlation of the amount of movement on a day with that on the day before.
    pub(super) static DAY_LIKE = "life.day_like": 0.25, "1", [0.0, 0.95];
    /// Factor on the movement of a day that the routine calls quiet; its square for a very quiet day.
    pub(super) static QUIET_DAY = "life.quiet_day": 0.5, "1", [0.0, 1.0];
    /// Factor on the movement of a day that the routine calls busy; its square for a very busy day.
    pub(super) static BUSY_DAY = "life.busy_day": 1.5, "1", [1.0, 5.0];
    /// Largest factor on a person's usual movement.
    pub(super) static MOST_MOVEMENT = "life.most_movement": 20.0, "1", [1.0, 100.0];
    /// Number of weeks after which a gait that slows week by week slows no further.
    pub(super) static MOST_WEEKS = "life.most_weeks": 26.0, "1", [1.0, 520.0];
    /// Lowest walking speed as a share of a person's pace.
    pub(super) static LEAST_PACE = "life.least_pace": 0.33, "1", [0.05, 1.0];
}

/// How things are on one day.
#[derive(Clone, Debug)]
pub struct DayParameters {
    /// So many times the walking speed.
    pub pace: f64,
    pub irregular: f64,
    pub restless: f64,
    /// Nobody moves more than so many times as much as usual.
    pub(super) most_movement: f64,
    pub pulse: f64,
    pub respiration: f64,
    /// So many times the usual liveliness: more errands, less sitting between them, and more stirring.
    pub level: f64,
    /// So many times as much as usual days differ in that.
    pub(super) differ: f64,
    /// So much later she gets up who went to bed late, of how late it was.
    pub(super) sleeps_in: f64,
    /// So much later than planned today began, after last night.
    pub(super) slept_in: Micros,
    pub(super) active: Vec<(Option<PartOfDay>, f64)>,
    pub(super) later_s: BTreeMap<Activity, f64>,
    pub(super) longer: BTreeMap<Activity, f64>,
    pub(super) longer_s: BTreeMap<Activity, f64>,
    pub(super) oftener: Vec<(Activity, Option<PartOfDay>, f64)>,
    pub(super) skips: BTreeMap<Activity, f64>,
    pub(super) forgets: Vec<(String, f64)>,
    /// What of motor schemas is added to their own.
    pub(super) shy: Vec<(Shy, f64)>,
    /// The conditions in force, and how severe each is; 1 is a moderate case.
    pub severities: Vec<(String, f64)>,
}

/// How long a change has lasted, and whose pace it changes.
#[derive(Clone, Copy)]
pub(super) struct Span {
    /// No more than [`MOST_WEEKS`].
    pub(super) weeks: f64,
    pub(super) pace_mps: f64,
    /// Nobody walks slower than this part of `pace_mps`.
    pub(super) least_pace: f64,
}

impl DayParameters {
    pub(super) fn ordinary() -> DayParameters {
        DayParameters {
            pace: 1.0,
            irregular: 1.0,
            restless: 1.0,
            most_movement: MOST_MOVEMENT.value,
            pulse: 0.0,
            respiration: 0.0,
            level: 1.0,
            differ: 1.0,
            sleeps_in: 0.0,
            slept_in: 0,
            active: Vec::new(),
            later_s: BTreeMap::new(),
            longer: BTreeMap::new(),
            longer_s: BTreeMap::new(),
            oftener: Vec::new(),
            skips: BTreeMap::new(),
            forgets: Vec::new(),
            shy: Vec::new(),
            severities: Vec::new(),
        }
    }

    /// Adds an effect at so much of its full strength; `share` says where in its range it lies for this person.
    pub(super) fn change(&mut self, effect: &Effect, strength: f64, share: f64, span: Span) {
        // A factor of 1.3 at twice its strength is 1.6; of 0.4 it is not below nothing.
        let factor = |fuzzy: &Fuzzy| (1.0 + (fuzzy.at(share) - 1.0) * strength).max(0.0);
        let amount = |fuzzy: &Fuzzy| fuzzy.at(share) * strength;
        match effect {
            Effect::Shows { .. } | Effect::DaysAre { .. } => {}
            Effect::DaysDiffer(by) => self.differ *= factor(by),
            Effect::SleepsIn => self.sleeps_in = strength.min(1.0),
            Effect::Pace(by) => self.pace *= factor(by),
            Effect::PaceEachWeek(by) => {
                let mps = amount(by) * span.weeks;
                self.pace = (self.pace + mps / span.pace_mps).max(span.least_pace);
            }
            Effect::Later { activity, by } => *self.later_s.entry(activity.clone()).or_default() += amount(by),
            Effect::Longer { activity, factor: by } => {
                *self.longer.entry(activity.clone()).or_insert(1.0) *= factor(by)
            }
            Effect::LongerBy { activity, by } => *self.longer_s.entry(activity.clone()).or_default() += amount(by),
            Effect::Oftener { activity, part, factor: by } => self.oftener.push((activity.clone(), *part, factor(by))),
            Effect::Skips { activity, chance } => {
                let skips = self.skips.entry(activity.clone()).or_default();
                *skips = 1.0 - (1.0 - *skips) * (1.0 - (chance * strength).min(1.0));
            }
            Effect::Irregular(by) => self.irregular *= factor(by),
            Effect::Active { part, factor: by } => self.active.push((*part, factor(by))),
            Effect::Restless(by) => self.restless = (self.restless * factor(by)).min(self.most_movement),
            Effect::Forgets { thing, chance } => {
                self.forgets.push((thing.to_lowercase(), (chance * strength).min(1.0)))
            }
            Effect::Shy { of, gain } => self.shy.push((*of, gain * strength)),
            Effect::Pulse(by) => self.pulse += amount(by),
            Effect::Respiration(by) => self.respiration += amount(by),
        }
    }

    /// How somebody wanders today whose own gains are these.
    pub fn gains(&self, own: Gains) -> Gains {
        let mut gains = own;
        for (of, gain) in &self.shy {
            let one = match of {
                Shy::OpenFloor => &mut gains.open_floor,
                Shy::People => &mut gains.people,
                Shy::GoingOn => &mut gains.pauses,
            };
            *one += gain;
        }
        gains
    }

    /// How many times the usual movement there is at an hour of the day.
    pub fn activity(&self, hour: f64) -> f64 {
        (self.level * self.changed_activity(hour)).min(self.most_movement)
    }

    /// The same as far as it has changed, on a day as lively as any.
    pub fn changed_activity(&self, hour: f64) -> f64 {
        if self.active.is_empty() {
            return 1.0;
        }
        let holds = |part: &Option<PartOfDay>| {
            part.is_none_or(|part| {
                let (from, to) = part.hours();
                let (from, to) = (from / 3600.0, to / 3600.0);
                (from..to).contains(&hour) || (from..to).contains(&(hour + 24.0))
            })
        };
        // Several changes together are not without bounds.
        let factors = self.active.iter().filter(|(part, _)| holds(part)).map(|(_, factor)| factor);
        factors.product::<f64>().min(self.most_movement)
    }

    /// How many seconds later something is done.
    pub fn later_s(&self, activity: &Activity) -> f64 {
        self.later_s.get(activity).copied().unwrap_or(0.0)
    }

    /// How long something takes that would take so many seconds; of being out without `longer_s`.
    pub fn lasting_s(&self, activity: &Activity, seconds: f64) -> f64 {
        let factor = self.longer.get(activity).copied().unwrap_or(1.0);
        let longer_s = Some(self.longer_s(activity)).filter(|_| *activity != Activity::Leave);
        (seconds * factor + longer_s.unwrap_or(0.0)).max(0.0)
    }

    /// How many seconds longer something is done; of being out, in all of a day.
    pub fn longer_s(&self, activity: &Activity) -> f64 {
        self.longer_s.get(activity).copied().unwrap_or(0.0)
    }

    /// How many times as often something is done, in a part of the day.
    pub fn oftener(&self, activity: &Activity, within: Option<PartOfDay>) -> f64 {
        let holds = |part: &Option<PartOfDay>| part.is_none() || *part == within;
        self.oftener.iter().filter(|(of, part, _)| of == activity && holds(part)).map(|(_, _, factor)| factor).product()
    }

    /// How likely something is left out.
    pub fn skips(&self, activity: &Activity) -> f64 {
        self.skips.get(activity).copied().unwrap_or(0.0)
    }

    /// What may stay on or open after its use, each with its chance.
    pub fn forgotten(&self) -> impl Iterator<Item = (&str, f64)> {
        self.forgets.iter().map(|(thing, chance)| (thing.as_str(), *chance))
    }
}
