//! Scripts: parsed, and simulated if they are valid. A script may fail in the middle of a run, with a message that
//! names its line.

use super::{messages, simulation};
use crate::choices::Choices;
use crate::mutate::scripts;
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_core::time::{HOUR, Span};
use homebody_simulation::{OpenScenario, ScenarioSource, SimulationError, Template};
use std::collections::BTreeMap;
use std::path::Path;

pub const TARGET: Target = Target { name: "script", cases: 10_000, seeds, mutate, run };

const FILE: &str = "clara.rhai";

/// Time of simulation of an input that passes the check (our choice).
const SIMULATED: Span = HOUR;

fn seeds() -> Vec<CaseFiles> {
    seeds::with_ending(TARGET.name, ".rhai", FILE)
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    target::change(files, seeds, choices, |_, text, others, choices| scripts::script(text, others, choices));
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    let text = target::texts(files).remove(FILE).unwrap_or_default();
    let template = Template::named("dark-hall").map_err(|error| error.to_string())?;
    let mut texts: BTreeMap<String, String> = template.files().collect();
    texts.insert(FILE.to_owned(), text);
    let opened = match ScenarioSource::from_texts(texts.clone(), "scenario.json").open() {
        Ok(opened) => opened,
        Err(error) => return messages::error(&error, &texts).map(|()| ReadVerdict::Refused),
    };
    let first = simulated(&opened)?;
    if first.1.is_none() {
        return simulation::simulate(&opened, folder).map(|()| ReadVerdict::Accepted);
    }
    let again = simulated(&opened)?;
    if first != again {
        return Err(format!("the same seed gives {first:?} and {again:?}"));
    }
    Ok(ReadVerdict::Refused)
}

/// The number of facts of a run, and the reason if it ends early.
fn simulated(opened: &OpenScenario) -> Result<(usize, Option<String>), String> {
    let mut run = opened.run().length(SIMULATED).start().map_err(|error| error.to_string())?;
    let mut facts = 0;
    loop {
        match run.next_batch() {
            Ok(Some(batch)) => facts += batch.facts.len(),
            Ok(None) => return Ok((facts, None)),
            Err(error @ SimulationError::Driver { .. }) => {
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
