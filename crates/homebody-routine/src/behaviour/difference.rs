//! Sentences that a run does not follow, with the expected and the actual numbers.

use super::driver::RoutineDriver;
use super::resident_routine::{ResidentRoutine, SentenceId, SentenceKind};
use super::tally::{LATE, SentenceOutcome, SentenceTally};
use crate::explain::words::clock;
use crate::language::activities::phrase;
use crate::routine::{Effect, HabitTime, When};
use homebody_core::ids::ResidentId;
use homebody_core::run::Run;
use homebody_core::time::{DAY, MINUTE, RunTime};
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
    /// The share of the sentence that is not followed, from 0 to 1: of its occasions, of its length, or half of those that are late.
    pub lost_share: f64,
    /// Whether it is certain before the run.
    pub told: bool,
}

/// The run that differences are measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// A whole run.
    Run,
    /// The first days of a run. A sentence without an occasion in them is not judged.
    Sample,
}

/// Occasions of a sample that must be missed or late before a sentence is reported (our choice): one may be chance.
const LEAST_OF_SAMPLE: u32 = 2;

/// The weight of a late occasion; a missed one weighs 1 (our choice).
const LATE_WEIGHT: f64 = 0.5;

/// Share of the planned activities that may be left out without a report (our choice): one day in twenty.
const LEFT_OUT: f64 = 0.05;

/// Share of the activities with a time that may be late without a report (our choice).
const LATE_SHARE: f64 = 0.1;

/// Mean delay above which a stated time of day is reported, in minutes (our choice).
const LATE_MEAN_MIN: f64 = 8.0;

/// Share of its mean length below which an activity is reported (our choice).
const SHORT: f64 = 0.9;

/// Sentences that a run, so far, does not follow, the largest loss first.
pub fn of_run(run: &Run, measured: Measured) -> Vec<Difference> {
    let days = i32::try_from(run.now().since_zero().div_euclid(DAY)).unwrap_or(i32::MAX);
    let drivers = (0..run.names().len()).filter_map(|body| run.driver(ResidentId::new(body))?.as_any());
    let lives = drivers.filter_map(|driver| driver.downcast_ref());
    let (visitors, residents): (Vec<&RoutineDriver>, Vec<&RoutineDriver>) =
        lives.partition(|life: &&RoutineDriver| life.is_visitor());
    let of_one = |resident: &RoutineDriver| {
        let own = visitors.iter().filter(|visitor| visitor.host() == resident.host());
        let of_visitors: Vec<&SentenceTally> = own.map(|visitor| visitor.tally()).collect();
        differences(resident.life(), resident.tally(), &of_visitors, days, measured)
    };
    let mut all: Vec<Difference> = residents.into_iter().flat_map(of_one).collect();
    all.sort_by(|one, other| other.lost_share.total_cmp(&one.lost_share));
    all
}

/// The differences after `days` days. A host may do other things in the time of a visit, so its length is in the visitor's
/// tally.
fn differences(
    life: &ResidentRoutine,
    tally: &SentenceTally,
    of_visitors: &[&SentenceTally],
    days: i32,
    measured: Measured,
) -> Vec<Difference> {
    let is_sample = measured == Measured::Sample;
    let mut all = if is_sample { Vec::new() } else { predicted_differences(life, days) };
    for (id, file, said) in life.sentences().filter(|(id, ..)| id.source != ResidentRoutine::UNSAID) {
        if all.iter().any(|known| known.file == file && known.line == said.line && known.text == said.text) {
            continue;
        }
        let lived = tally.outcome(id);
        let of_stay = of_visitors.iter().map(|visitor| visitor.outcome(id)).find(|stay| stay.begun > 0);
        let lengths = of_stay.unwrap_or_else(|| lived.clone());
        let is_judged = |lost: &Lost| !is_sample || lost.occasions >= LEAST_OF_SAMPLE;
        let lost = if is_sample || days < A_MONTH { None } else { without_day(life, id, days) };
        let lost = lost.or_else(|| difference(life, id, &lived, &lengths)).filter(is_judged);
        if let Some(lost) = lost {
            all.push(Difference {
                resident: life.name.clone(),
                file: file.to_owned(),
                line: said.line,
                text: said.text.clone(),
                expected: lost.expected,
                lived: lost.lived,
                lost_share: lost.share,
                told: false,
            });
        }
    }
    all.sort_by(|a, b| (a.file != *life.file(), &a.file, a.line).cmp(&(b.file != *life.file(), &b.file, b.line)));
    all
}

/// Shortest run, in days, in which a sentence about weekdays, weather or poor nights is expected to apply (our choice).
const A_MONTH: i32 = 31;

/// Sentences of the routine itself that have no effect in a run of `days` days.
pub fn predicted_differences(life: &ResidentRoutine, days: i32) -> Vec<Difference> {
    let own = life.sentences().filter(|(id, ..)| id.source == ResidentRoutine::OWN);
    let never = own.filter_map(|(id, file, said)| {
        let when = when(life, id)?;
        if when.days_of_run(&life.calendar, days).next().is_some() {
            return None;
        }
        let lived = match (when.phase.from.map(|from| life.day_of(from)), when.phase.until) {
            (Some(i32::MAX), _) => return None,
            (Some(from), _) if from >= days => {
                format!("nothing: it begins on day {}, and the run has {days}", i64::from(from) + 1)
            }
            (_, Some(until)) if life.day_of(until) <= 0 => "nothing: it is over before the run".into(),
            // A run of a day has no Tuesday.
            _ if days < A_MONTH && when.days_of_run(&life.calendar, A_MONTH).next().is_some() => return None,
            _ => "nothing: it applies on no day of this run".into(),
        };
        Some(Difference {
            resident: life.name.clone(),
            file: file.to_owned(),
            line: said.line,
            text: said.text.clone(),
            expected: "once in the run or more".to_owned(),
            lived,
            lost_share: 1.0,
            told: true,
        })
    });
    never.collect()
}

fn when(life: &ResidentRoutine, id: SentenceId) -> Option<&When> {
    match id.kind {
        SentenceKind::Habit => life.habit(id).map(|habit| &habit.when),
        SentenceKind::Rule => life.rule(id).map(|rule| &rule.when),
        SentenceKind::Change => life.change(id).map(|change| &change.when),
    }
}

/// The loss of a sentence.
struct Lost {
    expected: String,
    lived: String,
    share: f64,
    /// Occasions that show it; none of a sentence that never applied.
    occasions: u32,
}

/// The loss of a habit whose weather or episode is on no day of the run.
fn without_day(life: &ResidentRoutine, id: SentenceId, days: i32) -> Option<Lost> {
    let when = &life.habit(id)?.when;
    let mut dates = when.days_of_run(&life.calendar, days);
    let is_never = id.source == ResidentRoutine::OWN && !dates.any(|day| life.is_on(&when.days, day));
    let (expected, lived) = ("on one day or more".to_owned(), "nothing: it applies on no day of this run".to_owned());
    is_never.then_some(Lost { expected, lived, share: 1.0, occasions: 0 })
}

/// The activity that most often took the time of a sentence, and when it ended.
fn taker_words(life: &ResidentRoutine, lived: &SentenceOutcome) -> String {
    let most = lived.takers.iter().max_by_key(|(_, ends)| ends.len());
    let Some((habit, ends)) = most.and_then(|(id, ends)| Some((life.habit(*id)?, ends))) else {
        return String::new();
    };
    let what = match &habit.visitor {
        Some(visitor) => format!("the visit by {visitor:?}"),
        None => format!("{:?}", phrase(&habit.activity)),
    };
    format!("; its time goes to {what}, until about {}", clock(median_clock_s(life, ends)))
}

/// The median time of day, in seconds since midnight. Times after midnight follow those before.
fn median_clock_s(life: &ResidentRoutine, times: &[RunTime]) -> f64 {
    let minutes =
        times.iter().map(|at| life.calendar.local(*at)).map(|at| i64::from(at.hour()) * 60 + i64::from(at.minute()));
    let minutes: Vec<i64> = minutes.collect();
    let first = minutes.first().copied().unwrap_or_default();
    let (day, half) = (DAY / MINUTE, DAY / MINUTE / 2);
    let mut later: Vec<i64> = minutes.iter().map(|minute| (minute - first + half).rem_euclid(day) - half).collect();
    later.sort_unstable();
    (first + later.get(later.len() / 2).copied().unwrap_or_default()).rem_euclid(day) as f64 * MINUTE.seconds()
}

/// The expected and the actual result, if they differ.
fn difference(
    life: &ResidentRoutine,
    id: SentenceId,
    lived: &SentenceOutcome,
    lengths: &SentenceOutcome,
) -> Option<Lost> {
    let SentenceOutcome { planned, begun, no_way, late, .. } = *lived;
    match id.kind {
        SentenceKind::Rule => return None,
        SentenceKind::Change => {
            // The effect of a condition is reported with the sentence that shows it.
            let is_shown = life.change(id).is_some_and(|change| matches!(change.effect, Effect::Shows { .. }));
            let is_never = planned == 0 && (id.source == ResidentRoutine::OWN || is_shown);
            let (expected, lived) = ("on one day or more".to_owned(), "it held on no day".to_owned());
            return is_never.then_some(Lost { expected, lived, share: 1.0, occasions: 0 });
        }
        SentenceKind::Habit => {}
    }
    let missed = planned.saturating_sub(begun);
    let all = planned.max(begun);
    if no_way > 0 || f64::from(missed) > f64::from(planned) * LEFT_OUT {
        let why = match no_way {
            0 => "there was no time for the others".to_owned(),
            ways => format!("there was no way {ways} times"),
        };
        let done = begun.saturating_sub(no_way);
        return Some(Lost {
            expected: format!("{all} times"),
            lived: format!("{done} times: {why}{}", taker_words(life, lived)),
            share: f64::from(all - done) / f64::from(all),
            occasions: all - done,
        });
    }
    let habit = life.habit(id)?;
    if habit.when.time != HabitTime::AnyTime && f64::from(late) > f64::from(begun) * LATE_SHARE {
        return Some(Lost {
            expected: "at its time".to_owned(),
            lived: format!(
                "begun more than {} min late {late} of {begun} times{}",
                LATE / MINUTE,
                taker_words(life, lived)
            ),
            share: LATE_WEIGHT * f64::from(late) / f64::from(begun),
            occasions: late,
        });
    }
    let late_min = lived.late_s / f64::from(begun.max(1)) / 60.0;
    if matches!(habit.when.time, HabitTime::At(_)) && late_min > LATE_MEAN_MIN {
        return Some(Lost {
            expected: "at its time".to_owned(),
            lived: format!("begun {late_min:.0} min late in the mean{}", taker_words(life, lived)),
            share: LATE_WEIGHT * late_min / (late_min + LATE_MEAN_MIN),
            occasions: begun,
        });
    }
    let SentenceOutcome { begun, done, planned_s, lasted_s, .. } = *lengths;
    let (planned_min, lasted_min) = (planned_s / f64::from(begun) / 60.0, lasted_s / f64::from(done) / 60.0);
    if (habit.when.lasts.is_some() || habit.when.until.is_some()) && done > 0 && lasted_min < SHORT * planned_min {
        return Some(Lost {
            expected: format!("{planned_min:.0} min on average"),
            lived: format!("{lasted_min:.0} min on average{}", taker_words(life, lived)),
            share: 1.0 - lasted_min / planned_min,
            occasions: done,
        });
    }
    None
}
