//! Homes that come and go: each is there for a while and then away for a while, by a stream of its own.

use homebody_core::random::Stream;
use homebody_core::time::{RunTime, SECOND, Span};

/// For how long homes are there and away, on average.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Churn {
    /// Mean time online, in the time of the home; at least one second.
    pub stays: Span,
    /// Mean time offline.
    pub away: Span,
}

/// Shortest period online or offline of a home (our choice).
const SHORTEST: Span = SECOND;

/// When one home is there.
#[derive(Clone, Debug)]
pub(super) struct HomePresence {
    churn: Churn,
    stream: Stream,
    is_there: bool,
    /// Until when that is so.
    until: RunTime,
}

impl HomePresence {
    /// Of the home of a seed, from the beginning of its run on: as many are there as at any other time.
    pub fn new(churn: Churn, seed: u64) -> HomePresence {
        let mut stream = Stream::named(seed, "fleet/presence");
        let [stays, away] = [churn.stays, churn.away].map(|span| span.micros() as f64);
        let is_there = stream.chance(stays / (stays + away));
        let mut presence = HomePresence { churn, stream, is_there, until: RunTime::START };
        presence.until = RunTime::START + presence.spell();
        presence
    }

    /// The duration of the next period: it has no memory, so that homes do not move in step.
    fn spell(&mut self) -> Span {
        let mean = if self.is_there { self.churn.stays } else { self.churn.away };
        mean.share(-libm::log(1.0 - self.stream.unit())).max(SHORTEST)
    }

    /// Whether the home is there now.
    pub fn is_there(&self) -> bool {
        self.is_there
    }

    /// The next change up to an instant: when, and whether the home is there from then on.
    pub fn change(&mut self, until: RunTime) -> Option<(RunTime, bool)> {
        if self.until > until {
            return None;
        }
        let at = self.until;
        self.is_there = !self.is_there;
        self.until = at + self.spell();
        Some((at, self.is_there))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::DAY;

    #[test]
    fn homes_are_there_for_their_share_of_the_time_and_each_by_its_own_stream() {
        let churn = Churn { stays: 300 * SECOND, away: 100 * SECOND };
        let there = |seed: u64| {
            let mut presence = HomePresence::new(churn, seed);
            let (mut since, mut sum, mut changes) = (RunTime::START, Span::ZERO, Vec::new());
            let mut was_there = presence.is_there();
            while let Some((at, is_there)) = presence.change(RunTime::START + DAY) {
                assert_ne!(is_there, was_there);
                sum += if was_there { at - since } else { Span::ZERO };
                (since, was_there) = (at, is_there);
                changes.push(at);
            }
            (sum.ratio(since.since_zero()), changes)
        };
        let shares: Vec<f64> = (0..50).map(|seed| there(seed).0).collect();
        let mean = shares.iter().sum::<f64>() / 50.0;
        assert!((mean - 0.75).abs() < 0.02, "{mean}");
        assert_eq!(there(7), there(7));
        assert_ne!(there(7).1, there(8).1);
        let begun = (0..1000).filter(|&seed| HomePresence::new(churn, seed).is_there()).count();
        assert!((700..800).contains(&begun), "{begun}");
    }
}
