//! The connection breaks at the end of a transaction, so that its result is unknown: no row is lost or doubled.

use crate::stage::life::{Life, patient};
use crate::stage::proxy::Proxy;
use crate::stage::{Server, kills};
use homebody_log::{Policy, WriteMode};

const FIRINGS: u64 = 6_000;

#[test]
fn transactions_without_an_answer_store_rows_once() {
    let Some((server, database, url)) = Server::with_database("ambiguous") else { return };
    let life = |run| Life { settles: 1, ..Life::new(run, FIRINGS) };
    life(1_000_000).live(&url, Some(&url), Policy::default()).unwrap();
    let undisturbed = server.dumps(&database, 1_000_000);
    let wanted = kills(20);
    let proxy = Proxy::start(&server.socket(), wanted);
    let through = format!("postgresql://postgres@127.0.0.1:{}/{database}?sslmode=disable", proxy.port);
    let mut run = 0;
    while proxy.cut().iter().sum::<usize>() < wanted {
        run += 1;
        life(run).live(&through, Some(&through), patient(30)).unwrap();
        let dumps = server.dumps(&database, run);
        assert_eq!(dumps, undisturbed, "run {run}, cut {:?}", proxy.cut());
    }
    let [before, sent, unheard] = proxy.cut();
    println!(
        "{wanted} cuts in {run} lives: {before} before COMMIT was sent, {sent} as it was, {unheard} with its answer kept back: \
         nothing lost, nothing doubled"
    );
    assert!(wanted < 20 || before > 0 && sent > 0 && unheard > 0, "each kind of cut has come");
}

#[test]
fn rows_that_were_sent_before_their_transaction_ended_are_there_once() {
    let Some((server, database, url)) = Server::with_database("ahead") else { return };
    let life = |run| Life { settles: 60, ..Life::new(run, 12_000) };
    life(1).live(&url, None, Policy::default()).unwrap();
    let undisturbed = server.dump(&database, "public", 1);
    let proxy = Proxy::start(&server.socket(), 4);
    let through = format!("postgresql://postgres@127.0.0.1:{}/{database}?sslmode=disable", proxy.port);
    let mut run = 1;
    while proxy.cut().iter().sum::<usize>() < 4 {
        run += 1;
        life(run).live(&through, None, patient(30)).unwrap();
        assert_eq!(server.dump(&database, "public", run), undisturbed, "run {run}, cut {:?}", proxy.cut());
    }
}

#[test]
fn a_replacement_without_an_answer_happens_once() {
    let Some((server, database, url)) = Server::with_database("replaced") else { return };
    let once = Life { settles: usize::MAX, ..Life::new(7, 500) };
    once.live(&url, Some(&url), Policy::default()).unwrap();
    let before = server.dumps(&database, 7);
    let proxy = Proxy::start(&server.socket(), 6);
    let through = format!("postgresql://postgres@127.0.0.1:{}/{database}?sslmode=disable", proxy.port);
    // All rows go in one transaction, so that old and new count alike.
    for _ in 0..12 {
        Life { how: WriteMode::Overwrite, ..once }.live(&through, Some(&through), patient(30)).unwrap();
        let after = server.dumps(&database, 7);
        assert_eq!(after, before);
    }
    assert_eq!(proxy.cut().iter().sum::<usize>(), 6);
}

/// The wrong way: it writes again what it has not heard of, and keeps how far it has come apart from the rows.
#[test]
fn blind_rewrites_double_rows_and_are_caught() {
    let Some((server, database, url)) = Server::with_database("naive") else { return };
    Life::new(1, 500).live(&url, None, Policy::default()).unwrap();
    let sound = server.dump(&database, "public", 1);
    let again = |key: &str| {
        server.psql(&database, key);
        let lost =
            "INSERT INTO firing SELECT 1, seq, fired_at, sensor, value FROM firing WHERE run_id = 1 AND seq >= 450";
        server.try_psql(&database, lost).is_ok()
    };
    assert!(!again("SELECT 1"), "with its key the table refuses what it has");
    assert!(again("ALTER TABLE firing DROP CONSTRAINT firing_pkey"), "without it nothing does");
    assert_ne!(server.dump(&database, "public", 1), sound, "the dump tells of rows that are there twice");
    let error = Life { how: WriteMode::Resume, ..Life::new(1, 500) }.live(&url, None, Policy::default()).unwrap_err();
    assert!(error.to_string().contains("has no key (run_id, seq)"), "{error}");
}
