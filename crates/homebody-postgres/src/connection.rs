//! A connection to a server on which each wait has an end.

use crate::messages::ServerMessage;
use crate::password;
use crate::server::{Host, Server};
use crate::tls;
use crate::trouble::{away, client_error, silent};
use homebody_log::{Deadline, LogError};
use std::future::Future;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::runtime::{Builder, Runtime};
use tokio::task::JoinHandle;
use tokio_postgres::types::{FromSql, ToSql};
use tokio_postgres::{Client, Config, Error, Row, SimpleQueryMessage};

/// Rows of one request (our choice).
const ROWS_AT_ONCE: usize = 8192;

/// The longest wait for a reader of a log, and for a request that grows with the size of a table.
const ANSWERS_WITHIN: Duration = Duration::from_secs(100);

/// Longest time that a server waits for a lock.
const LONGEST_LOCK: Duration = Duration::from_secs(30);

/// Longest time that a server keeps the transaction of a silent program open.
const LONGEST_IDLE: Duration = Duration::from_secs(90);

/// The number of packets that probe a silent server.
const KEEPALIVES: u32 = 3;

/// The settings of each connection. A program that is cut off holds up no other for long, and committed rows are on the server's disk.
/// The server reports a lock that it does not get before the deadline, and tells its own name of this connection.
fn settings(within: Duration) -> String {
    let lock_ms = within.mul_f64(0.8).min(LONGEST_LOCK).as_millis().max(1);
    let idle_ms = (3 * within).min(LONGEST_IDLE).as_millis().max(1);
    format!(
        "SET lock_timeout = {lock_ms}; SET idle_in_transaction_session_timeout = {idle_ms}; SET statement_timeout = 0; \
         SET tcp_keepalives_idle = 10; SET tcp_keepalives_interval = 10; SET tcp_keepalives_count = 3; \
         SELECT set_config('synchronous_commit', 'on', false) WHERE current_setting('synchronous_commit') = 'off'; \
         SELECT {BACKEND} FROM pg_stat_activity WHERE pid = pg_backend_pid()"
    )
}

/// A name of the server's end of a connection that no other end gets.
const BACKEND: &str = "pid || ' ' || backend_start";

/// A connection. After an error that passes it is of no more use.
pub(crate) struct DatabaseConnection {
    server: Server,
    runtime: Runtime,
    pub client: Client,
    /// Runs the connection in both directions.
    carrier: JoinHandle<()>,
    ended_by: Arc<Mutex<Option<Error>>>,
    deadline: Deadline,
    /// The server's name of its end, if it tells it.
    pub backend: Option<String>,
}

impl DatabaseConnection {
    /// Connects for one who reads, within the time that the server's URL says.
    pub fn to_read(server: &Server) -> Result<DatabaseConnection, LogError> {
        DatabaseConnection::open(server, &Deadline::new(ANSWERS_WITHIN))
    }

    /// Connects, within the time that the server's URL says and the deadline allows; each answer has the deadline's time.
    pub fn open(server: &Server, deadline: &Deadline) -> Result<DatabaseConnection, LogError> {
        let connect_within = server.connect_within.min(deadline.within());
        let runtime = Builder::new_current_thread().enable_io().enable_time().build();
        let runtime =
            runtime.map_err(|error| away(server, ServerMessage::NoConnection { reason: error.to_string() }))?;
        let found = password::find(server);
        let mut config = Config::new();
        config
            .user(&server.user)
            .dbname(&server.database)
            .port(server.port)
            .ssl_mode(tls::mode(server.tls))
            .application_name(&server.application)
            .connect_timeout(connect_within)
            .tcp_user_timeout(deadline.within())
            .keepalives_idle(deadline.within().max(Duration::from_secs(1)))
            .keepalives_interval((deadline.within() / KEEPALIVES).max(Duration::from_secs(1)))
            .keepalives_retries(KEEPALIVES);
        match &server.host {
            Host::Name(name) => config.host(name),
            #[cfg(unix)]
            Host::Socket(folder) => config.host_path(folder),
            #[cfg(not(unix))]
            Host::Socket(folder) => config.host(folder.to_string_lossy()),
        };
        if let Some(options) = &server.options {
            config.options(options);
        }
        if let Some(password) = &found.password {
            config.password(password);
        }
        let connector = tls::connector(server)?;
        let ended_by = Arc::<Mutex<Option<Error>>>::default();
        deadline.asks_for(connect_within);
        let connected = runtime.block_on(async {
            let connecting = async {
                let (client, line) = config.connect(connector).await?;
                let ended = ended_by.clone();
                let carrier = tokio::spawn(async move {
                    *ended.lock().unwrap_or_else(PoisonError::into_inner) = line.await.err();
                });
                let said = client.simple_query(&settings(deadline.within())).await?;
                Ok((client, carrier, said))
            };
            tokio::time::timeout(connect_within, connecting).await
        });
        match connected {
            Ok(Ok((client, carrier, said))) => {
                let backend = said.iter().rev().find_map(|said| match said {
                    SimpleQueryMessage::Row(row) => row.get(0).map(str::to_owned),
                    _ => None,
                });
                let (server, deadline) = (server.clone(), deadline.clone());
                Ok(DatabaseConnection { server, runtime, client, carrier, ended_by, deadline, backend })
            }
            Ok(Err(error)) => Err(client_error(server, &error, found.ignored.as_deref())),
            Err(_) => Err(silent(server, connect_within)),
        }
    }

    pub fn wait<T>(&self, asked: impl Future<Output = Result<T, Error>>) -> Result<T, LogError> {
        self.wait_for(self.deadline.within(), asked)
    }

    pub fn wait_long<T>(&self, asked: impl Future<Output = Result<T, Error>>) -> Result<T, LogError> {
        self.wait_for(ANSWERS_WITHIN.max(self.deadline.within()), asked)
    }

    pub fn wait_for<T>(&self, longest: Duration, asked: impl Future<Output = Result<T, Error>>) -> Result<T, LogError> {
        self.deadline.asks_for(longest);
        let answer = self.runtime.block_on(async { tokio::time::timeout(longest, asked).await });
        match answer {
            Ok(Ok(answer)) => Ok(answer),
            Ok(Err(error)) if error.is_closed() => Err(self.lost(&error)),
            Ok(Err(error)) => Err(client_error(&self.server, &error, None)),
            Err(_) => Err(silent(&self.server, longest)),
        }
    }

    /// Hands over the rows of a query, some at a time, within a transaction.
    pub fn each_row(
        &self,
        sql: &str,
        parameters: &[&(dyn ToSql + Sync)],
        mut take: impl FnMut(&Row) -> Result<(), LogError>,
    ) -> Result<(), LogError> {
        self.wait(self.client.execute(&format!("DECLARE rows NO SCROLL CURSOR FOR {sql}"), parameters))?;
        let next = self.wait(self.client.prepare(&format!("FETCH {ROWS_AT_ONCE} FROM rows")))?;
        loop {
            let rows = self.wait(self.client.query(&next, &[]))?;
            rows.iter().try_for_each(&mut take)?;
            if rows.len() < ROWS_AT_ONCE {
                return self.wait(self.client.batch_execute("CLOSE rows"));
            }
        }
    }

    /// Ends what the server still does for a connection that this program has given up: it would keep its locks.
    pub fn end(&self, backend: &str) {
        let sql = format!("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE {BACKEND} = $1");
        // A server that does not allow it ends the connection by itself a little later.
        let _ = self.wait(self.client.execute(&sql, &[&backend]));
    }

    /// Why the connection is lost, as far as the server has said so.
    fn lost(&self, error: &Error) -> LogError {
        let ended_by = self.ended_by.lock().unwrap_or_else(PoisonError::into_inner);
        match client_error(&self.server, ended_by.as_ref().unwrap_or(error), None) {
            told if told.passes() => told,
            told => away(&self.server, ServerMessage::Lost { reason: told.to_string() }),
        }
    }
}

impl Drop for DatabaseConnection {
    fn drop(&mut self) {
        self.carrier.abort();
    }
}

/// A cell of a row; an error where it has another type.
pub(crate) fn cell<'r, T: FromSql<'r>>(server: &Server, row: &'r Row, place: usize) -> Result<Option<T>, LogError> {
    row.try_get(place).map_err(|error| client_error(server, &error, None))
}
