//! The place of a cohort: a folder, or a prefix of an object store. A member of a cohort in a store is simulated in a temporary folder, and
//! its recording is sent last, so that a member with a recording is complete.

use crate::cohort::members::CohortLayout;
use crate::error::SimulationError;
use crate::recording_file;
#[cfg(not(feature = "cloud"))]
use homebody_log::error::HoldMessage;
use homebody_log::files::fresh::{FreshFile, remove_parts};
use homebody_log::run::places::LIST;
#[cfg(feature = "cloud")]
use homebody_log::run::places::RECORDING;
use homebody_log::table::truth::TruthKept;
use homebody_log::{LogError, WriteMode};
use std::fs;
use std::path::{Path, PathBuf};

pub(crate) enum CohortPlace {
    Folder(PathBuf),
    #[cfg(feature = "cloud")]
    Store {
        url: PathBuf,
        store: Box<homebody_arrow::Store>,
    },
}

/// A folder on this machine that stands for a cohort's, until this is dropped.
pub(crate) struct LocalFolder {
    path: PathBuf,
    #[cfg(feature = "cloud")]
    _scratch: Option<tempfile::TempDir>,
}

impl LocalFolder {
    pub fn path(&self) -> &Path {
        &self.path
    }
}

pub(crate) fn is_in_store(path: &Path) -> bool {
    path.to_string_lossy().contains("://")
}

impl CohortPlace {
    /// The place of a path: a folder, or the URL of a store. Nothing is created or requested there yet.
    pub fn from_path(path: &Path) -> Result<CohortPlace, SimulationError> {
        match is_in_store(path) {
            true => CohortPlace::in_store(path),
            false => Ok(CohortPlace::Folder(path.into())),
        }
    }

    #[cfg(feature = "cloud")]
    fn in_store(url: &Path) -> Result<CohortPlace, SimulationError> {
        let store = Box::new(homebody_arrow::Store::open(url)?);
        Ok(CohortPlace::Store { url: url.into(), store })
    }

    #[cfg(not(feature = "cloud"))]
    fn in_store(url: &Path) -> Result<CohortPlace, SimulationError> {
        Err(LogError::cannot_hold(url.display().to_string(), HoldMessage::NoObjectStore).into())
    }

    /// Its path, or its URL.
    pub fn path(&self) -> &Path {
        match self {
            CohortPlace::Folder(folder) => folder,
            #[cfg(feature = "cloud")]
            CohortPlace::Store { url, .. } => url,
        }
    }

    /// Creates the folder; a store needs none.
    pub fn create(&self) -> Result<(), SimulationError> {
        match self {
            CohortPlace::Folder(folder) => {
                fs::create_dir_all(folder).map_err(|error| SimulationError::io(folder, error))
            }
            #[cfg(feature = "cloud")]
            CohortPlace::Store { .. } => Ok(()),
        }
    }

    /// A cohort starts in an empty place, so that its files are never mixed with others.
    pub fn must_be_empty(&self) -> Result<(), SimulationError> {
        let found = match self {
            CohortPlace::Folder(folder) => {
                let entries = fs::read_dir(folder).map_err(|error| SimulationError::io(folder, error))?;
                let names = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned());
                // Hidden files do not count, and a cohort that was killed at once has left a part of its list.
                let mut others: Vec<String> =
                    names.filter(|name| !name.starts_with('.') && !recording_file::is_part(name)).collect();
                others.sort();
                others.into_iter().next()
            }
            #[cfg(feature = "cloud")]
            CohortPlace::Store { store, .. } => store.any()?,
        };
        let Some(file) = found else { return Ok(()) };
        Err(SimulationError::NotEmpty { folder: self.path().into(), is_cohort: self.has_list()?, file })
    }

    /// Whether the place has the list of a cohort.
    pub fn has_list(&self) -> Result<bool, SimulationError> {
        match self {
            CohortPlace::Folder(folder) => Ok(folder.join(LIST).exists()),
            #[cfg(feature = "cloud")]
            CohortPlace::Store { store, .. } => Ok(store.bytes(LIST)?.is_some()),
        }
    }

    /// The text of the list.
    pub fn list(&self) -> Result<String, SimulationError> {
        match self {
            CohortPlace::Folder(folder) => {
                recording_file::must_be_folder(folder)?;
                recording_file::text_of_list(&folder.join(LIST))
            }
            #[cfg(feature = "cloud")]
            CohortPlace::Store { url, store } => {
                let path = url.join(LIST);
                let bytes = store.bytes(LIST)?.ok_or_else(|| SimulationError::NoRecording { path: path.clone() })?;
                String::from_utf8(bytes)
                    .map_err(|_| SimulationError::Recording { path, why: "it is not text in UTF-8".into() })
            }
        }
    }

    /// Writes the list, whole or not at all.
    pub fn write_list(&self, text: String, how: WriteMode) -> Result<(), SimulationError> {
        match self {
            CohortPlace::Folder(folder) => {
                let path = folder.join(LIST);
                if how != WriteMode::Create {
                    // A program that died while it wrote the list has left a part.
                    remove_parts(&path)?;
                }
                Ok(FreshFile::write_whole(&path, text.as_bytes(), how != WriteMode::Create)?)
            }
            #[cfg(feature = "cloud")]
            CohortPlace::Store { url, store } => match how == WriteMode::Create && self.has_list()? {
                true => Err(LogError::Exists { place: url.join(LIST).display().to_string() }.into()),
                false => Ok(store.put_bytes(LIST, text.into_bytes())?),
            },
        }
    }

    /// The folder in which members are simulated and checked: its own, or an empty temporary one.
    pub fn here(&self) -> Result<LocalFolder, SimulationError> {
        match self {
            CohortPlace::Folder(folder) => Ok(LocalFolder {
                path: folder.clone(),
                #[cfg(feature = "cloud")]
                _scratch: None,
            }),
            #[cfg(feature = "cloud")]
            CohortPlace::Store { .. } => {
                let scratch = tempfile::tempdir().map_err(|error| SimulationError::io(&std::env::temp_dir(), error))?;
                Ok(LocalFolder { path: scratch.path().into(), _scratch: Some(scratch) })
            }
        }
    }

    /// Copies existing files from a store; files in a folder need no copy.
    #[cfg_attr(not(feature = "cloud"), allow(unused_variables, reason = "only stores are elsewhere"))]
    pub fn bring(&self, here: &LocalFolder, files: &[PathBuf]) -> Result<(), SimulationError> {
        #[cfg(feature = "cloud")]
        if let CohortPlace::Store { store, .. } = self {
            for file in files {
                let Some(bytes) = store.bytes(&name_in(here, file))? else { continue };
                let made = file.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(file, bytes));
                made.map_err(|error| SimulationError::io(file, error))?;
            }
        }
        Ok(())
    }

    /// Copies the files of a member to a store, the recording last.
    #[cfg_attr(not(feature = "cloud"), allow(unused_variables, reason = "only stores are elsewhere"))]
    pub fn send(&self, here: &LocalFolder, files: Vec<PathBuf>) -> Result<(), SimulationError> {
        #[cfg(feature = "cloud")]
        if let CohortPlace::Store { store, .. } = self {
            let is_recording = |file: &PathBuf| file.file_name().is_some_and(|name| name == RECORDING);
            let (last, first): (Vec<_>, Vec<_>) = files.iter().partition(|file| is_recording(file));
            for file in first.into_iter().chain(last) {
                store.put(&name_in(here, file), file)?;
            }
        }
        Ok(())
    }
}

#[cfg(feature = "cloud")]
fn name_in(here: &LocalFolder, file: &Path) -> String {
    file.strip_prefix(here.path()).unwrap_or(file).to_string_lossy().replace('\\', "/")
}

/// The text of the list of the cohort in a folder, or below the URL of an object store.
///
/// # Errors
///
/// [`SimulationError::NotFolder`] if it is a file, [`SimulationError::NoRecording`], [`SimulationError::File`] or [`SimulationError::Recording`] without one,
/// [`SimulationError::Log`] if the store does not answer, or this program knows none.
pub fn list_of_cohort(place: &Path) -> Result<String, SimulationError> {
    CohortPlace::from_path(place)?.list()
}

/// Copies the files of one member of a cohort's set into another folder, with the layout of the cohort's. It makes a member of an object
/// store readable.
///
/// # Errors
///
/// [`SimulationError::Recording`] if the cohort is no set of this form, [`SimulationError::Log`] if the store does not answer, or this program knows none.
pub fn bring_member(place: &Path, form: &str, member: &str, to: &Path) -> Result<(), SimulationError> {
    let not_set =
        || SimulationError::Recording { path: place.join(LIST), why: format!("members have no form {form:?}") };
    let layout = CohortLayout::named(Some(form)).ok_or_else(not_set)?;
    let from = CohortPlace::from_path(place)?;
    let here = from.here()?;
    // A brief truth lacks some of them.
    let files = layout.files(here.path(), member, TruthKept::All);
    from.bring(&here, &files)?;
    for file in files.into_iter().filter(|file| file.is_file()) {
        let copy = to.join(file.strip_prefix(here.path()).unwrap_or(&file));
        let made = copy.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::copy(&file, &copy).map(drop));
        made.map_err(|error| SimulationError::io(&file, error))?;
    }
    Ok(())
}
