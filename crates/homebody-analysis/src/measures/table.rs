use super::registry::MEASURES;
use super::values::{Measures, SilentSensor};
use crate::phrases::write_remarks;
use homebody_core::problem::counted;
use homebody_core::statistics::quantile;
use std::fmt;
use std::fmt::Write;

impl Measures {
    /// A row for each day, a column for each measure: `date,time_in_bed,...`; unknown values are empty.
    pub fn csv(&self) -> String {
        let names: Vec<&str> = MEASURES.iter().map(|measure| measure.name).collect();
        let mut text = format!("date,{}\n", names.join(","));
        for day in &self.days {
            let values = day.values.iter().map(|value| value.map_or_else(String::new, |value| format!("{value:.4}")));
            let _ = writeln!(text, "{},{}", day.date, values.collect::<Vec<_>>().join(","));
        }
        text
    }

    pub fn known(&self, measure: usize) -> Vec<f64> {
        self.days.iter().filter_map(|day| day.values[measure]).collect()
    }
}

impl fmt::Display for Measures {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        const LAST: usize = 7;
        let whole = self.days.iter().filter(|day| day.is_whole).count();
        let (first, last) = match (self.days.first(), self.days.last()) {
            (Some(first), Some(last)) => (first.date, last.date),
            _ => return writeln!(f, "{}: no days", self.name),
        };
        let days = counted(self.days.len(), "day", "days");
        writeln!(f, "{}: {days} from {first} to {last}, {whole} of them complete\n", self.name)?;
        writeln!(
            f,
            "  {:24}{:10}{:>6}{:>9}{:>9}{:>9}   last days",
            "measure", "unit", "days", "10 %", "median", "90 %"
        )?;
        for (number, measure) in MEASURES.iter().enumerate() {
            let known = self.known(number);
            let recent: Vec<String> = self.days[self.days.len().saturating_sub(LAST)..]
                .iter()
                .map(|day| day.values[number].map_or("-".to_owned(), |value| format!("{value:.1}")))
                .collect();
            write!(f, "  {:24}{:10}{:>6}", measure.name, measure.unit, known.len())?;
            if known.is_empty() {
                writeln!(f)?;
                continue;
            }
            for value in [0.1, 0.5, 0.9].iter().filter_map(|share| quantile(&known, *share)) {
                write!(f, "{value:>9.2}")?;
            }
            writeln!(f, "   {}", recent.join("  "))?;
        }
        for (_, words) in SilentSensor::sentences(&self.silent) {
            writeln!(f, "\n{words}; measures that need it have no value for that time.")?;
        }
        if !self.noted.is_empty() {
            writeln!(f)?;
        }
        self.noted.iter().try_for_each(|noted| writeln!(f, "{noted}"))?;
        write_remarks(f, &self.remarks)
    }
}
