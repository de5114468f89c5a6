//! `logger.json`: where the log goes, names that reach SQL, ids of sensors.

use super::{HomeInCheck, ProblemReport, folded};
use crate::problem::Problem;
use crate::scenario::inside::{outside_folder, taken_in_run};
use crate::scenario::logger::{LoggerFile, LumpFile, MessagesFile};
use crate::scenario::scheme::{self, NoPlace, OUTPUT, PlaceMessage, Scheme, Stands};
use crate::scenario::source::{JsonSource, pointer_part};
use crate::sensors::messages::SensorMessage;
use std::collections::{BTreeMap, BTreeSet};

/// The hint for a place that leads out of the folder.
const INSIDE: &str = "name a file in the folder, such as \"sqlite:log.db\"";

crate::messages! {
    /// Problems with the logger.
    pub enum LoggerMessage in "logger" {
        /// `lumps` divides the holds into lumps by their shares, and all shares are 0.
        NoShare error "no-share" ("every lump in \"lumps\" has the share 0")
            hint ("give one lump a share above 0, or write [] for holds of exactly \"hold_s\"");
        /// A scenario names files of the run's folder only. Servers and standard output are the choice of the person who runs it.
        NotAFile { target: String } error "not-a-file" ("{target:?} is not a file in the folder of the run")
            hint ("remove it here, and run with: homebody run --out {target}");
        /// SQLite keeps tables of its own, which have names of this form.
        SqliteTable { name: String } error "sqlite-table" ("SQLite reserves table names that begin with \"sqlite_\"")
            hint ("choose another name than {name:?}");
        /// Homebody writes tables named `run` and `sensor` next to the log. They describe the runs and the sensors.
        ReservedTable { name: String }
            error "reserved-table" ("the table of the log cannot be named {name:?}, because Homebody writes another table of this name")
            hint ("choose another name");
        /// Each column of a table has its own name.
        SameColumn { first: &'static str, second: &'static str, name: String }
            error "duplicate-column" ("the columns {first:?} and {second:?} cannot both be named {name:?}")
            hint ("rename one of them");
        /// The names of tables and columns reach SQL, so they consist of letters, digits and underscores.
        SqlName { name: String } error "sql-name" ("{name:?} cannot be the name of a table or a column")
            hint ("use at most 63 characters from a-z, 0-9 and _, and do not begin with a digit");
        /// The rows of a log name their sensors by id, so each id is different. A sensor without an id in `ids` has its name as its id.
        SameId { first: String, second: String, id: String }
            error "duplicate-id" ("the sensors {first:?} and {second:?} would both have the id {id:?} in the log")
            hint ("give each sensor its own id");
    }
}

pub fn check(source: &JsonSource, file: &LoggerFile, surroundings: &HomeInCheck, problems: &mut Vec<Problem>) {
    let report = &mut ProblemReport { source, problems };
    check_targets(report, &file.to);
    check_sql_names(report, file);
    check_ids(report, &file.ids, surroundings);
    check_lumps(report, file);
}

fn check_lumps(report: &mut ProblemReport, file: &LoggerFile) {
    let MessagesFile::OnOff(on_off) = &file.messages else { return };
    for (index, LumpFile { parts, .. }) in on_off.lumps.iter().enumerate() {
        report.range(&format!("/messages/on_off/lumps/{index}/parts"), "parts", *parts);
    }
    if !on_off.lumps.is_empty() && on_off.lumps.iter().all(|lump| lump.share == 0.0) {
        report.add("/messages/on_off/lumps", LoggerMessage::NoShare);
    }
}

fn check_targets(report: &mut ProblemReport, targets: &[String]) {
    let mut paths: Vec<&str> = Vec::new();
    for (index, target) in targets.iter().enumerate() {
        let pointer = format!("/to/{index}");
        let (scheme, path) = match Scheme::split(target) {
            Ok(parts) => parts,
            Err(NoPlace { what, hint }) => {
                let hint = hint.replace(&scheme::forms(), &scheme::forms_of_scenarios());
                let mut problem = report.source.problem(&pointer, PlaceMessage::Invalid { what, hint }, None);
                if scheme::without_password(target) != *target {
                    // The line would show it.
                    problem.excerpt = None;
                }
                report.problems.push(problem);
                continue;
            }
        };
        if scheme.row().stands == Stands::Server || path == OUTPUT {
            report.add(&pointer, LoggerMessage::NotAFile { target: target.clone() });
        } else if let Some(outside) = outside_folder(path, "the run's folder") {
            report.problems.push(report.source.problem(&pointer, outside, Some(INSIDE.into())));
        } else if let Some(taken) = taken_in_run(path, &paths) {
            report.add(&pointer, taken);
        } else {
            paths.push(path);
        }
    }
}

fn check_sql_names(report: &mut ProblemReport, file: &LoggerFile) {
    if let Some(table) = &file.table {
        check_sql_name(report, "/table", table);
        if table.starts_with("sqlite_") {
            report.add("/table", LoggerMessage::SqliteTable { name: table.clone() });
        }
        if table == "run" || table == "sensor" {
            report.add("/table", LoggerMessage::ReservedTable { name: table.clone() });
        }
    }
    let columns = &file.columns;
    let columns = [
        ("run", &columns.run),
        ("seq", &columns.seq),
        ("time", &columns.time),
        ("sensor", &columns.sensor),
        ("value", &columns.value),
    ];
    for (index, &(key, name)) in columns.iter().enumerate() {
        let pointer = format!("/columns/{key}");
        check_sql_name(report, &pointer, name);
        if let Some(&(first, _)) = columns[..index].iter().find(|(_, other)| *other == name) {
            report.add(&pointer, LoggerMessage::SameColumn { first, second: key, name: name.clone() });
        }
    }
}

fn check_sql_name(report: &mut ProblemReport, pointer: &str, name: &str) {
    let begins = name.starts_with(|c: char| c.is_ascii_lowercase() || c == '_');
    let goes_on = name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if !begins || !goes_on || name.len() > 63 {
        report.add(pointer, LoggerMessage::SqlName { name: name.to_owned() });
    }
}

fn check_ids(report: &mut ProblemReport, ids: &BTreeMap<String, String>, surroundings: &HomeInCheck) {
    let mut owners: BTreeMap<String, &str> = BTreeMap::new();
    if let Some(home) = surroundings.home {
        let names = home.sensors.iter().map(|sensor| sensor.name());
        let known: BTreeSet<&str> = names.clone().collect();
        for sensor in ids.keys().filter(|id| !known.contains(id.as_str())) {
            let (nearest, known) = report.names_for(sensor, names.clone());
            let pointer = format!("/ids/{}", pointer_part(sensor));
            report.add_to_key(&pointer, SensorMessage::Unknown { sensor: sensor.clone(), nearest, known });
        }
        // A sensor without an id of its own is logged by its name.
        owners.extend(names.filter(|name| !ids.contains_key(*name)).map(|name| (folded(name), name)));
    }
    for (sensor, id) in ids {
        let pointer = format!("/ids/{}", pointer_part(sensor));
        report.name(&pointer, id);
        if let Some(owner) = owners.insert(folded(id), sensor) {
            let (first, second) = (owner.to_owned(), sensor.clone());
            report.add(&pointer, LoggerMessage::SameId { first, second, id: id.clone() });
        }
    }
}
