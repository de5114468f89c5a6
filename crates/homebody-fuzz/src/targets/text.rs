//! Short inputs: names of logs, dates, time zones, speeds, commands for a run.

use super::messages;
use crate::choices::Choices;
use crate::mutate::{numbers, texts, word};
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_analysis::dates::DayChoice;
use homebody_core::calendar::{Calendar, time_of_day};
use homebody_log::{LogError, Url};
use homebody_simulation::{pace::RunCommand, pace::Speed};
use std::fmt::Display;
use std::path::Path;

pub const TARGET: Target = Target { name: "text", cases: 5_000, seeds, mutate, run };

const FILE: &str = "texts";

/// Largest number of texts in a case (our choice).
const MOST_LINES: usize = 200;

fn seeds() -> Vec<CaseFiles> {
    seeds::files(TARGET.name, FILE)
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    target::change(files, seeds, choices, |_, text, _, choices| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for _ in 0..choices.size(20) {
            let at = choices.below(lines.len());
            let Some(line) = lines.get_mut(at) else { break };
            *line = match choices.below(5) {
                0 => word(choices, "instants").to_owned(),
                1 => numbers::other(1.0, choices),
                2 => format!("{}{}", line.split_inclusive(':').next().unwrap_or_default(), texts::other("", choices)),
                3 => format!("{} {}", line.split(' ').next().unwrap_or_default(), numbers::other(2.0, choices)),
                _ => texts::other(line, choices),
            };
        }
        lines.truncate(MOST_LINES);
        *text = lines.join("\n");
    });
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    let mut verdict = ReadVerdict::Refused;
    for text in target::texts(files).values().flat_map(|text| text.lines()) {
        if is_valid(text, folder)? {
            verdict = ReadVerdict::Accepted;
        }
    }
    Ok(verdict)
}

fn is_valid(text: &str, folder: &Path) -> Result<bool, String> {
    let url = text.parse::<Url>().map_err(LogError::NoPlace);
    if let Ok(url) = &url {
        let within = url.within(folder).to_string();
        let again = within.parse::<Url>().map_err(|error| format!("{within:?} is no URL any more: {error}"))?;
        if again.scheme() != url.scheme() {
            return Err(format!("{text:?} becomes {again}"));
        }
    }
    let asked = text.parse::<DayChoice>();
    if let (Ok(asked), true) = (asked.as_ref(), text.len() == 10) {
        let said = asked.to_string();
        if said != text {
            return Err(format!("{text:?} is understood as {said}"));
        }
    }
    let start = Calendar::new(text, "Europe/Berlin").map(drop);
    let found = [
        checked(url)?,
        checked(asked)?,
        checked(start)?,
        checked(Calendar::zone(text))?,
        checked(text.parse::<Speed>())?,
        checked(text.parse::<RunCommand>())?,
        time_of_day(text).is_some(),
    ];
    Ok(found.contains(&true))
}

/// True if it is valid; otherwise checks the message.
fn checked<T, E: Display>(read: Result<T, E>) -> Result<bool, String> {
    match read {
        Ok(_) => Ok(true),
        Err(error) => messages::refusal(&error).map(|()| false),
    }
}
