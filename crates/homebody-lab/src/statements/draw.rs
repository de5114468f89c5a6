//! Draws lives: a home, a routine, and one to three statements.

use super::change::DrawnChange;
use super::habit::DrawnHabit;
use super::homes::{DrawnBase, DrawnHome, HOMES, STARTS};
use super::rule::DrawnRule;
use homebody_core::calendar::Calendar;
use homebody_core::random::Stream;
use std::ops::RangeInclusive;

/// A stream of drawn numbers.
pub struct Draw(Stream);

impl Draw {
    pub fn below(&mut self, count: u32) -> u32 {
        self.0.below(count)
    }

    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        self.0.between(least, most)
    }

    pub fn one_in(&mut self, count: u32) -> bool {
        self.0.below(count) == 0
    }
}

#[derive(Clone, Debug, PartialEq)]
pub enum DrawnStatement {
    Habit(DrawnHabit),
    Change(DrawnChange),
    Rule(DrawnRule),
}

#[derive(Clone, Debug)]
pub struct DrawnLife {
    /// The index of the first statement.
    pub first: usize,
    pub seed: u64,
    pub days: i32,
    pub home: usize,
    pub start: usize,
    pub base: DrawnBase,
    pub statements: Vec<DrawnStatement>,
}

/// Largest number of tries to draw a statement about something else than the others (our choice).
const MOST_TRIES: usize = 20;

/// Largest number of statements of a life (our choice).
const MOST_STATEMENTS: u32 = 3;

impl DrawnStatement {
    fn draw(draw: &mut Draw, life: &DrawnLife) -> DrawnStatement {
        match draw.below(10) {
            0..=5 => DrawnStatement::Habit(DrawnHabit::draw_one(draw, life, life.home())),
            6 | 7 => DrawnStatement::Change(DrawnChange::draw(draw, life)),
            _ => DrawnStatement::Rule(DrawnRule::draw(draw, life)),
        }
    }

    pub fn kind(&self) -> String {
        match self {
            DrawnStatement::Habit(habit) => habit.kind.to_owned(),
            DrawnStatement::Change(change) => format!("change of {}", change.kind),
            DrawnStatement::Rule(rule) => format!("rule on {}", rule.kind),
        }
    }

    /// The sentence itself.
    pub fn words(&self, home: &DrawnHome) -> String {
        match self {
            DrawnStatement::Habit(habit) => habit.words(home),
            DrawnStatement::Change(change) => change.words(home),
            DrawnStatement::Rule(rule) => rule.words(home),
        }
    }

    /// Sentences that it needs, such as the habit that it changes.
    pub fn carriers(&self, home: &DrawnHome) -> Vec<String> {
        let (DrawnStatement::Change(DrawnChange { carriers, .. }) | DrawnStatement::Rule(DrawnRule { carriers, .. })) =
            self
        else {
            return Vec::new();
        };
        carriers.iter().map(|carrier| home.of_person(carrier)).collect()
    }

    /// Labels of the activities that it and its carriers are about.
    pub fn about(&self) -> Vec<&'static str> {
        match self {
            DrawnStatement::Habit(habit) => vec![habit.visitor.unwrap_or(habit.deed.label)],
            DrawnStatement::Change(change) => change.about.to_vec(),
            DrawnStatement::Rule(rule) => rule.about.to_vec(),
        }
    }

    /// Labels whose usual sentences it replaces.
    pub fn replaces(&self) -> Vec<&'static str> {
        match self {
            // The rest of the week keeps its time.
            DrawnStatement::Habit(habit) => vec![habit.deed.label],
            DrawnStatement::Change(change) => change.about.to_vec(),
            DrawnStatement::Rule(_) => Vec::new(),
        }
    }

    pub fn has_twin(&self) -> bool {
        matches!(self, DrawnStatement::Change(change) if change.has_twin())
    }
}

impl DrawnLife {
    /// Draws a life, whose statements are counted from `first`.
    fn draw(draw: &mut Draw, first: usize, seed: u64, days: &RangeInclusive<i32>) -> DrawnLife {
        let days = days.start() + draw.below((days.end() - days.start() + 1).max(1) as u32) as i32;
        let home = draw.below(HOMES.len() as u32) as usize;
        let start = draw.below(STARTS.len() as u32) as usize;
        let base = DrawnBase::draw(draw, &HOMES[home], days);
        let mut life = DrawnLife { first, seed, days, home, start, base, statements: Vec::new() };
        let count = 1 + draw.below(MOST_STATEMENTS);
        for _ in 0..MOST_TRIES {
            let statement = DrawnStatement::draw(draw, &life);
            let about = statement.about();
            let others: Vec<&str> = life.statements.iter().flat_map(DrawnStatement::about).collect();
            let is_new = !about.iter().any(|label| others.contains(label));
            let is_changed =
                life.base.about.contains(&"condition") && about.iter().any(|label| life.base.about.contains(label));
            let is_all = |about: &[&str]| about.contains(&"everything");
            let clashes = is_all(&about) && !others.is_empty() || is_all(&others);
            if is_new && !is_changed && !clashes {
                life.statements.push(statement);
            }
            if life.statements.len() == count as usize {
                break;
            }
        }
        life
    }

    /// Draws lives until they have at least so many statements. Each has streams of its own.
    pub fn draw_all(count: usize, seed: u64, days: &RangeInclusive<i32>) -> Vec<DrawnLife> {
        let (mut lives, mut first): (Vec<DrawnLife>, usize) = (Vec::new(), 0);
        while first < count {
            let number = lives.len();
            let mut draw = Draw(Stream::named(seed, &format!("statements/{number}")));
            let life = DrawnLife::draw(&mut draw, first, seed.wrapping_add(number as u64), days);
            first += life.statements.len();
            lives.push(life);
        }
        lives
    }

    pub fn home(&self) -> &'static DrawnHome {
        &HOMES[self.home]
    }

    pub fn start(&self) -> (&'static str, &'static str) {
        STARTS[self.start]
    }

    /// Its calendar; the run begins at midnight.
    pub fn calendar(&self) -> Calendar {
        let (start, zone) = self.start();
        Calendar::new(&format!("{start}T00:00:00"), zone).expect("the start is a time of its zone")
    }
}
