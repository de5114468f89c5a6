use super::measure::{DailyMeasure, ValueForm};
use crate::dates::clock_of_hours;
use crate::phrases::{count, hours, often};
use homebody_core::names::capitalised;

/// Difference of the pace, in percent, below which it is unchanged (our choice).
const SAME_PACE_PERCENT: f64 = 5.0;

#[derive(Clone, Copy)]
pub(crate) enum Earlier {
    Usual(f64),
    /// The mean before, of a change in a summary.
    Before(f64),
}

impl DailyMeasure {
    pub fn is_clock(&self) -> bool {
        self.unit.form == ValueForm::Clock
    }

    pub fn with_unit(&self, value: f64, decimals: usize) -> String {
        if self.is_clock() { clock_of_hours(value) } else { format!("{value:.decimals$} {}", self.unit) }
    }

    pub fn noun(&self) -> String {
        self.title.to_lowercase()
    }

    pub(crate) fn changed(&self, is_more: bool) -> &'static str {
        if is_more { self.more } else { self.less }
    }

    /// The values of a comparison, such as `2.8 a day on average, usually 3.6`; empty if no words fit.
    pub(crate) fn compared(&self, value: f64, earlier: Earlier, is_average: bool) -> String {
        let (other, word, than) = match earlier {
            Earlier::Usual(other) => (other, "usually", "usual"),
            Earlier::Before(other) => (other, "previously", "before"),
        };
        let said = if is_average { self.on_average(value) } else { self.said(value) };
        match (said, self.short(other)) {
            (Some(said), Some(other)) => format!("{said}, {word} {other}"),
            _ if other <= 0.0 => String::new(),
            _ => {
                format!("{:.0} % {} than {than}", (value / other - 1.0).abs() * 100.0, self.comparative(value > other))
            }
        }
    }

    /// A day in words, compared with the usual value, if that is known, and whether the day is more. `None` where only a usual value
    /// would give the value a meaning.
    pub(crate) fn day_words(&self, value: f64, usual: Option<(f64, Option<bool>)>) -> Option<String> {
        if self.did.is_empty() && !matches!(self.unit.form, ValueForm::OfUsual | ValueForm::MetresASecond) {
            return self.words_with_title(value, usual);
        }
        Some(self.words_with_subject(value, usual))
    }

    fn words_with_title(&self, value: f64, usual: Option<(f64, Option<bool>)>) -> Option<String> {
        let title = self.title;
        let beside = match (usual, usual.and_then(|(mean, is_more)| Some((mean, is_more?)))) {
            (None, _) => return self.said(value).map(|said| format!("{title}: {said}")),
            (Some(_), None) => "as usual".to_owned(),
            (Some(_), Some((mean, is_more))) => match self.short(mean) {
                Some(mean) => format!("{} than usual ({mean})", self.comparative(is_more)),
                None if mean > 0.0 => {
                    format!("{:.0} % {} than usual", (value / mean - 1.0).abs() * 100.0, self.comparative(is_more))
                }
                None => format!("{} than usual", self.comparative(is_more)),
            },
        };
        Some(match self.said(value) {
            Some(said) => format!("{title}: {said}, {beside}"),
            None => format!("{title}: {beside}"),
        })
    }

    fn words_with_subject(&self, value: f64, usual: Option<(f64, Option<bool>)>) -> String {
        let is_walk = matches!(self.unit.form, ValueForm::OfUsual | ValueForm::MetresASecond);
        match usual {
            Some((_, None)) if is_walk => "Walked at the usual pace".to_owned(),
            Some((mean, Some(is_more))) if is_walk => {
                format!("Walked {:.0} % {} than usual", (value / mean - 1.0).abs() * 100.0, self.comparative(is_more))
            }
            // It is relative to the whole log, so it has words before there is a usual value.
            None if self.unit.form == ValueForm::OfUsual => match ((value - 1.0).abs() * 100.0).round() {
                percent if percent < SAME_PACE_PERCENT => "Walked as fast as on most days".to_owned(),
                percent => format!("Walked {percent:.0} % {} than on most days", self.comparative(value > 1.0)),
            },
            None => self.this_day(value),
            Some((_, None)) => format!("{}, as usual", self.this_day(value)),
            Some((mean, Some(is_more))) => {
                let usual = self.short(mean).unwrap_or_default();
                format!("{}, {} than usual ({usual})", self.this_day(value), self.comparative(is_more))
            }
        }
    }

    fn this_day(&self, value: f64) -> String {
        let said = match self.unit.form {
            ValueForm::Hours => format!("for {}", hours(value)),
            ValueForm::MetresASecond => format!("at {value:.2} m/s"),
            _ => self.said(value).unwrap_or_default(),
        };
        let is_none = value < 0.05 && !self.did_not.is_empty();
        capitalised(&if is_none { self.did_not.to_owned() } else { self.did.replace("{}", &said) })
    }

    fn said(&self, value: f64) -> Option<String> {
        match self.unit.form {
            ValueForm::Hours => Some(hours(value)),
            ValueForm::Clock => Some(format!("at {}", clock_of_hours(value))),
            ValueForm::Times => Some(often(value)),
            ValueForm::MetresASecond => Some(format!("{value:.2} m/s")),
            ValueForm::OfUsual | ValueForm::Amount => None,
        }
    }

    /// An average on its own, such as `2.8 a day on average`.
    pub(crate) fn on_average(&self, value: f64) -> Option<String> {
        let said = match self.unit.form {
            ValueForm::Times => format!("{} a {}", count(value), self.occasion),
            _ => self.said(value)?,
        };
        Some(format!("{said} on average"))
    }

    /// A value without its unit, after another that has it.
    fn short(&self, value: f64) -> Option<String> {
        match self.unit.form {
            ValueForm::Hours => Some(format!("{value:.1}")),
            ValueForm::Clock => Some(clock_of_hours(value)),
            ValueForm::Times => Some(count(value)),
            ValueForm::MetresASecond => Some(format!("{value:.2}")),
            ValueForm::OfUsual | ValueForm::Amount => None,
        }
    }

    fn comparative(&self, is_more: bool) -> &'static str {
        match (self.unit.form, is_more) {
            (ValueForm::Clock, true) => "later",
            (ValueForm::Clock, false) => "earlier",
            (ValueForm::Times, true) => "more often",
            (ValueForm::Times, false) => "less often",
            (ValueForm::Hours, true) => "longer",
            (ValueForm::Hours, false) => "less",
            (ValueForm::OfUsual | ValueForm::MetresASecond, true) => "faster",
            (ValueForm::OfUsual | ValueForm::MetresASecond, false) => "more slowly",
            (ValueForm::Amount, true) => "higher",
            (ValueForm::Amount, false) => "lower",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::registry::MEASURES;
    use super::*;

    #[test]
    fn days_are_worded_by_their_unit() {
        let day =
            |name: &str, value, usual| DailyMeasure::named(name).unwrap().day_words(value, usual).unwrap_or_default();
        assert_eq!(day("time_out", 0.0, None), "Did not go out");
        assert_eq!(
            day("meals", 1.0, Some((2.8, Some(false)))),
            "Had a meal in the kitchen once, less often than usual (2.8)"
        );
        assert_eq!(day("rising", 9.0, Some((7.25, Some(true)))), "Got up at 09:00, later than usual (07:15)");
        assert_eq!(day("pace", 0.8, None), "Walked 20 % more slowly than on most days");
        assert_eq!(day("pace", 0.8, Some((1.0, None))), "Walked at the usual pace");
    }

    #[test]
    fn every_measure_has_words_for_more_and_less() {
        for measure in MEASURES {
            assert!(!measure.more.is_empty() && measure.more != measure.less, "{}", measure.name);
            assert_eq!(measure.did.is_empty(), !measure.did.contains("{}"), "{}", measure.name);
        }
    }
}
