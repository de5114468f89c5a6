//! Why each row of a log is there, from the truth of its run.

use super::RecordedTruth;
use super::turns::TruthClock;
use crate::error::LogError;
use crate::files::database::text;
use crate::source::{InstantReader, instant_of_cell};
use homebody_core::time::{RunTime, TimeScale};
use rusqlite::Connection;
use std::collections::VecDeque;

/// The truth of a run, to be asked why each row of its log is there.
pub(crate) struct Causes<'t> {
    truth: &'t RecordedTruth,
    clock: CauseClock,
    firings: CauseRows,
    offs: CauseRows,
}

struct CauseClock {
    instants: InstantReader,
    turns: TruthClock,
}

/// Rows of one of the truth's tables that name rows of the log, in their order, a part of them in memory.
struct CauseRows {
    /// Asks for those after a rowid, and how many.
    sql: &'static str,
    /// The last that was read.
    rowid: i64,
    /// When the last one was seen.
    seen_at: RunTime,
    is_over: bool,
    read: VecDeque<Cause>,
}

/// How many of them are read at once.
const AT_ONCE: usize = 4096;

// A firing that only prolongs what an ON has begun names the same row as those before it. Firings are numbered from 0 and rows
// of a table from 1.
const FIRINGS: &str = "SELECT rowid, row, resident, seen_at, sensor, why, thing FROM cause
                       WHERE rowid > ?1 AND row IS NOT NULL ORDER BY rowid LIMIT ?2";
const OFFS: &str = "SELECT off.rowid, off.row, cause.resident, cause.seen_at, cause.sensor, cause.why, cause.thing
                    FROM off JOIN cause ON cause.rowid = off.firing + 1 AND cause.firing = off.firing
                    WHERE off.rowid > ?1 ORDER BY off.rowid LIMIT ?2";

impl CauseRows {
    fn of(sql: &'static str) -> CauseRows {
        CauseRows { sql, rowid: 0, seen_at: RunTime::MIN, is_over: false, read: VecDeque::new() }
    }

    /// What is told of a row, if anything is; rows are asked for in their order.
    fn take(&mut self, row: u64, from: &Connection, clock: &mut CauseClock) -> rusqlite::Result<Option<Cause>> {
        loop {
            match self.read.front() {
                Some(next) if next.row > row => return Ok(None),
                Some(next) if next.row == row => return Ok(self.read.pop_front()),
                Some(_) => drop(self.read.pop_front()),
                None if self.is_over => return Ok(None),
                None => self.read_on(from, clock)?,
            }
        }
    }

    fn read_on(&mut self, from: &Connection, clock: &mut CauseClock) -> rusqlite::Result<()> {
        let mut statement = from.prepare_cached(self.sql)?;
        let mut rows = statement.query((self.rowid, AT_ONCE as i64))?;
        self.is_over = true;
        while let Some(row) = rows.next()? {
            let said = |column| {
                let said = text(row.get_ref(column)?).into_owned();
                Ok::<_, rusqlite::Error>(Some(said).filter(|said| !said.is_empty()))
            };
            let resident = said(2)?;
            let seen_at = instant_of_cell(row, 3, &mut clock.instants)?;
            let seen_at = seen_at.map(|at| clock.turns.sight(resident.as_deref(), at, self.seen_at));
            self.seen_at = seen_at.unwrap_or(self.seen_at);
            self.read.push_back(Cause {
                row: row.get::<_, i64>(1)? as u64,
                resident,
                seen_at,
                sensor: said(4)?,
                why: said(5)?.unwrap_or_default(),
                thing: said(6)?,
            });
            (self.rowid, self.is_over) = (row.get(0)?, false);
        }
        Ok(())
    }
}

impl<'t> Causes<'t> {
    pub fn of(truth: &'t RecordedTruth, scale: &TimeScale) -> Result<Causes<'t>, LogError> {
        let (firings, offs) = (CauseRows::of(FIRINGS), CauseRows::of(OFFS));
        let clock =
            CauseClock { instants: InstantReader::default(), turns: TruthClock::new(truth, &truth.scale(scale))? };
        Ok(Causes { truth, clock, firings, offs })
    }

    /// The last row of the log that it tells of, if it tells of any.
    pub fn last_row(&self) -> Result<Option<u64>, LogError> {
        let sql = "SELECT max(row) FROM (SELECT max(row) AS row FROM cause UNION ALL SELECT max(row) FROM off)";
        let last = self.truth.connection.query_row(sql, [], |row| row.get::<_, Option<i64>>(0));
        Ok(last.map_err(|error| self.truth.error(error))?.map(|row| row as u64))
    }

    /// Why a row is there, if the truth tells; rows are asked for in their order. An ON tells of the firing that it began
    /// with; those that prolong it come later.
    pub fn of_row(&mut self, row: u64) -> Result<Option<Cause>, LogError> {
        let Causes { truth, clock, firings, offs } = self;
        let mut take = || match firings.take(row, &truth.connection, clock)? {
            Some(cause) => Ok(Some(cause)),
            None => offs.take(row, &truth.connection, clock),
        };
        take().map_err(|error| truth.error(error))
    }
}

/// Why a row of a log is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Cause {
    /// The row that tells of it.
    pub row: u64,
    pub resident: Option<String>,
    /// When it began to be noticed.
    pub seen_at: Option<RunTime>,
    /// The sensor's id in the log.
    pub sensor: Option<String>,
    pub why: String,
    pub thing: Option<String>,
}
