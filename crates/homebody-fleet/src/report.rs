//! The reports of a fleet while it runs, and at its end.

use homebody_log::fleet::Lateness;
use serde::Serialize;
use std::fs;

/// A report on a fleet since the last report; the last one is on the whole time.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FleetReport {
    pub time: String,
    /// The time since the start of delivery, in seconds.
    pub running_s: f64,
    /// The time that the report covers, in seconds.
    pub span_s: f64,
    /// True of the last report, which covers the whole time.
    pub is_last: bool,
    pub homes: usize,
    pub homes_in_all: usize,
    /// The number of connections of homes since the start.
    pub came: u64,
    /// The number of disconnections of homes since the start.
    pub went: u64,
    /// Homes whose simulation ended, because a driver failed.
    pub failed: usize,
    /// Messages that the destinations have accepted, summed over destinations.
    pub messages: u64,
    pub messages_per_s: f64,
    /// The messages among them that were due in this time: their lateness is measured.
    pub timed: u64,
    /// The median lateness in milliseconds: the time from when a message was due until its destination had it.
    pub late_median_ms: f64,
    pub late_99_ms: f64,
    pub late_most_ms: f64,
    /// The age of the oldest message that is overdue, in seconds.
    pub behind_s: f64,
    /// Messages that are due and not delivered yet.
    pub waiting: usize,
    /// The lead of the simulation of all homes, in seconds: below 0, messages are late because of it.
    pub ahead_s: f64,
    /// The number of outages since the start.
    pub storms: u64,
    /// True during an outage of all homes.
    pub is_away: bool,
    /// The number of retried calls to destinations since the start.
    pub retries: u64,
    /// The memory of this program, in megabytes; `None` on systems without this figure.
    pub memory_mb: Option<f64>,
    /// The processor time of this program; 1 is one whole processor.
    pub processors: Option<f64>,
    pub destinations: Vec<DestinationReport>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DestinationReport {
    pub place: String,
    pub messages: u64,
    pub late_median_ms: f64,
    pub late_99_ms: f64,
    pub late_most_ms: f64,
    /// Messages that are due and not delivered yet.
    pub waiting: usize,
    /// The number of retried calls since the start.
    pub retries: u64,
    pub is_away: bool,
}

/// Median, 99 % and most, in milliseconds.
pub(super) fn late_ms(lateness: &Lateness) -> [f64; 3] {
    [lateness.quantile_us(0.5), lateness.quantile_us(0.99), lateness.most_us()].map(|us| us as f64 / 1000.0)
}

/// The memory of this program in megabytes.
pub(super) fn memory_mb() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()? * 1024.0 / 1e6)
}

/// The processor time of this program so far, in seconds.
pub(super) fn processor_s() -> Option<f64> {
    /// Units of processor time, the same on every system with this file.
    const TICKS_PER_S: f64 = 100.0;
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in parentheses, may have spaces in it.
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let [user, system] = [fields.get(11)?, fields.get(12)?].map(|ticks| ticks.parse::<f64>().ok());
    Some((user? + system?) / TICKS_PER_S)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_os = "linux")]
    fn reads_memory_and_processor_time() {
        let memory = memory_mb().unwrap();
        // Other tests of this program take and give back some memory meanwhile.
        let more: Vec<u8> = vec![1; 500_000_000];
        let after = memory_mb().unwrap();
        assert!(more[499_999_999] == 1 && after - memory > 250.0, "{memory} and then {after}");
        let (before, begun) = (processor_s().unwrap(), std::time::Instant::now());
        while processor_s().unwrap() < before + 0.05 {
            assert!(begun.elapsed().as_secs() < 30, "the processor time does not grow");
        }
    }
}
