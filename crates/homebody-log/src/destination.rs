//! Destinations of rows: a sink, and the policy for it.

pub(crate) mod checkpoint;
pub(crate) mod spool;
mod timed_sink;
pub(crate) mod writer;

use crate::files::WriteMode;
use crate::policy::{Cancel, Policy, SinkMetrics};
use crate::registry;
use crate::sink::Sink;
use crate::url::Url;
use checkpoint::CheckpointedSink;
pub use checkpoint::{NOTES, Note};
use spool::{BATCHES_WAITING, Spooled, WhenDown};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use timed_sink::TimedSink;

/// A destination of rows, and the policy for its failures.
pub struct Destination {
    /// The name in errors and summaries, such as `csv:log.csv`.
    pub place: String,
    /// Takes the rows.
    pub sink: Box<dyn Sink>,
    /// The time of retries after a failure, and whether the run ends with it.
    pub policy: Policy,
    /// Counts rows, bytes and retries.
    pub meter: Arc<SinkMetrics>,
    /// Ends the wait for it while it is away.
    pub cancel: Cancel,
    /// The reaction to its absence, beyond the policy.
    pub when_down: WhenDown,
    /// The folder with a note of its confirmed rows, if it cannot count them itself.
    pub notes: Option<PathBuf>,
    /// The treatment of existing rows unless the run is resumed; None for that of the run's files.
    pub how: Option<WriteMode>,
}

/// The user's options for all servers of a run.
#[derive(Clone, Debug, Default)]
pub struct Treatment {
    /// The reaction to the absence of a server, or of the reader of standard output.
    pub when_down: WhenDown,
    /// The time that one of these has to answer a request; None for the usual time of its kind.
    pub answers_within: Option<Duration>,
    /// Ends the wait for any destination.
    pub cancel: Cancel,
}

impl Destination {
    /// A place of one of the known kinds, which the run cannot do without.
    pub fn new(url: &Url) -> Destination {
        Destination::with(url.to_string(), registry::sink(url), registry::policy(url))
    }

    /// The same for a home without an end: a text file has its name from its first line on.
    pub fn followed(url: &Url) -> Destination {
        Destination { sink: registry::sink_as(url, true), ..Destination::new(url) }
    }

    /// The same, begun like this unless the run is resumed, whether or not the run's files are replaced.
    pub fn begun_as(self, how: WriteMode) -> Destination {
        Destination { how: Some(how), ..self }
    }

    /// A caller's own.
    pub fn own(place: impl Into<String>, sink: impl Sink + 'static, policy: Policy) -> Destination {
        Destination::with(place.into(), Box::new(sink), policy)
    }

    fn with(place: String, sink: Box<dyn Sink>, policy: Policy) -> Destination {
        let (meter, cancel, when_down) = (Arc::default(), Cancel::new(), WhenDown::Error);
        Destination { place, sink, policy, meter, cancel, when_down, notes: None, how: None }
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
