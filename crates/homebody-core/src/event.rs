//! What comes out of the world: firings, and apart from them the truth.

use crate::camera::silhouette::Picture;
use crate::deed::Deed;
use crate::ids::{ResidentId, RoomId, SensorId, ThingId};
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
    /// Whose message it is.
    pub sensor: SensorId,
    /// What the sensor said.
    pub value: Value,
}

/// What a sensor says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Value {
    /// That it saw movement; a motion sensor has no more to say.
    Fire,
    /// It is on, began or is under way: an appliance, water, a load on a mat, heat.
    On,
    /// What was on is over.
    Off,
    /// A door or a piece of furniture was opened.
    Open,
    /// It was closed.
    Close,
    /// Somebody has come into the bed, which was empty.
    In,
    /// Nobody is in the bed any more.
    Out,
    /// How restless somebody in bed is, from 1 to 4.
    Restless(u8),
    /// Where the pulse of who lies still in the bed is beside what is normal.
    Pulse(Band),
    /// Where their respiration is beside what is normal.
    Respiration(Band),
    /// A camera woke.
    Woke,
    /// It sees somebody, whom it did not see before.
    Seen,
    /// It sleeps.
    Slept,
    /// A number, in thousandths of the sensor's unit.
    Reading(i32),
}

/// Where a number lies beside what is normal.
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
    /// Whose doing it was, if it was anybody's.
    pub resident: Option<ResidentId>,
    /// When what it was began to be noticed.
    pub seen_at: RunTime,
    /// What kind of cause it was.
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
    Provenance {
        /// The firing's number in the run.
        seq: u64,
        /// Why it came.
        provenance: Provenance,
    },
    /// What a sensor said at `at`, or should have said, that never reached the logger.
    Lost {
        /// When it said so, or should have.
        at: RunTime,
        /// Whose message it is.
        sensor: SensorId,
        /// What it said, or should have said.
        value: Value,
        /// Why it would have come.
        provenance: Provenance,
        /// What became of it.
        loss: Loss,
    },
    /// What a resident's body did over a span, told when that is over: the spans of a resident follow each other without
    /// gaps, and no two that follow each other are the same rest, in-place motion or absence.
    Movement {
        /// Whose body it is.
        resident: ResidentId,
        /// From when.
        begin: RunTime,
        /// Until when; the next span begins at this instant.
        end: RunTime,
        /// What the body did.
        doing: MotionState,
        /// How it held itself.
        posture: Posture,
    },
    /// From `at` on, the resident is in this room, or in none: between
    /// rooms or away.
    Room {
        /// Who came there.
        resident: ResidentId,
        /// From when on.
        at: RunTime,
        /// The room; `None` between rooms and away.
        room: Option<RoomId>,
    },
    /// From `at` on, the resident does this; nothing ends what was done before.
    Activity {
        /// Who does it.
        resident: ResidentId,
        /// From when on.
        at: RunTime,
        /// Its label, such as `sleeping`; `None` where nothing in particular is done.
        name: Option<String>,
    },
    /// A thing was used.
    Use {
        /// Who used it; `None` where it was nobody who lives there or visits.
        resident: Option<ResidentId>,
        /// When.
        at: RunTime,
        /// The thing, and how it is afterwards.
        act: ThingUse,
    },
    /// How strong a need of a resident is, from 0 (met) to 1 (pressing).
    Need {
        /// Whose need it is.
        resident: ResidentId,
        /// When.
        at: RunTime,
        /// What is needed.
        need: BodilyNeed,
        /// From 0, met, to 1, pressing.
        level: f64,
    },
    /// From `at` on, until it is told again, a resident's condition is this severe; 1 is a moderate case.
    Condition {
        /// Who has it.
        resident: ResidentId,
        /// From when on.
        at: RunTime,
        /// The condition, as the routine calls it.
        name: String,
        /// 1 is a moderate case, 0 none.
        severity: f64,
    },
    /// Something was done from outside. Of who falls, no room holds that was told for an instant after this.
    Outside {
        /// When.
        at: RunTime,
        /// What.
        deed: Deed,
    },
}

/// Using a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ThingUse {
    /// The door, piece of furniture or lamp that is used.
    pub thing: ThingId,
    /// How it is afterwards: on or open, or off or closed.
    pub on: bool,
}

/// What builds up until something is done about it.
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

/// A picture that a camera keeps: a silhouette in which somebody is seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// When it was taken.
    pub at: RunTime,
    /// The camera.
    pub sensor: SensorId,
    /// What it kept.
    pub picture: Picture,
}

/// What an advance of a run has brought: firings and pictures in order of time, facts in the order in which they came to be known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Events {
    /// What reached the logger, in order of time.
    pub firings: Vec<Firing>,
    /// The truth, in the order in which it came to be known.
    pub facts: Vec<Fact>,
    /// What cameras keep, in order of time.
    pub frames: Vec<Frame>,
}

impl Events {
    /// How many firings, facts and pictures there are together.
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
