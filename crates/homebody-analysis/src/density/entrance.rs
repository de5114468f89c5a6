//! The sensors at the entrance: as a person lists them, or by their names.

use serde::Serialize;

use crate::signs::{Kind, LogSensors};
use homebody_core::names::words;
use homebody_core::vocabulary::{FRONT_WORDS, ROLE_WORDS, WINDOW_WORDS, has_any};

/// The sensors by which somebody leaves and comes home.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entrance {
    /// Their ids in the log.
    pub sensors: Vec<String>,
    /// Why they are taken for that.
    pub chosen: Chosen,
}

/// Why they are taken for that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Chosen {
    /// Somebody says so.
    Asked,
    /// Their names speak of an entrance, or they are contacts of doors.
    Known,
    /// Their names speak of a door or a hall, and no better ones are there.
    Guessed,
    /// There is none.
    None,
}

impl Entrance {
    /// Those of the names that are asked for; else those that speak of an entrance, with all contacts but those of drawers
    /// and the like; else those that speak of a door or a hall. A name that speaks of another room is of a door in there.
    pub fn find(ids: &[String], sensors: &LogSensors, asked: &[String]) -> Entrance {
        let with = |chosen, takes: &dyn Fn(usize) -> bool| {
            let taken = ids.iter().enumerate().filter(|(sensor, _)| takes(*sensor)).map(|(_, id)| id.clone());
            Some(Entrance { sensors: taken.collect(), chosen }).filter(|entrance| !entrance.sensors.is_empty())
        };
        let none = Entrance { sensors: Vec::new(), chosen: Chosen::None };
        if !asked.is_empty() {
            return with(Chosen::Asked, &|sensor| asked.contains(&ids[sensor])).unwrap_or(none);
        }
        let LogSensors { called, kinds } = sensors;
        let leads_out =
            |sensor: usize| matches!(kinds[sensor], Kind::Motion | Kind::Contact) && !is_inner(&called[sensor]);
        let is_front = |name: &str| speaks(name, &ENTRANCES) || has_any(&words(name), FRONT_WORDS);
        let is_known = |sensor: usize| kinds[sensor] == Kind::Contact || is_front(&called[sensor]);
        with(Chosen::Known, &|sensor| leads_out(sensor) && is_known(sensor))
            .or_else(|| with(Chosen::Guessed, &|sensor| leads_out(sensor) && speaks(&called[sensor], &WAYS)))
            .unwrap_or(none)
    }
}

/// How words begin that speak of an entrance. All these words are ours.
const ENTRANCES: [&str; 6] = ["entr", "front", "foyer", "vestibule", "exit", "porch"];
const WAYS: [&str; 2] = ["door", "hall"];
/// Rooms and things whose doors lead out of no home.
const INNER: [&str; 28] = [
    "bed",
    "bath",
    "toilet",
    "shower",
    "kitchen",
    "living",
    "dining",
    "office",
    "study",
    "closet",
    "wardrobe",
    "cabinet",
    "cupboard",
    "drawer",
    "fridge",
    "refrigerator",
    "freezer",
    "oven",
    "microwave",
    "stove",
    "dishwasher",
    "washer",
    "laundry",
    "medicine",
    "pill",
    "window",
    "room",
    "pantry",
];

fn speaks(name: &str, of: &[&str]) -> bool {
    words(name).iter().any(|word| of.iter().any(|begin| word.starts_with(begin)))
}

fn is_inner(name: &str) -> bool {
    let words = words(name);
    let is_thing = || ROLE_WORDS.iter().any(|(_, known)| has_any(&words, known)) || has_any(&words, WINDOW_WORDS);
    speaks(name, &INNER) || has_any(&words, ROOMS) || is_thing()
}

/// Words in other languages for rooms inside a home.
const ROOMS: &str = "-zimmer küche -küche bad büro keller chambre cuisine salon bureau salle dormitorio cocina baño salón camera \
    cucina bagno soggiorno quarto cozinha -kamer keuken kök sovrum badrum vardagsrum kuchnia łazienka sypialnia kuchyně koupelna \
    ložnice кухня ванная спальня 厨房 卧室 浴室 客厅 台所 寝室";

#[cfg(test)]
mod tests {
    use super::*;

    fn found(sensors: &[(&str, Kind)], asked: &[&str]) -> (Vec<String>, Chosen) {
        let asked: Vec<String> = asked.iter().map(|name| (*name).into()).collect();
        let (called, kinds): (Vec<String>, Vec<Kind>) =
            sensors.iter().map(|&(called, kind)| (called.to_owned(), kind)).unzip();
        let entrance = Entrance::find(&called.clone(), &LogSensors { called, kinds }, &asked);
        (entrance.sensors, entrance.chosen)
    }

    #[test]
    fn the_best_names_are_taken() {
        use Kind::{Contact, Motion, Reading};
        let names = |names: &[&str]| names.iter().map(|name| String::from(*name)).collect::<Vec<_>>();
        let home = [("MainEntryway", Motion), ("BedroomADoor", Motion), ("HallwayA", Motion), ("front T", Reading)];
        assert_eq!(found(&home, &[]), (names(&["MainEntryway"]), Chosen::Known));
        assert_eq!(found(&home[1..], &[]), (names(&["HallwayA"]), Chosen::Guessed));
        assert_eq!(found(&home[1..2], &[]), (names(&[]), Chosen::None));
        assert_eq!(found(&home, &["BedroomADoor"]), (names(&["BedroomADoor"]), Chosen::Asked));
        let contacts = [("D002", Contact), ("kitchen drawer", Contact), ("M001", Motion)];
        assert_eq!(found(&contacts, &[]), (names(&["D002"]), Chosen::Known));
    }

    #[test]
    fn entrances_are_found_in_other_languages() {
        use Kind::{Contact, Motion};
        let names = |names: &[&str]| names.iter().map(|name| String::from(*name)).collect::<Vec<_>>();
        let home =
            [("haustuer", Contact), ("Kühlschrank", Contact), ("Schlafzimmer Fenster", Contact), ("Flur", Motion)];
        assert_eq!(found(&home, &[]), (names(&["haustuer"]), Chosen::Known));
        let home = [("Eingang", Motion), ("Küche Tür", Motion)];
        assert_eq!(found(&home, &[]), (names(&["Eingang"]), Chosen::Known));
    }
}
