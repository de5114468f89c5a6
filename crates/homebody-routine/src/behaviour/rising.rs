//! Times of rising and of going to bed, and draws of fuzzy numbers.

use super::resident_routine::{DayParameters, InForce, ResidentRoutine};
use crate::routine::{Activity, HabitTime};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::numbers::Numbers;
use homebody_core::time::{HOUR, MINUTE, RunTime, Span};

const HOUR_S: f64 = 3600.0;

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

/// Without a sentence, or if its chance fails.
fn usual_up(numbers: &Numbers) -> Fuzzy {
    Fuzzy::around(numbers.of(&UP_H) * HOUR_S, numbers.of(&UP_SPREAD_H) * HOUR_S)
}

/// Without a sentence, or if its chance fails.
fn usual_bed(numbers: &Numbers) -> Fuzzy {
    let [at, earlier, later] = [&BED_H, &BED_EARLIER_H, &BED_LATER_H].map(|number| numbers.of(number) * HOUR_S);
    Fuzzy { low: at - earlier, from: at, to: at, high: at + later }
}

pub(super) fn up(life: &ResidentRoutine, day: i32, parameters: &DayParameters) -> RunTime {
    let time = clock_of(life, day, parameters, &Activity::GetUp).unwrap_or_else(|| {
        varied(&usual_up(&life.numbers), life.stream_of_day(day, "up").unit(), parameters.irregular)
            + parameters.later_s(&Activity::GetUp)
    }) + life.person.up_s;
    life.instant(day, time.clamp(0.0, LAST_S))
}

/// The last second of a day, which limits a later rising.
const LAST_S: f64 = 24.0 * HOUR_S - 1.0;

/// The first such time after `up` that leaves part of the day, and before the next rising.
pub(super) fn bed(
    life: &ResidentRoutine,
    day: i32,
    parameters: &DayParameters,
    up: RunTime,
    next_up: RunTime,
) -> RunTime {
    let time = bed_s(life, day, parameters);
    after(life, day, time, up).min(next_up - 30 * MINUTE).max(up + 30 * MINUTE)
}

/// The first such time that leaves part of the day.
fn after(life: &ResidentRoutine, day: i32, mut time: f64, up: RunTime) -> RunTime {
    // Half past midnight ends the day before, and so does eight in the morning after rising at three.
    while life.instant(day, time) < up + HOUR {
        time += 24.0 * HOUR_S;
    }
    life.instant(day, time)
}

fn bed_s(life: &ResidentRoutine, day: i32, parameters: &DayParameters) -> f64 {
    let said = clock_of(life, day, parameters, &Activity::GoToBed);
    let time = said.unwrap_or_else(|| {
        varied(&usual_bed(&life.numbers), life.stream_of_day(day, "bed").unit(), parameters.irregular)
            + parameters.later_s(&Activity::GoToBed)
    });
    time + life.person.bed_s
}

/// The usual bedtime is the median over this many nights (our choice).
const NIGHTS: i32 = 7;

/// Smallest delay of going to bed in a late night (our choice).
const LATE: Span = MINUTE.times(30);

/// Delay of a bedtime now beyond the usual one; 0 if it is not late.
pub(super) fn late_by(life: &ResidentRoutine, day: i32, up: RunTime, now: RunTime) -> Span {
    let as_said = DayParameters { irregular: 0.0, ..DayParameters::ordinary() };
    let mut times: Vec<f64> = (day + 1 - NIGHTS..=day).map(|day| bed_s(life, day, &as_said)).collect();
    times.sort_by(f64::total_cmp);
    let late = now - after(life, day, times[times.len() / 2], up);
    if late < LATE { Span::ZERO } else { late }
}

/// The stated time of rising or going to bed, if a habit applies on this day.
fn clock_of(life: &ResidentRoutine, day: i32, parameters: &DayParameters, activity: &Activity) -> Option<f64> {
    life.habits(day).find_map(|InForce { said: habit, strength, key, source, .. }| {
        if habit.activity != *activity || habit.visitor.is_some() || !life.is_on(&habit.when.days, day) {
            return None;
        }
        if source == ResidentRoutine::UNSAID && life.says(habit, day) {
            return None;
        }
        let HabitTime::At(time) = &habit.when.time else { return None };
        let key = of_time(key, 0);
        let holds = life.stream_of_day(day, &format!("{key}/whether")).unit() < life.chance(habit, strength, day);
        let share = life.stream_of_day(day, &format!("{key}/start")).unit();
        holds.then(|| varied(time, share, parameters.irregular) + parameters.later_s(activity))
    })
}

pub(super) fn of_time(key: &str, number: u32) -> String {
    format!("{key}/{number}")
}

/// Stretches the deviation from the mean by a factor.
pub(super) fn varied(fuzzy: &Fuzzy, share: f64, irregular: f64) -> f64 {
    let mean = fuzzy.mean();
    mean + (fuzzy.at(share) - mean) * irregular
}

/// Stretches a duration's deviation from the mean without going below zero, so that the mean stays.
pub(super) fn varied_length(fuzzy: &Fuzzy, share: f64, irregular: f64) -> f64 {
    /// Smallest ratio of the shortest duration to the mean (our choice).
    const LEAST: f64 = 0.05;
    let (mean, least) = (fuzzy.mean(), fuzzy.low);
    let most = if least < mean { (mean * (1.0 - LEAST) / (mean - least)).max(1.0) } else { irregular };
    varied(fuzzy, share, irregular.min(most))
}
