//! A log on the wall clock of its home, with the ground truth and the recording in its folder: the recording has the names of the sensors,
//! the time zone, and the time of the run.

use crate::error::QueryError;
use crate::home_sensors::{name_sensors, rooms_of_log, sensor_rooms};
use crate::log_ref::{IncompleteLog, LogRef};
use crate::long_log::{KeptRows, LongLog, MOST_COMPARED, MOST_ROWS, TakeEvent};
use homebody_analysis::dates::{on_wall, put_on_wall, zone_of};
use homebody_analysis::density::{DensityOptions, Map, Mapping, NoMap};
use homebody_analysis::measures::{HomeKnowledge, Measures, Measuring, Ways};
use homebody_analysis::rows::Tallies;
use homebody_analysis::signs::LogSensors;
use homebody_core::calendar::Calendar;
use homebody_core::names::capitalised;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{Interval, RunTime, Span, TimeScale, WallTime};
use homebody_log::log::Clock;
use homebody_log::run::places::RECORDING;
use homebody_log::source::TruthValue;
use homebody_log::table::truth::{Truth, tables};
use homebody_log::text::one_word;
use homebody_log::truth::truth_rows;
use homebody_log::{Log, Url, read_timeline};
use homebody_timeline::{PersonTimeline, Timeline};
use homebody_walk::Mesh;
use jiff::civil::Date;
use jiff::tz::TimeZone;
use std::collections::BTreeMap;
use std::path::PathBuf;

pub struct LoadedLog {
    /// Its name, with the conditions that its run leaves out.
    pub name: String,
    /// Its rows; `log.clock` says whether they could be put on the wall.
    pub log: Log,
    pub timeline: Timeline<WallTime>,
    /// The rooms of its sensors, by their names in the log, from the home of its run or from the log itself.
    pub rooms: BTreeMap<String, String>,
    /// The time of the run, if that is known.
    pub recorded: Option<Interval<WallTime>>,
    /// The zone of its wall clock, if that is known.
    pub zone: Option<TimeZone>,
    /// The files that the log itself is in.
    pub files: Vec<PathBuf>,
    /// All its files, with those of its ground truth and its recording; an output must not replace them.
    pub sources: Vec<PathBuf>,
    /// The scenario with its home, if that is known: its run's, or the one that its sensors were placed in.
    home: Option<Scenario>,
    /// The place of its rows, if they are too many for memory: then `log` has no rows.
    long: Option<LongLog>,
    /// Its ground truth, and the zone of the home if that is in UTC.
    truth: Option<(Url, Option<TimeZone>)>,
    /// The folder of its run, if that is incomplete: see [`LogRef::incomplete`].
    pub incomplete: Option<IncompleteLog>,
}

/// A message that never reached the logger.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LostMessage {
    /// The time, on the clock of the log.
    pub at: WallTime,
    pub sensor: String,
    pub value: String,
    /// The cause, in a word of the ground truth.
    pub loss: String,
}

impl LoadedLog {
    /// Reads a log by its URL, by its path alone, or by the folder of its run. A log in UTC is put on the wall of `zone`, of its run's
    /// zone, or of the zone by the offsets of its instants; without any it stays in UTC.
    pub fn read(text: &str, zone: Option<&str>) -> Result<LoadedLog, QueryError> {
        LoadedLog::from_ref(LogRef::find(text)?, zone)
    }

    /// Reads a log that was found.
    pub fn from_ref(named: LogRef, zone: Option<&str>) -> Result<LoadedLog, QueryError> {
        let (log, truth) = named.read_with_truth()?;
        LoadedLog::with(named, log, None, truth, zone)
    }

    /// The same of a log of any length. Of one with more than two million rows no rows are in memory: [`LoadedLog::rows`] reads them
    /// again each time.
    pub fn of_any_length(named: LogRef, zone: Option<&str>) -> Result<LoadedLog, QueryError> {
        LoadedLog::of_length(named, zone, MOST_ROWS)
    }

    /// The same, with so many rows in memory at most.
    pub(crate) fn of_length(named: LogRef, zone: Option<&str>, most: usize) -> Result<LoadedLog, QueryError> {
        let (mut kept, mut first) = (KeptRows::new(most), Vec::new());
        let mut log = named.stream(&mut |part| {
            let left = MOST_COMPARED - first.len();
            first.extend(part.events.iter().take(left).copied());
            kept.take(part);
        })?;
        let long = kept.give(&mut log, &named.place, &named.mapping);
        let truth = named.truth_of_run(&mut log, first)?;
        LoadedLog::with(named, log, long, truth, zone)
    }

    /// The log alone, without its truth. Only its first `most` rows are in memory; `log.rows` is the number of all.
    pub fn alone(named: LogRef, zone: Option<&str>, most: usize) -> Result<LoadedLog, QueryError> {
        let mut events = Vec::new();
        let mut log = named.stream(&mut |part| {
            let left = most - events.len();
            events.extend(part.events.iter().take(left));
        })?;
        log.events = events;
        LoadedLog::with(named, log, None, None, zone)
    }

    fn with(
        named: LogRef,
        mut log: Log,
        mut long: Option<LongLog>,
        truth: Option<Url>,
        zone: Option<&str>,
    ) -> Result<LoadedLog, QueryError> {
        let asked = zone.map(|name| Calendar::zone(name).map_err(|_| QueryError::zone(name))).transpose()?;
        // Days are drawn on the wall, so these are the instants as the truth tells them.
        let as_told = TimeScale::one();
        let timeline = truth.as_ref().map(|truth| read_timeline(truth, &as_told)).transpose()?.unwrap_or_default();
        let incomplete = named.incomplete();
        let known_zone = named.zone();
        let LogRef { name, place, run, scenario, .. } = named;
        if let Some(scenario) = &scenario {
            name_sensors(&mut log, scenario);
        }
        let rooms = scenario.as_ref().map_or_else(|| rooms_of_log(&log), sensor_rooms);
        let zone = asked.or(known_zone).or_else(|| zone_of(&log));
        let of_utc = zone.clone().filter(|_| log.clock == Clock::Utc);
        // The recording of an incomplete run has the length asked for, and not the simulated one.
        let lived = run.as_ref().filter(|run| run.is_complete());
        let span = scenario.as_ref().zip(lived).map(|(scenario, run)| {
            let wall = |at| WallTime::from(scenario.calendar.local(at).datetime());
            Interval::starting(RunTime::START, run.length_us).map(wall)
        });
        let wall = |at| {
            let at = as_told.run_to_wall(at);
            of_utc.as_ref().map_or(at, |zone| on_wall(at, zone))
        };
        let timeline = timeline.map(wall);
        if let Some(zone) = &of_utc {
            put_on_wall(&mut log, zone);
            long.iter_mut().for_each(|long| long.put_on_wall(zone));
        }
        // A recording that lies there by chance is of another time.
        let rows = rows_span(&log, long.as_ref());
        let recorded = span.filter(|span| rows.is_none_or(|rows| span.contains(rows.begin) && span.contains(rows.end)));
        let beside = Some(place.path().with_file_name(RECORDING)).filter(|path| path.is_file());
        let of_truth = truth.as_ref().map(|truth| truth.files(&tables())).unwrap_or_default();
        let files = place.files();
        let sources = files.iter().cloned().chain(of_truth).chain(beside).collect();
        let without = run.map(|run| run.without).filter(|without| !without.is_empty());
        let name = name + without.map_or_else(String::new, |names| format!(", without {}", names.join(", "))).as_str();
        let (home, truth) = (scenario, truth.map(|truth| (truth, of_utc)));
        Ok(LoadedLog { name, log, timeline, rooms, recorded, zone, files, sources, home, long, truth, incomplete })
    }

    /// Gives its sensors the names and rooms that they have in the home of a scenario. Returns the number of them in that home.
    pub fn place_in(&mut self, scenario: &Scenario) -> usize {
        name_sensors(&mut self.log, scenario);
        self.rooms = sensor_rooms(scenario);
        self.home = Some(scenario.clone());
        self.log.sensors.iter().filter(|sensor| self.rooms.contains_key(*sensor)).count()
    }

    pub fn scenario(&self) -> Option<&Scenario> {
        self.home.as_ref()
    }

    /// The ways between the sensors in its home, if that is known. It takes some tenths of a second.
    fn ways(&self) -> Option<Ways> {
        let scenario = self.home.as_ref()?;
        let radius_m = scenario.residents.first()?.file.radius_m;
        let mesh = Mesh::with_numbers(scenario.home.plan(), radius_m, scenario.home.numbers());
        let called = |name: &str| {
            let id = scenario.logger.ids.get(name).map_or(name, String::as_str);
            vec![id.to_owned(), one_word(id)]
        };
        Some(Ways::from_home(&scenario.home, &|from, to| mesh.path(from, to), &called))
    }

    /// The options of a map of its density: the whole log, with its time and zone, if they are known.
    pub fn density_asked(&self) -> DensityOptions {
        DensityOptions { recorded: self.recorded, zone: self.zone.clone(), ..DensityOptions::default() }
    }

    /// Passes on its rows in the order of time, from memory or from their place.
    pub fn rows(&self, take: TakeEvent) -> Result<(), NoMap> {
        match &self.long {
            Some(long) => long.rows(take),
            None => self.log.in_order().into_iter().try_for_each(take),
        }
    }

    /// From the first instant of its rows to the last.
    pub fn rows_span(&self) -> Option<Interval<WallTime>> {
        rows_span(&self.log, self.long.as_ref())
    }

    /// The map of its density.
    pub fn density(&self, asked: &DensityOptions) -> Result<Map, NoMap> {
        let mut tallies = Tallies::new(&self.log);
        self.rows(&mut |row| {
            tallies.take(row);
            Ok(())
        })?;
        let called = self.log.called();
        let kinds = tallies.kinds();
        let mut mapping = Mapping::new(&self.log, LogSensors { called, kinds }, asked);
        self.rows(&mut |row| {
            mapping.take(row);
            Ok(())
        })?;
        mapping.end(&self.name)
    }

    /// Measures of its days, with all that its home tells.
    pub fn measures(&self) -> Result<Measures, NoMap> {
        let asked = DensityOptions { recorded: self.recorded, ..DensityOptions::default() };
        let ways = self.ways();
        let known = HomeKnowledge { rooms: &self.rooms, ways: ways.as_ref() };
        let mut measuring = Measuring::new(&self.log, known, &asked);
        self.rows(&mut |row| measuring.take(row))?;
        let mut measures = Measures::from_rows(&self.name, measuring)?;
        let residents = self.residents();
        if residents.len() > 1 {
            measures.remarks.push(format!(
                "The sensors cannot tell residents apart; this covers everybody together: {}; pass --resident NAME for one of them by the ground truth",
                residents.join(", ")
            ));
        }
        Ok(measures)
    }

    /// The residents of its home, or of the ground truth.
    pub fn residents(&self) -> Vec<&str> {
        match &self.home {
            Some(home) => home.residents.iter().map(|resident| resident.file.name.as_str()).collect(),
            None => self.timeline.people.iter().map(|person| person.name.as_str()).collect(),
        }
    }

    /// The subject of sentences about the log: the name of the only resident.
    pub fn subject(&self) -> String {
        match self.residents()[..] {
            [] => "the resident".to_owned(),
            [one] => capitalised(one),
            _ => "a resident".to_owned(),
        }
    }

    /// The messages that never reached the logger, in order, by the ground truth; `None` without one.
    pub fn lost(&self) -> Result<Option<Vec<LostMessage>>, QueryError> {
        let Some((truth, zone)) = &self.truth else { return Ok(None) };
        let mut all = Vec::new();
        let as_told = TimeScale::one();
        truth_rows(truth, Truth::Lost, &as_told, &mut |cells| {
            let text = |index: usize| match cells.get(index) {
                Some(TruthValue::Text(text)) => (*text).to_owned(),
                _ => String::new(),
            };
            if let Some(&TruthValue::Integer(at)) = cells.get(2) {
                let at = as_told.run_to_wall(RunTime::from_micros(at));
                let at = zone.as_ref().map_or(at, |zone| on_wall(at, zone));
                let ids = self.home.iter().flat_map(|scenario| &scenario.logger.ids);
                let sensor =
                    ids.into_iter().find(|(_, id)| **id == text(0)).map_or_else(|| text(0), |(name, _)| name.clone());
                all.push(LostMessage { at, sensor, value: text(1), loss: text(4) });
            }
            Ok(())
        })?;
        all.sort_by_key(|lost| lost.at);
        Ok(Some(all))
    }

    /// The times with guests at home, by the ground truth; `None` if the residents are unknown.
    pub fn company(&self) -> Option<Vec<Interval<WallTime>>> {
        self.home.as_ref()?;
        let residents = self.residents();
        let is_guest = |person: &&PersonTimeline<WallTime>| !residents.contains(&person.name.as_str());
        let guests = self.timeline.people.iter().filter(is_guest);
        Some(guests.flat_map(|guest| guest.rooms.iter().map(|room| room.time)).collect())
    }

    pub fn ended(&self) -> Option<WallTime> {
        self.recorded.map(|recorded| recorded.end)
    }

    /// The first and the last of its dates: those of its run, even without rows, or else those of its rows.
    pub fn dates(&self) -> Option<(Date, Date)> {
        let of_run = self.recorded.map(|run| (run.begin.date(), (run.end - Span::MICROSECOND).date()));
        of_run.or_else(|| self.rows_span().map(|rows| (rows.begin.date(), rows.end.date())))
    }
}

fn rows_span(log: &Log, long: Option<&LongLog>) -> Option<Interval<WallTime>> {
    let times = || log.events.iter().map(|event| Interval::instant(event.at));
    long.map(LongLog::span).or_else(|| times().reduce(Interval::hull))
}
