//! The plan of a day: what is to be done, in which order, from getting up to going to bed and through the night after.
//!
//! Each habit that is meant for the day is drawn: whether, how often, when, for how long. What is said relative to
//! something else is put beside it. The order is that of the starts; how the day really goes is for the living.
//!
//! A day goes from one rising to the next: what has its time in the hours before rising is of the day before, so that
//! 03:00 is lived whether one sleeps then or is still up. What is said comes before what is not: unsaid washing and
//! dressing wait for a shower that has its time.

use super::drafts::{Draft, Drafts, Resolved, Start};
use super::item::Item;
use super::life::{DayParameters, InForce, Life};
use super::rising::{bed, of_time, up, varied, varied_length};
use super::usual;
use crate::routine::{Activity, FallsFrom, Habit, Meal, PartOfDay, USUAL_SHARE, When};
use homebody_core::activity::UsualLength;
use homebody_core::time::{Micros, SECOND, micros, seconds};

/// A day's plan.
#[derive(Clone, Debug)]
pub struct Agenda {
    pub day: i32,
    /// When the resident gets up, and goes to bed.
    pub up: Micros,
    pub bed: Micros,
    /// When the day after begins, as it looks today.
    pub next_up: Micros,
    /// Whether there is a visit to the bathroom first thing, and one before bed.
    pub bathroom_first: bool,
    pub bathroom_last: bool,
    /// What is done one after the other, in order of start.
    pub items: Vec<Item>,
    /// What interrupts whatever goes on then, in order of start; also in the night after the day.
    pub breaks: Vec<Item>,
}

const MINUTE: f64 = 60.0;
const HOUR: f64 = 3600.0;

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
    /// The plan of a day of a life, as it is with the day's mood.
    pub fn of(life: &Life, day: i32, parameters: &DayParameters) -> Agenda {
        let up = up(life, day, parameters) + parameters.slept_in;
        // As it would be if tomorrow were as today: a change that begins tomorrow does not touch tonight.
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
        // Who gets up late begins the day later, and not with what is overdue; what is said keeps a time that is not past.
        let waits = |item: &Item| item.start < if item.is_unsaid { ready } else { up };
        for item in items.iter_mut().filter(|item| waits(item) && !mornings.contains(&item.key)) {
            item.latest += ready - item.start;
            item.start = ready;
            item.waits = true;
        }
        one_meal_after_the_other(&mut items);
        items.sort_by_key(|item| item.start);
        count_at_home(&mut breaks, &items, up, bed);
        // What comes after going to bed interrupts the night.
        let is_of_the_night =
            |item: &Item| item.visitor.is_none() && item.start >= bed && item.activity.is_of_the_night();
        let late = items.extract_if(.., |item| is_of_the_night(item));
        breaks.extend(late.map(|item| Item { latest: item.start + 3600 * SECOND, ..item }));
        breaks.sort_by_key(|item| item.start);
        let visits = bathroom.unwrap_or(2);
        Agenda { day, up, bed, next_up, bathroom_first: visits > 0, bathroom_last: visits > 1, items, breaks }
    }
}

/// When what is done after getting up is done, as far as it is done soon.
fn ready(life: &Life, up: Micros, items: &[Item], mornings: &[String]) -> Micros {
    let soon_is_over = up + micros(life.numbers.of(&SOON_S));
    let soon = items.iter().filter(|item| {
        mornings.contains(&item.key) && item.start < soon_is_over && item.activity != Activity::ComeHome
    });
    soon.map(|item| item.start + item.lasts).fold(up, Micros::max)
}

/// Who has breakfast late has lunch after it.
fn one_meal_after_the_other(items: &mut [Item]) {
    let mut over = Micros::MIN;
    for meal in Meal::ALL {
        let is_of = |item: &&mut Item| {
            item.visitor.is_none() && [Activity::Prepare(meal), Activity::Eat(meal)].contains(&item.activity)
        };
        let of_meal: Vec<&mut Item> = items.iter_mut().filter(is_of).collect();
        let Some(begin) = of_meal.iter().map(|item| item.start).min() else { continue };
        let by = over.saturating_sub(begin).max(0);
        for item in of_meal {
            (item.start, item.latest, item.waits) = (item.start + by, item.latest + by, item.waits || by > 0);
            over = over.max(item.start + item.lasts);
        }
    }
}

/// What is done so many times a day is spread over the time at home, beside the outings; what an outing that takes longer has
/// kept from its time is done after it.
fn count_at_home(breaks: &mut [Item], items: &[Item], up: Micros, bed: Micros) {
    let outings = items.iter().filter(|item| item.activity == Activity::Leave && item.visitor.is_none());
    let outings = outings.map(|item| (item.start, item.until.unwrap_or(item.start + item.lasts)));
    let mut away: Vec<(Micros, Micros)> = Vec::new();
    for (from, to) in outings {
        let from = away.last().map_or(up, |before| before.1).max(from);
        away.extend(Some((from, to.min(bed))).filter(|(from, to)| from < to));
    }
    let at_home = bed - up - away.iter().map(|(from, to)| to - from).sum::<Micros>();
    let share = at_home as f64 / (bed - up).max(1) as f64;
    for item in breaks.iter_mut().filter(|item| item.is_counted && (up..bed).contains(&item.start)) {
        let mut start = up + ((item.start - up) as f64 * share) as Micros;
        for (from, to) in &away {
            start += if start >= *from { to - from } else { 0 };
        }
        (item.start, item.latest) = (start, bed);
    }
}

/// Time until which it is night (our choice). An activity of a later hour is overdue for a person who sleeps longer.
const NIGHT_S: f64 = 6.0 * HOUR;

/// Longest duration, in days (our choice).
const MOST_DAYS: f64 = 400.0;

struct Planner<'a> {
    life: &'a Life,
    parameters: &'a DayParameters,
    day: i32,
    up: Micros,
    bed: Micros,
    next_up: Micros,
    drafts: Drafts<'a>,
    breaks: Vec<Item>,
    /// How often the routine says that the bathroom is visited by day, if it does.
    bathroom: Option<u32>,
}

/// One of several times that a habit is done on a day.
#[derive(Clone, Copy)]
struct Time {
    number: u32,
    of: u32,
    /// The day of the calendar that it is said of.
    day: i32,
}

impl Planner<'_> {
    /// Draws every habit of the day.
    fn draw(&mut self) {
        let life = self.life;
        // The text of the last habit, and when that is done if it is done today.
        let mut before: (usize, Option<Start>) = (0, None);
        for in_force in life.habits(self.day) {
            let InForce { said: habit, source, .. } = in_force;
            if before.0 != source {
                before = (source, None);
            }
            if matches!(habit.activity, Activity::GetUp | Activity::GoToBed) && habit.visitor.is_none() {
                before.1 = Some(Start::After(habit.activity.clone(), 0));
                continue;
            }
            if source == Life::UNSAID && life.says(habit, self.day) {
                continue;
            }
            let mut count = self.count(&in_force, self.day);
            if habit.is_how_often(&Activity::UseBathroom, false)
                && source == Life::OWN
                && life.is_meant(habit, self.day)
            {
                // First thing in the morning and before bed are two of them.
                let said = self.bathroom.unwrap_or(0) + count;
                count = count.min(said.saturating_sub(2));
                self.bathroom = Some(said);
            }
            if habit.when == When::Then && before.1.is_none() {
                continue;
            }
            let mut last = None;
            for number in 0..count {
                last = self.add(&in_force, Time { number, of: count, day: self.day }, before.1.as_ref()).or(last);
            }
            before.1 = last;
        }
        self.draw_small_hours();
        self.share_time_out();
    }

    /// Who is out so much less a day is out less on each of the day's outings.
    fn share_time_out(&mut self) {
        let is_outing = |item: &Item| item.activity == Activity::Leave && item.visitor.is_none();
        let outings =
            || self.drafts.list.iter().map(|draft| &draft.item).chain(&self.breaks).filter(|item| is_outing(item));
        let longer = micros(self.parameters.longer_s(&Activity::Leave) / outings().count().max(1) as f64);
        let all = self.drafts.list.iter_mut().map(|draft| &mut draft.item).chain(&mut self.breaks);
        all.filter(|item| is_outing(item)).for_each(|item| item.lasts = (item.lasts + longer).max(SECOND));
    }

    /// What tomorrow's sentences say of the hours before tomorrow's rising.
    fn draw_small_hours(&mut self) {
        let (life, tomorrow) = (self.life, self.day + 1);
        for in_force in life.habits(tomorrow) {
            let InForce { said: habit, source, .. } = in_force;
            let When::At(time) = &habit.when else { continue };
            let is_day = matches!(habit.activity, Activity::GetUp | Activity::GoToBed) && habit.visitor.is_none();
            if is_day || source == Life::UNSAID || life.instant(tomorrow, time.low) >= self.next_up {
                continue;
            }
            let count = self.count(&in_force, tomorrow);
            for number in 0..count {
                self.add(&in_force, Time { number, of: count, day: tomorrow }, None);
            }
        }
    }

    /// How many times the habit is done on a day.
    fn count(&self, in_force: &InForce<Habit>, day: i32) -> u32 {
        let InForce { said: habit, strength, key, .. } = *in_force;
        if !self.life.is_on(&habit.days, day) {
            return 0;
        }
        let key = of_time(key, 0);
        let share = |purpose: &str| self.life.stream_of_day(day, &format!("{key}/{purpose}")).unit();
        let within = match habit.when {
            When::Within(part) => Some(part),
            _ => None,
        };
        let chance = self.life.chance(habit, strength, day);
        let oftener = self.parameters.oftener(&habit.activity, within);
        // Who skips a meal does not prepare it either.
        let skipped = match habit.activity {
            Activity::Prepare(meal) => Activity::Eat(meal),
            ref activity => activity.clone(),
        };
        let skip = self.life.stream_of_day(day, &format!("skip/{}", skipped.label())).unit();
        if let Some(days) = habit.chance.days_a_week
            && !self.is_one_of(habit, &key, days, day)
        {
            return 0;
        }
        let chance =
            if habit.chance.days_a_week.is_some() { (chance / habit.chance.probability).min(1.0) } else { chance };
        if share("whether") >= (chance * oftener.min(1.0)).min(1.0) || skip < self.parameters.skips(&skipped) {
            return 0;
        }
        let (least, most) = habit.times;
        let drawn = f64::from(least) + libm::floor(share("times") * f64::from(most - least + 1));
        // So many times as often: a part of a time is a chance.
        let times = drawn * oftener.max(1.0);
        let whole = libm::floor(times);
        (whole as u32 + u32::from(share("once more") < times - whole)).min(200)
    }

    /// Whether a day is one of so many days that are drawn from each week, of those that the habit is meant for.
    fn is_one_of(&self, habit: &Habit, key: &str, days: u8, today: i32) -> bool {
        let meant = self.life.week_of(today).filter(|&day| self.life.is_on(&habit.days, day));
        let share = |day: i32| self.life.stream_of_day(day, &format!("{key}/of the week")).unit();
        let own = share(today);
        meant.filter(|&day| day != today && share(day) < own).count() < usize::from(days)
    }

    /// How long one time of a habit takes, in seconds, with its random numbers from `key`.
    fn length_s(&self, habit: &Habit, key: &str, day: i32) -> f64 {
        let irregular = self.parameters.irregular;
        let lasts_s = match &habit.lasts {
            Some(lasts) => {
                let share = self.life.stream_of_day(day, &format!("{key}/lasts")).unit();
                varied_length(lasts, share, irregular)
            }
            None => {
                let UsualLength { median_min, sigma } = usual::length(&habit.activity, &self.life.numbers);
                let mut stream = self.life.stream_of_day(day, &format!("{key}/lasts"));
                let wider = sigma * irregular.min(2.0);
                // A wider lognormal of the same mean has a smaller median.
                let median_s = median_min * MINUTE * libm::exp((sigma * sigma - wider * wider) / 2.0);
                stream.lognormal(median_s, wider)
            }
        };
        self.parameters.lasting_s(&habit.activity, lasts_s) * self.life.person.length
    }

    /// Adds one time of a habit; when what is said to come then begins, if it is done.
    fn add(&mut self, in_force: &InForce<Habit>, time: Time, before: Option<&Start>) -> Option<Start> {
        let InForce { said: habit, key, source, .. } = *in_force;
        let key = of_time(key, time.number);
        let own = self.life.stream_of_day(time.day, &format!("{key}/start")).unit();
        // Several times are each in a part of the span of their own.
        let share = (f64::from(time.number) + own) / f64::from(time.of);
        let (activity, parameters) = (habit.activity.clone(), self.parameters);
        let lasts = micros(self.length_s(habit, &key, time.day).clamp(1.0, MOST_DAYS * 24.0 * HOUR));
        let clock_s = if source == Life::UNSAID { self.out_of_step_s() } else { 0.0 } + self.life.person.clock_s;
        let later = micros(parameters.later_s(&activity) + clock_s);
        let at = |time_s: f64| self.life.instant(time.day, time_s);
        let within = |from: Micros, to: Micros| from + ((to - from).max(0) as f64 * share) as Micros;
        let mut patience = 2.5 * HOUR;
        let when = self.when_of(habit, &key, time.day);
        let (start, known) = match &when {
            When::At(time) => {
                patience = 4.0 * HOUR;
                (at(varied(time, share, parameters.irregular)), Start::Known)
            }
            When::Within(PartOfDay::Night) if activity.is_of_the_night() => {
                (within(self.bed + 1800 * SECOND, self.next_up - 1200 * SECOND), Start::Known)
            }
            When::Within(PartOfDay::Night) => {
                let from = self.bed - micros(self.life.numbers.of(&BEDTIME_H) * HOUR);
                (within(from, self.bed - lasts), Start::Known)
            }
            When::Within(part) => {
                let (from, to) = part.hours();
                let to = (to - seconds(lasts)).max(from + 0.2 * (to - from));
                patience = (to - from) + HOUR;
                (at(from + (to - from) * share), Start::Known)
            }
            When::AnyTime if time.of > 1 => self.spread_over_the_day(&activity, time, lasts, own),
            When::AnyTime => match usual::clock(&activity, &self.life.numbers) {
                Some(time) => (at(varied(&time, share, parameters.irregular)), Start::Known),
                None => {
                    patience = 6.0 * HOUR;
                    (self.any_time(habit, share), Start::Known)
                }
            },
            When::After(activity, gap) => {
                (0, Start::After(activity.clone(), micros(gap.map_or(0.0, |gap| gap.at(own)))))
            }
            When::Before(activity, gap) => {
                (0, Start::Before(activity.clone(), micros(gap.map_or(0.0, |gap| gap.at(own)))))
            }
            When::With(activity) => (0, Start::With(activity.clone())),
            When::Then => (0, before?.clone()),
        };
        let (start, known) = match known {
            Start::At(start) => (start, Start::Known),
            known => (start, known),
        };
        let start = start.saturating_add(if matches!(known, Start::Known) { later } else { 0 });
        if matches!(habit.when, When::At(_)) && self.is_before_rising(start, time.day) != (time.day > self.day) {
            return None;
        }
        let until_share = || self.life.stream_of_day(time.day, &format!("{key}/until")).unit();
        let until = habit.until.map(|until| at(varied(&until, until_share(), parameters.irregular)));
        let item = Item {
            activity,
            place: habit.place.clone(),
            falling: habit.falling,
            visitor: habit.visitor.clone(),
            start,
            lasts,
            until: until.map(|until| until.saturating_add(later)),
            latest: start + micros(patience),
            of: Some(in_force.id()),
            is_unsaid: source == Life::UNSAID,
            waits: source == Life::UNSAID,
            has_its_time: source != Life::UNSAID && !matches!(when, When::AnyTime | When::Within(_)),
            is_counted: matches!(when, When::AnyTime) && (time.of > 1 || habit.activity == Activity::UseBathroom),
            follows: None,
            key,
        };
        let in_the_night = start >= self.bed;
        let is_break = item.visitor.is_none() && item.activity.interrupts(in_the_night);
        if matches!(known, Start::Known) && is_break {
            let latest = match (item.activity.can_come_later(), &when) {
                (true, When::AnyTime) => self.bed,
                (true, When::Within(part)) if *part != PartOfDay::Night => at(part.hours().1),
                _ => start,
            };
            self.breaks.push(Item { latest: latest.max(start + 3600 * SECOND), ..item });
            return Some(Start::At(start + lasts));
        }
        self.drafts.list.push(Draft { item, start: known });
        Some(Start::Then(self.drafts.list.len() - 1))
    }

    /// When one time of a habit is: of a fall that mostly comes at some time of the day, there or at another.
    fn when_of(&self, habit: &Habit, key: &str, day: i32) -> When {
        let Some((part, from)) = habit.falling.and_then(|falling| Some((falling.mostly?, falling.from))) else {
            return habit.when.clone();
        };
        let share = self.life.stream_of_day(day, &format!("{key}/mostly")).unit();
        match part {
            _ if share < USUAL_SHARE => When::Within(part),
            PartOfDay::Night => When::AnyTime,
            _ if part == PartOfDay::Day || from == FallsFrom::Bed => When::Within(PartOfDay::Night),
            _ => When::AnyTime,
        }
    }

    /// From an hour after rising until an hour before bed, but not when a fall mostly is, where that is said.
    fn any_time(&self, habit: &Habit, share: f64) -> Micros {
        let (from, to) = (self.up + 3600 * SECOND, self.bed - 3600 * SECOND);
        let to = to.max(from);
        let mostly = habit.falling.and_then(|falling| falling.mostly).map(PartOfDay::hours);
        let (begin, end) = mostly.map_or((from, from), |(begin_s, end_s)| {
            let within = |time_s: f64| self.life.instant(self.day, time_s).clamp(from, to);
            (within(begin_s), within(end_s))
        });
        let at = from + ((to - from - (end - begin)) as f64 * share) as Micros;
        if at < begin { at } else { at + (end - begin) }
    }

    /// How much later than usual all goes that nobody says of somebody whose day begins late, in seconds; earlier where
    /// negative.
    fn out_of_step_s(&self) -> f64 {
        /// Earliest and latest hour of getting up of a person who keeps the hours of others (our choice).
        const IN_STEP_H: (f64, f64) = (4.5, 10.0);
        let up_s = seconds(self.up - self.life.instant(self.day, 0.0));
        up_s - up_s.clamp(IN_STEP_H.0 * HOUR, IN_STEP_H.1 * HOUR)
    }

    /// Whether an instant is in the night before a day's rising, or before the bedtime of a day that goes on so long.
    fn is_before_rising(&self, start: Micros, day: i32) -> bool {
        let is_next = day > self.day;
        let rising = if is_next { self.next_up } else { self.up };
        if start >= rising - micros(self.life.numbers.of(&NEARLY_UP_S)) {
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

    /// One of several times a day: medicine with the meals, all else from soon after getting up until shortly before bed.
    fn spread_over_the_day(&self, activity: &Activity, time: Time, lasts: Micros, own: f64) -> (Micros, Start) {
        if *activity == Activity::TakeMedicine && time.of <= 4 {
            let meals: &[Meal] = if time.of == 2 { &[Meal::Breakfast, Meal::Dinner] } else { &Meal::ALL };
            return match meals.get(time.number as usize) {
                Some(meal) => (0, Start::With(Activity::Eat(*meal))),
                None => (0, Start::Before(Activity::GoToBed, 1200 * SECOND)),
            };
        }
        let (from, to) = (self.up + 2700 * SECOND, self.bed - 3600 * SECOND - lasts);
        let place = f64::from(time.number) / f64::from(time.of - 1) + (own - 0.5) * 0.3 / f64::from(time.of);
        let span = (to - from).max(0) as f64;
        (from + (span * place.clamp(0.0, 1.0)) as Micros, Start::Known)
    }
}

impl Activity {
    /// Whether it is done in the night, out of bed or in it, if it is said to be done at night; all else is done before bed.
    pub(crate) fn is_of_the_night(&self) -> bool {
        use Activity::{Drink, Fall, Lap, Leave, LieAwake, Pace, Snack, Stumble, UseBathroom, Wander};
        matches!(self, UseBathroom | LieAwake | Fall | Stumble | Wander | Pace | Lap | Drink | Snack | Leave)
    }

    /// Whether it is made up for who was out, or asleep, as it should have been done: not what one does elsewhere, too.
    fn can_come_later(&self) -> bool {
        matches!(self, Activity::Wander | Activity::Pace | Activity::Lap | Activity::Fall | Activity::Stumble)
    }

    /// Whether it interrupts what goes on rather than waiting for its turn.
    fn interrupts(&self, at_night: bool) -> bool {
        match self {
            Activity::Wander | Activity::Pace | Activity::Lap | Activity::LieAwake | Activity::UseBathroom => true,
            Activity::Fall | Activity::Stumble => true,
            _ => at_night,
        }
    }
}
