//! `--force` replaces files, and neither rows on a server nor a database with other tables.

use crate::flat::flat;
use crate::postgres::Server;
use rusqlite::Connection;

#[test]
fn force_replaces_no_rows() {
    let Some(server) = Server::shared() else { return };
    let (folder, database) = (flat(), server.database("replaced"));
    let url = server.url("postgres", &database, "");
    let run = format!("run flat --for 20m --quiet --out {url}");
    folder.run(&run).ok();
    // The transaction of each row.
    let written = || server.psql(&database, "SELECT count(*), min(xmin::text), max(xmin::text) FROM firing");
    let before = written();
    folder.run(&format!("{run} --force")).fails(1, "error[postgresql::run-exists]");
    folder.run(&run).fails(1, "error[postgresql::run-exists]");
    assert_eq!(written(), before);
    folder.run(&format!("{run} --replace-rows")).ok();
    assert_ne!(written(), before);
}

#[test]
fn a_fleet_goes_on_with_its_reports_and_its_rows() {
    let Some(server) = Server::shared() else { return };
    let (folder, database) = (flat(), server.database("reported"));
    let url = server.url("postgres", &database, "");
    let fleet = format!(
        "fleet flat --homes 3 --out {url} --start 2024-11-01 --speed 1000 --for 2s --report-every 1s --quiet --report r.jsonl --list homes.csv"
    );
    folder.run(&fleet).ok();
    let rows = || server.psql(&database, "SELECT count(*), min(xmin::text) FROM firing WHERE seq = 0");
    let (before, reports) = (rows(), folder.read("r.jsonl"));
    folder.run(&fleet).ok();
    assert_eq!(rows(), before, "rows that are there are not written again");
    let both = folder.read("r.jsonl");
    assert!(both.starts_with(&reports) && both.len() > reports.len(), "{both}");
    // With --force, too: it is for files.
    folder.run(&format!("{fleet} --force")).ok();
    assert_eq!(rows(), before);
    assert!(!folder.read("r.jsonl").starts_with(&reports));
    let sensors = server.psql(&database, "SELECT count(DISTINCT run_id) FROM homebody_sensor WHERE name <> ''");
    assert_eq!(sensors.trim(), "3");
    // The control: a file of something else is not taken for reports.
    folder.write("r.jsonl", "my notes\n");
    folder.run(&fleet).fails(1, "[log::exists]: r.jsonl");
    assert_eq!(folder.read("r.jsonl"), "my notes\n");
}

#[test]
fn a_database_file_that_holds_more_than_a_run_is_kept() {
    let folder = flat();
    folder.run("run flat --for 20m --quiet --out sqlite:log.db").ok();
    folder.run("run flat --for 21m --quiet --out sqlite:log.db --force").ok();
    let add = |sql: &str| Connection::open(folder.path("log.db")).unwrap().execute_batch(sql).unwrap();
    add("CREATE TABLE letters (text TEXT); INSERT INTO letters VALUES ('dear')");
    for to in ["--out sqlite:log.db", "--out csv:log.db", "--truth log.db"] {
        let words = format!("run flat --for 20m --quiet {to} --out csv:other.csv --force");
        folder.run(&words).fails(1, "is a database with the table \"letters\"");
    }
    folder.run("convert runs/none --out sqlite:log.db --force");
    assert_eq!(folder.query("log.db", "SELECT text FROM letters"), ["dear"]);
}
