//! Fleets: thousands of homes that one thread simulates in real time, to load-test a back end.
//!
//! The homes of a scenario share all that does not depend on the seed. Each is simulated in small parts some tens of seconds ahead of
//! the clock, so that slow parts, such as the plan of a day, delay no message. Its messages wait until they are due. The delivery of
//! its rows does not change them: they are those of the same home alone.

#![warn(missing_docs)]

mod error;
pub mod catalogue;

mod churn;
mod homes;
mod outages;
mod report;
mod run;
mod setup;

pub use churn::Churn;
pub use error::FleetError;
pub use homebody_log::fleet::Patience;
pub use outages::Outages;
pub use report::{DestinationReport, FleetReport};
pub use run::{FleetRun, FleetStatus};
pub use setup::{FleetHomes, FleetMessage, FleetSetup, MOST_HOMES};
