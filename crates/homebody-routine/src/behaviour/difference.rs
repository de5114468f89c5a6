//! Sentences that a run does not follow, with the expected and the actual numbers.

use super::driver::RoutineDriver;
use super::resident_routine::{ResidentRoutine, SentenceId, SentenceKind};
use super::tally::{LATE, SentenceOutcome, SentenceTally};
use crate::routine::{Effect, HabitTime, Phase};
use homebody_core::time::MINUTE;
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    pub resident: String,
    /// The routine or the condition.
    pub file: String,
    /// Counted from 1.
    pub line: u32,
    pub text: String,
    pub expected: String,
    pub lived: String,
    /// Whether it is certain before the run.
    pub told: bool,
}

/// Share of the planned activities that may be left out without a report (our choice): one day in twenty.
const LEFT_OUT: f64 = 0.05;

/// Share of the activities with a time that may be late without a report (our choice).
const LATE_SHARE: f64 = 0.1;

/// Share of its mean length below which an activity is reported (our choice).
const SHORT: f64 = 0.7;

pub fn differences_of_all(lives: &[&RoutineDriver], days: i32) -> Vec<Difference> {
    let (visitors, residents): (Vec<&RoutineDriver>, Vec<&RoutineDriver>) =
        lives.iter().partition(|life| life.is_visitor());
    let of_one = |resident: &RoutineDriver| {
        let own = visitors.iter().filter(|visitor| visitor.host() == resident.host());
        let of_visitors: Vec<&SentenceTally> = own.map(|visitor| visitor.tally()).collect();
        differences(resident.life(), resident.tally(), &of_visitors, days)
    };
    residents.into_iter().flat_map(of_one).collect()
}

/// The differences after `days` days. A host only welcomes a visitor who stays for days; the length of the stay is in the
/// visitor's tally.
fn differences(
    life: &ResidentRoutine,
    tally: &SentenceTally,
    of_visitors: &[&SentenceTally],
    days: i32,
) -> Vec<Difference> {
    let mut all = predicted_differences(life, days);
    for (id, file, said) in life.sentences().filter(|(id, ..)| id.source != ResidentRoutine::UNSAID) {
        if all.iter().any(|known| known.file == file && known.line == said.line && known.text == said.text) {
            continue;
        }
        let lived = tally.outcome(id);
        let lengths =
            of_visitors.iter().map(|visitor| visitor.outcome(id)).find(|stay| stay.begun > 0).unwrap_or(lived);
        if let Some((expected, lived)) = difference(life, id, lived, lengths) {
            let (resident, file) = (life.name.clone(), file.to_owned());
            let (line, text) = (said.line, said.text.clone());
            all.push(Difference { resident, file, line, text, expected, lived, told: false });
        }
    }
    all.sort_by(|a, b| (a.file != *life.file(), &a.file, a.line).cmp(&(b.file != *life.file(), &b.file, b.line)));
    all
}

/// Sentences of the routine itself that have no effect in a run of `days` days.
pub fn predicted_differences(life: &ResidentRoutine, days: i32) -> Vec<Difference> {
    let own = life.sentences().filter(|(id, ..)| id.source == ResidentRoutine::OWN);
    let never = own.filter_map(|(id, file, said)| {
        let phase = phase(life, id)?;
        let from = phase.from.map(|from| life.day_of(from))?;
        let lived = match from {
            i32::MAX => return None,
            from if from >= days => {
                format!("nothing: it begins on day {}, and the run has {days}", i64::from(from) + 1)
            }
            _ if phase.until.is_some_and(|until| life.day_of(until) <= 0) => {
                "nothing: it is over before the run".into()
            }
            _ => return None,
        };
        Some(Difference {
            resident: life.name.clone(),
            file: file.to_owned(),
            line: said.line,
            text: said.text.clone(),
            expected: "once in the run or more".to_owned(),
            lived,
            told: true,
        })
    });
    never.collect()
}

fn phase(life: &ResidentRoutine, id: SentenceId) -> Option<Phase> {
    match id.kind {
        SentenceKind::Habit => life.habit(id).map(|habit| habit.when.phase),
        SentenceKind::Rule => life.rule(id).map(|rule| rule.when.phase),
        SentenceKind::Change => life.change(id).map(|change| change.when.phase),
    }
}

/// The expected and the actual result, if they differ.
fn difference(
    life: &ResidentRoutine,
    id: SentenceId,
    lived: SentenceOutcome,
    lengths: SentenceOutcome,
) -> Option<(String, String)> {
    let SentenceOutcome { planned, begun, no_way, late, .. } = lived;
    match id.kind {
        SentenceKind::Rule => return None,
        SentenceKind::Change => {
            // The effect of a condition is reported with the sentence that shows it.
            let is_shown = life.change(id).is_some_and(|change| matches!(change.effect, Effect::Shows { .. }));
            let is_never = planned == 0 && (id.source == ResidentRoutine::OWN || is_shown);
            return is_never.then(|| ("on one day or more".to_owned(), "it held on no day".to_owned()));
        }
        SentenceKind::Habit => {}
    }
    let missed = planned.saturating_sub(begun);
    let expected = format!("{} times", planned.max(begun));
    if no_way > 0 || f64::from(missed) > f64::from(planned) * LEFT_OUT {
        let why = match no_way {
            0 => "there was no time for the others".to_owned(),
            ways => format!("there was no way {ways} times"),
        };
        return Some((expected, format!("{} times: {why}", begun.saturating_sub(no_way))));
    }
    let habit = life.habit(id)?;
    if matches!(habit.when.time, HabitTime::At(_) | HabitTime::Before(..))
        && f64::from(late) > f64::from(begun) * LATE_SHARE
    {
        let minutes = LATE / MINUTE;
        return Some(("at its time".to_owned(), format!("begun more than {minutes} min late {late} of {begun} times")));
    }
    let SentenceOutcome { begun, done, planned_s, lasted_s, .. } = lengths;
    if habit.when.lasts.is_some() && done > 0 && lasted_s / f64::from(done) < SHORT * planned_s / f64::from(begun) {
        let minutes = |sum_s: f64, times: u32| sum_s / f64::from(times) / 60.0;
        let expected = format!("{:.0} min on average", minutes(planned_s, begun));
        return Some((expected, format!("{:.0} min on average", minutes(lasted_s, done))));
    }
    None
}
