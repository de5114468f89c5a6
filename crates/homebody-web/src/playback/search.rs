//! Searches over a whole stored run.

use super::{OpenRun, Playback, RequestError};
use crate::dates::NumberedEpisode;
use crate::messages::PageMessage;
use crate::request_error::{not_found, unprocessable};
use crate::wire::{DateView, Find, FoundView, HitView, PlaybackView};
use homebody_analysis::episodes::ChangeEpisode;
use homebody_core::activity::FALLEN;
use homebody_core::time::{Interval, RunTime, SECOND};
use homebody_log::source::TruthValue;
use homebody_log::table::truth::Truth;
use homebody_log::truth::truth_rows;
use homebody_query::search::{
    BY_TRUTH, DayHours, Hit, KnownStay, Listener, Query, SearchError, SearchGround, SearchSubject, TakeSearchRow,
    at_home, falls_in_rooms, find,
};
use homebody_simulation::Cancel;
use homebody_timeline::Episode;
use std::borrow::Cow;
use std::collections::HashMap;

/// Largest number of matches in a list (our choice). The total is given as well.
const MOST_HITS: usize = 5000;

impl Playback {
    /// Searches a run until it is cancelled. `episodes` computes its episodes, which takes longer, and only if the search is for them.
    pub fn find(
        &self,
        name: &str,
        asked: &Find,
        cancel: &Cancel,
        episodes: impl FnOnce() -> Result<Vec<ChangeEpisode>, RequestError>,
    ) -> Result<FoundView, RequestError> {
        let run = self.open(name)?;
        let query = query(asked)?;
        let episodes = if query.what == SearchSubject::Alert { episodes()? } else { Vec::new() };
        let known = match query.what {
            SearchSubject::Room => run.stays()?,
            SearchSubject::Doing => run.activities(|_| true)?,
            SearchSubject::Fall => run.falls("")?,
            SearchSubject::SeenFall => Some(run.all_falls(cancel)?),
            SearchSubject::Lost => run.lost()?,
            SearchSubject::Alert => Some(run.episodes(&episodes)),
            SearchSubject::On | SearchSubject::Still => None,
        };
        let home = match query.what {
            SearchSubject::Still => run.stays()?.as_deref().map(at_home),
            _ => None,
        };
        let days = run.view.days.len();
        let view = run.complete_view()?;
        let mut rows = |take: &mut TakeSearchRow<RunTime>| match &run.reading {
            Some(reading) => {
                let mut known = reading.known();
                (0..days).try_for_each(|day| {
                    let of = known.rows.day(day).map_err(|error| error.to_string())?;
                    of.iter().for_each(|row| take(row.at, row.sensor, row.value));
                    Ok(())
                })
            }
            None => Ok(()),
        };
        let mut ground = SearchGround {
            span: run.view.interval(),
            days: run.view.days.iter().map(DateView::clock).collect(),
            told: known,
            home,
            sensors: listeners(&view),
            values: &view.values,
            gaps: Vec::new(),
            rows: &mut rows,
        };
        let found = find(&query, &mut ground).map_err(|why| match why {
            SearchError::Unread(_) => unprocessable(why),
            why => not_found(why),
        })?;
        let all = found.hits.len() as u64;
        let hits = found.hits.into_iter().take(MOST_HITS);
        let view = |hit: Hit<RunTime>| HitView {
            begin_us: hit.time.begin.micros(),
            end_us: hit.time.end.micros(),
            is_fall: hit.name == FALLEN,
            words: hit.words,
        };
        let hits = hits.map(view).collect();
        Ok(FoundView { hits, all, remarks: found.remarks })
    }
}

fn query(asked: &Find) -> Result<Query, RequestError> {
    let hours = |(from, to): (u32, u32)| DayHours::new(from, to).ok_or_else(|| unprocessable(PageMessage::SameHours));
    let hours = asked.between_min.map(hours).transpose()?;
    if !(0.0..=1e9).contains(&asked.least_s) {
        return Err(unprocessable(PageMessage::Duration));
    }
    let name = asked.name.clone().filter(|name| !name.is_empty());
    Ok(Query { what: asked.what, name, hours, least: SECOND.share(asked.least_s) })
}

fn listeners(view: &PlaybackView) -> Vec<Listener> {
    let listener = |(index, id): (usize, &String)| {
        let known = view.home.sensors.get(index);
        let name = known.map_or(id, |sensor| &sensor.name).clone();
        Listener { name, room: known.and_then(|sensor| sensor.room.clone()), tells_of_nobody: false }
    };
    view.sensors.iter().enumerate().map(listener).collect()
}

impl OpenRun {
    /// The residents in rooms, by the ground truth or the estimates for a located log. Between rooms the name is empty.
    fn stays(&self) -> Result<Option<Vec<KnownStay<'_, RunTime>>>, RequestError> {
        let room = |number: usize| self.view.home.rooms.get(number).map_or("", |room| room.name.as_str());
        let mut all = Vec::new();
        if let Some(walk) = &self.view.walk {
            for (stays, who) in walk.stays.iter().zip(&self.view.residents) {
                let stay = |&(begin, end, place): &(i64, i64, i32)| {
                    let span = Interval::new(RunTime::from_micros(begin), RunTime::from_micros(end));
                    Some(self.stay(span, &who.name, room(place.try_into().ok()?)))
                };
                all.extend(stays.iter().filter_map(stay));
            }
        } else if let Some(lives) = self.lives()? {
            for (person, who) in lives.people.iter().zip(&self.view.residents) {
                let stay = |stay: &NumberedEpisode| self.stay(stay.time, &who.name, room(stay.label as usize));
                all.extend(person.rooms.iter().map(stay));
            }
        } else {
            return Ok(None);
        }
        Ok(Some(sorted(all)))
    }

    fn activities(&self, is_asked: impl Fn(&str) -> bool) -> Result<Option<Vec<KnownStay<'_, RunTime>>>, RequestError> {
        let Some(lives) = self.lives()?.filter(|_| self.view.walk.is_none()) else { return Ok(None) };
        let mut all = Vec::new();
        for (person, who) in lives.people.iter().zip(&self.view.residents) {
            for &Episode { label, time } in &person.activities {
                let name = lives.activities.get(label as usize).map_or("", String::as_str);
                if is_asked(name) {
                    all.push(self.stay(time, &who.name, name));
                }
            }
        }
        Ok(Some(sorted(all)))
    }

    /// `by` are the first words about a fall.
    fn falls(&self, by: &str) -> Result<Option<Vec<KnownStay<'_, RunTime>>>, RequestError> {
        let Some(falls) = self.activities(|activity| activity == FALLEN)? else { return Ok(None) };
        Ok(Some(falls_in_rooms(falls, &self.stays()?.unwrap_or_default(), by)))
    }

    fn all_falls(&self, cancel: &Cancel) -> Result<Vec<KnownStay<'_, RunTime>>, RequestError> {
        let known = self.falls(BY_TRUTH)?.unwrap_or_default();
        Ok(sorted(self.seen_falls(cancel)?.into_iter().chain(known).collect()))
    }

    fn stay<'a>(&self, span: Interval<RunTime>, who: &'a str, name: &'a str) -> KnownStay<'a, RunTime> {
        let run = self.view.interval();
        KnownStay::with_person(who, name, span.map(|at| at.clamp(run.begin, run.end)))
    }

    fn lost(&self) -> Result<Option<Vec<KnownStay<'_, RunTime>>>, RequestError> {
        let Some(truth) = &self.truth else { return Ok(None) };
        if let Some(known) = self.lost.get() {
            return Ok(Some(known.clone()));
        }
        let view = self.complete_view()?;
        let sensors = listeners(&view);
        let known = view.sensors.iter().map(String::as_str).zip(&sensors).collect::<HashMap<_, _>>();
        let mut all = Vec::new();
        truth_rows(truth, Truth::Lost, &self.scale, &mut |cells| {
            let text = |index: usize| match cells.get(index) {
                Some(TruthValue::Text(text)) => *text,
                _ => "",
            };
            let Some(&TruthValue::Integer(at)) = cells.get(2) else { return Ok(()) };
            let at = RunTime::from_micros(at);
            let name = known.get(text(0)).map_or(text(0), |sensor| &sensor.name).to_owned();
            let words = format!("{name}: {}, lost: {}", text(1), text(4));
            let (name, words) = (Cow::Owned(name), Cow::Owned(words));
            all.push(KnownStay { time: Interval::instant(at), who: None, name, words });
            Ok(())
        })
        .map_err(unprocessable)?;
        Ok(Some(self.lost.get_or_init(|| sorted(all)).clone()))
    }

    fn episodes<'a>(&self, episodes: &'a [ChangeEpisode]) -> Vec<KnownStay<'a, RunTime>> {
        let stay = |episode: &'a ChangeEpisode| {
            let found = episode.found.to_string();
            let day = self.view.days.iter().find(|day| day.date == found)?;
            let words = Cow::Borrowed(episode.words.as_str());
            Some(KnownStay { time: day.interval(), who: None, name: Cow::Borrowed("episode"), words })
        };
        sorted(episodes.iter().filter_map(stay).collect())
    }
}

fn sorted(mut stays: Vec<KnownStay<RunTime>>) -> Vec<KnownStay<RunTime>> {
    stays.sort_by_key(|stay| stay.time.begin);
    stays
}
