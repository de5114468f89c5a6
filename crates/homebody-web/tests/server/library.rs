//! A folder of homes: its first page, and the requests that change homes.

use super::served::{Heard, LONGEST_WAIT, Page, Served};
use homebody_web::library::Library;
use homebody_web::{Options, address_file};
use serde_json::{Value, json};
use std::fs;
use std::io::{Cursor, Write};
use std::path::Path;
use std::time::Instant;
use tungstenite::Message;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

impl Served {
    fn json(&self, path: &str) -> Value {
        let answer = self.api(path);
        assert_eq!(answer.code, 200, "{path}: {}", String::from_utf8_lossy(&answer.body));
        serde_json::from_slice(&answer.body).unwrap()
    }

    fn homes(&self) -> Vec<String> {
        let homes = self.json("/api/library")["homes"].clone();
        let mut names: Vec<String> =
            homes.as_array().unwrap().iter().map(|home| home["name"].as_str().unwrap().to_owned()).collect();
        names.sort();
        names
    }

    /// The status of a refusal, and its message.
    fn refusal(&self, method: &str, path: &str, body: &Value) -> (u16, Value) {
        let answer = self.send(method, path, body.to_string().as_bytes());
        (answer.code, answer.refusal())
    }
}

fn text(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn creates_copies_renames_deletes_and_restores_homes() {
    let served = Served::library(&["studio"]);
    let at = |path: &str| served.folder.path().join(path);
    // A file and a hidden folder are not homes.
    fs::create_dir(at("notes")).unwrap();
    fs::create_dir(at(".hidden")).unwrap();
    fs::write(at(".hidden/scenario.json"), "{}").unwrap();
    assert_eq!(served.homes(), ["studio"]);
    served.told("/api/library/homes/a%20flat", &json!({ "from": "template", "name": "tigerplace" }));
    served.told("/api/library/homes/nothing", &json!({ "from": "empty" }));
    assert_eq!(served.homes(), ["a flat", "nothing", "studio"]);
    assert_eq!(text(&at("a flat/scenario.json"))["name"], "a flat");
    let card = served.json("/api/library/homes/a%20flat");
    assert_eq!((&card["problems"], &card["residents"]), (&json!(0), &json!(["margaret"])));
    assert!(card["home"].as_str().unwrap().contains("\"rooms\""));
    assert!(
        served.json("/api/library/homes/nothing")["problems"].as_u64().unwrap() > 0,
        "nobody can live in an empty home"
    );

    served.told("/api/library/homes/studio/copy", &json!({ "name": "studio, too" }));
    fs::create_dir_all(at("studio/runs/mine")).unwrap();
    served.told("/api/library/homes/studio/name", &json!({ "name": "attic" }));
    assert_eq!(served.homes(), ["a flat", "attic", "nothing", "studio, too"]);
    assert!(at("attic/runs/mine").is_dir(), "its runs have come along");
    assert_eq!(text(&at("attic/scenario.json"))["name"], "attic");
    assert_eq!(text(&at("studio, too/scenario.json"))["name"], "studio, too");

    let answer = served.send("DELETE", "/api/library/homes/attic", b"");
    let aside: Value = serde_json::from_slice(&answer.body).unwrap();
    assert_eq!(served.homes(), ["a flat", "nothing", "studio, too"]);
    assert_eq!(served.json("/api/library")["aside"], json!([{ "key": aside["key"], "name": "attic" }]));
    let back = format!("/api/library/put-aside/{}", aside["key"].as_str().unwrap());
    served.told(&back, &json!({}));
    assert!(at("attic/runs/mine").is_dir());
    assert_eq!(served.refusal("POST", &back, &json!({})).0, 404);
    assert_eq!(served.json("/api/library")["aside"], json!([]));
    // No hidden folder stays.
    let hidden = fs::read_dir(served.folder.path()).unwrap().flatten();
    let hidden = hidden.filter(|entry| entry.file_name().to_string_lossy().starts_with(".new-")).count();
    assert_eq!(hidden, 0);
}

#[test]
fn rejects_invalid_names_with_all_faults() {
    let served = Served::library(&["studio"]);
    let long = "n".repeat(4000);
    let given = fs::read_dir(served.folder.path()).unwrap().count();
    for name in ["..", ".hidden", "a%2Fb", "%2Fetc", "..%2F..%2Fetc", "a%00b", "runs", "%20", "a.", "a%3Ab", &long] {
        let (code, why) = served.refusal("POST", &format!("/api/library/homes/{name}"), &json!({ "from": "empty" }));
        assert!(code == 422 || code == 404, "{name}: {code} {why}");
        assert!(why["what"].as_str().unwrap_or_default().len() < 500, "{why}");
        for path in [format!("/api/library/homes/{name}/copy"), format!("/api/library/homes/{name}/name")] {
            assert!(served.refusal("POST", &path, &json!({ "name": "b" })).0 >= 404, "{path}");
        }
        assert_eq!(served.refusal("DELETE", &format!("/api/library/homes/{name}"), &json!({})).0, 404, "{name}");
        assert_eq!(served.api(&format!("/api/homes/{name}/files")).code, 404, "{name}");
    }
    let (_, why) = served.refusal("POST", "/api/library/homes/studio/name", &json!({ "name": format!(".{long}/") }));
    assert_eq!(
        (&why["code"], why["data"]["why"].as_array().unwrap().len()),
        (&json!("library::invalid-name"), 3),
        "{why}"
    );
    let (code, why) = served.refusal("POST", "/api/library/homes/studio/copy", &json!({ "name": "studio" }));
    assert_eq!(
        (code, &why["code"], &why["data"]["name"]),
        (422, &json!("library::name-used"), &json!("studio")),
        "{why}"
    );
    assert_eq!(why["what"], "The name studio is already in use here. Choose another name.");
    assert_eq!(fs::read_dir(served.folder.path()).unwrap().count(), given);
}

#[cfg(unix)]
#[test]
fn follows_no_link_out_of_a_library() {
    let elsewhere = tempfile::tempdir().unwrap();
    fs::write(elsewhere.path().join("scenario.json"), "{}").unwrap();
    let served = Served::library(&["studio"]);
    std::os::unix::fs::symlink(elsewhere.path(), served.folder.path().join("link")).unwrap();
    assert_eq!(served.homes(), ["studio"]);
    assert_eq!(served.api("/api/homes/link/files").code, 404);
    assert_eq!(served.api("/api/library/homes/link").code, 404);
    // A home with a link is not copied, and leaves no partial copy.
    std::os::unix::fs::symlink("/etc/hostname", served.folder.path().join("studio/link")).unwrap();
    let (code, why) = served.refusal("POST", "/api/library/homes/studio/copy", &json!({ "name": "copy" }));
    assert_eq!((code, &why["code"]), (422, &json!("library::not-plain")), "{why}");
    assert_eq!(served.homes(), ["studio"]);
}

#[cfg(unix)]
#[test]
fn rejects_homes_with_linked_runs() {
    let elsewhere = tempfile::tempdir().unwrap();
    let served = Served::library(&["studio", "by-hand"]);
    // The same for a home that is open already.
    assert_eq!(served.api("/api/homes/studio/runs").code, 200);
    std::os::unix::fs::symlink(elsewhere.path(), served.folder.path().join("studio/runs")).unwrap();
    for path in ["/api/homes/studio/runs", "/api/homes/studio/files", "/api/library/homes/studio"] {
        let answer = served.api(path);
        let why = answer.refusal();
        assert_eq!((answer.code, &why["code"]), (422, &json!("library::linked-runs")), "{path}: {why}");
    }
    assert_eq!(fs::read_dir(elsewhere.path()).unwrap().count(), 0);
    // The control: another home has its own runs.
    assert_eq!(served.api("/api/homes/by-hand/runs").code, 200);
}

#[test]
fn rejects_invisible_names() {
    let served = Served::library(&[]);
    for name in ["%E2%80%8B", "a%E2%80%AEb", "%EF%BB%BF", "flat%E2%81%A6"] {
        let (code, why) = served.refusal("POST", &format!("/api/library/homes/{name}"), &json!({ "from": "empty" }));
        let is_told = why["data"]["why"].to_string().contains("an invisible character");
        assert!(code == 422 && is_told, "{name}: {code} {why}");
    }
    assert_eq!(served.homes(), [""; 0]);
}

/// Each home has its own run: a page of one does not affect the other.
#[test]
fn two_homes_run_at_once_with_separate_runs() {
    let served = Served::library(&["studio", "by-hand"]);
    let mut pages: Vec<Page> =
        ["studio", "by-hand"].map(|name| served.page_at(&format!("/api/homes/{name}/live"))).into();
    let goes_on = |name: &str| served.json(&format!("/api/library/homes/{name}"))["goes_on"].clone();
    for (page, name) in pages.iter_mut().zip(["studio", "by-hand"]) {
        page.say(r#"{"say":"step","seconds":60}"#);
        page.until(|frame| frame["now_us"] == 60_000_000 && frame["state"] == "paused");
        assert_eq!(goes_on(name), format!("{name}-1"));
        page.say(r#"{"say":"stop"}"#);
        page.until(|frame| frame["state"] == "over");
        assert_eq!(goes_on(name), Value::Null);
    }
    for name in ["studio", "by-hand"] {
        let runs = served.json(&format!("/api/homes/{name}/runs"));
        assert_eq!(runs.as_array().unwrap().len(), 1, "{runs}");
        assert_eq!(runs[0]["scenario"], name);
        assert!(served.folder.path().join(name).join("runs").join(format!("{name}-1")).is_dir());
        let card = served.json(&format!("/api/library/homes/{name}"));
        assert_eq!((&card["runs"], &card["latest"][0]["name"]), (&json!(1), &json!(format!("{name}-1"))));
        let hours = served.json(&format!("/api/library/homes/{name}/runs/{name}-1"));
        let rows: u64 = hours[0].as_array().unwrap().iter().map(|rows| rows.as_u64().unwrap()).sum();
        assert_eq!((hours.as_array().unwrap().len(), hours[0].as_array().unwrap().len()), (1, 24));
        assert!(rows > 0 || name == "studio", "{hours}");
    }
}

/// The close code of a page's socket.
fn closed_with(page: &mut Page) -> u16 {
    let begun = Instant::now();
    loop {
        match page.socket.read() {
            Ok(Message::Close(Some(frame))) => return frame.code.into(),
            Ok(_) => assert!(begun.elapsed() < LONGEST_WAIT, "it is not closed"),
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn pages_of_a_renamed_home_close_and_its_run_is_complete() {
    let served = Served::library(&["by-hand"]);
    let mut page = served.page_at("/api/homes/by-hand/live");
    page.say(r#"{"say":"step","seconds":60}"#);
    page.until(|frame| frame["now_us"] == 60_000_000);
    served.told("/api/library/homes/by-hand/name", &json!({ "name": "other" }));
    assert_eq!(closed_with(&mut page), 4404);
    assert_eq!(closed_with(&mut served.page_at("/api/homes/by-hand/live")), 4404, "it is not there any more");
    let runs = served.json("/api/homes/other/runs");
    assert_eq!((runs.as_array().unwrap().len(), &runs[0]["problem"]), (1, &Value::Null), "{runs}");
    // Without the token a client does not learn the names of homes.
    for name in ["other", "by-hand"] {
        let mut stranger = Page { socket: served.socket_at(&format!("/api/homes/{name}/live")) };
        stranger.say(r#"{"say":"hello","token":"guessed"}"#);
        assert_eq!(closed_with(&mut stranger), 4401);
        assert_eq!(served.get(&format!("/api/homes/{name}/files"), "").code, 401);
        assert_eq!(served.get(&format!("/homes/{name}/"), "").code, 200);
    }
    assert!(matches!(served.page_at("/api/homes/other/live").hear(), Heard::Tell(_)));
}

/// A page whose server ends waits for the next one; only the page of a deleted home closes.
#[test]
fn reports_no_home_as_deleted_at_its_end() {
    let mut served = Served::library(&["by-hand"]);
    let mut page = served.page_at("/api/homes/by-hand/live");
    page.until(|_| true);
    served.close();
    let is_gone = |message: &Message| matches!(message, Message::Close(Some(frame)) if u16::from(frame.code) == 4404);
    while let Ok(message) = page.socket.read() {
        assert!(!is_gone(&message));
    }
}

/// Drafts of a home in a library behave as those of a single home: saving replaces only known versions.
#[test]
fn keeps_changes_of_two_pages_of_one_home() {
    let served = Served::library(&["studio"]);
    let versions = served.json("/api/homes/studio/files/versions");
    let save =
        |text: &str| json!({ "files": [{ "name": "home.json", "text": text, "version": versions["home.json"] }] });
    let first = served.told("/api/homes/studio/files", &save("{ \"first\": 1 }"));
    assert!(first["saved"]["home.json"].is_string(), "{first}");
    let second = served.told("/api/homes/studio/files", &save("{ \"second\": 1 }"));
    assert_eq!(second["changed"][0]["text"], "{ \"first\": 1 }");
    assert_eq!(text(&served.folder.path().join("studio/home.json")), json!({ "first": 1 }));
}

#[test]
fn unwatched_homes_close_when_too_many_are_open() {
    let served = Served::library(&["by-hand"]);
    let names: Vec<String> = (0..20).map(|number| format!("home {number}")).collect();
    for name in &names {
        served.told("/api/library/homes/by-hand/copy", &json!({ "name": name }));
    }
    let path = |name: &str, rest: &str| format!("/api/homes/{}/{rest}", name.replace(' ', "%20"));
    for name in &names {
        assert_eq!(served.api(&path(name, "runs")).code, 200, "{name}");
    }
    let mut pages = Vec::new();
    for name in &names[..16] {
        let mut page = served.page_at(&path(name, "live"));
        page.until(|_| true);
        pages.push(page);
    }
    let answer = served.api(&path(&names[16], "runs"));
    assert_eq!(answer.code, 503, "{}", String::from_utf8_lossy(&answer.body));
    drop(pages.remove(3));
    let is_free = |_: u32| {
        std::thread::sleep(std::time::Duration::from_millis(50));
        served.api(&path(&names[16], "runs")).code == 200
    };
    assert!((0..100).any(is_free), "the place of a page that is gone becomes free");
}

/// No user can write into `/proc`, not even root.
#[cfg(target_os = "linux")]
#[test]
fn reports_a_read_only_folder() {
    let library = Library::new("/proc".into(), false);
    let served = Served::of(tempfile::tempdir().unwrap(), Options { port: Some(0), ..Options::new(library) });
    let view = served.json("/api/library");
    assert!(view["trouble"].as_str().unwrap().contains("Cannot write to this folder"), "{view}");
    let (code, why) = served.refusal("POST", "/api/library/homes/mine", &json!({ "from": "empty" }));
    assert_eq!((code, &why["code"]), (422, &json!("library::not-writable")), "{why}");
}

#[test]
fn lists_a_thousand_homes_and_counts_the_others() {
    let folder = tempfile::tempdir().unwrap();
    for number in 0..1005 {
        let home = folder.path().join(format!("home {number}"));
        fs::create_dir(&home).unwrap();
        fs::write(home.join("scenario.json"), "{").unwrap();
    }
    let library = Library::new(folder.path().to_owned(), false);
    let view = library.view();
    assert_eq!((view.homes.len(), view.more), (1000, 5));
    // A home with an invalid scenario has a card with its problems.
    assert_eq!(library.card(&view.homes[0].name).unwrap().problems, 1);
}

#[test]
fn creates_homes_from_plans_and_logs() {
    let served = Served::library(&[]);
    let (code, why) = served.refusal("POST", "/api/library/plans/plan", &json!("no plan"));
    assert!(code == 422 && why["code"].as_str().is_some_and(|code| code.starts_with("import::")), "{code} {why}");
    let rows: String = (0..40)
        .map(|minute| {
            let sensor = if minute % 8 < 4 { "bedroom" } else { "kitchen" };
            let said = if minute % 2 == 0 { "ON" } else { "OFF" };
            format!("2026-01-05 07:{minute:02}:00.000000\t{sensor}\t{said}\n")
        })
        .collect();
    let answer = served.send("POST", "/api/library/logs/theirs/week.txt", rows.as_bytes());
    assert_eq!(answer.code, 200, "{}", String::from_utf8_lossy(&answer.body));
    let made: Value = serde_json::from_slice(&answer.body).unwrap();
    assert!(!made["remarks"].as_array().unwrap().is_empty(), "a schematic home says what it lacks");
    let home = text(&served.folder.path().join("theirs/home.json"));
    let rooms: Vec<&str> =
        home["rooms"].as_array().unwrap().iter().map(|room| room["name"].as_str().unwrap()).collect();
    assert!(rooms.contains(&"bedroom") && rooms.contains(&"kitchen"), "{rooms:?}");
    // The hint about names without a room fits the page.
    let placeless = rows.replace("bedroom", "M001").replace("kitchen", "M002");
    let answer = served.send("POST", "/api/library/logs/none/week.txt", placeless.as_bytes());
    let why = answer.refusal()["what"].as_str().unwrap().to_owned();
    assert!(
        answer.code == 422 && why.contains("M001") && why.contains("draw its rooms") && !why.contains("--"),
        "{why}"
    );
    let answer = served.send("POST", "/api/library/logs/none/week.txt", b"this is no log");
    let why = String::from_utf8_lossy(&answer.body).into_owned();
    assert!(answer.code == 422 && why.contains("week.txt") && !why.contains(".new-"), "{why}");
    assert_eq!(served.homes(), ["theirs"]);
}

/// Missing parts of a plan are problems, and the home works as soon as they are added.
#[test]
fn the_page_adds_what_a_plan_lacks_for_a_resident() {
    let served = Served::library(&[]);
    let corners = [(0, 0), (600, 0), (600, 400), (0, 400)];
    let walls = (0..4).map(|side| {
        let [(x, y), (to_x, to_y)] = [corners[side], corners[(side + 1) % 4]];
        format!("<wall xStart='{x}' yStart='{y}' xEnd='{to_x}' yEnd='{to_y}' thickness='20'/>")
    });
    let points = corners.map(|(x, y)| format!("<point x='{x}' y='{y}'/>")).concat();
    let mut plan = ZipWriter::new(Cursor::new(Vec::new()));
    plan.start_file("Home.xml", SimpleFileOptions::default()).unwrap();
    write!(
        plan,
        "<home version='7200'>{}<room name='Kitchen'>{points}</room>\
         <doorOrWindow name='Front door' x='300' y='400' width='90' depth='20' height='210'/></home>",
        walls.collect::<String>()
    )
    .unwrap();
    let answer = served.send("POST", "/api/library/plans/mine", &plan.finish().unwrap().into_inner());
    let made: Value = serde_json::from_slice(&answer.body).unwrap();
    let remarks = made["remarks"].to_string();
    assert!(remarks.contains("the home has no place to sleep") && !remarks.contains("hint"), "{remarks}");
    let folder = served.folder.path().join("mine");
    assert_eq!(text(&folder.join("anna.json"))["driver"]["routine"], "anna.routine");
    let check = served.told("/api/homes/mine/check", &json!({ "texts": {} }));
    assert!(check["problems"].to_string().contains("the home has no place to sleep"), "{check}");
}

/// Address and token stay after a restart; without the file the token changes.
#[test]
fn keeps_the_address_for_the_next_server() {
    let files = tempfile::tempdir().unwrap();
    let kept = files.path().join("address");
    let serve = |kept: Option<&Path>, port| {
        let folder = tempfile::tempdir().unwrap();
        let library = Library::new(folder.path().to_owned(), false);
        Served::of(folder, Options { port, kept: kept.map(Path::to_owned), ..Options::new(library) })
    };
    let first = serve(Some(&kept), Some(0));
    let (address, token) = (first.address, first.token.clone());
    drop(first);
    assert_eq!(address_file::read(&kept).unwrap().unwrap().port, address.port());
    let second = serve(Some(&kept), None);
    assert_eq!((second.address, &second.token), (address, &token));
    assert_eq!(second.api("/api/library").code, 200);
    drop(second);
    assert_ne!(serve(None, Some(0)).token, token);
}
