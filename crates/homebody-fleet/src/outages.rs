//! Outages: the network of all homes is down for a while, and then all homes send their messages at once.

use homebody_core::time::Span;

/// Repeated outages of all homes at the same time: the first one ends `every` after the start of the fleet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outages {
    every: Span,
    lasts: Span,
}

impl Outages {
    /// The time from the end of one outage to that of the next, and the duration of each, in real time. `None` unless the duration is
    /// longer than 0 and shorter than that time.
    pub fn new(every: Span, lasts: Span) -> Option<Outages> {
        (lasts > Span::ZERO && lasts < every).then_some(Outages { every, lasts })
    }

    /// The time from the end of one outage to that of the next.
    pub fn every(&self) -> Span {
        self.every
    }

    pub fn lasts(&self) -> Span {
        self.lasts
    }

    /// The delivery of a message that is due this long after the start of the fleet: at once, or at the end of an outage.
    pub fn delivery(&self, after: Span) -> Span {
        if after < Span::ZERO {
            return after;
        }
        let end = (after.div_euclid(self.every) + 1) * self.every;
        if after >= end - self.lasts { end } else { after }
    }

    /// True during an outage, this long after the start of the fleet.
    pub fn is_away(&self, after: Span) -> bool {
        self.delivery(after) != after
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
    fn delivers_messages_of_an_outage_at_its_end() {
        let span = Span::from_micros;
        let outages = Outages::new(span(300), span(30)).unwrap();
        for (after, delivery) in
            [(-5, -5), (0, 0), (269, 269), (270, 300), (299, 300), (300, 300), (301, 301), (570, 600), (600, 600)]
        {
            assert_eq!(outages.delivery(span(after)), span(delivery), "{after}");
        }
        assert_eq!([299, 300, -1].map(|after| outages.ended(span(after))), [0, 1, 0]);
        assert!(outages.is_away(span(280)) && !outages.is_away(span(310)));
        assert_eq!([30, 0].map(|lasts| Outages::new(span(30), span(lasts))), [None, None]);
    }
}
