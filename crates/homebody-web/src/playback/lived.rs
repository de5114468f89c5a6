//! The timelines of residents, of a run whose truth is read while the run is already open, as its log is.

use super::background_read::{BackgroundRead, PartlyRead, ReadProgress, read_in};
use crate::dates::NumberedEpisode;
use crate::request_error::{RequestError, unprocessable};
use homebody_core::time::{DAY, RunTime, Span, TimeScale};
use homebody_log::{LogError, Url, each_episode};
use homebody_timeline::{Episode, EpisodeKind, PersonTimeline};
use std::collections::HashMap;
use std::sync::Arc;

/// Longest activity (our choice): a truth has an activity only once it is over, so rows may still arrive from this far
/// back.
const LATE: Span = DAY.times(31);

/// Episodes that are passed on together (our choice).
const MOST_AT_ONCE: usize = 1000;

/// The truth of the whole run, or of as much as has come.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Lives {
    /// The residents. The numbers of rooms are those of the home, and those of activities are of `activities`.
    pub people: Vec<PersonTimeline<RunTime, u32>>,
    /// The activities, in the order in which they come.
    pub activities: Vec<String>,
}

impl Lives {
    fn new(residents: &[String]) -> Lives {
        Lives { people: residents.iter().cloned().map(PersonTimeline::new).collect(), activities: Vec::new() }
    }
}

pub(super) struct KnownLives {
    lives: Arc<Lives>,
    how_far: ReadProgress,
}

impl PartlyRead for KnownLives {
    fn how_far(&self) -> &ReadProgress {
        &self.how_far
    }
}

pub(super) struct Lived {
    coming: BackgroundRead<KnownLives>,
}

impl Lived {
    /// Begins to read the truth of a run with these residents and rooms in another thread.
    pub fn begin(
        truth: Url,
        scale: TimeScale,
        residents: Vec<String>,
        rooms: &[String],
    ) -> Result<Lived, RequestError> {
        let rooms: HashMap<String, u32> = rooms.iter().cloned().zip(0..).collect();
        let lives = Arc::new(Lives::new(&residents));
        let coming = BackgroundRead::new(KnownLives { lives, how_far: ReadProgress::begun(LATE) });
        let lived = Lived { coming: coming.clone() };
        read_in("reads a truth", move || {
            let mut taken = Taken { residents, rooms, activities: HashMap::new(), episodes: Vec::new() };
            let read = each_episode(&truth, &scale, &mut |resident, kind, episode| {
                taken.take(resident, kind, &episode);
                if taken.episodes.len() >= MOST_AT_ONCE { coming.grow(|known| taken.hand_on(known)) } else { Ok(()) }
            });
            let read = read.and_then(|()| coming.grow(|known| taken.hand_on(known)));
            coming.end(|known| known.how_far.ended = Some(read.map_err(unprocessable)));
        })?;
        Ok(lived)
    }

    pub fn coming(&self) -> &BackgroundRead<KnownLives> {
        &self.coming
    }

    pub fn whole(&self) -> Result<Arc<Lives>, RequestError> {
        Ok(self.coming.until(RunTime::MAX)?.lives.clone())
    }
}

impl KnownLives {
    pub fn lives(&self) -> &Lives {
        &self.lives
    }
}

struct Taken {
    residents: Vec<String>,
    rooms: HashMap<String, u32>,
    activities: HashMap<String, u32>,
    /// By the number of the resident.
    episodes: Vec<(usize, EpisodeKind, NumberedEpisode)>,
}

impl Taken {
    fn take(&mut self, resident: &str, kind: EpisodeKind, Episode { label, time }: &Episode) {
        let Some(resident) = self.residents.iter().position(|name| name == resident) else { return };
        let number = match kind {
            EpisodeKind::Room => self.rooms.get(label).copied(),
            EpisodeKind::Activity => match self.activities.get(label) {
                Some(&number) => Some(number),
                None => {
                    let number = self.activities.len() as u32;
                    self.activities.insert(label.clone(), number);
                    Some(number)
                }
            },
        };
        self.episodes.extend(number.map(|number| (resident, kind, Episode::new(number, *time))));
    }

    fn hand_on(&mut self, known: &mut KnownLives) -> Result<(), LogError> {
        // Nobody else has it before all has come.
        let lives = Arc::make_mut(&mut known.lives);
        if lives.activities.len() < self.activities.len() {
            let mut names: Vec<(&String, &u32)> = self.activities.iter().collect();
            names.sort_by_key(|(_, number)| **number);
            lives.activities = names.into_iter().map(|(name, _)| name.clone()).collect();
        }
        for (resident, kind, episode) in self.episodes.drain(..) {
            known.how_far.last_us = known.how_far.last_us.max(episode.end());
            lives.people[resident].episodes_mut(kind).push(episode);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::Interval;

    #[test]
    fn activities_are_known_once_no_earlier_ones_can_come() {
        let residents = vec!["ann".to_owned()];
        let lives = Arc::new(Lives::new(&residents));
        let coming = BackgroundRead::new(KnownLives { lives, how_far: ReadProgress::begun(LATE) });
        let lived = Lived { coming: coming.clone() };
        let rooms = HashMap::from([("hall".to_owned(), 7)]);
        let mut taken = Taken { residents, rooms, activities: HashMap::new(), episodes: Vec::new() };
        let day = |days: i64| RunTime::START + days * DAY;
        let days = |begin, end| Interval::new(day(begin), day(end));
        let mut hand_on = |kind, resident, label: &str, begin, end| {
            taken.take(resident, kind, &Episode::new(label.to_owned(), days(begin, end)));
            coming.grow(|known| taken.hand_on(known)).unwrap();
        };
        hand_on(EpisodeKind::Activity, "ann", "sleeping", 0, 1);
        hand_on(EpisodeKind::Room, "ann", "hall", 1, 2);
        hand_on(EpisodeKind::Room, "ann", "attic", 2, 3);
        hand_on(EpisodeKind::Activity, "bob", "reading", 2, 3);
        assert!(coming.known().read_us().unwrap().unwrap() < day(0));
        hand_on(EpisodeKind::Activity, "ann", "eating", 3, 40);
        assert_eq!(coming.known().read_us(), Ok(Some(day(9))));
        let known = coming.until(day(9)).unwrap().lives().clone();
        let [ann] = &known.people[..] else { panic!("{known:?}") };
        assert_eq!(ann.rooms, [Episode::new(7, days(1, 2))]);
        assert_eq!(ann.activities, [Episode::new(0, days(0, 1)), Episode::new(1, days(3, 40))]);
        assert_eq!(known.activities, ["sleeping", "eating"]);
        coming.end(|known| known.how_far.ended = Some(Ok(())));
        assert_eq!(*lived.whole().unwrap(), known);
    }
}
