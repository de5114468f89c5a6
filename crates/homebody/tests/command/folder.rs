//! A folder for each test, in which the command runs.

use rusqlite::types::Value;
use rusqlite::{Connection, OpenFlags};
use serde_json::Value as Json;
use sha2::{Digest, Sha256};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::OnceLock;
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait: far longer than necessary, for busy machines.
const PATIENCE: Duration = Duration::from_secs(120);

pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// The program of the package whose tests these are.
const PROGRAM: &str = match (option_env!("CARGO_BIN_EXE_homebody"), option_env!("CARGO_BIN_EXE_homebody-lab")) {
    (Some(program), _) | (None, Some(program)) => program,
    (None, None) => panic!("a package with a program"),
};

pub type Files = Vec<(String, Vec<u8>)>;

/// A folder that vanishes with the test.
pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    /// A folder with a copy of a scenario of the repository.
    pub fn with(scenario: &str) -> Folder {
        let folder = Folder::new();
        folder.copy_scenario(scenario);
        folder
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn json(&self, name: &str) -> Json {
        serde_json::from_str(&self.read(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn edit_json(&self, name: &str, change: impl FnOnce(&mut Json)) {
        let mut json = self.json(name);
        change(&mut json);
        self.write(name, json.to_string());
    }

    /// Leaves the recording of a run as a kill before the first rows leaves it.
    pub fn unfinish(&self, run: &str) {
        self.edit_json(&format!("{run}/recording.json"), |recording| {
            (recording["sha256"], recording["firings"]) = ("".into(), 0.into());
            recording.as_object_mut().unwrap().remove("rows");
        });
    }

    /// Replaces a part of a file's text that is in it once.
    pub fn edit(&self, name: &str, old: &str, new: &str) {
        let text = self.read(name);
        assert_eq!(text.matches(old).count(), 1, "{old:?} must be in {name} once");
        self.write(name, text.replace(old, new));
    }

    /// Copies a scenario of the repository into a folder of the same name.
    pub fn copy_scenario(&self, name: &str) {
        for entry in fs::read_dir(Path::new(ROOT).join("scenarios").join(name)).unwrap() {
            let entry = entry.unwrap();
            self.write(&format!("{name}/{}", entry.file_name().display()), fs::read(entry.path()).unwrap());
        }
    }

    /// The example's apartment with a day that was written by hand, so that a test knows what happens when.
    pub fn copy_hand_written_day(&self) {
        self.copy_scenario("tigerplace");
        fs::remove_file(self.path("tigerplace/margaret.routine")).unwrap();
        self.write("tigerplace/day.path.json", include_str!("day.path.json"));
        self.edit("tigerplace/margaret.json", "\"routine\": \"margaret.routine\"", "\"path\": \"day.path.json\"");
    }

    /// A folder with the files that `fill` makes. It makes them once, for all tests that keep them in `files`.
    pub fn filled_once(files: &OnceLock<Files>, fill: impl FnOnce(&Folder)) -> Folder {
        let files = files.get_or_init(|| {
            let folder = Folder::new();
            fill(&folder);
            let names = folder.files().into_iter().filter(|name| !name.ends_with('/'));
            names.map(|name| (name.clone(), fs::read(folder.path(&name)).unwrap())).collect()
        });
        let folder = Folder::new();
        files.iter().for_each(|(name, bytes)| folder.write(name, bytes));
        folder
    }

    /// All files and empty folders, in order.
    pub fn files(&self) -> Vec<String> {
        let mut files = Vec::new();
        self.walk(self.0.path(), &mut files);
        files.sort();
        files
    }

    fn walk(&self, folder: &Path, files: &mut Vec<String>) {
        let entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        if entries.is_empty() && folder != self.0.path() {
            files.push(format!("{}/", folder.strip_prefix(self.0.path()).unwrap().display()));
        }
        for path in entries {
            if path.is_dir() {
                self.walk(&path, files);
            } else {
                files.push(path.strip_prefix(self.0.path()).unwrap().display().to_string());
            }
        }
    }

    pub fn sha256(&self, name: &str) -> String {
        sha256(&fs::read(self.path(name)).unwrap())
    }

    /// The SHA-256 of all rows of the truth, in the order in which they were stored: which of its tables has which
    /// page of the file depends on when rows came.
    pub fn truth_sha256(&self, name: &str) -> String {
        sha256(self.dump(name).as_bytes())
    }

    pub fn dump(&self, name: &str) -> String {
        let tables = self.query(name, "SELECT name, sql FROM sqlite_schema WHERE type = 'table' ORDER BY name");
        assert!(!tables.is_empty(), "{name} has no tables");
        let rows = |table: &String| {
            let (name_of_table, _) = table.split_once('|').unwrap();
            format!("{table}\n{}\n", self.query(name, &format!("SELECT * FROM \"{name_of_table}\"")).join("\n"))
        };
        tables.iter().map(rows).collect()
    }

    pub fn query(&self, name: &str, sql: &str) -> Vec<String> {
        let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let connection = Connection::open_with_flags(self.path(name), flags).unwrap();
        connection.busy_timeout(Duration::from_secs(5)).unwrap();
        let mut statement = connection.prepare(sql).unwrap();
        let columns = statement.column_count();
        let row = |row: &rusqlite::Row| {
            (0..columns).map(|column| row.get(column).map(shown)).collect::<rusqlite::Result<Vec<_>>>()
        };
        let rows = statement.query_map([], row).unwrap();
        rows.map(|row| row.unwrap().join("|")).collect()
    }

    /// The number of rows of a log; 0 before the log exists.
    pub fn stored_rows(&self, name: &str) -> i64 {
        let count = || {
            let connection = Connection::open_with_flags(self.path(name), OpenFlags::SQLITE_OPEN_READ_ONLY)?;
            connection.query_row("SELECT count(*) FROM firing", [], |row| row.get(0))
        };
        count().unwrap_or(0)
    }

    /// Runs the command with words parted by blanks, to its end.
    pub fn run(&self, words: &str) -> Done {
        self.say(words, "")
    }

    pub fn say(&self, words: &str, input: &str) -> Done {
        let mut running = self.start(words);
        running.say(input);
        running.finish()
    }

    pub fn start(&self, words: &str) -> Running {
        let mut command = self.command(words);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        Running { words: words.into(), child: command.spawn().unwrap() }
    }

    /// The command, for tests that start it in their own way.
    pub fn command(&self, words: &str) -> Command {
        let mut command = Command::new(PROGRAM);
        command.args(words.split_whitespace()).current_dir(self.0.path());
        command
    }

    pub fn until(&self, what: &str, is_so: impl Fn(&Folder) -> bool) {
        wait_until(|| is_so(self), || what.to_owned());
    }
}

/// Waits until something is so, and fails with what was waited for.
pub fn wait_until(is_so: impl Fn() -> bool, what: impl Fn() -> String) {
    let begun = Instant::now();
    while !is_so() {
        assert!(begun.elapsed() < PATIENCE, "waited in vain until {}", what());
        thread::sleep(Duration::from_millis(5));
    }
}

fn shown(value: Value) -> String {
    match value {
        Value::Null => "NULL".into(),
        Value::Integer(number) => number.to_string(),
        Value::Real(number) => number.to_string(),
        Value::Text(text) => text,
        Value::Blob(bytes) => format!("{bytes:?}"),
    }
}

pub struct Running {
    words: String,
    child: Child,
}

impl Running {
    pub fn say(&mut self, input: impl AsRef<[u8]>) {
        // The command may have ended, or not listen.
        let _ = self.child.stdin.as_mut().unwrap().write_all(input.as_ref());
    }

    pub fn is_alive(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    pub fn id(&self) -> u32 {
        self.child.id()
    }

    pub fn signal(&self, name: &str) {
        signal(&self.child, name);
    }

    pub fn kill(mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    /// Waits for the end while standard input stays open.
    pub fn finish_listening(mut self) -> Done {
        let input = self.child.stdin.take();
        let done = self.finish();
        drop(input);
        done
    }

    pub fn finish(self) -> Done {
        Done::new(&self.words, self.child.wait_with_output().unwrap())
    }
}

/// Sends a signal by its name, such as INT.
pub fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([&format!("-{name}"), &child.id().to_string()]).status();
    assert!(status.unwrap().success());
}

/// A process that is killed at the end of the test.
pub struct Ends(pub Child);

impl Ends {
    /// Ends it by a signal within a time, on however slow a machine; its exit code.
    pub fn stop(&mut self, name: &str, within: Duration, said: impl Fn() -> String) -> Option<i32> {
        signal(&self.0, name);
        let begun = Instant::now();
        loop {
            if let Some(status) = self.0.try_wait().unwrap() {
                println!("ended {} ms after the signal", begun.elapsed().as_millis());
                return status.code();
            }
            assert!(begun.elapsed() < within, "it has not ended:\n{}", said());
            thread::sleep(Duration::from_millis(10));
        }
    }
}

impl Drop for Ends {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

pub struct Done {
    words: String,
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Done {
    pub fn new(words: &str, output: Output) -> Done {
        let Output { status, stdout, stderr } = output;
        let [out, err] = [stdout, stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        assert!(!err.contains("panicked") && status.code() != Some(101), "homebody {words}\n{err}");
        Done { words: words.into(), code: status.code(), out, err }
    }

    /// It has done what was asked.
    pub fn ok(self) -> Done {
        assert_eq!(self.code, Some(0), "homebody {}\n{}", self.words, self.err);
        self
    }

    /// It has failed with this code, said this to people, and nothing to scripts.
    pub fn fails(self, code: i32, said: &str) -> Done {
        assert_eq!(self.code, Some(code), "homebody {}\n{}", self.words, self.err);
        assert!(self.err.contains(said), "homebody {} must say {said:?}, but says\n{}", self.words, self.err);
        assert_eq!(self.out, "", "homebody {}", self.words);
        self
    }

    #[track_caller]
    pub fn says(self, parts: &[&str]) -> Done {
        says(&self.err, parts);
        self
    }

    #[track_caller]
    pub fn prints(self, parts: &[&str]) -> Done {
        says(&self.out, parts);
        self
    }

    /// The one JSON object on standard output.
    pub fn json(&self) -> Json {
        let value: Json = serde_json::from_str(&self.out)
            .unwrap_or_else(|error| panic!("homebody {} prints no one value: {error}\n{}", self.words, self.out));
        assert!(value.is_object(), "homebody {} prints {value}", self.words);
        value
    }
}

#[track_caller]
pub fn says(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
}

/// The numbers of the rows of a log in lines of JSON, without a last row that a kill has cut short.
pub fn numbers(rows: &str) -> Vec<u64> {
    let object = |line: &str| serde_json::from_str::<Json>(line).ok();
    rows.lines().filter_map(object).map(|row| row["seq"].as_u64().unwrap()).collect()
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
