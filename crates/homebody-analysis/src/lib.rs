//! Figures and tables of homes and logs, for people and programs.
//!
//! Nothing here reads or writes a file: texts and logs come in, plain data goes out. Nothing here draws. In reading order:

/// The floor that sensors see, from the fields that make the data.
pub mod coverage;

/// The parts list of a home: devices, places in words, heights and angles; two layouts side by side.
pub mod parts;

/// The messages of this crate.
pub mod catalogue;

/// Dates and hours on the clock on the wall.
pub mod dates;
/// The rows of a log that are signs of a person, and the kinds of sensors.
pub mod signs;

/// Rows of a log, one by one, and the spans that they open and close.
pub mod rows;

/// Motion sensors that stay on, and the movements that their reports hide.
pub mod holds;

pub mod look;

/// The order in which sensors fire, and the times between.
pub mod walks;

/// Comparison of two logs.
pub mod compare;
/// Explanation of a log by one of a repeated simulation.
pub mod explanation;
/// Windows of a log, with the messages of sensors and the activities in each.
pub mod windows;
/// A random forest, which separates rows of figures.
pub mod forest;
/// The distance of a log from a real one, and what gives it away.
pub mod realism;

/// The timing of the motion sensors of a log, and the effects of its link.
pub mod timing;
/// The movement in each hour of each day, and absences.
pub mod density;

/// Measures of each day of a person.
pub mod measures;

mod phrases;

/// Episodes: days differ from a reference for some time.
pub mod episodes;

/// Alerts by rules of the user's own.
pub mod alerts;

pub mod summaries;

pub mod falls;

pub mod care;

/// One day: the firings of sensors and the activities of residents.
pub mod day;

/// Moments of a run, with everybody's ways in between.
pub mod strip;

#[cfg(test)]
mod sample;
