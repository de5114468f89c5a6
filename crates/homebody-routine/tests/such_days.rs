//! Days by weather, by episodes and by the nights before, and rules on wakings, as the truth has them.

use crate::stage::{Simulated, day, hour, mean};
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, RunTime, Span};
use std::collections::BTreeSet;

const ALONE: &str = "Margaret is 82.\nShe gets up at 07:00. She goes to bed at 22:30. She does not nap.\n";

/// The days on which an activity begins between two hours.
fn days_of(lives: &Simulated, name: &str, from_h: f64, to_h: f64) -> BTreeSet<i64> {
    let all = lives.of(name).filter(|time| (from_h..to_h).contains(&hour(time.begin)));
    all.map(|time| day(time.begin)).collect()
}

#[test]
fn each_day_is_dry_or_rainy_and_the_weather_lasts() {
    let habits = "She does not go out. On dry days she knits at 10:00 for 40 minutes.";
    let lives = Simulated::new(&format!("{ALONE}{habits} On rainy days she bakes at 10:00 for 40 minutes."), 150);
    let (dry, rainy) = (days_of(&lives, "handicraft", 9.5, 11.5), days_of(&lives, "baking", 9.5, 11.5));
    assert_eq!(dry.intersection(&rainy).count(), 0);
    assert!(dry.len() + rainy.len() >= 140, "{} and {}", dry.len(), rainy.len());
    let share = rainy.len() as f64 / (dry.len() + rainy.len()) as f64;
    assert!((0.2..0.5).contains(&share), "{share}");
    let after = |of: &BTreeSet<i64>| {
        let next = of.iter().filter(|day| rainy.contains(&(*day + 1))).count();
        next as f64 / of.len() as f64
    };
    assert!(after(&rainy) > after(&dry) + 0.05, "{} and {}", after(&rainy), after(&dry));
    let without = Simulated::of_changed(&format!("{ALONE}{habits}"), 30, |routine| {
        routine.habits.iter_mut().for_each(|habit| habit.when.days.weather = None);
    });
    assert!(days_of(&without, "handicraft", 9.5, 11.5).len() >= 28);
}

#[test]
fn hot_days_are_in_summer_and_frosty_ones_in_winter() {
    let habits = "She does not go out. On hot days she knits at 10:00 for 40 minutes. In frosty weather she bakes at 10:00 for 40 minutes.";
    let lives = Simulated::new(&format!("{ALONE}{habits}"), 330);
    // From 5 January on.
    let (hot, frosty) = (days_of(&lives, "handicraft", 9.5, 11.5), days_of(&lives, "baking", 9.5, 11.5));
    assert!(!hot.is_empty() && hot.len() < 40 && hot.iter().all(|day| (110..270).contains(day)), "{hot:?}");
    assert!(frosty.len() > 40 && frosty.iter().filter(|day| (125..225).contains(*day)).count() <= 2, "{frosty:?}");
}

#[test]
fn an_episode_has_its_length_and_begins_at_random() {
    let out = "She goes out at 10:00 for 1 hour.";
    let at_home = |text: &str| -> Vec<i64> {
        let lives = Simulated::new(&format!("{ALONE}{text}"), 240);
        let out = days_of(&lives, "away", 9.0, 12.0);
        (0..240).filter(|day| !out.contains(day)).collect()
    };
    let days = at_home(&format!("{out} About once every 5 weeks, for a week, she does not go out."));
    let mut lengths: Vec<usize> = Vec::new();
    for (index, day) in days.iter().enumerate() {
        match lengths.last_mut().filter(|_| index > 0 && days[index - 1] + 1 == *day) {
            Some(length) => *length += 1,
            None => lengths.push(1),
        }
    }
    let whole = lengths.iter().filter(|length| **length >= 7).count();
    assert!((2..=14).contains(&whole), "{lengths:?}");
    assert!(lengths.iter().filter(|length| **length < 7).count() <= 2, "{lengths:?}");
    assert!(at_home(out).len() <= 3);
}

/// The time awake in the night before each day, between falling asleep and rising.
fn awake_before(lives: &Simulated) -> Vec<f64> {
    let sleeping: Vec<Interval<RunTime>> = lives.of("sleeping").collect();
    let awake = |day: i64| {
        let night = Interval::starting(RunTime::START + day * DAY - 2 * HOUR, 12 * HOUR);
        let of: Vec<_> = sleeping.iter().filter(|time| night.contains(time.begin)).collect();
        of.windows(2).map(|pair| pair[1].begin - pair[0].end).sum::<Span>().ratio(MINUTE)
    };
    (0..lives.days).map(awake).collect()
}

#[test]
fn what_follows_a_poor_night_follows_no_other() {
    let text = "She does not go out. After a poor night she knits at 10:00 for 40 minutes.";
    let lives = Simulated::new(&format!("{ALONE}{text}"), 90);
    let knits = days_of(&lives, "handicraft", 9.5, 11.5);
    assert!((6..60).contains(&knits.len()), "{}", knits.len());
    let awake = awake_before(&lives);
    let of = |is_poor: bool| -> Vec<f64> {
        (1..90).filter(|day| knits.contains(day) == is_poor).map(|day| awake[day as usize]).collect()
    };
    let (poor, good) = (of(true), of(false));
    let least = poor.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(good.iter().filter(|minutes| **minutes > least + 8.0).count() <= 2, "{poor:?} {good:?}");
    assert!(mean(&poor) > 1.5 * mean(&good));
    let three = "She does not go out. After 3 poor nights in a row she knits at 10:00 for 40 minutes.";
    let rarer = days_of(&Simulated::new(&format!("{ALONE}{three}"), 90), "handicraft", 9.5, 11.5);
    assert!(rarer.len() * 2 < knits.len(), "{} of {}", rarer.len(), knits.len());
    let always = Simulated::of_changed(&format!("{ALONE}{text}"), 30, |routine| {
        routine.habits.iter_mut().for_each(|habit| habit.when.days.poor_nights = 0);
    });
    assert!(days_of(&always, "handicraft", 9.5, 11.5).len() >= 28);
}

#[test]
fn every_waking_is_answered() {
    let drinks_and_wakings = |rule: &str| {
        let lives = Simulated::new(&format!("{ALONE}She does not go out.{rule}"), 40);
        let is_of_night = |at: RunTime| hour(at) < 6.5 || hour(at) > 23.5;
        let rows: Vec<_> = lives.activities.iter().filter(|(time, _)| is_of_night(time.begin)).collect();
        let wakes = |pair: &&[&(Interval<RunTime>, String)]| {
            pair[0].1 == "sleeping" && ["lying_awake", "using_bathroom", "walking"].contains(&pair[1].1.as_str())
        };
        let wakings = rows.windows(2).filter(wakes).count();
        (rows.iter().filter(|(_, what)| what == "drinking").count(), wakings)
    };
    let (drinks, wakings) = drinks_and_wakings(" Whenever she wakes at night, she makes tea.");
    assert!(wakings > 60, "{wakings}");
    assert!(drinks * 100 >= wakings * 85 && drinks * 100 <= wakings * 125, "{drinks} of {wakings}");
    let (drinks, wakings) = drinks_and_wakings("");
    assert!(drinks * 4 < wakings, "{drinks} of {wakings}");
}
