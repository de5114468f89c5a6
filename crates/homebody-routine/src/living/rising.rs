//! When somebody gets up and goes to bed on a day, and how what is fuzzy is drawn.

use super::life::{DayParameters, InForce, Life};
use crate::routine::{Activity, When};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::numbers::Numbers;
use homebody_core::time::{Micros, SECOND};

const HOUR: f64 = 3600.0;

homebody_core::numbers! {
    /// Time of getting up, if the routine gives none: 06:44 for healthy older adults (Scientific Reports 2015,
    /// actigraphy).
    static UP_H = "day.up": 6.73, "h", [2.0, 14.0];
    /// Largest deviation of the time of getting up from `day.up`.
    static UP_SPREAD_H = "day.up_spread": 0.5, "h", [0.0, 4.0];
    /// Time of going to bed, if the routine gives none: 23:23 for healthy older adults (Scientific Reports 2015,
    /// actigraphy).
    static BED_H = "day.bed": 23.38, "h", [17.0, 28.0];
    /// Largest deviation of the time of going to bed from `day.bed` to an earlier time.
    static BED_EARLIER_H = "day.bed_earlier": 0.48, "h", [0.0, 4.0];
    /// Largest deviation of the time of going to bed from `day.bed` to a later time.
    static BED_LATER_H = "day.bed_later": 0.52, "h", [0.0, 4.0];
}

/// Getting up where nothing is said or the quantifier says no.
fn usual_up(numbers: &Numbers) -> Fuzzy {
    Fuzzy::around(numbers.of(&UP_H) * HOUR, numbers.of(&UP_SPREAD_H) * HOUR)
}

/// Going to bed where nothing is said or the quantifier says no.
fn usual_bed(numbers: &Numbers) -> Fuzzy {
    let [at, earlier, later] = [&BED_H, &BED_EARLIER_H, &BED_LATER_H].map(|number| numbers.of(number) * HOUR);
    Fuzzy { low: at - earlier, from: at, to: at, high: at + later }
}

/// When the resident gets up on a day.
pub(super) fn up(life: &Life, day: i32, parameters: &DayParameters) -> Micros {
    let time = clock_of(life, day, parameters, &Activity::GetUp).unwrap_or_else(|| {
        varied(&usual_up(&life.numbers), life.stream_of_day(day, "up").unit(), parameters.irregular)
            + parameters.later_s(&Activity::GetUp)
    }) + life.person.up_s;
    life.instant(day, time.clamp(0.0, LAST_S))
}

/// The last second of a day: who is said to get up later gets up then.
const LAST_S: f64 = 24.0 * HOUR - 1.0;

/// When the resident who got up at `up` goes to bed: the first time of that hour that leaves some of the day, and before the
/// next rising.
pub(super) fn bed(life: &Life, day: i32, parameters: &DayParameters, up: Micros, next_up: Micros) -> Micros {
    let time = bed_s(life, day, parameters);
    after(life, day, time, up).min(next_up - 1800 * SECOND).max(up + 1800 * SECOND)
}

/// The first instant of a time of day that leaves some of the day.
fn after(life: &Life, day: i32, mut time: f64, up: Micros) -> Micros {
    // Half past midnight is the end of the day before, and so is eight in the morning of who gets up at three.
    while life.instant(day, time) < up + 3600 * SECOND {
        time += 24.0 * HOUR;
    }
    life.instant(day, time)
}

/// At which time of day the resident goes to bed.
fn bed_s(life: &Life, day: i32, parameters: &DayParameters) -> f64 {
    let said = clock_of(life, day, parameters, &Activity::GoToBed);
    let time = said.unwrap_or_else(|| {
        varied(&usual_bed(&life.numbers), life.stream_of_day(day, "bed").unit(), parameters.irregular)
            + parameters.later_s(&Activity::GoToBed)
    });
    time + life.person.bed_s
}

/// Usual is the bedtime in the middle of those of so many nights (ours).
const NIGHTS: i32 = 7;

/// Smallest delay of going to bed in a late night (our choice).
const LATE: Micros = 1800 * SECOND;

/// How late it is for somebody who goes to bed now, beside the bedtime that is usual by the sentences; 0 where it is not late.
pub(super) fn late_by(life: &Life, day: i32, up: Micros, now: Micros) -> Micros {
    let as_said = DayParameters { irregular: 0.0, ..DayParameters::ordinary() };
    let mut times: Vec<f64> = (day + 1 - NIGHTS..=day).map(|day| bed_s(life, day, &as_said)).collect();
    times.sort_by(f64::total_cmp);
    let late = now - after(life, day, times[times.len() / 2], up);
    if late < LATE { 0 } else { late }
}

/// The time of day that the habits say for getting up or going to bed, if one of them holds on this day.
fn clock_of(life: &Life, day: i32, parameters: &DayParameters, activity: &Activity) -> Option<f64> {
    life.habits(day).find_map(|InForce { said: habit, strength, key, source, .. }| {
        if habit.activity != *activity || habit.visitor.is_some() || !life.is_on(&habit.days, day) {
            return None;
        }
        if source == Life::UNSAID && life.says(habit, day) {
            return None;
        }
        let When::At(time) = &habit.when else { return None };
        let key = of_time(key, 0);
        let holds = life.stream_of_day(day, &format!("{key}/whether")).unit() < life.chance(habit, strength, day);
        let share = life.stream_of_day(day, &format!("{key}/start")).unit();
        holds.then(|| varied(time, share, parameters.irregular) + parameters.later_s(activity))
    })
}

/// What tells apart the several times a day that a habit is done.
pub(super) fn of_time(key: &str, number: u32) -> String {
    format!("{key}/{number}")
}

/// A number of a fuzzy number, so many times as far from its mean as it would be.
pub(super) fn varied(fuzzy: &Fuzzy, share: f64, irregular: f64) -> f64 {
    let mean = fuzzy.mean();
    mean + (fuzzy.at(share) - mean) * irregular
}

/// How long something takes whose length is fuzzy: as far from the mean as said, and never below nothing, so that the mean
/// stays.
pub(super) fn varied_length(fuzzy: &Fuzzy, share: f64, irregular: f64) -> f64 {
    /// Smallest ratio of the shortest duration to the mean (our choice).
    const LEAST: f64 = 0.05;
    let (mean, least) = (fuzzy.mean(), fuzzy.low);
    let most = if least < mean { (mean * (1.0 - LEAST) / (mean - least)).max(1.0) } else { irregular };
    varied(fuzzy, share, irregular.min(most))
}
