//! What is looked for over a whole log or run: where somebody is, what is on, when nothing stirs, falls and what cameras take for
//! them, lost messages, alerts.
//!
//! What is found are spans. They are cut to hours of the day where some are asked for, and only then held against how long they are to
//! be at least: of a stay from 5:50 to 6:10, "between 0 and 6" has ten minutes. Rooms and activities are the truth's, where there is one;
//! without it somebody is taken to be in a room from what its sensors say until another room's say something, whoever it is. Something
//! goes on until its sensor says that it ends, or until its state is not known; where one never does, it goes on as long as the sensor says again within ten minutes.
//! Nothing stirs while no sensor says anything but readings; where it is known who is at home, only then is it counted.

mod hours;

pub use homebody_analysis::measures::Span;
use hours::MINUTE;
pub use hours::{DayClock, Hours, HoursMessage};

use homebody_analysis::measures::joined;
use homebody_analysis::signs::{Course, Says, says, without};
use homebody_core::scenario::nearest::nearest;
use homebody_core::time::Micros;
use std::borrow::Cow;

/// Time within which the same event again belongs to one match (our choice).
const PAUSE: Micros = MINUTE;

/// Time within which a repeated event belongs to one match, for a sensor without an end of its events (our choice).
const BOUT: Micros = 10 * MINUTE;

/// How words begin about a fall that the truth tells of, beside those that cameras see.
pub const BY_TRUTH: &str = "by the truth: ";

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// Somebody is in a room.
    Room,
    /// A sensor has said that something goes on, and not yet that it ends.
    On,
    /// No sensor says anything but readings, while somebody is at home.
    Still,
    /// Somebody does something.
    Doing,
    /// Somebody has fallen.
    Fall,
    /// Cameras take something for a fall; beside these what the truth tells of falls.
    SeenFall,
    /// A message never reached the logger.
    Lost,
    /// Something is different from before.
    Alert,
}

impl What {
    /// All of them.
    pub const ALL: [What; 8] =
        [What::Room, What::On, What::Still, What::Doing, What::Fall, What::SeenFall, What::Lost, What::Alert];

    /// In a word, as it is asked for.
    pub fn word(self) -> &'static str {
        match self {
            What::Room => "room",
            What::On => "on",
            What::Still => "still",
            What::Doing => "doing",
            What::Fall => "fall",
            What::SeenFall => "seen-fall",
            What::Lost => "lost",
            What::Alert => "alert",
        }
    }

    /// Whether a name has to be said: which room, which sensor, what is done.
    pub fn has_name(self) -> bool {
        matches!(self, What::Room | What::On | What::Doing)
    }

    /// Whether it is known without a look at the rows.
    fn is_told(self) -> bool {
        matches!(self, What::Doing | What::Fall | What::SeenFall | What::Lost | What::Alert)
    }
}

/// What is asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Query {
    /// What is looked for.
    pub what: What,
    /// Which room, which sensor, what is done; of lost messages, alerts and falls that cameras see, whose alone.
    pub name: Option<String>,
    /// Between which hours of the day.
    pub hours: Option<Hours>,
    /// How long it is to be at least.
    pub least: Micros,
}

/// What is known to have been.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stay<'a> {
    /// From when.
    pub begin: Micros,
    /// Until when; as it begins, what has no length.
    pub end: Micros,
    /// Whose it was.
    pub who: Option<Cow<'a, str>>,
    /// The room, what was done, the sensor of a lost message, the rule of an alert or of a fall that cameras see.
    pub name: Cow<'a, str>,
    /// What is said of it besides.
    pub words: Cow<'a, str>,
}

/// A sensor of the log.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listener {
    /// What the home calls it, or else the log.
    pub name: String,
    /// The room that it is in, where that is known.
    pub room: Option<String>,
    /// Whether it tells of no person, as an automation does: its rows do not count.
    pub tells_of_nobody: bool,
}

/// Takes a row: when, the sensor's number, the value's.
pub type TakeRow<'a> = dyn FnMut(Micros, u32, u32) + 'a;

/// Hands over all rows in the order of time.
pub type Rows<'a> = dyn FnMut(&mut TakeRow) -> Result<(), String> + 'a;

/// What is looked through.
pub struct Ground<'a> {
    /// From when to when there is something to be found.
    pub span: Span,
    /// Its days, by the clock on the wall.
    pub days: Vec<DayClock>,
    /// What is known of what is asked without a look at the rows; `None` where nobody knows.
    pub told: Option<Vec<Stay<'a>>>,
    /// When somebody was at home, in order; `None` where nobody knows.
    pub home: Option<Vec<Span>>,
    /// Those of the rows.
    pub sensors: Vec<Listener>,
    /// What rows say.
    pub values: &'a [String],
    /// When nothing was recorded, in order.
    pub gaps: Vec<Span>,
    /// The rows.
    pub rows: &'a mut Rows<'a>,
}

/// A span in which it was so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hit {
    /// From when.
    pub begin: Micros,
    /// Until when.
    pub end: Micros,
    /// The room, the sensor, what was done, or the rule; empty where nothing stirs.
    pub name: String,
    /// Whose it was, and what, as far as it is known.
    pub words: String,
}

/// All that was found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// In the order of their beginnings.
    pub hits: Vec<Hit>,
    /// How it was looked for, where that is not what one would think.
    pub remarks: Vec<String>,
}

homebody_core::messages! {
    /// Errors of a search in a log.
    #[derive(Clone, PartialEq, Eq)]
    pub enum Unfindable in "find" {
        /// A search for a room, a sensor or an activity needs its name.
        NoName(kind: &'static str) error "no-name" ("the name of the {kind} is missing")
            hint ("write the name after the word {kind}");
        /// No room, sensor or activity of the log has this name.
        Unknown {
            /// `room`, `sensor` or `activity`.
            kind: &'static str,
            /// The name that was asked for.
            name: String,
            /// The known names.
            hint: String,
        } error "unknown-name" ("no {kind} is called {name:?}") hint ("{hint}");
        /// Activities, falls and lost messages are in the ground truth of a run, and not in a log.
        NoTruth(what: &'static str) error "needs-truth" ("a log alone does not contain {what}")
            hint ("name a run that has its ground truth");
        /// The rows of the log cannot be read.
        Unread(why: String) error "unreadable" ("{why}");
    }
}

/// Looks for it.
///
/// # Errors
///
/// If a name leads nowhere, if only a truth would tell, or if the rows cannot be read.
pub fn find(query: &Query, ground: &mut Ground) -> Result<Found, Unfindable> {
    let kind = match query.what {
        What::Room => "room",
        What::On => "sensor",
        _ => "activity",
    };
    if query.what.has_name() && query.name.is_none() {
        return Err(Unfindable::NoName(kind));
    }
    let mut remarks = Vec::new();
    let name = query.name.as_deref().unwrap_or("");
    let all: Vec<Hit> = match (query.what, ground.told.take()) {
        (What::Room, None) => by_sensors(name, ground, &mut remarks)?,
        (What::Room, Some(told)) => {
            // The plan knows rooms that nobody was in.
            let known = rooms(ground).chain(told.iter().map(|stay| &*stay.name));
            let name = named("room", name, known)?;
            merged(told, &name)
        }
        (What::On, _) => on(name, ground, &mut remarks)?,
        (What::Still, _) => still(ground, &mut remarks)?,
        (What::Doing, Some(told)) => {
            let name = named("activity", &name.replace(' ', "_"), told.iter().map(|stay| &*stay.name))?;
            merged(told, &name)
        }
        (_, Some(told)) => {
            let is_asked = |stay: &Stay| query.name.as_ref().is_none_or(|name| *name == *stay.name);
            told.into_iter().filter(is_asked).map(|stay| hit(&stay)).collect()
        }
        (what, None) => {
            debug_assert!(what.is_told());
            return Err(Unfindable::NoTruth(match what {
                What::Doing => "activities",
                What::Fall | What::SeenFall => "falls",
                What::Lost => "lost messages",
                _ => "it",
            }));
        }
    };
    let within = query.hours.map(|hours| hours.over(&ground.days));
    let mut hits: Vec<Hit> = match &within {
        Some(within) => all.into_iter().flat_map(|hit| parts(&hit, within)).collect(),
        None => all,
    };
    hits.retain(|hit| hit.end - hit.begin >= query.least);
    hits.sort_by_key(|hit| hit.begin);
    Ok(Found { hits, remarks })
}

/// The parts of what was found that lie in spans in order.
fn parts(hit: &Hit, within: &[Span]) -> Vec<Hit> {
    let parts = hours::cut((hit.begin, hit.end), within).into_iter();
    parts.map(|(begin, end)| Hit { begin, end, ..hit.clone() }).collect()
}

fn rooms<'a>(ground: &'a Ground) -> impl Iterator<Item = &'a str> {
    ground.sensors.iter().filter_map(|sensor| sensor.room.as_deref())
}

/// The one of these names that is meant, whatever the case of its letters.
fn named<'n>(kind: &'static str, name: &str, known: impl Iterator<Item = &'n str>) -> Result<String, Unfindable> {
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
    Err(Unfindable::Unknown { kind, name: name.to_owned(), hint })
}

fn hit(stay: &Stay) -> Hit {
    let words = match (&stay.who, &*stay.words) {
        (Some(who), "") => who.to_string(),
        (Some(who), words) => format!("{who}: {words}"),
        (None, words) => words.to_owned(),
    };
    Hit { begin: stay.begin, end: stay.end, name: stay.name.to_string(), words }
}

/// The stays of one name, by whose they are; what goes on after a pause is one.
fn merged(told: Vec<Stay>, name: &str) -> Vec<Hit> {
    let mut all: Vec<Hit> = Vec::new();
    let mut last: Vec<(Option<Cow<str>>, usize)> = Vec::new();
    for stay in told.into_iter().filter(|stay| *stay.name == *name) {
        let known = last.iter_mut().find(|(who, _)| *who == stay.who);
        match known {
            Some((_, at)) if stay.begin - all[*at].end <= PAUSE => all[*at].end = all[*at].end.max(stay.end),
            Some((_, at)) => {
                *at = all.len();
                all.push(hit(&stay));
            }
            None => {
                last.push((stay.who.clone(), all.len()));
                all.push(hit(&stay));
            }
        }
    }
    all
}

/// Spans of which nothing more is said.
fn wordless(spans: Vec<Span>, name: &str) -> Vec<Hit> {
    spans.into_iter().map(|(begin, end)| Hit { begin, end, name: name.to_owned(), words: String::new() }).collect()
}

/// What the values of rows say.
fn meanings(values: &[String]) -> Vec<Says> {
    values.iter().map(|value| says(value)).collect()
}

fn by_sensors(name: &str, ground: &mut Ground, remarks: &mut Vec<String>) -> Result<Vec<Hit>, Unfindable> {
    let name = named("room", name, rooms(ground))?;
    let said = meanings(ground.values);
    let is_in: Vec<Option<bool>> =
        ground.sensors.iter().map(|sensor| sensor.room.as_ref().map(|room| *room == name)).collect();
    let mut courses = vec![Course::default(); ground.sensors.len()];
    let mut recorder = Course::default();
    let mut spans: Vec<Span> = Vec::new();
    let mut since = None;
    let mut last = ground.span.0;
    let mut take = |at: Micros, sensor: u32, value: u32| {
        last = at;
        let says = said.get(value as usize).copied().unwrap_or(Says::Else);
        // A stay ends at a gap of the recorder.
        if let Some(gap) = recorder.take(at, Says::Begins, &ground.gaps).unknown_from {
            spans.extend(since.take().map(|begin| (begin, gap)));
        }
        let Some(course) = courses.get_mut(sensor as usize) else { return };
        if !course.take(at, says, &ground.gaps).begins() || ground.sensors[sensor as usize].tells_of_nobody {
            return;
        }
        match is_in.get(sensor as usize).copied().flatten() {
            Some(true) => since = since.or(Some(at)),
            Some(false) => spans.extend(since.take().map(|begin| (begin, at))),
            None => {}
        }
    };
    (ground.rows)(&mut take).map_err(Unfindable::Unread)?;
    spans.extend(since.map(|begin| (begin, last)));
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

fn on(name: &str, ground: &mut Ground, remarks: &mut Vec<String>) -> Result<Vec<Hit>, Unfindable> {
    let name = named("sensor", name, ground.sensors.iter().map(|sensor| sensor.name.as_str()))?;
    let of = ground.sensors.iter().position(|sensor| sensor.name == name).map_or(u32::MAX, |at| at as u32);
    let said = meanings(ground.values);
    let mut begins: Vec<(Micros, OnOff)> = Vec::new();
    let mut course = Course::default();
    let mut last = ground.span.0;
    let mut take = |at: Micros, sensor: u32, value: u32| {
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
    (ground.rows)(&mut take).map_err(Unfindable::Unread)?;
    let mut spans: Vec<Span> = Vec::new();
    if begins.iter().any(|(_, is)| *is == OnOff::Off) {
        let mut since = None;
        for (at, is) in begins {
            match is {
                OnOff::On => since = since.or(Some(at)),
                OnOff::Off | OnOff::Unknown => spans.extend(since.take().map(|begin| (begin, at))),
            }
        }
        spans.extend(since.map(|begin| (begin, last)));
    } else {
        let begins = begins.into_iter().filter(|(_, is)| *is == OnOff::On);
        spans = joined(begins.map(|(at, _)| (at, at)), BOUT);
        let minutes = BOUT / MINUTE;
        remarks.push(format!("{name} never says that it is off: what it says again within {minutes} minutes is one."));
    }
    Ok(wordless(spans, &name))
}

fn still(ground: &mut Ground, remarks: &mut Vec<String>) -> Result<Vec<Hit>, Unfindable> {
    let said = meanings(ground.values);
    let (begin, end) = ground.span;
    let mut spans: Vec<Span> = Vec::new();
    let mut since = begin;
    let mut take = |at: Micros, sensor: u32, value: u32| {
        let is_sign = said.get(value as usize).is_some_and(|says| says.is_sign());
        if !is_sign || ground.sensors.get(sensor as usize).is_some_and(|sensor| sensor.tells_of_nobody) {
            return;
        }
        if at - since > PAUSE {
            spans.push((since, at));
        }
        since = since.max(at);
    };
    (ground.rows)(&mut take).map_err(Unfindable::Unread)?;
    if end - since > PAUSE {
        spans.push((since, end));
    }
    let spans = without(&spans, &ground.gaps);
    let spans = match &ground.home {
        Some(home) => hours::intersected(&spans, home),
        None => {
            remarks.push("Nobody knows whether anybody was at home: also while all are out nothing stirs.".into());
            spans
        }
    };
    Ok(wordless(spans, ""))
}

/// Falls, and in which room each was, by who was where. `by` says who tells of them, and may be empty.
pub fn falls_in_rooms<'a>(falls: Vec<Stay<'a>>, stays: &[Stay], by: &str) -> Vec<Stay<'a>> {
    let told = |fall: Stay<'a>| {
        let is_there = |stay: &&Stay| stay.who == fall.who && (stay.begin..stay.end).contains(&fall.begin);
        let room = stays.iter().find(is_there).filter(|stay| !stay.name.is_empty());
        let words = room.map_or_else(|| format!("{by}has fallen"), |room| format!("{by}has fallen, {}", room.name));
        Stay { words: Cow::Owned(words), ..fall }
    };
    falls.into_iter().map(told).collect()
}

/// When somebody was at home: all stays in rooms together, with short ways between rooms.
pub fn at_home(stays: impl IntoIterator<Item = Span>) -> Vec<Span> {
    let mut stays: Vec<Span> = stays.into_iter().collect();
    stays.sort_unstable();
    joined(stays.into_iter(), PAUSE)
}

#[cfg(test)]
mod tests;
