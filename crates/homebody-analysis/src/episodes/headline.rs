//! One sentence about the state of a resident.

use super::change::{ChangeEpisode, DaysAway};
use super::reference::{LEAST_DAYS, REFERENCE_DAYS, ReferenceDays};
use super::wording;
use crate::measures::{DayMeasures, Measures};
use crate::phrases::in_full;
use homebody_core::problem::counted;
use jiff::civil::Date;
use serde::Serialize;

/// Age of an old episode, in days (our choice): younger ones need a look.
const NEW_DAYS: i32 = 7;
/// Days without a whole day after which nothing is known of the present (our choice).
const OLD_DAYS: usize = 3;

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct Headline {
    pub state: HeadlineState,
    /// A sentence, without a full stop.
    pub words: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum HeadlineState {
    /// An episode is new.
    LookToday,
    /// An episode lasts.
    Changed,
    /// Too little is known to say more.
    NotKnown,
    /// The days are as usual.
    AsUsual,
}

impl Headline {
    pub(super) fn new(
        measures: &Measures,
        reference: Option<&ReferenceDays>,
        episodes: &[ChangeEpisode],
        away: &[DaysAway],
    ) -> Headline {
        let headline = |state, words: String| Headline { state, words };
        let days = &measures.days;
        let Some(last) = days.iter().rposition(DayMeasures::counts) else {
            return headline(HeadlineState::NotKnown, "No complete day is known yet".to_owned());
        };
        let today = days[days.len() - 1].date;
        if let Some(open) = episodes.iter().rfind(|episode| episode.over.is_none()) {
            let is_new = open.found.until(today).is_ok_and(|span| span.get_days() < NEW_DAYS);
            let state = if is_new { HeadlineState::LookToday } else { HeadlineState::Changed };
            return headline(state, open.words.clone());
        }
        if let Some(away) = away.last().filter(|away| away.to == today) {
            return headline(HeadlineState::NotKnown, format!("Away since {}", in_full(away.from)));
        }
        if days.len() - 1 - last >= OLD_DAYS {
            return headline(HeadlineState::NotKnown, format!("No complete day since {}", in_full(days[last].date)));
        }
        let known = reference.map_or(0, |reference| reference.days);
        match known {
            0..LEAST_DAYS => headline(
                HeadlineState::NotKnown,
                format!(
                    "The usual days are not known yet: {} of {LEAST_DAYS} that are needed",
                    counted(known, "complete day", "complete days")
                ),
            ),
            LEAST_DAYS..REFERENCE_DAYS => headline(
                HeadlineState::AsUsual,
                format!(
                    "As usual, as far as {} show: only large changes can be seen before {REFERENCE_DAYS} days",
                    counted(known, "complete day", "complete days")
                ),
            ),
            _ => headline(HeadlineState::AsUsual, format!("As usual{}", since_over(episodes, today))),
        }
    }
}

/// The end of the last episode, if it is recent.
fn since_over(episodes: &[ChangeEpisode], today: Date) -> String {
    let over = episodes.iter().filter_map(|episode| episode.over).max();
    let is_recent = |over: &Date| over.until(today).is_ok_and(|span| span.get_days() < 4 * NEW_DAYS);
    over.filter(is_recent).map_or(String::new(), |over| format!(" again since {}", wording::day_and_month(over)))
}
