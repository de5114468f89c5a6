//! An overview of a log: its span, its sensors and their kinds, and its oddities.
//!
//! | word | meaning |
//! |---|---|
//! | repeated | a row says that what is on already comes on, such as an ON after an ON |
//! | missing | a row says that something ends that has not begun, such as an OFF without an ON: that row was lost |
//! | doubled | a row is the sensor's last once more: the same instant, the same value |
//! | set back | a row is earlier than the one before it |
//! | silence | nothing says anything for 12 h or more |
//! | dead | a sensor says nothing more for two days or more before the log ends, and for three times as long as ever before |
//! | stuck | a motion sensor is on for 6 h or more; or all of 50 readings or more over a day are one number |
//! | not known | a row says that the state of the sensor is not known, such as `unavailable` |
//! | restored | a row says the state again after an unknown time: after such a row, or after a gap of the recorder |
//!
//! It keeps no row, so a log may be of any size. A log with its newest rows first, or with its rows sensor by sensor, is read again in the
//! order of time, as far as so many rows can wait. All lengths are our choice.

mod counts;
mod overview;
mod home;
mod looker;
mod order;
mod sensor;
mod words;

pub use looker::{Looker, looked};
pub use overview::{
    ActivityLook, HomeSensor, LogOverview, LogSilence, Misfit, OfHome, SensorLook, SensorTrouble, UnlistedSensor,
};

#[cfg(test)]
mod tests;
