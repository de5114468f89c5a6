//! What is looked for over a log that somebody names, with the truth beside it where there is one.

use crate::error::Error;
use crate::falls::{LogWithSilhouettes, silhouettes_of};
use crate::find::{
    BY_TRUTH, DayClock, Found, Ground, Listener, Query, Stay, TakeRow, Unfindable, What, at_home, falls_in_rooms, find,
};
use crate::log_with_run::LogWithRun;
use homebody_analysis::alerts::{Rules, USUAL, alerts};
use homebody_analysis::dates::{midnight, on_wall};
use homebody_analysis::falls::rules::FallRules;
use homebody_analysis::measures::Rooms;
use homebody_analysis::signs::{Kind, kinds};
use homebody_core::activity::FALLEN;
use homebody_core::time::{DAY, Micros};
use homebody_log::Activity;
use std::borrow::Cow;

/// The remark on rooms that are guessed, as measures guess them.
const GUESSED: &str = "Rooms are guessed from sensor names; homebody measures --json lists them in guessed_rooms";

/// Looks through a log. Instants are those of the wall, in microseconds since 1970.
///
/// # Errors
///
/// [`Error::Find`] if a name leads nowhere, or if only a truth would tell; [`Error::Log`] if that cannot be read.
pub fn find_in_log(query: &Query, read: &LogWithRun) -> Result<Found, Error> {
    let Some((first, last)) = read.dates() else { return Ok(Found::default()) };
    let (begin, end) = (midnight(first), midnight(last) + DAY);
    let days: Vec<DayClock> = (0..(end - begin) / DAY)
        .map(|day| DayClock { begin: begin + day * DAY, end: begin + (day + 1) * DAY, clock: 0, turn: None })
        .collect();
    let span = read.recorded.as_ref().map_or_else(|| heard(read), |run| (run.start, run.end));
    let rooms = stays(read, |life| &life.rooms, |_| true);
    let told = match query.what {
        What::Room => rooms.clone(),
        What::Doing => stays(read, |life| &life.activities, |_| true),
        What::Fall => falls(read, rooms.as_deref(), ""),
        What::SeenFall => Some(seen_falls(read, rooms.as_deref())?),
        What::Lost => lost(read)?,
        What::Alert => Some(of_alerts(read)?),
        What::On | What::Still => None,
    };
    let home = rooms.map(|stays| at_home(stays.iter().map(|stay| (stay.begin, stay.end))));
    let guessed = (query.what == What::Room && told.is_none() && read.rooms.is_empty())
        .then(|| Rooms::of(&read.log.sensors, &read.rooms));
    let guess = |sensor: usize| Some(guessed.as_ref()?.name_of(sensor)?.to_owned());
    let listener = |(sensor, (name, kind)): (usize, (&String, Kind))| Listener {
        name: name.clone(),
        room: read.rooms.get(name).cloned().or_else(|| guess(sensor)),
        tells_of_nobody: kind == Kind::Other,
    };
    let mut rows = |take: &mut TakeRow| {
        read.log.in_order().into_iter().for_each(|row| take(row.at, row.sensor, row.value));
        Ok(())
    };
    let sensors = read.log.sensors.iter().zip(kinds(&read.log)).enumerate().map(listener).collect();
    let gaps = read.log.gaps.clone();
    let mut ground = Ground { span, days, told, home, sensors, values: &read.log.values, gaps, rows: &mut rows };
    let mut found = find(query, &mut ground)?;
    if guessed.is_some() {
        found.remarks.insert(0, GUESSED.to_owned());
    }
    Ok(found)
}

/// From the first row to the last.
fn heard(read: &LogWithRun) -> (Micros, Micros) {
    let times = || read.log.events.iter().map(|event| event.at);
    (times().min().unwrap_or(0), times().max().unwrap_or(0))
}

/// What the truth tells of residents; `None` without a truth.
fn stays<'a>(
    read: &'a LogWithRun,
    of: impl Fn(&'a homebody_log::Life) -> &'a Vec<Activity>,
    is_asked: impl Fn(&str) -> bool,
) -> Option<Vec<Stay<'a>>> {
    if read.lives.is_empty() {
        return None;
    }
    let mut all = Vec::new();
    for life in &read.lives {
        all.extend(of(life).iter().filter(|stay| is_asked(&stay.name)).map(|stay| Stay {
            begin: stay.begin,
            end: stay.end,
            who: Some(Cow::Borrowed(life.resident.as_str())),
            name: Cow::Borrowed(stay.name.as_str()),
            words: Cow::Borrowed(""),
        }));
    }
    all.sort_by_key(|stay| stay.begin);
    Some(all)
}

/// What the truth tells of falls, by who was in which of the rooms; `None` without a truth.
fn falls<'a>(read: &'a LogWithRun, rooms: Option<&[Stay]>, by: &str) -> Option<Vec<Stay<'a>>> {
    let falls = stays(read, |life| &life.activities, |name| name == FALLEN)?;
    Some(falls_in_rooms(falls, rooms.unwrap_or_default(), by))
}

fn lost(read: &LogWithRun) -> Result<Option<Vec<Stay<'static>>>, Error> {
    let Some(lost) = read.lost()? else { return Ok(None) };
    let stay = |lost: crate::log_with_run::Lost| Stay {
        begin: lost.at,
        end: lost.at,
        who: None,
        words: Cow::Owned(format!("{} said {}, lost: {}", lost.sensor, lost.value, lost.loss)),
        name: Cow::Owned(lost.sensor),
    };
    Ok(Some(lost.into_iter().map(stay).collect()))
}

/// What cameras take for falls by the usual rules, with what the truth tells of falls, if there is one.
fn seen_falls<'a>(read: &'a LogWithRun, rooms: Option<&[Stay]>) -> Result<Vec<Stay<'a>>, Error> {
    let missing = || Error::NoSilhouettes { log: read.name.clone() };
    let path = read.files.first().and_then(|log| silhouettes_of(log)).ok_or_else(missing)?;
    let kept = LogWithSilhouettes::of(&path, read.scenario().ok_or_else(missing)?)?;
    let calendar = &kept.scenario.calendar;
    let zone = calendar.local(0).time_zone().clone();
    let wall = |at| on_wall(calendar.timestamp(at).as_microsecond(), &zone);
    let seen = kept.falls(&FallRules::default(), |_| true)?.falls.into_iter().map(|fall| Stay {
        begin: wall(fall.at),
        end: wall(fall.alarm_at),
        who: None,
        words: Cow::Owned(kept.words(&fall)),
        name: Cow::Owned(fall.rule),
    });
    let mut all: Vec<Stay> = seen.collect();
    all.extend(falls(read, rooms, BY_TRUTH).unwrap_or_default());
    all.sort_by_key(|stay| stay.begin);
    Ok(all)
}

/// Alerts by the usual rules, which are of whole days.
fn of_alerts(read: &LogWithRun) -> Result<Vec<Stay<'static>>, Error> {
    let unread = |why: String| Error::Find(Unfindable::Unread(why));
    let measures = read.measures().map_err(|why| unread(why.to_string()))?;
    let rules = Rules::read(USUAL).map_err(|problems| unread(problems.to_string()))?;
    let stay = |alert: homebody_analysis::alerts::Alert| Stay {
        begin: midnight(alert.date),
        end: midnight(alert.date) + DAY,
        who: None,
        name: Cow::Owned(alert.rule),
        words: Cow::Owned(alert.words),
    };
    Ok(alerts(&measures, &rules).alerts.into_iter().map(stay).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log_with_run::NamedLog;

    #[test]
    fn rooms_that_measures_guess_are_found_and_said_to_be_a_guess() {
        let folder = tempfile::tempdir().unwrap();
        let find = |sensor: &str| {
            let path = folder.path().join("log.csv");
            let rows = format!(
                "time,sensor,value\n2024-02-26 02:00:00,{sensor},ON\n2024-02-26 02:01:00,{sensor},OFF\n\
                 2024-02-26 02:05:00,hall_motion,ON\n2024-02-26 02:06:00,hall_motion,OFF\n"
            );
            std::fs::write(&path, rows).unwrap();
            let read = LogWithRun::of(NamedLog::find(&path.display().to_string()).unwrap(), None).unwrap();
            let query = Query { what: What::Room, name: Some("bathroom".into()), hours: None, least: 0 };
            find_in_log(&query, &read)
        };
        let found = find("bathroom_motion").unwrap();
        assert_eq!((found.hits.len(), found.remarks[0].as_str()), (1, GUESSED), "{:?}", found.hits);
        // The control: no word of a name tells of a bathroom.
        let error = find("m17").unwrap_err().to_string();
        assert!(error.contains("no room is called \"bathroom\""), "{error}");
    }
}
