//! Where words and figures go: what was asked for to standard output or a file, what is said besides to standard error.

use crate::failure::Failure;
use homebody_log::fresh::FreshFile;
use std::borrow::Cow;
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
    match std::io::stdout().lock().write_all(seen(text).as_bytes()) {
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
    let _ = writeln!(std::io::stderr().lock(), "{}", seen(&text.to_string()));
}

/// The text with a mark for each character that a terminal would obey: names come from files that anybody may have written.
fn seen(text: &str) -> Cow<'_, str> {
    let is_obeyed = |c: char| c.is_control() && c != '\n' && c != '\t';
    if text.contains(is_obeyed) { text.replace(is_obeyed, "\u{fffd}").into() } else { text.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_terminal_obeys_a_name() {
        assert_eq!(
            seen("sensor\u{1b}[2J\u{7}\u{9b}1m, a\tb\r\n"),
            "sensor\u{fffd}[2J\u{fffd}\u{fffd}1m, a\tb\u{fffd}\n"
        );
        assert!(matches!(seen("hall motion, Öz 好\n"), Cow::Borrowed(_)));
    }
}
