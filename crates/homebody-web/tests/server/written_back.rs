//! A home whose folder is missing.

use super::desk::all_files;
use super::served::Served;
use serde_json::{Value, json};
use std::fs;

/// Whoever has read the files of a home that is gone can write them back.
#[test]
fn a_home_whose_folder_is_gone_is_written_back() {
    let served = Served::scenario("studio");
    let folder = served.file("studio", "home.json").parent().unwrap().to_owned();
    let whole = all_files(&folder);
    let files = serde_json::from_slice::<Value>(&served.api("/api/files").body).unwrap()["files"].clone();
    fs::remove_dir_all(&folder).unwrap();
    let fresh = |file: &Value| json!({ "name": file["name"], "text": file["text"], "version": null });
    let all: Vec<Value> = files.as_array().unwrap().iter().map(fresh).collect();
    // Not of some of them alone, which would be no home, nor with one that has no place there.
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
