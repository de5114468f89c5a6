//! Interruptions of an activity: rules, due meals, breaks of the plan, pressing needs.

use super::defaults;
use super::drafts::SOON_DONE;
use super::driver::{GRACE, RoutineDriver};
use super::item::{Item, Turning};
use super::resident_routine::{ResidentRoutine, SentenceId};
use super::script::ActivityStep;
use crate::routine::{Activity, Response};
use homebody_core::activity::{self, ActivityKind, UsualLength};
use homebody_core::event::BodilyNeed;
use homebody_core::time::{MINUTE, RunTime, Span};

impl RoutineDriver {
    /// When a rule is due that stands before the one being answered.
    pub(super) fn rules_at(&self) -> RunTime {
        self.watches.due_before(self.answering())
    }

    /// The position of the first rule being answered: only earlier ones interrupt it (Brooks 1986).
    fn answering(&self) -> usize {
        self.scripts.iter().filter_map(|playing| playing.answers).min().unwrap_or(usize::MAX)
    }

    pub(super) fn interrupted_at(&self, now: RunTime) -> RunTime {
        let event = self.next_break_at(now);
        if self.visitor.is_some() {
            return RunTime::NEVER;
        }
        // A need does not interrupt the response to another.
        let needs = if self.scripts.len() > 2 { RunTime::NEVER } else { self.needs.presses_at() };
        let meal = self.essential().map_or(RunTime::NEVER, |(_, due)| due);
        event.min(needs).min(meal).min(self.rules_at()).max(now)
    }

    /// Start of the next break. Lying awake waits for bed.
    pub(super) fn next_break_at(&self, now: RunTime) -> RunTime {
        let Some(item) = self.agenda.breaks.get(self.next_break) else { return RunTime::NEVER };
        let waits = item.activity == Activity::LieAwake && !self.needs.asleep() && now <= item.latest;
        if waits { RunTime::NEVER } else { item.start }
    }

    /// The next fall or stumble, which no nap, meal or wash prevents.
    pub(super) fn accident_at(&self) -> RunTime {
        self.next_accident().map_or(RunTime::NEVER, |index| self.agenda.breaks[index].start)
    }

    /// Its index among the breaks; others before it may wait for the end of a nap.
    fn next_accident(&self) -> Option<usize> {
        let is_accident = |item: &Item| matches!(item.activity, Activity::Fall | Activity::Stumble);
        let ahead = self.agenda.breaks.get(self.next_break..).filter(|_| self.visitor.is_none())?;
        ahead.iter().position(is_accident).map(|index| self.next_break + index)
    }

    /// The next short activity that is possible during cooking.
    pub(super) fn breaks_into_cooking_at(&self, now: RunTime) -> RunTime {
        let next = self.agenda.breaks.get(self.next_break).filter(|_| self.visitor.is_none());
        let is_soon_done = |item: &&Item| item.lasts <= SOON_DONE && !item.activity.is_of_the_night();
        next.filter(is_soon_done).map_or(RunTime::NEVER, |item| item.start.max(now))
    }

    /// The next meal or medicine of the plan, and when it interrupts the current activity, if that yields. In company that stays on, this
    /// holds for all that has a time.
    pub(super) fn essential(&self) -> Option<(usize, RunTime)> {
        let (playing, below) = self.scripts.split_last()?;
        if !playing.gives_way || playing.guest.is_none() && !below.is_empty() {
            return None;
        }
        let until = playing.guest.map_or(RunTime::MIN, |guest| guest.until);
        let items = || self.agenda.items.iter().enumerate().skip(self.next_item);
        let in_company = items().find(|(_, item)| item.is_done_in_company(until));
        let in_company = in_company.map(|(index, item)| (index, item.start));
        let due = |due: &(usize, RunTime)| due.1;
        self.next_essential().into_iter().chain(in_company).min_by_key(due)
    }

    fn next_essential(&self) -> Option<(usize, RunTime)> {
        let items = self.agenda.items.iter().enumerate().skip(self.next_item);
        let now = self.now;
        let mut essential = items.filter(|(_, item)| item.is_essential() && self.may_begin(item, now));
        let (index, item) = essential.next()?;
        // Medicine with a time is not delayed by unstated activities.
        let end = item.start + item.lasts;
        let is_first = |of: &Item| of.has_its_time && of.activity == Activity::TakeMedicine && of.start < end;
        if let Some((index, medicine)) = essential.find(|(_, of)| item.waits && is_first(of)) {
            return Some((index, medicine.start));
        }
        // An activity that is nearly done is finished, but not resumed between cooking and eating.
        let is_next = self.at_table > item.start - 2 * GRACE;
        let due = item.start + if is_next { Span::ZERO } else { GRACE };
        let playing = self.scripts.last()?;
        let undisturbed = match item.waits {
            true => playing.undisturbed,
            // An activity with the meal begins before it.
            false if playing.goes_with.is_some_and(|of| item.of == Some(of)) => playing.since + GRACE,
            false => due,
        };
        Some((index, due.max(undisturbed)))
    }

    pub(super) fn interrupt(&mut self, now: RunTime) {
        if self.rules_at() <= now && self.answer_rule(now) {
            return;
        }
        if let Some(index) = self.next_accident().filter(|&index| self.agenda.breaks[index].start <= now) {
            // It precedes those that wait.
            self.agenda.breaks[self.next_break..=index].rotate_right(1);
            return self.begin_break(now);
        }
        if let Some((index, due)) = self.essential()
            && due <= now
        {
            let item = self.agenda.items.remove(index);
            self.tally.plan_item(&item);
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
                // Visits at night are shorter.
                Activity::UseBathroom if self.needs.asleep() => UsualLength { median_min: 4.0, sigma: 0.4 },
                ref activity => defaults::length(activity, &self.life.numbers),
            };
            let lasts_s = self.parameters.lasting_s(&activity, stream.lognormal(median_min * 60.0, sigma));
            let lasts = Span::from_seconds(lasts_s);
            // Nobody naps while a guest sits there, or in the time of something that is stated.
            let is_stated = |of: SentenceId| of.source != ResidentRoutine::UNSAID;
            let is_busy =
                self.scripts.iter().any(|playing| playing.guest.is_some() || playing.of.is_some_and(is_stated));
            if activity == Activity::Nap && (is_busy || self.is_stated_before(now + lasts)) {
                return self.needs.put_off(BodilyNeed::Tiredness, now);
            }
            if let Some(need) = self.waits_for_a_meal(&activity, now + lasts) {
                return self.needs.put_off(need, now);
            }
            self.begin(&Item::now(key, activity, lasts));
        }
    }

    /// The need of a snack or a drink that the next meal meets: a drink would last into its time, a snack would spoil the appetite.
    fn waits_for_a_meal(&self, activity: &Activity, end: RunTime) -> Option<BodilyNeed> {
        let (need, until) = match activity {
            Activity::Snack => (BodilyNeed::Hunger, end + APPETITE),
            Activity::Drink => (BodilyNeed::Thirst, end),
            _ => return None,
        };
        let is_meal =
            |item: &&Item| matches!(item.activity, Activity::Prepare(_) | Activity::Eat(_)) && item.visitor.is_none();
        let next = self.agenda.items.iter().skip(self.next_item).find(is_meal)?;
        (next.start < until && next.latest >= self.now).then_some(need)
    }

    /// Begins the next break, unless it is too late.
    fn begin_break(&mut self, now: RunTime) {
        let Some(item) = self.agenda.breaks.get(self.next_break).cloned() else { return };
        self.next_break += 1;
        // Only in bed.
        let is_idle = item.activity == Activity::LieAwake && !self.needs.asleep();
        if now <= item.latest && !is_idle {
            self.begin_at(&item, now);
        }
    }

    /// Answers a due rule; false if nothing comes of it.
    fn answer_rule(&mut self, now: RunTime) -> bool {
        let due = self.with_watches(|watches, resident| {
            watches.due(resident.answering(), now, |state| resident.is_so(state, now), &resident.life)
        });
        let Some((rule, rank, mut answers)) = due else { return false };
        self.tally.hold(rule);
        answers.reverse();
        self.go_on_answering(rank, answers, now);
        true
    }

    /// Continues with the next response of a rule, the last of the list.
    pub(super) fn go_on_answering(&mut self, rank: usize, mut answers: Vec<Response>, now: RunTime) {
        let Some(next) = answers.pop() else { return };
        self.respond(next, now);
        if let Some(playing) = self.scripts.last_mut() {
            (playing.answers, playing.still) = (Some(rank), answers);
        }
    }

    pub(super) fn respond(&mut self, response: Response, now: RunTime) {
        match response {
            // Ends the night.
            Response::Do { activity: Activity::GetUp, .. } if self.needs.asleep() => {
                for step in self.scripts.iter_mut().flat_map(|playing| playing.steps.iter_mut()) {
                    if let ActivityStep::Stay(stay) = step {
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
                let turns = Some(Turning { thing: index, on, until: None });
                self.begin(&Item { turns, ..Item::now("rule".into(), activity, Span::ZERO) });
            }
            Response::Do { activity, place, lasts } => {
                let key = format!("rule/{}/{}", activity.label(), self.times(&activity));
                let mut stream = self.life.stream_of_day(self.agenda.day, &key);
                let UsualLength { median_min, sigma } = defaults::length(&activity, &self.life.numbers);
                let lasts_s = match lasts {
                    Some(lasts) => lasts.draw(&mut stream),
                    None => stream.lognormal(median_min * 60.0, sigma),
                };
                self.begin(&Item { place, ..Item::now(key, activity, Span::from_seconds(lasts_s)) });
            }
        }
    }
}

/// Time before a meal without a snack (our choice).
const APPETITE: Span = MINUTE.times(45);

/// Shortest rest of a visit that leaves the host time for another activity, while the guest sits by (our choice).
const SITS_BY: Span = MINUTE.times(30);

impl Item {
    /// Whether the host does it at its time although a visitor stays until `until`.
    fn is_done_in_company(&self, until: RunTime) -> bool {
        let is_at_home = self.visitor.is_none()
            && !self.is_essential()
            && !matches!(self.activity, Activity::Leave | Activity::ComeHome);
        is_at_home && self.has_its_time && !self.is_unsaid && self.start.saturating_add(SITS_BY) < until
    }
}

impl Activity {
    /// Leisure, company and housework yield to due meals.
    pub(super) fn gives_way_to_meals(&self) -> bool {
        use ActivityKind::{Food, Housework, Leisure};
        let is_of = |kinds: &[ActivityKind]| self.row().is_some_and(|row| kinds.contains(&row.kind));
        match self {
            Activity::Exercise | Activity::Visit | Activity::Other(_) => true,
            Activity::Everyday(_) => is_of(&[Leisure, Food, Housework]),
            _ => is_of(&[Leisure, Housework]),
        }
    }
}
