//! `logger.json`: where the log goes, and which table, columns, ids and time format it has there.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `logger.json`: maps the log onto a real network's database.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "logger")]
pub struct LoggerFile {
    /// Where the JSON Schema of this file is, for editors.
    #[serde(rename = "$schema", skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Where to write: `sqlite:FILE`, `csv:FILE`, `casas:FILE`; relative to the run's folder. Default `sqlite:log.db`.
    #[schemars(length(max = 16))]
    pub to: Vec<String>,
    /// The table's name. Default `firing`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<String>,
    /// What the columns of the log are called.
    pub columns: ColumnsFile,
    /// The network's own id of a sensor, such as an X10 code, by the sensor's name. Others keep their name.
    #[schemars(extend("maxProperties" = 2_000))]
    pub ids: BTreeMap<String, String>,
    /// What of a firing becomes rows.
    pub messages: MessagesFile,
    /// Whether a text that a spreadsheet would take for a formula has a ' before it in the log and the truth in CSV: one that
    /// begins with =, +, -, or @. It is read without. Default `true`.
    #[serde(skip_serializing_if = "is_true")]
    pub spreadsheet_safe: bool,
    /// How the instants of the log and of the truth are written.
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

/// Column names; `run` and `seq` make the key under which a row is stored once only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "set of columns")]
pub struct ColumnsFile {
    /// The column of the run's id, the same number in all rows of a run.
    pub run: String,
    /// The column that numbers the rows of a run, from 0.
    pub seq: String,
    /// The column of the time at which the logger says that it was said.
    pub time: String,
    /// The column of the sensor's id.
    pub sensor: String,
    /// The column of what the sensor said.
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

/// What of a firing is stored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Default)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "kind of messages")]
pub enum MessagesFile {
    /// Each firing is one row, as at TigerPlace.
    #[default]
    FireOnly,
    /// `ON` at a firing, `OFF` once no firing has come for the hold, as in CASAS homes; firings meanwhile only prolong it.
    OnOff(OnOffFile),
    /// `true` at a firing, `false` once no firing has come for the timeout, as Zigbee sensors report occupancy.
    Occupancy(OccupancyFile),
}

/// ON and OFF with a hold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "on_off message")]
pub struct OnOffFile {
    /// From the last firing to OFF. A Bosch unit's ON lasts 4 s, an X10 one's a minute.
    #[schemars(range(min = 0.001, max = 86_400))]
    pub hold_s: f64,
    /// How the hold of real units lumps and spreads; `[]` for exactly `hold_s` each time. The default is that of Bosch units,
    /// whose ONs of 4 s last 3.8 to 4.5 s in nine of ten cases, in parts of `hold_s`.
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

/// Holds that are about as long as each other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "lump of holds")]
pub struct LumpFile {
    /// Which part of the holds they are, in comparison with the other lumps.
    #[schemars(range(min = 0, max = 1_000_000))]
    pub share: f64,
    /// How long they are, least and most, in parts of `hold_s`; every length between is as likely.
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
    /// From the last firing to `false`. 90 s is Zigbee2MQTT's default for the Aqara RTCGQ11LM.
    #[schemars(range(min = 0.001, max = 86_400))]
    pub timeout_s: f64,
}

/// How an instant is written.
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
