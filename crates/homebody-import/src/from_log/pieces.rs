//! The furniture of a schematic home: the aims of sensors, and the things that a resident needs.

use super::interpretation::{Interpretation, LogRoom, SensorAim};
use super::words::{RoomKind, RoomThing};
use super::{LogSensor, Speaks};
use homebody_core::role::Role;

#[derive(Clone, Debug)]
pub struct NeededPiece {
    pub room: usize,
    pub thing: &'static RoomThing,
    pub sensors: Vec<usize>,
}

/// The things that a resident needs: the name of the thing and its possible kinds of rooms, the best first.
const NEEDED: [(&str, &[&str]); 8] = [
    ("bed", &["bedroom", "room", "study", "living room"]),
    ("toilet", &["bathroom", "toilet"]),
    ("washbasin", &["bathroom", "toilet"]),
    ("stove", &["kitchen"]),
    ("fridge", &["kitchen"]),
    ("sink", &["kitchen"]),
    ("armchair", &["living room", "room", "bedroom", "study", "dining room"]),
    ("dining chair", &["dining room", "kitchen"]),
];

/// The pieces of all rooms. Missing ones are added, with a room if no room may have them, and reported.
pub fn pieces(interpretation: &mut Interpretation, sensors: &[LogSensor]) -> Vec<NeededPiece> {
    let mut pieces: Vec<NeededPiece> = Vec::new();
    for (number, &(room, what)) in interpretation.sensors.iter().enumerate() {
        let SensorAim::Thing(thing) = what else { continue };
        // Each contact hangs on a piece of its own.
        let is_contact = |sensor: &usize| sensors[*sensor].speaks == Speaks::Contact;
        let may_share = |piece: &NeededPiece| !is_contact(&number) || !piece.sensors.iter().any(is_contact);
        let is_same =
            |piece: &&mut NeededPiece| piece.room == room && piece.thing.name == thing.name && may_share(piece);
        match pieces.iter_mut().find(is_same) {
            Some(piece) => piece.sensors.push(number),
            None => pieces.push(NeededPiece { room, thing, sensors: vec![number] }),
        }
    }
    let (mut things, mut rooms) = (Vec::new(), Vec::new());
    for (name, kinds) in NEEDED {
        let Some(thing) = RoomThing::named(name) else { continue };
        let will_do =
            |role: Option<Role>| role == thing.role || thing.role == Some(Role::Armchair) && role == Some(Role::Sofa);
        if pieces.iter().any(|piece| will_do(piece.thing.role)) {
            continue;
        }
        let room_of_kind = |kind: &&str| interpretation.rooms.iter().position(|room| room.kind.name == *kind);
        let room = kinds.iter().find_map(room_of_kind).unwrap_or_else(|| {
            let kind = RoomKind::named(kinds[0]);
            rooms.push(kind.name);
            interpretation.rooms.push(LogRoom { name: kind.name.to_owned(), kind, is_in_log: false });
            interpretation.rooms.len() - 1
        });
        things.push(name);
        pieces.push(NeededPiece { room, thing, sensors: Vec::new() });
    }
    for (what, names) in [("rooms", rooms), ("things", things)] {
        if !names.is_empty() {
            let names = names.join(", ");
            interpretation
                .guesses
                .push(format!("{what} that no sensor tells of, and that a life needs, are added: {names}"));
        }
    }
    pieces
}
