//! An episode, with its signs and its course.

use super::signs::Sign;
use crate::phrases::{in_full, listed};
use homebody_core::names::capitalised;
use jiff::civil::Date;
use serde::Serialize;
use std::fmt;

/// Signs that moved together.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct ChangeEpisode {
    /// The estimated first day.
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub since: Date,
    /// The day after whose end it was found.
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub found: Date,
    /// The days after whose end it was known to have become worse.
    #[cfg_attr(feature = "wire", ts(type = "string[]"))]
    pub worse: Vec<Date>,
    /// The first day that was as usual again; `None` while it lasts.
    #[cfg_attr(feature = "wire", ts(type = "string | null"))]
    pub over: Option<Date>,
    pub course: Course,
    /// The strongest first.
    pub signs: Vec<Sign>,
    /// Conditions that make such signs in simulated people, the likeliest first.
    pub seen_with: Vec<SeenWith>,
    /// The signs in a sentence, without a full stop.
    pub words: String,
}

/// The strength of the signs now, compared with their strongest weeks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum Course {
    Growing,
    Steady,
    Easing,
    Over,
}

/// A condition that makes such signs.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct SeenWith {
    pub condition: String,
    pub likelihood_ratio: f64,
}

/// Whole days on which the home was empty for most of the day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct DaysAway {
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub from: Date,
    #[cfg_attr(feature = "wire", ts(type = "string"))]
    pub to: Date,
}

impl DaysAway {
    pub fn words(&self) -> String {
        match self.from == self.to {
            true => format!("Away on {}", in_full(self.from)),
            false => format!("Away from {} to {}", in_full(self.from), in_full(self.to)),
        }
    }
}

impl fmt::Display for ChangeEpisode {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let worse = self.worse.last().map_or(String::new(), |date| format!(", stronger since {}", in_full(*date)));
        writeln!(f, "{}. Found on {}{worse}, {}.", self.words, in_full(self.found), self.course.words())?;
        for sign in &self.signs {
            let direction = if sign.numbers.is_empty() { String::new() } else { format!(": {}", sign.numbers) };
            writeln!(f, "  {}{direction} ({} days show it)", capitalised(&sign.words), sign.shown_by.len())?;
        }
        if !self.seen_with.is_empty() {
            let with: Vec<String> = self.seen_with.iter().map(SeenWith::to_string).collect();
            writeln!(f, "  Seen with {} in simulated people. Ask.", listed(&with))?;
        }
        Ok(())
    }
}

impl fmt::Display for SeenWith {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} (likelihood ratio {:.1})", self.condition.replace('-', " "), self.likelihood_ratio)
    }
}

impl Course {
    fn words(self) -> &'static str {
        match self {
            Course::Growing => "still growing",
            Course::Steady => "still so",
            Course::Easing => "easing",
            Course::Over => "over",
        }
    }
}
