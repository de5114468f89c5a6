//! The measures of claims, and their bounds.
//!
//! Bounds from the words of a sentence are widened only by chance and by walking time: a share of days by three standard errors; a time
//! of day by [`GRACE_MIN`], because a person finishes the previous activity and walks; a length by a tenth, because "for 20 minutes" is
//! approximate. "Every day" allows one day in twenty without the activity.

use super::subject::{Filter, Range, Subject, clock_range, number, range, scaled};
use super::truth::{ClaimTruth, Occurrence};
use homebody_core::time::{DAY, MINUTE, Span};

/// Largest delay of an activity that is still in time, in minutes (our choice): the previous one is finished first, and
/// a walk follows.
pub const GRACE_MIN: f64 = 15.0;

/// Share of the activities with a time that keep it (our choice).
pub const MOST_OF_THEM: f64 = 0.9;

/// Share of the days that counts as every day (our choice).
pub const EVERY: f64 = 0.95;

/// Standard errors allowed for chance (our choice): of a thousand true claims, three appear false.
pub const ERRORS: f64 = 3.0;

/// Tolerance of a length, as a share (our choice).
const OF_LENGTH: f64 = 0.1;

#[derive(Clone, Debug, PartialEq)]
pub enum ClaimMeasure {
    /// The share of days or nights; three standard errors are added.
    OnDays {
        share: f64,
        nights: bool,
    },
    DaysAWeek(usize),
    Times(Range),
    TimesADay {
        range: Range,
        nights: bool,
    },
    /// Most start then, in minutes of the day.
    Begins(Range),
    /// The mean, and the standard deviation, of their start, in minutes of the day.
    BeginsOnAverage(Range),
    Spread(Range),
    /// Most end then.
    Ends(Range),
    /// The mean and the longest, in minutes, and of most.
    Lasts(Range),
    Longest(Range),
    Mostly(Range),
    Minutes(Range),
    /// Minutes from the end, to the start, or from the start of another activity, for most of them.
    After(String, Range),
    Before(String, Range),
    With(String, Range),
    /// The room, for most of the time.
    In(String),
    Is(Range),
}

impl ClaimMeasure {
    pub fn read(text: &str) -> Result<ClaimMeasure, String> {
        let words: Vec<&str> = text.split(' ').collect();
        let no_clock = || format!("no times of day in {text:?}");
        Ok(match *words {
            ["every", span @ ("day" | "night")] => Self::OnDays { share: 1.0, nights: span == "night" },
            ["never"] => Self::Times((0.0, 0.0)),
            ["on", share, "%", "of", span @ ("days" | "nights")] => {
                Self::OnDays { share: number(share)? / 100.0, nights: span == "nights" }
            }
            ["on", days, "days", "a", "week"] => Self::DaysAWeek(number(days)? as usize),
            [times, "times"] => Self::Times(range(times)?),
            [times, "times", "a", span @ ("day" | "night")] => {
                Self::TimesADay { range: range(times)?, nights: span == "night" }
            }
            ["begins", clocks] => Self::Begins(clock_range(clocks).ok_or_else(no_clock)?),
            ["begins", "on", "average", clocks] => Self::BeginsOnAverage(clock_range(clocks).ok_or_else(no_clock)?),
            ["begins", by, "min"] => Self::BeginsOnAverage(range(by)?),
            ["spread", by, "min"] => Self::Spread(range(by)?),
            ["spread", by] => Self::Spread(range(by)?),
            ["ends", clocks] => Self::Ends(clock_range(clocks).ok_or_else(no_clock)?),
            ["lasts", by] => Self::Lasts(range(by)?),
            ["lasts", by, unit] => Self::Lasts(scaled(by, unit)?),
            ["mostly", by, unit] => Self::Mostly(scaled(by, unit)?),
            ["longest", by, unit] => Self::Longest(scaled(by, unit)?),
            ["times", by] => Self::TimesADay { range: range(by)?, nights: false },
            [by, unit, "a", "day"] => Self::Minutes(scaled(by, unit)?),
            ["time", by] | [by] => Self::Minutes(range(by)?),
            ["after", other, by, "min"] => Self::After(other.to_owned(), range(by)?),
            ["before", other, by, "min"] => Self::Before(other.to_owned(), range(by)?),
            ["with", other, by, "min"] => Self::With(other.to_owned(), range(by)?),
            ["in", ..] => Self::In(words[1..].join(" ")),
            ["is", by] => Self::Is(range(by)?),
            _ => return Err(format!("there is no such measure as {text:?}")),
        })
    }

    /// The number of days, weeks or times that a share refers to.
    pub fn many(&self, life: &ClaimTruth, who: usize, subject: &Subject, filter: &Filter) -> f64 {
        let nights = self.is_of_nights();
        let many = match self {
            Self::OnDays { .. } => life.days(filter, nights).len(),
            Self::DaysAWeek(_) => life.whole_weeks().len(),
            _ => life.occurrences(who, subject, filter, nights).len(),
        };
        many as f64
    }

    /// The bounds of a measured value of `many` days, weeks or times.
    pub fn bounds(&self, many: f64, is_twin: bool) -> Range {
        match self {
            Self::OnDays { share, .. } if *share >= 1.0 => (all_but_a_few(many, EVERY), 1.0),
            Self::OnDays { share, .. } => {
                let error = ERRORS * (share * (1.0 - share) / many.max(1.0)).sqrt();
                ((share - error).max(0.0), (share + error).min(1.0))
            }
            Self::DaysAWeek(_)
            | Self::Begins(_)
            | Self::Ends(_)
            | Self::After(..)
            | Self::Before(..)
            | Self::With(..)
            | Self::Mostly(_)
            | Self::In(_) => (all_but_a_few(many, MOST_OF_THEM), 1.0),
            Self::Lasts(range) if !is_twin => (range.0 * (1.0 - OF_LENGTH), range.1 * (1.0 + OF_LENGTH)),
            Self::Times(range)
            | Self::TimesADay { range, .. }
            | Self::BeginsOnAverage(range)
            | Self::Spread(range)
            | Self::Lasts(range)
            | Self::Longest(range)
            | Self::Minutes(range)
            | Self::Is(range) => *range,
        }
    }

    pub fn value(&self, life: &ClaimTruth, who: usize, subject: &Subject, filter: &Filter) -> f64 {
        if let Self::Is(_) = self {
            return mean(&life.daily(who, subject, filter));
        }
        let nights = self.is_of_nights();
        let all = life.occurrences(who, subject, filter, nights);
        let share =
            |holds: &dyn Fn(&Occurrence) -> bool| all.iter().filter(|one| holds(one)).count() as f64 / all.len() as f64;
        let minutes = |span: Span| span.ratio(MINUTE);
        let days = life.days(filter, nights).len() as f64;
        let begins = |range: &Range| -> Vec<f64> { all.iter().map(|one| near(one.clock_min, *range)).collect() };
        match self {
            Self::OnDays { .. } => {
                let mut on: Vec<i32> = all.iter().map(|one| one.day).collect();
                on.dedup();
                on.len() as f64 / days
            }
            Self::DaysAWeek(each) => weeks_with(&all, life, *each),
            Self::Times(_) => all.len() as f64,
            Self::TimesADay { .. } => all.len() as f64 / days,
            Self::Begins(range) => share(&|one| is_then(one.clock_min, *range)),
            // A person does not return to an activity that was interrupted shortly before its end.
            Self::Ends((from, to)) => {
                let range = (from - GRACE_MIN, *to);
                share(&|one| is_then(minutes(one.time.end - life.midnight(one.time.end)), range))
            }
            // The day is a circle: by how much each is before or after the first.
            Self::BeginsOnAverage(_) => {
                let first = all.first().map_or(0.0, |one| one.clock_min);
                mean(&usual(begins(&(first, first))))
            }
            Self::Spread(_) => {
                let first = all.first().map_or(0.0, |one| one.clock_min);
                spread(&usual(begins(&(first, first))))
            }
            Self::Lasts(_) => mean(&all.iter().map(|one| minutes(one.lasted)).collect::<Vec<_>>()),
            Self::Longest(_) => all.iter().map(|one| minutes(one.time.length())).fold(0.0, f64::max),
            Self::Mostly((from, to)) => share(&|one| (*from..=*to).contains(&minutes(one.time.length()))),
            Self::Minutes(_) => all.iter().map(|one| minutes(one.lasted)).sum::<f64>() / days,
            Self::After(other, range) => {
                let others = life.spans(who, &Subject::Activity(other.clone()));
                share(&|one| {
                    let last = others.iter().map(|of| of.time.end).filter(|end| *end <= one.time.begin).max();
                    last.is_some_and(|last| is_within(minutes(one.time.begin - last), *range))
                })
            }
            Self::Before(other, range) => {
                let others = life.spans(who, &Subject::Activity(other.clone()));
                share(&|one| {
                    let next = others.iter().find(|of| of.time.begin >= one.time.begin);
                    next.is_some_and(|next| is_within(minutes(next.time.begin - one.time.begin), *range))
                })
            }
            Self::With(other, range) => {
                let others = life.spans(who, &Subject::Activity(other.clone()));
                let off = |one: &Occurrence, of: &Occurrence| minutes(one.time.begin - of.time.begin);
                share(&|one| others.iter().any(|of| (range.0..=range.1).contains(&off(one, of))))
            }
            Self::In(room) => {
                let [there, all] = all.iter().fold([Span::ZERO; 2], |[there, all], one| {
                    // Other places in the meantime do not count.
                    [there + life.time_in(who, room, one.time).min(one.lasted), all + one.lasted]
                });
                there.ratio(all)
            }
            Self::Is(_) => f64::NAN,
        }
    }
}

/// The share of whole weeks with the right number of days.
fn weeks_with(all: &[Occurrence], life: &ClaimTruth, each: usize) -> f64 {
    let weeks = life.whole_weeks();
    let on = |monday: i32| (monday..monday + 7).filter(|day| all.iter().any(|one| one.day == *day)).count() == each;
    weeks.iter().filter(|monday| on(**monday)).count() as f64 / weeks.len() as f64
}

/// The minute of the day that is nearest to a range, on any day.
fn near(minute: f64, (from, to): Range) -> f64 {
    let middle = (from + to) / 2.0;
    let day = (DAY / MINUTE) as f64;
    (minute - middle + 1.5 * day).rem_euclid(day) - day / 2.0 + middle
}

fn is_then(minute: f64, range: Range) -> bool {
    is_within(near(minute, range), range)
}

fn is_within(minutes: f64, (from, to): Range) -> bool {
    (from - 1.0..=to + GRACE_MIN).contains(&minutes)
}

/// A share as a whole number of `many`; one may be missing if there are some.
fn all_but_a_few(many: f64, share: f64) -> f64 {
    /// Number of cases below which none may be missed (our choice).
    const SOME: f64 = 5.0;
    let missed = (many * (1.0 - share) + 1e-9).floor();
    let missed = if many >= SOME { missed.max(1.0) } else { missed };
    1.0 - missed / many.max(1.0)
}

/// The times without the 5 % that are farthest from their middle, as "every day" also allows.
fn usual(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    let middle = values.get(values.len() / 2).copied().unwrap_or_default();
    values.sort_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs()));
    values.truncate((values.len() as f64 * EVERY).ceil() as usize);
    values
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn spread(values: &[f64]) -> f64 {
    let mean = mean(values);
    (values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / values.len() as f64).sqrt()
}
