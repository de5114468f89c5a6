//! Storms: the network of all homes is away for a while, and then all of them report at once.

use homebody_core::time::Micros;

/// Outages of all homes at the same time, again and again: the first of them ends `every` after the fleet has begun.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Storms {
    every: Micros,
    lasts: Micros,
}

impl Storms {
    /// From the end of one outage to that of the next, and how long each lasts, in microseconds of the world's clock. None where
    /// an outage would last as long as that or longer, or no time at all.
    pub fn new(every: Micros, lasts: Micros) -> Option<Storms> {
        (lasts > 0 && lasts < every).then_some(Storms { every, lasts })
    }

    /// From the end of one outage to that of the next.
    pub fn every(&self) -> Micros {
        self.every
    }

    /// How long each lasts.
    pub fn lasts(&self) -> Micros {
        self.lasts
    }

    /// When that is told which would be told at an instant after the fleet's beginning: at once, or at the end of an outage.
    pub fn told_at(&self, after: Micros) -> Micros {
        if after < 0 {
            return after;
        }
        let end = (after.div_euclid(self.every) + 1) * self.every;
        if after >= end - self.lasts { end } else { after }
    }

    /// Whether the network is away at an instant after the fleet's beginning.
    pub fn is_away(&self, after: Micros) -> bool {
        self.told_at(after) != after
    }

    /// How many outages have ended by then.
    pub fn ended(&self, after: Micros) -> u64 {
        after.div_euclid(self.every).max(0) as u64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_falls_into_an_outage_is_told_at_its_end() {
        let storms = Storms::new(300, 30).unwrap();
        for (after, told) in
            [(-5, -5), (0, 0), (269, 269), (270, 300), (299, 300), (300, 300), (301, 301), (570, 600), (600, 600)]
        {
            assert_eq!(storms.told_at(after), told, "{after}");
        }
        assert_eq!((storms.ended(299), storms.ended(300), storms.ended(-1)), (0, 1, 0));
        assert!(storms.is_away(280) && !storms.is_away(310));
        assert_eq!((Storms::new(30, 30), Storms::new(30, 0)), (None, None));
    }
}
