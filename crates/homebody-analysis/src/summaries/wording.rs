use super::sentence::SummarySubject;
use super::set::Set;
use crate::dates::clock_of_hours;
use crate::measures::DailyMeasure;
use crate::phrases::often;
use homebody_core::fuzzy::Quantifier;
use homebody_core::names::capitalised;

impl DailyMeasure {
    /// A sentence of a summary without its full stop: how the measure was on so many days, or how it changed.
    pub(super) fn summary_words(&self, quantifier: Quantifier, set: Set, about: SummarySubject, days: usize) -> String {
        let on = on(quantifier, self.occasion, days);
        let how = match set {
            Set::Beyond { is_more, .. } => return format!("{} than before {on}", capitalised(self.changed(is_more))),
            Set::Exactly(0) => self.did_not.to_owned(),
            Set::Exactly(times) => self.did.replace("{}", &often(times.into())),
            Set::AtLeast(times) => self.did.replace("{}", &format!("at least {}", often(times.into()))),
            Set::Between(from, to) if self.is_clock() => {
                self.did.replace("{}", &format!("between {} and {}", clock_of_hours(from), clock_of_hours(to)))
            }
            Set::Between(from, to) => {
                let from = if from == 0.0 { "at most".to_owned() } else { format!("{from} to") };
                self.did.replace("{}", &format!("for {from} {to} hour{}", if to == 1.0 { "" } else { "s" }))
            }
        };
        format!("{} {how} {on}", capitalised(about.subject))
    }
}

fn on(quantifier: Quantifier, occasion: &str, days: usize) -> String {
    let many = match quantifier {
        Quantifier::Every => "every",
        Quantifier::AlmostAlways => "nearly all",
        Quantifier::Most => "most",
        Quantifier::Often => "many",
        Quantifier::AboutHalf => "about half of the",
        Quantifier::Sometimes => "some",
        Quantifier::Rarely => "few",
        Quantifier::AlmostNever => "hardly any",
    };
    let plural = if quantifier == Quantifier::Every { "" } else { "s" };
    let span = if days == 14 { "two weeks".to_owned() } else { format!("{days} days") };
    format!("on {many} {occasion}{plural} of the last {span}")
}
