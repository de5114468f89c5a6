//! Where rows go: a sink, and how it is treated.

pub(crate) mod checkpoint;
pub(crate) mod spool;
mod timed_sink;
pub(crate) mod writer;

use crate::error::LogError;
use crate::files::WriteMode;
use crate::policy::{Cancel, Policy, SinkMetrics};
use crate::registry;
use crate::sink::{Begin, Sink, Watermark};
use crate::table::Batch;
use crate::url::Url;
use checkpoint::CheckpointedSink;
pub use checkpoint::{NOTES, Note};
use homebody_core::time::RunTime;
use spool::{BATCHES_WAITING, Spooled, WhenDown};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use timed_sink::TimedSink;

/// Where rows go, and what becomes of the run if that fails.
pub struct Destination {
    /// What errors and summaries call it, such as `csv:log.csv`.
    pub place: String,
    /// What takes the rows.
    pub sink: Box<dyn Sink>,
    /// How long a failure is waited for, and whether the run ends with it.
    pub policy: Policy,
    /// What counts what it takes.
    pub meter: Arc<SinkMetrics>,
    /// Ends the wait for it while it is away.
    pub cancel: Cancel,
    /// How the run treats its absence, beyond the policy.
    pub when_down: WhenDown,
    /// The folder with a note of its confirmed rows, if it cannot count them itself.
    pub notes: Option<PathBuf>,
}

/// How a run treats its servers, as its user asks for.
#[derive(Clone, Debug, Default)]
pub struct Treatment {
    /// How it treats the absence of a server, or of the reader of standard output.
    pub when_down: WhenDown,
    /// How long one of these may take to answer a request; None for as long as its kind may.
    pub answers_within: Option<Duration>,
    /// Ends the wait for any destination.
    pub cancel: Cancel,
}

impl Destination {
    /// A place of one of the known kinds, which the run cannot do without.
    pub fn new(url: &Url) -> Destination {
        Destination::with(url.to_string(), registry::sink(url), registry::policy(url))
    }

    /// The same for a home that nobody knows when it ends: a text file has its name from its first line on.
    pub fn followed(url: &Url) -> Destination {
        Destination { sink: registry::sink_as(url, true), ..Destination::new(url) }
    }

    /// The same, begun like this unless the run is resumed, whether or not the run's files are replaced.
    pub fn begun_as(self, how: WriteMode) -> Destination {
        Destination { sink: Box::new(BegunAs { how, inner: self.sink }), ..self }
    }

    /// A caller's own.
    pub fn own(place: impl Into<String>, sink: impl Sink + 'static, policy: Policy) -> Destination {
        Destination::with(place.into(), Box::new(sink), policy)
    }

    fn with(place: String, sink: Box<dyn Sink>, policy: Policy) -> Destination {
        let (meter, cancel, when_down, notes) = (Arc::default(), Cancel::new(), WhenDown::Error, None);
        Destination { place, sink, policy, meter, cancel, when_down, notes }
    }

    /// The same, with what becomes of the run while it is away.
    pub fn when_down(self, when: &WhenDown) -> Destination {
        let policy = match when {
            WhenDown::Error => return self,
            &WhenDown::Retry(retry_for) => Policy { retry_for, retries_beginning: true, ..self.policy },
            WhenDown::Spool(..) => Policy { batches_waiting: BATCHES_WAITING, ..self.policy },
        };
        Destination { policy, when_down: when.clone(), ..self }
    }

    /// The same, treated so.
    pub fn treated(self, as_said: &Treatment) -> Destination {
        let answers_within = as_said.answers_within.unwrap_or(self.policy.answers_within);
        let (policy, cancel) = (Policy { answers_within, ..self.policy }, as_said.cancel.clone());
        Destination { policy, cancel, ..self }.when_down(&as_said.when_down)
    }

    /// The same, with what it has confirmed noted in this folder.
    pub fn remembered_in(self, folder: &Path) -> Destination {
        Destination { notes: Some(folder.to_owned()), ..self }
    }

    /// Its sink with all that stands before it: a deadline, a spool, notes.
    pub(crate) fn into_sink(self) -> Box<dyn Sink> {
        let Destination { place, sink, policy, meter, when_down, notes, .. } = self;
        let timed = TimedSink::new(place.clone(), sink, policy.stops_within, meter.clone());
        let sink: Box<dyn Sink> = match when_down {
            WhenDown::Spool(folder, most_bytes) => {
                Box::new(Spooled::new(place.clone(), timed, &folder, most_bytes, meter))
            }
            WhenDown::Error | WhenDown::Retry(_) => Box::new(timed),
        };
        match notes {
            Some(folder) => Box::new(CheckpointedSink::new(&place, sink, &folder)),
            None => sink,
        }
    }
}

/// A sink that is begun otherwise than the run's files.
struct BegunAs {
    how: WriteMode,
    inner: Box<dyn Sink>,
}

impl Sink for BegunAs {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let how = if begin.how == WriteMode::Resume { WriteMode::Resume } else { self.how };
        self.inner.begin(&Begin { how, ..*begin })
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.inner.write(batch)
    }

    fn make_durable(&mut self) -> Result<Watermark, LogError> {
        self.inner.make_durable()
    }

    fn finish(&mut self, end: RunTime) -> Result<(), LogError> {
        self.inner.finish(end)
    }

    fn is_behind(&self) -> bool {
        self.inner.is_behind()
    }
}
