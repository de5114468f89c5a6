//! Tells builds apart whose models may live a run otherwise: the version and a digest of the sources that decide about lives.

use std::hash::{DefaultHasher, Hasher};
use std::path::Path;
use std::{env, fs, io};

/// What decides about lives, from the crate's folder.
const MODELS: [&str; 4] =
    ["../homebody-core/src", "../homebody-walk/src", "../homebody-routine/src", "../../conditions"];

fn main() -> io::Result<()> {
    let mut digest = DefaultHasher::new();
    for folder in MODELS {
        println!("cargo::rerun-if-changed={folder}");
        // What is built from a registry has its crates elsewhere, and its version says enough.
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
