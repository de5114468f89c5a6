//! The hour that a clock on the wall shows twice as it is set back: the choice between the two instants of a time in the truth.
//!
//! An activity, a change of room or a sighting begins when the resident moves. So of the two instants of a time, we take the one at which
//! the resident moved. The times of movements themselves are known because movements follow each other without gaps.
//!
//! Left out: a resident who keeps still through the whole of both hours gives no sign of the second. Then the first is taken. Activities of
//! several days give no sign either.

use super::RecordedTruth;
use super::movements::first_row;
use crate::error::LogError;
use crate::source::{InstantReader, instant_of_cell};
use homebody_core::time::{DAY, HOUR, Interval, RunTime, Span, TimeScale, WallTime};
use homebody_timeline::Episode;
use std::collections::BTreeMap;

/// Time before an hour that the clock repeats after which movements are read (our choice).
const BEFORE: Span = HOUR;

/// Time after such an hour beyond which movements are not read (our choice).
const LONGEST: Span = DAY;

/// Reads the instants of a truth.
pub(crate) struct TruthClock {
    scale: TimeScale,
    /// By resident, in their order: the movements in the hours that the clock shows twice.
    moved: BTreeMap<String, Vec<Episode<RunTime, ChangeSign>>>,
}

/// Evidence that something began at an instant, by the movement of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum ChangeSign {
    None,
    InPlace,
    Stride,
    /// Something else began in this very microsecond.
    Change,
}

impl TruthClock {
    pub fn new(truth: &RecordedTruth, scale: &TimeScale) -> Result<TruthClock, LogError> {
        let mut turns = TruthClock { scale: scale.clone(), moved: BTreeMap::new() };
        for hour in scale.shown_twice().filter(|_| truth.has_movements) {
            let hour = hour.map(|at| scale.run_to_wall(at));
            let span = Interval::new(hour.begin - BEFORE, hour.end + BEFORE);
            turns.learn(truth, span).map_err(|error| truth.error(error))?;
        }
        Ok(turns)
    }

    /// Reads the movements of a span on the wall.
    fn learn(&mut self, truth: &RecordedTruth, span: Interval<WallTime>) -> rusqlite::Result<()> {
        let mut instants = InstantReader::default();
        // In a truth of years nearly all rows are of other days.
        let row = first_row(&truth.connection, &mut instants, |end| end < span.begin)?;
        let sql = "SELECT begin_at, end_at, resident, kind FROM movement WHERE rowid >= ? ORDER BY rowid";
        let mut statement = truth.connection.prepare_cached(sql)?;
        let mut rows = statement.query([row])?;
        while let Some(row) = rows.next()? {
            let (Some(begin), Some(end)) =
                (instant_of_cell(row, 0, &mut instants)?, instant_of_cell(row, 1, &mut instants)?)
            else {
                continue;
            };
            if end > span.end + LONGEST {
                break;
            }
            if end <= span.begin || begin >= span.end {
                continue;
            }
            let moved = self.moved.entry(row.get(2)?).or_default();
            let begin = self.scale.run_from_wall_after(begin, moved.last().map_or(RunTime::MIN, Episode::end));
            let how = match row.get_ref(3)?.as_str() {
                Ok("stride") => ChangeSign::Stride,
                Ok("in_place" | "stir") => ChangeSign::InPlace,
                _ => ChangeSign::None,
            };
            moved.push(Episode::new(how, Interval::new(begin, self.scale.run_from_wall_after(end, begin))));
        }
        Ok(())
    }

    /// The instants at which the wall shows a time.
    fn all(&self, at: WallTime) -> impl Iterator<Item = RunTime> {
        self.scale.all_utc(at).map(|at| self.scale.from_utc(at))
    }

    /// The run's instant, no earlier than `first`, at which an activity or a stay of a resident began or ended, for its time in the truth.
    pub fn turn(&self, resident: &str, at: WallTime, first: RunTime) -> RunTime {
        let sign = |instant: &RunTime| (self.sign(resident, *instant), instant.abs_diff(first));
        let known = self.all(at).filter(|instant| *instant >= first);
        let best = known.max_by(|one, other| {
            let ((one, near), (other, far)) = (sign(one), sign(other));
            one.cmp(&other).then(far.cmp(&near))
        });
        best.unwrap_or_else(|| self.scale.run_from_wall(at, first))
    }

    /// The run's instant at which a sensor noticed a resident, for its time in the truth; `last` is that of the row before.
    pub fn sight(&self, resident: Option<&str>, at: WallTime, last: RunTime) -> RunTime {
        let moved = |instant: &RunTime| resident.is_some_and(|who| self.sign(who, *instant) > ChangeSign::None);
        let mut signs = self.all(at).filter(moved);
        match (signs.next(), signs.next()) {
            (Some(only), None) => only,
            _ => self.scale.run_from_wall(at, last),
        }
    }

    fn sign(&self, resident: &str, at: RunTime) -> ChangeSign {
        let Some(moved) = self.moved.get(resident) else { return ChangeSign::None };
        let next = moved.partition_point(|moved| moved.end() < at);
        let around = moved[next..].iter().take_while(|moved| moved.begin() <= at);
        let is_end = |moved: &Episode<RunTime, ChangeSign>| [moved.begin(), moved.end()].contains(&at);
        around
            .map(|moved| if is_end(moved) { ChangeSign::Change } else { moved.label })
            .max()
            .unwrap_or(ChangeSign::None)
    }
}
