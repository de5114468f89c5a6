use homebody_core::geometry::point;
use homebody_core::random::Stream;
use serde::Serialize;
use serde_json::{Value, json};

/// Shortest and longest time on the floor after a fall, in seconds: 26 falls of old people in view of cameras had 2 to 59 minutes,
/// and 28 minutes on average without a call for help (Vlaeyen et al. 2013).
const LIES_S: [f64; 2] = [120.0, 3540.0];

/// Seconds between the movements of half of those who lie on the floor (our choice): after such falls, most people
/// move.
const STIRS_S: [f64; 2] = [45.0, 180.0];

macro_rules! cases {
    ($($(#[$doc:meta])* $case:ident $name:literal $per_day:literal,)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
        #[serde(rename_all = "snake_case")]
        pub enum FallCase {
            $($(#[$doc])* $case,)*
        }

        /// Name, and number of times a day in view of the cameras (by our own guess; 0 for falls).
        const CASES: &[(&str, f64)] = &[$(($name, $per_day)),*];

        impl FallCase {
            pub const ALL: [FallCase; CASES.len()] = [$(FallCase::$case),*];
        }
    };
}

cases! {
    FallsWalking "falls while walking" 0.0,
    FallsStanding "falls from standing" 0.0,
    /// From the armchair.
    FallsRising "falls while rising" 0.0,
    FallsFromBed "falls out of bed" 0.0,
    /// To the knees, and to the floor.
    SinksDown "sinks down" 0.0,
    /// Lies down on the floor, and rests there.
    Exercises "exercises on the floor" 0.3,
    Kneels "kneels" 1.0,
    /// Sometimes without a movement for minutes.
    Sits "sits in the armchair" 3.0,
    /// No sensor watches this seat alone.
    SitsAtTable "sits at the table" 3.0,
    /// To something low, several times.
    Bends "bends" 10.0,
    GoesToBed "goes to bed" 1.5,
    /// Kneels down quickly, and rises.
    PicksUp "picks something up" 4.0,
    /// Passes, and lies down.
    Cat "cat" 10.0,
}

pub(super) struct Story {
    pub path: Value,
    pub length_s: f64,
}

impl FallCase {
    pub fn is_fall(self) -> bool {
        self < FallCase::Exercises
    }

    pub fn name(self) -> &'static str {
        CASES[self as usize].0
    }

    pub fn per_day(self) -> f64 {
        CASES[self as usize].1
    }

    pub(super) fn story(self, stream: &mut Stream) -> Story {
        let mut story = StoryBuilder { at: [4.4, 1.2], steps: Vec::new(), length_s: 0.0 };
        let (to, pace) = ([stream.between(1.6, 3.6), stream.between(1.3, 2.6)], stream.between(0.5, 1.2));
        match self {
            FallCase::FallsWalking => story.go(to, pace).down(stream),
            FallCase::FallsStanding => story.go(to, pace).busy(8.0, "standing").down(stream),
            FallCase::FallsRising => {
                story.go(ARMCHAIR, pace).busy(10.0, "sitting").shift([1.45, 1.2], 1.2).down(stream)
            }
            FallCase::FallsFromBed => story.go(BED, pace).busy(12.0, "lying").shift([1.4, 2.6], 0.8).down(stream),
            FallCase::SinksDown => story.go(to, pace).busy(5.0, "kneeling").down(stream),
            FallCase::Exercises => {
                let rests = stream.between(60.0, 180.0);
                let busy = story.go(to, pace).busy(6.0, "kneeling").busy(stream.between(60.0, 90.0), "lying");
                busy.still(rests, "lying").busy(5.0, "kneeling").busy(20.0, "standing")
            }
            FallCase::Kneels => story.go(to, pace).busy(stream.between(20.0, 90.0), "kneeling").busy(10.0, "standing"),
            FallCase::Sits | FallCase::SitsAtTable => {
                let seat = if self == FallCase::Sits { ARMCHAIR } else { CHAIR };
                let (every, long) = (spread(stream, [60.0, 1800.0]), stream.between(2400.0, 3600.0));
                story.go(seat, pace).busy(15.0, "sitting").stirring(long, every, "sitting").busy(5.0, "standing")
            }
            FallCase::Bends => {
                let story = story.go(to, pace).busy(4.0, "bending").busy(3.0, "standing").busy(8.0, "bending");
                story.busy(3.0, "standing").busy(6.0, "bending").busy(3.0, "standing")
            }
            FallCase::GoesToBed => {
                let (every, long) = (spread(stream, [300.0, 1800.0]), stream.between(2400.0, 4800.0));
                story.go(BED, pace).busy(15.0, "lying").stirring(long, every, "lying").busy(5.0, "standing")
            }
            FallCase::PicksUp => story
                .go(to, pace)
                .busy(3.0, "kneeling")
                .busy(8.0, "standing")
                .busy(3.0, "kneeling")
                .busy(5.0, "standing"),
            FallCase::Cat => story.go(to, pace).busy(60.0, "lying"),
        };
        let StoryBuilder { steps, length_s, .. } = story;
        Story { path: json!({ "start": [4.4, 1.2], "steps": steps }), length_s }
    }
}

const ARMCHAIR: [f64; 2] = [0.8, 1.0];
const BED: [f64; 2] = [1.1, 3.4];
const CHAIR: [f64; 2] = [4.5, 2.7];

/// A random time with a uniform logarithm.
fn spread(stream: &mut Stream, [least, most]: [f64; 2]) -> f64 {
    stream.between(least.ln(), most.ln()).exp()
}

struct StoryBuilder {
    at: [f64; 2],
    steps: Vec<Value>,
    length_s: f64,
}

impl StoryBuilder {
    fn step(&mut self, step: Value, lasts_s: f64) -> &mut StoryBuilder {
        self.steps.push(step);
        self.length_s += lasts_s;
        self
    }

    fn go(&mut self, to: [f64; 2], pace: f64) -> &mut StoryBuilder {
        let lasts_s = point(self.at).distance(point(to)) / pace;
        self.at = to;
        self.step(json!({ "go": { "to": [to], "pace_mps": pace } }), lasts_s)
    }

    /// Moves on in a given time, like a person who loses their balance.
    fn shift(&mut self, to: [f64; 2], in_s: f64) -> &mut StoryBuilder {
        self.at = to;
        self.step(json!({ "go": { "to": [to], "in_s": in_s } }), in_s)
    }

    fn still(&mut self, for_s: f64, posture: &str) -> &mut StoryBuilder {
        self.step(json!({ "wait": { "for_s": for_s, "posture": posture } }), for_s)
    }

    fn stirring(&mut self, for_s: f64, every_s: f64, posture: &str) -> &mut StoryBuilder {
        // The first stir would come at once.
        let first_s = every_s.min(for_s / 2.0);
        let stir = json!({ "every_s": every_s, "for_s": 2.0 });
        self.still(first_s, posture);
        self.step(json!({ "wait": { "for_s": for_s - first_s, "posture": posture, "stir": stir } }), for_s - first_s)
    }

    fn busy(&mut self, for_s: f64, posture: &str) -> &mut StoryBuilder {
        let stir = json!({ "every_s": 3.0, "for_s": 1.5 });
        self.step(json!({ "wait": { "for_s": for_s, "posture": posture, "stir": stir } }), for_s)
    }

    /// Falls, lies there, and gets up with help.
    fn down(&mut self, stream: &mut Stream) -> &mut StoryBuilder {
        let lies_s = spread(stream, LIES_S);
        match stream.chance(0.5) {
            true => self.stirring(lies_s, spread(stream, STIRS_S), "down"),
            false => self.still(lies_s, "down"),
        };
        self.busy(5.0, "standing")
    }
}
