//! Shared by the tests: servers, and a run whose rows go there.
#![allow(dead_code, reason = "each test file uses a part of it")]

pub mod life;
pub mod proxy;
pub mod server;

pub use server::Server;
use std::sync::Mutex;

/// The number of kills or cuts: few by default, or `HOMEBODY_KILLS`.
pub fn kills(usual: usize) -> usize {
    std::env::var("HOMEBODY_KILLS").ok().and_then(|kills| kills.parse().ok()).unwrap_or(usual)
}

/// Numbers as if by chance, the same in each run of a test.
pub struct Chance(Mutex<u64>);

impl Chance {
    pub fn new(seed: u64) -> Chance {
        Chance(Mutex::new(seed))
    }

    pub fn below(&self, end: u64) -> u64 {
        let mut state = self.0.lock().unwrap();
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 33) % end
    }
}
