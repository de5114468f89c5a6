//! Destinations and sources in crates of their own, as far as this build has them.

use homebody_log::registry::{Registry, install};

/// Registers them for the whole program. Call it before all else; a second call changes nothing.
pub fn install_sinks() {
    install(Registry::new(vec![
        #[cfg(feature = "postgresql")]
        homebody_postgres::POSTGRESQL,
        #[cfg(feature = "parquet")]
        homebody_arrow::PLUGIN,
        #[cfg(feature = "mqtt")]
        homebody_mqtt::plugin(),
    ]));
}
