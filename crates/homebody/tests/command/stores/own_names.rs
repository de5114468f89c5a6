//! Each kind of destination returns a log with a network's own names without a mapping.

use crate::flat::flat;
use crate::folder::Folder;
use crate::postgres::Server;

/// A logger file with unusual names only.
const LOGGER: &str = r#"{
  "to": ["sqlite:log.db"],
  "table": "uplink",
  "columns": { "run": "stay", "seq": "nr", "time": "heard", "sensor": "mote", "value": "payload" }
}"#;

/// The values of sensors, in order; some places have times in UTC, and some in local time.
fn said(folder: &Folder, place: &str) -> Vec<String> {
    folder.run(&format!("convert {place} --out csv:read.csv --force")).ok();
    let rows = folder.read("read.csv");
    rows.lines().skip(1).map(|row| row.split(',').skip(2).collect::<Vec<_>>().join(",")).collect()
}

#[test]
fn a_log_under_a_networks_names_is_read_without_a_mapping() {
    let folder = flat();
    folder.write("flat/logger.json", LOGGER);
    let run = "run flat --for 20m --quiet --force";
    let files =
        ["csv:log.csv", "jsonl:log.jsonl", "parquet:log.parquet", "arrow:log.arrow", "parquet:set", "sqlite:log.db"];
    let out: Vec<String> = files.iter().map(|file| format!("--out {file}")).collect();
    folder.run(&format!("{run} {} --truth parquet:truth", out.join(" "))).ok();
    let wanted = said(&folder, "csv:log.csv");
    assert!(wanted.len() > 300 && wanted.iter().any(|row| row == "KitchenFloor,ON"), "{:?}", &wanted[..3]);
    for file in files {
        assert!(said(&folder, file) == wanted, "{file} is read otherwise");
        assert!(said(&folder, file.split_once(':').unwrap().1) == wanted, "{file} is not known by what is in it");
    }
    // The truth is labelled with, whatever the log is called.
    folder.run("label parquet:set parquet:truth --out csv:labelled.csv").ok();
    assert!(folder.read("labelled.csv").lines().count() == wanted.len() + 1);
    // The control: a table of a truth also has instants and texts, but it is not a log.
    for table in ["act", "cause", "lost"] {
        folder
            .run(&format!("convert parquet:truth/{table} --out csv:x.csv"))
            .fails(2, "error[parquet::missing-columns]");
    }
    // The names of a mapping are meant where one is given.
    folder.write("other.json", r#"{ "columns": { "sensor": "payload", "value": "mote", "time": "heard" } }"#);
    folder.run("convert log.parquet --mapping other.json --out csv:turned.csv").ok();
    assert!(folder.read("turned.csv").lines().nth(1).unwrap().contains(",ON,"), "{}", folder.read("turned.csv"));

    let Some(server) = Server::shared() else { return };
    let database = server.database("own_names");
    let url = server.url("postgres", &database, "");
    folder.run(&format!("{run} --out {url} --truth {url}")).ok();
    assert!(said(&folder, &url) == wanted, "the table of the only run is read");
    folder.run(&format!("label {url} --out csv:labelled.csv --force")).ok();
    // Of runs in several tables the one that is named is read, in its table.
    let id = server.psql(&database, "SELECT run_id FROM homebody_run");
    folder.write("flat/logger.json", r#"{ "to": ["sqlite:log.db"] }"#);
    folder.run(&format!("{run} --seed 5 --out {url}")).ok();
    assert!(said(&folder, &format!("{url}&run={}", id.trim())) == wanted);
    assert!(said(&folder, &url) != wanted, "ours is read where nobody names one");
    folder.run(&format!("doctor {url}")).ok();
    // The control: what that table says of itself is held against its rows, though no mapping names it.
    server.psql(&database, "DELETE FROM uplink WHERE nr = 5");
    let said = folder.run(&format!("doctor {url}"));
    assert!(said.code == Some(1) && said.out.contains("\"uplink\" has "), "{}", said.out);
}
