//! Flats of random rooms, turned and moved: joints stay joined, and lengths stay the same.

use crate::plans::plan::{Home, file};
use homebody_core::geometry::{self, Point, point};
use homebody_core::random::Stream;
use homebody_import::sweet_home;
use std::f64::consts::{FRAC_PI_2, PI};

const CASES: u64 = 300;

/// Rounding two ends to millimetres moves each by half the diagonal of a square millimetre at most.
const ROUNDED_M: f64 = 0.001 * std::f64::consts::SQRT_2 + 1e-9;

/// An older adult's body.
const BODY_M: f64 = 0.22;

/// A flat on a grid: columns and rows of rooms, all in centimetres.
struct Flat {
    xs: Vec<f64>,
    ys: Vec<f64>,
    half_wall: f64,
    /// Position of the flat's corner in the drawing, and its turn.
    corner: Point,
    turn: f64,
    /// Distance of drawn rooms from the faces of walls.
    careless: f64,
    has_rooms: bool,
    is_whole: bool,
}

/// A drawn door: its name, and the cells on both sides; `None` for the outside.
type Joined = (String, [Option<(usize, usize)>; 2]);

impl Flat {
    fn new(dice: &mut Stream) -> Flat {
        let line = |dice: &mut Stream| {
            let rooms = 1 + (dice.unit() * 3.5) as usize;
            let mut at = 0.0;
            let ends = (0..rooms).map(|_| {
                at += dice.between(180.0, 500.0).round();
                at
            });
            [0.0].into_iter().chain(ends).collect::<Vec<f64>>()
        };
        let turn = if dice.chance(0.3) { 0.0 } else { dice.between(-PI, PI) };
        Flat {
            xs: line(dice),
            ys: line(dice),
            half_wall: dice.between(3.0, 20.0),
            corner: Point::new(dice.between(-5e3, 5e3), dice.between(-5e3, 5e3)),
            turn,
            careless: if dice.chance(0.5) { 0.0 } else { dice.between(-2.0, 4.0) },
            has_rooms: dice.chance(0.8),
            is_whole: dice.chance(0.5),
        }
    }

    /// A point of the flat where the plan draws it.
    fn at(&self, x: f64, y: f64) -> Point {
        self.corner + Point::from_angle(self.turn).rotate(Point::new(x, y))
    }

    fn wall(&self, from: [f64; 2], to: [f64; 2]) -> String {
        let (a, b) = (self.at(from[0], from[1]), self.at(to[0], to[1]));
        let thickness = self.half_wall * 2.0;
        format!("<wall xStart='{}' yStart='{}' xEnd='{}' yEnd='{}' thickness='{thickness}'/>", a.x, a.y, b.x, b.y)
    }

    /// The walls' lengths in metres, and their drawing: as long as they go, or from corner to corner.
    fn walls(&self) -> (Vec<f64>, String) {
        let (mut lengths, mut drawn) = (Vec::new(), String::new());
        let mut draw = |from: [f64; 2], to: [f64; 2]| {
            lengths.push(Point::from(from).distance(Point::from(to)) / 100.0);
            drawn += &self.wall(from, to);
        };
        let pieces = |line: &[f64]| match self.is_whole {
            true => vec![[line[0], line[line.len() - 1]]],
            false => line.windows(2).map(|ends| [ends[0], ends[1]]).collect(),
        };
        for &x in &self.xs {
            pieces(&self.ys).iter().for_each(|[from, to]| draw([x, *from], [x, *to]));
        }
        for &y in &self.ys {
            pieces(&self.xs).iter().for_each(|[from, to]| draw([*to, y], [*from, y]));
        }
        (lengths, drawn)
    }

    fn rooms(&self, dice: &mut Stream) -> String {
        let mut drawn = String::new();
        for (row, ys) in self.ys.windows(2).enumerate() {
            for (column, xs) in self.xs.windows(2).enumerate() {
                let mut off = || self.half_wall + if self.careless == 0.0 { 0.0 } else { self.careless * dice.unit() };
                let (left, right, low, high) = (xs[0] + off(), xs[1] - off(), ys[0] + off(), ys[1] - off());
                let mut corners = [(left, low), (right, low), (right, high), (left, high)];
                if dice.chance(0.5) {
                    corners.reverse();
                }
                drawn += &format!("<room name='{column} {row}'>");
                for (x, y) in corners {
                    let p = self.at(x, y);
                    drawn += &format!("<point x='{}' y='{}'/>", p.x, p.y);
                }
                drawn += "</room>";
            }
        }
        drawn
    }

    fn door(&self, name: &str, x: f64, y: f64, angle: f64, width: f64) -> String {
        let p = self.at(x, y);
        let angle = self.turn + angle;
        format!(
            "<doorOrWindow name='{name}' x='{}' y='{}' angle='{angle}' width='{width}' depth='12' height='205'/>",
            p.x, p.y
        )
    }

    /// A door in each wall between two rooms, and some that lead out.
    fn doors(&self, dice: &mut Stream) -> (Vec<Joined>, String) {
        let (mut joined, mut drawn) = (Vec::new(), String::new());
        let (columns, rows) = (self.xs.len() - 1, self.ys.len() - 1);
        for (across, along, lines, cells) in [(true, &self.ys, &self.xs, rows), (false, &self.xs, &self.ys, columns)] {
            for (line, &at) in lines.iter().enumerate() {
                for cell in 0..cells {
                    let is_outer = line == 0 || line == lines.len() - 1;
                    if is_outer && !dice.chance(0.3) {
                        continue;
                    }
                    let width = dice.between(70.0, 110.0).round();
                    let room = self.half_wall + width / 2.0 + 1.0;
                    let place = dice.between(along[cell] + room, along[cell + 1] - room);
                    // A little off its wall, the other way round, and slightly oblique.
                    let (aside, slant) = (dice.between(-3.0, 3.0), dice.between(-0.05, 0.05));
                    let half_turn = if dice.chance(0.5) { PI } else { 0.0 };
                    let name = format!("door {}", joined.len());
                    let (x, y, angle) = match across {
                        true => (at + aside, place, FRAC_PI_2),
                        false => (place, at + aside, 0.0),
                    };
                    drawn += &self.door(&name, x, y, angle + slant + half_turn, width);
                    let side = |line: Option<usize>| {
                        let line = line.filter(|&line| line < lines.len() - 1)?;
                        Some(if across { (line, cell) } else { (cell, line) })
                    };
                    joined.push((name, [side(line.checked_sub(1)), side(Some(line))]));
                }
            }
        }
        (joined, drawn)
    }

    /// The middle of a room in the home that was imported.
    fn middle(&self, (column, row): (usize, usize), least: Point) -> Point {
        let (x, y) = ((self.xs[column] + self.xs[column + 1]) / 2.0, (self.ys[row] + self.ys[row + 1]) / 2.0);
        self.imported(x, y) - least
    }

    fn imported(&self, x: f64, y: f64) -> Point {
        let p = self.at(x, y) / 100.0;
        Point::new(p.x, -p.y)
    }

    /// The lower left corner of the drawn flat, north up.
    fn least(&self) -> Point {
        let (width, depth) = (self.xs[self.xs.len() - 1], self.ys[self.ys.len() - 1]);
        let corners = [(0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth)];
        geometry::bounds(corners.map(|(x, y)| self.imported(x, y))).0
    }
}

#[test]
fn random_flats_keep_their_lengths_and_joints() {
    let mut joints = 0;
    for case in 0..CASES {
        let dice = &mut Stream::named(case, "flat");
        let flat = Flat::new(dice);
        let (lengths, walls) = flat.walls();
        let (joined, doors) = flat.doors(dice);
        let rooms = if flat.has_rooms { flat.rooms(dice) } else { String::new() };
        let imported = sweet_home(&file(&format!("{doors}{walls}{rooms}")), "flat", None);
        let home = Home::from(imported.unwrap_or_else(|error| panic!("case {case}: {error}")));
        let cells = (flat.xs.len() - 1) * (flat.ys.len() - 1);
        let counts = (home.file.walls.len(), home.file.rooms.len(), home.file.doors.len());
        assert_eq!(counts, (lengths.len(), cells, joined.len()), "case {case}: {:#?}", home.remarks);
        for (wall, length) in home.file.walls.iter().zip(lengths) {
            let found = point(wall.from).distance(point(wall.to));
            assert!((found - length).abs() <= ROUNDED_M, "case {case}: {found} m, not {length}");
        }
        let ends = home.file.walls.iter().flat_map(|wall| [point(wall.from), point(wall.to)]);
        assert!(geometry::bounds(ends).0.distance(Point::ZERO) < 0.002, "case {case}: the corner is the origin");
        let least = flat.least();
        let room = |cell| home.plan.room_at(flat.middle(cell, least)).expect("each cell is a room");
        for (name, sides) in &joined {
            let door = home.file.doors.iter().find(|door| door.name == *name).expect("each door is there");
            assert_eq!(door.outside, sides.contains(&None), "case {case}");
            let mut expected = sides.map(|cell| cell.map(|cell| home.file.rooms[room(cell)].name.as_str()));
            let mut found = home.joins(name);
            expected.sort();
            found.sort();
            assert_eq!(found, expected, "case {case}: {name}");
            let (from, to) = (point(door.from), point(door.to));
            let out = (to - from).normalize().perp() * 0.6;
            for step in -20..=20 {
                let p = (from + to) / 2.0 + out * f64::from(step) / 20.0;
                let is_free = home.plan.is_walkable(p, BODY_M);
                assert!(is_free || door.outside, "case {case}: nobody walks through {name} at {p}");
            }
            joints += 1;
        }
        for (row, ys) in flat.ys.windows(2).enumerate() {
            for (column, xs) in flat.xs.windows(2).enumerate() {
                let whole = (xs[1] - xs[0]) * (ys[1] - ys[0]) / 1e4;
                let outline = &home.plan.rooms[room((column, row))].outline;
                let area = geometry::signed_area(outline).abs();
                assert!((area - whole).abs() < 0.02, "case {case}: {area} m², not {whole}");
            }
        }
    }
    assert!(joints > 1_000, "{joints}");
}
