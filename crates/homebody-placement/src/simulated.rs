//! Simulates homes into logs, with the ground truth of their first residents.

use homebody_analysis::density::{DensityOptions, NoMap};
use homebody_analysis::measures::{HomeKnowledge, Measures, TimedWalk, TruthDetails, Ways};
use homebody_core::drivers::error::DriverError;
use homebody_core::event::Fact;
use homebody_core::motion::MotionState;
use homebody_core::run::DriverProvider;
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::Sensor;
use homebody_core::time::{DAY, Interval, RunTime, SECOND, Span, WallTime};
use homebody_log::{Event, Log, LogError, SimulatedRun};
use homebody_timeline::{PersonTimeline, TimelineBuilder};
use std::collections::BTreeMap;

homebody_core::messages! {
    /// Reasons why a home cannot be simulated and measured: errors of other areas.
    pub enum SimulatedLogError in "measured" {
        => inner {
            /// The simulation failed.
            Run(DriverError);
            /// The log cannot be written.
            Log(LogError);
            /// The log has no measures.
            NoMap(NoMap);
        }
    }
}

impl From<DriverError> for SimulatedLogError {
    fn from(error: DriverError) -> SimulatedLogError {
        SimulatedLogError::Run(error)
    }
}

impl From<LogError> for SimulatedLogError {
    fn from(error: LogError) -> SimulatedLogError {
        SimulatedLogError::Log(error)
    }
}

impl From<NoMap> for SimulatedLogError {
    fn from(error: NoMap) -> SimulatedLogError {
        SimulatedLogError::NoMap(error)
    }
}

pub struct SimulatedLog {
    log: Log,
    person: PersonTimeline<WallTime>,
    details: TruthDetails,
    rooms: BTreeMap<String, String>,
    /// By sensor, the indices of its rows.
    of_sensors: Vec<Vec<u32>>,
    ways: Option<Ways>,
    recorded: Interval<WallTime>,
}

impl SimulatedLog {
    pub fn simulate(
        scenario: &Scenario,
        drivers: &dyn DriverProvider,
        seed: u64,
        days: u32,
    ) -> Result<SimulatedLog, SimulatedLogError> {
        let length = i64::from(days) * DAY;
        let wall = |at: RunTime| WallTime::from(scenario.calendar.local(at).datetime());
        let run = SimulatedRun::new(scenario, drivers, seed, length)?;
        let mut timeline = TimelineBuilder::for_run(run.run());
        let mut walks = Walks::default();
        let mut log = run.into_log(wall, |facts| {
            timeline.take(facts);
            facts.iter().for_each(|fact| walks.take(fact, &wall));
        })?;
        log.events.sort_by_key(|event| event.at);
        let mut of_sensors = vec![Vec::new(); log.sensors.len()];
        (0..).zip(&log.events).for_each(|(place, event)| of_sensors[event.sensor as usize].push(place));
        let mut people = timeline.finish(RunTime::START + length).map(wall).people;
        let guests = people.split_off(scenario.residents.len());
        let company = guests.into_iter().flat_map(|guest| guest.rooms).map(|stay| stay.time).collect();
        let sensors = scenario.home.placed_sensors();
        let room = |sensor: &Sensor| Some((sensor.name.clone(), sensor.info(scenario.home.plan()).room?));
        let begin = WallTime::midnight(scenario.calendar.local(RunTime::START).date());
        Ok(SimulatedLog {
            log,
            person: people.into_iter().next().unwrap_or_default(),
            details: TruthDetails { walks: Some(walks.walks), company: Some(company) },
            rooms: sensors.iter().filter_map(room).collect(),
            of_sensors,
            ways: None,
            recorded: Interval::starting(begin, length),
        })
    }

    pub fn with_ways(self, ways: Option<Ways>) -> SimulatedLog {
        SimulatedLog { ways, ..self }
    }

    pub fn measures(&self) -> Result<Measures, SimulatedLogError> {
        self.measures_of(&self.log)
    }

    pub fn measures_by(&self, keep: &dyn Fn(&str) -> bool) -> Result<Measures, SimulatedLogError> {
        let (mut sensors, mut rows): (Vec<String>, Vec<(u32, u32)>) = Default::default();
        for (name, places) in self.log.sensors.iter().zip(&self.of_sensors).filter(|(name, _)| keep(name)) {
            let sensor = sensors.len() as u32;
            rows.extend(places.iter().map(|&place| (place, sensor)));
            sensors.push(name.clone());
        }
        // Those of each sensor are in order, so a stable sort merges them.
        rows.sort();
        let event = |&(place, sensor): &(u32, u32)| Event { sensor, ..self.log.events[place as usize] };
        let (values, events) = (self.log.values.clone(), rows.iter().map(event).collect());
        let log = Log { sensors, values, events, ..Log::default() };
        self.measures_of(&log)
    }

    pub fn true_measures(&self) -> Measures {
        Measures::from_detailed_truth("", &self.person, &self.details, self.recorded)
    }

    fn measures_of(&self, log: &Log) -> Result<Measures, SimulatedLogError> {
        let asked = DensityOptions { recorded: Some(self.recorded), ..DensityOptions::default() };
        let known = HomeKnowledge { rooms: &self.rooms, ways: self.ways.as_ref() };
        Ok(Measures::from_log("", log, &known, &asked)?)
    }
}

#[derive(Default)]
struct Walks {
    walks: Vec<TimedWalk>,
    last: (Interval<RunTime>, f64),
}

/// Length below which a walk is not counted (our choice): a step or two.
const LEAST_WALK_M: f64 = 2.0;
/// Stop after which a new walk begins (our choice).
const STOPS: Span = SECOND;

impl Walks {
    fn take(&mut self, fact: &Fact, wall: &dyn Fn(RunTime) -> WallTime) {
        let Fact::Movement { resident, begin, end, doing: MotionState::Stride { from, to }, .. } = fact else { return };
        if resident.index() > 0 {
            return;
        }
        if *begin - self.last.0.end > STOPS {
            let (time, metres) = self.last;
            if metres >= LEAST_WALK_M {
                self.walks.push(TimedWalk { at: wall(time.end), speed_m_s: metres / time.length().seconds() });
            }
            self.last = (Interval::new(*begin, *end), 0.0);
        }
        self.last.0.end = *end;
        self.last.1 += from.distance(*to);
    }
}
