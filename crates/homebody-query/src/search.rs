//! Searches over a whole log or run: stays in rooms, sensors that are on, times without movement, falls, lost messages, alerts.
//!
//! A match is an interval. It is cut to the given hours of the day, and only then compared with the shortest duration: a stay from 5:50 to
//! 6:10 has ten minutes "between 0 and 6". Rooms and activities are those of the ground truth, if there is one. Without it, a person is in
//! a room from a message of its sensors until a message of another room's sensors; people are not told apart. A sensor is on until it says
//! that it is off, or until its state is unknown; a sensor that is never off is on as long as it repeats itself within ten minutes. Nothing
//! stirs while no sensor says anything but readings; if the times at home are known, only those count.

mod hours;

pub use hours::{DayHours, HoursMessage, SearchDay};

use homebody_analysis::signs::{Says, SensorCourse, says};
use homebody_core::nearest::nearest;
use homebody_core::time::{Interval, MINUTE, Span, TimePoint, intersection, joined, without};
use serde::Deserialize;
use std::borrow::Cow;

/// Time within which the same event again belongs to one match (our choice).
const PAUSE: Span = MINUTE;

/// Time within which a repeated event belongs to one match, for a sensor without an end of its events (our choice).
const BOUT: Span = MINUTE.times(10);

/// The first words about a fall of the ground truth, next to those that cameras see.
pub const BY_TRUTH: &str = "by the truth: ";

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub enum SearchSubject {
    Room,
    On,
    /// No sensor says anything but readings while a person is at home.
    Still,
    Doing,
    Fall,
    /// Cameras see a fall; the ground truth has its falls, too.
    SeenFall,
    /// A message never reached the logger.
    Lost,
    Alert,
}

impl SearchSubject {
    pub const ALL: [SearchSubject; 8] = {
        use SearchSubject::{Alert, Doing, Fall, Lost, On, Room, SeenFall, Still};
        [Room, On, Still, Doing, Fall, SeenFall, Lost, Alert]
    };

    /// The word for it in a query.
    pub fn word(self) -> &'static str {
        match self {
            SearchSubject::Room => "room",
            SearchSubject::On => "on",
            SearchSubject::Still => "still",
            SearchSubject::Doing => "doing",
            SearchSubject::Fall => "fall",
            SearchSubject::SeenFall => "seen-fall",
            SearchSubject::Lost => "lost",
            SearchSubject::Alert => "alert",
        }
    }

    /// A search for it needs a name: of a room, a sensor or an activity.
    pub fn has_name(self) -> bool {
        matches!(self, SearchSubject::Room | SearchSubject::On | SearchSubject::Doing)
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Query {
    pub what: SearchSubject,
    /// The room, sensor or activity; of lost messages, alerts and seen falls, the name of their sensor or rule.
    pub name: Option<String>,
    pub hours: Option<DayHours>,
    /// The shortest duration of a match.
    pub least: Span,
}

/// An interval that is known without a look at the rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KnownStay<'a, T> {
    /// From when to when; empty for an event.
    pub time: Interval<T>,
    /// The resident, if it is about one.
    pub who: Option<Cow<'a, str>>,
    /// The room, what was done, the sensor of a lost message, the rule of an alert or of a fall that cameras see.
    pub name: Cow<'a, str>,
    /// Further words.
    pub words: Cow<'a, str>,
}

impl<'a, T> KnownStay<'a, T> {
    /// A time in which a person is in a room or does something.
    pub fn with_person(who: &'a str, name: &'a str, time: Interval<T>) -> KnownStay<'a, T> {
        KnownStay { time, who: Some(Cow::Borrowed(who)), name: Cow::Borrowed(name), words: Cow::Borrowed("") }
    }
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listener {
    pub name: String,
    /// The room, if it is known.
    pub room: Option<String>,
    /// It tells of no person, as an automation does: its rows do not count.
    pub tells_of_nobody: bool,
}

/// Takes a row: time, number of the sensor, number of the value.
pub type TakeSearchRow<'a, T> = dyn FnMut(T, u32, u32) + 'a;

/// Hands over all rows in the order of time.
pub type SearchRows<'a, T> = dyn FnMut(&mut TakeSearchRow<T>) -> Result<(), String> + 'a;

pub struct SearchGround<'a, T> {
    /// The time of the log.
    pub span: Interval<T>,
    pub days: Vec<SearchDay<T>>,
    /// The intervals that are known without a look at the rows; `None` if they are unknown.
    pub told: Option<Vec<KnownStay<'a, T>>>,
    /// The times with a person at home, in order; `None` if they are unknown.
    pub home: Option<Vec<Interval<T>>>,
    pub sensors: Vec<Listener>,
    pub values: &'a [String],
    /// The gaps of the recorder, in order.
    pub gaps: Vec<Interval<T>>,
    pub rows: &'a mut SearchRows<'a, T>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hit<T> {
    /// From when to when.
    pub time: Interval<T>,
    /// The room, the sensor, the activity, or the rule; empty for a time without movement.
    pub name: String,
    /// The resident and the details, as far as they are known.
    pub words: String,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SearchResult<T> {
    pub hits: Vec<Hit<T>>,
    pub remarks: Vec<String>,
}

homebody_core::messages! {
    /// Errors of a search in a log.
    #[derive(Clone, PartialEq, Eq)]
    pub enum SearchError in "find" {
        /// A search for a room, a sensor or an activity needs its name.
        NoName(kind: &'static str) error "no-name" ("the name of the {kind} is missing")
            hint ("write the name after the word {kind}");
        /// No room, sensor or activity of the log has this name.
        Unknown { kind: &'static str, name: String, hint: String } error "unknown-name" ("no {kind} is called {name:?}") hint ("{hint}");
        /// Activities, falls and lost messages are in the ground truth of a run, and not in a log.
        NoTruth(what: &'static str) error "needs-truth" ("a log alone does not contain {what}")
            hint ("name a run that has its ground truth");
        /// The rows of the log cannot be read.
        Unread(why: String) error "unreadable" ("{why}");
    }
}

/// Looks for it.
pub fn find<T: TimePoint + Default>(
    query: &Query,
    ground: &mut SearchGround<T>,
) -> Result<SearchResult<T>, SearchError> {
    let kind = match query.what {
        SearchSubject::Room => "room",
        SearchSubject::On => "sensor",
        _ => "activity",
    };
    if query.what.has_name() && query.name.is_none() {
        return Err(SearchError::NoName(kind));
    }
    let mut remarks = Vec::new();
    let name = query.name.as_deref().unwrap_or("");
    let all: Vec<Hit<T>> = match (query.what, ground.told.take()) {
        (SearchSubject::Room, None) => by_sensors(name, ground, &mut remarks)?,
        (SearchSubject::Room, Some(told)) => {
            // The plan has rooms without stays.
            let known = rooms(ground).chain(told.iter().map(|stay| &*stay.name));
            let name = named("room", name, known)?;
            merged(told, &name)
        }
        (SearchSubject::On, _) => on(name, ground, &mut remarks)?,
        (SearchSubject::Still, _) => still(ground, &mut remarks)?,
        (SearchSubject::Doing, Some(told)) => {
            let name = named("activity", &name.replace(' ', "_"), told.iter().map(|stay| &*stay.name))?;
            merged(told, &name)
        }
        (_, Some(told)) => {
            let is_asked = |stay: &KnownStay<T>| query.name.as_ref().is_none_or(|name| *name == *stay.name);
            told.into_iter().filter(is_asked).map(|stay| hit(&stay)).collect()
        }
        (what, None) => {
            return Err(SearchError::NoTruth(match what {
                SearchSubject::Doing => "activities",
                SearchSubject::Fall | SearchSubject::SeenFall => "falls",
                SearchSubject::Lost => "lost messages",
                _ => "it",
            }));
        }
    };
    let within = query.hours.map(|hours| hours.over(&ground.days));
    let mut hits: Vec<Hit<T>> = match &within {
        Some(within) => all.into_iter().flat_map(|hit| parts(&hit, within)).collect(),
        None => all,
    };
    hits.retain(|hit| hit.time.length() >= query.least);
    hits.sort_by_key(|hit| hit.time.begin);
    Ok(SearchResult { hits, remarks })
}

/// The parts of a match within intervals in order; a match without length is in them or not.
fn parts<T: TimePoint>(hit: &Hit<T>, within: &[Interval<T>]) -> Vec<Hit<T>> {
    let Interval { begin, end } = hit.time;
    let within = &within[within.partition_point(|interval| interval.end <= begin)..];
    if begin == end {
        return within.first().filter(|first| first.contains(begin)).map(|_| hit.clone()).into_iter().collect();
    }
    let parts = intersection(&[hit.time], within).into_iter();
    parts.map(|time| Hit { time, ..hit.clone() }).collect()
}

fn rooms<'a, T>(ground: &'a SearchGround<T>) -> impl Iterator<Item = &'a str> {
    ground.sensors.iter().filter_map(|sensor| sensor.room.as_deref())
}

/// The one of these names that `name` means, in any case of its letters.
fn named<'n>(kind: &'static str, name: &str, known: impl Iterator<Item = &'n str>) -> Result<String, SearchError> {
    let mut known: Vec<&str> = known.collect();
    known.sort_unstable();
    known.dedup();
    let is_meant = |one: &&&str| one.eq_ignore_ascii_case(name);
    if let Some(one) = known.iter().find(|one| **one == name).or_else(|| known.iter().find(is_meant)) {
        return Ok((*one).to_owned());
    }
    let hint = match nearest(name, known.iter().copied()) {
        Some(one) => format!("did you mean {one:?}?"),
        None if known.is_empty() => format!("the log names no {kind}"),
        None => format!("there are {}", known.iter().take(30).copied().collect::<Vec<_>>().join(", ")),
    };
    Err(SearchError::Unknown { kind, name: name.to_owned(), hint })
}

fn hit<T: TimePoint>(stay: &KnownStay<T>) -> Hit<T> {
    let words = match (&stay.who, &*stay.words) {
        (Some(who), "") => who.to_string(),
        (Some(who), words) => format!("{who}: {words}"),
        (None, words) => words.to_owned(),
    };
    Hit { time: stay.time, name: stay.name.to_string(), words }
}

/// The stays of one name by person; stays with a short pause between are one.
fn merged<T: TimePoint>(told: Vec<KnownStay<T>>, name: &str) -> Vec<Hit<T>> {
    let mut all: Vec<Hit<T>> = Vec::new();
    let mut last: Vec<(Option<Cow<str>>, usize)> = Vec::new();
    for stay in told.into_iter().filter(|stay| *stay.name == *name) {
        let known = last.iter().position(|(who, _)| *who == stay.who);
        let before = known.map(|known| &mut all[last[known].1]);
        match before.filter(|before| stay.time.begin - before.time.end <= PAUSE) {
            Some(before) => before.time.end = before.time.end.max(stay.time.end),
            None => {
                last.retain(|(who, _)| *who != stay.who);
                last.push((stay.who.clone(), all.len()));
                all.push(hit(&stay));
            }
        }
    }
    all
}

/// Intervals without further words.
fn wordless<T: TimePoint>(spans: Vec<Interval<T>>, name: &str) -> Vec<Hit<T>> {
    let hit = |time| Hit { time, name: name.to_owned(), words: String::new() };
    spans.into_iter().map(hit).collect()
}

fn meanings(values: &[String]) -> Vec<Says> {
    values.iter().map(|value| says(value)).collect()
}

fn by_sensors<T: TimePoint + Default>(
    name: &str,
    ground: &mut SearchGround<T>,
    remarks: &mut Vec<String>,
) -> Result<Vec<Hit<T>>, SearchError> {
    let name = named("room", name, rooms(ground))?;
    let said = meanings(ground.values);
    let is_in: Vec<Option<bool>> =
        ground.sensors.iter().map(|sensor| sensor.room.as_ref().map(|room| *room == name)).collect();
    let mut courses = vec![SensorCourse::default(); ground.sensors.len()];
    let mut recorder = SensorCourse::default();
    let mut spans: Vec<Interval<T>> = Vec::new();
    let mut since = None;
    let mut last = ground.span.begin;
    let mut take = |at: T, sensor: u32, value: u32| {
        last = at;
        let says = said.get(value as usize).copied().unwrap_or(Says::Else);
        // A stay ends at a gap of the recorder.
        if let Some(gap) = recorder.take(at, Says::Begins, &ground.gaps).unknown_from {
            spans.extend(since.take().map(|begin| Interval::new(begin, gap)));
        }
        let Some(course) = courses.get_mut(sensor as usize) else { return };
        if !course.take(at, says, &ground.gaps).begins() || ground.sensors[sensor as usize].tells_of_nobody {
            return;
        }
        match is_in.get(sensor as usize).copied().flatten() {
            Some(true) => since = since.or(Some(at)),
            Some(false) => spans.extend(since.take().map(|begin| Interval::new(begin, at))),
            None => {}
        }
    };
    (ground.rows)(&mut take).map_err(SearchError::Unread)?;
    spans.extend(since.map(|begin| Interval::new(begin, last)));
    remarks
        .push("By its sensors: from what one of the room says until one of another room does, whoever it is.".into());
    Ok(wordless(spans, &name))
}

/// The state of a sensor from an instant on.
#[derive(Clone, Copy, PartialEq, Eq)]
enum OnOff {
    On,
    Off,
    Unknown,
}

fn on<T: TimePoint + Default>(
    name: &str,
    ground: &mut SearchGround<T>,
    remarks: &mut Vec<String>,
) -> Result<Vec<Hit<T>>, SearchError> {
    let name = named("sensor", name, ground.sensors.iter().map(|sensor| sensor.name.as_str()))?;
    let of = ground.sensors.iter().position(|sensor| sensor.name == name).map_or(u32::MAX, |at| at as u32);
    let said = meanings(ground.values);
    let mut begins: Vec<(T, OnOff)> = Vec::new();
    let mut course = SensorCourse::default();
    let mut last = ground.span.begin;
    let mut take = |at: T, sensor: u32, value: u32| {
        last = at;
        if sensor != of {
            return;
        }
        let says = said.get(value as usize).copied().unwrap_or(Says::Else);
        let said = course.take(at, says, &ground.gaps);
        begins.extend(said.unknown_from.map(|unknown| (unknown, OnOff::Unknown)));
        match said.says {
            says if says.is_on() => begins.push((at, OnOff::On)),
            Says::Ends | Says::Closes => begins.push((at, OnOff::Off)),
            _ => {}
        }
    };
    (ground.rows)(&mut take).map_err(SearchError::Unread)?;
    let mut spans: Vec<Interval<T>> = Vec::new();
    if begins.iter().any(|(_, is)| *is == OnOff::Off) {
        let mut since = None;
        for (at, is) in begins {
            match is {
                OnOff::On => since = since.or(Some(at)),
                OnOff::Off | OnOff::Unknown => spans.extend(since.take().map(|begin| Interval::new(begin, at))),
            }
        }
        spans.extend(since.map(|begin| Interval::new(begin, last)));
    } else {
        let begins = begins.into_iter().filter(|(_, is)| *is == OnOff::On);
        spans = joined(begins.map(|(at, _)| Interval::instant(at)), BOUT);
        let minutes = BOUT / MINUTE;
        remarks.push(format!("{name} never says that it is off: what it says again within {minutes} minutes is one."));
    }
    Ok(wordless(spans, &name))
}

fn still<T: TimePoint>(ground: &mut SearchGround<T>, remarks: &mut Vec<String>) -> Result<Vec<Hit<T>>, SearchError> {
    let said = meanings(ground.values);
    let Interval { begin, end } = ground.span;
    let mut spans: Vec<Interval<T>> = Vec::new();
    let mut since = begin;
    let mut take = |at: T, sensor: u32, value: u32| {
        let is_sign = said.get(value as usize).is_some_and(|says| says.is_sign());
        if !is_sign || ground.sensors.get(sensor as usize).is_some_and(|sensor| sensor.tells_of_nobody) {
            return;
        }
        if at - since > PAUSE {
            spans.push(Interval::new(since, at));
        }
        since = since.max(at);
    };
    (ground.rows)(&mut take).map_err(SearchError::Unread)?;
    if end - since > PAUSE {
        spans.push(Interval::new(since, end));
    }
    let spans = without(&spans, &ground.gaps);
    let spans = match &ground.home {
        Some(home) => intersection(&spans, home),
        None => {
            remarks.push("Nobody knows whether anybody was at home: also while all are out nothing stirs.".into());
            spans
        }
    };
    Ok(wordless(spans, ""))
}

/// Falls, with the room of each, by the stays of the same person. `by` begins their words, and may be empty.
pub fn falls_in_rooms<'a, T: TimePoint>(
    falls: Vec<KnownStay<'a, T>>,
    stays: &[KnownStay<T>],
    by: &str,
) -> Vec<KnownStay<'a, T>> {
    let told = |fall: KnownStay<'a, T>| {
        let is_there = |stay: &&KnownStay<T>| stay.who == fall.who && stay.time.contains(fall.time.begin);
        let room = stays.iter().find(is_there).filter(|stay| !stay.name.is_empty());
        let words = room.map_or_else(|| format!("{by}has fallen"), |room| format!("{by}has fallen, {}", room.name));
        KnownStay { words: Cow::Owned(words), ..fall }
    };
    falls.into_iter().map(told).collect()
}

/// The times with a person at home: all stays in rooms together, with short ways between rooms.
pub fn at_home<T: TimePoint>(stays: &[KnownStay<T>]) -> Vec<Interval<T>> {
    let mut stays: Vec<Interval<T>> = stays.iter().map(|stay| stay.time).collect();
    stays.sort_unstable();
    joined(stays, PAUSE)
}

#[cfg(test)]
mod tests;
