//! The messages between the page and the server.
//!
//! The types of the page in `web/src/wire.ts` are made from these; a test compares them. Over the socket, the page sends a
//! `PageCommand` as JSON. The server sends a `RunNotice` as JSON and a `RunFrame` as MessagePack. Everything else goes over HTTP, and
//! large answers are MessagePack.
//!
//! Lengths are metres, angles degrees, and instants whole microseconds since the start of the run, which a number of JSON holds
//! exactly for two hundred years. Points are `[x, y]`, with y up on the plan.

mod care;
mod draft;
mod free_text;
mod search;
mod installing;
mod library;
mod silhouettes;
mod statements;

pub use care::*;
pub use draft::*;
pub use free_text::*;
pub use installing::*;
pub use library::*;
pub use search::*;
pub use silhouettes::*;
pub use statements::*;

use homebody_log::MovementKind;
use homebody_simulation::RunOptions;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use ts_rs::TS;

pub type At = [f64; 2];

#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct HomeView {
    pub name: String,
    /// The lower left and the upper right corner of the plan.
    pub bounds: [At; 2],
    pub rooms: Vec<RoomView>,
    /// Walls, closed doors and furniture, as convex outlines.
    pub solids: Vec<SolidView>,
    pub doors: Vec<DoorView>,
    /// In the order of [`RunFrame::on`].
    pub things: Vec<ThingView>,
    /// In the order of the numbers of sensors.
    pub sensors: Vec<SensorView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RoomView {
    pub name: String,
    pub outline: Vec<At>,
    /// The place of its name.
    pub middle: At,
    /// In a home of several floors.
    pub floor: Option<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SolidView {
    pub kind: SolidKind,
    pub name: Option<String>,
    pub outline: Vec<At>,
    pub enterable: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum SolidKind {
    Wall,
    Door,
    Furniture,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DoorView {
    pub name: String,
    /// The jambs; an open door is hinged at the first.
    pub from: At,
    pub to: At,
    pub open: bool,
    pub outside: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ThingView {
    pub name: String,
    pub kind: ThingKind,
    pub at: At,
    /// The verbs that switch it on and off, such as `Turn on` and `Turn off`.
    pub verbs: [String; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum ThingKind {
    Door,
    Furniture,
    /// The lamp of a room, under the name of the room.
    Lamp,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SensorView {
    pub name: String,
    /// The key of its kind, such as `motion`, `bed` or `contact`.
    pub kind: String,
    pub room: Option<String>,
    pub at: At,
    /// Counted from east against the clock; for sensors on walls.
    pub facing_deg: Option<f64>,
    /// The parts of its beams that detect a standing adult; for sensors on walls.
    pub beams: Vec<[At; 2]>,
    /// The area of a ceiling sensor, or the mat or bed.
    pub area: Option<Vec<At>>,
    pub camera: Option<CameraView>,
}

/// The run that pages show.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RunView {
    /// The name of its folder, once it has one.
    pub id: Option<String>,
    pub scenario: String,
    pub home: HomeView,
    /// Residents first, then visitors and pets.
    pub residents: Vec<ResidentView>,
    /// The resident that keys move.
    pub driven: Option<u32>,
    #[ts(type = "number")]
    pub length_us: i64,
    /// Below 2^53.
    #[ts(type = "number")]
    pub seed: u64,
    /// All conditions of its residents, with those that are left out.
    pub conditions: Vec<String>,
    pub without: Vec<String>,
    pub days: Vec<DateView>,
    /// The intervals in which the sun is down.
    #[ts(type = "Array<[number, number]>")]
    pub nights: Vec<(i64, i64)>,
    /// The destinations of the log, as URLs.
    pub log: Vec<String>,
    pub replay: bool,
    /// The versions of the scenario's files at the start of the run; none for a replay.
    pub files: BTreeMap<String, String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ResidentView {
    pub name: String,
    pub radius_m: f64,
}

/// The state of a run at an instant.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RunFrame {
    #[ts(type = "number")]
    pub now_us: i64,
    /// The time on the home's clock, as `2009-03-02 07:12:03`.
    pub clock: String,
    pub state: RunState,
    /// In simulated seconds a second; null for as fast as possible.
    pub speed: Option<f64>,
    /// By resident; null for those who are out.
    pub bodies: Vec<Option<BodyView>>,
    /// The sensors that detect movement.
    pub seeing: Vec<u32>,
    /// The things that are on or open.
    pub on: Vec<u32>,
    /// The sine of the sun's height: below 0 it is dark.
    pub sun: f64,
    /// The number of rows of the log so far.
    #[ts(type = "number")]
    pub told: u64,
    /// The same by sensor.
    #[ts(type = "Array<number>")]
    pub counts: Vec<u64>,
    /// The latest rows since the frame before, in order.
    pub firings: Vec<FiringView>,
    /// In the order of sensors.
    pub looks: Vec<CameraStateView>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum RunState {
    Paused,
    Playing,
    /// At its end or stopped; its files are complete.
    Over,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct BodyView {
    pub at: At,
    /// Counted from east against the clock.
    pub heading_deg: f64,
    pub posture: MapPosture,
    pub room: Option<u32>,
    /// The label of the ground truth.
    pub activity: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum MapPosture {
    Standing,
    Sitting,
    Lying,
}

/// A firing with its row of the log.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FiringView {
    #[ts(type = "number")]
    pub seq: u64,
    #[ts(type = "number")]
    pub at_us: i64,
    pub sensor: u32,
    pub value: String,
    /// Time, sensor and message as they are stored; null without a log.
    pub row: Option<[String; 3]>,
}

/// A stored run in a list.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct StoredView {
    /// The name of its folder.
    pub name: String,
    pub scenario: String,
    /// Local date and time.
    pub start: String,
    pub days: u32,
    pub has_truth: bool,
    /// The name of the log that was located for its path.
    pub walked_back: Option<String>,
    /// The reason why playback is not possible.
    pub problem: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub problem_code: Option<String>,
    /// The time when its files were created, in milliseconds since 1970.
    #[ts(type = "number | null")]
    pub made_ms: Option<i64>,
    /// Below 2^53.
    #[ts(type = "number | null")]
    pub seed: Option<u64>,
    pub without: Vec<String>,
    pub about: RunAbout,
}

/// The title and the note that a person gave a stored run.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct RunAbout {
    /// At most 100 characters; empty for a run without a title.
    pub title: String,
    /// At most 2,000 characters.
    pub note: String,
}

/// The key of a deleted run or home, by which it is restored.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, TS)]
pub struct DeletedKey {
    pub key: String,
}

/// A stored run as a whole. Only a run with ground truth has the parts that come from it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct PlaybackView {
    pub name: String,
    pub scenario: String,
    pub home: HomeView,
    /// In the order of [`DayView::lives`].
    pub residents: Vec<ResidentView>,
    /// Local date and time.
    pub start: String,
    pub zone: String,
    #[ts(type = "number")]
    pub length_us: i64,
    /// The sensors of the log: those of the home in its order, then those without a place in it.
    pub sensors: Vec<String>,
    /// The messages of the sensors.
    pub values: Vec<String>,
    pub days: Vec<DateView>,
    /// The number of rows in each hour of the clock, by day.
    pub hours: Vec<Vec<u32>>,
    /// The intervals in which the sun is down.
    #[ts(type = "Array<[number, number]>")]
    pub nights: Vec<(i64, i64)>,
    pub has_truth: bool,
    pub activities: Vec<String>,
    /// For each resident begin, end and number of each activity. A long run has only the longest.
    #[ts(type = "Array<Array<[number, number, number]>>")]
    pub spans: Vec<Vec<(i64, i64, u32)>>,
    /// For a located log: the rows are those of the original log, and the estimates replace the ground truth.
    pub walk: Option<LocatedView>,
    pub has_silhouettes: bool,
    /// Missing or skipped data, in sentences.
    pub remarks: Vec<String>,
    /// The end of the part that is read so far, with its sensors, values and hours; null once all is read.
    #[ts(type = "number | null")]
    pub read_us: Option<i64>,
}

/// The progress of reading the log of an open run.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ReadingView {
    /// Null once all is read.
    #[ts(type = "number | null")]
    pub read_us: Option<i64>,
}

/// The number of events of each sensor, in parts of the run of equal length.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LanesView {
    #[ts(type = "number")]
    pub bucket_us: i64,
    /// By sensor, from the start of the run.
    pub counts: Vec<Vec<u32>>,
}

/// The estimates for a located log.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LocatedView {
    /// The name of the log.
    pub log: String,
    /// The most likely place of each resident: begin, end and number as in chances, without short stays.
    #[ts(type = "Array<Array<[number, number, number]>>")]
    pub stays: Vec<Vec<(i64, i64, i32)>>,
}

/// An instant, a place and the probability of a person there from then on. A place is the number of the home's room, [`OUT`] or
/// [`BETWEEN`].
pub type Chance = (i64, i32, f32);

/// The place outside the home.
pub const OUT: i32 = -1;

/// The place between the rooms.
pub const BETWEEN: i32 = -2;

/// A civil day.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DateView {
    /// Such as `2009-03-02`.
    pub date: String,
    #[ts(type = "number")]
    pub begin_us: i64,
    #[ts(type = "number")]
    pub end_us: i64,
    /// The time on the clock at `begin_us`: the first day may begin at noon.
    #[ts(type = "number")]
    pub clock_us: i64,
    /// The instant at which clocks are set, and by how much.
    #[ts(type = "[number, number] | null")]
    pub turn: Option<(i64, i64)>,
}

/// A day of a stored run. Its spans may begin before the day and end after it.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DayView {
    /// Instant, sensor and value of each row of the log.
    #[ts(type = "Array<[number, number, number]>")]
    pub rows: Vec<(i64, u32, u32)>,
    /// By resident; empty without ground truth.
    pub lives: Vec<PersonDay>,
    /// The end of the movements here; if it is before the end of the day, the page requests the rest.
    #[ts(type = "number")]
    pub until_us: i64,
}

/// Begin, end, kind, posture, from, to.
pub type MovementView = (i64, i64, MovementKind, MapPosture, Option<At>, Option<At>);

/// The ground truth about a person, in the order of time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct PersonDay {
    /// Begin, end, kind, posture, from, to.
    #[ts(type = "Array<[number, number, MovementKind, MapPosture, [number, number] | null, [number, number] | null]>")]
    pub movements: Vec<MovementView>,
    /// Begin, end and number of the home's room; nothing between rooms.
    #[ts(type = "Array<[number, number, number]>")]
    pub rooms: Vec<(i64, i64, u32)>,
    /// Begin, end and number of the activity.
    #[ts(type = "Array<[number, number, number]>")]
    pub activities: Vec<(i64, i64, u32)>,
    /// For a located log: instant, place and probability of a person there from then on. The place is the number of the home's room,
    /// -1 for out, -2 for between the rooms; places that are not listed have none.
    #[ts(type = "Array<[number, number, number]>")]
    pub chances: Vec<Chance>,
}

/// A log that the page has opened and the server locates.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LocatingView {
    pub log: String,
    pub state: LocatingState,
    /// The completed share, from 0 to 1.
    pub share: f64,
    /// The resulting run.
    pub run: Option<String>,
    /// The reason of a failure.
    pub problem: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub problem_code: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum LocatingState {
    /// The server is receiving the log.
    Coming,
    Walking,
    Done,
    Failed,
    Stopped,
}

/// A command of a page to the run. All pages have the same run.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(tag = "say", rename_all = "snake_case", deny_unknown_fields)]
pub enum PageCommand {
    /// The first message of a page, without which it gets no answer to others.
    Hello {
        token: String,
    },
    Play,
    Pause,
    /// Continue for so many seconds, then pause.
    Step {
        seconds: f64,
    },
    /// From 0.1 to 1000; null for as fast as possible.
    Speed {
        times: Option<f64>,
    },
    /// Go to an instant; back means to simulate again from the start, with the same input.
    Jump {
        #[ts(type = "number")]
        to_us: i64,
    },
    /// Hold exactly these keys from now on.
    Hold {
        keys: Vec<Key>,
    },
    /// Let the resident who is moved by keys sit, lie or stand from now on.
    Be {
        posture: MapPosture,
    },
    /// Let the resident who is moved by keys turn a thing on or off, or open or close it.
    Use {
        thing: u32,
        on: bool,
    },
    /// Start a new run, in which keys move a resident, or all residents follow the scenario.
    Start {
        driven: Option<u32>,
        #[serde(default)]
        #[ts(type = "Partial<RunOptions>")]
        options: RunOptions,
    },
    /// End the run, so that its files are complete.
    Stop,
    /// Replay the recording of a stored run.
    Replay {
        run: String,
    },
}

/// A key that moves a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Key {
    Up,
    Down,
    Left,
    Right,
    /// At twice the pace.
    Fast,
    /// At half the pace.
    Slow,
}

/// A message of the server besides frames.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
#[serde(tag = "tell", rename_all = "snake_case")]
pub enum RunNotice {
    /// A run has started; the following frames are of this one.
    Run { run: Box<RunView> },
    /// A text for the person at the page.
    Note {
        text: String,
        bad: bool,
        #[serde(skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        code: Option<String>,
    },
    /// No run could start because of problems with the scenario, or with an option of the run. The previous run continues.
    Unbegun {
        why: String,
        problems: Vec<ProblemView>,
        /// The name of the option.
        #[serde(skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        option: Option<String>,
        #[serde(skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        code: Option<String>,
    },
}

/// The message of a refused request; the status of HTTP has its kind.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RefusedView {
    /// The stable code, such as `page::no-run`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub code: Option<String>,
    /// In sentences.
    pub what: String,
    /// The values in the message, by name.
    #[ts(type = "Record<string, unknown>")]
    pub data: Map<String, Value>,
}
