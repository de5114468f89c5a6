//! Times of rising and of going to bed, and draws of fuzzy numbers.

use super::defaults;
use super::places::HomePlaces;
use super::resident_routine::{DayParameters, InForce, ResidentRoutine, SentenceId};
use crate::routine::{Activity, DaySelection, Habit, HabitTime};
use homebody_core::fuzzy::Fuzzy;
use homebody_core::numbers::Numbers;
use homebody_core::time::{HOUR, MINUTE, RunTime, Span};
use std::sync::Arc;

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
    let later = parameters.later_s(&Activity::GetUp);
    let said = clock_of(life, day, parameters, &Activity::GetUp).map(|clock| clock.0 + later);
    let time = slept_until(life, day, parameters).or(said).unwrap_or_else(|| {
        varied(&usual_up(&life.numbers), life.stream_of_day(day, "up").unit(), parameters.irregular) + later
    }) + life.person.up_s;
    life.instant(day, time.clamp(0.0, LAST_S))
}

/// The end of a stated time in bed that has a beginning: its own, or a stated bedtime without a stated rising.
fn slept_until(life: &ResidentRoutine, day: i32, parameters: &DayParameters) -> Option<f64> {
    let (is_timed, in_bed_s) = in_bed_s(life, day - 1, parameters)?;
    let (bed_s, is_own) = clock_of(life, day - 1, parameters, &Activity::GoToBed)?;
    let rises = || clock_of(life, day, parameters, &Activity::GetUp).is_some_and(|(_, is_own)| is_own);
    if !is_timed && (!is_own || rises()) {
        return None;
    }
    let bed_s = bed_s + parameters.later_s(&Activity::GoToBed);
    Some(bed_s + in_bed_s - if bed_s < NOON_S { 0.0 } else { 24.0 * HOUR_S })
}

/// A bedtime before noon is after midnight.
const NOON_S: f64 = 12.0 * HOUR_S;

/// The stated time in bed of a night, which is the duration of going to bed, and whether the sentence gives the bedtime, too.
fn in_bed_s(life: &ResidentRoutine, day: i32, parameters: &DayParameters) -> Option<(bool, f64)> {
    let with_length = holding(life, day, &Activity::GoToBed).find(|habit| habit.said.when.lasts.is_some())?;
    let share = life.stream_of_day(day, &format!("{}/lasts", of_time(with_length.key, 0))).unit();
    let lasts_s = varied_length(with_length.said.when.lasts.as_ref()?, share, parameters.irregular);
    Some((has_time(with_length.said), parameters.lasting_s(&Activity::GoToBed, lasts_s)))
}

/// The last second of a day, which limits a later rising.
const LAST_S: f64 = 24.0 * HOUR_S - 1.0;

/// The first such time after `up` that leaves part of the day, and before the next rising. A stated time in bed without a
/// beginning ends with the rising.
pub(super) fn bed(
    life: &ResidentRoutine,
    day: i32,
    parameters: &DayParameters,
    up: RunTime,
    next_up: RunTime,
) -> RunTime {
    let bed = after(life, day, bed_s(life, day, parameters), up);
    let bed = match in_bed_s(life, day, parameters) {
        Some((false, in_bed_s)) if slept_until(life, day + 1, parameters).is_none() => {
            next_up - Span::from_seconds(in_bed_s)
        }
        _ => bed,
    };
    within_the_day(bed, up, next_up)
}

/// The sentence with the time of a bedtime, and the latest time that it states.
pub(super) fn bed_stated_by(
    life: &ResidentRoutine,
    day: i32,
    parameters: &DayParameters,
    up: RunTime,
) -> Option<(SentenceId, RunTime)> {
    let first = holding(life, day, &Activity::GoToBed).find(|habit| has_time(habit.said))?;
    let HabitTime::At(time) = &first.said.when.time else { return None };
    let latest_s = time.high + parameters.later_s(&Activity::GoToBed) + life.person.bed_s;
    Some((first.id(), after(life, day, latest_s, up)))
}

/// A bedtime that leaves half an hour of the day, and of the night.
pub(super) fn within_the_day(bed: RunTime, up: RunTime, next_up: RunTime) -> RunTime {
    bed.min(next_up - 30 * MINUTE).max(up + 30 * MINUTE)
}

/// Whether a habit gives tonight's bedtime relative to another activity.
pub(super) fn is_bedtime(life: &ResidentRoutine, day: i32, habit: &InForce<Habit>) -> bool {
    let first = holding(life, day, &Activity::GoToBed).find(|of| has_time(of.said));
    !matches!(habit.said.when.time, HabitTime::At(_)) && first.is_some_and(|first| first.id() == habit.id())
}

/// The name of the place of the coming night's sleep, if stated. Of several sentences, the one about the fewest nights
/// applies, and of those the last.
pub(super) fn sleeps_at(life: &ResidentRoutine, day: i32) -> Option<&str> {
    let nights = |habit: &Habit| {
        let DaySelection { weekdays, months, every, of_month, .. } = habit.when.days;
        let days = f64::from(weekdays.count_ones()) / 7.0 * f64::from(months.count_ones()) / 12.0;
        let of_month = f64::from(of_month.1.saturating_sub(of_month.0).min(30) + 1) / 31.0;
        habit.when.chance.probability * days * of_month / f64::from(every.max(1))
    };
    let places = holding(life, day, &Activity::GoToBed).filter(|habit| habit.said.place.is_some());
    let rarest = places.reduce(|one, other| if nights(other.said) <= nights(one.said) { other } else { one });
    rarest?.said.place.as_deref()
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
    let time = said.map(|clock| clock.0).unwrap_or_else(|| {
        varied(&usual_bed(&life.numbers), life.stream_of_day(day, "bed").unit(), parameters.irregular)
    });
    time + parameters.later_s(&Activity::GoToBed) + life.person.bed_s
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

/// The habits of an activity that are done on a day.
fn holding<'a>(life: &'a ResidentRoutine, day: i32, activity: &Activity) -> impl Iterator<Item = InForce<'a, Habit>> {
    life.habits(day).filter(move |in_force| {
        let InForce { said: habit, strength, key, source, .. } = in_force;
        if habit.activity != *activity || habit.visitor.is_some() || !life.is_on(&habit.when.days, day) {
            return false;
        }
        if *source == ResidentRoutine::UNSAID && life.says(habit, day) {
            return false;
        }
        let whether = life.stream_of_day(day, &format!("{}/whether", of_time(key, 0)));
        { whether }.unit() < life.chance(habit, *strength, day)
    })
}

/// Whether a habit of rising or going to bed gives its time.
fn has_time(habit: &Habit) -> bool {
    !matches!(habit.when.time, HabitTime::AnyTime | HabitTime::Within(_))
}

/// The time of rising or of going to bed by a habit, in seconds since midnight, and whether the routine or a condition states
/// it. A bedtime relative to another activity follows from the plan of the day.
fn clock_of(life: &ResidentRoutine, day: i32, parameters: &DayParameters, activity: &Activity) -> Option<(f64, bool)> {
    let first = holding(life, day, activity).find(|habit| has_time(habit.said))?;
    let share = life.stream_of_day(day, &format!("{}/start", of_time(first.key, 0))).unit();
    let gap_s = |gap: &Option<Fuzzy>| gap.map_or(0.0, |gap| gap.at(share));
    let starts = |of: &Activity| start_of(life, day, parameters, of);
    let time = match &first.said.when.time {
        HabitTime::At(time) => varied(time, share, parameters.irregular),
        _ if *activity == Activity::GoToBed => return None,
        HabitTime::Before(of, gap) => starts(of)?.0 - gap_s(gap),
        HabitTime::With(of) => starts(of)?.0,
        HabitTime::After(of, gap) => starts(of).map(|(start, lasts)| start + lasts + gap_s(gap))?,
        HabitTime::Then => {
            let before = life.habits(day).take_while(|habit| habit.id() != first.id()).last();
            let (start, lasts) = starts(&before.filter(|before| before.source == first.source)?.said.activity)?;
            start + lasts
        }
        HabitTime::AnyTime | HabitTime::Within(_) => return None,
    };
    Some((time, first.source != ResidentRoutine::UNSAID))
}

/// Start and duration, in seconds, of an activity with a time of day that a rising can refer to.
fn start_of(life: &ResidentRoutine, day: i32, parameters: &DayParameters, activity: &Activity) -> Option<(f64, f64)> {
    let timed = holding(life, day, activity).find_map(|habit| {
        let HabitTime::At(time) = &habit.said.when.time else { return None };
        let share = life.stream_of_day(day, &format!("{}/start", of_time(habit.key, 0))).unit();
        let usual_s = defaults::length(activity, &life.numbers).median_min * 60.0;
        let start = varied(time, share, parameters.irregular) + parameters.later_s(activity);
        Some((start, habit.said.when.lasts.map_or(usual_s, |lasts| lasts.mean())))
    });
    match activity {
        // It is eaten once it is prepared.
        Activity::Eat(meal) if timed.is_none() => {
            let (start, lasts) = start_of(life, day, parameters, &Activity::Prepare(*meal))?;
            Some((start + lasts, defaults::length(activity, &life.numbers).median_min * 60.0))
        }
        _ => timed,
    }
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

/// The places of the home with a stated place of sleep as the bed.
pub(super) fn places_of_night(usual: &Arc<HomePlaces>, asleep_at: Option<&str>) -> Arc<HomePlaces> {
    asleep_at.map_or_else(|| usual.clone(), |name| Arc::new(HomePlaces::clone(usual).sleeping_at(name)))
}
