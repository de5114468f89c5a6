//! What became of all targets, for people.

use crate::supervise::Outcome;
use crate::target::Target;
use std::fmt;

/// The outcomes of targets, in their order.
pub struct Table(pub Vec<(Target, Outcome)>);

impl Table {
    /// How many cases failed.
    pub fn failures(&self) -> usize {
        self.0.iter().map(|(_, outcome)| outcome.findings.len()).sum()
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(
            f,
            "{:<10} {:>7} {:>8} {:>8} {:>7} {:>20} {:>20}",
            "target", "cases", "accepted", "refused", "failed", "slowest", "peak memory"
        )?;
        for (target, outcome) in &self.0 {
            let Outcome { cases, accepted, refused, slowest, largest, findings } = outcome;
            let slowest = format!("{:.2} s (#{})", slowest.0.as_secs_f64(), slowest.1);
            let largest = format!("{} MiB (#{})", largest.0.div_ceil(1 << 20), largest.1);
            let failed = findings.len();
            writeln!(
                f,
                "{:<10} {cases:>7} {accepted:>8} {refused:>8} {failed:>7} {slowest:>20} {largest:>20}",
                target.name
            )?;
        }
        Ok(())
    }
}
