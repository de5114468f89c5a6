//! What residents did when and where they were, from a run's truth.

use super::activities::Activity;
use super::database::{instant, text};
use super::instant::Instants;
use super::recorded_truth::RecordedTruth;
use super::run_clock::RunClock;
use super::turns::Turns;
use crate::error::LogError;
use crate::truth::Truth;
use crate::url::Url;
use homebody_core::time::Micros;
use rusqlite::Rows;
use std::collections::{BTreeMap, HashMap};

/// What a run's truth tells of one resident.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Life {
    /// The resident's name.
    pub resident: String,
    /// In order of their beginnings.
    pub activities: Vec<Activity>,
    /// The rooms as spans, named by the room; none between rooms and away.
    pub rooms: Vec<Activity>,
}

/// The activities that a run's truth tells, of all residents, in order of their beginnings; instants are as in [`lives`].
pub fn activities(truth: &Url, clock: &RunClock) -> Result<Vec<Activity>, LogError> {
    let mut all: Vec<Activity> = lives(truth, clock)?.into_iter().flat_map(|life| life.activities).collect();
    all.sort_by_key(|activity| activity.begin);
    Ok(all)
}

/// What a run's truth tells of each resident, by name. Instants are microseconds since the run's start, by the clock of its
/// files; [`RunClock::told`] says what they are since 1970.
///
/// # Errors
///
/// [`LogError::NoTruth`] if there is none in this place.
pub fn lives(truth: &Url, clock: &RunClock) -> Result<Vec<Life>, LogError> {
    lives_of(&RecordedTruth::open(truth, &[Truth::Room, Truth::Activity])?, clock)
}

/// The same of a truth that is open.
pub(crate) fn lives_of(truth: &RecordedTruth, clock: &RunClock) -> Result<Vec<Life>, LogError> {
    let mut lives: BTreeMap<String, Life> = BTreeMap::new();
    read(truth, clock, &mut |span| {
        if !lives.contains_key(span.resident) {
            lives.insert(span.resident.into(), Life { resident: span.resident.into(), ..Life::default() });
        }
        let life = lives.get_mut(span.resident).expect("just put there");
        let of = match span.kind {
            SpanKind::Activity => &mut life.activities,
            SpanKind::Room => &mut life.rooms,
        };
        of.push(Activity { name: span.name.into(), begin: span.begin, end: span.end });
        Ok(())
    })?;
    Ok(lives.into_values().collect())
}

/// What a resident did, or where they were.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpanKind {
    /// The name is that of an activity.
    Activity,
    /// The name is that of a room.
    Room,
}

/// A span of a resident's life, as a run's truth tells it.
#[derive(Clone, Copy, Debug)]
pub struct LifeSpan<'t> {
    /// What the name is of.
    pub kind: SpanKind,
    /// The resident's name.
    pub resident: &'t str,
    /// What was done, or the room.
    pub name: &'t str,
    /// From when, in microseconds since the run's start, as in [`lives`].
    pub begin: Micros,
    /// Until when.
    pub end: Micros,
}

/// Gives what [`lives`] has span by span, and keeps none of them: activities and rooms in the order in which they end.
///
/// # Errors
///
/// [`LogError::NoTruth`] if there is none in this place; those of `take`.
pub fn life_spans(
    truth: &Url,
    clock: &RunClock,
    take: &mut dyn FnMut(LifeSpan<'_>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    read(&RecordedTruth::open(truth, &[Truth::Room, Truth::Activity])?, clock, take)
}

fn read(
    truth: &RecordedTruth,
    clock: &RunClock,
    take: &mut dyn FnMut(LifeSpan<'_>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    let clock = truth.clock(clock);
    let turns = Turns::new(truth, &clock)?;
    let failed = |error| truth.error(error);
    let prepare = |sql: &str| truth.connection.prepare(sql).map_err(failed);
    let mut activities =
        prepare("SELECT begin_at, end_at, resident, name FROM activity WHERE name IS NOT NULL ORDER BY rowid")?;
    let mut rooms = prepare("SELECT at, NULL, resident, room FROM room ORDER BY rowid")?;
    let mut activities = Tellings::new(activities.query([]).map_err(failed)?);
    let mut rooms = Tellings::new(rooms.query([]).map_err(failed)?);
    let (mut activity, mut room) = (activities.next().map_err(failed)?, rooms.next().map_err(failed)?);
    let mut done: HashMap<String, Micros> = HashMap::new();
    // Since when who is where.
    let mut now: BTreeMap<String, (Micros, Option<String>)> = BTreeMap::new();
    let mut end = Micros::MIN;
    loop {
        let is_activity = match (&activity, &room) {
            (Some(activity), Some(room)) => activity.over() <= room.over(),
            (activity, _) => activity.is_some(),
        };
        if is_activity {
            let next = activities.next().map_err(failed)?;
            let Some(Told { at: [Some(begin), Some(until)], who: resident, what: Some(name) }) =
                std::mem::replace(&mut activity, next)
            else {
                continue;
            };
            let begin = turns.turn(&resident, begin, done.get(&resident).copied().unwrap_or(Micros::MIN));
            let until = turns.turn(&resident, until, begin);
            end = end.max(until);
            take(LifeSpan { kind: SpanKind::Activity, resident: &resident, name: &name, begin, end: until })?;
            done.insert(resident, until);
            continue;
        }
        let next = rooms.next().map_err(failed)?;
        let Some(Told { at, who: resident, what }) = std::mem::replace(&mut room, next) else { break };
        let Some(at) = at[0] else { continue };
        let before = now.get(&resident);
        let at = turns.turn(&resident, at, before.map_or(Micros::MIN, |(since, _)| *since));
        before.map_or(Ok(()), |room| leave(&resident, room, at, take))?;
        now.insert(resident, (at, what));
    }
    // Where somebody goes ends where they are; the last room ends with the run, or when no more is known.
    if truth.has_movements {
        let mut last = prepare("SELECT end_at, NULL, NULL, NULL FROM movement ORDER BY rowid DESC LIMIT 1")?;
        let last = Tellings::new(last.query([]).map_err(failed)?).next().map_err(failed)?;
        end = last.and_then(|told| told.at[0]).map_or(end, |at| clock.instant_from(at, end).max(end));
    }
    now.iter().try_for_each(|(resident, room)| leave(resident, room, end, take))
}

/// Gives the room that somebody leaves.
fn leave(
    resident: &str,
    (begin, name): &(Micros, Option<String>),
    at: Micros,
    take: &mut dyn FnMut(LifeSpan<'_>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    match name {
        Some(name) if *begin < at => take(LifeSpan { kind: SpanKind::Room, resident, name, begin: *begin, end: at }),
        _ => Ok(()),
    }
}

/// A row of the truth, its instants in microseconds since 1970.
struct Told {
    at: [Option<Micros>; 2],
    who: String,
    what: Option<String>,
}

impl Told {
    /// When it is over.
    fn over(&self) -> Option<Micros> {
        self.at[1].or(self.at[0])
    }
}

/// Rows of two instants, who, and what.
struct Tellings<'s> {
    rows: Rows<'s>,
    instants: Instants,
}

impl<'s> Tellings<'s> {
    fn new(rows: Rows<'s>) -> Tellings<'s> {
        Tellings { rows, instants: Instants::default() }
    }

    fn next(&mut self) -> rusqlite::Result<Option<Told>> {
        let Some(row) = self.rows.next()? else { return Ok(None) };
        let at = [instant(row, 0, &mut self.instants)?, instant(row, 1, &mut self.instants)?];
        let [who, what] = [row.get_ref(2)?, row.get_ref(3)?].map(|cell| text(cell).into_owned());
        Ok(Some(Told { at, who, what: Some(what).filter(|what| !what.is_empty()) }))
    }
}
