//! Random statements: each canonical sentence is read back as the statement that it was printed from.

use crate::home::home;
use homebody_core::fuzzy::Fuzzy;
use homebody_core::random::Stream;
use homebody_routine::language::activities::phrase;
use homebody_routine::language::routine;
use homebody_routine::routine::{
    Activity, DayEpisode, DayKind, DaySelection, Effect, Habit, HabitChance, HabitTime, Meal, PartOfDay, Phase,
    PhaseDay, Quote, Routine, RoutineChange, Weather, When,
};
use homebody_routine::statement::{statements, text};
use std::fmt::Debug;

/// Statements of each kind in an ordinary run.
const FEW: u32 = 1_000;
/// Statements of each kind in the long run.
const MANY: u32 = 50_000;

/// Sentences to which the times of others refer.
const OTHERS: &str =
    "She gets up at 06:45. She eats lunch. She eats dinner. She takes a shower. She watches television.\n";
const OTHER: [Activity; 4] =
    [Activity::Eat(Meal::Lunch), Activity::Eat(Meal::Dinner), Activity::Shower, Activity::WatchTelevision];

struct Draw(Stream);

impl Draw {
    fn one<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.0.below(of.len() as u32) as usize].clone()
    }

    fn number(&mut self, least: u32, most: u32) -> f64 {
        f64::from(least + self.0.below(most - least + 1))
    }

    /// In one of `of` draws.
    fn is_rare(&mut self, of: u32) -> bool {
        self.0.below(of) == 0
    }

    fn phase(&mut self) -> Phase {
        let from = self.is_rare(3).then(|| self.number(1, 60) as i32);
        let until = self.is_rare(4).then(|| from.unwrap_or(0) + self.number(5, 60) as i32);
        Phase { from: from.map(PhaseDay::Day), until: until.map(PhaseDay::Day), ..Phase::default() }
    }

    fn days(&mut self) -> DaySelection {
        let mut days = DaySelection::ALL;
        match self.0.below(10) {
            0 | 1 => days.weekdays = self.number(1, 126) as u8,
            2 => days.months = self.number(1, 4094) as u16,
            3 => days.every = self.number(2, 20) as u32,
            4 => days.kind = Some(self.one(&[DayKind::Quiet, DayKind::Busy])),
            5 => {
                let day = self.number(1, 28) as u8;
                days.of_month = (day, day);
            }
            6 => days.weather = Some(self.one(&[Weather::Dry, Weather::Rainy, Weather::Hot, Weather::Frosty])),
            7 => {
                let (every_days, lasts_days) = (self.number(20, 90) as u32, self.number(1, 10) as u32);
                days.episode = Some(DayEpisode { every_days, lasts_days });
            }
            _ => {}
        }
        days
    }

    fn chance(&mut self) -> HabitChance {
        let mut chance = HabitChance { quantifier: None, probability: 1.0, becomes: None, days_a_week: None };
        match self.0.below(4) {
            0 => chance.probability = self.number(1, 99) / 100.0,
            1 => {
                chance.probability = self.number(1, 99) / 100.0;
                chance.becomes = Some((self.number(1, 99) / 100.0, PhaseDay::Day(self.number(70, 90) as i32)));
            }
            _ => chance = HabitChance::ALWAYS,
        }
        chance
    }

    fn clock(&mut self) -> Fuzzy {
        let at = self.number(28, 86) * 900.0;
        let spread = self.one(&[300.0, 1200.0, 600.0]);
        Fuzzy { low: at - spread, from: at, to: at, high: at + spread }
    }

    fn length(&mut self) -> Fuzzy {
        let from = self.number(2, 40) * 300.0;
        match self.0.below(4) {
            0 => Fuzzy { low: from * 0.75, from, to: from, high: from * 1.25 },
            1 => Fuzzy { low: from, from, to: from + 900.0, high: from + 900.0 },
            2 => Fuzzy { low: from - 120.0, from, to: from, high: from + 120.0 },
            _ => Fuzzy { low: from * 0.9, from, to: from, high: from * 1.1 },
        }
    }

    fn time(&mut self) -> HabitTime {
        let gap = |draw: &mut Draw| draw.is_rare(2).then(|| Fuzzy::exactly(draw.number(1, 12) * 300.0));
        match self.0.below(7) {
            0 | 1 => HabitTime::At(self.clock()),
            2 => HabitTime::Within(self.one(&[PartOfDay::Morning, PartOfDay::Afternoon, PartOfDay::Evening])),
            3 => HabitTime::After(self.one(&OTHER), gap(self)),
            4 => HabitTime::Before(self.one(&OTHER), gap(self)),
            _ => HabitTime::AnyTime,
        }
    }

    fn when(&mut self) -> When {
        let time = self.time();
        let times = match (&time, self.0.below(4)) {
            (HabitTime::AnyTime | HabitTime::Within(_), 0) => (2, 2),
            (HabitTime::AnyTime | HabitTime::Within(_), 1) => (2, 4),
            _ => (1, 1),
        };
        When {
            phase: self.phase(),
            days: self.days(),
            chance: self.chance(),
            lasts: self.is_rare(2).then(|| self.length()),
            is_total: times != (1, 1) && self.is_rare(3),
            time,
            times,
            ..When::default()
        }
    }

    fn habit(&mut self, activities: &[Activity]) -> Habit {
        let is_visit = self.is_rare(5);
        let mut habit = Habit {
            said: Quote::default(),
            visitor: is_visit.then(|| self.one(&["daughter", "nurse", "district nurse"]).to_owned()),
            activity: if is_visit { Activity::Visit } else { self.one(activities) },
            place: None,
            when: self.when(),
            eats_out: false,
            thing_on: (!is_visit && self.is_rare(4)).then(|| self.one(&["television", "lamp"]).to_owned()),
            key: is_visit && self.is_rare(4),
            does: Vec::new(),
            falling: None,
        };
        if habit.when.days.episode.is_some() {
            (habit.when.chance, habit.when.phase) = (HabitChance::ALWAYS, Phase::default());
        }
        if self.is_rare(10) {
            habit.when.days.poor_nights = self.number(1, 3) as u32;
        }
        if is_visit {
            (habit.when.times, habit.when.is_total, habit.when.days.episode) = ((1, 1), false, None);
            if self.is_rare(3) {
                habit.does = vec![Activity::Housework];
            }
            if habit.when.days != DaySelection::ALL && self.is_rare(4) {
                habit.when.nights = self.number(1, 5) as u32;
                habit.when.lasts = None;
            }
        }
        habit
    }

    fn change(&mut self, activities: &[Activity]) -> RoutineChange {
        let activity = self.one(activities);
        let factor = Fuzzy::exactly(self.number(2, 19) / 10.0);
        let by = Fuzzy::exactly(self.number(1, 24) * 300.0 * self.one(&[1.0, -1.0]));
        let mut when = When { phase: self.phase(), ..When::default() };
        if self.is_rare(4) {
            when.days = self.days();
        }
        if when.days.episode.is_some() {
            when.phase = Phase::default();
        }
        let thing = self.one(&["stove", "television", "lamp"]).to_owned();
        let effect = match self.0.below(12) {
            0 => Effect::Later { activity, by },
            1 => Effect::LongerBy { activity, by },
            2 => Effect::Longer { activity, factor },
            3 => Effect::Oftener { activity, factor },
            4 => Effect::Pace(factor),
            5 => Effect::Irregular(factor),
            6 => Effect::Active { factor },
            7 => Effect::Restless(factor),
            8 => Effect::Spares { thing },
            10 => Effect::Range { place: self.one(&["kitchen", "upper floor"]).to_owned(), inside: self.is_rare(2) },
            9 => {
                (when.time, when.until) = (HabitTime::Within(PartOfDay::Night), None);
                if self.is_rare(2) {
                    let until = self.clock().map(|at| at + 3600.0);
                    (when.time, when.until) = (HabitTime::At(until.map(|at| at - 3600.0)), Some(until));
                }
                Effect::KeepsOn { thing }
            }
            _ => Effect::DaysDiffer(factor),
        };
        RoutineChange { said: Quote::default(), when, effect }
    }
}

/// Activities that may stand at any time, by their usual phrase.
fn ordinary() -> Vec<Activity> {
    use Activity as A;
    let special = [A::GetUp, A::GoToBed, A::ComeHome, A::Leave, A::Visit, A::Fall, A::Stumble];
    let all = Activity::all_of_table().filter(|activity| !special.contains(activity));
    all.filter(|activity| !matches!(activity, A::Eat(_) | A::Prepare(_)) && !phrase(activity).is_empty()).collect()
}

/// Reads a canonical sentence after the others.
fn read_back(sentence: &str) -> Result<Routine, String> {
    let (read, problems) = routine("margaret.routine", &format!("{OTHERS}{sentence}"), &home());
    match &problems[..] {
        [] => Ok(read),
        problems => Err(problems.iter().map(|problem| format!("{problem}; ")).collect()),
    }
}

fn lost<T: PartialEq + Debug>(lost: &mut Vec<String>, routine: Routine, last: fn(&Routine) -> Option<T>) {
    let sentence = text(statements(&routine).iter().map(|(_, statement)| statement));
    match read_back(&sentence) {
        Err(problems) => lost.push(format!("{sentence}  {problems}")),
        Ok(read) if last(&read) != last(&routine) => {
            lost.push(format!("{sentence}  {:?}\n  {:?}", last(&routine), last(&read)));
        }
        Ok(_) => {}
    }
}

fn keeps_meaning(count: u32) {
    let (activities, mut draw, mut all) = (ordinary(), Draw(Stream::named(11, "random statements")), Vec::new());
    for _ in 0..count {
        let routine = Routine { habits: vec![draw.habit(&activities)], ..Routine::default() };
        lost(&mut all, routine, |read| read.habits.last().map(|last| Habit { said: Quote::default(), ..last.clone() }));
        let routine = Routine { changes: vec![draw.change(&activities)], ..Routine::default() };
        lost(&mut all, routine, |read| {
            read.changes.last().map(|last| RoutineChange { said: Quote::default(), ..last.clone() })
        });
    }
    let found = all.len();
    all.truncate(30);
    assert_eq!(found, 0, "of {}:\n{}", 2 * count, all.join("\n"));
}

#[test]
fn canonical_sentences_of_random_statements_keep_their_meaning() {
    keeps_meaning(FEW);
}

#[test]
#[ignore = "takes minutes"]
fn canonical_sentences_of_a_hundred_thousand_statements_keep_their_meaning() {
    keeps_meaning(MANY);
}
