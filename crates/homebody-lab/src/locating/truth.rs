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

/// A home and its residents.
pub struct Home<'a> {
    /// The home, with its link.
    pub scenario: &'a Scenario,
    /// The drivers of its residents.
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

impl From<ResponseError> for LocatingError {
    fn from(error: ResponseError) -> LocatingError {
        LocatingError::Home(error)
    }
}

impl From<LogError> for LocatingError {
    fn from(error: LogError) -> LocatingError {
        LocatingError::Log(error)
    }
}

impl From<DriverError> for LocatingError {
    fn from(error: DriverError) -> LocatingError {
        LocatingError::Run(error)
    }
}

/// The place of a person: out, between rooms, or in a room by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    Out,
    Between,
    Room(usize),
}

impl Place {
    pub(crate) fn of(at: Option<Point>, room: Option<usize>) -> Place {
        match (at, room) {
            (None, _) => Place::Out,
            (_, None) => Place::Between,
            (_, Some(room)) => Place::Room(room),
        }
    }
}

/// The beginning of a second of a run.
pub(crate) fn second_begins(second: usize) -> RunTime {
    RunTime::START + second as i64 * SECOND
}

/// The messages of a simulated run, and the truth of each second.
pub(crate) struct MessagesWithTruth {
    pub messages: Vec<LogMessage>,
    /// By sensor: the room that it hangs in.
    pub room_of: Vec<Option<usize>>,
    /// The number of bodies that live there; the others visit.
    pub residents: usize,
    /// By body and second.
    pub places: Vec<Vec<Place>>,
    pub at: Vec<Vec<Option<Point>>>,
}

impl MessagesWithTruth {
    pub fn simulate(home: &Home, seed: u64, length: Span) -> Result<MessagesWithTruth, LocatingError> {
        let mut simulated = SimulatedRun::new(home.scenario, home.drivers, seed, length)?;
        let run = simulated.run();
        let (bodies, seconds) = (run.names().len(), (length / SECOND) as usize);
        let mut all = MessagesWithTruth {
            messages: Vec::new(),
            room_of: run.sensors().iter().map(|sensor| sensor.room.map(|room| room.index())).collect(),
            residents: home.scenario.residents.len(),
            places: vec![vec![Place::Out; seconds]; bodies],
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

    fn moves(&mut self, home: &Home, body: usize, segment: &MotionSegment) {
        let plan = home.scenario.home.plan();
        // The seconds that begin within it.
        let next_second = |at: RunTime| (at.since_zero() + SECOND - Span::MICROSECOND) / SECOND;
        let (first, end) = (next_second(segment.begin), next_second(segment.end));
        for second in (first.max(0) as usize)..(end as usize).min(self.places[body].len()) {
            let at = segment.position(second_begins(second));
            self.places[body][second] = Place::of(at, at.and_then(|at| plan.room_at(at)));
            self.at[body][second] = at;
        }
    }
}
