//! The places of texts: each near the thing that it names, off the walls, and off the other texts.

use glam::Vec2Swizzles;
use homebody_core::geometry::{self, Point};

use super::font;
use super::svg::{Anchor, Svg, Type};

#[derive(Default)]
pub struct Labels {
    /// Never covered: walls, doors and sensors, in pixels.
    pub solid: Vec<Vec<Point>>,
    pub rooms: Vec<Vec<Point>>,
    /// Walls, which separate a mark from a text on their other side.
    pub walls: Vec<Vec<Point>>,
    /// Covered only by texts that find no other place: furniture.
    pub soft: Vec<Vec<Point>>,
    taken: Vec<Block>,
    placed: Vec<PlacedText>,
}

#[derive(Clone, Copy)]
pub struct Block {
    pub least: Point,
    pub most: Point,
}

struct PlacedText {
    lines: Vec<String>,
    middle: Point,
    set: Type,
    leader: Option<Point>,
}

struct TextSpot {
    cost: f64,
    lines: Vec<String>,
    spot: Point,
    distance: f64,
}

/// Distance between the base lines of a text of several lines, in font sizes.
const LINE_HEIGHT: f64 = 1.15;
/// Largest ratio of the width of a reader's own font to that of the program's (our choice).
const SPARE_WIDTH: f64 = 1.06;

impl Labels {
    pub fn take(&mut self, block: Block) {
        self.taken.push(block);
    }

    /// Puts a name inside an outline: as near `middle` and as large as it fits, on one line or two.
    /// False if it does not fit at all.
    pub fn inside(&mut self, name: &str, outline: &[Point], middle: Point, sizes: &[f64], set: Type) -> bool {
        let (least, most) = geometry::bounds(outline.iter().copied());
        let mut spots = vec![middle];
        let reach = ((most - least) / SPOT_STEP).ceil();
        for row in 0..=reach.y as usize {
            spots
                .extend((0..=reach.x as usize).map(|column| least + Point::new(column as f64, row as f64) * SPOT_STEP));
        }
        // Sideways costs more than up or down: a name out of the middle line looks lost.
        let cost = |spot: &Point| (spot.x - middle.x).abs() * 1.3 + (spot.y - middle.y).abs();
        spots.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        for soft_counts in [true, false] {
            for &size in sizes {
                for lines in breakings(name) {
                    let extent = extent(&lines, size);
                    let fits = |spot: &&Point| {
                        let block = Block::around(**spot, extent + Point::splat(4.0));
                        block.is_within(outline) && self.is_free(&block, soft_counts)
                    };
                    if let Some(&spot) = spots.iter().find(fits) {
                        self.place(lines, spot, Type { size, ..set }, None);
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Puts a name on a piece of furniture, turned if it is narrow; false if it does not fit.
    pub fn on(&mut self, name: &str, outline: &[Point], middle: Point, sizes: &[f64], set: Type) -> bool {
        for &size in sizes {
            for upright in [false, true] {
                for lines in breakings(name) {
                    let extent = extent(&lines, size);
                    let extent = if upright { extent.yx() } else { extent };
                    let block = Block::around(middle, extent + Point::splat(3.0));
                    if block.is_within(outline) && self.is_free(&block, false) {
                        self.place(lines, middle, Type { size, upright, ..set }, None);
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Puts a name at the first free spot, if there is one.
    pub fn at_first(&mut self, name: &str, spots: &[Point], set: Type) {
        let lines = vec![name.to_owned()];
        let extent = extent(&lines, set.size);
        if let Some(&spot) = spots.iter().find(|&&spot| self.is_free(&Block::around(spot, extent), true)) {
            self.place(lines, spot, set, None);
        }
    }

    /// Puts a name next to a mark, preferably towards `facing_deg` on the plan and on this side of the walls; with a line to it if that is
    /// far. Without a free place, it covers the least.
    pub fn beside(&mut self, name: &str, mark: Point, facing_deg: f64, set: Type) {
        if let Some(found) = self.best_beside(name, mark, facing_deg, set) {
            self.tie(found, mark, set);
        }
    }

    /// As `beside`, but leaves the name out where it would cover something.
    pub fn beside_if_free(&mut self, name: &str, mark: Point, facing_deg: f64, set: Type) {
        let best = self.best_beside(name, mark, facing_deg, set);
        if let Some(found) = best.filter(|found| found.cost < SOLID_COST) {
            self.tie(found, mark, set);
        }
    }

    fn tie(&mut self, found: TextSpot, mark: Point, set: Type) {
        let leader = (found.distance > LEADER).then_some(mark);
        self.place(found.lines, found.spot, set, leader);
    }

    fn best_beside(&self, name: &str, mark: Point, facing_deg: f64, set: Type) -> Option<TextSpot> {
        let ahead = |turn_deg: f64| geometry::direction(facing_deg + turn_deg) * Point::new(1.0, -1.0);
        let front = mark + ahead(0.0) * CLEARANCE;
        let mut best: Option<TextSpot> = None;
        for lines in breakings(name) {
            let half = extent(&lines, set.size) / 2.0 + Point::splat(1.0);
            for distance in [CLEARANCE, 25.0, 40.0, 55.0] {
                for aside_deg in (-11..=12).map(|turn| f64::from(turn) * 15.0) {
                    let towards = ahead(aside_deg);
                    // Slides the text along itself, so that the mark lies off its end and not off its middle.
                    let slide = (towards * 2.5).clamp(Point::NEG_ONE, Point::ONE) * half;
                    let spot = mark + towards * distance + slide;
                    let cost = self.covered(&Block::around(spot, half * 2.0))
                        + self.astray(front, spot)
                        + if distance > LEADER { self.crossed(mark, spot) } else { 0.0 }
                        + (distance - CLEARANCE)
                        + 0.3 * aside_deg.abs()
                        + 15.0 * (lines.len() - 1) as f64;
                    if best.as_ref().is_none_or(|best| cost < best.cost) {
                        best = Some(TextSpot { cost, lines: lines.clone(), spot, distance });
                    }
                }
            }
        }
        best
    }

    /// The cost of a text on the other side of a wall: more so in a room that it is not about.
    fn astray(&self, front: Point, spot: Point) -> f64 {
        let through_wall = self.walls.iter().any(|wall| crosses(wall, front, spot));
        let in_room = || self.rooms.iter().any(|room| geometry::contains(room, spot));
        match through_wall {
            false => 0.0,
            true if in_room() => 110.0,
            true => 60.0,
        }
    }

    /// The cost of a line over other texts.
    fn crossed(&self, mark: Point, spot: Point) -> f64 {
        let texts = self.taken.iter().filter(|taken| crosses(&taken.corners(), mark, spot)).count();
        80.0 * texts as f64
    }

    pub fn draw(&self, svg: &mut Svg) {
        for label in &self.placed {
            if let Some(mark) = label.leader {
                let near = mark + (label.middle - mark) * 0.25;
                let end = label.middle - (label.middle - mark).normalize_or_zero() * label.set.size * 0.7;
                svg.line(near, end, &super::paint::Paint::line(label.set.fill, 0.8));
            }
            let step = LINE_HEIGHT * label.set.size;
            let first = -(label.lines.len() as f64 - 1.0) / 2.0 * step;
            for (row, line) in label.lines.iter().enumerate() {
                let off = first + row as f64 * step;
                let off = if label.set.upright { Point::new(off, 0.0) } else { Point::new(0.0, off) };
                svg.text(line, label.middle + off, &label.set.anchored(Anchor::Middle));
            }
        }
    }

    fn place(&mut self, lines: Vec<String>, middle: Point, set: Type, leader: Option<Point>) {
        let extent = extent(&lines, set.size);
        self.take(Block::around(middle, if set.upright { extent.yx() } else { extent }));
        self.placed.push(PlacedText { lines, middle, set, leader });
    }

    fn is_free(&self, block: &Block, soft_counts: bool) -> bool {
        let covers = self.taken.iter().any(|taken| block.meets(taken))
            || self.solid.iter().any(|solid| block.meets_outline(solid))
            || soft_counts && self.soft.iter().any(|soft| block.meets_outline(soft));
        !covers
    }

    /// The cost of covering the things under a block: texts most, furniture least.
    fn covered(&self, block: &Block) -> f64 {
        let texts = self.taken.iter().filter(|taken| block.meets(taken)).count();
        let solids = self.solid.iter().filter(|solid| block.meets_outline(solid)).count();
        let soft = self.soft.iter().filter(|soft| block.meets_outline(soft)).count();
        400.0 * texts as f64 + SOLID_COST * solids as f64 + 12.0 * soft as f64
    }
}

/// Distance of a mark from its text, in pixels.
const CLEARANCE: f64 = 13.0;
/// Distance from its mark beyond which a text has a line to it.
const LEADER: f64 = 30.0;
const SOLID_COST: f64 = 150.0;
/// Distance between the spots that are tried for a name, in pixels.
const SPOT_STEP: f64 = 6.0;

impl Block {
    pub fn around(middle: Point, extent: Point) -> Block {
        Block { least: middle - extent / 2.0, most: middle + extent / 2.0 }
    }

    fn meets(&self, other: &Block) -> bool {
        self.least.cmplt(other.most).all() && other.least.cmplt(self.most).all()
    }

    fn meets_outline(&self, outline: &[Point]) -> bool {
        let corners = self.corners();
        outline.iter().any(|p| self.least.cmplt(*p).all() && p.cmplt(self.most).all())
            || corners.iter().any(|&corner| geometry::contains(outline, corner))
            || self.crosses(outline)
    }

    fn is_within(&self, outline: &[Point]) -> bool {
        self.corners().iter().all(|&corner| geometry::contains(outline, corner)) && !self.crosses(outline)
    }

    fn crosses(&self, outline: &[Point]) -> bool {
        geometry::sides(&self.corners()).any(|(a, b)| crosses(outline, a, b))
    }

    fn corners(&self) -> [Point; 4] {
        let (least, most) = (self.least, self.most);
        [least, Point::new(most.x, least.y), most, Point::new(least.x, most.y)]
    }
}

fn crosses(outline: &[Point], from: Point, to: Point) -> bool {
    geometry::sides(outline).any(|(a, b)| geometry::segments_meet(a, b, from, to))
}

fn extent(lines: &[String], size: f64) -> Point {
    let width = lines.iter().map(|line| font::width(line, size)).fold(0.0, f64::max);
    Point::new(width * SPARE_WIDTH, size * LINE_HEIGHT * lines.len() as f64)
}

/// A name on one line, and, if it has words, on two lines of about the same length.
fn breakings(name: &str) -> Vec<Vec<String>> {
    let length = name.chars().count() as i64;
    let spaces = name.char_indices().enumerate().filter(|(_, (_, c))| *c == ' ');
    let middle = spaces.min_by_key(|(place, _)| (2 * *place as i64 - length).abs());
    let one_line = vec![name.to_owned()];
    match middle {
        None => vec![one_line],
        Some((_, (at, _))) => vec![one_line, vec![name[..at].trim().to_owned(), name[at..].trim().to_owned()]],
    }
}
