//! Notes and results of a cohort.

use super::run_output::{Output, resume_line, speed_in_words};
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

/// Announces the size of a cohort's output if it is large, and the truth tables that it leaves out by default. The tables of a cohort
/// with `is_chosen` were given by the user.
pub fn announce(cohort: &Cohort, is_chosen: bool) {
    if cohort.kept() == TruthKept::Brief && !is_chosen {
        tell(
            "note: a large cohort stores no truth tables cause, off, movement and lost: --truth-tables all stores them, and \
             homebody replay of a member's recording writes them",
        );
    }
    if let Some(OutputEstimate { rows, bytes, members }) = estimate(cohort).filter(|size| size.bytes >= MUCH_BYTES) {
        let all = counted(cohort.count() as u64, "member", "members");
        let (rows, each, bytes) =
            (rows_in_words(rows), size_in_words(bytes / cohort.count() as f64), size_in_words(bytes));
        let (members, days) = (counted(members as u64, "member", "members"), SAMPLE / DAY);
        tell(format!("{all}: about {rows} rows and {bytes}, {each} each (estimated from {days} days of {members})"));
    }
}

struct OutputEstimate {
    rows: f64,
    bytes: f64,
    members: usize,
}

/// Returns `None` for a small cohort, or without room for a sample.
fn estimate(cohort: &Cohort) -> Option<OutputEstimate> {
    let all = cohort.progress().length;
    let sample = cohort.beginning(SAMPLE_MEMBERS, SAMPLE);
    let sampled = sample.progress().length;
    if all < sampled.saturating_mul(WORTH_A_SAMPLE) {
        return None;
    }
    let scratch = tempfile::tempdir().ok()?;
    let folder = scratch.path().join("sample");
    let summary = sample.store_in(&folder, |_| ()).ok()?;
    let times = all.ratio(sampled);
    let rows = summary.list.members.iter().map(|member| member.rows).sum::<u64>() as f64 * times;
    Some(OutputEstimate { rows, bytes: bytes_in(&folder) as f64 * times, members: sample.count() })
}

fn rows_in_words(rows: f64) -> String {
    match rows {
        rows if rows >= 1e9 => format!("{:.1} billion", rows / 1e9),
        rows if rows >= 1e6 => format!("{:.1} million", rows / 1e6),
        rows => grouped(rows as u64),
    }
}

fn size_in_words(bytes: f64) -> String {
    match bytes {
        bytes if bytes >= 1e12 => format!("{:.1} TB", bytes / 1e12),
        bytes if bytes >= 1e9 => format!("{:.1} GB", bytes / 1e9),
        bytes => format!("{:.1} MB", bytes / 1e6),
    }
}

fn bytes_in(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let size = |path: &Path| fs::metadata(path).map_or(0, |found| found.len());
    entries.map(|entry| entry.path()).map(|path| if path.is_dir() { bytes_in(&path) } else { size(&path) }).sum()
}

pub fn report(output: &Output, summary: &CohortSummary) -> Result<(), Failure> {
    let is_stopped = summary.is_stopped();
    let CohortSummary { folder, list, asked, found, done, took, .. } = summary;
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
    let part = if count < *asked { format!(" of {asked}") } else { String::new() };
    let stopped = if is_stopped { ", stopped" } else { "" };
    let before = if *found > 0 { format!(", {found} of them complete before this run") } else { String::new() };
    let speed = if *done > Span::ZERO { format!(", {}", speed_in_words(*done, *took)) } else { String::new() };
    let resume = if is_stopped { resume_line(folder) } else { String::new() };
    print_text(&format!(
        "{name}: simulated {members}{part}{stopped}{before} in {:.1} s{speed}\n\nrows       {}\nfolder     {}\nmembers    {}\n{resume}",
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
    fn estimates_the_output_of_a_large_cohort_and_of_no_small_one() {
        let studio = homebody_simulation::open("../../scenarios/studio").unwrap();
        let planned = |members: u32, days: f64| studio.cohort(members).days(days).start().unwrap();
        assert!(estimate(&planned(2, 3.0)).is_none() && estimate(&planned(30, 2.0)).is_none());
        let cohort = planned(24, 8.0);
        let folder = tempfile::tempdir().unwrap();
        let summary = cohort.store_in(folder.path().join("all"), |_| ()).unwrap();
        let rows = summary.list.members.iter().map(|member| member.rows).sum::<u64>() as f64;
        let guess = estimate(&cohort).unwrap();
        let is_near = |ratio: f64| (0.7..1.4).contains(&ratio);
        assert_eq!(guess.members, SAMPLE_MEMBERS);
        assert!(is_near(guess.rows / rows), "{} of {rows}", guess.rows);
        assert!(is_near(guess.bytes / bytes_in(folder.path()) as f64), "{}", guess.bytes);
    }
}
