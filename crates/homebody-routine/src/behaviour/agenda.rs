//! The plan of a day: activities in order, from rising to bed and through the night after.
//!
//! Each habit of the day is drawn: whether, how often, when, and how long. Activities with a time relative to another
//! follow that one. The plan is in order of start; the driver may deviate.
//!
//! A day lasts from one rising to the next: times in the hours before rising belong to the day before, so that 03:00 occurs
//! whether the resident sleeps or is still up. Stated activities take precedence: unstated washing and dressing wait for a
//! shower with a time.

use super::defaults;
use super::drafts::{Drafts, ItemDraft, ItemStart, Resolved};
use super::item::Item;
use super::resident_routine::{DayParameters, InForce, ResidentRoutine};
use super::rising::{bed, of_time, up, varied, varied_length};
use crate::routine::{Activity, FallsFrom, Habit, HabitTime, Meal, PartOfDay, USUAL_SHARE};
use homebody_core::activity::UsualLength;
use homebody_core::time::{HOUR, Interval, MINUTE, RunTime, SECOND, Span};

#[derive(Clone, Debug)]
pub struct Agenda {
    pub day: i32,
    pub up: RunTime,
    pub bed: RunTime,
    /// The next rising, as expected today.
    pub next_up: RunTime,
    /// Visits to the bathroom after rising and before bed.
    pub bathroom_first: bool,
    pub bathroom_last: bool,
    /// Activities in a row, by start.
    pub items: Vec<Item>,
    /// Interrupting activities, by start, including those of the night.
    pub breaks: Vec<Item>,
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
        let bed = bed(life, day, parameters, up, next_up);
        let mut planner = Planner {
            life,
            parameters,
            day,
            up,
            bed,
            next_up,
            drafts: Drafts { life, day, up, bed, list: Vec::new() },
            breaks: Vec::new(),
            bathroom: None,
        };
        planner.draw();
        let Planner { drafts, mut breaks, bathroom, .. } = planner;
        let Resolved { mut items, breaks: while_busy, mornings } = drafts.resolve();
        breaks.extend(while_busy);
        items.sort_by_key(|item| item.start);
        let ready = ready(life, up, &items, &mornings);
        // After a late rising, overdue activities are dropped; stated times in the future stay.
        let waits = |item: &Item| item.start < if item.is_unsaid { ready } else { up };
        for item in items.iter_mut().filter(|item| waits(item) && !mornings.contains(&item.key)) {
            item.latest += ready - item.start;
            item.start = ready;
            item.waits = true;
        }
        one_meal_after_the_other(&mut items);
        items.sort_by_key(|item| item.start);
        count_at_home(&mut breaks, &items, up, bed);
        // Activities after bedtime interrupt the night.
        let is_of_the_night =
            |item: &Item| item.visitor.is_none() && item.start >= bed && item.activity.is_of_the_night();
        let late = items.extract_if(.., |item| is_of_the_night(item));
        breaks.extend(late.map(|item| Item { latest: item.start + HOUR, ..item }));
        breaks.sort_by_key(|item| item.start);
        let visits = bathroom.unwrap_or(2);
        Agenda { day, up, bed, next_up, bathroom_first: visits > 0, bathroom_last: visits > 1, items, breaks }
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

/// A late breakfast delays lunch.
fn one_meal_after_the_other(items: &mut [Item]) {
    let mut over = RunTime::MIN;
    for meal in Meal::ALL {
        let is_of = |item: &&mut Item| {
            item.visitor.is_none() && [Activity::Prepare(meal), Activity::Eat(meal)].contains(&item.activity)
        };
        let of_meal: Vec<&mut Item> = items.iter_mut().filter(is_of).collect();
        let Some(begin) = of_meal.iter().map(|item| item.start).min() else { continue };
        let by = over.saturating_since(begin).max(Span::ZERO);
        for item in of_meal {
            (item.start, item.latest, item.waits) = (item.start + by, item.latest + by, item.waits || by > Span::ZERO);
            over = over.max(item.start + item.lasts);
        }
    }
}

/// Spreads activities with a number per day over the time at home. Those that a long outing displaced follow it.
fn count_at_home(breaks: &mut [Item], items: &[Item], up: RunTime, bed: RunTime) {
    let outings = items.iter().filter(|item| item.activity == Activity::Leave && item.visitor.is_none());
    let outings = outings.map(|item| Interval::new(item.start, item.until.unwrap_or(item.start + item.lasts)));
    let mut away: Vec<Interval<RunTime>> = Vec::new();
    for outing in outings {
        let over = away.last().map_or(up, |before| before.end);
        away.extend(Some(outing.intersection(Interval::new(over, bed))).filter(|outing| !outing.is_empty()));
    }
    let at_home = bed - up - away.iter().map(|outing| outing.length()).sum::<Span>();
    let share = at_home.ratio((bed - up).max(Span::MICROSECOND));
    for item in breaks.iter_mut().filter(|item| item.is_counted && (up..bed).contains(&item.start)) {
        let mut start = up + (item.start - up).share(share);
        for outing in &away {
            start += if start >= outing.begin { outing.length() } else { Span::ZERO };
        }
        (item.start, item.latest) = (start, bed);
    }
}

/// Time until which it is night (our choice). An activity of a later hour is overdue for a person who sleeps longer.
const NIGHT_S: f64 = 6.0 * HOUR_S;

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
    /// Stated number of bathroom visits by day.
    bathroom: Option<u32>,
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
        for in_force in life.habits(self.day) {
            let InForce { said: habit, source, .. } = in_force;
            if before.0 != source {
                before = (source, None);
            }
            if matches!(habit.activity, Activity::GetUp | Activity::GoToBed) && habit.visitor.is_none() {
                before.1 = Some(ItemStart::After(habit.activity.clone(), Span::ZERO));
                continue;
            }
            if source == ResidentRoutine::UNSAID && life.says(habit, self.day) {
                continue;
            }
            let mut count = self.count(&in_force, self.day);
            if habit.is_how_often(&Activity::UseBathroom, false)
                && source == ResidentRoutine::OWN
                && life.is_meant(habit, self.day)
            {
                // The visits after rising and before bed count, too.
                let said = self.bathroom.unwrap_or(0) + count;
                count = count.min(said.saturating_sub(2));
                self.bathroom = Some(said);
            }
            if habit.when.time == HabitTime::Then && before.1.is_none() {
                continue;
            }
            let mut last = None;
            for number in 0..count {
                last = self.add(&in_force, Repetition { number, of: count, day: self.day }, before.1.as_ref()).or(last);
            }
            before.1 = last;
        }
        self.draw_small_hours();
        self.share_time_out();
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
        for in_force in life.habits(tomorrow) {
            let InForce { said: habit, source, .. } = in_force;
            let HabitTime::At(time) = &habit.when.time else { continue };
            let is_day = matches!(habit.activity, Activity::GetUp | Activity::GoToBed) && habit.visitor.is_none();
            if is_day || source == ResidentRoutine::UNSAID || life.instant(tomorrow, time.low) >= self.next_up {
                continue;
            }
            let count = self.count(&in_force, tomorrow);
            for number in 0..count {
                self.add(&in_force, Repetition { number, of: count, day: tomorrow }, None);
            }
        }
    }

    /// Number of repetitions on a day.
    fn count(&self, in_force: &InForce<Habit>, day: i32) -> u32 {
        let InForce { said: habit, strength, key, .. } = *in_force;
        if !self.life.is_on(&habit.when.days, day) {
            return 0;
        }
        let key = of_time(key, 0);
        let share = |purpose: &str| self.life.stream_of_day(day, &format!("{key}/{purpose}")).unit();
        let within = match habit.when.time {
            HabitTime::Within(part) => Some(part),
            _ => None,
        };
        let chance = self.life.chance(habit, strength, day);
        let oftener = self.parameters.oftener(&habit.activity, within);
        // A skipped meal is not prepared either.
        let skipped = match habit.activity {
            Activity::Prepare(meal) => Activity::Eat(meal),
            ref activity => activity.clone(),
        };
        let skip = self.life.stream_of_day(day, &format!("skip/{}", skipped.label())).unit();
        if let Some(days) = habit.when.chance.days_a_week
            && !self.is_one_of(habit, &key, days, day)
        {
            return 0;
        }
        let chance = if habit.when.chance.days_a_week.is_some() {
            (chance / habit.when.chance.probability).min(1.0)
        } else {
            chance
        };
        if share("whether") >= (chance * oftener.min(1.0)).min(1.0) || skip < self.parameters.skips(&skipped) {
            return 0;
        }
        let (least, most) = habit.when.times;
        let drawn = f64::from(least) + libm::floor(share("times") * f64::from(most - least + 1));
        // A fraction becomes a probability.
        let times = drawn * oftener.max(1.0);
        let whole = libm::floor(times);
        (whole as u32 + u32::from(share("once more") < times - whole)).min(200)
    }

    /// Whether a day is among the days of its week that are drawn for the habit.
    fn is_one_of(&self, habit: &Habit, key: &str, days: u8, today: i32) -> bool {
        let meant = self.life.week_of(today).filter(|&day| self.life.is_on(&habit.when.days, day));
        let share = |day: i32| self.life.stream_of_day(day, &format!("{key}/of the week")).unit();
        let own = share(today);
        meant.filter(|&day| day != today && share(day) < own).count() < usize::from(days)
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
        let mut patience = 2.5 * HOUR_S;
        let when = self.when_of(habit, &key, time.day);
        let (start, known) = match &when {
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
            HabitTime::After(activity, gap) => (
                RunTime::START,
                ItemStart::After(activity.clone(), Span::from_seconds(gap.map_or(0.0, |gap| gap.at(own)))),
            ),
            HabitTime::Before(activity, gap) => (
                RunTime::START,
                ItemStart::Before(activity.clone(), Span::from_seconds(gap.map_or(0.0, |gap| gap.at(own)))),
            ),
            HabitTime::With(activity) => (RunTime::START, ItemStart::With(activity.clone())),
            HabitTime::Then => (RunTime::START, before?.clone()),
        };
        let (start, known) = match known {
            ItemStart::At(start) => (start, ItemStart::Known),
            known => (start, known),
        };
        let start = start.saturating_add(if matches!(known, ItemStart::Known) { later } else { Span::ZERO });
        if matches!(habit.when.time, HabitTime::At(_))
            && self.is_before_rising(start, time.day) != (time.day > self.day)
        {
            return None;
        }
        let until_share = || self.life.stream_of_day(time.day, &format!("{key}/until")).unit();
        let until = habit.when.until.map(|until| at(varied(&until, until_share(), parameters.irregular)));
        let item = Item {
            activity,
            place: habit.place.clone(),
            falling: habit.falling,
            visitor: habit.visitor.clone(),
            start,
            lasts,
            until: until.map(|until| until.saturating_add(later)),
            latest: start + Span::from_seconds(patience),
            of: Some(in_force.id()),
            is_unsaid: source == ResidentRoutine::UNSAID,
            waits: source == ResidentRoutine::UNSAID,
            has_its_time: source != ResidentRoutine::UNSAID
                && !matches!(when, HabitTime::AnyTime | HabitTime::Within(_)),
            is_counted: matches!(when, HabitTime::AnyTime) && (time.of > 1 || habit.activity == Activity::UseBathroom),
            follows: None,
            key,
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
        self.drafts.list.push(ItemDraft { item, start: known });
        Some(ItemStart::Then(self.drafts.list.len() - 1))
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
        let (from, to) = (self.up + 45 * MINUTE, self.bed - HOUR - lasts);
        let place = f64::from(time.number) / f64::from(time.of - 1) + (own - 0.5) * 0.3 / f64::from(time.of);
        (from + (to - from).max(Span::ZERO).share(place.clamp(0.0, 1.0)), ItemStart::Known)
    }
}

impl Activity {
    /// Done at night if so stated, in or out of bed; all other activities are done before bed.
    pub(crate) fn is_of_the_night(&self) -> bool {
        use Activity::{Drink, Fall, Lap, Leave, LieAwake, Pace, Snack, Stumble, UseBathroom, Wander};
        matches!(self, UseBathroom | LieAwake | Fall | Stumble | Wander | Pace | Lap | Drink | Snack | Leave)
    }

    /// Whether it is done later if its time passed away from home or asleep; not if it is also done elsewhere.
    fn can_come_later(&self) -> bool {
        matches!(self, Activity::Wander | Activity::Pace | Activity::Lap | Activity::Fall | Activity::Stumble)
    }

    /// As opposed to waiting for its turn.
    fn interrupts(&self, at_night: bool) -> bool {
        match self {
            Activity::Wander | Activity::Pace | Activity::Lap | Activity::LieAwake | Activity::UseBathroom => true,
            Activity::Fall | Activity::Stumble => true,
            _ => at_night,
        }
    }
}
