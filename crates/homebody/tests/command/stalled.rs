//! A reader of standard output stops reading. The run notices it, the home's own log grows, and a signal ends the run soon.

use crate::folder::{Ends, Folder, numbers};
use crate::served::get;
use std::fs::File;
use std::io::Read;
use std::process::{ChildStdout, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// A run that is stopped ends within this time, on however slow a machine; without a word it would wait for its reader for good.
const SOON: Duration = Duration::from_secs(30);

const TIMEOUT: &str = "--destination-timeout 1s";

/// Begins a command; the test does not read its standard output.
fn unread(folder: &Folder, words: &str) -> (Ends, ChildStdout) {
    let mut command = folder.command(words);
    command.stdout(Stdio::piped()).stderr(File::create(folder.path("said")).unwrap());
    let mut child = command.spawn().unwrap();
    let output = child.stdout.take().unwrap();
    (Ends(child), output)
}

/// Ends a command by a signal; its exit code.
fn stop(folder: &Folder, command: &mut Ends) -> Option<i32> {
    command.stop("TERM", SOON, || folder.read("said"))
}

fn metrics(folder: &Folder) -> String {
    let said = folder.read("said");
    let address = said.lines().find_map(|line| line.strip_prefix("metrics    http://")).unwrap();
    let address = address.trim_end_matches("/metrics");
    get(address, address, "/metrics", "")
}

#[test]
fn a_reader_that_stands_still_stops_neither_the_homes_own_log_nor_a_signal() {
    let folder = Folder::with("studio");
    folder.edit("studio/logger.json", "casas:log.txt", "sqlite:log.db");
    let stored = || folder.stored_rows("home/log.db");
    let words = format!("live studio --folder home --start 2024-11-01 --out jsonl:- {TIMEOUT}");
    let (mut home, mut output) = unread(&folder, &format!("{words} --on-unavailable spool --metrics 0"));
    folder.until("it is noticed", |folder| folder.read("said").contains("is unavailable: it has not answered for 1 s"));
    let before = stored();
    folder.until("the home's own log goes on", |_| stored() > before + 5000);
    let seen = metrics(&folder);
    let up = "homebody_destination_up{scenario=\"studio\",destination=\"jsonl:-\"} 0";
    assert!(seen.contains(up), "{seen}");
    assert_eq!(stop(&folder, &mut home), Some(143), "{}", folder.read("said"));
    assert!(folder.read("said").contains("was unavailable when the run stopped"), "{}", folder.read("said"));
    let mut first = String::new();
    output.read_to_string(&mut first).unwrap();
    let first = numbers(&first);

    // The same command gives the rest, by its numbers.
    let words = "live studio --folder home --out jsonl:- --quiet";
    let out = File::create(folder.path("rest")).unwrap();
    let mut home = Ends(folder.command(words).stdout(out).stderr(Stdio::null()).spawn().unwrap());
    let all = stored();
    folder.until("it goes on", |_| stored() > all);
    assert_eq!(stop(&folder, &mut home), Some(143));
    let rest = numbers(&folder.read("rest"));
    assert!(first.iter().copied().eq(0..first.len() as u64));
    assert!(rest[0] <= first.len() as u64, "{} and {}", first.len(), rest[0]);
    assert!(rest.iter().copied().eq(rest[0]..stored() as u64), "no row is missing");
}

#[test]
fn a_signal_ends_a_run_before_it_is_noticed_that_nobody_reads() {
    let folder = Folder::with("studio");
    folder.edit("studio/logger.json", "casas:log.txt", "sqlite:log.db");
    let words = "live studio --folder home --start 2024-11-01 --out jsonl:- --destination-timeout 1h";
    let (mut home, _output) = unread(&folder, words);
    folder.until("it has begun", |folder| folder.stored_rows("home/log.db") > 0);
    let stands = || {
        let before = folder.stored_rows("home/log.db");
        thread::sleep(Duration::from_secs(1));
        folder.stored_rows("home/log.db") == before
    };
    folder.until("it stands still", |_| stands());
    assert_eq!(stop(&folder, &mut home), Some(143), "{}", folder.read("said"));
    folder.run("replay home/recording.json --out csv:again.csv").ok();
}

#[test]
fn a_reader_that_stands_still_ends_a_run_that_does_not_wait_and_a_slow_one_does_not() {
    let folder = Folder::with("studio");
    let (mut run, _output) = unread(&folder, &format!("run studio --for 60d --out jsonl:- {TIMEOUT}"));
    let status = run.0.wait().unwrap();
    let said = folder.read("said");
    assert!(status.code() == Some(1) && said.contains("jsonl:- has not answered for"), "{status}: {said}");
    // The control: who takes longer than that for all of it, and a little all the time, gets all of it.
    let (mut run, mut output) = unread(&folder, &format!("run studio --for 2d --out jsonl:- {TIMEOUT}"));
    let (begun, mut all, mut piece) = (Instant::now(), Vec::new(), [0; 4096]);
    loop {
        let length = output.read(&mut piece).unwrap();
        if length == 0 {
            break;
        }
        all.extend_from_slice(&piece[..length]);
        thread::sleep(if begun.elapsed() < Duration::from_secs(4) {
            Duration::from_millis(200)
        } else {
            Duration::ZERO
        });
    }
    assert!(run.0.wait().unwrap().success(), "{}", folder.read("said"));
    let rows = numbers(&String::from_utf8(all).unwrap());
    assert!(rows.iter().copied().eq(0..rows.len() as u64) && begun.elapsed() > Duration::from_secs(2));
}
