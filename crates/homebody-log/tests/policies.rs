//! Destinations in code: the effect on a run when one of them fails, hangs, is full or returns.

use crate::alone::is_alone;
use crate::stage::sinks::{Call, Got, sink};
use crate::stage::{self, Folder};
use homebody_core::scenario::logger::LoggerFile;
use homebody_log::run_log::destinations;
use homebody_log::{Cancel, Destination, LogError, Policy, Sink, Stored, Watermark, WriteMode};
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// The reaction of a destination to its n-th batch, or, for 0, to its beginning.
type Deed = fn(usize) -> Result<(), LogError>;

/// A destination that does so and keeps what it gets.
fn own(got: Arc<Mutex<Got>>, deed: Deed) -> impl Sink {
    let mut batches = 0;
    sink(move |call, batch| {
        batches += usize::from(call == Call::Write);
        if matches!(call, Call::Begin | Call::Write) {
            deed(batches)?;
        }
        Ok(got.lock().unwrap().take(call, batch))
    })
}

/// Tries again soon, and for longer than any test takes.
fn patient() -> Policy {
    Policy { retry_for: Duration::from_secs(60), retry_after: Duration::from_millis(2), ..Policy::default() }
}

const ROWS: u64 = 60_000;

/// Stores a run into a file and a destination that does so.
fn stored(name: &str, deed: Deed, policy: Policy) -> (Folder, Arc<Mutex<Got>>, Result<Stored, LogError>) {
    let folder = Folder::new(name);
    let got = Arc::new(Mutex::new(Got::default()));
    let mut all = destinations(&[folder.url("csv:log.csv")], WriteMode::Create).unwrap();
    all.push(Destination::own("a broker", own(got.clone(), deed), policy));
    let logger = stage::logger(all, WriteMode::Create);
    let stored = logger.and_then(|logger| stage::store(logger, &stage::firings(ROWS), 1000));
    (folder, got, stored)
}

fn lines(folder: &Folder) -> u64 {
    folder.text("log.csv").lines().count() as u64 - 1
}

fn is_whole(got: &Mutex<Got>) -> bool {
    let got = got.lock().unwrap();
    got.ended && got.has(ROWS) && got.sensors == BTreeSet::from_iter(stage::sensors())
}

/// Fails at its third batch.
fn full(batch: usize) -> Result<(), LogError> {
    if batch == 3 { Err(LogError::destination("a broker", "it is full")) } else { Ok(()) }
}

/// Is away twice, and comes back.
fn away(batch: usize) -> Result<(), LogError> {
    if (3..5).contains(&batch) { Err(LogError::destination("a broker", "it is away").passing()) } else { Ok(()) }
}

fn hangs(batch: usize) -> Result<(), LogError> {
    hangs_at(3, batch)
}

fn hangs_at_the_beginning(batch: usize) -> Result<(), LogError> {
    hangs_at(0, batch)
}

fn hangs_at(which: usize, batch: usize) -> Result<(), LogError> {
    if batch == which {
        thread::sleep(Duration::from_secs(3600));
    }
    Ok(())
}

/// Is away at its first beginning, and there at the second.
fn late(batch: usize) -> Result<(), LogError> {
    static BEGUN: AtomicUsize = AtomicUsize::new(0);
    if batch == 0 && BEGUN.fetch_add(1, Ordering::Relaxed) == 0 {
        return Err(LogError::destination("a broker", "it is away").passing());
    }
    Ok(())
}

#[test]
fn a_destination_of_ones_own_gets_every_row() {
    let (folder, got, stored) = stored("own", |_| Ok(()), Policy::default());
    let stored = stored.unwrap();
    assert_eq!((stored.rows, lines(&folder), is_whole(&got)), (ROWS, ROWS, true));
    assert_eq!(stored.places.last().unwrap(), "a broker");
}

#[test]
fn a_failing_required_destination_ends_the_run() {
    let (folder, _, stored) = stored("required", full, Policy::default());
    let error = stored.unwrap_err();
    assert!(error.to_string().contains("a broker") && error.to_string().contains("it is full"), "{error}");
    assert!(folder.files().is_empty(), "a text file is whole or not there");
}

#[test]
fn a_failing_optional_destination_stops_no_other() {
    let (folder, got, stored) = stored("optional", full, Policy::optional());
    let stored = stored.unwrap();
    assert_eq!((stored.rows, lines(&folder), is_whole(&got)), (ROWS, ROWS, false));
    let [(place, error)] = &stored.failed[..] else { panic!("one failed") };
    assert!(place == "a broker" && error.to_string().contains("it is full"), "{error}");
    assert!(!stored.places.iter().any(|place| place == "a broker"));
}

#[test]
fn a_recovered_destination_gets_every_row_once() {
    let (folder, got, stored) = stored("back", away, patient());
    assert_eq!((stored.unwrap().rows, lines(&folder), is_whole(&got)), (ROWS, ROWS, true));
    // The control: without the policy there are no retries.
    let (_, got, stored) = self::stored("not-back", away, Policy::default());
    assert!(stored.is_err() && !is_whole(&got));
}

#[test]
fn an_absent_destination_is_begun_again() {
    let (folder, got, stored) = stored("late", late, patient());
    assert_eq!((stored.unwrap().rows, lines(&folder), is_whole(&got)), (ROWS, ROWS, true));
}

/// Both of one name: only the one that fails is left behind.
#[test]
fn drops_the_right_one_of_two_destinations_with_one_name() {
    let folder = Folder::new("one-name");
    let own = |deed: Deed, policy| Destination::own("a broker", own(Arc::default(), deed), policy);
    let all = vec![
        own(|_| Ok(()), Policy::default()),
        own(full, Policy::optional()),
        Destination::new(&folder.url("csv:log.csv")),
    ];
    let stored = stage::store(stage::logger(all, WriteMode::Create).unwrap(), &stage::firings(ROWS), 1000).unwrap();
    assert_eq!((stored.places.len(), stored.places[0].as_str(), stored.failed.len()), (2, "a broker", 1));
}

#[test]
fn a_run_waits_once_for_a_hanging_destination() {
    let within = Duration::from_secs(8);
    thread::scope(|scope| {
        for (name, required, deed) in [
            ("hangs-required", true, hangs as Deed),
            ("hangs-optional", false, hangs),
            ("begin-hangs-required", true, hangs_at_the_beginning),
            ("begin-hangs-optional", false, hangs_at_the_beginning),
        ] {
            scope.spawn(move || {
                let begun = Instant::now();
                let policy = Policy { answers_within: within, required, ..Policy::default() };
                let (folder, _, stored) = stored(name, deed, policy);
                // Two waits, for the run and at its end, would have taken twice as long.
                let took = begun.elapsed();
                assert!(took >= within && took < 2 * within, "{name}: {took:?}");
                if required {
                    assert!(matches!(stored.unwrap_err(), LogError::Hangs { .. }));
                } else {
                    let stored = stored.unwrap();
                    assert_eq!((lines(&folder), stored.failed.len()), (ROWS, 1));
                    assert!(matches!(stored.failed[0].1, LogError::Hangs { .. }));
                }
            });
        }
    });
}

/// Is away from its third batch on, which it says at once and then only after a long time.
fn away_and_slow_to_say_so(batch: usize) -> Result<(), LogError> {
    match batch {
        0..3 => Ok(()),
        3 => Err(LogError::destination("a broker", "nobody listens").passing()),
        _ => hangs_at(batch, batch),
    }
}

#[test]
fn a_stopped_run_does_not_wait_for_an_absent_destination() {
    let always = |batch: usize| away(batch.min(3));
    for (name, deed) in [("stopped", always as Deed), ("stopped-slow", away_and_slow_to_say_so)] {
        let (folder, cancel, told) = (Folder::new(name), Cancel::new(), Arc::new(Mutex::new(Vec::new())));
        let to = Destination::own("a broker", own(Arc::default(), deed), patient());
        let to = Destination { cancel: cancel.clone(), ..to };
        let heard = told.clone();
        to.meter.telling(Arc::new(move |news| heard.lock().unwrap().push(news.to_string())));
        let meter = to.meter.clone();
        let mut all = destinations(&[folder.url("csv:log.csv")], WriteMode::Create).unwrap();
        all.insert(0, to);
        let logger = stage::logger(all, WriteMode::Create).unwrap();
        let stops = thread::spawn(move || {
            while !meter.read().is_away {
                thread::sleep(Duration::from_millis(5));
            }
            thread::sleep(Duration::from_millis(100));
            cancel.cancel();
            Instant::now()
        });
        let stored = stage::store(logger, &stage::firings(ROWS), 1000).unwrap();
        let took = stops.join().unwrap().elapsed();
        assert!(took < Duration::from_secs(60), "{name}: {took:?}");
        assert!(matches!(&stored.away, Some(LogError::StoppedAway { place, .. }) if place == "a broker"));
        let told = told.lock().unwrap();
        assert!(told.len() == 1 && told[0].starts_with("warning: a broker is unavailable: "), "{told:?}");
        assert_eq!((stored.rows, lines(&folder)), (ROWS, ROWS), "the others have all of it");
    }
}

/// No machine has room for a stack of this size, so the process gets no further thread.
#[test]
fn reports_that_no_thread_can_be_started() {
    let stack_bytes = (1_u64 << 46).to_string();
    if is_alone("policies::reports_that_no_thread_can_be_started", &[("RUST_MIN_STACK", &stack_bytes)]) {
        let folder = Folder::new("no-thread");
        let error = stage::open(&[folder.url("csv:log.csv")], &LoggerFile::default(), false).err().unwrap();
        assert!(matches!(error, LogError::NoThread { .. }), "{error}");
        assert!(folder.files().is_empty());
    }
}

#[test]
fn reports_a_destination_with_more_rows_than_the_run() {
    let stored = |rows: u64, policy: Policy| {
        // It has so many rows of the run already, as a note of what was confirmed says.
        let to = Destination::own("a broker", sink(move |_, _| Ok(Watermark(vec![rows]))), policy);
        let logger = stage::logger(vec![to], WriteMode::Resume).unwrap();
        stage::store(logger, &stage::firings(1000), 100)
    };
    let error = stored(1007, Policy::default()).unwrap_err();
    assert!(matches!(&error, LogError::Changed(reason) if reason.place == "a broker"), "{error}");
    assert!(error.to_string().contains("7 more rows"), "{error}");
    let failed = stored(1007, Policy::optional()).unwrap().failed;
    assert!(failed.len() == 1 && failed[0].0 == "a broker", "{failed:?}");
    // The control: one that has all of it, or less, is fine.
    assert!(stored(1000, Policy::default()).is_ok() && stored(10, Policy::default()).is_ok());
}
