//! A diary written as a routine: sentences with the times, the lengths and the frequencies of what somebody did.
//!
//! A day goes from one rising to the next. When somebody gets up and goes to bed is a triangle whose standard deviation is that of
//! the diary. What is done soon after rising on most days is said by how long after. Of what takes long, such as outings, the first,
//! the second and so on of a day each have a time of day, and so has each meal; of what is soon done, such as washing, and of what
//! has no name of its own, such as sitting somewhere, it is said how many times a day it is, and of visits to the toilet how many
//! times a night. Lengths and counts are those of four in five cases, from the first tenth to the last; where a few last much longer
//! than most, these are said apart.
//!
//! We assume that a night is the only sleep of three hours and more, in which one may have been up for an hour and a half, and
//! that what a diary could note and never does is not done.
//!
//! Left out: weekdays, whether one day is like the one before, and what follows what but for rising, and for eating what was
//! prepared.

use crate::explain::words::number;
use crate::language::activities::phrase;
use crate::routine::{Activity, Meal};
use homebody_core::statistics;
use homebody_core::time::{DAY, Micros, SECOND, seconds};
use std::ops::Range;

/// What a diary notes; instants are microseconds since a midnight on the clock on the wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Noted {
    /// What was done; a night is [`Activity::GoToBed`].
    pub what: Activity,
    /// From when.
    pub begin: Micros,
    /// Until when.
    pub end: Micros,
}

/// Longest time awake of a person who sleeps again and was not up for the day (our choice).
const UP_AT_NIGHT: Micros = 90 * 60 * SECOND;
/// Length below which a sleep is a nap (our choice).
const SHORTEST_NIGHT: Micros = 3 * 3600 * SECOND;
/// Time after rising within which an activity, on at least half of the days, follows from it (our choice).
const AFTER_RISING: Micros = 2 * 3600 * SECOND;
/// Shortest activity with a time of day (our choice).
const LONG: Micros = 10 * 60 * SECOND;
/// Ratio of the longest tenth to the median above which few activities last much longer than most (our choice).
const SKEWED: f64 = 3.0;
/// Share of days below which an activity is left out (our choice).
const RARE: f64 = 0.1;
/// Smallest and largest tolerance of a clock time, in minutes (our choice).
const GIVE_OR_TAKE_MIN: [f64; 2] = [5.0, 480.0];

/// The sentences of a diary. `noted` is in order; `known` are the activities that it would note: of those that it never does,
/// the sentences say so.
pub fn sentences(noted: &[Noted], known: &[Activity]) -> Vec<String> {
    let days = days(noted);
    let mut said = nights(&days);
    let mut whats: Vec<&Activity> = known.iter().filter(|what| **what != Activity::GoToBed).collect();
    whats.sort();
    whats.dedup();
    for what in whats {
        let of: Vec<Vec<&Noted>> = days.iter().map(|day| day.of(what)).collect();
        if of.iter().all(Vec::is_empty) {
            said.push(format!("She never {}.", phrase(what)));
        } else if !is_eaten_after_cooking(what, &days) {
            said.extend(of_activity(what, &days, of));
        }
    }
    said
}

/// What was done from one rising to the next.
struct Day<'a> {
    /// When one rose, and when one went to bed.
    up: Micros,
    bed: Option<Micros>,
    noted: Vec<&'a Noted>,
    /// In the night before.
    at_night: Vec<&'a Noted>,
}

impl<'a> Day<'a> {
    fn of(&self, what: &Activity) -> Vec<&'a Noted> {
        self.noted.iter().filter(|noted| noted.what == *what).copied().collect()
    }

    /// The midnight before one rose.
    fn midnight(&self) -> Micros {
        self.up.div_euclid(DAY) * DAY
    }
}

fn days(noted: &[Noted]) -> Vec<Day<'_>> {
    let mut nights: Vec<Range<Micros>> = Vec::new();
    for sleep in noted.iter().filter(|one| one.what == Activity::GoToBed) {
        match nights.last_mut().filter(|night| sleep.begin - night.end <= UP_AT_NIGHT) {
            Some(night) => night.end = night.end.max(sleep.end),
            None => nights.push(sleep.begin..sleep.end),
        }
    }
    nights.retain(|night| night.end - night.start >= SHORTEST_NIGHT);
    let within = |span: Range<Micros>| noted.iter().filter(move |one| span.contains(&one.begin)).collect();
    let day = |(index, night): (usize, &Range<Micros>)| {
        let bed = nights.get(index + 1).map(|next| next.start);
        let (day, night) = (night.end..bed.unwrap_or(Micros::MAX), night.clone());
        Day { up: night.end, bed, noted: within(day), at_night: within(night) }
    };
    nights.iter().enumerate().map(day).collect()
}

fn nights(days: &[Day]) -> Vec<String> {
    let mut said = Vec::new();
    let up: Vec<f64> = days.iter().map(|day| seconds(day.up - day.midnight())).collect();
    let bed: Vec<f64> = days.iter().filter_map(|day| Some(seconds(day.bed? - day.midnight()))).collect();
    for (what, times) in [("gets up", up), ("goes to bed", bed)] {
        if !times.is_empty() {
            said.push(format!("She {what} {}.", clock(&times)));
        }
    }
    let visits = |day: &Day| day.at_night.iter().filter(|one| one.what == Activity::UseBathroom).count() as f64;
    let visits: Vec<f64> = days.iter().map(visits).filter(|&count| count > 0.0).collect();
    let share = visits.len() as f64 / days.len().max(1) as f64;
    if share >= RARE {
        // "On 10 % of nights" says already that it is by night.
        let a_night = if (share * 100.0).round() < 100.0 { "" } else { " a night" };
        let on = on(share, "nights");
        said.push(format!("{on} {} {}{a_night}.", phrase(&Activity::UseBathroom), times(&visits)));
    }
    said
}

/// On which share of days or nights she does something.
fn on(share: f64, what: &str) -> String {
    let percent = (share * 100.0).round();
    if percent < 100.0 { format!("On {} % of {what} she", number(percent)) } else { "She".into() }
}

/// How many times, in words.
fn times(counts: &[f64]) -> String {
    let [least, most] = [0.1, 0.9].map(|share| quantile(counts, share).round());
    match (least, most) {
        (1.0, 1.0) => "once".into(),
        (least, most) if least == most => format!("{} times", number(most)),
        (least, most) => format!("{} to {} times", number(least), number(most)),
    }
}

/// Whether it is a meal whose preparation is noted, too, and says it.
fn is_eaten_after_cooking(what: &Activity, days: &[Day]) -> bool {
    let Activity::Eat(meal) = what else { return false };
    days.iter().any(|day| !day.of(&Activity::Prepare(*meal)).is_empty())
}

fn of_activity(what: &Activity, days: &[Day], mut of: Vec<Vec<&Noted>>) -> Vec<String> {
    let mut said = Vec::new();
    let all = days.len() as f64;
    let soon: Vec<usize> = (0..days.len())
        .filter(|&day| of[day].first().is_some_and(|first| first.begin - days[day].up < AFTER_RISING))
        .collect();
    if soon.len() as f64 >= all / 2.0 && *what != Activity::Leave {
        let firsts: Vec<&Noted> = soon.iter().map(|&day| of[day].remove(0)).collect();
        let after: Vec<f64> =
            soon.iter().zip(&firsts).map(|(&day, first)| seconds(first.begin - days[day].up)).collect();
        let minutes = (mean(&after) / 60.0).round().max(1.0);
        let when = format!(" {} after she gets up", counted(minutes, "minute"));
        said.extend(sentence(what, soon.len() as f64 / all, &when, &firsts, days));
    }
    if let Activity::Prepare(_) | Activity::Eat(_) = what {
        // A meal has one time of the day: two would contradict each other.
        of.iter_mut().for_each(|of| of.truncate(1));
        return if said.is_empty() { at_their_times(what, days, &of) } else { said };
    }
    let lengths: Vec<f64> = of.iter().flatten().map(|one| seconds(one.end - one.begin)).collect();
    // What has no name of its own, such as sitting, is done again and again.
    let is_often = lengths.is_empty() || matches!(what, Activity::Other(_)) || quantile(&lengths, 0.5) < seconds(LONG);
    match is_often {
        true => said.extend(shorter_and_longer(of).iter().filter_map(|of| times_a_day(what, days, of))),
        false => said.extend(at_their_times(what, days, &of)),
    }
    said
}

/// The same twice where few last much longer than most: once the shorter, once the longer, so that each has lengths of its own.
fn shorter_and_longer(of: Vec<Vec<&Noted>>) -> Vec<Vec<Vec<&Noted>>> {
    let length = |one: &Noted| seconds(one.end - one.begin);
    let mut lengths: Vec<f64> = of.iter().flatten().map(|one| length(one)).collect();
    lengths.sort_by(f64::total_cmp);
    if lengths.is_empty() || quantile(&lengths, 0.9) <= SKEWED * quantile(&lengths, 0.5) {
        return vec![of];
    }
    // Where two neighbours are the furthest apart, in times as long, among those that are longer than most.
    let pairs = lengths[lengths.len() / 2..].windows(2);
    let widest = pairs.max_by(|a, b| (a[1] / a[0].max(1.0)).total_cmp(&(b[1] / b[0].max(1.0))));
    let Some(&[_, longer]) = widest else { return vec![of] };
    let part = |is_longer: bool| -> Vec<Vec<&Noted>> {
        let fits = |one: &&Noted| (length(one) >= longer) == is_longer;
        of.iter().map(|of| of.iter().copied().filter(fits).collect()).collect()
    };
    vec![part(false), part(true)]
}

/// Of what is soon done: how many times on such a day.
fn times_a_day(what: &Activity, days: &[Day], of: &[Vec<&Noted>]) -> Option<String> {
    let counts: Vec<f64> = of.iter().map(|of| of.len() as f64).filter(|&count| count > 0.0).collect();
    if counts.is_empty() {
        return None;
    }
    // "On 40 % of days" says already that it is once.
    let when = match times(&counts).as_str() {
        "once" => String::new(),
        times => format!(" {times} a day"),
    };
    let all: Vec<&Noted> = of.iter().flatten().copied().collect();
    sentence(what, counts.len() as f64 / days.len() as f64, &when, &all, days)
}

/// Of what takes long: when the first, the second and so on of a day is.
fn at_their_times(what: &Activity, days: &[Day], of: &[Vec<&Noted>]) -> Vec<String> {
    let most = of.iter().map(Vec::len).max().unwrap_or(0);
    let nth = |nth: usize| {
        let on: Vec<usize> = (0..days.len()).filter(|&day| of[day].len() > nth).collect();
        let times: Vec<f64> = on.iter().map(|&day| seconds(of[day][nth].begin - days[day].midnight())).collect();
        let done: Vec<&Noted> = on.iter().map(|&day| of[day][nth]).collect();
        sentence(what, on.len() as f64 / days.len() as f64, &format!(" {}", clock(&times)), &done, days)
    };
    (0..most).filter_map(nth).collect()
}

/// One sentence: on which share of days, what, when, for how long.
fn sentence(what: &Activity, share: f64, when: &str, done: &[&Noted], days: &[Day]) -> Option<String> {
    if share < RARE {
        return None;
    }
    let lasts = |done: &[&Noted]| {
        let lengths: Vec<f64> = done.iter().map(|one| seconds(one.end - one.begin)).collect();
        span([0.1, 0.9].map(|share| quantile(&lengths, share)))
    };
    let eats = |meal: Meal| {
        let eaten: Vec<&Noted> = days.iter().flat_map(|day| day.of(&Activity::Eat(meal))).collect();
        if eaten.is_empty() { String::new() } else { format!(", then eats {}", lasts(&eaten)) }
    };
    let then = if let Activity::Prepare(meal) = what { eats(*meal) } else { String::new() };
    let on = on(share, "days");
    Some(format!("{on} {}{when} {}{then}.", phrase(what), lasts(done)))
}

/// Seconds since midnight as a time of day, with a triangle of their spread.
fn clock(times_s: &[f64]) -> String {
    let minutes = (mean(times_s) / 60.0).round() as i64;
    let [least, most] = GIVE_OR_TAKE_MIN;
    // The standard deviation of a triangle is its half width over the root of six.
    let give_or_take = (spread(times_s) * 6.0_f64.sqrt() / 60.0).round().clamp(least, most);
    let (hour, minute) = (minutes.div_euclid(60).rem_euclid(24), minutes.rem_euclid(60));
    format!("at about {hour:02}:{minute:02}, give or take {}", counted(give_or_take, "minute"))
}

/// From so many seconds to so many.
fn span([from, to]: [f64; 2]) -> String {
    let (unit, of_unit) = if to < 180.0 { ("second", 1.0) } else { ("minute", 60.0) };
    let [from, to] = [from, to].map(|s| s / of_unit);
    let [from, to] = match unit {
        "second" => [from, to].map(|value| value.round().max(1.0)),
        // A tenth of a minute where minutes would be nothing.
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

/// The standard deviation; of one value nothing.
fn spread(values: &[f64]) -> f64 {
    statistics::sd(values).unwrap_or(0.0)
}

fn quantile(values: &[f64], share: f64) -> f64 {
    statistics::quantile(values, share).unwrap_or(0.0)
}

#[cfg(test)]
mod tests;
