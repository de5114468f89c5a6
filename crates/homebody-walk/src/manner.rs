//! Small movements of a resting body: intervals, durations and distances.
//!
//! Movements on the spot come in short bouts. The gaps between bouts have a heavy tail, as the gaps between motion
//! firings of real homes have.
//!
//! Movements come in clusters: after a movement another follows soon, with a probability for each manner of staying, or
//! a long gap. We assume that gaps of both kinds and bouts are lognormal. Their parameters for each manner are our
//! choice: a day of a generated older adult then has about as many firings, and gaps as long, as the CASAS homes of
//! single older adults. `homebody-lab daily-life` and `homebody-lab realism` report the remaining differences.
//!
//! A gap and a bout are drawn one after the other; a factor for activity shortens the long gaps. A blanket hides most
//! of a movement in bed: sleepers turn by 0.3 m, and a quarter of it is visible (our choice).
//!
//! Left out: which limb moves.

use homebody_core::activity::{FALLEN, READING, WASHING};
use homebody_core::numbers::{Number, Numbers};
use homebody_core::random::Stream;
use homebody_core::time::{SECOND, Span};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manner {
    name: &'static str,
    /// Median gap between clusters of movements.
    pub gap_s: f64,
    /// Standard deviation of the logarithm of these gaps.
    pub sigma: f64,
    /// Probability that another movement follows soon.
    pub more: f64,
    /// Median gap between the movements of a cluster.
    pub soon_s: f64,
    /// Median duration of a movement.
    pub bout_s: f64,
    pub amplitude_m: f64,
}

const fn manner(
    name: &'static str,
    [gap_s, sigma]: [f64; 2],
    [more, soon_s]: [f64; 2],
    [bout_s, amplitude_m]: [f64; 2],
) -> Manner {
    Manner { name, gap_s, sigma, more, soon_s, bout_s, amplitude_m }
}

/// Standard deviation of the logarithm of the gaps in a cluster (our choice).
const SOON_SPREAD: f64 = 0.6;

const TABLE: &str = "stay";

impl Manner {
    /// Asleep: 10-20 gross movements an hour, with silence of up to an hour between them.
    pub const ASLEEP: Manner = manner("asleep", [600.0, 1.15], [0.7, 15.0], [3.0, 0.07]);
    /// Awake in bed.
    pub const AWAKE_IN_BED: Manner = manner("awake_in_bed", [120.0, 1.2], [0.6, 8.0], [3.0, 0.15]);
    /// Getting up, lying down, rising.
    pub const TURNING: Manner = manner("turning", [4.0, 0.5], [0.0, 4.0], [4.0, 0.4]);
    /// In front of a screen, or doing nothing.
    pub const STILL: Manner = manner("still", [600.0, 1.4], [0.6, 8.0], [1.3, 0.25]);
    /// Over a book, a newspaper or a keyboard.
    pub const READING: Manner = manner(READING, [300.0, 1.3], [0.5, 7.5], [1.5, 0.25]);
    /// In company, or on the telephone.
    pub const TALKING: Manner = manner("talking", [40.0, 1.2], [0.75, 5.0], [3.0, 0.3]);
    pub const EATING: Manner = manner("eating", [50.0, 1.2], [0.3, 6.0], [2.0, 0.3]);
    pub const ON_TOILET: Manner = manner("on_toilet", [100.0, 1.2], [0.4, 6.0], [2.7, 0.3]);
    /// Standing and using the hands: at the stove, the sink, the wardrobe.
    pub const BUSY: Manner = manner("busy", [75.0, 1.3], [0.55, 7.0], [4.0, 0.35]);
    /// Washing oneself, under the shower too.
    pub const WASHING: Manner = manner(WASHING, [24.0, 1.2], [0.4, 4.5], [6.0, 0.35]);
    /// On the floor, trying to get up.
    pub const FALLEN: Manner = manner(FALLEN, [45.0, 1.1], [0.0, 4.0], [4.0, 0.4]);
    /// An animal asleep.
    pub const CURLED_UP: Manner = manner("curled_up", [400.0, 1.0], [0.0, 4.0], [2.0, 0.15]);

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

    /// With the parameters of the scenario.
    pub fn with_numbers(&self, numbers: &Numbers) -> Manner {
        let of = |column: &str, value| numbers.of_table([TABLE, self.name, column], value);
        Manner {
            name: self.name,
            gap_s: of("gap", self.gap_s),
            sigma: of("spread", self.sigma),
            more: of("more", self.more),
            soon_s: of("soon", self.soon_s),
            bout_s: of("bout", self.bout_s),
            amplitude_m: of("amplitude", self.amplitude_m),
        }
    }

    pub fn names() -> impl Iterator<Item = &'static str> {
        Manner::ALL.into_iter().map(|manner| manner.name)
    }

    pub fn named(name: &str) -> Option<Manner> {
        Manner::ALL.into_iter().find(|manner| manner.name == name)
    }

    /// Only in these does restlessness count.
    pub fn is_in_bed(&self) -> bool {
        [Manner::ASLEEP.name, Manner::AWAKE_IN_BED.name].contains(&self.name)
    }

    pub fn numbers() -> Vec<Number> {
        let of = |manner: &Manner| {
            let Manner { name, gap_s, sigma, more, soon_s, bout_s, amplitude_m } = *manner;
            let number = |column: &str, value, unit, range, what: &str| {
                let what = format!("{what}, for the manner of staying `{name}`.");
                Number::of_table([TABLE, name, column], value, unit, range, what, file!())
            };
            [
                number("gap", gap_s, "s", [0.5, 21_600.0], "Median gap, in seconds, between two clusters of movements"),
                number(
                    "spread",
                    sigma,
                    "1",
                    [0.0, 5.0],
                    "Standard deviation of the logarithm of the gaps between clusters",
                ),
                number("more", more, "1", [0.0, 0.99], "Probability that another movement follows soon"),
                number("soon", soon_s, "s", [0.5, 600.0], "Median gap, in seconds, between the movements of a cluster"),
                number("bout", bout_s, "s", [0.5, 30.0], "Median duration, in seconds, of a movement"),
                number(
                    "amplitude",
                    amplitude_m,
                    "m",
                    [0.0, 1.0],
                    "Distance, in metres, that the moving part of the body covers",
                ),
            ]
        };
        Manner::ALL.iter().flat_map(of).collect()
    }

    /// `activity` 2 doubles the number of clusters.
    pub fn gap(&self, activity: f64, stream: &mut Stream) -> Span {
        let gap_s = match stream.chance(self.more) {
            true => stream.lognormal(self.soon_s, SOON_SPREAD),
            false => stream.lognormal(self.gap_s, self.sigma) / activity.max(0.05),
        };
        Span::from_seconds(gap_s.clamp(0.5, 6.0 * 3600.0))
    }

    pub fn bout(&self, stream: &mut Stream) -> Span {
        Span::from_seconds(stream.lognormal(self.bout_s, 0.5).clamp(0.5, 30.0)).max(SECOND / 2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gaps(manner: Manner, activity: f64) -> Vec<f64> {
        let stream = &mut Stream::named(1, "gaps");
        (0..20_000).map(|_| manner.gap(activity, stream).seconds()).collect()
    }

    #[test]
    fn movements_come_in_clusters_with_long_silence_between() {
        let manner = Manner { gap_s: 600.0, sigma: 0.5, more: 0.75, soon_s: 10.0, ..Manner::ASLEEP };
        let gaps = gaps(manner, 1.0);
        // The two kinds hardly overlap: exp(3.2 * 0.6) * 10 = 68 s, and 600 / exp(3.2 * 0.5) = 121 s.
        let soon = gaps.iter().filter(|&&gap| gap < 95.0).count() as f64 / gaps.len() as f64;
        assert!((soon - 0.75).abs() < 0.02, "{soon}");
        let mut long: Vec<f64> = gaps.into_iter().filter(|&gap| gap >= 95.0).collect();
        long.sort_by(f64::total_cmp);
        assert!((long[long.len() / 2] / 600.0 - 1.0).abs() < 0.05, "{}", long[long.len() / 2]);
    }

    #[test]
    fn activity_adds_clusters_and_does_not_lengthen_them() {
        let manner = Manner { more: 0.5, soon_s: 1.0, gap_s: 1_000.0, sigma: 0.1, ..Manner::STILL };
        let mean_long = |activity| {
            let long: Vec<f64> = gaps(manner, activity).into_iter().filter(|&gap| gap > 100.0).collect();
            (long.len(), long.iter().sum::<f64>() / long.len() as f64)
        };
        let ((usual, usual_s), (active, active_s)) = (mean_long(1.0), mean_long(2.0));
        assert_eq!(usual, active);
        assert!((usual_s / active_s - 2.0).abs() < 0.01, "{usual_s} and {active_s}");
    }
}
