//! What the page and the server say to each other.
//!
//! The page's own types in `web/src/wire.ts` are made from these; a test keeps them so. Over the socket, what the page says is
//! JSON, a `Say` each; what it hears is JSON where it is a `Tell`, and MessagePack where it is a `Frame`. All the rest
//! is asked for by HTTP, and answered in JSON, or in MessagePack where it is large.
//!
//! Lengths are metres, angles degrees, instants whole microseconds since the run's start, which any number of JSON holds
//! exactly for two hundred years. Points are `[x, y]`, with y up on the plan.

mod care;
mod draft;
mod finding;
mod installing;
mod library;
mod silhouettes;

pub use care::*;
pub use draft::*;
pub use finding::*;
pub use installing::*;
pub use library::*;
pub use silhouettes::*;

use homebody_simulation::VariantOptions;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use ts_rs::TS;

/// A point on the plan, in metres.
pub type At = [f64; 2];

/// A home as it is drawn.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct HomeView {
    pub name: String,
    /// The lower left and the upper right corner of all there is.
    pub bounds: [At; 2],
    pub rooms: Vec<RoomView>,
    /// Walls, doors that are closed, and furniture: convex outlines.
    pub solids: Vec<SolidView>,
    pub doors: Vec<DoorView>,
    /// What can be used, in the order of [`Frame::on`].
    pub things: Vec<ThingView>,
    /// In the order in which firings count them.
    pub sensors: Vec<SensorView>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RoomView {
    pub name: String,
    pub outline: Vec<At>,
    /// Where its name goes.
    pub middle: At,
    /// The floor that it is on, in a home of several.
    pub floor: Option<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SolidView {
    pub kind: SolidKind,
    /// Of furniture.
    pub name: Option<String>,
    pub outline: Vec<At>,
    /// Whether bodies can be in it: a bed, a chair, a rug.
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
    /// Its jambs; a door that stands open is hinged at the first.
    pub from: At,
    pub to: At,
    pub open: bool,
    /// Whether it leads out of the home.
    pub outside: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ThingView {
    pub name: String,
    pub kind: ThingKind,
    pub at: At,
    /// What is done to it, and what undoes that: `Turn on`, `Turn off`.
    pub verbs: [String; 2],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum ThingKind {
    Door,
    Furniture,
    /// The lamp of a room, under the room's name.
    Lamp,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct SensorView {
    pub name: String,
    /// As its file says it: `motion`, `bed`, `contact`, ...
    pub kind: String,
    /// The room that it is in.
    pub room: Option<String>,
    pub at: At,
    /// Where it looks, counted from east against the clock; of sensors on walls.
    pub facing_deg: Option<f64>,
    /// The parts of its beams in which it sees a standing adult, from where to where; of sensors on walls.
    pub beams: Vec<[At; 2]>,
    /// What it sees from the ceiling, or the mat or bed that it feels.
    pub area: Option<Vec<At>>,
    /// Of cameras.
    pub camera: Option<CameraView>,
}

/// A run that is being lived, or about to be.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RunView {
    /// The name of its folder, if it is stored in one: what playback knows it by.
    pub id: Option<String>,
    pub scenario: String,
    pub home: HomeView,
    /// Residents first, then visitors and pets.
    pub residents: Vec<ResidentView>,
    /// Who is moved by keys.
    pub driven: Option<u32>,
    #[ts(type = "number")]
    pub length_us: i64,
    /// A number below 2^53.
    #[ts(type = "number")]
    pub seed: u64,
    /// Conditions that its residents show, or would if they were not left out.
    pub conditions: Vec<String>,
    /// Those that are left out.
    pub without: Vec<String>,
    /// By the clock on the wall.
    pub days: Vec<DateView>,
    /// From when to when the sun is down.
    #[ts(type = "Array<[number, number]>")]
    pub nights: Vec<(i64, i64)>,
    /// Where the log goes, as URLs.
    pub log: Vec<String>,
    /// Whether a recording is being lived again.
    pub replay: bool,
    /// The versions of the scenario's files that it goes by: what has another one now was saved since. Of a replay there are none.
    pub files: BTreeMap<String, String>,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ResidentView {
    pub name: String,
    pub radius_m: f64,
}

/// What a run looks like at an instant.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct Frame {
    #[ts(type = "number")]
    pub now_us: i64,
    /// The time on the home's clock, as `2009-03-02 07:12:03`.
    pub clock: String,
    pub state: State,
    /// How many seconds go by in a second; nothing where it goes as fast as it can.
    pub speed: Option<f64>,
    /// By resident; nothing for those who are out.
    pub bodies: Vec<Option<BodyView>>,
    /// The sensors that see somebody move.
    pub seeing: Vec<u32>,
    /// The things that are on, or open.
    pub on: Vec<u32>,
    /// The sine of the sun's height: below 0 it is dark.
    pub sun: f64,
    /// How many firings there have been.
    #[ts(type = "number")]
    pub told: u64,
    /// The same by sensor.
    #[ts(type = "Array<number>")]
    pub counts: Vec<u64>,
    /// The last of those since the frame before, in order.
    pub firings: Vec<FiringView>,
    /// The cameras, in the order of sensors.
    pub looks: Vec<LookView>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum State {
    Paused,
    Playing,
    /// It has come to its end, or was stopped; its files are complete.
    Over,
}

#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct BodyView {
    pub at: At,
    /// Where it faces, counted from east against the clock.
    pub heading_deg: f64,
    pub posture: Posture,
    pub room: Option<u32>,
    /// What the truth calls what it does.
    pub activity: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Posture {
    Standing,
    Sitting,
    Lying,
}

/// A firing, with the row that the log has of it.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct FiringView {
    #[ts(type = "number")]
    pub seq: u64,
    #[ts(type = "number")]
    pub at_us: i64,
    pub sensor: u32,
    pub value: String,
    /// Time, sensor and message as they are stored; nothing where no log is looked at.
    pub row: Option<[String; 3]>,
}

/// A run that is stored, as the list of them tells it.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct StoredView {
    /// The name of its folder.
    pub name: String,
    pub scenario: String,
    /// The local date and time of its start.
    pub start: String,
    pub days: u32,
    pub has_truth: bool,
    /// The name of the log that its path was made from by walking it back.
    pub walked_back: Option<String>,
    /// Why it cannot be played back.
    pub problem: Option<String>,
    /// The stable code of the problem.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub problem_code: Option<String>,
    /// When its files were begun, in milliseconds since 1970, where that is known.
    #[ts(type = "number | null")]
    pub made_ms: Option<i64>,
    /// A number below 2^53.
    #[ts(type = "number | null")]
    pub seed: Option<u64>,
    /// Conditions that are left out of it.
    pub without: Vec<String>,
    /// What somebody has called it, and noted about it.
    pub about: RunAbout,
}

/// What somebody calls a stored run, and notes about it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct RunAbout {
    /// At most 100 letters; none where it is known by its folder alone.
    pub title: String,
    /// At most 2,000 letters.
    pub note: String,
}

/// A run that was put aside, and can be fetched back.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, TS)]
pub struct PutAside {
    /// The name under which it is fetched back.
    pub key: String,
}

/// A stored run as a whole. Of what is told here and in its days, the truth is only there where the run has left one.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct PlaybackView {
    pub name: String,
    pub scenario: String,
    pub home: HomeView,
    /// In the order of [`DayView::lives`].
    pub residents: Vec<ResidentView>,
    /// The local date and time of its start.
    pub start: String,
    pub zone: String,
    #[ts(type = "number")]
    pub length_us: i64,
    /// What the log calls its sensors: those of the home in the home's order, then those that stand nowhere in it.
    pub sensors: Vec<String>,
    /// What sensors say in the log.
    pub values: Vec<String>,
    pub days: Vec<DateView>,
    /// How many rows the log has in each hour of the clock, by day.
    pub hours: Vec<Vec<u32>>,
    /// From when to when the sun is down.
    #[ts(type = "Array<[number, number]>")]
    pub nights: Vec<(i64, i64)>,
    pub has_truth: bool,
    /// The names of activities.
    pub activities: Vec<String>,
    /// What each resident did: begin, end and the activity's number. Of a long run the short ones are left out.
    #[ts(type = "Array<Array<[number, number, number]>>")]
    pub spans: Vec<Vec<(i64, i64, u32)>>,
    /// Of a log that was walked back: then the rows are those of the log as it was given, and instead of the truth there is
    /// what was made of them.
    pub walk: Option<WalkView>,
    /// Whether its cameras have kept silhouettes.
    pub has_silhouettes: bool,
    /// What is missing or was skipped, in sentences.
    pub remarks: Vec<String>,
    /// Up to when the log is read by now; what else is told of it here, its sensors, values and hours, is as far. `None` once all is read.
    #[ts(type = "number | null")]
    pub read_us: Option<i64>,
}

/// How far the log of a stored run is read that is open already.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct ReadingView {
    /// `None` once all of it is.
    #[ts(type = "number | null")]
    pub read_us: Option<i64>,
}

/// How often each sensor of a stored run spoke, in parts of it of equal length.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct LanesView {
    #[ts(type = "number")]
    pub bucket_us: i64,
    /// By sensor, from the run's start on.
    pub counts: Vec<Vec<u32>>,
}

/// What is known of a log that was walked back.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct WalkView {
    /// What the log was called.
    pub log: String,
    /// Where each resident most likely was: begin, end and the place's number, as chances have it. Short stays are left out.
    #[ts(type = "Array<Array<[number, number, number]>>")]
    pub stays: Vec<Vec<(i64, i64, i32)>>,
}

/// An instant, a place and how likely somebody is there from then on, from 0 to 1. A place is the number of the home's room, -1
/// for out, -2 for between the rooms.
pub type Chance = (i64, i32, f32);

/// The place of who is out.
pub const OUT: i32 = -1;

/// The place of who is at home between the rooms.
pub const BETWEEN: i32 = -2;

/// A day by the clock on the wall.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DateView {
    /// Such as `2009-03-02`.
    pub date: String,
    #[ts(type = "number")]
    pub begin_us: i64,
    #[ts(type = "number")]
    pub end_us: i64,
    /// The time on the clock when the day begins in the run: its first one may begin at noon.
    #[ts(type = "number")]
    pub clock_us: i64,
    /// When clocks are set in it, and by how much.
    #[ts(type = "[number, number] | null")]
    pub turn: Option<(i64, i64)>,
}

/// All of a day of a stored run. What somebody did may begin before the day and end after it.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct DayView {
    /// The log's rows: instant, sensor and value.
    #[ts(type = "Array<[number, number, number]>")]
    pub rows: Vec<(i64, u32, u32)>,
    /// By resident; of none where there is no truth.
    pub lives: Vec<LifeView>,
    /// Up to here movements are told; where that is not the day's end, the rest is asked for next.
    #[ts(type = "number")]
    pub until_us: i64,
}

/// Begin, end, what it was, in which posture, from where, to where.
pub type MovementView = (i64, i64, MotionState, Posture, Option<At>, Option<At>);

/// What somebody did, in the order of time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, TS)]
pub struct LifeView {
    /// Begin, end, what it was, in which posture, from where, to where.
    #[ts(type = "Array<[number, number, MotionState, Posture, [number, number] | null, [number, number] | null]>")]
    pub movements: Vec<MovementView>,
    /// Begin, end and the number of the home's room; between rooms there is none.
    #[ts(type = "Array<[number, number, number]>")]
    pub rooms: Vec<(i64, i64, u32)>,
    /// Begin, end and the activity's number.
    #[ts(type = "Array<[number, number, number]>")]
    pub activities: Vec<(i64, i64, u32)>,
    /// Of a log that was walked back: an instant, a place, and how likely somebody is there from then on. The place is the
    /// number of the home's room, -1 for out, -2 for between the rooms; those that are not told of have no chance.
    #[ts(type = "Array<[number, number, number]>")]
    pub chances: Vec<Chance>,
}

/// A log that somebody has opened in the page, on its way to be walked back.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct WalkingView {
    /// What it is called.
    pub log: String,
    pub state: WalkState,
    /// How much of it is done, from 0 to 1.
    pub share: f64,
    /// The run that came of it.
    pub run: Option<String>,
    /// Why none came of it.
    pub problem: Option<String>,
    /// The stable code of the problem.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub problem_code: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum WalkState {
    /// Not all of it has reached the server.
    Coming,
    Walking,
    Done,
    Failed,
    Stopped,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum MotionState {
    Stride,
    InPlace,
    Rest,
    Away,
}

/// What the page asks of the run. All pages have the same run.
#[derive(Clone, Debug, PartialEq, Deserialize, TS)]
#[serde(tag = "say", rename_all = "snake_case", deny_unknown_fields)]
pub enum Say {
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
        posture: Posture,
    },
    /// Let the resident who is moved by keys turn a thing on or off, or open or close it.
    Use {
        thing: u32,
        on: bool,
    },
    /// Start a new run, in which keys move a resident, or all residents follow the scenario.
    Start {
        driven: Option<u32>,
        #[serde(flatten)]
        variant: VariantOptions,
    },
    /// End the run, so that its files are complete.
    Stop,
    /// Replay the recording of a stored run.
    Replay {
        run: String,
    },
}

/// The keys that move a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Key {
    Up,
    Down,
    Left,
    Right,
    /// Twice the pace.
    Fast,
    /// Half the pace.
    Slow,
}

/// What the page hears besides frames.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
#[serde(tag = "tell", rename_all = "snake_case")]
pub enum Tell {
    /// A run has begun; frames that follow are of this one.
    Run { run: Box<RunView> },
    /// Something to read: what was done, or why it could not be, with the stable code of the message.
    Note {
        text: String,
        bad: bool,
        #[serde(skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        code: Option<String>,
    },
    /// No run could be begun, and what is wrong with the scenario. The run that there was, if there was one, is there still.
    Unbegun {
        why: String,
        problems: Vec<ProblemView>,
        #[serde(skip_serializing_if = "Option::is_none")]
        #[ts(optional)]
        code: Option<String>,
    },
}

/// The message of a refused request. The status of HTTP has its kind.
#[derive(Clone, Debug, PartialEq, Serialize, TS)]
pub struct RefusedView {
    /// The stable code, such as `page::no-run`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[ts(optional)]
    pub code: Option<String>,
    /// The message, as sentences.
    pub what: String,
    /// The values that the message quotes, by name.
    #[ts(type = "Record<string, unknown>")]
    pub data: Map<String, Value>,
}
