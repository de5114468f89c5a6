//! The half of the day of a time that leaves it open, by the other words of its sentence.

use crate::routine::{Activity, Meal, PartOfDay};

/// Hours of the clock at which an activity takes place in the first half of the day, and in the second (our choice).
const HALVES: [(&[Activity], [f64; 2], [f64; 2]); 9] = [
    (&[Activity::GetUp], [4.0, 12.0], NONE),
    (&[Activity::Eat(Meal::Breakfast), Activity::Prepare(Meal::Breakfast), Activity::Dress], [5.0, 12.0], NONE),
    (&[Activity::Eat(Meal::Lunch), Activity::Prepare(Meal::Lunch)], [11.0, 12.0], [0.0, 3.0]),
    (&[Activity::Eat(Meal::Dinner), Activity::Prepare(Meal::Dinner)], NONE, [4.0, 10.0]),
    (&[Activity::GoToBed], [0.0, 4.0], [7.0, 12.0]),
    (&[Activity::WatchTelevision], NONE, [0.0, 11.0]),
    (&[Activity::TakeMedicine], [6.0, 10.0], [0.0, 6.0]),
    (
        &[Activity::Leave, Activity::Visit, Activity::Exercise, Activity::Housework, Activity::Laundry],
        [8.0, 12.0],
        [0.0, 6.0],
    ),
    (&[Activity::Drink, Activity::Nap], [9.0, 12.0], [0.0, 6.0]),
];

const NONE: [f64; 2] = [0.0, 0.0];

/// Hours of the clock at which daytime activities do not take place (our choice).
const BY_DAY: [f64; 2] = [1.0, 6.0];

const AT_ANY_HOUR: [Activity; 10] = [
    Activity::UseBathroom,
    Activity::LieAwake,
    Activity::Wander,
    Activity::Pace,
    Activity::Lap,
    Activity::Fall,
    Activity::Stumble,
    Activity::ComeHome,
    Activity::Snack,
    Activity::Relax,
];

/// Whether an hour of a clock of twelve is in the second half of the day, by the activity.
pub fn half_of_activity(doing: &Activity, hour: f64) -> Option<bool> {
    let of_doing = HALVES.iter().find(|(activities, ..)| activities.contains(doing));
    let usual = (!AT_ANY_HOUR.contains(doing)).then_some((NONE, BY_DAY));
    let (first, second) = &of_doing.map(|(_, first, second)| (*first, *second)).or(usual)?;
    let is_in = |[from, to]: &[f64; 2]| (*from..*to).contains(&(hour % 12.0));
    if is_in(first) { Some(false) } else { is_in(second).then_some(true) }
}

/// The same by the part of the day.
pub fn half_of_part(part: PartOfDay, hour: f64) -> Option<bool> {
    match part {
        PartOfDay::Morning => Some(false),
        PartOfDay::Afternoon | PartOfDay::Evening => Some(true),
        PartOfDay::Night => Some((6.0..12.0).contains(&hour)),
        PartOfDay::Noon => Some(hour < 6.0),
        PartOfDay::Day => None,
    }
}

/// Both times that an open one may be, as a hint.
pub fn both_halves(said: &str, hour: f64, is_whole: bool) -> String {
    let early = if (3.0..12.0).contains(&hour) { "in the morning" } else { "at night" };
    let late = if (6.0..12.0).contains(&hour) { "in the evening" } else { "in the afternoon" };
    let shown = if hour == 0.0 { 12.0 } else { hour };
    match is_whole {
        true => format!("write \"{shown} am\" or \"{shown} pm\""),
        false => format!("write \"{said} {early}\" or \"{said} {late}\""),
    }
}
