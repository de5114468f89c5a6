//! A log or a truth in a database of PostgreSQL.
//!
//! Rows wait in memory, already encoded, until a transaction has taken them, with the new watermark of the run. Many rows of a log are
//! sent before the transaction ends. A transaction that fails is made again with the same rows. If the connection was lost during its end,
//! the next transaction finds out whether it was taken: each begins with a look at the run's watermark, which waits for an earlier
//! transaction.

use crate::connection::DatabaseConnection;
use crate::messages::{ContinueMessage, ServerMessage, ServerUrlMessage};
use crate::rows::{CopyRows, Encoder, copy_into};
use crate::runs::{self, At, StoredRun};
use crate::schema::{Schema, ident};
use crate::sensors;
use crate::server::Server;
use crate::trouble::{changed, unheld, wrong};
use bytes::Bytes;
use futures_util::SinkExt;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::RunTime;
use homebody_log::table::{Batch, ColumnKind};
use homebody_log::{Begin, Deadline, LogError, RunInfo, Sink, Url, Watermark, WriteMode};
use std::pin::Pin;
use std::time::Instant;
use tokio_postgres::CopyInSink;
use tokio_postgres::types::ToSql;

/// Rows and bytes after which a transaction ends in any case (our choice): memory has to hold them.
const MOST_ROWS: u64 = 200_000;
const MOST_BYTES: usize = 32 << 20;

/// A database as a destination. Its errors that [pass](LogError::passes) may be tried again; nothing is kept twice.
pub struct Postgres {
    url: String,
    open: Option<OpenDatabaseLog>,
    /// Whether this program may have added the run without an answer.
    has_tried: bool,
}

struct OpenDatabaseLog {
    server: Server,
    deadline: Deadline,
    /// None after it was lost, until the next transaction.
    connection: Option<DatabaseConnection>,
    /// The server's name of the last connection, if that was given up.
    left_behind: Option<String>,
    schema: Schema,
    run: RunInfo,
    encoder: Encoder,
    /// The number of transactions that have changed the run.
    commits: i64,
    /// The number of durable rows of each table.
    durable: Vec<i64>,
    /// Whether the first transaction deletes existing rows of the run.
    replaces: bool,
    /// For a log that is resumed, the column of its instants.
    goes_on_by: Option<(String, TimeFormat)>,
    /// The rows of the transaction that is under way.
    sealed: Option<Sealed>,
    /// The rows that have come since.
    waiting: Vec<CopyRows>,
    /// A transaction that takes waiting rows already.
    ahead: Option<Ahead>,
}

/// A transaction that takes rows of the only table already.
struct Ahead {
    copy: Pin<Box<CopyInSink<Bytes>>>,
    /// The number of chunks that were sent.
    sent: usize,
}

/// The content of a transaction: it stays the same until the transaction was taken.
struct Sealed {
    rows: Vec<CopyRows>,
    /// The number of rows of each table afterwards.
    then: Vec<i64>,
    end: Option<RunTime>,
    /// Whether the server was asked to end the transaction and has not answered.
    is_in_doubt: bool,
}

impl Postgres {
    /// The database of a URL. Nothing is touched before it is begun.
    pub fn new(url: &Url) -> Postgres {
        Postgres { url: url.to_string(), open: None, has_tried: false }
    }

    fn begun(&mut self) -> Result<&mut OpenDatabaseLog, LogError> {
        // Only a URL that was read has been begun.
        self.open.as_mut().ok_or_else(|| LogError::Stopped { place: "postgresql".into() })
    }
}

impl Sink for Postgres {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let server = Server::parse(&self.url)?;
        let mut run = RunInfo::clone(&begin.run);
        if let Some(id) = &server.run {
            let no_number = || wrong(&server, ServerUrlMessage::Run { run: id.clone() });
            run.id = id.parse().map_err(|_| no_number())?;
        }
        let connection = DatabaseConnection::open(&server, &begin.deadline)?;
        let schema = Schema::make(&connection, &server, begin)?;
        if runs::has_others(&connection, &schema)? {
            let name = schema.name.clone();
            return Err(wrong(
                &server,
                match schema.is_truth {
                    true => ServerMessage::TruthInLogs { schema: name },
                    false => ServerMessage::LogInTruths { schema: name },
                },
            ));
        }
        let known = runs::find(&connection, &schema, run.id, false)?;
        let is_ours = self.has_tried && known.as_ref().is_some_and(|known| known.commits == 0);
        let has_rows =
            known.is_none() && begin.how != WriteMode::Resume && runs::has_rows(&connection, &schema, run.id)?;
        if begin.how == WriteMode::Create && (known.is_some() && !is_ours || has_rows) {
            return Err(already(&server, &schema, &run));
        }
        let mut replaces = begin.how == WriteMode::Overwrite && (known.is_some() || has_rows);
        let nothing = vec![0; schema.tables.len()];
        let (commits, durable) = match known {
            Some(known) if begin.how == WriteMode::Resume => {
                can_go_on(&server, &schema, &known)?;
                // A stopped truth has ends of activities at the stop, which the resumed run does not have.
                replaces = schema.is_truth && known.is_ended;
                (known.commits, if replaces { nothing } else { known.rows })
            }
            Some(known) => (known.commits, nothing),
            None => {
                self.has_tried = true;
                if !runs::add(&connection, &schema, &run)? {
                    return Err(already(&server, &schema, &run));
                }
                (0, nothing)
            }
        };
        if begin.how == WriteMode::Overwrite {
            sensors::forget(&connection, &schema, &[run.id])?;
        }
        sensors::tell(&connection, &schema, &[(run.id, &run.sensors)])?;
        let encoder = Encoder::new(run.id, runs::start_of(&run), begin.time);
        let waiting = vec![CopyRows::default(); schema.tables.len()];
        let connection = Some(connection);
        let goes_on = begin.how == WriteMode::Resume && !schema.is_truth && durable[0] > 0;
        let instants = begin.tables[0].columns.iter().find(|column| column.kind == ColumnKind::Instant);
        let goes_on_by = instants.filter(|_| goes_on).map(|column| (ident(&column.name), begin.time));
        let (sealed, ahead) = (None, None);
        let open = OpenDatabaseLog {
            server,
            deadline: begin.deadline.clone(),
            connection,
            left_behind: None,
            schema,
            run,
            encoder,
            commits,
            durable,
            replaces,
            goes_on_by,
            sealed,
            waiting,
            ahead,
        };
        let watermark = open.watermark();
        self.open = Some(open);
        Ok(watermark)
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let open = self.begun()?;
        // First, so that a batch whose call fails has not been taken.
        if open.waiting.iter().map(|rows| rows.count).sum::<u64>() >= MOST_ROWS
            || open.waiting.iter().map(CopyRows::bytes).sum::<usize>() >= MOST_BYTES
        {
            open.commit(None)?;
        }
        open.send_ahead()?;
        open.encoder.learn(batch).map_err(|text| unheld(&open.server, &text))?;
        for row in batch.rows() {
            open.encoder.row(row.cells, &mut open.waiting[row.table]);
        }
        Ok(())
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let open = self.begun()?;
        open.commit(None)?;
        Ok(open.watermark())
    }

    fn finish(&mut self, end: RunTime) -> Result<(), LogError> {
        let open = self.begun()?;
        open.has_come_as_far(end)?;
        open.commit(Some(end))?;
        self.open = None;
        Ok(())
    }
}

impl Drop for Postgres {
    /// Removes a run without rows, which would be in the way of the next.
    fn drop(&mut self) {
        let Some(open) = self.open.as_mut().filter(|open| open.commits == 0 && open.sealed.is_none()) else { return };
        let was_ahead = open.ahead.take().is_some();
        let OpenDatabaseLog { connection: Some(connection), schema, run, .. } = open else { return };
        if was_ahead && connection.wait(connection.client.batch_execute("ROLLBACK")).is_err() {
            return;
        }
        let _ = runs::forget(connection, schema, run.id);
        let _ = sensors::forget(connection, schema, &[run.id]);
    }
}

impl OpenDatabaseLog {
    fn watermark(&self) -> Watermark {
        Watermark(self.durable.iter().map(|&rows| rows as u64).collect())
    }

    /// Refuses the end of a resumed run that was stopped before it came as far as the earlier one.
    fn has_come_as_far(&mut self, end: RunTime) -> Result<(), LogError> {
        // New rows show that it has come as far.
        let has_new = self.sealed.is_some() || self.waiting.iter().any(|rows| rows.count > 0);
        let Some((column, time)) = self.goes_on_by.take().filter(|_| !has_new) else { return Ok(()) };
        let OpenDatabaseLog { server, connection: Some(connection), schema, run, .. } = self else { return Ok(()) };
        let end = runs::start_of(run) + end.since_zero();
        let (seconds, milliseconds) = (end.since_zero().seconds(), end.micros().div_euclid(1000));
        let end: &(dyn ToSql + Sync) = match time {
            TimeFormat::Local | TimeFormat::LocalOffset | TimeFormat::Utc => &At(end),
            TimeFormat::EpochS => &seconds,
            TimeFormat::EpochMs => &milliseconds,
        };
        let (table, run_column) = (&schema.tables[0].quoted, &schema.tables[0].run_column);
        let sql = format!("SELECT EXISTS (SELECT FROM {table} WHERE {run_column} = $1 AND {column} > $2)");
        match connection.wait_long(connection.client.query_one(&sql, &[&run.id, end]))?.get(0) {
            true => Err(changed(server, ContinueMessage::LaterRows)),
            false => Ok(()),
        }
    }

    /// Makes sure of all rows that have come, and of the run's end if that has come.
    fn commit(&mut self, end: Option<RunTime>) -> Result<(), LogError> {
        // The unfinished transaction of an earlier call comes first, unchanged.
        while self.sealed.is_some() || end.is_some() || self.waiting.iter().any(|rows| rows.count > 0) {
            let sealed = self.sealed.get_or_insert_with(|| {
                let rows = std::mem::replace(&mut self.waiting, vec![CopyRows::default(); self.durable.len()]);
                let then = self.durable.iter().zip(&rows).map(|(durable, rows)| durable + rows.count as i64).collect();
                Sealed { rows, then, end, is_in_doubt: false }
            });
            let is_last = end.is_some() && sealed.end == end;
            let begun = Instant::now();
            match self.transact() {
                // The connection may have been lost long ago: a new one is tried once, unless this has taken long already.
                Err(error) if error.passes() && begun.elapsed() < self.deadline.within() / 2 => {
                    self.disconnect();
                    if let Err(error) = self.transact() {
                        self.disconnect();
                        return Err(error);
                    }
                }
                Err(error) => {
                    self.disconnect();
                    return Err(error);
                }
                Ok(()) => {}
            }
            if let Some(taken) = self.sealed.take() {
                self.durable = taken.then;
            }
            self.commits += 1;
            self.replaces = false;
            if is_last {
                break;
            }
        }
        Ok(())
    }

    fn disconnect(&mut self) {
        self.ahead = None;
        if let Some(lost) = self.connection.take() {
            self.left_behind = lost.backend.clone();
        }
    }

    /// Sends waiting rows of a log, so that the server works while others are made. If that fails, the transaction is made anew at its
    /// end, and reports the error. A server that does not answer is an error at once.
    fn send_ahead(&mut self) -> Result<(), LogError> {
        let is_due = self.waiting.len() == 1 && self.sealed.is_none() && self.waiting[0].whole_from(1).next().is_some();
        let tried = if is_due { self.try_ahead() } else { Ok(()) };
        if tried.is_err() {
            self.disconnect();
        }
        tried.or_else(|error| if matches!(error, LogError::Hangs { .. }) { Err(error) } else { Ok(()) })
    }

    fn try_ahead(&mut self) -> Result<(), LogError> {
        if self.ahead.is_none() {
            if self.connection.is_none() || !self.begin()? {
                return Ok(());
            }
            let Some(connection) = &self.connection else { return Ok(()) };
            let sql = copy_into(&self.schema.tables[0]);
            let copy = connection.wait(connection.client.copy_in(&sql))?;
            self.ahead = Some(Ahead { copy: Box::pin(copy), sent: 0 });
        }
        let (Some(connection), Some(Ahead { copy, sent })) = (&self.connection, &mut self.ahead) else { return Ok(()) };
        for chunk in self.waiting[0].whole_from(*sent) {
            connection.wait(copy.feed(chunk))?;
            *sent += 1;
        }
        Ok(())
    }

    /// Begins a transaction, with a look at how far the run is. False where an earlier one has taken the sealed rows.
    fn begin(&self) -> Result<bool, LogError> {
        let OpenDatabaseLog { server, connection: Some(connection), schema, run, .. } = self else { return Ok(false) };
        connection.wait(connection.client.batch_execute("BEGIN"))?;
        let known = runs::find(connection, schema, run.id, true)?;
        let known = known.ok_or_else(|| changed(server, ContinueMessage::NoRunRow))?;
        if known.commits != self.commits {
            connection.wait(connection.client.batch_execute("ROLLBACK"))?;
            // It has gone as asked where that was in doubt. Nobody else leaves just these numbers.
            let is_taken = |sealed: &Sealed| sealed.is_in_doubt && known.rows == sealed.then;
            let is_ours = known.commits == self.commits + 1 && self.sealed.as_ref().is_some_and(is_taken);
            return if is_ours { Ok(false) } else { Err(changed(server, ContinueMessage::OtherProgram)) };
        }
        for table in schema.tables.iter().filter(|_| self.replaces) {
            let sql = format!("DELETE FROM {} WHERE {} = $1", table.quoted, table.run_column);
            connection.wait_long(connection.client.execute(&sql, &[&run.id]))?;
        }
        Ok(true)
    }

    /// One transaction of the sealed rows, unless an earlier one has taken them.
    fn transact(&mut self) -> Result<(), LogError> {
        if self.connection.is_none() {
            let connection = DatabaseConnection::open(&self.server, &self.deadline)?;
            if let Some(backend) = self.left_behind.take() {
                connection.end(&backend);
            }
            self.connection = Some(connection);
        }
        let mut ahead = self.ahead.take();
        if ahead.is_none() && !self.begin()? {
            return Ok(());
        }
        let OpenDatabaseLog { server, connection: Some(connection), schema, run, sealed: Some(sealed), .. } = self
        else {
            return Ok(());
        };
        for (table, rows) in schema.tables.iter().zip(&sealed.rows).filter(|(_, rows)| rows.count > 0) {
            let sql = copy_into(table);
            let Ahead { mut copy, sent } = match ahead.take() {
                Some(ahead) => ahead,
                None => Ahead { copy: Box::pin(connection.wait(connection.client.copy_in(&sql))?), sent: 0 },
            };
            for chunk in rows.copy().skip(sent).filter(|chunk| !chunk.is_empty()) {
                connection.wait(copy.feed(chunk))?;
            }
            let copied = connection.wait(copy.as_mut().finish())?;
            if copied != rows.count {
                return Err(changed(server, ContinueMessage::OtherCount));
            }
        }
        runs::mark(connection, schema, run, &sealed.then, sealed.end)?;
        sealed.is_in_doubt = true;
        connection.wait(connection.client.batch_execute("COMMIT"))
    }
}

fn already(server: &Server, schema: &Schema, run: &RunInfo) -> LogError {
    let (scenario, schema) = (run.scenario.clone(), schema.name.clone());
    wrong(server, ServerMessage::Exists { run: run.id, scenario, schema })
}

/// Refuses what was not begun as this run is.
fn can_go_on(server: &Server, schema: &Schema, known: &StoredRun) -> Result<(), LogError> {
    let tables: Vec<&str> = schema.tables.iter().map(|table| table.name.as_str()).collect();
    if known.tables != tables {
        return Err(changed(server, ContinueMessage::OtherTables { tables: known.tables.clone() }));
    }
    Ok(())
}
