//! What is done at the keys is written into the run's recording while the run goes on, so that it is not lost with the program.
//!
//! Disks are slow, so a thread of its own does it. Of the log nothing is stored before the input that it comes of: whoever goes on
//! with the run finds no row that the recording cannot explain.

use homebody_core::recording::Recording;
use homebody_core::scenario::input::{InputFile, KeysFile};
use homebody_log::LogError;
use homebody_log::run_log::write_over;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Shortest interval between writes of input (our choice). It is on disk within a second.
const EVERY: Duration = Duration::from_millis(400);

/// Writes a recording anew whenever its input has grown.
pub struct InputKeeper {
    /// Until it ends.
    lines: Option<Sender<Vec<KeysFile>>>,
    thread: Option<JoinHandle<()>>,
    done: Arc<Done>,
    /// How many lines the thread has been given, and when.
    given: (usize, Option<Instant>),
}

#[derive(Default)]
struct Done {
    /// So many lines are on disk.
    kept: AtomicUsize,
    failed: Mutex<Option<LogError>>,
}

impl InputKeeper {
    /// Of a recording in a file that has so many lines already; `name` is that of the recording's file of keys.
    pub fn new(place: PathBuf, recording: Recording, name: String, kept: usize) -> std::io::Result<InputKeeper> {
        let done = Arc::new(Done { kept: kept.into(), ..Done::default() });
        let (lines, given) = channel();
        let writes = done.clone();
        let write = move || write_all(&place, recording, &name, &given, &writes);
        let thread = thread::Builder::new().name("recording".into()).spawn(write)?;
        Ok(InputKeeper { lines: Some(lines), thread: Some(thread), done, given: (kept, None) })
    }

    /// Gives the thread what was done, if it is time to write again. Returns how many lines of it are on disk.
    ///
    /// # Errors
    ///
    /// It could not be written.
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

impl Drop for InputKeeper {
    /// Nothing is written any more when it is gone.
    fn drop(&mut self) {
        self.lines = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn write_all(
    place: &std::path::Path,
    mut recording: Recording,
    name: &str,
    given: &Receiver<Vec<KeysFile>>,
    done: &Done,
) {
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

/// The text of a file of keys.
pub fn input_text(input: &[KeysFile]) -> String {
    let file = InputFile { schema: None, keys: input.to_vec() };
    serde_json::to_string_pretty(&file).unwrap_or_default() + "\n"
}
