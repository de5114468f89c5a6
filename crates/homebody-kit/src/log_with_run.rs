//! A log that somebody names, and what lies beside it where a run left it: the truth, and the recording, which knows the
//! sensors' own names, the time zone, and from when to when the run was.

use crate::error::Error;
use crate::long_log::{Kept, LongLog, MOST_COMPARED, MOST_ROWS, TakeRow};
use homebody_analysis::dates::{date_of, on_wall, put_on_wall, zone_of};
use homebody_analysis::density::{Asked, Map, Mapping, NoMap};
use homebody_analysis::look::HomeSensor;
use homebody_analysis::measures::{Known, Measures, Measuring, Ways};
use homebody_analysis::rows::Tallies;
use homebody_analysis::signs::{LogSensors, kind_in_home};
use homebody_core::names::capitalised;
use homebody_core::recording::Recording;
use homebody_core::scenario::calendar::Calendar;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::sensors::Sensor;
use homebody_core::time::Micros;
use homebody_log::places::{LIST, RECORDING, logs_of, recording_in};
use homebody_log::source::{Clock, Value, truth_rows};
use homebody_log::truth::{Truth, tables};
use homebody_log::word::one_word;
use homebody_log::{Life, Log, LogError, Places, RunClock, SensorInfo, Source, Url, lives, read, stream, survey};
use homebody_walk::Mesh;
use jiff::civil::Date;
use jiff::tz::TimeZone;
use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A log on the clock on the wall of its home.
pub struct LogWithRun {
    /// What it is called, and what its run is without.
    pub name: String,
    /// Its rows; `log.clock` says whether they could be put on the wall.
    pub log: Log,
    /// What the truth tells, where there is one.
    pub lives: Vec<Life>,
    /// The rooms of its sensors in the home of its run, or as the log itself tells them, by their names in the log; none where
    /// neither does.
    pub rooms: BTreeMap<String, String>,
    /// From when to when the run was, if that is known.
    pub recorded: Option<Range<Micros>>,
    /// The zone on whose wall its rows are, if that is known.
    pub zone: Option<TimeZone>,
    /// The files that the log itself is in.
    pub files: Vec<PathBuf>,
    /// The files that it comes from, its truth's and its recording too, which nothing replaces.
    pub sources: Vec<PathBuf>,
    /// The scenario with its home, where that is known: its run's, or the one that its sensors were placed in.
    home: Option<Scenario>,
    /// The place of its rows, if they are too many for memory: `log` has none then.
    long: Option<LongLog>,
    /// Its truth, and the zone on whose wall what that tells is put, where it is told in UTC.
    truth: Option<(Url, Option<TimeZone>)>,
    /// The folder of its run, if that was not lived to its end: see [`NamedLog::unfinished`].
    pub unfinished: Option<Unended>,
}

/// A message that never reached the logger.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lost {
    /// When it was said, on the clock of the log.
    pub at: Micros,
    /// The sensor's name in its home, or else its id.
    pub sensor: String,
    /// What it said.
    pub value: String,
    /// How it was lost, in a word of the truth.
    pub loss: String,
}

/// The run of a log that was killed or stopped.
#[derive(Clone, Debug, PartialEq)]
pub struct Unended {
    /// In which it is gone on with.
    pub folder: PathBuf,
    /// Whether it was killed, so that its log and its truth may end at different instants.
    pub is_killed: bool,
}

impl LogWithRun {
    /// Reads a log by its URL, by its path alone, or by the folder of its run. One in UTC is put on the wall of `zone`, of its
    /// run's zone, or of the one that its instants have the offsets of; without any it stays in UTC.
    ///
    /// # Errors
    ///
    /// [`Error::TimeZone`] if no zone has this name, [`Error::Log`] if the log or the truth beside it cannot be read, and those of
    /// [`NamedLog::find`] and [`NamedLog::read`].
    pub fn read(text: &str, zone: Option<&str>) -> Result<LogWithRun, Error> {
        LogWithRun::of(NamedLog::find(text)?, zone)
    }

    /// The same of one that has been found.
    ///
    /// # Errors
    ///
    /// Those of [`LogWithRun::read`].
    pub fn of(named: NamedLog, zone: Option<&str>) -> Result<LogWithRun, Error> {
        let mut log = named.read()?;
        let first = log.events.iter().take(MOST_COMPARED).copied().collect();
        let truth = named.own_truth(&mut log, first)?;
        LogWithRun::with(named, log, None, truth, zone)
    }

    /// The same of a log of any length. Of one with more than two million rows no rows are in memory: [`LogWithRun::rows`] reads them
    /// again each time.
    ///
    /// # Errors
    ///
    /// Those of [`LogWithRun::read`].
    pub fn of_any_length(named: NamedLog, zone: Option<&str>) -> Result<LogWithRun, Error> {
        LogWithRun::of_length(named, zone, MOST_ROWS)
    }

    /// The same, with so many rows in memory at most.
    pub(crate) fn of_length(named: NamedLog, zone: Option<&str>, most: usize) -> Result<LogWithRun, Error> {
        let (mut kept, mut first) = (Kept::new(most), Vec::new());
        let mut log = named.stream(&mut |part| {
            let left = MOST_COMPARED - first.len();
            first.extend(part.events.iter().take(left).copied());
            kept.take(part);
        })?;
        let long = kept.give(&mut log, &named.place, &named.mapping);
        let truth = named.own_truth(&mut log, first)?;
        LogWithRun::with(named, log, long, truth, zone)
    }

    /// The log alone, without the truth beside it. Of one that has more rows only the first `most` are in memory, and `log.rows`
    /// says how many there are.
    ///
    /// # Errors
    ///
    /// Those of [`LogWithRun::read`].
    pub fn alone(named: NamedLog, zone: Option<&str>, most: usize) -> Result<LogWithRun, Error> {
        let mut events = Vec::new();
        let mut log = named.stream(&mut |part| {
            let left = most - events.len();
            events.extend(part.events.iter().take(left));
        })?;
        log.events = events;
        LogWithRun::with(named, log, None, None, zone)
    }

    fn with(
        named: NamedLog,
        mut log: Log,
        mut long: Option<LongLog>,
        truth: Option<Url>,
        zone: Option<&str>,
    ) -> Result<LogWithRun, Error> {
        let asked = zone.map(|name| Calendar::zone(name).map_err(|_| Error::zone(name))).transpose()?;
        // Days are drawn on the wall, so these are the instants as the truth tells them.
        let mut lives = truth.as_ref().map(|truth| lives(truth, &RunClock::as_told())).transpose()?.unwrap_or_default();
        let unfinished = named.unfinished();
        let known_zone = named.zone();
        let NamedLog { name, place, run, scenario, .. } = named;
        if let Some(scenario) = &scenario {
            name_sensors(&mut log, scenario);
        }
        let rooms = scenario.as_ref().map_or_else(|| rooms_told(&log), sensor_rooms);
        let zone = asked.or(known_zone).or_else(|| zone_of(&log));
        let told = truth.clone().map(|truth| (truth, zone.clone().filter(|_| log.clock == Clock::Utc)));
        // One that is being lived, or was killed, says how long it is to be, and not how far it has come.
        let lived = run.as_ref().filter(|run| run.is_complete());
        let span = scenario.as_ref().zip(lived).map(|(scenario, run)| {
            let instant = |at| scenario.calendar.timestamp(at).as_microsecond();
            let zone = scenario.calendar.local(0).time_zone().clone();
            on_wall(instant(0), &zone)..on_wall(instant(run.length_us), &zone)
        });
        if let Some(zone) = zone.as_ref().filter(|_| log.clock == Clock::Utc) {
            for part in lives.iter_mut().flat_map(|life| life.activities.iter_mut().chain(&mut life.rooms)) {
                (part.begin, part.end) = (on_wall(part.begin, zone), on_wall(part.end, zone));
            }
            put_on_wall(&mut log, zone);
            long.iter_mut().for_each(|long| long.put_on_wall(zone));
        }
        // A recording that lies there by chance is of another time.
        let rows = rows_span(&log, long.as_ref());
        let recorded =
            span.filter(|span| rows.is_none_or(|(first, last)| span.contains(&first) && span.contains(&last)));
        let beside = Some(place.path().with_file_name(RECORDING)).filter(|path| path.is_file());
        let truth = truth.map(|truth| truth.files(&tables())).unwrap_or_default();
        let files = place.files();
        let sources = files.iter().cloned().chain(truth).chain(beside).collect();
        let without = run.map(|run| run.without).filter(|without| !without.is_empty());
        let name = name + without.map_or_else(String::new, |names| format!(", without {}", names.join(", "))).as_str();
        let home = scenario;
        Ok(LogWithRun { name, log, lives, rooms, recorded, zone, files, sources, home, long, truth: told, unfinished })
    }

    /// Gives its sensors the names and rooms that they have in the home of a scenario. Says how many of them are in it.
    pub fn place_in(&mut self, scenario: &Scenario) -> usize {
        name_sensors(&mut self.log, scenario);
        self.rooms = sensor_rooms(scenario);
        self.home = Some(scenario.clone());
        self.log.sensors.iter().filter(|sensor| self.rooms.contains_key(*sensor)).count()
    }

    /// The scenario with its home, where that is known.
    pub fn scenario(&self) -> Option<&Scenario> {
        self.home.as_ref()
    }

    /// How far it is from sensor to sensor along the ways of its home, where that is known. It is some tenths of a second of work.
    fn ways(&self) -> Option<Ways> {
        let scenario = self.home.as_ref()?;
        let radius_m = scenario.residents.first()?.file.radius_m;
        let mesh = Mesh::with_numbers(scenario.home.plan(), radius_m, scenario.home.numbers());
        let called = |name: &str| {
            let id = scenario.logger.ids.get(name).map_or(name, String::as_str);
            vec![id.to_owned(), one_word(id)]
        };
        Some(Ways::of(&scenario.home, &|from, to| mesh.path(from, to), &called))
    }

    /// What a map of its density is asked for: all of it, with what is known of when and where it was recorded.
    pub fn density_asked(&self) -> Asked {
        Asked { recorded: self.recorded.clone(), zone: self.zone.clone(), ..Asked::default() }
    }

    /// Passes on its rows in the order of time, from memory or from their place.
    ///
    /// # Errors
    ///
    /// [`NoMap::Unread`] and [`NoMap::Disorder`] of a long log that cannot be read again, or is out of order, and those of `take`.
    pub fn rows(&self, take: TakeRow) -> Result<(), NoMap> {
        match &self.long {
            Some(long) => long.rows(take),
            None => self.log.in_order().into_iter().try_for_each(take),
        }
    }

    /// The first and the last instant of its rows.
    pub fn rows_span(&self) -> Option<(Micros, Micros)> {
        rows_span(&self.log, self.long.as_ref())
    }

    /// The map of its density.
    ///
    /// # Errors
    ///
    /// If no sensor tells of motion, or the days are too many, and those of [`LogWithRun::rows`].
    pub fn density(&self, asked: &Asked) -> Result<Map, NoMap> {
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
    ///
    /// # Errors
    ///
    /// If no sensor tells of motion, or the days are too many.
    pub fn measures(&self) -> Result<Measures, NoMap> {
        let asked = Asked { recorded: self.recorded.clone(), ..Asked::default() };
        let ways = self.ways();
        let known = Known { rooms: &self.rooms, ways: ways.as_ref() };
        let mut measuring = Measuring::new(&self.log, known, &asked);
        self.rows(&mut |row| measuring.take(row))?;
        let mut measures = Measures::of_rows(&self.name, measuring)?;
        let residents = self.residents();
        if residents.len() > 1 {
            measures.remarks.push(format!(
                "The sensors cannot tell residents apart; this covers everybody together: {}; pass --resident NAME for one of them by the ground truth",
                residents.join(", ")
            ));
        }
        Ok(measures)
    }

    /// Those who live in its home, where that or a truth tells it.
    pub fn residents(&self) -> Vec<&str> {
        match &self.home {
            Some(home) => home.residents.iter().map(|resident| resident.file.name.as_str()).collect(),
            None => self.lives.iter().map(|life| life.resident.as_str()).collect(),
        }
    }

    /// What sentences call whom it is about: by name where one alone lives there.
    pub fn subject(&self) -> String {
        match self.residents()[..] {
            [] => "the resident".to_owned(),
            [one] => capitalised(one),
            _ => "a resident".to_owned(),
        }
    }

    /// The messages that never reached the logger, in order, as the truth tells them; `None` where there is none.
    ///
    /// # Errors
    ///
    /// [`Error::Log`] if the truth cannot be read.
    pub fn lost(&self) -> Result<Option<Vec<Lost>>, Error> {
        let Some((truth, zone)) = &self.truth else { return Ok(None) };
        let mut all = Vec::new();
        truth_rows(truth, Truth::Lost, &RunClock::as_told(), &mut |cells| {
            let text = |index: usize| match cells.get(index) {
                Some(Value::Text(text)) => (*text).to_owned(),
                _ => String::new(),
            };
            if let Some(&Value::Integer(at)) = cells.get(2) {
                let at = zone.as_ref().map_or(at, |zone| on_wall(at, zone));
                let ids = self.home.iter().flat_map(|scenario| &scenario.logger.ids);
                let sensor =
                    ids.into_iter().find(|(_, id)| **id == text(0)).map_or_else(|| text(0), |(name, _)| name.clone());
                all.push(Lost { at, sensor, value: text(1), loss: text(4) });
            }
            Ok(())
        })?;
        all.sort_by_key(|lost| lost.at);
        Ok(Some(all))
    }

    /// When guests were in the home, as the truth tells it; `None` where it is not known who lives there.
    pub fn company(&self) -> Option<Vec<(Micros, Micros)>> {
        self.home.as_ref()?;
        let residents = self.residents();
        let is_guest = |life: &&Life| !residents.contains(&life.resident.as_str());
        let guests = self.lives.iter().filter(is_guest);
        Some(guests.flat_map(|guest| guest.rooms.iter().map(|room| (room.begin, room.end))).collect())
    }

    /// When its recording ended, if that is known.
    pub fn ended(&self) -> Option<Micros> {
        self.recorded.as_ref().map(|recorded| recorded.end)
    }

    /// The first and the last of its dates: those of its run, on which nothing may have been said, else those of its rows.
    pub fn dates(&self) -> Option<(Date, Date)> {
        let of_run = self.recorded.as_ref().map(|run| (date_of(run.start), date_of(run.end - 1)));
        of_run.or_else(|| self.rows_span().map(|(first, last)| (date_of(first), date_of(last))))
    }
}

fn rows_span(log: &Log, long: Option<&LongLog>) -> Option<(Micros, Micros)> {
    let times = || log.events.iter().map(|event| event.at);
    long.map(LongLog::span).or_else(|| times().min().zip(times().max()))
}

/// The sensors of a home, as its logs show them.
pub fn home_sensors(scenario: &Scenario) -> Vec<HomeSensor> {
    let one = |sensor: &Sensor| {
        let SensorInfo { id, name, kind, unit, .. } = SensorInfo::in_home(sensor, scenario);
        let kind = kind_in_home(&kind, unit.is_some());
        HomeSensor { ids: vec![id.clone(), one_word(&id)], name, kind }
    };
    scenario.home.placed_sensors().iter().map(one).collect()
}

/// The rooms that the sensors of a home are in, by their names there and by their ids in its logs.
pub fn sensor_rooms(scenario: &Scenario) -> BTreeMap<String, String> {
    let mut rooms = BTreeMap::new();
    for sensor in scenario.home.placed_sensors() {
        let info = sensor.info(scenario.home.plan());
        let Some(room) = info.room else { continue };
        let id = scenario.logger.ids.get(&info.name).unwrap_or(&info.name);
        for name in [info.name.clone(), id.clone(), one_word(id)] {
            rooms.insert(name, room.clone());
        }
    }
    rooms
}

/// The rooms that a log itself tells of its sensors.
fn rooms_told(log: &Log) -> BTreeMap<String, String> {
    let told = log.known.iter().filter_map(|known| Some((known.id.clone(), known.room.clone()?)));
    told.collect()
}

/// Gives the sensors their names in the home for the ids that they have in the log, and what the home has of them besides.
fn name_sensors(log: &mut Log, scenario: &Scenario) {
    for sensor in log.sensors.iter_mut().chain(log.known.iter_mut().map(|known| &mut known.id)) {
        if let Some((name, _)) = scenario.logger.ids.iter().find(|(_, id)| *id == sensor) {
            sensor.clone_from(name);
        }
    }
    know_sensors(log, scenario);
}

/// Adds the names, kinds and rooms that a scenario's home has of the log's sensors.
fn know_sensors(log: &mut Log, scenario: &Scenario) {
    for sensor in scenario.home.placed_sensors() {
        let info = SensorInfo::in_home(sensor, scenario);
        let is_it = |id: &&String| **id == info.name || **id == info.id || **id == one_word(&info.id);
        let Some(id) = log.sensors.iter().find(is_it) else { continue };
        let info = SensorInfo { id: id.clone(), ..info };
        match log.known.iter_mut().find(|known| known.id == *id) {
            Some(known) => known.fill(info),
            None => log.known.push(info),
        }
    }
}

/// A log that somebody names, before it is read: where it is, and what is known of the run that left it.
pub struct NamedLog {
    /// What it is called.
    pub name: String,
    /// Where it is.
    pub place: Source,
    /// What its table and columns are called, by the logger of its run; the usual names where that is not known.
    pub mapping: LoggerFile,
    /// The recording beside it.
    run: Option<Recording>,
    scenario: Option<Scenario>,
}

impl NamedLog {
    /// Finds a log by its URL, by its path alone, or by the folder of its run.
    ///
    /// # Errors
    ///
    /// [`Error::NoLog`] or [`Error::IsCohort`] if it is a folder without one log, [`Error::NoRows`] if it is that of a run which
    /// has not stored any, [`Error::Log`] if there is no such file.
    pub fn find(text: &str) -> Result<NamedLog, Error> {
        let path = PathBuf::from(text);
        if path.join(LIST).is_file() {
            return Err(Error::IsCohort { member: first_member(&path), folder: path });
        }
        if path.is_dir() {
            let recording = recording_in(&path);
            return match log_in(&path, recording.as_ref()) {
                Some(place) => Ok(NamedLog::at(text, Source::from(&place), recording)),
                None if recording.as_ref().is_some_and(|run| !run.is_complete()) => Err(no_rows(path)),
                None if recording.is_some() => Err(Error::NoLog { folder: path }),
                None => match Source::recognise(&path) {
                    Err(LogError::IsFolder { .. }) => Err(Error::NoLog { folder: path }),
                    found => Ok(NamedLog::at(text, found?, None)),
                },
            };
        }
        let place = match path.exists() {
            true => Source::recognise(&path)?,
            // What is no file is a URL with something wrong in it; a password may be in it, too.
            false if text.contains("://") => text.parse().map_err(LogError::NoPlace)?,
            false => text.parse().or_else(|_| Source::recognise(&path)).map_err(|error: LogError| error)?,
        };
        let of_set = || recording_in(Places::in_set_at(place.path())?.recording?.parent()?);
        let beside = place.path().parent().and_then(recording_in).or_else(of_set);
        Ok(NamedLog::at(text, place, beside))
    }

    fn at(text: &str, place: Source, run: Option<Recording>) -> NamedLog {
        let scenario = run.as_ref().and_then(|run| run.scenario().ok());
        let mapping = scenario.as_ref().map(|scenario| scenario.logger.clone()).unwrap_or_default();
        NamedLog { name: called(text), place, mapping, run, scenario }
    }

    /// The scenario of its run, if that is known.
    pub fn scenario(&self) -> Option<&Scenario> {
        self.scenario.as_ref()
    }

    /// Adds what the home of its run has of the log's sensors, if that is known.
    pub fn know_home(&self, log: &mut Log) {
        if let Some(scenario) = &self.scenario {
            know_sensors(log, scenario);
        }
    }

    /// The zone of its run's clocks, if that is known.
    pub fn zone(&self) -> Option<TimeZone> {
        self.scenario.as_ref().map(|scenario| scenario.calendar.local(0).time_zone().clone())
    }

    /// What its run's home calls a sensor that has an id in the log.
    pub fn name_of(&self, id: &str) -> Option<&str> {
        let ids = self.scenario.iter().flat_map(|scenario| &scenario.logger.ids);
        ids.into_iter().find(|(_, known)| *known == id).map(|(name, _)| name.as_str())
    }

    /// Reads it through: `take` gets its rows part by part, as of [`stream`].
    ///
    /// # Errors
    ///
    /// Those of [`NamedLog::read`].
    pub fn stream(&self, take: &mut dyn FnMut(&Log)) -> Result<Log, Error> {
        let mut take = |part: &Log| {
            take(part);
            Ok(())
        };
        self.with_rows(stream(&self.place, &self.mapping, &mut take))
    }

    /// Reads it into memory.
    ///
    /// # Errors
    ///
    /// [`Error::NoRows`] if its run has not stored any yet, [`Error::Log`] if it cannot be read.
    pub fn read(&self) -> Result<Log, Error> {
        self.with_rows(read(&self.place, &self.mapping))
    }

    /// Reads it through and keeps no rows.
    ///
    /// # Errors
    ///
    /// Those of [`NamedLog::read`].
    pub fn survey(&self) -> Result<Log, Error> {
        self.with_rows(survey(&self.place, &self.mapping))
    }

    /// A run that has no rows yet is told as such, whatever its log is without them.
    fn with_rows(&self, read: Result<Log, LogError>) -> Result<Log, Error> {
        let file = self.place.path();
        let is_empty = match &read {
            Ok(log) => log.rows == 0 && log.skipped == 0,
            Err(LogError::Missing { .. } | LogError::NoTables { .. }) => true,
            Err(_) => fs::metadata(file).is_ok_and(|found| found.len() == 0),
        };
        match self.run.as_ref().is_some_and(|run| is_empty && !run.is_complete() && self.is_of_its_run()) {
            true => Err(no_rows(file.parent().unwrap_or(Path::new("")).to_owned())),
            false => Ok(read?),
        }
    }

    /// What is known of its run, if that was not lived to its end.
    pub fn unfinished(&self) -> Option<Unended> {
        let run = self.run.as_ref().filter(|run| !run.is_whole() && self.is_of_its_run())?;
        let folder = self.place.path().parent()?.to_owned();
        Some(Unended { folder, is_killed: !run.is_complete() })
    }

    /// Whether the recording beside it says that the run's log is here.
    fn is_of_its_run(&self) -> bool {
        let file = self.place.path();
        let folder = file.parent().unwrap_or(Path::new(""));
        logs_of(folder, self.scenario.as_ref()).any(|url| url.file() == Some(file))
    }

    /// Reads instants of its run from the truth beside it. Where the run is not known, they are as they are told.
    pub fn clock(&self) -> RunClock {
        clock(self.scenario.as_ref(), self.run.as_ref())
    }

    /// Reads instants of its run from a truth that may be elsewhere, by whichever of the two has a recording beside it.
    pub fn clock_beside(&self, truth: &Url) -> RunClock {
        if self.scenario.is_some() {
            return self.clock();
        }
        let run = truth.file().and_then(Path::parent).and_then(recording_in);
        clock(run.as_ref().and_then(|run| run.scenario().ok()).as_ref(), run.as_ref())
    }

    /// Reads instants of its run from the log itself, which has the clock `told_by`.
    pub fn clock_of(&self, told_by: Clock) -> RunClock {
        let known = self.scenario.as_ref().zip(self.run.as_ref());
        known
            .map_or_else(RunClock::as_told, |(scenario, run)| RunClock::new(&scenario.calendar, run.length_us, told_by))
    }
}

fn clock(scenario: Option<&Scenario>, run: Option<&Recording>) -> RunClock {
    scenario.zip(run).map_or_else(RunClock::as_told, |(scenario, run)| RunClock::of(scenario, run.length_us))
}

/// A run that has no rows yet, and the folder by which it can be gone on with: its cohort's, if it is a member of one.
fn no_rows(folder: PathBuf) -> Error {
    let cohort = folder.parent().filter(|parent| parent.join(LIST).is_file());
    Error::NoRows { resume: cohort.unwrap_or(&folder).to_owned(), folder }
}

/// The log in a run's folder: where its recording says that it is, or under a usual name.
fn log_in(folder: &Path, recording: Option<&Recording>) -> Option<Url> {
    let scenario = recording.and_then(|run| run.scenario().ok());
    let there = logs_of(folder, scenario.as_ref()).find(|url| url.file().is_some_and(Path::is_file));
    there.or_else(|| Places::in_set_at(folder)?.log.pop())
}

/// The first member of a cohort who was lived.
fn first_member(folder: &Path) -> Option<PathBuf> {
    let is_member = |path: &PathBuf| path.join(RECORDING).is_file();
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(is_member).min()
}

/// What a log is called: as its file, or as the folder of its run.
fn called(text: &str) -> String {
    let path =
        PathBuf::from(text.split_once(':').filter(|(scheme, _)| scheme.len() > 1).map_or(text, |(_, path)| path));
    path.file_name().map_or(text.into(), |name| name.to_string_lossy().into_owned())
}
