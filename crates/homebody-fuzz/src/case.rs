//! One case: run in a folder of its own, with limits on its time and memory.

use crate::target::{CaseFiles, ReadVerdict, Target};
use peak_alloc::PeakAlloc;
use std::panic::{self, AssertUnwindSafe};
use std::sync::{Mutex, Once, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, process, thread};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Largest time and memory of a case in an optimised build (our choice).
const LONGEST: Duration = Duration::from_secs(1);
const MOST_BYTES: usize = 256 << 20;

/// Memory above which the process ends at once, to protect the machine (our choice).
const GREATEST_BYTES: usize = 1 << 30;

/// The exit code of a process whose case takes too much memory.
pub const GREEDY: i32 = 86;

static PANICS: Mutex<Vec<String>> = Mutex::new(Vec::new());

fn panics() -> std::sync::MutexGuard<'static, Vec<String>> {
    PANICS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs a case. With `is_measured`, too much time or memory fails, if it recurs: other processes may have delayed the first run.
///
/// # Errors
///
/// A panic of any thread, an invariant that does not hold, or a limit that is exceeded.
pub fn run(target: &Target, files: &CaseFiles, is_measured: bool) -> Result<ReadVerdict, String> {
    static GUARDED: Once = Once::new();
    GUARDED.call_once(guard);
    let (verdict, excess) = measured(target, files)?;
    match excess.filter(|_| is_measured) {
        Some(_) => match measured(target, files)? {
            (_, Some(excess)) => Err(excess),
            (verdict, None) => Ok(verdict),
        },
        None => Ok(verdict),
    }
}

fn guard() {
    panic::set_hook(Box::new(|panic| panics().push(panic.to_string())));
    thread::spawn(|| {
        let begin = Memory::begin();
        while begin.bytes("VmRSS:", ALLOCATOR.current_usage()) < GREATEST_BYTES {
            thread::sleep(Duration::from_millis(5));
        }
        process::exit(GREEDY);
    });
}

/// The verdict on a case, and the limit that it exceeded.
fn measured(target: &Target, files: &CaseFiles) -> Result<(ReadVerdict, Option<String>), String> {
    let folder = tempfile::tempdir().map_err(|error| {
        format!("no folder for temporary files: {error}\n  hint: let TMPDIR name a folder that can be written")
    })?;
    panics().clear();
    let (memory, begun) = (Memory::begin(), Instant::now());
    let result = panic::catch_unwind(AssertUnwindSafe(|| (target.run)(files, folder.path())));
    let (took, bytes) = (begun.elapsed(), memory.bytes("VmHWM:", ALLOCATOR.peak_usage()));
    if let Some(panic) = panics().first() {
        return Err(panic.clone());
    }
    let verdict = result.unwrap_or_else(|_| Err("a panic without a message".into()))?;
    let is_within = took <= LONGEST && bytes <= MOST_BYTES;
    Ok((verdict, (!is_within).then(|| format!("{:.1} s, {} MiB", took.as_secs_f64(), bytes >> 20))))
}

/// Linux also counts the memory of C libraries, which the allocator does not know.
struct Memory {
    allocated: usize,
    resident: Option<usize>,
}

impl Memory {
    fn begin() -> Memory {
        ALLOCATOR.reset_peak_usage();
        // On Linux, this resets the peak.
        let _ = fs::write("/proc/self/clear_refs", "5");
        Memory { allocated: ALLOCATOR.current_usage(), resident: status("VmRSS:") }
    }

    /// Growth in bytes since the beginning, by a key of Linux's status or by the allocator.
    fn bytes(&self, key: &str, allocated: usize) -> usize {
        let resident = self.resident.zip(status(key)).map_or(0, |(before, now)| now.saturating_sub(before));
        allocated.saturating_sub(self.allocated).max(resident)
    }
}

/// A figure from Linux's status of this process, in bytes.
fn status(key: &str) -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(key))?;
    Some(line.split_whitespace().next()?.parse::<usize>().ok()? << 10)
}
