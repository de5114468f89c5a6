//! Questions about homes and logs: pure analysis, and the pictures of its answers.
//!
//! Nothing here reads or writes a file: texts and logs come in, figures and pictures go out. In reading order:

/// Where in a home the sensors see, from the very fields that make the data.
pub mod coverage;

/// Dates on the clock on the wall, and which rows of a log are signs of somebody.
pub mod dates;
pub mod signs;

/// How alike two logs are.
pub mod compare;

/// How much somebody moved in each hour of each day, and when nobody was at home.
pub mod density;

/// One day: what sensors said, and what residents did.
pub mod day;

/// What was measured in the real world, done again.
pub mod godsey2009;
pub mod sphere;

/// Generated lives beside what was measured of real ones.
pub mod daily_life;

/// Floor plans, maps and charts.
pub mod picture;

#[cfg(test)]
mod sample;
