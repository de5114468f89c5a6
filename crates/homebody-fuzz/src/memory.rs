//! How much memory a case takes: the larger of what our own allocator counts and of what the process grows by, which C libraries
//! add to.

use peak_alloc::PeakAlloc;
use std::fs;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// The memory from here on.
pub struct Memory {
    allocated: usize,
    /// None where the system does not tell.
    resident: Option<usize>,
}

impl Memory {
    /// Begins to count.
    pub fn begin() -> Memory {
        ALLOCATOR.reset_peak_usage();
        // On Linux, this sets back the most that has been resident.
        let _ = fs::write("/proc/self/clear_refs", "5");
        Memory { allocated: ALLOCATOR.current_usage(), resident: status("VmRSS:") }
    }

    /// The most at any time since then beyond what there was, in bytes.
    pub fn peak_bytes(&self) -> usize {
        let resident = self.resident.zip(status("VmHWM:")).map_or(0, |(before, peak)| peak.saturating_sub(before));
        ALLOCATOR.peak_usage().saturating_sub(self.allocated).max(resident)
    }

    /// What there is now beyond what there was, in bytes.
    pub fn now_bytes(&self) -> usize {
        let resident = self.resident.zip(status("VmRSS:")).map_or(0, |(before, now)| now.saturating_sub(before));
        ALLOCATOR.current_usage().saturating_sub(self.allocated).max(resident)
    }
}

/// A figure that Linux tells of this process, in bytes.
fn status(key: &str) -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(key))?;
    Some(line.split_whitespace().next()?.parse::<usize>().ok()? << 10)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_taken_and_given_back_is_counted() {
        let memory = Memory::begin();
        drop(vec![1_u8; 64 << 20]);
        assert!(memory.peak_bytes() >= 64 << 20);
        assert!(memory.now_bytes() < 64 << 20);
    }
}
