//! Homes in real time: they resume without a gap after a stop or a kill, and leave the same files as a run.

use crate::folder::{Folder, numbers, signal, wait_until};
use crate::served::get;
use std::fs::File;
use std::process::Child;

/// A home that is lived, what it says going into files: nobody waits for who does not read.
struct Living<'f> {
    folder: &'f Folder,
    child: Child,
    name: &'static str,
}

impl<'f> Living<'f> {
    fn begin(folder: &'f Folder, name: &'static str, words: &str) -> Living<'f> {
        let file = |what: &str| File::create(folder.path(&format!("{name}.{what}"))).unwrap();
        let child = folder.command(words).stdout(file("out")).stderr(file("err")).spawn().unwrap();
        Living { folder, child, name }
    }

    /// Ends it by a signal; its exit code, and the numbers of the rows that it has given.
    fn end(mut self, name: &str) -> (Option<i32>, Vec<u64>) {
        signal(&self.child, name);
        let code = self.child.wait().unwrap().code();
        assert!(!self.told().contains("panicked"), "{}", self.told());
        (code, numbers(&self.folder.read(&format!("{}.out", self.name))))
    }

    /// Waits until something is so of it; where it never is, its words say why.
    fn until(&self, what: &str, is_so: impl Fn() -> bool) {
        wait_until(is_so, || format!("{}: {what}; it has said: {}", self.name, self.told()));
    }

    fn told(&self) -> String {
        self.folder.read(&format!("{}.err", self.name))
    }
}

#[test]
fn a_home_goes_on_after_a_stop_and_a_death_without_a_gap() {
    let folder = Folder::with("studio");
    folder.edit("studio/logger.json", "casas:log.txt", "sqlite:log.db");
    let stored = || folder.stored_rows("home/log.db");

    // Years are caught up with in a while; meanwhile it is stopped.
    let home = Living::begin(&folder, "first", "live studio --folder home --start 2024-11-01 --out jsonl:-");
    home.until("it has begun", || stored() > 1000);
    let (code, first) = home.end("TERM");
    assert_eq!(code, Some(143));
    assert!(first.iter().copied().eq(0..first.len() as u64), "every row once, in order");
    assert_eq!(stored(), first.len() as i64);
    folder.run("replay home/recording.json --out csv:again.csv").ok();

    // The home catches up, and repeats no row.
    let home = Living::begin(&folder, "second", "live studio --folder home --out jsonl:-");
    home.until("it has gone on", || stored() > first.len() as i64);
    let (code, second) = home.end("INT");
    assert_eq!(code, Some(130));
    assert!(second.iter().copied().eq(first.len() as u64..stored() as u64), "{:?}", second.first());

    // After a death some rows may be given again, by their numbers, and none is missing.
    let killed = || folder.stored_rows("killed/log.db");
    let home = Living::begin(&folder, "third", "live studio --folder killed --start 2024-11-01 --out jsonl:-");
    home.until("it has begun", || killed() > 1000);
    let (_, before) = home.end("KILL");
    let home = Living::begin(&folder, "fourth", "live studio --folder killed --out jsonl:-");
    home.until("it has gone on", || killed() > before.len() as i64);
    let (_, after) = home.end("TERM");
    assert!(after[0] <= before.len() as u64, "{} and {}", before.len(), after[0]);
    assert!(after.iter().copied().eq(after[0]..killed() as u64));
    folder.run("replay killed/recording.json --out csv:killed.csv").ok();

    // Other options than those of the home are refused, and so is a run to an end.
    folder.run("live studio --folder home --start 2024-11-02").fails(2, "error[live::other-start]");
    folder.run("live studio --folder home --seed 7").fails(2, "error[live::other-seed]");
    folder.run("run --resume home").fails(2, "error[run::home-in-real-time]");
    let said = folder.run("doctor home").ok().out;
    assert!(said.contains("homebody live SCENARIO --folder home resumes it"), "{said}");
    let home = Living::begin(&folder, "fifth", "live studio --folder home --start 2024-11-01 --seed 74");
    home.until("it says so", || {
        home.told().contains("resumes in home; simulated from 2024-11-01 00:00:00; press Ctrl-C")
    });
    assert_eq!(home.end("TERM").0, Some(143));

    // A clock of another zone may be behind ours, or a date be meant that is to come: that is said.
    let home = Living::begin(&folder, "sixth", "live studio --folder later --start 2100-01-01");
    home.until("it says so", || home.told().contains(" days; the home's clock shows 20"));
    assert_eq!(home.end("TERM").0, Some(143));

    // Another scenario has another folder.
    folder.copy_scenario("tigerplace");
    folder.run("live tigerplace --folder home").fails(2, "error[live::other-home]");
    folder.run("live studio --start yesterday").fails(2, "now, today, 2026-11-01");
    folder.run("live studio --out csv:rows.csv").fails(2, "error[run::middle-of-run]");
}

/// Text logs of a live home have their names while they grow, and after a death go on where they were; those of a run with an end have
/// none before it.
#[test]
fn the_texts_of_a_live_home_can_be_followed() {
    for (place, log, again) in [("casas:log.txt", "log.txt", "casas:again"), ("csv:log.csv", "log.csv", "csv:again")] {
        let folder = Folder::with("studio");
        folder.edit("studio/logger.json", "casas:log.txt", place);
        let file = format!("home/{log}");
        let lines = || std::fs::read_to_string(folder.path(&file)).map_or(0, |text| text.lines().count());
        let home = Living::begin(&folder, "first", "live studio --folder home --start 2024-11-01");
        home.until("it can be followed", || lines() > 100);
        home.end("KILL");
        let before = folder.read(&file);
        assert!(!before.is_empty());
        let home = Living::begin(&folder, "second", "live studio --folder home");
        home.until("it has gone on", || lines() > before.lines().count() + 100);
        let now = folder.read(&file);
        assert!(now.starts_with(&before[..before.rfind('\n').unwrap() + 1]), "what was read stays");
        assert_eq!(home.end("TERM").0, Some(143));
        folder.run(&format!("replay home/recording.json --out {again}")).ok();
        assert!(folder.read(&file) == folder.read("again"), "another log");

        let running = folder.start("run studio --for 1d --speed 1 --quiet");
        folder.until("it has begun", |folder| folder.files().iter().any(|file| file.contains(&format!("{log}."))));
        assert!(!folder.path(&format!("runs/studio-1/{log}")).exists(), "nothing is half written");
        running.kill();
    }
}

#[test]
fn the_numbers_of_a_run_are_served_under_their_own_name_alone() {
    let folder = Folder::with("studio");
    let home = Living::begin(&folder, "watched", "live studio --metrics 127.0.0.1:0");
    home.until("it says where", || home.told().contains("/metrics"));
    let told = home.told();
    let address = told.split("http://").nth(1).unwrap().split('/').next().unwrap().to_owned();
    let ask = |host: &str| get(&address, host, "/metrics", "");
    home.until("it has begun", || ask(&address).contains("homebody_lag_seconds"));
    let numbers = ask(&address);
    assert!(
        numbers.starts_with("HTTP/1.1 200") && numbers.contains("homebody_lag_seconds{scenario=\"studio\"}"),
        "{numbers}"
    );
    assert!(ask("evil.example").starts_with("HTTP/1.1 403"));
    assert_eq!(home.end("TERM").0, Some(143));
    folder.run("run studio --for 1h --metrics nowhere --out csv:a.csv").fails(2, "IP:PORT");
}
