//! PostgreSQL as a destination of logs and truths, and as a source of logs.
//!
//! A [`Postgres`] keeps rows exactly once, whatever fails: a transaction holds rows and the watermark of the run, and after a lost answer
//! the server is asked how the transaction ended. Passwords come from files and the environment alone, and are in no type of this crate.
//!
//! This crate does not know how firings come about, nor what a log means. Reading order:

mod messages;
mod server;
mod password;
mod tls;
mod trouble;
mod connection;

mod rows;
mod schema;
mod runs;
mod sensors;
mod sink;

mod fleet_runs;
mod fleet;

mod source;
mod tables;

mod examine;
mod examined_runs;

pub use fleet::PostgresFleet;
use homebody_core::scenario::scheme::Scheme;
use homebody_log::Policy;
use homebody_log::registry::PlacePlugin;
pub use messages::MESSAGES;
pub use sink::Postgres;
pub use source::FORM;

/// Checks that a URL names a database, without a connection.
///
/// # Errors
///
/// All problems of the URL, without a password.
pub fn understood(url: &str) -> Result<(), homebody_log::LogError> {
    server::Server::parse(url).map(drop)
}

pub const POSTGRESQL: PlacePlugin = PlacePlugin {
    schemes: &[Scheme::Postgresql],
    open: |url| Box::new(Postgres::new(url)),
    fleet: Some(|url| Box::new(PostgresFleet::new(url))),
    policy: Policy::of_server,
    forms: &[FORM],
    tables: Some(tables::read),
    truth_of: Some(tables::truth_of),
    examine: examine::examine,
};
