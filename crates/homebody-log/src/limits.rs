//! Limits on what is read. Anybody may have written a file, and what is in it must not fill the memory.

/// No file of a scenario is larger, in bytes (ours). A list of profiles is one, too.
pub const LARGEST_OF_SCENARIO_BYTES: u64 = 8 << 20;

/// No recording is larger, in bytes (ours): it holds all files of a scenario.
pub const LARGEST_RECORDING_BYTES: u64 = 64 << 20;

/// No list of a cohort's members is larger, in bytes (ours): a hundred thousand of them take half a kilobyte each, and their table.
pub const LARGEST_LIST_BYTES: u64 = 256 << 20;

/// No row of a log or a truth has more bytes (ours): a mebibyte.
pub const LONGEST_ROW_BYTES: usize = 1 << 20;

/// No row has more cells (ours).
pub const MOST_CELLS: usize = 1000;

/// No row of comma-separated values goes on over more lines (ours).
pub const MOST_LINES_OF_ROW: usize = 100;

/// No more activities of a log are kept (ours): that is a hundred a day for a life.
pub const MOST_ACTIVITIES: usize = 3_000_000;

/// No more rows wait to be put into the order of time (ours): they take 48 MB.
pub const MOST_WAITING: usize = 1 << 20;

/// No sensor's id has more characters, which is the most that Home Assistant takes.
pub const LONGEST_ID: usize = 255;

/// Nothing that a sensor says has more characters (ours).
pub const LONGEST_VALUE: usize = 4096;

/// How many characters of a text an error quotes (ours).
const LONGEST_QUOTED: usize = 40;

/// The beginning of a text, in quotes.
pub(crate) fn beginning(text: &str) -> String {
    match text.char_indices().nth(LONGEST_QUOTED) {
        Some((end, _)) => format!("{:?}...", &text[..end]),
        None => format!("{text:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_beginning_is_quoted() {
        assert_eq!(beginning("hall \"1\""), r#""hall \"1\"""#);
        assert_eq!(beginning(&"é".repeat(50)), format!("{:?}...", "é".repeat(40)));
    }
}
