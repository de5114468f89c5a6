//! What is told of a cohort.

use super::lived::{Output, go_on_in, speed_in_words};
use crate::failure::Failure;
use crate::print::{print_json, print_text};
use homebody_core::problem::counted;
use homebody_kit::{LIST, LivedCohort};
use serde_json::json;

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
