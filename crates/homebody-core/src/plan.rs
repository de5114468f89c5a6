//! The floor plan resolved: walls with their doors cut out, as solids that stop bodies and beams.

pub mod form;
pub mod sun;

use crate::geometry::{self, Point, point};
use crate::stride::Stride;
use crate::time::{RunTime, Span};
use form::{BuildingFiles, FurnitureFile, RoomFile, Spot};

/// A room of the plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// The room's name, as the home's file has it.
    pub name: String,
    /// Its corners in metres, in the order of the file; the last is joined to the first.
    pub outline: Vec<Point>,
    /// Whether the outline is convex, so that a straight way between two of its points stays in it.
    pub is_convex: bool,
}

impl Room {
    /// Whether a straight way from a point in the room to `to` surely stays in it. False where that takes a search.
    pub fn surely_holds(&self, from: Point, to: Point) -> bool {
        let (least, most) = (from.min(to), from.max(to));
        let is_near = |(a, b): (Point, Point)| a.min(b).cmple(most).all() && a.max(b).cmpge(least).all();
        geometry::contains(&self.outline, to) && (self.is_convex || !geometry::sides(&self.outline).any(is_near))
    }
}

/// The part of the home's file that a solid comes from: the index into that list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A piece of the wall of this index, between its doors.
    Wall(usize),
    /// The door of this index, which is closed, or shut behind each person who passes.
    Door(usize),
    /// The piece of furniture of this index.
    Furniture(usize),
}

/// A convex thing that stands in the home.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// The part of the file.
    pub origin: Origin,
    /// Convex, corners counter-clockwise.
    pub outline: Vec<Point>,
    /// Beams that pass lower are stopped; infinite for walls and closed doors.
    pub height_m: f64,
    /// Whether it stops bodies.
    pub stops_bodies: bool,
}

/// The passage of a door: a rectangle through its wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// Index into the home's doors, which are also the first of its things.
    pub door: usize,
    /// The corners of the rectangle, in metres: as long as the door, as thick as the wall.
    pub outline: Vec<Point>,
}

/// Something that can be used: opened and closed, or turned on and off.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// The name of the door, of the piece of furniture or of the lamp's room.
    pub name: String,
    /// The middle, in metres.
    pub at: Point,
    /// The state at the start of a run: open or on.
    pub on: bool,
}

/// The floor plan of a home.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The rooms by [`RoomId`](crate::ids::RoomId), in the order of the home's file.
    pub rooms: Vec<Room>,
    /// The things that can be used: doors, then furniture, then the lamps of rooms, under the rooms' names.
    pub things: Vec<Thing>,
    /// The obstacles to bodies or beams: walls between their doors, closed doors, furniture.
    pub solids: Vec<Solid>,
    /// The doors that let people through.
    pub openings: Vec<Opening>,
    /// Points with a name: places, then enterable furniture, then rooms.
    pub places: Vec<(String, Point)>,
}

/// The largest distance of a door's jamb from the middle line of its wall, in metres.
pub const JAMB_TOLERANCE_M: f64 = 0.01;

/// In metres. A shorter piece of wall next to a door comes from rounding. Its outline would be a point.
const LEAST_WALL_M: f64 = 1e-9;

/// Greatest height of furniture, such as a carpet, that blocks no one, in metres (our choice): people step over it.
pub const FLAT_M: f64 = 0.05;

/// A floor of a home that has several.
#[derive(Clone, Debug, PartialEq)]
pub struct Floor {
    /// The name.
    pub name: String,
    /// The corners of the box around its rooms, in metres.
    pub bounds: (Point, Point),
}

/// The floors that the rooms of a home are on, in the order of the file; none where no room says so.
pub fn floors(rooms: &[RoomFile]) -> Vec<Floor> {
    let mut floors: Vec<Floor> = Vec::new();
    for room in rooms {
        let Some(name) = &room.floor else { continue };
        let (least, most) = geometry::bounds(room.outline.iter().map(|&at| point(at)));
        match floors.iter_mut().find(|floor| floor.name == *name) {
            Some(Floor { bounds, .. }) => *bounds = (bounds.0.min(least), bounds.1.max(most)),
            None => floors.push(Floor { name: name.clone(), bounds: (least, most) }),
        }
    }
    floors
}

impl Plan {
    /// Resolves the building of a home that has passed its checks.
    pub fn new<'a>(building: impl Into<BuildingFiles<'a>>) -> Plan {
        let home = building.into();
        let mut solids = Vec::new();
        let mut openings = Vec::new();
        for (index, wall) in home.walls.iter().enumerate() {
            let (from, to) = (point(wall.from), point(wall.to));
            let length = from.distance(to);
            let along = (to - from) / length;
            let mut gaps: Vec<(f64, f64)> = Vec::new();
            for (door_index, door) in home.doors.iter().enumerate() {
                let Some((start, end)) = span_on_wall(from, to, point(door.from), point(door.to)) else { continue };
                gaps.push((start, end));
                let outline = geometry::thick_segment(from + along * start, from + along * end, wall.thickness_m);
                if !door.open || door.shut_behind {
                    let (origin, outline) = (Origin::Door(door_index), outline.clone());
                    solids.push(Solid { origin, outline, height_m: f64::INFINITY, stops_bodies: !door.open });
                }
                if door.open {
                    openings.push(Opening { door: door_index, outline });
                }
            }
            gaps.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut start = 0.0;
            for (gap_start, gap_end) in gaps.into_iter().chain([(length, length)]) {
                if gap_start - start > LEAST_WALL_M {
                    let outline =
                        geometry::thick_segment(from + along * start, from + along * gap_start, wall.thickness_m);
                    let origin = Origin::Wall(index);
                    solids.push(Solid { origin, outline, height_m: f64::INFINITY, stops_bodies: true });
                }
                start = start.max(gap_end);
            }
        }
        for (index, piece) in home.furniture.iter().enumerate() {
            let mut outline = furniture_outline(piece);
            if geometry::signed_area(&outline) < 0.0 {
                outline.reverse();
            }
            let origin = Origin::Furniture(index);
            let stops_bodies = !piece.enterable && piece.height_m > FLAT_M;
            solids.push(Solid { origin, outline, height_m: piece.height_m, stops_bodies });
        }
        let rooms: Vec<Room> = home
            .rooms
            .iter()
            .map(|room| {
                let outline = geometry::points(&room.outline);
                Room { name: room.name.clone(), is_convex: geometry::is_convex(&outline), outline }
            })
            .collect();
        let thing = |name: &str, at, on| Thing { name: name.into(), at, on };
        let doors = home.doors.iter().map(|door| {
            // The way out stands open to bodies, not to the draught.
            thing(&door.name, (point(door.from) + point(door.to)) / 2.0, door.open && !door.outside)
        });
        let furniture = home
            .furniture
            .iter()
            .map(|piece| thing(&piece.name, geometry::inner_point(&furniture_outline(piece)), false));
        let lamps = rooms.iter().map(|room| thing(&room.name, geometry::inner_point(&room.outline), false));
        let things = doors.chain(furniture).chain(lamps).collect();
        let places = home.places.iter().map(|place| (place.name.clone(), point(place.at)));
        let seats = home.furniture.iter().filter(|piece| piece.enterable);
        let seats = seats.map(|piece| (piece.name.clone(), geometry::inner_point(&furniture_outline(piece))));
        let named_rooms = rooms.iter().map(|room| (room.name.clone(), geometry::inner_point(&room.outline)));
        let places = places.chain(seats).chain(named_rooms).collect();
        Plan { rooms, things, solids, openings, places }
    }

    /// The room a point lies in. A border belongs to the room to the east of it, or to the north where it runs from east
    /// to west; of rooms that overlap, the first of the file counts.
    pub fn room_at(&self, p: Point) -> Option<usize> {
        self.rooms.iter().position(|room| geometry::contains(&room.outline, p))
    }

    /// Whether the point is inside the home: in a room or in the opening of a door.
    pub fn is_inside(&self, p: Point) -> bool {
        self.room_at(p).is_some() || self.openings.iter().any(|opening| geometry::contains(&opening.outline, p))
    }

    /// The distance of a point from the nearest room or door opening, in metres; 0 inside.
    pub fn distance_outside(&self, p: Point) -> f64 {
        let rooms = self.rooms.iter().map(|room| &room.outline);
        let areas = rooms.chain(self.openings.iter().map(|opening| &opening.outline));
        areas.map(|area| geometry::distance_to_area(area, p)).fold(f64::INFINITY, f64::min)
    }

    /// Whether a door's rectangle leads out: on one side of it, at a body's radius from the wall, the home ends.
    pub fn leads_out(&self, outline: &[Point], radius_m: f64) -> bool {
        let &[a, b, c, d] = outline else { return false };
        let (near, far) = ((a + b) / 2.0, (c + d) / 2.0);
        let beyond = (far - near).normalize_or_zero() * radius_m;
        !self.is_inside(near - beyond) || !self.is_inside(far + beyond)
    }

    /// Whether a body of this radius can stand at the point.
    pub fn is_walkable(&self, p: Point, radius: f64) -> bool {
        // Most solids are far off, which costs little to see; rounding decides nothing at twice the radius.
        let is_far = |outline: &[Point]| {
            let (least, most) = geometry::bounds(outline.iter().copied());
            p.cmplt(least - 2.0 * radius).any() || p.cmpgt(most + 2.0 * radius).any()
        };
        let stops = |Solid { outline, stops_bodies, .. }: &Solid| {
            *stops_bodies && !is_far(outline) && geometry::distance_to_area(outline, p) < radius
        };
        self.is_inside(p) && !self.solids.iter().any(stops)
    }

    /// The rooms along a stride, each with the instant at which the body enters it; `None` between rooms.
    pub fn rooms_along(&self, stride: &Stride) -> Vec<(RunTime, Option<usize>)> {
        let way = stride.to - stride.from;
        let (least, most) = (stride.from.min(stride.to), stride.from.max(stride.to));
        let is_near = |(a, b): &(Point, Point)| a.min(*b).cmple(most).all() && a.max(*b).cmpge(least).all();
        let mut cuts = vec![0.0];
        for (a, b) in self.rooms.iter().flat_map(|room| geometry::sides(&room.outline)).filter(is_near) {
            let (side, turn) = (b - a, way.perp_dot(b - a));
            let (along, across) = ((a - stride.from).perp_dot(side) / turn, (a - stride.from).perp_dot(way) / turn);
            if turn != 0.0 && along > 0.0 && along < 1.0 && (0.0..=1.0).contains(&across) {
                cuts.push(along);
            }
        }
        cuts.sort_by(f64::total_cmp);
        let ends = cuts.iter().skip(1).copied().chain([1.0]);
        let mut rooms: Vec<(RunTime, Option<usize>)> = Vec::new();
        for (start, end) in cuts.iter().copied().zip(ends) {
            let room = self.room_at(stride.from + way * ((start + end) / 2.0));
            if rooms.last().is_none_or(|(_, last)| *last != room) {
                let after = libm::ceil(start * (stride.end - stride.begin).micros() as f64);
                let at = stride.begin + Span::from_micros(after as i64);
                rooms.push((at, room));
            }
        }
        rooms
    }

    /// The index of the thing of a name; of several, the first.
    pub fn thing(&self, name: &str) -> Option<usize> {
        self.things.iter().position(|thing| thing.name == name)
    }

    /// The index of the lamp of a room; `None` if there is no such room.
    pub fn lamp(&self, room: &str) -> Option<usize> {
        let room = self.rooms.iter().position(|known| known.name == room)?;
        Some(self.things.len() - self.rooms.len() + room)
    }

    /// The piece of furniture of a name; of several, the first.
    pub fn piece(&self, name: &str) -> Option<&Solid> {
        let pieces = || self.solids.iter().filter(|solid| matches!(solid.origin, Origin::Furniture(_)));
        let doors = self.things.len() - self.rooms.len() - pieces().count();
        pieces().zip(&self.things[doors..]).find(|(_, thing)| thing.name == name).map(|(piece, _)| piece)
    }

    /// The position of a spot of a path; `None` if the home has no place of that name.
    pub fn spot(&self, spot: &Spot) -> Option<Point> {
        match spot {
            Spot::At(at) => Some(point(*at)),
            Spot::Place(name) => self.places.iter().find(|(place, _)| place == name).map(|(_, at)| *at),
        }
    }

    /// The least and the greatest corner of the plan, walls included.
    pub fn bounds(&self) -> (Point, Point) {
        let rooms = self.rooms.iter().flat_map(|room| room.outline.iter());
        geometry::bounds(rooms.chain(self.solids.iter().flat_map(|solid| solid.outline.iter())).copied())
    }
}

/// The position of a door on a wall, as distances from the wall's start; `None` if it is on another wall.
pub fn span_on_wall(from: Point, to: Point, jamb: Point, other: Point) -> Option<(f64, f64)> {
    let on_wall = |p: Point| geometry::distance_to_segment(p, from, to) <= JAMB_TOLERANCE_M;
    if !on_wall(jamb) || !on_wall(other) {
        return None;
    }
    let along = (to - from).normalize_or_zero();
    let (a, b) = ((jamb - from).dot(along), (other - from).dot(along));
    Some((a.min(b).max(0.0), a.max(b)))
}

/// The corners of a piece of furniture, as its file gives them; empty if the file gives neither form.
pub fn furniture_outline(piece: &FurnitureFile) -> Vec<Point> {
    if let Some(outline) = &piece.outline {
        return geometry::points(outline);
    }
    let (Some(at), Some([width, depth])) = (piece.at, piece.size_m) else { return Vec::new() };
    let (x, y) = (
        geometry::direction(piece.turn_deg) * (width / 2.0),
        geometry::direction(piece.turn_deg + 90.0) * (depth / 2.0),
    );
    let middle = point(at);
    vec![middle - x - y, middle + x - y, middle + x + y, middle - x + y]
}
