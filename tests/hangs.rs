//! A place that stops answering while rows come, for tests of the crates that have such places. They measure when it is noticed, how many
//! rows the others get meanwhile, and how soon a stopped run ends.

use homebody_core::event::Firing;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{RunTime, Span};
use homebody_log::table::Batch;
use homebody_log::{
    Begin, Cancel, Destination, LogError, Logger, Policy, RunInfo, Sink, Watermark, WhenDown, WriteMode,
};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// How long a place may take to answer.
pub const DEADLINE: Duration = Duration::from_secs(1);

/// How long a test waits for something, also on a slow machine.
pub const SOON: Duration = Duration::from_secs(120);

/// Rows of one step, and how many come before the place stops answering.
const STEP: usize = 20;
const BEFORE: u64 = 1000;

/// Rows that the other place gets after it was noticed, before the place answers again.
const BESIDE: u64 = 1000;

/// The size of a spool at most.
const MOST_SPOOLED_BYTES: u64 = 64 << 20;

/// A destination that counts its rows.
struct Counting(Arc<AtomicU64>);

impl Sink for Counting {
    fn begin(&mut self, _: &Begin) -> Result<Watermark, LogError> {
        Ok(Watermark::none())
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.0.fetch_add(batch.len() as u64, Ordering::SeqCst);
        Ok(())
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        Ok(Watermark(vec![self.0.load(Ordering::SeqCst)]))
    }

    fn finish(&mut self, _: RunTime) -> Result<(), LogError> {
        Ok(())
    }
}

/// A logger of two places, with the rows that the second has.
fn open(to: Destination, run: RunInfo) -> Result<(Logger, Arc<AtomicU64>), LogError> {
    let count = Arc::new(AtomicU64::new(0));
    let beside = Destination::own("beside", Counting(count.clone()), Policy::default());
    let logger = Logger::open(vec![to, beside], &LoggerFile::default(), &Arc::new(run), WriteMode::Create)?;
    Ok((logger, count))
}

/// Stores rows at a pace, and has both places make sure of them now and then, as a run does. Ends once `look` says so.
fn live(logger: &mut Logger, firings: &[Firing], mut look: impl FnMut(u64) -> bool) -> Result<u64, LogError> {
    let mut rows = 0;
    for (number, step) in firings.chunks(STEP).enumerate() {
        logger.store(step, step[step.len() - 1].at + Span::MICROSECOND)?;
        rows += step.len() as u64;
        if number % 20 == 19 {
            logger.wait_durable()?;
            logger.make_durable()?;
        }
        if look(rows) {
            break;
        }
        thread::sleep(Duration::from_millis(2));
    }
    Ok(rows)
}

/// Gives rows to a place whose answers `stall(true)` holds back, until that is noticed and the other place has got more rows; then
/// `stall(false)` lets it answer again. Returns the number of all rows.
pub fn outlived(to: Destination, run: RunInfo, firings: &[Firing], mut stall: impl FnMut(bool)) -> u64 {
    let spools = tempfile::tempdir().unwrap();
    let policy = Policy { answers_within: DEADLINE, ..to.policy.clone() };
    let to = Destination { policy, ..to }.when_down(&WhenDown::Spool(spools.path().into(), MOST_SPOOLED_BYTES));
    let meter = to.meter.clone();
    let (mut logger, count) = open(to, run).unwrap();
    let (mut since, mut noticed, mut back) = (None, None, None);
    let rows = live(&mut logger, firings, |rows| {
        let beside = count.load(Ordering::SeqCst);
        match (since, noticed) {
            (None, _) if rows >= BEFORE => {
                stall(true);
                since = Some(Instant::now());
            }
            (Some(since), None) if meter.read().is_away => noticed = Some((Instant::elapsed(&since), beside)),
            (_, Some((_, before))) if beside >= before + BESIDE => back = Some(beside - before),
            _ => {}
        }
        back.is_some()
    });
    let rows = rows.unwrap();
    stall(false);
    logger.finish().unwrap();
    assert_eq!(count.load(Ordering::SeqCst), rows, "the other place has all rows");
    assert_eq!(std::fs::read_dir(spools.path()).unwrap().count(), 0, "no spool is left");
    let (noticed, beside) = (noticed.expect("it was noticed").0, back.expect("the other place got rows meanwhile"));
    println!("noticed after {:.2} s, {beside} of {rows} rows went to the other place meanwhile", noticed.as_secs_f64());
    // A server may report a lock a little before the deadline.
    assert!(noticed >= DEADLINE * 3 / 4 && noticed < SOON, "{noticed:?}");
    rows
}

/// The same without a spool. Returns the error that ends the run, and the time until then.
pub fn ended(to: Destination, run: RunInfo, firings: &[Firing], mut stall: impl FnMut(bool)) -> (LogError, Duration) {
    let policy = Policy { answers_within: DEADLINE, ..to.policy.clone() };
    let (mut logger, _) = open(Destination { policy, ..to }, run).unwrap();
    let mut since = None;
    let lived = live(&mut logger, firings, |rows| {
        if rows >= BEFORE && since.is_none() {
            stall(true);
            since = Some(Instant::now());
        }
        false
    });
    let error = lived.map(drop).and_then(|()| logger.finish().map(drop)).unwrap_err();
    let took = since.unwrap().elapsed();
    println!("ended by an error after {:.2} s: {error}", took.as_secs_f64());
    (error, took)
}

/// Stops a run whose place does not answer, long before its deadline is over: how long the run then takes to end. The other place has
/// all rows.
pub fn stopped(to: Destination, run: RunInfo, firings: &[Firing], mut stall: impl FnMut(bool)) -> Duration {
    let cancel = Cancel::new();
    let policy = Policy { answers_within: SOON, ..to.policy.clone() };
    let (mut logger, count) = open(Destination { policy, cancel: cancel.clone(), ..to }, run).unwrap();
    let mut stops = None;
    let rows = live(&mut logger, firings, |rows| {
        if rows >= BEFORE && stops.is_none() {
            stall(true);
            let cancel = cancel.clone();
            stops = Some(thread::spawn(move || {
                thread::sleep(Duration::from_millis(500));
                cancel.cancel();
                Instant::now()
            }));
        }
        cancel.is_cancelled()
    });
    let rows = rows.unwrap();
    let away = logger.finish().unwrap().away;
    let took = stops.unwrap().join().unwrap().elapsed();
    println!("ended {:.2} s after it was stopped: {}", took.as_secs_f64(), away.as_ref().unwrap());
    assert!(matches!(away, Some(LogError::StoppedAway { .. })), "{away:?}");
    assert_eq!(count.load(Ordering::SeqCst), rows, "the other place has all rows");
    assert!(took < SOON / 4, "{took:?}");
    took
}
