//! A connection to a server on which each wait has an end.

use crate::password;
use crate::server::{Host, Server};
use crate::tls;
use crate::trouble::{away, silent, told};
use homebody_log::LogError;
use std::future::Future;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use tokio::runtime::{Builder, Runtime};
use tokio::task::JoinHandle;
use tokio_postgres::{Client, Config, Error};

/// How long a server may take for one thing that it is asked (ours): less than a run waits for a destination.
const ANSWERS_WITHIN: Duration = Duration::from_secs(100);

/// What holds in each connection (ours). Who is cut off in the middle holds nobody up for long, and what is said to be committed is
/// on the server's disk.
const SETTINGS: &str = "SET lock_timeout = '30s'; SET idle_in_transaction_session_timeout = '90s'; SET statement_timeout = 0; \
     SET tcp_keepalives_idle = 10; SET tcp_keepalives_interval = 10; SET tcp_keepalives_count = 3; \
     SELECT set_config('synchronous_commit', 'on', false) WHERE current_setting('synchronous_commit') = 'off'";

/// How long an unanswered packet is sent again (ours).
const UNANSWERED: Duration = Duration::from_secs(30);

/// A connection. After an error that passes it is of no more use.
pub(crate) struct Connection {
    server: Server,
    runtime: Runtime,
    pub client: Client,
    /// Carries what is said in both directions.
    carrier: JoinHandle<()>,
    /// Why the connection is lost, once it is.
    ended_by: Arc<Mutex<Option<Error>>>,
}

impl Connection {
    /// Connects, within the time that the server's URL says.
    pub fn open(server: &Server) -> Result<Connection, LogError> {
        let runtime = Builder::new_current_thread().enable_io().enable_time().build();
        let runtime = runtime.map_err(|error| away(server, format!("the system gives no connection: {error}")))?;
        let found = password::find(server);
        let mut config = Config::new();
        config
            .user(&server.user)
            .dbname(&server.database)
            .port(server.port)
            .ssl_mode(tls::mode(server.tls))
            .application_name(&server.application)
            .connect_timeout(server.connect_within)
            .tcp_user_timeout(UNANSWERED);
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
        let connected = runtime.block_on(async {
            let connecting = async {
                let (client, line) = config.connect(connector).await?;
                let ended = ended_by.clone();
                let carrier = tokio::spawn(async move {
                    *ended.lock().unwrap_or_else(PoisonError::into_inner) = line.await.err();
                });
                client.batch_execute(SETTINGS).await?;
                Ok((client, carrier))
            };
            tokio::time::timeout(server.connect_within, connecting).await
        });
        match connected {
            Ok(Ok((client, carrier))) => Ok(Connection { server: server.clone(), runtime, client, carrier, ended_by }),
            Ok(Err(error)) => Err(told(server, &error, found.ignored.as_deref())),
            Err(_) => Err(silent(server, server.connect_within)),
        }
    }

    /// Waits for what the server says.
    pub fn wait<T>(&self, asked: impl Future<Output = Result<T, Error>>) -> Result<T, LogError> {
        self.wait_for(ANSWERS_WITHIN, asked)
    }

    /// The same, not longer than so.
    pub fn wait_for<T>(&self, longest: Duration, asked: impl Future<Output = Result<T, Error>>) -> Result<T, LogError> {
        let answer = self.runtime.block_on(async { tokio::time::timeout(longest, asked).await });
        match answer {
            Ok(Ok(answer)) => Ok(answer),
            Ok(Err(error)) if error.is_closed() => Err(self.lost(&error)),
            Ok(Err(error)) => Err(told(&self.server, &error, None)),
            Err(_) => Err(silent(&self.server, longest)),
        }
    }

    /// Why the connection is lost, as far as the server has said so.
    fn lost(&self, error: &Error) -> LogError {
        let ended_by = self.ended_by.lock().unwrap_or_else(PoisonError::into_inner);
        match told(&self.server, ended_by.as_ref().unwrap_or(error), None) {
            told if told.passes() => told,
            told => away(&self.server, format!("the connection is lost: {told}")),
        }
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        self.carrier.abort();
    }
}
