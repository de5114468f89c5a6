//! Absences and visits of several days.

use super::amounts::DAY_S;
use super::builder::Builder;
use super::calendar::{self, days_between};
use super::messages::TimeSentenceMessage;
use super::parts::{Parts, Said};
use super::value::Clause;
use crate::routine::{Activity, HabitTime, Phase};
use homebody_core::fuzzy::Fuzzy;

/// Time at which a stay away or a visit of whole days begins and ends (our choice).
const SETS_OUT_S: Fuzzy = Fuzzy { low: 9.0 * 3600.0, from: 9.5 * 3600.0, to: 10.5 * 3600.0, high: 11.0 * 3600.0 };
const COMES_BACK_S: f64 = 17.0 * 3600.0;

/// For so many days at most somebody is away at a stretch (our choice).
const MOST_DAYS: i32 = 390;

/// Said it begins, on which day, and how long it lasts.
pub struct Stay {
    pub when: HabitTime,
    pub phase: Phase,
    pub lasts: Fuzzy,
}

pub fn staying(
    builder: &mut Builder,
    clause: &Clause,
    activity: &Activity,
    parts: &Parts,
    phase: &Phase,
) -> Option<Stay> {
    let is_stay =
        matches!(activity, Activity::Leave | Activity::Visit) && parts.lasts.is_none() && parts.until.is_none();
    let words = builder.said(clause.verb_span).to_lowercase();
    let is_state = ["is ", "are ", "stays", "stay"].iter().any(|state| words.starts_with(state));
    let when = match parts.when.as_ref().map(|slot| &slot.value[..]) {
        Some([Said::At(time)]) if !time.clock.open => HabitTime::At(Fuzzy::around(time.clock.s, time.spread_s)),
        None if parts.part.is_none() => HabitTime::At(SETS_OUT_S),
        _ => return None,
    };
    if !is_stay || !is_state && words.contains("walk") {
        return None;
    }
    let is_often = parts.chance.is_some() || parts.every.is_some() || parts.weekdays.is_some();
    if let Some(days) = &parts.for_days {
        let lasts = Fuzzy::exactly(days.value * DAY_S);
        return match phase.from {
            // So often within these days.
            Some(_) if is_often => None,
            Some(_) if !is_state && parts.when.is_some() => {
                let state = if *activity == Activity::Visit { "stays" } else { "is out" }.to_owned();
                let message = TimeSentenceMessage::StayOrEachDay { state, days: builder.said(days.span) };
                builder.fault(days.span, message);
                None
            }
            Some(from) => {
                let until = Some(calendar::later(from, 1));
                Some(Stay { when, phase: Phase { from: Some(from), until, ..Phase::default() }, lasts })
            }
            None if is_often => Some(Stay { when, phase: Phase { until: None, ..*phase }, lasts }),
            None => {
                let help = format!("write \"from day 30, {}, she {words}\"", builder.said(days.span));
                builder.fault(days.span, TimeSentenceMessage::NoBeginning { help });
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
    let days = days_between(from, until, builder.context.first_date).filter(|&days| days > 1)?;
    let begins_s = match &when {
        HabitTime::At(at) => at.mean(),
        _ => SETS_OUT_S.mean(),
    };
    let lasts = Fuzzy::exactly(((days - 1) as f64 * DAY_S + COMES_BACK_S - begins_s).max(3600.0));
    let phase = Phase { from: Some(from), until: Some(calendar::later(from, 1)), ..Phase::default() };
    Some(Stay { when, phase, lasts })
}
