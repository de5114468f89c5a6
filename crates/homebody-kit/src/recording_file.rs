//! Reads recordings and the lists of cohorts.

use crate::error::Error;
use crate::open_messages::OpenMessage;
use homebody_core::problem::readable;
use homebody_core::recording::{LONGEST, Recording};
use homebody_log::limits::{LARGEST_LIST_BYTES, LARGEST_RECORDING_BYTES};
use homebody_log::plain;
use std::io::ErrorKind;
use std::path::Path;

/// Reads a recording, of a complete run or an unfinished one. The scenario in it is checked later, when it is loaded.
///
/// # Errors
///
/// [`Error::NoRecording`], [`Error::File`] or [`Error::Recording`] if the file has no recording.
pub fn recording(path: &Path) -> Result<Recording, Error> {
    let text = text(path, LARGEST_RECORDING_BYTES)?;
    let wrong = |why: String| Error::Recording { path: path.into(), why };
    let recording: Recording = serde_json::from_str(&text).map_err(|error| wrong(readable(error.to_string())))?;
    let lengths = [Some(recording.length_us), recording.stopped_of_us];
    if !lengths.into_iter().flatten().all(|length| (0..=LONGEST).contains(&length)) {
        return Err(wrong("a run is at most 100 years long".into()));
    }
    has_its_scenario(path, &recording)?;
    Ok(recording)
}

/// A recording names which of its files is the scenario's own.
pub(crate) fn has_its_scenario(path: &Path, recording: &Recording) -> Result<(), Error> {
    match !recording.entry.is_empty() && recording.files.contains_key(&recording.entry) {
        true => Ok(()),
        false => {
            let why = readable(format!("its scenario {:?} is not among its files", recording.entry));
            Err(Error::Recording { path: path.into(), why })
        }
    }
}

/// The text of the list of a cohort.
pub(crate) fn text_of_list(path: &Path) -> Result<String, Error> {
    text(path, LARGEST_LIST_BYTES)
}

/// The text of a recording, or of the list of a cohort.
fn text(path: &Path, most_bytes: u64) -> Result<String, Error> {
    let text = plain::read_text(path, most_bytes);
    if text.as_ref().is_ok_and(|text| text.trim().is_empty()) {
        return Err(Error::Recording { path: path.into(), why: "it is empty".into() });
    }
    text.map_err(|error| match error.kind() {
        ErrorKind::NotFound => Error::NoRecording { path: path.into() },
        ErrorKind::IsADirectory => Error::unreadable(path, OpenMessage::RecordingFolder),
        _ => Error::io(path, error),
    })
}
