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

use homebody_core::random::Stream;
use homebody_core::time::{Micros, SECOND, micros};

/// How a body that stays somewhere stirs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manner {
    /// The median gap between two movements, in seconds.
    pub gap_s: f64,
    /// The spread of the gaps: the standard deviation of their logarithm.
    pub sigma: f64,
    /// The median length of a movement, in seconds.
    pub bout_s: f64,
    /// How far what moves moves, in metres.
    pub amplitude_m: f64,
}

const fn manner(gap_s: f64, sigma: f64, bout_s: f64, amplitude_m: f64) -> Manner {
    Manner { gap_s, sigma, bout_s, amplitude_m }
}

impl Manner {
    /// Asleep: 10-20 gross movements an hour.
    pub const ASLEEP: Manner = manner(50.0, 2.4, 3.0, 0.3);
    /// Awake in bed.
    pub const AWAKE_IN_BED: Manner = manner(45.0, 1.5, 3.0, 0.3);
    /// Getting up, lying down, rising.
    pub const TURNING: Manner = manner(4.0, 0.5, 4.0, 0.4);
    /// In front of a screen, or doing nothing.
    pub const STILL: Manner = manner(300.0, 2.0, 2.0, 0.2);
    pub const READING: Manner = manner(150.0, 2.0, 2.0, 0.25);
    pub const TALKING: Manner = manner(25.0, 1.5, 3.0, 0.25);
    pub const EATING: Manner = manner(40.0, 1.8, 4.0, 0.3);
    pub const ON_TOILET: Manner = manner(90.0, 1.5, 3.0, 0.25);
    /// Standing and using the hands: at the stove, the sink, the wardrobe.
    pub const BUSY: Manner = manner(50.0, 1.5, 6.0, 0.4);
    /// Washing oneself.
    pub const WASHING: Manner = manner(35.0, 1.4, 6.0, 0.4);
    /// On the floor, trying to get up.
    pub const FALLEN: Manner = manner(45.0, 1.1, 4.0, 0.4);
    /// An animal asleep.
    pub const CURLED_UP: Manner = manner(400.0, 1.0, 2.0, 0.15);

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
