//! What a home tells of the sensors of a log.

use super::ways::Ways;
use std::collections::BTreeMap;

/// What is known of the home of a log.
#[derive(Clone, Copy, Debug)]
pub struct Known<'a> {
    /// Which sensors are in which rooms; empty where only names tell it.
    pub rooms: &'a BTreeMap<String, String>,
    /// How far it is from sensor to sensor, where that is known.
    pub ways: Option<&'a Ways>,
}
