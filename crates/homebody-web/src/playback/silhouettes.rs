//! Silhouettes and falls in the camera pictures of a stored run.

use super::{OpenRun, PIECE, Playback, RequestError};
use crate::messages::PageMessage;
use crate::request_error::not_found;
use crate::wire::SilhouettesView;
use homebody_core::problem::readable;
use homebody_core::time::{Interval, RunTime, Span};
use homebody_query::search::KnownStay;
use homebody_simulation::Cancel;

impl Playback {
    /// The silhouettes of a span, as many as there is time for: all, or one for each `every`.
    pub fn silhouettes(
        &self,
        name: &str,
        span: Interval<RunTime>,
        every: Span,
    ) -> Result<SilhouettesView, RequestError> {
        let run = self.open(name)?;
        let film = run.film.as_ref().ok_or_else(|| no_silhouettes(name))?;
        film.part(span.intersection(run.view.interval()), every, PIECE)
    }
}

impl OpenRun {
    pub fn seen_falls(&self, cancel: &Cancel) -> Result<Vec<KnownStay<'_, RunTime>>, RequestError> {
        self.film.as_ref().ok_or_else(|| no_silhouettes(&self.name))?.falls(cancel).cloned()
    }
}

fn no_silhouettes(name: &str) -> RequestError {
    not_found(PageMessage::NoSilhouettes { run: readable(name.to_owned()) })
}
