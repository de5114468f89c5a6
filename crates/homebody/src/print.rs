//! Where words and figures go: what was asked for to standard output or a file, what is said besides to standard error.

use crate::failure::Failure;
use homebody_log::fresh::FreshFile;
use std::path::Path;

/// A JSON object as files and scripts get it.
pub fn json_text(value: &impl serde::Serialize) -> Result<String, Failure> {
    Ok(serde_json::to_string_pretty(value).map_err(Failure::usage)? + "\n")
}

/// Prints the one JSON object that `--json` promises.
pub fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    print_text(&json_text(value)?)
}

/// Prints on standard output; a reader that has gone away is no error.
pub fn print_text(text: &str) -> Result<(), Failure> {
    use std::io::{ErrorKind, Write};
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Io(format!("standard output: {error}"))),
        _ => Ok(()),
    }
}

/// Writes a whole file under its name or not at all; one that exists is replaced with `force` only.
pub fn write_file(path: &Path, bytes: &[u8], force: bool) -> Result<(), Failure> {
    let mut file = FreshFile::create(path, force)?;
    file.write(bytes)?;
    Ok(file.finish()?)
}

/// Tells people something on standard error; that nobody listens there is no error.
pub fn tell(text: impl std::fmt::Display) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}
