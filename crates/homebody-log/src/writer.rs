//! A thread that writes batches to one destination, so that what makes them need not wait for a disk or a network.
//!
//! Batches come through a bounded queue: when the destination is the slower, the maker waits for it, and memory stays
//! small. An error ends the thread; it comes out of the next call to the writer.

use crate::cancel::Cancel;
use crate::destination::Destination;
use crate::error::LogError;
use crate::meter::Meter;
use crate::policy::Policy;
use crate::run_info::RunInfo;
use crate::sink::{Begin, How, Sink, Watermark};
use crate::table::{Batch, Table};
use crate::waiting::Waiting;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::Micros;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Rows of one batch. This and the numbers below are ours.
pub(crate) const BATCH: usize = 4096;

/// How long rows wait for a batch to fill. Whoever watches a live run sees them a little later.
pub(crate) const BATCH_WAITS: Duration = Duration::from_millis(100);

/// How long rows are unsure where nothing comes any more, not even word to make sure of them.
const IDLE: Duration = Duration::from_secs(1);

/// How often a full queue or a thread that ends is looked at.
const LOOK: Duration = Duration::from_micros(200);

/// How often one that begins is looked at.
const BEGINNING_LOOK: Duration = Duration::from_millis(10);

/// How long a destination that is away may take to notice that the run was stopped.
const NOTICES_WITHIN: Duration = Duration::from_millis(800);

/// A destination in a thread of its own.
pub(crate) struct Writer {
    /// What errors call it.
    place: String,
    policy: Policy,
    messages: Option<SyncSender<Message>>,
    thread: Option<JoinHandle<Result<(), LogError>>>,
    shared: Arc<Shared>,
    meter: Arc<Meter>,
    /// Ends the wait for it while it is away.
    cancel: Cancel,
    /// Whether it was waited for in vain: nobody does so twice.
    hangs: bool,
    /// How often it was asked to make sure of its rows.
    asked: u64,
}

/// What the thread tells while it works.
#[derive(Default)]
struct Shared {
    /// Counts up whenever the destination has answered.
    answers: AtomicU64,
    /// How often it has made sure of its rows because it was asked to.
    settled: AtomicU64,
    /// How many of the rows to come the destination has already.
    there: AtomicU64,
    durable: Mutex<Watermark>,
}

enum Message {
    Rows(Arc<Batch>),
    Settle,
    Finish(Micros),
}

/// What a writer is begun with.
#[derive(Clone)]
pub(crate) struct Beginning {
    pub run: Arc<RunInfo>,
    pub tables: Arc<Vec<Table>>,
    pub time: TimeFormat,
    pub run_column: String,
    pub spreadsheet_safe: bool,
    pub how: How,
}

impl Writer {
    /// Begins the sink in a thread of its own. Waits until it has begun, as long as its policy says, so that its error is
    /// told at once.
    pub fn spawn(destination: Destination, beginning: &Beginning) -> Result<Writer, LogError> {
        let Destination { place, sink, policy, meter, cancel } = destination;
        let (messages, incoming) = sync_channel(policy.batches_waiting);
        let (begun, begins) = sync_channel(1);
        let shared = Arc::new(Shared::default());
        let work = Work {
            place: place.clone(),
            sink,
            policy: policy.clone(),
            shared: shared.clone(),
            meter: meter.clone(),
            cancel: cancel.clone(),
            there: Vec::new(),
        };
        let beginning = beginning.clone();
        let thread = thread::Builder::new().spawn(move || work.live(&beginning, &begun, incoming));
        let thread = thread.map_err(|source| LogError::NoThread { place: place.clone(), source })?;
        let (messages, thread) = (Some(messages), Some(thread));
        let mut writer = Writer { place, policy, messages, thread, shared, meter, cancel, hangs: false, asked: 0 };
        let mut patience = Patience::new(&writer);
        loop {
            match begins.recv_timeout(BEGINNING_LOOK) {
                Ok(()) => return Ok(writer),
                Err(RecvTimeoutError::Timeout) => patience.is_left(&mut writer)?,
                // The thread has ended.
                Err(RecvTimeoutError::Disconnected) => {
                    writer.join()?;
                    return Err(LogError::Stopped { place: writer.place.clone() });
                }
            }
        }
    }

    fn hangs_error(&self) -> LogError {
        LogError::Hangs { place: self.place.clone(), seconds: self.policy.answers_within.as_secs() }
    }

    /// What errors call the destination.
    pub fn place(&self) -> &str {
        &self.place
    }

    /// The place, and what counts what it takes.
    pub fn meter(&self) -> (String, Arc<Meter>) {
        (self.place.clone(), self.meter.clone())
    }

    /// Whether its error ends the run.
    pub fn is_required(&self) -> bool {
        self.policy.required
    }

    /// How far everything is durable.
    pub fn durable(&self) -> Watermark {
        self.shared.durable.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Whether all that the destination had of the run when it was begun has been lived again.
    pub fn is_beyond_what_was_there(&self) -> bool {
        self.shared.there.load(Ordering::Acquire) == 0
    }

    /// Hands over rows; the thread's error, if it has ended by one.
    pub fn send(&mut self, batch: Arc<Batch>) -> Result<(), LogError> {
        self.pass(Message::Rows(batch))
    }

    /// Has it make sure of all rows that were handed over before. Nobody waits for that here.
    pub fn settle(&mut self) -> Result<(), LogError> {
        self.asked += 1;
        self.pass(Message::Settle)
    }

    /// Waits until it has made sure of its rows as often as it was asked to.
    pub fn wait_settled(&mut self) -> Result<(), LogError> {
        let asked = self.asked;
        self.wait(|writer| writer.shared.settled.load(Ordering::Acquire) >= asked)?;
        self.check()
    }

    /// The thread's error, if it has ended by one.
    pub fn check(&mut self) -> Result<(), LogError> {
        match &self.thread {
            Some(thread) if !thread.is_finished() => Ok(()),
            _ => self.join(),
        }
    }

    /// Waits until all rows are safe and the run is marked as ended, as long as the destination goes on answering.
    pub fn finish(mut self, end: Micros) -> Result<(), LogError> {
        self.pass(Message::Finish(end))?;
        self.messages = None;
        self.wait(|_| false)?;
        self.join()
    }

    fn pass(&mut self, message: Message) -> Result<(), LogError> {
        let Some(messages) = self.messages.clone() else { return self.join() };
        let mut message = match messages.try_send(message) {
            Ok(()) => return Ok(()),
            Err(TrySendError::Full(message)) => message,
            Err(TrySendError::Disconnected(_)) => return self.join(),
        };
        let mut patience = Patience::new(self);
        loop {
            thread::sleep(LOOK);
            message = match messages.try_send(message) {
                Ok(()) => return Ok(()),
                Err(TrySendError::Full(message)) => message,
                Err(TrySendError::Disconnected(_)) => return self.join(),
            };
            patience.is_left(self)?;
        }
    }

    /// Waits until it is so, or for the thread's end.
    fn wait(&mut self, is_so: impl Fn(&Writer) -> bool) -> Result<(), LogError> {
        let mut patience = Patience::new(self);
        while !is_so(self) && self.thread.as_ref().is_some_and(|thread| !thread.is_finished()) {
            thread::sleep(LOOK);
            patience.is_left(self)?;
        }
        Ok(())
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
    /// Waits for the thread, so that nothing writes on after the run has been given up; but not for one that hangs.
    fn drop(&mut self) {
        self.messages = None;
        if !self.hangs
            && self.wait(|_| false).is_ok()
            && let Some(thread) = self.thread.take()
        {
            let _ = thread.join();
        }
    }
}

/// How long a destination may still go without an answer.
struct Patience {
    answers: u64,
    since: Instant,
    /// When it was seen that the run was stopped.
    stopped: Option<Instant>,
}

impl Patience {
    fn new(writer: &Writer) -> Patience {
        let answers = writer.shared.answers.load(Ordering::Relaxed);
        Patience { answers, since: Instant::now(), stopped: None }
    }

    /// An error where none is left: then nobody waits for the destination any more.
    fn is_left(&mut self, writer: &mut Writer) -> Result<(), LogError> {
        let answers = writer.shared.answers.load(Ordering::Relaxed);
        if answers != self.answers {
            (self.answers, self.since) = (answers, Instant::now());
        }
        if writer.cancel.is_cancelled() {
            let stopped = self.stopped.get_or_insert_with(Instant::now).elapsed();
            if let Some(why) = writer.meter.why_away().filter(|_| stopped > NOTICES_WITHIN) {
                writer.hangs = true;
                return Err(LogError::StoppedAway { place: writer.place.clone(), why });
            }
        }
        if self.since.elapsed() > writer.policy.answers_within {
            writer.hangs = true;
            return Err(writer.hangs_error());
        }
        Ok(())
    }
}

/// What the thread works with.
struct Work {
    /// What errors call it.
    place: String,
    sink: Box<dyn Sink>,
    policy: Policy,
    shared: Arc<Shared>,
    meter: Arc<Meter>,
    cancel: Cancel,
    /// By table, how many of the rows to come the destination has already.
    there: Vec<u64>,
}

impl Work {
    /// The thread's life: begins the sink, says so, and writes what comes.
    fn live(
        mut self,
        beginning: &Beginning,
        begun: &SyncSender<()>,
        incoming: Receiver<Message>,
    ) -> Result<(), LogError> {
        let begin = Begin {
            run: &beginning.run,
            tables: &beginning.tables,
            time: beginning.time,
            run_column: &beginning.run_column,
            spreadsheet_safe: beginning.spreadsheet_safe,
            how: beginning.how,
            cancel: &self.cancel.clone(),
        };
        let retry_for = if self.policy.retries_beginning { self.policy.retry_for } else { Duration::ZERO };
        let there = self.call_for(retry_for, |sink| sink.begin(&begin))?;
        let Work { shared, .. } = &mut self;
        *shared.durable.lock().unwrap_or_else(PoisonError::into_inner) = there.clone();
        shared.there.store(there.0.iter().sum(), Ordering::Release);
        self.there = there.0;
        // Nobody waits any more for one that has begun too late: then it is dropped as it is.
        match begun.send(()) {
            Ok(()) => self.write(incoming),
            Err(_) => Ok(()),
        }
    }

    fn write(mut self, incoming: Receiver<Message>) -> Result<(), LogError> {
        let mut is_unsure = false;
        loop {
            let message = match is_unsure {
                true => incoming.recv_timeout(IDLE),
                false => incoming.recv().map_err(|_| RecvTimeoutError::Disconnected),
            };
            match message {
                Ok(Message::Rows(batch)) => {
                    self.take(&batch)?;
                    is_unsure = true;
                }
                Ok(Message::Settle) => {
                    self.settle()?;
                    self.shared.settled.fetch_add(1, Ordering::Release);
                    is_unsure = self.sink.is_behind();
                }
                Ok(Message::Finish(end)) => {
                    self.call(|sink| sink.finish(end))?;
                    return self.has_no_more();
                }
                Err(RecvTimeoutError::Timeout) => {
                    self.settle()?;
                    is_unsure = self.sink.is_behind();
                }
                // Whoever made the rows has given up.
                Err(RecvTimeoutError::Disconnected) => return self.settle(),
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
        let Work { place, sink, policy, meter, cancel, .. } = self;
        let waiting = Waiting { retry_for, ..policy.waiting(place, meter, cancel) };
        waiting.call(|| false, || ask(&mut **sink))
    }

    /// An error where the destination has rows behind the last of the run: most look themselves and have refused to end, but those of which
    /// only a note says what they have cannot.
    fn has_no_more(&self) -> Result<(), LogError> {
        match self.there.iter().sum::<u64>() {
            0 => Ok(()),
            rows => {
                let what = format!("it has been given {rows} rows more than the run has made by now");
                Err(LogError::Changed { place: self.place.clone(), what })
            }
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
        let Work { shared, meter, .. } = self;
        meter.took(batch);
        shared.answers.fetch_add(1, Ordering::Relaxed);
        Ok(())
    }

    fn settle(&mut self) -> Result<(), LogError> {
        let durable = self.call(|sink| sink.settle())?;
        let Work { shared, meter, .. } = self;
        meter.made_sure(durable.0.iter().sum());
        *shared.durable.lock().unwrap_or_else(PoisonError::into_inner) = durable;
        shared.answers.fetch_add(1, Ordering::Relaxed);
        Ok(())
    }
}
