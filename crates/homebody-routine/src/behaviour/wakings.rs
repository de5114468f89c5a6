//! Wakings of the night, which rules answer, and poor nights.

use super::current_activity::SleepRecord;
use super::driver::RoutineDriver;
use super::item::Item;
use homebody_core::activity::SLEEPING;
use homebody_core::time::{MINUTE, RunTime, Span};

homebody_core::numbers! {
    /// Least time awake in a poor night after falling asleep, as a multiple of a person's usual one.
    static POOR_NIGHT = "night.poor": 1.5, "1", [1.0, 10.0];
}

/// Time out of bed of a visit to the toilet at night (our choice).
const TOILET_TRIP: Span = MINUTE.times(5);

impl RoutineDriver {
    /// Takes note of a waking, or of falling asleep again, at the beginning of an activity of this name.
    pub(super) fn note_sleep(&mut self, name: &str, now: RunTime) {
        if !self.needs.asleep() {
            return;
        }
        match (name == SLEEPING, self.nights.awake_since) {
            (true, Some(since)) => {
                (self.nights.awake, self.nights.awake_since) = (self.nights.awake + (now - since), None);
                if std::mem::take(&mut self.nights.is_open) {
                    self.watches.wakes(now, &self.life);
                }
            }
            (false, None) if self.name == SLEEPING => {
                self.nights.awake_since = Some(now);
                // A need comes first, and an answer of a rule does not wake the person again.
                let lies = self.scripts.len() == 1;
                self.nights.is_open = !lies && self.scripts.iter().all(|playing| playing.answers.is_none());
                if lies {
                    self.watches.wakes(now, &self.life);
                }
            }
            _ => {}
        }
    }

    /// Ends the record of a night.
    pub(super) fn end_night(&mut self, now: RunTime) {
        let night = &self.nights;
        let awake = night.awake + night.awake_since.map_or(Span::ZERO, |since| now - since);
        let body = &self.life.constitution;
        let usual = MINUTE.seconds() * body.awake_min + TOILET_TRIP.seconds() * body.toilet_at_night;
        let is_poor = awake.seconds() > usual * self.life.numbers.of(&POOR_NIGHT);
        self.nights = SleepRecord { poor: if is_poor { night.poor + 1 } else { 0 }, ..SleepRecord::default() };
    }

    /// Takes from the plan what is only done after poor nights.
    pub(super) fn leave_out_after_good_nights(&mut self) {
        let (life, poor) = (&self.life, self.nights.poor);
        let habit = |item: &Item| item.of.and_then(|of| life.habit(of));
        let is_due = |item: &Item| habit(item).is_none_or(|habit| habit.when.days.poor_nights <= poor);
        self.agenda.items.retain(is_due);
        self.agenda.breaks.retain(is_due);
    }
}
