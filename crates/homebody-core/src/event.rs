//! The output of the world: firings, and separately the truth.

use crate::camera::silhouette::Picture;
use crate::ids::{ResidentId, RoomId, SensorId, ThingId};
use crate::intervention::Intervention;
use crate::motion::MotionState;
use crate::posture::Posture;
use crate::time::RunTime;
use std::fmt;

/// One message of a sensor as it reaches the logger. Never holds ground truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Firing {
    /// The run's firings are numbered from 0, in order of time and, at one instant, of sensors.
    pub seq: u64,
    /// The time that the log gives it.
    pub at: RunTime,
    /// The sensor that sent the message.
    pub sensor: SensorId,
    /// The value of the message.
    pub value: Value,
}

/// A value of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Value {
    /// That it saw movement; a motion sensor has no more to say.
    Fire,
    /// It is on, began or is under way: an appliance, water, a load on a mat, heat.
    On,
    /// The detection, the use or the pressure is over.
    Off,
    /// A door or a piece of furniture was opened.
    Open,
    /// It was closed.
    Close,
    /// A person has come into the empty bed.
    In,
    /// The bed is empty.
    Out,
    /// The level of restlessness in bed, from 1 to 4.
    Restless(u8),
    /// The pulse of a person who lies still in the bed, compared with the normal pulse.
    Pulse(Band),
    /// The respiration of this person, compared with the normal respiration.
    Respiration(Band),
    /// A camera woke.
    Woke,
    /// It sees a person, after a time without any.
    Seen,
    /// It sleeps.
    Slept,
    /// A number, in thousandths of the sensor's unit.
    Reading(i32),
}

/// A number compared with the limits of normal numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Band {
    /// Below the lower limit of the sensor.
    Low,
    /// Between the limits, both included.
    Normal,
    /// Above the upper limit of the sensor.
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
            Value::Woke => f.write_str("WOKE"),
            Value::Seen => f.write_str("SEEN"),
            Value::Slept => f.write_str("SLEPT"),
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
    /// The resident who caused it, if any.
    pub resident: Option<ResidentId>,
    /// When what it was began to be noticed.
    pub seen_at: RunTime,
    /// The kind of cause.
    pub trigger: Trigger,
}

/// A kind of cause.
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
    /// Its id was garbled into an id of no sensor.
    Garbled,
    /// The logger was not running.
    Outage,
}

/// One piece of ground truth.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each variant says what its data are")]
pub enum Fact {
    /// Why a firing came: whose movement the sensor saw, and when it saw it.
    Provenance {
        /// The firing's number in the run.
        seq: u64,
        provenance: Provenance,
    },
    /// A message that a sensor sent at `at`, or should have sent, and that never reached the logger.
    Lost {
        /// When it said so, or should have.
        at: RunTime,
        sensor: SensorId,
        value: Value,
        /// Why it would have come.
        provenance: Provenance,
        loss: Loss,
    },
    /// A resident's movement over a span, reported at its end. The spans of a resident follow each other without gaps,
    /// and no two successive ones are the same rest, in-place motion or absence.
    Movement {
        resident: ResidentId,
        begin: RunTime,
        /// Until when; the next span begins at this instant.
        end: RunTime,
        doing: MotionState,
        posture: Posture,
    },
    /// From `at` on, the resident is in this room, or in none: between rooms or away.
    Room { resident: ResidentId, at: RunTime, room: Option<RoomId> },
    /// From `at` on, the resident does this; nothing ends what was done before.
    Activity {
        resident: ResidentId,
        at: RunTime,
        /// Its label, such as `sleeping`; `None` where nothing in particular is done.
        name: Option<String>,
    },
    /// A thing was used.
    Use {
        /// The user; `None` if no resident or visitor used it.
        resident: Option<ResidentId>,
        at: RunTime,
        act: ThingUse,
    },
    /// The strength of a resident's need, from 0 (met) to 1 (pressing).
    Need { resident: ResidentId, at: RunTime, need: BodilyNeed, level: f64 },
    /// The severity of a resident's condition from `at` until the next report; 1 is a moderate case.
    Condition {
        resident: ResidentId,
        at: RunTime,
        /// The condition, as the routine calls it.
        name: String,
        severity: f64,
    },
    /// An intervention from outside. If a resident falls, rooms reported for a later instant do not hold any more.
    Outside { at: RunTime, intervention: Intervention },
}

/// Using a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ThingUse {
    /// The door, piece of furniture or lamp that is used.
    pub thing: ThingId,
    /// The state afterwards: on or open, or off or closed.
    pub on: bool,
}

/// A need that builds up until it is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum BodilyNeed {
    /// To go to the toilet.
    Toilet,
    /// To drink.
    Thirst,
    /// To eat.
    Hunger,
    /// To rest or sleep.
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

/// A picture that a camera keeps: a silhouette with a person in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// When it was taken.
    pub at: RunTime,
    /// The camera.
    pub sensor: SensorId,
    /// The silhouette.
    pub picture: Picture,
}

/// The output of an advance of a run: firings and pictures in order of time, facts in the order in which they became
/// known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Events {
    /// The messages that reached the logger, in order of time.
    pub firings: Vec<Firing>,
    /// The truth, in the order in which it became known.
    pub facts: Vec<Fact>,
    /// The pictures of cameras, in order of time.
    pub frames: Vec<Frame>,
}

impl Events {
    /// The number of firings, facts and pictures together.
    pub fn len(&self) -> usize {
        self.firings.len() + self.facts.len() + self.frames.len()
    }

    /// Whether nothing has happened.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Takes away all firings, facts and pictures, and keeps the memory for the next advance.
    pub fn clear(&mut self) {
        self.firings.clear();
        self.facts.clear();
        self.frames.clear();
    }
}
