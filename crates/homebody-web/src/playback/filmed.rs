//! What cameras of a stored run have kept, and what they take for falls.

use super::{Opened, PIECE, Playback, Refusal};
use crate::messages::PageMessage;
use crate::refusal::unknown;
use crate::wire::FilmView;
use homebody_core::problem::readable;
use homebody_core::time::Micros;
use homebody_kit::Cancel;
use homebody_kit::find::Stay;

impl Playback {
    /// The silhouettes of a span of a stored run, as many as there is time for: all, or those of instants so far apart.
    pub fn film(&self, name: &str, (from, to): (Micros, Micros), every: Micros) -> Result<FilmView, Refusal> {
        let run = self.open(name)?;
        let film = run.film.as_ref().ok_or_else(|| no_silhouettes(name))?;
        film.part((from.max(0), to.min(run.view.length_us)), every, PIECE)
    }
}

impl Opened {
    /// What cameras take for falls.
    pub fn seen_falls(&self, cancel: &Cancel) -> Result<Vec<Stay<'_>>, Refusal> {
        self.film.as_ref().ok_or_else(|| no_silhouettes(&self.name))?.falls(cancel).cloned()
    }
}

fn no_silhouettes(name: &str) -> Refusal {
    unknown(PageMessage::NoSilhouettes { run: readable(name.to_owned()) })
}
