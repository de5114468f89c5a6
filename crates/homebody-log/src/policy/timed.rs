//! A destination in a thread of its own, so that its caller waits no longer than its deadline.
//!
//! A call that takes longer is an error that passes. The call stays in its thread, and the same call, made again, gets the answer once it
//! comes. So no rows are given twice, and at most one thread hangs, also after many tries.

use super::cancel::Cancel;
use super::deadline::Deadline;
use super::metrics::SinkMetrics;
use crate::error::LogError;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// The interval of checks during a wait.
const LOOK: Duration = Duration::from_millis(20);

/// By how much a destination that keeps to the deadline itself may be late: its own error says more.
const GRACE: Duration = Duration::from_millis(300);

/// The length of a brief wait.
const BRIEFLY: Duration = Duration::from_millis(50);

/// The time for the answer of a destination that is away, or of a server, once the run is stopped.
pub(crate) const STOPS_WITHIN: Duration = Duration::from_millis(700);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Call {
    Begin,
    Write,
    MakeDurable,
    Finish,
}

/// A destination of a kind, with a deadline for each answer.
pub(crate) struct Timed<S: ?Sized, A> {
    place: String,
    /// Until its thread has it.
    sink: Option<Box<S>>,
    hand: Option<Hand<S, A>>,
    deadline: Deadline,
    cancel: Cancel,
    /// The time for an answer once the run is stopped, and the instant of the stop.
    stops_within: Duration,
    stopped: Option<Instant>,
    meter: Arc<SinkMetrics>,
    /// The call that still has no answer.
    unanswered: Option<Call>,
    has_finished: bool,
}

struct Hand<S: ?Sized, A> {
    jobs: Sender<Job<S, A>>,
    answers: Receiver<Result<A, LogError>>,
    thread: JoinHandle<()>,
}

pub(crate) type Job<S, A> = Box<dyn FnOnce(&mut S) -> Result<A, LogError> + Send>;

impl<S: ?Sized + Send + 'static, A: Default + Send + 'static> Timed<S, A> {
    pub fn new(place: String, sink: Box<S>, stops_within: Duration, meter: Arc<SinkMetrics>) -> Timed<S, A> {
        Timed {
            place,
            sink: Some(sink),
            hand: None,
            deadline: Deadline::default(),
            cancel: Cancel::new(),
            stops_within,
            stopped: None,
            meter,
            unanswered: None,
            has_finished: false,
        }
    }

    /// From now on this deadline holds, and this handle ends waits.
    pub fn keep_to(&mut self, deadline: &Deadline, cancel: &Cancel) {
        (self.deadline, self.cancel) = (deadline.clone(), cancel.clone());
    }

    /// Makes a call and waits for its answer as long as the destination has time.
    pub fn ask(&mut self, call: Call, job: impl FnOnce() -> Job<S, A>) -> Result<A, LogError> {
        Ok(self.asked(call, false, job)?.unwrap_or_default())
    }

    /// The same for a moment; None where the destination has not answered yet.
    pub fn ask_briefly(&mut self, call: Call, job: impl FnOnce() -> Job<S, A>) -> Result<Option<A>, LogError> {
        self.asked(call, true, job)
    }

    fn asked(&mut self, call: Call, is_brief: bool, job: impl FnOnce() -> Job<S, A>) -> Result<Option<A>, LogError> {
        if let Some(before) = self.unanswered {
            if !is_brief {
                self.deadline.asks();
            }
            match self.answer(is_brief)? {
                None => return Ok(None),
                Some(given) if before == call => return given.map(Some),
                Some(Err(error)) if !error.passes() => return Err(error),
                Some(_) => {}
            }
        }
        if self.has_finished {
            return Ok(Some(A::default()));
        }
        self.deadline.asks();
        let hand = match &mut self.hand {
            Some(hand) => hand,
            hand @ None => {
                let stopped = || LogError::Stopped { place: self.place.clone() };
                let begun = Hand::begin(self.sink.take().ok_or_else(stopped)?);
                hand.insert(begun.map_err(|source| LogError::NoThread { place: self.place.clone(), source })?)
            }
        };
        // One that has broken is noticed as its answer does not come.
        let _ = hand.jobs.send(job());
        self.unanswered = Some(call);
        self.answer(is_brief)?.transpose()
    }

    /// Waits for the answer to what was asked last.
    fn answer(&mut self, is_brief: bool) -> Result<Option<Result<A, LogError>>, LogError> {
        let begun = Instant::now();
        loop {
            let Some(hand) = &self.hand else { return Err(LogError::Stopped { place: self.place.clone() }) };
            match hand.answers.recv_timeout(LOOK) {
                Ok(given) => {
                    self.has_finished |= self.unanswered.take() == Some(Call::Finish) && given.is_ok();
                    return Ok(Some(given));
                }
                Err(RecvTimeoutError::Disconnected) => self.break_up(),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if self.cancel.is_cancelled() {
                let stopped = self.stopped.get_or_insert_with(Instant::now).elapsed();
                let why = self.meter.why_away();
                let within = if why.is_some() { STOPS_WITHIN } else { self.stops_within };
                // One that is slow and answers has the time of one answer for all that is left.
                if stopped.min(self.deadline.unanswered()) > within || stopped > within.max(self.deadline.within()) {
                    let why = why.unwrap_or_else(|| "it has not answered yet".into());
                    return Err(LogError::StoppedAway { place: self.place.clone(), why });
                }
            }
            if is_brief && begun.elapsed() > BRIEFLY {
                return Ok(None);
            }
            if !is_brief && self.deadline.is_over_by(GRACE) {
                return Err(LogError::hangs(&self.place, self.deadline.within()));
            }
        }
    }

    /// The destination has panicked, and its caller does.
    fn break_up(&mut self) {
        self.unanswered = None;
        if let Some(Err(panic)) = self.hand.take().map(|hand| hand.thread.join()) {
            std::panic::resume_unwind(panic);
        }
    }
}

impl<S: ?Sized, A> Drop for Timed<S, A> {
    /// Waits until the destination is given up, so that nothing writes on afterwards; but not for one that hangs.
    fn drop(&mut self) {
        let Some(Hand { jobs, answers, thread }) = self.hand.take() else { return };
        drop((jobs, answers));
        if self.unanswered.is_some() {
            return;
        }
        self.deadline.asks();
        let begun = Instant::now();
        while !thread.is_finished() {
            let is_late = self.cancel.is_cancelled() && begun.elapsed() > self.stops_within;
            if is_late || self.deadline.is_over_by(GRACE) {
                return;
            }
            thread::sleep(Duration::from_millis(1));
        }
        let _ = thread.join();
    }
}

impl<S: ?Sized + Send + 'static, A: Send + 'static> Hand<S, A> {
    fn begin(mut sink: Box<S>) -> std::io::Result<Hand<S, A>> {
        let (jobs, asked) = channel::<Job<S, A>>();
        let (answer, answers) = channel();
        let thread = thread::Builder::new().spawn(move || {
            while let Ok(job) = asked.recv() {
                if answer.send(job(&mut sink)).is_err() {
                    return;
                }
            }
        })?;
        Ok(Hand { jobs, answers, thread })
    }
}
