//! The floor before a camera: the part that it sees, and the part that furniture hides.
//!
//! We assume that a camera sees a person on a bed or a seat if it sees its top.
//!
//! The floor is sampled at the middles of square cells. Walls and closed doors end the floor before a camera; furniture hides the floor
//! behind it, and the floor below itself.
//!
//! Left out: floor further off than [`FAR_M`], on which a body is some pixels high.

use homebody_core::camera::lens::Lens;
use homebody_core::camera::outlook::Outlook;
use homebody_core::camera::scenery::Prism;
use homebody_core::geometry::Point;
use homebody_core::plan::Plan;

/// Side of a cell, in metres (our choice).
pub const STEP_M: f64 = 0.1;

/// Distance from a camera beyond which the floor is left out, in metres (our choice).
pub const FAR_M: f64 = 12.0;

/// Tolerance, as a share of the way, of the comparison of a point with the thing that hides it (our choice).
const SPARE: f64 = 1e-3;

/// Left, lower, right and upper edge, in metres.
pub type Rectangle = [f64; 4];

/// The floor before a camera, as rectangles that share no floor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CameraFloor {
    pub seen: Vec<Rectangle>,
    /// The floor that the camera would see without furniture.
    pub hidden: Vec<Rectangle>,
}

#[derive(Clone, Copy, PartialEq)]
enum FloorCell {
    Seen,
    Hidden,
}

impl CameraFloor {
    pub fn from_lens(plan: &Plan, lens: &Lens) -> CameraFloor {
        let outlook = Outlook::new(plan);
        let (walls, pieces): (Vec<Prism>, Vec<Prism>) =
            outlook.prisms.into_iter().partition(|prism| prism.height_m.is_infinite());
        let cell = |at: Point| -> Option<FloorCell> {
            if at.distance(lens.at.truncate()) > FAR_M || plan.room_at(at).is_none() {
                return None;
            }
            let target = at.extend(outlook.ground.support_m(at));
            let on = lens.project(target)?;
            let is_in = (0.0..f64::from(lens.columns)).contains(&on.x) && (0.0..f64::from(lens.rows)).contains(&on.y);
            let way = target - lens.at;
            let hides = |prism: &Prism| prism.first_hit(lens.at, way).is_some_and(|times| times < 1.0 - SPARE);
            if !is_in || walls.iter().any(hides) {
                return None;
            }
            Some(if pieces.iter().any(hides) { FloorCell::Hidden } else { FloorCell::Seen })
        };
        let (least, most) = plan.bounds();
        let [columns, rows] = [most.x - least.x, most.y - least.y].map(|long| (long / STEP_M).ceil().max(0.0) as usize);
        let mut floor = CameraFloor::default();
        for row in 0..rows {
            let y = least.y + row as f64 * STEP_M;
            let mut run: Option<(FloorCell, usize)> = None;
            for column in 0..=columns {
                let middle = Point::new(least.x + (column as f64 + 0.5) * STEP_M, y + STEP_M / 2.0);
                let here = if column < columns { cell(middle) } else { None };
                if run.map(|(cell, _)| cell) == here {
                    continue;
                }
                if let Some((cell, from)) = run {
                    let edge = |column: usize| least.x + column as f64 * STEP_M;
                    floor.add(cell, [edge(from), y, edge(column), y + STEP_M]);
                }
                run = here.map(|cell| (cell, column));
            }
        }
        floor
    }

    /// Adds a run of cells of a row; it joins one that is as wide as the piece below it.
    fn add(&mut self, cell: FloorCell, next: Rectangle) {
        let of = match cell {
            FloorCell::Seen => &mut self.seen,
            FloorCell::Hidden => &mut self.hidden,
        };
        let is_below = |last: &&mut Rectangle| {
            last[0] == next[0] && last[2] == next[2] && (last[3] - next[1]).abs() < STEP_M / 2.0
        };
        match of.iter_mut().rev().take(8).find(is_below) {
            Some(last) => last[3] = next[3],
            None => of.push(next),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::body::figure::Point3;
    use homebody_core::home::form::HomeFile;
    use serde_json::json;

    fn plan(furniture: serde_json::Value) -> Plan {
        let home: HomeFile = serde_json::from_value(json!({ "name": "flat",
            "walls": [{ "from": [5, 0], "to": [5, 4], "thickness_m": 0.2 }],
            "rooms": [{ "name": "room", "outline": [[0, 0], [5, 0], [5, 4], [0, 4]] },
                      { "name": "other", "outline": [[5, 0], [9, 0], [9, 4], [5, 4]] }],
            "furniture": furniture }))
        .unwrap();
        Plan::new(&home)
    }

    fn lens() -> Lens {
        Lens::new(Point3::new(0.05, 2.0, 2.0), 0.0, 0.6, 1.2, [160, 120])
    }

    fn square_m(all: &[Rectangle]) -> f64 {
        all.iter().map(|[left, low, right, high]| (right - left) * (high - low)).sum()
    }

    fn holds(all: &[Rectangle], x: f64, y: f64) -> bool {
        all.iter().any(|[left, low, right, high]| (*left..*right).contains(&x) && (*low..*high).contains(&y))
    }

    #[test]
    fn the_shadow_of_a_block_is_as_long_as_similar_triangles_say() {
        // A block of 1 m, 2.0 to 2.4 m before a lens at 2 m: what lies up to 4.75 m off is hidden.
        let block = json!([{ "name": "box", "at": [2.2, 2.0], "size_m": [0.4, 0.8], "height_m": 1.0 }]);
        let floor = CameraFloor::from_lens(&plan(block), &lens());
        for (x, is_seen) in [(1.9, true), (2.2, false), (3.0, false), (4.6, false), (4.85, true)] {
            assert_eq!((holds(&floor.seen, x, 2.02), holds(&floor.hidden, x, 2.02)), (is_seen, !is_seen), "{x}");
        }
        let empty = CameraFloor::from_lens(&plan(json!([])), &lens());
        assert_eq!(empty.hidden, Vec::<Rectangle>::new());
        // The hidden part and the rest make the whole.
        let all = square_m(&floor.seen) + square_m(&floor.hidden);
        assert!((all - square_m(&empty.seen)).abs() < 1e-9, "{all}");
        // Without a door nothing of the other room is before it.
        assert!(!holds(&empty.seen, 6.0, 2.0) && holds(&empty.seen, 4.85, 2.0));
    }

    #[test]
    fn the_top_of_a_bed_is_seen_and_the_floor_behind_it_is_not() {
        let bed =
            json!([{ "name": "bed", "at": [3.0, 2.0], "size_m": [0.9, 2.0], "height_m": 0.5, "enterable": true }]);
        let floor = CameraFloor::from_lens(&plan(bed), &lens());
        assert!(holds(&floor.seen, 3.0, 2.0) && holds(&floor.hidden, 3.6, 2.0) && holds(&floor.seen, 4.85, 2.0));
    }

    #[test]
    fn floor_beyond_the_edges_of_the_picture_is_neither_seen_nor_hidden() {
        let floor = CameraFloor::from_lens(&plan(json!([])), &lens());
        // The nearest that it sees is where the lowest row meets the floor.
        let lens = lens();
        let way = lens.ray_through(80.0, 120.0);
        let nearest = lens.at.x + way.x * lens.at.z / -way.z;
        assert!(!holds(&floor.seen, nearest - 0.15, 2.02) && holds(&floor.seen, nearest + 0.15, 2.02), "{nearest}");
        assert!(floor.hidden.is_empty());
    }
}
