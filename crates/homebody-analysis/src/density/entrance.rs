//! The sensors at the entrance: as a person lists them, or by their names.

use serde::Serialize;

use crate::signs::{Kind, LogSensors};
use homebody_core::doors::{Leads, leads};
use homebody_core::names::words;

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Entrance {
    pub sensors: Vec<String>,
    pub chosen: EntranceSource,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EntranceSource {
    Asked,
    /// Their names speak of an entrance, or are those of bare doors.
    Known,
    /// They are other contacts, or their names speak of a door or a hall, and the log has none better.
    Guessed,
    #[default]
    None,
}

impl Entrance {
    /// The sensors that a person asks for. Without these, sensors whose names speak of an entrance, and bare doors if no front door
    /// has a contact. Without these, other contacts, and names that speak of a door or a hall. A thing inside leads nowhere.
    pub fn find(ids: &[String], sensors: &LogSensors, asked: &[String]) -> Entrance {
        let with = |chosen, takes: &dyn Fn(usize) -> bool| {
            let taken = ids.iter().enumerate().filter(|(sensor, _)| takes(*sensor)).map(|(_, id)| id.clone());
            Some(Entrance { sensors: taken.collect(), chosen }).filter(|entrance| !entrance.sensors.is_empty())
        };
        if !asked.is_empty() {
            return with(EntranceSource::Asked, &|sensor| asked.contains(&ids[sensor])).unwrap_or_default();
        }
        let leads: Vec<Leads> = sensors.called.iter().map(|name| leads(name)).collect();
        let is = |sensor: usize, kind| sensors.kinds[sensor] == kind;
        let leads_out =
            |sensor: usize| leads[sensor] == Leads::Out && (is(sensor, Kind::Motion) || is(sensor, Kind::Contact));
        let has_front_door = (0..ids.len()).any(|sensor| leads_out(sensor) && is(sensor, Kind::Contact));
        let is_bare_door = |sensor: usize| !has_front_door && leads[sensor] == Leads::Bare && is(sensor, Kind::Contact);
        let is_way = |sensor: usize| match leads[sensor] {
            Leads::Inside => false,
            _ => is(sensor, Kind::Contact) || is(sensor, Kind::Motion) && speaks(&sensors.called[sensor], &WAYS),
        };
        with(EntranceSource::Known, &|sensor| leads_out(sensor) || is_bare_door(sensor))
            .or_else(|| with(EntranceSource::Guessed, &is_way))
            .unwrap_or_default()
    }
}

/// Beginnings of words for a way through the home (our choice).
const WAYS: [&str; 2] = ["door", "hall"];

fn speaks(name: &str, of: &[&str]) -> bool {
    words(name).iter().any(|word| of.iter().any(|begin| word.starts_with(begin)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(sensors: &[(&str, Kind)], asked: &[&str]) -> (Vec<String>, EntranceSource) {
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
        assert_eq!(found(&home, &[]), (names(&["MainEntryway"]), EntranceSource::Known));
        assert_eq!(found(&home[1..], &[]), (names(&["HallwayA"]), EntranceSource::Guessed));
        assert_eq!(found(&home[1..2], &[]), (names(&[]), EntranceSource::None));
        assert_eq!(found(&home, &["BedroomADoor"]), (names(&["BedroomADoor"]), EntranceSource::Asked));
        let contacts = [("D002", Contact), ("kitchen drawer", Contact), ("M001", Motion)];
        assert_eq!(found(&contacts, &[]), (names(&["D002"]), EntranceSource::Known));
    }

    #[test]
    fn entrances_are_found_in_other_languages() {
        use Kind::{Contact, Motion};
        let names = |names: &[&str]| names.iter().map(|name| String::from(*name)).collect::<Vec<_>>();
        let home =
            [("haustuer", Contact), ("Kühlschrank", Contact), ("Schlafzimmer Fenster", Contact), ("Flur", Motion)];
        assert_eq!(found(&home, &[]), (names(&["haustuer"]), EntranceSource::Known));
        let home = [("Eingang", Motion), ("Küche Tür", Motion)];
        assert_eq!(found(&home, &[]), (names(&["Eingang"]), EntranceSource::Known));
    }

    #[test]
    fn doors_inside_lead_nowhere_and_a_front_door_is_better_than_one_of_no_name() {
        use Kind::{Contact, Motion};
        let names = |names: &[&str]| names.iter().map(|name| String::from(*name)).collect::<Vec<_>>();
        for inside in ["Kühlschranktür", "Badtür", "Garderobe", "car door", "cat flap door", "Briefkasten", "kastdeur"]
        {
            assert_eq!(
                found(&[("Wohnzimmer", Motion), (inside, Contact)], &[]),
                (names(&[]), EntranceSource::None),
                "{inside}"
            );
        }
        let doors = [("Haustür", Contact), ("D002", Contact), ("Anna door", Contact)];
        assert_eq!(found(&doors, &[]), (names(&["Haustür"]), EntranceSource::Known));
        assert_eq!(found(&doors[1..], &[]), (names(&["D002"]), EntranceSource::Known));
        assert_eq!(found(&doors[2..], &[]), (names(&["Anna door"]), EntranceSource::Guessed));
        // A motion sensor at the entrance does not stand for a door.
        let home = [("Entry", Motion), ("D002", Contact)];
        assert_eq!(found(&home, &[]), (names(&["Entry", "D002"]), EntranceSource::Known));
    }
}
