//! The parts of packages: the command accepts the words of the unit and the container, and paths exist.

use crate::folder::{Folder, ROOT, signal};
use std::fs;
use std::path::Path;
use std::process::Command;

fn read(name: &str) -> String {
    fs::read_to_string(Path::new(ROOT).join("packaging").join(name)).unwrap()
}

/// The values of a key of the unit.
fn said<'t>(unit: &'t str, key: &str) -> Vec<&'t str> {
    unit.lines().filter_map(|line| line.strip_prefix(key)?.strip_prefix('=')).collect()
}

/// Has the command understand its words, in a folder with these homes; it ends soon, whatever it would do.
fn understood(words: &str, home: &str) {
    let folder = Folder::with("by-hand");
    fs::rename(folder.path("by-hand"), folder.path("etc-home")).unwrap();
    let words = words.replace(home, &folder.path("etc-home").display().to_string());
    let words = words.replace("/var/lib/homebody", &folder.path("state").display().to_string());
    fs::create_dir(folder.path("state")).unwrap();
    // A build with all kinds of places is not needed for the words.
    let done = folder.run(&format!("{words} --help"));
    assert_eq!(done.code, Some(0), "{words}: {}", done.err);
    // A word that there is not shows that words are read at all.
    folder.run(&format!("{words} --no-such-word")).fails(2, "unexpected argument '--no-such-word'");
}

#[test]
fn the_words_of_the_unit_are_understood() {
    let unit = read("homebody@.service");
    let [start] = said(&unit, "ExecStart")[..] else { panic!("one ExecStart") };
    let words = start.strip_prefix("/usr/bin/homebody ").unwrap();
    let words = words.replace("$HOMEBODY_WORDS", "--metrics 9464").replace("%i", "tigerplace");
    understood(&words, "/etc/homebody/tigerplace");
    // The exit code of a stopped home is not a failure.
    assert_eq!(said(&unit, "SuccessExitStatus"), ["143"]);
    assert_eq!(said(&unit, "StateDirectory"), ["homebody"]);
    assert_eq!(said(&unit, "WorkingDirectory"), ["/var/lib/homebody"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_home_of_the_unit_lives_stops_in_time_and_goes_on() {
    use std::thread::sleep;
    use std::time::{Duration, Instant};
    let folder = Folder::with("by-hand");
    let unit = read("homebody@.service");
    let words = said(&unit, "ExecStart")[0].strip_prefix("/usr/bin/homebody ").unwrap();
    let words = words.replace(" $HOMEBODY_WORDS", "").replace("/etc/homebody/%i", "by-hand");
    let words = words.replace("/var/lib/homebody/%i", "state");
    for _ in 0..2 {
        let mut home = folder.command(&words).spawn().unwrap();
        folder.until("it begins", |folder| folder.path("state/recording.json").exists());
        sleep(Duration::from_millis(700));
        let told = Instant::now();
        signal(&home, "TERM");
        let ended = home.wait().unwrap();
        assert_eq!(ended.code(), Some(143), "as the unit says");
        assert!(told.elapsed() < Duration::from_secs(30));
    }
}

#[test]
fn systemd_finds_nothing_wrong_with_the_unit() {
    let Ok(version) = Command::new("systemd-analyze").arg("--version").output() else {
        println!("skipped: systemd is not installed");
        return;
    };
    assert!(version.status.success());
    let folder = Folder::new();
    // The program of this test in place of the one that a package installs.
    let unit = read("homebody@.service").replace("/usr/bin/homebody", env!("CARGO_BIN_EXE_homebody"));
    let verify = |name: &str, unit: &str| {
        folder.write(name, unit);
        let done =
            Command::new("systemd-analyze").args(["verify", "--man=no"]).arg(folder.path(name)).output().unwrap();
        String::from_utf8_lossy(&done.stderr)
            .lines()
            .filter(|line| line.contains(name))
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(verify("homebody@tigerplace.service", &unit), [""; 0]);
    // The control: a key that there is not.
    let said = verify("homebody@other.service", &unit.replace("TimeoutStopSec", "TimeoutStopSecs"));
    assert!(said.iter().any(|line| line.contains("TimeoutStopSecs")), "{said:?}");
}

#[test]
fn the_files_of_the_container_exist() {
    let file = read("Containerfile");
    let folder = Folder::new();
    let mut copied = 0;
    for line in file.lines().filter_map(|line| line.strip_prefix("COPY --from=build /source/")) {
        let (from, to) = line.split_once(' ').unwrap();
        assert!(from == "target/release/homebody" || Path::new(ROOT).join(from).exists(), "{from}");
        assert!(to.starts_with("/usr/"), "{to}");
        copied += 1;
    }
    assert_eq!(copied, 2);
    let words = |key: &str| {
        let line = file.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(' ')).unwrap();
        serde_json::from_str::<Vec<String>>(line).unwrap()
    };
    assert_eq!(words("ENTRYPOINT"), ["/usr/bin/homebody"]);
    folder.run(&words("CMD").join(" ")).ok();
    // Files that do not belong in it are left out.
    let left_out = fs::read_to_string(Path::new(ROOT).join(".containerignore")).unwrap();
    assert!(["target", ".git", "web/node_modules"].iter().all(|name| left_out.lines().any(|line| line == *name)));
    // The page is built with it, and so are all kinds of places.
    assert!(file.contains("npm") && file.contains("--features all") && file.contains("--locked"));
    // The examples of the document are understood.
    let document = fs::read_to_string(Path::new(ROOT).join("docs/how-to/deploy.md")).unwrap();
    let examples = document.lines().filter_map(|line| line.strip_prefix("podman run ")?.split_once(" homebody "));
    for (_, words) in examples {
        let words = words.replace("/usr/share/homebody/scenarios", &format!("{ROOT}/scenarios"));
        assert_eq!(folder.run(&format!("{words} --help")).code, Some(0), "{words}");
    }
}
