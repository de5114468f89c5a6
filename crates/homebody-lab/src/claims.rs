//! Simulations follow the sentences of routines, or the user is warned before the run: a table of claims.
//!
//! Each case is some sentences of a routine, put over a calm life, and what is to come of them by their words. The bounds are
//! written by hand, not taken from how the program understands the sentences, and measured in the truth alone. A claim that
//! does not hold is told if the program says before the run that the sentences are refused, kept as a remark or not lived.

mod homes;
mod life;
mod measure;
mod report;
mod subject;
mod text;

#[cfg(test)]
mod tests;

pub use life::Life;
pub use text::{CLAIMS, CONDITIONS, Case, Claim, Home};

use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::time::{DAY, RunTime};
use homebody_routine::household::Household;
use serde::Serialize;
use std::collections::BTreeMap;
use text::{Beside, What};

/// Three meals, up at seven, in bed at half past ten; what is unsaid goes as it usually does.
const CALM: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 07:00.\nShe goes to bed at 22:30.\n";

/// A Monday in winter, in UTC: no clock changes.
const START: &str = "2009-01-05";

/// The result of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It was measured as the words say.
    Lived,
    /// It was not, and that is told before the run.
    Told,
    /// It was not, and nobody says so.
    Neither,
}

/// One claim with what was measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The form of sentences, a heading of the table.
    pub form: String,
    /// The line of the case in the table of claims.
    pub line: usize,
    /// The sentences that are tried.
    pub text: String,
    /// The claims, as in the table.
    pub claim: String,
    /// The source of the size, if the table names it.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub source: String,
    pub expected: String,
    pub measured: String,
    pub verdict: Verdict,
}

/// All claims and what came of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Experiment {
    pub claims: Vec<Row>,
    pub lived: usize,
    pub told: usize,
    pub neither: usize,
    pub days: i32,
    pub seed: u64,
}

/// The effects of conditions, beside published sizes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Conditions {
    pub conditions: Vec<Row>,
    /// Number of effects within the expected range.
    pub within: usize,
    pub seed: u64,
}

impl Conditions {
    pub fn of(rows: Vec<Row>, seed: u64) -> Conditions {
        let within = rows.iter().filter(|row| row.verdict == Verdict::Lived).count();
        Conditions { conditions: rows, within, seed }
    }
}

/// A simulated case: its truth, or the warnings before the run.
struct Tried {
    life: Option<Life>,
    /// Whose life counts where a claim names nobody.
    who: usize,
    told: Vec<String>,
}

impl Experiment {
    pub fn of(rows: Vec<Row>, days: i32, seed: u64) -> Experiment {
        let count = |verdict: Verdict| rows.iter().filter(|row| row.verdict == verdict).count();
        Experiment {
            lived: count(Verdict::Lived),
            told: count(Verdict::Told),
            neither: count(Verdict::Neither),
            days,
            seed,
            claims: rows,
        }
    }
}

impl Case {
    /// Simulates the sentences, for so many days unless the case sets them, and judges each claim.
    pub fn simulate(&self, days: i32, seed: u64) -> Vec<Row> {
        let days = self.days.unwrap_or(days);
        let with = self.tried(&self.said, days, seed);
        let twin = self.has_twin().then(|| self.tried(&[], days, seed));
        self.claims.iter().map(|claim| self.judge(claim, &with, twin.as_ref())).collect()
    }

    fn tried(&self, said: &[String], days: i32, seed: u64) -> Tried {
        let files = self.files(said);
        let (scenario, household) = match Household::load(&files, "scenario.json", &[]) {
            Ok(loaded) => loaded,
            Err(problems) => {
                let told = problems.0.iter().map(|problem| format!("{}{}", problem.label(), problem.text())).collect();
                return Tried { life: None, who: 0, told };
            }
        };
        let mut told = Vec::new();
        for routine in (0..scenario.residents.len()).filter_map(|resident| household.routine(resident)) {
            told.extend(routine.remarks.iter().map(|remark| format!("{}: remark: not lived", remark.text)));
        }
        let length = i64::from(days) * DAY;
        let end = RunTime::START + length;
        let mut run = Run::new(&scenario, &household, seed, length);
        let mut life = Life::new(&run, &scenario.calendar, days);
        let mut events = Events::default();
        while run.now() < end {
            if let Err(error) = run.advance((run.now() + DAY).min(end), &mut events) {
                told.push(error.to_string());
                return Tried { life: None, who: 0, told };
            }
            life.absorb(&events);
            events.clear();
        }
        life.finish();
        // The report of `homebody routine check --lived` on these sentences.
        let all = words(&said.join(" "));
        let of_them = Household::differences(&run).into_iter().filter(|of| all.contains(&words(&of.text)));
        told.extend(of_them.map(|of| format!("{}: expected {}; lived {}", of.text, of.expected, of.lived)));
        let who = life.body(self.whose.as_deref(), 0).unwrap_or(0);
        Tried { life: Some(life), who, told }
    }

    /// The files of the home with these sentences in the routine.
    fn files(&self, said: &[String]) -> BTreeMap<String, String> {
        let mut files = self.home.files(self.start.as_deref().unwrap_or(START));
        let lines: String = self.both.iter().chain(said).map(|line| format!("{line}\n")).collect();
        let file = format!("{}.routine", self.whose.as_deref().unwrap_or("margaret"));
        let base = match self.home {
            _ if self.alone => String::new(),
            Home::Apartment => CALM.to_owned(),
            Home::Couple => files.get(&file).cloned().unwrap_or_default(),
        };
        files.insert(file, format!("{base}{lines}"));
        files
    }

    /// Judges one claim by the truth, beside the twin, and by the warnings.
    fn judge(&self, claim: &Claim, with: &Tried, twin: Option<&Tried>) -> Row {
        let row = |expected: String, measured: String, verdict: Verdict| Row {
            form: self.form.clone(),
            line: self.line,
            text: self.sentence(),
            claim: claim.text.clone(),
            source: claim.source.clone(),
            expected,
            measured,
            verdict,
        };
        let told = || with.told.join("; ");
        let or_told = if with.told.is_empty() { Verdict::Neither } else { Verdict::Told };
        let (of, subject, measure, filter, beside) = match &claim.what {
            What::Told(words) => {
                let is_told = with.told.iter().any(|told| told.contains(words.as_str()));
                let verdict = if is_told { Verdict::Told } else { Verdict::Neither };
                return row(format!("told: {words}"), told(), verdict);
            }
            What::Measured { of, subject, measure, filter, beside } => (of, subject, measure, filter, *beside),
        };
        let value = |tried: &Tried| {
            let life = tried.life.as_ref()?;
            let who = life.body(of.as_deref(), tried.who)?;
            Some((measure.of(life, who, subject, filter), measure.many(life, who, subject, filter)))
        };
        let measured = value(with);
        let (low, high) = measure.bounds(measured.map_or(1.0, |(_, many)| many), beside != Beside::Itself);
        let expected = measure.in_words((low, high), beside);
        let Some((value_with, _)) = measured else { return row(expected, told(), or_told) };
        let value = match (beside, twin.and_then(value)) {
            (Beside::Itself, _) => value_with,
            (Beside::ShareOfTwin, Some((of_twin, _))) => value_with / of_twin,
            (Beside::MoreThanTwin, Some((of_twin, _))) => value_with - of_twin,
            (_, None) => f64::NAN,
        };
        // Rounded as it is shown.
        let holds = value >= low - 1e-9 && value <= high + 1e-9;
        let verdict = if holds { Verdict::Lived } else { or_told };
        let measured = measure.value_in_words(value, beside);
        row(expected, if holds || with.told.is_empty() { measured } else { format!("{measured}; {}", told()) }, verdict)
    }
}

/// A text with one space between its words.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
