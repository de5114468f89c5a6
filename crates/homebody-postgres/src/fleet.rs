//! The runs of many homes in one database, over one connection.
//!
//! Each home is a run of its own. A transaction may have rows of many homes, and stores their new watermarks with them. A transaction
//! whose end is unknown is looked up before it is made again.

use crate::connection::DatabaseConnection;
use crate::fleet_runs;
use crate::messages::{ContinueMessage, ServerMessage, ServerUrlMessage};
use crate::rows::{CopyRows, Encoder, copy_into};
use crate::runs::{self, At};
use crate::schema::{InTable, Schema};
use crate::sensors;
use crate::server::Server;
use crate::trouble::{changed, unheld, wrong};
use futures_util::SinkExt;
use homebody_core::event::Value;
use homebody_core::time::UtcTime;
use homebody_log::fleet::{Fleet, FleetEvent, FleetRow, FleetSink};
use homebody_log::table::{Batch, Cell, TextPool};
use homebody_log::{Begin, Deadline, LogError, Url, WriteMode};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

/// Largest number of rows in a transaction (our choice).
const MOST_AT_ONCE: usize = 20_000;

/// A database that many homes tell.
pub struct PostgresFleet {
    url: String,
    open: Option<OpenDatabaseFleet>,
}

struct OpenDatabaseFleet {
    server: Server,
    deadline: Deadline,
    /// None after it was lost, until the next transaction.
    connection: Option<DatabaseConnection>,
    fleet: Arc<Fleet>,
    schema: Schema,
    kinds: Vec<HomeRowEncoder>,
    homes: Vec<StoredHome>,
    /// Whether the server was asked to end a transaction, and has not answered.
    is_in_doubt: bool,
}

struct HomeRowEncoder {
    table: InTable,
    encoder: Encoder,
    texts: TextPool,
    start: UtcTime,
}

/// The watermark of a home.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct StoredHome {
    /// The number of the next row.
    rows: i64,
    /// The number of transactions that have changed it.
    commits: i64,
}

impl PostgresFleet {
    /// The database of a URL. Nothing is touched before it is begun.
    pub fn new(url: &Url) -> PostgresFleet {
        PostgresFleet { url: url.to_string(), open: None }
    }

    fn begun(&mut self) -> Result<&mut OpenDatabaseFleet, LogError> {
        self.open.as_mut().ok_or_else(|| LogError::Stopped { place: "postgresql".into() })
    }
}

impl FleetSink for PostgresFleet {
    fn check(&self, _: bool) -> Result<(), LogError> {
        let server = Server::parse(&self.url)?;
        match &server.run {
            Some(run) => Err(wrong(&server, ServerUrlMessage::FleetRun { run: run.clone() })),
            None => Ok(()),
        }
    }

    fn begin(&mut self, fleet: &Arc<Fleet>, how: WriteMode, deadline: &Deadline) -> Result<Vec<u64>, LogError> {
        let server = Server::parse(&self.url)?;
        let connection = DatabaseConnection::open(&server, deadline)?;
        let (mut kinds, mut all) = (Vec::new(), None);
        for layout in &fleet.layouts {
            // Existing rows of runs are continued: their ids are those of the very same homes.
            let (run, tables) = (Arc::new(layout.run.clone()), vec![layout.table.clone()]);
            let begin = Begin::new(run, tables, layout.time, WriteMode::Resume);
            let begin = Begin { run_column: layout.run_column.clone(), deadline: deadline.clone(), ..begin };
            let schema = Schema::make(&connection, &server, &begin)?;
            let start = runs::start_of(&layout.run);
            let encoder = Encoder::new(0, start, layout.time);
            kinds.push(HomeRowEncoder { table: schema.tables[0].clone(), encoder, texts: TextPool::default(), start });
            all = Some(schema);
        }
        let none = || wrong(&server, ServerMessage::NoHomes);
        let schema = all.ok_or_else(none)?;
        if how == WriteMode::Overwrite {
            fleet_runs::forget(&connection, &schema, &kinds_of(fleet, &kinds))?;
        }
        fleet_runs::add(&connection, &schema, fleet)?;
        let homes = fleet.homes.iter();
        let known: Vec<_> = homes.map(|home| (home.run, &fleet.layouts[home.layout].run.sensors[..])).collect();
        sensors::tell(&connection, &schema, &known)?;
        let homes = found(&connection, &server, &schema, fleet)?;
        let there = homes.iter().map(|home| home.rows as u64).collect();
        let (fleet, connection) = (fleet.clone(), Some(connection));
        self.open = Some(OpenDatabaseFleet {
            server,
            deadline: deadline.clone(),
            connection,
            fleet,
            schema,
            kinds,
            homes,
            is_in_doubt: false,
        });
        Ok(there)
    }

    fn tell(&mut self, told: &[FleetEvent]) -> Result<(), LogError> {
        let open = self.begun()?;
        let rows: Vec<FleetRow> =
            told.iter().filter_map(|told| if let FleetEvent::Row(row) = told { Some(*row) } else { None }).collect();
        if rows.is_empty() {
            return Ok(());
        }
        let begun = Instant::now();
        match open.transact(&rows) {
            // The connection may have been lost long ago: a new one is tried once, unless this has taken long already.
            Err(error) if error.passes() && begun.elapsed() < open.deadline.within() / 2 => {
                open.connection = None;
                open.transact(&rows)
            }
            done => done,
        }
        .inspect_err(|_| open.connection = None)
    }

    fn finish(&mut self, end: UtcTime) -> Result<(), LogError> {
        let open = self.begun()?;
        let ids: Vec<i64> = open.fleet.homes.iter().map(|home| home.run).collect();
        let sql =
            format!("UPDATE {} SET ended_at = greatest($2, started_at) WHERE run_id = ANY($1)", open.schema.runs());
        let connection = open.connected()?;
        match connection.wait_long(connection.client.execute(&sql, &[&ids, &At(end)])) {
            Ok(_) => self.open = None,
            Err(error) => {
                open.connection = None;
                return Err(error);
            }
        }
        Ok(())
    }

    fn most_at_once(&self) -> usize {
        MOST_AT_ONCE
    }
}

/// By table, the ids of the runs whose rows are in it.
fn kinds_of(fleet: &Fleet, kinds: &[HomeRowEncoder]) -> Vec<(InTable, Vec<i64>)> {
    let of =
        |layout: usize| fleet.homes.iter().filter(move |home| home.layout == layout).map(|home| home.run).collect();
    kinds.iter().enumerate().map(|(layout, kind)| (kind.table.clone(), of(layout))).collect()
}

/// The watermark of each home; an error if its entry is that of another run.
fn found(
    connection: &DatabaseConnection,
    server: &Server,
    schema: &Schema,
    fleet: &Fleet,
) -> Result<Vec<StoredHome>, LogError> {
    let known = fleet_runs::find(connection, schema, fleet)?;
    let home = |home: &homebody_log::fleet::FleetHome| {
        let Some(known) = known.get(&home.run) else {
            return Err(wrong(server, ServerMessage::RunGone { home: home.name.to_string() }));
        };
        if known.holds != runs::holds(false) || known.version != fleet.layouts[home.layout].run.version {
            let (run, holds, version) = (home.run, known.holds.to_string(), known.version.to_string());
            return Err(wrong(server, ServerMessage::ForeignRun { run, holds, version }));
        }
        Ok(StoredHome { rows: known.rows, commits: known.commits })
    };
    fleet.homes.iter().map(home).collect()
}

impl OpenDatabaseFleet {
    fn connected(&mut self) -> Result<&DatabaseConnection, LogError> {
        if self.connection.is_none() {
            self.connection = Some(DatabaseConnection::open(&self.server, &self.deadline)?);
        }
        self.connection.as_ref().ok_or_else(|| LogError::Stopped { place: self.server.place.clone() })
    }

    /// One transaction of these rows, unless an earlier one has taken them.
    fn transact(&mut self, rows: &[FleetRow]) -> Result<(), LogError> {
        self.connected()?;
        // By the number of the home, the row after the last of these.
        let then: BTreeMap<u32, i64> = rows.iter().map(|row| (row.home, row.seq as i64 + 1)).collect();
        let encoded = self.encode(rows)?;
        let OpenDatabaseFleet {
            server, connection: Some(connection), fleet, schema, kinds, homes, is_in_doubt, ..
        } = self
        else {
            return Ok(());
        };
        connection.wait(connection.client.batch_execute("BEGIN"))?;
        let ids: Vec<i64> = then.keys().map(|&home| fleet.homes[home as usize].run).collect();
        let now = fleet_runs::look_at(connection, schema, &ids)?;
        let is = |of: &dyn Fn(u32, i64) -> StoredHome| {
            then.iter().all(|(&home, &rows)| {
                let StoredHome { rows, commits } = of(home, rows);
                now.get(&fleet.homes[home as usize].run) == Some(&(rows, commits))
            })
        };
        let after = |home: u32, rows| after_commit(homes[home as usize], rows);
        let is_taken = *is_in_doubt && is(&after);
        if !is_taken && !is(&|home, _| homes[home as usize]) {
            return Err(changed(server, ContinueMessage::OtherProgram));
        }
        if is_taken {
            connection.wait(connection.client.batch_execute("ROLLBACK"))?;
        } else {
            for (kind, rows) in kinds.iter().zip(&encoded).filter(|(_, rows)| rows.count > 0) {
                let sql = copy_into(&kind.table);
                let copied = connection.wait(async {
                    let mut copy = Box::pin(connection.client.copy_in(&sql).await?);
                    for chunk in rows.copy().filter(|chunk| !chunk.is_empty()) {
                        copy.feed(chunk).await?;
                    }
                    copy.as_mut().finish().await
                })?;
                if copied != rows.count {
                    return Err(changed(server, ContinueMessage::OtherCount));
                }
            }
            let rows: Vec<i64> = then.values().copied().collect();
            fleet_runs::mark(connection, schema, &ids, &rows)?;
            *is_in_doubt = true;
            connection.wait(connection.client.batch_execute("COMMIT"))?;
        }
        *is_in_doubt = false;
        for (home, rows) in then {
            homes[home as usize] = after_commit(homes[home as usize], rows);
        }
        Ok(())
    }

    /// By layout, the encoded rows.
    fn encode(&mut self, rows: &[FleetRow]) -> Result<Vec<CopyRows>, LogError> {
        let OpenDatabaseFleet { server, fleet, kinds, .. } = self;
        let mut all = vec![CopyRows::default(); kinds.len()];
        let mut buffer = String::new();
        for row in rows {
            let home = &fleet.homes[row.home as usize];
            let (layout, kind) = (&fleet.layouts[home.layout], &mut kinds[home.layout]);
            let before = kind.texts.len();
            let sensor = Cell::Text(kind.texts.id(layout.sensor(row.sensor)));
            let value = match row.value {
                Value::Reading(number) => Cell::Thousandths(number),
                value => Cell::Text(kind.texts.id(layout.value(value, &mut buffer))),
            };
            if kind.texts.len() > before {
                let learnt = kind.encoder.learn(&Batch::default().with(&kind.texts));
                learnt.map_err(|text| unheld(server, &text))?;
            }
            kind.encoder.of_run(home.run, kind.start);
            kind.encoder
                .row(&[Cell::Integer(row.seq as i64), Cell::Instant(row.at), sensor, value], &mut all[home.layout]);
        }
        Ok(all)
    }
}

fn after_commit(home: StoredHome, rows: i64) -> StoredHome {
    StoredHome { rows, commits: home.commits + 1 }
}
