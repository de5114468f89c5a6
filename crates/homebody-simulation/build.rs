//! The version of a build, with a digest of the sources of its models: builds with other models may simulate a run differently.

use std::hash::{DefaultHasher, Hasher};
use std::path::Path;
use std::{env, fs, io};

/// The sources of the models, from the crate's folder.
const MODELS: [&str; 4] =
    ["../homebody-core/src", "../homebody-walk/src", "../homebody-routine/src", "../../conditions"];

fn main() -> io::Result<()> {
    let mut digest = DefaultHasher::new();
    for folder in MODELS {
        println!("cargo::rerun-if-changed={folder}");
        // A build from a registry has these crates elsewhere, and its version identifies the models.
        if Path::new(folder).is_dir() {
            add(Path::new(folder), &mut digest)?;
        }
    }
    let version = env::var("CARGO_PKG_VERSION").unwrap_or_default();
    println!("cargo::rustc-env=HOMEBODY_VERSION={version}+{:08x}", digest.finish() >> 32);
    Ok(())
}

fn add(folder: &Path, digest: &mut DefaultHasher) -> io::Result<()> {
    let mut entries = fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>()?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        digest.write(entry.file_name().as_encoded_bytes());
        match entry.file_type()?.is_dir() {
            true => add(&entry.path(), digest)?,
            false => digest.write(&fs::read(entry.path())?),
        }
    }
    Ok(())
}
