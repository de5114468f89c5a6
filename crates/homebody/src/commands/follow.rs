//! `homebody locate --follow`: the location of residents while a log grows.

use super::log_input::LogArguments;
use crate::failure::Failure;
use crate::print::{ResultMessage, print_json_text, print_text};
use crate::signals::Signals;
use homebody_core::scenario::load::Scenario;
use homebody_log::LogError;
use homebody_query::LoadedLog;
use homebody_simulation::Cancel;
use homebody_tracking::{FollowedHome, LogFollower, PersonLocation};
use std::fs::{self, File};
use std::io::{BufRead, Write};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

homebody_core::messages! {
    /// Problems with a log that a command follows.
    pub enum FollowMessage in "follow" {
        /// Homebody recognises the form of a file by its first lines. Standard input has none yet, so its form must be named:
        ///
        /// ```sh
        /// tail -n +1 -F home.txt | homebody locate casas:- --home my-home --follow
        /// ```
        NoForm error "no-form" ("cannot recognise the form of a log on standard input")
            hint ("write casas:- for a CASAS log, or csv:- for a CSV log");
    }
}

pub struct FollowedLog<'a> {
    /// That of standard input ends with [`INPUT`].
    pub log: &'a LogArguments,
    pub zone: &'a str,
    pub every_s: u64,
    pub is_json: bool,
}

/// The end of an argument that means standard input.
const INPUT: &str = ":-";
/// Largest number of lines of standard input that wait to be stored.
const MOST_WAITING: usize = 10_000;
/// Longest delay after a signal.
const BREATH: Duration = Duration::from_millis(100);

impl FollowedLog<'_> {
    /// Prints the room of each resident until the input ends, or a signal comes.
    pub fn follow(&self, scenario: &Scenario) -> Result<(), Failure> {
        if self.log.text() == "-" {
            return Err(Failure::asked(FollowMessage::NoForm));
        }
        let signals = Signals::listen()?;
        let cancel = signals.cancel();
        let learnt = FollowedHome::new(scenario)?;
        let following = &mut LogFollower::new(&learnt, scenario);
        let done = match self.log.text().strip_suffix(INPUT) {
            Some(form) => self.input(form, following, cancel),
            None => self.file(following, cancel),
        };
        done.and_then(|()| signals.ended(cancel.is_cancelled()))
    }

    fn file(&self, following: &mut LogFollower, cancel: &Cancel) -> Result<(), Failure> {
        // The first read must succeed. Later reads may meet a file that is being written.
        let mut looked = Some(self.log.read(Some(self.zone))?);
        while !cancel.is_cancelled() {
            if let Some(read) = looked {
                self.take(following, &read)?;
            }
            let began = Instant::now();
            while began.elapsed() < Duration::from_secs(self.every_s) && !cancel.is_cancelled() {
                thread::sleep(BREATH);
            }
            looked = self.log.how().read(self.log.text(), Some(self.zone)).ok();
        }
        Ok(())
    }

    /// Stores the lines of standard input in a temporary file, and reads that file.
    fn input(&self, form: &str, following: &mut LogFollower, cancel: &Cancel) -> Result<(), Failure> {
        let mut kept = InputCopy::new()?;
        let named = format!("{form}:{}", kept.path.display());
        let lines = lines()?;
        let mut is_over = false;
        let mut looked = Instant::now();
        let mut is_new = false;
        while !is_over && !cancel.is_cancelled() {
            match lines.recv_timeout(BREATH) {
                Ok(line) => {
                    kept.add(&line)?;
                    is_new = true;
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => is_over = true,
            }
            let is_time = looked.elapsed() >= Duration::from_secs(self.every_s) && is_new;
            if is_over || is_time {
                let read = self.log.how().read(&named, Some(self.zone));
                // The first lines of a table may not be a log yet.
                match read {
                    Ok(read) => self.take(following, &read)?,
                    Err(error) if is_over => return Err(error),
                    Err(_) => {}
                }
                (looked, is_new) = (Instant::now(), false);
            }
        }
        Ok(())
    }

    fn take(&self, following: &mut LogFollower, read: &LoadedLog) -> Result<(), Failure> {
        let mut text = String::new();
        let mut failed = None;
        following.take(&read.log, |presence| {
            self.line(&presence).map_or_else(|error| failed = Some(error), |line| text.push_str(&line))
        })?;
        match failed {
            Some(error) => Err(error),
            None if text.is_empty() => Ok(()),
            None if self.is_json => print_json_text(&text),
            None => print_text(&text),
        }
    }

    fn line(&self, presence: &PersonLocation) -> Result<String, Failure> {
        match self.is_json {
            false => Ok(format!("{presence}\n")),
            true => {
                let line = serde_json::to_string(presence).map(|line| line + "\n");
                line.map_err(|error| Failure::file(ResultMessage::NotWritten { why: error.to_string() }))
            }
        }
    }
}

fn lines() -> Result<Receiver<Vec<u8>>, Failure> {
    let (sender, lines) = sync_channel(MOST_WAITING);
    let read = move || {
        let mut input = std::io::stdin().lock();
        let mut line = Vec::new();
        while let Ok(1..) = input.read_until(b'\n', &mut line) {
            if sender.send(std::mem::take(&mut line)).is_err() {
                break;
            }
        }
    };
    let none = |error| Failure::file(homebody_log::error::no_thread("to read standard input", error));
    thread::Builder::new().spawn(read).map_err(none)?;
    Ok(lines)
}

/// The lines of standard input so far, in a temporary folder.
struct InputCopy {
    folder: PathBuf,
    path: PathBuf,
    file: File,
}

impl InputCopy {
    fn new() -> Result<InputCopy, Failure> {
        let folder = std::env::temp_dir().join(format!("homebody-follow-{}", std::process::id()));
        fs::create_dir(&folder).map_err(|error| LogError::file(&folder, error))?;
        let path = folder.join("log");
        let file = File::create_new(&path).map_err(|error| LogError::file(&path, error))?;
        Ok(InputCopy { folder, path, file })
    }

    fn add(&mut self, line: &[u8]) -> Result<(), Failure> {
        Ok(self.file.write_all(line).map_err(|error| LogError::file(&self.path, error))?)
    }
}

impl Drop for InputCopy {
    /// Removes the folder. Errors do not matter: the system empties the folder for temporary files.
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}
