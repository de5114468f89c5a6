//! The text of the CASAS smart homes: date, time, sensor and value, parted by blanks or tabs, as homes differ.
//!
//! Some homes repeat the sensor or tell its room and place before the value, and what kind of sensor it is after
//! it; all that is passed over. Some note at a line's end that an activity begins or ends, as `Sleep begin`.

use super::reading::{Reading, open};
use crate::error::LogError;
use crate::limits::LONGEST_ROW_BYTES;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

/// Before the kind of a sensor there is always its value.
const KIND: &str = "Control4-";

pub(crate) fn read(path: &Path, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let mut file = BufReader::new(open(path)?);
    let mut line = Vec::new();
    for number in 1.. {
        line.clear();
        // One more is read, which says that it goes on.
        let read = file.by_ref().take(LONGEST_ROW_BYTES as u64 + 1).read_until(b'\n', &mut line);
        if read.map_err(|error| LogError::file(path, error))? == 0 {
            break;
        }
        if line.len() > LONGEST_ROW_BYTES {
            let what = format!("the line is longer than {LONGEST_ROW_BYTES} bytes");
            return Err(LogError::too_long(path, number, what));
        }
        understand(number, &String::from_utf8_lossy(&line), reading)?;
    }
    Ok(())
}

fn understand(number: u64, line: &str, reading: &mut Reading<'_>) -> Result<(), LogError> {
    let line = line.trim_start_matches('\u{feff}');
    let mut words = line.split_whitespace();
    let Some(date) = words.next() else { return Ok(()) };
    // `2009-03-02T07:12:03` is one word, `2009-03-02 07:12:03` two.
    let time =
        if date.contains(':') { date.to_string() } else { format!("{date} {}", words.next().unwrap_or_default()) };
    let words: Vec<&str> = words.collect();
    let Some(&sensor) = words.first() else {
        reading.skip(number, "there are no date, time, sensor and value".into());
        return Ok(());
    };
    let value = match words.iter().position(|word| word.starts_with(KIND)) {
        Some(kind) if kind > 1 => words.get(kind - 1),
        _ if words.len() > 2 && words[1] == sensor => words.get(2),
        _ => words.get(1),
    };
    let rows = reading.log.rows;
    reading.row(number, &time, sensor, value.copied().unwrap_or_default())?;
    if let [.., name, note @ ("begin" | "end")] = words[2.min(words.len())..]
        && reading.log.rows > rows
    {
        reading.note(name, note == "begin");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Log;

    fn read(text: &str) -> Log {
        let mut take = |_: &Log| Ok(());
        let mut reading = Reading::new(Path::new("log.txt"), &mut take);
        for (index, line) in text.lines().enumerate() {
            understand(index as u64 + 1, line, &mut reading).unwrap();
        }
        reading.log
    }

    #[test]
    fn homes_differ() {
        for line in [
            "2009-03-02 07:12:03.25\tM001\tON\t",
            "2009-03-02 07:12:03.25 M001 ON",
            "2009-03-02\t07:12:03.250000\tM001\tON\tSleep begin\r",
            "2009-03-02T07:12:03.25 M001 ON R1_Work end",
            "2009-03-02 07:12:03.25 M001 M001 ON Cook",
            "2009-03-02 07:12:03.250  M001  Kitchen Stove ON Control4-Motion",
            "2009-03-02 07:12:03.250\tM001\tKitchen\tStove\tON\tControl4-MotionArea\tCook",
            "\u{feff}2009-03-02 07:12:03.25 M001 ON",
        ] {
            let log = read(line);
            assert_eq!((&log.sensors[..], &log.values[..]), (&["M001".into()][..], &["ON".into()][..]), "{line}");
            assert_eq!(log.events[0].at, 1_235_977_923_250_000, "{line}");
        }
    }

    #[test]
    fn notes_become_activities() {
        let log = read(
            "2009-03-02 07:00:00 M001 ON Sleep end\n2009-03-02 08:00:00 M001 ON Cook begin\n\
             2009-03-02 08:10:00 M001 ON Cook begin\n2009-03-02 08:20:00 M001 OFF R1_Work begin\n\
             2009-03-02 08:30:00 M001 OFF Cook end",
        );
        let [cook] = &log.activities[..] else { panic!("{:?}", log.activities) };
        assert_eq!((cook.name.as_str(), cook.end - cook.begin), ("Cook", 30 * 60 * 1_000_000));
    }

    #[test]
    fn dirt_is_skipped_and_told() {
        let log =
            read("2009-03-02 07:12:03 M001 ON\n\nnonsense\n2009-03-02 07:12:04 M001\n2009-03-02 99:12:04 M1 ON\n");
        assert_eq!((log.events.len(), log.skipped), (1, 3));
        let lines: Vec<u64> = log.problems.iter().map(|skipped| skipped.line).collect();
        assert_eq!(lines, [3, 4, 5]);
    }
}
