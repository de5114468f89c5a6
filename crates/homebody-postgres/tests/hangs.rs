//! A server stops answering, by a half-open connection or a locked table, or takes no changes for a while. The run notices it, loses and
//! doubles no row, and ends when it is stopped.

use crate::hanging::{SOON, ended, outlived, stopped};
use crate::stage::Server;
use crate::stage::life::{Life, destination, firings, patient, run};
use crate::stalling::Stalling;
use homebody_log::{Destination, Policy};
use std::os::unix::net::UnixStream;
use std::thread;
use std::time::{Duration, Instant};

const ROWS: u64 = 60_000;

/// A server behind a proxy, and a destination there.
fn behind(server: &Server, database: &str) -> (Stalling, Destination) {
    let socket = server.socket();
    let proxy = Stalling::before(move || UnixStream::connect(&socket));
    let url = format!("postgresql://postgres@127.0.0.1:{}/{database}?sslmode=disable", proxy.port);
    let to = destination(&url, &Policy::of_server());
    (proxy, to)
}

fn counted(server: &Server, database: &str) -> String {
    server.psql(database, "SELECT count(*), count(DISTINCT seq), max(seq) FROM firing")
}

#[test]
fn rows_of_a_half_open_connection_are_spooled_and_stored_once() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("half_open");
    let (proxy, to) = behind(server, &database);
    let rows = outlived(to, run(1), &firings(ROWS), |is_stalled| proxy.stall(is_stalled));
    assert_eq!(counted(server, &database), format!("{rows}|{rows}|{}", rows - 1));
}

#[test]
fn rows_of_a_locked_table_are_spooled_and_stored_once() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("locked");
    let to = destination(&server.url("postgres", &database, ""), &Policy::of_server());
    let locks = "SELECT count(*) FROM pg_locks WHERE mode = 'AccessExclusiveLock' AND granted AND relation = 'firing'::regclass";
    let frees = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE query LIKE 'BEGIN; LOCK TABLE firing%'";
    thread::scope(|scope| {
        let stall = |is_stalled| match is_stalled {
            true => {
                scope.spawn(|| server.try_psql("locked", "BEGIN; LOCK TABLE firing; SELECT pg_sleep(600); COMMIT"));
                let begun = Instant::now();
                while server.psql("locked", locks) != "1" {
                    assert!(begun.elapsed() < SOON, "nobody gets the lock");
                }
            }
            false => drop(server.psql("postgres", frees)),
        };
        let rows = outlived(to, run(1), &firings(ROWS), stall);
        assert_eq!(counted(server, &database), format!("{rows}|{rows}|{}", rows - 1));
    });
}

#[test]
fn a_half_open_connection_ends_a_run_without_retries() {
    let Some(server) = Server::shared() else { return };
    let database = server.database("half_open_error");
    let (proxy, to) = behind(server, &database);
    let (error, took) = ended(to, run(1), &firings(ROWS), |is_stalled| proxy.stall(is_stalled));
    assert!(error.code() == "log::no-answer" && took < SOON / 2, "{took:?}: {error}");
    proxy.stall(false);
    let rows: u64 = server.psql(&database, "SELECT count(*) FROM firing").parse().unwrap();
    assert!(rows < ROWS, "the control: without a spool it lacks rows");
}

#[test]
fn a_stopped_run_does_not_wait_for_a_half_open_connection() {
    let Some(server) = Server::shared() else { return };
    let (proxy, to) = behind(server, &server.database("half_open_stopped"));
    stopped(to, run(1), &firings(ROWS), |is_stalled| proxy.stall(is_stalled));
}

/// As where another server takes over, and does not take changes yet.
#[test]
fn waits_for_a_read_only_server() {
    let Some((server, database, url)) = Server::with_database("read_only") else { return };
    let life = Life { rests: Duration::from_millis(2), settles: 1, ..Life::new(1, 20_000) };
    let read_only = |is_read_only: bool| {
        let sql = format!("ALTER DATABASE {database} SET default_transaction_read_only = {is_read_only}");
        server.psql("postgres", &sql);
        let sql = format!("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = '{database}'");
        server.psql("postgres", &sql);
    };
    let has_begun = || server.try_psql(&database, "SELECT 1 FROM firing LIMIT 1").is_ok_and(|found| found == "1");
    let disturbed = |run: i64, policy: Policy| {
        thread::scope(|scope| {
            let lived = scope.spawn(|| Life { run, ..life }.live(&url, None, policy));
            let begun = Instant::now();
            while !has_begun() {
                assert!(begun.elapsed() < SOON, "nothing is stored");
            }
            read_only(true);
            thread::sleep(Duration::from_secs(2));
            read_only(false);
            lived.join().unwrap()
        })
    };
    disturbed(1, patient(SOON.as_secs())).unwrap();
    assert_eq!(counted(server, &database), "20000|20000|19999");
    server.psql(&database, "DROP TABLE firing, homebody_run");
    let error = disturbed(2, Policy::default()).expect_err("the control: who does not wait ends");
    assert_eq!(error.code(), "postgresql::read-only", "{error}");
}
