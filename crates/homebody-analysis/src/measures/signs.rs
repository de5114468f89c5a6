//! Signs of a person in known rooms, and the room of a person whom several sensors see at once.
//!
//! Use, opening and closing of a thing are signs as much as a movement: many real homes have hardly a motion sensor.

use super::rooms::SensorRooms;
use crate::holds::{HiddenMovement, HoldTimes};
use crate::rows::StateRow;
use crate::signs::{Kind, RowMeaning, Says};
use homebody_core::time::{SECOND, Span, WallTime};

/// Time within which sensors see the same movement (our choice).
const TOGETHER: Span = SECOND.times(2);

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoomSign {
    pub at: WallTime,
    pub room: usize,
    /// The sensor, by its number in the log.
    pub sensor: usize,
    /// A movement was seen as it began. Else a thing was used, or a movement continued.
    pub is_seen: bool,
    /// Its sensor stays on for a hold time: then a single sign is as much as many of another sensor.
    pub is_held: bool,
}

/// The signs of the resident in known rooms, by rows in order of time. A movement is one sign. Things in use give one as they begin, and
/// one as they end.
pub fn signs(rows: &[StateRow], kinds: &[Kind], rooms: &SensorRooms, holds: &HoldTimes) -> Vec<RoomSign> {
    let sign = |row: &StateRow| {
        let sensor = row.sensor as usize;
        let room = rooms.of_sensors[sensor]?;
        gives_signs(kinds[sensor], &row.said).then_some(RoomSign {
            at: row.at,
            room,
            sensor,
            is_seen: kinds[sensor] == Kind::Motion,
            is_held: holds.hold(sensor).is_some(),
        })
    };
    let mut signs = Vec::with_capacity(rows.len());
    signs.extend(rows.iter().filter_map(sign));
    signs
}

/// The same signs and those of movements between reports, in the order of time. A movement that may have been before the last sign of
/// another room is left out.
pub fn with_movements(signs: &[RoomSign], movements: &[HiddenMovement], rooms: &SensorRooms) -> Vec<RoomSign> {
    let of_rows = signs.iter().map(|sign| (*sign, Span::ZERO));
    let of_movements = movements.iter().filter_map(|movement| {
        let sensor = movement.sensor as usize;
        let sign = RoomSign { at: movement.at, room: rooms.of_sensors[sensor]?, sensor, is_seen: false, is_held: true };
        Some((sign, movement.within))
    });
    let mut all: Vec<(RoomSign, Span)> = of_rows.chain(of_movements).collect();
    all.sort_by_key(|(sign, _)| sign.at);
    let is_sure = |index: &usize| {
        let (sign, within) = all[*index];
        let before = all[..*index].iter().rev().map(|(other, _)| other).take_while(|other| other.at > sign.at - within);
        within == Span::ZERO || before.into_iter().all(|other| other.room == sign.room)
    };
    (0..all.len()).filter(is_sure).map(|index| all[index].0).collect()
}

pub fn gives_signs(kind: Kind, said: &RowMeaning) -> bool {
    match kind {
        Kind::Motion => said.says == Says::Begins && said.is_sign(),
        Kind::Contact | Kind::Used => said.is_sign(),
        Kind::Reading | Kind::Other => false,
    }
}

/// The signs, each in the room where most of the sensors are that speak with it: a sensor that sees through an open door into
/// the next room speaks together with those in there, and one that sees who passes the door, with those out here. Of as many, it
/// is the sensor's own room.
pub fn agreed(signs: &[RoomSign]) -> Vec<RoomSign> {
    let (mut from, mut to) = (0, 0);
    // The signs of one room around the current one.
    let mut of_room = 0..0;
    let mut agreed = Vec::with_capacity(signs.len());
    // The sensors that speak, with their rooms; and by room, how many do.
    let (mut sensors, mut speaking) = (Vec::<(usize, usize)>::new(), Vec::<(usize, usize)>::new());
    for (number, sign) in signs.iter().enumerate() {
        if number == of_room.end {
            let others = signs[number..].iter().position(|other| other.room != sign.room);
            of_room = number..others.map_or(signs.len(), |others| number + others);
        }
        while signs[from].at < sign.at - TOGETHER {
            from += 1;
        }
        while signs.get(to).is_some_and(|other| other.at <= sign.at + TOGETHER) {
            to += 1;
        }
        if of_room.start <= from && to <= of_room.end {
            agreed.push(*sign);
            continue;
        }
        sensors.clear();
        speaking.clear();
        for other in &signs[from..to] {
            if sensors.contains(&(other.room, other.sensor)) {
                continue;
            }
            sensors.push((other.room, other.sensor));
            match speaking.iter_mut().find(|(room, _)| *room == other.room) {
                Some((_, count)) => *count += 1,
                None => speaking.push((other.room, 1)),
            }
        }
        let rank = |&(room, count): &(usize, usize)| (count, room == sign.room);
        let most = speaking.iter().reduce(|most, other| if rank(other) > rank(most) { other } else { most });
        agreed.push(RoomSign { room: most.map_or(sign.room, |(room, _)| *room), ..*sign });
    }
    agreed
}

#[cfg(test)]
mod tests {
    use super::*;

    const HALL: usize = 0;
    const BATHROOM: usize = 1;

    /// Signs by their seconds, rooms and sensors.
    fn at(signs: &[(i64, usize, usize)]) -> Vec<RoomSign> {
        let at = crate::sample::at;
        let sign = |&(s, room, sensor)| RoomSign { at: at(s), room, sensor, is_seen: true, is_held: false };
        signs.iter().map(sign).collect()
    }

    fn rooms(signs: &[(i64, usize, usize)]) -> Vec<usize> {
        agreed(&at(signs)).iter().map(|sign| sign.room).collect()
    }

    #[test]
    fn room_is_that_of_most_sensors_at_once() {
        // Two sensors of the bathroom, and that of the hall, which looks in.
        assert_eq!(rooms(&[(0, BATHROOM, 1), (1, HALL, 0), (2, BATHROOM, 2)]), [BATHROOM; 3]);
        // Two sensors of the hall, and that of the bathroom, which looks out.
        assert_eq!(rooms(&[(0, HALL, 3), (1, BATHROOM, 1), (2, HALL, 0)]), [HALL; 3]);
        // One of each, and each alone: nothing is known better.
        assert_eq!(rooms(&[(0, HALL, 0), (1, BATHROOM, 1)]), [HALL, BATHROOM]);
        // Two signs of one sensor count once.
        assert_eq!(rooms(&[(0, HALL, 0), (1, BATHROOM, 1), (2, HALL, 0)]), [HALL, BATHROOM, HALL]);
        assert_eq!(rooms(&[(0, BATHROOM, 1), (1, BATHROOM, 2), (9, HALL, 0)]), [BATHROOM, BATHROOM, HALL]);
    }
}
