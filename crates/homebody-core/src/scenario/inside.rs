//! Confines files to a folder: the names in a file are read and written below one folder, whatever its author wrote.

use crate::problem::Advice;

/// The hint for a link that leads out of the scenario's folder.
pub const WHERE: &str = "name a file relative to the scenario's folder, with / between folders";

crate::messages! {
    /// Problems with the files that other files name.
    pub enum FileMessage in "file" {
        /// The name of a file is empty or blank.
        NoName error "empty-name" ("a file name must not be empty")
            hint ("write the name of a file");
        /// A scenario reads files in its own folder only, and a run writes files in its own folder only. So names do not begin with
        /// `/`, and contain no `..`, colon or backslash.
        OutsideFolder { name: String, folder: String }
            error "outside-folder" ("{name:?} is not a file name inside {folder}")
            hint ("name a file relative to the folder, with / between folders");
        /// A log is a file in the run's folder. This name is that of a folder.
        IsFolder { path: String } error "is-folder" ("{path:?} is a folder")
            hint ("name a file in it");
        /// File systems limit the length of names and paths, and Homebody adds endings to them.
        NameTooLong {
            /// The largest length of a name, in bytes.
            most_bytes: usize,
            /// The largest length of a path, in bytes.
            most_path_bytes: usize,
        } error "name-too-long" ("the name has more than {most_bytes} bytes, or its path more than {most_path_bytes}")
            hint ("choose a shorter name");
        /// Each run writes some files of its own into its folder: the recording, the ground truth, the table of sensors and others.
        OfRun { path: String, of_run: String }
            error "of-run" ("{path:?} conflicts with {of_run}, which each run writes into its folder")
            hint ("choose another name, such as \"csv:logs/week.csv\"");
        /// Homebody creates and removes files with this ending while it runs.
        OfProgram { path: String, ending: String }
            error "reserved-ending" ("{path:?} ends in {ending}, which Homebody uses for temporary files")
            hint ("choose another name, such as \"csv:logs/week.csv\"");
        /// Two logs of a run cannot share a file.
        SameFile { path: String } error "same-file" ("two logs have the same file {path:?}")
            hint ("give each log its own file, such as \"csv:logs/week.csv\"");
        /// One of the paths is a folder of the other, or is a file that Homebody writes next to the other.
        Collision { path: String, other: String } error "collision" ("{path:?} and {other:?} cannot both be files")
            hint ("choose another name, such as \"csv:logs/week.csv\"");
        /// The folder of the scenario does not contain the file.
        Missing { name: String, nearest: Option<String> } error "not-found" ("there is no file {name:?}")
            advice (Some(match nearest {
                Some(near) => Advice::meant(near),
                None => "create the file, or correct the name".into(),
            }));
        /// The file exists and cannot be read as text: it may be a folder, a link, larger than Homebody reads, or not in UTF-8.
        Unreadable { name: String, why: String, help: Option<String> }
            error "unreadable" ("cannot read {name:?}: {why}")
            advice (help.clone());
        /// Each file of a scenario has one kind, such as home, logger or resident.
        TwoUses {
            name: String,
            /// The kind that it is used as.
            used: String,
            /// The kind that it is linked as here.
            wanted: String,
        } error "two-uses" ("{name:?} is already used as {used}, so it cannot be {wanted}")
            hint ("name another file");
        /// Two residents have the same file. They would be the same person.
        LinkedTwice { name: String } error "linked-twice" ("two residents have the same file {name:?}")
            hint ("give each resident its own file");
        /// The file is valid, but of another kind than the link needs. Two links may be swapped.
        WrongKind { name: String, found: String, wanted: String }
            error "wrong-kind" ("{name:?} is {found}, but {wanted} is needed here")
            hint ("name another file");
        /// Routines and scripts have a largest length, so that reading them takes a moment only.
        TooLong { name: String, why: String } error "too-long" ("{name:?} is too long: {why}")
            hint ("shorten it");
    }
}

/// The problem with a name that is to be a file inside `folder`, which is given in words; `None` for a valid name. The spelling
/// alone decides, so that a name means the same on each system. Links on a disk concern those functions that read them.
pub fn outside_folder(name: &str, folder: &str) -> Option<FileMessage> {
    if name.trim().is_empty() {
        return Some(FileMessage::NoName);
    }
    let leaves = name.split(['/', '\\']).any(|part| part == "..");
    let is_absolute = name.starts_with(['/', '\\']) || name.contains(':');
    let is_odd = name.contains('\\') || name.chars().any(char::is_control);
    let outside = || FileMessage::OutsideFolder { name: name.to_owned(), folder: folder.to_owned() };
    (leaves || is_absolute || is_odd).then(outside)
}

/// The name of the recording in a run's folder.
pub const RECORDING: &str = "recording.json";
/// The name of the database of the truth in a run's folder.
pub const TRUTH: &str = "truth.db";
/// The name of the table of sensors in a run's folder: id in the log, name in the home, kind, room and place.
pub const SENSORS: &str = "sensors.csv";
/// The name of the database of the cameras' silhouettes in a run's folder, if its home has cameras.
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

/// The truth of a stopped run, while it is written again.
const ANEW: &str = "anew.truth.db";

/// Endings of files that the program makes and removes by itself.
const OF_PROGRAM: [&str; 5] = [CONFIRMED, ".lock", ".part", ".spool", ".old"];

/// Endings after the name of a file in the names of companion files during writing.
const BESIDE: [&str; 6] = ["-wal", "-shm", "-journal", ".lock", ".anew", ".anew.lock"];

/// Beginnings of endings with a number.
const NUMBERED: [&str; 2] = [".part", ".old"];

/// Longest name of a file in a run's folder (our choice): file systems take 255 bytes, and companion files have longer
/// names.
const LONGEST_NAME_BYTES: usize = 200;

/// Longest path in a run's folder (our choice): systems take 4096 bytes, and the folder has some.
const LONGEST_PATH_BYTES: usize = 1000;

/// The problem with a log at a path inside a run's folder that has logs at `others`; `None` for a free path. Letters are compared
/// without their case, as some file systems do.
pub fn taken_in_run(path: &str, others: &[&str]) -> Option<FileMessage> {
    let own = plainly(path);
    let path = path.to_owned();
    if own.is_empty() || path.ends_with('/') || path.ends_with("/.") {
        return Some(FileMessage::IsFolder { path });
    }
    if own.split('/').any(|part| part.len() > LONGEST_NAME_BYTES) || own.len() > LONGEST_PATH_BYTES {
        let (most_bytes, most_path_bytes) = (LONGEST_NAME_BYTES, LONGEST_PATH_BYTES);
        return Some(FileMessage::NameTooLong { most_bytes, most_path_bytes });
    }
    if let Some(of_run) = OF_RUN.into_iter().find(|of_run| collide(&own, of_run)) {
        return Some(FileMessage::OfRun { path, of_run: of_run.to_owned() });
    }
    if let Some(ending) = OF_PROGRAM.into_iter().find(|ending| own.ends_with(ending)) {
        return Some(FileMessage::OfProgram { path, ending: ending.to_owned() });
    }
    let other = others.iter().find(|other| collide(&own, &plainly(other)))?;
    Some(match own == plainly(other) {
        true => FileMessage::SameFile { path },
        false => FileMessage::Collision { path, other: (*other).to_owned() },
    })
}

/// A path without what changes nothing in it.
fn plainly(path: &str) -> String {
    let parts: Vec<&str> = path.split('/').filter(|part| !part.is_empty() && *part != ".").collect();
    parts.join("/").to_lowercase()
}

/// Whether one of two files is in the place of the other, of its folder, or of a companion file.
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
    use crate::problem::Diagnose;

    #[test]
    fn refuses_names_that_lead_out_of_the_folder() {
        for name in ["log.db", "logs/log.db", "a b/ö.csv", "..log", "log..db", "./log.db", "~/log.db"] {
            assert!(outside_folder(name, "it").is_none(), "{name}");
        }
        #[rustfmt::skip]
        let cases = [
            "", " ", "/etc/passwd", "..", "../log.db", "a/../../b", "a/..", "C:log", "\\\\host\\log", "a\\..\\b",
            "a\nb",
        ];
        for name in cases {
            assert!(outside_folder(name, "it").is_some(), "{name}");
        }
    }

    #[test]
    fn a_log_cannot_take_the_place_of_another_file() {
        for path in ["log.db", "logs/log.db", "./log.db", "truth.csv", "recording.json.txt", "x/truth.db"] {
            assert!(taken_in_run(path, &["other.db", "logs/other.db"]).is_none(), "{path}");
        }
        let long = "x".repeat(201);
        let deep = "x/".repeat(501) + "log.db";
        for (path, code, of_run) in [
            (".", "file::is-folder", ""),
            ("x/", "file::is-folder", ""),
            ("x/.", "file::is-folder", ""),
            ("./", "file::is-folder", ""),
            (&long, "file::name-too-long", ""),
            (&deep, "file::name-too-long", ""),
            ("recording.json", "file::of-run", "recording.json"),
            ("./Recording.JSON", "file::of-run", "recording.json"),
            ("recording.json/log.db", "file::of-run", "recording.json"),
            ("recording.json.7-0.part", "file::of-run", "recording.json"),
            ("truth.db-wal", "file::of-run", "truth.db"),
            ("truth.db-journal/log.db", "file::of-run", "truth.db"),
            ("truth.db.anew", "file::of-run", "truth.db"),
            ("truth.db.lock", "file::of-run", "truth.db"),
            ("sensors.csv", "file::of-run", "sensors.csv"),
            ("about-run.json", "file::of-run", "about-run.json"),
            ("./Care-Notes.json", "file::of-run", "care-notes.json"),
            ("cohort.json", "file::of-run", "cohort.json"),
            ("anew.truth.db", "file::of-run", "anew.truth.db"),
            ("jsonl.confirmed.json", "file::reserved-ending", ""),
            ("logs/a.lock", "file::reserved-ending", ""),
            ("week.csv.part", "file::reserved-ending", ""),
            ("mqtt.spool", "file::reserved-ending", ""),
            ("other.db", "file::same-file", ""),
            ("./other.db", "file::same-file", ""),
            ("other.db-shm", "file::collision", ""),
            ("other.db/log.db", "file::collision", ""),
            ("logs", "file::collision", ""),
        ] {
            let problem = taken_in_run(path, &["other.db", "logs/other.db"]).expect(path).diagnostic();
            assert_eq!(problem.code, code, "{path}");
            assert_eq!(problem.data.get("of_run").and_then(|name| name.as_str()).unwrap_or_default(), of_run, "{path}");
        }
    }
}
