//! A destination is unavailable while rows go into a spool on disk: later it gets each row once and in order, and no other destination
//! waits.

use crate::stage::sinks::{Call, Got, sink};
use crate::stage::{self, Folder};
use homebody_core::time::Span;
use homebody_log::destination::Note;
use homebody_log::run_log::destinations;
use homebody_log::table::Batch;
use homebody_log::{Cancel, Destination, LogError, Policy, Sink, Stored, Watermark, WhenDown, WriteMode};
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

const ROWS: u64 = 60_000;

const PLENTY_BYTES: u64 = 64 << 20;

/// A server that is there or away by how often it was asked for anything.
#[derive(Clone)]
struct Server {
    got: Arc<Mutex<Got>>,
    asked: Arc<AtomicUsize>,
    is_away: IsAway,
}

/// Whether it is away, by how often it was asked before.
type IsAway = fn(usize) -> bool;

impl Server {
    fn new(is_away: IsAway) -> Server {
        Server { got: Arc::default(), asked: Arc::default(), is_away }
    }

    fn answers(&self) -> Result<(), LogError> {
        match (self.is_away)(self.asked.fetch_add(1, Ordering::Relaxed)) {
            true => Err(LogError::destination("a server", "it is away").passing()),
            false => Ok(()),
        }
    }

    fn is_whole(&self) -> bool {
        let got = self.got.lock().unwrap();
        got.ended && got.has(ROWS) && got.sensors == BTreeSet::from_iter(stage::sensors())
    }

    fn destination(&self) -> Destination {
        let server = self.clone();
        let answer = move |call, batch: &Batch| {
            server.answers()?;
            Ok(server.got.lock().unwrap().take(call, batch))
        };
        Destination::own("a server", sink(answer), Policy::default())
    }
}

/// Stores a run into a file and a server, with what becomes of it while the server is away.
fn stored(folder: &Folder, server: &Server, when: &WhenDown) -> Result<Stored, LogError> {
    let mut all = destinations(&[folder.url("csv:log.csv")], WriteMode::Overwrite)?;
    all.push(server.destination().when_down(when));
    stage::store(stage::logger(all, WriteMode::Overwrite)?, &stage::firings(ROWS), 1000)
}

fn spool(folder: &Folder, most_bytes: u64) -> WhenDown {
    WhenDown::Spool(folder.path().into(), most_bytes)
}

#[test]
fn a_returning_destination_gets_every_row_once_and_no_spool_is_left() {
    let ways: [(&str, IsAway); 5] = [
        ("in-the-middle", |asked| (3..9).contains(&asked)),
        ("at-the-beginning", |asked| asked < 4),
        ("again-and-again", |asked| asked % 3 == 1),
        ("until-the-end", |asked| (2..12).contains(&asked)),
        ("never", |_| false),
    ];
    for (name, is_away) in ways {
        let (folder, server) = (Folder::new(name), Server::new(is_away));
        let stored = stored(&folder, &server, &spool(&folder, PLENTY_BYTES)).unwrap();
        assert_eq!((stored.rows, server.is_whole()), (ROWS, true), "{name}");
        assert_eq!(folder.files(), ["log.csv"], "{name}");
    }
    // The control: without a spool, the first time away ends the run.
    let (folder, server) = (Folder::new("without"), Server::new(|asked| asked == 3));
    assert!(stored(&folder, &server, &WhenDown::Error).is_err() && !server.is_whole());
}

#[test]
fn a_destination_with_the_beginning_gets_the_rest() {
    let folder = Folder::new("beginning");
    let server = Server::new(|asked| asked < 2);
    server.got.lock().unwrap().rows.extend(0..12_345);
    let stored = stored(&folder, &server, &spool(&folder, PLENTY_BYTES)).unwrap();
    assert_eq!((stored.rows, server.is_whole()), (ROWS, true));
}

/// A destination that counts what it was given since it was begun, and cannot say what it had before.
fn forgetful(got: Arc<Mutex<Got>>) -> impl Sink {
    let mut given = 0;
    sink(move |call, batch| {
        given = if call == Call::Begin { 0 } else { given + batch.len() as u64 };
        got.lock().unwrap().take(call, batch);
        Ok(Watermark(vec![given]))
    })
}

#[test]
fn confirmed_rows_do_not_go_to_a_forgetful_destination_again() {
    let (folder, got) = (Folder::new("forgetful"), Arc::<Mutex<Got>>::default());
    let lived = |rows, how| {
        let own = Destination::own("a pipe", forgetful(got.clone()), Policy::default()).remembered_in(folder.path());
        stage::store(stage::logger(vec![own], how).unwrap(), &stage::firings(rows), 1000).unwrap();
    };
    lived(ROWS / 3, WriteMode::Create);
    lived(ROWS / 2, WriteMode::Resume);
    lived(ROWS, WriteMode::Resume);
    assert!(got.lock().unwrap().has(ROWS));
    // The control: nothing is left out for a run that begins anew.
    lived(ROWS, WriteMode::Create);
    assert_eq!(got.lock().unwrap().rows.len() as u64, 2 * ROWS);
}

#[test]
fn confirmed_rows_stay_noted_while_a_destination_is_away() {
    // It begins, takes and confirms three times, takes once more, and is away from then on.
    let (folder, server, cancel) = (Folder::new("noted"), Server::new(|asked| asked >= 8), Cancel::new());
    let own = server.destination().when_down(&spool(&folder, PLENTY_BYTES)).remembered_in(folder.path());
    let own = Destination { cancel: cancel.clone(), ..own };
    let mut logger = stage::logger(vec![own], WriteMode::Create).unwrap();
    for step in stage::firings(10_000).chunks(1000) {
        logger.store(step, step[step.len() - 1].at + Span::MICROSECOND).unwrap();
        logger.make_durable().unwrap();
        logger.wait_durable().unwrap();
    }
    cancel.cancel();
    assert!(matches!(logger.finish().unwrap().away, Some(LogError::StoppedAway { .. })));
    let note = Note::read(&folder.path().join("a-server.confirmed.json")).unwrap();
    assert_eq!((note.rows, server.got.lock().unwrap().rows.len()), (vec![3000], 4000));
}

#[test]
fn a_full_spool_ends_the_run_and_says_how_to_resume() {
    let (folder, server) = (Folder::new("full"), Server::new(|asked| asked > 2));
    let error = stored(&folder, &server, &spool(&folder, 1 << 20)).unwrap_err();
    assert!(matches!(error, LogError::SpoolFull { most_mb: 1, .. }), "{error}");
    assert!(!folder.files().iter().any(|name| name.ends_with(".spool")), "whoever goes on makes its rows again");
}
