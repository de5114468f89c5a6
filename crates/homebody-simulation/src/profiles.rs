//! A list of profiles: the members of a cohort, and how each differs from the scenario.
//!
//! A profile changes the routine of one resident: its sentences are added, and the sentences that contradict them are removed. So a
//! member's recording contains all that the run depends on, and simulating or replaying it needs no profile.

mod messages;
mod profile;
mod rows;
mod sentences;
mod table;

use crate::error::SimulationError;
use homebody_core::problem::{Problem, Problems};
use homebody_log::files::plain;
use homebody_log::limits::LARGEST_OF_SCENARIO_BYTES;
use homebody_log::sink::csv_line;
pub(crate) use messages::ProfileMessage;
pub(crate) use profile::Base;
pub use profile::Profile;
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::Path;
use table::ProfileTable;

pub(crate) fn read(path: &Path, base: &Base, without: &[String]) -> Result<Vec<Profile>, SimulationError> {
    let file = path.display().to_string();
    let bytes = plain::read(path, LARGEST_OF_SCENARIO_BYTES).map_err(|error| match error.kind() {
        ErrorKind::NotFound => SimulationError::unreadable(path, ProfileMessage::NoFile),
        ErrorKind::IsADirectory => SimulationError::unreadable(path, ProfileMessage::Folder),
        _ => SimulationError::io(path, error),
    })?;
    let text = String::from_utf8(bytes).map_err(|_| Problem::of_file(&file, ProfileMessage::NotUtf8, None))?;
    from_table(&file, &text, base, without)
}

/// The profiles of a table that problems call `file`: all of them, or all problems.
pub(crate) fn from_table(
    file: &str,
    text: &str,
    base: &Base,
    without: &[String],
) -> Result<Vec<Profile>, SimulationError> {
    let table = ProfileTable::read(file, text)?;
    let (profiles, problems) = rows::read(&table, base, without);
    if problems.is_empty() { Ok(profiles) } else { Err(SimulationError::Problems(in_order(problems, file))) }
}

/// Profiles as a table for [`from_table`].
pub(crate) fn table(profiles: &[Profile]) -> String {
    let columns: BTreeSet<&str> = profiles.iter().flat_map(|profile| profile.row.keys().map(String::as_str)).collect();
    let mut table = csv_line(["name", "seed"].into_iter().chain(columns.iter().copied())) + "\n";
    for Profile { name, seed, row, .. } in profiles {
        let seed = seed.map(|seed| seed.to_string()).unwrap_or_default();
        let cells = columns.iter().map(|column| row.get(*column).map_or("", String::as_str));
        table += &(csv_line([name.as_str(), &seed].into_iter().chain(cells)) + "\n");
    }
    table
}

/// Problems in the order of their places, those of other files than the list last.
fn in_order(mut problems: Vec<Problem>, file: &str) -> Problems {
    problems.sort_by_key(|problem| (problem.file != file, problem.file.clone(), problem.line, problem.column));
    // Several conditions with one start have the same problem.
    problems.dedup();
    Problems::truncated(&problems)
}
