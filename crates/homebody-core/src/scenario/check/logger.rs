//! `logger.json`: where the log goes, names that reach SQL, ids of sensors.

use super::{Report, Surroundings, folded};
use crate::problem::Problem;
use crate::scenario::inside::{outside_folder, taken_in_run};
use crate::scenario::logger::{LoggerFile, LumpFile, MessagesFile};
use crate::scenario::scheme::{self, NoPlace, OUTPUT, Scheme, Stands};
use crate::scenario::source::{Source, pointer_part};
use std::collections::{BTreeMap, BTreeSet};

/// What to do about a place that leads out of the folder.
const INSIDE: &str = "name a file in there, such as \"sqlite:log.db\"";

/// What to do about a place that something else has.
const ANOTHER: &str = "name a file that nothing else has, such as \"csv:logs/week.csv\"";

pub fn check(source: &Source, file: &LoggerFile, surroundings: &Surroundings, problems: &mut Vec<Problem>) {
    let report = &mut Report { source, problems };
    check_targets(report, &file.to);
    check_sql_names(report, file);
    check_ids(report, &file.ids, surroundings);
    check_lumps(report, file);
}

fn check_lumps(report: &mut Report, file: &LoggerFile) {
    let MessagesFile::OnOff(on_off) = &file.messages else { return };
    for (index, LumpFile { parts: [least, most], .. }) in on_off.lumps.iter().enumerate() {
        if least > most {
            let what = format!("the least of \"parts\", {least}, is more than its most, {most}");
            report.hinted(&format!("/messages/on_off/lumps/{index}/parts"), what, format!("write [{most}, {least}]"));
        }
    }
    if !on_off.lumps.is_empty() && on_off.lumps.iter().all(|lump| lump.share == 0.0) {
        let hint = "give one lump a share above 0, or write [] for holds of exactly \"hold_s\"";
        report.hinted("/messages/on_off/lumps", "no lump has a share", hint);
    }
}

fn check_targets(report: &mut Report, targets: &[String]) {
    let mut paths: Vec<&str> = Vec::new();
    for (index, target) in targets.iter().enumerate() {
        let pointer = format!("/to/{index}");
        let (scheme, path) = match Scheme::split(target) {
            Ok(parts) => parts,
            Err(NoPlace { what, hint }) => {
                let hint = hint.replace(&scheme::forms(), &scheme::forms_of_scenarios());
                let mut problem = report.source.problem(&pointer, what, Some(hint));
                if scheme::without_password(target) != *target {
                    // The line would show it.
                    problem.excerpt = None;
                }
                report.problems.push(problem);
                continue;
            }
        };
        if scheme.row().stands == Stands::Server || path == OUTPUT {
            let what = format!("{target:?} is no file of a run's folder");
            report.hinted(&pointer, what, format!("say it to the command: homebody run --out {target}"));
        } else if let Some(what) = outside_folder(path, "the run's folder") {
            report.hinted(&pointer, what, INSIDE);
        } else if let Some(what) = taken_in_run(path, &paths) {
            report.hinted(&pointer, what, ANOTHER);
        } else {
            paths.push(path);
        }
    }
}

fn check_sql_names(report: &mut Report, file: &LoggerFile) {
    if let Some(table) = &file.table {
        check_sql_name(report, "/table", table);
        if table.starts_with("sqlite_") {
            report.add("/table", "SQLite keeps table names that begin with \"sqlite_\" for itself");
        }
        if table == "run" {
            report.add("/table", "the table \"run\" says which runs the log holds: the firings need another");
        }
        if table == "sensor" {
            report.add("/table", "the table \"sensor\" says what the sensors are: the firings need another");
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
    for (index, (key, name)) in columns.iter().enumerate() {
        let pointer = format!("/columns/{key}");
        check_sql_name(report, &pointer, name);
        if let Some((other, _)) = columns[..index].iter().find(|(_, other)| other == name) {
            report.add(&pointer, format!("the columns \"{other}\" and \"{key}\" cannot both be named {name:?}"));
        }
    }
}

fn check_sql_name(report: &mut Report, pointer: &str, name: &str) {
    let begins = name.starts_with(|c: char| c.is_ascii_lowercase() || c == '_');
    let goes_on = name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if !begins || !goes_on || name.len() > 63 {
        let hint = "use a to z, 0 to 9 and _, not a digit first, at most 63 characters";
        report.hinted(pointer, format!("{name:?} cannot be the name of a table or a column"), hint);
    }
}

fn check_ids(report: &mut Report, ids: &BTreeMap<String, String>, surroundings: &Surroundings) {
    let mut owners: BTreeMap<String, &str> = BTreeMap::new();
    if let Some(home) = surroundings.home {
        let names = home.sensors.iter().map(|sensor| sensor.name());
        let known: BTreeSet<&str> = names.clone().collect();
        for sensor in ids.keys().filter(|id| !known.contains(id.as_str())) {
            let hint = report.did_you_mean(sensor, names.clone());
            let pointer = format!("/ids/{}", pointer_part(sensor));
            report.problems.push(report.source.problem_with_key(
                &pointer,
                format!("the home has no sensor {sensor:?}"),
                hint,
            ));
        }
        // A sensor without an id of its own is logged by its name.
        owners.extend(names.filter(|name| !ids.contains_key(*name)).map(|name| (folded(name), name)));
    }
    for (sensor, id) in ids {
        let pointer = format!("/ids/{}", pointer_part(sensor));
        report.name(&pointer, id);
        if let Some(owner) = owners.insert(folded(id), sensor) {
            report.add(&pointer, format!("{owner:?} and {sensor:?} would both be logged as {id:?}"));
        }
    }
}
