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
use std::collections::BTreeMap;

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
        let person = people.entry(name.to_owned()).or_insert_with(|| PersonTimeline::new(name.to_owned()));
        person.episodes_mut(kind).push(episode);
        Ok(())
    })?;
    Ok(Timeline { people: people.into_values().collect() })
}

fn read(truth: &RecordedTruth, scale: &TimeScale, take: &mut TakeEpisode) -> Result<(), LogError> {
    let scale = truth.scale(scale);
    let failed = |error| truth.error(error);
    let prepare = |sql: &str| truth.connection.prepare(sql).map_err(failed);
    let mut activities =
        prepare("SELECT begin_at, end_at, resident, name FROM activity WHERE name IS NOT NULL ORDER BY rowid")?;
    let mut rooms = prepare("SELECT at, NULL, resident, room FROM room ORDER BY rowid")?;
    let mut activities = TruthRows::new(activities.query([]).map_err(failed)?).map_err(failed)?;
    let mut rooms = TruthRows::new(rooms.query([]).map_err(failed)?).map_err(failed)?;
    let mut residents = Residents::new(TruthClock::new(truth, &scale)?, &scale);
    loop {
        let is_activity = match (&activities.ahead, &rooms.ahead) {
            (Some(activity), Some(room)) => activity.over() <= room.over(),
            (activity, _) => activity.is_some(),
        };
        let rows = if is_activity { &mut activities } else { &mut rooms };
        match rows.next().map_err(failed)? {
            Some(row) if is_activity => residents.take_activity(row, take)?,
            Some(row) => residents.take_room(row, take)?,
            None => break,
        }
    }
    // The last room ends with the run, or with the last known activity.
    let mut end = residents.end;
    if truth.has_movements {
        let mut last = prepare("SELECT end_at, NULL, NULL, NULL FROM movement ORDER BY rowid DESC LIMIT 1")?;
        let last = TruthRows::new(last.query([]).map_err(failed)?).map_err(failed)?.ahead;
        end = last.and_then(|told| told.at[0]).map_or(end, |at| scale.run_from_wall_after(at, end).max(end));
    }
    residents.end_all(end, take)
}

/// The residents as the rows so far leave them.
struct Residents {
    turns: TruthClock,
    /// The last instants before the wall is set back: there the truth has an activity in pieces.
    set_backs: Vec<RunTime>,
    now: BTreeMap<String, ResidentNow>,
    end: RunTime,
}

#[derive(Default)]
struct ResidentNow {
    done: Option<RunTime>,
    /// An activity that ends where the wall is set back, and may continue.
    parted: Option<Episode>,
    /// The room, and when the resident entered it.
    room: Option<(RunTime, Option<String>)>,
}

impl Residents {
    fn new(turns: TruthClock, scale: &TimeScale) -> Residents {
        let back = scale.run_changes().filter(|change| change.is_back());
        let set_backs = back.map(|change| change.at - Span::MICROSECOND).collect();
        Residents { turns, set_backs, now: BTreeMap::new(), end: RunTime::MIN }
    }

    fn take_activity(&mut self, row: TruthRow, take: &mut TakeEpisode) -> Result<(), LogError> {
        let TruthRow { at: [Some(begin), Some(until)], who, what: Some(name) } = row else { return Ok(()) };
        let now = self.now.entry(who.clone()).or_default();
        let begin = self.turns.turn(&who, begin, now.done.unwrap_or(RunTime::MIN));
        let until = self.turns.turn(&who, until, begin);
        self.end = self.end.max(until);
        now.done = Some(until);
        let mut whole = Episode::new(name, Interval::new(begin, until));
        match now.parted.take() {
            Some(first) if first.label == whole.label && begin - first.end() <= Span::MICROSECOND => {
                whole.time.begin = first.begin();
            }
            Some(other) => take(&who, EpisodeKind::Activity, other)?,
            None => {}
        }
        if self.set_backs.contains(&until) {
            now.parted = Some(whole);
            return Ok(());
        }
        take(&who, EpisodeKind::Activity, whole)
    }

    fn take_room(&mut self, row: TruthRow, take: &mut TakeEpisode) -> Result<(), LogError> {
        let TruthRow { at: [Some(at), _], who, what } = row else { return Ok(()) };
        let now = self.now.entry(who.clone()).or_default();
        let at = self.turns.turn(&who, at, now.room.as_ref().map_or(RunTime::MIN, |(since, _)| *since));
        leave(&who, now.room.replace((at, what)), at, take)
    }

    fn end_all(mut self, end: RunTime, take: &mut TakeEpisode) -> Result<(), LogError> {
        for (resident, now) in &mut self.now {
            now.parted.take().map_or(Ok(()), |activity| take(resident, EpisodeKind::Activity, activity))?;
        }
        self.now.into_iter().try_for_each(|(resident, now)| leave(&resident, now.room, end, take))
    }
}

fn leave(
    resident: &str,
    room: Option<(RunTime, Option<String>)>,
    at: RunTime,
    take: &mut TakeEpisode,
) -> Result<(), LogError> {
    match room {
        Some((begin, Some(room))) if begin < at => {
            take(resident, EpisodeKind::Room, Episode::new(room, Interval::new(begin, at)))
        }
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
    ahead: Option<TruthRow>,
}

impl<'s> TruthRows<'s> {
    fn new(rows: Rows<'s>) -> rusqlite::Result<TruthRows<'s>> {
        let mut rows = TruthRows { rows, instants: InstantReader::default(), ahead: None };
        rows.next()?;
        Ok(rows)
    }

    fn next(&mut self) -> rusqlite::Result<Option<TruthRow>> {
        let read = match self.rows.next()? {
            Some(row) => {
                let at = [instant_of_cell(row, 0, &mut self.instants)?, instant_of_cell(row, 1, &mut self.instants)?];
                let [who, what] = [row.get_ref(2)?, row.get_ref(3)?].map(|cell| text(cell).into_owned());
                Some(TruthRow { at, who, what: Some(what).filter(|what| !what.is_empty()) })
            }
            None => None,
        };
        Ok(std::mem::replace(&mut self.ahead, read))
    }
}
