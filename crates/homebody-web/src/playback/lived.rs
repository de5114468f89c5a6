//! What residents did and where they were, of a run whose truth is read while the run is open already, as its log is.

use super::background_read::{BackgroundRead, PartlyRead, ReadProgress, read_in};
use crate::request_error::{RequestError, unprocessable};
use homebody_core::time::{DAY, Interval, RunTime, Span, TimeScale};
use homebody_log::{LifeSpan, LogError, SpanKind, Url};
use std::collections::HashMap;
use std::sync::Arc;

/// Longest activity (our choice): a truth has an activity only once it is over, so rows may still arrive from this far
/// back.
const LATE: Span = DAY.times(31);

/// Spans that are passed on together (our choice).
const MOST_AT_ONCE: usize = 1000;

/// Of a resident: from when until when, and a number of what.
pub(super) type Spans = Vec<(Interval<RunTime>, u32)>;

/// What the truth tells of the whole run, or of as much as has come.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Lives {
    /// By resident; numbers are those of the home's rooms.
    pub rooms: Vec<Spans>,
    /// By resident; numbers are those of `names`.
    pub activities: Vec<Spans>,
    /// What is done, in the order in which it comes.
    pub names: Vec<String>,
}

/// What is known of lives so far.
pub(super) struct Known {
    lives: Arc<Lives>,
    how_far: ReadProgress,
}

impl PartlyRead for Known {
    fn how_far(&self) -> &ReadProgress {
        &self.how_far
    }
}

/// Lives, as far as they have come.
pub(super) struct Lived {
    coming: BackgroundRead<Known>,
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
        let none = || vec![Vec::new(); residents.len()];
        let lives = Arc::new(Lives { rooms: none(), activities: none(), names: Vec::new() });
        let coming = BackgroundRead::new(Known { lives, how_far: ReadProgress::begun(LATE) });
        let lived = Lived { coming: coming.clone() };
        read_in("reads a truth", move || {
            let mut taken = Taken { residents, rooms, names: HashMap::new(), spans: Vec::new() };
            let read = homebody_log::life_spans(&truth, &scale, &mut |span| {
                taken.take(&span);
                if taken.spans.len() >= MOST_AT_ONCE { coming.grow(|known| taken.hand_on(known)) } else { Ok(()) }
            });
            let read = read.and_then(|()| coming.grow(|known| taken.hand_on(known)));
            coming.end(|known| known.how_far.ended = Some(read.map_err(unprocessable)));
        })?;
        Ok(lived)
    }

    /// What has come, to be waited for.
    pub fn coming(&self) -> &BackgroundRead<Known> {
        &self.coming
    }

    /// All of it.
    pub fn whole(&self) -> Result<Arc<Lives>, RequestError> {
        Ok(self.coming.until(RunTime::MAX)?.lives.clone())
    }
}

impl Known {
    /// What has come of lives.
    pub fn lives(&self) -> &Lives {
        &self.lives
    }
}

/// What has been taken from a truth and is not handed on yet.
struct Taken {
    residents: Vec<String>,
    rooms: HashMap<String, u32>,
    names: HashMap<String, u32>,
    /// Of which resident, of what, and the span.
    spans: Vec<(usize, SpanKind, (Interval<RunTime>, u32))>,
}

impl Taken {
    fn take(&mut self, span: &LifeSpan) {
        let Some(resident) = self.residents.iter().position(|name| name == span.resident) else { return };
        let number = match span.kind {
            SpanKind::Room => self.rooms.get(span.name).copied(),
            SpanKind::Activity => match self.names.get(span.name) {
                Some(&number) => Some(number),
                None => {
                    let number = self.names.len() as u32;
                    self.names.insert(span.name.to_owned(), number);
                    Some(number)
                }
            },
        };
        let interval = Interval::new(span.begin, span.end);
        self.spans.extend(number.map(|number| (resident, span.kind, (interval, number))));
    }

    fn hand_on(&mut self, known: &mut Known) -> Result<(), LogError> {
        // Nobody else has it before all has come.
        let lives = Arc::make_mut(&mut known.lives);
        if lives.names.len() < self.names.len() {
            let mut names: Vec<(&String, &u32)> = self.names.iter().collect();
            names.sort_by_key(|(_, number)| **number);
            lives.names = names.into_iter().map(|(name, _)| name.clone()).collect();
        }
        for (resident, kind, span) in self.spans.drain(..) {
            known.how_far.last_us = known.how_far.last_us.max(span.0.end);
            let of = match kind {
                SpanKind::Room => &mut lives.rooms,
                SpanKind::Activity => &mut lives.activities,
            };
            of[resident].push(span);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_done_is_known_once_nothing_more_of_its_time_comes() {
        let lives = Arc::new(Lives { rooms: vec![Vec::new()], activities: vec![Vec::new()], names: Vec::new() });
        let coming = BackgroundRead::new(Known { lives, how_far: ReadProgress::begun(LATE) });
        let lived = Lived { coming: coming.clone() };
        let rooms = HashMap::from([("hall".to_owned(), 7)]);
        let mut taken = Taken { residents: vec!["ann".into()], rooms, names: HashMap::new(), spans: Vec::new() };
        let day = |days: i64| RunTime::START + days * DAY;
        let mut hand_on = |kind, resident, name, begin, end| {
            taken.take(&LifeSpan { kind, resident, name, begin: day(begin), end: day(end) });
            coming.grow(|known| taken.hand_on(known)).unwrap();
        };
        hand_on(SpanKind::Activity, "ann", "sleeping", 0, 1);
        hand_on(SpanKind::Room, "ann", "hall", 1, 2);
        hand_on(SpanKind::Room, "ann", "attic", 2, 3);
        hand_on(SpanKind::Activity, "nobody", "reading", 2, 3);
        assert!(coming.known().read_us().unwrap().unwrap() < day(0));
        hand_on(SpanKind::Activity, "ann", "eating", 3, 40);
        assert_eq!(coming.known().read_us(), Ok(Some(day(9))));
        let days = |begin, end| Interval::new(day(begin), day(end));
        let known = coming.until(day(9)).unwrap().lives().clone();
        assert_eq!(
            (&known.rooms[0][..], &known.activities[0][..]),
            (&[(days(1, 2), 7)][..], &[(days(0, 1), 0), (days(3, 40), 1)][..])
        );
        assert_eq!(known.names, ["sleeping", "eating"]);
        coming.end(|known| known.how_far.ended = Some(Ok(())));
        assert_eq!(*lived.whole().unwrap(), known);
    }
}
