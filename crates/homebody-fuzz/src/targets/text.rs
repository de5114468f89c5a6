//! Short texts that people say: places of logs, dates, time zones, speeds, commands for a run that is lived.

use super::told;
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::{numbers, tables, texts};
use crate::target::{self, Files, Target, Verdict};
use homebody_analysis::dates::Asked;
use homebody_core::scenario::calendar::{Calendar, time_of_day};
use homebody_kit::pace::{Command, Speed};
use homebody_log::{LogError, Url};
use std::fmt::Display;
use std::path::Path;

pub const TARGET: Target =
    Target { name: "text", about: "URLs, dates, zones, speeds, commands", cases: 5_000, corpus, mutate, run };

const FILE: &str = "texts";

/// Largest number of texts in a case (our choice).
const MOST_LINES: usize = 200;

fn corpus() -> Vec<Files> {
    let texts = corpus::of(TARGET.name).into_iter().flat_map(Files::into_values);
    texts.map(|text| Files::from([(FILE.to_owned(), text)])).collect()
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    target::change(files, corpus, dice, |_, text, _, dice| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for _ in 0..dice.size(20) {
            let at = dice.below(lines.len());
            let Some(line) = lines.get_mut(at) else { break };
            *line = match dice.below(5) {
                0 => tables::instant(dice).to_owned(),
                1 => numbers::other(1.0, dice),
                2 => format!("{}{}", line.split_inclusive(':').next().unwrap_or_default(), texts::other("", dice)),
                3 => format!("{} {}", line.split(' ').next().unwrap_or_default(), numbers::other(2.0, dice)),
                _ => texts::other(line, dice),
            };
        }
        lines.truncate(MOST_LINES);
        *text = lines.join("\n");
    });
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    let mut verdict = Verdict::Refused;
    for text in target::texts(files).values().flat_map(|text| text.lines()) {
        if understood(text, folder)? {
            verdict = Verdict::Accepted;
        }
    }
    Ok(verdict)
}

/// Reads a text as all that it may be; whether it is anything.
fn understood(text: &str, folder: &Path) -> Result<bool, String> {
    let url = text.parse::<Url>().map_err(LogError::NoPlace);
    if let Ok(url) = &url {
        let within = url.within(folder).to_string();
        let again = within.parse::<Url>().map_err(|error| format!("{within:?} is no URL any more: {error}"))?;
        if again.scheme() != url.scheme() {
            return Err(format!("{text:?} becomes {again}"));
        }
    }
    let asked = text.parse::<Asked>();
    if let (Ok(asked), true) = (asked.as_ref(), text.len() == 10) {
        let said = asked.to_string();
        if said != text {
            return Err(format!("{text:?} is understood as {said}"));
        }
    }
    let start = Calendar::new(text, "Europe/Berlin").map(drop);
    let found = [
        spoken(url)?,
        spoken(asked)?,
        spoken(start)?,
        spoken(Calendar::zone(text))?,
        spoken(text.parse::<Speed>())?,
        spoken(text.parse::<Command>())?,
        time_of_day(text).is_some(),
    ];
    Ok(found.contains(&true))
}

/// Whether it is understood; why not can be read.
fn spoken<T, E: Display>(read: Result<T, E>) -> Result<bool, String> {
    match read {
        Ok(_) => Ok(true),
        Err(error) => told::message(&error.to_string()).map(|()| false),
    }
}
