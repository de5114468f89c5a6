//! `logger.json`: where the log goes, and which table, columns, ids and time format it has there.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `logger.json`: maps the log to the database of a real network.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "logger")]
pub struct LoggerFile {
    /// Path or URL of this file's JSON Schema, for editors.
    #[serde(rename = "$schema", skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Destinations: `sqlite:FILE`, `csv:FILE`, `casas:FILE`, relative to the run's folder. Default `sqlite:log.db`.
    #[schemars(length(max = 16))]
    pub to: Vec<String>,
    /// Name of the table. Default `firing`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<String>,
    /// Names of the log's columns.
    pub columns: ColumnsFile,
    /// Id that the network gives a sensor, such as an X10 code, by the sensor's name. Other sensors keep their name.
    #[schemars(extend("maxProperties" = 2_000))]
    pub ids: BTreeMap<String, String>,
    /// How firings of motion sensors become rows.
    pub messages: MessagesFile,
    /// Whether a CSV log or truth puts a ' before a text that a spreadsheet would read as a formula: one that begins
    /// with =, +, - or @. Homebody removes it when it reads the file. Default `true`.
    #[serde(skip_serializing_if = "is_true")]
    pub spreadsheet_safe: bool,
    /// Format of the instants in the log and in the truth.
    pub time: TimeFormat,
}

impl Default for LoggerFile {
    fn default() -> Self {
        LoggerFile {
            schema: None,
            to: Vec::new(),
            table: None,
            columns: ColumnsFile::default(),
            ids: BTreeMap::new(),
            messages: MessagesFile::default(),
            spreadsheet_safe: true,
            time: TimeFormat::default(),
        }
    }
}

fn is_true(value: &bool) -> bool {
    *value
}

/// Names of the columns. `run` and `seq` are the key that stores each row only once.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "set of columns")]
pub struct ColumnsFile {
    /// Column of the run's id, the same number in all rows of a run.
    pub run: String,
    /// Column of the row's number in the run, from 0.
    pub seq: String,
    /// Column of the time that the logger gives the event.
    pub time: String,
    /// Column of the sensor's id.
    pub sensor: String,
    /// Column of the event's value.
    pub value: String,
}

impl Default for ColumnsFile {
    fn default() -> Self {
        ColumnsFile {
            run: "run_id".into(),
            seq: "seq".into(),
            time: "fired_at".into(),
            sensor: "sensor".into(),
            value: "value".into(),
        }
    }
}

/// How firings of motion sensors become rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Default)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "kind of messages")]
pub enum MessagesFile {
    /// Each firing is one row, as at TigerPlace.
    #[default]
    FireOnly,
    /// `ON` at a firing, and `OFF` once no firing has come for the hold, as in CASAS homes. A firing during the hold
    /// only prolongs it.
    OnOff(OnOffFile),
    /// `true` at a firing, and `false` once no firing has come for the timeout, as Zigbee sensors report occupancy.
    Occupancy(OccupancyFile),
}

/// ON and OFF with a hold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "on_off message")]
pub struct OnOffFile {
    /// Time from the last firing to OFF. The ON of a Bosch unit lasts 4 s, that of an X10 unit a minute.
    #[schemars(range(min = 0.001, max = 86_400))]
    pub hold_s: f64,
    /// How the holds of real units vary: groups of lengths, in parts of `hold_s`. `[]` makes each hold exactly
    /// `hold_s`. The default is that of Bosch units: nine in ten of their ONs of 4 s last 3.8 to 4.5 s.
    #[serde(default = "lumps", skip_serializing_if = "is_usual")]
    #[schemars(length(max = 20))]
    pub lumps: Vec<LumpFile>,
}

impl OnOffFile {
    /// Holds of exactly this length.
    pub fn exactly(hold_s: f64) -> OnOffFile {
        OnOffFile { hold_s, lumps: Vec::new() }
    }
}

/// A group of holds of about the same length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "lump of holds")]
pub struct LumpFile {
    /// Weight of the group in comparison with the other groups.
    #[schemars(range(min = 0, max = 1_000_000))]
    pub share: f64,
    /// Shortest and longest hold in parts of `hold_s`. Every length in between is equally likely.
    #[schemars(inner(range(min = 0.01, max = 100)))]
    pub parts: [f64; 2],
}

/// Ours, such that 5 % are below 0.955, half below 0.995 and 5 % above 1.11 of the hold, as of Bosch units.
fn lumps() -> Vec<LumpFile> {
    let lump = |share, parts| LumpFile { share, parts };
    vec![lump(0.55, [0.95, 1.0]), lump(0.3, [1.0, 1.05]), lump(0.12, [1.05, 1.125]), lump(0.03, [1.125, 1.6])]
}

fn is_usual(of: &[LumpFile]) -> bool {
    of == lumps()
}

/// Occupancy with a timeout.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "occupancy message")]
pub struct OccupancyFile {
    /// Time from the last firing to `false`. Zigbee2MQTT uses 90 s for the Aqara RTCGQ11LM.
    #[schemars(range(min = 0.001, max = 86_400))]
    pub timeout_s: f64,
}

/// Format of an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, Default)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "time format")]
pub enum TimeFormat {
    /// Local time without a zone, `2009-03-02 07:12:03.250000`.
    #[default]
    Local,
    /// Local time with its offset, `2009-03-02T07:12:03.250000-06:00`.
    LocalOffset,
    /// UTC, `2009-03-02T13:12:03.250000Z`.
    Utc,
    /// Seconds since 1970 with a fraction.
    EpochS,
    /// Whole milliseconds since 1970.
    EpochMs,
}
