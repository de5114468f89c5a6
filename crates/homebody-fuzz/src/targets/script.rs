//! Scripts: read, and lived by where nothing is wrong. A script may give up in the middle of a run, in words with its line.

use super::{life, told};
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::scripts;
use crate::target::{self, Files, Target, Verdict};
use homebody_core::time::{Micros, SECOND};
use homebody_kit::{Error, OpenScenario, Source, Template};
use std::collections::BTreeMap;
use std::path::Path;

pub const TARGET: Target =
    Target { name: "script", about: "scripts, checked and lived", cases: 10_000, corpus, mutate, run };

/// The file of a case.
const FILE: &str = "clara.rhai";

/// Time of simulation of an input that passes the check (our choice).
const LIVED: Micros = 3_600 * SECOND;

fn corpus() -> Vec<Files> {
    let of = |text: &[u8]| Files::from([(FILE.to_owned(), text.to_vec())]);
    let all = corpus::of(TARGET.name).into_iter().chain(corpus::scenarios());
    let scripts =
        all.flat_map(|files| files.into_iter().filter(|(name, _)| name.ends_with(".rhai")).collect::<Vec<_>>());
    scripts.map(|(_, text)| of(&text)).collect()
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    target::change(files, corpus, dice, |_, text, others, dice| scripts::script(text, others, dice));
}

fn run(files: &Files, folder: &Path) -> Result<Verdict, String> {
    let text = target::texts(files).remove(FILE).unwrap_or_default();
    let template = Template::named("dark-hall").map_err(|error| error.to_string())?;
    let mut texts: BTreeMap<String, String> = template.files().collect();
    texts.insert(FILE.to_owned(), text);
    let opened = match Source::of_texts(texts.clone(), "scenario.json").open() {
        Ok(opened) => opened,
        Err(error) => return told::error(&error, &texts).map(|()| Verdict::Refused),
    };
    let first = lived(&opened)?;
    if first.1.is_none() {
        return life::live(&opened, folder).map(|()| Verdict::Accepted);
    }
    let again = lived(&opened)?;
    if first != again {
        return Err(format!("the same seed is lived as {first:?} and as {again:?}"));
    }
    Ok(Verdict::Refused)
}

/// How many facts a part of a life has, and why it ends early.
fn lived(opened: &OpenScenario) -> Result<(usize, Option<String>), String> {
    let mut run = opened.run().length(LIVED).start().map_err(|error| error.to_string())?;
    let mut facts = 0;
    loop {
        match run.next_batch() {
            Ok(Some(batch)) => facts += batch.facts.len(),
            Ok(None) => return Ok((facts, None)),
            Err(error @ Error::Driver { .. }) => {
                let said = error.to_string();
                return match said.contains(" s: clara.rhai") {
                    true => Ok((facts, Some(said))),
                    false => Err(format!("a script may say only what a body can do: {said}")),
                };
            }
            Err(error) => return Err(error.to_string()),
        }
    }
}
