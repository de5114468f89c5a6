//! Destinations outside a run's folder: servers and standard output, each with its treatment.

use crate::broker;
use crate::error::SimulationError;
use crate::pace::PaceKeeper;
use homebody_log::destination::Treatment;
use homebody_log::{Destination, Url};
use std::path::Path;

/// The destinations of these places. The rows that they confirm are noted in the run's folder, for those that cannot report them. A run
/// obeys its brokers, and is refused if it is faster than they allow.
pub(crate) fn destinations(
    urls: &[Url],
    treatment: &Treatment,
    folder: Option<&Path>,
    paced: &mut PaceKeeper,
) -> Result<Vec<Destination>, SimulationError> {
    let mut all = Vec::new();
    for url in urls {
        let destination = broker::destination(url, paced)?.unwrap_or_else(|| Destination::new(url));
        let destination = destination.treated(treatment);
        all.push(match folder {
            // A database reports its rows itself, also after it was restored from an older copy.
            Some(folder) if !url.scheme().row().reports_rows => destination.remembered_in(folder),
            _ => destination,
        });
    }
    Ok(all)
}
