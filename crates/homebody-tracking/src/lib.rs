//! Locates people by the log of their home, finds faulty sensors, and fits a scenario to a log.
//!
//! `homebody-infer` has the model; this crate applies it to a log by its name and a scenario, and simulates the result. It does not know
//! who asks, nor how an answer is shown. Reading order:

mod error;
pub mod catalogue;

mod translation;
mod follower;
mod health;

pub mod located_folder;

mod calibration;

pub use calibration::{Calibration, CalibrationMessage, FiringRates, Fitted, SensorSight, calibrate, simulated_log};
pub use error::TrackingError;
pub use follower::{FollowedHome, LogFollower, PersonLocation};
pub use health::{Health, SensorFinding, health};
pub use translation::{
    LEAST_CHANGE, PersonStay, PlaceChance, PossiblePlace, Translation, TranslationMessage, locate, sensors_of_home,
};
