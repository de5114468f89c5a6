//! Deleted runs and homes: their folders are moved into a hidden folder next to the others, until they are restored or a person
//! removes them there.

use crate::messages::PageMessage;
use crate::request_error::{RequestError, not_found, unprocessable};
use homebody_core::problem::readable;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::Path;

const TRASH: &str = ".put-aside";

/// Moves a folder, named by its path below `within`, into the trash. Returns its key there.
pub fn delete(within: &Path, name: &str) -> Result<String, RequestError> {
    let trash = within.join(TRASH);
    let is_free = |key: &String| fs::symlink_metadata(trash.join(key)).is_err();
    let flat = name.replace('+', "++").replace('/', "+-");
    let key = (1..).map(|number| format!("{flat}~{number}")).find(is_free).expect("a number that is not taken");
    let moved = fs::create_dir_all(&trash).and_then(|()| fs::rename(within.join(name), trash.join(&key)));
    let failed = |error: io::Error| PageMessage::NotDeleted { name: name.into(), why: error.to_string() };
    moved.map(|()| key).map_err(|error| unprocessable(failed(error)))
}

/// Moves a deleted folder back, and returns its name. `kind` is `run` or `home`, for messages.
pub fn restore(within: &Path, kind: &'static str, key: &str) -> Result<String, RequestError> {
    let missing = || not_found(PageMessage::NothingDeleted { kind, key: readable(key.to_owned()) });
    let name = deleted(within).into_iter().find(|(known, _)| known == key).map(|(_, name)| name).ok_or_else(missing)?;
    let to = within.join(&name);
    if fs::symlink_metadata(&to).is_ok() {
        return Err(unprocessable(PageMessage::NameTaken { kind, name }));
    }
    let folder = to.parent().unwrap_or(within);
    let moved = fs::create_dir_all(folder).and_then(|()| fs::rename(within.join(TRASH).join(key), &to));
    moved.map(|()| name).map_err(|error| match error.kind() {
        ErrorKind::NotFound => missing(),
        _ => unprocessable(PageMessage::NotRestored { key: readable(key.to_owned()), why: error.to_string() }),
    })
}

pub fn deleted(within: &Path) -> Vec<(String, String)> {
    let listed = fs::read_dir(within.join(TRASH)).into_iter().flatten().flatten();
    let folders = listed.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
    let keys = folders.filter_map(|entry| entry.file_name().into_string().ok());
    let mut all: Vec<(String, String)> = keys.filter_map(|key| Some((key.clone(), name_of(&key)?))).collect();
    all.sort();
    all
}

fn name_of(key: &str) -> Option<String> {
    let mut flat = key.rsplit_once('~')?.0.chars().peekable();
    let mut name = String::new();
    while let Some(c) = flat.next() {
        name.push(match c {
            '+' if flat.next_if_eq(&'+').is_some() => '+',
            '+' => {
                flat.next_if_eq(&'-');
                '/'
            }
            c => c,
        });
    }
    let is_inside = name.split('/').all(|part| !part.is_empty() && part != "." && part != "..");
    is_inside.then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn restores_any_name() {
        let within = tempfile::tempdir().unwrap();
        for name in ["a-1", "cohort-1/0001", "a+b", "a++b", "c/+d", "e~1", "f+-g"] {
            fs::create_dir_all(within.path().join(name)).unwrap();
            let key = delete(within.path(), name).unwrap();
            assert_eq!(deleted(within.path()), [(key.clone(), name.to_owned())]);
            assert!(!within.path().join(name).exists());
            assert_eq!(restore(within.path(), "run", &key).unwrap(), name);
            assert!(within.path().join(name).is_dir());
        }
        // An earlier form without an escape.
        assert_eq!(name_of("cohort-1+0001~1").as_deref(), Some("cohort-1/0001"));
        for key in ["..~1", "a+..~1", "+-a~1", "a", "~1", "a+~1"] {
            assert_eq!(name_of(key), None, "{key}");
        }
    }
}
