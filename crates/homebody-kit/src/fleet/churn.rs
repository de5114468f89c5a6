//! Homes that come and go: each is there for a while and then away for a while, by a stream of its own.

use homebody_core::random::Stream;
use homebody_core::time::Micros;

/// For how long homes are there and away, on average.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Churn {
    /// How long a home is there, in microseconds of its life; at least one second.
    pub stays: Micros,
    /// How long it is away.
    pub away: Micros,
}

/// Shortest period online or offline of a home, in microseconds (our choice).
const SHORTEST: Micros = 1_000_000;

/// When one home is there.
#[derive(Clone, Debug)]
pub(super) struct Presence {
    churn: Churn,
    stream: Stream,
    is_there: bool,
    /// Until when that is so.
    until: Micros,
}

impl Presence {
    /// Of the home of a seed, from the beginning of its run on: as many are there as at any other time.
    pub fn new(churn: Churn, seed: u64) -> Presence {
        let mut stream = Stream::named(seed, "fleet/presence");
        let (stays, away) = (churn.stays as f64, churn.away as f64);
        let is_there = stream.chance(stays / (stays + away));
        let mut presence = Presence { churn, stream, is_there, until: 0 };
        presence.until = presence.spell();
        presence
    }

    /// How long the next spell lasts: spells have no memory, so that homes do not move in step.
    fn spell(&mut self) -> Micros {
        let mean = if self.is_there { self.churn.stays } else { self.churn.away };
        let drawn = -libm::log(1.0 - self.stream.unit()) * mean as f64;
        (drawn as Micros).max(SHORTEST)
    }

    /// Whether the home is there now.
    pub fn is_there(&self) -> bool {
        self.is_there
    }

    /// The next change up to an instant: when, and whether the home is there from then on.
    pub fn change(&mut self, until: Micros) -> Option<(Micros, bool)> {
        if self.until > until {
            return None;
        }
        let at = self.until;
        self.is_there = !self.is_there;
        self.until += self.spell();
        Some((at, self.is_there))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;

    #[test]
    fn homes_are_there_for_their_share_of_the_time_and_each_by_its_own_stream() {
        let churn = Churn { stays: 300 * SECOND, away: 100 * SECOND };
        let day = 86_400 * SECOND;
        let there = |seed: u64| {
            let mut presence = Presence::new(churn, seed);
            let (mut since, mut sum, mut changes) = (0, 0, Vec::new());
            let mut was_there = presence.is_there();
            while let Some((at, is_there)) = presence.change(day) {
                assert_ne!(is_there, was_there);
                sum += if was_there { at - since } else { 0 };
                (since, was_there) = (at, is_there);
                changes.push(at);
            }
            (sum as f64 / since as f64, changes)
        };
        let shares: Vec<f64> = (0..50).map(|seed| there(seed).0).collect();
        let mean = shares.iter().sum::<f64>() / 50.0;
        assert!((mean - 0.75).abs() < 0.02, "{mean}");
        assert_eq!(there(7), there(7));
        assert_ne!(there(7).1, there(8).1);
        let begun = (0..1000).filter(|&seed| Presence::new(churn, seed).is_there()).count();
        assert!((700..800).contains(&begun), "{begun}");
    }
}
