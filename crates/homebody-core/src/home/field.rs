//! The field: which sensors see a body of one size, and where, baked into a coarse grid.
//!
//! Each cell holds the sensors that *may* see a body whose centre is in it and those that *surely* do,
//! and for the unsure ones the few beams to test. A movement through the home then costs two
//! masks a cell; beams are looked at only where the masks do not decide.

use super::bake;
use super::plan::Plan;
use crate::geometry::{self, Point};
use crate::sensors::{Kind, Sensor};
use crate::stride::{self, Beam, Stride};
use crate::time::Micros;

/// One bit a sensor. A home has at most [`MAX_SENSORS`].
pub type Mask = u128;

/// How many sensors a home may have: the bits of a [`Mask`].
pub const MAX_SENSORS: usize = 128;

/// The numbers of the bits that are set, least first.
pub fn bits(mut mask: Mask) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = (mask != 0).then(|| mask.trailing_zeros() as usize)?;
        mask &= mask - 1;
        Some(bit)
    })
}

/// A body as sensors see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    pub radius_m: f64,
    /// How high it reaches in its posture.
    pub top_m: f64,
}

/// What the sensors of a home see of bodies of one size.
#[derive(Clone, Debug)]
pub struct Field {
    pub size: Size,
    pub beams: Vec<Beam>,
    /// Where each sensor's beams begin in `beams`, and one more number for the end.
    first_beam: Vec<u32>,
    /// The outlines of ceiling sensors, by sensor.
    areas: Vec<Option<Vec<Point>>>,
    corner: Point,
    columns: i32,
    rows: i32,
    cells: Vec<Cell>,
    unsure: Vec<Beams>,
    /// The cell of whoever is outside the grid: nobody sees them.
    nowhere: Cell,
}

/// What is known of a cell before any beam is looked at.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cell {
    /// Sensors that may see a body here.
    pub may: Mask,
    /// Sensors that see a body wherever it is in here; a part of `may`.
    pub sure: Mask,
    /// Where this cell's beams to test begin, one entry for each sensor of `may` that is not sure.
    unsure: u32,
}

/// The beams of one sensor that a body in a cell may touch.
#[derive(Clone, Copy, Debug)]
struct Beams {
    first: u32,
    end: u32,
}

/// The side of a cell, in metres. Between 0.15 and 0.35 the speed is the same.
const CELL_M: f64 = 0.25;

/// How much larger than itself a cell is taken to be: more than a body moves in a microsecond.
const SLACK_M: f64 = 1e-4;

impl Field {
    /// Bakes the field for bodies of this size.
    pub fn bake(plan: &Plan, sensors: &[Sensor], size: Size) -> Field {
        let mut beams = Vec::new();
        let mut first_beam = vec![0];
        for sensor in sensors {
            beams.extend(bake::beams(sensor, plan, size.top_m));
            first_beam.push(beams.len() as u32);
        }
        let areas = sensors
            .iter()
            .map(|sensor| match &sensor.kind {
                Kind::CeilingMotion(area) => Some(area.outline.clone()),
                Kind::Motion(_) => None,
            })
            .collect();
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
            nowhere: Cell::default(),
        };
        for row in 0..field.rows {
            for column in 0..field.columns {
                let cell = field.bake_cell(column, row);
                field.cells.push(cell);
            }
        }
        field
    }

    fn bake_cell(&mut self, column: i32, row: i32) -> Cell {
        let least = self.corner + Point::new(f64::from(column), f64::from(row)) * CELL_M - Point::splat(SLACK_M);
        let most = least + Point::splat(CELL_M + 2.0 * SLACK_M);
        let corners = [least, Point::new(most.x, least.y), most, Point::new(least.x, most.y)];
        let middle = (least + most) / 2.0;
        let around = middle.distance(most);
        let (near, inside) = (self.size.radius_m + SLACK_M, self.size.radius_m - SLACK_M);
        let mut cell = Cell { unsure: self.unsure.len() as u32, ..Cell::default() };
        for sensor in 0..self.areas.len() {
            let beams = self.range(sensor);
            let may = |beam: &Beam| beam.distance(middle) <= near + around;
            let area = self.areas[sensor].as_deref();
            let over_area = area.is_some_and(|outline| geometry::distance_to_area(outline, middle) <= near + around);
            let first = beams.clone().find(|&beam| may(&self.beams[beam]));
            if first.is_none() && !over_area {
                continue;
            }
            cell.may |= 1 << sensor;
            let within = |beam: &Beam| corners.iter().all(|&corner| beam.distance(corner) <= inside);
            let sure = match area {
                Some(outline) => corners.iter().all(|&corner| geometry::distance_to_area(outline, corner) <= inside),
                None => self.beams[beams.clone()].iter().any(within),
            };
            if sure {
                cell.sure |= 1 << sensor;
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

    /// The cell of a point.
    pub fn cell(&self, p: Point) -> &Cell {
        let at = (p - self.corner) / CELL_M;
        self.cell_at(floor(at.x), floor(at.y))
    }

    /// The first instant, not before `now`, at which a body on this stride comes to a cell where a
    /// sensor of `want` may see it; `until` if there is none before.
    pub(crate) fn unseen_until(&self, stride: &Stride, want: Mask, now: Micros, until: Micros) -> Micros {
        let at = (stride.position(now) - self.corner) / CELL_M;
        let (mut column, mut row) = (floor(at.x), floor(at.y));
        if self.cell_at(column, row).may & want != 0 {
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
        let limit = (until - now) as f64;
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
            if self.cell_at(column, row).may & want != 0 {
                return now + entered as Micros;
            }
        }
    }

    fn cell_at(&self, column: i32, row: i32) -> &Cell {
        let on_grid = column >= 0 && row >= 0 && column < self.columns && row < self.rows;
        if on_grid { &self.cells[(row * self.columns + column) as usize] } else { &self.nowhere }
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
    pub(crate) fn to_test(&self, cell: &Cell, sensor: usize) -> &[Beam] {
        let before = (cell.may & !cell.sure) & ((1 << sensor) - 1);
        let beams = self.unsure[cell.unsure as usize + before.count_ones() as usize];
        &self.beams[beams.first as usize..beams.end as usize]
    }

    /// Whether `sensor`, one of the unsure ones of the cell, sees a body that moves at `p` in the cell.
    pub(crate) fn sees_in(&self, cell: &Cell, sensor: usize, p: Point) -> bool {
        let touched = |beam: &Beam| stride::touches(beam, p, self.size.radius_m);
        self.over_area(sensor, p) || self.to_test(cell, sensor).iter().any(touched)
    }

    /// Whether `sensor` sees a body that moves at `p`, with no grid in between.
    pub fn sees(&self, sensor: usize, p: Point) -> bool {
        self.over_area(sensor, p)
            || self.beams[self.range(sensor)].iter().any(|beam| stride::touches(beam, p, self.size.radius_m))
    }

    /// Whether the centre `p` is over the area of `sensor`, if it has one.
    pub(crate) fn over_area(&self, sensor: usize, p: Point) -> bool {
        self.areas[sensor].as_deref().is_some_and(|outline| geometry::contains(outline, p))
    }

    /// All sensors that see a body that moves at `p`.
    pub fn seen_at(&self, p: Point) -> Mask {
        let cell = self.cell(p);
        bits(cell.may & !cell.sure)
            .filter(|&sensor| self.sees_in(cell, sensor, p))
            .fold(cell.sure, |mask, bit| mask | 1 << bit)
    }
}

/// The greatest whole number not above `x`; a cast and a comparison are faster than the general function.
fn floor(x: f64) -> i32 {
    let whole = x as i32;
    whole - i32::from(f64::from(whole) > x)
}
