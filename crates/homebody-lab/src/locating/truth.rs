//! Simulated runs: the messages of their logs, and the truth of each second.

use homebody_core::drivers::error::DriverError;
use homebody_core::event::Fact;
use homebody_core::geometry::Point;
use homebody_core::motion::MotionSegment;
use homebody_core::run::DriverProvider;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_infer::{LogMessage, MessageKind, ResponseError};
use homebody_log::{LogError, SimulatedRun};

pub struct SimulatedHome<'a> {
    pub scenario: &'a Scenario,
    pub drivers: &'a dyn DriverProvider,
    /// The residents that are people, not pets.
    pub people: Vec<usize>,
}

homebody_core::messages! {
    /// Reasons why residents cannot be located in a simulated log: errors of other areas.
    pub enum LocatingError in "located" {
        => inner {
            /// Homebody cannot compute how the sensors of the home respond.
            Home(ResponseError);
            /// The log cannot be written.
            Log(LogError);
            /// The simulation failed.
            Run(DriverError);
        }
    }
}

from_errors!(LocatingError: Home(ResponseError), Log(LogError), Run(DriverError));

/// The place of a person: out, between rooms, or in a room by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PersonPlace {
    Out,
    Between,
    Room(usize),
}

impl PersonPlace {
    pub(crate) fn new(at: Option<Point>, room: Option<usize>) -> PersonPlace {
        match (at, room) {
            (None, _) => PersonPlace::Out,
            (_, None) => PersonPlace::Between,
            (_, Some(room)) => PersonPlace::Room(room),
        }
    }
}

pub(crate) fn second_begins(second: usize) -> RunTime {
    RunTime::START + second as i64 * SECOND
}

pub(crate) struct MessagesWithTruth {
    pub messages: Vec<LogMessage>,
    /// By sensor: its room.
    pub room_of: Vec<Option<usize>>,
    /// The number of residents among the bodies; the others are visitors.
    pub residents: usize,
    pub places: Vec<Vec<PersonPlace>>,
    pub at: Vec<Vec<Option<Point>>>,
}

impl MessagesWithTruth {
    pub fn simulate(home: &SimulatedHome, seed: u64, length: Span) -> Result<MessagesWithTruth, LocatingError> {
        let mut simulated = SimulatedRun::new(home.scenario, home.drivers, seed, length)?;
        let run = simulated.run();
        let (bodies, seconds) = (run.names().len(), (length / SECOND) as usize);
        let mut all = MessagesWithTruth {
            messages: Vec::new(),
            room_of: run.sensors().iter().map(|sensor| sensor.room.map(|room| room.index())).collect(),
            residents: home.scenario.residents.len(),
            places: vec![vec![PersonPlace::Out; seconds]; bodies],
            at: vec![vec![None; seconds]; bodies],
        };
        simulated.each_hour(|facts, rows| {
            for fact in facts {
                if let Fact::Movement { resident, begin, end, doing, posture } = *fact {
                    all.moves(home, resident.index(), &MotionSegment { begin, end, doing, posture });
                }
            }
            all.messages.extend(rows.filter_map(|row| {
                Some(LogMessage { at: row.at, sensor: row.sensor.index(), said: MessageKind::from_value(&row.value)? })
            }));
        })?;
        Ok(all)
    }

    fn moves(&mut self, home: &SimulatedHome, body: usize, segment: &MotionSegment) {
        let plan = home.scenario.home.plan();
        // The seconds that begin within it.
        let next_second = |at: RunTime| (at.since_zero() + SECOND - Span::MICROSECOND) / SECOND;
        let (first, end) = (next_second(segment.begin), next_second(segment.end));
        for second in (first.max(0) as usize)..(end as usize).min(self.places[body].len()) {
            let at = segment.position(second_begins(second));
            self.places[body][second] = PersonPlace::new(at, at.and_then(|at| plan.room_at(at)));
            self.at[body][second] = at;
        }
    }
}
