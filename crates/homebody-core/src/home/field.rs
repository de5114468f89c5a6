//! The field: which sensors see a body of one size, and where, baked into a coarse grid.
//!
//! Each cell holds the sensors that *may* see a body whose centre is in it and those that *surely* do,
//! and for the unsure ones the few beams to test. A movement through the home then costs two
//! masks a cell; beams are looked at only where the masks do not decide. A mask holds a block of
//! `BLOCK` sensors; a home with more has a layer of cells for each block.

use crate::geometry::{self, Point};
use crate::ids::SensorId;
use crate::plan::Plan;
use crate::resident::BodySize;
use crate::sensor_set::{BLOCK, Mask, SensorSet, bit, bits, blocks};
use crate::sensors::Sensor;
use crate::stride::{self, Beam, Stride};
use crate::time::{RunTime, Span};

/// The view of a home's sensors on bodies of one size.
#[derive(Clone, Debug)]
pub struct Field {
    /// The bodies that it was baked for.
    pub size: BodySize,
    /// The sensors' beams, cut by walls, doors and furniture; sensor after sensor.
    pub beams: Vec<Beam>,
    /// The index of each sensor's first beam in `beams`, and the number of all.
    first_beam: Vec<u32>,
    areas: Vec<Option<Vec<Point>>>,
    corner: Point,
    columns: i32,
    rows: i32,
    /// Row by row from the south-west, one layer of `rows` rows after the other for each block of sensors.
    cells: Vec<FieldCell>,
    unsure: Vec<Beams>,
    /// The cell of a body outside the grid, which no sensor sees.
    nowhere: FieldCell,
}

/// The sensors of a block that see a body in a cell, as far as no beam is needed to know it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FieldCell {
    /// Sensors that may see a body here.
    pub may: Mask,
    /// Sensors that see a body wherever it is in here; a part of `may`.
    pub sure: Mask,
    /// The index of the first beam to test, with one entry for each sensor of `may` that is not sure.
    unsure: u32,
}

#[derive(Clone, Copy, Debug)]
struct Beams {
    first: u32,
    end: u32,
}

/// The side of a cell, in metres. Between 0.15 and 0.35 the speed is the same.
const CELL_M: f64 = 0.25;

/// The margin around a cell: more than a body moves in a microsecond.
const SLACK_M: f64 = 1e-4;

impl Field {
    /// Bakes the field for bodies of this size.
    pub fn bake(plan: &Plan, sensors: &[Sensor], size: BodySize) -> Field {
        let mut beams = Vec::new();
        let mut first_beam = vec![0];
        for sensor in sensors {
            beams.extend(sensor.kind.beams(plan, size.top_m));
            first_beam.push(beams.len() as u32);
        }
        let areas = sensors.iter().map(|sensor| sensor.kind.area_below().map(<[Point]>::to_vec)).collect();
        let (least, most) = plan.bounds();
        let corner = least - Point::splat(CELL_M);
        let cells = ((most - corner) / CELL_M).ceil() + Point::ONE;
        let mut field = Field {
            size,
            beams,
            first_beam,
            areas,
            corner,
            columns: cells.x as i32,
            rows: cells.y as i32,
            cells: Vec::new(),
            unsure: Vec::new(),
            nowhere: FieldCell::default(),
        };
        let reaches: Vec<_> = (0..sensors.len()).map(|sensor| field.reach(sensor)).collect();
        for block in 0..blocks(sensors.len()) {
            for row in 0..field.rows {
                for column in 0..field.columns {
                    let cell = field.bake_cell(block, column, row, &reaches);
                    field.cells.push(cell);
                }
            }
        }
        field
    }

    /// The largest distance from the middle of a cell at which a beam touches a body in it.
    fn nearness(&self) -> f64 {
        self.size.radius_m + SLACK_M + (CELL_M / 2.0 + SLACK_M) * std::f64::consts::SQRT_2
    }

    /// The least and the greatest middle of the cells from which a sensor may see.
    fn reach(&self, sensor: usize) -> (Point, Point) {
        let beams = self.beams[self.range(sensor)].iter().flat_map(|beam| [beam.start, beam.end()]);
        let (least, most) = geometry::bounds(beams.chain(self.areas[sensor].iter().flatten().copied()));
        let around = Point::splat(self.nearness() + SLACK_M);
        (least - around, most + around)
    }

    fn bake_cell(&mut self, block: usize, column: i32, row: i32, reaches: &[(Point, Point)]) -> FieldCell {
        let least = self.corner + Point::new(f64::from(column), f64::from(row)) * CELL_M - Point::splat(SLACK_M);
        let most = least + Point::splat(CELL_M + 2.0 * SLACK_M);
        let corners = [least, Point::new(most.x, least.y), most, Point::new(least.x, most.y)];
        let middle = (least + most) / 2.0;
        let around = middle.distance(most);
        let (near, inside) = (self.size.radius_m + SLACK_M, self.size.radius_m - SLACK_M);
        let mut cell = FieldCell { unsure: self.unsure.len() as u32, ..FieldCell::default() };
        let first = block * BLOCK;
        for (sensor, &(from, to)) in reaches.iter().enumerate().skip(first).take(BLOCK) {
            if middle.cmplt(from).any() || middle.cmpgt(to).any() {
                continue;
            }
            let beams = self.range(sensor);
            let may = |beam: &Beam| beam.distance(middle) <= near + around;
            let area = self.areas[sensor].as_deref();
            let over_area = area.is_some_and(|outline| geometry::distance_to_area(outline, middle) <= near + around);
            let first = beams.clone().find(|&beam| may(&self.beams[beam]));
            if first.is_none() && !over_area {
                continue;
            }
            cell.may |= bit(sensor);
            let within = |beam: &Beam| corners.iter().all(|&corner| beam.distance(corner) <= inside);
            let sure = match area {
                Some(outline) => corners.iter().all(|&corner| geometry::distance_to_area(outline, corner) <= inside),
                None => self.beams[beams.clone()].iter().any(within),
            };
            if sure {
                cell.sure |= bit(sensor);
                continue;
            }
            let first = first.unwrap_or(beams.start);
            let last = beams.clone().rev().find(|&beam| may(&self.beams[beam]));
            let end = last.map_or(first, |last| last + 1);
            self.unsure.push(Beams { first: first as u32, end: end as u32 });
        }
        cell
    }

    /// The beams of a sensor.
    pub fn range(&self, sensor: usize) -> std::ops::Range<usize> {
        self.first_beam[sensor] as usize..self.first_beam[sensor + 1] as usize
    }

    /// The entry of a block for the cell of a point.
    #[inline]
    pub(crate) fn cell(&self, block: usize, p: Point) -> &FieldCell {
        let at = (p - self.corner) / CELL_M;
        self.cell_at(self.layer(block), floor(at.x), floor(at.y))
    }

    /// The first instant, not before `now`, at which a body on this stride comes to a cell where a sensor of `want`,
    /// all of one block, may see it; `until` if it comes to none before.
    pub(crate) fn unseen_until(
        &self,
        block: usize,
        stride: &Stride,
        want: Mask,
        now: RunTime,
        until: RunTime,
    ) -> RunTime {
        let layer = self.layer(block);
        let at = (stride.position(now) - self.corner) / CELL_M;
        let (mut column, mut row) = (floor(at.x), floor(at.y));
        if self.cell_at(layer, column, row).may & want != 0 {
            return now.min(until);
        }
        // Along each axis: the step to the next cell, and the microseconds until it and from one to the other.
        let axis = |within: f64, velocity: f64, slowness: f64| {
            let per_cell = CELL_M * slowness;
            if velocity > 0.0 {
                (1, (1.0 - within) * per_cell, per_cell)
            } else if velocity < 0.0 {
                (-1, within * per_cell, per_cell)
            } else {
                (0, f64::INFINITY, 0.0)
            }
        };
        let (Stride { velocity, slowness, .. }, within) = (stride, at - Point::new(f64::from(column), f64::from(row)));
        let (column_step, mut next_column, per_column) = axis(within.x, velocity.x, slowness.x);
        let (row_step, mut next_row, per_row) = axis(within.y, velocity.y, slowness.y);
        let limit = (until - now).micros() as f64;
        loop {
            let entered = next_column.min(next_row);
            if entered >= limit {
                return until;
            }
            if next_column < next_row {
                (column, next_column) = (column + column_step, next_column + per_column);
            } else {
                (row, next_row) = (row + row_step, next_row + per_row);
            }
            if self.cell_at(layer, column, row).may & want != 0 {
                return now + Span::from_micros(entered as i64);
            }
        }
    }

    /// The cells of a block, and of those after it.
    #[inline]
    fn layer(&self, block: usize) -> &[FieldCell] {
        &self.cells[block * (self.rows * self.columns) as usize..]
    }

    #[inline]
    fn cell_at<'a>(&'a self, layer: &'a [FieldCell], column: i32, row: i32) -> &'a FieldCell {
        let on_grid = column >= 0 && row >= 0 && column < self.columns && row < self.rows;
        if on_grid { &layer[(row * self.columns + column) as usize] } else { &self.nowhere }
    }

    /// The microseconds from being at `p` until a body on this stride leaves the cell of `p`; infinite if it
    /// never does.
    pub fn leaves_cell(&self, p: Point, stride: &Stride) -> f64 {
        let at = (p - self.corner) / CELL_M;
        let border = |at: f64, velocity: f64, slowness: f64| {
            let within = at - f64::from(floor(at));
            if velocity > 0.0 {
                (1.0 - within) * CELL_M * slowness
            } else if velocity < 0.0 {
                within * CELL_M * slowness
            } else {
                f64::INFINITY
            }
        };
        let (velocity, slowness) = (stride.velocity, stride.slowness);
        border(at.x, velocity.x, slowness.x).min(border(at.y, velocity.y, slowness.y))
    }

    /// The beams of `sensor`, one of the unsure ones of the cell, that a body in the cell may touch.
    #[inline]
    pub(crate) fn to_test(&self, cell: &FieldCell, sensor: usize) -> &[Beam] {
        let before = (cell.may & !cell.sure) & (bit(sensor) - 1);
        let beams = self.unsure[cell.unsure as usize + before.count_ones() as usize];
        &self.beams[beams.first as usize..beams.end as usize]
    }

    /// Whether `sensor`, one of the unsure ones of the cell, sees a body that moves at `p` in the cell.
    #[inline]
    pub(crate) fn sees_in(&self, cell: &FieldCell, sensor: usize, p: Point) -> bool {
        let touched = |beam: &Beam| stride::touches(beam, p, self.size.radius_m);
        self.over_area(sensor, p) || self.to_test(cell, sensor).iter().any(touched)
    }

    /// Whether `sensor` sees a body that moves at `p`, with no grid in between.
    pub fn sees(&self, sensor: usize, p: Point) -> bool {
        self.over_area(sensor, p)
            || self.beams[self.range(sensor)].iter().any(|beam| stride::touches(beam, p, self.size.radius_m))
    }

    /// Whether the centre `p` is over the area of `sensor`, if it has one.
    #[inline]
    pub(crate) fn over_area(&self, sensor: usize, p: Point) -> bool {
        self.areas[sensor].as_deref().is_some_and(|outline| geometry::contains(outline, p))
    }

    /// All sensors that see a body that moves at `p`.
    pub fn seen_at(&self, p: Point) -> SensorSet {
        let of_block = |block: usize| {
            let cell = self.cell(block, p);
            let seeing = move |&sensor: &usize| cell.sure & bit(sensor) != 0 || self.sees_in(cell, sensor, p);
            bits(cell.may).map(move |number| block * BLOCK + number).filter(seeing)
        };
        (0..blocks(self.areas.len())).flat_map(of_block).map(SensorId::new).collect()
    }
}

/// The greatest whole number not above `x`; a cast and a comparison are faster than the general function.
fn floor(x: f64) -> i32 {
    let whole = x as i32;
    whole - i32::from(f64::from(whole) > x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::home::form::HomeFile;
    use serde_json::{Value, json};

    /// A room 6 by 4 without walls; on its western side, at y = 2, a lens at the very edge with one beam to the east; over
    /// the square from (4, 0.5) to (5, 1.5) a ceiling sensor.
    fn field(furniture: Value, walls: Value, top_m: f64) -> Field {
        let home: Result<HomeFile, _> = serde_json::from_value(json!({
            "name": "home", "walls": walls, "furniture": furniture,
            "rooms": [{ "name": "room", "outline": [[0, 0], [6, 0], [6, 4], [0, 4]] }],
            "sensors": [
                { "name": "wall", "kind": "motion", "at": [-0.02, 2], "height_m": 2.1, "facing_deg": 0, "beams": 1 },
                { "name": "ceiling", "kind": "ceiling_motion", "area": [[4, 0.5], [5, 0.5], [5, 1.5], [4, 1.5]] },
            ],
        }));
        let home = home.expect("a home");
        let plan = Plan::new(&home);
        let sensors: Vec<Sensor> =
            home.sensors.iter().map(|sensor| Sensor::new(sensor, &plan).expect("a place")).collect();
        Field::bake(&plan, &sensors, BodySize { radius_m: 0.2, top_m })
    }

    /// The lit parts of the wall sensor's beam, as distances from its lens.
    fn lit(field: &Field) -> Vec<(f64, f64)> {
        field.beams[field.range(0)].iter().map(|beam| (beam.start.x, beam.end().x)).collect()
    }

    fn close(found: &[(f64, f64)], expected: &[(f64, f64)]) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
        found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| near(a.0, b.0) && near(a.1, b.1))
    }

    const STANDING_M: f64 = 1.65;
    const SITTING_M: f64 = 1.32;
    const LYING_M: f64 = 0.66;

    fn piece(height_m: f64, enterable: bool) -> Value {
        json!([{ "name": "piece", "at": [2.5, 2], "size_m": [1, 1], "height_m": height_m, "enterable": enterable }])
    }

    #[test]
    fn behind_a_sideboard_who_stands_is_seen_and_who_sits_is_not() {
        // From 2.1 m over 1.5 m at 3 m the sight line falls 0.2 m a metre: at 1.32 m after 3.9 m, at 0.66 m after 7.2 m.
        let [standing, sitting, lying] =
            [STANDING_M, SITTING_M, LYING_M].map(|top_m| field(piece(1.5, false), json!([]), top_m));
        // 0.45, 0.78 and 1.44 m below the lens at the fan's lower end, 48 degrees down.
        assert!(close(&lit(&standing), &[(0.405182, 10.0)]), "{:?}", lit(&standing));
        assert!(close(&lit(&sitting), &[(0.702315, 2.0), (3.9, 10.0)]), "{:?}", lit(&sitting));
        assert!(close(&lit(&lying), &[(1.296582, 2.0), (7.2, 10.0)]), "{:?}", lit(&lying));
        // A body of 0.2 m shows its edge from 3.7 m on.
        let sees = |field: &Field, x: f64| field.sees(0, Point::new(x, 2.0));
        assert_eq!([3.4, 3.69, 3.71].map(|x| sees(&standing, x)), [true, true, true]);
        assert_eq!([3.4, 3.69, 3.71].map(|x| sees(&sitting, x)), [false, false, true]);
        assert_eq!([3.4, 3.69, 3.71].map(|x| sees(&lying, x)), [false, false, false]);
    }

    #[test]
    fn behind_a_low_table_only_who_lies_is_hidden() {
        assert!(close(&lit(&field(piece(0.75, false), json!([]), SITTING_M)), &[(0.702315, 10.0)]));
        // From 2.1 m over 0.75 m at 3 m it falls 0.45 m a metre: at 0.66 m after 3.2 m.
        let lying = field(piece(0.75, false), json!([]), LYING_M);
        assert!(close(&lit(&lying), &[(1.296582, 2.0), (3.2, 10.0)]), "{:?}", lit(&lying));
        // On a bed of that height a body lies in view, and so does one next to it from 3.2 m on.
        let bed = field(piece(0.75, true), json!([]), LYING_M);
        assert!(close(&lit(&bed), &[(1.296582, 3.0), (3.2, 10.0)]), "{:?}", lit(&bed));
    }

    #[test]
    fn walls_and_what_is_as_high_as_the_lens_end_a_beam() {
        let wall = json!([{ "from": [5, 0], "to": [5, 4] }]);
        assert!(close(&lit(&field(json!([]), wall, STANDING_M)), &[(0.405182, 4.95)]));
        assert!(close(&lit(&field(piece(2.1, false), json!([]), STANDING_M)), &[(0.405182, 2.0)]));
    }

    #[test]
    fn a_body_is_seen_over_an_area_and_a_radius_around_it() {
        let field = field(json!([]), json!([]), STANDING_M);
        let seen = |x, y| field.seen_at(Point::new(x, y)).iter().fold(0, |mask, sensor| mask | bit(sensor.index()));
        assert_eq!(seen(4.5, 1.0), 0b10);
        assert_eq!([seen(3.81, 1.0), seen(3.79, 1.0)], [0b10, 0]);
        // Off the corner (4, 0.5) by 0.1 and 0.17, 0.197 m; by 0.15 and 0.15, 0.212 m.
        assert_eq!([seen(3.9, 0.33), seen(3.85, 0.35)], [0b10, 0]);
        // Beside the beam, and where beam and area are both in reach: 0.15 m from the one, 0.35 from the other.
        assert_eq!([seen(2.0, 2.19), seen(2.0, 2.21)], [0b01, 0]);
        assert_eq!([seen(4.5, 1.85), seen(4.5, 1.69)], [0b01, 0b10]);
    }

    #[test]
    fn the_grid_begins_one_cell_outside_the_plan() {
        let field = field(json!([]), json!([]), STANDING_M);
        assert_eq!(field.corner, Point::new(-0.25, -0.25));
        // (6.25 / 0.25 + 1) by (4.25 / 0.25 + 1) cells.
        assert_eq!((field.columns, field.rows), (26, 18));
        assert_eq!(field.cell(0, Point::new(100.0, 1.0)).may, 0);
        assert_eq!(field.cell(0, Point::new(-100.0, 1.0)).may, 0);
    }

    #[test]
    fn a_cell_is_left_at_the_first_of_its_borders() {
        let field = field(json!([]), json!([]), STANDING_M);
        let at = Point::new(0.1, 3.1);
        let leaves = |dx: f64, dy: f64| {
            let end = RunTime::START + Span::from_seconds(1.0);
            field.leaves_cell(at, &Stride::new(at, at + Point::new(dx, dy), RunTime::START, end))
        };
        // Its borders are x = 0, 0.25 and y = 3, 3.25.
        assert!((leaves(1.0, 0.0) - 150_000.0).abs() < 1e-3);
        assert!((leaves(-1.0, 0.0) - 100_000.0).abs() < 1e-3);
        assert!((leaves(0.6, 0.8) - 187_500.0).abs() < 1e-3);
        assert!((leaves(1.0, -1.0) - 100_000.0).abs() < 1e-3);
        assert_eq!(leaves(0.0, 0.0), f64::INFINITY);
    }

    #[test]
    fn a_walk_is_unseen_until_it_comes_to_a_cell_where_it_may_be_seen() {
        let field = field(json!([]), json!([]), STANDING_M);
        let ceiling = 0b10;
        let stride = |from: (f64, f64), to: (f64, f64)| {
            let (from, to) = (Point::from(from), Point::from(to));
            Stride::new(from, to, RunTime::START, RunTime::START + Span::from_seconds(from.distance(to)))
        };
        // Cells may be seen whose middle is at most 0.2 + 0.125 * sqrt(2) = 0.377 m from the area: along y = 0.9, in the
        // row from 0.75 to 1, those from x = 3.5 on, with middle 3.625.
        let along = stride((0.1, 0.9), (5.9, 0.9));
        let unseen_until = |stride, want, now, until| {
            field.unseen_until(0, stride, want, RunTime::from_micros(now), RunTime::from_micros(until)).micros()
        };
        let until = 10_000_000;
        assert!((unseen_until(&along, ceiling, 0, until) - 3_400_000).abs() <= 1);
        assert!((unseen_until(&along, ceiling, 1_000_000, until) - 3_400_000).abs() <= 1);
        assert_eq!(unseen_until(&along, ceiling, 4_000_000, until), 4_000_000);
        assert_eq!(unseen_until(&along, ceiling, 0, 3_000_000), 3_000_000);
        // Never a sensor that is not asked for, nor one that is passed.
        assert_eq!(unseen_until(&along, 0b01, 0, 5_000_000), 5_000_000);
        let past = stride((0.1, 3.5), (5.9, 3.5));
        assert_eq!(unseen_until(&past, 0b11, 0, 5_000_000), 5_000_000);
        // From the other side: the last such cell ends at x = 5.5.
        let back = stride((5.9, 0.9), (0.1, 0.9));
        assert!((unseen_until(&back, ceiling, 0, until) - 400_000).abs() <= 1);
    }

    #[test]
    fn whole_numbers_below_go_down_for_negative_ones() {
        assert_eq!([-1.5, -1.0, -0.1, 0.0, 0.9, 7.0].map(floor), [-2, -1, -1, 0, 0, 7]);
    }
}
