//! The content of a plan, in metres, with y to the north and angles counter-clockwise.
//!
//! Sweet Home 3D writes centimetres, y to the south and radians clockwise; only this module converts them.

use crate::outline::rectangle;
use homebody_core::geometry::{self, Point};
use homebody_core::names::words;
use roxmltree::{Document, Node};
use std::collections::BTreeMap;

/// Largest number in a plan, in centimetres or radians (our choice): ten kilometres.
const GREATEST: f64 = 1e6;

/// Everything in a plan that may become part of a home, on all levels.
#[derive(Debug, Default)]
pub struct PlanDrawing {
    pub levels: Vec<PlanLevel>,
    pub walls: Vec<PlanWall>,
    pub rooms: Vec<PlanRoom>,
    pub openings: Vec<PlanPiece>,
    pub pieces: Vec<PlanPiece>,
    pub labels: Vec<Label>,
    pub latitude_deg: Option<f64>,
    /// The number of things without a usable place or size.
    pub unread: usize,
}

/// The number of a level's id in a plan: a group passes its level on to its content, and the id may be long.
pub type LevelId = usize;

#[derive(Default)]
struct LevelIds<'a>(BTreeMap<&'a str, LevelId>);

impl<'a> LevelIds<'a> {
    fn id(&mut self, text: &'a str) -> LevelId {
        let next = self.0.len();
        *self.0.entry(text).or_insert(next)
    }
}

#[derive(Debug)]
pub struct PlanLevel {
    pub id: LevelId,
    pub name: String,
    pub elevation_m: f64,
    pub height_m: Option<f64>,
    /// The order of levels of one elevation.
    pub index: f64,
    pub is_viewable: bool,
}

#[derive(Clone, Debug)]
pub struct PlanWall {
    pub level: Option<LevelId>,
    pub from: Point,
    pub to: Point,
    pub thickness_m: f64,
    /// The angle of a curved wall, counter-clockwise; 0 for a straight one.
    pub arc_rad: f64,
}

#[derive(Clone, Debug)]
pub struct PlanRoom {
    pub level: Option<LevelId>,
    pub name: String,
    pub corners: Vec<Point>,
    /// False for a room that is drawn for its ceiling alone.
    pub has_floor: bool,
}

#[derive(Clone, Debug)]
pub struct Label {
    pub level: Option<LevelId>,
    pub text: String,
    pub at: Point,
}

#[derive(Clone, Debug)]
pub struct PlanPiece {
    pub level: Option<LevelId>,
    pub name: String,
    pub words: Vec<String>,
    /// The words of its name in the catalogue, which are English in any language of the program.
    pub catalog: Vec<String>,
    pub at: Point,
    pub width_m: f64,
    pub depth_m: f64,
    pub turn_rad: f64,
    pub elevation_m: f64,
    pub height_m: f64,
    pub is_visible: bool,
    /// True if it cuts a hole into the floor above.
    pub is_cut_out: bool,
}

impl PlanPiece {
    pub fn outline(&self) -> [Point; 4] {
        rectangle(self.at, [self.width_m, self.depth_m], self.turn_rad.to_degrees())
    }
}

pub fn read(document: &Document) -> PlanDrawing {
    let mut drawing = PlanDrawing::default();
    let mut ids = LevelIds::default();
    // Pieces in groups come after the others.
    let mut waiting: Vec<(Node, Option<LevelId>, bool)> = vec![(document.root_element(), None, true)];
    while let Some((parent, level, is_visible)) = waiting.pop() {
        let mut groups = Vec::new();
        for node in parent.children().filter(Node::is_element) {
            let level = node.attribute("level").map(|id| ids.id(id)).or(level);
            let is_visible = is_visible && node.attribute("visible") != Some("false");
            match node.tag_name().name() {
                "furnitureGroup" => groups.push((node, level, is_visible)),
                _ => drawing.add(node, level, is_visible, &mut ids),
            }
        }
        waiting.extend(groups.into_iter().rev());
    }
    drawing
}

impl PlanDrawing {
    fn add<'a>(&mut self, node: Node<'a, '_>, level: Option<LevelId>, is_visible: bool, ids: &mut LevelIds<'a>) {
        let is_read = match node.tag_name().name() {
            "level" => self::level(node, ids).map(|level| self.levels.push(level)),
            "wall" => wall(node, level).map(|wall| self.walls.push(wall)),
            "room" => room(node, level).map(|room| self.rooms.push(room)),
            "doorOrWindow" => opening(node, level, is_visible).map(|opening| self.openings.push(opening)),
            "pieceOfFurniture" if node.attribute("doorOrWindow") == Some("true") => {
                opening(node, level, is_visible).map(|opening| self.openings.push(opening))
            }
            "pieceOfFurniture" | "light" | "shelfUnit" => {
                piece(node, level, is_visible, None).map(|piece| self.pieces.push(piece))
            }
            "label" => {
                self.labels.extend(label(node, level));
                Some(())
            }
            "compass" => {
                self.latitude_deg = latitude_deg(node);
                Some(())
            }
            _ => Some(()),
        };
        self.unread += usize::from(is_read.is_none());
    }
}

fn level<'a>(node: Node<'a, '_>, ids: &mut LevelIds<'a>) -> Option<PlanLevel> {
    let id = node.attribute("id")?;
    let name = node.attribute("name").unwrap_or(id).to_owned();
    let (elevation_m, index) =
        (length(node, "elevation").unwrap_or(0.0), number(node, "elevationIndex").unwrap_or(0.0));
    let is_viewable = node.attribute("viewable") != Some("false");
    Some(PlanLevel { id: ids.id(id), name, elevation_m, height_m: length(node, "height"), index, is_viewable })
}

fn wall(node: Node, level: Option<LevelId>) -> Option<PlanWall> {
    /// The thickness of a new wall in Sweet Home 3D.
    const USUAL_THICKNESS_M: f64 = 0.075;
    let from = point(node, "xStart", "yStart")?;
    let to = point(node, "xEnd", "yEnd")?;
    let thickness_m = length(node, "thickness").filter(|&thickness| thickness > 0.0).unwrap_or(USUAL_THICKNESS_M);
    let arc_rad = -number(node, "arcExtent").unwrap_or(0.0);
    Some(PlanWall { level, from, to, thickness_m, arc_rad })
}

fn room(node: Node, level: Option<LevelId>) -> Option<PlanRoom> {
    let points = node.children().filter(|child| child.has_tag_name("point"));
    let corners: Vec<Point> = points.map(|corner| point(corner, "x", "y")).collect::<Option<_>>()?;
    let name = node.attribute("name").unwrap_or_default().to_owned();
    let has_floor = node.attribute("floorVisible") != Some("false");
    (corners.len() > 2).then_some(PlanRoom { level, name, corners, has_floor })
}

fn label(node: Node, level: Option<LevelId>) -> Option<Label> {
    let text = node.children().find(|child| child.has_tag_name("text")).and_then(|text| text.text());
    Some(Label { level, text: text.unwrap_or_default().to_owned(), at: point(node, "x", "y")? })
}

/// A piece, if it has all sizes; `unsaid_m` replaces a missing depth or height.
fn piece(node: Node, level: Option<LevelId>, is_visible: bool, unsaid_m: Option<f64>) -> Option<PlanPiece> {
    let positive = |key| length(node, key).filter(|&size| size > 0.0);
    // A leaning piece has another size as seen from above.
    let size = |in_plan, upright| positive(in_plan).or_else(|| positive(upright));
    let name = node.attribute("name").unwrap_or_default().to_owned();
    let catalog = words(node.attribute("catalogId").unwrap_or_default());
    Some(PlanPiece {
        level,
        words: words(&name),
        name,
        catalog,
        at: point(node, "x", "y")?,
        width_m: size("widthInPlan", "width")?,
        depth_m: size("depthInPlan", "depth").or(unsaid_m)?,
        turn_rad: -number(node, "angle").unwrap_or(0.0),
        elevation_m: length(node, "elevation").unwrap_or(0.0),
        height_m: size("heightInPlan", "height").or(unsaid_m)?,
        is_visible,
        is_cut_out: node.has_attribute("staircaseCutOutShape"),
    })
}

/// A door or window, as wide as its hole in the wall, at the place of that hole.
fn opening(node: Node, level: Option<LevelId>, is_visible: bool) -> Option<PlanPiece> {
    let mut piece = piece(node, level, is_visible, Some(0.0))?;
    let across = geometry::direction(piece.turn_rad.to_degrees());
    if let Some((middle, share)) = hole(node, "wallLeft", "wallWidth") {
        let mirror = if node.attribute("modelMirrored") == Some("true") { -1.0 } else { 1.0 };
        piece.at += across * (mirror * middle * piece.width_m);
        piece.width_m *= share;
    }
    // The back of a piece is to the north, and the wall's share of its depth is counted from there.
    if let Some((middle, _)) = hole(node, "wallDistance", "wallThickness") {
        piece.at -= across.perp() * (middle * piece.depth_m);
    }
    Some(piece)
}

/// The part of a piece that is in the wall: the offset of its middle, and its size, both as shares of the piece.
fn hole(node: Node, begin: &str, size: &str) -> Option<(f64, f64)> {
    let share = |key, usual| number(node, key).filter(|share| (0.0..=1.0).contains(share)).unwrap_or(usual);
    let (begin, size) = (share(begin, 0.0), share(size, 1.0));
    (size > 0.0 && begin + size <= 1.0).then_some((begin + size / 2.0 - 0.5, size))
}

/// The compass's latitude, limited to the range of homes.
fn latitude_deg(node: Node) -> Option<f64> {
    /// The range of latitudes of a home.
    const MOST_DEG: f64 = 65.0;
    let latitude_deg = number(node, "latitude")?.to_degrees();
    Some(((latitude_deg * 100.0).round() / 100.0).clamp(-MOST_DEG, MOST_DEG))
}

fn point(node: Node, x: &str, y: &str) -> Option<Point> {
    Some(Point::new(length(node, x)?, -length(node, y)?))
}

fn length(node: Node, key: &str) -> Option<f64> {
    number(node, key).map(|centimetres| centimetres / 100.0)
}

fn number(node: Node, key: &str) -> Option<f64> {
    let number: f64 = node.attribute(key)?.trim().parse().ok()?;
    (number.is_finite() && number.abs() <= GREATEST).then_some(number)
}
