//! The distances from sensor to sensor in a known home, along the ways that people walk.
//!
//! A way leads from the middle of the field of one sensor to the middle of another's. On it a person comes into the view of others, each so
//! many metres from its beginning. The caller finds the ways: this module knows views alone.

use crate::coverage;
use homebody_core::geometry::Point;
use homebody_core::home::form::HomeFile;
use homebody_core::ids::SensorId;
use homebody_core::resident::Build;
use std::collections::BTreeMap;

/// Side of a cell of the sensors' fields, and step along a way, in metres (our choice).
const CELL_M: f64 = 0.1;
const STEP_M: f64 = 0.05;

#[derive(Clone, Copy, Debug)]
pub struct HomeKnowledge<'a> {
    /// The rooms of sensors; empty if only names tell them.
    pub rooms: &'a BTreeMap<String, String>,
    pub ways: Option<&'a Ways>,
}

#[derive(Clone, Debug, Default)]
pub struct Ways {
    /// By all names that a sensor may have in a log: its number here.
    numbers: BTreeMap<String, usize>,
    ways: Vec<Vec<Option<ViewEntries>>>,
}

/// A way from one sensor to another: the sensors whose view it enters, in metres from the beginning.
type ViewEntries = Vec<(usize, f64)>;

impl Ways {
    /// Of a home. `path` finds the corners of a way, without its beginning; `called` says what a sensor is called in logs
    /// besides its name.
    pub fn from_home(
        home: &HomeFile,
        path: &dyn Fn(Point, Point) -> Option<Vec<Point>>,
        called: &dyn Fn(&str) -> Vec<String>,
    ) -> Ways {
        let seen = coverage::of_home(home, Build::adult(), CELL_M);
        let grid = &seen.coverage.grid;
        let middles: Vec<Option<Point>> = (0..seen.sensors.len())
            .map(|sensor| {
                let sees =
                    |cell: &usize| grid.cells[*cell].as_ref().is_some_and(|seen| seen.contains(SensorId::new(sensor)));
                let cells: Vec<Point> = (0..grid.cells.len()).filter(sees).map(|cell| grid.middle(cell)).collect();
                let middle = cells.iter().fold(Point::ZERO, |sum, cell| sum + *cell) / cells.len().max(1) as f64;
                cells.into_iter().min_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)))
            })
            .collect();
        let way = |from: usize, to: usize| {
            let (begin, end) = (middles[from]?, middles[to]?);
            let corners = path(begin, end).filter(|corners| !corners.is_empty())?;
            Some(along(begin, &corners, seen.sensors.len(), &|sensor, p| seen.field.sees(sensor, p)))
        };
        let count = seen.sensors.len();
        let ways = (0..count).map(|from| (0..count).map(|to| way(from, to)).collect()).collect();
        let mut numbers = BTreeMap::new();
        for (number, sensor) in seen.sensors.iter().enumerate() {
            numbers.insert(sensor.name.clone(), number);
            numbers.extend(called(&sensor.name).into_iter().map(|name| (name, number)));
        }
        Ways { numbers, ways }
    }

    pub fn number(&self, name: &str) -> Option<usize> {
        self.numbers.get(name).copied()
    }

    /// The metres from the view of `from` to the view of `to`, on the way from `before`.
    pub fn walked_m(&self, before: usize, from: usize, to: usize) -> Option<f64> {
        let way = self.ways[before][to].as_ref()?;
        let comes = |sensor: usize| way.iter().find(|(other, _)| *other == sensor).map(|(_, at)| *at);
        Some(comes(to)? - comes(from)?)
    }
}

fn along(begin: Point, corners: &[Point], sensors: usize, sees: &dyn Fn(usize, Point) -> bool) -> ViewEntries {
    let mut comes_m = Vec::new();
    let mut was_seen: Vec<bool> = (0..sensors).map(|sensor| sees(sensor, begin)).collect();
    let (mut gone, mut at) = (0.0, begin);
    for &corner in corners {
        let length = at.distance(corner);
        let steps = (length / STEP_M).ceil().max(1.0) as usize;
        for step in 1..=steps {
            let part = step as f64 / steps as f64;
            let p = at + (corner - at) * part;
            for (sensor, was_seen) in was_seen.iter_mut().enumerate() {
                let is_seen = sees(sensor, p);
                if is_seen && !*was_seen {
                    comes_m.push((sensor, gone + length * part));
                }
                *was_seen = is_seen;
            }
        }
        (gone, at) = (gone + length, corner);
    }
    comes_m
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of three rooms, each seen by one sensor in its middle.
    fn row() -> Ways {
        let home: HomeFile = serde_json::from_str(
            r#"{ "name": "row", "rooms": [{ "name": "hall", "outline": [[0, 0], [9, 0], [9, 2], [0, 2]] }], "walls": [],
                 "sensors": [
                   { "kind": "ceiling_motion", "name": "a", "area": [[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [0.5, 1.5]] },
                   { "kind": "ceiling_motion", "name": "b", "area": [[4, 0.5], [5, 0.5], [5, 1.5], [4, 1.5]] },
                   { "kind": "ceiling_motion", "name": "c", "area": [[7, 0.5], [8, 0.5], [8, 1.5], [7, 1.5]] }
                 ] }"#,
        )
        .unwrap();
        Ways::from_home(&home, &|_, to| Some(vec![to]), &|name| vec![format!("M{name}")])
    }

    #[test]
    fn ways_lead_from_view_to_view() {
        let ways = row();
        assert_eq!((ways.number("a"), ways.number("Mc"), ways.number("d")), (Some(0), Some(2), None));
        let is = |metres: Option<f64>, about: f64| metres.is_some_and(|metres| (metres - about).abs() < 0.15);
        // A body of 0.2 m is seen before its middle is over an area. From coming into the view of the second to coming into that of the third.
        assert!(is(ways.walked_m(0, 1, 2), 3.0), "{:?}", ways.walked_m(0, 1, 2));
        assert_eq!(ways.walked_m(1, 0, 2), None, "the first is not on that way");
    }
}
