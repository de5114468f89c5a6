//! A destination that stops answering counts as away once its deadline is over. It gets each row once when it answers again, and no run
//! waits for it at its end.

use crate::hanging::{DEADLINE, SOON, ended, outlived, stopped};
use crate::stage;
use crate::stage::sinks::{Call, Got, sink};
use homebody_core::time::Span;
use homebody_log::table::Batch;
use homebody_log::{Destination, LogError, Policy, WhenDown, WriteMode};
use std::sync::{Arc, Condvar, Mutex};
use std::thread;
use std::time::{Duration, Instant};

const ROWS: u64 = 60_000;

/// A server that does not answer such a call while it is held.
#[derive(Clone)]
struct Server {
    got: Arc<Mutex<Got>>,
    held: Arc<(Mutex<bool>, Condvar)>,
    hangs_in: Call,
    /// Whether a call that has hung is lost with its connection, or done late.
    loses: bool,
}

impl Server {
    fn new(hangs_in: Call, loses: bool) -> Server {
        Server { got: Arc::default(), held: Arc::default(), hangs_in, loses }
    }

    fn hold(&self, is_held: bool) {
        *self.held.0.lock().unwrap() = is_held;
        self.held.1.notify_all();
    }

    fn answers(&self, call: Call) -> Result<(), LogError> {
        let held = self.held.0.lock().unwrap();
        if call != self.hangs_in || !*held {
            return Ok(());
        }
        let _free = self.held.1.wait_timeout_while(held, 2 * SOON, |held| *held).unwrap();
        match self.loses {
            true => Err(LogError::destination("a server", "the connection is lost").passing()),
            false => Ok(()),
        }
    }

    fn destination(&self) -> Destination {
        let server = self.clone();
        let answer = move |call, batch: &Batch| {
            server.answers(call)?;
            Ok(server.got.lock().unwrap().take(call, batch))
        };
        Destination::own("a server", sink(answer), Policy::of_server())
    }

    fn has(&self, rows: u64) -> bool {
        self.got.lock().unwrap().has(rows)
    }
}

#[test]
fn rows_of_a_hanging_destination_are_spooled_and_others_continue() {
    for (call, loses) in
        [(Call::Write, false), (Call::Write, true), (Call::MakeDurable, false), (Call::MakeDurable, true)]
    {
        let server = Server::new(call, loses);
        let rows = outlived(server.destination(), stage::run(), &stage::firings(ROWS), |held| server.hold(held));
        assert!(server.has(rows), "{call:?}: each row is there once, in its order");
    }
}

#[test]
fn a_hanging_destination_ends_a_run_without_retries() {
    let server = Server::new(Call::Write, false);
    let (error, took) = ended(server.destination(), stage::run(), &stage::firings(ROWS), |held| server.hold(held));
    assert!(matches!(error, LogError::Hangs { seconds: 1, .. }), "{error}");
    assert!((DEADLINE..SOON / 2).contains(&took), "{took:?}");
    // The run has ended before the server answers.
    server.hold(false);
    assert!(!server.has(ROWS), "the control: without a spool it lacks rows");
}

/// The same call gets the answer, at the beginning and at the end, and no row comes twice.
#[test]
fn a_run_with_retries_waits_for_a_late_answer() {
    for (call, loses) in [Call::Begin, Call::Write, Call::MakeDurable, Call::Finish]
        .map(|call| [(call, false), (call, true)])
        .as_flattened()
    {
        let server = Server::new(*call, *loses);
        let policy = Policy { answers_within: Duration::from_millis(200), ..Policy::of_server() };
        let to = Destination { policy, ..server.destination() }.when_down(&WhenDown::Retry(SOON));
        let meter = to.meter.clone();
        server.hold(true);
        let (free, begun) = (server.clone(), Instant::now());
        let freed = thread::spawn(move || {
            while meter.read().retries < 2 {
                assert!(begun.elapsed() < SOON, "nobody retries");
                thread::sleep(Duration::from_millis(10));
            }
            free.hold(false);
        });
        let mut logger = stage::logger(vec![to], WriteMode::Create).unwrap();
        for step in stage::firings(10_000).chunks(1000) {
            logger.store(step, step[step.len() - 1].at + Span::MICROSECOND).unwrap();
            logger.make_durable().unwrap();
        }
        let stored = logger.finish().unwrap();
        freed.join().unwrap();
        assert!(stored.rows == 10_000 && server.has(10_000), "{call:?}, lost {loses}");
    }
}

#[test]
fn a_stopped_run_does_not_wait_for_a_hanging_destination() {
    for call in [Call::Write, Call::MakeDurable, Call::Finish] {
        let server = Server::new(call, false);
        stopped(server.destination(), stage::run(), &stage::firings(ROWS), |held| server.hold(held));
    }
    // The control: one that may take its time is waited for.
    let server = Server::new(Call::MakeDurable, false);
    let to = server.destination();
    let to = Destination { policy: Policy { stops_within: Duration::from_secs(4), ..to.policy.clone() }, ..to };
    let took = stopped(to, stage::run(), &stage::firings(ROWS), |held| server.hold(held));
    assert!(took >= Duration::from_secs(4), "{took:?}");
}
