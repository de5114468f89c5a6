//! What is told of a cohort.

use super::lived::{Output, go_on_in, speed_in_words};
use crate::failure::Failure;
use crate::print::{print_json, print_text, tell};
use homebody_core::problem::counted;
use homebody_core::time::{DAY, Micros};
use homebody_kit::{Cohort, CohortLayout, LIST, LivedCohort, OpenScenario, TruthKept};
use serde_json::json;
use std::fs;
use std::path::Path;

/// How much a cohort writes is told by what one of its members writes in the first days, so many (ours).
const SAMPLE: Micros = 3 * DAY;

/// A cohort that lives less than so many times as long is lived sooner than foretold, and writes little (ours).
const WORTH_A_SAMPLE: Micros = 20;

/// Less than this is written without a word before (ours).
const MUCH_BYTES: u64 = 100_000_000;

/// Says how much a cohort is going to write, if it is much, and what it leaves out of truths, unless that was asked for.
pub fn foretell(opened: &OpenScenario, cohort: &Cohort, layout: CohortLayout, length: Micros, is_asked: bool) {
    if cohort.kept() == TruthKept::Brief && !is_asked {
        tell(
            "of the truths of a large cohort, the tables cause, off, movement and lost are left out: --truth-tables all keeps them, \
             and homebody replay of a member's recording has them",
        );
    }
    if let Some(words) = foretold(opened, (layout, cohort.kept()), cohort.count(), length) {
        tell(words);
    }
}

/// How much a cohort is going to write, in words; `None` where it is little, or where there is no place for a sample.
fn foretold(
    opened: &OpenScenario,
    (layout, kept): (CohortLayout, TruthKept),
    count: usize,
    length: Micros,
) -> Option<String> {
    if length.saturating_mul(count as Micros) < SAMPLE * WORTH_A_SAMPLE {
        return None;
    }
    let scratch = tempfile::tempdir().ok()?;
    let folder = scratch.path().join("sample");
    let sample = length.min(SAMPLE);
    let one = opened.cohort(1).length(sample).layout(layout).truth(kept).start();
    let lived = one.and_then(|one| one.store_in(&folder, |_| ())).ok()?;
    let times = length as f64 / sample as f64;
    let each = bytes_in(&folder) as f64 * times;
    let rows = lived.list.members.iter().map(|member| member.rows).sum::<u64>() as f64 * times * count as f64;
    let all = each * count as f64;
    let (lives, days) = (counted(count, "life", "lives"), sample / DAY);
    (all >= MUCH_BYTES as f64).then(|| {
        let (rows, all, each) = (rows_in_words(rows), in_words(all), in_words(each));
        format!("{lives}: about {rows} rows and {all}, {each} each, by what one of them writes in {days} days")
    })
}

fn rows_in_words(rows: f64) -> String {
    match rows {
        rows if rows >= 1e9 => format!("{:.1} billion", rows / 1e9),
        rows if rows >= 1e6 => format!("{:.1} million", rows / 1e6),
        rows => format!("{rows:.0}"),
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

/// Tells people and scripts what has become of a cohort.
pub fn report(output: &Output, lived: &LivedCohort) -> Result<(), Failure> {
    let is_stopped = lived.is_stopped();
    let LivedCohort { folder, list, asked, found, lived, took, .. } = lived;
    if output.json {
        let mut list = serde_json::to_value(list).map_err(Failure::usage)?;
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
    let lives = counted(count, "life", "lives");
    let of = if count < *asked { format!(" of {asked}") } else { String::new() };
    let stopped = if is_stopped { ", stopped" } else { "" };
    let before = if *found > 0 { format!(", {found} of them complete before") } else { String::new() };
    let speed = if *lived > 0 { format!(", {}", speed_in_words(*lived, *took)) } else { String::new() };
    let how = if is_stopped { go_on_in(folder) } else { String::new() };
    print_text(&format!(
        "{name}: {lives}{of}{stopped}{before} in {:.1} s{speed}\n\nrows       {rows} in all\nfolder     {}\nmembers    {}\n{how}",
        took.as_secs_f64(),
        folder.display(),
        folder.join(LIST).display(),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_large_cohort_writes_is_foretold_by_a_sample_and_of_a_small_one_nothing_is_said() {
        let studio = homebody_kit::open("../../scenarios/studio").unwrap();
        let kept = (CohortLayout::Folders, TruthKept::Brief);
        let of = |count: usize, days: Micros| foretold(&studio, kept, count, days * DAY);
        let words = of(10_000, 365).unwrap();
        assert!(
            words.starts_with("10000 lives: about ")
                && words.contains(" billion rows and ")
                && words.contains(" GB, ")
                && words.ends_with("in 3 days"),
            "{words}"
        );
        assert_eq!((of(2, 3), of(30, 2)), (None, None));
    }
}
