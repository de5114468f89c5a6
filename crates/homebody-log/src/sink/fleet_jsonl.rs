//! The rows of many homes as a JSON object a line: which home, and then as the log of that home alone has it.

use super::fleet::{Fleet, FleetEvent, FleetRow, FleetSink};
use super::jsonl::{in_json, quote};
use super::text::{TextSink, TextTarget};
use crate::error::{LogError, OutputMessage, Reason};
use crate::files::{WriteMode, plain};
use crate::policy::Deadline;
use crate::run::sensor_table;
use crate::table::InstantWriter;
use crate::url::Url;
use homebody_core::event::Value;
use homebody_core::time::UtcTime;
use std::io::{Read, Write};
use std::path::Path;
use std::sync::Arc;

/// The key of the home, unless a column of the log has this name.
const HOME: &str = "home";
const HOME_BESIDE_COLUMN: &str = "home_name";

/// Whether a file looks like rows of a fleet, so that the same command may add to it. The beginning of a run compares each row.
pub fn has_rows_of_fleet(path: &Path) -> bool {
    let begins = [HOME, HOME_BESIDE_COLUMN].map(|key| format!("{{{}:\"", in_json(key)));
    let mut first = Vec::new();
    let read =
        plain::open(path).and_then(|file| file.take(HOME_BESIDE_COLUMN.len() as u64 + 5).read_to_end(&mut first));
    read.is_ok() && begins.iter().any(|begin| first.starts_with(begin.as_bytes()))
}

/// One text for all homes.
pub(crate) struct FleetJsonl {
    at: TextTarget,
    open: Option<OpenFleetJsonl>,
}

struct OpenFleetJsonl {
    fleet: Arc<Fleet>,
    text: TextSink,
    kinds: Vec<InKind>,
    line: Vec<u8>,
    buffer: String,
}

/// The parts of lines that homes of one kind share.
struct InKind {
    clock: InstantWriter,
    /// The text before the home, and before the value of each column.
    home: String,
    keys: Vec<String>,
    sensors: Vec<String>,
}

impl FleetJsonl {
    pub fn new(url: &Url) -> FleetJsonl {
        FleetJsonl { at: TextTarget::from_url(url), open: None }
    }
}

impl FleetSink for FleetJsonl {
    fn begin(&mut self, fleet: &Arc<Fleet>, how: WriteMode, deadline: &Deadline) -> Result<Vec<u64>, LogError> {
        let kinds = fleet.layouts.iter().map(|layout| {
            let names = || layout.table.columns.iter().map(|column| column.name.as_str());
            let home = if names().any(|name| name == HOME) { HOME_BESIDE_COLUMN } else { HOME };
            let sensors = (0..layout.run.sensors.len()).map(homebody_core::ids::SensorId::new);
            InKind {
                clock: InstantWriter::new(&layout.run.calendar, layout.time),
                home: format!("{{{}:", in_json(home)),
                keys: names().map(|name| format!(",{}:", in_json(name))).collect(),
                sensors: sensors.map(|sensor| in_json(layout.sensor(sensor))).collect(),
            }
        });
        let kinds = kinds.collect();
        // The same command makes the same rows again, in the same order: those that are there are compared, and the rest is added.
        let goes_on = matches!(&self.at, TextTarget::File(path) if has_rows_of_fleet(path));
        let how = if goes_on && how == WriteMode::Create { WriteMode::Resume } else { how };
        let text = TextSink::begin(&self.at, how, true, deadline)?;
        // Homes of one scenario have the same sensors; of several, an id says nothing without the home.
        if let (TextTarget::File(path), [layout]) = (&self.at, &fleet.layouts[..]) {
            sensor_table::write(&sensor_table::beside(path), &layout.run, how != WriteMode::Create)?;
        }
        self.open = Some(OpenFleetJsonl { fleet: fleet.clone(), text, kinds, line: Vec::new(), buffer: String::new() });
        Ok(vec![0; fleet.homes.len()])
    }

    fn is_file(&self) -> bool {
        matches!(self.at, TextTarget::File(_))
    }

    fn tell(&mut self, told: &[FleetEvent]) -> Result<(), LogError> {
        let Some(open) = &mut self.open else { return Err(LogError::Stopped { place: self.at.place() }) };
        for told in told {
            if let FleetEvent::Row(row) = told {
                open.line(row);
                open.text.line(&open.line).map_err(of_other_homes)?;
            }
        }
        open.text.show()
    }

    fn finish(&mut self, _: UtcTime) -> Result<(), LogError> {
        self.open.take().map_or(Ok(()), |open| open.text.stop())
    }
}

/// Says that a file with other rows belongs to another fleet, or to the same one at another time.
fn of_other_homes(error: LogError) -> LogError {
    let LogError::Changed(Reason { place, why, .. }) = error else { return error };
    LogError::destination(place, OutputMessage::OtherHomes { difference: why.what })
}

impl OpenFleetJsonl {
    fn line(&mut self, row: &FleetRow) {
        let OpenFleetJsonl { fleet, kinds, line, buffer, .. } = self;
        let home = &fleet.homes[row.home as usize];
        let InKind { clock, home: key, keys, sensors } = &mut kinds[home.layout];
        let quote = quote(clock);
        line.clear();
        // A vector takes all that is written to it.
        let _ = write!(line, "{key}\"{}\"", home.name);
        for (column, key) in keys.iter().enumerate() {
            line.extend_from_slice(key.as_bytes());
            let _ = match (column, row.value) {
                (0, _) => write!(line, "{}", row.seq),
                (1, _) => write!(line, "{quote}{}{quote}", clock.text(row.at)),
                (2, _) => line.write_all(sensors[row.sensor.index()].as_bytes()),
                (_, Value::Reading(_)) => write!(line, "{}", row.value),
                (_, said) => write!(line, "\"{}\"", fleet.layouts[home.layout].value(said, buffer)),
            };
        }
        line.extend_from_slice(b"}\n");
    }
}
