//! `homebody locate`: locating people by a log and the plan.

use crate::folder::{Files, Folder, signal};
use serde_json::Value;
use std::sync::OnceLock;

/// A folder with a day of the studio, with one resident.
fn studio() -> Folder {
    static FILES: OnceLock<Files> = OnceLock::new();
    Folder::filled_once(&FILES, |folder| {
        folder.run("new home --template studio").ok();
        folder.run("run home --for 1d --quiet --out sqlite:log.db --truth truth.db").ok();
    })
}

fn report(folder: &Folder) -> Value {
    folder.json("walked/report.json")
}

#[test]
fn a_log_is_walked_back_and_what_is_lived_again_explains_it() {
    let folder = studio();
    folder.run("locate log.db --home home --out walked").ok();
    let all = report(&folder)["explained"]["all"].clone();
    let [real, relived, matched] = ["real", "relived", "matched"].map(|key| all[key].as_f64().unwrap());
    assert!(real > 300.0 && matched / real > 0.8 && (relived - matched) / relived < 0.25, "{all}");
    // The located room is right for most of the day.
    let rooms = folder.query(
        "truth.db",
        "SELECT substr(at, 1, 19) AS at, coalesce(room, '') FROM room WHERE resident = 'walter' ORDER BY at",
    );
    let told = folder.read("walked/where.csv");
    let told: Vec<(&str, &str)> = told
        .lines()
        .skip(1)
        .filter(|line| !line.contains("somebody else"))
        .map(|line| (&line[..19], line.split(',').nth(2).unwrap()))
        .collect();
    let room_at = |minute: usize| {
        let at = format!("{:02}:{:02}:30", minute / 60, minute % 60);
        let of = |all: &mut dyn Iterator<Item = (&str, &str)>| {
            all.take_while(|(time, _)| &time[11..] <= at.as_str()).last().map(|(_, room)| room.to_owned())
        };
        let is = rooms.iter().map(|row| row.split_once('|').unwrap());
        (of(&mut is.into_iter()), of(&mut told.iter().copied()))
    };
    let right = (1..1_440).filter(|&minute| matches!(room_at(minute), (Some(is), Some(told)) if is == told)).count();
    assert!(right > 1_300, "{right} of 1439 minutes");
    // The probabilities by room belong to the located rooms, and add up to 1.
    let rooms = folder.read("walked/rooms.csv");
    let mut chances = std::collections::BTreeMap::new();
    for line in rooms.lines().skip(1).filter(|line| line.contains(",walter,") && &line[11..19] <= "12:00:00") {
        let cells: Vec<&str> = line.split(',').collect();
        chances.insert(cells[2].to_owned(), cells[3].parse::<f64>().unwrap());
    }
    let sum: f64 = chances.values().sum();
    assert!((sum - 1.0).abs() < 0.2, "{chances:?}");
    let best = chances.iter().max_by(|a, b| a.1.total_cmp(b.1)).unwrap().0;
    let told_at_noon = told.iter().take_while(|(time, _)| &time[11..] <= "12:00:00").last().unwrap().1;
    assert_eq!(best.replace("out", ""), told_at_noon);
    assert!(folder.path("walked/given/log.db").is_file());
    // The result is a scenario, and its run can be inspected.
    folder.run("check walked").ok();
    folder.run("day walked/run 2026-03-02 --json");
    folder.run("locate log.db --home home --out walked").fails(1, "[kit::exists]: walked");
}

#[test]
fn reports_the_share_of_rows_that_do_not_fit() {
    let folder = studio();
    folder.run("convert log.db --out csv:log.csv").ok();
    let log = folder.read("log.csv").replace("M002", "M999");
    folder.write("strange.csv", &log);
    folder.run("locate strange.csv --home home --out walked").ok().says(&[
        "% of the rows are of sensors that the home does not have: M999",
        "nothing comes from bathroom motion",
    ]);
    let header = log.lines().next().unwrap();
    let of_attic: Vec<&str> = log.lines().filter(|line| line.contains("M999")).collect();
    folder.write("none.csv", format!("{header}\n{}\n", of_attic.join("\n")));
    folder.run("locate none.csv --home home --out never").fails(2, "error[locate::other-home]");
    folder.write("empty.csv", format!("{header}\n"));
    folder.run("locate empty.csv --home home --out never").fails(2, "no rows");
    assert!(!folder.path("never").exists());
}

#[test]
fn time_that_runs_backward_and_rows_that_come_twice_are_walked_back_all_the_same() {
    let folder = studio();
    folder.run("convert log.db --out csv:log.csv").ok();
    let log = folder.read("log.csv");
    let mut lines: Vec<&str> = log.lines().collect();
    let middle = lines.len() / 2;
    lines[middle..middle + 40].reverse();
    let again = lines[middle];
    lines.insert(middle, again);
    folder.write("mixed.csv", &(lines.join("\n") + "\n"));
    folder.run("locate mixed.csv --home home --out walked").ok();
    let all = report(&folder)["explained"]["all"].clone();
    assert!(all["matched"].as_f64().unwrap() / all["real"].as_f64().unwrap() > 0.8, "{all}");
}

#[test]
fn a_log_that_comes_in_pieces_says_where_everybody_is_as_it_does_at_once() {
    let folder = studio();
    folder.run("convert log.db --out csv:log.csv").ok();
    let log = folder.read("log.csv");
    let at_once = folder.say("locate csv:- --home home --follow", &log).ok();
    let told: Vec<&str> = at_once.out.lines().collect();
    assert!(told.len() > 20, "{}", at_once.out);
    assert!(told.iter().any(|line| line.contains("walter: surely in the ")), "{}", at_once.out);
    let mut running = folder.start("locate csv:- --home home --follow --poll 1");
    let (first, rest) = log.split_at(log.len() / 2);
    running.say(first);
    std::thread::sleep(std::time::Duration::from_millis(1_500));
    running.say(rest);
    assert_eq!(running.finish().ok().out, at_once.out);
    // The last position differs from the one in the middle.
    let half = &log[..first.rfind('\n').unwrap() + 1];
    let told_of_half = folder.say("locate csv:- --home home --follow", half).ok().out;
    assert!(at_once.out.starts_with(&told_of_half) && at_once.out != told_of_half);
    let lines = folder.say("locate csv:- --home home --follow --json", &log).ok().out;
    let lines: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), told.len());
    assert!(lines.iter().all(|line| (0.0..=1.0).contains(&line["chance"].as_f64().unwrap())));
    folder.say("locate - --home home --follow", &log).fails(2, "error[follow::no-form]");
    folder.run("locate log.csv --home home").fails(2, "--out <FOLDER>");
    folder.run("locate log.csv --home home --out there --follow").fails(2, "cannot be used with");
    folder.run("locate nothing.csv --home home --follow").fails(1, "nothing.csv");
}

#[cfg(unix)]
#[test]
fn a_file_that_grows_is_followed_until_a_signal_comes() {
    let folder = studio();
    folder.run("convert log.db --out csv:log.csv").ok();
    let log = folder.read("log.csv");
    let end = log[..log.len() / 2].rfind('\n').unwrap() + 1;
    folder.write("grows.csv", &log[..end]);
    let mut command = folder.command("locate grows.csv --home home --follow --poll 1");
    let file = std::fs::File::create(folder.path("told")).unwrap();
    let mut child = command.stdout(file).spawn().unwrap();
    folder.until("the first half was told", |folder| !folder.read("told").is_empty());
    let half = folder.read("told");
    folder.write("grows.csv", &log);
    folder.until("the rest was told", |folder| folder.read("told").len() > half.len());
    signal(&child, "TERM");
    assert_eq!(child.wait().unwrap().code(), Some(143));
    let at_once = folder.say("locate csv:- --home home --follow", &log).ok().out;
    assert!(at_once.starts_with(&folder.read("told")) && folder.read("told").starts_with(&half));
}
