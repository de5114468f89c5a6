//! Files that users write in the page: questions about them, and saving.

use super::served::Served;
use homebody_core::event::Events;
use homebody_core::ids::SensorId;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::RunTime;
use homebody_routine::household::{Household, RoutineLanguage};
use homebody_web::folders::HomeFolders;
use rusqlite::Connection;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

impl Served {
    pub fn told(&self, path: &str, body: &Value) -> Value {
        let answer = self.post(path, body);
        assert_eq!(answer.code, 200, "{path}: {}", String::from_utf8_lossy(&answer.body));
        match answer.head.contains("msgpack") {
            true => rmp_serde::from_slice(&answer.body).unwrap(),
            false => serde_json::from_slice(&answer.body).unwrap(),
        }
    }

    pub fn file(&self, scenario: &str, name: &str) -> PathBuf {
        self.folder.path().join(scenario).join(name)
    }

    fn version(&self, name: &str) -> String {
        let versions: Value = serde_json::from_slice(&self.api("/api/files/versions").body).unwrap();
        versions[name].as_str().unwrap().to_owned()
    }
}

pub fn draft(name: &str, text: &str) -> Value {
    json!({ "texts": { name: text } })
}

/// All files below a folder with their bytes.
pub fn all_files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_symlink() {
            continue;
        }
        if path.is_dir() {
            files.extend(all_files(&path));
        } else {
            files.insert(path.clone(), fs::read(&path).unwrap());
        }
    }
    files
}

#[test]
fn lists_files_with_their_roles() {
    let served = Served::scenario("couple-with-cat");
    fs::create_dir(served.file("couple-with-cat", "conditions")).unwrap();
    fs::write(served.file("couple-with-cat", "conditions/flu.routine"), "she sleeps longer").unwrap();
    fs::write(served.file("couple-with-cat", "notes.txt"), "not written in the page").unwrap();
    let files: Value = serde_json::from_slice(&served.api("/api/files").body).unwrap();
    assert_eq!(
        (&files["entry"], &files["home"], &files["logger"]),
        (&json!("scenario.json"), &json!("home.json"), &json!("logger.json"))
    );
    assert_eq!(files["lives"].as_array().unwrap().len(), 3);
    assert!(
        files["lives"].as_array().unwrap().contains(&json!({ "name": "minka", "routine": "minka.routine" })),
        "{}",
        files["lives"]
    );
    let names: Vec<&str> =
        files["files"].as_array().unwrap().iter().map(|file| file["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"conditions/flu.routine") && !names.contains(&"notes.txt"), "{names:?}");
    let home = files["files"].as_array().unwrap().iter().find(|file| file["name"] == "home.json").unwrap();
    assert_eq!(
        home["text"].as_str().unwrap(),
        fs::read_to_string(served.file("couple-with-cat", "home.json")).unwrap()
    );
    assert_eq!(home["version"], served.version("home.json"));
}

#[test]
fn saves_all_or_nothing_over_known_versions() {
    let served = Served::scenario("studio");
    let (home, routine) = (served.file("studio", "home.json"), served.file("studio", "walter.routine"));
    let old = fs::read_to_string(&home).unwrap();
    let seen = served.version("home.json");
    let save = |name: &str, text: &str, version: Value| json!({ "name": name, "text": text, "version": version });

    let new = old.replacen("1", "2", 1);
    let told = served.told("/api/files", &json!({ "files": [save("home.json", &new, json!(seen))] }));
    assert_eq!((fs::read_to_string(&home).unwrap(), &told["changed"]), (new.clone(), &json!([])));
    assert_eq!(told["saved"]["home.json"], served.version("home.json"));

    // The text was based on a file that has changed: neither file is written.
    let before = all_files(served.folder.path());
    let both =
        [save("home.json", "{}", json!(seen)), save("walter.routine", "", json!(served.version("walter.routine")))];
    let told = served.told("/api/files", &json!({ "files": both }));
    assert_eq!(told["saved"], json!({}));
    assert_eq!((&told["changed"][0]["name"], &told["changed"][0]["text"]), (&json!("home.json"), &json!(new)));
    assert_eq!(all_files(served.folder.path()), before);

    let twice = [save("new.json", "1", Value::Null), save("new.json", "2", Value::Null)];
    assert_eq!(served.post("/api/files", &json!({ "files": twice })).code, 422);
    assert_eq!(all_files(served.folder.path()), before);

    // A new file replaces no other. A deleted file is created again if the page knows that it was deleted.
    let told = served.told("/api/files", &json!({ "files": [save("walter.routine", "", Value::Null)] }));
    assert_eq!(told["changed"][0]["name"], "walter.routine");
    fs::remove_file(&routine).unwrap();
    let told = served.told("/api/files", &json!({ "files": [save("walter.routine", "a", json!("0"))] }));
    assert_eq!(told["changed"][0], json!({ "name": "walter.routine", "text": "", "version": "" }));
    assert!(!routine.exists());
    served.told("/api/files", &json!({ "files": [save("walter.routine", "a", json!(""))] }));
    assert_eq!(fs::read_to_string(&routine).unwrap(), "a");
    assert!(all_files(served.folder.path()).keys().all(|path| !path.to_string_lossy().contains(".part")));

    // A byte order mark stays. The folder of conditions is created with its first file.
    fs::write(&routine, "\u{feff}a").unwrap();
    let seen = json!(served.version("walter.routine"));
    let both = [save("walter.routine", "b", seen), save("conditions/flu.routine", "she sleeps longer", Value::Null)];
    served.told("/api/files", &json!({ "files": both }));
    assert_eq!(fs::read_to_string(&routine).unwrap(), "\u{feff}b");
    assert!(served.file("studio", "conditions/flu.routine").exists());
}

#[test]
fn writes_only_plain_files_of_the_scenario() {
    let served = Served::scenario("studio");
    let outside = served.folder.path().join("outside.json");
    fs::write(&outside, "{}").unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink(&outside, served.file("studio", "link.json")).unwrap();
        let elsewhere = served.folder.path().join("elsewhere");
        fs::create_dir(&elsewhere).unwrap();
        symlink(&elsewhere, served.file("studio", "conditions")).unwrap();
    }
    let before = all_files(served.folder.path());
    let absolute = outside.to_string_lossy().into_owned();
    let mut names: Vec<String> = ["..", "", "log.db", "a.json.exe", "link.json", "conditions/outside.json", &absolute]
        .map(str::to_owned)
        .to_vec();
    names.push("a".repeat(300) + ".json");
    let ways = [
        "../",
        "..\\",
        "/",
        "//",
        "\\\\server\\",
        "./",
        ".",
        "a/",
        "a\\",
        "c:",
        "c:/",
        "\0",
        "a\0",
        "conditions/../",
        "/proc/self/",
    ];
    for way in ways {
        for again in ["", "../", "..\\", "conditions/", "x/../../"] {
            for target in ["outside.json", "home.json", "etc/passwd.json", "a.routine", "\0.json"] {
                names.push(format!("{way}{again}{target}"));
                names.push(format!("conditions/{way}{again}{target}"));
            }
        }
    }
    for name in &names {
        let file = json!({ "name": name, "text": "x", "version": null });
        let answer = served.post("/api/files", &json!({ "files": [file] }));
        assert_eq!(answer.code, 422, "{name:?}");
    }
    // A link is not a file of the page, and nothing replaces it.
    if cfg!(unix) {
        let files: Value = serde_json::from_slice(&served.api("/api/files").body).unwrap();
        assert!(!files.to_string().contains("link.json"));
    }
    assert_eq!(all_files(served.folder.path()), before);
}

#[test]
fn checks_drafts_without_touching_files() {
    let served = Served::scenario("tigerplace");
    let before = all_files(served.folder.path());
    assert_eq!(served.told("/api/check", &json!({ "texts": {} })), json!({ "problems": [], "warnings": [] }));
    let routine = before[&served.file("tigerplace", "margaret.routine")].clone();
    let routine = String::from_utf8(routine).unwrap() + "\nShe gest up early.\n";
    let home = String::from_utf8(before[&served.file("tigerplace", "home.json")].clone()).unwrap();
    let home = home.replacen("\"thickness_m\": 0.2", "\"thickness_m\": -0.2", 1);
    let told = served.told("/api/check", &json!({ "texts": { "margaret.routine": routine, "home.json": home } }));
    let shelf = HomeFolders {
        scenario: served.file("tigerplace", ""),
        entry: "scenario.json".into(),
        is_trusted: false,
        runs: "runs".into(),
    };
    let files: BTreeMap<String, String> = before
        .iter()
        .map(|(path, bytes)| {
            (path.file_name().unwrap().to_str().unwrap().into(), String::from_utf8(bytes.clone()).unwrap())
        })
        .chain([("margaret.routine".into(), routine), ("home.json".into(), home)])
        .collect();
    let wrong = Scenario::load_in(&mut RoutineLanguage::default(), &files, &shelf.entry).unwrap_err();
    let problems = told["problems"].as_array().unwrap();
    assert_eq!(problems.len(), wrong.0.len());
    assert!(problems.len() >= 2 || wrong.0.len() == 1);
    for (told, problem) in problems.iter().zip(&wrong.0) {
        assert_eq!(
            (&told["file"], &told["line"], &told["column"]),
            (&json!(problem.file), &json!(problem.line), &json!(problem.column))
        );
        assert_eq!((&told["what"], &told["hint"]), (&json!(problem.what), &json!(problem.hint)));
        assert_eq!(told["fix"], json!(problem.fix));
    }
    assert_eq!(all_files(served.folder.path()), before);
}

fn scenario(served: &Served, name: &str) -> (Scenario, Household) {
    let shelf = HomeFolders {
        scenario: served.file(name, ""),
        entry: "scenario.json".into(),
        is_trusted: false,
        runs: "runs".into(),
    };
    Household::load(&shelf, &shelf.entry, &[]).unwrap()
}

#[test]
fn explains_routines_with_an_invalid_sentence() {
    let served = Served::scenario("tigerplace-depression");
    let text = fs::read_to_string(served.file("tigerplace-depression", "margaret.routine")).unwrap();
    let asked = |text: &str| json!({ "draft": draft("margaret.routine", text), "file": "margaret.routine" });
    let whole = served.told("/api/explain", &asked(&text));
    assert_eq!(whole["problems"], json!([]));
    let severity = whole["conditions"][0]["severity"].as_array().unwrap();
    assert_eq!((&whole["conditions"][0]["name"], severity.len()), (&json!("depression"), 120));
    // From week 6, over 4 weeks: the first five weeks are free of it, and from the ninth it has its full strength.
    let at = |day: usize| severity[day].as_f64().unwrap();
    assert_eq!((at(34), at(62), at(119)), (0.0, 1.0, 1.0));
    assert!(at(35) > 0.0 && at(48) > 0.4 && at(48) < 0.6);
    let wrong = served.told("/api/explain", &asked(&(text.clone() + "She gest up.\n")));
    assert_eq!(wrong["sentences"], whole["sentences"]);
    assert_eq!(wrong["problems"][0]["line"], text.lines().count() + 1);
    let has = |kind: &str, text: &str| {
        whole["words"].as_array().unwrap().iter().any(|word| word["kind"] == kind && word["text"] == text)
    };
    assert!(has("place", "armchair") && has("condition", "severe heart failure") && has("activity", "takes a shower"));
    let nobodys = served.told("/api/explain", &json!({ "draft": { "texts": {} }, "file": "other.routine" }));
    assert_eq!(nobodys["problems"][0]["what"], "no resident uses this routine");
}

#[test]
fn simulates_a_month_like_a_run() {
    let served = Served::scenario("tigerplace-depression");
    let asked = |without: &[&str]| json!({ "draft": { "texts": {} }, "from": 55, "days": 10, "without": without });
    let month = served.told("/api/month", &asked(&[]));
    let (scenario, household) = scenario(&served, "tigerplace-depression");
    let instant = |us: &Value| RunTime::from_micros(us.as_i64().unwrap());
    let end = instant(&month["days"][9]["end_us"]);
    let mut run = Run::new(&scenario, &household, scenario.file.seed, end.since_zero());
    let mut events = Events::default();
    run.advance(end, &mut events).unwrap();
    let begin = instant(&month["days"][0]["begin_us"]);
    let motion = |sensor: SensorId| run.sensors()[sensor.index()].senses_motion();
    let fired = events.firings.iter().filter(|firing| motion(firing.sensor) && firing.at >= begin).count() as u64;
    let hours = |month: &Value| -> u64 {
        month["hours"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|day| day.as_array().unwrap())
            .map(|hour| hour.as_u64().unwrap())
            .sum()
    };
    assert_eq!(hours(&month), fired);
    // The activities leave no gaps.
    let spans = month["spans"][0].as_array().unwrap();
    assert!(spans.len() > 100);
    assert!(spans.windows(2).all(|pair| pair[0][1].as_i64() <= pair[1][0].as_i64()));
    let activities = month["activities"].as_array().unwrap();
    assert!(spans.iter().all(|span| (span[2].as_u64().unwrap() as usize) < activities.len()));
    let without = served.told("/api/month", &asked(&["depression"]));
    assert!(hours(&without) > hours(&month), "{} {}", hours(&without), hours(&month));
    let unknown = served.told("/api/month", &asked(&["hiccups"]));
    assert!(unknown["problems"][0]["what"].as_str().unwrap().contains("hiccups"));
    assert!(!served.folder.path().join("runs").exists(), "a draft leaves no run");
}

#[test]
fn first_rows_and_counts_equal_those_of_a_run() {
    let served = Served::scenario("tigerplace");
    let text = fs::read_to_string(served.file("tigerplace", "logger.json")).unwrap();
    let mut logger: Value = serde_json::from_str(&text).unwrap();
    logger["to"] = json!(["sqlite:log.db", "csv:log.csv", "casas:log.txt"]);
    let told = served.told("/api/rows", &draft("logger.json", &logger.to_string()));
    let places = told["places"].as_array().unwrap();
    assert_eq!(places.len(), 3, "{}", told["problems"]);
    assert_eq!(
        (&places[0]["table"], &places[0]["columns"]),
        (&json!("event"), &json!(["run_id", "seq", "ts_local", "sensor_id", "event_code"]))
    );
    assert_eq!(places[1]["columns"], json!(["seq", "ts_local", "sensor_id", "event_code"]));
    assert!(!served.folder.path().join("runs").exists());

    let mut page = served.page();
    page.say(r#"{"say":"speed","times":null}"#);
    page.say(r#"{"say":"jump","to_us":93600000000}"#);
    page.say(r#"{"say":"play"}"#);
    page.until(|frame| frame["now_us"].as_i64() >= Some(93_600_000_000));
    page.say(r#"{"say":"stop"}"#);
    page.until(|frame| frame["state"] == "over");
    let log = Connection::open(served.only_run().join("log.db")).unwrap();
    let mut select = log.prepare("SELECT seq, ts_local, sensor_id, event_code FROM event ORDER BY seq").unwrap();
    let text = |row: &rusqlite::Row, at| row.get::<_, String>(at);
    let rows: Vec<[String; 4]> = select
        .query_map([], |row| Ok([row.get::<_, i64>(0)?.to_string(), text(row, 1)?, text(row, 2)?, text(row, 3)?]))
        .unwrap()
        .map(Result::unwrap)
        .collect();
    let shown = places[0]["rows"].as_array().unwrap();
    assert_eq!(shown.len(), 40);
    for (shown, row) in shown.iter().zip(&rows) {
        assert_eq!(shown.as_array().unwrap()[1..], row.iter().map(|text| json!(text)).collect::<Vec<_>>());
    }
    let in_casas: Vec<Value> = rows[..40].iter().map(|row| json!(&row[1..])).collect();
    assert_eq!(places[2]["rows"], json!(in_casas));

    let growth: Value = serde_json::from_slice(&served.api("/api/growth").body).unwrap();
    assert_eq!(growth["hours"].as_array().unwrap().len(), 2);
    // The bed and the stove are not motion sensors.
    let motion: Vec<&[String; 4]> = rows.iter().filter(|row| row[2] != "C1" && row[2] != "C3").collect();
    for (day, date) in ["2009-03-02", "2009-03-03"].iter().enumerate() {
        for hour in 0..24 {
            let began = format!("{date} {hour:02}");
            let there = motion.iter().filter(|row| row[1].starts_with(&began)).count();
            assert_eq!(growth["hours"][day][hour], there, "{began}");
        }
    }
    let today = rows.iter().filter(|row| row[1].starts_with("2009-03-03")).count();
    assert_eq!(growth["today"].as_array().unwrap().len(), today);
    // A page that connects late gets the firings of each sensor.
    let mut late = served.page();
    let seen = late.until(|_| true);
    let sensors = seen.run["home"]["sensors"].as_array().unwrap();
    let id = |sensor: &Value| &logger["ids"][sensor["name"].as_str().unwrap()];
    let fired: Vec<usize> =
        sensors.iter().map(|sensor| rows.iter().filter(|row| id(sensor) == &row[2]).count()).collect();
    assert_eq!(seen.frame["counts"], json!(fired));
}

#[test]
fn simulates_the_same_month_after_any_other() {
    let asked = |from: u32| json!({ "draft": { "texts": {} }, "from": from, "days": 3, "without": [] });
    let fresh = |from: u32| Served::scenario("tigerplace-depression").told("/api/month", &asked(from));
    let served = Served::scenario("tigerplace-depression");
    let kept = |from: u32| served.told("/api/month", &asked(from));
    kept(100);
    for from in [62, 0, 37, 62, 117] {
        let (kept, fresh) = (kept(from), fresh(from));
        assert_eq!(kept["problems"], json!([]));
        assert_eq!(kept, fresh, "from day {from}");
    }
    // The control: another routine changes the days, and the first routine has the same days again.
    let text = fs::read_to_string(served.file("tigerplace-depression", "margaret.routine")).unwrap();
    let other = text + "She takes a shower every day at 3 pm.\n";
    let changed = served.told(
        "/api/month",
        &json!({ "draft": draft("margaret.routine", &other), "from": 62, "days": 3, "without": [] }),
    );
    assert_eq!(changed["problems"], json!([]));
    assert_ne!(changed["spans"], fresh(62)["spans"]);
    assert_eq!(kept(62), fresh(62));
}

#[test]
fn tries_the_destination_of_a_run_without_harm() {
    let served = Served::scenario("studio");
    let url = "casas:out.txt";
    let file = served.file("studio", "logger.json");
    let mut logger: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    logger["to"] = json!([url]);
    fs::write(&file, logger.to_string()).unwrap();
    let mut page = served.page();
    page.say(r#"{"say":"start","driven":null}"#);
    page.say(r#"{"say":"speed","times":null}"#);
    page.say(r#"{"say":"jump","to_us":43200000000}"#);
    page.until(|frame| frame["now_us"].as_i64() >= Some(43_200_000_000));
    assert_eq!(served.told("/api/connect", &json!({ "url": url }))["works"], true);
    page.say(r#"{"say":"stop"}"#);
    page.until_told("rows in");
    assert!(fs::read_to_string(served.only_run().join("out.txt")).unwrap().lines().count() > 10);
    for url in ["casas:/srv/out.txt", "casas:../out.txt"] {
        let told = served.told("/api/connect", &json!({ "url": url }));
        assert_eq!(told["works"], false);
        assert!(told["said"].as_str().unwrap().contains("is not a file name inside the run's folder"), "{told}");
    }
}

#[test]
fn downloads_logs_under_their_names() {
    let served = Served::scenario("studio");
    let mut page = served.page();
    page.say(r#"{"say":"speed","times":null}"#);
    page.say(r#"{"say":"jump","to_us":43200000000}"#);
    page.until(|frame| frame["now_us"].as_i64() >= Some(43_200_000_000));
    page.say(r#"{"say":"stop"}"#);
    page.until_told("rows in");
    let run = served.only_run();
    let answer = served.api(&format!("/api/runs/{}/log", run.file_name().unwrap().to_str().unwrap()));
    assert!(answer.head.contains("filename=\"log.txt\""), "{}", answer.head);
    assert_eq!(answer.body, fs::read(run.join("log.txt")).unwrap());
}

#[cfg(unix)]
#[test]
fn saving_keeps_the_permissions_of_a_file() {
    use std::os::unix::fs::PermissionsExt;
    let served = Served::scenario("studio");
    let file = served.file("studio", "walter.routine");
    fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).unwrap();
    let files: Value = serde_json::from_slice(&served.api("/api/files").body).unwrap();
    let known = files["files"].as_array().unwrap().iter().find(|file| file["name"] == "walter.routine").unwrap();
    let save = json!({ "name": "walter.routine", "text": "Walter is 80.\n", "version": known["version"] });
    served.told("/api/files", &json!({ "files": [save] }));
    assert_eq!(fs::read_to_string(&file).unwrap(), "Walter is 80.\n");
    assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600);
}

#[test]
fn tries_destinations_without_a_trace() {
    let served = Served::scenario("studio");
    let folder = served.folder.path().to_string_lossy().into_owned();
    let before = all_files(served.folder.path());
    let tried = |url: &str| served.told("/api/connect", &json!({ "url": url }));
    assert_eq!(tried("sqlite:log.db")["works"], true);
    assert_eq!(tried("csv:logs/new.csv")["works"], true);
    for (url, said) in [
        (format!("csv:{folder}/new.csv"), "is not a file name inside the run's folder"),
        ("csv:../new.csv".into(), "is not a file name inside the run's folder"),
        ("mysql:log".into(), "is not a place for a log"),
        ("log.txt".into(), "did you mean \"casas:log.txt\", or \"csv:log.txt\"?"),
    ] {
        let told = tried(&url);
        assert!(told["works"] == false && told["said"].as_str().unwrap().contains(said), "{url}: {told}");
    }
    assert_eq!(all_files(served.folder.path()), before);
}

#[test]
fn refuses_invalid_questions_with_a_reason() {
    let served = Served::scenario("studio");
    for (path, body) in [
        ("/api/check", json!({})),
        ("/api/check", json!({ "texts": { "a": 1 } })),
        ("/api/plan", json!({ "texts": {}, "more": 1 })),
        ("/api/month", json!({ "draft": { "texts": {} }, "from": -1, "days": 3, "without": [] })),
        ("/api/files", json!({ "files": [{ "name": "home.json" }] })),
        ("/api/connect", json!([])),
    ] {
        let answer = served.post(path, &body);
        assert_eq!(answer.code, 422, "{path} {body}");
        assert!(!answer.body.is_empty());
    }
}

#[test]
fn writes_nothing_without_the_token_or_for_another_page() {
    let served = Served::scenario("studio");
    let before = all_files(served.folder.path());
    let file = json!({ "name": "home.json", "text": "x", "version": served.version("home.json") });
    let body = json!({ "files": [file] }).to_string();
    let (address, token) = (served.address, format!("x-homebody-token: {}\r\n", served.token));
    for path in [
        "/api/files",
        "/api/check",
        "/api/plan",
        "/api/explain",
        "/api/statements",
        "/api/statement",
        "/api/month",
        "/api/rows",
        "/api/connect",
        "/api/import",
    ] {
        for (head, code) in [
            ("Content-Type: application/json\r\n".to_owned(), 401),
            (format!("Content-Type: application/json\r\nOrigin: http://evil.com\r\n{token}"), 403),
            (format!("Content-Type: application/json\r\nOrigin: null\r\n{token}"), 403),
            // A request that a form of another page can send.
            ("Content-Type: text/plain\r\nOrigin: http://evil.com\r\n".into(), 403),
            ("Content-Type: application/x-www-form-urlencoded\r\n".into(), 401),
        ] {
            let length = body.len();
            let request = format!(
                "POST {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{head}Content-Length: {length}\r\n\r\n{body}"
            );
            assert_eq!(served.ask(request.as_bytes()).code, code, "{path} {head}");
        }
    }
    let length = body.len();
    let plain = format!(
        "POST /api/files HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{token}Content-Type: text/plain\r\nContent-Length: {length}\r\n\r\n{body}"
    );
    assert_eq!(served.ask(plain.as_bytes()).code, 415);
    assert_eq!(all_files(served.folder.path()), before);
}
