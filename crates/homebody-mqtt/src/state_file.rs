//! How far a broker has acknowledged a run, beside the run: a broker cannot be asked.

use homebody_log::LogError;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

/// The file; None for none, so that a run that is gone on with is sent again from its beginning.
pub(crate) struct StateFile {
    path: Option<PathBuf>,
    run: i64,
    written: u64,
}

#[derive(Serialize, Deserialize)]
struct Acknowledged {
    /// As text: no reader of JSON shall round it.
    run: String,
    rows: u64,
}

impl StateFile {
    pub fn new(path: Option<&Path>, run: i64) -> StateFile {
        StateFile { path: path.map(Path::to_owned), run, written: 0 }
    }

    /// How many rows of this run were acknowledged; none where the file is not there, is none, or tells of another run.
    pub fn rows(&self) -> u64 {
        let text = self.path.as_ref().and_then(|path| fs::read_to_string(path).ok()).unwrap_or_default();
        let read: Option<Acknowledged> = serde_json::from_str(&text).ok();
        read.filter(|read| read.run == self.run.to_string()).map_or(0, |read| read.rows)
    }

    /// Writes down how many are.
    pub fn write(&mut self, rows: u64) -> Result<(), LogError> {
        let Some(path) = self.path.as_ref().filter(|_| rows != self.written) else { return Ok(()) };
        let error = |source| LogError::File { place: path.display().to_string(), source };
        let text =
            serde_json::to_string(&Acknowledged { run: self.run.to_string(), rows }).map_err(LogError::Recording)?;
        // Whoever reads it finds the one before or this one, and never a part.
        let beside = path.with_extension("part");
        fs::write(&beside, text).and_then(|()| fs::rename(&beside, path)).map_err(error)?;
        self.written = rows;
        Ok(())
    }
}
