//! Writes a log anew without its identity: other dates, other names, no free text.
//!
//! Dates are shifted by whole weeks, so that days of the week and times of day stay; sensors get the caller's names. Rows whose value is
//! neither a number nor a word of sensors are left out, with all other facts about sensors.
//!
//! The habits of a resident remain visible, and may be known to an acquaintance.

use super::convert::convert_as;
use super::{Rewrite, Transfer};
use crate::error::LogError;
use crate::log::Log;
use crate::read::stream;
use homebody_core::time::{DAY, WallTime};
use homebody_timeline::Episode;

/// The way in which a log is made anonymous.
pub struct Anonymising<'a> {
    /// By how many weeks dates are shifted; `None` for as many as bring the first week to that of 1 January 2001, a Monday.
    pub weeks: Option<i64>,
    /// The new names of the sensors, in the order of the log.
    pub names: &'a [String],
    /// Whether a value may stay.
    pub keeps: &'a dyn Fn(&str) -> bool,
    /// Whether the new log has the activities, with their labels.
    pub with_activities: bool,
}

/// The result for a log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Anonymised {
    /// Rows that are written.
    pub rows: u64,
    /// Rows that say free text, and are left out.
    pub left_out: u64,
}

/// 1 January 2001, in days since 1970.
const MONDAY: i64 = 11_323;
const WEEK: i64 = 7;

/// Writes an anonymous log; `about` is its [`survey`](crate::read::survey), and `progress` gets the number of written rows.
///
/// # Errors
///
/// As of [`convert`](crate::convert()).
pub fn anonymise(
    transfer: &Transfer,
    about: &Log,
    by: &Anonymising,
    mut progress: impl FnMut(u64),
) -> Result<Anonymised, LogError> {
    let keeps: Vec<bool> = about.values.iter().map(|value| (by.keeps)(value)).collect();
    let (mut rows, mut first) = (0, WallTime::MAX);
    stream(transfer.from, transfer.mapping, &mut |part| {
        for event in part.events.iter().filter(|event| keeps[event.value as usize]) {
            (rows, first) = (rows + 1, first.min(event.at));
        }
        Ok(())
    })?;
    let first = about.activities.iter().map(Episode::begin).chain([first]).min().filter(|&at| at != WallTime::MAX);
    let weeks = by.weeks.unwrap_or_else(|| (MONDAY - monday(first.unwrap_or_default())) / WEEK);
    let shift = weeks * WEEK * DAY;
    let activities = about.activities.iter().filter(|_| by.with_activities);
    let shifted = |of: &Episode<WallTime>| of.clone().map(|at| at + shift);
    let nobodys = Log {
        sensors: by.names.to_vec(),
        activities: activities.map(shifted).collect(),
        rows,
        clock: about.clock,
        ..Log::default()
    };
    let rewrite = Rewrite { shift, sensors: by.names, keeps: &keeps };
    let written = convert_as(transfer, &nobodys, Some(&rewrite), &mut progress)?;
    Ok(Anonymised { rows: written, left_out: about.rows - rows })
}

/// The Monday before an instant, or its day if it is one, in days since 1970, which began on a Thursday.
fn monday(at: WallTime) -> i64 {
    let day = at.day_number();
    day - (day + 3).rem_euclid(WEEK)
}
