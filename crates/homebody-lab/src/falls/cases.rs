//! What somebody does in a case: falls, or what looks like one.

use homebody_core::geometry::point;
use homebody_core::random::Stream;
use serde::Serialize;
use serde_json::{Value, json};

/// Who falls lies there for a time between these, in seconds: 2 to 59 minutes had 26 falls of old people before cameras, 28 on
/// average of those who called nobody (Vlaeyen et al. 2013).
const LIES_S: [f64; 2] = [120.0, 3540.0];

/// Seconds between the movements of half of those who lie on the floor (our choice): after such falls, most people
/// move.
const STIRS_S: [f64; 2] = [45.0, 180.0];

/// What somebody does in a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Case {
    /// Falls while walking.
    FallsWalking,
    /// Falls from standing.
    FallsStanding,
    /// Falls while rising from the armchair.
    FallsRising,
    /// Falls out of bed.
    FallsFromBed,
    /// Sinks to the knees, and to the floor.
    SinksDown,
    /// Lies down on the floor to exercise, and rests there.
    Exercises,
    /// Kneels for a while.
    Kneels,
    /// Sits in the armchair, now and then without a stir for minutes.
    Sits,
    /// Sits at the table, where no sensor of its own looks.
    SitsAtTable,
    /// Bends to something low, again and again.
    Bends,
    /// Lies down on the bed.
    GoesToBed,
    /// Kneels down quickly to pick something up, and rises.
    PicksUp,
    /// A cat comes by, and lies down.
    Cat,
}

/// What happens in a case.
pub(super) struct Story {
    /// The path.
    pub path: Value,
    /// How long all of it takes, in seconds.
    pub length_s: f64,
}

impl Case {
    /// All of them, falls first.
    pub const ALL: [Case; 13] = [
        Case::FallsWalking,
        Case::FallsStanding,
        Case::FallsRising,
        Case::FallsFromBed,
        Case::SinksDown,
        Case::Exercises,
        Case::Kneels,
        Case::Sits,
        Case::SitsAtTable,
        Case::Bends,
        Case::GoesToBed,
        Case::PicksUp,
        Case::Cat,
    ];

    /// Whether it is a fall.
    pub fn is_fall(self) -> bool {
        self < Case::Exercises
    }

    /// How often a day somebody does it in view of the cameras, by our own guess; 0 for falls.
    pub fn per_day(self) -> f64 {
        match self {
            Case::Exercises => 0.3,
            Case::Kneels => 1.0,
            Case::Sits => 3.0,
            Case::SitsAtTable => 3.0,
            Case::Bends => 10.0,
            Case::GoesToBed => 1.5,
            Case::PicksUp => 4.0,
            Case::Cat => 10.0,
            _ => 0.0,
        }
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Case::FallsWalking => "falls while walking",
            Case::FallsStanding => "falls from standing",
            Case::FallsRising => "falls while rising",
            Case::FallsFromBed => "falls out of bed",
            Case::SinksDown => "sinks down",
            Case::Exercises => "exercises on the floor",
            Case::Kneels => "kneels",
            Case::Sits => "sits in the armchair",
            Case::SitsAtTable => "sits at the table",
            Case::Bends => "bends",
            Case::GoesToBed => "goes to bed",
            Case::PicksUp => "picks something up",
            Case::Cat => "cat",
        }
    }

    /// What happens in a case.
    pub(super) fn story(self, stream: &mut Stream) -> Story {
        let mut telling = Telling { at: [4.4, 1.2], steps: Vec::new(), length_s: 0.0 };
        let (to, pace) = ([stream.between(1.6, 3.6), stream.between(1.3, 2.6)], stream.between(0.5, 1.2));
        match self {
            Case::FallsWalking => telling.go(to, pace).down(stream),
            Case::FallsStanding => telling.go(to, pace).busy(8.0, "standing").down(stream),
            Case::FallsRising => telling.go(ARMCHAIR, pace).busy(10.0, "sitting").shift([1.45, 1.2], 1.2).down(stream),
            Case::FallsFromBed => telling.go(BED, pace).busy(12.0, "lying").shift([1.4, 2.6], 0.8).down(stream),
            Case::SinksDown => telling.go(to, pace).busy(5.0, "kneeling").down(stream),
            Case::Exercises => {
                let rests = stream.between(60.0, 180.0);
                let busy = telling.go(to, pace).busy(6.0, "kneeling").busy(stream.between(60.0, 90.0), "lying");
                busy.still(rests, "lying").busy(5.0, "kneeling").busy(20.0, "standing")
            }
            Case::Kneels => telling.go(to, pace).busy(stream.between(20.0, 90.0), "kneeling").busy(10.0, "standing"),
            Case::Sits | Case::SitsAtTable => {
                let seat = if self == Case::Sits { ARMCHAIR } else { CHAIR };
                let (every, long) = (spread(stream, [60.0, 1800.0]), stream.between(2400.0, 3600.0));
                telling.go(seat, pace).busy(15.0, "sitting").stirring(long, every, "sitting").busy(5.0, "standing")
            }
            Case::Bends => {
                let telling = telling.go(to, pace).busy(4.0, "bending").busy(3.0, "standing").busy(8.0, "bending");
                telling.busy(3.0, "standing").busy(6.0, "bending").busy(3.0, "standing")
            }
            Case::GoesToBed => {
                let (every, long) = (spread(stream, [300.0, 1800.0]), stream.between(2400.0, 4800.0));
                telling.go(BED, pace).busy(15.0, "lying").stirring(long, every, "lying").busy(5.0, "standing")
            }
            Case::PicksUp => telling
                .go(to, pace)
                .busy(3.0, "kneeling")
                .busy(8.0, "standing")
                .busy(3.0, "kneeling")
                .busy(5.0, "standing"),
            Case::Cat => telling.go(to, pace).busy(60.0, "lying"),
        };
        let Telling { steps, length_s, .. } = telling;
        Story { path: json!({ "start": [4.4, 1.2], "steps": steps }), length_s }
    }
}

const ARMCHAIR: [f64; 2] = [0.8, 1.0];
const BED: [f64; 2] = [1.1, 3.4];
const CHAIR: [f64; 2] = [4.5, 2.7];

/// A time between two, as often around one of them as around any other of the same order.
fn spread(stream: &mut Stream, [least, most]: [f64; 2]) -> f64 {
    stream.between(least.ln(), most.ln()).exp()
}

/// A path as it is told.
struct Telling {
    at: [f64; 2],
    steps: Vec<Value>,
    length_s: f64,
}

impl Telling {
    fn step(&mut self, step: Value, lasts_s: f64) -> &mut Telling {
        self.steps.push(step);
        self.length_s += lasts_s;
        self
    }

    fn go(&mut self, to: [f64; 2], pace: f64) -> &mut Telling {
        let lasts_s = point(self.at).distance(point(to)) / pace;
        self.at = to;
        self.step(json!({ "go": { "to": [to], "pace_mps": pace } }), lasts_s)
    }

    /// Moves on in a given time, as somebody who loses their balance.
    fn shift(&mut self, to: [f64; 2], in_s: f64) -> &mut Telling {
        self.at = to;
        self.step(json!({ "go": { "to": [to], "in_s": in_s } }), in_s)
    }

    fn still(&mut self, for_s: f64, posture: &str) -> &mut Telling {
        self.step(json!({ "wait": { "for_s": for_s, "posture": posture } }), for_s)
    }

    fn stirring(&mut self, for_s: f64, every_s: f64, posture: &str) -> &mut Telling {
        // The first stir would come at once.
        let first_s = every_s.min(for_s / 2.0);
        let stir = json!({ "every_s": every_s, "for_s": 2.0 });
        self.still(first_s, posture);
        self.step(json!({ "wait": { "for_s": for_s - first_s, "posture": posture, "stir": stir } }), for_s - first_s)
    }

    fn busy(&mut self, for_s: f64, posture: &str) -> &mut Telling {
        let stir = json!({ "every_s": 3.0, "for_s": 1.5 });
        self.step(json!({ "wait": { "for_s": for_s, "posture": posture, "stir": stir } }), for_s)
    }

    /// Falls, lies there, and is helped up in the end.
    fn down(&mut self, stream: &mut Stream) -> &mut Telling {
        let lies_s = spread(stream, LIES_S);
        match stream.chance(0.5) {
            true => self.stirring(lies_s, spread(stream, STIRS_S), "down"),
            false => self.still(lies_s, "down"),
        };
        self.busy(5.0, "standing")
    }
}
