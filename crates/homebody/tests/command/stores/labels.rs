//! Labels are the same for any destination of the ground truth.

use crate::flat::flat;
use crate::folder::Folder;
use crate::postgres::Server;
use homebody_core::scenario::scheme::{SchemeRow, Stands};

/// Places of a truth in files of columns, and names to read it again.
const COLUMNS: [(&str, &str); 5] = [
    ("parquet:columns.parquet", "columns.parquet"),
    ("parquet:columns.parquet", "columns.cause.parquet"),
    ("arrow:columns.arrow", "arrow:columns.arrow"),
    ("parquet:set", "parquet:set"),
    ("parquet:set", "set"),
];

#[test]
fn labels_are_the_same_from_whatever_the_truth_was_written_to() {
    let folder = flat();
    let run = "run flat --for 20m --quiet --force --out csv:log.csv --truth";
    folder.run(&format!("{run} truth.db")).ok();
    folder.run("label log.csv truth.db --out csv:wanted.csv").ok();
    let wanted = folder.read("wanted.csv");
    assert!(wanted.lines().count() > 300 && wanted.contains(",movement,"));
    let same = |truth: &str| {
        folder.run(&format!("label log.csv {truth} --out csv:found.csv --force")).ok();
        assert!(folder.read("found.csv") == wanted, "{truth} gives other labels");
    };
    for row in SchemeRow::with_files_of_tables().filter(|row| row.stands == Stands::Text) {
        let name = row.name;
        for file in [format!("{name}-truth.{}", row.extensions[0]), format!("{name}-packed.{}.gz", row.extensions[0])] {
            folder.run(&format!("{run} {name}:{file}")).ok();
            same(&file);
            same(&format!("{name}:{file}"));
        }
        // By the file of one of its tables.
        same(&format!("{name}-packed.cause.{}.gz", row.extensions[0]));
    }
    for (to, by) in COLUMNS {
        folder.run(&format!("{run} {to}")).ok();
        same(by);
    }
    // Of a data set of several runs one is named.
    folder.run("run flat --for 20m --seed 2 --quiet --out csv:other.csv --truth parquet:set").ok();
    folder.run("label log.csv parquet:set --out csv:x.csv").fails(1, "name one of run=");
    let id = folder.query("truth.db", "SELECT run_id FROM run").remove(0);
    same(&format!("parquet:set/run={id}"));
    // All missing parts are reported.
    std::fs::remove_file(folder.path("columns.off.arrow")).unwrap();
    std::fs::remove_file(folder.path("columns.room.arrow")).unwrap();
    folder
        .run("label log.csv arrow:columns.arrow --out csv:x.csv")
        .fails(1, "error[truth::missing-parts]")
        .says(&["no file columns.off.arrow, no file columns.room.arrow"]);
    folder.run("label log.csv mqtt://127.0.0.1/homes --out csv:x.csv").fails(1, "error[truth::not-stored]");

    let Some(server) = Server::shared() else { return };
    let database = server.database("labels");
    let url = server.url("postgres", &database, "");
    let truth = server.url("postgres", &database, "&schema=truth");
    folder.run(&format!("{run} {url}")).ok();
    same(&truth);
    same(&url);
    folder.run(&format!("run flat --for 20m --seed 2 --quiet --force --out csv:other.csv --truth {url}")).ok();
    let said = folder
        .run(&format!("label log.csv {truth} --out csv:x.csv"))
        .fails(1, "has the ground truths of several runs")
        .err;
    assert!(said.contains(&format!("?run={id}")) || said.contains(&id), "{said}");
    same(&format!("{truth}&run={id}"));
    folder.run(&format!("label log.csv {truth}&run=7 --out csv:x.csv")).fails(1, "has no ground truth of the run 7");
    // The control: the truth of the other run is refused, or gives other labels.
    let other = server.psql(&database, &format!("SELECT run_id FROM truth.homebody_run WHERE run_id <> {id}"));
    let labelled = folder.run(&format!("label log.csv {truth}&run={other} --out csv:found.csv --force"));
    assert!(labelled.code != Some(0) || folder.read("found.csv") != wanted);
    // A log on the server has its truth there, too.
    folder.run(&format!("run flat --for 20m --quiet --replace-rows --out {url} --truth {truth}")).ok();
    server.psql(&database, &format!("DELETE FROM homebody_run WHERE run_id <> {id}"));
    server.psql(&database, "ALTER TABLE truth.room DROP COLUMN room");
    folder.run(&format!("label log.csv {truth}&run={id} --out csv:x.csv")).fails(1, "no column \"room\" of \"room\"");
}

/// A day and night in which clocks go back, of a logger that tells the clock on the wall: a server keeps the world's.
#[test]
fn an_hour_that_comes_twice_is_labelled_by_a_truth_on_a_server() {
    let Some(server) = Server::shared() else { return };
    let folder = Folder::with("tigerplace");
    for (name, key, value) in [("scenario", "start", "2009-10-31T18:00:00"), ("logger", "time", "local")] {
        let file = format!("tigerplace/{name}.json");
        folder.edit_json(&file, |json| json[key] = value.into());
    }
    let url = server.url("postgres", &server.database("twice"), "");
    folder.run("run tigerplace --for 14h --quiet").ok();
    folder.run(&format!("run tigerplace --for 14h --quiet --out csv:x.csv --truth {url}")).ok();
    folder.run("run tigerplace --for 14h --quiet --out csv:y.csv --truth parquet:truth").ok();
    folder.run("label runs/tigerplace-1 --out csv:wanted.csv").ok();
    let wanted = folder.read("wanted.csv");
    assert!(wanted.lines().count() > 500);
    for truth in [url.as_str(), "parquet:truth"] {
        folder.run(&format!("label runs/tigerplace-1 {truth} --out csv:found.csv --force")).ok();
        assert!(folder.read("found.csv") == wanted, "{truth}");
    }
}

#[test]
fn activities_come_back_from_a_server_and_a_truth_lies_beside_its_log_there() {
    let Some(server) = Server::shared() else { return };
    let folder = flat();
    let database = server.database("activities");
    let url = server.url("postgres", &database, "");
    let truth = server.url("postgres", &database, "&schema=truth");
    folder.copy_scenario("tigerplace");
    folder.run("run tigerplace --for 30h --quiet").ok();
    folder.run(&format!("run tigerplace --for 30h --quiet --out {url} --truth {truth}")).ok();
    folder.run("convert runs/tigerplace-1 --activities --out csv:wanted.csv").ok();
    let wanted = folder.read("wanted.activity.csv");
    assert!(wanted.lines().count() > 10);
    // From the ground truth next to it.
    folder.run(&format!("convert {url} --activities --mapping tigerplace/logger.json --out csv:beside.csv")).ok();
    assert_eq!(folder.read("beside.activity.csv").lines().count(), wanted.lines().count());
    // Of a log that was written anew they go along, and come back.
    let again = server.url("postgres", &database, "&schema=again");
    folder.run(&format!("convert csv:wanted.csv --out {again}")).ok();
    folder.run(&format!("convert {again} --out csv:found.csv")).ok();
    folder.run("convert csv:wanted.csv --out csv:direct.csv").ok();
    assert_eq!(folder.read("found.activity.csv").lines().count(), wanted.lines().count());
    let names = |file: &str| {
        let text = folder.read(file);
        text.lines().map(|line| line.rsplit(',').next().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(names("found.activity.csv"), names("wanted.activity.csv"));
    assert_eq!(names("found.csv"), names("direct.csv"), "rows have their labels");
}
