//! Measures of days taken from logs, held against the same taken from what residents did.

use crate::walk_back::{Home, NotWalked};
use homebody_analysis::dates::midnight;
use homebody_analysis::density::{Asked, NoMap};
use homebody_analysis::measures::{Beside, Known, MEASURES, Measures, Walk, Ways};
use homebody_core::event::{Events, Fact, MotionState};
use homebody_core::run::Run;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::sensors::Sensor;
use homebody_core::time::{DAY, Micros, SECOND, seconds};
use homebody_log::{Activity, Event, Life, Log, Rows};
use homebody_walk::Mesh;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::Range;

/// How a measure of a home's log differs from the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Error {
    /// The measure's name.
    pub measure: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// By day on which both are known: what the log says, and what was so.
    #[serde(skip)]
    pub pairs: Vec<(f64, f64)>,
    /// On how many days both are known.
    pub days: usize,
    /// The mean of the truth.
    pub mean_true: f64,
    /// The mean of what the log says, less that of the truth.
    pub bias: f64,
    /// The mean of how far the two are apart.
    pub mean_error: f64,
    /// On nine days of ten they are no farther apart.
    pub p90_error: f64,
    /// How well the log follows the truth from day to day: Pearson's correlation; `None` where either never changes.
    pub correlation: Option<f64>,
}

impl Error {
    /// Of pairs of what a log says and what was so; `None` without any.
    pub fn of(measure: &'static str, unit: &'static str, pairs: Vec<(f64, f64)>) -> Option<Error> {
        let count = pairs.len() as f64;
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(of).sum::<f64>() / count;
        let mut apart: Vec<f64> = pairs.iter().map(|(heard, lived)| (heard - lived).abs()).collect();
        apart.sort_by(f64::total_cmp);
        let p90_error = *apart.get(((count - 1.0) * 0.9).max(0.0).round() as usize)?;
        let (mean_heard, mean_true) = (mean(&|pair| pair.0), mean(&|pair| pair.1));
        let together = mean(&|pair| (pair.0 - mean_heard) * (pair.1 - mean_true));
        let spread = [mean(&|pair| (pair.0 - mean_heard).powi(2)), mean(&|pair| (pair.1 - mean_true).powi(2))];
        let spread = spread[0].sqrt() * spread[1].sqrt();
        Some(Error {
            measure,
            unit,
            days: pairs.len(),
            mean_true,
            bias: mean_heard - mean_true,
            mean_error: apart.iter().sum::<f64>() / count,
            p90_error,
            correlation: (spread > 1e-12).then(|| together / spread),
            pairs,
        })
    }

    /// All days of several homes together.
    pub fn all<'a>(of_homes: impl Iterator<Item = &'a Error> + Clone) -> Vec<Error> {
        let of_measure = |measure: &homebody_analysis::measures::Measure| {
            let same = of_homes.clone().filter(|error| error.measure == measure.name);
            Error::of(measure.name, measure.unit, same.flat_map(|error| error.pairs.iter().copied()).collect())
        };
        MEASURES.iter().filter_map(of_measure).collect()
    }
}

homebody_core::messages! {
    /// Reasons why a simulated log cannot be measured: errors of other areas.
    pub enum NotMeasured in "measured" {
        => inner {
            /// The simulation failed, or its log cannot be written.
            Lives(NotWalked);
            /// The log has no measures.
            NoMap(NoMap);
        }
    }
}

impl From<NotWalked> for NotMeasured {
    fn from(error: NotWalked) -> NotMeasured {
        NotMeasured::Lives(error)
    }
}

impl From<NoMap> for NotMeasured {
    fn from(error: NoMap) -> NotMeasured {
        NotMeasured::NoMap(error)
    }
}

/// Lives a home of one resident for so many days, and measures its log and its truth.
///
/// # Errors
///
/// If the home cannot be lived in, or its log tells of no motion.
pub fn case(home: &Home, seed: u64, days: u32) -> Result<Vec<Error>, NotMeasured> {
    let logged = LoggedLife { ways: ways(home), ..LoggedLife::live(home, seed, days)? };
    Ok(beside(&logged.heard()?, &logged.lived()))
}

/// Measures of a log beside those that are taken for true, on the days that both know.
pub fn beside(heard: &Measures, lived: &Measures) -> Vec<Error> {
    let errors = MEASURES.iter().enumerate().filter_map(|(number, measure)| {
        let pairs = heard.days.iter().filter_map(|day| {
            let lived = lived.days.iter().find(|lived| lived.date == day.date)?;
            day.values[number].zip(lived.values[number])
        });
        Error::of(measure.name, measure.unit, pairs.collect())
    });
    errors.collect()
}

/// A life of days, with the log of it.
pub struct LoggedLife {
    log: Log,
    life: Life,
    beside: Beside,
    rooms: BTreeMap<String, String>,
    /// By sensor, the places of its rows in the log.
    of_sensors: Vec<Vec<u32>>,
    /// How far it is from sensor to sensor, where that is asked for.
    ways: Option<Ways>,
    recorded: Range<Micros>,
}

/// How far it is from sensor to sensor in a home, as its first resident walks.
fn ways(home: &Home) -> Option<Ways> {
    let scenario = home.scenario;
    let resident = scenario.residents.first()?;
    let mesh = Mesh::with_numbers(scenario.home.plan(), resident.file.radius_m, scenario.home.numbers());
    Some(Ways::of(&scenario.home, &|from, to| mesh.path(from, to), &|_| Vec::new()))
}

impl LoggedLife {
    /// Lives a home for so many days; the life is that of the first resident.
    ///
    /// # Errors
    ///
    /// If the home cannot be lived in.
    pub fn live(home: &Home, seed: u64, days: u32) -> Result<LoggedLife, NotMeasured> {
        let Lived { mut log, life, beside } = lived(home, seed, i64::from(days) * DAY)?;
        log.events.sort_by_key(|event| event.at);
        let mut of_sensors = vec![Vec::new(); log.sensors.len()];
        (0..).zip(&log.events).for_each(|(place, event)| of_sensors[event.sensor as usize].push(place));
        let sensors = home.scenario.home.placed_sensors();
        let room = |sensor: &Sensor| Some((sensor.name.clone(), sensor.info(home.scenario.home.plan()).room?));
        let begin = midnight(home.scenario.calendar.local(0).date());
        let rooms = sensors.iter().filter_map(room).collect();
        let recorded = begin..begin + i64::from(days) * DAY;
        Ok(LoggedLife { log, life, beside, rooms, of_sensors, ways: None, recorded })
    }

    /// Measures of the days by the log.
    ///
    /// # Errors
    ///
    /// If it tells of no motion.
    pub fn heard(&self) -> Result<Measures, NotMeasured> {
        self.heard_of(&self.log)
    }

    /// The same by some of the sensors alone.
    ///
    /// # Errors
    ///
    /// If none of them looks for motion.
    pub fn heard_by(&self, keep: &dyn Fn(&str) -> bool) -> Result<Measures, NotMeasured> {
        let (mut sensors, mut rows): (Vec<String>, Vec<(u32, u32)>) = Default::default();
        for (name, places) in self.log.sensors.iter().zip(&self.of_sensors).filter(|(name, _)| keep(name)) {
            let sensor = sensors.len() as u32;
            rows.extend(places.iter().map(|&place| (place, sensor)));
            sensors.push(name.clone());
        }
        // Those of each sensor are in order, so that a stable sort merges them.
        rows.sort();
        let event = |&(place, sensor): &(u32, u32)| Event { sensor, ..self.log.events[place as usize] };
        let (values, events) = (self.log.values.clone(), rows.iter().map(event).collect());
        let log = Log { sensors, values, events, ..Log::default() };
        self.heard_of(&log)
    }

    /// The same measures by what the resident did.
    pub fn lived(&self) -> Measures {
        Measures::lived_beside("", &self.life, &self.beside, self.recorded.clone())
    }

    fn heard_of(&self, log: &Log) -> Result<Measures, NotMeasured> {
        let asked = Asked { recorded: Some(self.recorded.clone()), ..Asked::default() };
        let known = Known { rooms: &self.rooms, ways: self.ways.as_ref() };
        Ok(Measures::heard("", log, &known, &asked)?)
    }
}

/// A log by the home's own names of sensors, the life of the first resident, and what is known besides, all on the clock on the wall.
struct Lived {
    log: Log,
    life: Life,
    beside: Beside,
}

fn lived(home: &Home, seed: u64, length: Micros) -> Result<Lived, NotWalked> {
    let scenario = home.scenario;
    let mut run = Run::new(scenario, home.drivers, seed, length);
    let names: Vec<String> = run.sensors().iter().map(|sensor| sensor.name.clone()).collect();
    let logger = LoggerFile { time: TimeFormat::Local, ..scenario.logger.clone() };
    let mut rows = Rows::new(&logger, seed, &names, &scenario.calendar)?;
    let wall = |at: Micros| {
        let local = scenario.calendar.local(at);
        local.timestamp().as_microsecond() + i64::from(local.offset().seconds()) * SECOND
    };
    let mut log = Log { sensors: names, ..Log::default() };
    let mut life = Life::default();
    let mut events = Events::default();
    let mut known: BTreeMap<String, u32> = BTreeMap::new();
    let mut walking = Walking::default();
    let mut guests = Guests { residents: scenario.residents.len(), ..Guests::default() };
    while run.now() < length {
        run.advance((run.now() + DAY / 24).min(length), &mut events)?;
        for fact in &events.facts {
            walking.take(fact, &wall);
            guests.take(fact, &wall);
            let (at, name, spans) = match fact {
                Fact::Room { resident, at, room } if resident.index() == 0 => {
                    let name = room.map(|room| scenario.home.plan().rooms[room.index()].name.clone());
                    (at, name, &mut life.rooms)
                }
                Fact::Activity { resident, at, name } if resident.index() == 0 => {
                    (at, name.clone(), &mut life.activities)
                }
                _ => continue,
            };
            if let Some(last) = spans.last_mut().filter(|last| last.end == Micros::MAX) {
                last.end = wall(*at);
            }
            spans.extend(name.map(|name| Activity { name, begin: wall(*at), end: Micros::MAX }));
        }
        for row in rows.of(&events.firings, run.settled()) {
            let next = known.len() as u32;
            let value = *known.entry(row.value.clone()).or_insert(next);
            if value == next {
                log.values.push(row.value);
            }
            log.events.push(Event { at: wall(row.at), sensor: row.sensor.0, value });
        }
        events.clear();
    }
    for spans in [&mut life.rooms, &mut life.activities] {
        spans.iter_mut().filter(|span| span.end == Micros::MAX).for_each(|span| span.end = wall(length));
    }
    let company = guests.end(wall(length));
    Ok(Lived { log, life, beside: Beside { walks: Some(walking.walks), company: Some(company) } })
}

/// The walks of the first resident that are long enough.
#[derive(Default)]
struct Walking {
    walks: Vec<Walk>,
    /// From when to when the last one was, and how many metres.
    last: (Micros, Micros, f64),
}

/// Length below which a walk is a step or two (our choice).
const LEAST_WALK_M: f64 = 2.0;
/// Stop after which a new walk begins (our choice).
const STOPS: Micros = SECOND;

impl Walking {
    fn take(&mut self, fact: &Fact, wall: &dyn Fn(Micros) -> Micros) {
        let Fact::Movement { resident, begin, end, doing: MotionState::Stride { from, to }, .. } = fact else { return };
        if resident.index() > 0 {
            return;
        }
        if *begin - self.last.1 > STOPS {
            let (from, to, metres) = self.last;
            if metres >= LEAST_WALK_M {
                self.walks.push(Walk { at: wall(to), speed_m_s: metres / seconds(to - from) });
            }
            self.last = (*begin, *end, 0.0);
        }
        self.last.1 = *end;
        self.last.2 += from.distance(*to);
    }
}

/// When guests are in the home.
#[derive(Default)]
struct Guests {
    residents: usize,
    /// By guest: since when they are in a room.
    since: BTreeMap<usize, Micros>,
    spans: Vec<(Micros, Micros)>,
}

impl Guests {
    fn take(&mut self, fact: &Fact, wall: &dyn Fn(Micros) -> Micros) {
        let Fact::Room { resident, at, room } = fact else { return };
        if resident.index() < self.residents {
            return;
        }
        if let Some(since) = self.since.remove(&resident.index()) {
            self.spans.push((since, wall(*at)));
        }
        if room.is_some() {
            self.since.insert(resident.index(), wall(*at));
        }
    }

    fn end(mut self, at: Micros) -> Vec<(Micros, Micros)> {
        self.spans.extend(self.since.into_values().map(|since| (since, at)));
        self.spans
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_told_beside_the_truth() {
        let error = Error::of("meals", "times", vec![(3.0, 3.0), (4.0, 3.0), (1.0, 2.0), (5.0, 4.0)]).unwrap();
        assert_eq!((error.days, error.mean_true, error.bias, error.mean_error), (4, 3.0, 0.25, 0.75));
        assert!((error.p90_error - 1.0).abs() < 1e-9 && error.correlation.unwrap() > 0.9);
        assert_eq!(Error::of("meals", "times", Vec::new()), None);
        assert_eq!(Error::of("meals", "times", vec![(1.0, 2.0); 3]).unwrap().correlation, None);
    }
}
