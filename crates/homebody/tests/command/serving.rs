//! `homebody serve`, and the browser that it opens.

use crate::folder::Folder;
use crate::served::{address_of, get};
use std::fs;
use std::io::Read;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// Stands in for a browser's opener: says what it was started with, and keeps what it was led to.
const OPENER: &str = "#!/bin/sh\nprintf '%s\\n' \"$@\" > opened.tmp\ncp \"$1\" led.html\nmv opened.tmp opened\n";

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o777
}

/// The token stays secret on the machine: it is in no command line, and only its user can read the file with it, which exists only as
/// long as necessary.
#[test]
fn the_token_is_on_no_command_line() {
    let folder = Folder::with("by-hand");
    folder.write("bin/xdg-open", OPENER);
    folder.write("bin/open", OPENER);
    fs::create_dir(folder.path("runtime")).unwrap();
    for opener in ["bin/xdg-open", "bin/open"] {
        fs::set_permissions(folder.path(opener), fs::Permissions::from_mode(0o755)).unwrap();
    }
    let path = format!("{}:{}", folder.path("bin").display(), std::env::var("PATH").unwrap());
    let mut command = folder.command("serve by-hand");
    command.env("PATH", path);
    command.env("XDG_RUNTIME_DIR", folder.path("runtime")).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut served = command.spawn().unwrap();
    let (address, token) = address_of(&mut served);
    folder.until("a browser is opened", |folder| folder.path("opened").exists());
    let opened = folder.read("opened");
    assert!(!opened.contains(&token), "{opened}");
    let file = PathBuf::from(opened.trim());
    assert!(file.starts_with(folder.path("runtime")) && file.is_absolute(), "{opened}");
    assert_eq!((mode(&file), mode(file.parent().unwrap())), (0o600, 0o700));
    assert!(folder.read("led.html").contains(&format!("url=http://{address}/#token={token}\"")));
    #[cfg(target_os = "linux")]
    for line in ["cmdline", "environ"] {
        let line = fs::read(format!("/proc/{}/{line}", served.id())).unwrap();
        assert!(!String::from_utf8_lossy(&line).contains(&token));
    }

    // A stranger does not use it up; the page does.
    let ask =
        |token: &str| get(&address, &address, "/api/runs", &format!("x-homebody-token: {token}\r\n"))[9..12].to_owned();
    assert_eq!(ask("wrong"), "401");
    assert!(file.exists());
    assert_eq!(ask(&token), "200");
    folder.until("the file is removed", |_| !file.exists() && !file.parent().unwrap().exists());

    served.kill().unwrap();
    let mut errors = String::new();
    served.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
    assert!(!errors.contains(&token), "{errors}");
    served.wait().unwrap();
}

/// As with `homebody run`, a scenario can be trusted on request.
#[test]
fn a_scenario_of_ones_own_is_served_by_its_links() {
    let folder = Folder::with("by-hand");
    fs::rename(folder.path("by-hand/home.json"), folder.path("home.json")).unwrap();
    std::os::unix::fs::symlink("../home.json", folder.path("by-hand/home.json")).unwrap();
    folder.run("serve by-hand --no-open").fails(2, "it is a link to a place outside of the scenario's folder");
    let mut served = folder.command("serve by-hand --no-open --trust").stdout(Stdio::piped()).spawn().unwrap();
    address_of(&mut served);
    served.kill().unwrap();
    served.wait().unwrap();
}

/// A scenario with problems is served, so that the page can mend it; one whose files the page could not show is not.
#[test]
fn a_scenario_with_problems_is_served_and_what_cannot_be_shown_is_not() {
    let folder = Folder::with("tigerplace");
    let logger = folder.read("tigerplace/logger.json");
    folder.write("tigerplace/logger.json", logger.replace("hall motion", "corridor motion"));
    let mut command = folder.command("serve tigerplace --no-open --port 0");
    let mut served = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    address_of(&mut served);
    served.kill().unwrap();
    let mut warned = String::new();
    served.stderr.take().unwrap().read_to_string(&mut warned).unwrap();
    served.wait().unwrap();
    assert!(warned.contains("warning[serve::problems]"), "{warned}");
    folder.write("tigerplace/scenario.json", "{");
    folder.run("serve tigerplace --no-open").fails(2, "scenario.json");
    folder.run("serve nowhere --no-open").fails(1, "nowhere");
}
