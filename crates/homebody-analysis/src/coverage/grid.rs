//! The floor in square cells, and the connected groups of cells traced to polygons.
//!
//! Rings are traced here rather than by a library. `contour` interpolates between the middles of cells, so its rings are not
//! the borders of cells. `i_overlay`, on which `geo` builds, puts cells together as fast and as exactly, but a hole that
//! touches the outer ring at a corner becomes part of that ring, and corners within straight sides are gone: smoothing and
//! the error of an area need the ring in steps of one cell.

use std::collections::BTreeMap;

use homebody_core::geometry::Point;
use homebody_core::sensor_set::SensorSet;

/// Square cells over a home. Their corners lie at whole multiples of the step, so that walls that
/// do the same cut no cell in two, and layouts of one home can be compared cell by cell.
#[derive(Clone, Debug, PartialEq)]
pub struct CoverageGrid {
    pub step_m: f64,
    pub columns: usize,
    pub rows: usize,
    /// Row by row from the south-west: `None` where no body can stand, else the sensors that see the cell.
    pub cells: Vec<Option<SensorSet>>,
    least: CellCorner,
}

/// A corner of cells, in steps east and north of the home's origin.
pub type CellCorner = [i64; 2];

/// Cells that hang together by their sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Ascending indices into the grid's cells.
    pub cells: Vec<usize>,
    /// The border in unit steps: the outer ring, counter-clockwise, then the holes, clockwise.
    /// Rings may touch at a corner, but no ring touches itself.
    pub rings: Vec<Vec<CellCorner>>,
}

impl CoverageGrid {
    /// Looks at the middle of every cell between the corners of `bounds`.
    pub fn sample(bounds: (Point, Point), step_m: f64, look: impl Fn(Point) -> Option<SensorSet>) -> CoverageGrid {
        assert!(step_m > 0.0, "the cells of a grid need a size");
        let (least, most) = ((bounds.0 / step_m).floor(), (bounds.1 / step_m).ceil());
        let (columns, rows) = ((most.x - least.x) as usize, (most.y - least.y) as usize);
        let least = [least.x as i64, least.y as i64];
        let mut grid = CoverageGrid { step_m, columns, rows, cells: Vec::new(), least };
        grid.cells = (0..columns * rows).map(|cell| look(grid.middle(cell))).collect();
        grid
    }

    pub fn middle(&self, cell: usize) -> Point {
        let [x, y] = self.south_west(cell);
        Point::new(x as f64 + 0.5, y as f64 + 0.5) * self.step_m
    }

    pub fn watchers(&self, cell: usize) -> Option<usize> {
        self.cells[cell].as_ref().map(SensorSet::len)
    }

    pub fn corner(&self, [x, y]: CellCorner) -> Point {
        // Divided, not multiplied, where the step is one over a whole number: 3 * 0.05 is not 0.15.
        let per_metre = (1.0 / self.step_m).round();
        if (per_metre * self.step_m - 1.0).abs() < 1e-12 {
            Point::new(x as f64, y as f64) / per_metre
        } else {
            Point::new(x as f64, y as f64) * self.step_m
        }
    }

    /// The cells around a corner, counter-clockwise from the south-west one; nothing beyond the edge.
    pub fn around(&self, [x, y]: CellCorner) -> [Option<usize>; 4] {
        [[x - 1, y - 1], [x, y - 1], [x, y], [x - 1, y]].map(|[x, y]| {
            let column = usize::try_from(x - self.least[0]).ok().filter(|&column| column < self.columns)?;
            let row = usize::try_from(y - self.least[1]).ok().filter(|&row| row < self.rows)?;
            Some(row * self.columns + column)
        })
    }

    /// The cell itself and the eight at exactly `reach` cells from it, along the axes and diagonals.
    pub fn near(&self, cell: usize, reach: i64) -> impl Iterator<Item = usize> {
        let [x, y] = self.south_west(cell);
        let off = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [dx, dy]));
        // The cell north-east of a corner.
        off.filter_map(move |[dx, dy]| self.around([x + dx * reach, y + dy * reach])[2])
    }

    pub fn area_m2(&self, region: &Region) -> f64 {
        region.cells.len() as f64 * self.step_m * self.step_m
    }

    /// The largest difference of the area of a region from the true one, by the sides of its border.
    pub fn region_error_m2(&self, region: &Region) -> f64 {
        self.error_m2(region.rings.iter().map(Vec::len).sum())
    }

    /// The largest difference of the area of the chosen cells from the true one, if its sides are straight: half a cell for each side of a
    /// cell in the border, and a cell for the corners.
    pub fn area_error_m2(&self, chosen: impl Fn(usize) -> bool) -> f64 {
        let chosen_cells = (0..self.cells.len()).filter(|&cell| chosen(cell));
        let sides: usize = chosen_cells
            .map(|cell| self.neighbours(cell).iter().filter(|side| !side.is_some_and(&chosen)).count())
            .sum();
        self.error_m2(sides)
    }

    fn error_m2(&self, sides: usize) -> f64 {
        if sides == 0 { 0.0 } else { (sides as f64 / 2.0 + 1.0) * self.step_m * self.step_m }
    }

    /// The groups of chosen cells that hang together by their sides, in the order of their first cells.
    pub fn regions(&self, chosen: impl Fn(usize) -> bool) -> Vec<Region> {
        let mut region_of = vec![usize::MAX; self.cells.len()];
        let mut regions = Vec::new();
        for start in 0..self.cells.len() {
            if region_of[start] != usize::MAX || !chosen(start) {
                continue;
            }
            let number = regions.len();
            let mut cells = Vec::new();
            let mut open = vec![start];
            region_of[start] = number;
            while let Some(cell) = open.pop() {
                cells.push(cell);
                for next in self.neighbours(cell).into_iter().flatten() {
                    if region_of[next] == usize::MAX && chosen(next) {
                        region_of[next] = number;
                        open.push(next);
                    }
                }
            }
            cells.sort_unstable();
            let rings = self.trace(&cells, |cell| region_of[cell] == number);
            regions.push(Region { cells, rings });
        }
        regions
    }

    /// The cell of a region with the most cells between it and the border: where a label belongs.
    pub fn deepest(&self, region: &Region) -> usize {
        let place = |cell: usize| region.cells.binary_search(&cell).ok();
        let mut reached = vec![false; region.cells.len()];
        let is_at_border = |&cell: &usize| self.neighbours(cell).iter().any(|side| side.and_then(place).is_none());
        let mut layer: Vec<usize> = region.cells.iter().copied().filter(is_at_border).collect();
        let mut deepest = region.cells[0];
        while !layer.is_empty() {
            layer.sort_unstable();
            deepest = layer[layer.len() / 2];
            layer.iter().filter_map(|&cell| place(cell)).for_each(|place| reached[place] = true);
            let mut inner = Vec::new();
            for next in layer.iter().flat_map(|&cell| self.neighbours(cell)).flatten() {
                if let Some(place) = place(next).filter(|&place| !reached[place]) {
                    reached[place] = true;
                    inner.push(next);
                }
            }
            layer = inner;
        }
        deepest
    }

    /// Joins the sides between a region and the rest into rings, with the region on the left.
    fn trace(&self, cells: &[usize], belongs: impl Fn(usize) -> bool) -> Vec<Vec<CellCorner>> {
        let mut sides: BTreeMap<CellCorner, Vec<CellCorner>> = BTreeMap::new();
        for &cell in cells {
            let [x, y] = self.south_west(cell);
            let around = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
            for (side, neighbour) in self.neighbours(cell).into_iter().enumerate() {
                if !neighbour.is_some_and(&belongs) {
                    sides.entry(around[side]).or_default().push(around[(side + 1) % 4]);
                }
            }
        }
        let mut rings = Vec::new();
        while let Some((&start, ends)) = sides.iter().next() {
            let mut ring = vec![start];
            let (first, mut from, mut to) = (ends[0], start, ends[0]);
            loop {
                remove(&mut sides, from, to);
                let next = if to == start && turns_to(from, to, first, sides.get(&to)) {
                    break;
                } else {
                    rightmost(from, to, &sides[&to])
                };
                ring.push(to);
                (from, to) = (to, next);
            }
            rings.push(ring);
        }
        // Counter-clockwise encloses a positive area: the outer ring, and a region has one.
        rings.sort_by_key(|ring| doubled_area(ring) < 0);
        rings
    }

    /// The cells to the south, east, north and west; nothing beyond the edge.
    fn neighbours(&self, cell: usize) -> [Option<usize>; 4] {
        let (column, row) = (cell % self.columns, cell / self.columns);
        [
            (row > 0).then(|| cell - self.columns),
            (column + 1 < self.columns).then(|| cell + 1),
            (row + 1 < self.rows).then(|| cell + self.columns),
            (column > 0).then(|| cell - 1),
        ]
    }

    fn south_west(&self, cell: usize) -> CellCorner {
        [self.least[0] + (cell % self.columns) as i64, self.least[1] + (cell / self.columns) as i64]
    }
}

/// Whether a walk that comes back to its start over `from -> to` closes there, or passes through: two
/// sides leave a corner where cells touch, and the walk closes only if it would take its first side again.
fn turns_to(from: CellCorner, to: CellCorner, first: CellCorner, others: Option<&Vec<CellCorner>>) -> bool {
    let others = others.map_or(&[][..], |others| others);
    others.iter().all(|&other| turn(from, to, first) < turn(from, to, other))
}

/// Of the sides that leave `to`, the one most to the right: it keeps holes that touch the outer ring
/// or each other at a corner rings of their own.
fn rightmost(from: CellCorner, to: CellCorner, ends: &[CellCorner]) -> CellCorner {
    *ends.iter().min_by_key(|&&end| turn(from, to, end)).expect("every side of a border is followed by another")
}

fn turn(from: CellCorner, to: CellCorner, end: CellCorner) -> i64 {
    (to[0] - from[0]) * (end[1] - to[1]) - (to[1] - from[1]) * (end[0] - to[0])
}

fn remove(sides: &mut BTreeMap<CellCorner, Vec<CellCorner>>, from: CellCorner, to: CellCorner) {
    if let Some(ends) = sides.get_mut(&from) {
        ends.retain(|&end| end != to);
        if ends.is_empty() {
            sides.remove(&from);
        }
    }
}

fn doubled_area(ring: &[CellCorner]) -> i64 {
    let next = |i: usize| ring[(i + 1) % ring.len()];
    ring.iter().enumerate().map(|(i, a)| a[0] * next(i)[1] - a[1] * next(i)[0]).sum()
}

/// A ring without the corners in the middle of a straight side.
pub fn straightened(ring: &[CellCorner]) -> Vec<CellCorner> {
    let n = ring.len();
    let bends = |&i: &usize| turn(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]) != 0;
    (0..n).filter(bends).map(|i| ring[i]).collect()
}
