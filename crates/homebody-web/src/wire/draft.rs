//! Drafts: files that a person edits in the page and has not saved.

use super::{At, DateView, HomeView};
use homebody_analysis::coverage::SensorCoverage;
use homebody_routine::completion::Completion;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use ts_rs::TS;

/// The files in the folder of the scenario.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FilesView {
    /// The scenario's own file. It names the home, the logger and the routines below.
    pub entry: String,
    pub home: Option<String>,
    pub logger: Option<String>,
    pub lives: Vec<ResidentRoutineView>,
    pub files: Vec<FileView>,
}

/// The place of an image below the plan: the file `underlay.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct UnderlayView {
    /// The name of the image's file in the same folder.
    pub picture: String,
    /// Its middle, in metres.
    pub at: [f64; 2],
    pub width_m: f64,
    /// Against the clock.
    #[serde(default)]
    pub turn_deg: f64,
}

/// A resident with a routine.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ResidentRoutineView {
    pub name: String,
    /// The name of its file.
    pub routine: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FileView {
    pub name: String,
    pub text: String,
    /// A digest of the text.
    pub version: String,
}

/// Texts in place of files, by name.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Draft {
    pub texts: BTreeMap<String, String>,
}

/// Texts to be saved, all or none.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Save {
    pub files: Vec<SaveFile>,
}

#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct SaveFile {
    pub name: String,
    pub text: String,
    /// The version that the draft is based on; null for a new file.
    pub version: Option<String>,
}

/// The result of saving.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SavedView {
    /// The new versions by name; empty if nothing was saved.
    pub saved: BTreeMap<String, String>,
    /// The files that other programs or pages have changed.
    pub changed: Vec<FileView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CheckView {
    pub problems: Vec<ProblemView>,
    pub warnings: Vec<ProblemView>,
}

/// A kind of names in a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Named {
    Room,
    Door,
    Furniture,
    Place,
    Sensor,
    Resident,
}

#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Rename {
    pub draft: Draft,
    pub kind: Named,
    pub from: String,
    pub to: String,
}

#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Forget {
    pub draft: Draft,
    pub kind: Named,
    pub names: Vec<String>,
}

/// The uses of names, and the texts without the old names.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct NamesView {
    pub mentions: Vec<MentionView>,
    /// The changed texts.
    pub texts: BTreeMap<String, String>,
    /// True if another thing of its kind has the old or the new name. Then nothing is renamed.
    pub is_shared: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct MentionView {
    pub file: String,
    /// From 1.
    pub line: u32,
    /// The line, shortened.
    pub said: String,
    /// True if `texts` removes it; the author of the file removes the others.
    pub goes: bool,
}

/// A solution with one click.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct MendView {
    /// The label of the button.
    pub what: String,
    /// The changed texts.
    pub texts: BTreeMap<String, String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ProblemView {
    /// The stable code, such as `home::rooms-overlap`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub code: Option<String>,
    pub file: String,
    /// From 1; 0 for the whole file.
    pub line: u32,
    /// In characters, from 1; 0 for the whole file.
    pub column: u32,
    /// In characters.
    pub width: u32,
    pub what: String,
    pub hint: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub fix: Option<FixView>,
}

/// A change that solves a problem, as a button offers it.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum FixView {
    /// Replace the words or the JSON string at the problem's place.
    Replace { with: String },
    /// Set `"enterable"` of a piece of furniture to `true`.
    LetEnter { furniture: String },
    /// Add a piece to the furniture of the home.
    Add {
        #[ts(type = "Record<string, unknown>")]
        piece: Value,
        room: Option<String>,
        /// The hint without the words for this change.
        rest: String,
    },
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PlanView {
    /// Of the home's file only.
    pub problems: Vec<ProblemView>,
    pub home: Option<HomeView>,
    pub coverage: Option<CoverageView>,
}

/// The parts of a home in which sensors detect a standing body. Areas are square metres, shares 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CoverageView {
    /// The side of a cell.
    pub step_m: f64,
    /// The south-west corner of the first cell.
    pub corner: At,
    pub columns: u32,
    /// Row by row from the south-west, a byte each: 255 without room for a body, else the number of sensors.
    #[serde(with = "serde_bytes")]
    #[ts(type = "Uint8Array")]
    pub cells: Vec<u8>,
    pub whole: FloorView,
    pub rooms: Vec<FloorView>,
    /// The sensors with a field, in the order of the home's file.
    pub sensors: Vec<SensorCoverage>,
    /// Pairs of sensors and their common floor, the largest first.
    #[ts(type = "Array<[string, string, number]>")]
    pub overlaps: Vec<(String, String, f64)>,
    /// The largest first.
    pub dead_zones: Vec<DeadZoneView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FloorView {
    pub name: String,
    pub floor_m2: f64,
    /// The shares with no, one, two, and three or more sensors.
    pub seen_by: [f64; 4],
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DeadZoneView {
    /// From 1, the largest first.
    pub number: u32,
    pub room: Option<String>,
    pub area_m2: f64,
    pub middle: At,
    pub outline: Vec<At>,
    pub holes: Vec<Vec<At>>,
}

/// A home from a file of another program.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ImportView {
    /// As a home's file.
    pub text: String,
    /// Omissions and guesses, in sentences.
    pub remarks: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Explain {
    pub draft: Draft,
    pub file: String,
}

/// The meaning of a routine, and completions for its words.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct ExplainView {
    /// Of the routine's file and its conditions only.
    pub problems: Vec<ProblemView>,
    /// The date of the scenario's first day, and the number of its days; empty for an invalid scenario.
    pub first: String,
    pub days: u32,
    /// Whether the text is in another language than English, which forms write.
    pub is_foreign: bool,
    pub sentences: Vec<SentenceView>,
    /// The defaults for what the routine does not say.
    pub unsaid: Vec<SentenceView>,
    pub conditions: Vec<ConditionView>,
    pub words: Vec<Completion>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SentenceView {
    /// From 1.
    pub line: u32,
    /// The words of the routine.
    pub said: String,
    /// `person`, `habit`, `rule` or `change`.
    pub kind: String,
    pub what: String,
    pub days: String,
    pub when: String,
    /// The begin in seconds since midnight: the 5th percentile, the mean, the 95th percentile.
    pub start_s: Option<[f64; 3]>,
    /// The duration in seconds: the same three.
    pub lasts_s: Option<[f64; 3]>,
    pub in_words: String,
}

/// A condition in a routine.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ConditionView {
    pub name: String,
    /// For each day of the scenario, from 0 without the condition to 1 at moderate strength.
    pub severity: Vec<f64>,
    pub sentences: Vec<SentenceView>,
}

/// Days of a draft to be simulated without any file.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Month {
    pub draft: Draft,
    /// The first day, from 0.
    pub from: u32,
    /// At most 31.
    pub days: u32,
    /// Conditions to leave out.
    pub without: Vec<String>,
}

/// Days of a draft.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct MonthView {
    pub problems: Vec<ProblemView>,
    pub days: Vec<DateView>,
    pub residents: Vec<String>,
    pub activities: Vec<String>,
    /// For each resident begin, end and number of each activity.
    #[ts(type = "Array<Array<[number, number, number]>>")]
    pub spans: Vec<Vec<(i64, i64, u32)>>,
    pub rooms: Vec<String>,
    /// For each resident begin, end and number of each stay in a room.
    #[ts(type = "Array<Array<[number, number, number]>>")]
    pub stays: Vec<Vec<(i64, i64, u32)>>,
    /// The firings of motion sensors in each hour of the clock, by day.
    pub hours: Vec<Vec<u32>>,
    /// The place and reason of an early end, in sentences.
    pub cut: Option<String>,
}

/// The first rows of a log in the form of a logger's file.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RowsView {
    pub problems: Vec<ProblemView>,
    /// By destination of the log.
    pub places: Vec<PlaceRowsView>,
    /// The end of the simulation and its reason, in sentences.
    pub cut: Option<String>,
    /// The schemes of URLs, with descriptions.
    #[ts(type = "Array<[string, string]>")]
    pub kinds: Vec<(String, String)>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PlaceRowsView {
    /// The URL of the file.
    pub to: String,
    /// For databases.
    pub table: Option<String>,
    pub columns: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

/// A destination to be tried.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Connect {
    pub url: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ConnectView {
    pub works: bool,
    /// The result, or the reason of a failure with a hint.
    pub said: String,
    /// The stable code of a failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub code: Option<String>,
}

/// Figures of the log of the run on the stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct LiveCountsView {
    /// The firings of motion sensors in each hour of the clock, by day.
    pub hours: Vec<Vec<u32>>,
    /// Instant and sensor of each firing of the last day.
    #[ts(type = "Array<[number, number]>")]
    pub today: Vec<(i64, u32)>,
    /// The number of firings of that day that `today` leaves out.
    #[ts(type = "number")]
    pub left_out: u64,
}
