//! What is put aside: a folder is moved into a hidden one beside the others, where no listing finds it, until it is fetched back or
//! somebody removes it there.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::Path;

/// The folder of what is put aside, beside the others.
const ASIDE: &str = ".put-aside";

/// Why nothing was moved.
#[derive(Debug)]
pub enum Unmoved {
    /// Nothing is put aside under this key.
    Unknown,
    /// Something has its name now.
    Taken(String),
    Failed(io::Error),
}

/// Puts a folder aside, by its path below another, and says the key under which it is fetched back.
pub fn put(within: &Path, name: &str) -> io::Result<String> {
    let aside = within.join(ASIDE);
    fs::create_dir_all(&aside)?;
    let is_free = |key: &String| fs::symlink_metadata(aside.join(key)).is_err();
    let flat = name.replace('+', "++").replace('/', "+-");
    let key = (1..).map(|number| format!("{flat}~{number}")).find(is_free).expect("a number that is not taken");
    fs::rename(within.join(name), aside.join(&key))?;
    Ok(key)
}

/// Fetches back what was put aside under a key, and says its name.
pub fn fetch_back(within: &Path, key: &str) -> Result<String, Unmoved> {
    let aside = within.join(ASIDE);
    if !keys(within).iter().any(|known| known == key) {
        return Err(Unmoved::Unknown);
    }
    let name = name_of(key).ok_or(Unmoved::Unknown)?;
    let to = within.join(&name);
    if fs::symlink_metadata(&to).is_ok() {
        return Err(Unmoved::Taken(name));
    }
    let folder = to.parent().unwrap_or(within);
    let moved = fs::create_dir_all(folder).and_then(|()| fs::rename(aside.join(key), &to));
    match moved {
        Ok(()) => Ok(name),
        Err(error) if error.kind() == ErrorKind::NotFound => Err(Unmoved::Unknown),
        Err(error) => Err(Unmoved::Failed(error)),
    }
}

/// The keys of all that is put aside.
pub fn keys(within: &Path) -> Vec<String> {
    let listed = fs::read_dir(within.join(ASIDE)).into_iter().flatten().flatten();
    let folders = listed.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
    let mut keys: Vec<String> = folders.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    keys.retain(|key| name_of(key).is_some());
    keys.sort();
    keys
}

/// What something was called that is put aside.
pub fn name_of(key: &str) -> Option<String> {
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
    fn whatever_it_is_called_it_comes_back_under_its_name() {
        let within = tempfile::tempdir().unwrap();
        for name in ["a-1", "cohort-1/0001", "a+b", "a++b", "c/+d", "e~1", "f+-g"] {
            fs::create_dir_all(within.path().join(name)).unwrap();
            let key = put(within.path(), name).unwrap();
            assert_eq!(keys(within.path()), std::slice::from_ref(&key));
            assert!(!within.path().join(name).exists());
            assert_eq!(fetch_back(within.path(), &key).unwrap(), name);
            assert!(within.path().join(name).is_dir());
        }
        // As it was written before there was an escape.
        assert_eq!(name_of("cohort-1+0001~1").as_deref(), Some("cohort-1/0001"));
        for key in ["..~1", "a+..~1", "+-a~1", "a", "~1", "a+~1"] {
            assert_eq!(name_of(key), None, "{key}");
        }
    }
}
