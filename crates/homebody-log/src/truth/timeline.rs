//! Builds the timelines of people from the truth of a run, wherever it is stored.

use super::RecordedTruth;
use super::turns::TruthClock;
use crate::error::LogError;
use crate::files::database::text;
use crate::source::{InstantReader, instant_of_cell};
use crate::table::truth::Truth;
use crate::url::Url;
use homebody_core::time::{Interval, RunTime, Span, TimeScale, WallTime};
use homebody_timeline::{Episode, EpisodeKind, PersonTimeline, Timeline};
use rusqlite::Rows;
use std::collections::{BTreeMap, HashMap};

/// Takes an episode of the person with a name.
pub type TakeEpisode<'a> = dyn FnMut(&str, EpisodeKind, Episode) -> Result<(), LogError> + 'a;

/// Reads the timeline of a run from its truth; its people are in the order of their names. The wall of the scale is the one by which the
/// files of the run tell instants.
///
/// # Errors
///
/// [`LogError::NoTruth`] if there is no truth in this place.
pub fn read_timeline(truth: &Url, scale: &TimeScale) -> Result<Timeline, LogError> {
    timeline_of(&open(truth)?, scale)
}

/// Hands over the episodes of [`read_timeline`] one by one, in the order in which they end, and keeps none of them.
///
/// # Errors
///
/// [`LogError::NoTruth`] if there is no truth in this place; those of `take`.
pub fn each_episode(truth: &Url, scale: &TimeScale, take: &mut TakeEpisode) -> Result<(), LogError> {
    read(&open(truth)?, scale, take)
}

fn open(truth: &Url) -> Result<RecordedTruth, LogError> {
    RecordedTruth::open(truth, &[Truth::Room, Truth::Activity])
}

pub(crate) fn timeline_of(truth: &RecordedTruth, scale: &TimeScale) -> Result<Timeline, LogError> {
    let mut people: BTreeMap<String, PersonTimeline> = BTreeMap::new();
    read(truth, scale, &mut |name, kind, episode| {
        if !people.contains_key(name) {
            people.insert(name.to_owned(), PersonTimeline::new(name.to_owned()));
        }
        people.get_mut(name).expect("just put there").episodes_mut(kind).push(episode);
        Ok(())
    })?;
    Ok(Timeline { people: people.into_values().collect() })
}

fn read(truth: &RecordedTruth, scale: &TimeScale, take: &mut TakeEpisode) -> Result<(), LogError> {
    let scale = truth.scale(scale);
    let turns = TruthClock::new(truth, &scale)?;
    let failed = |error| truth.error(error);
    let prepare = |sql: &str| truth.connection.prepare(sql).map_err(failed);
    let mut activities =
        prepare("SELECT begin_at, end_at, resident, name FROM activity WHERE name IS NOT NULL ORDER BY rowid")?;
    let mut rooms = prepare("SELECT at, NULL, resident, room FROM room ORDER BY rowid")?;
    let mut activities = TruthRows::new(activities.query([]).map_err(failed)?);
    let mut rooms = TruthRows::new(rooms.query([]).map_err(failed)?);
    let (mut activity, mut room) = (activities.next().map_err(failed)?, rooms.next().map_err(failed)?);
    let mut done: HashMap<String, RunTime> = HashMap::new();
    // On a wall that is set back, the truth has an activity in pieces: by resident, the first of them.
    let set_backs: Vec<RunTime> =
        scale.run_changes().filter(|change| change.is_back()).map(|change| change.at - Span::MICROSECOND).collect();
    let mut parted: BTreeMap<String, Episode> = BTreeMap::new();
    // The room of each resident, and when they entered it.
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
            let mut whole = Episode::new(name, Interval::new(begin, until));
            match parted.remove(&resident) {
                Some(first) if first.label == whole.label && begin - first.end() <= Span::MICROSECOND => {
                    whole.time.begin = first.begin();
                }
                Some(other) => take(&resident, EpisodeKind::Activity, other)?,
                None => {}
            }
            if set_backs.contains(&until) {
                parted.insert(resident, whole);
            } else {
                take(&resident, EpisodeKind::Activity, whole)?;
            }
            continue;
        }
        let next = rooms.next().map_err(failed)?;
        let Some(TruthRow { at, who: resident, what }) = std::mem::replace(&mut room, next) else { break };
        let Some(at) = at[0] else { continue };
        let at = turns.turn(&resident, at, now.get(&resident).map_or(RunTime::MIN, |(since, _)| *since));
        match now.get_mut(&resident) {
            Some(room) => leave(&resident, std::mem::replace(room, (at, what)), at, take)?,
            None => _ = now.insert(resident, (at, what)),
        }
    }
    parted.into_iter().try_for_each(|(resident, activity)| take(&resident, EpisodeKind::Activity, activity))?;
    // The last room ends with the run, or with the last known activity.
    if truth.has_movements {
        let mut last = prepare("SELECT end_at, NULL, NULL, NULL FROM movement ORDER BY rowid DESC LIMIT 1")?;
        let last = TruthRows::new(last.query([]).map_err(failed)?).next().map_err(failed)?;
        end = last.and_then(|told| told.at[0]).map_or(end, |at| scale.run_from_wall_after(at, end).max(end));
    }
    now.into_iter().try_for_each(|(resident, room)| leave(&resident, room, end, take))
}

fn leave(
    resident: &str,
    (begin, room): (RunTime, Option<String>),
    at: RunTime,
    take: &mut TakeEpisode,
) -> Result<(), LogError> {
    match room {
        Some(room) if begin < at => take(resident, EpisodeKind::Room, Episode::new(room, Interval::new(begin, at))),
        _ => Ok(()),
    }
}

struct TruthRow {
    at: [Option<WallTime>; 2],
    who: String,
    what: Option<String>,
}

impl TruthRow {
    fn over(&self) -> Option<WallTime> {
        self.at[1].or(self.at[0])
    }
}

/// Rows of two instants, who, and what.
struct TruthRows<'s> {
    rows: Rows<'s>,
    instants: InstantReader,
}

impl<'s> TruthRows<'s> {
    fn new(rows: Rows<'s>) -> TruthRows<'s> {
        TruthRows { rows, instants: InstantReader::default() }
    }

    fn next(&mut self) -> rusqlite::Result<Option<TruthRow>> {
        let Some(row) = self.rows.next()? else { return Ok(None) };
        let at = [instant_of_cell(row, 0, &mut self.instants)?, instant_of_cell(row, 1, &mut self.instants)?];
        let [who, what] = [row.get_ref(2)?, row.get_ref(3)?].map(|cell| text(cell).into_owned());
        Ok(Some(TruthRow { at, who, what: Some(what).filter(|what| !what.is_empty()) }))
    }
}
