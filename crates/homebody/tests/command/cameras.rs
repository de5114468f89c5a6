//! Silhouettes next to a log, and falls in them.

use crate::folder::{Folder, says};
use rusqlite::Connection;

/// Somebody who walks into the middle of the room, and falls there.
fn fallen() -> Folder {
    let folder = Folder::with("cameras");
    folder.edit("cameras/edith.json", "\"routine\": \"edith.routine\"", "\"path\": \"falls.path.json\"");
    let path = r#"{ "start": [5.8, 1.4], "steps": [{ "wait": { "for_s": 30 } }, { "go": { "to": [[4.9, 2.9]], "pace_mps": 0.7 } },
        { "activity": "fallen" }, { "wait": { "for_s": 120, "posture": "down" } }, { "activity": "" }, { "go": { "to": [[4.4, 1.4]], "pace_mps": 0.3 } }, { "wait": { "for_s": 60 } }] }"#;
    folder.write("cameras/falls.path.json", path);
    folder
}

fn silhouettes(folder: &Folder, run: &str) -> Vec<(i64, String, Vec<u8>)> {
    let database = Connection::open(folder.path(&format!("runs/{run}/silhouettes.db"))).unwrap();
    let mut rows = database.prepare("SELECT utc_us, camera, packed FROM silhouette").unwrap();
    let row = |row: &rusqlite::Row| Ok((row.get(0)?, row.get(1)?, row.get(2)?));
    rows.query_map([], row).unwrap().map(Result::unwrap).collect()
}

#[test]
fn a_fall_before_two_cameras_is_found_and_where_it_was() {
    let folder = fallen();
    folder.run("run cameras --quiet --for 5m").ok();
    let found = folder.run("falls runs/cameras-1 --json").ok().json();
    let falls = found["falls"].as_array().unwrap();
    assert_eq!(falls.len(), 1, "{found}");
    assert_eq!((falls[0]["rule"].as_str(), falls[0]["room"].as_str()), (Some("sudden"), Some("room")));
    let at: Vec<f64> = falls[0]["at_m"].as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect();
    assert!((at[0] - 4.9).abs() < 1.0 && (at[1] - 2.9).abs() < 1.0, "{at:?}");
    assert!(found["voxel_persons"].as_u64().unwrap() > 20, "{found}");
    folder.run("falls runs/cameras-1").ok().prints(&["very likely a fall"]);
    // Beside it stands what the truth tells.
    let found = folder.run("find runs/cameras-1 seen-fall --json").ok().json();
    let hits = found["found"].as_array().unwrap();
    let words: Vec<&str> = hits.iter().map(|hit| hit["words"].as_str().unwrap()).collect();
    assert!(words.iter().any(|words| words.starts_with("by cameras: very likely a fall, room (")), "{words:?}");
    assert!(words.contains(&"edith: by the truth: has fallen, room"), "{words:?}");
    let begins: Vec<&str> = hits.iter().map(|hit| hit["begin"].as_str().unwrap()).collect();
    let [seen, told] = ["by cameras", "edith"].map(|whose| {
        begins[words.iter().position(|words| words.starts_with(whose)).unwrap()]
            .rsplit(':')
            .next()
            .unwrap()
            .parse::<f64>()
            .unwrap()
    });
    assert!((seen - told).rem_euclid(60.0) < 5.0, "{begins:?}");
    assert_eq!(hits.iter().filter(|hit| hit["name"] == "fallen").count(), 1, "{hits:?}");
    folder.run("find runs/cameras-1 fall").ok().prints(&["edith: has fallen, room"]);
    let only = folder.run("find runs/cameras-1 seen-fall sudden --json").ok().json();
    assert_eq!(only["found"].as_array().unwrap().len(), 1, "{only}");
}

#[test]
fn silhouettes_are_the_same_however_fast_and_with_another_seed_others() {
    let folder = fallen();
    folder.run("run cameras --quiet --for 2m").ok();
    folder.run("run cameras --quiet --for 2m --speed 100").ok();
    folder.run("run cameras --quiet --for 2m --seed 5").ok();
    let first = silhouettes(&folder, "cameras-1");
    assert!(first.len() > 50);
    assert!(first == silhouettes(&folder, "cameras-2"));
    assert!(first != silhouettes(&folder, "cameras-3"));
}

#[test]
fn a_log_without_silhouettes_and_rules_that_are_wrong_are_told() {
    let folder = Folder::with("studio");
    folder.run("run studio --quiet --for 1d").ok();
    folder.run("falls runs/studio-1").fails(2, "kit::no-silhouettes");
    folder.write("rules.json", folder.run("falls --show-rules").ok().out.replace("\"high\" }", "\"tall\" }"));
    folder.run("falls runs/studio-1 --rules rules.json").fails(2, "rules.json: error[fall-rule::");
    folder.run("falls").fails(2, "LOG");
    folder.run("find runs/studio-1 seen-fall").fails(2, "kit::no-silhouettes");
    folder.run("silhouettes runs/studio-1").fails(2, "kit::no-silhouettes");
}

/// Three cameras that watch a person for some time.
fn postures(long: &str) -> Folder {
    let folder = Folder::with("postures");
    folder.run(&format!("run postures --quiet --for {long}")).ok();
    folder
}

#[test]
fn silhouettes_become_a_film_tables_and_pictures() {
    let folder = postures("20s");
    let outs = "--out film.apng --out features.csv --out features.jsonl --out pictures";
    let told = folder.run(&format!("silhouettes runs/postures-1 --scale 2 {outs} --json")).ok().json();
    let stored = folder.query(
        "runs/postures-1/silhouettes.db",
        "SELECT name, area_px, left_px, elongation FROM silhouette JOIN camera USING (camera) ORDER BY silhouette.rowid",
    );
    let instants = folder.query("runs/postures-1/silhouettes.db", "SELECT count(DISTINCT utc_us) FROM silhouette");
    assert_eq!(told["pictures"].as_u64().unwrap(), stored.len() as u64);
    assert_eq!(told["instants"].as_u64().unwrap().to_string(), instants[0]);
    assert_eq!(told["cameras"].as_array().unwrap().len(), 3);

    let csv = folder.read("features.csv");
    assert!(csv.starts_with("at,camera,area_px,left_px,"), "{csv}");
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), stored.len());
    for (row, stored) in rows.iter().zip(&stored) {
        let stored: Vec<&str> = stored.split('|').collect();
        assert_eq!((row[1], row[2], row[3]), (stored[0], stored[1], stored[2]));
        assert!((row[12].parse::<f64>().unwrap() - stored[3].parse::<f64>().unwrap()).abs() < 1e-3);
    }
    assert!(rows[0][0].starts_with("2025-06-02T10:00:00") && rows[0][0].ends_with("-07:00"), "{:?}", rows[0]);
    // By one camera alone, the height of a standing person is about right.
    assert!(rows.iter().take(30).any(|row| (1.5..1.9).contains(&row[15].parse::<f64>().unwrap())));
    let objects: Vec<serde_json::Value> =
        folder.read("features.jsonl").lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(objects.len(), rows.len());
    assert_eq!(objects[5]["area_px"].to_string(), rows[5][2]);

    let pictures: Vec<String> = folder.files().into_iter().filter(|name| name.starts_with("pictures/")).collect();
    assert_eq!(pictures.len(), stored.len());
    assert!(pictures.iter().any(|name| name == "pictures/south-west/2025-06-02T10-00-05.000-0700.png"), "{pictures:?}");
    let size = |name: &str| {
        let bytes = std::fs::read(folder.path(name)).unwrap();
        assert_eq!(&bytes[1..4], b"PNG", "{name}");
        let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        let frames = bytes.windows(4).position(|word| word == b"acTL").map(|at| number(at + 4));
        (number(16), number(20), frames)
    };
    assert_eq!(size(&pictures[0]), (320, 240, None));
    // Three cameras and two gaps of three pixels.
    assert_eq!(size("film.apng"), ((3 * 160 + 6) * 2, 240, Some(instants[0].parse().unwrap())));
    // Existing files are not replaced without notice.
    folder.run("silhouettes runs/postures-1 --out film.apng").fails(1, "log::exists");
    folder.run("silhouettes runs/postures-1 --out pictures").fails(2, "error[silhouettes::not-empty]: pictures");
    folder.run("silhouettes runs/postures-1 --out film.apng --force --camera south-east --every 1s").ok();
}

#[test]
fn a_strip_of_silhouettes_has_a_row_for_each_camera_that_is_asked_for() {
    let folder = postures("20s");
    let told = folder
        .run("silhouettes runs/postures-1 --from 10:00:05 --every 2s --frames 4 --svg strip.svg --json")
        .ok()
        .json();
    let svg = folder.read("strip.svg");
    says(
        &svg,
        &[
            "2025-06-02 10:00:05.000",
            "2025-06-02 10:00:11.000",
            ">north-east<",
            "4 moments from 2025-06-02 10:00:05.000 on before 3 cameras",
        ],
    );
    assert!(!svg.contains("10:00:13"));
    // Nothing but what lies there is read: six seconds of at most five pictures a second.
    assert!(told["instants"].as_u64().unwrap() <= 31, "{told}");
    let camera = "--camera south-east --camera south-east";
    folder.run(&format!("silhouettes runs/postures-1 {camera} --svg one.svg")).ok();
    let one = folder.read("one.svg");
    assert!(one.contains("8 moments from 2025-06-02 10:00:00.000 on before 1 camera;"));
}

#[test]
fn reports_all_wrong_options_for_silhouettes_at_once() {
    let folder = postures("11m");
    let wrong = folder
        .run("silhouettes runs/postures-1 --camera soth-east --from noon --to 25 --out a.csv")
        .fails(2, "error[silhouettes::no-camera]");
    says(
        &wrong.err,
        &[
            "did you mean \"south-east\"?",
            "the cameras are north-east",
            "error[moment::not-a-time]: \"noon\"",
            "error[moment::not-a-time]: \"25\"",
            "3 problems",
        ],
    );
    let nothing = "silhouettes runs/postures-1 --from 2025-06-02T12:00 --to 2025-06-02T13:00 --out a.csv";
    folder
        .run(nothing)
        .fails(2, "error[silhouettes::none-in-time]")
        .says(&["the last one before is at 2025-06-02 10:1"]);
    folder.run("silhouettes runs/postures-1 --from 10:05 --to 10:04").fails(2, "error[moment::no-span]");
    folder.run("silhouettes runs/postures-1 --out a.gif --out b.png").fails(2, "error[silhouettes::form]");
    folder.run("silhouettes runs/postures-1 --out b.csv --out a.apng").fails(2, "error[silhouettes::too-many]");
    let written =
        folder.files().into_iter().filter(|name| !name.starts_with("runs/") && !name.starts_with("postures/"));
    assert_eq!(written.collect::<Vec<_>>(), Vec::<String>::new());
    folder.run("silhouettes runs/postures-1 --every 1s --out a.apng").ok();
}
