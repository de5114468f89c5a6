//! Absences and visits of several days.

use super::amounts::DAY_S;
use super::calendar::{self, days_between};
use super::clause::Clause;
use super::draft::RoutineDraft;
use super::messages::TimeSentenceMessage;
use super::reader::SentenceReader;
use crate::routine::{Activity, HabitTime, Phase};
use homebody_core::fuzzy::Fuzzy;

/// Time at which a stay away or a visit of whole days begins and ends (our choice).
const SETS_OUT_S: Fuzzy = Fuzzy { low: 9.0 * 3600.0, from: 9.5 * 3600.0, to: 10.5 * 3600.0, high: 11.0 * 3600.0 };
const COMES_BACK_S: f64 = 17.0 * 3600.0;

/// For so many days at most somebody is away at a stretch (ours).
const MOST_DAYS: i32 = 390;

pub fn staying(
    reader: &mut SentenceReader,
    draft: &RoutineDraft,
    clause: &Clause,
    activity: &Activity,
    phase: &Phase,
) -> Option<(HabitTime, Phase, Option<Fuzzy>)> {
    let adverbs = &clause.adverbs;
    if !matches!(activity, Activity::Leave | Activity::Visit) || adverbs.lasts.is_some() || adverbs.until_time.is_some()
    {
        return None;
    }
    let words = reader.said(clause.predicate_span).to_lowercase();
    let first = words.split_whitespace().next().unwrap_or_default();
    let is_state = ["is", "are", "stays", "stay"].contains(&first);
    let says_when =
        adverbs.when.as_ref().is_some_and(|slot| !matches!(slot.value, HabitTime::At(_))) || adverbs.part.is_some();
    if says_when || !is_state && words.contains("walk") {
        return None;
    }
    let when = match adverbs.when.as_ref().map(|slot| &slot.value) {
        Some(HabitTime::At(at)) => HabitTime::At(*at),
        _ => HabitTime::At(SETS_OUT_S),
    };
    let is_often = adverbs.chance.is_some() || adverbs.every.is_some() || adverbs.weekdays.is_some();
    if let Some(days) = &adverbs.for_days {
        let lasts = Some(Fuzzy::exactly(days.value * DAY_S));
        return match phase.from {
            Some(from) => {
                let until = Some(calendar::later(from, 1));
                Some((when, Phase { from: Some(from), until, ..Phase::default() }, lasts))
            }
            None if is_often => Some((when, Phase { until: None, ..*phase }, lasts)),
            None => {
                let help = format!("write \"from day 30, {}, she {words}\"", reader.said(days.span));
                reader.fault(days.span, TimeSentenceMessage::NoBeginning { help });
                None
            }
        };
    }
    let from = phase.from?;
    if !is_state || is_often {
        return None;
    }
    // Of no end is said: until the run is over.
    let until = phase.until.unwrap_or(calendar::later(from, MOST_DAYS));
    let days = days_between(from, until, draft.first_date).filter(|&days| days > 1)?;
    let begins_s = match &when {
        HabitTime::At(at) => at.mean(),
        _ => SETS_OUT_S.mean(),
    };
    let lasts = (days - 1) as f64 * DAY_S + COMES_BACK_S - begins_s;
    let phase = Phase { from: Some(from), until: Some(calendar::later(from, 1)), ..Phase::default() };
    Some((when, phase, Some(Fuzzy::exactly(lasts.max(3600.0)))))
}
