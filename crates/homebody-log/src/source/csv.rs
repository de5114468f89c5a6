//! Comma-separated values: ours, pyadlml's `time,device,value`, Home Assistant's `entity_id,state,last_changed`,
//! and files without a header line whose first fields are time, sensor and value.

use super::{Places, Reading, open};
use crate::error::LogError;
use ::csv::{ByteRecord, ReaderBuilder};
use homebody_core::scenario::logger::LoggerFile;
use std::io::BufReader;
use std::path::Path;

/// Without a header line.
const FIRST: Places = Places { time: 0, sensor: 1, value: 2 };

pub(crate) fn read(path: &Path, file: &LoggerFile, reading: &mut Reading) -> Result<(), LogError> {
    let source = BufReader::new(open(path)?);
    let mut records = ReaderBuilder::new().has_headers(false).flexible(true).from_reader(source);
    let mut record = ByteRecord::new();
    let mut places = None;
    while records.read_byte_record(&mut record).map_err(|error| LogError::file(path, error.into()))? {
        let line = record.position().map_or(0, |position| position.line());
        let field = |place: usize| record.get(place).map(String::from_utf8_lossy).unwrap_or_default();
        let places = match places {
            Some(places) => places,
            None => {
                let first = field(0).trim_start_matches('\u{feff}').to_string();
                if reading.instants.read(&first).is_some() {
                    *places.insert(FIRST)
                } else {
                    let names = (0..record.len()).map(|place| field(place).trim_start_matches('\u{feff}').to_string());
                    let names: Vec<String> = names.collect();
                    let found = Places::by_name(&names, file);
                    let why = || format!("no columns of time, sensor and value are among {}", names.join(", "));
                    places = Some(found.ok_or_else(|| LogError::NoLog { path: path.into(), why: why() })?);
                    continue;
                }
            }
        };
        let time = field(places.time);
        reading.row(line, time.trim_start_matches('\u{feff}'), field(places.sensor).trim(), field(places.value).trim());
    }
    Ok(())
}
