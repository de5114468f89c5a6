//! What is said about files that somebody writes in the page: drafts, until they are saved.

use super::{At, DateView, HomeView};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use ts_rs::TS;

/// The files of the scenario's folder, as they are on disk.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FilesView {
    /// The scenario's own file; those that follow are the ones that it links, as far as it can be read.
    pub entry: String,
    pub home: Option<String>,
    pub logger: Option<String>,
    pub lives: Vec<LivesView>,
    pub files: Vec<FileView>,
}

/// How a picture of the scenario's folder lies below the plan: its file `underlay.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct UnderlayView {
    /// The name of the picture's file beside it.
    pub picture: String,
    /// Where its middle is, in metres.
    pub at: [f64; 2],
    pub width_m: f64,
    /// Against the clock.
    #[serde(default)]
    pub turn_deg: f64,
}

/// A resident who lives by a routine.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LivesView {
    pub name: String,
    /// The name of the routine's file.
    pub routine: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FileView {
    pub name: String,
    pub text: String,
    /// A sign of what is on disk: another text has another version.
    pub version: String,
}

/// Texts that take the places of files, by name; what is not named is as it is on disk.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Draft {
    pub texts: BTreeMap<String, String>,
}

/// Texts to be written; none is where one of the files has changed.
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
    /// The version that the text was made from; nothing for a file that is not there yet.
    pub version: Option<String>,
}

/// What came of saving.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SavedView {
    /// The new versions by name; empty where nothing was written.
    pub saved: BTreeMap<String, String>,
    /// What is on disk where it is not what the texts were made from.
    pub changed: Vec<FileView>,
}

/// What is wrong with a scenario, and what is hardly meant.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CheckView {
    pub problems: Vec<ProblemView>,
    pub warnings: Vec<ProblemView>,
}

/// What has a name in a scenario.
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

/// A thing is to be called otherwise.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Rename {
    pub draft: Draft,
    pub kind: Named,
    pub from: String,
    pub to: String,
}

/// Things that are to go.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Forget {
    pub draft: Draft,
    pub kind: Named,
    pub names: Vec<String>,
}

/// Where things are named.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct NamesView {
    pub mentions: Vec<MentionView>,
    /// The texts that change, as they are then.
    pub texts: BTreeMap<String, String>,
    /// Whether another thing of its kind has one of both names: then nothing else is renamed.
    pub is_shared: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct MentionView {
    pub file: String,
    /// From 1.
    pub line: u32,
    /// The line, cut where it is long.
    pub said: String,
    /// Whether it goes with the thing in `texts`; what does not is left to whoever writes the file.
    pub goes: bool,
}

/// A mend of what is wrong and has one answer.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct MendView {
    /// What is done, as a button says it.
    pub what: String,
    /// The texts that change, as they are then.
    pub texts: BTreeMap<String, String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ProblemView {
    /// The stable code, such as `home::rooms-overlap`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub code: Option<String>,
    pub file: String,
    /// From 1; 0 where the file as a whole is meant.
    pub line: u32,
    /// In characters, from 1; 0 where the file as a whole is meant.
    pub column: u32,
    /// How many characters are meant.
    pub width: u32,
    pub what: String,
    pub hint: Option<String>,
    /// The change that solves it, where there is one.
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

/// A home that is being drawn.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PlanView {
    /// Of the home's file alone.
    pub problems: Vec<ProblemView>,
    /// Nothing where there are problems.
    pub home: Option<HomeView>,
    pub coverage: Option<CoverageView>,
}

/// Where in a home the sensors see a body that stands. Areas are square metres, shares 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct CoverageView {
    /// The side of a cell.
    pub step_m: f64,
    /// The south-west corner of the first cell.
    pub corner: At,
    pub columns: u32,
    /// Row by row from the south-west, a byte each: 255 where no body can stand, else how many sensors see it.
    #[serde(with = "serde_bytes")]
    #[ts(type = "Uint8Array")]
    pub cells: Vec<u8>,
    pub whole: FloorView,
    pub rooms: Vec<FloorView>,
    /// Of those that look; in the order of the home's file.
    pub sensors: Vec<SeenView>,
    /// Pairs of sensors and the floor that both see, the largest first.
    #[ts(type = "Array<[string, string, number]>")]
    pub overlaps: Vec<(String, String, f64)>,
    /// The largest first.
    pub dead_zones: Vec<DeadZoneView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FloorView {
    pub name: String,
    pub floor_m2: f64,
    /// Shares that are seen by none, one, two, and three or more.
    pub seen_by: [f64; 4],
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SeenView {
    pub name: String,
    pub seen_m2: f64,
    /// The part of it that no other sensor sees.
    pub alone_m2: f64,
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

/// A home made from another program's file.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ImportView {
    /// The text of a home's file.
    pub text: String,
    /// What was left out or guessed, in sentences.
    pub remarks: Vec<String>,
}

/// A routine among the files that is asked about.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Explain {
    pub draft: Draft,
    pub file: String,
}

/// How a routine was understood, and what can be said in it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct ExplainView {
    /// Of the routine's file and the conditions it shows; empty does not mean that other files are right.
    pub problems: Vec<ProblemView>,
    /// The date of the scenario's first day, and how many days it has; none where it cannot be read.
    pub first: String,
    pub days: u32,
    pub sentences: Vec<SentenceView>,
    /// What is left unsaid and goes as it usually does.
    pub unsaid: Vec<SentenceView>,
    pub conditions: Vec<ConditionView>,
    /// What may be written, for completion.
    pub words: Vec<WordView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SentenceView {
    /// From 1.
    pub line: u32,
    /// The words it was understood from.
    pub said: String,
    /// `person`, `habit`, `rule` or `change`.
    pub kind: String,
    pub what: String,
    pub days: String,
    pub when: String,
    /// When it begins, in seconds since midnight: one in twenty begins before the first, the mean, one in twenty after the last.
    pub start_s: Option<[f64; 3]>,
    /// How long it lasts, in the same way.
    pub lasts_s: Option<[f64; 3]>,
    pub in_words: String,
}

/// A condition that a routine shows.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ConditionView {
    pub name: String,
    /// How severe it is on each day of the scenario: 0 where it is not there, 1 at its moderate full strength.
    pub severity: Vec<f64>,
    pub sentences: Vec<SentenceView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct WordView {
    /// What is written.
    pub text: String,
    pub kind: WordKind,
    /// What it says, in a few words.
    pub about: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum WordKind {
    /// A whole sentence, as an example of its form.
    Sentence,
    /// What somebody does: `watches television`.
    Activity,
    /// When, how long or how often: `in the morning`.
    Time,
    Place,
    Condition,
}

/// Days of a life that are asked for, without any file.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Month {
    pub draft: Draft,
    /// The first day, counted from 0.
    pub from: u32,
    /// At most 31.
    pub days: u32,
    /// Conditions that are left out.
    pub without: Vec<String>,
}

/// Some days of a life as a draft has it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct MonthView {
    /// Why there is none.
    pub problems: Vec<ProblemView>,
    pub days: Vec<DateView>,
    pub residents: Vec<String>,
    /// The names of activities.
    pub activities: Vec<String>,
    /// What each resident did: begin, end and the activity's number.
    #[ts(type = "Array<Array<[number, number, number]>>")]
    pub spans: Vec<Vec<(i64, i64, u32)>>,
    /// The names of rooms.
    pub rooms: Vec<String>,
    /// Where each resident was: begin, end and the room's number; away or between rooms there is none.
    #[ts(type = "Array<Array<[number, number, number]>>")]
    pub stays: Vec<Vec<(i64, i64, u32)>>,
    /// How often motion sensors fired in each hour of the clock, by day.
    pub hours: Vec<Vec<u32>>,
    /// Where and why it ends before the last day, in sentences.
    pub cut: Option<String>,
}

/// The first rows of a log, as the network that a logger's file describes would have them.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RowsView {
    pub problems: Vec<ProblemView>,
    /// One for each place that the log goes to.
    pub places: Vec<PlaceRowsView>,
    /// Until when rows were looked for and why no longer, in sentences.
    pub cut: Option<String>,
    /// How the URLs of places begin, and what each is.
    #[ts(type = "Array<[string, string]>")]
    pub kinds: Vec<(String, String)>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PlaceRowsView {
    /// The URL as the file has it.
    pub to: String,
    /// Of a database.
    pub table: Option<String>,
    pub columns: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

/// A place for a log that is to be tried.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Connect {
    pub url: String,
}

/// Whether a place takes a log.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ConnectView {
    pub works: bool,
    /// What was found there, or why it does not work and what to do.
    pub said: String,
    /// The stable code of the message, where it does not work.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub code: Option<String>,
}

/// What the log of the run that is being lived has got so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct GrowthView {
    /// How often motion sensors fired in each hour of the clock, by day.
    pub hours: Vec<Vec<u32>>,
    /// The firings of the day that is being lived: instant and sensor.
    #[ts(type = "Array<[number, number]>")]
    pub today: Vec<(i64, u32)>,
    /// How many firings of that day are not in `today`.
    #[ts(type = "number")]
    pub left_out: u64,
}
