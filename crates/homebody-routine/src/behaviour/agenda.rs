//! The plan of a day: activities in order, from rising to bed and through the night after.
//!
//! Each habit of the day is drawn: whether, how often, when, and how long. Activities with a time relative to another
//! follow that one. The plan is in order of start; the driver may deviate.
//!
//! A day lasts from one rising to the next: times in the hours before rising belong to the day before, so that 03:00 occurs
//! whether the resident sleeps or is still up. Stated activities take precedence: unstated washing and dressing wait for a
//! shower with a time.

use super::arrange;
use super::defaults;
use super::drafts::{Drafts, ItemDraft, ItemStart, Resolved};
use super::help;
use super::item::{Follows, Item};
use super::resident_routine::{DayParameters, InForce, ResidentRoutine, SentenceId};
use super::rising::{bed, bed_stated_by, is_bedtime, of_time, sleeps_at, up, varied, varied_length, within_the_day};
use crate::routine::{Activity, FallsFrom, Habit, HabitTime, Meal, PartOfDay, USUAL_SHARE};
use homebody_core::activity::UsualLength;
use homebody_core::fuzzy::Fuzzy;
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, RunTime, SECOND, Span};

#[derive(Clone, Debug)]
pub struct Agenda {
    pub day: i32,
    pub up: RunTime,
    pub bed: RunTime,
    /// The sentence that states the time of the bedtime, and the latest time that it states.
    pub bed_of: Option<SentenceId>,
    pub bed_by: RunTime,
    /// The activity of today that the bedtime waits for.
    pub bed_follows: Option<Follows>,
    /// The name of the place of the coming night's sleep, if stated.
    pub sleeps_at: Option<String>,
    /// The next rising, as expected today.
    pub next_up: RunTime,
    /// Visits to the bathroom after rising and before bed.
    pub bathroom_first: bool,
    pub bathroom_last: bool,
    /// A day in bed, which the resident leaves for needs, medicine and visitors.
    pub in_bed: bool,
    /// Whether the routine gives the times of the visits of the coming night.
    pub says_visits_of_night: bool,
    /// Activities in a row, by start.
    pub items: Vec<Item>,
    /// Interrupting activities, by start, including those of the night.
    pub breaks: Vec<Item>,
    /// Keys of the activities that follow the rising.
    pub(super) mornings: Vec<String>,
}

const MINUTE_S: f64 = 60.0;
const HOUR_S: f64 = 3600.0;

homebody_core::numbers! {
    /// Time from getting up to the end of the morning's washing and dressing.
    static SOON_S = "day.soon": 3_600.0, "s", [0.0, 14_400.0];
    /// Time before rising within which an activity waits until after it. One that is earlier in the night is done in
    /// the night.
    static NEARLY_UP_S = "day.nearly_up": 2_700.0, "s", [0.0, 14_400.0];
    /// Time before bed of the activities that the routine sets for the night, for a person who is up.
    static BEDTIME_H = "day.bedtime": 2.0, "h", [0.25, 6.0];
}

impl Agenda {
    pub fn new(life: &ResidentRoutine, day: i32, parameters: &DayParameters) -> Agenda {
        let up = up(life, day, parameters) + parameters.slept_in;
        // As if tomorrow were like today: a change that begins tomorrow does not affect tonight.
        let next_up = self::up(life, day + 1, parameters);
        let mut bed = bed(life, day, parameters, up, next_up);
        let plan = |bed| {
            let mut planner = Planner {
                life,
                parameters,
                day,
                up,
                bed,
                next_up,
                drafts: Drafts { life, day, up, bed, list: Vec::new(), bedtime: None },
                breaks: Vec::new(),
                bathroom: None,
            };
            planner.draw();
            let Planner { drafts, breaks, bathroom, .. } = planner;
            (drafts.resolve(), breaks, bathroom)
        };
        let mut planned = plan(bed);
        let mut bed_follows = None;
        if let Some((bedtime, follows)) = planned.0.bedtime.take() {
            // Once more, with the activities of the evening and the night at their times.
            (bed, bed_follows) = (within_the_day(bedtime, up, next_up), follows);
            planned = plan(bed);
        }
        let (Resolved { mut items, breaks: while_busy, mornings, .. }, mut breaks, bathroom) = planned;
        breaks.extend(while_busy);
        help::share(&mut items, &mut breaks, &life.numbers);
        items.sort_by_key(|item| item.start);
        let ready = ready(life, up, &items, &mornings);
        // After a late rising, overdue activities are dropped; stated times in the future stay.
        // A visitor rings at their time.
        let waits = |item: &Item| item.visitor.is_none() && item.start < if item.is_unsaid { ready } else { up };
        for item in items.iter_mut().filter(|item| waits(item) && !mornings.contains(&item.key)) {
            (item.start, item.latest) = (ready, item.latest + (ready - item.start));
            // One that follows another is not overdue.
            item.waits = item.is_unsaid || item.follows.is_none();
        }
        arrange::one_meal_after_the_other(&mut items);
        arrange::into_free_time(&mut items);
        items.sort_by_key(|item| item.start);
        arrange::count_at_home(&mut breaks, &items, up, bed);
        // Activities after bedtime interrupt the night.
        let is_of_the_night =
            |item: &Item| item.visitor.is_none() && item.start >= bed && item.activity.is_of_the_night();
        let late = items.extract_if(.., |item| is_of_the_night(item));
        breaks.extend(late.map(|item| Item { latest: item.start + HOUR, ..item }));
        breaks.sort_by_key(|item| item.start);
        let [bathroom_first, bathroom_last] = bathroom.unwrap_or([true; 2]);
        let says_visits_of_night = life.says_visits_in(Interval::new(bed, next_up), day);
        let sleeps_at = sleeps_at(life, day).map(str::to_owned);
        let stated = bed_stated_by(life, day, parameters, up);
        let (bed_of, bed_by) = (stated.map(|stated| stated.0), stated.map_or(RunTime::MIN, |stated| stated.1));
        Agenda {
            day,
            up,
            bed,
            bed_of,
            bed_by,
            bed_follows,
            sleeps_at,
            next_up,
            bathroom_first,
            bathroom_last,
            in_bed: life.stays_in_bed(parameters, day),
            says_visits_of_night,
            items,
            breaks,
            mornings,
        }
    }
}

/// The end of the morning's washing and dressing, as far as they follow soon.
fn ready(life: &ResidentRoutine, up: RunTime, items: &[Item], mornings: &[String]) -> RunTime {
    let soon_is_over = up + Span::from_seconds(life.numbers.of(&SOON_S));
    let soon = items.iter().filter(|item| {
        mornings.contains(&item.key) && item.start < soon_is_over && item.activity != Activity::ComeHome
    });
    soon.map(|item| item.start + item.lasts).fold(up, RunTime::max)
}

/// Time until which it is night (our choice). An activity of a later hour is overdue for a person who sleeps longer.
const NIGHT_S: f64 = 6.0 * HOUR_S;

/// Time until which a visit belongs to the night before (our choice): carers come from five on.
const NIGHT_OF_VISITS_S: f64 = 4.0 * HOUR_S;

/// Time at which a stay of one night ends, and one of several, if no other is stated (our choice).
const AFTER_A_NIGHT: Fuzzy = Fuzzy { low: 9.5 * HOUR_S, from: 10.0 * HOUR_S, to: 11.0 * HOUR_S, high: 11.5 * HOUR_S };
const AFTER_NIGHTS: Fuzzy = Fuzzy { low: 14.0 * HOUR_S, from: 15.0 * HOUR_S, to: 17.0 * HOUR_S, high: 18.0 * HOUR_S };

/// Longest duration, in days (our choice).
const MOST_DAYS: f64 = 400.0;

struct Planner<'a> {
    life: &'a ResidentRoutine,
    parameters: &'a DayParameters,
    day: i32,
    up: RunTime,
    bed: RunTime,
    next_up: RunTime,
    drafts: Drafts<'a>,
    breaks: Vec<Item>,
    /// Whether a stated number of bathroom visits by day includes the one after rising and the one before bed.
    bathroom: Option<[bool; 2]>,
}

#[derive(Clone, Copy)]
struct Repetition {
    number: u32,
    of: u32,
    day: i32,
}

impl Planner<'_> {
    fn draw(&mut self) {
        let life = self.life;
        // The source of the last habit, and its start if it is done today.
        let mut before: (usize, Option<ItemStart>) = (0, None);
        let mut totals = Vec::new();
        let in_bed = life.stays_in_bed(self.parameters, self.day);
        for in_force in life.habits(self.day).filter(|habit| !in_bed || habit.said.is_done_on_a_day_in_bed()) {
            let InForce { said: habit, source, .. } = in_force;
            if habit.when.is_total {
                totals.push(in_force);
                continue;
            }
            if before.0 != source {
                before = (source, None);
            }
            if matches!(habit.activity, Activity::GetUp | Activity::GoToBed) && habit.visitor.is_none() {
                if habit.activity == Activity::GoToBed && is_bedtime(life, self.day, &in_force) {
                    let share = life.stream_of_day(self.day, &format!("{}/start", of_time(in_force.key, 0))).unit();
                    let later = Span::from_seconds(self.parameters.later_s(&Activity::GoToBed));
                    self.drafts.bedtime =
                        ItemStart::relative(&habit.when.time, share, before.1.as_ref()).map(|start| (start, later));
                }
                before.1 = Some(ItemStart::After(habit.activity.clone(), Span::ZERO));
                continue;
            }
            if source == ResidentRoutine::UNSAID && life.says(habit, self.day) {
                continue;
            }
            let mut count = self.count(&in_force, self.day);
            // The meal of a preparation that has stopped is eaten at its time.
            let is_left_out = count == 0 && matches!(habit.activity, Activity::Prepare(_)) && habit.visitor.is_none();
            if is_left_out {
                count = self.count_without_changes(&in_force, self.day);
            }
            if habit.is_how_often(&Activity::UseBathroom, false)
                && source == ResidentRoutine::OWN
                && life.is_meant(habit, self.day)
            {
                count = self.count_without_both_ends(habit, count);
            }
            if habit.when.time == HabitTime::Then && before.1.is_none() {
                continue;
            }
            let mut last = None;
            for number in 0..count {
                last = self.add(&in_force, Repetition { number, of: count, day: self.day }, before.1.as_ref()).or(last);
            }
            if let (true, Some(ItemStart::Then(of))) = (is_left_out, &last) {
                self.drafts.list[*of].is_left_out = true;
            }
            before.1 = last;
        }
        self.draw_small_hours();
        totals.iter().for_each(|total| self.draw_total(total));
        self.share_time_out();
    }

    /// As many repetitions as others leave of a total in its span.
    fn draw_total(&mut self, in_force: &InForce<Habit>) {
        let habit = in_force.said;
        let at = |time_s: f64| self.life.instant(self.day, time_s);
        let span = match &habit.when.time {
            HabitTime::Within(PartOfDay::Night) => Interval::new(self.bed, self.next_up),
            HabitTime::Within(PartOfDay::Day) => Interval::new(self.up, self.bed),
            HabitTime::Within(part) => Interval::new(at(part.hours().0), at(part.hours().1)),
            _ => Interval::new(self.up, self.bed),
        };
        let is_one = |item: &Item| item.activity == habit.activity && item.visitor.is_none();
        let is_within = |draft: &ItemDraft| match draft.start {
            ItemStart::Known => span.contains(draft.item.start),
            // Others refer to activities of the day.
            _ => span.end == self.bed,
        };
        let drafts = self.drafts.list.iter().filter(|draft| is_one(&draft.item) && is_within(draft)).count();
        let breaks = self.breaks.iter().filter(|item| is_one(item) && span.contains(item.start)).count();
        let mut count = self.count(in_force, self.day).saturating_sub((drafts + breaks) as u32);
        if habit.is_how_often(&Activity::UseBathroom, false) {
            count = self.count_without_both_ends(habit, count);
        }
        for number in 0..count {
            self.add(in_force, Repetition { number, of: count, day: self.day }, None);
        }
    }

    /// The number of bathroom visits besides those after rising and before bed, which count, too, if the sentence covers them.
    fn count_without_both_ends(&mut self, habit: &Habit, mut count: u32) -> u32 {
        let at = |time_s: f64| self.life.instant(self.day, time_s);
        let covers = |end: RunTime| match &habit.when.time {
            HabitTime::At(time) => (at(time.low)..=at(time.high)).contains(&end),
            _ => true,
        };
        let are_covered = [covers(self.up), covers(self.bed)];
        for (is_counted, is_covered) in self.bathroom.get_or_insert_default().iter_mut().zip(are_covered) {
            if !*is_counted && is_covered && count > 0 {
                *is_counted = true;
                count -= 1;
            }
        }
        count
    }

    /// Distributes a change of the time out over the day's outings.
    fn share_time_out(&mut self) {
        let is_outing = |item: &Item| item.activity == Activity::Leave && item.visitor.is_none();
        let outings =
            || self.drafts.list.iter().map(|draft| &draft.item).chain(&self.breaks).filter(|item| is_outing(item));
        let longer = Span::from_seconds(self.parameters.longer_s(&Activity::Leave) / outings().count().max(1) as f64);
        let all = self.drafts.list.iter_mut().map(|draft| &mut draft.item).chain(&mut self.breaks);
        all.filter(|item| is_outing(item)).for_each(|item| item.lasts = (item.lasts + longer).max(SECOND));
    }

    /// Tomorrow's sentences apply to the hours before tomorrow's rising.
    fn draw_small_hours(&mut self) {
        let (life, tomorrow) = (self.life, self.day + 1);
        let mut before: (usize, Option<ItemStart>) = (0, None);
        for in_force in life.habits(tomorrow) {
            let InForce { said: habit, source, .. } = in_force;
            let last = before.1.take().filter(|_| before.0 == source);
            let is_early = match &habit.when.time {
                HabitTime::At(time) => life.instant(tomorrow, time.low) < self.next_up,
                HabitTime::Then => last.is_some(),
                _ => false,
            };
            let is_day = matches!(habit.activity, Activity::GetUp | Activity::GoToBed) && habit.visitor.is_none();
            if is_day || source == ResidentRoutine::UNSAID || !is_early {
                continue;
            }
            let count = self.count(&in_force, tomorrow);
            for number in 0..count {
                let repetition = Repetition { number, of: count, day: tomorrow };
                before = (source, self.add(&in_force, repetition, last.as_ref()).or(before.1));
            }
        }
    }

    /// Number of repetitions on a day.
    fn count(&self, in_force: &InForce<Habit>, day: i32) -> u32 {
        let habit = in_force.said;
        let within = habit.when.part();
        // A skipped meal is not prepared either.
        let meal = habit.activity.of_same_meal().filter(|_| matches!(habit.activity, Activity::Prepare(_)));
        let is_skipped = |activity: &Activity| self.life.skips(self.parameters, activity, day);
        if is_skipped(&habit.activity) || meal.is_some_and(|meal| is_skipped(&meal)) {
            return 0;
        }
        self.count_at(in_force, day, self.parameters.oftener(&habit.activity, within))
    }

    fn count_without_changes(&self, in_force: &InForce<Habit>, day: i32) -> u32 {
        self.count_at(in_force, day, 1.0)
    }

    fn count_at(&self, in_force: &InForce<Habit>, day: i32, oftener: f64) -> u32 {
        let InForce { said: habit, strength, key, .. } = *in_force;
        if !self.life.is_on(&habit.when.days, day) {
            return 0;
        }
        let key = of_time(key, 0);
        let share = |purpose: &str| self.life.stream_of_day(day, &format!("{key}/{purpose}")).unit();
        let chance = self.life.chance(habit, strength, day);
        // On more days as long as there are any, then more times a day.
        let (chance, more) = match habit.when.chance.days_a_week {
            Some(days) => {
                let days = f64::from(days) * oftener;
                let (rank, of) = self.life.place_in_week(&habit.when.days, &key, day);
                let chance = (chance / habit.when.chance.probability).min(1.0);
                (chance * (days - rank).clamp(0.0, 1.0), (days / of).max(1.0))
            }
            None => ((chance * oftener).min(1.0), (chance * oftener).max(1.0)),
        };
        if share("whether") >= chance {
            return 0;
        }
        let (least, most) = habit.when.times;
        let drawn = f64::from(least) + libm::floor(share("times") * f64::from(most - least + 1));
        // A fraction becomes a probability.
        let times = drawn * more;
        let whole = libm::floor(times);
        (whole as u32 + u32::from(share("once more") < times - whole)).min(200)
    }

    /// In seconds, with random numbers from `key`.
    fn length_s(&self, habit: &Habit, key: &str, day: i32) -> f64 {
        let irregular = self.parameters.irregular;
        let lasts_s = match &habit.when.lasts {
            Some(lasts) => {
                let share = self.life.stream_of_day(day, &format!("{key}/lasts")).unit();
                varied_length(lasts, share, irregular)
            }
            None => {
                let UsualLength { median_min, sigma } = defaults::length(&habit.activity, &self.life.numbers);
                let mut stream = self.life.stream_of_day(day, &format!("{key}/lasts"));
                let wider = sigma * irregular.min(2.0);
                // A wider lognormal of the same mean has a smaller median.
                let median_s = median_min * MINUTE_S * libm::exp((sigma * sigma - wider * wider) / 2.0);
                stream.lognormal(median_s, wider)
            }
        };
        self.parameters.lasting_s(&habit.activity, lasts_s) * self.life.person.length
    }

    /// Adds one repetition. Returns the start of a habit that follows it with "then", if it is done.
    fn add(&mut self, in_force: &InForce<Habit>, time: Repetition, before: Option<&ItemStart>) -> Option<ItemStart> {
        let InForce { said: habit, key, source, .. } = *in_force;
        let key = of_time(key, time.number);
        let own = self.life.stream_of_day(time.day, &format!("{key}/start")).unit();
        // Repetitions are spread over equal parts of the span.
        let share = (f64::from(time.number) + own) / f64::from(time.of);
        let (activity, parameters) = (habit.activity.clone(), self.parameters);
        let lasts = Span::from_seconds(self.length_s(habit, &key, time.day).clamp(1.0, MOST_DAYS * 24.0 * HOUR_S));
        let clock_s =
            if source == ResidentRoutine::UNSAID { self.out_of_step_s() } else { 0.0 } + self.life.person.clock_s;
        let later = Span::from_seconds(parameters.later_s(&activity) + clock_s);
        let at = |time_s: f64| self.life.instant(time.day, time_s);
        let within = |from: RunTime, to: RunTime| from + (to - from).max(Span::ZERO).share(share);
        let (mut patience, mut open) = (2.5 * HOUR_S, None);
        let when = self.when_of(habit, &key, time.day);
        let (start, known) = match &when {
            HabitTime::At(span) if habit.when.times.1 > 1 && !PartOfDay::Night.contains(span.mean()) => {
                let while_up = Interval::new(self.up + 45 * MINUTE, self.bed);
                let span = Interval::new(at(span.low), at(span.high)).intersection(while_up);
                open = Some(span);
                (within(span.begin, span.end), ItemStart::Known)
            }
            HabitTime::At(time) => {
                patience = 4.0 * HOUR_S;
                (at(varied(time, share, parameters.irregular)), ItemStart::Known)
            }
            HabitTime::Within(PartOfDay::Night) if activity.is_of_the_night() => {
                (within(self.bed + 30 * MINUTE, self.next_up - 20 * MINUTE), ItemStart::Known)
            }
            HabitTime::Within(PartOfDay::Night) => {
                let from = self.bed - Span::from_seconds(self.life.numbers.of(&BEDTIME_H) * HOUR_S);
                (within(from, self.bed - lasts), ItemStart::Known)
            }
            HabitTime::Within(part) => {
                let (from, to) = part.hours();
                let to = (to - lasts.seconds()).max(from + 0.2 * (to - from));
                patience = (to - from) + HOUR_S;
                open = Some(Interval::new(at(from), at(to)));
                (at(from + (to - from) * share), ItemStart::Known)
            }
            HabitTime::AnyTime if time.of > 1 => self.spread_over_the_day(&activity, time, lasts, own),
            HabitTime::AnyTime => match defaults::clock(&activity, &self.life.numbers) {
                Some(time) => (at(varied(&time, share, parameters.irregular)), ItemStart::Known),
                None => {
                    patience = 6.0 * HOUR_S;
                    (self.any_time(habit, share), ItemStart::Known)
                }
            },
            relative_time => (RunTime::START, ItemStart::relative(relative_time, own, before)?),
        };
        let (start, known) = match known {
            ItemStart::At(start) => (start, ItemStart::Known),
            known => (start, known),
        };
        let start = start.saturating_add(if matches!(known, ItemStart::Known) { later } else { Span::ZERO });
        let is_before_rising = match &habit.visitor {
            Some(_) => start < self.life.instant(time.day, NIGHT_OF_VISITS_S),
            None => self.is_before_rising(start, time.day),
        };
        if matches!(habit.when.time, HabitTime::At(_)) && is_before_rising != (time.day > self.day) {
            return None;
        }
        let stated_by = match &habit.when.time {
            HabitTime::At(time) => at(time.high).saturating_add(later),
            HabitTime::Within(part) if *part != PartOfDay::Night => at(part.hours().1).saturating_add(later),
            _ => RunTime::MIN,
        };
        let until = self.end_of(habit, &key, time.day);
        // A visit until two in the morning ends on the next day.
        let is_over_midnight = |until: RunTime| habit.visitor.is_some() && known == ItemStart::Known && until <= start;
        let until = until.map(|until| if is_over_midnight(until) { until + DAY } else { until });
        let is_long = habit.visitor.is_some() || habit.when.nights > 0;
        let lasts = match until.filter(|_| is_long && known == ItemStart::Known && habit.when.lasts.is_none()) {
            Some(until) => (until.saturating_add(later) - start).max(SECOND),
            None => lasts,
        };
        let item = Item {
            place: habit.place.clone(),
            eats_out: habit.eats_out,
            thing_on: habit.thing_on.clone(),
            falling: habit.falling,
            visitor: habit.visitor.clone(),
            start,
            stated_by,
            until: until.map(|until| until.saturating_add(later)),
            latest: start + Span::from_seconds(patience),
            of: Some(in_force.id()),
            is_unsaid: source == ResidentRoutine::UNSAID,
            waits: source == ResidentRoutine::UNSAID,
            has_its_time: source != ResidentRoutine::UNSAID
                && !matches!(when, HabitTime::AnyTime | HabitTime::Within(_)),
            has_key: habit.key,
            does: habit.does.clone(),
            open,
            is_counted: match when {
                HabitTime::AnyTime => time.of > 1 || habit.activity == Activity::UseBathroom,
                _ => open.is_some() && matches!(when, HabitTime::At(_)),
            },
            ..Item::now(key, activity, lasts)
        };
        let in_the_night = start >= self.bed;
        let is_break = item.visitor.is_none() && item.activity.interrupts(in_the_night);
        if matches!(known, ItemStart::Known) && is_break {
            let latest = match (item.activity.can_come_later(), &when) {
                (true, HabitTime::AnyTime) => self.bed,
                (true, HabitTime::Within(part)) if *part != PartOfDay::Night => at(part.hours().1),
                _ => start,
            };
            self.breaks.push(Item { latest: latest.max(start + HOUR), ..item });
            return Some(ItemStart::At(start + lasts));
        }
        let later = Span::from_seconds(parameters.later_s(&item.activity));
        self.drafts.list.push(ItemDraft { item, start: known, later, is_left_out: false });
        Some(ItemStart::Then(self.drafts.list.len() - 1))
    }

    /// The stated end, which is on a later day after nights.
    fn end_of(&self, habit: &Habit, key: &str, day: i32) -> Option<RunTime> {
        let share = || self.life.stream_of_day(day, &format!("{key}/until")).unit();
        let nights = habit.when.nights;
        let time_s = match (habit.when.until, nights) {
            (Some(until), _) => varied(&until, share(), self.parameters.irregular),
            (None, 0) => return None,
            (None, 1) => AFTER_A_NIGHT.at(share()),
            (None, _) => AFTER_NIGHTS.at(share()),
        };
        Some(self.life.instant(day.saturating_add(nights.min(MOST_DAYS as u32) as i32), time_s))
    }

    /// The time of one repetition. A fall with a usual part of the day has it with the usual share.
    fn when_of(&self, habit: &Habit, key: &str, day: i32) -> HabitTime {
        let Some((part, from)) = habit.falling.and_then(|falling| Some((falling.mostly?, falling.from))) else {
            return habit.when.time.clone();
        };
        let share = self.life.stream_of_day(day, &format!("{key}/mostly")).unit();
        match part {
            _ if share < USUAL_SHARE => HabitTime::Within(part),
            PartOfDay::Night => HabitTime::AnyTime,
            _ if part == PartOfDay::Day || from == FallsFrom::Bed => HabitTime::Within(PartOfDay::Night),
            _ => HabitTime::AnyTime,
        }
    }

    /// From an hour after rising to an hour before bed, outside of the usual part of a fall.
    fn any_time(&self, habit: &Habit, share: f64) -> RunTime {
        let (from, to) = (self.up + HOUR, self.bed - HOUR);
        let to = to.max(from);
        let mostly = habit.falling.and_then(|falling| falling.mostly).map(PartOfDay::hours);
        let (begin, end) = mostly.map_or((from, from), |(begin_s, end_s)| {
            let within = |time_s: f64| self.life.instant(self.day, time_s).clamp(from, to);
            (within(begin_s), within(end_s))
        });
        let at = from + (to - from - (end - begin)).share(share);
        if at < begin { at } else { at + (end - begin) }
    }

    /// Delay of unstated activities for a resident with unusual hours, in seconds; negative if early.
    fn out_of_step_s(&self) -> f64 {
        /// Earliest and latest hour of getting up of a person who keeps the hours of others (our choice).
        const IN_STEP_H: (f64, f64) = (4.5, 10.0);
        let up_s = (self.up - self.life.instant(self.day, 0.0)).seconds();
        up_s - up_s.clamp(IN_STEP_H.0 * HOUR_S, IN_STEP_H.1 * HOUR_S)
    }

    /// Whether an instant is before the rising of a day, or before the bedtime that ends it.
    fn is_before_rising(&self, start: RunTime, day: i32) -> bool {
        let is_next = day > self.day;
        let rising = if is_next { self.next_up } else { self.up };
        if start >= rising - Span::from_seconds(self.life.numbers.of(&NEARLY_UP_S)) {
            return false;
        }
        if start < self.life.instant(day, NIGHT_S) {
            return true;
        }
        let bed = match is_next {
            true => self.bed,
            false => {
                let before = up(self.life, self.day - 1, self.parameters);
                bed(self.life, self.day - 1, self.parameters, before, self.up)
            }
        };
        start < bed
    }

    /// Medicine goes with meals; other activities are spread from soon after rising to shortly before bed.
    fn spread_over_the_day(
        &self,
        activity: &Activity,
        time: Repetition,
        lasts: Span,
        own: f64,
    ) -> (RunTime, ItemStart) {
        if *activity == Activity::TakeMedicine && time.of <= 4 {
            let meals: &[Meal] = if time.of == 2 { &[Meal::Breakfast, Meal::Dinner] } else { &Meal::ALL };
            return match meals.get(time.number as usize) {
                Some(meal) => (RunTime::START, ItemStart::With(Activity::Eat(*meal))),
                None => (RunTime::START, ItemStart::Before(Activity::GoToBed, 20 * MINUTE)),
            };
        }
        let (number, of) = (f64::from(time.number), f64::from(time.of));
        let varied = (own - 0.5) * 0.3 / of;
        let (from, to, place) = match activity {
            // Between the visits after rising and before bed.
            Activity::UseBathroom => (self.up, self.bed, (number + 1.0) / (of + 1.0)),
            _ => (self.up + 45 * MINUTE, self.bed - HOUR - lasts, number / (of - 1.0)),
        };
        (from + (to - from).max(Span::ZERO).share((place + varied).clamp(0.0, 1.0)), ItemStart::Known)
    }
}
