//! Drivers that callers bring: they take the places of the scenario's own.

use homebody_core::drivers::Driver;
use homebody_core::home::Home;
use homebody_core::run::{DriverProvider, Guest};
use homebody_routine::household::Household;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Makes a driver from the home and the run's seed.
pub type MakeDriver = Arc<dyn Fn(&Arc<Home>, u64) -> Box<dyn Driver> + Send + Sync>;

/// The drivers of a run: the caller's own for some residents, the household's for the others.
pub struct CustomDrivers<'a> {
    pub household: &'a Household,
    /// By resident.
    pub own: &'a BTreeMap<usize, MakeDriver>,
}

impl DriverProvider for CustomDrivers<'_> {
    fn guests(&self) -> Vec<Guest> {
        self.household.guests()
    }

    fn driver(&self, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn Driver>> {
        match self.own.get(&body) {
            Some(make) => Some(make(home, seed)),
            None => self.household.driver(body, home, seed),
        }
    }
}
