//! Many homes that tell one place, over one connection or into one file.

mod lateness;
mod teller;

pub use crate::registry::fleet_sink;
pub use crate::sink::fleet::{Fleet, FleetEvent, FleetHome, FleetLayout, FleetRow, FleetSink, HomeRows};
pub use crate::sink::fleet_jsonl::has_rows_of_fleet;
pub use lateness::Lateness;
pub use teller::{Now, Patience, Since, Teller};
