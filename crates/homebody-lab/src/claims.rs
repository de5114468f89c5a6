//! Simulations follow the sentences of routines, or Homebody warns before the run: a table of claims.
//!
//! A case adds sentences to a simple routine, and states what they must cause. The bounds are written by hand, and not taken from the
//! program's reading of the sentences. They are measured in the ground truth alone. A claim that does not hold counts as told if the
//! program warns before the run: it rejects the sentences, keeps them as a remark, or reports that it does not follow them.

mod homes;
mod measure;
mod report;
mod subject;
mod text;
mod truth;

#[cfg(test)]
mod tests;

pub use subject::{Filter, Subject, WEEKDAYS};
pub use text::{CLAIMS, CONDITIONS, Claim, ClaimCase, ClaimHome};
pub use truth::{ClaimTruth, Occurrence};

use crate::simulated::each_step;
use homebody_core::run::Run;
use homebody_core::time::DAY;
use homebody_routine::household::Household;
use serde::Serialize;
use std::collections::BTreeMap;
use text::{Beside, ClaimContent};

/// Three meals, up at seven, in bed at half past ten; defaults apply to everything else.
const CALM: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 07:00.\nShe goes to bed at 22:30.\n";

/// A Monday in winter, in UTC: no clock changes.
const START: &str = "2009-01-05";

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The measured value agrees with the sentence.
    Lived,
    /// The measured value differs, and Homebody warned before the run.
    Told,
    /// The measured value differs, and Homebody did not warn.
    Neither,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimRow {
    pub form: String,
    pub line: usize,
    pub text: String,
    pub claim: String,
    /// The source of the size, if the table names it.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub source: String,
    pub expected: String,
    pub measured: String,
    pub verdict: Verdict,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimsExperiment {
    pub claims: Vec<ClaimRow>,
    pub lived: usize,
    pub told: usize,
    pub neither: usize,
    pub days: i32,
    pub seed: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ConditionsExperiment {
    pub conditions: Vec<ClaimRow>,
    /// Number of effects within the expected range.
    pub within: usize,
    pub seed: u64,
}

impl ConditionsExperiment {
    pub fn from_rows(rows: Vec<ClaimRow>, seed: u64) -> ConditionsExperiment {
        let within = rows.iter().filter(|row| row.verdict == Verdict::Lived).count();
        ConditionsExperiment { conditions: rows, within, seed }
    }
}

/// A simulated case: its truth, or the warnings before the run.
struct SimulatedCase {
    life: Option<ClaimTruth>,
    who: usize,
    warnings: Vec<String>,
}

impl ClaimsExperiment {
    pub fn from_rows(rows: Vec<ClaimRow>, days: i32, seed: u64) -> ClaimsExperiment {
        let count = |verdict: Verdict| rows.iter().filter(|row| row.verdict == verdict).count();
        ClaimsExperiment {
            lived: count(Verdict::Lived),
            told: count(Verdict::Told),
            neither: count(Verdict::Neither),
            days,
            seed,
            claims: rows,
        }
    }
}

impl ClaimCase {
    /// Simulates the sentences for a number of days, unless the case sets it, and judges each claim.
    pub fn simulate(&self, days: i32, seed: u64) -> Vec<ClaimRow> {
        let days = self.days.unwrap_or(days);
        let with = self.simulate_sentences(&self.said, days, seed);
        let twin = self.has_twin().then(|| self.simulate_sentences(&[], days, seed));
        self.claims.iter().map(|claim| self.judge(claim, &with, twin.as_ref())).collect()
    }

    fn simulate_sentences(&self, said: &[String], days: i32, seed: u64) -> SimulatedCase {
        let files = self.files(said);
        let (scenario, household) = match Household::load(&files, "scenario.json", &[]) {
            Ok(loaded) => loaded,
            Err(problems) => {
                let warnings =
                    problems.0.iter().map(|problem| format!("{}{}", problem.label(), problem.text())).collect();
                return SimulatedCase { life: None, who: 0, warnings };
            }
        };
        let mut warnings = Vec::new();
        for routine in (0..scenario.residents.len()).filter_map(|resident| household.routine(resident)) {
            warnings.extend(routine.remarks.iter().map(|remark| format!("{}: remark: not lived", remark.text)));
        }
        let length = i64::from(days) * DAY;
        let mut run = Run::new(&scenario, &household, seed, length);
        let mut life = ClaimTruth::new(&run, &scenario.calendar, days);
        if let Err(error) = each_step(&mut run, DAY, |events| life.absorb(events)) {
            warnings.push(error.to_string());
            return SimulatedCase { life: None, who: 0, warnings };
        }
        life.finish();
        // The report of `homebody routine check --lived` on these sentences.
        let all = words(&said.join(" "));
        let of_them = Household::differences(&run).into_iter().filter(|of| all.contains(&words(&of.text)));
        warnings.extend(of_them.map(|of| format!("{}: expected {}; lived {}", of.text, of.expected, of.lived)));
        let who = life.body(self.whose.as_deref(), 0).unwrap_or(0);
        SimulatedCase { life: Some(life), who, warnings }
    }

    fn files(&self, said: &[String]) -> BTreeMap<String, String> {
        let mut files = self.home.files(self.start.as_deref().unwrap_or(START));
        let lines: String = self.both.iter().chain(said).map(|line| format!("{line}\n")).collect();
        let file = format!("{}.routine", self.whose.as_deref().unwrap_or("margaret"));
        let base = match self.home {
            _ if self.alone => String::new(),
            ClaimHome::Apartment => CALM.to_owned(),
            ClaimHome::Couple => files.get(&file).cloned().unwrap_or_default(),
        };
        files.insert(file, format!("{base}{lines}"));
        files
    }

    /// Judges one claim by the ground truth, by the twin, and by the warnings before the run.
    fn judge(&self, claim: &Claim, with: &SimulatedCase, twin: Option<&SimulatedCase>) -> ClaimRow {
        let row = |expected: String, measured: String, verdict: Verdict| ClaimRow {
            form: self.form.clone(),
            line: self.line,
            text: self.sentence(),
            claim: claim.text.clone(),
            source: claim.source.clone(),
            expected,
            measured,
            verdict,
        };
        let warnings = || with.warnings.join("; ");
        let or_told = if with.warnings.is_empty() { Verdict::Neither } else { Verdict::Told };
        let (of, subject, measure, filter, beside) = match &claim.what {
            ClaimContent::Told(words) => {
                let is_warned = with.warnings.iter().any(|warning| warning.contains(words.as_str()));
                let verdict = if is_warned { Verdict::Told } else { Verdict::Neither };
                return row(format!("told: {words}"), warnings(), verdict);
            }
            ClaimContent::Measured { of, subject, measure, filter, beside } => (of, subject, measure, filter, *beside),
        };
        let value = |tried: &SimulatedCase| {
            let life = tried.life.as_ref()?;
            let who = life.body(of.as_deref(), tried.who)?;
            Some((measure.value(life, who, subject, filter), measure.many(life, who, subject, filter)))
        };
        let measured = value(with);
        let (low, high) = measure.bounds(measured.map_or(1.0, |(_, many)| many), beside != Beside::Itself);
        let expected = measure.in_words((low, high), beside);
        let Some((value_with, _)) = measured else { return row(expected, warnings(), or_told) };
        let value = match (beside, twin.and_then(value)) {
            (Beside::Itself, _) => value_with,
            (Beside::ShareOfTwin, Some((of_twin, _))) => value_with / of_twin,
            (Beside::MoreThanTwin, Some((of_twin, _))) => value_with - of_twin,
            (_, None) => f64::NAN,
        };
        // The report rounds values.
        let holds = value >= low - 1e-9 && value <= high + 1e-9;
        let verdict = if holds { Verdict::Lived } else { or_told };
        let measured = measure.value_in_words(value, beside);
        row(
            expected,
            if holds || with.warnings.is_empty() { measured } else { format!("{measured}; {}", warnings()) },
            verdict,
        )
    }
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
