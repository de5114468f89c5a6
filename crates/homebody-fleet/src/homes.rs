//! Simulates all homes, each a little ahead of the clock, and returns the messages that are due. It has no clock: its caller passes the
//! time.
//!
//! A home is a run of the core, without a [`Simulation`](homebody_simulation::Simulation): that has a recording with all texts of its
//! scenario and buffers of its own, which the homes of a fleet share.

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

/// Time ahead of real time below which a home is simulated further (our choice): ten thousand people who plan
/// their day at midnight take some seconds.
const AHEAD: Span = SECOND.times(30);

/// Real time of a run that is simulated at once (our choice): its events wait in memory.
const STEP: Span = MINUTE;

/// Divisor of the lag that gives the step of a home far behind, and longest step (our choice).
const PART_OF_BEHIND: i64 = 4;
const LONGEST_STEP: Span = HOUR;

/// Number of events after which a step ends, whatever drivers decide (our choice).
const MOST_EVENTS: usize = 100_000;

pub(super) struct FleetSimulation {
    homes: Vec<FleetMember>,
    /// The homes by the end of their simulated part.
    by_time: BinaryHeap<Reverse<(UtcTime, u32)>>,
    pending: BinaryHeap<Reverse<PendingMessage>>,
    clocks: FleetClock,
    outages: Option<Outages>,
    events: Events,
    /// The number of homes whose latest delivered message says that they are online.
    pub there: usize,
    /// The number of connections and disconnections since the start.
    pub came: u64,
    pub went: u64,
    /// The homes whose driver failed: their simulation ended.
    pub failed: Vec<(u32, DriverError)>,
}

struct FleetMember {
    run: Run,
    rows: HomeRows,
    presence: Option<HomePresence>,
    skew: Span,
    start: UtcTime,
    is_there: bool,
    /// The latest due time of its messages: no later message is due earlier.
    last_due: UtcTime,
    order: u64,
}

#[derive(Clone, Copy, Debug)]
struct FleetClock {
    /// The speed from the instant `begin` of real time on; `None` for runs in real time.
    speed: Option<f64>,
    begin: UtcTime,
}

/// A message that waits until it is due. Messages of one home stay in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct PendingMessage {
    due: UtcTime,
    home: u32,
    order: u64,
    event: Unordered,
}

/// An event that plays no part in the order of messages.
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
    /// The real time of an instant of a run that starts at `start`, for a home with a clock that is ahead by `skew`.
    fn real_time(&self, start: UtcTime, at: RunTime, skew: Span) -> UtcTime {
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
    /// All homes of a fleet whose delivery starts at this instant.
    pub fn new(fleet: FleetHomes, begin: UtcTime) -> FleetSimulation {
        let FleetHomes { fleet, homes, speed, outages, starts } = fleet;
        let clocks = FleetClock { speed, begin };
        let home = |(index, home): (usize, UnstartedHome)| {
            let UnstartedHome { run, rows, presence, skew } = home;
            let is_there = presence.as_ref().is_none_or(HomePresence::is_there);
            let start = starts[fleet.homes[index].layout];
            FleetMember { run, rows, presence, skew, start, is_there, last_due: UtcTime::MIN, order: 0 }
        };
        let homes: Vec<FleetMember> = homes.into_iter().enumerate().map(home).collect();
        let done = homes
            .iter()
            .zip(0..)
            .map(|(home, index)| Reverse((clocks.real_time(home.start, RunTime::START, home.skew), index)));
        FleetSimulation {
            by_time: done.collect(),
            pending: BinaryHeap::new(),
            there: homes.iter().filter(|home| home.is_there).count(),
            homes,
            clocks,
            outages,
            events: Events::default(),
            came: 0,
            went: 0,
            failed: Vec::new(),
        }
    }

    pub fn first_messages(&self) -> Vec<FleetEvent> {
        let there = self.homes.iter().zip(0..).filter(|(home, _)| home.is_there);
        there.map(|(_, index)| FleetEvent::Comes(index)).collect()
    }

    pub fn simulated_to(&self) -> UtcTime {
        self.by_time.peek().map_or(UtcTime::MAX, |Reverse((done, _))| *done)
    }

    pub fn next_due(&self) -> Option<UtcTime> {
        self.pending.peek().map(|Reverse(pending)| self.delivery(pending.due))
    }

    /// The delivery of a message that is due at an instant: at once, or at the end of an outage.
    fn delivery(&self, due: UtcTime) -> UtcTime {
        let begin = self.clocks.begin;
        self.outages.map_or(due, |outages| begin + outages.delivery(due - begin))
    }

    /// Starts delivery at this instant. Outages count from it, and with a speed of its own the whole fleet starts at it.
    pub fn start_delivery(&mut self, now: UtcTime) {
        let later = now - std::mem::replace(&mut self.clocks.begin, now);
        if self.clocks.speed.is_none() {
            return;
        }
        let moved = |Reverse((done, home))| Reverse((done + later, home));
        self.by_time = std::mem::take(&mut self.by_time).into_iter().map(moved).collect();
        let moved = |Reverse(pending): Reverse<PendingMessage>| {
            let event = match pending.event.0 {
                FleetEvent::Row(row) => FleetEvent::Row(FleetRow { due: row.due + later, ..row }),
                event => event,
            };
            Reverse(PendingMessage { due: pending.due + later, event: Unordered(event), ..pending })
        };
        self.pending = std::mem::take(&mut self.pending).into_iter().map(moved).collect();
        for home in &mut self.homes {
            home.last_due = home.last_due.saturating_add(later);
        }
    }

    /// Whether all homes are far enough ahead of an instant to start delivery then.
    pub fn is_ready(&self, now: UtcTime) -> bool {
        self.simulated_to() >= now + AHEAD / 2
    }

    /// The number of outages that have ended by an instant, and true during an outage.
    pub fn outages(&self, now: UtcTime) -> (u64, bool) {
        let after = now - self.clocks.begin;
        self.outages.map_or((0, false), |outages| (outages.ended(after), outages.is_away(after)))
    }

    /// The instant at which a home must be advanced.
    pub fn next_step(&self) -> UtcTime {
        self.simulated_to().saturating_sub(AHEAD)
    }

    /// Takes the messages that are due by now, at most so many.
    pub fn due(&mut self, now: UtcTime, most: usize, into: &mut Vec<FleetEvent>) {
        while into.len() < most
            && let Some(Reverse(pending)) = self.pending.peek()
            && self.delivery(pending.due) <= now
        {
            let Unordered(mut event) = pending.event;
            match &mut event {
                FleetEvent::Row(row) => row.due = self.delivery(row.due),
                FleetEvent::Comes(_) => (self.there, self.came) = (self.there + 1, self.came + 1),
                FleetEvent::Goes(_) => (self.there, self.went) = (self.there - 1, self.went + 1),
            }
            into.push(event);
            self.pending.pop();
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
            // Different first steps spread the later steps of the homes over time.
            RunTime::START => step.share(share) + Span::MICROSECOND,
            _ => self.clocks.span(STEP.max((now - done) / PART_OF_BEHIND)).min(LONGEST_STEP.max(step)),
        };
        self.events.clear();
        let until = home.run.now().saturating_add(step);
        let ended = home.run.advance_within(until, MOST_EVENTS, &mut self.events).err();
        let clocks = self.clocks;
        home.queue(index, &self.events, clocks, &mut self.pending);
        match ended {
            None => self.by_time.push(Reverse((clocks.real_time(home.start, home.run.now(), home.skew), index))),
            Some(error) => self.failed.push((index, error)),
        }
        true
    }
}

impl FleetMember {
    /// Queues the messages of the last step until they are due.
    fn queue(
        &mut self,
        index: u32,
        events: &Events,
        clocks: FleetClock,
        pending: &mut BinaryHeap<Reverse<PendingMessage>>,
    ) {
        let now = self.run.now();
        let mut rows = Vec::new();
        self.rows.of(&events.firings, now, |seq, at, sensor, value| {
            rows.push(FleetRow { seq, at, due: UtcTime::EPOCH, home: index, sensor, value });
        });
        for row in rows {
            self.change_presence(row.at, index, clocks, pending);
            if self.is_there {
                self.push(row.at, FleetEvent::Row(row), (index, clocks), pending);
            }
        }
        self.change_presence(now - Span::MICROSECOND, index, clocks, pending);
    }

    fn change_presence(
        &mut self,
        until: RunTime,
        index: u32,
        clocks: FleetClock,
        pending: &mut BinaryHeap<Reverse<PendingMessage>>,
    ) {
        while let Some((at, comes)) = self.presence.as_mut().and_then(|presence| presence.change(until)) {
            self.is_there = comes;
            let event = if comes { FleetEvent::Comes(index) } else { FleetEvent::Goes(index) };
            self.push(at, event, (index, clocks), pending);
        }
    }

    fn push(
        &mut self,
        at: RunTime,
        mut event: FleetEvent,
        (home, clocks): (u32, FleetClock),
        pending: &mut BinaryHeap<Reverse<PendingMessage>>,
    ) {
        let due = clocks.real_time(self.start, at, self.skew).max(self.last_due);
        if let FleetEvent::Row(row) = &mut event {
            row.due = due;
        }
        pending.push(Reverse(PendingMessage { due, home, order: self.order, event: Unordered(event) }));
        (self.last_due, self.order) = (due, self.order + 1);
    }
}

#[cfg(test)]
mod tests;
