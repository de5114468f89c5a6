//! Fleets: thousands of homes that one thread simulates in real time, to load-test a back end.
//!
//! The homes of a scenario share all data that do not depend on the seed. Each home is simulated in small steps, some tens of seconds ahead
//! of the clock, so that slow steps, such as the plan of a day, delay no message. The messages wait until they are due. The delivery of a
//! row does not change it: the rows of a home are the same in any fleet.

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
