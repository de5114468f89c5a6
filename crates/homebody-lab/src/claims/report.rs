//! The table: a line for each claim, what does not hold first.

use super::measure::Measure;
use super::subject::Range;
use super::text::Beside;
use super::{Conditions, Experiment, Verdict};
use std::fmt;

impl Measure {
    pub fn is_of_nights(&self) -> bool {
        matches!(self, Measure::OnDays { nights: true, .. } | Measure::TimesADay { nights: true, .. })
    }

    /// A number of this measure, in its unit.
    pub fn value_in_words(&self, value: f64, beside: Beside) -> String {
        if value.is_nan() {
            return "never".to_owned();
        }
        let plain = |value: f64| match value.abs() {
            large if large >= 100.0 => format!("{value:.0}"),
            large if large >= 10.0 => format!("{value:.1}"),
            _ => format!("{value:.2}"),
        };
        match self {
            _ if beside == Beside::ShareOfTwin => format!("{value:.2} times the twin's"),
            Measure::BeginsOnAverage(_) if beside == Beside::MoreThanTwin => format!("{value:.0} min later"),
            Measure::BeginsOnAverage(_) => clock(value),
            Measure::OnDays { nights: true, .. } => format!("{:.1} % of nights", value * 100.0),
            Measure::OnDays { .. } => format!("{:.1} % of days", value * 100.0),
            Measure::DaysAWeek(_) => format!("{:.0} % of weeks", value * 100.0),
            Measure::Begins(_)
            | Measure::Ends(_)
            | Measure::After(..)
            | Measure::Before(..)
            | Measure::With(..)
            | Measure::Mostly(_) => format!("{:.0} % of times", value * 100.0),
            Measure::In(_) => format!("{:.0} % of the time", value * 100.0),
            Measure::Times(_) => format!("{} times", plain(value)),
            Measure::TimesADay { nights: true, .. } => format!("{} a night", plain(value)),
            Measure::TimesADay { .. } => format!("{} a day", plain(value)),
            Measure::Spread(_) | Measure::Lasts(_) | Measure::Longest(_) => length(value),
            Measure::Minutes(_) => format!("{} a day", length(value)),
            Measure::Is(_) => plain(value),
        }
    }

    /// The bounds in words.
    pub fn in_words(&self, (low, high): Range, beside: Beside) -> String {
        match low == high {
            true => self.value_in_words(low, beside),
            false => format!("{} to {}", self.value_in_words(low, beside), self.value_in_words(high, beside)),
        }
    }
}

fn clock(minutes: f64) -> String {
    let whole = minutes.rem_euclid(1440.0) as u32;
    format!("{:02}:{:02}", whole / 60, whole % 60)
}

fn length(minutes: f64) -> String {
    match minutes.abs() {
        long if long >= 2880.0 => format!("{:.1} days", minutes / 1440.0),
        long if long >= 180.0 => format!("{:.1} h", minutes / 60.0),
        _ => format!("{minutes:.1} min"),
    }
}

impl fmt::Display for Experiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Experiment { claims: rows, lived, told, neither, days, seed } = self;
        let claims = rows.len();
        writeln!(
            f,
            "{claims} claims of what sentences come to, over {days} days where a case says no other (seed {seed})"
        )?;
        writeln!(f, "\n  {:<34} {:>7} {:>6} {:>5} {:>8}", "form", "claims", "lived", "told", "neither")?;
        for group in rows.chunk_by(|a, b| a.form == b.form) {
            let of = |verdict: Verdict| group.iter().filter(|row| row.verdict == verdict).count();
            let (lived, told, neither) = (of(Verdict::Lived), of(Verdict::Told), of(Verdict::Neither));
            let form = group.first().map_or("", |row| row.form.as_str());
            writeln!(f, "  {form:<34} {:>7} {lived:>6} {told:>5} {neither:>8}", group.len())?;
        }
        writeln!(f, "  {:<34} {claims:>7} {lived:>6} {told:>5} {neither:>8}", "all")?;
        for (verdict, title) in [(Verdict::Told, "Told before the run:"), (Verdict::Neither, "Neither lived nor told:")]
        {
            let mut of = rows.iter().filter(|row| row.verdict == verdict).peekable();
            if of.peek().is_some() {
                writeln!(f, "\n{title}\n")?;
            }
            for row in of {
                let measured = row.measured.lines().next().unwrap_or_default();
                writeln!(f, "  line {}: {}", row.line, row.text)?;
                writeln!(f, "    {}\n    expected: {}; measured: {measured}", row.claim, row.expected)?;
            }
        }
        Ok(())
    }
}

/// A table in Markdown.
impl fmt::Display for Conditions {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "| condition | what is measured | source | expected | measured |")?;
        writeln!(f, "|---|---|---|---|---|")?;
        for row in &self.conditions {
            let what = row.claim.split(": ").next().unwrap_or_default();
            let when = row
                .claim
                .split_once(" | ")
                .map_or(String::new(), |(_, when)| format!(", {}", when.replace(" | ", ", ")));
            let is_out = if row.verdict == Verdict::Lived { "" } else { " (not within)" };
            let (condition, source, expected) = (&row.form, &row.source, &row.expected);
            writeln!(f, "| {condition} | {what}{when} | {source} | {expected} | {}{is_out} |", row.measured)?;
        }
        writeln!(f, "\n{} of {} lie within (seed {}).", self.within, self.conditions.len(), self.seed)
    }
}
