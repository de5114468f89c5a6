//! The keys by which a resident is moved. They are written into the run's recording during the run, so that they are not lost with the
//! program.
//!
//! Disks are slow, so a thread of its own writes them. No event is stored before the input that caused it: a resumed run finds no
//! row that its recording cannot explain.

use homebody_core::drivers::input::{InputFile, KeysFile};
use homebody_core::ids::ResidentId;
use homebody_core::recording::Recording;
use homebody_log::LogError;
use homebody_log::run_log::write_over;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// The input of the resident who is moved by keys.
pub(super) struct KeyInput {
    pub resident: ResidentId,
    /// The name of the file of keys in the recording.
    pub file: String,
    /// The number of lines in the scenario at the start.
    pub known: usize,
    pub lines: Vec<KeysFile>,
}

impl KeyInput {
    /// The text of the file of keys.
    pub fn text(&self) -> String {
        input_text(&self.lines)
    }

    /// Writes the input into a recording as it grows.
    pub fn recorder(&self, place: &Path, recording: Recording) -> Result<InputRecorder, LogError> {
        let failed = |source| LogError::File { place: place.display().to_string(), source };
        InputRecorder::new(place.into(), recording, self.file.clone(), self.known).map_err(failed)
    }
}

/// Shortest interval between writes of input (our choice). It is on disk within a second.
const EVERY: Duration = Duration::from_millis(400);

/// Writes a recording anew whenever its input has grown.
pub(super) struct InputRecorder {
    /// Until it ends.
    lines: Option<Sender<Vec<KeysFile>>>,
    thread: Option<JoinHandle<()>>,
    done: Arc<WrittenLines>,
    /// The number of lines that the thread has, and since when.
    given: (usize, Option<Instant>),
}

#[derive(Default)]
struct WrittenLines {
    kept: AtomicUsize,
    failed: Mutex<Option<LogError>>,
}

impl InputRecorder {
    /// For the recording in a file that has so many lines already; `name` is that of its file of keys.
    fn new(place: PathBuf, recording: Recording, name: String, kept: usize) -> std::io::Result<InputRecorder> {
        let done = Arc::new(WrittenLines { kept: kept.into(), ..WrittenLines::default() });
        let (lines, given) = channel();
        let writes = done.clone();
        let write = move || write_all(&place, recording, &name, &given, &writes);
        let thread = thread::Builder::new().name("recording".into()).spawn(write)?;
        Ok(InputRecorder { lines: Some(lines), thread: Some(thread), done, given: (kept, None) })
    }

    /// Gives the lines to the thread, if it is time to write again. Returns the number of lines on disk.
    pub fn keep(&mut self, input: &[KeysFile]) -> Result<usize, LogError> {
        let (given, when) = self.given;
        if given < input.len() && when.is_none_or(|when| when.elapsed() >= EVERY) {
            self.given = (input.len(), Some(Instant::now()));
            if let Some(lines) = &self.lines {
                // The thread ends only where it has said why.
                let _ = lines.send(input.to_vec());
            }
        }
        match self.done.failed.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(error) => Err(error),
            None => Ok(self.done.kept.load(Ordering::Acquire)),
        }
    }
}

impl Drop for InputRecorder {
    /// Nothing is written any more when it is gone.
    fn drop(&mut self) {
        self.lines = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn write_all(place: &Path, mut recording: Recording, name: &str, given: &Receiver<Vec<KeysFile>>, done: &WrittenLines) {
    while let Ok(lines) = given.recv() {
        // Of what was given meanwhile the last has all.
        let lines = given.try_iter().last().unwrap_or(lines);
        recording.files.insert(name.to_owned(), input_text(&lines));
        if let Err(error) = write_over(place, &recording) {
            *done.failed.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            return;
        }
        done.kept.store(lines.len(), Ordering::Release);
    }
}

fn input_text(input: &[KeysFile]) -> String {
    let file = InputFile { schema: None, keys: input.to_vec() };
    serde_json::to_string_pretty(&file).unwrap_or_default() + "\n"
}
