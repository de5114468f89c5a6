//! One floor: the drawing of a level as rooms, walls, doors and furniture that fit together.

use crate::doors::WallDoor;
use crate::drawing::{self, PlanDrawing, PlanPiece};
use crate::error::ImportError;
use crate::furniture::Furniture;
use crate::names::NamePool;
use crate::outline::NamedRoom;
use crate::passages::{self, WallGap};
use crate::walls::StraightWall;
use crate::{doors, furniture, kinds, outdoors, rooms, spaces, walls};
use homebody_core::geometry::Point;
use homebody_core::home::form::GREATEST_SIZE_M;
use homebody_core::problem::counted;

/// A floor in the coordinates of its plan, or several that are joined by stairs.
#[derive(Clone, Debug)]
pub struct BuiltFloor {
    pub rooms: Vec<NamedRoom>,
    pub walls: Vec<StraightWall>,
    pub doors: Vec<WallDoor>,
    pub furniture: Vec<Furniture>,
    pub stairs: Vec<PlanPiece>,
    /// True if its way out leads into an open-air room.
    pub is_open: bool,
}

/// The names of a home. Rooms and furniture share theirs: paths go to either, and lamps are named after rooms.
#[derive(Default)]
pub struct AllNames {
    pub spots: NamePool,
    pub doors: NamePool,
}

/// Builds the floor of one level. With `is_home`, people may come home to it: the open-air rooms before its front door
/// are then outside.
pub fn build(
    drawing: &PlanDrawing,
    is_home: bool,
    names: &mut AllNames,
    remarks: &mut Vec<String>,
) -> Result<BuiltFloor, ImportError> {
    let openings = doors::without_windows(drawing.openings.clone(), remarks)?;
    let drawn_rooms = rooms::named(drawing, remarks);
    let outlines = if drawing.walls.is_empty() { rooms::outlines(&drawn_rooms, &openings) } else { Vec::new() };
    if !outlines.is_empty() {
        remarks.push("the plan has doors but no walls; the outlines of rooms with doors are walls now".to_owned());
    }
    let all_walls = [&drawing.walls[..], &outlines].concat();
    let mut walls = walls::joined(walls::straight(&all_walls, &openings, remarks)?);
    let drawn_rooms = spaces::split_rooms(drawn_rooms, &walls, remarks);
    let drawn = walls.len();
    walls.extend(doors::gaps(&openings, &walls, remarks));
    let in_gaps = drawn..walls.len();
    let at: Vec<Point> = openings.iter().map(|door| door.at).collect();
    let mut passages = passages::gaps(&walls, &at, &drawn_rooms);
    walls.extend(passages.iter().map(|passage| passage.wall.clone()));
    let mut rooms = rooms::place(&drawn_rooms, &walls, &mut names.spots, remarks)?;
    let spaces = spaces::without_room(&walls, &rooms);
    if !spaces.is_empty() {
        let spaces_are =
            counted(spaces.len(), "space that walls enclose is a room", "spaces that walls enclose are rooms");
        remarks.push(format!("{spaces_are} now, which the plan does not draw"));
        let room = |corners| {
            let mut room = drawing::PlanRoom { level: None, name: String::new(), corners, has_floor: true };
            rooms::name_by_label(&mut room, &drawing.labels);
            room
        };
        let spaces: Vec<drawing::PlanRoom> = spaces.into_iter().map(room).collect();
        rooms.extend(rooms::place(&spaces, &walls, &mut names.spots, remarks)?);
    }
    passages::thick_enough(&mut walls[in_gaps], &rooms);
    let Some(first) = rooms.first().map(|room| room.outline[0]) else { return Err(ImportError::NoRooms) };
    let all = walls.len() + rooms.len();
    let is_near = |p: &Point| (*p - first).abs().max_element() <= GREATEST_SIZE_M;
    walls.retain(|wall| is_near(&wall.from) && is_near(&wall.to));
    rooms.retain(|room| room.outline.iter().all(is_near));
    let far = all - walls.len() - rooms.len();
    if far > 0 {
        let far = counted(far, "wall or room", "walls and rooms");
        remarks.push(format!("left out: {far} more than {GREATEST_SIZE_M} m away"));
    }
    let seams = passages::seams(&walls, &rooms);
    walls.extend(seams.iter().map(|seam| seam.wall.clone()));
    let mut doors = doors::place(&openings, &walls, &rooms, &mut names.doors, remarks);
    if !passages.is_empty() {
        let are = counted(passages.len(), "gap between walls is a passage", "gaps between walls are passages");
        remarks.push(format!("{are} now, as rooms end at both of its sides"));
    }
    passages.extend(seams);
    doors.extend(passages.into_iter().map(|WallGap { from, to, .. }| {
        let name = names.doors.give("passage", "passage");
        WallDoor { name, from, to, is_outside: false, leads_home: 0 }
    }));
    let is_open = is_home && outdoors::remove_open_rooms(&mut rooms, &walls, &mut doors, remarks);
    let furniture = furniture::place(drawing.pieces.clone(), &rooms, &mut names.spots, remarks)?;
    let stairs = drawing.pieces.iter().filter(|piece| piece.is_visible && kinds::is_stairs(piece)).cloned().collect();
    Ok(BuiltFloor { rooms, walls, doors, furniture, stairs, is_open })
}

impl BuiltFloor {
    /// The preference for this floor as the way home: 0 without a door that leads out, 3 with a front door.
    pub fn way_out(&self) -> usize {
        doors::way_out(&self.doors)
    }

    /// Puts the way out before all other doors: the first door that leads out is used.
    pub fn put_way_out_first(&mut self) {
        let best = (0..self.doors.len()).filter(|&index| self.doors[index].is_outside);
        let best = best.rev().max_by_key(|&index| self.doors[index].leads_home);
        if let Some(best) = best {
            self.doors[..=best].rotate_right(1);
        }
    }

    pub fn points(&self) -> impl Iterator<Item = Point> + '_ {
        let ends = self.walls.iter().flat_map(|wall| [wall.from, wall.to]);
        ends.chain(self.rooms.iter().flat_map(|room| room.outline.iter().copied()))
    }
}
