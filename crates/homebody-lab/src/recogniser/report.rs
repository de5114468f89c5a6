//! The experiment in words.

use super::Experiment;
use std::fmt;

impl fmt::Display for Experiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Experiment { simulated_days, real_days: [first, second], cases, .. } = self;
        writeln!(
            f,
            "Activities in windows of 5 minutes, recognised on the last {second} of {} real days; {} seeds, {simulated_days} \
             simulated days each\n",
            first + second,
            cases.len()
        )?;
        writeln!(f, "{:<32} {:>8} {:>7} {:>8}", "learnt from", "macro F1", "spread", "of real")?;
        for score in &self.scores {
            let (name, part) = (score.learnt_from, format!("{:.0} %", score.of_real * 100.0));
            writeln!(f, "{name:<32} {:>8.3} {:>7.3} {part:>8}", score.macro_f1, score.spread)?;
        }
        writeln!(f, "\nF1 by class")?;
        write!(f, "{:<32}", "learnt from")?;
        self.classes.iter().try_for_each(|class| write!(f, " {:>9}", short(class)))?;
        writeln!(f)?;
        for score in &self.scores {
            write!(f, "{:<32}", score.learnt_from)?;
            score.f1.iter().try_for_each(|f1| write!(f, " {f1:>9.2}"))?;
            writeln!(f)?;
        }
        for score in self.scores.iter().take(2) {
            writeln!(f, "\nWhat windows were taken for, learnt from {}", score.learnt_from)?;
            write!(f, "{:<32}", "are")?;
            self.classes.iter().try_for_each(|class| write!(f, " {:>9}", short(class)))?;
            writeln!(f)?;
            for (class, row) in self.classes.iter().zip(&score.confusion) {
                write!(f, "{class:<32}")?;
                row.iter().try_for_each(|count| write!(f, " {count:>9.1}"))?;
                writeln!(f)?;
            }
        }
        writeln!(f, "\nThe routine, written from the first {first} days\n\n{}", self.routine.trim_end())
    }
}

/// As much of a name as a column has room for.
fn short(class: &str) -> &str {
    class.get(..9).unwrap_or(class)
}
