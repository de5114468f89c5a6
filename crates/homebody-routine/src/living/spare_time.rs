//! What fills the time until something is due.

use super::agenda::Item;
use super::driver::{MINUTE, RoutineDriver};
use super::manner::Manner;
use super::script::{Interruptible, Stay, Step};
use crate::routine::Activity;
use homebody_core::numbers::{Number, Numbers};
use homebody_core::role::Role;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{Micros, SECOND, micros};

/// What fills the time, how often in comparison, and for how many minutes at a time: set so that the hours of
/// a day come near those of people of 75 and more (American Time Use Survey); housework stands for the small errands that
/// nobody plans, from which people of that age rise from their seats 46-60 times a day.
const FILLERS: [(Activity, f64, f64); 6] = [
    (Activity::WatchTelevision, 0.98, 14.0),
    (Activity::Relax, 0.21, 8.0),
    (Activity::Read, 0.14, 13.0),
    (Activity::Housework, 0.5, 1.3),
    (Activity::Phone, 0.1, 12.0),
    (Activity::UseComputer, 0.1, 14.0),
];

/// What their numbers' names begin with.
const TABLE: &str = "filler";

homebody_core::numbers! {
    /// So many times as often somebody who sits gets up for an errand as one errand follows another.
    static RISES = "spare_time.rises": 26.0, "1", [0.0, 500.0];
    /// The standard deviation of the logarithm of how long what fills the time lasts.
    static SPREAD = "spare_time.spread": 0.5, "1", [0.0, 2.0];
}

/// The numbers of what fills the time.
pub(super) fn numbers() -> Vec<Number> {
    let of = |(activity, weight, minutes): &(Activity, f64, f64)| {
        let row = activity.label();
        let number = |column: &str, value, unit, range, what: String| {
            Number::of_table([TABLE, row, column], value, unit, range, what, file!())
        };
        let often = format!("How often `{row}` fills the time, in comparison.");
        let long = format!("The median length of `{row}` where it fills the time.");
        [number("weight", *weight, "1", [0.0, 100.0], often), number("minutes", *minutes, "min", [0.1, 240.0], long)]
    };
    FILLERS.iter().flat_map(of).collect()
}

/// [`FILLERS`], as the scenario's numbers have them.
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

impl RoutineDriver {
    /// Fills the time until something is due, by the weights of older adults' days.
    pub(super) fn fill(&mut self, until: Micros, now: Micros) {
        let gap = until - now;
        let key = format!("fill/{}", self.times(&Activity::Relax));
        let mut stream = self.life.stream_of_day(self.agenda.day, &key);
        let said: Vec<&Activity> = self.life.habits(self.agenda.day).map(|habit| &habit.said.activity).collect();
        let (mut fillers, mut weights) = (Vec::new(), Vec::new());
        let rising = self.life.numbers.of(&RISES) * self.parameters.activity(self.hour(now));
        for (activity, weight, minutes) in self::fillers(&self.life.numbers) {
            // A home without a desk has no computer.
            let can = activity != Activity::UseComputer || self.places.has(Role::Desk);
            let planned = activity != Activity::Relax && activity != Activity::Housework && said.contains(&&activity);
            let rises = activity == Activity::Housework && self.body.posture() != Posture::Standing;
            if can && !planned {
                let weight = weight * self.parameters.oftener(&activity, None);
                weights.push(if rises { weight * rising } else { weight });
                fillers.push((activity, minutes));
            }
        }
        let (activity, minutes) = &fillers[stream.pick(&weights)];
        if gap < 3 * MINUTE {
            let posture = self.body.posture();
            let stay = Stay {
                posture,
                manner: Manner::STILL,
                left: gap.max(SECOND),
                until: Some(until.max(now + SECOND)),
                may: Interruptible::Interrupt,
            };
            let steps = [Step::Name(Activity::Relax.label().into()), Step::Stay(stay)];
            return self.play(steps.into(), stream, Activity::Relax.label());
        }
        // On a lively day one sits for less long at a time.
        let longer = if *activity == Activity::Housework { 1.0 } else { 1.0 / self.parameters.lively };
        let lasts = micros(
            self.parameters
                .lasting_s(activity, stream.lognormal(minutes * 60.0 * longer, self.life.numbers.of(&SPREAD)))
                .max(20.0),
        )
        .min(gap);
        self.begin(&Item::now(key, activity.clone(), lasts));
        for step in self.scripts.last_mut().into_iter().flat_map(|playing| playing.steps.iter_mut()) {
            if let Step::Stay(stay) = step
                && stay.may == Interruptible::Interrupt
            {
                stay.may = Interruptible::Yield;
            }
        }
    }
}
