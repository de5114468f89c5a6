//! A thread that sends the events of a fleet to one place. Events wait in a list, which its maker keeps short.

use super::lateness::Lateness;
use crate::error::LogError;
use crate::files::WriteMode;
use crate::policy::{Call, Cancel, Deadline, Job, RetryWait, STOPS_WITHIN, SinkMetrics, TellNews, Timed};
use crate::sink::{Fleet, FleetEvent, FleetSink};
use homebody_core::time::UtcTime;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// The world's clock.
pub type Now = Arc<dyn Fn() -> UtcTime + Send + Sync>;

/// First and longest wait between two attempts (our choice).
const FIRST_WAIT: Duration = Duration::from_millis(100);
const LONGEST_WAIT: Duration = Duration::from_secs(5);

/// Time to wait for an unavailable destination at the end (our choice).
const AT_THE_END: Duration = Duration::from_secs(60);

/// Sends events to one place.
pub struct Teller {
    place: String,
    shared: Arc<SharedState>,
    thread: Option<JoinHandle<Result<(), LogError>>>,
    meter: Arc<SinkMetrics>,
}

/// The wait for a place that is away.
#[derive(Clone, Default)]
pub struct Patience {
    /// For how long.
    pub retry_for: Duration,
    /// The time for an answer of a server, or of the reader of standard output; None for ten seconds.
    pub answers_within: Option<Duration>,
    /// Ends the wait early.
    pub cancel: Cancel,
    /// Gets the news of it.
    pub tell: Option<TellNews>,
}

#[derive(Default)]
struct SharedState {
    state: Mutex<TellerState>,
    changed: Condvar,
}

#[derive(Default)]
struct TellerState {
    waiting: Vec<FleetEvent>,
    /// The number of events that are being sent, and the time at which the first was due.
    in_hand: usize,
    oldest_in_hand: Option<UtcTime>,
    /// When the fleet has ended, and since when that is known.
    ended: Option<(UtcTime, Instant)>,
    is_given_up: bool,
    /// From when on lateness counts.
    counts_from: Option<UtcTime>,
    /// Since this was looked at last.
    since: Since,
}

/// The events that a place got in a while.
#[derive(Clone, Debug, Default)]
pub struct Since {
    /// Rows, those too that were due before the fleet began to tell.
    pub rows: u64,
    /// The lateness of the others.
    pub lateness: Lateness,
}

impl SharedState {
    fn lock(&self) -> MutexGuard<'_, TellerState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Teller {
    /// Begins a place, and then a thread that tells it. Something that fails and [passes](LogError::passes) is tried again as long as
    /// there is patience.
    ///
    /// # Errors
    ///
    /// The place cannot be begun.
    pub fn begin(
        place: String,
        sink: Box<dyn FleetSink>,
        (fleet, how): (&Arc<Fleet>, WriteMode),
        patience: &Patience,
        now: &Now,
    ) -> Result<Teller, LogError> {
        let (meter, shared) = (Arc::new(SinkMetrics::default()), Arc::new(SharedState::default()));
        if let Some(tell) = patience.tell.clone() {
            meter.telling(tell);
        }
        let calls =
            Calls { place: place.clone(), shared: shared.clone(), meter: meter.clone(), patience: patience.clone() };
        let (within, stops_within) = match sink.is_file() {
            true => (Deadline::OF_FILES, Deadline::OF_FILES),
            false => (patience.answers_within.unwrap_or(Deadline::OF_SERVERS), STOPS_WITHIN),
        };
        let (deadline, most_at_once) = (Deadline::new(within), sink.most_at_once().max(1));
        let mut sink: TimedFleetSink = Timed::new(place.clone(), sink, stops_within, meter.clone());
        sink.keep_to(&deadline, &patience.cancel);
        let begins = || -> Job<dyn FleetSink, Vec<u64>> {
            let (fleet, deadline) = (fleet.clone(), deadline.clone());
            Box::new(move |sink| sink.begin(&fleet, how, &deadline))
        };
        let there = calls.call(|| sink.ask(Call::Begin, begins))?;
        let work = TellerWork { sink, most_at_once, calls, there, now: now.clone() };
        let thread = thread::Builder::new().spawn(move || work.run());
        let thread = thread.map_err(|source| LogError::NoThread { place: place.clone(), source })?;
        Ok(Teller { place, shared, thread: Some(thread), meter })
    }

    /// The name of the place in errors.
    pub fn place(&self) -> &str {
        &self.place
    }

    /// The metrics of the place.
    pub fn meter(&self) -> &Arc<SinkMetrics> {
        &self.meter
    }

    /// Lateness counts from this instant on: what is due before it is what the fleet catches up with.
    pub fn count_from(&self, instant: UtcTime) {
        self.shared.lock().counts_from = Some(instant);
    }

    /// Has the place told this, after all that waits already.
    pub fn tell(&self, told: &[FleetEvent]) {
        self.shared.lock().waiting.extend_from_slice(told);
        self.shared.changed.notify_all();
    }

    /// The number of waiting events.
    pub fn waiting(&self) -> usize {
        let state = self.shared.lock();
        state.waiting.len() + state.in_hand
    }

    /// Since when that is due which waits the longest.
    pub fn oldest_due(&self) -> Option<UtcTime> {
        let state = self.shared.lock();
        state.oldest_in_hand.or_else(|| first_due(&state.waiting))
    }

    /// The events since the last call.
    pub fn since(&self) -> Since {
        std::mem::take(&mut self.shared.lock().since)
    }

    /// Reports the error that has ended it.
    ///
    /// # Errors
    ///
    /// That one.
    pub fn check(&mut self) -> Result<(), LogError> {
        match &self.thread {
            Some(thread) if !thread.is_finished() => Ok(()),
            _ => self.join(),
        }
    }

    /// Has the place told what still waits, and that the fleet has ended then.
    ///
    /// # Errors
    ///
    /// The place failed, or was away for a minute, or did not answer a fleet that was stopped.
    pub fn finish(&mut self, end: UtcTime) -> Result<(), LogError> {
        self.shared.lock().ended = Some((end, Instant::now()));
        self.shared.changed.notify_all();
        self.join()
    }

    fn join(&mut self) -> Result<(), LogError> {
        match self.thread.take() {
            Some(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            None => Err(LogError::Stopped { place: self.place.clone() }),
        }
    }
}

impl Drop for Teller {
    fn drop(&mut self) {
        self.shared.lock().is_given_up = true;
        self.shared.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// A place with a deadline. Its answer counts the rows that it holds, by home.
type TimedFleetSink = Timed<dyn FleetSink, Vec<u64>>;

struct TellerWork {
    sink: TimedFleetSink,
    most_at_once: usize,
    calls: Calls,
    /// By home, the number of rows that the place holds already.
    there: Vec<u64>,
    now: Now,
}

impl TellerWork {
    fn run(mut self) -> Result<(), LogError> {
        loop {
            let (told, ended) = {
                let shared = &self.calls.shared;
                let mut state = shared.lock();
                while state.waiting.is_empty() && state.ended.is_none() && !state.is_given_up {
                    state = shared.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
                }
                if state.is_given_up {
                    return Ok(());
                }
                let told = std::mem::take(&mut state.waiting);
                state.in_hand = told.len();
                (told, state.ended)
            };
            for told in told.chunks(self.most_at_once) {
                self.tell(told)?;
            }
            if let (true, Some((end, _))) = (told.is_empty(), ended) {
                let TellerWork { sink, calls, .. } = &mut self;
                let finishes = || -> Job<dyn FleetSink, Vec<u64>> { Box::new(move |sink| done(sink.finish(end))) };
                return calls.call(|| sink.ask(Call::Finish, finishes)).map(drop);
            }
        }
    }

    fn tell(&mut self, told: &[FleetEvent]) -> Result<(), LogError> {
        let TellerWork { sink, calls, there, now, .. } = self;
        let Calls { shared, meter, .. } = &*calls;
        shared.lock().oldest_in_hand = first_due(told);
        let is_new = |told: &&FleetEvent| match told {
            FleetEvent::Row(row) => row.seq >= there[row.home as usize],
            FleetEvent::Comes(_) | FleetEvent::Goes(_) => true,
        };
        let new: Vec<FleetEvent> = told.iter().filter(is_new).copied().collect();
        if !new.is_empty() {
            let tells = || -> Job<dyn FleetSink, Vec<u64>> {
                let new = new.clone();
                Box::new(move |sink| done(sink.tell(&new)))
            };
            calls.call(|| sink.ask(Call::Write, tells))?;
        }
        let now = now();
        let mut state = shared.lock();
        let mut rows = 0;
        for told in &new {
            let FleetEvent::Row(row) = told else { continue };
            rows += 1;
            if state.counts_from.is_some_and(|from| row.due >= from) {
                state.since.lateness.add(now - row.due);
            }
        }
        state.since.rows += rows;
        state.in_hand = state.in_hand.saturating_sub(told.len());
        state.oldest_in_hand = None;
        meter.took_rows(rows);
        Ok(())
    }
}

/// The answer of a call that has none but that it is done.
fn done(done: Result<(), LogError>) -> Result<Vec<u64>, LogError> {
    done.map(|()| Vec::new())
}

fn first_due(told: &[FleetEvent]) -> Option<UtcTime> {
    told.iter().find_map(|told| if let FleetEvent::Row(row) = told { Some(row.due) } else { None })
}

/// Calls of a place, each made again while the place is away and there is patience.
struct Calls {
    place: String,
    shared: Arc<SharedState>,
    meter: Arc<SinkMetrics>,
    patience: Patience,
}

impl Calls {
    fn call<T>(&self, call: impl FnMut() -> Result<T, LogError>) -> Result<T, LogError> {
        let Calls { place, shared, meter, patience } = self;
        let Patience { retry_for, cancel, .. } = patience;
        let at_the_end = AT_THE_END.min(*retry_for);
        let is_over = || {
            let state = shared.lock();
            state.is_given_up || state.ended.is_some_and(|(_, since)| since.elapsed() > at_the_end)
        };
        let (retry_for, first, longest) = (*retry_for, FIRST_WAIT, LONGEST_WAIT);
        RetryWait { place, meter, cancel, retry_for, first, longest }.call(is_over, call)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sink::fleet::FleetRow;
    use homebody_core::event::Value;
    use homebody_core::ids::SensorId;
    use homebody_core::time::RunTime;
    use std::sync::atomic::{AtomicI64, Ordering};

    /// A place that takes a while by the fake clock for each call, and is away for the first ones.
    struct Slow {
        clock: Arc<AtomicI64>,
        takes_us: i64,
        away: u32,
        told: Arc<Mutex<Vec<FleetEvent>>>,
    }

    impl FleetSink for Slow {
        fn begin(&mut self, _: &Arc<Fleet>, _: WriteMode, _: &Deadline) -> Result<Vec<u64>, LogError> {
            Ok(vec![2, 0])
        }

        fn tell(&mut self, told: &[FleetEvent]) -> Result<(), LogError> {
            self.clock.fetch_add(self.takes_us, Ordering::SeqCst);
            if self.away > 0 {
                self.away -= 1;
                return Err(LogError::destination("there", "it is away").passing());
            }
            self.told.lock().unwrap().extend_from_slice(told);
            Ok(())
        }

        fn finish(&mut self, _: UtcTime) -> Result<(), LogError> {
            Ok(())
        }
    }

    fn at(micros: i64) -> UtcTime {
        UtcTime::from_micros(micros)
    }

    fn row(home: u32, seq: u64, due: i64) -> FleetEvent {
        FleetEvent::Row(FleetRow {
            seq,
            at: RunTime::START,
            due: at(due),
            home,
            sensor: SensorId(0),
            value: Value::Fire,
        })
    }

    fn teller(takes_us: i64, away: u32, retry_for: Duration) -> (Teller, Arc<Mutex<Vec<FleetEvent>>>) {
        let (clock, told) = (Arc::new(AtomicI64::new(1_000_000)), Arc::new(Mutex::new(Vec::new())));
        let sink = Slow { clock: clock.clone(), takes_us, away, told: told.clone() };
        let fleet = Arc::new(Fleet { first: 1, layouts: Vec::new(), homes: Vec::new() });
        let now: Now = Arc::new(move || at(clock.load(Ordering::SeqCst)));
        let patience = Patience { retry_for, ..Patience::default() };
        let teller =
            Teller::begin("there".into(), Box::new(sink), (&fleet, WriteMode::Create), &patience, &now).unwrap();
        teller.count_from(at(1_000_000));
        (teller, told)
    }

    #[test]
    fn lateness_is_from_when_a_row_is_due_to_when_the_place_has_it() {
        let (mut teller, told) = teller(30_000, 0, Duration::ZERO);
        // Of home 0 two rows are there; one is from before the fleet began.
        teller.tell(&[row(0, 1, 1_000_000), row(1, 0, 900_000), row(0, 2, 1_010_000), FleetEvent::Goes(1)]);
        teller.finish(at(2_000_000)).unwrap();
        assert_eq!(*told.lock().unwrap(), [row(1, 0, 900_000), row(0, 2, 1_010_000), FleetEvent::Goes(1)]);
        let since = teller.since();
        assert_eq!((since.rows, since.lateness.count(), since.lateness.most_us()), (2, 1, 20_000));
        assert_eq!((teller.since().rows, teller.waiting(), teller.meter().read().rows), (0, 0, 2));
    }

    #[test]
    fn waiting_events_are_late_and_sent_once() {
        let (mut teller, told) = teller(50_000, 2, Duration::from_secs(60));
        teller.tell(&[row(1, 0, 1_000_000)]);
        teller.finish(at(2_000_000)).unwrap();
        assert_eq!(told.lock().unwrap().len(), 1);
        assert_eq!((teller.since().lateness.most_us(), teller.meter().read().retries), (150_000, 2));
    }

    #[test]
    fn an_absent_place_without_retries_ends_it() {
        let (mut teller, told) = teller(0, 1, Duration::ZERO);
        teller.tell(&[row(1, 0, 1_000_000)]);
        assert!(teller.finish(at(2_000_000)).is_err() && told.lock().unwrap().is_empty());
    }
}
