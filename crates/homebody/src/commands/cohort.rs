//! What is told of a cohort.

use super::live::{Output, speed_in_words};
use crate::failure::Failure;
use crate::print::{print_json, print_text};
use homebody_kit::{LIST, LivedCohort};
use serde_json::json;

/// Tells people and scripts what has become of a cohort.
pub fn report(output: &Output, lived: &LivedCohort) -> Result<(), Failure> {
    let LivedCohort { folder, list, asked, lived, took } = lived;
    if output.json {
        let mut list = serde_json::to_value(list).map_err(Failure::usage)?;
        list["took_s"] = json!(took.as_secs_f64());
        list["folder"] = json!(folder.display().to_string());
        return print_json(&list);
    }
    if output.quiet {
        return Ok(());
    }
    let rows: u64 = list.members.iter().map(|member| member.rows).sum();
    let (name, count) = (&list.scenario, list.members.len());
    let stopped = if count < *asked { format!(" of {asked}, stopped") } else { String::new() };
    print_text(&format!(
        "{name}: {count} lives{stopped} in {:.1} s, {} \n\nrows       {rows} in all\nfolder     {}\nmembers    {}\n",
        took.as_secs_f64(),
        speed_in_words(*lived, *took),
        folder.display(),
        folder.join(LIST).display(),
    ))
}
