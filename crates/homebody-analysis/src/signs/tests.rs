use super::*;
use crate::sample::{at, log, parsed, span};
use homebody_core::time::{HOUR, SECOND, WallTime};
use homebody_log::{Log, SaidBy, SensorInfo, ValuePair};

#[test]
fn sensors_are_taken_for_what_most_of_their_rows_look_like() {
    let log = log(&parsed(
        "0 M1 ON, 1 M1 OFF, 2 M1 ON0, 3 D1 OPEN, 4 T1 21.5, 5 T1 1, 6 T1 0, 7 L002 ON, 8 mattress true, \
         9 hall FIRE",
    ));
    let wanted = [Kind::Motion, Kind::Contact, Kind::Reading, Kind::Used, Kind::Used, Kind::Motion];
    assert_eq!(kinds(&log), wanted);
}

#[test]
fn a_bed_that_is_on_for_seconds_is_where_a_motion_sensor_looks() {
    let rows: Vec<(i64, &str, &str)> = (0..10)
        .flat_map(|time| {
            let (from, to) = (1000 * time, 1000 * time + 4);
            [(from, "BedroomBed", "ON"), (to, "BedroomBed", "OFF"), (from, "bed", "ON"), (to + 900, "bed", "OFF")]
        })
        .chain((0..5).map(|time| (1000 * time, "kitchen", "ON")))
        .collect();
    assert_eq!(kinds(&log(&rows)), [Kind::Motion, Kind::Used, Kind::Motion]);
    // An instant tells nothing of how long it lasts.
    assert_eq!(kinds(&log(&[(0, "chair", "ON"), (1, "kitchen", "ON")])), [Kind::Used, Kind::Motion]);
}

#[test]
fn of_a_home_of_contacts_that_say_on_nothing_sees_movement() {
    let names = [
        ("Hall-Bedroom door", 600, Kind::Contact),
        ("Maindoor Magnetic Entrance", 9, Kind::Contact),
        ("Cups cupboard", 9, Kind::Used),
        ("ToiletFlush", 3, Kind::Used),
        ("Fridge", 40, Kind::Used),
        // A motion sensor that looks at a door or a fridge is ON for seconds.
        ("BedroomADoor", 4, Kind::Motion),
        ("KitchenARefrigerator", 4, Kind::Motion),
        ("Basin PIR Bathroom", 600, Kind::Motion),
    ];
    let rows: Vec<(i64, &str, &str)> = (0..10)
        .flat_map(|time| {
            names.map(|(name, length, _)| [(1000 * time, name, "ON"), (1000 * time + length, name, "OFF")])
        })
        .flatten()
        .collect();
    assert_eq!(kinds(&log(&rows)), names.map(|(_, _, kind)| kind));
    // Without an end its length is not known: its values decide.
    assert_eq!(kinds(&log(&[(0, "front door", "FIRE")])), [Kind::Motion]);
    // No sensor looks if nothing else is ON for seconds.
    let rows: Vec<(i64, &str, &str)> = (0..10)
        .flat_map(|time| {
            ["Frontdoor", "Fridge"].map(|name| [(1000 * time, name, "ON"), (1000 * time + 4, name, "OFF")])
        })
        .flatten()
        .collect();
    assert_eq!(kinds(&log(&rows)), [Kind::Contact, Kind::Used]);
}

#[test]
fn first_values_of_simulated_sensors_are_beginnings() {
    for kind in homebody_core::sensors::kinds::KINDS {
        let Some(first) = kind.values.first() else { continue };
        let says = says(&first.to_string());
        assert!(matches!(says, Says::Begins | Says::Opens), "a {} sensor says {first}: {says:?}", kind.key);
    }
}

#[test]
fn on_lasts_until_off() {
    let log = log(&parsed("5 M1 ON, 0 M1 ON, 9 M1 OFF, 9 M1 OFF, 20 M1 ON, 3 hall FIRE, 6 hall FIRE"));
    assert_eq!(spans(&log), [vec![span(0, 9), span(20, 20)], vec![span(3, 3), span(6, 6)]]);
}

fn of_kind(id: &str, kind: &str) -> SensorInfo {
    SensorInfo::of_kind(id, kind, &[])
}

/// Rows of sensors that are each on for so many seconds, ten times.
fn rows<'a>(sensors: &[(&'a str, i64)]) -> Vec<(i64, &'a str, &'a str)> {
    let on_and_off = |time: i64| {
        move |&(name, length): &(&'a str, i64)| [(1000 * time, name, "on"), (1000 * time + length, name, "off")]
    };
    (0..10).flat_map(|time| sensors.iter().flat_map(on_and_off(time)).collect::<Vec<_>>()).collect()
}

#[test]
fn kind_of_source_decides_and_table_overrides_it() {
    let mut log = log(&rows(&[("A", 3), ("B", 3), ("C", 4000), ("D", 3), ("E", 3), ("F", 3)]));
    log.known = vec![
        of_kind("A", "motion"),
        of_kind("B", "door"),
        of_kind("C", "Control4-Motion"),
        of_kind("D", "connectivity"),
        SensorInfo { said_by: SaidBy::Table, ..of_kind("E", "contact") },
        SensorInfo { said_by: SaidBy::Home, ..of_kind("F", "bed") },
    ];
    let wanted = [Kind::Motion, Kind::Contact, Kind::Motion, Kind::Other, Kind::Contact, Kind::Used];
    let by = [Evidence::Source, Evidence::Source, Evidence::Source, Evidence::Source, Evidence::Table, Evidence::Home];
    let taken = taken(&log);
    assert_eq!(taken.iter().map(|one| one.kind).collect::<Vec<_>>(), wanted);
    assert_eq!(taken.iter().map(|one| one.by).collect::<Vec<_>>(), by);
    assert_eq!(taken[1].because, "\"door\" in its source");
    // Without a word of theirs all are guesses.
    log.known.clear();
    assert!(super::taken(&log).iter().all(|one| one.by == Evidence::Guess));
}

#[test]
fn numbers_are_readings_whatever_they_are_readings_of_but_for_a_table() {
    let mut log = log(&[(0, "A", "21.5"), (1, "A", "22"), (2, "B", "300"), (3, "C", "1"), (4, "C", "0")]);
    log.known = vec![of_kind("A", "motion"), of_kind("B", "power"), of_kind("C", "motion")];
    assert_eq!(kinds(&log), [Kind::Reading, Kind::Reading, Kind::Motion]);
    log.known[0].said_by = SaidBy::Table;
    assert_eq!(kinds(&log)[0], Kind::Motion);
}

#[test]
fn occupancy_of_a_bed_is_use_and_of_a_room_is_motion() {
    let mut log = log(&rows(&[("binary_sensor.bett", 25_000), ("binary_sensor.flur", 60)]));
    log.known = vec![of_kind("binary_sensor.bett", "occupancy"), of_kind("binary_sensor.flur", "occupancy")];
    assert_eq!(kinds(&log), [Kind::Used, Kind::Motion]);
}

#[test]
fn domains_of_programs_tell_of_no_person() {
    let names = [
        ("automation.hall_light", Kind::Other),
        ("update.core", Kind::Other),
        ("sun.sun", Kind::Other),
        ("input_boolean.guests", Kind::Other),
        ("person.ada", Kind::Other),
        ("cover.blind", Kind::Other),
        ("light.hall", Kind::Used),
        ("binary_sensor.hall_motion", Kind::Motion),
    ];
    let log = log(&rows(&names.map(|(name, _)| (name, 30))));
    assert_eq!(kinds(&log), names.map(|(_, kind)| kind));
}

#[test]
fn a_contact_that_is_open_for_seconds_is_a_contact() {
    for (name, others, wanted) in [
        ("binary_sensor.front_door_contact", "binary_sensor.hall_motion", Kind::Contact),
        ("Haustür Kontakt", "Flur", Kind::Contact),
        // The other has a word for motion in its name: so this one would, too.
        ("binary_sensor.front_door", "binary_sensor.hall_motion", Kind::Contact),
        ("haustuer", "Bewegungsmelder Flur", Kind::Contact),
        ("Fridge", "Kitchen PIR", Kind::Used),
        ("front door", "hall", Kind::Contact),
        // These look at a door.
        ("front door motion", "hall motion", Kind::Motion),
        ("BedroomADoor", "HallwayA", Kind::Motion),
    ] {
        assert_eq!(kinds(&log(&rows(&[(name, 8), (others, 60)])))[0], wanted, "{name}");
    }
    // Nobody goes through a door and closes it in so short.
    assert_eq!(kinds(&log(&rows(&[("front door", 2), ("hall", 2)])))[0], Kind::Motion);
}

#[test]
fn motion_sensors_by_their_names_stay_so_however_often_they_speak() {
    let mut sensors = vec![("Shower PIR Bathroom", 400), ("Basin PIR Bathroom", 61), ("Maindoor Magnetic Entrance", 9)];
    sensors.extend([("Door PIR Bedroom", 3); 30]);
    let log = log(&rows(&sensors));
    assert_eq!(kinds(&log), [Kind::Motion, Kind::Motion, Kind::Contact, Kind::Motion]);
    // Without the word, nothing but doors is ON for moments, and no sensor looks.
    let mut sensors = vec![("Shower", 400), ("Basin", 61)];
    sensors.extend([("Door Bedroom", 3); 30]);
    assert_eq!(kinds(&crate::sample::log(&rows(&sensors))), [Kind::Used, Kind::Used, Kind::Contact]);
}

#[test]
fn on_ends_where_state_becomes_unknown() {
    let log = log(&parsed(
        "0 M1 on, 20 M1 unavailable, 3600 M1 off, 7200 M1 on, 7260 M1 off, 7300 bed on, 7400 bed unknown, \
         7500 bed on, 7600 bed off",
    ));
    assert_eq!(spans(&log), [vec![span(0, 20), span(7200, 7260)], vec![span(7300, 7400), span(7500, 7600)]]);
    assert_eq!(UnknownStates::from_log(&log).spans(&log.gaps), [vec![span(20, 3600)], vec![span(7400, 7500)]]);
    let said = said(&log);
    // The bed keeps its state: it does not fire. The OFF of the sensor is new.
    assert_eq!(said.iter().filter(|said| said.is_restored).count(), 1);
    assert!(said[7].is_restored && !said[7].begins() && said[5].begins() && !said[2].is_restored);
    assert_eq!(said[2].unknown_from, Some(at(20)));
}

#[test]
fn spans_end_at_gaps_of_the_recorder() {
    let mut log = log(&parsed("0 bed off, 0 bed on, 30 hall FIRE, 86400 bed on, 86430 bed off"));
    let whole = spans(&log);
    assert_eq!(whole[0], [span(0, 86_430)], "without a word of a gap");
    log.gaps = vec![span(30, 86_400)];
    assert_eq!(spans(&log)[0], [span(0, 30), span(86_400, 86_430)]);
    assert!(said(&log)[3].is_restored);
    // One at the end of the log, too.
    log.gaps.push(span(86_425, 108_000));
    log.events.pop();
    let end = WallTime::EPOCH + 30 * HOUR;
    assert_eq!(spans_until(&log, Some(end))[0].last(), Some(&span(86_400, 86_425)));
}

#[test]
fn nothing_is_known_where_no_sensor_is() {
    let log = log(&parsed("0 M1 on, 1 M2 on, 10 M1 unavailable, 20 M2 unavailable, 30 M1 off, 40 M2 off, 50 T1 21"));
    let of = |asks: &dyn Fn(usize) -> bool| UnknownStates::from_log(&log).of_all(&log.gaps, asks);
    assert_eq!(of(&|sensor| sensor < 2), [span(20, 30)]);
    assert_eq!(of(&|sensor| sensor == 0), [span(10, 30)]);
    assert_eq!(of(&|_| true), [span(20, 30)], "the temperature is not known before its first row");
    // Without a word that a state is not known, all is known.
    let plain = crate::sample::log(&[(0, "T1", "21"), (500, "M1", "on"), (510, "M1", "off")]);
    assert_eq!(UnknownStates::from_log(&plain).of_all(&plain.gaps, &|sensor| sensor == 1), []);
}

/// A log of one sensor that says two words in turn, the first for `on` seconds and the second for `off`.
fn in_turn(sensor: &str, words: [&str; 2], [on, off]: [i64; 2]) -> Log {
    let row = |time: i64| [(time * (on + off), sensor, words[0]), (time * (on + off) + on, sensor, words[1])];
    let mut log = log(&(0..10).flat_map(row).collect::<Vec<_>>());
    let held = [on, off].map(|length| 10 * length * SECOND);
    log.pairs = vec![ValuePair { sensor: 0, values: [0, 1], held, takes_turns: true }];
    log
}

#[test]
fn two_words_of_a_sensor_that_no_table_has_are_a_guess_by_its_name() {
    for (sensor, words, held, kind, on) in [
        ("hall pir", ["zing", "zang"], [20, 500], Kind::Motion, "zing"),
        ("hall pir", ["zang", "zing"], [500, 20], Kind::Motion, "zing"),
        ("hall pir", ["Bewogen", "OFF"], [500, 20], Kind::Motion, "Bewogen"),
        ("hall pir", ["pir", "none"], [20, 20], Kind::Motion, "pir"),
        ("bf01", ["pir", "none"], [20, 20], Kind::Motion, "pir"),
        ("bed", ["liegt", "nichtliegt"], [500, 20], Kind::Used, "liegt"),
    ] {
        let log = in_turn(sensor, words, held);
        let taken = &taken(&log)[0];
        assert_eq!((taken.kind, taken.by), (kind, Evidence::Guess), "{words:?}");
        assert!(taken.because.contains(&format!("{on:?} is taken for ON")), "{}", taken.because);
        let begun = said(&log).iter().filter(|said| said.begins()).count();
        assert_eq!(begun, 10, "{words:?}");
    }
    // A contact opens, and closes.
    let log = in_turn("front door", ["zing", "zang"], [20, 500]);
    assert_eq!((said(&log)[0].says, said(&log)[1].says, kinds(&log)), (Says::Opens, Says::Closes, vec![Kind::Contact]));
}

#[test]
fn words_that_tell_nothing_are_named_and_those_of_other_sensors_are_left() {
    let log = in_turn("hall pir", ["zing", "zang"], [20, 30]);
    let own = OwnWords::from_log(&log);
    assert_eq!((own.is_empty(), own.not_understood().len(), kinds(&log)), (true, 1, vec![Kind::Reading]));
    assert!(own.not_understood()[0].contains("hall pir sends \"zing\" and \"zang\""), "{:?}", own.not_understood());
    let other = in_turn("boiler", ["eco", "comfort"], [20, 500]);
    let own = OwnWords::from_log(&other);
    assert!(own.is_empty() && own.not_understood().is_empty());
}

#[test]
fn the_name_of_a_motion_sensor_decides_over_open_and_closed() {
    let rows: Vec<(i64, &str, &str)> = (0..10)
        .flat_map(|time| {
            ["hall pir", "hall door"]
                .map(|name| [(1000 * time, name, "Zone Open"), (1000 * time + 9, name, "Zone Restored")])
        })
        .flatten()
        .collect();
    assert_eq!(kinds(&log(&rows)), [Kind::Motion, Kind::Contact]);
    // A heater may be idle now and then.
    assert_eq!(kinds(&log(&[(0, "heater", "idle"), (1, "heater", "eco"), (2, "heater", "boost")])), [Kind::Reading]);
}

#[test]
fn a_door_is_a_contact_by_its_name_before_its_few_rows_are_looked_at() {
    let few = parsed("0 binary_sensor.hall_motion on, 9 binary_sensor.hall_motion off, 20 binary_sensor.front_door on");
    assert_eq!(kinds(&log(&few)), [Kind::Motion, Kind::Contact]);
    assert_eq!(kinds(&log(&few[2..])), [Kind::Contact], "its id is that of a system which says when a state ends");
    assert_eq!(kinds(&log(&[(0, "hall pir", "ON"), (9, "Haustür", "ON")])), [Kind::Motion, Kind::Contact]);
    // Both of its states are there, and no time between them.
    assert_eq!(kinds(&log(&[(0, "front door", "OFF"), (0, "front door", "ON")])), [Kind::Contact]);
    // A motion sensor at a door says no more than that something begins.
    assert_eq!(kinds(&log(&[(0, "front door", "FIRE"), (5, "front door", "FIRE")])), [Kind::Motion]);
}

#[test]
fn an_entity_whose_name_tells_of_no_room_and_no_movement_is_of_no_person() {
    let names = [
        ("binary_sensor.workday_sensor", Kind::Other),
        ("binary_sensor.ping_router", Kind::Other),
        ("binary_sensor.office_router", Kind::Other),
        ("sensor.phone_activity", Kind::Other),
        ("binary_sensor.kitchen_2", Kind::Motion),
        ("binary_sensor.aqara_1", Kind::Motion),
        ("binary_sensor.flur", Kind::Motion),
        ("binary_sensor.aqara_motion", Kind::Motion),
        // Other systems have no ids of such a kind.
        ("workday_sensor", Kind::Motion),
    ];
    let mut rows = rows(&names.map(|(name, _)| (name, 30)));
    rows.push((99_999, "sensor.phone_activity", "Walking"));
    rows.push((99_999, "sensor.phone_activity", "Still"));
    let mut log = log(&rows);
    let aqara = of_kind("binary_sensor.aqara_1", "binary_sensor");
    log.known = vec![SensorInfo { room: Some("Bedroom".into()), ..aqara }];
    assert_eq!(kinds(&log), names.map(|(_, kind)| kind));
}

#[test]
fn settings_are_not_readings_whatever_their_names() {
    let log = in_turn("input_select.motion_mode", ["zing", "zang"], [20, 30]);
    assert_eq!((OwnWords::from_log(&log).not_understood().len(), kinds(&log)), (0, vec![Kind::Other]));
}
