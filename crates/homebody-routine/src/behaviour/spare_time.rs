//! Activities in spare time.

use super::defaults;
use super::driver::RoutineDriver;
use super::item::Item;
use super::manner::Manner;
use super::resident_routine::InForce;
use super::script::{ActivityStep, Interruptible, StayStep};
use crate::routine::{Activity, HabitTime, PartOfDay};
use homebody_core::activity::{RESTING_IN_BED, UsualLength};
use homebody_core::numbers::{Number, Numbers};
use homebody_core::posture::Posture;
use homebody_core::random::Stream;
use homebody_core::role::Role;
use homebody_core::time::{HOUR, MINUTE, RunTime, SECOND, Span};

/// Activities with relative frequency and minutes: set so that the hours of a day come near those of people of 75 and more
/// (American Time Use Survey); housework stands for the small errands of `chores.rs`, for which people of that age rise
/// from their seats 46-60 times a day.
const FILLERS: [(Activity, f64, f64); 6] = [
    (Activity::WatchTelevision, 0.98, 14.0),
    (Activity::Relax, 0.2, 8.0),
    (Activity::Read, 0.13, 13.0),
    (Activity::Housework, 0.5, 1.3),
    (Activity::Phone, 0.1, 12.0),
    (Activity::UseComputer, 0.095, 14.0),
];

/// Fills the spare time of a day in bed.
const IN_BED: Activity = Activity::Everyday(RESTING_IN_BED);

const TABLE: &str = "filler";

homebody_core::numbers! {
    /// Rate at which a sitting person gets up for an errand, as a multiple of the rate at which one errand follows
    /// another.
    static RISES = "spare_time.rises": 26.0, "1", [0.0, 500.0];
    /// Number of errands before noon, as a multiple of that in the afternoon. In homes of the CASAS collection, 40 to
    /// 47 % of a day's firings come from 06:00 to 12:00.
    static MORNING = "spare_time.morning": 1.7, "1", [0.0, 10.0];
    /// Number of errands after 18:00, as a multiple of that in the afternoon. In the same homes, 24 to 25 % of a day's
    /// firings come then.
    static EVENING = "spare_time.evening": 0.75, "1", [0.0, 10.0];
    /// Probability that another errand follows one at once.
    static AGAIN = "spare_time.again": 0.25, "1", [0.0, 0.95];
    /// Standard deviation of the logarithm of the duration of an activity that fills spare time.
    static SPREAD = "spare_time.spread": 0.5, "1", [0.0, 2.0];
}

pub(super) fn numbers() -> Vec<Number> {
    let of = |(activity, weight, minutes): &(Activity, f64, f64)| {
        let row = activity.label();
        let number = |column: &str, value, unit, range, what: String| {
            Number::of_table([TABLE, row, column], value, unit, range, what, file!())
        };
        let often = format!("Relative frequency of `{row}` in spare time.");
        let long = format!("Median duration, in minutes, of `{row}` in spare time.");
        [number("weight", *weight, "1", [0.0, 100.0], often), number("minutes", *minutes, "min", [0.1, 240.0], long)]
    };
    FILLERS.iter().flat_map(of).collect()
}

fn fillers(numbers: &Numbers) -> [(Activity, f64, f64); 6] {
    if !numbers.are_set() {
        return FILLERS;
    }
    FILLERS.map(|(activity, weight, minutes)| {
        let row = activity.label();
        let of = |column: &str, value| numbers.of_table([TABLE, row, column], value);
        let (weight, minutes) = (of("weight", weight), of("minutes", minutes));
        (activity, weight, minutes)
    })
}

const FILLS: &str = "fill/";

impl Item {
    pub fn is_filler(&self) -> bool {
        self.key.starts_with(FILLS)
    }

    /// Whether it is an errand of spare time.
    pub fn is_errand(&self) -> bool {
        self.is_filler() && self.activity == Activity::Housework
    }
}

impl RoutineDriver {
    /// Fills the time until the next activity is due, by the weights of older adults' days.
    pub(super) fn fill(&mut self, until: RunTime, now: RunTime) {
        let gap = until - now;
        let key = format!("{FILLS}{}", self.times(&Activity::Relax));
        let mut stream = self.life.stream_of_day(self.agenda.day, &key);
        let errands = self.errands_at(now);
        let (activity, minutes, share) = &self.filler(now, errands, &mut stream);
        if gap < 3 * MINUTE {
            let posture = self.body.posture();
            let left = gap.max(SECOND);
            let stay = StayStep { posture, manner: Manner::STILL, left, until: None, may: Interruptible::Interrupt };
            let steps = [ActivityStep::Name(Activity::Relax.label().into()), ActivityStep::Stay(stay)];
            self.play(steps.into(), stream, Activity::Relax.label());
            if let Some(playing) = self.scripts.last_mut() {
                playing.until = Some(now + left);
            }
            return;
        }
        let lasts_s = stream.lognormal(minutes * 60.0, self.life.numbers.of(&SPREAD));
        // More errands leave less sitting time between them.
        let lasts_s = if *activity == Activity::Housework { lasts_s } else { lasts_s / errands.max(1.0) };
        let lasts = Span::from_seconds((lasts_s * self.longer(activity, *share)).max(20.0)).min(gap);
        self.begin(&Item::now(key, activity.clone(), lasts));
        for step in self.scripts.last_mut().into_iter().flat_map(|playing| playing.steps.iter_mut()) {
            if let ActivityStep::Stay(stay) = step
                && stay.may == Interruptible::Interrupt
            {
                stay.may = Interruptible::Yield;
            }
        }
    }

    /// Factor on errands now: of several reasons for fewer, the strongest applies.
    fn errands_at(&self, now: RunTime) -> f64 {
        let hour = self.hour(now);
        let often = self.parameters.oftener(&Activity::Housework, None);
        let changed = self.parameters.changed_activity(hour);
        let of_hour = match hour {
            ..12.0 => self.life.numbers.of(&MORNING),
            18.0.. => self.life.numbers.of(&EVENING),
            _ => 1.0,
        };
        let times = self.errands.times(changed, hour) * self.parameters.level * of_hour;
        if often < 1.0 { times.min(often) } else { times * often }
    }

    /// Factor on the length of an activity of spare time, so that its share of that time changes by the stated factor. The
    /// others then have less.
    fn longer(&self, activity: &Activity, share: f64) -> f64 {
        /// Largest share of spare time of one activity (our choice).
        const MOST_OF_IT: f64 = 0.95;
        let planned = self.agenda.items.iter().filter(|item| item.visitor.is_none()).map(|item| item.lasts);
        let spare_s = (self.agenda.bed - self.agenda.up - planned.sum::<Span>()).max(HOUR).seconds();
        let longer = self.parameters.longer.get(activity).copied().unwrap_or(1.0);
        let changed = share * longer + self.parameters.longer_s(activity) / spare_s;
        if changed == share || share <= 0.0 || share >= MOST_OF_IT {
            return 1.0;
        }
        let changed = changed.clamp(0.0, MOST_OF_IT);
        changed * (1.0 - share) / ((1.0 - changed) * share)
    }

    /// An activity for now, its median length in minutes, and its usual share of spare time. A less frequent activity is drawn as often, and then
    /// replaced.
    fn filler(&mut self, now: RunTime, errands: f64, stream: &mut Stream) -> (Activity, f64, f64) {
        if self.agenda.in_bed {
            let UsualLength { median_min, .. } = defaults::length(&IN_BED, &self.life.numbers);
            return (IN_BED, median_min, 0.0);
        }
        let (mut fillers, mut weights) = (Vec::new(), Vec::new());
        let (rising, again) = (self.life.numbers.of(&RISES), self.life.numbers.of(&AGAIN));
        for (activity, weight, minutes) in self::fillers(&self.life.numbers) {
            // A home without a desk has no computer.
            let can = activity != Activity::UseComputer || self.places.has(Role::Desk);
            if can && !self.is_said(&activity, now) {
                let weight = weight * self.parameters.oftener(&activity, None).max(1.0);
                weights.push(weight);
                fillers.push((activity, minutes));
            }
        }
        let whole_min: f64 = weights.iter().zip(&fillers).map(|(weight, (_, minutes))| weight * minutes).sum();
        let shares: Vec<f64> =
            weights.iter().zip(&fillers).map(|(weight, (_, minutes))| weight * minutes / whole_min).collect();
        if let Some(errand) = fillers.iter().position(|(activity, _)| *activity == Activity::Housework) {
            let more = self.parameters.oftener(&Activity::Housework, None).max(1.0);
            let others = weights.iter().sum::<f64>() - weights[errand];
            weights[errand] = match self.body.posture() {
                Posture::Standing => more * others * again / (1.0 - again),
                _ => weights[errand] * rising,
            };
        }
        let mut instead_of = None;
        loop {
            let drawn = stream.pick(&weights);
            let (activity, minutes) = fillers[drawn].clone();
            let often = match &activity {
                Activity::Housework => {
                    self.errands.chance(self.hour(now), errands);
                    errands
                }
                other => self.parameters.oftener(other, None),
            };
            if often >= 1.0 || weights.len() == 1 || stream.chance(often) {
                return (activity, instead_of.unwrap_or(minutes), shares[drawn]);
            }
            if activity != Activity::Housework {
                // The replacement takes as long, so that other activities do not become more frequent.
                instead_of = instead_of.or(Some(minutes));
                if let Some(errand) = fillers.iter().position(|(activity, _)| *activity == Activity::Housework) {
                    weights[errand] = 0.0;
                }
            }
            weights[drawn] = 0.0;
            if weights.iter().all(|weight| *weight <= 0.0) {
                return (Activity::Relax, instead_of.unwrap_or(minutes), shares[drawn]);
            }
        }
    }

    /// Whether the routine states the frequency of an activity for now, so that it does not fill spare time. A frequency on
    /// most days, or without a time, covers all of the day; otherwise only its part.
    fn is_said(&self, activity: &Activity, now: RunTime) -> bool {
        if matches!(activity, Activity::Relax | Activity::Housework) {
            return false;
        }
        let (day, hour_s) = (self.agenda.day, self.hour(now) * 3600.0);
        if self.life.has_ended(activity, day) {
            return true;
        }
        self.life.habits(day).any(|InForce { said: habit, .. }| {
            let is_it = habit.activity == *activity && habit.visitor.is_none() && self.life.is_meant(habit, day);
            is_it
                && match &habit.when.time {
                    HabitTime::Within(PartOfDay::Night) => false,
                    HabitTime::AnyTime => true,
                    _ if habit.when.chance.probability >= 0.5 => true,
                    HabitTime::Within(part) => (part.hours().0..part.hours().1).contains(&hour_s),
                    _ => false,
                }
        })
    }
}
