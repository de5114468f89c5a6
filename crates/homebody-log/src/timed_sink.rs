//! A sink with a deadline for each answer.

use crate::error::LogError;
use crate::meter::Meter;
use crate::sink::{Begin, Beginning, Sink, Watermark};
use crate::table::Batch;
use crate::timed::{Call, Job, Timed};
use homebody_core::time::Micros;
use std::sync::Arc;
use std::time::Duration;

/// A sink that may take no longer than its deadline says.
pub(crate) struct TimedSink {
    calls: Timed<dyn Sink, Answer>,
    is_behind: bool,
}

/// The answer of a sink: up to where rows are durable, and whether it is behind.
type Answer = (Watermark, bool);

impl TimedSink {
    pub fn new(place: String, sink: Box<dyn Sink>, stops_within: Duration, meter: Arc<Meter>) -> TimedSink {
        TimedSink { calls: Timed::new(place, sink, stops_within, meter), is_behind: false }
    }

    /// As [`Sink::begin`]; None where the sink has not answered yet.
    pub fn begin_briefly(&mut self, begin: &Begin) -> Result<Option<Watermark>, LogError> {
        self.calls.keep_to(begin.deadline, begin.cancel);
        let given = self.calls.ask_briefly(Call::Begin, || begins(begin))?;
        Ok(given.map(|given| self.heard(given)))
    }

    /// As [`Sink::write`]; None where the sink has not answered yet.
    pub fn write_briefly(&mut self, batch: &Batch) -> Result<Option<()>, LogError> {
        let given = self.calls.ask_briefly(Call::Write, || writes(batch))?;
        Ok(given.map(|given| drop(self.heard(given))))
    }

    /// As [`Sink::settle`]; None where the sink has not answered yet.
    pub fn settle_briefly(&mut self) -> Result<Option<Watermark>, LogError> {
        let given = self.calls.ask_briefly(Call::Settle, settles)?;
        Ok(given.map(|given| self.heard(given)))
    }

    fn heard(&mut self, (durable, is_behind): Answer) -> Watermark {
        self.is_behind = is_behind;
        durable
    }
}

impl Sink for TimedSink {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        self.calls.keep_to(begin.deadline, begin.cancel);
        let given = self.calls.ask(Call::Begin, || begins(begin))?;
        Ok(self.heard(given))
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        let given = self.calls.ask(Call::Write, || writes(batch))?;
        self.heard(given);
        Ok(())
    }

    fn settle(&mut self) -> Result<Watermark, LogError> {
        let given = self.calls.ask(Call::Settle, settles)?;
        Ok(self.heard(given))
    }

    fn finish(&mut self, end: Micros) -> Result<(), LogError> {
        let finishes = || job(move |sink| sink.finish(end).map(|()| Watermark::none()));
        let given = self.calls.ask(Call::Finish, finishes)?;
        self.heard(given);
        Ok(())
    }

    fn is_behind(&self) -> bool {
        self.is_behind
    }
}

fn job(ask: impl FnOnce(&mut dyn Sink) -> Result<Watermark, LogError> + Send + 'static) -> Job<dyn Sink, Answer> {
    Box::new(move |sink| {
        let durable = ask(sink)?;
        Ok((durable, sink.is_behind()))
    })
}

fn begins(begin: &Begin) -> Job<dyn Sink, Answer> {
    let beginning = Beginning::of(begin);
    job(move |sink| sink.begin(&beginning.begin()))
}

fn writes(batch: &Batch) -> Job<dyn Sink, Answer> {
    let batch = batch.clone();
    job(move |sink| sink.write(&batch).map(|()| Watermark::none()))
}

fn settles() -> Job<dyn Sink, Answer> {
    job(|sink| sink.settle())
}
