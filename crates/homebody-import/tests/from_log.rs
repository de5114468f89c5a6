//! A home that is made from a log is valid, whatever the names and the order of its sensors.

use homebody_core::home::form::HomeFile;
use homebody_import::from_log::{LogSensor, LogWay, SchematicError, Speaks, schematic};
use std::collections::BTreeSet;

/// Numbers that are always the same.
struct Dice(u64);

impl Dice {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % most
    }
}

const ROOMS: &str =
    "Kitchen,BathroomA,BathroomB,BedroomA,bedroom 2,living room,hallway,MainEntryway,Office,dining room,laundry";
const PLACES: &str = ",Area,Sink,Toilet,Bed,Chair,Door,Stove,Fridge,Couch,front door,Cabinet";

fn some(dice: &mut Dice) -> (Vec<LogSensor>, Vec<LogWay>) {
    let [rooms, places] = [ROOMS, PLACES].map(|names| names.split(',').collect::<Vec<_>>());
    let mut ids = BTreeSet::new();
    for _ in 0..1 + dice.below(28) {
        ids.insert(format!("{} {}", rooms[dice.below(rooms.len())], places[dice.below(places.len())]));
    }
    let sensors: Vec<LogSensor> = ids
        .iter()
        .map(|id| {
            let speaks = if dice.below(6) == 0 { Speaks::Contact } else { Speaks::Motion };
            LogSensor::new(id, speaks, 1 + dice.below(2000) as u64)
        })
        .collect();
    let ways = (0..dice.below(3 * sensors.len() + 1)).filter_map(|_| {
        let (a, b) = (dice.below(sensors.len()), dice.below(sensors.len()));
        let (times, soon_s) = (1 + dice.below(300) as u64, dice.below(120) as f64 / 10.0);
        (a < b).then_some(LogWay { between: [a, b], times, soon_s })
    });
    let ways = ways.collect();
    (sensors, ways)
}

#[test]
fn makes_a_valid_home_of_any_log() {
    let mut dice = Dice(1);
    for case in 0..150 {
        let (sensors, ways) = some(&mut dice);
        let home =
            schematic("home", "", &sensors, &ways).unwrap_or_else(|error| panic!("case {case}: {error}\n{sensors:?}"));
        let file: HomeFile = serde_json::from_str(&home.home_json).unwrap();
        let left: Vec<&String> = home.remarks.iter().filter(|remark| remark.starts_with("left out")).collect();
        assert!(left.is_empty(), "case {case}: {left:?}\n{}", home.home_json);
        assert!(file.doors.iter().any(|door| door.outside), "case {case}: no way out");
        // Every sensor is placed with its own id, or reported as without a place.
        let unplaced = home.remarks.iter().any(|remark| remark.starts_with("for these sensors there is no place"));
        let ids: BTreeSet<&String> = home.ids.values().collect();
        assert_eq!((ids.len(), home.ids.len()), (file.sensors.len(), file.sensors.len()), "case {case}");
        assert!(ids.len() == sensors.len() || unplaced, "case {case}: {:?}", home.remarks);
        assert!(
            ["bed", "toilet", "stove", "fridge"]
                .iter()
                .all(|thing| file.furniture.iter().any(|piece| piece.name.starts_with(thing))),
            "case {case}: {:?}",
            home.remarks
        );
    }
}

#[test]
fn a_home_has_no_more_rooms_than_are_arranged() {
    let sensors: Vec<LogSensor> = (0..60).map(|n| LogSensor::new(&format!("bedroom {n}"), Speaks::Motion, 9)).collect();
    assert!(matches!(schematic("home", "", &sensors, &[]), Err(SchematicError::TooManyRooms(60))));
    assert_eq!(schematic("home", "", &[], &[]), Err(SchematicError::NoSensors));
    let began = std::time::Instant::now();
    schematic("home", "", &sensors[..30], &[]).unwrap();
    println!("30 rooms: {:?}", began.elapsed());
}
