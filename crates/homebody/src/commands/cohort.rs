//! Notes and results of a cohort.

use super::lived::{Output, go_on_in, speed_in_words};
use crate::failure::Failure;
use crate::print::{counted, grouped, not_written, print_json, print_text, tell};
use homebody_core::time::{DAY, Span};
use homebody_simulation::{Cohort, CohortSummary, LIST, TruthKept};
use serde_json::json;
use std::fs;
use std::path::Path;

/// Days, and members, of a cohort that the estimate of its output is made from (our choice). Members differ by a factor
/// of two.
const SAMPLE: Span = DAY.times(3);
const SAMPLE_MEMBERS: usize = 6;

/// Smallest ratio of a cohort to its sample for an estimate (our choice): a smaller cohort is simulated in less time.
const WORTH_A_SAMPLE: i64 = 10;

/// Homebody announces no smaller output (our choice).
const MUCH_BYTES: f64 = 1e8;

/// Announces the size of a cohort's output if it is large, and the truth tables that it leaves out by default.
pub fn foretell(cohort: &Cohort, is_asked: bool) {
    if cohort.kept() == TruthKept::Brief && !is_asked {
        tell(
            "note: a large cohort stores no truth tables cause, off, movement and lost: --truth-tables all stores them, and \
             homebody replay of a member's recording writes them",
        );
    }
    if let Some(Estimate { rows, bytes, members }) = estimate(cohort).filter(|of| of.bytes >= MUCH_BYTES) {
        let lives = counted(cohort.count() as u64, "member", "members");
        let (rows, each, bytes) = (rows_in_words(rows), in_words(bytes / cohort.count() as f64), in_words(bytes));
        let (members, days) = (counted(members as u64, "member", "members"), SAMPLE / DAY);
        tell(format!("{lives}: about {rows} rows and {bytes}, {each} each (estimated from {days} days of {members})"));
    }
}

/// The size of what a cohort writes, by a sample of so many members.
struct Estimate {
    rows: f64,
    bytes: f64,
    members: usize,
}

/// Returns `None` for a small cohort, or without room for a sample.
fn estimate(cohort: &Cohort) -> Option<Estimate> {
    let all = cohort.progress().length;
    let sample = cohort.beginning(SAMPLE_MEMBERS, SAMPLE);
    let sampled = sample.progress().length;
    if all < sampled.saturating_mul(WORTH_A_SAMPLE) {
        return None;
    }
    let scratch = tempfile::tempdir().ok()?;
    let folder = scratch.path().join("sample");
    let lived = sample.store_in(&folder, |_| ()).ok()?;
    let times = all.ratio(sampled);
    let rows = lived.list.members.iter().map(|member| member.rows).sum::<u64>() as f64 * times;
    Some(Estimate { rows, bytes: bytes_in(&folder) as f64 * times, members: sample.count() })
}

fn rows_in_words(rows: f64) -> String {
    match rows {
        rows if rows >= 1e9 => format!("{:.1} billion", rows / 1e9),
        rows if rows >= 1e6 => format!("{:.1} million", rows / 1e6),
        rows => grouped(rows as u64),
    }
}

fn in_words(bytes: f64) -> String {
    match bytes {
        bytes if bytes >= 1e12 => format!("{:.1} TB", bytes / 1e12),
        bytes if bytes >= 1e9 => format!("{:.1} GB", bytes / 1e9),
        bytes => format!("{:.1} MB", bytes / 1e6),
    }
}

/// The size of all files in a folder and in those below it.
fn bytes_in(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let size = |path: &Path| fs::metadata(path).map_or(0, |found| found.len());
    entries.map(|entry| entry.path()).map(|path| if path.is_dir() { bytes_in(&path) } else { size(&path) }).sum()
}

/// Prints the result of a cohort.
pub fn report(output: &Output, lived: &CohortSummary) -> Result<(), Failure> {
    let is_stopped = lived.is_stopped();
    let CohortSummary { folder, list, asked, found, done, took, .. } = lived;
    if output.json {
        let mut list = serde_json::to_value(list).map_err(not_written)?;
        list["stopped"] = json!(is_stopped);
        list["found_complete"] = json!(found);
        list["took_s"] = json!(took.as_secs_f64());
        list["folder"] = json!(folder.display().to_string());
        return print_json(&list);
    }
    if output.quiet {
        return Ok(());
    }
    let rows: u64 = list.members.iter().map(|member| member.rows).sum();
    let (name, count) = (&list.scenario, list.members.len());
    let members = counted(count as u64, "member", "members");
    let of = if count < *asked { format!(" of {asked}") } else { String::new() };
    let stopped = if is_stopped { ", stopped" } else { "" };
    let before = if *found > 0 { format!(", {found} of them complete before this run") } else { String::new() };
    let speed = if *done > Span::ZERO { format!(", {}", speed_in_words(*done, *took)) } else { String::new() };
    let how = if is_stopped { go_on_in(folder) } else { String::new() };
    print_text(&format!(
        "{name}: simulated {members}{of}{stopped}{before} in {:.1} s{speed}\n\nrows       {}\nfolder     {}\nmembers    {}\n{how}",
        took.as_secs_f64(),
        grouped(rows),
        folder.display(),
        folder.join(LIST).display(),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_estimate_is_near_what_a_cohort_writes_and_a_small_cohort_has_none() {
        let studio = homebody_simulation::open("../../scenarios/studio").unwrap();
        let of = |members: u32, days: f64| studio.cohort(members).days(days).start().unwrap();
        assert!(estimate(&of(2, 3.0)).is_none() && estimate(&of(30, 2.0)).is_none());
        let cohort = of(24, 8.0);
        let folder = tempfile::tempdir().unwrap();
        let lived = cohort.store_in(folder.path().join("all"), |_| ()).unwrap();
        let rows = lived.list.members.iter().map(|member| member.rows).sum::<u64>() as f64;
        let guess = estimate(&cohort).unwrap();
        let is_near = |ratio: f64| (0.7..1.4).contains(&ratio);
        assert_eq!(guess.members, SAMPLE_MEMBERS);
        assert!(is_near(guess.rows / rows), "{} of {rows}", guess.rows);
        assert!(is_near(guess.bytes / bytes_in(folder.path()) as f64), "{}", guess.bytes);
    }
}
