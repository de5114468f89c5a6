//! Places stay inside: what a file names is read and written below one folder, whoever wrote the file.

/// What to do about a link that leads out of the folder.
pub const WHERE: &str = "name a file relative to the scenario's folder, with / between folders";

/// Why a name is refused that is to be a file inside `folder`, which is given in words; `None` if it is one. It is the
/// spelling that is looked at, so that a name means the same on each system: links on a disk are for who reads them.
pub fn outside_folder(name: &str, folder: &str) -> Option<String> {
    if name.trim().is_empty() {
        return Some("a file name must not be empty".into());
    }
    let leaves = name.split(['/', '\\']).any(|part| part == "..");
    let is_absolute = name.starts_with(['/', '\\']) || name.contains(':');
    let is_odd = name.contains('\\') || name.chars().any(char::is_control);
    (leaves || is_absolute || is_odd).then(|| format!("{name:?} is no file name inside {folder}"))
}

/// What a run's folder calls its recording.
pub const RECORDING: &str = "recording.json";
/// What a run's folder calls the database of its truth.
pub const TRUTH: &str = "truth.db";
/// What a run's folder calls the table of its sensors: id in the log, name in the home, kind, room and place.
pub const SENSORS: &str = "sensors.csv";
/// What a run's folder calls the database of its cameras' silhouettes, where its home has cameras.
pub const SILHOUETTES: &str = "silhouettes.db";

/// The list of members in a cohort's folder.
pub const LIST: &str = "cohort.json";
/// The page's file with a run's title, in the run's folder.
pub const ABOUT: &str = "about-run.json";
/// The page's file with notes about days, in the run's folder.
pub const NOTES: &str = "care-notes.json";
/// The ending of a file that counts the rows that a destination has confirmed.
pub const CONFIRMED: &str = ".confirmed.json";

/// The files of a run's folder besides its logs.
const OF_RUN: [&str; 8] = [RECORDING, TRUTH, SENSORS, SILHOUETTES, LIST, ABOUT, NOTES, ANEW];

/// The truth of a run that was stopped, while it is written anew.
const ANEW: &str = "anew.truth.db";

/// Endings of files that the program makes and removes by itself.
const OF_PROGRAM: [&str; 5] = [CONFIRMED, ".lock", ".part", ".spool", ".old"];

/// What comes behind the name of a file in the names of those that are beside it while it is written.
const BESIDE: [&str; 6] = ["-wal", "-shm", "-journal", ".lock", ".anew", ".anew.lock"];

/// How those end that have a number between.
const NUMBERED: [&str; 2] = [".part", ".old"];

/// Longest name of a file in a run's folder (our choice): file systems take 255 bytes, and companion files have longer
/// names.
const LONGEST_NAME_BYTES: usize = 200;

/// Longest path in a run's folder (our choice): systems take 4096 bytes, and the folder has some.
const LONGEST_PATH_BYTES: usize = 1000;

/// Why a log cannot go to a path inside a run's folder, where `others` go, too; `None` if it can. Letters are compared without
/// their case, as some file systems do.
pub fn taken_in_run(path: &str, others: &[&str]) -> Option<String> {
    let own = plainly(path);
    if own.is_empty() || path.ends_with('/') || path.ends_with("/.") {
        return Some(format!("{path:?} is a folder, and no file in it"));
    }
    if own.split('/').any(|part| part.len() > LONGEST_NAME_BYTES) || own.len() > LONGEST_PATH_BYTES {
        return Some(format!(
            "the file name is too long: it has more than {LONGEST_NAME_BYTES} bytes, or its folders more \
             than {LONGEST_PATH_BYTES}"
        ));
    }
    if let Some(of_run) = OF_RUN.into_iter().find(|of_run| collide(&own, of_run)) {
        return Some(format!("{path:?} is the place of the run's own {of_run}, or beside it"));
    }
    if let Some(ending) = OF_PROGRAM.into_iter().find(|ending| own.ends_with(ending)) {
        return Some(format!("{path:?} ends with {ending}, as files do that this program makes and removes by itself"));
    }
    let other = others.iter().find(|other| collide(&own, &plainly(other)))?;
    Some(match own == plainly(other) {
        true => format!("two logs cannot go to the one file {path:?}"),
        false => format!("{path:?} and {other:?} cannot both be files: one would be in the place of the other"),
    })
}

/// A path without what changes nothing in it.
fn plainly(path: &str) -> String {
    let parts: Vec<&str> = path.split('/').filter(|part| !part.is_empty() && *part != ".").collect();
    parts.join("/").to_lowercase()
}

/// Whether one of two files is in the place of the other, of its folder, or of what is beside it.
fn collide(one: &str, other: &str) -> bool {
    let takes = |one: &str, other: &str| {
        let Some(rest) = one.strip_prefix(other) else { return false };
        // A folder of the name of a file takes its place, too.
        let rest = rest.split_once('/').map_or(rest, |(rest, _)| rest);
        let is_numbered = rest.starts_with('.') && NUMBERED.iter().any(|end| rest.ends_with(end));
        rest.is_empty() || BESIDE.contains(&rest) || is_numbered
    };
    takes(one, other) || takes(other, one)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_lead_out_are_refused() {
        for name in ["log.db", "logs/log.db", "a b/ö.csv", "..log", "log..db", "./log.db", "~/log.db"] {
            assert_eq!(outside_folder(name, "it"), None, "{name}");
        }
        for name in [
            "",
            " ",
            "/etc/passwd",
            "..",
            "../log.db",
            "a/../../b",
            "a/..",
            "C:log",
            "\\\\host\\log",
            "a\\..\\b",
            "a\nb",
        ] {
            assert!(outside_folder(name, "it").is_some(), "{name}");
        }
    }

    #[test]
    fn a_log_takes_no_place_that_is_another_s() {
        for path in ["log.db", "logs/log.db", "./log.db", "truth.csv", "recording.json.txt", "x/truth.db"] {
            assert_eq!(taken_in_run(path, &["other.db", "logs/other.db"]), None, "{path}");
        }
        let long = "x".repeat(201);
        let deep = "x/".repeat(501) + "log.db";
        for (path, why) in [
            (".", "is a folder"),
            ("x/", "is a folder"),
            ("x/.", "is a folder"),
            ("./", "is a folder"),
            (&long, "too long"),
            (&deep, "too long"),
            ("recording.json", "the run's own recording.json"),
            ("./Recording.JSON", "the run's own recording.json"),
            ("recording.json/log.db", "the run's own recording.json"),
            ("recording.json.7-0.part", "the run's own recording.json"),
            ("truth.db-wal", "the run's own truth.db"),
            ("truth.db-journal/log.db", "the run's own truth.db"),
            ("truth.db.anew", "the run's own truth.db"),
            ("truth.db.lock", "the run's own truth.db"),
            ("sensors.csv", "the run's own sensors.csv"),
            ("about-run.json", "the run's own about-run.json"),
            ("./Care-Notes.json", "the run's own care-notes.json"),
            ("cohort.json", "the run's own cohort.json"),
            ("anew.truth.db", "the run's own anew.truth.db"),
            ("jsonl.confirmed.json", "ends with .confirmed.json"),
            ("logs/a.lock", "ends with .lock"),
            ("week.csv.part", "ends with .part"),
            ("mqtt.spool", "ends with .spool"),
            ("other.db", "two logs cannot go to the one file"),
            ("./other.db", "two logs cannot go to the one file"),
            ("other.db-shm", "cannot both be files"),
            ("other.db/log.db", "cannot both be files"),
            ("logs", "cannot both be files"),
        ] {
            let said = taken_in_run(path, &["other.db", "logs/other.db"]).unwrap_or_default();
            assert!(said.contains(why), "{path}: {said}");
        }
    }
}
