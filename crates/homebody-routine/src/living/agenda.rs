//! The plan of a day: what is to be done, in which order, from getting up to going to bed and through the night after.
//!
//! Each habit that is meant for the day is drawn: whether, how often, when, for how long. What is said relative to
//! something else is put beside it. The order is that of the starts; how the day really goes is for the living.

use super::life::{DayParameters, InForce, Life};
use super::usual;
use crate::fuzzy::Fuzzy;
use crate::routine::{Activity, Habit, Meal, PartOfDay, When};
use homebody_core::activity::UsualLength;
use homebody_core::numbers::Numbers;
use homebody_core::time::{Micros, SECOND, micros, seconds};

/// A day's plan.
#[derive(Clone, Debug)]
pub struct Agenda {
    pub day: i32,
    /// When the resident gets up, and goes to bed.
    pub up: Micros,
    pub bed: Micros,
    /// What is done one after the other, in order of start.
    pub items: Vec<Item>,
    /// What interrupts whatever goes on then, in order of start; also in the night after the day.
    pub breaks: Vec<Item>,
}

/// One thing to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Tells its random numbers from those of all others of the day.
    pub key: String,
    pub activity: Activity,
    pub place: Option<String>,
    pub visitor: Option<String>,
    pub start: Micros,
    pub lasts: Micros,
    /// It ends then, however late it begins.
    pub until: Option<Micros>,
    /// It is left out if it cannot begin by then.
    pub latest: Micros,
}

impl Item {
    /// Something that nobody planned, to be done at once.
    pub fn now(key: String, activity: Activity, lasts: Micros) -> Item {
        Item { key, activity, place: None, visitor: None, start: 0, lasts, until: None, latest: Micros::MAX }
    }
}

/// An item whose start may hang on another's.
struct Draft {
    item: Item,
    start: Start,
}

#[derive(Clone, Debug)]
enum Start {
    Known,
    At(Micros),
    After(Activity, Micros),
    Before(Activity, Micros),
    With(Activity),
    /// The end of the draft of this index.
    Then(usize),
}

const MINUTE: f64 = 60.0;
const HOUR: f64 = 3600.0;

homebody_core::numbers! {
    /// How long after getting up the morning's washing and dressing is over.
    static SOON_S = "day.soon": 3_600.0, "s", [0.0, 14_400.0];
    /// Outings shorter than this are left out.
    static LEAST_OUT_S = "day.least_out": 600.0, "s", [0.0, 7_200.0];
    /// When one gets up on a day of which no sentence says so: 06:44 of healthy older adults (Scientific
    /// Reports 2015, actigraphy).
    static UP_H = "day.up": 6.73, "h", [2.0, 14.0];
    /// How much earlier or later than that one gets up at most.
    static UP_SPREAD_H = "day.up_spread": 0.5, "h", [0.0, 4.0];
    /// When one goes to bed on a day of which no sentence says so: 23:23 of healthy older adults
    /// (Scientific Reports 2015, actigraphy).
    static BED_H = "day.bed": 23.38, "h", [17.0, 28.0];
    /// How much earlier than that one goes to bed at most.
    static BED_EARLIER_H = "day.bed_earlier": 0.48, "h", [0.0, 4.0];
    /// How much later than that one goes to bed at most.
    static BED_LATER_H = "day.bed_later": 0.52, "h", [0.0, 4.0];
}

/// Getting up where nothing is said or the quantifier says no.
fn usual_up(numbers: &Numbers) -> Fuzzy {
    Fuzzy::around(numbers.of(&UP_H) * HOUR, numbers.of(&UP_SPREAD_H) * HOUR)
}

/// Going to bed where nothing is said or the quantifier says no.
fn usual_bed(numbers: &Numbers) -> Fuzzy {
    let [at, earlier, later] = [&BED_H, &BED_EARLIER_H, &BED_LATER_H].map(|number| numbers.of(number) * HOUR);
    Fuzzy { low: at - earlier, from: at, to: at, high: at + later }
}

impl Agenda {
    /// The plan of a day of a life, as it is with the day's mood.
    pub fn of(life: &Life, day: i32, parameters: &DayParameters) -> Agenda {
        let (up, bed) = (up(life, day, parameters), bed(life, day, parameters));
        // As it would be if tomorrow were as today: a change that begins tomorrow does not touch tonight.
        let next_up = self::up(life, day + 1, parameters);
        let mut planner = Planner {
            life,
            parameters,
            day,
            up,
            bed,
            next_up,
            drafts: Vec::new(),
            breaks: Vec::new(),
            mornings: Vec::new(),
        };
        planner.draw();
        let mut items = planner.resolve();
        items.sort_by_key(|item| item.start);
        let ready = planner.ready(&items);
        // Who gets up late begins the day later, and not with what is overdue.
        for item in items.iter_mut().filter(|item| item.start < ready && !planner.mornings.contains(&item.key)) {
            item.latest += ready - item.start;
            item.start = ready;
        }
        items.sort_by_key(|item| item.start);
        let mut breaks = planner.breaks;
        breaks.sort_by_key(|item| item.start);
        Agenda { day, up, bed, items, breaks }
    }
}

/// When the resident gets up on a day.
pub fn up(life: &Life, day: i32, parameters: &DayParameters) -> Micros {
    let time = clock_of(life, day, parameters, &Activity::GetUp).unwrap_or_else(|| {
        varied(&usual_up(&life.numbers), life.stream_of_day(day, "up").unit(), parameters.irregular)
            + parameters.later_s(&Activity::GetUp)
    }) + life.person.up_s;
    life.instant(day, time.clamp(2.0 * HOUR, 14.0 * HOUR))
}

/// When the resident goes to bed at the end of a day.
fn bed(life: &Life, day: i32, parameters: &DayParameters) -> Micros {
    let time = clock_of(life, day, parameters, &Activity::GoToBed).unwrap_or_else(|| {
        varied(&usual_bed(&life.numbers), life.stream_of_day(day, "bed").unit(), parameters.irregular)
            + parameters.later_s(&Activity::GoToBed)
    }) + life.person.bed_s;
    // Half past midnight is the end of the day before.
    let time = if time < 12.0 * HOUR { time + 24.0 * HOUR } else { time };
    life.instant(day, time.clamp(17.0 * HOUR, 28.0 * HOUR))
}

/// The time of day that the habits say for getting up or going to bed, if one of them holds on this day.
fn clock_of(life: &Life, day: i32, parameters: &DayParameters, activity: &Activity) -> Option<f64> {
    life.habits(day).find_map(|InForce { said: habit, strength, key, .. }| {
        if habit.activity != *activity || habit.visitor.is_some() || !life.is_on(&habit.days, day) {
            return None;
        }
        let When::At(time) = &habit.when else { return None };
        let key = of_time(key, 0);
        let holds = life.stream_of_day(day, &format!("{key}/whether")).unit() < life.chance(habit, strength, day);
        let share = life.stream_of_day(day, &format!("{key}/start")).unit();
        holds.then(|| varied(time, share, parameters.irregular) + parameters.later_s(activity))
    })
}

/// What tells apart the several times a day that a habit is done.
fn of_time(key: &str, number: u32) -> String {
    format!("{key}/{number}")
}

/// A number of a fuzzy number, so many times as far from its mean as it would be.
fn varied(fuzzy: &Fuzzy, share: f64, irregular: f64) -> f64 {
    let mean = fuzzy.mean();
    mean + (fuzzy.at(share) - mean) * irregular
}

struct Planner<'a> {
    life: &'a Life,
    parameters: &'a DayParameters,
    day: i32,
    up: Micros,
    bed: Micros,
    next_up: Micros,
    drafts: Vec<Draft>,
    breaks: Vec<Item>,
    /// What is done after getting up, by key: washing, dressing.
    mornings: Vec<String>,
}

impl Planner<'_> {
    /// Draws every habit of the day.
    fn draw(&mut self) {
        let life = self.life;
        // The text of the last habit, and when that is done if it is done today.
        let mut before: (usize, Option<Start>) = (0, None);
        for InForce { said: habit, strength, key, source } in life.habits(self.day) {
            if before.0 != source {
                before = (source, None);
            }
            if matches!(habit.activity, Activity::GetUp | Activity::GoToBed) && habit.visitor.is_none() {
                before.1 = Some(Start::After(habit.activity.clone(), 0));
                continue;
            }
            let count = self.count(habit, strength, key);
            if habit.when == When::Then && before.1.is_none() {
                continue;
            }
            let mut last = None;
            for number in 0..count {
                last = self.add(habit, key, number, before.1.as_ref()).or(last);
            }
            before.1 = last;
        }
    }

    /// How many times the habit is done today.
    fn count(&self, habit: &Habit, strength: f64, key: &str) -> u32 {
        if !self.life.is_on(&habit.days, self.day) {
            return 0;
        }
        let key = of_time(key, 0);
        let share = |purpose: &str| self.life.stream_of_day(self.day, &format!("{key}/{purpose}")).unit();
        let within = match habit.when {
            When::Within(part) => Some(part),
            _ => None,
        };
        let chance = self.life.chance(habit, strength, self.day);
        let oftener = self.parameters.oftener(&habit.activity, within);
        // Who skips a meal does not prepare it either.
        let skipped = match habit.activity {
            Activity::Prepare(meal) => Activity::Eat(meal),
            ref activity => activity.clone(),
        };
        let skip = self.life.stream_of_day(self.day, &format!("skip/{}", skipped.label())).unit();
        if let Some(days) = habit.chance.days_a_week
            && !self.is_one_of(habit, &key, days)
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

    /// Whether today is one of so many days that are drawn from each week, of those that the habit is meant for.
    fn is_one_of(&self, habit: &Habit, key: &str, days: u8) -> bool {
        let monday = self.day - i32::from(self.life.calendar.weekday(self.day));
        let meant = (monday..monday + 7).filter(|&day| self.life.is_on(&habit.days, day));
        let share = |day: i32| self.life.stream_of_day(day, &format!("{key}/of the week")).unit();
        let today = share(self.day);
        meant.filter(|&day| day != self.day && share(day) < today).count() < usize::from(days)
    }

    /// Adds one time of a habit; when what is said to come then begins, if it is done.
    fn add(&mut self, habit: &Habit, key: &str, number: u32, before: Option<&Start>) -> Option<Start> {
        let key = of_time(key, number);
        let share = |purpose: &str| self.life.stream_of_day(self.day, &format!("{key}/{purpose}")).unit();
        let (activity, parameters) = (habit.activity.clone(), self.parameters);
        let lasts_s = match &habit.lasts {
            Some(lasts) => varied(lasts, share("lasts"), parameters.irregular),
            None => {
                let UsualLength { median_min, sigma } = usual::length(&activity, &self.life.numbers);
                let mut stream = self.life.stream_of_day(self.day, &format!("{key}/lasts"));
                stream.lognormal(median_min * MINUTE, sigma * parameters.irregular.min(2.0))
            }
        };
        let lasts =
            micros((parameters.lasting_s(&activity, lasts_s) * self.life.person.length).clamp(1.0, 20.0 * HOUR));
        let later = micros(parameters.later_s(&activity) + self.life.person.clock_s);
        let at = |time: f64| self.life.instant(self.day, time);
        let mut patience = 2.5 * HOUR;
        let (start, known) = match &habit.when {
            When::At(time) => {
                patience = 4.0 * HOUR;
                (at(varied(time, share("start"), parameters.irregular)), Start::Known)
            }
            When::Within(PartOfDay::Night) => {
                let (from, to) = (self.bed + 1800 * SECOND, self.next_up - 1200 * SECOND);
                (from + ((to - from).max(0) as f64 * share("start")) as Micros, Start::Known)
            }
            When::Within(part) => {
                let (from, to) = part.hours();
                let to = (to - seconds(lasts)).max(from + 0.2 * (to - from));
                patience = (to - from) + HOUR;
                (at(from + (to - from) * share("start")), Start::Known)
            }
            When::AnyTime => match usual::clock(&activity, &self.life.numbers) {
                Some(time) => (at(varied(&time, share("start"), parameters.irregular)), Start::Known),
                None => {
                    patience = 6.0 * HOUR;
                    let (from, to) = (self.up + 3600 * SECOND, self.bed - 3600 * SECOND);
                    (from + ((to - from).max(0) as f64 * share("start")) as Micros, Start::Known)
                }
            },
            When::After(activity, gap) => {
                (0, Start::After(activity.clone(), micros(gap.map_or(0.0, |gap| gap.at(share("start"))))))
            }
            When::Before(activity, gap) => {
                (0, Start::Before(activity.clone(), micros(gap.map_or(0.0, |gap| gap.at(share("start"))))))
            }
            When::With(activity) => (0, Start::With(activity.clone())),
            When::Then => (0, before?.clone()),
        };
        let (start, known) = match known {
            Start::At(start) => (start, Start::Known),
            known => (start, known),
        };
        let until =
            habit.until.map(|until| at(varied(&until, share("until"), parameters.irregular)).saturating_add(later));
        // Nobody goes out for a moment.
        if activity == Activity::Leave && until.is_none() && lasts < micros(self.life.numbers.of(&LEAST_OUT_S)) {
            return None;
        }
        let start = start.saturating_add(if matches!(known, Start::Known) { later } else { 0 });
        let item = Item {
            key,
            activity,
            place: habit.place.clone(),
            visitor: habit.visitor.clone(),
            start,
            lasts,
            until,
            latest: start + micros(patience),
        };
        let in_the_night = habit.when == When::Within(PartOfDay::Night) || start >= self.bed;
        let is_break = item.visitor.is_none() && item.activity.interrupts(in_the_night);
        if matches!(known, Start::Known) && is_break {
            self.breaks.push(Item { latest: start + 3600 * SECOND, ..item });
            return Some(Start::At(start + lasts));
        }
        self.drafts.push(Draft { item, start: known });
        Some(Start::Then(self.drafts.len() - 1))
    }

    /// Puts what hangs on something beside it.
    fn resolve(&mut self) -> Vec<Item> {
        let mut known: Vec<bool> = self.drafts.iter().map(|draft| matches!(draft.start, Start::Known)).collect();
        // Each pass settles at least one, or none is left that can be.
        for last in (0..=self.drafts.len()).rev() {
            for index in 0..self.drafts.len() {
                if !known[index]
                    && let Some(start) = self.start_of(index, &known, last == 0)
                {
                    let item = &mut self.drafts[index].item;
                    (item.start, item.latest) = (start, start + micros(4.0 * HOUR));
                    known[index] = true;
                }
            }
            if known.iter().all(|&known| known) {
                break;
            }
        }
        self.come_home();
        let mornings = self.drafts.iter().filter(|draft| matches!(draft.start, Start::After(Activity::GetUp, _)));
        self.mornings = mornings.map(|draft| draft.item.key.clone()).collect();
        let is_done = |activity: &Activity| self.drafts.iter().any(|draft| draft.item.activity == *activity);
        // There is nothing to wash up after a meal that was skipped.
        let is_idle = |draft: &Draft| match &draft.start {
            Start::After(meal, _) => draft.item.activity == Activity::WashUp && !is_done(meal),
            _ => false,
        };
        self.drafts.iter().filter(|draft| !is_idle(draft)).map(|draft| draft.item.clone()).collect()
    }

    /// When what is done after getting up is done, as far as it is done soon.
    fn ready(&self, items: &[Item]) -> Micros {
        let soon_is_over = self.up + micros(self.life.numbers.of(&SOON_S));
        let soon = items.iter().filter(|item| {
            self.mornings.contains(&item.key) && item.start < soon_is_over && item.activity != Activity::ComeHome
        });
        soon.map(|item| item.start + item.lasts).fold(self.up, Micros::max)
    }

    /// Coming home at a time ends the outing before it.
    fn come_home(&mut self) {
        let homes = self.drafts.iter().filter(|draft| draft.item.activity == Activity::ComeHome);
        let homes: Vec<Micros> = homes.map(|draft| draft.item.start).collect();
        for home in homes {
            let outings = self.drafts.iter_mut().map(|draft| &mut draft.item);
            let outings = outings.filter(|item| item.activity == Activity::Leave && item.start < home);
            if let Some(outing) = outings.max_by_key(|item| item.start) {
                outing.until = Some(home);
            }
        }
        // It is in the outing.
        self.drafts.iter_mut().filter(|draft| draft.item.activity == Activity::ComeHome).for_each(|draft| {
            draft.item.latest = Micros::MIN;
        });
    }

    /// The start of a draft whose reference is known; `at_last` it is guessed where the reference is never.
    fn start_of(&self, index: usize, known: &[bool], at_last: bool) -> Option<Micros> {
        let Draft { item, start } = &self.drafts[index];
        let span = |activity: &Activity| self.span_of(activity, known, at_last);
        match start {
            Start::Known => Some(item.start),
            Start::At(start) => Some(*start),
            Start::After(activity, gap) => Some(span(activity)?.1 + gap),
            Start::Before(activity, gap) => Some(span(activity)?.0 - gap - item.lasts),
            // One microsecond before, so that it comes first.
            Start::With(activity) => Some(span(activity)?.0 - 1),
            Start::Then(of) => {
                let of_item = &self.drafts[*of].item;
                known[*of].then_some(of_item.start + of_item.lasts)
            }
        }
    }

    /// From when to when something is done today; where it is not done, when it usually would be.
    fn span_of(&self, activity: &Activity, known: &[bool], at_last: bool) -> Option<(Micros, Micros)> {
        match activity {
            Activity::GetUp => return Some((self.up, self.up + 60 * SECOND)),
            Activity::GoToBed => return Some((self.bed, self.bed + 60 * SECOND)),
            Activity::ComeHome => return Some((0, self.span_of(&Activity::Leave, known, at_last)?.1)),
            _ => {}
        }
        let mut of = self.drafts.iter().zip(known).filter(|(draft, _)| draft.item.activity == *activity);
        match of.next() {
            Some((draft, true)) => Some((draft.item.start, draft.item.start + draft.item.lasts)),
            Some((_, false)) if !at_last => None,
            _ => {
                let usual = usual::clock(activity, &self.life.numbers).map_or(12.0 * HOUR, |clock| clock.mean());
                let start = self.life.instant(self.day, usual);
                Some((start, start + micros(usual::length(activity, &self.life.numbers).median_min * MINUTE)))
            }
        }
    }
}

impl Activity {
    /// When it is usually done, where nothing is said. Meals: ours, as no norms were found.
    pub(crate) fn usual_clock(&self) -> Option<Fuzzy> {
        let around = |hours: f64, minutes: f64| Some(Fuzzy::around(hours * HOUR, minutes * MINUTE));
        match self {
            Activity::Prepare(Meal::Breakfast) | Activity::TakeMedicine => around(7.75, 30.0),
            Activity::Eat(Meal::Breakfast) => around(8.0, 30.0),
            Activity::Prepare(Meal::Lunch) => around(11.8, 30.0),
            Activity::Eat(Meal::Lunch) => around(12.25, 30.0),
            Activity::Prepare(Meal::Dinner) => around(17.25, 40.0),
            Activity::Eat(Meal::Dinner) => around(17.75, 40.0),
            Activity::Shower | Activity::Wash | Activity::Dress => around(7.25, 40.0),
            Activity::Nap => around(14.75, 45.0),
            Activity::Visit => around(15.0, 90.0),
            _ => None,
        }
    }

    /// Whether it interrupts what goes on rather than waiting for its turn.
    fn interrupts(&self, at_night: bool) -> bool {
        match self {
            Activity::Wander | Activity::Pace | Activity::Lap | Activity::Fall | Activity::LieAwake => true,
            Activity::UseBathroom => true,
            _ => at_night,
        }
    }
}
