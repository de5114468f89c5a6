//! Outages: the network of all homes is away for a while, and then all of them report at once.

use homebody_core::time::Span;

/// Outages of all homes at the same time, again and again: the first of them ends `every` after the fleet has begun.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outages {
    every: Span,
    lasts: Span,
}

impl Outages {
    /// From the end of one outage to that of the next, and how long each lasts, by the world's clock. None where an outage would
    /// last as long as that or longer, or no time at all.
    pub fn new(every: Span, lasts: Span) -> Option<Outages> {
        (lasts > Span::ZERO && lasts < every).then_some(Outages { every, lasts })
    }

    /// From the end of one outage to that of the next.
    pub fn every(&self) -> Span {
        self.every
    }

    /// The duration of each.
    pub fn lasts(&self) -> Span {
        self.lasts
    }

    /// When that is told which would be told at an instant after the fleet's beginning: at once, or at the end of an outage.
    pub fn told_at(&self, after: Span) -> Span {
        if after < Span::ZERO {
            return after;
        }
        let end = (after.div_euclid(self.every) + 1) * self.every;
        if after >= end - self.lasts { end } else { after }
    }

    /// Whether the network is away at an instant after the fleet's beginning.
    pub fn is_away(&self, after: Span) -> bool {
        self.told_at(after) != after
    }

    /// The number of outages that have ended by then.
    pub fn ended(&self, after: Span) -> u64 {
        after.div_euclid(self.every).max(0) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_falls_into_an_outage_is_told_at_its_end() {
        let span = Span::from_micros;
        let storms = Outages::new(span(300), span(30)).unwrap();
        for (after, told) in
            [(-5, -5), (0, 0), (269, 269), (270, 300), (299, 300), (300, 300), (301, 301), (570, 600), (600, 600)]
        {
            assert_eq!(storms.told_at(span(after)), span(told), "{after}");
        }
        assert_eq!([299, 300, -1].map(|after| storms.ended(span(after))), [0, 1, 0]);
        assert!(storms.is_away(span(280)) && !storms.is_away(span(310)));
        assert_eq!([30, 0].map(|lasts| Outages::new(span(30), span(lasts))), [None, None]);
    }
}
