//! A run reports that its broker is unavailable, and waits. After a stop meanwhile it ends soon, and resumes when the broker is available
//! again.

use crate::flat::flat;
use crate::folder::{Ends, Folder};
use crate::mosquitto::Broker;
use std::fs::File;
use std::process::Stdio;
use std::thread;
use std::time::{Duration, Instant};

const SPAN: &str = "50m";

/// A run that is stopped ends within this time, on however slow a machine: it waits for the broker for ten minutes, or a day.
const SOON: Duration = Duration::from_secs(60);

/// Starts a run, kills its broker, and stops the run at once or when it reports that it waits. Returns its exit code and messages.
fn stopped(folder: &Folder, words: &str, broker: &mut Broker, says: Option<&str>) -> (Option<i32>, String) {
    let mut command = folder.command(words);
    command.stdout(Stdio::null()).stderr(File::create(folder.path("said")).unwrap());
    let mut run = Ends(command.spawn().unwrap());
    let is_note = |name: &String| name.ends_with(".confirmed.json");
    folder.until("the broker has confirmed rows", |folder| folder.files().iter().any(is_note));
    broker.kill();
    if let Some(says) = says {
        folder.until("the run says what it waits for", |folder| folder.read("said").contains(says));
    } else {
        // It has noticed by now, and has not given up hope yet.
        thread::sleep(Duration::from_secs(2));
    }
    assert!(run.0.try_wait().unwrap().is_none(), "{}", folder.read("said"));
    let code = run.stop("INT", SOON, || folder.read("said"));
    (code, folder.read("said"))
}

#[test]
fn a_run_that_is_stopped_while_its_broker_is_away_ends_soon_and_is_gone_on_with() {
    let waits = "is unavailable: no broker listens on this host and port\n  the run waits for it for at most 600 s\n";
    let spools = "is unavailable: no broker listens on this host and port\n  Homebody stores rows in the spool until it is available\n";
    for (log, more, says) in
        [("log.db", "", Some(waits)), ("log.csv", "", None), ("log.db", "--on-unavailable spool", Some(spools))]
    {
        let folder = flat();
        let kind = if log == "log.db" { "sqlite" } else { "csv" };
        folder.edit("flat/logger.json", "sqlite:log.db", &format!("{kind}:{log}"));
        let Some(mut broker) = Broker::start() else { return };
        let port = broker.port;
        let words = format!("--speed 60 --out mqtt://127.0.0.1:{port}/homebody?allow-fast=true {more}");
        let (code, said) = stopped(&folder, &format!("run flat --for {SPAN} {words}"), &mut broker, says);
        assert_eq!(code, Some(130), "{said}");
        let [why, hint] =
            [" was unavailable when the run stopped: no broker listens on this host and port;", "--resume runs/flat-1"];
        assert!(said.contains(why) && said.contains(hint), "{said}");
        assert_eq!(said.matches("warning: ").count(), usize::from(says.is_some()), "it is said once: {said}");
        let is_back = |line: &str| line.ends_with(" is available again") && !line.starts_with(' ');
        assert!(!said.lines().any(is_back), "{said}");

        broker.begin();
        folder.run(&format!("run --resume runs/flat-1 --out mqtt://127.0.0.1:{port}/homebody?allow-fast=true")).ok();
        folder.run(&format!("run flat --for {SPAN} --quiet")).ok();
        let rows = |run: &str| match kind {
            "sqlite" => folder.query(&format!("runs/{run}/{log}"), "SELECT seq, sensor, value, fired_at FROM firing"),
            _ => folder.read(&format!("runs/{run}/{log}")).lines().skip(1).map(str::to_owned).collect(),
        };
        assert_eq!(rows("flat-1"), rows("flat-2"));
        assert_eq!(folder.truth_sha256("runs/flat-1/truth.db"), folder.truth_sha256("runs/flat-2/truth.db"));
        let note = folder.files().into_iter().find(|name| name.ends_with(".confirmed.json")).unwrap();
        let confirmed = format!("\"rows\":[{}]", rows("flat-1").len());
        assert!(folder.read(&note).contains(&confirmed), "{confirmed}: {}", folder.read(&note));
    }
}

#[test]
fn a_broker_that_comes_late_is_an_error_or_waited_for_as_is_said() {
    let folder = flat();
    // Without mosquitto, there is nothing to test.
    let Some(mut broker) = Broker::start() else { return };
    let port = broker.port;
    broker.kill();
    let words = format!("run flat --for 20m --out mqtt://127.0.0.1:{port}/homebody?allow-fast=true");
    let begun = Instant::now();
    folder.run(&words).fails(1, "no broker listens on this host and port\n  hint: start the broker");
    assert!(begun.elapsed() < SOON, "{:?}", begun.elapsed());
    for (number, (how, says)) in
        [("retry", "the run waits"), ("spool", "stores rows in the spool")].into_iter().enumerate()
    {
        let mut command = folder.command(&format!("{words} --on-unavailable {how}"));
        command.stdout(Stdio::null()).stderr(File::create(folder.path("said")).unwrap());
        let mut run = Ends(command.spawn().unwrap());
        folder.until("the run says what it waits for", |folder| folder.read("said").contains(says));
        broker.begin();
        let status = run.0.wait().unwrap();
        let said = folder.read("said");
        assert!(status.success() && said.lines().any(|line| line.ends_with(" is available again")), "{how}: {said}");
        let run = format!("runs/flat-{}", number + 1);
        let note = folder.files().into_iter().find(|name| name.starts_with(&run) && name.ends_with(".confirmed.json"));
        let confirmed = format!("\"rows\":[{}]", folder.stored_rows(&format!("{run}/log.db")));
        assert!(folder.read(&note.unwrap()).contains(&confirmed), "{how}: {confirmed}");
        broker.kill();
    }
}
