//! Which places a fleet can write, and what takes its rows there.

use super::FleetSink;
use crate::elsewhere::{self, not_built_in};
use crate::error::LogError;
use crate::sink::fleet_jsonl::FleetJsonl;
pub use crate::sink::fleet_jsonl::has_rows_of_fleet;
use crate::url::Url;
use homebody_core::scenario::scheme::{NoPlace, SCHEMES, Scheme};

/// What takes the rows of a fleet at a place. Nothing is touched before it is begun.
///
/// # Errors
///
/// [`LogError::NoPlace`] for a kind of place that no fleet can write, which says those that it can; [`LogError::NotBuiltIn`] for
/// one that this build does not have.
pub fn sink(url: &Url) -> Result<Box<dyn FleetSink>, LogError> {
    let scheme = url.scheme();
    if scheme == Scheme::Jsonl {
        return Ok(Box::new(FleetJsonl::new(url)));
    }
    match elsewhere::of(scheme) {
        Some(elsewhere) => elsewhere.fleet.map(|open| open(url)).ok_or_else(|| no_fleet(url)),
        None if WRITABLE.contains(&scheme) => Err(not_built_in(url)),
        None => Err(no_fleet(url)),
    }
}

/// The kinds of places that a fleet can write, in builds that have them.
const WRITABLE: [Scheme; 4] = [Scheme::Jsonl, Scheme::Postgresql, Scheme::Mqtt, Scheme::Mqtts];

fn no_fleet(url: &Url) -> LogError {
    let rows = SCHEMES.iter().filter(|row| WRITABLE.contains(&row.scheme));
    let can: Vec<String> = rows.map(|row| format!("{}:{}", row.name, row.at)).collect();
    let what = format!("{url} has no room for many homes");
    LogError::NoPlace(NoPlace { what, hint: format!("a fleet writes {}, and jsonl:-", can.join(", ")) })
}
