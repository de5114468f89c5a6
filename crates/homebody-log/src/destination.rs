//! Where rows go: a sink, and how it is treated.

use crate::cancel::Cancel;
use crate::elsewhere;
use crate::error::LogError;
use crate::meter::Meter;
use crate::policy::Policy;
use crate::sink::{self, Begin, How, Sink, Watermark};
use crate::table::Batch;
use crate::url::Url;
use homebody_core::time::Micros;
use std::sync::Arc;

/// Where rows go, and what becomes of the run if that fails.
pub struct Destination {
    /// What errors and summaries call it, such as `csv:log.csv`.
    pub place: String,
    /// What takes the rows.
    pub sink: Box<dyn Sink>,
    /// How long a failure is waited for, and whether the run ends with it.
    pub policy: Policy,
    /// What counts what it takes.
    pub meter: Arc<Meter>,
    /// Ends the wait for it while it is away.
    pub cancel: Cancel,
}

impl Destination {
    /// A place of one of the known kinds, which the run cannot do without.
    pub fn of(url: &Url) -> Destination {
        let policy = elsewhere::of(url.scheme()).map_or_else(Policy::default, |elsewhere| (elsewhere.policy)());
        let (meter, cancel) = (Arc::default(), Cancel::new());
        Destination { place: url.to_string(), sink: sink::open(url), policy, meter, cancel }
    }

    /// The same for a home that nobody knows when it ends: a text file has its name from its first line on.
    pub fn followed(url: &Url) -> Destination {
        Destination { sink: sink::open_as(url, true), ..Destination::of(url) }
    }

    /// The same, begun like this unless the run is resumed, whether or not the run's files are replaced.
    pub fn begun_as(self, how: How) -> Destination {
        Destination { sink: Box::new(BegunAs { how, inner: self.sink }), ..self }
    }

    /// A caller's own.
    pub fn own(place: impl Into<String>, sink: impl Sink + 'static, policy: Policy) -> Destination {
        let (meter, cancel) = (Arc::default(), Cancel::new());
        Destination { place: place.into(), sink: Box::new(sink), policy, meter, cancel }
    }
}

/// A sink that is begun otherwise than the run's files.
struct BegunAs {
    how: How,
    inner: Box<dyn Sink>,
}

impl Sink for BegunAs {
    fn begin(&mut self, begin: &Begin) -> Result<Watermark, LogError> {
        let how = if begin.how == How::GoOn { How::GoOn } else { self.how };
        self.inner.begin(&Begin { how, ..*begin })
    }

    fn write(&mut self, batch: &Batch) -> Result<(), LogError> {
        self.inner.write(batch)
    }

    fn settle(&mut self) -> Result<Watermark, LogError> {
        self.inner.settle()
    }

    fn finish(&mut self, end: Micros) -> Result<(), LogError> {
        self.inner.finish(end)
    }

    fn is_behind(&self) -> bool {
        self.inner.is_behind()
    }
}
