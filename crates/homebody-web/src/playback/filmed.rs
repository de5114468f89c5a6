//! What cameras of a stored run have kept, and what they take for falls.

use super::{Opened, PIECE, Playback, Refusal};
use crate::messages::PageMessage;
use crate::refusal::unknown;
use crate::wire::FilmView;
use homebody_core::problem::readable;
use homebody_core::time::{Interval, RunTime, Span};
use homebody_query::search::KnownStay;
use homebody_simulation::Cancel;

impl Playback {
    /// The silhouettes of a span of a stored run, as many as there is time for: all, or those of instants so far apart.
    pub fn film(&self, name: &str, span: Interval<RunTime>, every: Span) -> Result<FilmView, Refusal> {
        let run = self.open(name)?;
        let film = run.film.as_ref().ok_or_else(|| no_silhouettes(name))?;
        film.part(span.intersection(run.view.interval()), every, PIECE)
    }
}

impl Opened {
    /// What cameras take for falls.
    pub fn seen_falls(&self, cancel: &Cancel) -> Result<Vec<KnownStay<'_, RunTime>>, Refusal> {
        self.film.as_ref().ok_or_else(|| no_silhouettes(&self.name))?.falls(cancel).cloned()
    }
}

fn no_silhouettes(name: &str) -> Refusal {
    unknown(PageMessage::NoSilhouettes { run: readable(name.to_owned()) })
}
