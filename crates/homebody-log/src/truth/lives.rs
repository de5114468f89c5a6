//! What residents did when and where they were, from a run's truth.

use super::RecordedTruth;
use super::turns::TruthClock;
use crate::error::LogError;
use crate::files::database::text;
use crate::log::Activity;
use crate::source::{InstantReader, instant_of_cell};
use crate::table::truth::Truth;
use crate::url::Url;
use homebody_core::time::{RunTime, Span, TimeScale, WallTime};
use rusqlite::Rows;
use std::collections::{BTreeMap, HashMap};

/// What a run's truth tells of one resident.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Life<T = RunTime> {
    /// The resident's name.
    pub resident: String,
    /// In order of their beginnings.
    pub activities: Vec<Activity<T>>,
    /// The rooms as spans, named by the room; none between rooms and away.
    pub rooms: Vec<Activity<T>>,
}

impl<T> Life<T> {
    /// The same with all instants changed, as to another scale: those of activities first.
    pub fn map<U>(self, mut change: impl FnMut(T) -> U) -> Life<U> {
        let mut all = |spans: Vec<Activity<T>>| spans.into_iter().map(|span| span.map(&mut change)).collect();
        Life { resident: self.resident, activities: all(self.activities), rooms: all(self.rooms) }
    }
}

/// The activities that a run's truth tells, of all residents, in order of their beginnings; the scale is as in [`lives`].
pub fn activities(truth: &Url, scale: &TimeScale) -> Result<Vec<Activity<RunTime>>, LogError> {
    let mut all: Vec<Activity<RunTime>> = lives(truth, scale)?.into_iter().flat_map(|life| life.activities).collect();
    all.sort_by_key(|activity| activity.begin);
    Ok(all)
}

/// What a run's truth tells of each resident, by name. The wall of the scale is the one that the run's files tell instants by.
///
/// # Errors
///
/// [`LogError::NoTruth`] if there is none in this place.
pub fn lives(truth: &Url, scale: &TimeScale) -> Result<Vec<Life>, LogError> {
    lives_of(&RecordedTruth::open(truth, &[Truth::Room, Truth::Activity])?, scale)
}

/// The same of a truth that is open.
pub(crate) fn lives_of(truth: &RecordedTruth, scale: &TimeScale) -> Result<Vec<Life>, LogError> {
    let mut lives: BTreeMap<String, Life> = BTreeMap::new();
    read(truth, scale, &mut |span| {
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
    /// From when.
    pub begin: RunTime,
    /// Until when.
    pub end: RunTime,
}

impl<'t> LifeSpan<'t> {
    fn of_activity(resident: &'t str, activity: &'t Activity<RunTime>) -> LifeSpan<'t> {
        let Activity { name, begin, end } = activity;
        LifeSpan { kind: SpanKind::Activity, resident, name, begin: *begin, end: *end }
    }
}

/// Gives what [`lives`] has span by span, and keeps none of them: activities and rooms in the order in which they end.
///
/// # Errors
///
/// [`LogError::NoTruth`] if there is none in this place; those of `take`.
pub fn life_spans(
    truth: &Url,
    scale: &TimeScale,
    take: &mut dyn FnMut(LifeSpan<'_>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    read(&RecordedTruth::open(truth, &[Truth::Room, Truth::Activity])?, scale, take)
}

fn read(
    truth: &RecordedTruth,
    scale: &TimeScale,
    take: &mut dyn FnMut(LifeSpan<'_>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    let scale = truth.scale(scale);
    let turns = TruthClock::new(truth, &scale)?;
    let failed = |error| truth.error(error);
    let prepare = |sql: &str| truth.connection.prepare(sql).map_err(failed);
    let mut activities =
        prepare("SELECT begin_at, end_at, resident, name FROM activity WHERE name IS NOT NULL ORDER BY rowid")?;
    let mut rooms = prepare("SELECT at, NULL, resident, room FROM room ORDER BY rowid")?;
    let mut activities = Tellings::new(activities.query([]).map_err(failed)?);
    let mut rooms = Tellings::new(rooms.query([]).map_err(failed)?);
    let (mut activity, mut room) = (activities.next().map_err(failed)?, rooms.next().map_err(failed)?);
    let mut done: HashMap<String, RunTime> = HashMap::new();
    // On a wall that is set back, the truth has an activity in pieces: by resident, the first of them.
    let set_backs: Vec<RunTime> =
        scale.run_changes().filter(|change| change.is_back()).map(|change| change.at - Span::MICROSECOND).collect();
    let mut parted: BTreeMap<String, Activity<RunTime>> = BTreeMap::new();
    // Since when who is where.
    let mut now: BTreeMap<String, (RunTime, Option<String>)> = BTreeMap::new();
    let mut end = RunTime::MIN;
    loop {
        let is_activity = match (&activity, &room) {
            (Some(activity), Some(room)) => activity.over() <= room.over(),
            (activity, _) => activity.is_some(),
        };
        if is_activity {
            let next = activities.next().map_err(failed)?;
            let Some(TruthRow { at: [Some(begin), Some(until)], who: resident, what: Some(name) }) =
                std::mem::replace(&mut activity, next)
            else {
                continue;
            };
            let begin = turns.turn(&resident, begin, done.get(&resident).copied().unwrap_or(RunTime::MIN));
            let until = turns.turn(&resident, until, begin);
            end = end.max(until);
            done.insert(resident.clone(), until);
            let mut whole = Activity { name, begin, end: until };
            match parted.remove(&resident) {
                Some(first) if first.name == whole.name && begin - first.end <= Span::MICROSECOND => {
                    whole.begin = first.begin;
                }
                Some(other) => take(LifeSpan::of_activity(&resident, &other))?,
                None => {}
            }
            if set_backs.contains(&until) {
                parted.insert(resident, whole);
            } else {
                take(LifeSpan::of_activity(&resident, &whole))?;
            }
            continue;
        }
        let next = rooms.next().map_err(failed)?;
        let Some(TruthRow { at, who: resident, what }) = std::mem::replace(&mut room, next) else { break };
        let Some(at) = at[0] else { continue };
        let before = now.get(&resident);
        let at = turns.turn(&resident, at, before.map_or(RunTime::MIN, |(since, _)| *since));
        before.map_or(Ok(()), |room| leave(&resident, room, at, take))?;
        now.insert(resident, (at, what));
    }
    parted.iter().try_for_each(|(resident, activity)| take(LifeSpan::of_activity(resident, activity)))?;
    // Where somebody goes ends where they are; the last room ends with the run, or when no more is known.
    if truth.has_movements {
        let mut last = prepare("SELECT end_at, NULL, NULL, NULL FROM movement ORDER BY rowid DESC LIMIT 1")?;
        let last = Tellings::new(last.query([]).map_err(failed)?).next().map_err(failed)?;
        end = last.and_then(|told| told.at[0]).map_or(end, |at| scale.run_from_wall_after(at, end).max(end));
    }
    now.iter().try_for_each(|(resident, room)| leave(resident, room, end, take))
}

/// Gives the room that somebody leaves.
fn leave(
    resident: &str,
    (begin, name): &(RunTime, Option<String>),
    at: RunTime,
    take: &mut dyn FnMut(LifeSpan<'_>) -> Result<(), LogError>,
) -> Result<(), LogError> {
    match name {
        Some(name) if *begin < at => take(LifeSpan { kind: SpanKind::Room, resident, name, begin: *begin, end: at }),
        _ => Ok(()),
    }
}

/// A row of the truth.
struct TruthRow {
    at: [Option<WallTime>; 2],
    who: String,
    what: Option<String>,
}

impl TruthRow {
    /// When it is over.
    fn over(&self) -> Option<WallTime> {
        self.at[1].or(self.at[0])
    }
}

/// Rows of two instants, who, and what.
struct Tellings<'s> {
    rows: Rows<'s>,
    instants: InstantReader,
}

impl<'s> Tellings<'s> {
    fn new(rows: Rows<'s>) -> Tellings<'s> {
        Tellings { rows, instants: InstantReader::default() }
    }

    fn next(&mut self) -> rusqlite::Result<Option<TruthRow>> {
        let Some(row) = self.rows.next()? else { return Ok(None) };
        let at = [instant_of_cell(row, 0, &mut self.instants)?, instant_of_cell(row, 1, &mut self.instants)?];
        let [who, what] = [row.get_ref(2)?, row.get_ref(3)?].map(|cell| text(cell).into_owned());
        Ok(Some(TruthRow { at, who, what: Some(what).filter(|what| !what.is_empty()) }))
    }
}
