//! The names of sensors accompany a log to every destination.

use crate::flat::flat;
use crate::folder::Folder;

/// The row of a sensor in a table of sensors.
fn row(folder: &Folder, table: &str, id: &str) -> Vec<String> {
    let text = folder.read(table);
    let row = text.lines().find(|line| line.starts_with(&format!("{id},")));
    row.unwrap_or_else(|| panic!("{id} is not in\n{text}")).split(',').map(str::to_owned).collect()
}

#[test]
fn files_have_a_table_of_sensors_beside_them_and_databases_in_them() {
    let folder = flat();
    let id = "KitchenFloor";
    folder.run("run flat --for 20m --quiet --out csv:week.csv --out casas:week.txt --out sqlite:week.db").ok();
    let header = folder.read("week.sensors.csv").lines().next().unwrap().to_owned();
    assert_eq!(header, "id,name,kind,room,x_m,y_m,unit,zone");
    let file = row(&folder, "week.sensors.csv", id);
    assert!(!file[1].is_empty() && !file[2].is_empty() && file[7].contains('/'), "{file:?}");
    let rows = folder.query("week.db", &format!("SELECT name, kind, coalesce(room, '') FROM sensor WHERE id = '{id}'"));
    assert_eq!(rows, [file[1..4].join("|")]);
    assert_eq!(folder.query("week.db", "SELECT zone FROM run"), [file[7].clone()]);
    // A run's folder has its own table for all of its logs, and a truth has its own words.
    folder.run("run flat --for 20m --quiet").ok();
    assert!(!folder.files().iter().any(|file| file.starts_with("runs/") && file.ends_with("log.sensors.csv")));
    assert!(folder.query("runs/flat-1/truth.db", "SELECT name FROM sqlite_schema WHERE name = 'sensor'").is_empty());
    // A log that is read knows them, wherever it came from, and hands them on.
    for (from, to) in [("week.csv", "sqlite:a.db"), ("a.db", "csv:b.csv"), ("b.csv", "jsonl:c.jsonl")] {
        folder.run(&format!("convert {from} --out {to}")).ok();
    }
    assert_eq!(row(&folder, "c.sensors.csv", id)[1..4], file[1..4]);
    // The control: a log with nothing but ids gets no table.
    folder.write("bare.csv", "time,sensor,value\n2009-03-02 07:12:03,M1,ON\n2009-03-02 07:12:09,M1,OFF\n");
    folder.run("convert bare.csv --out sqlite:bare.db").ok();
    folder.run("convert bare.csv --out csv:again.csv").ok();
    assert!(folder.query("bare.db", "SELECT name FROM sqlite_schema WHERE name = 'sensor'").is_empty());
    assert!(!folder.path("again.sensors.csv").exists());
}

#[test]
fn the_table_of_sensors_is_not_taken_for_the_log() {
    let folder = flat();
    folder.run("run flat --for 20m --quiet --out sqlite:week.db --out csv:week.csv").ok();
    let rows = folder.read("week.csv").lines().count() - 1;
    folder.run("convert week.db --out csv:read.csv").ok();
    assert_eq!(folder.read("read.csv").lines().count() - 1, rows);
    // Also where ids look like instants, and no other table is a log.
    folder.query("week.db", "DROP TABLE firing");
    folder.query("week.db", "UPDATE sensor SET id = '2009-03-02 07:12:03', name = 'M1', kind = 'ON'");
    folder.run("convert week.db --out csv:none.csv").fails(2, "error[log-form::no-log-table]");
}

#[test]
fn an_anonymised_log_hides_the_names_of_sensors() {
    let folder = flat();
    folder.run("run flat --for 20m --quiet --out csv:week.csv").ok();
    let name = row(&folder, "week.sensors.csv", "KitchenFloor")[1].clone();
    folder.run("anonymise week.csv --out sqlite:nobodys.db").ok();
    folder.run("anonymise week.csv --out csv:nobodys.csv").ok();
    assert!(!folder.dump("nobodys.db").contains(&name) && !folder.path("nobodys.sensors.csv").exists());
}
