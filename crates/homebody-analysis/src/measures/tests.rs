//! Measures and alerts of logs that are short, have gaps, or are of days that are unlike others.

use super::*;
use crate::alerts::{EXAMPLE, LogAlerts, Rules, SENSOR, alerts};
use homebody_core::time::{DAY, MINUTE, SECOND, Span};
use homebody_log::{Event, Log};
use std::collections::BTreeMap;

const SENSORS: [&str; 5] =
    ["bedroom motion", "bathroom motion", "kitchen motion", "living room motion", "entrance motion"];
const BEDROOM: u32 = 0;
const BATHROOM: u32 = 1;
const KITCHEN: u32 = 2;
const LIVING: u32 = 3;
const ENTRANCE: u32 = 4;

/// The messages of an ordinary day: from one minute to another, so many minutes apart, by which sensor.
const ORDINARY: [(i64, i64, i64, u32); 11] = [
    (0, 1, 1, BEDROOM),
    (200, 206, 2, BATHROOM),
    (207, 209, 1, BEDROOM),
    (420, 424, 1, BEDROOM),
    (425, 435, 1, BATHROOM),
    (436, 470, 1, KITCHEN),
    (471, 720, 5, LIVING),
    (721, 755, 1, KITCHEN),
    (756, 1080, 5, LIVING),
    (1081, 1120, 1, KITCHEN),
    (1121, 1375, 5, LIVING),
];

fn at(day: i64, minute: i64) -> WallTime {
    WallTime::EPOCH + (day * 1440 + minute) * MINUTE
}

fn log_of(days: i64, otherwise: &dyn Fn(i64, i64, u32) -> bool) -> Log {
    let mut log = Log { sensors: SENSORS.map(String::from).into(), values: vec!["ON".into()], ..Log::default() };
    for day in 0..days {
        let to_bed = [(1376, 1380, 1, BEDROOM)];
        for (from, to, step, sensor) in ORDINARY.into_iter().chain(to_bed) {
            let mut minute = from;
            while minute < to {
                // Not to the second, as no day is like another.
                let at = at(day, minute) + (day * 7 + minute * 13) % 50 * SECOND;
                if otherwise(day, minute, sensor) {
                    log.events.push(Event { at, sensor, value: 0 });
                }
                minute += step;
            }
        }
    }
    log
}

fn measured(log: &Log) -> (Measures, LogAlerts) {
    let measures = Measures::from_log(
        "log",
        log,
        &HomeKnowledge { rooms: &BTreeMap::new(), ways: None },
        &DensityOptions::default(),
    )
    .unwrap();
    let told = alerts(&measures, &Rules::read(EXAMPLE).unwrap());
    (measures, told)
}

fn values(measures: &Measures, name: &str) -> Vec<Option<f64>> {
    measures.days.iter().map(|day| day.value(name)).collect()
}

#[test]
fn ordinary_days_are_measured_and_nothing_is_alarming() {
    let (measures, told) = measured(&log_of(40, &|_, _, _| true));
    let bed = values(&measures, "time_in_bed")[20].unwrap();
    assert!((7.0..8.2).contains(&bed), "{bed}");
    assert_eq!(values(&measures, "bathroom_night")[20], Some(1.0));
    assert_eq!(values(&measures, "meals")[20], Some(3.0));
    assert!(told.alerts.is_empty(), "{told}");
}

/// The same log by sensors that stay on for so many seconds after a movement.
fn held(log: &Log, hold: Span) -> Log {
    let values = vec!["ON".to_owned(), "OFF".to_owned()];
    let mut held = Log { sensors: log.sensors.clone(), values, ..Log::default() };
    for sensor in 0..log.sensors.len() as u32 {
        let of_sensor = log.events.iter().filter(|event| event.sensor == sensor);
        let at: Vec<WallTime> = of_sensor.map(|event| event.at).collect();
        for on in at.chunk_by(|&a, &b| b - a <= hold) {
            held.events.push(Event { at: on[0], sensor, value: 0 });
            held.events.push(Event { at: on[on.len() - 1] + hold, sensor, value: 1 });
        }
    }
    held.events.sort_by_key(|event| event.at);
    held
}

#[test]
fn sensors_that_stay_on_hide_no_stays() {
    let log = log_of(20, &|_, _, _| true);
    let (plain, _) = measured(&log);
    // A movement a minute: with a hold time of 90 s only the first of each stay is reported.
    let reported = held(&log, 90 * SECOND);
    assert!(3 * reported.events.len() < 4 * log.events.len());
    let (held, _) = measured(&reported);
    for name in ["bathroom_night", "bathroom_day", "meals", "time_out", "outings"] {
        assert_eq!(values(&held, name)[5..19], values(&plain, name)[5..19], "{name}");
    }
    for name in ["time_in_bed", "sleep", "sedentary"] {
        for day in 5..19 {
            let [a, b] = [&held, &plain].map(|measures| values(measures, name)[day].unwrap());
            assert!((a - b).abs() < 0.1, "{name}: {a}, {b}");
        }
    }
    // Hidden measures are not known, and doubtful ones are guesses.
    for name in ["showers", "restlessness"] {
        assert!(values(&held, name).iter().all(Option::is_none), "{name}");
        assert!(values(&plain, name).iter().any(Option::is_some), "{name}");
        assert!(
            held.remarks.iter().any(|remark| remark.to_lowercase().starts_with(name) && remark.contains("unknown: ")),
            "{name}"
        );
    }
    assert!(held.guesses.contains(&"bathroom_day") && !plain.guesses.contains(&"bathroom_day"));
}

/// The log with more signs on each day, by their minutes and sensors.
fn with_more(log: &Log, days: i64, more: &[(i64, u32)]) -> Log {
    let mut log = log.clone();
    for day in 0..days {
        log.events.extend(more.iter().map(|&(minute, sensor)| Event { at: at(day, minute), sensor, value: 0 }));
    }
    log.events.sort_by_key(|event| event.at);
    log
}

#[test]
fn a_restless_part_of_the_night_is_still_in_bed() {
    let log = log_of(12, &|_, _, _| true);
    // No silence lasts for 20 minutes from going to bed until the way to the bathroom.
    let restless: Vec<(i64, u32)> = (0..20).map(|turn| (10 * turn, BEDROOM)).collect();
    let until_midnight = (139..144).map(|turn| (10 * turn, BEDROOM));
    let restless = with_more(&log, 12, &restless.into_iter().chain(until_midnight).collect::<Vec<_>>());
    let [plain, restless] = [&log, &restless].map(|log| measured(log).0);
    for name in ["time_in_bed", "bedtime", "rising", "bathroom_night", "bathroom_day"] {
        assert_eq!(values(&restless, name)[2..11], values(&plain, name)[2..11], "{name}");
    }
}

#[test]
fn stray_signs_of_other_rooms_end_no_night() {
    let log = with_more(&log_of(12, &|_, _, _| true), 12, &[(199, BEDROOM)]);
    let strays = with_more(&log, 12, &[(60, KITCHEN), (100, LIVING), (300, LIVING)]);
    let [plain, strays] = [&log, &strays].map(|log| measured(log).0);
    for name in ["time_in_bed", "bedtime", "rising", "bathroom_night", "bathroom_day", "room_changes"] {
        assert_eq!(values(&strays, name)[2..11], values(&plain, name)[2..11], "{name}");
    }
}

#[test]
fn an_evening_in_the_bedroom_with_a_way_to_the_kitchen_is_no_night() {
    let log = log_of(12, &|_, minute, _| !(1200..1375).contains(&minute));
    // The resident rests there from eight, cooks at nine, and goes to bed at eleven.
    let rests = (120..126).chain(128..137).map(|turn| (10 * turn, BEDROOM));
    let cooks = (1266..1274).map(|minute| (minute, KITCHEN));
    let evening = with_more(&log, 12, &rests.chain(cooks).collect::<Vec<_>>());
    let bedtimes = values(&measured(&evening).0, "bedtime");
    assert!(bedtimes[2..11].iter().flatten().all(|bedtime| *bedtime > 21.2), "{bedtimes:?}");
}

#[test]
fn measures_without_a_sensor_are_unknown() {
    let all = log_of(5, &|_, _, _| true);
    let of_rooms = |rooms: &[u32]| Log {
        events: all.events.iter().filter(|event| rooms.contains(&event.sensor)).copied().collect(),
        ..all.clone()
    };
    let (one, two, three) =
        (of_rooms(&[LIVING]), of_rooms(&[LIVING, BATHROOM]), of_rooms(&[LIVING, BATHROOM, KITCHEN]));
    let known = |log: &Log, name: &str| values(&measured(log).0, name).iter().any(Option::is_some);
    assert_eq!([&one, &two, &three].map(|log| known(log, "pacing")), [false, true, true]);
    assert_eq!([&one, &two, &three].map(|log| known(log, "lapping")), [false, false, true]);
    // A window in the kitchen tells of no meal, and a fridge does.
    for (name, is_known) in [("kitchen window", false), ("kitchen fridge", true)] {
        let mut log = Log { values: vec!["ON".into(), "OPEN".into(), "CLOSE".into()], ..two.clone() };
        log.sensors[KITCHEN as usize] = name.into();
        for minute in [500, 700, 1900, 2100, 3400] {
            for (minute, value) in [(minute, 1), (minute + 3, 2)] {
                log.events.push(Event { at: at(0, minute), sensor: KITCHEN, value });
            }
        }
        log.events.sort_by_key(|event| event.at);
        assert_eq!(known(&log, "meals"), is_known, "{name}");
    }
}

#[test]
fn three_days_have_no_usual_and_nothing_is_invented() {
    let (measures, told) = measured(&log_of(3, &|_, _, _| true));
    assert!(told.alerts.is_empty(), "{told}");
    assert!(told.remarks.iter().any(|remark| remark.contains("needed to know what is usual")), "{told}");
    for name in ["density_distance", "interdaily_stability", "company", "visits"] {
        assert!(values(&measures, name).iter().all(Option::is_none), "{name} of three days");
    }
    assert!(!measures.guesses.contains(&"visits"));
}

#[test]
fn weeks_without_a_log_are_unknown() {
    let (measures, told) = measured(&log_of(60, &|day, _, _| !(20..40).contains(&day)));
    for name in ["meals", "bathroom_day", "room_changes", "sedentary", "density_morning"] {
        let known = values(&measures, name);
        assert!(known[21..39].iter().all(Option::is_none), "{name}: {known:?}");
        assert!(known[50].is_some(), "{name}: {known:?}");
    }
    let invented: Vec<&str> =
        told.alerts.iter().filter(|alert| alert.rule != SENSOR).map(|alert| alert.words.as_str()).collect();
    assert!(invented.is_empty(), "{invented:?}");
}

#[test]
fn dead_sensor_gives_an_alert_instead_of_zeros() {
    let (measures, told) = measured(&log_of(40, &|day, _, sensor| day < 25 || sensor != KITCHEN));
    assert_eq!(measures.silent.iter().map(|silent| silent.sensor.as_str()).collect::<Vec<_>>(), ["kitchen motion"]);
    assert!(values(&measures, "meals")[27..].iter().all(Option::is_none));
    let rules: Vec<&str> = told.alerts.iter().map(|alert| alert.rule.as_str()).collect();
    assert_eq!(rules, [SENSOR], "{told}");
    // A person who does stop eating, while the sensor still sees them pass, has a value.
    let (_, told) = measured(&log_of(40, &|day, minute, sensor| {
        day < 25 || sensor != KITCHEN || minute % 180 == 0 || minute == 440
    }));
    assert!(told.alerts.iter().any(|alert| alert.measures.contains(&"meals")), "{told}");
}

#[test]
fn night_away_has_no_sleep_measure() {
    let away = |day: i64, minute: i64, _: u32| !(day == 30 && minute > 1110 || day == 31 && minute < 600);
    let mut log = log_of(40, &away);
    // Out by the door in the evening, and home in the morning.
    for at in [at(30, 1110), at(31, 600)] {
        let sign = |sign: i64| Event { at: at + sign * 20 * SECOND, sensor: ENTRANCE, value: 0 };
        log.events.extend((0..4).map(sign));
    }
    let (measures, told) = measured(&log);
    assert_eq!(values(&measures, "time_in_bed")[31], None);
    assert_eq!(values(&measures, "sleep")[31], None);
    assert!(values(&measures, "time_out")[30].is_some_and(|hours| hours > 5.0), "{:?}", values(&measures, "time_out"));
    let of_nights = ["sleep", "time_in_bed", "restlessness", "bathroom_night", "rising"];
    let of_night = |name: &&'static str| of_nights.contains(name);
    assert!(!told.alerts.iter().any(|alert| alert.measures.iter().any(of_night)), "{told}");
}

#[test]
fn moved_furniture_gives_alerts_until_it_is_usual() {
    // The armchair stands where the sensor of the living room no longer sees it: it tells a third of what it did.
    let moved = |day: i64, minute: i64, sensor: u32| day < 40 || sensor != LIVING || (minute / 5) % 3 == 0;
    let (measures, _) = measured(&log_of(100, &moved));
    let day = |number: usize| measures.days[number].date;
    for method in ["deviation", "ewma", "cusum"] {
        let rule = format!(
            r#"{{ "rules": [{{ "name": "quiet", "measure": "density_morning", "when": "less", "method": "{method}", "least_sd": 0.5 }}] }}"#
        );
        let told = alerts(&measures, &Rules::read(&rule).unwrap());
        let dates: Vec<_> = told.alerts.iter().map(|alert| alert.date).collect();
        assert!(dates.first().is_some_and(|first| (day(40)..=day(43)).contains(first)), "{method}: {told}");
        assert!(dates.last().is_some_and(|last| *last < day(60)), "{method}: {told}");
    }
}

#[test]
fn night_of_a_clock_change_is_whole_and_without_alerts() {
    // In spring clocks leave out 02:00 to 03:00, and in autumn they show it twice.
    for hour in [|minute: i64| !(120..180).contains(&minute), |_: i64| true] {
        let mut log = log_of(40, &|day, minute, _| day != 30 || hour(minute));
        if hour(150) {
            log.events.push(Event { at: at(30, 150), sensor: BEDROOM, value: 0 });
            log.events.push(Event { at: at(30, 150), sensor: BEDROOM, value: 0 });
        }
        let (measures, told) = measured(&log);
        assert!(measures.days[30].is_whole && values(&measures, "time_in_bed")[30].is_some());
        assert!(told.alerts.is_empty(), "{told}");
    }
}

/// The messages of a home of contacts on a day: the minute, the sensor, and the minutes that it is on.
const OF_CONTACTS: [(i64, &str, i64); 14] = [
    (0, "bed pressure", 420),
    (422, "Hall-Toilet door", 1),
    (424, "ToiletFlush", 1),
    (430, "Fridge", 1),
    (432, "Groceries cupboard", 1),
    (436, "Microwave", 3),
    (448, "Fridge", 1),
    (480, "Frontdoor", 1),
    (720, "Frontdoor", 1),
    (722, "Fridge", 1),
    (760, "Hall-Toilet door", 1),
    (763, "ToiletFlush", 1),
    (800, "Plates cupboard", 1),
    (1380, "bed pressure", 60),
];

fn of_contacts(days: i64) -> Log {
    let mut log = Log { values: vec!["ON".into(), "OFF".into()], ..Log::default() };
    for (day, &(minute, name, lasts)) in (0..days).flat_map(|day| OF_CONTACTS.iter().map(move |row| (day, row))) {
        let sensor = log.sensors.iter().position(|known| known == name).unwrap_or_else(|| {
            log.sensors.push(name.to_owned());
            log.sensors.len() - 1
        });
        let at = at(day, minute);
        // A door and a fridge are open for seconds.
        let end = if lasts == 1 { at + 8 * SECOND } else { at + lasts * MINUTE };
        log.events.extend([(at, 0), (end, 1)].map(|(at, value)| Event { at, sensor: sensor as u32, value }));
    }
    log
}

#[test]
fn a_home_of_contacts_is_measured_as_far_as_they_tell() {
    let (measures, _) = measured(&of_contacts(9));
    let on_day_5 = |name: &str| values(&measures, name)[5];
    for (name, value) in
        [("time_in_bed", 8.0), ("bathroom_night", 0.0), ("bathroom_day", 2.0), ("time_out", 4.0), ("outings", 1.0)]
    {
        assert!(on_day_5(name).is_some_and(|is| (is - value).abs() < 0.1), "{name}: {:?}", on_day_5(name));
    }
    for name in ["sleep", "restlessness", "showers", "room_changes", "sedentary", "pacing", "density_morning"] {
        assert_eq!(on_day_5(name), None, "{name}");
    }
    assert!(!measures.guesses.contains(&"time_in_bed"));
    // If the bed has no sensor, and no motion sensor sees the bedroom, a night is a guess.
    let mut without_bed = of_contacts(9);
    let bed = without_bed.sensors.iter().position(|name| name == "bed pressure").unwrap();
    without_bed.sensors[bed] = "bedroom drawer".into();
    let guessed = measured(&without_bed).0;
    for name in ["time_in_bed", "bedtime", "rising", "bathroom_night"] {
        assert!(guessed.guesses.contains(&name), "{name}: {:?}", guessed.remarks);
    }
    // Without an open door there is not an outing: a person who sits for four hours has not left.
    let mut indoors = of_contacts(9);
    let door = indoors.sensors.iter().position(|name| name == "Frontdoor").unwrap();
    indoors.events.retain(|event| event.sensor as usize != door);
    assert_eq!(values(&measured(&indoors).0, "outings")[5], None);
}

/// A log of five days with half a minute each: the bed is taken all the time, and a lamp is on and off.
fn of_half_minutes(has_gaps: bool) -> Log {
    let sensors = ["bed pressure", "kitchen lamp", "bathroom motion"].map(String::from).into();
    let mut log = Log { sensors, values: vec!["ON".into(), "OFF".into()], ..Log::default() };
    let first = [(470, 0), (475, 1)];
    log.events.extend(first.map(|(minute, value)| Event { at: at(0, minute), sensor: 0, value }));
    for day in 0..5 {
        let at = at(day, 480);
        let rows = [(0, 0, 0), (0, 1, 0), (10, 1, 1), (20, 2, 0), (30, 2, 1)];
        log.events.extend(rows.map(|(second, sensor, value)| Event { at: at + second * SECOND, sensor, value }));
        if has_gaps && day < 4 {
            log.gaps.push(Interval::new(at + 31 * SECOND, at + DAY));
        }
    }
    let last = [(481, 0), (600, 1)];
    log.events.extend(last.map(|(minute, sensor)| Event { at: at(4, minute), sensor, value: 1 }));
    log
}

#[test]
fn nothing_is_known_in_gaps_of_a_recording() {
    let (measures, told) = measured(&of_half_minutes(true));
    let known: Vec<_> = measures.days.iter().flat_map(|day| day.values.iter().flatten()).collect();
    assert!(known.is_empty(), "{known:?}");
    assert!(measures.days.iter().all(|day| !day.is_whole) && told.alerts.is_empty(), "{told}");
}

#[test]
fn a_bed_that_stays_taken_gives_no_impossible_hours() {
    let (measures, _) = measured(&of_half_minutes(false));
    let in_bed: Vec<f64> = values(&measures, "time_in_bed").into_iter().flatten().collect();
    assert!(!in_bed.is_empty() && in_bed.iter().all(|hours| (0.0..=24.0).contains(hours)), "{in_bed:?}");
    for measure in MEASURES.iter().filter(|measure| measure.is_clock()) {
        let clocks: Vec<f64> = values(&measures, measure.name).into_iter().flatten().collect();
        assert!(clocks.iter().all(|hours| (0.0..=36.0).contains(hours)), "{}: {clocks:?}", measure.name);
    }
}

#[test]
fn a_gap_by_night_ends_the_time_in_bed() {
    // From two in the morning to five nothing is recorded on day 20; for five minutes on day 25.
    let silent = |day: i64, minute: i64, _: u32| !(day == 20 && (120..300).contains(&minute));
    let mut log = log_of(30, &silent);
    log.gaps = [(20, 120, 300), (25, 120, 125)].map(|(day, from, to)| Interval::new(at(day, from), at(day, to))).into();
    let (measures, _) = measured(&log);
    let in_bed = values(&measures, "time_in_bed");
    assert_eq!((in_bed[20], values(&measures, "sleep")[20], values(&measures, "meals")[20]), (None, None, None));
    assert!(in_bed[19].is_some() && in_bed[21].is_some(), "{in_bed:?}");
    assert!(in_bed[25].is_some_and(|hours| (hours - in_bed[24].unwrap()).abs() < 0.2), "{in_bed:?}");
}
