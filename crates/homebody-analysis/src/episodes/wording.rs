use super::signs::Sign;
use crate::measures::{DailyMeasure, Earlier, ValueForm};
use crate::phrases::listed;
use jiff::civil::Date;

/// Number of signs in the sentence about an episode (our choice).
const IN_A_SENTENCE: usize = 4;

/// A date such as `16 April`.
pub(super) fn day_and_month(date: Date) -> String {
    date.strftime("%-d %B").to_string()
}

/// An episode in a sentence, without a full stop.
pub(super) fn episode_words(since: Date, over: Option<Date>, signs: &[Sign]) -> String {
    let span = match over {
        None => format!("Since about {}", day_and_month(since)),
        Some(over) => {
            format!("From about {} to {}", day_and_month(since), day_and_month(over.yesterday().unwrap_or(over)))
        }
    };
    let words: Vec<&str> = signs.iter().take(IN_A_SENTENCE).map(|sign| sign.words.as_str()).collect();
    if words.is_empty() {
        return format!("{span}: several measures are slightly different from before");
    }
    format!("{span}: {}", listed(&words))
}

/// Differences from one hour on are in hours.
const MINUTES_AN_HOUR: f64 = 60.0;

impl DailyMeasure {
    /// ` a day` or ` a night`, unless the words say when.
    fn per_occasion(&self, words: &str) -> String {
        let is_said = words.ends_with("by day") || words.ends_with("at night");
        if is_said { String::new() } else { format!(" a {}", self.occasion) }
    }

    /// A difference from the usual value in words, and both values.
    pub(super) fn sign_words(&self, value: f64, usual: f64) -> (String, String) {
        let by = value - usual;
        let changed = self.changed(by > 0.0);
        let words = match self.unit.form {
            ValueForm::Clock => {
                let direction = if by > 0.0 { "later" } else { "earlier" };
                format!("{} {} {direction}", self.noun(), amount(by))
            }
            ValueForm::Hours => format!("{} {changed}", amount(by)),
            ValueForm::Times if usual.abs() < MOST_COUNTED => {
                format!("{:.1} {changed}{}", by.abs(), self.per_occasion(changed))
            }
            _ if usual > 0.0 => format!("{changed} by {:.0} %", (by / usual * 100.0).abs()),
            _ => changed.to_owned(),
        };
        (words, self.compared(value, Earlier::Usual(usual), true))
    }
}

/// Largest usual count of a day whose difference is a number; differences of larger counts are shares.
const MOST_COUNTED: f64 = 20.0;

/// A number of hours, as `47 min` or `1.5 h`.
fn amount(hours: f64) -> String {
    let minutes = (hours.abs() * MINUTES_AN_HOUR).round();
    if minutes < MINUTES_AN_HOUR { format!("{minutes:.0} min") } else { format!("{:.1} h", hours.abs()) }
}
