//! `homebody doctor` reports the fault of a broken destination with a hint, and no fault of an intact one.

use crate::flat::flat;
use crate::folder::Folder;
use crate::mosquitto::Broker;
use crate::postgres::Server;
use rusqlite::Connection;
use serde_json::Value;
use std::fs;
use std::os::unix::fs::PermissionsExt;

/// The report of the doctor on a place: if a check is wrong, and its checks as `verdict about: says`.
fn doctor(folder: &Folder, words: &str) -> (bool, Vec<String>) {
    let said = folder.run(&format!("doctor {words} --json"));
    assert!(!said.out.contains("s3cr3t-canary") && !said.err.contains("s3cr3t-canary"), "{}", said.out);
    let json: Value = serde_json::from_str(&said.out).unwrap_or_else(|_| panic!("{words}: {}{}", said.out, said.err));
    let mut lines = Vec::new();
    for check in json["places"].as_array().unwrap().iter().flat_map(|place| place["checks"].as_array().unwrap()) {
        let text = |name: &str| check[name].as_str().unwrap_or_default().to_owned();
        assert!(text("verdict") == "ok" || !text("hint").is_empty(), "{check} has no hint");
        lines.push(format!("{} {}: {}", text("verdict"), text("about"), text("says")));
    }
    let wrong = json["wrong"].as_u64().unwrap();
    assert_eq!(said.code, Some(i32::from(wrong > 0)), "{lines:?}");
    (wrong > 0, lines)
}

/// Nothing is wrong, and nothing is warned of.
fn is_whole(folder: &Folder, words: &str) {
    let (_, lines) = doctor(folder, words);
    assert!(!lines.is_empty() && lines.iter().all(|line| line.starts_with("ok ")), "{words}: {lines:#?}");
}

/// Something is wrong or warned of, and one line says this.
fn tells(folder: &Folder, words: &str, verdict: &str, wanted: &str) {
    let (is_wrong, lines) = doctor(folder, words);
    let is_it = |line: &&String| line.starts_with(verdict) && line.contains(wanted);
    assert!(lines.iter().any(|line| is_it(&line)), "{words}: {verdict} {wanted:?} is not among {lines:#?}");
    assert!(is_wrong || verdict != "wrong");
}

#[test]
fn an_installation_is_looked_at() {
    let folder = flat();
    let said = folder.run("doctor").ok();
    for about in ["version", "features", "database", "time zones", "clock", "folder", "terminal"] {
        assert!(said.out.contains(&format!("  {about}")), "{about}: {}", said.out);
    }
    assert!(folder.files().iter().all(|file| file.starts_with("flat/")), "it leaves nothing");
    // An invalid argument gives exit code 2.
    for (place, what) in [
        ("nonsense:x", "is not a place for a log"),
        ("postgresql://ann:s3cr3t-canary@host/homes", "had a password in it"),
        ("mqtt://ann:s3cr3t-canary@host/homes", "password"),
        ("jsonl:-", "stores none"),
    ] {
        let said = folder.run(&format!("doctor {place}")).fails(2, what);
        assert!(!said.err.contains("s3cr3t-canary") && !said.out.contains("s3cr3t-canary"), "{}", said.err);
    }
    tells(&folder, "none.db", "wrong", "does not exist");
}

#[test]
fn finds_the_faults_of_files() {
    let folder = flat();
    folder
        .run("run flat --for 10m --quiet --out sqlite:log.db --out csv:log.csv --out jsonl:log.jsonl --truth truth.db")
        .ok();
    for place in ["sqlite:log.db", "log.db", "sqlite:truth.db", "csv:log.csv", "log.jsonl"] {
        is_whole(&folder, place);
    }
    let change = |sql: &str| {
        fs::copy(folder.path("log.db"), folder.path("hurt.db")).unwrap();
        Connection::open(folder.path("hurt.db")).unwrap().execute_batch(sql).unwrap();
    };
    for (sql, wanted) in [
        ("DELETE FROM firing WHERE seq = 5", "1 number is missing, the first is 5"),
        ("DELETE FROM firing WHERE seq < 3", "3 numbers are missing, the first is 0"),
        ("UPDATE firing SET sensor = NULL WHERE seq = 4", "1 row has no time or no sensor"),
        ("UPDATE firing SET seq = 'five' WHERE seq = 5", "1 row has no integer as the number of the run or of the row"),
        ("ALTER TABLE firing RENAME TO other", "there is no table \"firing\": it has "),
        ("ALTER TABLE firing RENAME COLUMN value TO said", "has no column \"value\""),
        (
            "CREATE TABLE copy AS SELECT * FROM firing; INSERT INTO copy SELECT * FROM firing WHERE seq = 7; DROP TABLE firing; \
             ALTER TABLE copy RENAME TO firing",
            "has no key",
        ),
    ] {
        change(sql);
        tells(&folder, "sqlite:hurt.db", "wrong", wanted);
    }
    change("UPDATE run SET ended_at = NULL");
    tells(&folder, "sqlite:hurt.db", "warning", "is not complete");
    change("DROP TABLE run");
    tells(&folder, "hurt.db", "warning", "there is no table \"run\"");
    // Pages of nonsense in the middle.
    let mut bytes = fs::read(folder.path("log.db")).unwrap();
    let middle = bytes.len() / 2 / 4096 * 4096;
    bytes[middle..middle + 4096].fill(0x5a);
    folder.write("hurt.db", &bytes);
    tells(&folder, "sqlite:hurt.db", "wrong", "damaged");
    folder.write("hurt.db", "no database, but a text that is long enough to be looked at by somebody");
    tells(&folder, "sqlite:hurt.db", "wrong", "");
    let before = folder.sha256("truth.db");
    fs::copy(folder.path("truth.db"), folder.path("hurt.db")).unwrap();
    Connection::open(folder.path("hurt.db")).unwrap().execute_batch("DELETE FROM cause WHERE firing = 9").unwrap();
    tells(&folder, "sqlite:hurt.db", "wrong", "its firings: of ");
    assert_eq!(folder.sha256("truth.db"), before);

    let text = folder.read("log.csv");
    let lines: Vec<&str> = text.lines().collect();
    folder.write("hurt.csv", [&lines[..5], &lines[6..]].concat().join("\n"));
    tells(&folder, "csv:hurt.csv", "wrong", "1 number is missing, the first is 4");
    folder.write("hurt.csv", [&lines[..5], &lines[3..]].concat().join("\n"));
    tells(&folder, "csv:hurt.csv", "wrong", "2 rows have numbers that were there before");
    let text = folder.read("log.jsonl");
    folder.write("hurt.jsonl", &text[..text.len() - 9]);
    tells(&folder, "jsonl:hurt.jsonl", "wrong", "cannot read 1 line");
}

#[test]
fn finds_the_faults_of_columns() {
    let folder = flat();
    folder.run("run flat --for 10m --quiet --out parquet:log.parquet --out arrow:log.arrow --out parquet:lives --truth parquet:truth").ok();
    for place in ["parquet:log.parquet", "log.arrow", "parquet:lives", "lives", "truth"] {
        is_whole(&folder, place);
    }
    for name in ["log.parquet", "log.arrow"] {
        let bytes = fs::read(folder.path(name)).unwrap();
        let hurt = format!("hurt.{}", name.rsplit('.').next().unwrap());
        folder.write(&hurt, &bytes[..bytes.len() - 20]);
        tells(&folder, &hurt, "wrong", "damaged or cut short");
    }
    let part =
        folder.files().into_iter().find(|file| file.starts_with("lives/") && file.ends_with(".parquet")).unwrap();
    let hidden = part.replace("part-0", ".part-1").replace(".parquet", ".parquet.77.part");
    folder.write(&hidden, "half");
    tells(&folder, "lives", "warning", "1 file is incomplete");
    fs::remove_file(folder.path(&hidden)).unwrap();
    // A day that is of another place in the run.
    folder.run("run flat --for 5m --seed 3 --quiet --out parquet:other").ok();
    let other =
        folder.files().into_iter().find(|file| file.starts_with("other/") && file.ends_with(".parquet")).unwrap();
    fs::copy(folder.path(&other), folder.path(&part.replace("part-0", "part-1"))).unwrap();
    tells(&folder, "lives", "wrong", "rows come before");
}

#[test]
fn the_folder_of_a_run_is_held_against_its_recording() {
    let folder = flat();
    folder.run("run flat --for 10m --quiet").ok();
    is_whole(&folder, "runs/flat-1");
    is_whole(&folder, "runs/flat-1 --replay");
    folder.write("runs/flat-1/mqtt-x.confirmed.json", r#"{"run": 7, "rows": [3]}"#);
    tells(&folder, "runs/flat-1", "wrong", "belongs to another run");
    folder.write("runs/flat-1/mqtt-x.confirmed.json", "half");
    tells(&folder, "runs/flat-1", "wrong", "is not a valid note");
    fs::remove_file(folder.path("runs/flat-1/mqtt-x.confirmed.json")).unwrap();
    folder.write("runs/flat-1/log.db.123.part", "half");
    tells(&folder, "runs/flat-1", "warning", "is an incomplete file");
    fs::remove_file(folder.path("runs/flat-1/log.db.123.part")).unwrap();
    Connection::open(folder.path("runs/flat-1/log.db"))
        .unwrap()
        .execute_batch("DELETE FROM firing WHERE seq = (SELECT max(seq) FROM firing)")
        .unwrap();
    tells(&folder, "runs/flat-1", "wrong", "and the recording says");
    folder.edit("runs/flat-1/recording.json", "\"firings\": ", "\"firings\": 1");
    tells(&folder, "runs/flat-1 --replay", "wrong", "the replay has other firings");
    fs::remove_file(folder.path("runs/flat-1/sensors.csv")).unwrap();
    fs::remove_file(folder.path("runs/flat-1/truth.db")).unwrap();
    tells(&folder, "runs/flat-1", "wrong", "the folder has no ground truth");
    tells(&folder, "runs/flat-1", "wrong", "there is no sensors.csv");
    folder.write("runs/flat-1/recording.json", "{}");
    tells(&folder, "runs/flat-1", "wrong", "");
}

#[test]
fn finds_the_faults_of_a_database_on_a_server() {
    let Some(server) = Server::start_with(&["fsync=on"]) else { return };
    let folder = flat();
    let database = server.database("homes");
    let url = server.url("postgres", &database, "");
    is_whole(&folder, &url);
    folder.run(&format!("run flat --for 10m --quiet --out {url} --truth {url}")).ok();
    is_whole(&folder, &url);
    is_whole(&folder, &server.url("postgres", &database, "&schema=truth"));
    let hurts = |sql: &str, verdict: &str, wanted: &str| {
        server.psql("postgres", &format!("CREATE DATABASE hurt TEMPLATE {database}"));
        server.psql("hurt", sql);
        tells(&folder, &server.url("postgres", "hurt", ""), verdict, wanted);
        server.psql("postgres", "DROP DATABASE hurt");
    };
    hurts("DELETE FROM firing WHERE seq = 5", "wrong", "1 number is missing, the first is 5");
    hurts("DELETE FROM firing WHERE seq = 5", "wrong", "\"homebody_run\" says");
    hurts(
        "ALTER TABLE firing DROP CONSTRAINT firing_pkey; INSERT INTO firing SELECT * FROM firing WHERE seq < 4",
        "wrong",
        "has no key",
    );
    hurts(
        "ALTER TABLE firing DROP CONSTRAINT firing_pkey; INSERT INTO firing SELECT * FROM firing WHERE seq < 4",
        "wrong",
        "4 rows have numbers that were there before",
    );
    hurts("ALTER TABLE firing ALTER value TYPE char(9)", "wrong", "is character(9), and not text");
    hurts("ALTER TABLE firing DROP COLUMN sensor", "wrong", "has no column \"sensor\"");
    hurts("UPDATE homebody_run SET ended_at = NULL", "warning", "is not complete");
    hurts("DELETE FROM homebody_run", "wrong", "has no such run");
    hurts("DROP TABLE homebody_run", "warning", "there is no table \"homebody_run\"");
    hurts("DELETE FROM truth.movement", "wrong", "\"movement\" has 0 rows");
    hurts("ALTER DATABASE hurt SET default_transaction_read_only = on", "wrong", "takes no changes from this user");
    server.psql(&database, "CREATE ROLE guest LOGIN; REVOKE CREATE ON SCHEMA public FROM PUBLIC");
    tells(&folder, &server.url("guest", &database, ""), "wrong", "has no right to INSERT");
    tells(&folder, &server.url("guest", "postgres", "&schema=fresh"), "wrong", "may not create one");
    // Read-only access of a role is reported once for each schema, and not for each table of the truth.
    let reads = "CREATE ROLE looker LOGIN; GRANT USAGE ON SCHEMA truth TO looker; \
                 GRANT SELECT ON ALL TABLES IN SCHEMA public, truth TO looker";
    server.psql(&database, reads);
    let (_, lines) = doctor(&folder, &server.url("looker", &database, ""));
    let wrong: Vec<&String> = lines.iter().filter(|line| line.starts_with("wrong")).collect();
    assert!(wrong.len() == 2 && wrong.iter().all(|line| line.contains("has no right to INSERT in ")), "{lines:#?}");
    tells(&folder, &server.url("postgres", "nowhere", ""), "wrong", "does not exist");
    tells(&folder, "postgresql://ann@127.0.0.1:1/homes", "wrong", "no server answers");
}

#[test]
fn finds_the_faults_of_a_broker() {
    let Some(broker) = Broker::start() else { return };
    let folder = flat();
    let url = broker.url("homes").to_string();
    is_whole(&folder, &url);
    is_whole(&folder, &format!("{url} --write"));
    assert_eq!(broker_keeps(&broker), "", "what is tried leaves nothing");
    folder.run(&format!("run flat --for 1m --quiet --out {url}?allow-fast=true --out csv:x.csv")).ok();
    tells(&folder, &url, "warning", "of 1 home are kept: homes/flat");
    drop(broker);
    tells(&folder, &url, "wrong", "no broker listens on this host and port");

    let rights = |name: &str, text: &str| {
        folder.write(name, text);
        fs::set_permissions(folder.path(name), fs::Permissions::from_mode(0o600)).unwrap();
        format!("allow_anonymous true\nacl_file {}\n", folder.path(name).display())
    };
    let broker = Broker::with(&rights("readers", "topic read homes/#\n")).unwrap();
    tells(&folder, &format!("{} --write", broker.url("homes")), "wrong", "this user may not publish below homes/");
    let broker = Broker::with(&rights("writers", "topic write homes/#\n")).unwrap();
    tells(&folder, &format!("{} --write", broker.url("homes")), "wrong", "may not subscribe");
    let broker = Broker::with("allow_anonymous false\n").unwrap();
    tells(&folder, &broker.url("homes").to_string(), "wrong", "rejects this user");
}

/// The retained messages of a broker below `homes`, one per line.
fn broker_keeps(broker: &Broker) -> String {
    let port = broker.port.to_string();
    let args = ["-h", "127.0.0.1", "-p", &port, "-t", "homes/#", "--retained-only", "-W", "1", "-v"];
    let heard = std::process::Command::new("mosquitto_sub").args(args).output().unwrap();
    String::from_utf8(heard.stdout).unwrap()
}

/// Ground truths without the later tables `outside` and `home` are intact.
#[test]
fn a_truth_of_an_earlier_version_is_whole() {
    let folder = flat();
    folder.run("run flat --for 10m --quiet --out csv:log.csv --truth truth.db").ok();
    folder.run("run flat --for 10m --quiet --out csv:other.csv --truth parquet:truth").ok();
    let older = |later: &str| {
        fs::copy(folder.path("truth.db"), folder.path("older.db")).unwrap();
        Connection::open(folder.path("older.db")).unwrap().execute_batch(&format!("DROP TABLE {later}")).unwrap();
    };
    older("outside; DROP TABLE home");
    is_whole(&folder, "older.db");
    folder.run("label log.csv older.db --out csv:labelled.csv").ok();
    for later in ["outside", "home"] {
        fs::remove_dir_all(folder.path(&format!("truth/{later}"))).unwrap();
    }
    is_whole(&folder, "parquet:truth");
    // The control: what there always was is missing.
    older("room");
    tells(&folder, "older.db", "wrong", "there is no table \"room\"");
    fs::remove_dir_all(folder.path("truth/room")).unwrap();
    tells(&folder, "parquet:truth", "wrong", "there is no folder truth/room");

    let Some(server) = Server::start_with(&["fsync=on"]) else { return };
    let database = server.database("older");
    let url = server.url("postgres", &database, "");
    folder.run(&format!("run flat --for 10m --quiet --out {url} --truth {url}")).ok();
    server.psql(
        &database,
        "DROP TABLE truth.outside, truth.home; UPDATE truth.homebody_run SET rows = rows[1:10], tables = tables[1:10];
         CREATE ROLE carer LOGIN; GRANT USAGE ON SCHEMA truth TO carer;
         GRANT INSERT, SELECT, UPDATE ON ALL TABLES IN SCHEMA public, truth TO carer",
    );
    is_whole(&folder, &url);
    is_whole(&folder, &server.url("carer", &database, ""));
    server.psql(&database, "REVOKE INSERT ON truth.room FROM carer");
    let carers = server.url("carer", &database, "");
    let said = folder.run(&format!("doctor {carers}")).out;
    let hint = said.split("hint: ").nth(1).unwrap().lines().next().unwrap();
    assert_eq!(hint, "GRANT INSERT ON truth.room TO carer");
    server.psql(&database, hint);
    is_whole(&folder, &carers);
}

/// A fleet has many runs: one line reports them, and added or removed homes are not losses.
#[test]
fn the_homes_of_a_fleet_are_told_of_together() {
    let Some(server) = Server::shared() else { return };
    let folder = flat();
    let database = server.database("fleets");
    let url = server.url("postgres", &database, "");
    let fleet = "fleet flat --homes 20 --speed 600 --for 2s --quiet --out";
    folder.run(&format!("{fleet} {url}")).ok();
    let (is_wrong, lines) = doctor(&folder, &url);
    assert!(!is_wrong && lines.len() < 10, "{lines:#?}");
    assert!(lines.iter().any(|line| line.starts_with("ok rows: 20 runs: ")), "{lines:#?}");
    server.psql(&database, "CREATE SCHEMA churn");
    let churned = server.url("postgres", &database, "&schema=churn");
    folder.run(&format!("{fleet} {churned}")).ok();
    // As homes that were away leave it.
    server.psql(&database, "DELETE FROM churn.firing WHERE seq BETWEEN 10 AND 19");
    tells(&folder, &churned, "warning", "20 homes of a fleet lack the rows of 200 numbers");
    // The control: duplicate or surplus rows are wrong in a fleet, too.
    server.psql(&database, "UPDATE homebody_run SET rows = ARRAY[1] WHERE home = 'home00004'");
    tells(&folder, &url, "wrong", "and \"homebody_run\" says 1");
}
