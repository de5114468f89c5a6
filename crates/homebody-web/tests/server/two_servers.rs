//! Two servers serve one folder: it has each save that one of them has accepted.

use super::served::Served;
use homebody_web::Options;
use homebody_web::library::Library;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::{fs, thread};

/// The number of saves of each page.
const SAVES: usize = 25;

/// A second server of the same homes, as in another program.
fn beside(served: &Served) -> Served {
    let library = Library::new(served.folder.path().to_owned(), false);
    Served::of(tempfile::tempdir().unwrap(), Options { port: Some(0), ..Options::new(library) })
}

fn answer(served: &Served, method: &str, path: &str, body: &Value) -> (u16, Value) {
    let answer = served.send(method, path, body.to_string().as_bytes());
    (answer.code, serde_json::from_slice(&answer.body).unwrap_or_default())
}

/// Adds words to a list, each time to the list as read; returns the accepted words.
fn add_words(served: &Served, page: usize) -> Vec<String> {
    let mut accepted = Vec::new();
    for number in 0..SAVES {
        let files: Value = serde_json::from_slice(&served.api("/api/homes/studio/files").body).unwrap();
        let file = files["files"].as_array().unwrap().iter().find(|file| file["name"] == "scratch.json").unwrap();
        let mut words: Vec<String> = serde_json::from_str(file["text"].as_str().unwrap()).unwrap();
        let word = format!("{page}-{number}");
        words.push(word.clone());
        let text = serde_json::to_string(&words).unwrap();
        let save = json!({ "files": [{ "name": "scratch.json", "text": text, "version": file["version"] }] });
        let (code, said) = answer(served, "POST", "/api/homes/studio/files", &save);
        if code == 200 && said["saved"].as_object().is_some_and(|saved| !saved.is_empty()) {
            accepted.push(word);
        }
    }
    accepted
}

/// Adds notes to days of its own; returns the days that were accepted.
fn add_notes(served: &Served, page: usize) -> Vec<String> {
    let day = |number: usize| format!("2025-{:02}-{:02}", 1 + page, 1 + number);
    let note =
        |day: &String| json!({ "before": null, "note": { "day": day, "about": "day", "seen": true, "note": "x" } });
    let is_accepted =
        |day: &String| answer(served, "POST", "/api/homes/studio/runs/studio-1/notes", &note(day)).0 == 200;
    (0..SAVES).map(day).filter(is_accepted).collect()
}

#[test]
fn two_servers_of_one_folder_lose_no_save() {
    let first = Served::library(&["studio"]);
    let home = first.folder.path().join("studio");
    fs::write(home.join("scratch.json"), "[]").unwrap();
    fs::create_dir_all(home.join("runs/studio-1")).unwrap();
    fs::write(home.join("runs/studio-1/recording.json"), "{}").unwrap();
    let second = beside(&first);
    let pages = [&first, &second, &first, &second];
    let all = |act: fn(&Served, usize) -> Vec<String>| -> BTreeSet<String> {
        thread::scope(|scope| {
            let threads: Vec<_> =
                pages.iter().enumerate().map(|(page, served)| scope.spawn(move || act(served, page))).collect();
            threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
        })
    };
    let accepted = all(add_words);
    let kept: BTreeSet<String> = serde_json::from_str(&fs::read_to_string(home.join("scratch.json")).unwrap()).unwrap();
    assert!(accepted.len() >= SAVES, "{} were accepted", accepted.len());
    assert_eq!(kept, accepted);
    let accepted = all(add_notes);
    let notes: Value =
        serde_json::from_str(&fs::read_to_string(home.join("runs/studio-1/care-notes.json")).unwrap()).unwrap();
    let kept: BTreeSet<String> =
        notes["notes"].as_array().unwrap().iter().map(|note| note["day"].as_str().unwrap().to_owned()).collect();
    assert_eq!(kept, accepted);
    // No lock and no partial file stays.
    let names = fs::read_dir(&home).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let left: Vec<String> = names.filter(|name| name.ends_with(".lock") || name.ends_with(".part")).collect();
    assert_eq!(left, [""; 0]);
}
