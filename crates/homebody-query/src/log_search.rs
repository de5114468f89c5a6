//! Searches in a log by its name, with the ground truth in its folder if there is one.

use crate::camera_falls::{RunSilhouettes, silhouettes_of};
use crate::error::QueryError;
use crate::loaded_log::LoadedLog;
use crate::search::{
    BY_TRUTH, KnownStay, Listener, Query, SearchDay, SearchError, SearchGround, SearchResult, SearchSubject,
    TakeSearchRow, at_home, falls_in_rooms, find,
};
use homebody_analysis::episodes::{ChangeEpisode, WatchOptions, watch};
use homebody_analysis::falls::rules::FallRules;
use homebody_analysis::measures::SensorRooms;
use homebody_analysis::signs::{Kind, kinds};
use homebody_core::activity::FALLEN;
use homebody_core::time::{DAY, Interval, RunTime, Span, WallTime};
use homebody_timeline::EpisodeKind;
use std::borrow::Cow;

/// The remark on rooms that are guessed, as measures guess them.
const GUESSED: &str = "Rooms are guessed from sensor names; homebody measures --json lists them in guessed_rooms";

/// Looks through a log.
pub fn find_in_log(query: &Query, read: &LoadedLog) -> Result<SearchResult<WallTime>, QueryError> {
    let Some((first, last)) = read.dates() else { return Ok(SearchResult::default()) };
    let (begin, end) = (WallTime::midnight(first), WallTime::midnight(last) + DAY);
    let day = |day| Interval::starting(begin + day * DAY, DAY);
    let clock = |Interval { begin, end }| SearchDay { begin, end, clock: Span::ZERO, turn: None };
    let days = (0..(end - begin) / DAY).map(|number| clock(day(number))).collect();
    let span = read.recorded.unwrap_or_else(|| heard(read));
    let rooms = stays(read, EpisodeKind::Room, |_| true);
    let told = match query.what {
        SearchSubject::Room => rooms.clone(),
        SearchSubject::Doing => stays(read, EpisodeKind::Activity, |_| true),
        SearchSubject::Fall => falls(read, rooms.as_deref(), ""),
        SearchSubject::SeenFall => Some(seen_falls(read, rooms.as_deref())?),
        SearchSubject::Lost => lost(read)?,
        SearchSubject::Alert => Some(of_episodes(read)?),
        SearchSubject::On | SearchSubject::Still => None,
    };
    let home = rooms.as_deref().map(at_home);
    let guessed = (query.what == SearchSubject::Room && told.is_none() && read.rooms.is_empty())
        .then(|| SensorRooms::from_sensors(&read.log.sensors, &read.rooms));
    let guess = |sensor: usize| Some(guessed.as_ref()?.name_of(sensor)?.to_owned());
    let listener = |(sensor, (name, kind)): (usize, (&String, Kind))| Listener {
        name: name.clone(),
        room: read.rooms.get(name).cloned().or_else(|| guess(sensor)),
        tells_of_nobody: kind == Kind::Other,
    };
    let mut rows = |take: &mut TakeSearchRow<WallTime>| {
        read.log.in_order().into_iter().for_each(|row| take(row.at, row.sensor, row.value));
        Ok(())
    };
    let sensors = read.log.sensors.iter().zip(kinds(&read.log)).enumerate().map(listener).collect();
    let gaps = read.log.gaps.clone();
    let mut ground = SearchGround { span, days, told, home, sensors, values: &read.log.values, gaps, rows: &mut rows };
    let mut found = find(query, &mut ground)?;
    if guessed.is_some() {
        found.remarks.insert(0, GUESSED.to_owned());
    }
    Ok(found)
}

/// From the first row to the last.
fn heard(read: &LoadedLog) -> Interval<WallTime> {
    read.log.events.iter().map(|event| Interval::instant(event.at)).reduce(Interval::hull).unwrap_or_default()
}

/// The intervals of residents in the ground truth; `None` without one.
fn stays(read: &LoadedLog, kind: EpisodeKind, is_asked: impl Fn(&str) -> bool) -> Option<Vec<KnownStay<'_, WallTime>>> {
    if read.timeline.people.is_empty() {
        return None;
    }
    let mut all = Vec::new();
    for person in &read.timeline.people {
        let asked = person.episodes(kind).iter().filter(|stay| is_asked(&stay.label));
        all.extend(asked.map(|stay| KnownStay::with_person(&person.name, &stay.label, stay.time)));
    }
    all.sort_by_key(|stay| stay.time.begin);
    Some(all)
}

/// The falls in the ground truth, with their rooms; `None` without one.
fn falls<'a>(
    read: &'a LoadedLog,
    rooms: Option<&[KnownStay<WallTime>]>,
    by: &str,
) -> Option<Vec<KnownStay<'a, WallTime>>> {
    let falls = stays(read, EpisodeKind::Activity, |name| name == FALLEN)?;
    Some(falls_in_rooms(falls, rooms.unwrap_or_default(), by))
}

fn lost(read: &LoadedLog) -> Result<Option<Vec<KnownStay<'static, WallTime>>>, QueryError> {
    let Some(lost) = read.lost()? else { return Ok(None) };
    let stay = |lost: crate::loaded_log::LostMessage| KnownStay {
        time: Interval::instant(lost.at),
        who: None,
        words: Cow::Owned(format!("{} said {}, lost: {}", lost.sensor, lost.value, lost.loss)),
        name: Cow::Owned(lost.sensor),
    };
    Ok(Some(lost.into_iter().map(stay).collect()))
}

/// The falls that cameras see by the usual rules, with those of the ground truth, if there is one.
fn seen_falls<'a>(
    read: &'a LoadedLog,
    rooms: Option<&[KnownStay<WallTime>]>,
) -> Result<Vec<KnownStay<'a, WallTime>>, QueryError> {
    let missing = || QueryError::NoSilhouettes { log: read.name.clone() };
    let path = read.files.first().and_then(|log| silhouettes_of(log)).ok_or_else(missing)?;
    let kept = RunSilhouettes::open(&path, read.scenario().ok_or_else(missing)?)?;
    let wall = |at: RunTime| WallTime::from(kept.scenario.calendar.local(at).datetime());
    let seen = kept.falls(&FallRules::default(), |_| true)?.falls.into_iter().map(|fall| KnownStay {
        time: Interval::new(fall.at, fall.alarm_at).map(wall),
        who: None,
        words: Cow::Owned(kept.words(&fall)),
        name: Cow::Owned(fall.rule),
    });
    let mut all: Vec<KnownStay<WallTime>> = seen.collect();
    all.extend(falls(read, rooms, BY_TRUTH).unwrap_or_default());
    all.sort_by_key(|stay| stay.time.begin);
    Ok(all)
}

/// Episodes, on the days on which they were found.
fn of_episodes(read: &LoadedLog) -> Result<Vec<KnownStay<'static, WallTime>>, QueryError> {
    let measures = read.measures().map_err(|why| QueryError::Search(SearchError::Unread(why.to_string())))?;
    let stay = |episode: ChangeEpisode| KnownStay {
        time: Interval::starting(WallTime::midnight(episode.found), DAY),
        who: None,
        name: Cow::Borrowed("episode"),
        words: Cow::Owned(episode.words),
    };
    Ok(watch(&measures, WatchOptions::default()).episodes.into_iter().map(stay).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log_ref::LogRef;

    #[test]
    fn finds_guessed_rooms_with_a_remark() {
        let folder = tempfile::tempdir().unwrap();
        let find = |sensor: &str| {
            let path = folder.path().join("log.csv");
            let rows = format!(
                "time,sensor,value\n2024-02-26 02:00:00,{sensor},ON\n2024-02-26 02:01:00,{sensor},OFF\n\
                 2024-02-26 02:05:00,hall_motion,ON\n2024-02-26 02:06:00,hall_motion,OFF\n"
            );
            std::fs::write(&path, rows).unwrap();
            let read = LoadedLog::from_ref(LogRef::find(&path.display().to_string()).unwrap(), None).unwrap();
            let query =
                Query { what: SearchSubject::Room, name: Some("bathroom".into()), hours: None, least: Span::ZERO };
            find_in_log(&query, &read)
        };
        let found = find("bathroom_motion").unwrap();
        assert_eq!((found.hits.len(), found.remarks[0].as_str()), (1, GUESSED), "{:?}", found.hits);
        // The control: no word of a name tells of a bathroom.
        let error = find("m17").unwrap_err().to_string();
        assert!(error.contains("no room is called \"bathroom\""), "{error}");
    }
}
