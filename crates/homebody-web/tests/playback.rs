//! The page plays stored runs as they were stored.

use crate::stored::*;
use axum::http::StatusCode;
use homebody_core::time::{DAY, HOUR, RunTime, SECOND, Span};
use homebody_log::MovementKind;
use homebody_query::search::SearchSubject;
use homebody_simulation::Cancel;
use homebody_web::folders::HomeFolders;
use homebody_web::playback::RequestError;
use homebody_web::staged_run::{StagedRun, StartRequest};
use homebody_web::wire::{Find, FoundView, RunState};
use rusqlite::Connection;
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

#[test]
fn plays_rows_of_the_log() {
    let stored = Stored::lived("tigerplace", 30 * HOUR, as_it_is);
    let (view, days) = (stored.view(), stored.days());
    assert_eq!((view.days.len(), view.start.as_str(), view.has_truth), (2, "2009-03-02 00:00:00", true));
    assert_eq!(view.days[1].end_us, 30 * HOUR.micros());

    let connection = Connection::open(stored.file("log.db")).unwrap();
    let mut statement = connection.prepare("SELECT ts_local, sensor_id, event_code FROM event ORDER BY seq").unwrap();
    let rows = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?))).unwrap();
    let rows: Vec<(String, String, String)> = rows.map(Result::unwrap).collect();
    assert!(rows.len() > 1000);
    assert_eq!(words(&view, &days), rows.iter().map(|row| (row.1.clone(), row.2.clone())).collect::<Vec<_>>());
    for (row, told) in days.iter().flat_map(|day| &day.rows).zip(&rows) {
        let (second, micros) = (row.0 / SECOND.micros(), row.0 % SECOND.micros());
        let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
        let day = 2 + hour / 24;
        assert_eq!(format!("2009-03-{day:02} {:02}:{minute:02}:{second:02}.{micros:06}", hour % 24), told.0);
    }
    let told: u32 = view.hours.iter().flatten().sum();
    assert_eq!(told as usize, rows.len());
    assert_eq!(view.hours[0][7], days[0].rows.iter().filter(|row| row.0 / HOUR.micros() == 7).count() as u32);
}

#[test]
fn plays_movements_of_the_ground_truth() {
    for (scenario, length) in [("tigerplace", 50 * HOUR), ("couple-with-cat", 30 * HOUR)] {
        let stored = Stored::lived(scenario, length, as_it_is);
        let (view, days) = (stored.view(), stored.days());
        let connection = Connection::open(stored.file("truth.db")).unwrap();
        for (index, resident) in view.residents.iter().enumerate() {
            let sql = "SELECT kind, posture, from_x FROM movement WHERE resident = ? ORDER BY rowid";
            let mut statement = connection.prepare(sql).unwrap();
            let told =
                statement.query_map([&resident.name], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?))).unwrap();
            let told: Vec<(String, String, Option<f64>)> = told.map(Result::unwrap).collect();
            let mut seen = Vec::new();
            for (day, date) in days.iter().zip(&view.days) {
                let movements = &day.lives[index].movements;
                let (first, last) = (movements.first().unwrap(), movements.last().unwrap());
                assert!(first.0 <= date.begin_us && last.1 >= date.end_us, "{}", resident.name);
                assert!(movements.windows(2).all(|pair| pair[0].1 == pair[1].0), "{}: without gaps", resident.name);
                seen.extend(movements.iter().map(|one| (one.0, one.1, one.2, one.3, one.4.map(|from| from[0]))));
            }
            // A span over midnight is in both days.
            seen.dedup();
            let seen: Vec<_> = seen.iter().map(|one| (text(&one.2), text(&one.3), one.4)).collect();
            assert_eq!(seen, told, "{scenario}: {}", resident.name);
        }
        assert!(days.iter().all(|day| day.lives.len() == view.residents.len()));
        assert!(days[0].lives[0].movements.iter().any(|movement| movement.2 == MovementKind::Stride));
    }
}

/// A value as the wire and the ground truth write it.
fn text(value: &impl serde::Serialize) -> String {
    serde_json::to_value(value).unwrap().as_str().unwrap().into()
}

#[test]
fn plays_rooms_and_activities_of_the_ground_truth() {
    let stored = Stored::lived("tigerplace", 30 * HOUR, as_it_is);
    let (view, days) = (stored.view(), stored.days());
    let connection = Connection::open(stored.file("truth.db")).unwrap();
    let count = |sql: &str| connection.query_row(sql, [], |row| row.get::<_, i64>(0)).unwrap() as usize;
    let all: Vec<_> = days.iter().flat_map(|day| &day.lives[0].activities).collect();
    let across = days[0].lives[0].activities.iter().filter(|span| span.1 > DAY.micros()).count();
    assert_eq!(all.len() - across, count("SELECT count(*) FROM activity WHERE resident = 'margaret'"));
    assert_eq!(view.activities[all[0].2 as usize], "sleeping");
    let (begin, end, room) = days[0].lives[0].rooms[0];
    assert_eq!((begin, view.home.rooms[room as usize].name.as_str()), (0, "bedroom"));
    let left = "SELECT (julianday(at) - julianday('2009-03-02')) * 86400 FROM room WHERE resident = 'margaret' LIMIT 1 OFFSET 1";
    let left_s = connection.query_row(left, [], |row| row.get::<_, f64>(0)).unwrap();
    assert!((end as f64 / 1e6 - left_s).abs() < 0.01, "{end} {left_s}");
    assert!(!view.spans[0].is_empty() && view.spans[0].len() <= all.len());
}

#[test]
fn every_form_of_log_has_the_same_instants() {
    let told = |logger: &'static str| {
        let change = move |name: &str, text: String| if name == "logger.json" { logger.into() } else { text };
        // Clocks go forward on the second day.
        let change = move |name: &str, text: String| change(name, text).replace("2009-03-02T", "2009-03-07T");
        let stored = Stored::lived("tigerplace", 30 * HOUR, change);
        let days = stored.days();
        assert_eq!(stored.view().days[1].turn, Some((26 * HOUR.micros(), HOUR.micros())));
        let rows: Vec<_> = days.iter().flat_map(|day| &day.rows).map(|row| (row.0 / 1000, row.1)).collect();
        let moved: Vec<_> = days[1].lives[0].movements.iter().map(|one| one.0 / 1000).collect();
        assert!(rows.len() > 1000 && !moved.is_empty());
        (rows, moved)
    };
    let local = told(r#"{ "table": "seen", "columns": { "time": "t", "sensor": "s", "value": "v" } }"#);
    for logger in [
        r#"{ "to": ["sqlite:inner/log.db"], "time": "utc" }"#,
        r#"{ "time": "local_offset" }"#,
        r#"{ "time": "epoch_s" }"#,
        r#"{ "to": ["csv:log.csv"], "columns": { "time": "when", "sensor": "who", "value": "what" } }"#,
        r#"{ "to": ["casas:log.txt"], "ids": { "bed sensor": "B 001" } }"#,
    ] {
        assert_eq!(told(logger), local, "{logger}");
    }
}

#[test]
fn plays_rows_without_ground_truth() {
    let stored = Stored::lived("tigerplace", 3 * HOUR, as_it_is);
    let with = stored.days();
    fs::remove_file(stored.file("truth.db")).unwrap();
    let (view, days) = (stored.view(), stored.days());
    assert!(!view.has_truth && view.spans.is_empty() && !stored.playback.list()[0].has_truth);
    assert_eq!(days[0].rows, with[0].rows);
    assert!(days[0].lives.is_empty() && !with[0].lives.is_empty());
}

#[test]
fn unknown_runs_and_days_are_refused() {
    let stored = Stored::lived("by-hand", 20 * SECOND, as_it_is);
    let name = stored.name();
    for unknown in ["", ".", "..", "../runs", "nobody", "by-hand-1/", "/", "by-hand-1\0"] {
        assert!(
            matches!(stored.playback.run(unknown), Err(RequestError { status: StatusCode::NOT_FOUND, .. })),
            "{unknown:?}"
        );
    }
    for day in [1, 2, usize::MAX] {
        assert!(
            matches!(stored.playback.day(&name, day), Err(RequestError { status: StatusCode::NOT_FOUND, .. })),
            "{day}"
        );
    }
    assert!(stored.playback.day(&name, 0).is_ok());
}

#[test]
fn plays_runs_of_any_name() {
    let stored = Stored::lived("by-hand", 20 * SECOND, as_it_is);
    let first = stored.days();
    let runs = stored.folder.path().join("runs");
    let evil = "<img src=x onerror=alert(1)> \u{202e} '\"%2e%2e";
    fs::rename(runs.join(stored.name()), runs.join(evil)).unwrap();
    assert_eq!(stored.playback.run(evil).unwrap().name, evil);
    assert_eq!(stored.days(), first);
}

#[test]
fn rejects_damaged_files_and_outside_paths() {
    let stored = Stored::lived("by-hand", 20 * SECOND, as_it_is);
    let name = stored.name();
    let damage = |file: &str, text: &str| {
        let path = stored.file(file);
        let whole = fs::read(&path).unwrap();
        fs::write(&path, text).unwrap();
        let refused = stored.playback.run(&name).map(|view| view.remarks.clone());
        fs::write(&path, whole).unwrap();
        refused
    };
    for (file, text) in [
        ("log.db", "not a database"),
        ("truth.db", "not a database"),
        ("recording.json", "{"),
        (
            "recording.json",
            r#"{ "version": "", "entry": "x", "files": {}, "seed": 1, "length_us": 1, "firings": 0, "sha256": "" }"#,
        ),
    ] {
        assert!(
            matches!(damage(file, text), Err(RequestError { status: StatusCode::UNPROCESSABLE_ENTITY, .. })),
            "{file}"
        );
    }
    let recording = fs::read_to_string(stored.file("recording.json")).unwrap();
    for length in [i64::MAX, i64::MIN, -1] {
        let mut long: serde_json::Value = serde_json::from_str(&recording).unwrap();
        long["length_us"] = length.into();
        assert!(
            matches!(
                damage("recording.json", &long.to_string()),
                Err(RequestError { status: StatusCode::UNPROCESSABLE_ENTITY, .. })
            ),
            "{length}"
        );
    }
    let secret = stored.folder.path().join("runs/secret.db");
    fs::copy(stored.file("log.db"), &secret).unwrap();
    for to in ["sqlite:../secret.db".to_owned(), format!("sqlite:{}", secret.display())] {
        let mut lured: serde_json::Value = serde_json::from_str(&recording).unwrap();
        let entry = lured["entry"].as_str().unwrap().to_owned();
        let mut scenario: serde_json::Value = serde_json::from_str(lured["files"][&entry].as_str().unwrap()).unwrap();
        scenario["logger"] = "logger.json".into();
        lured["files"][&entry] = scenario.to_string().into();
        lured["files"]["logger.json"] = serde_json::json!({ "to": [to] }).to_string().into();
        let refused = damage("recording.json", &lured.to_string()).unwrap_err();
        assert!(
            matches!(&refused, RequestError { status: StatusCode::UNPROCESSABLE_ENTITY, message: why } if why.to_string().contains("inside the run's folder")),
            "{refused:?}"
        );
    }
    assert!(stored.playback.run(&name).is_ok());
}

#[test]
fn plays_members_of_a_cohort() {
    let stored = Stored::lived("by-hand", 10 * SECOND, as_it_is);
    let runs = stored.folder.path().join("runs");
    let alone = stored.name();
    fs::create_dir(runs.join("cohort-1")).unwrap();
    fs::rename(runs.join(&alone), runs.join("cohort-1/0001")).unwrap();
    assert_eq!(stored.name(), "cohort-1/0001");
    assert!(stored.view().remarks.is_empty(), "{:?}", stored.view().remarks);
    assert_eq!(stored.days().len(), 1);
    for name in ["cohort-1", "cohort-1/", "cohort-1/../cohort-1/0001", "/cohort-1/0001"] {
        assert!(matches!(stored.playback.run(name), Err(RequestError { status: StatusCode::NOT_FOUND, .. })), "{name}");
    }
}

/// A run that goes back and forth leaves the files of an undisturbed one.
#[test]
fn continues_from_a_snapshot_like_an_undisturbed_run() {
    let at = |since: Span| RunTime::START + since;
    let stored = |back: &[Span], stop: Span| {
        let folder = TempDir::new().unwrap();
        let own = folder.path().join("scenario");
        copy(&scenarios().join("tigerplace"), &own, &as_it_is);
        let folders = HomeFolders {
            scenario: own,
            entry: "scenario.json".into(),
            is_trusted: false,
            runs: folder.path().join("runs"),
        };
        let mut act = StagedRun::new(&folders, &folders.entry, StartRequest::default()).unwrap();
        live(&mut act, at(12 * DAY + 5 * HOUR), &folders);
        for to in back.iter().map(|&to| at(to)) {
            assert!(act.rewind(to));
            assert!(act.now() <= to && act.now() >= to - 5 * DAY, "{} is far from {to}", act.now());
            live(&mut act, to, &folders);
        }
        live(&mut act, at(stop), &folders);
        let frame = act.frame(RunState::Paused, None);
        let counts = act.live_counts().lock().unwrap().view();
        act.finish().unwrap();
        let runs: Vec<PathBuf> = fs::read_dir(&folders.runs).unwrap().map(|run| run.unwrap().path()).collect();
        assert_eq!(runs.len(), 1, "it leaves one folder");
        let rows = |file: &str, select: &str| -> Vec<String> {
            let database = Connection::open(runs[0].join(file)).unwrap();
            let mut select = database.prepare(select).unwrap();
            let columns = select.column_count();
            let row = |row: &rusqlite::Row| {
                (0..columns).map(|column| row.get::<_, rusqlite::types::Value>(column)).collect::<Result<Vec<_>, _>>()
            };
            select.query_map([], row).unwrap().map(|row| format!("{:?}", row.unwrap())).collect()
        };
        let log = rows("log.db", "SELECT * FROM event ORDER BY seq");
        let truth = ["movement", "room", "activity", "act", "cause"]
            .map(|table| rows("truth.db", &format!("SELECT * FROM {table} ORDER BY rowid")));
        let recording = fs::read_to_string(runs[0].join("recording.json")).unwrap();
        ((log, truth, recording), frame, counts)
    };
    let undisturbed = stored(&[], 15 * DAY);
    assert!(undisturbed.0.0.len() > 1000 && undisturbed.0.1.iter().all(|rows| rows.len() > 100));
    let back = stored(&[3 * DAY, 11 * DAY, HOUR, 6 * DAY + Span::from_micros(7)], 15 * DAY);
    assert_eq!(back.1.now_us, undisturbed.1.now_us);
    assert_eq!(
        (&back.1.counts, &back.1.on, back.1.told),
        (&undisturbed.1.counts, &undisturbed.1.on, undisturbed.1.told)
    );
    assert_eq!(format!("{:?}{:?}", back.1.bodies, back.2), format!("{:?}{:?}", undisturbed.1.bodies, undisturbed.2));
    assert!(back.0 == undisturbed.0, "log, truth or recording differ");
    // A run stopped after a jump back has everything that was simulated.
    let (stopped, frame, _) = stored(&[3 * DAY], 4 * DAY);
    assert_eq!(frame.now_us, 4 * DAY.micros());
    assert!(stopped == stored(&[], Span::ZERO).0, "who stops leaves something else");
    // The control: a run that was simulated further differs.
    assert!(stopped != stored(&[], 13 * DAY).0 && stopped != undisturbed.0);
}

/// A run under manual control starts anew, because everything may change.
#[test]
fn a_controlled_run_goes_back_only_to_its_start() {
    let folder = TempDir::new().unwrap();
    let own = folder.path().join("scenario");
    copy(&scenarios().join("by-hand"), &own, &as_it_is);
    let folders = HomeFolders {
        scenario: own,
        entry: "scenario.json".into(),
        is_trusted: false,
        runs: folder.path().join("runs"),
    };
    let start = StartRequest { driven: Some(0), ..StartRequest::default() };
    let mut act = StagedRun::new(&folders, &folders.entry, start).unwrap();
    let at = |since: Span| RunTime::START + since;
    live(&mut act, at(10 * SECOND), &folders);
    assert!(!act.rewind(at(SECOND)));
    assert_eq!((act.now(), act.restarted(at(SECOND)).unwrap().now()), (at(10 * SECOND), RunTime::START));
}

/// Searches a run.
fn find(stored: &Stored, what: SearchSubject, name: &str, between_min: Option<(u32, u32)>, least_s: f64) -> FoundView {
    let name = (!name.is_empty()).then(|| name.to_owned());
    let asked = Find { what, name, between_min, least_s };
    stored.playback.find(&stored.name(), &asked, &Cancel::new(), || Ok(Vec::new())).unwrap()
}

#[test]
fn a_search_agrees_with_log_and_truth() {
    let stored = Stored::lived("tigerplace", 5 * DAY, as_it_is);
    let connection = Connection::open(stored.file("truth.db")).unwrap();
    let count = |sql: &str| connection.query_row(sql, [], |row| row.get::<_, i64>(0)).unwrap() as u64;
    let night = Some((0, 6 * 60));
    let visits = find(&stored, SearchSubject::Room, "bathroom", night, 0.0);
    let told = "SELECT count(*) FROM room WHERE room = 'bathroom' AND resident = 'margaret' AND time(at) < '06:00'";
    assert!(visits.all > 3 && visits.all <= count(told), "{} of {}", visits.all, count(told));
    assert!(visits.hits.iter().all(|hit| hit.begin_us % DAY.micros() < 6 * HOUR.micros() && hit.words == "margaret"));
    assert!(visits.hits.is_sorted_by_key(|hit| hit.begin_us));
    let long = find(&stored, SearchSubject::Room, "bathroom", night, 300.0);
    assert!(long.all < visits.all && long.hits.iter().all(|hit| hit.end_us - hit.begin_us >= 300 * SECOND.micros()));
    // By day there is no night.
    assert_eq!(find(&stored, SearchSubject::Doing, "sleeping", Some((600, 720)), 0.0).all, 0);
    assert_eq!(find(&stored, SearchSubject::Fall, "", None, 0.0), FoundView { hits: vec![], all: 0, remarks: vec![] });

    let view = stored.view();
    let rows: Vec<i64> = stored.days().iter().flat_map(|day| &day.rows).map(|row| row.0).collect();
    // Readings, such as restlessness in bed, are not signs of a person.
    let on = view.values.iter().position(|value| value == "ON").unwrap();
    let days = stored.days();
    let signs = days.iter().flat_map(|day| &day.rows).filter(|row| row.2 as usize == on).map(|row| row.0);
    let signs: Vec<i64> = signs.collect();
    let still = find(&stored, SearchSubject::Still, "", None, 1800.0);
    assert!(still.all > 0);
    for hit in &still.hits {
        assert!(!signs.iter().any(|at| (hit.begin_us + 1..hit.end_us).contains(at)), "{hit:?}");
    }
    let sensor = view.home.sensors.iter().find(|sensor| sensor.name.contains("stove")).unwrap();
    let on = find(&stored, SearchSubject::On, &sensor.name, None, 60.0);
    assert!(on.all > 0 && on.hits.iter().all(|hit| rows.contains(&hit.begin_us)));
    for (wrong, what) in
        [("attic", SearchSubject::Room), ("attic", SearchSubject::On), ("flying", SearchSubject::Doing)]
    {
        let asked = Find { what, name: Some(wrong.into()), between_min: None, least_s: 0.0 };
        let refused = stored.playback.find(&stored.name(), &asked, &Cancel::new(), || Ok(Vec::new()));
        assert!(matches!(refused, Err(RequestError { status: StatusCode::NOT_FOUND, .. })), "{wrong}: {refused:?}");
    }
    let nonsense = Find { what: SearchSubject::Still, name: None, between_min: Some((7, 7)), least_s: f64::NAN };
    assert!(matches!(
        stored.playback.find(&stored.name(), &nonsense, &Cancel::new(), || Ok(Vec::new())),
        Err(RequestError { status: StatusCode::UNPROCESSABLE_ENTITY, .. })
    ));
}

#[test]
fn finds_lost_messages_with_ground_truth_only() {
    let stored = Stored::lived("house-two-floors", 30 * HOUR, as_it_is);
    let lost = find(&stored, SearchSubject::Lost, "", None, 0.0);
    let connection = Connection::open(stored.file("truth.db")).unwrap();
    let told: i64 = connection.query_row("SELECT count(*) FROM lost", [], |row| row.get(0)).unwrap();
    assert!(lost.all > 10 && lost.all == told as u64, "{} of {told}", lost.all);
    let sensor = lost.hits[0].words.split(": ").next().unwrap().to_owned();
    let own = find(&stored, SearchSubject::Lost, &sensor, None, 0.0);
    assert!(own.all > 0 && own.hits.iter().all(|hit| hit.words.starts_with(&sensor)));
    drop(connection);
    fs::remove_file(stored.file("truth.db")).unwrap();
    let asked = Find { what: SearchSubject::Lost, name: None, between_min: None, least_s: 0.0 };
    let refused = stored.playback.find(&stored.name(), &asked, &Cancel::new(), || Ok(Vec::new())).unwrap_err();
    assert!(
        matches!(&refused, RequestError { status: StatusCode::NOT_FOUND, message: why } if why.code == "find::needs-truth"),
        "{refused:?}"
    );
    // Sensors tell the rooms, too.
    let name = stored.view().home.rooms[0].name.clone();
    let by_sensors = find(&stored, SearchSubject::Room, &name, None, 0.0);
    assert_eq!(by_sensors.remarks.len(), 1, "{by_sensors:?}");
}

#[test]
fn lists_runs_by_their_present_files() {
    let stored = Stored::lived("by-hand", HOUR, as_it_is);
    let listed = || stored.playback.list().into_iter().next().unwrap();
    let before = listed();
    assert_eq!((before.problem.as_deref(), before.days, before.has_truth), (None, 1, true));
    assert_eq!(listed(), before);
    fs::remove_file(stored.file("truth.db")).unwrap();
    assert!(!listed().has_truth);
    // A recording that was damaged since it was read is reported.
    fs::write(stored.file("recording.json"), "{}").unwrap();
    assert!(listed().problem.is_some());
}

/// Sam in the room with three cameras, for two minutes.
fn postures() -> Stored {
    Stored::lived("postures", 120 * SECOND, as_it_is)
}

#[test]
fn reads_silhouettes_in_parts() {
    let stored = postures();
    let view = stored.view();
    assert!(view.has_silhouettes && view.home.sensors.iter().all(|sensor| sensor.camera.is_some()));
    let connection = Connection::open(stored.file("silhouettes.db")).unwrap();
    let start = stored_start(&connection);
    let sql = "SELECT utc_us, name, packed FROM silhouette JOIN camera USING (camera) ORDER BY silhouette.rowid";
    let mut statement = connection.prepare(sql).unwrap();
    let row = |row: &rusqlite::Row| Ok((row.get::<_, i64>(0)? - start, row.get(1)?, row.get(2)?));
    let file: Vec<(i64, String, Vec<u8>)> = statement.query_map([], row).unwrap().map(Result::unwrap).collect();
    let (begin, end) = (4 * SECOND.micros(), 64 * SECOND.micros());
    let (mut told, mut from, mut parts) = (Vec::new(), begin, 0);
    while from < end {
        let film = stored.film(from, end, Span::ZERO).unwrap();
        assert!(film.until_us > from, "it comes on");
        for moment in &film.moments {
            let name = |sensor: u32| view.home.sensors[sensor as usize].name.clone();
            told.extend(moment.pictures.iter().map(|of| (moment.at_us, name(of.sensor), of.packed.clone())));
        }
        (from, parts) = (film.until_us, parts + 1);
    }
    let expected: Vec<_> = file.iter().filter(|(at, ..)| (begin..end).contains(at)).cloned().collect();
    assert!(expected.len() > 500 && told == expected, "{} of {} in {parts} parts", told.len(), expected.len());
    // Pictures at intervals of five seconds leave out the others.
    let film = stored.film(0, 60 * SECOND.micros(), 5 * SECOND).unwrap();
    assert!(
        film.moments.windows(2).all(|two| two[1].at_us - two[0].at_us >= 5 * SECOND.micros()) && film.moments.len() > 1
    );
    // A span after the run is empty, and a run without cameras has no silhouettes.
    let beyond = stored.film(i64::MAX - 1, i64::MAX, Span::ZERO).unwrap();
    assert!(beyond.moments.is_empty());
    let without = Stored::lived("studio", HOUR, as_it_is);
    assert!(!without.view().has_silhouettes);
    assert!(matches!(
        without.film(0, HOUR.micros(), Span::ZERO),
        Err(RequestError { status: StatusCode::NOT_FOUND, .. })
    ));
}

/// The start of the run in UTC.
fn stored_start(connection: &Connection) -> i64 {
    let first: i64 = connection.query_row("SELECT min(utc_us) FROM silhouette", [], |row| row.get(0)).unwrap();
    // The run starts on a whole hour, and cameras that never sleep see a person at once.
    first - first.rem_euclid(HOUR.micros())
}

#[test]
fn voxel_persons_follow_the_body() {
    let stored = postures();
    let person = |since: Span| {
        let film = stored.film(since.micros(), (since + SECOND / 5).micros(), Span::ZERO).unwrap();
        (film.moments[0].persons[0].clone(), film.corner, film.edge_m)
    };
    let (standing, corner, edge_m) = person(5 * SECOND);
    assert!(standing.upright > 0.5 && (standing.at[0] - 2.6).abs() < 0.3, "{standing:?}");
    // The cubes are at the person's place, and the highest at the top.
    let cubes: Vec<&[u16]> = standing.cubes.chunks(3).collect();
    assert!(cubes.len() > 100);
    let mean = |axis: usize| cubes.iter().map(|cube| f64::from(cube[axis])).sum::<f64>() / cubes.len() as f64;
    assert!((corner[0] + (mean(0) + 0.5) * edge_m - standing.at[0]).abs() < 0.15, "{standing:?}");
    assert!((corner[1] + (mean(1) + 0.5) * edge_m - standing.at[1]).abs() < 0.15);
    let top = cubes.iter().map(|cube| cube[2]).max().unwrap();
    assert!((f64::from(top + 1) * edge_m - standing.height_m).abs() < 0.2, "{top} {standing:?}");
    let (down, ..) = person(76 * SECOND);
    assert!(down.on_the_ground > 0.5 && down.height_m < 0.6, "{down:?}");
}

#[test]
fn finds_falls_in_silhouettes_and_stops_a_cancelled_search() {
    let stored = postures();
    let asked = Find { what: SearchSubject::SeenFall, name: None, between_min: None, least_s: 0.0 };
    let cancelled = Cancel::new();
    cancelled.cancel();
    let stopped = stored.playback.find(&stored.name(), &asked, &cancelled, || Ok(Vec::new()));
    assert!(
        matches!(stopped, Err(RequestError { status: StatusCode::UNPROCESSABLE_ENTITY, message: why }) if why.code == "kit::cancelled")
    );
    let found = stored.playback.find(&stored.name(), &asked, &Cancel::new(), || Ok(Vec::new())).unwrap();
    let fall = found.hits.iter().find(|hit| hit.words.contains("very likely a fall, room")).unwrap();
    // Sam falls after 66 s.
    assert!(
        (66 * SECOND.micros()..72 * SECOND.micros()).contains(&fall.begin_us) && fall.end_us > fall.begin_us,
        "{found:?}"
    );
}

#[test]
fn cameras_show_their_stored_silhouettes_while_awake() {
    let (stored, mut act, folders) = Stored::begun("cameras", as_it_is);
    let view = act.view();
    let cameras: Vec<u32> =
        (0u32..).zip(&view.home.sensors).filter(|(_, of)| of.camera.is_some()).map(|(at, _)| at).collect();
    // Nobody moves at midnight.
    let looks = act.frame(RunState::Playing, None).looks;
    assert_eq!(looks.iter().map(|look| look.sensor).collect::<Vec<_>>(), cameras);
    assert!(looks.iter().all(|look| !look.awake && look.packed.is_empty()), "{looks:?}");
    let mut seen = Vec::new();
    for step in 0..300 {
        live(&mut act, RunTime::START + 8 * HOUR + step * 17 * SECOND, &folders);
        for look in act.frame(RunState::Playing, None).looks {
            assert!(look.awake || look.packed.is_empty(), "{look:?}");
            seen.push((act.now(), look));
        }
    }
    act.finish().unwrap();
    let shown: Vec<_> = seen.iter().filter(|(_, look)| !look.packed.is_empty()).collect();
    let asleep = seen.iter().filter(|(_, look)| !look.awake).count();
    assert!(shown.len() > 10 && asleep > 10, "{} shown, {asleep} asleep", shown.len());
    // The page shows the last stored picture.
    let connection = Connection::open(stored.file("silhouettes.db")).unwrap();
    let start: i64 = 1_748_847_600_000_000;
    // Events at the present instant are still to come.
    let sql = "SELECT packed FROM silhouette JOIN camera USING (camera) WHERE name = ? AND utc_us < ? \
               ORDER BY silhouette.rowid DESC LIMIT 1";
    for (now, look) in shown {
        let name = &view.home.sensors[look.sensor as usize].name;
        let kept: Vec<u8> = connection.query_row(sql, (name, start + now.micros()), |row| row.get(0)).unwrap();
        assert_eq!(look.packed, kept, "{name} at {now}");
    }
}
