//! The files of a data set, in the order of writing.

use super::batches::OpenedTable;
use crate::layout::ROWS_BEFORE;
use crate::messages::ColumnsMessage;
use homebody_log::LogError;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// Largest number of files in a data set or in one of its folders (our choice): two hundred years of days.
const MOST_FILES: usize = 100_000;

/// Largest depth of nested folders in a data set (our choice).
const DEEPEST: usize = 6;

pub(super) fn files(path: &Path) -> Result<Vec<PathBuf>, LogError> {
    if !path.is_dir() {
        return Ok(vec![path.into()]);
    }
    let mut found = Vec::new();
    collect(path, 0, &mut found)?;
    found.sort();
    if found.is_empty() {
        return Err(LogError::no_log(path.display().to_string(), ColumnsMessage::NoFiles));
    }
    // Ours say how many rows come before; with others the names say their order.
    let mut in_order = Vec::new();
    for file in &found {
        let Some(rows) = about(&OpenedTable::open(file)?, ROWS_BEFORE) else { return Ok(found) };
        in_order.push((rows, file.clone()));
    }
    in_order.sort();
    Ok(in_order.into_iter().map(|(_, file)| file).collect())
}

pub(super) fn about(opened: &OpenedTable, key: &str) -> Option<u64> {
    let about: Value = serde_json::from_str(opened.about.as_ref()?).ok()?;
    about.get(key)?.as_u64()
}

/// The folders of the runs of a data set with their names; without any, it is the whole.
pub(super) fn runs_in(folder: &Path) -> Vec<(String, PathBuf)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().take(MOST_FILES);
    let named = entries.map(|entry| (entry.file_name().to_string_lossy().into_owned(), entry.path()));
    let mut runs: Vec<(String, PathBuf)> =
        named.filter(|(name, path)| name.starts_with("run=") && path.is_dir()).collect();
    runs.sort();
    if runs.is_empty() {
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        runs.push((name, folder.to_owned()));
    }
    runs.into_iter().map(|(name, path)| (name.replace('=', " "), path)).collect()
}

/// The files of one run, and those that have no name yet.
pub(super) fn all_files(folder: &Path) -> Result<(Vec<PathBuf>, Vec<PathBuf>), LogError> {
    let mut found = Vec::new();
    collect(folder, 0, &mut found)?;
    found.sort();
    let inner = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let folders = inner.filter(|path| path.is_dir()).chain([folder.to_owned()]);
    let hidden = folders.flat_map(|folder| fs::read_dir(folder).into_iter().flatten().flatten()).filter(|entry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        name.starts_with('.') && name.contains(".parquet")
    });
    Ok((found, hidden.map(|entry| entry.path()).collect()))
}

fn collect(folder: &Path, depth: usize, found: &mut Vec<PathBuf>) -> Result<(), LogError> {
    let unread = |error| LogError::reading(folder, error);
    let mut runs = Vec::new();
    for entry in fs::read_dir(folder).map_err(unread)?.take(MOST_FILES) {
        let path = entry.map_err(unread)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // A file that is not finished, or not ours.
        if name.starts_with(['.', '_']) {
            continue;
        }
        if path.is_dir() {
            if !name.contains('=') {
                continue;
            }
            if name.starts_with("run=") {
                runs.push(name);
            }
            if depth < DEEPEST {
                collect(&path, depth + 1, found)?;
            }
        } else if name.ends_with(".parquet") {
            found.push(path);
        }
    }
    if found.len() > MOST_FILES {
        return Err(LogError::no_log(folder.display().to_string(), ColumnsMessage::ManyFiles { most: MOST_FILES }));
    }
    runs.sort();
    match &runs[..] {
        [] | [_] => Ok(()),
        several => {
            let several = ColumnsMessage::SeveralRuns { runs: several.to_vec() };
            Err(LogError::no_log(folder.display().to_string(), several))
        }
    }
}
