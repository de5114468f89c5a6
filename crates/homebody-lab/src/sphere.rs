//! Real and simulated motion sensors: the recordings of the SPHERE challenge.
//!
//! In each recording, one person follows a script for half an hour in a house with one motion sensor in each of nine rooms. A camera on
//! the person's head showed annotators the room and the kind of movement, to the second (Twomey et al. 2016). The response of the real
//! sensors to a known movement is therefore known, and can be compared with a simulation of the same movement.
//!
//! We assume that the room and the kind of movement are true. The position in the room is unknown, so the simulated person walks between
//! points that we choose, at the annotated times. The real data also have the movements of other people, which no simulation has.
//!
//! `parse` reads a recording, `without_short_stays` omits stays that no person can walk, `path_of` makes a path, `SphereExperiment::run`
//! simulates the path in the house and `hold`s the firings, and `compare_runs` compares both.
//!
//! Left out: the accelerometer, the cameras, and the time before the first and after the last annotation.

mod compare;
mod comparison;
mod experiment;
mod house;
mod located;
mod parse;
mod path;
#[cfg(test)]
mod real_data;
mod short_stays;
mod words;

pub use compare::{compare_run, compare_runs, hold};
pub use comparison::Comparison;
pub use experiment::{RecordingResult, SphereError, SphereExperiment};
pub use house::SphereHouse;
pub use parse::{RecordingTexts, RowMessage, SphereRowError, parse};
pub use path::{PlacementError, path_of};
pub use short_stays::{ShortStay, without_short_stays};

use serde::Serialize;

/// A row of a file of a recording. Seconds count from the start of the recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Interval {
    pub start_s: f64,
    pub end_s: f64,
    pub name: String,
}

#[derive(Clone, Debug, PartialEq)]
pub struct AnnotatedRun {
    /// The rooms of the person, in order of time and without overlaps; never empty.
    pub rooms: Vec<Interval>,
    /// The line of each room in `location_0.csv`, counted from 1.
    pub room_lines: Vec<usize>,
    /// The movements of the person, in order of time and without overlaps.
    pub movements: Vec<Interval>,
    /// The ON times of each room's motion sensor, in order of time.
    pub pir: Vec<Interval>,
    /// The rooms by a second annotator.
    pub second_rooms: Option<Vec<Interval>>,
}

impl AnnotatedRun {
    /// The first annotated instant: second 0 of the path and of the comparison.
    pub fn begin_s(&self) -> f64 {
        let first = |intervals: &[Interval]| intervals.first().map_or(f64::INFINITY, |interval| interval.start_s);
        first(&self.rooms).min(first(&self.movements))
    }

    pub fn end_s(&self) -> f64 {
        let last = |intervals: &[Interval]| intervals.last().map_or(f64::NEG_INFINITY, |interval| interval.end_s);
        last(&self.rooms).max(last(&self.movements))
    }

    /// The seconds on which both annotators named the same room, and those on which both named one.
    pub fn annotators_agree(&self) -> Option<(u64, u64)> {
        let second = self.second_rooms.as_ref()?;
        let moments = moments(self.begin_s(), self.end_s());
        let pairs = moments.filter_map(|at| at_moment(&self.rooms, at).zip(at_moment(second, at)));
        Some(pairs.fold((0, 0), |(same, all), (first, second)| (same + u64::from(first == second), all + 1)))
    }
}

/// The middle of each whole second of a span.
fn moments(begin_s: f64, end_s: f64) -> impl Iterator<Item = f64> {
    (0..(end_s - begin_s).max(0.0) as u64).map(move |second| begin_s + second as f64 + 0.5)
}

/// The name of the interval at a moment; the intervals are in order and do not overlap.
fn at_moment(intervals: &[Interval], at_s: f64) -> Option<&str> {
    let begun = intervals.partition_point(|interval| interval.start_s <= at_s);
    intervals[..begun].last().filter(|interval| at_s < interval.end_s).map(|interval| interval.name.as_str())
}
