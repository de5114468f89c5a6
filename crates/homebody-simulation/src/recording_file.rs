//! Files of recordings and of the lists of cohorts, and their folders.

use crate::VERSION;
use crate::error::SimulationError;
use crate::open_messages::OpenMessage;
use homebody_core::problem::readable;
use homebody_core::recording::Recording;
use homebody_core::time::{LONGEST, Span};
use homebody_log::files::plain;
use homebody_log::limits::{LARGEST_LIST_BYTES, LARGEST_RECORDING_BYTES};
use homebody_log::run::places::{LIST, RECORDING, SENSORS};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Reads a recording of a complete or incomplete run. Loading checks its scenario later.
///
/// # Errors
///
/// [`SimulationError::NoRecording`], [`SimulationError::File`] or [`SimulationError::Recording`] if the file has no recording.
pub fn recording(path: &Path) -> Result<Recording, SimulationError> {
    let text = text(path, LARGEST_RECORDING_BYTES)?;
    let wrong = |why: String| SimulationError::Recording { path: path.into(), why };
    let recording: Recording = serde_json::from_str(&text).map_err(|error| wrong(readable(error.to_string())))?;
    let lengths = [Some(recording.length_us), recording.stopped_of_us];
    if !lengths.into_iter().flatten().all(|length| (Span::ZERO..=LONGEST).contains(&length)) {
        return Err(wrong("a run is at most 100 years long".into()));
    }
    has_its_scenario(path, &recording)?;
    Ok(recording)
}

pub(crate) fn has_its_scenario(path: &Path, recording: &Recording) -> Result<(), SimulationError> {
    match !recording.entry.is_empty() && recording.files.contains_key(&recording.entry) {
        true => Ok(()),
        false => {
            let why = readable(format!("its scenario {:?} is not among its files", recording.entry));
            Err(SimulationError::Recording { path: path.into(), why })
        }
    }
}

pub(crate) fn text_of_list(path: &Path) -> Result<String, SimulationError> {
    text(path, LARGEST_LIST_BYTES)
}

fn text(path: &Path, most_bytes: u64) -> Result<String, SimulationError> {
    let text = plain::read_text(path, most_bytes);
    if text.as_ref().is_ok_and(|text| text.trim().is_empty()) {
        return Err(SimulationError::Recording { path: path.into(), why: "it is empty".into() });
    }
    text.map_err(|error| match error.kind() {
        ErrorKind::NotFound => SimulationError::NoRecording { path: path.into() },
        ErrorKind::IsADirectory => SimulationError::unreadable(path, OpenMessage::RecordingFolder),
        _ => SimulationError::io(path, error),
    })
}

/// A run with a driver of another program cannot be replayed from its recording.
pub(crate) fn must_be_replayable(path: &Path, recording: &Recording) -> Result<(), SimulationError> {
    match recording.can_replay() {
        true => Ok(()),
        false => Err(SimulationError::OwnDrivers { path: path.into(), residents: recording.own_drivers.clone() }),
    }
}

/// The folder of a run or a cohort must not be a file; the error names the folder of the file.
pub(crate) fn must_be_folder(path: &Path) -> Result<(), SimulationError> {
    match path.is_file() {
        true => Err(SimulationError::NotFolder { path: path.into(), folder: run_folder_of(path) }),
        false => Ok(()),
    }
}

/// The folder of the run or the cohort that wrote a file; for a member, that of the cohort.
pub(crate) fn run_folder_of(path: &Path) -> Option<PathBuf> {
    let above = |path: &Path| match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => ".".into(),
    };
    let folder = above(path);
    let cohort = if folder.file_name().is_some() { above(&folder) } else { folder.join("..") };
    // A run that was killed in its first moment has only its recording.
    let is_recording = path.file_name().is_some_and(|name| name == RECORDING);
    let left = [(cohort, LIST), (folder.clone(), LIST), (folder.clone(), SENSORS)];
    let left = left.into_iter().find(|(folder, file)| folder.join(file).is_file()).map(|(folder, _)| folder);
    left.or(is_recording.then_some(folder))
}

/// Another version may simulate a run differently from the one that started it.
pub(crate) fn must_be_of_this_version(
    what: &'static str,
    folder: &Path,
    recording: &Recording,
) -> Result<(), SimulationError> {
    match recording.version == VERSION {
        true => Ok(()),
        false => Err(SimulationError::OtherVersion {
            what,
            folder: folder.into(),
            version: readable(recording.version.clone()),
        }),
    }
}

/// True of the name of an incomplete file of a recording or of a cohort's list.
pub(crate) fn is_part(name: &str) -> bool {
    [RECORDING, LIST].iter().any(|known| name.starts_with(known)) && name.ends_with(".part")
}

/// True of a folder that is empty or has only such a file.
pub(crate) fn was_not_started(folder: &Path) -> bool {
    let Ok(mut entries) = std::fs::read_dir(folder) else { return false };
    entries.all(|entry| entry.is_ok_and(|entry| is_part(&entry.file_name().to_string_lossy())))
}
