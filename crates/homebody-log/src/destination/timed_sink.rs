//! A sink with a deadline for each answer.

use crate::error::LogError;
use crate::policy::{Call, Job, SinkMetrics, Timed};
use crate::sink::{Begin, Sink, Watermark};
use crate::table::Batch;
use homebody_core::time::RunTime;
use std::sync::Arc;
use std::time::Duration;

/// A sink that may take no longer than its deadline says.
pub(crate) struct TimedSink {
    calls: Timed<dyn Sink, SinkAnswer>,
    is_behind: bool,
}

/// The answer of a sink: up to where rows are durable, and whether it is behind.
type SinkAnswer = (Watermark, bool);

impl TimedSink {
    pub fn new(place: String, sink: Box<dyn Sink>, stops_within: Duration, meter: Arc<SinkMetrics>) -> TimedSink {
        TimedSink { calls: Timed::new(place, sink, stops_within, meter), is_behind: false }
    }

    /// As [`Sink::begin`]; None where the sink has not answered yet.
    pub fn begin_briefly(&mut self, begin: &Begin) -> Result<Option<Watermark>, LogError> {
        self.calls.keep_to(&begin.deadline, &begin.cancel);
        let given = self.calls.ask_briefly(Call::Begin, || begins(begin))?;
        Ok(given.map(|given| self.heard(given)))
    }

    pub fn write_briefly(&mut self, batch: &Batch) -> Result<Option<()>, LogError> {
        let given = self.calls.ask_briefly(Call::Write, || writes(batch))?;
        Ok(given.map(|given| drop(self.heard(given))))
    }

    pub fn make_durable_briefly(&mut self) -> Result<Option<Watermark>, LogError> {
        let given = self.calls.ask_briefly(Call::MakeDurable, makes_durable)?;
        Ok(given.map(|given| self.heard(given)))
    }

    fn heard(&mut self, (durable, is_behind): SinkAnswer) -> Watermark {
        self.is_behind = is_behind;
        durable
    }
}

impl Sink for TimedSink {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        self.calls.keep_to(&begin.deadline, &begin.cancel);
        let given = self.calls.ask(Call::Begin, || begins(begin))?;
        Ok(self.heard(given))
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let given = self.calls.ask(Call::Write, || writes(batch))?;
        self.heard(given);
        Ok(())
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        let given = self.calls.ask(Call::MakeDurable, makes_durable)?;
        Ok(self.heard(given))
    }

    fn finish(&mut self, end: RunTime) -> Result<(), LogError> {
        let finishes = || job(move |sink| sink.finish(end).map(|()| Watermark::none()));
        let given = self.calls.ask(Call::Finish, finishes)?;
        self.heard(given);
        Ok(())
    }

    fn is_behind(&self) -> bool {
        self.is_behind
    }
}

fn job(ask: impl FnOnce(&mut dyn Sink) -> Result<Watermark, LogError> + Send + 'static) -> Job<dyn Sink, SinkAnswer> {
    Box::new(move |sink| {
        let durable = ask(sink)?;
        Ok((durable, sink.is_behind()))
    })
}

fn begins(begin: &Begin) -> Job<dyn Sink, SinkAnswer> {
    let begin = begin.clone();
    job(move |sink| sink.begin(&begin))
}

fn writes(batch: &Batch) -> Job<dyn Sink, SinkAnswer> {
    let batch = batch.clone();
    job(move |sink| sink.write(&batch).map(|()| Watermark::none()))
}

fn makes_durable() -> Job<dyn Sink, SinkAnswer> {
    job(|sink| sink.make_durable())
}
