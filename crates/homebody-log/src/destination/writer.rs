//! A thread that writes batches to one destination, so that what makes them need not wait for a disk or a network.
//!
//! Batches come through a bounded queue: when the destination is the slower, the maker waits for it, and memory stays
//! small. The destination's deadline ends each of its calls, so the thread always comes back. An error ends the thread; it comes out of
//! the next call to the writer.

use super::Destination;
use crate::error::{ChangedMessage, LogError};
use crate::files::WriteMode;
use crate::policy::{Cancel, Deadline, Policy, RetryWait, SinkMetrics};
use crate::sink::{Begin, Sink, Watermark};
use crate::table::Batch;
use homebody_core::time::RunTime;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Rows of one batch (our choice, as the values below).
pub(crate) const BATCH: usize = 4096;

/// The wait of rows for a full batch. A viewer of a run sees them so much later.
pub(crate) const BATCH_WAITS: Duration = Duration::from_millis(100);

/// The time after which rows become durable without new rows or requests.
const IDLE: Duration = Duration::from_secs(1);

/// The interval of checks of a thread that makes rows durable.
const LOOK: Duration = Duration::from_micros(200);

/// A destination in a thread of its own.
pub(crate) struct Writer {
    place: String,
    policy: Policy,
    messages: Option<SyncSender<WriterMessage>>,
    thread: Option<JoinHandle<Result<(), LogError>>>,
    shared: Arc<WriterShared>,
    meter: Arc<SinkMetrics>,
    /// The number of requests to make rows durable.
    asked: u64,
}

#[derive(Default)]
struct WriterShared {
    /// The number of answered requests to make rows durable.
    settled: AtomicU64,
    /// The number of the rows to come that the destination has already.
    there: AtomicU64,
    is_given_up: AtomicBool,
    durable: Mutex<Watermark>,
}

enum WriterMessage {
    Rows(Arc<Batch>),
    MakeDurable,
    Finish(RunTime),
}

impl Writer {
    /// Begins the sink in a thread of its own, and waits until it has begun: an error then comes from this call.
    pub fn spawn(destination: Destination, beginning: &Begin) -> Result<Writer, LogError> {
        let (place, policy) = (destination.place.clone(), destination.policy.clone());
        let (meter, cancel) = (destination.meter.clone(), destination.cancel.clone());
        let deadline = Deadline::new(policy.answers_within);
        let how = destination.how.filter(|_| beginning.how != WriteMode::Resume).unwrap_or(beginning.how);
        let beginning = Begin { how, cancel: cancel.clone(), deadline, ..beginning.clone() };
        let (messages, incoming) = sync_channel(policy.batches_waiting);
        let (begun, begins) = sync_channel(1);
        let shared = Arc::new(WriterShared::default());
        let work = WriterWork {
            place: place.clone(),
            sink: destination.into_sink(),
            policy: policy.clone(),
            shared: shared.clone(),
            meter: meter.clone(),
            cancel,
            there: Vec::new(),
        };
        let thread = thread::Builder::new().spawn(move || work.run(&beginning, &begun, incoming));
        let thread = thread.map_err(|source| LogError::NoThread { place: place.clone(), source })?;
        let (messages, thread) = (Some(messages), Some(thread));
        let mut writer = Writer { place, policy, messages, thread, shared, meter, asked: 0 };
        match begins.recv() {
            Ok(()) => Ok(writer),
            // The thread has ended.
            Err(_) => {
                writer.join()?;
                Err(LogError::Stopped { place: writer.place.clone() })
            }
        }
    }

    pub fn place(&self) -> &str {
        &self.place
    }

    pub fn meter(&self) -> (String, Arc<SinkMetrics>) {
        (self.place.clone(), self.meter.clone())
    }

    /// Whether its error ends the run.
    pub fn is_required(&self) -> bool {
        self.policy.required
    }

    pub fn durable(&self) -> Watermark {
        self.shared.durable.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Whether the run is past all rows that the destination had at its beginning.
    pub fn is_past_replayed_part(&self) -> bool {
        self.shared.there.load(Ordering::Acquire) == 0
    }

    /// Hands over rows; the thread's error, if it has ended by one.
    pub fn send(&mut self, batch: Arc<Batch>) -> Result<(), LogError> {
        self.pass(WriterMessage::Rows(batch))
    }

    /// Has it make sure of all rows that were handed over before. Nobody waits for that here.
    pub fn make_durable(&mut self) -> Result<(), LogError> {
        self.asked += 1;
        self.pass(WriterMessage::MakeDurable)
    }

    /// Waits until all requests to make rows durable are answered.
    pub fn wait_durable(&mut self) -> Result<(), LogError> {
        let asked = self.asked;
        while self.shared.settled.load(Ordering::Acquire) < asked
            && self.thread.as_ref().is_some_and(|thread| !thread.is_finished())
        {
            thread::sleep(LOOK);
        }
        self.check()
    }

    /// The thread's error, if it has ended by one.
    pub fn check(&mut self) -> Result<(), LogError> {
        match &self.thread {
            Some(thread) if !thread.is_finished() => Ok(()),
            _ => self.join(),
        }
    }

    /// Waits until all rows are safe and the run is marked as ended.
    pub fn finish(mut self, end: RunTime) -> Result<(), LogError> {
        self.pass(WriterMessage::Finish(end))?;
        self.join()
    }

    fn pass(&mut self, message: WriterMessage) -> Result<(), LogError> {
        match self.messages.as_ref().map(|messages| messages.send(message)) {
            Some(Ok(())) => Ok(()),
            Some(Err(_)) | None => self.join(),
        }
    }

    fn join(&mut self) -> Result<(), LogError> {
        self.messages = None;
        match self.thread.take() {
            Some(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            None => Err(LogError::Stopped { place: self.place.clone() }),
        }
    }
}

impl Drop for Writer {
    /// Waits for the thread, so that nothing writes on after the run has been given up. It does not wait long for a destination that hangs.
    fn drop(&mut self) {
        self.messages = None;
        self.shared.is_given_up.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

struct WriterWork {
    place: String,
    sink: Box<dyn Sink>,
    policy: Policy,
    shared: Arc<WriterShared>,
    meter: Arc<SinkMetrics>,
    cancel: Cancel,
    /// By table, how many of the rows to come the destination has already.
    there: Vec<u64>,
}

impl WriterWork {
    /// The thread's life: begins the sink, says so, and writes what comes.
    fn run(
        mut self,
        beginning: &Begin,
        begun: &SyncSender<()>,
        incoming: Receiver<WriterMessage>,
    ) -> Result<(), LogError> {
        let retry_for = if self.policy.retries_beginning { self.policy.retry_for } else { Duration::ZERO };
        let there = self.call_for(retry_for, |sink| sink.begin(beginning))?;
        let WriterWork { shared, .. } = &mut self;
        *shared.durable.lock().unwrap_or_else(PoisonError::into_inner) = there.clone();
        shared.there.store(there.0.iter().sum(), Ordering::Release);
        self.there = there.0;
        // A destination that begins too late is dropped, since its caller does not wait any more.
        match begun.send(()) {
            Ok(()) => self.write(incoming),
            Err(_) => Ok(()),
        }
    }

    fn write(mut self, incoming: Receiver<WriterMessage>) -> Result<(), LogError> {
        let mut is_unsure = false;
        loop {
            let message = match is_unsure {
                true => incoming.recv_timeout(IDLE),
                false => incoming.recv().map_err(|_| RecvTimeoutError::Disconnected),
            };
            match message {
                Ok(WriterMessage::Rows(batch)) => {
                    self.take(&batch)?;
                    is_unsure = true;
                }
                Ok(WriterMessage::MakeDurable) => {
                    self.make_durable()?;
                    self.shared.settled.fetch_add(1, Ordering::Release);
                    is_unsure = self.sink.is_behind();
                }
                Ok(WriterMessage::Finish(end)) => {
                    self.call(|sink| sink.finish(end))?;
                    return self.has_no_more();
                }
                Err(RecvTimeoutError::Timeout) => {
                    self.make_durable()?;
                    is_unsure = self.sink.is_behind();
                }
                // The caller has given up.
                Err(RecvTimeoutError::Disconnected) => return self.make_durable(),
            }
        }
    }

    /// Asks the destination for something, as often as the policy says.
    fn call<T>(&mut self, ask: impl FnMut(&mut dyn Sink) -> Result<T, LogError>) -> Result<T, LogError> {
        self.call_for(self.policy.retry_for, ask)
    }

    fn call_for<T>(
        &mut self,
        retry_for: Duration,
        mut ask: impl FnMut(&mut dyn Sink) -> Result<T, LogError>,
    ) -> Result<T, LogError> {
        let WriterWork { place, sink, policy, meter, cancel, shared, .. } = self;
        let waiting = RetryWait { retry_for, ..policy.waiting(place, meter, cancel) };
        waiting.call(|| shared.is_given_up.load(Ordering::Relaxed), || ask(&mut **sink))
    }

    /// An error if the destination has rows after the last one of the run. Most destinations check that themselves; those with a
    /// checkpoint cannot.
    fn has_no_more(&self) -> Result<(), LogError> {
        match self.there.iter().sum::<u64>() {
            0 => Ok(()),
            rows => Err(LogError::changed(self.place.as_str(), ChangedMessage::RowsAhead { rows })),
        }
    }

    /// Writes a batch, but for what is there already.
    fn take(&mut self, batch: &Batch) -> Result<(), LogError> {
        if self.there.iter().any(|&rows| rows > 0) {
            let rest = batch.beyond(&mut self.there);
            if !rest.is_empty() {
                self.call(|sink| sink.write(&rest))?;
            }
            self.shared.there.store(self.there.iter().sum(), Ordering::Release);
        } else {
            self.call(|sink| sink.write(batch))?;
        }
        self.meter.took(batch);
        Ok(())
    }

    fn make_durable(&mut self) -> Result<(), LogError> {
        let durable = self.call(|sink| sink.make_durable())?;
        let WriterWork { shared, meter, .. } = self;
        meter.made_sure(durable.0.iter().sum());
        *shared.durable.lock().unwrap_or_else(PoisonError::into_inner) = durable;
        Ok(())
    }
}
