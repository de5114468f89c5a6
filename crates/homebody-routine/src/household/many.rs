//! Many runs of one household with different seeds, which share all that does not depend on the seed.

use super::{DriverTemplate, Household};
use homebody_core::drivers::Driver;
use homebody_core::home::Home;
use homebody_core::run::{DriverProvider, Guest, Run};
use homebody_core::time::Span;
use std::sync::Arc;

/// Number of ways that a body remembers (our choice): one takes some microseconds to find, and a hundred bytes to
/// remember.
const WAYS: usize = 32;

/// Each run equals that of [`Run::new`] with the same household and seed.
pub struct ManyRuns {
    household: Arc<Household>,
    home: Arc<Home>,
    /// `None` for an unknown body.
    by_body: Vec<Option<DriverTemplate>>,
}

impl ManyRuns {
    /// Bakes the home, which takes some milliseconds and some megabytes.
    pub fn new(household: Arc<Household>) -> ManyRuns {
        let guests = household.guests();
        let home = Arc::new(Run::home_of(&household.scenario, &guests));
        let bodies = household.scenario.residents.len() + guests.len();
        let footing = |body| Some(DriverTemplate { ways: Some(WAYS), ..household.footing(body, &home)? });
        let by_body = (0..bodies).map(footing).collect();
        ManyRuns { household, home, by_body }
    }

    pub fn run(&self, seed: u64, length: Span) -> Run {
        Run::in_home(self.home.clone(), &self.household.scenario, self, seed, length)
    }
}

impl DriverProvider for ManyRuns {
    fn guests(&self) -> Vec<Guest> {
        self.household.guests()
    }

    fn driver(&self, body: usize, home: &Arc<Home>, seed: u64) -> Option<Box<dyn Driver>> {
        self.household.driver_on(self.by_body.get(body)?.as_ref()?, body, home, seed)
    }
}
