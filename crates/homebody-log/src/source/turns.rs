//! The hour that a clock on the wall tells twice as it is set back: which of the two an instant of the truth is in.
//!
//! An activity, a change of room or a sighting begins when the resident moves. So of the two instants that one time may mean, we
//! take the one at which the resident moved. The times of movements themselves are known because movements follow each other
//! without gaps.
//!
//! Left out: a resident who keeps still through the whole of both hours gives no sign of the second. Then the first is taken. What
//! goes on for days gives none either.

use super::database::instant;
use super::instant::Instants;
use super::movements::first_row;
use super::recorded_truth::RecordedTruth;
use super::run_clock::RunClock;
use crate::error::LogError;
use homebody_core::time::{DAY, Micros, SECOND};
use std::collections::BTreeMap;
use std::ops::Range;

/// Time before an hour that the clock repeats after which movements are read (our choice).
const BEFORE: Micros = 3600 * SECOND;

/// Time after such an hour beyond which movements are not read (our choice).
const LONGEST: Micros = DAY;

/// Reads the instants of a truth.
pub(super) struct Turns {
    clock: RunClock,
    /// By resident, in their order: those in the hours that are told twice.
    moved: BTreeMap<String, Vec<Moved>>,
}

struct Moved {
    begin: Micros,
    end: Micros,
    how: Sign,
}

/// How likely it is that something began at an instant, by what the body did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Sign {
    None,
    InPlace,
    Stride,
    /// Something else began in this very microsecond.
    Change,
}

impl Turns {
    pub fn new(truth: &RecordedTruth, clock: &RunClock) -> Result<Turns, LogError> {
        let mut turns = Turns { clock: clock.clone(), moved: BTreeMap::new() };
        let hours = clock.told_twice();
        for hour in hours.into_iter().filter(|_| truth.has_movements) {
            let first = clock.told(hour.start) - BEFORE;
            let last = clock.told(hour.end) + BEFORE;
            turns.learn(truth, first..last).map_err(|error| truth.error(error))?;
        }
        Ok(turns)
    }

    /// Reads the movements of a span, whose ends are as the truth tells them.
    fn learn(&mut self, truth: &RecordedTruth, span: Range<Micros>) -> rusqlite::Result<()> {
        let mut instants = Instants::default();
        // In a truth of years nearly all rows are of other days.
        let row = first_row(&truth.connection, &mut instants, |end| end < span.start)?;
        let sql = "SELECT begin_at, end_at, resident, kind FROM movement WHERE rowid >= ? ORDER BY rowid";
        let mut statement = truth.connection.prepare_cached(sql)?;
        let mut rows = statement.query([row])?;
        while let Some(row) = rows.next()? {
            let (Some(begin), Some(end)) = (instant(row, 0, &mut instants)?, instant(row, 1, &mut instants)?) else {
                continue;
            };
            if end > span.end + LONGEST {
                break;
            }
            if end <= span.start || begin >= span.end {
                continue;
            }
            let moved = self.moved.entry(row.get(2)?).or_default();
            let begin = self.clock.instant_from(begin, moved.last().map_or(Micros::MIN, |last| last.end));
            let how = match row.get_ref(3)?.as_str() {
                Ok("stride") => Sign::Stride,
                Ok("in_place" | "stir") => Sign::InPlace,
                _ => Sign::None,
            };
            moved.push(Moved { begin, end: self.clock.instant_from(end, begin), how });
        }
        Ok(())
    }

    /// The run's instant at which something of a resident began or ended that is told as `at`, no earlier than `first`.
    pub fn turn(&self, resident: &str, at: Micros, first: Micros) -> Micros {
        let sign = |instant: &Micros| (self.sign(resident, *instant), instant.abs_diff(first));
        let known = self.clock.all(at).filter(|instant| *instant >= first);
        let best = known.max_by(|one, other| {
            let ((one, near), (other, far)) = (sign(one), sign(other));
            one.cmp(&other).then(far.cmp(&near))
        });
        best.unwrap_or_else(|| self.clock.instant(at, first))
    }

    /// The run's instant at which a resident was noticed that is told as `at`; `last` is that of what was noticed before.
    pub fn sight(&self, resident: Option<&str>, at: Micros, last: Micros) -> Micros {
        let moved = |instant: &Micros| resident.is_some_and(|who| self.sign(who, *instant) > Sign::None);
        let mut signs = self.clock.all(at).filter(moved);
        match (signs.next(), signs.next()) {
            (Some(only), None) => only,
            _ => self.clock.instant(at, last),
        }
    }

    fn sign(&self, resident: &str, at: Micros) -> Sign {
        let Some(moved) = self.moved.get(resident) else { return Sign::None };
        let next = moved.partition_point(|moved| moved.end < at);
        let around = moved[next..].iter().take_while(|moved| moved.begin <= at);
        let sign = |moved: &Moved| if [moved.begin, moved.end].contains(&at) { Sign::Change } else { moved.how };
        around.map(sign).max().unwrap_or(Sign::None)
    }
}
