//! What interrupts what is being done: rules, meals that are due, what breaks into the day, needs that press.

use super::drafts::SOON_DONE;
use super::driver::{GRACE, RoutineDriver};
use super::item::Item;
use super::script::Step;
use super::usual;
use crate::routine::{Activity, Response};
use homebody_core::activity::{self, ActivityKind, UsualLength};
use homebody_core::time::{Micros, micros};

impl RoutineDriver {
    /// When a rule is due; what is done because of one is not interrupted by one that stands after it.
    pub(super) fn rules_at(&self) -> Micros {
        self.watches.due_before(self.answering())
    }

    /// Where the first rule stands that is being answered: only those before it break into that (Brooks 1986).
    fn answering(&self) -> usize {
        self.scripts.iter().filter_map(|playing| playing.answers).min().unwrap_or(usize::MAX)
    }

    /// When what may be interrupted will be.
    pub(super) fn interrupted_at(&self, now: Micros) -> Micros {
        let event = self.next_break_at(now);
        if self.visitor.is_some() {
            return Micros::MAX;
        }
        // What is being done about a need is not interrupted by another.
        let needs = if self.scripts.len() > 2 { Micros::MAX } else { self.needs.presses_at() };
        let meal = self.essential().map_or(Micros::MAX, |(_, due)| due);
        event.min(needs).min(meal).min(self.rules_at()).max(now)
    }

    /// When what interrupts comes next. Lying awake waits until one is in bed.
    pub(super) fn next_break_at(&self, now: Micros) -> Micros {
        let Some(item) = self.agenda.breaks.get(self.next_break) else { return Micros::MAX };
        let waits = item.activity == Activity::LieAwake && !self.needs.asleep() && now <= item.latest;
        if waits { Micros::MAX } else { item.start }
    }

    /// When somebody falls or stumbles next: no nap, no meal and no wash keeps them from it.
    pub(super) fn accident_at(&self) -> Micros {
        self.next_accident().map_or(Micros::MAX, |index| self.agenda.breaks[index].start)
    }

    /// Where among the breaks that is; others may come before it that wait for the end of a nap.
    fn next_accident(&self) -> Option<usize> {
        let is_accident = |item: &Item| matches!(item.activity, Activity::Fall | Activity::Stumble);
        let ahead = self.agenda.breaks.get(self.next_break..).filter(|_| self.visitor.is_none())?;
        ahead.iter().position(is_accident).map(|index| self.next_break + index)
    }

    /// When something is next to be done that is soon done, and may be done while a meal is cooked.
    pub(super) fn breaks_into_cooking_at(&self, now: Micros) -> Micros {
        let next = self.agenda.breaks.get(self.next_break).filter(|_| self.visitor.is_none());
        let is_soon_done = |item: &&Item| item.lasts <= SOON_DONE && !item.activity.is_of_the_night();
        next.filter(is_soon_done).map_or(Micros::MAX, |item| item.start.max(now))
    }

    /// The next meal or medicine of the plan, and from when on it interrupts what goes on, if that gives way to it.
    pub(super) fn essential(&self) -> Option<(usize, Micros)> {
        let [playing] = self.scripts.as_slice() else { return None };
        if !playing.gives_way {
            return None;
        }
        let items = self.agenda.items.iter().enumerate().skip(self.next_item);
        let mut essential = items.filter(|(_, item)| item.is_essential());
        let (index, item) = essential.next()?;
        // Medicine that has its time is not taken after what nobody says.
        let end = item.start + item.lasts;
        let is_first = |of: &Item| of.has_its_time && of.activity == Activity::TakeMedicine && of.start < end;
        if let Some((index, medicine)) = essential.find(|(_, of)| item.waits && is_first(of)) {
            return Some((index, medicine.start));
        }
        // What is nearly done is brought to its end, but nobody goes back to it between cooking and eating.
        let is_next = self.at_table > item.start - 2 * GRACE;
        Some((index, item.start + if is_next { 0 } else { GRACE }))
    }

    /// Does whatever presses now.
    pub(super) fn interrupt(&mut self, now: Micros) {
        if self.rules_at() <= now && self.answer_rule(now) {
            return;
        }
        if let Some(index) = self.next_accident().filter(|&index| self.agenda.breaks[index].start <= now) {
            // It comes before what waits.
            self.agenda.breaks[self.next_break..=index].rotate_right(1);
            return self.begin_break(now);
        }
        if let Some((index, due)) = self.essential()
            && due <= now
        {
            let item = self.agenda.items.remove(index);
            if now <= item.latest {
                self.begin_at(&item, now);
            }
            return;
        }
        if self.next_break_at(now) <= now {
            return self.begin_break(now);
        }
        if let Some(activity) = self.needs.pressing(now, self.hour(now)) {
            let key = format!("need/{}/{}", activity.label(), self.times(&activity));
            let mut stream = self.life.stream_of_day(self.agenda.day, &key);
            let UsualLength { median_min, sigma } = match activity {
                // By night visits are shorter.
                Activity::UseBathroom if self.needs.asleep() => UsualLength { median_min: 4.0, sigma: 0.4 },
                ref activity => usual::length(activity, &self.life.numbers),
            };
            let lasts = self.parameters.lasting_s(&activity, stream.lognormal(median_min * 60.0, sigma));
            self.begin(&Item::now(key, activity, micros(lasts)));
        }
    }

    /// Does what breaks into the day next, unless it is too late for it.
    fn begin_break(&mut self, now: Micros) {
        let Some(item) = self.agenda.breaks.get(self.next_break).cloned() else { return };
        self.next_break += 1;
        // Nobody lies awake who is up.
        let is_idle = item.activity == Activity::LieAwake && !self.needs.asleep();
        if now <= item.latest && !is_idle {
            self.begin_at(&item, now);
        }
    }

    /// Does what a rule asks for that is due; false where nothing of it is done.
    fn answer_rule(&mut self, now: Micros) -> bool {
        let due = self.with_watches(|watches, resident| {
            watches.due(resident.answering(), now, |state| resident.is_so(state, now), &resident.life)
        });
        let Some((rule, rank, mut answers)) = due else { return false };
        self.tally.hold(rule);
        answers.reverse();
        self.go_on_answering(rank, answers, now);
        true
    }

    /// Does the next of what a rule asks for, the last of the list.
    pub(super) fn go_on_answering(&mut self, rank: usize, mut answers: Vec<Response>, now: Micros) {
        let Some(next) = answers.pop() else { return };
        self.respond(next, now);
        if let Some(playing) = self.scripts.last_mut() {
            (playing.answers, playing.still) = (Some(rank), answers);
        }
    }

    pub(super) fn respond(&mut self, response: Response, now: Micros) {
        match response {
            // The night is over, whatever is left of it.
            Response::Do { activity: Activity::GetUp, .. } if self.needs.asleep() => {
                for step in self.scripts.iter_mut().flat_map(|playing| playing.steps.iter_mut()) {
                    if let Step::Stay(stay) = step {
                        stay.until = Some(now);
                    }
                }
            }
            Response::Do { activity: Activity::GoToBed, .. } => {
                self.scripts.clear();
                self.go_to_bed(now);
            }
            Response::Turn { thing, on } => {
                let Some(index) = self.places.thing_named(&thing) else { return };
                let activity = Activity::Other(activity::turning(&thing, on));
                self.begin(&Item::now("rule".into(), activity, 0));
                let at = self.places.named(&thing).cloned();
                if let Some(playing) = self.scripts.last_mut() {
                    playing.steps.truncate(1);
                    playing.steps.extend(at.map(Step::Go));
                    playing.steps.push_back(Step::Act(index, on));
                }
            }
            Response::Do { activity, place, lasts } => {
                let key = format!("rule/{}/{}", activity.label(), self.times(&activity));
                let mut stream = self.life.stream_of_day(self.agenda.day, &key);
                let UsualLength { median_min, sigma } = usual::length(&activity, &self.life.numbers);
                let lasts_s = match lasts {
                    Some(lasts) => lasts.draw(&mut stream),
                    None => stream.lognormal(median_min * 60.0, sigma),
                };
                self.begin(&Item { place, ..Item::now(key, activity, micros(lasts_s)) });
            }
        }
    }
}

impl Activity {
    /// Whether a meal that is due interrupts it: what is done for pleasure, company, the household.
    pub(super) fn gives_way_to_meals(&self) -> bool {
        use Activity::{Exercise, Housework, Laundry, Other, Phone, Read, Relax, UseComputer, Visit, WatchTelevision};
        match self {
            Exercise | Housework | Laundry | Other(_) | Phone | Read | Relax | UseComputer | Visit
            | WatchTelevision => true,
            Activity::Everyday(label) => {
                matches!(ActivityKind::of(label), ActivityKind::Leisure | ActivityKind::Food | ActivityKind::Housework)
            }
            _ => false,
        }
    }
}
