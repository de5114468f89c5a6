//! Draws lives. A life has a home, a routine and one to three statements.

use super::change::DrawnChange;
use super::habit::DrawnHabit;
use super::homes::{DrawnHome, LifeContext};
use super::numbers::Draw;
use super::rule::DrawnRule;
use std::ops::RangeInclusive;

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
    pub context: LifeContext,
    pub statements: Vec<DrawnStatement>,
}

/// Largest number of tries to draw a statement about something else than the others (our choice).
const MOST_TRIES: usize = 20;

/// Largest number of statements of a life (our choice).
const MOST_STATEMENTS: u32 = 3;

impl DrawnStatement {
    fn draw(draw: &mut Draw, context: &LifeContext) -> DrawnStatement {
        match draw.below(10) {
            0..=5 => DrawnStatement::Habit(DrawnHabit::draw_one(draw, context)),
            6 | 7 => DrawnStatement::Change(DrawnChange::draw(draw, context)),
            _ => DrawnStatement::Rule(DrawnRule::draw(draw, context)),
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
        let context = LifeContext::draw(draw, days);
        let mut life = DrawnLife { first, seed, context, statements: Vec::new() };
        let count = 1 + draw.below(MOST_STATEMENTS);
        for _ in 0..MOST_TRIES {
            let statement = DrawnStatement::draw(draw, &life.context);
            let about = statement.about();
            let others: Vec<&str> = life.statements.iter().flat_map(DrawnStatement::about).collect();
            let is_new = !about.iter().any(|label| others.contains(label));
            let is_changed = life.context.base.about.contains(&"condition")
                && about.iter().any(|label| life.context.base.about.contains(label));
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

    /// Draws lives. Together they have `count` statements or a few more.
    pub fn draw_all(count: usize, seed: u64, days: &RangeInclusive<i32>) -> Vec<DrawnLife> {
        DrawnLife::endless(seed, days).take_while(|life| life.first < count).collect()
    }

    /// Draws the first homes and routines.
    pub fn draw_lives(lives: usize, seed: u64, days: &RangeInclusive<i32>) -> Vec<DrawnLife> {
        DrawnLife::endless(seed, days).take(lives).collect()
    }

    /// Lives without end. Each has streams of its own.
    fn endless(seed: u64, days: &RangeInclusive<i32>) -> impl Iterator<Item = DrawnLife> {
        (0_u64..).scan(0, move |first, number| {
            let mut draw = Draw::named(seed, &format!("statements/{number}"));
            let life = DrawnLife::draw(&mut draw, *first, seed.wrapping_add(number), days);
            *first += life.statements.len();
            Some(life)
        })
    }
}
