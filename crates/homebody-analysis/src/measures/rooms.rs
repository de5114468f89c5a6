//! Which room each sensor of a log is in, and what the room is for: by its home, where that is known, else by names.

use homebody_core::names::words;
use std::collections::BTreeMap;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Purpose {
    Bedroom,
    Bathroom,
    Kitchen,
    Other,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct SensorRooms {
    /// By number: the name and the purpose.
    pub rooms: Vec<(String, Purpose)>,
    /// By sensor of the log.
    pub of_sensors: Vec<Option<usize>>,
}

/// A room in names of sensors: its name here, its purpose, and its words (our choice). Of two, the word that stands first in a name
/// decides: a `KitchenDoor` is the kitchen's. The hall comes last, for a `hall-bathroom door` and a `front bedroom` are of the other.
const ROOM_WORDS: [(&str, Purpose, &str); 7] = [
    ("bedroom", Purpose::Bedroom, "bedroom bed bedside mattress"),
    ("bathroom", Purpose::Bathroom, "bathroom bath bathtub toilet shower wc loo restroom basin flush"),
    (
        "kitchen",
        Purpose::Kitchen,
        "kitchen stove fridge refrigerator freezer microwave oven dishwasher cooktop toaster",
    ),
    ("living room", Purpose::Other, "living lounge sofa couch armchair recliner tv television"),
    ("dining room", Purpose::Other, "dining"),
    ("study", Purpose::Other, "study office work desk computer"),
    ("hall", Purpose::Other, "hall hallway corridor entry entryway entrance foyer front main"),
];

fn named_room(name: &str) -> Option<(&'static str, Purpose)> {
    let said = words(name);
    let (hall, others) = ROOM_WORDS.split_last()?;
    let tells = |of: &[(&'static str, Purpose, &str)]| {
        said.iter().find_map(|word| {
            let told = of.iter().find(|(.., words)| words.split(' ').any(|one| one == word))?;
            Some((told.0, told.1))
        })
    };
    tells(others).or_else(|| tells(std::slice::from_ref(hall)))
}

pub fn purpose(room: &str) -> Purpose {
    named_room(room).map_or(Purpose::Other, |(_, purpose)| purpose)
}

impl SensorRooms {
    /// The rooms of these sensors. `known` has the rooms of some of them; if it has none, names decide.
    pub fn from_sensors(sensors: &[String], known: &BTreeMap<String, String>) -> SensorRooms {
        let mut rooms = SensorRooms::default();
        for sensor in sensors {
            let room = match known.is_empty() {
                true => named_room(sensor).map(|(name, purpose)| (name.to_owned(), purpose)),
                false => known.get(sensor).map(|room| (room.clone(), purpose(room))),
            };
            let number = room.map(|room| rooms.number(room));
            rooms.of_sensors.push(number);
        }
        rooms
    }

    /// The rooms of some of the sensors. The other sensors are in no room.
    pub fn among(&self, takes: &dyn Fn(usize) -> bool) -> SensorRooms {
        let mut rooms = SensorRooms::default();
        for (sensor, room) in self.of_sensors.iter().enumerate() {
            let room = room.filter(|_| takes(sensor)).map(|room| self.rooms[room].clone());
            let number = room.map(|room| rooms.number(room));
            rooms.of_sensors.push(number);
        }
        rooms
    }

    /// The number of a room; an unknown room gets a new one.
    pub fn number(&mut self, room: (String, Purpose)) -> usize {
        self.rooms.iter().position(|known| known.0 == room.0).unwrap_or_else(|| {
            self.rooms.push(room);
            self.rooms.len() - 1
        })
    }

    pub fn name_of(&self, sensor: usize) -> Option<&str> {
        Some(&self.rooms[self.of_sensors.get(sensor).copied().flatten()?].0)
    }

    pub fn purpose(&self, room: usize) -> Purpose {
        self.rooms[room].1
    }

    pub fn has(&self, purpose: Purpose) -> bool {
        self.rooms.iter().any(|room| room.1 == purpose)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rooms_are_those_of_the_home_or_else_of_names() {
        let sensors: Vec<String> =
            ["BedroomABed", "KitchenADoor", "M003", "shower motion", "MainDoor"].map(String::from).into();
        let rooms = SensorRooms::from_sensors(&sensors, &BTreeMap::new());
        let of = |rooms: &SensorRooms, sensor: usize| rooms.of_sensors[sensor].map(|room| rooms.rooms[room].0.clone());
        let found: Vec<Option<String>> = (0..5).map(|sensor| of(&rooms, sensor)).collect();
        assert_eq!(
            found,
            [Some("bedroom"), Some("kitchen"), None, Some("bathroom"), Some("hall")].map(|room| room.map(String::from))
        );
        let known = BTreeMap::from([("M003".to_owned(), "guest bedroom".to_owned())]);
        let rooms = SensorRooms::from_sensors(&sensors, &known);
        assert_eq!((of(&rooms, 0), of(&rooms, 2)), (None, Some("guest bedroom".to_owned())));
        assert!(rooms.has(Purpose::Bedroom) && !rooms.has(Purpose::Kitchen));
        let none = rooms.among(&|sensor| sensor != 2);
        assert!(none.rooms.is_empty() && none.of_sensors == [None; 5], "{none:?}");
    }
}
