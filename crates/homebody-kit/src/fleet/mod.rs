//! Fleets: thousands of homes lived on the world's clock by one thread, each with a life of its own, to see what a back end bears.
//!
//! Homes of one scenario share all that does not depend on the seed. Each is lived some tens of seconds ahead of the clock, in
//! small parts, so that what takes long, as the plan of a day does, makes no message late. What its sensors say waits until its
//! time has come. When that is, and whether it is told at all, is no matter of the home's: its rows are those of the same home alone.

mod churn;
mod homes;
mod living;
mod report;
mod running;
mod storms;

pub use churn::Churn;
pub use homebody_log::fleet::Patience;
pub use homes::{FleetMessage, FleetOf, FleetSetup, MOST_HOMES};
pub use report::{FleetReport, OfDestination};
pub use running::{FleetLived, FleetRun};
pub use storms::Storms;
