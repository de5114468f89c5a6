//! A command that was killed on its way can be repeated, and completes its output.

use crate::flat::flat;
use crate::folder::Folder;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

/// Kills of each command, each a little later.
const KILLS: u32 = 3;

const LATER: Duration = Duration::from_millis(25);

/// Kills a command several times, and repeats it each time: it has the same files, without remains of the killed one.
fn killed_and_given_again(folder: &Folder, words: &str, made: &[&str], signal: &str) -> u32 {
    let before = folder.files();
    let remove = || {
        for name in made {
            let path = folder.path(name);
            let _ = if path.is_dir() { std::fs::remove_dir_all(path) } else { std::fs::remove_file(path) };
        }
    };
    folder.run(words).ok();
    let whole = folder.files();
    assert!(whole.len() > before.len());
    let mut killed = 0;
    for number in 0..KILLS {
        remove();
        assert_eq!(folder.files(), before, "{words}");
        let mut child = folder.command(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        thread::sleep(LATER * number);
        let _ = std::process::Command::new("kill").args([signal, &child.id().to_string()]).status();
        if child.wait().unwrap().success() {
            continue;
        }
        killed += 1;
        // The kill came after the last file was whole.
        if folder.files() == whole {
            continue;
        }
        folder.run(words).ok();
        assert_eq!(folder.files(), whole, "{words}, killed after {number} times {LATER:?}");
    }
    remove();
    killed
}

#[test]
fn killed_commands_are_given_again() {
    let folder = flat();
    folder.run("run flat --for 50m --quiet").ok();
    let mut killed = 0;
    for (signal, words, made) in [
        ("-KILL", "new my-home --template tigerplace", &["my-home"][..]),
        ("-TERM", "new my-home --template tigerplace", &["my-home"]),
        ("-KILL", "convert runs/flat-1 --out sqlite:out.db", &["out.db"]),
        ("-TERM", "convert runs/flat-1 --out csv:out.csv", &["out.csv", "out.sensors.csv"]),
        ("-KILL", "convert runs/flat-1 --out jsonl:out.jsonl.gz", &["out.jsonl.gz", "out.sensors.csv"]),
        ("-KILL", "label runs/flat-1 --out sqlite:labelled.db", &["labelled.db"]),
    ] {
        killed += killed_and_given_again(&folder, words, made, signal);
    }
    assert!(killed > 2, "{killed} were killed before their end");
}
