use super::{LogSummary, Realism, TellingFigure};
use std::fmt;

impl fmt::Display for Realism {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (letter, LogSummary { name, days, motion_sensors, firings_a_day, .. }) in [("A", &self.a), ("B", &self.b)] {
            writeln!(
                f,
                "{letter}  {name}: {days} days, {motion_sensors} motion sensors, {firings_a_day:.0} firings a day"
            )?;
        }
        writeln!(f, "\n{:16}  {:>6}  {:>6}  what", "measure", "value", "floor")?;
        let shown = |value: Option<f64>| value.map_or("-".into(), |value| format!("{value:.3}"));
        for (name, what, measure) in self.measures() {
            let each = match measure.of {
                Some([a, b]) => format!(": A {}, B {}", shown(a), shown(b)),
                None => String::new(),
            };
            writeln!(f, "{name:16}  {:>6}  {:>6}  {what}{each}", shown(measure.value), shown(measure.floor))?;
        }
        for (what, signs) in [("Days", &self.days_told_by), ("Hours", &self.hours_told_by)] {
            told_by(f, what, signs)?;
        }
        write!(f, "\n{MEASURES}")
    }
}

fn told_by(f: &mut fmt::Formatter, what: &str, signs: &[TellingFigure]) -> fmt::Result {
    if signs.is_empty() {
        return Ok(());
    }
    writeln!(f, "\n{what} are told apart by  (part, median of A, of B)")?;
    for TellingFigure { figure, part, medians: [a, b] } in signs {
        writeln!(f, "  {:>4.1} %  {a:>9.2}  {b:>9.2}  {figure}", part * 100.0)?;
    }
    Ok(())
}

/// The measures, for readers.
pub const MEASURES: &str = "\
value  Distance of B from A: 0 means equal, 1 means disjoint (density maps have another scale). KS is the
       Kolmogorov-Smirnov distance, JS the Jensen-Shannon distance. An area under the curve of 0.5 means that
       telling A from B is guessing.
floor  The distance between the two halves of A's days.
-      Not available: sensor names differ, ONs have no end, or there are too few days (a forest needs 4 on each
       log to separate days, and 2 to separate hours).
";
