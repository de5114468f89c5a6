//! Homes that connect and disconnect: each is online for a while and then offline for a while, by a stream of its own.

use homebody_core::random::Stream;
use homebody_core::time::{RunTime, SECOND, Span};

/// The average times of homes online and offline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Churn {
    /// Mean time online, in the time of the home; at least one second.
    pub stays: Span,
    pub away: Span,
}

/// Shortest period online or offline of a home (our choice).
const SHORTEST: Span = SECOND;

/// The presence of one home.
#[derive(Clone, Debug)]
pub(super) struct HomePresence {
    churn: Churn,
    stream: Stream,
    is_there: bool,
    until: RunTime,
}

impl HomePresence {
    /// The presence of the home with this seed from the start of its run on. The share of homes online is the same at the start as later.
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

    pub fn is_there(&self) -> bool {
        self.is_there
    }

    /// The next change up to an instant, and the presence from then on.
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
    fn homes_are_online_for_their_share_of_the_time() {
        let churn = Churn { stays: 300 * SECOND, away: 100 * SECOND };
        let presence_of = |seed: u64| {
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
        let shares: Vec<f64> = (0..50).map(|seed| presence_of(seed).0).collect();
        let mean = shares.iter().sum::<f64>() / 50.0;
        assert!((mean - 0.75).abs() < 0.02, "{mean}");
        assert_eq!(presence_of(7), presence_of(7));
        assert_ne!(presence_of(7).1, presence_of(8).1);
        let online = (0..1000).filter(|&seed| HomePresence::new(churn, seed).is_there()).count();
        assert!((700..800).contains(&online), "{online}");
    }
}
