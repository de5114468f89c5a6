//! The dates of sentences in a run.

use super::Explanation;
use super::words::join;
use crate::language::canonical::{MONTHS, WEEKDAYS};
use crate::routine::{DaySelection, When};
use crate::statement::Statement;
use homebody_core::calendar::Calendar;

impl Explanation {
    /// With the dates of its sentences in a run of so many days.
    pub fn dated(mut self, calendar: &Calendar, days: i32) -> Explanation {
        for row in &mut self.sentences {
            row.dates = when(&row.statement).map(|when| dates(when, calendar, days)).filter(|dates| !dates.is_empty());
        }
        self
    }
}

impl When {
    /// The days of a run with its date, in its time; weather, episodes and nights apart.
    pub(crate) fn days_of_run(&self, calendar: &Calendar, days: i32) -> impl Iterator<Item = i32> {
        (0..days).filter(|&day| self.phase.has_day(calendar, day) && self.days.has_date(calendar, day))
    }
}

fn when(statement: &Statement) -> Option<&When> {
    match statement {
        Statement::Habit(habit)
        | Statement::Sleep(habit)
        | Statement::Away(habit)
        | Statement::Visit(habit)
        | Statement::Event(habit) => Some(&habit.when),
        Statement::Change(change) | Statement::Thing(change) => Some(&change.when),
        Statement::Rule(rule) => Some(&rule.when),
        Statement::Person(_) | Statement::Note { .. } => None,
    }
}

fn dates(when: &When, calendar: &Calendar, days: i32) -> String {
    let Some(first) = when.days_of_run(calendar, days).next() else {
        return "applies on no day of this run".to_owned();
    };
    let is_counted = when.days.every > 1 || when.days.of_month != DaySelection::ALL.of_month;
    let first = is_counted.then(|| format!("first on {}", date(calendar, first)));
    let last = when.phase.until.map(|until| until.of_run(calendar).saturating_sub(1)).map(|last| {
        let fades = if when.phase.fading_days > 0.0 { " before it fades" } else { "" };
        format!("the last day{fades} is {}", date(calendar, last))
    });
    join([first, last].into_iter().flatten(), "; ")
}

/// Such as "day 6, Saturday 7 March 2009".
fn date(calendar: &Calendar, day: i32) -> String {
    let (year, month, of_month) = calendar.date(day);
    let (weekday, month) = (WEEKDAYS[usize::from(calendar.weekday(day))], MONTHS[usize::from(month) - 1]);
    format!("day {}, {weekday} {of_month} {month} {year}", i64::from(day) + 1)
}
