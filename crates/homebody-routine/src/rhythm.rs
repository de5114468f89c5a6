//! A diary as a routine: sentences with times, lengths and frequencies.
//!
//! A day lasts from one rising to the next. The times of rising and of going to bed are triangles with the standard
//! deviation of the diary. An activity that mostly follows soon after rising is given by its delay. Long activities, such
//! as outings, have a time for the first, second and so on of a day, and so has each meal. Short activities, such as
//! washing, and unnamed ones, such as sitting, have a number per day, and visits to the toilet a number per night. Lengths
//! and counts cover the middle four fifths; if a few last much longer than most, they become a sentence of their own.
//!
//! We assume that a night is the only sleep of three hours or more, with up to an hour and a half awake in it, and that an
//! activity which a diary could note and never does is not done.
//!
//! Left out: weekdays, similarity of successive days, and sequences other than after rising and from cooking to eating.

use crate::explain::words::number;
use crate::language::activities::phrase;
use crate::routine::{Activity, Meal};
use homebody_core::statistics;
use homebody_core::time::{HOUR, Interval, MINUTE, Span, WallTime, joined};

#[derive(Clone, Debug, PartialEq)]
pub struct DiaryEntry {
    /// The activity; a night is [`Activity::GoToBed`].
    pub what: Activity,
    pub begin: WallTime,
    pub end: WallTime,
}

/// Longest time awake of a person who sleeps again and was not up for the day (our choice).
const UP_AT_NIGHT: Span = MINUTE.times(90);
/// Length below which a sleep is a nap (our choice).
const SHORTEST_NIGHT: Span = HOUR.times(3);
/// Time after rising within which an activity, on at least half of the days, follows from it (our choice).
const AFTER_RISING: Span = HOUR.times(2);
/// Shortest activity with a time of day (our choice).
const LONG: Span = MINUTE.times(10);
/// Ratio of the longest tenth to the median above which few activities last much longer than most (our choice).
const SKEWED: f64 = 3.0;
/// Share of days below which an activity is left out (our choice).
const RARE: f64 = 0.1;
/// Smallest and largest tolerance of a clock time, in minutes (our choice).
const GIVE_OR_TAKE_MIN: [f64; 2] = [5.0, 480.0];

/// The sentences of a diary. `noted` is in order of time; `known` are the activities that the diary would note, so that the
/// sentences exclude those that it never does.
pub fn sentences(noted: &[DiaryEntry], known: &[Activity]) -> Vec<String> {
    let days = days(noted);
    let mut said = nights(&days);
    let mut whats: Vec<&Activity> = known.iter().filter(|what| **what != Activity::GoToBed).collect();
    whats.sort();
    whats.dedup();
    for what in whats {
        let of: Vec<Vec<&DiaryEntry>> = days.iter().map(|day| day.entries(what)).collect();
        if of.iter().all(Vec::is_empty) {
            said.push(format!("She never {}.", phrase(what)));
        } else if !is_eaten_after_cooking(what, &days) {
            said.extend(activity_sentences(what, &days, of));
        }
    }
    said
}

/// From one rising to the next.
struct DiaryDay<'a> {
    /// Rising, and going to bed.
    up: WallTime,
    bed: Option<WallTime>,
    noted: Vec<&'a DiaryEntry>,
    /// During the night before.
    at_night: Vec<&'a DiaryEntry>,
}

impl<'a> DiaryDay<'a> {
    fn entries(&self, what: &Activity) -> Vec<&'a DiaryEntry> {
        self.noted.iter().filter(|noted| noted.what == *what).copied().collect()
    }

    /// The midnight before rising.
    fn midnight(&self) -> WallTime {
        self.up - self.up.time_of_day()
    }
}

fn days(noted: &[DiaryEntry]) -> Vec<DiaryDay<'_>> {
    let sleeps = noted.iter().filter(|one| one.what == Activity::GoToBed);
    let mut nights = joined(sleeps.map(|sleep| Interval::new(sleep.begin, sleep.end)), UP_AT_NIGHT);
    nights.retain(|night| night.length() >= SHORTEST_NIGHT);
    let within = |time: Interval<WallTime>| noted.iter().filter(move |one| time.contains(one.begin)).collect();
    let day = |(index, night): (usize, &Interval<WallTime>)| {
        let bed = nights.get(index + 1).map(|next| next.begin);
        let day = Interval::new(night.end, bed.unwrap_or(WallTime::MAX));
        DiaryDay { up: night.end, bed, noted: within(day), at_night: within(*night) }
    };
    nights.iter().enumerate().map(day).collect()
}

fn nights(days: &[DiaryDay]) -> Vec<String> {
    let mut said = Vec::new();
    let up: Vec<f64> = days.iter().map(|day| day.up.time_of_day().seconds()).collect();
    let bed: Vec<f64> = days.iter().filter_map(|day| Some((day.bed? - day.midnight()).seconds())).collect();
    for (what, times) in [("gets up", up), ("goes to bed", bed)] {
        if !times.is_empty() {
            said.push(format!("She {what} {}.", clock(&times)));
        }
    }
    let visits = |day: &DiaryDay| day.at_night.iter().filter(|one| one.what == Activity::UseBathroom).count() as f64;
    let visits: Vec<f64> = days.iter().map(visits).filter(|&count| count > 0.0).collect();
    let share = visits.len() as f64 / days.len().max(1) as f64;
    if share >= RARE {
        // "On 10 % of nights" already implies the night.
        let a_night = if (share * 100.0).round() < 100.0 { "" } else { " a night" };
        let on = on(share, "nights");
        said.push(format!("{on} {} {}{a_night}.", phrase(&Activity::UseBathroom), times(&visits)));
    }
    said
}

fn on(share: f64, what: &str) -> String {
    let percent = (share * 100.0).round();
    if percent < 100.0 { format!("On {} % of {what} she", number(percent)) } else { "She".into() }
}

fn times(counts: &[f64]) -> String {
    let [least, most] = [0.1, 0.9].map(|share| quantile(counts, share).round());
    match (least, most) {
        (1.0, 1.0) => "once".into(),
        (least, most) if least == most => format!("{} times", number(most)),
        (least, most) => format!("{} to {} times", number(least), number(most)),
    }
}

/// For a meal whose preparation is noted too, that sentence gives the time.
fn is_eaten_after_cooking(what: &Activity, days: &[DiaryDay]) -> bool {
    let Activity::Eat(meal) = what else { return false };
    days.iter().any(|day| !day.entries(&Activity::Prepare(*meal)).is_empty())
}

fn activity_sentences(what: &Activity, days: &[DiaryDay], mut of: Vec<Vec<&DiaryEntry>>) -> Vec<String> {
    let mut said = Vec::new();
    let all = days.len() as f64;
    let soon: Vec<usize> = (0..days.len())
        .filter(|&day| of[day].first().is_some_and(|first| first.begin - days[day].up < AFTER_RISING))
        .collect();
    if soon.len() as f64 >= all / 2.0 && *what != Activity::Leave {
        let firsts: Vec<&DiaryEntry> = soon.iter().map(|&day| of[day].remove(0)).collect();
        let after: Vec<f64> =
            soon.iter().zip(&firsts).map(|(&day, first)| (first.begin - days[day].up).seconds()).collect();
        let minutes = (mean(&after) / 60.0).round().max(1.0);
        let when = format!(" {} after she gets up", counted(minutes, "minute"));
        said.extend(sentence(what, soon.len() as f64 / all, &when, &firsts, days));
    }
    if let Activity::Prepare(_) | Activity::Eat(_) = what {
        // A meal has one time of day: two would contradict each other.
        of.iter_mut().for_each(|of| of.truncate(1));
        return if said.is_empty() { at_their_times(what, days, &of) } else { said };
    }
    let lengths: Vec<f64> = of.iter().flatten().map(|one| (one.end - one.begin).seconds()).collect();
    // Unnamed activities, such as sitting, repeat throughout the day.
    let is_often = lengths.is_empty() || matches!(what, Activity::Other(_)) || quantile(&lengths, 0.5) < LONG.seconds();
    match is_often {
        true => said.extend(shorter_and_longer(of).iter().filter_map(|of| times_a_day(what, days, of))),
        false => said.extend(at_their_times(what, days, &of)),
    }
    said
}

/// Splits into shorter and longer ones if a few last much longer than most.
fn shorter_and_longer(of: Vec<Vec<&DiaryEntry>>) -> Vec<Vec<Vec<&DiaryEntry>>> {
    let length = |one: &DiaryEntry| (one.end - one.begin).seconds();
    let mut lengths: Vec<f64> = of.iter().flatten().map(|one| length(one)).collect();
    lengths.sort_by(f64::total_cmp);
    if lengths.is_empty() || quantile(&lengths, 0.9) <= SKEWED * quantile(&lengths, 0.5) {
        return vec![of];
    }
    // Cuts at the largest ratio between neighbours above the median.
    let pairs = lengths[lengths.len() / 2..].windows(2);
    let widest = pairs.max_by(|a, b| (a[1] / a[0].max(1.0)).total_cmp(&(b[1] / b[0].max(1.0))));
    let Some(&[_, longer]) = widest else { return vec![of] };
    let part = |is_longer: bool| -> Vec<Vec<&DiaryEntry>> {
        let fits = |one: &&DiaryEntry| (length(one) >= longer) == is_longer;
        of.iter().map(|of| of.iter().copied().filter(fits).collect()).collect()
    };
    vec![part(false), part(true)]
}

/// For short activities.
fn times_a_day(what: &Activity, days: &[DiaryDay], of: &[Vec<&DiaryEntry>]) -> Option<String> {
    let counts: Vec<f64> = of.iter().map(|of| of.len() as f64).filter(|&count| count > 0.0).collect();
    if counts.is_empty() {
        return None;
    }
    // "On 40 % of days" already implies once.
    let when = match times(&counts).as_str() {
        "once" => String::new(),
        times => format!(" {times} a day"),
    };
    let all: Vec<&DiaryEntry> = of.iter().flatten().copied().collect();
    sentence(what, counts.len() as f64 / days.len() as f64, &when, &all, days)
}

/// For long activities: times of the first, second and so on of a day.
fn at_their_times(what: &Activity, days: &[DiaryDay], of: &[Vec<&DiaryEntry>]) -> Vec<String> {
    let most = of.iter().map(Vec::len).max().unwrap_or(0);
    let nth = |nth: usize| {
        let on: Vec<usize> = (0..days.len()).filter(|&day| of[day].len() > nth).collect();
        let times: Vec<f64> = on.iter().map(|&day| (of[day][nth].begin - days[day].midnight()).seconds()).collect();
        let done: Vec<&DiaryEntry> = on.iter().map(|&day| of[day][nth]).collect();
        sentence(what, on.len() as f64 / days.len() as f64, &format!(" {}", clock(&times)), &done, days)
    };
    (0..most).filter_map(nth).collect()
}

fn sentence(what: &Activity, share: f64, when: &str, done: &[&DiaryEntry], days: &[DiaryDay]) -> Option<String> {
    if share < RARE {
        return None;
    }
    let lasts = |done: &[&DiaryEntry]| {
        let lengths: Vec<f64> = done.iter().map(|one| (one.end - one.begin).seconds()).collect();
        span([0.1, 0.9].map(|share| quantile(&lengths, share)))
    };
    let eats = |meal: Meal| {
        let eaten: Vec<&DiaryEntry> = days.iter().flat_map(|day| day.entries(&Activity::Eat(meal))).collect();
        if eaten.is_empty() { String::new() } else { format!(", then eats {}", lasts(&eaten)) }
    };
    let then = if let Activity::Prepare(meal) = what { eats(*meal) } else { String::new() };
    let on = on(share, "days");
    Some(format!("{on} {}{when} {}{then}.", phrase(what), lasts(done)))
}

fn clock(times_s: &[f64]) -> String {
    let minutes = (mean(times_s) / 60.0).round() as i64;
    let [least, most] = GIVE_OR_TAKE_MIN;
    // The standard deviation of a triangle is its half width divided by the root of six.
    let give_or_take = (spread(times_s) * 6.0_f64.sqrt() / 60.0).round().clamp(least, most);
    let (hour, minute) = (minutes.div_euclid(60).rem_euclid(24), minutes.rem_euclid(60));
    format!("at about {hour:02}:{minute:02}, give or take {}", counted(give_or_take, "minute"))
}

fn span([from, to]: [f64; 2]) -> String {
    let (unit, of_unit) = if to < 180.0 { ("second", 1.0) } else { ("minute", 60.0) };
    let [from, to] = [from, to].map(|s| s / of_unit);
    let [from, to] = match unit {
        "second" => [from, to].map(|value| value.round().max(1.0)),
        // In tenths of a minute if it would round to nothing.
        _ => [from, to].map(|value| ((value * 10.0).round() / 10.0).max(0.1)),
    };
    if from == to {
        format!("for {}", counted(to, unit))
    } else {
        format!("for {} to {}", number(from), counted(to, unit))
    }
}

fn counted(value: f64, what: &str) -> String {
    let s = if value == 1.0 { "" } else { "s" };
    format!("{} {what}{s}", number(value))
}

fn mean(values: &[f64]) -> f64 {
    statistics::mean(values).unwrap_or(0.0)
}

/// The standard deviation; 0 for a single value.
fn spread(values: &[f64]) -> f64 {
    statistics::sd(values).unwrap_or(0.0)
}

fn quantile(values: &[f64], share: f64) -> f64 {
    statistics::quantile(values, share).unwrap_or(0.0)
}

#[cfg(test)]
mod tests;
