//! How bodies stir: how often a body that stays somewhere moves, for how long, and how far.
//!
//! Movement on the spot comes in short bouts with gaps between them that have a heavy tail, as the gaps between motion
//! firings of real homes have.
//!
//! We assume lognormal gaps and bouts, one pair for each manner of staying. Their numbers are ours, set so that a day
//! of a generated older adult has about as many firings, and gaps as long, as the CASAS homes of single older adults;
//! `homebody experiment daily-life` says how near they come.
//!
//! A gap and a bout are drawn one after the other; a factor for activity shortens the gaps.
//!
//! Left out: which limb moves, and that movements of one kind come in clusters.

use homebody_core::activity::{FALLEN, READING, WASHING};
use homebody_core::numbers::{Number, Numbers};
use homebody_core::random::Stream;
use homebody_core::time::{Micros, SECOND, micros};

/// How a body that stays somewhere stirs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manner {
    /// What its numbers are called after.
    name: &'static str,
    /// The median gap between two movements, in seconds.
    pub gap_s: f64,
    /// The spread of the gaps: the standard deviation of their logarithm.
    pub sigma: f64,
    /// The median length of a movement, in seconds.
    pub bout_s: f64,
    /// How far what moves moves, in metres.
    pub amplitude_m: f64,
}

const fn manner(name: &'static str, gap_s: f64, sigma: f64, bout_s: f64, amplitude_m: f64) -> Manner {
    Manner { name, gap_s, sigma, bout_s, amplitude_m }
}

/// The table that the numbers of these are of.
const TABLE: &str = "stay";

impl Manner {
    /// Asleep: 10-20 gross movements an hour.
    pub const ASLEEP: Manner = manner("asleep", 50.0, 2.4, 3.0, 0.3);
    /// Awake in bed.
    pub const AWAKE_IN_BED: Manner = manner("awake_in_bed", 45.0, 1.5, 3.0, 0.3);
    /// Getting up, lying down, rising.
    pub const TURNING: Manner = manner("turning", 4.0, 0.5, 4.0, 0.4);
    /// In front of a screen, or doing nothing.
    pub const STILL: Manner = manner("still", 300.0, 2.0, 2.0, 0.2);
    /// Over a book, a newspaper or a keyboard.
    pub const READING: Manner = manner(READING, 150.0, 2.0, 2.0, 0.25);
    /// In company, or on the telephone.
    pub const TALKING: Manner = manner("talking", 25.0, 1.5, 3.0, 0.25);
    /// At a meal.
    pub const EATING: Manner = manner("eating", 40.0, 1.8, 4.0, 0.3);
    /// On the toilet.
    pub const ON_TOILET: Manner = manner("on_toilet", 90.0, 1.5, 3.0, 0.25);
    /// Standing and using the hands: at the stove, the sink, the wardrobe.
    pub const BUSY: Manner = manner("busy", 50.0, 1.5, 6.0, 0.4);
    /// Washing oneself.
    pub const WASHING: Manner = manner(WASHING, 35.0, 1.4, 6.0, 0.4);
    /// On the floor, trying to get up.
    pub const FALLEN: Manner = manner(FALLEN, 45.0, 1.1, 4.0, 0.4);
    /// An animal asleep.
    pub const CURLED_UP: Manner = manner("curled_up", 400.0, 1.0, 2.0, 0.15);

    const ALL: [Manner; 12] = [
        Manner::ASLEEP,
        Manner::AWAKE_IN_BED,
        Manner::TURNING,
        Manner::STILL,
        Manner::READING,
        Manner::TALKING,
        Manner::EATING,
        Manner::ON_TOILET,
        Manner::BUSY,
        Manner::WASHING,
        Manner::FALLEN,
        Manner::CURLED_UP,
    ];

    /// The same as the scenario's numbers have it.
    pub fn by(&self, numbers: &Numbers) -> Manner {
        let of = |column: &str, value| numbers.of_table([TABLE, self.name, column], value);
        Manner {
            name: self.name,
            gap_s: of("gap", self.gap_s),
            sigma: of("spread", self.sigma),
            bout_s: of("bout", self.bout_s),
            amplitude_m: of("amplitude", self.amplitude_m),
        }
    }

    /// What the manners are called.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Manner::ALL.into_iter().map(|manner| manner.name)
    }

    /// The manner of a name.
    pub fn named(name: &str) -> Option<Manner> {
        Manner::ALL.into_iter().find(|manner| manner.name == name)
    }

    /// Whether one stirs so in bed, where being restless counts.
    pub fn is_of_bed(&self) -> bool {
        [Manner::ASLEEP.name, Manner::AWAKE_IN_BED.name].contains(&self.name)
    }

    /// The numbers of all of them.
    pub fn numbers() -> Vec<Number> {
        let of = |manner: &Manner| {
            let name = manner.name;
            let number = |column: &str, value, unit, range, what: &str| {
                let what = format!("{what} of a body whose manner of staying is `{name}`.");
                Number::of_table([TABLE, name, column], value, unit, range, what, file!())
            };
            [
                number("gap", manner.gap_s, "s", [0.5, 21_600.0], "The median gap between two movements"),
                number("spread", manner.sigma, "1", [0.0, 5.0], "The standard deviation of the logarithm of the gaps"),
                number("bout", manner.bout_s, "s", [0.5, 30.0], "The median length of a movement"),
                number("amplitude", manner.amplitude_m, "m", [0.0, 1.0], "How far moves what moves"),
            ]
        };
        Manner::ALL.iter().flat_map(of).collect()
    }

    /// The next gap; `activity` 2 is twice as many movements.
    pub fn gap(&self, activity: f64, stream: &mut Stream) -> Micros {
        let gap_s = stream.lognormal(self.gap_s, self.sigma) / activity.max(0.05);
        micros(gap_s.clamp(0.5, 6.0 * 3600.0))
    }

    /// The next movement.
    pub fn bout(&self, stream: &mut Stream) -> Micros {
        micros(stream.lognormal(self.bout_s, 0.5).clamp(0.5, 30.0)).max(SECOND / 2)
    }
}
