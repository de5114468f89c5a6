//! What homes and logs tell: figures and tables for people and programs.
//!
//! Nothing here reads or writes a file: texts and logs come in, plain data goes out. Nothing here draws. In reading order:

#![warn(missing_docs)]

/// Where in a home the sensors see, from the very fields that make the data.
pub mod coverage;

/// What is put up in a home: devices, places in words, heights and angles; two layouts side by side.
pub mod parts;

/// The messages of this crate.
pub mod catalogue;

/// Dates and hours on the clock on the wall.
pub mod dates;
/// Which rows of a log are signs of somebody, and of which sensors.
pub mod signs;

/// Rows of a log, taken one by one, and the spans that they open and close.
pub mod rows;

/// Motion sensors that stay on, and the movements that their reports hide.
pub mod holds;

pub mod look;

/// Which sensor speaks after which, and how soon.
pub mod walks;

/// How alike two logs are.
pub mod compare;
/// How well a log that was lived again explains the one it was taken from.
pub mod explanation;
/// A log cut into windows, with what sensors said and what somebody did in each.
pub mod windows;
/// A random forest, which tells rows of figures apart.
pub mod forest;
/// How near a log is to a real one, and what gives it away.
pub mod realism;

/// How the motion sensors of a log are timed, and what their messages went through.
pub mod timing;
/// How much somebody moved in each hour of each day, and when nobody was at home.
pub mod density;

/// What a person has been doing, day by day, in figures.
pub mod measures;

mod phrases;

/// What is different from before, and worth a visit.
pub mod alerts;

pub mod summaries;

pub mod falls;

pub mod care;

/// One day: what sensors said, and what residents did.
pub mod day;

/// Moments of a run, with where everybody went in between.
pub mod strip;

#[cfg(test)]
mod sample;
