//! A log by the world's clock, with what the truth tells of its residents: what programs take that compute with instants, where people
//! read those on the wall.

use crate::error::QueryError;
use crate::log_ref::LogRef;
use homebody_analysis::dates::put_on_wall;
use homebody_core::calendar::Calendar;
use homebody_core::time::{DAY, Interval, RunTime, TimeScale, UtcTime, WallTime};
use homebody_log::error::TruthMessage;
use homebody_log::log::Clock;
use homebody_log::source::TruthValue;
use homebody_log::table::ColumnKind;
use homebody_log::table::truth::{Truth, tables};
use homebody_log::truth::truth_rows;
use homebody_log::{Event, Log, LogError, Url, read_timeline};
use homebody_timeline::{Episode, PersonTimeline, Timeline};
use jiff::tz::TimeZone;

/// A log in UTC. Without a known zone, its wall clock is taken for UTC.
pub struct UtcLog {
    pub log: Log<UtcTime>,
    /// The timeline of the ground truth, or else the activities of the log itself, for a person without a name.
    pub timeline: Timeline<UtcTime>,
    /// The zone of the home; `None` if instants are on the wall.
    pub zone: Option<String>,
}

struct UtcReader<'s> {
    scale: &'s TimeScale,
    /// The last instant in the file of a run; `None` if the run is unknown.
    last: Option<RunTime>,
}

impl UtcReader<'_> {
    /// Without a known run, an hour that the clock repeats is the first one.
    fn earth(&mut self, told: WallTime) -> UtcTime {
        let Some(last) = &mut self.last else { return self.scale.from_wall(told) };
        *last = self.scale.run_from_wall(told, *last);
        self.scale.to_utc(*last)
    }
}

/// The wall of a zone from a day before these instants to a day after: it is never so far from that of UTC.
fn wall_around(instants: impl Iterator<Item = WallTime>, zone: &TimeZone) -> TimeScale {
    let all = instants.map(Interval::instant).reduce(Interval::hull).unwrap_or_default().map(WallTime::as_of_utc);
    let range = Interval::new(all.begin.saturating_sub(DAY), all.end.saturating_add(DAY));
    TimeScale::new(UtcTime::EPOCH, zone, range)
}

impl LogRef {
    /// Reads it in UTC. `zone` is that of its home, if its run is unknown.
    pub fn instants(&self, zone: Option<&str>) -> Result<UtcLog, QueryError> {
        let asked = zone.map(|name| Calendar::zone(name).map_err(|_| QueryError::zone(name))).transpose()?;
        let (mut log, truth) = self.read_with_truth()?;
        let timeline = truth.map(|truth| read_timeline(&truth, &self.clock())).transpose()?.unwrap_or_default();
        let known = self.zone();
        let is_naive = log.clock == Clock::Local && known.is_none() && asked.is_none();
        let as_told = TimeScale::one();
        let of_run = self.clock_of(log.clock);
        let start = of_run.is_some().then_some(RunTime::MIN);
        let scale = match (of_run, &asked) {
            (Some(of_run), _) => of_run,
            (None, Some(zone)) if log.clock == Clock::Local => {
                let parts = timeline.people.iter().flat_map(|person| person.activities.iter().chain(&person.rooms));
                let parts = parts.flat_map(|part| [part.begin(), part.end()].map(|at| as_told.run_to_wall(at)));
                let noted = log.activities.iter().flat_map(|noted| [noted.begin(), noted.end()]);
                let gaps = log.gaps.iter().flat_map(|gap| [gap.begin, gap.end]);
                wall_around(log.events.iter().map(|event| event.at).chain(noted).chain(gaps).chain(parts), zone)
            }
            (None, _) => TimeScale::one(),
        };
        let reader = || UtcReader { scale: &scale, last: start };
        let mut told = reader();
        let events = std::mem::take(&mut log.events);
        let events: Vec<Event<UtcTime>> = events.into_iter().map(|event| event.map(|at| told.earth(at))).collect();
        let mut told = reader();
        let noted = std::mem::take(&mut log.activities);
        let noted: Vec<Episode<UtcTime>> = noted.into_iter().map(|noted| noted.map(|at| told.earth(at))).collect();
        let mut told = reader();
        let gaps = std::mem::take(&mut log.gaps).into_iter().map(|gap| gap.map(|at| told.earth(at))).collect();
        // Those are on the run's own clock already.
        let earth = |at: RunTime| match start {
            Some(_) => scale.to_utc(at),
            None => scale.from_wall(as_told.run_to_wall(at)),
        };
        let mut timeline = timeline.map(earth);
        if timeline.people.is_empty() && !noted.is_empty() {
            timeline.people.push(PersonTimeline { activities: noted, ..PersonTimeline::default() });
        }
        for sensor in &mut log.sensors {
            if let Some(name) = self.name_of(sensor) {
                *sensor = name.to_owned();
            }
        }
        let zone = known.or(asked).or_else(|| log.zone.clone()).unwrap_or(TimeZone::UTC);
        let zone = (!is_naive).then(|| zone.iana_name().unwrap_or("UTC").to_owned());
        Ok(UtcLog { log: log.with(events, Vec::new(), gaps), timeline, zone })
    }

    /// The truth in its folder.
    pub fn truth_that_is_there(&self) -> Result<Url, QueryError> {
        let no_truth = || LogError::no_truth(self.place.to_string(), TruthMessage::NotBeside);
        Ok(self.truth().ok_or_else(no_truth)?)
    }

    /// Hands over the rows of a table of the truth in its folder, with instants as in [`UtcLog`].
    pub fn truth_rows(&self, table: &str, take: &mut dyn FnMut(&[TruthValue<'_>])) -> Result<(), QueryError> {
        let truth = self.truth_that_is_there()?;
        let all = tables();
        let Some(index) = all.iter().position(|known| known.name == table) else {
            let known = all.iter().map(|table| table.name.clone()).collect();
            let no_table = TruthMessage::NoTable { table: table.into(), known };
            return Err(LogError::no_truth(truth.to_string(), no_table).into());
        };
        let clock = self.clock();
        let instants: Vec<bool> = all[index].columns.iter().map(|column| column.kind == ColumnKind::Instant).collect();
        truth_rows(&truth, Truth::ALL[index], &clock, &mut |row| {
            let mut cells = row.to_vec();
            for (cell, is_instant) in cells.iter_mut().zip(&instants) {
                if let TruthValue::Integer(at) = cell
                    && *is_instant
                {
                    *at = clock.to_utc(RunTime::from_micros(*at)).micros();
                }
            }
            take(&cells);
            Ok(())
        })?;
        Ok(())
    }

    /// Reads the log with the activities of its truth, or of the log itself, in the order of their beginnings. A log in UTC, of an unknown
    /// run, is put on the wall of `zone`, where one is given. With a truth, it is on a wall that is never set, so that lengths of time
    /// are right; it shows the time of the home as the run begins.
    pub fn with_activities(&self, zone: Option<&str>) -> Result<Log, QueryError> {
        let asked = zone.map(|name| Calendar::zone(name).map_err(|_| QueryError::zone(name))).transpose()?;
        let (mut log, truth) = self.read_with_truth()?;
        if let Some(zone) = asked.filter(|_| self.zone().is_none()) {
            put_on_wall(&mut log, &zone);
        }
        if let Some(truth) = truth {
            let home = self.clock_of(Clock::Local).unwrap_or_else(TimeScale::one);
            let start = home.run_to_wall(RunTime::START);
            let wall = |at: RunTime| start + at.since_zero();
            log.activities = read_timeline(&truth, &self.clock())?.map(wall).into_activities();
            let scale = self.clock_of(log.clock).unwrap_or_else(TimeScale::one);
            let mut last = RunTime::MIN;
            for event in &mut log.events {
                last = scale.run_from_wall(event.at, last);
                event.at = wall(last);
            }
        }
        Ok(log)
    }
}
