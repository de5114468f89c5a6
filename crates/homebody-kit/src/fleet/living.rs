//! Living all homes, each a little ahead of the clock, and what of it is to be told by now. It knows no clock: it is told the time.

use super::churn::Presence;
use super::homes::{FleetOf, HomeOf};
use super::storms::Storms;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::time::{Micros, SECOND};
use homebody_log::fleet::{FleetRow, HomeRows, Told};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Time ahead of the world's clock, in microseconds, below which a home is simulated further (our choice): ten thousand
/// people who plan their day at midnight take some seconds.
const AHEAD: i64 = 30 * SECOND;

/// Part of a run that is simulated at once, in microseconds of the world's clock (our choice): its events wait in
/// memory.
const STEP: i64 = 60 * SECOND;

/// Divisor of the lag that gives the step of a home far behind, and longest step (our choice).
const PART_OF_BEHIND: i64 = 4;
const LONGEST_STEP: Micros = 3600 * SECOND;

/// Number of events after which a step ends, whatever drivers decide (our choice).
const MOST_EVENTS: usize = 100_000;

/// All homes.
pub(super) struct Living {
    homes: Vec<Home>,
    /// The homes by how far they are lived, in microseconds since 1970.
    by_lived: BinaryHeap<Reverse<(i64, u32)>>,
    held: BinaryHeap<Reverse<Held>>,
    clocks: Clocks,
    storms: Option<Storms>,
    events: Events,
    /// Homes that are there, by what was told of them.
    pub there: usize,
    /// How often homes have come and gone since the fleet began.
    pub came: u64,
    pub went: u64,
    /// Whose driver decided what nobody can do: they are lived no further.
    pub failed: Vec<(u32, DriverError)>,
}

/// One home.
struct Home {
    run: Run,
    rows: HomeRows,
    presence: Option<Presence>,
    skew: Micros,
    /// When its runs start.
    start: i64,
    is_there: bool,
    /// What it says is told no earlier than what it has said before.
    last_due: i64,
    order: u64,
}

/// What instants of runs are by the world's clock.
#[derive(Clone, Copy, Debug)]
struct Clocks {
    /// How many times as fast as life, from the instant `begin` of the world's clock on; None where runs are where that is.
    speed: Option<f64>,
    begin: i64,
}

/// What is to be told once its time has come; of one home in the order in which it happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Held {
    due: i64,
    home: u32,
    order: u64,
    told: Kept,
}

/// The same, without order of its own.
#[derive(Clone, Copy, Debug)]
struct Kept(Told);

impl PartialEq for Kept {
    fn eq(&self, _: &Kept) -> bool {
        true
    }
}

impl Eq for Kept {}

impl PartialOrd for Kept {
    fn partial_cmp(&self, other: &Kept) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Kept {
    fn cmp(&self, _: &Kept) -> std::cmp::Ordering {
        std::cmp::Ordering::Equal
    }
}

impl Clocks {
    /// When something of a run that starts at `start` happens, by the world's clock, for a home whose clock is ahead by `skew`.
    fn of(&self, start: i64, at: Micros, skew: Micros) -> i64 {
        match self.speed {
            None => start + at - skew,
            Some(speed) => self.begin + ((at - skew) as f64 / speed) as i64,
        }
    }

    /// How long a span of the world's clock is in a run.
    fn span(&self, span: i64) -> Micros {
        self.speed.map_or(span, |speed| (span as f64 * speed) as Micros)
    }
}

impl Living {
    /// All homes of a fleet that begins to tell at this instant, in microseconds since 1970.
    pub fn new(fleet: FleetOf, begin: i64) -> Living {
        let FleetOf { fleet: of, homes, speed, storms, starts } = fleet;
        let clocks = Clocks { speed, begin };
        let home = |(index, home): (usize, HomeOf)| {
            let HomeOf { run, rows, presence, skew } = home;
            let is_there = presence.as_ref().is_none_or(Presence::is_there);
            let start = starts[of.homes[index].layout];
            Home { run, rows, presence, skew, start, is_there, last_due: i64::MIN, order: 0 }
        };
        let homes: Vec<Home> = homes.into_iter().enumerate().map(home).collect();
        let lived = homes.iter().zip(0..).map(|(home, index)| Reverse((clocks.of(home.start, 0, home.skew), index)));
        Living {
            by_lived: lived.collect(),
            held: BinaryHeap::new(),
            there: homes.iter().filter(|home| home.is_there).count(),
            homes,
            clocks,
            storms,
            events: Events::default(),
            came: 0,
            went: 0,
            failed: Vec::new(),
        }
    }

    /// What a place is told first: that those homes have come that are there from the beginning.
    pub fn first(&self) -> Vec<Told> {
        let there = self.homes.iter().zip(0..).filter(|(home, _)| home.is_there);
        there.map(|(_, index)| Told::Comes(index)).collect()
    }

    /// Up to which instant all homes are lived.
    pub fn lived(&self) -> i64 {
        self.by_lived.peek().map_or(i64::MAX, |Reverse((lived, _))| *lived)
    }

    /// When there is something to tell, as far as homes are lived.
    pub fn next_due(&self) -> Option<i64> {
        self.held.peek().map(|Reverse(held)| self.told_at(held.due))
    }

    /// When that is told which is due at an instant: what was due before an outage is told in it, if nobody has come to that before.
    fn told_at(&self, due: i64) -> i64 {
        let begin = self.clocks.begin;
        self.storms.map_or(due, |storms| begin + storms.told_at(due - begin))
    }

    /// The fleet begins to tell at this instant: from it outages count, and in runs that go at a speed of their own all that was to
    /// be told from the beginning on is told from then on.
    pub fn begin(&mut self, now: i64) {
        let later = now - std::mem::replace(&mut self.clocks.begin, now);
        if self.clocks.speed.is_none() {
            return;
        }
        let moved = |Reverse((lived, home))| Reverse((lived + later, home));
        self.by_lived = std::mem::take(&mut self.by_lived).into_iter().map(moved).collect();
        let moved = |Reverse(held): Reverse<Held>| {
            let told = match held.told.0 {
                Told::Row(row) => Told::Row(FleetRow { due: row.due + later, ..row }),
                told => told,
            };
            Reverse(Held { due: held.due + later, told: Kept(told), ..held })
        };
        self.held = std::mem::take(&mut self.held).into_iter().map(moved).collect();
        for home in &mut self.homes {
            home.last_due = home.last_due.saturating_add(later);
        }
    }

    /// Whether all homes are lived so far ahead of an instant that the fleet can begin to tell then.
    pub fn is_ready(&self, now: i64) -> bool {
        self.lived() >= now + AHEAD / 2
    }

    /// How many outages have ended by then, and whether there is one.
    pub fn storms(&self, now: i64) -> (u64, bool) {
        let after = now - self.clocks.begin;
        self.storms.map_or((0, false), |storms| (storms.ended(after), storms.is_away(after)))
    }

    /// When a home is to be lived on.
    pub fn next_life(&self) -> i64 {
        self.lived().saturating_sub(AHEAD)
    }

    /// What is to be told by now, at most so much of it.
    pub fn due(&mut self, now: i64, most: usize, into: &mut Vec<Told>) {
        while into.len() < most
            && let Some(Reverse(held)) = self.held.peek()
            && self.told_at(held.due) <= now
        {
            let Kept(mut told) = held.told;
            match &mut told {
                Told::Row(row) => row.due = self.told_at(row.due),
                Told::Comes(_) => (self.there, self.came) = (self.there + 1, self.came + 1),
                Told::Goes(_) => (self.there, self.went) = (self.there - 1, self.went + 1),
            }
            into.push(told);
            self.held.pop();
        }
    }

    /// Lives the home on that is lived least far. False where all are far enough ahead.
    pub fn live_one(&mut self, now: i64) -> bool {
        let Some(&Reverse((lived, index))) = self.by_lived.peek() else { return false };
        if lived >= now + AHEAD {
            return false;
        }
        self.by_lived.pop();
        let share = (i64::from(index) + 1) as f64 / self.homes.len() as f64;
        let home = &mut self.homes[index as usize];
        let step = match home.run.now() {
            // Not all of them at once from then on.
            0 => (self.clocks.span(STEP) as f64 * share) as Micros + 1,
            _ => {
                self.clocks.span(STEP.max((now - lived) / PART_OF_BEHIND)).min(LONGEST_STEP.max(self.clocks.span(STEP)))
            }
        };
        self.events.clear();
        let until = home.run.now().saturating_add(step);
        let ended = home.run.advance_within(until, MOST_EVENTS, &mut self.events).err();
        let clocks = self.clocks;
        home.say(index, &self.events, clocks, &mut self.held);
        match ended {
            None => self.by_lived.push(Reverse((clocks.of(home.start, home.run.now(), home.skew), index))),
            Some(error) => self.failed.push((index, error)),
        }
        true
    }
}

impl Home {
    /// Takes in what has happened, to be told when its time has come.
    fn say(&mut self, index: u32, events: &Events, clocks: Clocks, held: &mut BinaryHeap<Reverse<Held>>) {
        let now = self.run.now();
        let mut said = Vec::new();
        self.rows.of(&events.firings, now, |seq, at, sensor, value| {
            said.push(FleetRow { seq, at, due: 0, home: index, sensor, value });
        });
        for row in said {
            self.come_and_go(row.at, index, clocks, held);
            if self.is_there {
                self.hold(row.at, Told::Row(row), (index, clocks), held);
            }
        }
        self.come_and_go(now - 1, index, clocks, held);
    }

    /// Comes and goes up to an instant.
    fn come_and_go(&mut self, until: Micros, index: u32, clocks: Clocks, held: &mut BinaryHeap<Reverse<Held>>) {
        while let Some((at, comes)) = self.presence.as_mut().and_then(|presence| presence.change(until)) {
            self.is_there = comes;
            let told = if comes { Told::Comes(index) } else { Told::Goes(index) };
            self.hold(at, told, (index, clocks), held);
        }
    }

    fn hold(
        &mut self,
        at: Micros,
        mut told: Told,
        (home, clocks): (u32, Clocks),
        held: &mut BinaryHeap<Reverse<Held>>,
    ) {
        let due = clocks.of(self.start, at, self.skew).max(self.last_due);
        if let Told::Row(row) = &mut told {
            row.due = due;
        }
        held.push(Reverse(Held { due, home, order: self.order, told: Kept(told) }));
        (self.last_due, self.order) = (due, self.order + 1);
    }
}

#[cfg(test)]
mod tests;
