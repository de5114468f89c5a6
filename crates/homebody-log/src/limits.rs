//! Limits on what is read. Anybody may have written a file, and what is in it must not fill the memory.

/// Largest size of a scenario's file, or of a list of profiles, in bytes (our choice).
pub const LARGEST_OF_SCENARIO_BYTES: u64 = 8 << 20;

/// Largest size of a recording, in bytes (our choice): it contains all files of a scenario.
pub const LARGEST_RECORDING_BYTES: u64 = 64 << 20;

/// Largest size of a list of a cohort's members, in bytes (our choice): a hundred thousand members take half a kilobyte
/// each, and their table.
pub const LARGEST_LIST_BYTES: u64 = 256 << 20;

/// Largest number of bytes of a row of a log or a truth (our choice): a mebibyte.
pub const LONGEST_ROW_BYTES: usize = 1 << 20;

/// Largest number of cells of a row (our choice).
pub const MOST_CELLS: usize = 1000;

/// Largest number of lines of one row of comma-separated values (our choice).
pub const MOST_LINES_OF_ROW: usize = 100;

/// Largest number of activities of a log (our choice): a hundred a day for a lifetime.
pub const MOST_ACTIVITIES: usize = 3_000_000;

/// Largest number of rows that wait to be put into the order of time (our choice): they take 48 MB.
pub const MOST_WAITING: usize = 1 << 20;

/// Largest number of characters of a sensor's id, the most that Home Assistant accepts.
pub const LONGEST_ID: usize = 255;

/// Largest number of characters of a sensor's value (our choice).
pub const LONGEST_VALUE: usize = 4096;

/// Number of characters of a text that an error quotes (our choice).
const LONGEST_QUOTED: usize = 40;

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
