//! Real motion sensors against simulated ones: the recordings of the SPHERE challenge.
//!
//! What it is about: in each recording one person follows a script for half an hour in a house with one
//! motion sensor in each of nine rooms, and a camera on their head told annotators, to the second, in
//! which room they were and how they moved (Twomey et al. 2016). So the real sensors' answer to a
//! known movement is known, and a simulation of the same movement can be held against it.
//!
//! What we assume: the room and the kind of movement are true; where in the room the person
//! was is not known, so they walk between points that we choose, at the annotated times. Whatever
//! a sensor sees of others in the house is in the real data and in no simulation.
//!
//! How: `parse` reads a recording, `without_short_stays` leaves out what nobody can live, `path_of` makes a path of it, `Experiment::run` acts that path out in the
//! house and `hold`s the firings, and `compare_runs` puts both in numbers and in words.
//!
//! What is left out: the accelerometer, the cameras, and what happened before the first
//! and after the last annotation.

mod compare;
mod comparison;
mod experiment;
mod house;
mod parse;
mod path;
#[cfg(test)]
mod real_data;
mod short_stays;
mod walked_back;
mod words;

pub use compare::{compare_run, compare_runs, hold};
pub use comparison::{Comparison, Figures, Finding, RoomComparison};
pub use experiment::{Experiment, Recording, Undone};
pub use house::House;
pub use parse::{BadRow, RowMessage, Texts, parse};
pub use path::{Unplaced, path_of};
pub use short_stays::{ShortStay, without_short_stays};
pub use walked_back::WalkedBack;

use serde::Serialize;

/// A row of any of the recording's files: something that lasted for a time. Seconds count from the
/// recording's start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Interval {
    pub start_s: f64,
    pub end_s: f64,
    pub name: String,
}

/// A recording of one person.
#[derive(Clone, Debug, PartialEq)]
pub struct AnnotatedRun {
    /// In which room the person was, in order of time and without overlaps; never empty.
    pub rooms: Vec<Interval>,
    /// The row of each of the rooms in `location_0.csv`, as a line counted from 1.
    pub room_lines: Vec<usize>,
    /// How the person moved, in order of time and without overlaps.
    pub movements: Vec<Interval>,
    /// When each room's motion sensor was ON, in order of time.
    pub pir: Vec<Interval>,
    /// The rooms as a second annotator saw them.
    pub second_rooms: Option<Vec<Interval>>,
}

impl AnnotatedRun {
    /// The first annotated instant: second 0 of the path, and the first that is compared.
    pub fn begin_s(&self) -> f64 {
        let first = |intervals: &[Interval]| intervals.first().map_or(f64::INFINITY, |interval| interval.start_s);
        first(&self.rooms).min(first(&self.movements))
    }

    /// The last annotated instant.
    pub fn end_s(&self) -> f64 {
        let last = |intervals: &[Interval]| intervals.last().map_or(f64::NEG_INFINITY, |interval| interval.end_s);
        last(&self.rooms).max(last(&self.movements))
    }

    /// On how many seconds both annotators named the same room, and on how many both named one.
    pub fn annotators_agree(&self) -> Option<(u64, u64)> {
        let second = self.second_rooms.as_ref()?;
        let moments = moments(self.begin_s(), self.end_s());
        let pairs = moments.filter_map(|at| at_moment(&self.rooms, at).zip(at_moment(second, at)));
        Some(pairs.fold((0, 0), |(same, all), (first, second)| (same + u64::from(first == second), all + 1)))
    }
}

/// The middles of the whole seconds of a span.
fn moments(begin_s: f64, end_s: f64) -> impl Iterator<Item = f64> {
    (0..(end_s - begin_s).max(0.0) as u64).map(move |second| begin_s + second as f64 + 0.5)
}

/// The name of what lasts at this moment, of intervals in order of time that do not overlap.
fn at_moment(intervals: &[Interval], at_s: f64) -> Option<&str> {
    let begun = intervals.partition_point(|interval| interval.start_s <= at_s);
    intervals[..begun].last().filter(|interval| at_s < interval.end_s).map(|interval| interval.name.as_str())
}
