//! The messages of the page: about drafts, and to a run.

use super::messages;
use crate::choices::Choices;
use crate::mutate::{json, sentences};
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_simulation::Cancel;
use homebody_web::drafts::DraftService;
use homebody_web::folders::HomeFolders;
use homebody_web::stage::{Seen, Stage};
use homebody_web::wire::{Connect, Draft, Explain, Month, PageCommand, ProblemView, Save};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

pub const TARGET: Target = Target { name: "wire", cases: 2_000, seeds, mutate, run };

const FILE: &str = "message.json";

/// Time that the stage has for its commands before it is closed (our choice).
const LONGEST: Duration = Duration::from_millis(30);

fn seeds() -> Vec<CaseFiles> {
    seeds::files(TARGET.name, FILE)
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    let message = serde_json::from_str::<Value>(target::text(files, FILE));
    if let (Ok(mut message), true) = (message, choices.is(0.6))
        && drafted(&mut message, choices)
    {
        files.insert(FILE.to_owned(), message.to_string().into_bytes());
        return;
    }
    target::change_json(files, seeds, choices);
}

/// Changes a text of a draft, as its user would; false without one.
fn drafted(message: &mut Value, choices: &mut Choices) -> bool {
    let at = if message["texts"].is_object() { "/texts" } else { "/draft/texts" };
    let Some(Value::Object(texts)) = message.pointer_mut(at) else { return false };
    let names: Vec<String> = texts.keys().cloned().collect();
    let Some(name) = names.get(choices.below(names.len())) else { return false };
    let mut text = texts[name].as_str().unwrap_or_default().to_owned();
    if name.ends_with(".routine") {
        sentences::lines(&mut text, choices);
    } else if !json::json(&mut text, &[], choices) {
        return false;
    }
    texts.insert(name.clone(), text.into());
    true
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    let folders = folders(folder).map_err(|error| format!("the folder of the case: {error}"))?;
    let drafts = DraftService::new(folders.clone());
    let text = target::texts(files).remove(FILE).unwrap_or_default();
    let mut is_understood = ask(&drafts, &text)?;
    // One message, or a series.
    let says: Vec<PageCommand> =
        serde_json::from_str(&text).or_else(|_| serde_json::from_str(&text).map(|say| vec![say])).unwrap_or_default();
    if !says.is_empty() {
        is_understood = true;
        run_on_stage(folders, says)?;
    }
    // A plan of unknown origin, dropped onto the page.
    if let Err(error) = drafts.import(text.as_bytes()) {
        messages::refusal(&error)?;
    }
    Ok(if is_understood { ReadVerdict::Accepted } else { ReadVerdict::Refused })
}

/// Passes a question to the drafts; false for other messages.
fn ask(drafts: &DraftService, text: &str) -> Result<bool, String> {
    let mut is_understood = true;
    if let Ok(draft) = serde_json::from_str::<Draft>(text) {
        let checked = drafts.check(draft.clone());
        problems(&checked.problems)?;
        let planned = drafts.plan(draft.clone());
        problems(&planned.problems)?;
        problems(&drafts.rows(draft, &Cancel::new()).problems)?;
    } else if let Ok(explain) = serde_json::from_str::<Explain>(text) {
        problems(&drafts.explain(explain).problems)?;
    } else if let Ok(month) = serde_json::from_str::<Month>(text) {
        problems(&drafts.month(month, &Cancel::new()).problems)?;
    } else if let Ok(save) = serde_json::from_str::<Save>(text) {
        if let Err(why) = drafts.save(save) {
            messages::refusal(&why)?;
        }
        let _ = (drafts.files(), drafts.versions());
    } else if let Ok(connect) = serde_json::from_str::<Connect>(text) {
        messages::message(&drafts.connect(connect).said)?;
    } else {
        is_understood = false;
    }
    Ok(is_understood)
}

fn problems(problems: &[ProblemView]) -> Result<(), String> {
    for problem in problems {
        messages::message(&problem.what)?;
        problem.hint.as_deref().map_or(Ok(()), messages::message)?;
    }
    Ok(())
}

/// Sends messages to a run on a stage of its own.
fn run_on_stage(folders: HomeFolders, says: Vec<PageCommand>) -> Result<(), String> {
    let stage = Stage::open(folders).map_err(|error| error.to_string())?;
    let mut seen = Seen::default();
    let commands = stage.page_commands();
    for say in says {
        commands.send(say);
    }
    let begun = Instant::now();
    while begun.elapsed() < LONGEST {
        let news = stage.news(&mut seen, 100);
        serde_json::to_string(&news.frame).map_err(|error| format!("a frame that is no JSON: {error}"))?;
        std::thread::sleep(Duration::from_millis(10));
    }
    stage.close();
    Ok(())
}

fn folders(folder: &Path) -> std::io::Result<HomeFolders> {
    let scenario = folder.join("flat");
    fs::create_dir_all(&scenario)?;
    for (name, bytes) in seeds::flat() {
        fs::write(scenario.join(name), bytes)?;
    }
    Ok(HomeFolders { scenario, entry: "scenario.json".into(), is_trusted: false, runs: folder.join("runs") })
}
