//! A plan of Sweet Home 3D as a home.

use crate::doors::Door;
use crate::drawing::{self, Drawing};
use crate::error::NotImported;
use crate::furniture::Furniture;
use crate::names::{self, Names};
use crate::outline::{Room, rounded};
use crate::walls::Wall;
use crate::{archive, doors, enclosed, furniture, levels, markup, rooms, sound, walls};
use homebody_core::geometry::{self, At, Point};
use homebody_core::problem::counted;
use homebody_core::scenario::home::{DoorFile, FurnitureFile, GREATEST_SIZE_M, HomeFile, RoomFile, WallFile, latitude};

/// A home, and what was left out of the plan or guessed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Imported {
    /// The text of a `home.json` that passes the check; its schemas are expected in a folder beside it.
    pub home_json: String,
    /// What was left out or guessed, a sentence each, at most some dozens.
    pub remarks: Vec<String>,
}

/// Where the schema of what is made is looked for: in a folder beside it.
pub const SCHEMA: &str = "./schemas/home.schema.json";

/// Nobody reads more (ours).
const MOST_REMARKS: usize = 40;

/// Makes a home of this name of the bytes of a `.sh3d` file.
///
/// `level` is the name of a level, or its number counted from the lowest; without it, the one with the most walls is
/// taken. The lower left corner of the walls' middle lines is the origin, and lengths are rounded to millimetres.
pub fn sweet_home(bytes: &[u8], name: &str, level: Option<&str>) -> Result<Imported, NotImported> {
    let xml = archive::home_xml(bytes)?;
    let mut drawing = drawing::read(&markup::parse(&xml)?);
    let mut remarks = Vec::new();
    let level = levels::keep_one(&mut drawing, level, &mut remarks)?;
    if drawing.unread > 0 {
        let things = counted(drawing.unread, "thing without place or size", "things without place or size");
        remarks.push(format!("left out: {things}"));
    }
    let about = match level {
        Some(level) => format!("The level {level:?} of a plan made with Sweet Home 3D."),
        None => "From a plan made with Sweet Home 3D.".to_owned(),
    };
    let home = build(name, about, drawing, &mut remarks)?;
    let home_json = sound::text(home, &mut remarks)?;
    if remarks.len() > MOST_REMARKS {
        let more = remarks.len() - MOST_REMARKS;
        remarks.truncate(MOST_REMARKS);
        remarks.push(format!("and {more} more remarks"));
    }
    Ok(Imported { home_json, remarks })
}

fn build(name: &str, about: String, drawing: Drawing, remarks: &mut Vec<String>) -> Result<HomeFile, NotImported> {
    let doors = doors::only(drawing.openings, remarks)?;
    let mut walls = walls::straight(&drawing.walls, &doors, remarks)?;
    // Rooms and furniture share names: paths go to either, and lamps are called after rooms.
    let mut names = Names::default();
    let mut rooms = rooms::place(&drawing.rooms, &walls, &mut names, remarks)?;
    let spaces = enclosed::without_room(&walls, &rooms);
    if !spaces.is_empty() {
        let spaces_are =
            counted(spaces.len(), "space that walls enclose is a room", "spaces that walls enclose are rooms");
        remarks.push(format!("{spaces_are} now, which the plan does not draw"));
        let room = |corners| drawing::Room { level: None, name: String::new(), corners };
        let spaces: Vec<drawing::Room> = spaces.into_iter().map(room).collect();
        rooms.extend(rooms::place(&spaces, &walls, &mut names, remarks)?);
    }
    let Some(first) = rooms.first().map(|room| room.outline[0]) else { return Err(NotImported::NoRooms) };
    let all = walls.len() + rooms.len();
    let is_near = |p: &Point| (*p - first).abs().max_element() <= GREATEST_SIZE_M;
    walls.retain(|wall| is_near(&wall.from) && is_near(&wall.to));
    rooms.retain(|room| room.outline.iter().all(is_near));
    let far = all - walls.len() - rooms.len();
    if far > 0 {
        let far = counted(far, "wall or room", "walls and rooms");
        remarks.push(format!("left out: {far} more than {GREATEST_SIZE_M} m away"));
    }
    let doors = doors::place(&doors, &walls, &rooms, remarks);
    let furniture = furniture::place(drawing.pieces, &rooms, &mut names, remarks)?;
    let name = Some(names::clean(name)).filter(|name| !name.is_empty()).unwrap_or_else(|| "home".to_owned());
    let origin = origin(&walls, &rooms);
    Ok(HomeFile {
        schema: Some(SCHEMA.to_owned()),
        name,
        about,
        latitude_deg: drawing.latitude_deg.unwrap_or_else(latitude),
        rooms: rooms.into_iter().map(|room| room_file(room, origin)).collect(),
        walls: walls.into_iter().map(|wall| wall_file(wall, origin)).collect(),
        doors: doors.into_iter().map(|door| door_file(door, origin)).collect(),
        furniture: furniture.into_iter().map(|piece| furniture_file(piece, origin)).collect(),
        places: Vec::new(),
        sensors: Vec::new(),
    })
}

/// The lower left corner of all walls, or of all rooms where there are none.
fn origin(walls: &[Wall], rooms: &[Room]) -> Point {
    let ends = walls.iter().flat_map(|wall| [wall.from, wall.to]);
    let corners = rooms.iter().flat_map(|room| room.outline.iter().copied());
    let (least, _) = if walls.is_empty() { geometry::bounds(corners) } else { geometry::bounds(ends) };
    least
}

fn room_file(room: Room, origin: Point) -> RoomFile {
    RoomFile { name: room.name, outline: room.outline.into_iter().map(|corner| at(corner, origin)).collect() }
}

fn wall_file(wall: Wall, origin: Point) -> WallFile {
    let thickness_m = rounded(Point::splat(wall.thickness_m)).x;
    WallFile { from: at(wall.from, origin), to: at(wall.to, origin), thickness_m }
}

fn door_file(door: Door, origin: Point) -> DoorFile {
    let (from, to) = (at(door.from, origin), at(door.to, origin));
    DoorFile { name: door.name, from, to, open: !door.is_outside, shut_behind: false, outside: door.is_outside }
}

fn furniture_file(piece: Furniture, origin: Point) -> FurnitureFile {
    FurnitureFile {
        name: piece.name,
        at: Some(at(piece.at, origin)),
        size_m: Some(piece.size_m),
        turn_deg: piece.turn_deg,
        outline: None,
        height_m: piece.height_m,
        enterable: piece.is_enterable,
        role: None,
    }
}

fn at(p: Point, origin: Point) -> At {
    rounded(p - origin).into()
}
