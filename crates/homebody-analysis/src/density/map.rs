//! A log as a map: its hours, day by day.

use homebody_core::time::{DAY, Micros, SECOND, seconds};
use homebody_log::Log;
use jiff::civil::Date;
use jiff::tz::TimeZone;
use serde::Serialize;
use std::ops::Range;

use super::{Absence, Cell, Entrance, LEAST, Sign, State, Sum, absences};
use crate::dates::{ClockSet, clocks_set, date_of, midnight};
use crate::signs::{Kind, LogSensors, Says, is_seat, said, unknown_of_all, without};

const HOUR: Micros = 3600 * SECOND;
/// A longer silence of all sensors is no recording.
const SILENCE: Micros = DAY;
/// In a longer stretch that is not known the resident may have come home and left again.
const UNSEEN: Micros = 10 * 60 * SECOND;
/// The longest map: ten years.
const MOST_DAYS: usize = 3660;

/// What somebody wants to know of a log.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The sensors at the entrance; none to have them found by their names.
    pub doors: Vec<String>,
    /// The least absence.
    pub away_after: Micros,
    /// From when to when the log was recorded, if that is known.
    pub recorded: Option<Range<Micros>>,
    /// The zone on whose wall the log is, if that is known: on a day on which clocks are set, it says how long its hours are.
    pub zone: Option<TimeZone>,
    /// The first day; `None`: the first of the log.
    pub from: Option<Date>,
    /// How many days from the first on; `None`: to the last of the log.
    pub days: Option<usize>,
}

impl Default for Asked {
    fn default() -> Asked {
        Asked { doors: Vec::new(), away_after: LEAST, recorded: None, zone: None, from: None, days: None }
    }
}

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoMap {
    /// The log has no row.
    #[error("it has no rows")]
    Empty,
    /// The log has no sensor that is taken for a motion sensor.
    #[error("no sensor in it tells of motion\n  hint: motion sensors say ON, FIRE, true or 1 when they see somebody")]
    NoMotion,
    /// Its sensors are never in a state that is known.
    #[error("the state of its sensors is never known")]
    Unknown,
    /// So many days were asked for.
    #[error("a map of {0} days is longer than ten years")]
    TooLong(usize),
    /// The date that was asked for, and the first and the last that the log has.
    #[error("{0} is no day of it\n  hint: it goes from {1} to {2}")]
    NoDay(Date, Date, Date),
}

/// The hours of some days.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Map {
    /// What the log is called.
    pub name: String,
    /// The first day.
    pub from: Date,
    /// How many motion events there are.
    pub events: u64,
    /// How many sensors tell of motion.
    pub motion_sensors: usize,
    /// The sensors that tell of something else, and are left out.
    pub left_out: Vec<String>,
    /// The sensors by which somebody leaves and comes home.
    pub entrance: Entrance,
    /// For how many hours there is data.
    pub recorded_h: f64,
    /// For how many of these nobody was at home.
    pub away_h: f64,
    /// Firings an hour at home, if anybody ever was.
    pub density_per_h: Option<f64>,
    /// Hours away a day recorded.
    pub away_h_per_day: f64,
    /// What each day comes to.
    pub days: Vec<Day>,
    /// The 24 hours of the day over all days.
    pub hours: Vec<Hour>,
    /// All of which at least a part lies in these days.
    pub absences: Vec<Absence>,
    /// By day and hour.
    #[serde(skip)]
    pub cells: Vec<[Cell; 24]>,
}

/// One day of a map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Day {
    /// Which day it is.
    pub date: Date,
    /// What its hours come to.
    #[serde(flatten)]
    pub sum: Sum,
}

/// One hour of the day over all days of a map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hour {
    /// Which hour it is, from 0 to 23.
    pub hour: usize,
    /// What it comes to over all days.
    #[serde(flatten)]
    pub sum: Sum,
}

impl Map {
    /// The map of the days that are asked for.
    pub fn of(name: &str, log: &Log, asked: &Asked) -> Result<Map, NoMap> {
        let map = Map::of_any(name, log, &LogSensors::of(log), asked)?;
        if map.motion_sensors > 0 { Ok(map) } else { Err(NoMap::NoMotion) }
    }

    /// The same where no sensor may look for movement: when the log was recorded, and when nobody was at home.
    pub fn of_any(name: &str, log: &Log, sensors: &LogSensors, asked: &Asked) -> Result<Map, NoMap> {
        let LogSensors { called, kinds, spans } = sensors;
        let entrance = Entrance::find(&log.sensors, sensors, &asked.doors);
        let Heard { rows, events, signs } = Heard::of(log, kinds, &entrance);
        let (&[first, ..], &[.., last]) = (&rows[..], &rows[..]) else { return Err(NoMap::Empty) };
        if signs.is_empty() {
            return Err(NoMap::NoMotion);
        }
        let seats = spans.iter().zip(called).filter(|(_, name)| is_seat(name));
        let taken: Vec<(Micros, Micros)> = seats.flat_map(|(spans, _)| spans).copied().collect();
        // An hour is not known while no motion sensor is in a state that is known.
        let has_motion = kinds.contains(&Kind::Motion);
        let tells = |sensor: usize| match kinds[sensor] {
            Kind::Motion => true,
            Kind::Contact | Kind::Used => !has_motion,
            Kind::Reading | Kind::Other => false,
        };
        let unknown = unknown_of_all(log, &tells);
        let mut absences = absences(&signs, &taken, asked.away_after);
        absences.retain(|absence| {
            let within = |&(begin, end): &(Micros, Micros)| end.min(absence.end) - begin.max(absence.begin) > UNSEEN;
            !unknown.iter().any(within)
        });
        let recorded: Vec<(Micros, Micros)> = match &asked.recorded {
            Some(span) => vec![(span.start.min(first), span.end.max(last + 1))],
            None => without_silences(&rows, &absences),
        };
        let recorded: Vec<Range<Micros>> =
            without(&recorded, &unknown).into_iter().map(|(begin, end)| begin..end).collect();
        let (&[Range { start, .. }, ..], &[.., Range { end, .. }]) = (&recorded[..], &recorded[..]) else {
            return Err(NoMap::Unknown);
        };
        let days = days(asked, first.min(start), end.max(last + 1))?;

        let mut cells = vec![[Cell::default(); 24]; days.count];
        for &at in &events {
            if let Some(cell) = days.cell(&mut cells, at) {
                cell.events += 1;
            }
        }
        let set = asked.zone.as_ref().map_or_else(Vec::new, |zone| clocks_set(&days.span(), zone));
        for span in &recorded {
            days.add_lived(&mut cells, span, &set, |cell, hours| cell.recorded_h += hours);
        }
        for absence in &absences {
            days.add_lived(&mut cells, &(absence.begin..absence.end), &set, |cell, hours| cell.away_h += hours);
        }
        let shown = |absence: &&Absence| absence.begin < days.span().end && absence.end > days.span().start;
        let motion_sensors = kinds.iter().filter(|kind| **kind == Kind::Motion).count();
        let left_out = log.sensors.iter().zip(kinds).filter(|(_, kind)| **kind != Kind::Motion);
        let left_out = left_out.map(|(name, _)| name.clone()).collect();
        let absences = absences.iter().filter(shown).copied().collect();
        Ok(Map::sum(name, days.first, cells, Found { motion_sensors, left_out, entrance, absences }))
    }

    /// Sums the cells up.
    fn sum(name: &str, from: Date, cells: Vec<[Cell; 24]>, found: Found) -> Map {
        let first = midnight(from);
        let days = cells.iter().zip(0..);
        let days = days.map(|(day, number)| Day { date: date_of(first + number * DAY), sum: Sum::of(day) });
        let hours = (0..24).map(|hour| Hour { hour, sum: Sum::of(cells.iter().map(|day| &day[hour])) });
        let all = Sum::of(cells.iter().flatten());
        let recorded_days = all.recorded_h / 24.0;
        Map {
            name: name.into(),
            from,
            events: all.events,
            motion_sensors: found.motion_sensors,
            left_out: found.left_out,
            entrance: found.entrance,
            recorded_h: all.recorded_h,
            away_h: all.away_h,
            density_per_h: all.density_per_h,
            away_h_per_day: if recorded_days > 0.0 { all.away_h / recorded_days } else { 0.0 },
            days: days.collect(),
            hours: hours.collect(),
            absences: found.absences,
            cells,
        }
    }

    /// The cells as rows of a table: `date,hour,events,athome_h,density`; without a density where nobody was at home, and
    /// without hours at home where nothing is known.
    pub fn csv(&self) -> String {
        let mut text = String::from("date,hour,events,athome_h,density\n");
        for (day, cells) in self.days.iter().zip(&self.cells) {
            for (hour, cell) in cells.iter().enumerate() {
                let [at_home, density] = match cell.state() {
                    State::NoData => [String::new(), String::new()],
                    State::Away => [format!("{:.4}", cell.at_home_h()), String::new()],
                    State::Density(density) => [format!("{:.4}", cell.at_home_h()), format!("{density:.4}")],
                };
                text += &format!("{},{hour},{},{at_home},{density}\n", day.date, cell.events);
            }
        }
        text
    }
}

/// The rows of a log, in order: when there were any, events of motion, and signs of somebody.
struct Heard {
    rows: Vec<Micros>,
    events: Vec<Micros>,
    signs: Vec<Sign>,
}

impl Heard {
    fn of(log: &Log, kinds: &[Kind], entrance: &Entrance) -> Heard {
        let is_entrance: Vec<bool> = log.sensors.iter().map(|name| entrance.sensors.contains(name)).collect();
        let mut heard = Heard { rows: Vec::with_capacity(log.events.len()), events: Vec::new(), signs: Vec::new() };
        for (event, said) in log.events.iter().zip(said(log)) {
            let (at, sensor) = (event.at, event.sensor as usize);
            let is_motion = kinds[sensor] == Kind::Motion && said.begins() && said.says == Says::Begins;
            let is_use = matches!(kinds[sensor], Kind::Contact | Kind::Used) && said.begins();
            if is_motion || is_use {
                let at_entrance = is_entrance[sensor];
                let opens_door = kinds[sensor] == Kind::Contact && at_entrance;
                heard.signs.push(Sign { at, at_entrance, opens_door, is_use });
            }
            heard.events.extend(is_motion.then_some(at));
            heard.rows.push(at);
        }
        heard.rows.sort_unstable();
        heard.events.sort_unstable();
        heard.signs.sort_by_key(|sign| sign.at);
        heard
    }
}

/// What of a log is no matter of its cells.
struct Found {
    motion_sensors: usize,
    left_out: Vec<String>,
    entrance: Entrance,
    absences: Vec<Absence>,
}

/// The days of a map.
struct Days {
    first: Date,
    count: usize,
}

fn days(asked: &Asked, begin: Micros, end: Micros) -> Result<Days, NoMap> {
    let (first, last) = (date_of(begin), date_of(end - 1));
    let from = asked.from.unwrap_or(first);
    if !(first..=last).contains(&from) {
        return Err(NoMap::NoDay(from, first, last));
    }
    let there = ((midnight(last) - midnight(from)) / DAY + 1) as usize;
    let count = asked.days.unwrap_or(there).min(there);
    if count > MOST_DAYS { Err(NoMap::TooLong(count)) } else { Ok(Days { first: from, count }) }
}

impl Days {
    fn span(&self) -> Range<Micros> {
        let begin = midnight(self.first);
        begin..begin + self.count as Micros * DAY
    }

    fn cell<'c>(&self, cells: &'c mut [[Cell; 24]], at: Micros) -> Option<&'c mut Cell> {
        let hours = (at - self.span().start).div_euclid(HOUR);
        let hour = usize::try_from(hours).ok()?;
        cells.get_mut(hour / 24).map(|day| &mut day[hour % 24])
    }

    /// Gives each hour its part of a span, in hours.
    fn add(&self, cells: &mut [[Cell; 24]], span: Range<Micros>, add: impl Fn(&mut Cell, f64)) {
        let all = self.span();
        let mut at = span.start.max(all.start);
        let end = span.end.min(all.end);
        while at < end {
            let next = ((at.div_euclid(HOUR) + 1) * HOUR).min(end);
            if let Some(cell) = self.cell(cells, at) {
                add(cell, seconds(next - at) / 3600.0);
            }
            at = next;
        }
    }

    /// The same as it was lived: what the clock on the wall leaves out is none of the span, and what it shows again is in it twice.
    fn add_lived(
        &self,
        cells: &mut [[Cell; 24]],
        span: &Range<Micros>,
        set: &[ClockSet],
        add: impl Fn(&mut Cell, f64),
    ) {
        self.add(cells, span.clone(), &add);
        for ClockSet { wall, is_again } in set {
            let part = span.start.max(wall.start)..span.end.min(wall.end);
            self.add(cells, part, |cell, hours| add(cell, if *is_again { hours } else { -hours }));
        }
    }
}

/// From the first row to the last, but for silences that no absence explains.
fn without_silences(rows: &[Micros], absences: &[Absence]) -> Vec<(Micros, Micros)> {
    let mut recorded = Vec::new();
    let mut begin = rows[0];
    for pair in rows.windows(2) {
        let is_away = || absences.iter().any(|absence| absence.begin <= pair[0] && pair[1] <= absence.end);
        if pair[1] - pair[0] > SILENCE && !is_away() {
            recorded.push((begin, pair[0] + 1));
            begin = pair[1];
        }
    }
    recorded.push((begin, rows[rows.len() - 1] + 1));
    recorded
}
