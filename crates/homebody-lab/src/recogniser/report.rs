use super::{RecogniserExperiment, Score};
use homebody::shared::TextTable;
use std::fmt;

impl fmt::Display for RecogniserExperiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let RecogniserExperiment { simulated_days, real_days: [first, second], cases, .. } = self;
        writeln!(
            f,
            "Activities in windows of 5 minutes, recognised on the last {second} of {} real days; {} seeds, {simulated_days} \
             simulated days each\n",
            first + second,
            cases.len()
        )?;
        let table = TextTable::new("-32 learnt from|8 macro F1|7 spread|8 of real");
        f.write_str(&table.heading())?;
        for Score { learnt_from, macro_f1, spread, of_real, .. } in &self.scores {
            let [macro_f1, spread] = [macro_f1, spread].map(|value| format!("{value:.3}"));
            f.write_str(&table.row(&[learnt_from, &macro_f1, &spread, &format!("{:.0} %", of_real * 100.0)]))?;
        }
        writeln!(f, "\nF1 by class")?;
        let classes = || self.classes.iter().map(|class| short(class).to_owned());
        write_row(f, "learnt from", classes())?;
        for Score { learnt_from, f1, .. } in &self.scores {
            write_row(f, learnt_from, f1.iter().map(|f1| format!("{f1:.2}")))?;
        }
        for score in self.scores.iter().take(2) {
            writeln!(f, "\nWhat windows were taken for, learnt from {}", score.learnt_from)?;
            write_row(f, "are", classes())?;
            for (class, row) in self.classes.iter().zip(&score.confusion) {
                write_row(f, class, row.iter().map(|count| format!("{count:.1}")))?;
            }
        }
        writeln!(f, "\nThe routine, written from the first {first} days\n\n{}", self.routine.trim_end())
    }
}

fn write_row(f: &mut fmt::Formatter, name: &str, cells: impl Iterator<Item = String>) -> fmt::Result {
    write!(f, "{name:<32}")?;
    cells.into_iter().try_for_each(|cell| write!(f, " {cell:>9}"))?;
    writeln!(f)
}

/// The part of a name that fits into a column.
fn short(class: &str) -> &str {
    class.get(..9).unwrap_or(class)
}
