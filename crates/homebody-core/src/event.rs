//! What comes out of the world: firings, and apart from them the truth.

use crate::geometry::Point;
use crate::ids::{ResidentId, RoomId, SensorId, ThingId};
use crate::scenario::path::Posture;
use crate::time::Micros;
use std::fmt;

/// One message of a sensor as it reaches the logger. Never holds ground truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Firing {
    /// The run's firings are numbered from 0, in order of time and, at one instant, of sensors.
    pub seq: u64,
    /// The time that the log gives it.
    pub at: Micros,
    pub sensor: SensorId,
    pub value: Value,
}

/// What a sensor says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Value {
    /// That it saw movement; a motion sensor has no more to say.
    Fire,
    On,
    Off,
    Open,
    Close,
    /// Somebody is in the bed, or no longer.
    In,
    Out,
    /// How restless somebody in bed is, from 1 to 4.
    Restless(u8),
    Pulse(Band),
    Respiration(Band),
    /// A number, in thousandths of the sensor's unit.
    Reading(i32),
}

/// Where a number lies beside what is normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Band {
    Low,
    Normal,
    High,
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let band = |band: Band| match band {
            Band::Low => "LOW",
            Band::Normal => "NORMAL",
            Band::High => "HIGH",
        };
        match *self {
            Value::Fire | Value::On => f.write_str("ON"),
            Value::Off => f.write_str("OFF"),
            Value::Open => f.write_str("OPEN"),
            Value::Close => f.write_str("CLOSE"),
            Value::In => f.write_str("IN"),
            Value::Out => f.write_str("OUT"),
            Value::Restless(level) => write!(f, "RESTLESS_{level}"),
            Value::Pulse(of) => write!(f, "PULSE_{}", band(of)),
            Value::Respiration(of) => write!(f, "RESPIRATION_{}", band(of)),
            Value::Reading(thousandths) => {
                let sign = if thousandths < 0 { "-" } else { "" };
                let (whole, rest) = (thousandths.unsigned_abs() / 1000, thousandths.unsigned_abs() % 1000);
                match rest {
                    0 => write!(f, "{sign}{whole}"),
                    _ if rest % 100 == 0 => write!(f, "{sign}{whole}.{}", rest / 100),
                    _ if rest % 10 == 0 => write!(f, "{sign}{whole}.{:02}", rest / 10),
                    _ => write!(f, "{sign}{whole}.{rest:03}"),
                }
            }
        }
    }
}

/// Why a sensor fired.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// Whose doing it was, if it was anybody's.
    pub resident: Option<ResidentId>,
    /// When what it was began to be noticed.
    pub seen_at: Micros,
    pub trigger: Trigger,
}

/// What kind of cause it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trigger {
    /// A body moved, came or left.
    Movement,
    /// A thing was used.
    Use(ThingId),
    /// It was time for a reading, or what is measured has changed by itself.
    Reading,
    /// The message came twice.
    Duplicate,
    /// Nothing real: sun, warm air, a fault.
    False,
}

/// Why the logger never had a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Loss {
    /// By chance, on the way.
    Radio,
    /// Another sensor sent at the same time.
    Collision,
    /// The sensor did not notice.
    Miss,
    /// Its battery was empty.
    Battery,
    /// It had come off its place, or was elsewhere.
    Place,
    /// It was stuck.
    Stuck,
    /// Its id was garbled into one that nobody has.
    Garbled,
    /// The logger was not running.
    Outage,
}

/// One piece of ground truth.
#[derive(Clone, Debug, PartialEq)]
pub enum Fact {
    /// Why a firing came: whose movement the sensor saw, and when it saw it.
    Provenance { seq: u64, provenance: Provenance },
    /// What a sensor said at `at`, or should have said, that never reached the logger.
    Lost { at: Micros, sensor: SensorId, value: Value, provenance: Provenance, loss: Loss },
    /// What a resident's body did over a span, told when that is over: the spans of a resident follow each other without
    /// gaps, and no two that follow each other are the same rest, in-place motion or absence.
    Movement { resident: ResidentId, begin: Micros, end: Micros, doing: MotionState, posture: Posture },
    /// From `at` on, the resident is in this room, or in none: between
    /// rooms or away.
    Room { resident: ResidentId, at: Micros, room: Option<RoomId> },
    /// From `at` on, the resident does this; nothing ends what was done before.
    Activity { resident: ResidentId, at: Micros, name: Option<String> },
    /// A resident used a thing.
    Use { resident: ResidentId, at: Micros, act: ThingUse },
    /// How strong a need of a resident is, from 0 (met) to 1 (pressing).
    Need { resident: ResidentId, at: Micros, need: Need, level: f64 },
    /// From `at` on, until it is told again, a resident's condition is this severe; 1 is a moderate case.
    Condition { resident: ResidentId, at: Micros, name: String, severity: f64 },
}

/// Using a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ThingUse {
    pub thing: ThingId,
    /// How it is afterwards: on or open, or off or closed.
    pub on: bool,
}

/// What builds up until something is done about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Need {
    Toilet,
    Thirst,
    Hunger,
    Tiredness,
}

/// A heart and lungs, as a bed sensor feels them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vitals {
    /// Beats a minute.
    pub pulse: f64,
    /// Breaths a minute.
    pub respiration: f64,
}

/// What a body does over a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionState {
    /// A straight movement at constant speed.
    Stride { from: Point, to: Point },
    /// Movement on the spot: `amplitude_m` is how far what moves moves.
    InPlace { at: Point, amplitude_m: f64 },
    /// Keeping still.
    Rest { at: Point },
    /// Out of the home.
    Away,
}

/// What an advance of a run has brought: firings in order of time, facts in the order in which they came to be known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Events {
    pub firings: Vec<Firing>,
    pub facts: Vec<Fact>,
}

impl Events {
    pub fn clear(&mut self) {
        self.firings.clear();
        self.facts.clear();
    }
}
