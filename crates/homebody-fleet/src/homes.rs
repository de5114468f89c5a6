//! Simulates all homes, each a little ahead of the clock, and returns the messages that are due. It has no clock: it gets the time.

use crate::churn::HomePresence;
use crate::outages::Outages;
use crate::setup::{FleetHomes, UnstartedHome};
use homebody_core::drivers::error::DriverError;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::time::{HOUR, MINUTE, RunTime, SECOND, Span, UtcTime};
use homebody_log::fleet::{FleetEvent, FleetRow, HomeRows};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Time ahead of the world's clock below which a home is simulated further (our choice): ten thousand people who plan
/// their day at midnight take some seconds.
const AHEAD: Span = SECOND.times(30);

/// Part of a run that is simulated at once, by the world's clock (our choice): its events wait in memory.
const STEP: Span = MINUTE;

/// Divisor of the lag that gives the step of a home far behind, and longest step (our choice).
const PART_OF_BEHIND: i64 = 4;
const LONGEST_STEP: Span = HOUR;

/// Number of events after which a step ends, whatever drivers decide (our choice).
const MOST_EVENTS: usize = 100_000;

/// All homes.
pub(super) struct FleetSimulation {
    homes: Vec<FleetMember>,
    /// The homes by the instant that they have come to.
    by_time: BinaryHeap<Reverse<(UtcTime, u32)>>,
    held: BinaryHeap<Reverse<PendingMessage>>,
    clocks: FleetClock,
    storms: Option<Outages>,
    events: Events,
    /// Homes that are there, by what was told of them.
    pub there: usize,
    /// The number of connections and disconnections since the start.
    pub came: u64,
    pub went: u64,
    /// The homes whose driver failed: they are simulated no further.
    pub failed: Vec<(u32, DriverError)>,
}

/// One home.
struct FleetMember {
    run: Run,
    rows: HomeRows,
    presence: Option<HomePresence>,
    skew: Span,
    /// When its runs start.
    start: UtcTime,
    is_there: bool,
    /// The latest due time of its messages: no later message is due earlier.
    last_due: UtcTime,
    order: u64,
}

/// Converts instants of runs to real time.
#[derive(Clone, Copy, Debug)]
struct FleetClock {
    /// The speed from the instant `begin` of real time on; `None` for runs in real time.
    speed: Option<f64>,
    begin: UtcTime,
}

/// A message that waits until it is due; those of one home stay in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct PendingMessage {
    due: UtcTime,
    home: u32,
    order: u64,
    told: Unordered,
}

/// The same, without order of its own.
#[derive(Clone, Copy, Debug)]
struct Unordered(FleetEvent);

impl PartialEq for Unordered {
    fn eq(&self, _: &Unordered) -> bool {
        true
    }
}

impl Eq for Unordered {}

impl PartialOrd for Unordered {
    fn partial_cmp(&self, other: &Unordered) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Unordered {
    fn cmp(&self, _: &Unordered) -> std::cmp::Ordering {
        std::cmp::Ordering::Equal
    }
}

impl FleetClock {
    /// When something of a run that starts at `start` happens, by the world's clock, for a home whose clock is ahead by `skew`.
    fn world_time(&self, start: UtcTime, at: RunTime, skew: Span) -> UtcTime {
        match self.speed {
            None => start + at.since_zero() - skew,
            Some(speed) => self.begin + Span::from_micros(((at - skew).micros() as f64 / speed) as i64),
        }
    }

    /// A span of real time as a span of a run.
    fn span(&self, span: Span) -> Span {
        self.speed.map_or(span, |speed| span.share(speed))
    }
}

impl FleetSimulation {
    /// All homes of a fleet that begins to tell at this instant.
    pub fn new(fleet: FleetHomes, begin: UtcTime) -> FleetSimulation {
        let FleetHomes { fleet: of, homes, speed, storms, starts } = fleet;
        let clocks = FleetClock { speed, begin };
        let home = |(index, home): (usize, UnstartedHome)| {
            let UnstartedHome { run, rows, presence, skew } = home;
            let is_there = presence.as_ref().is_none_or(HomePresence::is_there);
            let start = starts[of.homes[index].layout];
            FleetMember { run, rows, presence, skew, start, is_there, last_due: UtcTime::MIN, order: 0 }
        };
        let homes: Vec<FleetMember> = homes.into_iter().enumerate().map(home).collect();
        let done = homes
            .iter()
            .zip(0..)
            .map(|(home, index)| Reverse((clocks.world_time(home.start, RunTime::START, home.skew), index)));
        FleetSimulation {
            by_time: done.collect(),
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

    /// The first messages: the connections of the homes that are online at the start.
    pub fn first(&self) -> Vec<FleetEvent> {
        let there = self.homes.iter().zip(0..).filter(|(home, _)| home.is_there);
        there.map(|(_, index)| FleetEvent::Comes(index)).collect()
    }

    /// The instant that all homes have come to.
    pub fn simulated_to(&self) -> UtcTime {
        self.by_time.peek().map_or(UtcTime::MAX, |Reverse((done, _))| *done)
    }

    /// The next instant with a due message.
    pub fn next_due(&self) -> Option<UtcTime> {
        self.held.peek().map(|Reverse(held)| self.told_at(held.due))
    }

    /// When that is told which is due at an instant: what was due before an outage is told in it, if nobody has come to that before.
    fn told_at(&self, due: UtcTime) -> UtcTime {
        let begin = self.clocks.begin;
        self.storms.map_or(due, |storms| begin + storms.told_at(due - begin))
    }

    /// The fleet begins to tell at this instant: from it outages count, and in runs that go at a speed of their own all that was to
    /// be told from the beginning on is told from then on.
    pub fn begin(&mut self, now: UtcTime) {
        let later = now - std::mem::replace(&mut self.clocks.begin, now);
        if self.clocks.speed.is_none() {
            return;
        }
        let moved = |Reverse((done, home))| Reverse((done + later, home));
        self.by_time = std::mem::take(&mut self.by_time).into_iter().map(moved).collect();
        let moved = |Reverse(held): Reverse<PendingMessage>| {
            let told = match held.told.0 {
                FleetEvent::Row(row) => FleetEvent::Row(FleetRow { due: row.due + later, ..row }),
                told => told,
            };
            Reverse(PendingMessage { due: held.due + later, told: Unordered(told), ..held })
        };
        self.held = std::mem::take(&mut self.held).into_iter().map(moved).collect();
        for home in &mut self.homes {
            home.last_due = home.last_due.saturating_add(later);
        }
    }

    /// Whether all homes are far enough ahead of an instant to start delivery then.
    pub fn is_ready(&self, now: UtcTime) -> bool {
        self.simulated_to() >= now + AHEAD / 2
    }

    /// The number of outages that have ended by then, and whether one is going on.
    pub fn storms(&self, now: UtcTime) -> (u64, bool) {
        let after = now - self.clocks.begin;
        self.storms.map_or((0, false), |storms| (storms.ended(after), storms.is_away(after)))
    }

    /// The instant at which a home must be advanced.
    pub fn next_step(&self) -> UtcTime {
        self.simulated_to().saturating_sub(AHEAD)
    }

    /// The messages that are due by now, at most so many.
    pub fn due(&mut self, now: UtcTime, most: usize, into: &mut Vec<FleetEvent>) {
        while into.len() < most
            && let Some(Reverse(held)) = self.held.peek()
            && self.told_at(held.due) <= now
        {
            let Unordered(mut told) = held.told;
            match &mut told {
                FleetEvent::Row(row) => row.due = self.told_at(row.due),
                FleetEvent::Comes(_) => (self.there, self.came) = (self.there + 1, self.came + 1),
                FleetEvent::Goes(_) => (self.there, self.went) = (self.there - 1, self.went + 1),
            }
            into.push(told);
            self.held.pop();
        }
    }

    /// Advances the home that is least far. False if all are far enough ahead.
    pub fn advance_one(&mut self, now: UtcTime) -> bool {
        let Some(&Reverse((done, index))) = self.by_time.peek() else { return false };
        if done >= now + AHEAD {
            return false;
        }
        self.by_time.pop();
        let share = (i64::from(index) + 1) as f64 / self.homes.len() as f64;
        let home = &mut self.homes[index as usize];
        let step = self.clocks.span(STEP);
        let step = match home.run.now() {
            // Not all of them at once from then on.
            RunTime::START => step.share(share) + Span::MICROSECOND,
            _ => self.clocks.span(STEP.max((now - done) / PART_OF_BEHIND)).min(LONGEST_STEP.max(step)),
        };
        self.events.clear();
        let until = home.run.now().saturating_add(step);
        let ended = home.run.advance_within(until, MOST_EVENTS, &mut self.events).err();
        let clocks = self.clocks;
        home.say(index, &self.events, clocks, &mut self.held);
        match ended {
            None => self.by_time.push(Reverse((clocks.world_time(home.start, home.run.now(), home.skew), index))),
            Some(error) => self.failed.push((index, error)),
        }
        true
    }
}

impl FleetMember {
    /// Takes in what has happened, to be told when its time has come.
    fn say(&mut self, index: u32, events: &Events, clocks: FleetClock, held: &mut BinaryHeap<Reverse<PendingMessage>>) {
        let now = self.run.now();
        let mut said = Vec::new();
        self.rows.of(&events.firings, now, |seq, at, sensor, value| {
            said.push(FleetRow { seq, at, due: UtcTime::EPOCH, home: index, sensor, value });
        });
        for row in said {
            self.come_and_go(row.at, index, clocks, held);
            if self.is_there {
                self.hold(row.at, FleetEvent::Row(row), (index, clocks), held);
            }
        }
        self.come_and_go(now - Span::MICROSECOND, index, clocks, held);
    }

    /// Comes and goes up to an instant.
    fn come_and_go(
        &mut self,
        until: RunTime,
        index: u32,
        clocks: FleetClock,
        held: &mut BinaryHeap<Reverse<PendingMessage>>,
    ) {
        while let Some((at, comes)) = self.presence.as_mut().and_then(|presence| presence.change(until)) {
            self.is_there = comes;
            let told = if comes { FleetEvent::Comes(index) } else { FleetEvent::Goes(index) };
            self.hold(at, told, (index, clocks), held);
        }
    }

    fn hold(
        &mut self,
        at: RunTime,
        mut told: FleetEvent,
        (home, clocks): (u32, FleetClock),
        held: &mut BinaryHeap<Reverse<PendingMessage>>,
    ) {
        let due = clocks.world_time(self.start, at, self.skew).max(self.last_due);
        if let FleetEvent::Row(row) = &mut told {
            row.due = due;
        }
        held.push(Reverse(PendingMessage { due, home, order: self.order, told: Unordered(told) }));
        (self.last_due, self.order) = (due, self.order + 1);
    }
}

#[cfg(test)]
mod tests;
