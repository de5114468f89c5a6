//! Stays in a room that are too short for a person.
//!
//! Annotators mark the frame of a video at which a room changes. After a wrong or a double mark, the person is in a room for a few frames,
//! or passes through it faster than a person walks. No path can follow that. Such a stay counts to the room before or after it, for the path
//! and for the comparison, and the report lists it.
//!
//! We assume that a stay lasts at least a fifth of a second, and that a person does not run from door to door.

use super::house::SphereHouse;
use super::path::{PlacementError, door_between, room_of};
use super::{AnnotatedRun, Interval};
use serde::Serialize;
use std::fmt;
use std::ops::Range;

/// Time in a room below which a person was never in it (our choice: five frames of a video).
const LEAST_STAY_S: f64 = 0.2;

/// Highest walking speed from door to door (our choice: adults begin to run at about this speed).
const FASTEST_WALK_MPS: f64 = 2.0;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShortStay {
    /// Its first row in `location_0.csv`, as a line counted from 1.
    pub line: usize,
    pub room: String,
    pub lasts_s: f64,
    /// Length of the path from the entry door to the exit door; `None`: the stay is too short for any path.
    pub way_m: Option<f64>,
    /// The room before or after it, which gets its time.
    pub counted_to: String,
}

impl fmt::Display for ShortStay {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let ShortStay { line, room, lasts_s, way_m, counted_to } = self;
        write!(f, "location_0.csv:{line}: {lasts_s:.3} s in {room:?} ")?;
        match way_m {
            Some(way_m) => write!(f, "are too short for the {way_m:.1} m from door to door")?,
            None => write!(f, "are too short to be there")?,
        }
        write!(f, ", and count as {counted_to:?}")
    }
}

/// The recording without its short stays, and the short stays in the order of their discovery.
pub fn without_short_stays(
    run: &AnnotatedRun,
    house: &mut SphereHouse,
) -> Result<(AnnotatedRun, Vec<ShortStay>), PlacementError> {
    let (mut run, mut found) = (run.clone(), Vec::new());
    loop {
        let stays = stays(&run);
        // The shortest stays first: their rooms need no door.
        let short = match stays.iter().position(|stay| stay.lasts_s < LEAST_STAY_S) {
            Some(short) => Some((short, None)),
            None => hurried(&stays, house)?,
        };
        match short {
            Some((short, way_m)) => match merge(&mut run, &stays, short, way_m) {
                Some(stay) => found.push(stay),
                None => return Ok((run, found)),
            },
            None => return Ok((run, found)),
        }
    }
}

struct AnnotatedStay {
    room: String,
    rows: Range<usize>,
    lasts_s: f64,
}

/// The stays of a recording: successive rows of one room are one stay, which lasts until the next starts.
fn stays(run: &AnnotatedRun) -> Vec<AnnotatedStay> {
    let mut first = 0;
    let stays = run.rooms.chunk_by(|a, b| a.name == b.name).map(|rows| {
        let begin_s = if first == 0 { run.begin_s() } else { rows[0].start_s };
        let end_s = run.rooms.get(first + rows.len()).map_or(run.end_s(), |next| next.start_s);
        first += rows.len();
        AnnotatedStay { room: rows[0].name.clone(), rows: first - rows.len()..first, lasts_s: end_s - begin_s }
    });
    stays.collect()
}

/// The first stay in which a person would have to run from door to door, with the distance.
fn hurried(stays: &[AnnotatedStay], house: &mut SphereHouse) -> Result<Option<(usize, Option<f64>)>, PlacementError> {
    let mut doors = Vec::new();
    for pair in stays.windows(2) {
        let [before, after] = [&pair[0], &pair[1]];
        let rooms = [room_of(&before.room, house.plan)?, room_of(&after.room, house.plan)?];
        doors.push(door_between(rooms, before.lasts_s < after.lasts_s, house)?);
    }
    for (index, pair) in doors.windows(2).enumerate() {
        let way_m = house.distance_m(pair[0], pair[1]);
        // `path_of` reports a missing path.
        if way_m.is_finite() && stays[index + 1].lasts_s < way_m / FASTEST_WALK_MPS {
            return Ok(Some((index + 1, Some(way_m))));
        }
    }
    Ok(None)
}

/// Adds a stay to the shorter neighbour, which is a passage, too; between two stays in one room, the person never left it.
/// `None` without another stay.
fn merge(run: &mut AnnotatedRun, stays: &[AnnotatedStay], short: usize, way_m: Option<f64>) -> Option<ShortStay> {
    let beside = [short.checked_sub(1), Some(short + 1)].into_iter().flatten().filter_map(|index| stays.get(index));
    let to = beside.min_by(|a, b| a.lasts_s.total_cmp(&b.lasts_s))?;
    let AnnotatedStay { room, rows, lasts_s } = &stays[short];
    let line = run.room_lines[rows.start];
    let neighbour = if to.rows.start < rows.start { rows.start - 1 } else { rows.end };
    // The rows of the new stay become one row, so that they are one visit.
    let is_there = |row: usize| run.rooms.get(row).is_some_and(|row| row.name == to.room);
    let from = rows.start - usize::from(rows.start > 0 && is_there(rows.start - 1));
    let until = rows.end + usize::from(is_there(rows.end));
    let (start_s, end_s) = (run.rooms[from].start_s, run.rooms[until - 1].end_s);
    let neighbour_line = run.room_lines[neighbour];
    run.rooms.splice(from..until, [Interval { start_s, end_s, name: to.room.clone() }]);
    run.room_lines.splice(from..until, [neighbour_line]);
    Some(ShortStay { line, room: room.clone(), lasts_s: *lasts_s, way_m, counted_to: to.room.clone() })
}

#[cfg(test)]
mod tests {
    use super::super::path::path_of;
    use super::super::path::tests::{plan, recording};
    use super::*;
    use homebody_core::drivers::path::form::{PathFile, PathStep};
    use homebody_core::plan::form::Spot;

    const MOVEMENTS: &str = "0-40 a_walk";

    /// The remaining rooms, as `start-end name`, and the reports on the others.
    fn kept(rooms: &str) -> (Vec<String>, Vec<String>) {
        let plan = plan();
        let house = &mut SphereHouse::new(&plan, 0.22);
        let (run, short) = without_short_stays(&recording(rooms, MOVEMENTS), house).unwrap();
        assert_eq!(run.rooms.len(), run.room_lines.len());
        let row = |Interval { start_s, end_s, name }: &Interval| format!("{start_s}-{end_s} {name}");
        (run.rooms.iter().map(row).collect(), short.iter().map(ShortStay::to_string).collect())
    }

    fn fastest_mps(path: &PathFile) -> f64 {
        let at = |spot: &Spot| match spot {
            Spot::At(at) => homebody_core::geometry::point(*at),
            Spot::Place(name) => panic!("{name:?} is a name"),
        };
        let (mut here, mut fastest) = (at(&path.start), 0.0_f64);
        for step in &path.steps {
            if let PathStep::Go(go) = step {
                let points: Vec<_> = [here].into_iter().chain(go.to.iter().map(at)).collect();
                let length_m: f64 = points.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
                fastest = fastest.max(length_m / go.in_s.unwrap());
                here = points[points.len() - 1];
            }
        }
        fastest
    }

    #[test]
    fn a_stay_of_85_ms_between_two_rooms_counts_to_the_shorter_beside_it() {
        let (rooms, said) = kept("0-20 kitchen, 20-20.085 hall, 20.085-40 bedroom");
        assert_eq!(rooms, ["0-20 kitchen", "20-40 bedroom"]);
        assert_eq!(said, ["location_0.csv:3: 0.085 s in \"hall\" are too short to be there, and count as \"bedroom\""]);
        let (rooms, _) = kept("0-10 kitchen, 10-10.085 hall, 10.085-40 bedroom");
        assert_eq!(rooms, ["0-10.085 kitchen", "10.085-40 bedroom"]);
    }

    /// The negative control is the annotated path, which a person cannot walk.
    #[test]
    fn remaining_stays_can_be_walked() {
        let plan = plan();
        let house = &mut SphereHouse::new(&plan, 0.22);
        for rooms in ["0-20 kitchen, 20-20.085 hall, 20.085-40 bedroom", "0-20 kitchen, 20-20.9 hall, 20.9-40 bedroom"]
        {
            let annotated = recording(rooms, MOVEMENTS);
            assert!(fastest_mps(&path_of(&annotated, house).unwrap()) > FASTEST_WALK_MPS, "{rooms}");
            let (run, _) = without_short_stays(&annotated, house).unwrap();
            assert!(fastest_mps(&path_of(&run, house).unwrap()) <= FASTEST_WALK_MPS, "{rooms}");
            assert_eq!((run.begin_s(), run.end_s()), (annotated.begin_s(), annotated.end_s()));
        }
    }

    #[test]
    fn rejects_stays_that_need_running() {
        let (rooms, said) = kept("0-20 kitchen, 20-20.9 hall, 20.9-40 bedroom");
        assert_eq!(rooms, ["0-20 kitchen", "20-40 bedroom"]);
        let [said] = &said[..] else { panic!("{said:?}") };
        assert!(said.starts_with("location_0.csv:3: 0.900 s in \"hall\" are too short for the 2."), "{said}");
        let unhurried = "0-20 kitchen, 20-22 hall, 22-40 bedroom";
        assert_eq!(kept(unhurried).1.len(), 0, "a passage of 2 s is one");
    }

    #[test]
    fn a_room_that_was_never_left_is_one_visit() {
        let (rooms, said) = kept("0-10 kitchen, 10-10.1 hall, 10.1-12 kitchen, 12-40 kitchen");
        assert_eq!(rooms, ["0-12 kitchen", "12-40 kitchen"], "rows that were two remain so");
        assert_eq!(said.len(), 1);
    }

    #[test]
    fn a_stay_at_either_end_has_one_neighbour() {
        assert_eq!(kept("0-0.1 kitchen, 0.1-40 hall").0, ["0-40 hall"]);
        assert_eq!(kept("0-39.9 hall, 39.9-40 bedroom").0, ["0-40 hall"]);
        assert_eq!(
            kept("0-20 hall, 20-20.1 bedroom, 20.1-20.2 hall, 20.2-40 kitchen").0,
            ["0-20.2 hall", "20.2-40 kitchen"]
        );
    }

    #[test]
    fn a_room_of_a_very_short_stay_needs_no_door() {
        assert_eq!(kept("0-20 kitchen, 20-20.1 shed, 20.1-40 kitchen").0, ["0-40 kitchen"]);
        let plan = plan();
        let longer = recording("0-20 kitchen, 20-21 shed, 21-40 kitchen", MOVEMENTS);
        assert!(without_short_stays(&longer, &mut SphereHouse::new(&plan, 0.22)).is_err());
    }
}
