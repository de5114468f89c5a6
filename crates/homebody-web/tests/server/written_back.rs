//! A home whose folder is missing.

use super::drafts::all_files;
use super::served::Served;
use serde_json::{Value, json};
use std::fs;

/// A page that has read the files of a deleted home can save them again.
#[test]
fn restores_the_folder_of_a_home_on_saving() {
    let served = Served::scenario("studio");
    let folder = served.file("studio", "home.json").parent().unwrap().to_owned();
    let whole = all_files(&folder);
    let files = serde_json::from_slice::<Value>(&served.api("/api/files").body).unwrap()["files"].clone();
    fs::remove_dir_all(&folder).unwrap();
    let fresh = |file: &Value| json!({ "name": file["name"], "text": file["text"], "version": null });
    let all: Vec<Value> = files.as_array().unwrap().iter().map(fresh).collect();
    // Not only some of them, and not with a file without a place there.
    let some: Vec<&Value> = all.iter().filter(|file| file["name"] != "scenario.json").collect();
    let odd = [&all[..], &[json!({ "name": "../out.json", "text": "", "version": null })]].concat();
    for files in [json!(some), json!(odd)] {
        assert_eq!(served.post("/api/files", &json!({ "files": files })).code, 422);
        assert!(!folder.exists());
    }
    served.told("/api/files", &json!({ "files": all }));
    assert_eq!(all_files(&folder), whole);
    assert_eq!(served.told("/api/check", &json!({ "texts": {} }))["problems"], json!([]));
}
