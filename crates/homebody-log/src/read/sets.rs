//! Logs in several files, such as a data set with a file a day.

use crate::error::LogError;
use crate::files::{is_packed, plain};
use crate::source::casas::words::when;
use crate::source::{ARAS, FileStart, InstantReader, LineReader, LogForm, LogInstant, day_of};
use homebody_core::time::{DAY, WallTime};
use std::collections::VecDeque;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// A file of a log, and its first instant if that is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct LogPart {
    pub path: PathBuf,
    pub begin: Option<WallTime>,
}

/// The files of one log in their order: their names differ by numbers, and their spans do not overlap.
pub(crate) fn one_log(form: &LogForm, paths: &[PathBuf]) -> Option<Vec<LogPart>> {
    let names: Vec<String> = paths.iter().map(|path| numberless(path)).collect();
    let alike = names.len() >= 2 && names.iter().all(|name| *name == names[0] && name.contains('#'));
    if !alike || is_of_homes(&names[0]) {
        return None;
    }
    let span = |path: &PathBuf| {
        // Its rows have no times.
        let (begin, end) = match *form == ARAS {
            true => day_of(path).map(|day| (WallTime::EPOCH + (day - 1) * DAY, WallTime::EPOCH + day * DAY))?,
            false => ends(path)?,
        };
        Some((begin, end, path.clone()))
    };
    let mut spans: Vec<(WallTime, WallTime, PathBuf)> = paths.iter().map(span).collect::<Option<_>>()?;
    spans.sort();
    let follow = spans.windows(2).all(|pair| pair[0].0 < pair[1].0 && pair[0].1 <= pair[1].0);
    let part = |(begin, _, path)| LogPart { path, begin: Some(begin) };
    follow.then(|| spans.into_iter().map(part).collect())
}

/// A file's name with a sign in place of each number.
fn numberless(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let mut without = String::new();
    for letter in name.chars() {
        match letter.is_ascii_digit() {
            true if without.ends_with('#') => {}
            true => without.push('#'),
            false => without.push(letter),
        }
    }
    without
}

/// Whether the numbers in a name count homes or people: then each file is a log of its own.
fn is_of_homes(name: &str) -> bool {
    const HOMES: [&str; 14] = [
        "home", "house", "hh", "csh", "flat", "apartment", "apt", "household", "patient", "subject", "resident",
        "person", "participant", "tm",
    ];
    let before = name.split('#').next().unwrap_or_default();
    let word = before.trim_end_matches(|c: char| !c.is_alphabetic());
    let word = word.rsplit(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
    HOMES.contains(&word)
}

/// The part of a file's end that shows its last instant.
const LOOKED_AT_BYTES: u64 = 1 << 16;

/// The same in lines for a packed file.
const LAST_LINES: usize = 100;

/// The first and the last instant of a text.
pub(crate) fn ends(path: &Path) -> Option<(WallTime, WallTime)> {
    let mut instants = InstantReader::default();
    let first = FileStart::read(path).ok()?.lines().find_map(|line| times(&line, &mut instants).first().copied())?;
    let last = last_lines(path).ok()?;
    let last = last.iter().flat_map(|line| times(line, &mut instants)).max()?;
    Some((first, last.max(first)))
}

fn last_lines(path: &Path) -> Result<Vec<String>, LogError> {
    if is_packed(path) {
        let (mut lines, mut last) = (LineReader::open(path)?, VecDeque::new());
        while let Some((_, line)) = lines.next_text()? {
            last.push_back(line.into_owned());
            last.drain(..last.len().saturating_sub(LAST_LINES));
        }
        return Ok(last.into());
    }
    let unreadable = |error| LogError::file(path, error);
    let mut file = plain::open(path).map_err(unreadable)?;
    let length = file.metadata().map_err(unreadable)?.len();
    let from = length.saturating_sub(LOOKED_AT_BYTES);
    file.seek(SeekFrom::Start(from)).map_err(unreadable)?;
    let mut bytes = Vec::new();
    file.take(LOOKED_AT_BYTES).read_to_end(&mut bytes).map_err(unreadable)?;
    let lines = bytes.split(|&byte| byte == b'\n').skip(usize::from(from > 0));
    Ok(lines.map(|line| String::from_utf8_lossy(line).into_owned()).collect())
}

/// The instants in a line, whatever its form: at its beginning, or in its cells.
pub(crate) fn times(line: &str, instants: &mut InstantReader) -> Vec<WallTime> {
    if let Some(first) = when(line.as_bytes(), instants) {
        let second = when(first.behind, instants).map(|second| second.at.on_wall());
        return std::iter::once(first.at.on_wall()).chain(second).collect();
    }
    let cells: Vec<&str> = line.split([',', ';', '\t', '|']).map(|cell| cell.trim().trim_matches('"').trim()).collect();
    // A number may be anything.
    let is_date = |cell: &&&str| cell.contains(':');
    let mut found: Vec<WallTime> =
        cells.iter().filter(is_date).filter_map(|cell| instants.read(cell)).map(LogInstant::on_wall).collect();
    if found.is_empty() {
        let joined = cells.windows(2).filter_map(|pair| instants.read(&format!("{} {}", pair[0], pair[1])));
        found = joined.map(LogInstant::on_wall).collect();
    }
    if found.is_empty() {
        found.extend(cells.iter().filter_map(|cell| instants.read(cell)).map(LogInstant::on_wall).take(1));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;

    #[test]
    fn names_that_differ_by_numbers_are_alike() {
        for (name, alike) in
            [("DAY_1.txt", "day_#.txt"), ("2026-02-02.csv", "#-#-#.csv"), ("devices.csv", "devices.csv")]
        {
            assert_eq!(numberless(Path::new(name)), alike);
        }
        for (name, is_of) in [
            ("hh#.csv", true),
            ("home_#.txt", true),
            ("data-house#.txt", true),
            ("day_#.txt", false),
            ("#-#.csv", false),
        ] {
            assert_eq!(is_of_homes(name), is_of, "{name}");
        }
    }

    #[test]
    fn the_times_of_a_line_are_found_in_any_form() {
        let second = |text: &str| {
            times(text, &mut InstantReader::default()).iter().map(|at| at.since_zero() / SECOND).collect::<Vec<_>>()
        };
        let at = 1_235_977_923;
        assert_eq!(second("2009-03-02 07:12:03 M1 ON"), [at]);
        assert_eq!(second("M1,\"2009-03-02 07:12:03\",ON"), [at]);
        assert_eq!(second("2009-03-02 07:12:03\t2009-03-02 07:12:04\t24\t1"), [at, at + 1]);
        assert_eq!(second("M1,1235977923.5,ON"), [at]);
        assert_eq!(second("2009-03-02,07:12:03,M1,ON"), [at]);
        assert!(second("no time").is_empty());
    }
}
