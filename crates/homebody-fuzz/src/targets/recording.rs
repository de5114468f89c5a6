//! Recordings: replayed, resumed, or read with a log.

use super::messages;
use crate::choices::Choices;
use crate::mutate::{json, numbers};
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_core::time::MINUTE;
use homebody_query::LoadedLog;
use homebody_simulation::{Destinations, IncompleteRun, RecordedRun, Template};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

pub const TARGET: Target = Target { name: "recording", cases: 1_000, seeds, mutate, run };

pub const FILE: &str = "recording.json";

/// Time allowed for a batch of a run that may be a hundred years long or more (our choice).
const LONGEST: Duration = Duration::from_millis(250);

fn seeds() -> Vec<CaseFiles> {
    let own = Template::all().filter_map(|template| recorded(template, &template.name()));
    seeds::named(TARGET.name).into_iter().chain(own).collect()
}

/// The recording of a minute of a scenario; incomplete if its name is long.
fn recorded(template: Template, name: &str) -> Option<CaseFiles> {
    let folder = tempfile::tempdir().ok()?;
    let path = folder.path().join(FILE);
    let to = Destinations { runs: None, recording: Some(path.clone()), ..Destinations::default() };
    let run = template.source().open().ok()?.run().length(MINUTE).start().ok()?;
    run.store(&to, |_| ()).ok()?;
    let mut text = fs::read_to_string(path).ok()?;
    if name.len() > 12 {
        let mut recording: Value = serde_json::from_str(&text).ok()?;
        recording["sha256"] = "".into();
        recording["firings"] = 0.into();
        text = recording.to_string();
    }
    Some(CaseFiles::from([(FILE.to_owned(), text.into_bytes())]))
}

fn mutate(files: &mut CaseFiles, seeds: &[CaseFiles], choices: &mut Choices) {
    // Half of the mutants change its scenario.
    let recording = serde_json::from_str::<Value>(target::text(files, FILE));
    if let (Ok(mut recording), true) = (recording, choices.is(0.5)) {
        let names: Vec<String> =
            recording["files"].as_object().into_iter().flat_map(|files| files.keys().cloned()).collect();
        if !names.is_empty() {
            let name = choices.one(&names);
            let mut text = recording["files"][name].as_str().unwrap_or_default().to_owned();
            json::json(&mut text, &[], choices);
            recording["files"][name] = text.into();
        }
        let mut text = recording.to_string();
        if choices.is(0.3) {
            let length = numbers::other(60e6, choices);
            text = text.replacen("\"length_us\":60000000", &format!("\"length_us\":{length}"), 1);
        }
        files.insert(FILE.to_owned(), text.into_bytes());
        return;
    }
    target::change_json(files, seeds, choices);
}

fn run(files: &CaseFiles, folder: &Path) -> Result<ReadVerdict, String> {
    let none = target::texts(&CaseFiles::new());
    let path = folder.join(FILE);
    fs::write(&path, files.get(FILE).map(Vec::as_slice).unwrap_or_default()).map_err(|error| error.to_string())?;
    // A recording next to a log gives the names of its sensors and its date.
    fs::write(folder.join("log.csv"), "time,sensor,value\n2009-03-02 07:12:03,bed motion,ON\n")
        .map_err(|error| error.to_string())?;
    if let Err(error) = LoadedLog::read(&folder.join("log.csv").to_string_lossy(), None) {
        messages::refusal(&error)?;
    }
    // The unfinished work in a folder is reported before it is resumed.
    if let Err(error) = IncompleteRun::open(folder) {
        messages::error(&error, &none)?;
    }
    let recorded = match RecordedRun::open(&path) {
        Ok(recorded) => recorded,
        Err(error) => return messages::error(&error, &none).map(|()| ReadVerdict::Refused),
    };
    let mut run = recorded.start();
    let begun = Instant::now();
    while begun.elapsed() < LONGEST {
        match run.next_batch() {
            Ok(Some(batch)) if batch.firings.windows(2).all(|two| two[0].seq < two[1].seq) => {}
            Ok(Some(_)) => return Err("firings are not in order".into()),
            Ok(None) => break,
            Err(error) => return Err(format!("the check lets it pass, and the run says: {error}")),
        }
    }
    Ok(ReadVerdict::Accepted)
}
