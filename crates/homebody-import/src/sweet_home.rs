//! A plan of Sweet Home 3D as a home.

use crate::doors::WallDoor;
use crate::error::ImportError;
use crate::floor::{self, AllNames, BuiltFloor};
use crate::furniture::Furniture;
use crate::levels::{self, PlanLevels};
use crate::outline::{NamedRoom, rounded};
use crate::walls::StraightWall;
use crate::{archive, drawing, exits, markup, names, places, reachability, soundness, stairs, text};
use homebody_core::geometry::{self, At, Point};
use homebody_core::home::form::{HomeFile, latitude};
use homebody_core::plan::form::{DoorFile, FurnitureFile, PlaceFile, RoomFile, WallFile};
use homebody_core::problem::counted;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Imported {
    /// The text of a `home.json` that passes the check; its schemas are expected in a folder next to it.
    pub home_json: String,
    /// Omissions and guesses, a sentence each, at most some dozens.
    pub remarks: Vec<String>,
}

/// The path of the schema, relative to the home's folder.
pub const SCHEMA: &str = "./schemas/home.schema.json";

/// Largest number of remarks (our choice).
const MOST_REMARKS: usize = 40;

/// Makes a home with this name from the bytes of a `.sh3d` file.
///
/// `level` is the name of a level, or its number counted from the lowest. By default, the home is on the level with the
/// front door, and the levels joined to it by stairs are drawn next to it. The lower left corner of the walls' middle
/// lines is the origin, and lengths are rounded to millimetres.
pub fn sweet_home(bytes: &[u8], name: &str, level: Option<&str>) -> Result<Imported, ImportError> {
    let xml = archive::home_xml(bytes)?;
    let drawing = drawing::read(&markup::parse(&xml)?);
    let (latitude_deg, unread) = (drawing.latitude_deg, drawing.unread);
    let levels = levels::split(drawing, level)?;
    let mut remarks = Vec::new();
    if unread > 0 {
        let things = counted(unread, "thing without place or size", "things without place or size");
        remarks.push(format!("left out: {things}"));
    }
    let (mut floor, mut names, about) = joined_floors(&levels, &mut remarks)?;
    floor.put_way_out_first();
    remarks.extend((floor.way_out() == 0).then(|| no_way_out(&floor, &mut names)));
    let name = Some(names::clean(name)).filter(|name| !name.is_empty()).unwrap_or_else(|| "home".to_owned());
    let home = home(name, about, latitude_deg, floor, names);
    let home = soundness::passing(home, &mut remarks)?;
    let (mut mended, mut told) = (home.clone(), Vec::new());
    reachability::make_reachable(&mut mended, &mut told);
    let home_json = match mended == home || soundness::is_passing(&mended) {
        true => {
            remarks.extend(told);
            text::home_text(&mended)
        }
        false => text::home_text(&home),
    };
    if remarks.len() > MOST_REMARKS {
        let more = remarks.len() - MOST_REMARKS;
        remarks.truncate(MOST_REMARKS);
        remarks.push(format!("and {more} more remarks"));
    }
    Ok(Imported { home_json, remarks })
}

/// The floor with the front door, joined to those that its stairs reach; the names in use, and the description of the
/// home.
fn joined_floors(
    levels: &PlanLevels,
    remarks: &mut Vec<String>,
) -> Result<(BuiltFloor, AllNames, String), ImportError> {
    let built = |index: usize, is_home: bool, names: &mut AllNames, remarks: &mut Vec<String>| {
        let storey = &levels.storeys[index];
        floor::build(&storey.drawing, is_home, names, remarks).map(|floor| (storey.elevation_m, floor))
    };
    let without_remarks =
        |index: usize, is_home: bool| built(index, is_home, &mut AllNames::default(), &mut Vec::new());
    let mut names = AllNames::default();
    if levels.storeys.len() == 1 {
        let (_, floor) = built(0, true, &mut names, remarks)?;
        let about = about(levels, &[0]);
        levels.report(&[0], "the only one on which something is drawn", remarks);
        return Ok((floor, names, about));
    }
    // First each floor by itself: the choice of floors decides about names and remarks.
    let alone: Vec<_> = (0..levels.storeys.len()).map(|index| without_remarks(index, true)).collect();
    let sound: Vec<usize> = (0..alone.len()).filter(|&index| alone[index].is_ok()).collect();
    let fits = |&index: &usize| {
        let floor = alone[index].as_ref();
        floor.map(|(_, floor)| (floor.way_out(), !floor.is_open, floor.walls.len())).ok()
    };
    let Some(home) = sound.iter().copied().rev().max_by_key(fits) else {
        let first = alone.into_iter().find_map(Result::err);
        return Err(first.unwrap_or(ImportError::NoRooms));
    };
    let leads_out = fits(&home).is_some_and(|(way_out, ..)| way_out > 0);
    // Only the floor with the front door has rooms outside of the home.
    let again = |(index, floor): (usize, Result<(f64, BuiltFloor), ImportError>)| match floor {
        Ok((_, floor)) if floor.is_open && index != home => without_remarks(index, false),
        floor => floor,
    };
    let floors: Vec<_> = alone.into_iter().enumerate().map(again).collect();
    let sound: Vec<usize> = (0..floors.len()).filter(|&index| floors[index].is_ok()).collect();
    let floors: Vec<(f64, BuiltFloor)> = floors.into_iter().flatten().collect();
    let first = sound.iter().position(|&index| index == home).unwrap_or_default();
    let (_, taken) = stairs::unfold(&floors, first, &mut AllNames::default());
    let taken: Vec<usize> = taken.into_iter().map(|floor| sound[floor]).collect();

    let mut floors = Vec::new();
    for &index in &taken {
        let mut own = Vec::new();
        let (height_m, mut floor) = built(index, index == home, &mut names, &mut own)?;
        let name = levels.storeys[index].name.as_ref().filter(|_| taken.len() > 1);
        remarks.extend(own.into_iter().map(|remark| match name {
            Some(name) => format!("{name:?}: {remark}"),
            None => remark,
        }));
        if taken.len() > 1 {
            floor.rooms.iter_mut().for_each(|room| room.floor = levels.storeys[index].name.clone());
        }
        floors.push((height_m, floor));
    }
    let first = taken.iter().position(|&index| index == home).unwrap_or_default();
    let (floor, _) = stairs::unfold(&floors, first, &mut names);
    let why = match (taken.len(), leads_out) {
        (1, true) => "by which people come home",
        (1, false) => "which has the most walls",
        _ => "which stairs join",
    };
    levels.report(&taken, why, remarks);
    if taken.len() > 1 {
        let floors = listed(levels, &taken);
        remarks.push(format!("the floors {floors} are drawn beside each other, with the stairs as a passage between"));
    }
    Ok((floor, names, about(levels, &taken)))
}

fn about(levels: &PlanLevels, taken: &[usize]) -> String {
    let names = listed(levels, taken);
    match taken {
        _ if names.is_empty() => "From a plan made with Sweet Home 3D.".to_owned(),
        [_] => format!("The level {names} of a plan made with Sweet Home 3D."),
        _ => format!("The levels {names} of a plan made with Sweet Home 3D, unfolded into one plane."),
    }
}

/// The names of levels in a sentence; empty for a plan with one level.
fn listed(levels: &PlanLevels, taken: &[usize]) -> String {
    let names = taken.iter().filter_map(|&index| levels.storeys[index].name.as_ref());
    names.map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
}

/// Remark that no door leads out, with a complete line for `home.json` that adds one.
fn no_way_out(floor: &BuiltFloor, names: &mut AllNames) -> String {
    let what = "no door leads out of the home";
    let Some(exit) = exits::front_door(floor) else {
        return format!(
            "{what}: mark the front door as \"outside\" in home.json, or in the page as one that leads outside"
        );
    };
    let (half, origin) = (exit.out.perp() * (exits::DOOR_M / 2.0), origin(&floor.walls, &floor.rooms));
    let [from, to] = [exit.at + half, exit.at - half].map(|p| at(p, origin)).map(|[x, y]| format!("[{x}, {y}]"));
    let (name, room) = (names.doors.give("front door", "door"), &floor.rooms[exit.room].name);
    let door = format!("{{ \"name\": {name:?}, \"from\": {from}, \"to\": {to}, \"open\": false, \"outside\": true }}");
    format!(
        "{what}: mark the front door as \"outside\" in home.json, in the page as one that leads outside, or add to \"doors\" {door}, for which there is room in {room:?}"
    )
}

fn home(name: String, about: String, latitude_deg: Option<f64>, floor: BuiltFloor, mut names: AllNames) -> HomeFile {
    let origin = origin(&floor.walls, &floor.rooms);
    let places = places::named(&floor, &mut names.spots);
    let BuiltFloor { rooms, walls, doors, furniture, .. } = floor;
    HomeFile {
        schema: Some(SCHEMA.to_owned()),
        name,
        about,
        latitude_deg: latitude_deg.unwrap_or_else(latitude),
        rooms: rooms.into_iter().map(|room| room_file(room, origin)).collect(),
        walls: walls.into_iter().map(|wall| wall_file(wall, origin)).collect(),
        doors: doors.into_iter().map(|door| door_file(door, origin)).collect(),
        furniture: furniture.into_iter().map(|piece| furniture_file(piece, origin)).collect(),
        places: places.into_iter().map(|(name, p)| PlaceFile { name, at: at(p, origin) }).collect(),
        sensors: Vec::new(),
    }
}

/// The lower left corner of all walls, or of all rooms in a plan without walls.
fn origin(walls: &[StraightWall], rooms: &[NamedRoom]) -> Point {
    let ends = walls.iter().flat_map(|wall| [wall.from, wall.to]);
    let corners = rooms.iter().flat_map(|room| room.outline.iter().copied());
    let (least, _) = if walls.is_empty() { geometry::bounds(corners) } else { geometry::bounds(ends) };
    least
}

fn room_file(room: NamedRoom, origin: Point) -> RoomFile {
    let outline = room.outline.into_iter().map(|corner| at(corner, origin)).collect();
    RoomFile { floor: room.floor, ..RoomFile::new(room.name, outline) }
}

fn wall_file(wall: StraightWall, origin: Point) -> WallFile {
    let thickness_m = rounded(Point::splat(wall.thickness_m)).x;
    WallFile { from: at(wall.from, origin), to: at(wall.to, origin), thickness_m }
}

fn door_file(door: WallDoor, origin: Point) -> DoorFile {
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
        role: piece.role,
    }
}

fn at(p: Point, origin: Point) -> At {
    rounded(p - origin).into()
}
