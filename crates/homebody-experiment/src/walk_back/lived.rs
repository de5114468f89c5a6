//! A life, as its log and as the truth have it, second by second.

use homebody_core::drivers::MotionSegment;
use homebody_core::drivers::error::DriverError;
use homebody_core::event::{Events, Fact};
use homebody_core::geometry::Point;
use homebody_core::run::{DriverProvider, Run};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{Micros, SECOND};
use homebody_infer::{Message, NotLearnt, Said};
use homebody_log::{LogError, Rows};

/// A home and the lives in it.
pub struct Home<'a> {
    /// The home, with its link.
    pub scenario: &'a Scenario,
    /// Who lives there, and how.
    pub drivers: &'a dyn DriverProvider,
    /// Which of its residents are people, and no pets.
    pub people: Vec<usize>,
}

homebody_core::messages! {
    /// Reasons why residents cannot be located in a simulated log: errors of other areas.
    pub enum NotWalked in "located" {
        => inner {
            /// Homebody cannot compute how the sensors of the home respond.
            Home(NotLearnt);
            /// The log cannot be written.
            Log(LogError);
            /// The simulation failed.
            Lives(DriverError);
        }
    }
}

impl From<NotLearnt> for NotWalked {
    fn from(error: NotLearnt) -> NotWalked {
        NotWalked::Home(error)
    }
}

impl From<LogError> for NotWalked {
    fn from(error: LogError) -> NotWalked {
        NotWalked::Log(error)
    }
}

impl From<DriverError> for NotWalked {
    fn from(error: DriverError) -> NotWalked {
        NotWalked::Lives(error)
    }
}

/// Where somebody is: out, between rooms, or in a room by its index.
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

/// A life that was lived.
pub(crate) struct Lived {
    pub messages: Vec<Message>,
    /// By sensor: the room that it hangs in.
    pub room_of: Vec<Option<usize>>,
    /// How many of the bodies live there; the others visit.
    pub residents: usize,
    /// By body and second.
    pub places: Vec<Vec<Place>>,
    pub at: Vec<Vec<Option<Point>>>,
}

impl Lived {
    pub fn new(home: &Home, seed: u64, length: Micros) -> Result<Lived, NotWalked> {
        let scenario = home.scenario;
        let mut run = Run::new(scenario, home.drivers, seed, length);
        let names: Vec<String> = run.sensors().iter().map(|sensor| sensor.name.clone()).collect();
        let room_of = run.sensors().iter().map(|sensor| sensor.room.map(|room| room.index())).collect();
        let mut rows = Rows::new(&scenario.logger, seed, &names, &scenario.calendar)?;
        let bodies = run.names().len();
        let seconds = (length / SECOND) as usize;
        let mut lived = Lived {
            messages: Vec::new(),
            room_of,
            residents: scenario.residents.len(),
            places: vec![vec![Place::Out; seconds]; bodies],
            at: vec![vec![None; seconds]; bodies],
        };
        let mut events = Events::default();
        while run.now() < length {
            run.advance(run.now() + 3_600 * SECOND, &mut events)?;
            for fact in &events.facts {
                if let Fact::Movement { resident, begin, end, doing, posture } = *fact {
                    let segment = MotionSegment { begin, end, doing, posture };
                    lived.moves(home, resident.index(), &segment);
                }
            }
            let said = rows.of(&events.firings, run.settled());
            lived.messages.extend(said.filter_map(|row| {
                Some(Message { at: row.at, sensor: row.sensor.index(), said: Said::of(&row.value)? })
            }));
            events.clear();
        }
        Ok(lived)
    }

    fn moves(&mut self, home: &Home, body: usize, segment: &MotionSegment) {
        let plan = home.scenario.home.plan();
        // The seconds that begin within it.
        let first = (segment.begin + SECOND - 1) / SECOND;
        let end = (segment.end + SECOND - 1) / SECOND;
        for second in (first.max(0) as usize)..(end as usize).min(self.places[body].len()) {
            let at = segment.position(second as Micros * SECOND);
            self.places[body][second] = Place::of(at, at.and_then(|at| plan.room_at(at)));
            self.at[body][second] = at;
        }
    }
}
