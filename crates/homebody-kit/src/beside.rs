//! Destinations outside a run's folder: servers and standard output, each with its treatment.

use crate::broker;
use crate::error::Error;
use crate::pace::Paced;
use homebody_core::scenario::scheme::Scheme;
use homebody_log::destination::Treatment;
use homebody_log::{Destination, Url};
use std::path::Path;

/// The destinations of these places. What those that cannot say it have confirmed is noted in
/// the run's folder, where it has one. A run hears its brokers, and is
/// refused where it is faster than they may be told.
pub(crate) fn destinations(
    urls: &[Url],
    as_said: &Treatment,
    folder: Option<&Path>,
    paced: &mut Paced,
) -> Result<Vec<Destination>, Error> {
    let mut all = Vec::new();
    for url in urls {
        let destination = broker::destination(url, paced)?.unwrap_or_else(|| Destination::of(url));
        let destination = destination.treated(as_said);
        all.push(match folder {
            // A database says itself what it holds, also after it was put back to what it was before.
            Some(folder) if url.scheme() != Scheme::Postgresql => destination.remembered_in(folder),
            _ => destination,
        });
    }
    Ok(all)
}
