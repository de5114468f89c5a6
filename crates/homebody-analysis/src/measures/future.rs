//! No measure sees the future: a day has the same values in a log that ends with it and in a longer one.

use super::*;
use crate::alerts::{EXAMPLE, Rules, SENSOR, alerts};
use crate::sample::TestRandom;
use homebody_core::home::form::HomeFile;
use homebody_core::time::{DAY, MINUTE, SECOND};
use homebody_log::Event;
use jiff::civil::Date;
use std::collections::BTreeMap;

const DAYS: usize = 40;

/// A log that is written row by row, in any order.
struct Writing {
    log: Log,
    numbers: TestRandom,
}

impl Writing {
    fn new(sensors: &[&str], seed: u64) -> Writing {
        let values = ["ON", "OFF", "OPEN", "CLOSE"].map(String::from).into();
        let sensors = sensors.iter().map(|name| (*name).to_owned()).collect();
        Writing { log: Log { sensors, values, ..Log::default() }, numbers: TestRandom(seed) }
    }

    fn say(&mut self, at: WallTime, sensor: usize, value: u32) {
        self.log.events.push(Event { at, sensor: sensor as u32, value });
    }

    fn on(&mut self, at: WallTime, sensor: usize, seconds: i64) {
        self.say(at, sensor, 0);
        self.say(at + seconds * SECOND, sensor, 1);
    }

    /// The resident walks past these sensors, one after the other.
    fn walk(&mut self, mut at: WallTime, sensors: &[usize], pace: i64) -> WallTime {
        for &sensor in sensors {
            self.on(at, sensor, 2);
            at += (3 + pace + self.numbers.below(3)) * SECOND;
        }
        at
    }

    fn stay(&mut self, from: WallTime, sensor: usize, minutes: i64, every_s: i64) {
        let mut at = from;
        while at < from + minutes * MINUTE {
            self.on(at, sensor, 2);
            at += (every_s + self.numbers.below(every_s)) * SECOND;
        }
    }

    fn ended(mut self) -> Log {
        self.log.events.sort_by_key(|event| event.at);
        self.log
    }
}

const MOTION: [&str; 9] = [
    "bedroom motion",
    "hall motion",
    "bathroom motion",
    "kitchen motion",
    "living room motion",
    "front door contact",
    "study motion",
    "hall bedroom end",
    "kitchen hall end",
];

/// Days of a resident who gets slower, has guests, spends a night elsewhere, and wanders. The study is in use from day 20 on.
fn of_motion(seed: u64) -> Log {
    let mut writing = Writing::new(&MOTION, seed);
    for day in 0..DAYS as i64 {
        let at = |writing: &mut Writing, minute: i64| {
            let minute = WallTime::EPOCH + (day * 1440 + minute + writing.numbers.below(20)) * MINUTE;
            minute + writing.numbers.below(60) * SECOND
        };
        let pace = day / 15;
        let out_by_night = day == 17;
        let night = at(&mut writing, 170);
        if day != 18 {
            writing.walk(night, &[0, 7, 1, 2], pace);
            writing.stay(night + MINUTE, 2, 3, 25);
            writing.walk(night + 6 * MINUTE, &[2, 1, 7, 0], pace);
        }
        let up = at(&mut writing, 420 + day);
        writing.walk(up, &[0, 7, 1, 2], pace);
        writing.stay(up + MINUTE, 2, 14, 25);
        for way in 0..6 {
            let from = up + (20 + 25 * way) * MINUTE;
            writing.walk(from, &[2, 1, 8, 3], pace);
            writing.stay(from + MINUTE, 3, 6, 40);
            writing.walk(from + 10 * MINUTE, &[3, 8, 1, 7, 0], pace);
        }
        let cooks = at(&mut writing, 700);
        writing.stay(cooks, 3, 25, 50);
        // Out for an hour and more, by the door.
        let leaves = cooks + 40 * MINUTE;
        writing.walk(leaves, &[4, 1], pace);
        writing.say(leaves + 20 * SECOND, 5, 2);
        writing.say(leaves + 25 * SECOND, 5, 3);
        let comes = leaves + (70 + writing.numbers.below(60)) * MINUTE;
        writing.say(comes, 5, 2);
        writing.say(comes + 5 * SECOND, 5, 3);
        writing.walk(comes + 8 * SECOND, &[1, 4], pace);
        if out_by_night {
            // Away until the next morning.
            let leaves = comes + 120 * MINUTE;
            writing.walk(leaves, &[4, 1, 1], pace);
            writing.say(leaves + 15 * SECOND, 5, 2);
            continue;
        }
        writing.stay(comes + 3 * MINUTE, 4, 150, 200);
        if day >= 20 {
            writing.stay(comes + 160 * MINUTE, 6, 20, 60);
        }
        if day % 4 == 1 {
            // A guest comes and goes, and it is lively.
            let guest = comes + 190 * MINUTE;
            writing.say(guest, 5, 2);
            writing.stay(guest + MINUTE, 4, 58, 8);
            writing.say(guest + 60 * MINUTE, 5, 2);
            writing.stay(guest + 61 * MINUTE, 4, 5, 60);
        }
        if day % 9 == 5 {
            let from = at(&mut writing, 1200);
            (0..5).for_each(|turn| {
                writing.walk(from + turn * 20 * SECOND, &[3, 4], 6);
            });
            (0..4).for_each(|turn| {
                writing.walk(from + (20 * 60 + turn * 30) * SECOND, &[3, 4, 0], 6);
            });
        }
        let to_bed = at(&mut writing, 1330 + day % 50);
        writing.walk(to_bed, &[4, 1, 7, 0], pace);
        writing.stay(to_bed + MINUTE, 0, 8, 40);
    }
    writing.ended()
}

fn of_contacts(seed: u64) -> Log {
    let names = ["bed pressure", "Hall-Toilet door", "ToiletFlush", "Fridge", "Microwave", "Frontdoor", "shower water"];
    let mut writing = Writing::new(&names, seed);
    for day in 0..DAYS as i64 {
        let at = |writing: &mut Writing, minute: i64| {
            WallTime::EPOCH + (day * 1440 + minute + writing.numbers.below(30)) * MINUTE
        };
        let lain = at(&mut writing, 1350);
        writing.on(lain, 0, 3600 * (7 + day % 3));
        for (minute, sensor, seconds) in
            [(500, 1, 8), (503, 2, 4), (510, 6, 400), (530, 3, 9), (545, 4, 120), (780, 3, 9)]
        {
            let from = at(&mut writing, minute);
            writing.on(from, sensor, seconds);
        }
        let leaves = at(&mut writing, 600);
        writing.on(leaves, 5, 9);
        writing.on(leaves + 95 * MINUTE, 5, 9);
    }
    writing.ended()
}

/// A home with the sensors of [`MOTION`] in a row.
fn ways() -> Ways {
    let order = [0, 7, 1, 2, 8, 3, 4, 6];
    let sensors = order.iter().enumerate().map(|(place, &sensor)| {
        let (left, right) = (3.0 * place as f64, 3.0 * place as f64 + 1.0);
        format!(
            r#"{{ "kind": "ceiling_motion", "name": "{}", "area": [[{left}, 0.5], [{right}, 0.5], [{right}, 1.5], [{left}, 1.5]] }}"#,
            MOTION[sensor]
        )
    });
    let sensors: Vec<String> = sensors.collect();
    let home: HomeFile = serde_json::from_str(&format!(
        r#"{{ "name": "row", "rooms": [{{ "name": "hall", "outline": [[-1, 0], [26, 0], [26, 2], [-1, 2]] }}], "walls": [],
             "sensors": [{}] }}"#,
        sensors.join(", ")
    ))
    .unwrap();
    Ways::from_home(&home, &|_, to| Some(vec![to]), &|_| Vec::new())
}

fn of_first(log: &Log, days: usize, ways: Option<&Ways>) -> Measures {
    let recorded = Interval::starting(WallTime::EPOCH, days as i64 * DAY);
    let events = log.events.iter().filter(|event| event.at < recorded.end).copied().collect();
    let part = Log { events, ..log.clone() };
    let asked = DensityOptions { recorded: Some(recorded), ..DensityOptions::default() };
    Measures::from_log("log", &part, &HomeKnowledge { rooms: &BTreeMap::new(), ways }, &asked).unwrap()
}

/// The differences between the days of a shorter log and the same days of a longer one.
fn differences(short: &Measures, long: &Measures) -> Vec<String> {
    let mut differences = Vec::new();
    for (day, later) in short.days.iter().zip(&long.days) {
        for (measure, (value, later)) in MEASURES.iter().zip(day.values.iter().zip(&later.values)) {
            if value != later {
                let (name, date) = (measure.name, day.date);
                differences.push(format!("{name} on {date}: {value:?}, and later {later:?}"));
            }
        }
    }
    differences
}

#[test]
fn a_day_is_the_same_whatever_comes_after_it() {
    let ways = ways();
    let logs = [(of_motion(1), Some(&ways)), (of_motion(2), Some(&ways)), (of_contacts(3), None)];
    let mut known = vec![0; MEASURES.len()];
    for (log, ways) in &logs {
        let all = of_first(log, DAYS, *ways);
        for day in &all.days {
            day.values.iter().zip(&mut known).for_each(|(value, known)| *known += usize::from(value.is_some()));
        }
        // A program that follows the log sees these values at the end of each day.
        for days in 1..DAYS {
            let differences = differences(&of_first(log, days, *ways), &all);
            assert!(differences.is_empty(), "in a log of {days} days: {differences:#?}");
        }
    }
    let never: Vec<&str> =
        MEASURES.iter().zip(&known).filter(|(_, known)| **known == 0).map(|(measure, _)| measure.name).collect();
    assert!(never.is_empty(), "never known in these logs, so nothing is shown of it: {never:?}");
}

#[test]
fn an_alert_comes_on_its_day_whatever_comes_after_it() {
    // The sensor of the kitchen dies on day 25, and the resident goes to bed ever later.
    let mut log = of_motion(4);
    let dies = WallTime::EPOCH + 25 * DAY;
    log.events.retain(|event| event.at < dies || ![3, 8].contains(&event.sensor));
    let rules = Rules::read(EXAMPLE).unwrap();
    let told = |days: usize| -> Vec<(Date, String)> {
        let alerts = alerts(&of_first(&log, days, None), &rules).alerts;
        alerts.into_iter().map(|alert| (alert.date, alert.rule)).collect()
    };
    let all = told(DAYS);
    assert!(all.iter().any(|(_, rule)| rule == SENSOR) && all.len() > 1, "{all:?}");
    for days in 1..DAYS {
        let end = (WallTime::EPOCH + days as i64 * DAY).date();
        let until: Vec<_> = all.iter().filter(|(date, _)| *date < end).cloned().collect();
        assert_eq!(told(days), until, "after {days} days");
    }
}

#[test]
fn a_measure_that_is_scaled_by_the_whole_run_is_caught() {
    let log = of_motion(1);
    let pace = MEASURES.iter().position(|measure| measure.name == "pace").unwrap();
    let scaled = |days: usize| {
        let mut measures = of_first(&log, days, None);
        let known = measures.known(pace);
        let mean = known.iter().sum::<f64>() / known.len() as f64;
        measures.days.iter_mut().filter_map(|day| day.values[pace].as_mut()).for_each(|value| *value /= mean);
        measures
    };
    let caught = differences(&scaled(20), &scaled(DAYS));
    assert!(!caught.is_empty() && caught.iter().all(|difference| difference.starts_with("pace on")), "{caught:?}");
}

#[test]
fn lives_that_part_are_alike_until_they_do() {
    let (well, mut ill) = (of_motion(5), of_motion(5));
    let parts = WallTime::EPOCH + 25 * DAY;
    // From that day on half of the rows are missing.
    let mut number = 0;
    ill.events.retain(|event| {
        number += 1;
        event.at < parts || number % 2 == 0
    });
    let differ = |measures: [Measures; 2], from: usize, to: usize| {
        let days = |measures: &Measures| measures.days[from..to].to_vec();
        days(&measures[0]) != days(&measures[1])
    };
    let both = || [&well, &ill].map(|log| of_first(log, DAYS, None));
    assert!(!differ(both(), 0, 25));
    assert!(differ(both(), 25, DAYS));
}
