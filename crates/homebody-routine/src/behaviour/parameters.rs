//! The parameters of one day: the effect of all changes.

use crate::routine::{Activity, Effect, PartOfDay, RoutineChange, Shy};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::time::Span;
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

#[derive(Clone, Debug)]
pub struct DayParameters {
    pub pace: f64,
    pub irregular: f64,
    pub restless: f64,
    pub(super) most_movement: f64,
    pub pulse: f64,
    pub respiration: f64,
    /// Factor on activity: more errands, less sitting between them, more movement on the spot.
    pub level: f64,
    /// Factor on the variation of activity between days.
    pub(super) differ: f64,
    /// Share of a late bedtime by which rising is later.
    pub(super) sleeps_in: f64,
    pub(super) slept_in: Span,
    pub(super) active: Vec<(Option<PartOfDay>, f64)>,
    pub(super) later_s: BTreeMap<Activity, f64>,
    pub(super) longer: BTreeMap<Activity, f64>,
    pub(super) longer_s: BTreeMap<Activity, f64>,
    pub(super) oftener: Vec<(Activity, Option<PartOfDay>, f64)>,
    pub(super) skips: BTreeMap<Activity, f64>,
    pub(super) forgets: Vec<(String, f64)>,
    /// Things that are on for a time, with probabilities.
    pub(super) kept_on: Vec<(RoutineChange, f64)>,
    /// Things that are not used, in lower case.
    pub(super) spares: Vec<String>,
    /// Rooms or floors to keep to if true, else to avoid, with probabilities.
    pub(super) ranges: Vec<(String, bool, f64)>,
    /// Additional gains of motor schemas.
    pub(super) shy: Vec<(Shy, f64)>,
    /// Severities of conditions; 1 is a moderate case.
    pub severities: Vec<(String, f64)>,
}

/// The duration of a change, and the pace that it acts on.
#[derive(Clone, Copy)]
pub(super) struct ChangeCourse {
    /// At most [`MOST_WEEKS`].
    pub(super) weeks: f64,
    /// Chance of the change today.
    pub(super) chance: f64,
    pub(super) pace_mps: f64,
    /// Lower limit as a share of `pace_mps`.
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
            slept_in: Span::ZERO,
            active: Vec::new(),
            later_s: BTreeMap::new(),
            longer: BTreeMap::new(),
            longer_s: BTreeMap::new(),
            oftener: Vec::new(),
            skips: BTreeMap::new(),
            forgets: Vec::new(),
            kept_on: Vec::new(),
            spares: Vec::new(),
            ranges: Vec::new(),
            shy: Vec::new(),
            severities: Vec::new(),
        }
    }

    /// Adds a change at a strength; `share` is its position within the range for this person.
    pub(super) fn change(&mut self, change: &RoutineChange, strength: f64, share: f64, course: ChangeCourse) {
        let (part, chance) = (change.when.part(), course.chance);
        // A factor of 1.3 at double strength is 1.6; one of 0.4 does not fall below 0.
        let factor = |fuzzy: &Fuzzy| (1.0 + (fuzzy.at(share) - 1.0) * strength).max(0.0);
        let amount = |fuzzy: &Fuzzy| fuzzy.at(share) * strength;
        match &change.effect {
            Effect::Shows { .. } | Effect::DaysAre { .. } => {}
            Effect::DaysDiffer(by) => self.differ *= factor(by),
            Effect::SleepsIn => self.sleeps_in = strength.min(1.0),
            Effect::Pace(by) => self.pace *= factor(by),
            Effect::PaceEachWeek(by) => {
                let mps = amount(by) * course.weeks;
                self.pace = (self.pace + mps / course.pace_mps).max(course.least_pace);
            }
            Effect::Later { activity, by } => *self.later_s.entry(activity.clone()).or_default() += amount(by),
            Effect::Longer { activity, factor: by } => {
                *self.longer.entry(activity.clone()).or_insert(1.0) *= factor(by)
            }
            Effect::LongerBy { activity, by } => *self.longer_s.entry(activity.clone()).or_default() += amount(by),
            Effect::Oftener { activity, factor: by } => self.oftener.push((activity.clone(), part, factor(by))),
            Effect::Skips { activity } => {
                let skips = self.skips.entry(activity.clone()).or_default();
                *skips = 1.0 - (1.0 - *skips) * (1.0 - (chance * strength).min(1.0));
            }
            Effect::Irregular(by) => self.irregular *= factor(by),
            Effect::Active { factor: by } => self.active.push((part, factor(by))),
            Effect::Restless(by) => self.restless = (self.restless * factor(by)).min(self.most_movement),
            Effect::Forgets { thing } => self.forgets.push((thing.to_lowercase(), (chance * strength).min(1.0))),
            Effect::KeepsOn { .. } => self.kept_on.push((change.clone(), (chance * strength).min(1.0))),
            Effect::Range { place, inside } => {
                self.ranges.push((place.to_lowercase(), *inside, (chance * strength).min(1.0)));
            }
            Effect::Spares { thing } => self.spares.push(thing.to_lowercase()),
            Effect::Shy { of, gain } => self.shy.push((*of, gain * strength)),
            Effect::Pulse(by) => self.pulse += amount(by),
            Effect::Respiration(by) => self.respiration += amount(by),
        }
    }

    /// The resident's gains with today's changes.
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

    pub fn activity(&self, hour: f64) -> f64 {
        (self.level * self.changed_activity(hour)).min(self.most_movement)
    }

    /// Without the variation between days.
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
        // Several changes together are limited.
        let factors = self.active.iter().filter(|(part, _)| holds(part)).map(|(_, factor)| factor);
        factors.product::<f64>().min(self.most_movement)
    }

    /// Delay in seconds. A meal and its preparation move together.
    pub fn later_s(&self, activity: &Activity) -> f64 {
        let of = |activity: &Activity| self.later_s.get(activity).copied();
        of(activity).or_else(|| of(&activity.of_same_meal()?)).unwrap_or(0.0)
    }

    /// Duration of an activity of `seconds`; for outings without `longer_s`.
    pub fn lasting_s(&self, activity: &Activity, seconds: f64) -> f64 {
        let factor = self.longer.get(activity).copied().unwrap_or(1.0);
        let longer_s = Some(self.longer_s(activity)).filter(|_| *activity != Activity::Leave);
        (seconds * factor + longer_s.unwrap_or(0.0)).max(0.0)
    }

    /// Seconds added; for outings, per day.
    pub fn longer_s(&self, activity: &Activity) -> f64 {
        self.longer_s.get(activity).copied().unwrap_or(0.0)
    }

    /// Factor on frequency in a part of the day.
    pub fn oftener(&self, activity: &Activity, within: Option<PartOfDay>) -> f64 {
        let holds = |part: &Option<PartOfDay>| part.is_none() || *part == within;
        self.oftener.iter().filter(|(of, part, _)| of == activity && holds(part)).map(|(_, _, factor)| factor).product()
    }

    pub fn skips(&self, activity: &Activity) -> f64 {
        self.skips.get(activity).copied().unwrap_or(0.0)
    }

    /// Things that may stay on or open after use, with probabilities.
    pub fn forgotten(&self) -> impl Iterator<Item = (&str, f64)> {
        self.forgets.iter().map(|(thing, chance)| (thing.as_str(), *chance))
    }
}
