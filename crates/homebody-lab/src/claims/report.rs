use super::measure::ClaimMeasure;
use super::subject::Range;
use super::text::Beside;
use super::{ClaimsExperiment, ConditionsExperiment, Verdict};
use homebody::shared::TextTable;
use std::fmt;

impl ClaimMeasure {
    pub fn is_of_nights(&self) -> bool {
        matches!(self, Self::OnDays { nights: true, .. } | Self::TimesADay { nights: true, .. })
    }

    /// A value of this measure, with its unit.
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
            Self::BeginsOnAverage(_) if beside == Beside::MoreThanTwin => format!("{value:.0} min later"),
            Self::BeginsOnAverage(_) => clock(value),
            Self::OnDays { nights: true, .. } => format!("{:.1} % of nights", value * 100.0),
            Self::OnDays { .. } => format!("{:.1} % of days", value * 100.0),
            Self::DaysAWeek(_) => format!("{:.0} % of weeks", value * 100.0),
            Self::Begins(_) | Self::Ends(_) | Self::After(..) | Self::Before(..) | Self::With(..) | Self::Mostly(_) => {
                format!("{:.0} % of times", value * 100.0)
            }
            Self::In(_) => format!("{:.0} % of the time", value * 100.0),
            Self::Times(_) => format!("{} times", plain(value)),
            Self::TimesADay { nights: true, .. } => format!("{} a night", plain(value)),
            Self::TimesADay { .. } => format!("{} a day", plain(value)),
            Self::Spread(_) | Self::Lasts(_) | Self::Longest(_) => length(value),
            Self::Minutes(_) => format!("{} a day", length(value)),
            Self::Is(_) => plain(value),
        }
    }

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

impl fmt::Display for ClaimsExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let ClaimsExperiment { claims: rows, lived, told, neither, days, seed } = self;
        let claims = rows.len();
        writeln!(
            f,
            "{claims} claims of what sentences come to, over {days} days where a case says no other (seed {seed})"
        )?;
        let table = TextTable::new("-34 form|7 claims|6 lived|5 told|8 neither");
        write!(f, "\n  {}", table.heading())?;
        for group in rows.chunk_by(|a, b| a.form == b.form) {
            let of = |verdict: Verdict| group.iter().filter(|row| row.verdict == verdict).count();
            let (lived, told, neither) = (of(Verdict::Lived), of(Verdict::Told), of(Verdict::Neither));
            let form = group.first().map_or("", |row| row.form.as_str());
            write!(f, "  {}", table.row(&[&form, &group.len(), &lived, &told, &neither]))?;
        }
        write!(f, "  {}", table.row(&[&"all", &claims, lived, told, neither]))?;
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
impl fmt::Display for ConditionsExperiment {
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
