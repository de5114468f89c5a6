//! Logs in the forms of data sets, with some changed lines: all other lines remain, and refused lines are reported.

use super::messages;
use crate::choices::Choices;
use crate::mutate::texts;
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::{Log, LogError, LogSource};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

pub const TARGET: Target = Target { name: "source", cases: 10_000, seeds, mutate, run };

/// The original log, and its mutant.
const GOOD: &str = "good";
const CHANGED: &str = "changed";

/// Lines at the beginning of a file that stay, because the others depend on them (our choice).
const HEAD: usize = 8;

fn seeds() -> Vec<CaseFiles> {
    let both = |text: Vec<u8>| CaseFiles::from([(GOOD.to_owned(), text.clone()), (CHANGED.to_owned(), text)]);
    seeds::named(TARGET.name).into_iter().flat_map(CaseFiles::into_values).map(both).collect()
}

fn mutate(files: &mut CaseFiles, _: &[CaseFiles], choices: &mut Choices) {
    let mut lines: Vec<String> = target::text(files, GOOD).split('\n').map(str::to_owned).collect();
    for _ in 0..choices.size(3) {
        let at = HEAD + choices.below(lines.len().saturating_sub(HEAD + 1).max(1));
        let Some(line) = lines.get_mut(at) else { continue };
        *line = other(line, choices).replace(['\n', '\r'], " ");
    }
    files.insert(CHANGED.to_owned(), lines.join("\n").into_bytes());
}

/// A line with another letter or word, or another line.
fn other(line: &str, choices: &mut Choices) -> String {
    let mut letters: Vec<char> = line.chars().collect();
    let at = choices.below(letters.len());
    match choices.below(8) {
        0 if !letters.is_empty() => drop(letters.remove(at)),
        1 => letters.insert(at, *choices.one(&['"', ',', '\t', ' ', 'Z', '-', ':', '0', ';', '|', '\0', 'é'])),
        2 if !letters.is_empty() => letters[at] = *choices.one(&['"', ',', '\t', ' ', 'Z', '-', ':', '9', 'x']),
        3 => letters.truncate(at),
        4 => return texts::other(line, choices),
        5 => return line.replacen(' ', "T", 1) + "Z",
        6 => return format!("\"{line}"),
        _ => return line.split([',', '\t', ' ']).rev().collect::<Vec<_>>().join(","),
    }
    letters.into_iter().collect()
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    let (good, changed) = (target::text(files, GOOD), target::text(files, CHANGED));
    // Binary content cannot be compared line by line.
    if good.is_empty() || changed.is_empty() {
        return Ok(ReadVerdict::Refused);
    }
    let path = folder.join(GOOD);
    let failed = |error: std::io::Error| format!("the folder of the case: {error}");
    fs::write(&path, good).map_err(failed)?;
    let form = LogSource::recognise(&path).map_err(|error| error.to_string())?.form();
    let read = |text: &str| {
        fs::write(&path, text).map_err(failed)?;
        Ok::<_, String>(homebody_log::read(LogSource::new(form, &path), &LoggerFile::default()))
    };
    let before: Vec<&str> = good.split('\n').collect();
    let after: Vec<&str> = changed.split('\n').collect();
    let differs: Vec<usize> = (0..before.len()).filter(|&at| after.get(at) != Some(&before[at])).collect();
    let apart = with_their_record(form.name, &before, &differs);
    let rest: Vec<&str> = match EACH_SECOND.contains(&form.name) {
        // A second without a row equals the one before it.
        true => {
            let kept = |at: usize| (0..=at).rev().find(|at| !apart.contains(at)).unwrap_or(0);
            (0..before.len()).map(|at| before[kept(at)]).collect()
        }
        false => (0..before.len()).filter(|at| !apart.contains(at)).map(|at| before[at]).collect(),
    };
    let rest = read(&rest.join("\n"))?.map_err(|error| format!("the lines that stay are refused: {error}"))?;
    let log: Log = match read(changed)? {
        Ok(log) => log,
        // A line longer than any log has.
        Err(error @ LogError::TooLong { .. }) => {
            return messages::refusal(&error).map(|()| ReadVerdict::Refused);
        }
        Err(error) => return Err(format!("lines that stay are lost with the others: {error}")),
    };
    let is_refused = |at: &usize| log.problems.iter().any(|problem| problem.line as usize == at + 1);
    // The changed meaning of a row for one second changes the row of the next.
    if !EACH_SECOND.contains(&form.name) || differs.iter().all(is_refused) {
        nothing_is_lost(&log, &rest)?;
    }
    if let Some(stranger) = log.problems.iter().find(|problem| !apart.contains(&(problem.line as usize - 1))) {
        return Err(format!("line {} was not changed and is refused: {}", stranger.line, stranger.why));
    }
    log.problems.iter().try_for_each(|problem| messages::message(&problem.why))?;
    // In a form with a row a line, a changed line is a row or is reported.
    let is_said = |at: &&usize| after.get(**at).is_some_and(|line| !line.trim().is_empty());
    let said = apart.iter().filter(is_said).count() as u64;
    if form.name == "casas" && log.rows + log.skipped < rest.rows + said {
        return Err(format!("of {said} lines that were changed some are neither rows nor named"));
    }
    Ok(if log.skipped > 0 { ReadVerdict::Refused } else { ReadVerdict::Accepted })
}

/// Forms with a row for each second, which record only changes.
const EACH_SECOND: [&str; 2] = ["aras", "openshs"];

/// The lines of all records that contain any of the lines.
fn with_their_record(form: &str, lines: &[&str], some: &[usize]) -> Vec<usize> {
    let mut number = 0;
    let records: Vec<usize> = lines
        .iter()
        .enumerate()
        .map(|(at, line)| {
            number = match form {
                "mit" => at / 5,
                "xes" => number + usize::from(line.starts_with("<trace")),
                _ => at,
            };
            number
        })
        .collect();
    (0..lines.len()).filter(|&at| some.iter().any(|&other| records[other] == records[at])).collect()
}

fn nothing_is_lost(log: &Log, rest: &Log) -> Result<(), String> {
    let (mut there, wanted) = (rows(log), rows(rest));
    for (row, times) in wanted {
        let found = there.remove(&row).unwrap_or(0);
        if found < times {
            return Err(format!("{row:?} is there {times} times in lines that stay, and {found} times is read"));
        }
    }
    Ok(())
}

/// The number of each row, and each activity of a form whose records are activities.
fn rows(log: &Log) -> BTreeMap<(i64, String, String), u64> {
    let mut rows = BTreeMap::new();
    for event in &log.events {
        *rows.entry((event.at.micros(), log.sensor(event).to_owned(), log.value(event).to_owned())).or_default() += 1;
    }
    if log.events.is_empty() {
        for of in &log.activities {
            *rows.entry((of.begin().micros(), of.label.clone(), of.end().to_string())).or_default() += 1;
        }
    }
    rows
}
