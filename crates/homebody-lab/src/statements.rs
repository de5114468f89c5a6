//! Random statements, and whether they happen in the simulation.
//!
//! A life is a home, a routine and one to three drawn statements, which may get in each other's way. Each statement is a sentence of the
//! routine, as a user would write it. After the run, each field of the statement is measured in the ground truth. Expected values come from
//! the drawn numbers, and not from the program's reading of the sentence.

mod besides;
mod bounds;
mod change;
mod days;
mod deeds;
mod draw;
mod field;
mod habit;
mod homes;
mod judge;
mod numbers;
mod report;
mod rule;

#[cfg(test)]
mod tests;

pub use bounds::FALSE_ALARMS;
pub use draw::DrawnLife;

use crate::claims::ClaimTruth;
use crate::simulated::each_step;
use draw::DrawnStatement;
use field::{FieldResult, FieldTopic, LifeView};
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::DAY;
use homebody_routine::behaviour::difference::Difference;
use homebody_routine::household::Household;
use homebody_routine::routine::Routine;
use serde::Serialize;
use std::collections::BTreeSet;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FieldVerdict {
    /// The measured value is within the bounds.
    Happened,
    /// Homebody reported before the run that it cannot happen, or has no room.
    Told,
    Neither,
}

/// A field of a statement.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FieldRow {
    /// The number of the statement.
    pub index: usize,
    pub kind: String,
    pub field: String,
    pub text: String,
    pub expected: String,
    pub measured: String,
    pub verdict: FieldVerdict,
    /// The report of the program, if any.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub told: String,
    /// The home, the days and the routine.
    pub home: String,
    pub days: i32,
    pub run_seed: u64,
    pub routine: String,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StatementsExperiment {
    pub seed: u64,
    pub statements: usize,
    /// Statements without an occasion in their run, such as a month that it does not reach.
    pub unmeasured: usize,
    pub happened: usize,
    pub told: usize,
    pub neither: usize,
    /// Probability that a true field is outside its bounds by chance.
    pub false_alarms: f64,
    pub fields: Vec<FieldRow>,
}

/// Reasons of refusals, each with the statement that it is about; `None` for another sentence.
type Refusals = Vec<(Option<usize>, String)>;

/// A run with its truth.
struct SimulatedLife {
    truth: ClaimTruth,
    who: usize,
    differences: Vec<Difference>,
    /// The statements as `explain` gives them.
    routine: Routine,
}

impl StatementsExperiment {
    pub fn from_rows(fields: Vec<FieldRow>, statements: usize, seed: u64) -> StatementsExperiment {
        let count = |verdict: FieldVerdict| fields.iter().filter(|row| row.verdict == verdict).count();
        StatementsExperiment {
            seed,
            statements,
            unmeasured: statements - fields.iter().map(|row| row.index).collect::<BTreeSet<_>>().len(),
            happened: count(FieldVerdict::Happened),
            told: count(FieldVerdict::Told),
            neither: count(FieldVerdict::Neither),
            false_alarms: FALSE_ALARMS,
            fields,
        }
    }
}

impl DrawnLife {
    /// Simulates the life and measures each of its statements.
    pub fn measure(&self) -> Vec<FieldRow> {
        let mut rows = Vec::new();
        // Without a statement, there is nothing to measure.
        let simulate = |left: &[usize]| if left.is_empty() { Err(Refusals::new()) } else { self.simulate(left) };
        let accepted = self.with_accepted(simulate, |index, why| rows.push(self.refused(index, why)));
        let Some((life, left)) = accepted else { return rows };
        let view = self.view(&life);
        for &index in &left {
            let statement = &self.statements[index];
            let others: Vec<usize> = left.iter().copied().filter(|other| *other != index).collect();
            let twin = if statement.has_twin() { self.simulate_with_carriers(&others, index).ok() } else { None };
            let twin_view = twin.as_ref().map(|twin| self.view(twin));
            let explained = statement.explained(&life.routine, &statement.words(self.context.home));
            let fields = explained.into_iter().chain(statement.judge(&view, twin_view.as_ref())).collect();
            rows.extend(self.rows(index, fields, &life));
        }
        rows.sort_by_key(|row| row.index);
        rows
    }

    fn view<'a>(&'a self, life: &'a SimulatedLife) -> LifeView<'a> {
        let takes = |day: i32| {
            self.statements
                .iter()
                .any(|statement| matches!(statement, DrawnStatement::Habit(habit) if habit.takes(day)))
        };
        LifeView {
            life: &life.truth,
            calendar: life.truth.calendar(),
            who: life.who,
            person: self.context.home.person,
            days: self.context.days,
            up_min: self.context.base.up_min,
            bed_min: self.context.base.bed_min,
            excused: (0..self.context.days).map(takes).collect(),
        }
    }

    fn row(&self, index: usize, field: FieldResult, verdict: FieldVerdict, told: String) -> FieldRow {
        let statement = &self.statements[index];
        FieldRow {
            index: self.first + index,
            kind: statement.kind(),
            field: field.field,
            text: statement.words(self.context.home),
            expected: field.expected,
            measured: field.measured,
            verdict,
            told,
            home: format!("{}, from {} in {}", self.context.home.name, self.context.start.0, self.context.start.1),
            days: self.context.days,
            run_seed: self.seed,
            routine: self.routine(&(0..self.statements.len()).collect::<Vec<_>>(), &[]),
        }
    }

    fn refused(&self, index: usize, why: &str) -> FieldRow {
        let field = FieldResult {
            field: "refused".to_owned(),
            expected: "accepted or refused with a reason".to_owned(),
            measured: "refused".to_owned(),
            holds: false,
        };
        self.row(index, field, FieldVerdict::Told, why.to_owned())
    }

    fn rows(&self, index: usize, fields: Vec<FieldResult>, life: &SimulatedLife) -> Vec<FieldRow> {
        let text = self.statements[index].words(self.context.home);
        let remarks = life.routine.remarks.iter().map(|remark| &remark.text);
        let remark = remarks.into_iter().find(|remark| text.contains(remark.trim_end_matches('.')));
        let is_of_it = |difference: &&Difference| text.contains(difference.text.trim().trim_end_matches('.'));
        let differences: Vec<&Difference> = life.differences.iter().filter(is_of_it).collect();
        fields
            .into_iter()
            .map(|field| {
                let told = differences.iter().find(|of| covers(of, field.topic()));
                let told = told.map(|of| format!("expected {}; {}", of.expected, of.lived));
                let told = told.or_else(|| remark.map(|remark| format!("remark: {remark}")));
                let verdict = match (field.holds, &told) {
                    (true, _) => FieldVerdict::Happened,
                    (false, Some(_)) => FieldVerdict::Told,
                    (false, None) => FieldVerdict::Neither,
                };
                self.row(index, field, verdict, told.unwrap_or_default())
            })
            .collect()
    }

    /// The text of the routine with some of the statements, and the carriers of others.
    fn routine(&self, statements: &[usize], carried: &[usize]) -> String {
        let all = || statements.iter().chain(carried).map(|index| &self.statements[*index]);
        let mut sentences: Vec<String> = all().flat_map(|statement| statement.carriers(self.context.home)).collect();
        sentences.dedup();
        sentences.extend(statements.iter().map(|index| self.statements[*index].words(self.context.home)));
        let sentences: Vec<&str> = sentences.iter().map(String::as_str).collect();
        let labels: Vec<&str> = all().flat_map(DrawnStatement::replaces).collect();
        self.context.base.text(self.context.home, &sentences, &labels)
    }

    fn simulate(&self, statements: &[usize]) -> Result<SimulatedLife, Refusals> {
        self.simulate_text(&self.routine(statements, &[]), statements)
    }

    fn simulate_with_carriers(&self, statements: &[usize], of: usize) -> Result<SimulatedLife, Refusals> {
        self.simulate_text(&self.routine(statements, &[of]), statements)
    }

    fn simulate_text(&self, text: &str, statements: &[usize]) -> Result<SimulatedLife, Refusals> {
        let (scenario, household) = self.load(text, statements)?;
        self.run(&scenario, &household).map_err(|why| vec![(None, why)])
    }

    fn load(&self, text: &str, statements: &[usize]) -> Result<(Scenario, Household), Refusals> {
        let (start, zone) = self.context.start;
        let files = self.context.home.files(start, zone, text);
        Household::load(&files, "scenario.json", &[]).map_err(|problems| {
            let of_line = |line: u32| {
                let line = text.lines().nth(line.max(1) as usize - 1)?;
                statements.iter().copied().find(|index| self.statements[*index].words(self.context.home) == line)
            };
            problems.0.iter().map(|problem| (of_line(problem.line), problem.text())).collect()
        })
    }

    /// The scenario of the life without the statements that the program refuses, and its seed.
    pub fn scenario(&self) -> Option<(Scenario, Household, u64)> {
        let load = |left: &[usize]| self.load(&self.routine(left, &[]), left);
        let ((scenario, household), _) = self.with_accepted(load, |_, _| {})?;
        Some((scenario, household, self.seed))
    }

    /// The result for the statements that the program accepts, with their indices. `refused` takes each of the others with its reason.
    fn with_accepted<T>(
        &self,
        make: impl Fn(&[usize]) -> Result<T, Refusals>,
        mut refused: impl FnMut(usize, &str),
    ) -> Option<(T, Vec<usize>)> {
        let mut left: Vec<usize> = (0..self.statements.len()).collect();
        loop {
            let refusals = match make(&left) {
                Ok(made) => return Some((made, left)),
                Err(refusals) => refusals,
            };
            let before = left.len();
            left.retain(|&index| {
                let why = refusals.iter().find(|(of, _)| of.is_none_or(|of| of == index));
                why.iter().for_each(|(_, why)| refused(index, why));
                why.is_none()
            });
            if left.len() == before {
                return None;
            }
        }
    }

    fn run(&self, scenario: &Scenario, household: &Household) -> Result<SimulatedLife, String> {
        let who = scenario.residents.iter().position(|one| one.file.name == self.context.home.person).unwrap_or(0);
        let routine = household.routine(who).cloned().unwrap_or_default();
        let mut run = Run::new(scenario, household, self.seed, i64::from(self.context.days) * DAY);
        let mut truth = ClaimTruth::new(&run, &scenario.calendar, self.context.days);
        each_step(&mut run, DAY, |events| truth.absorb(events)).map_err(|error| error.to_string())?;
        truth.finish();
        let differences = Household::differences(&run);
        Ok(SimulatedLife { truth, who, differences, routine })
    }
}

impl DrawnStatement {
    /// Whether the numbers that `explain` prints are those of the sentence.
    fn explained(&self, routine: &Routine, words: &str) -> Option<FieldResult> {
        let DrawnStatement::Habit(habit) = self else { return None };
        let of = routine.habits.iter().find(|of| of.said.text.trim_end_matches('.') == words.trim_end_matches('.'))?;
        habit.explained(of)
    }

    fn judge(&self, view: &LifeView, twin: Option<&LifeView>) -> Vec<FieldResult> {
        match self {
            DrawnStatement::Habit(habit) => habit.judge(view),
            DrawnStatement::Change(change) => change.judge(view, twin),
            DrawnStatement::Rule(rule) => rule.judge(view),
        }
    }
}

/// Whether a reported difference is about such a field. Only the gravest difference of a sentence is reported, so a lack of room explains
/// its time and length, too.
fn covers(difference: &Difference, topic: FieldTopic) -> bool {
    let never = difference.lived.starts_with("0 times") || difference.lived.starts_with("nothing") || difference.told;
    let is_short = difference.lived.contains("on average");
    never
        || match topic {
            FieldTopic::Time => !is_short,
            FieldTopic::Length => true,
            // An activity that has no room at its time is left out, too, once it is too late.
            FieldTopic::Days => !is_short,
            FieldTopic::Other => false,
        }
}
