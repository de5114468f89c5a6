//! A log that was walked back, as playback shows it: its rows as they were, and how likely everybody was in each room.

use crate::dates;
use crate::refusal::{Refusal, damaged, failed, shortened, without};
use crate::stored_log::{MOST_ROWS, StoredRows, stranger, told_of};
use crate::wire::{BETWEEN, Chance, OUT, PlaybackView, WalkView};
use homebody_core::problem::Diagnose;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{Interval, RunTime, SECOND, Span};
use homebody_log::files::plain;
use homebody_log::limits::LARGEST_RECORDING_BYTES;
use homebody_query::LogRef;
use homebody_timeline::Episode;
use homebody_tracking::located_folder::{GIVEN, LocatingSummary, REPORT, ROOMS, doubts};
use homebody_tracking::{PlaceChance, PossiblePlace, sensors_of_home};
use std::path::{Path, PathBuf};

/// Stay below which a room is not a destination (our choice).
const LEAST_STAY: Span = SECOND.times(10);

/// An instant, a place, and how likely somebody is there from then on, as [`Chance`] has them.
pub type KnownChance = (RunTime, i32, f32);

/// The folder of a log that was walked back.
pub struct Walked {
    folder: PathBuf,
    given: LogRef,
    reported: LocatingSummary,
}

/// What the report in such a folder says, as far as it can be read.
pub fn reported(folder: &Path) -> LocatingSummary {
    let text = plain::read_text(&folder.join(REPORT), LARGEST_RECORDING_BYTES);
    text.ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
}

/// The log that was given, in such a folder: the one file in there, or what the files come to together.
pub fn given(folder: &Path) -> Result<LogRef, Refusal> {
    let given = folder.join(GIVEN);
    let entries = given.read_dir().into_iter().flatten().flatten();
    // A link may lead to what its author was never to see.
    let plain = entries.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_file()));
    let files: Vec<PathBuf> = plain.map(|entry| entry.path()).collect();
    let found = match &files[..] {
        [one] => one,
        _ => &given,
    };
    LogRef::find(&found.to_string_lossy()).map_err(|error| damaged(without(folder, error.diagnostic())))
}

impl Walked {
    pub fn at(folder: PathBuf) -> Result<Walked, Refusal> {
        Ok(Walked { given: given(&folder)?, reported: reported(&folder), folder })
    }

    /// What it is read from.
    pub fn files(&self) -> impl Iterator<Item = PathBuf> {
        [ROOMS, REPORT].map(|file| self.folder.join(file)).into_iter().chain(self.given.place.files())
    }

    /// The rows of the log as it was given, with the view's sensors, by their names in the home.
    pub fn rows(&self, scenario: &Scenario, view: &mut PlaybackView, beside: &Path) -> Result<StoredRows, Refusal> {
        view.sensors = view.home.sensors.iter().map(|sensor| sensor.name.clone()).collect();
        // Of a way that is too long for a path only the first days are there.
        let mut rows = StoredRows::new(beside, view, &scenario.calendar, view.interval().end).map_err(failed)?;
        let log = rows.read(self.given.place.clone(), &self.given.mapping, MOST_ROWS);
        let log = log.map_err(|error| damaged(without(&self.folder, error.diagnostic())))?;
        let known = sensors_of_home(&log, scenario).into_iter().zip(&log.sensors);
        let strange = |id: &String, view: &mut PlaybackView| stranger(id, &mut view.sensors);
        let number = |(number, id): (Option<usize>, &String)| number.map_or_else(|| strange(id, view), |of| of as u32);
        rows.numbers = known.map(number).collect();
        view.remarks.extend(told_of(&log));
        view.values = log.values;
        view.remarks.extend(self.reported.remarks.iter().map(|remark| shortened(remark)));
        Ok(rows)
    }

    /// How likely everybody was where, by resident of the view, which is told of it.
    pub fn chances(&self, scenario: &Scenario, view: &mut PlaybackView) -> Result<Vec<Vec<KnownChance>>, Refusal> {
        let scale = scenario.calendar.scale(view.length());
        let table = self.folder.join(ROOMS);
        let all = doubts(&table, &self.reported.people, scenario.home.plan(), &scale);
        let all = all.map_err(|error| damaged(without(&self.folder, error.diagnostic())))?;
        // The guest is the last, and told of although nobody ever came.
        let end = view.interval().end;
        let mut chances = vec![Vec::new(); view.residents.len()];
        for PlaceChance { at, who, place, chance } in all.into_iter().filter(|doubt| doubt.at <= end) {
            let place = match place {
                PossiblePlace::Out => OUT,
                PossiblePlace::Between => BETWEEN,
                PossiblePlace::Room(room) => room as i32,
            };
            let of = chances.get_mut(who);
            of.into_iter().for_each(|all: &mut Vec<KnownChance>| all.push((at, place, chance)));
        }
        let places = view.home.rooms.len() + 2;
        let stays = chances.iter().map(|of| stays(of, places, end).iter().map(dates::told).collect()).collect();
        view.walk = Some(WalkView { log: self.reported.log.clone(), stays });
        Ok(chances)
    }
}

/// The most likely places of a person.
fn stays(chances: &[KnownChance], places: usize, end: RunTime) -> Vec<Episode<RunTime, i32>> {
    let mut now = Known::new(places);
    let mut all: Vec<Episode<RunTime, i32>> = Vec::new();
    for (index, &(at, place, chance)) in chances.iter().enumerate() {
        now.set(place, chance);
        // What changes at one instant is one change.
        if chances.get(index + 1).is_some_and(|next| next.0 == at) {
            continue;
        }
        let best = now.best();
        match all.last_mut() {
            Some(last) if last.label == best => last.time.end = end,
            last => {
                last.into_iter().for_each(|last| last.time.end = at);
                all.push(Episode::new(best, Interval::new(at, end)));
            }
        }
    }
    all.retain(|stay| stay.label != BETWEEN && stay.length() >= LEAST_STAY);
    all
}

/// The chances of a span: first those that hold when it begins, then what changes in it.
pub fn chances_of(chances: &[KnownChance], span: Interval<RunTime>) -> Vec<Chance> {
    let first = chances.partition_point(|chance| chance.0 <= span.begin);
    let last = chances.partition_point(|chance| chance.0 < span.end).max(first);
    let most = chances[..first].iter().map(|chance| chance.1).max().unwrap_or(0);
    let mut now = Known::new(usize::try_from(most).unwrap_or(0) + 3);
    chances[..first].iter().for_each(|&(_, place, chance)| now.set(place, chance));
    let known = now.all().filter(|(_, chance)| *chance > 0.0).map(|(place, chance)| (span.begin, place, chance));
    let all = known.chain(chances[first..last].iter().copied());
    all.map(|(at, place, chance)| (at.micros(), place, chance)).collect()
}

/// The chances that hold at an instant.
struct Known(Vec<f32>);

impl Known {
    fn new(places: usize) -> Known {
        Known(vec![0.0; places])
    }

    fn set(&mut self, place: i32, chance: f32) {
        self.0[(place - BETWEEN) as usize] = chance;
    }

    fn all(&self) -> impl Iterator<Item = (i32, f32)> {
        (BETWEEN..).zip(self.0.iter().copied())
    }

    fn best(&self) -> i32 {
        self.all().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(OUT, |(place, _)| place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CHANCES: [KnownChance; 7] = [
        (second(0), 1, 1.0),
        (second(20), 1, 0.5),
        (second(20), 0, 0.5),
        (second(30), 1, 0.1),
        (second(30), 0, 0.9),
        (second(32), OUT, 1.0),
        (second(32), 0, 0.0),
    ];

    const fn second(second: i64) -> RunTime {
        RunTime::START.saturating_add(SECOND.times(second))
    }

    #[test]
    fn a_span_begins_with_what_holds_then() {
        let of = chances_of(&CHANCES, Interval::new(second(25), second(31)));
        let (at, later) = (second(25).micros(), second(30).micros());
        assert_eq!(of, [(at, 0, 0.5), (at, 1, 0.5), (later, 1, 0.1), (later, 0, 0.9)]);
        assert_eq!(chances_of(&CHANCES, Interval::new(second(-5), second(0))), []);
        assert_eq!(chances_of(&[], Interval::new(second(0), second(1))), []);
    }

    #[test]
    fn stays_have_the_likeliest_place_and_last_for_a_while() {
        let end = second(100);
        let all = stays(&CHANCES, 4, end);
        assert_eq!(all.first().map(|stay| stay.label), Some(1));
        assert_eq!(all.last(), Some(&Episode::new(OUT, Interval::new(second(32), end))));
        assert!(all.iter().all(|stay| stay.length() >= LEAST_STAY), "{all:?}");
    }
}
