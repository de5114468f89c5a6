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
use std::collections::BTreeMap;

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
    lives_of(&RecordedTruth::open(truth, &[Truth::Movement, Truth::Room, Truth::Activity])?, clock)
}

/// The same of a truth that is open.
pub(crate) fn lives_of(truth: &RecordedTruth, clock: &RunClock) -> Result<Vec<Life>, LogError> {
    let clock = truth.clock(clock);
    let turns = Turns::new(truth, &clock)?;
    read(truth, &clock, &turns).map_err(|error| truth.error(error))
}

fn read(truth: &RecordedTruth, clock: &RunClock, turns: &Turns) -> rusqlite::Result<Vec<Life>> {
    let mut lives: BTreeMap<String, Life> = BTreeMap::new();
    let mut end = Micros::MIN;
    let sql = "SELECT begin_at, end_at, resident, name FROM activity WHERE name IS NOT NULL ORDER BY rowid";
    for Told { at, who, what } in told(truth, sql)? {
        if let ([Some(begin), Some(until)], Some(name)) = (at, what) {
            let done = &mut lives.entry(who.clone()).or_default().activities;
            let begin = turns.turn(&who, begin, done.last().map_or(Micros::MIN, |last| last.end));
            let until = turns.turn(&who, until, begin);
            end = end.max(until);
            done.push(Activity { name, begin, end: until });
        }
    }
    // Where somebody goes ends where they are; the last room ends with the run, or when no more is known.
    let sql = "SELECT end_at, NULL, NULL, NULL FROM movement ORDER BY rowid DESC LIMIT 1";
    for row in told(truth, sql)? {
        end = row.at[0].map_or(end, |at| clock.instant_from(at, end).max(end));
    }
    let mut open: BTreeMap<String, (Micros, Option<String>)> = BTreeMap::new();
    let mut leave = |who: String, at: Micros, room: Option<String>| {
        if let Some((begin, Some(room))) = open.insert(who.clone(), (at, room))
            && begin < at
        {
            lives.entry(who).or_default().rooms.push(Activity { name: room, begin, end: at });
        }
    };
    let mut come: BTreeMap<String, Micros> = BTreeMap::new();
    for Told { at, who, what } in told(truth, "SELECT at, NULL, resident, room FROM room ORDER BY rowid")? {
        if let Some(at) = at[0] {
            let at = turns.turn(&who, at, come.get(&who).copied().unwrap_or(Micros::MIN));
            come.insert(who.clone(), at);
            leave(who, at, what);
        }
    }
    come.into_keys().for_each(|who| leave(who, end, None));
    Ok(lives.into_iter().map(|(resident, life)| Life { resident, ..life }).collect())
}

/// A row of the truth, its instants in microseconds since 1970.
struct Told {
    at: [Option<Micros>; 2],
    who: String,
    what: Option<String>,
}

/// Rows of two instants, who, and what.
fn told(truth: &RecordedTruth, sql: &str) -> rusqlite::Result<Vec<Told>> {
    let mut statement = truth.connection.prepare(sql)?;
    let mut instants = Instants::default();
    let rows = statement.query_map([], |row| {
        Ok(Told {
            at: [instant(row, 0, &mut instants)?, instant(row, 1, &mut instants)?],
            who: text(row.get_ref(2)?).into_owned(),
            what: Some(text(row.get_ref(3)?).into_owned()).filter(|what| !what.is_empty()),
        })
    })?;
    rows.collect()
}
