//! The measures of claims, and their bounds.
//!
//! Bounds that the words of a sentence give are widened by chance and by the way there alone: a share of days by three standard
//! errors of so many days; a time of day by [`GRACE_MIN`], since what is being done is finished first and then walked from; a
//! length by a tenth, as "for 20 minutes" is give or take that much; "every day" leaves out one day in twenty.

use super::life::{Life, Occurrence};
use super::subject::{Filter, Range, Subject, clock_range, number, range, scaled};
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

/// The measure of a claim.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// On this share of the days or nights that count; three standard errors are added.
    OnDays {
        share: f64,
        nights: bool,
    },
    /// On so many days of each week.
    DaysAWeek(usize),
    /// So many in all.
    Times(Range),
    /// So many on a day or night that counts.
    TimesADay {
        range: Range,
        nights: bool,
    },
    /// Most begin then, in minutes of the day.
    Begins(Range),
    /// The mean, and the standard deviation, of when they begin, in minutes of the day.
    BeginsOnAverage(Range),
    Spread(Range),
    /// Most end then.
    Ends(Range),
    /// The mean and the longest, in minutes, and of most.
    Lasts(Range),
    Longest(Range),
    Mostly(Range),
    /// Minutes a day.
    Minutes(Range),
    /// Most begin so many minutes after the end, before the beginning, or after the beginning of another activity.
    After(String, Range),
    Before(String, Range),
    With(String, Range),
    /// Most of the time it is done in this room.
    In(String),
    /// A number of each day, on average.
    Is(Range),
}

impl Measure {
    pub fn read(text: &str) -> Result<Measure, String> {
        let words: Vec<&str> = text.split(' ').collect();
        let no_clock = || format!("no times of day in {text:?}");
        Ok(match *words {
            ["every", span @ ("day" | "night")] => Measure::OnDays { share: 1.0, nights: span == "night" },
            ["never"] => Measure::Times((0.0, 0.0)),
            ["on", share, "%", "of", span @ ("days" | "nights")] => {
                Measure::OnDays { share: number(share)? / 100.0, nights: span == "nights" }
            }
            ["on", days, "days", "a", "week"] => Measure::DaysAWeek(number(days)? as usize),
            [times, "times"] => Measure::Times(range(times)?),
            [times, "times", "a", span @ ("day" | "night")] => {
                Measure::TimesADay { range: range(times)?, nights: span == "night" }
            }
            ["begins", clocks] => Measure::Begins(clock_range(clocks).ok_or_else(no_clock)?),
            ["begins", "on", "average", clocks] => Measure::BeginsOnAverage(clock_range(clocks).ok_or_else(no_clock)?),
            ["begins", by, "min"] => Measure::BeginsOnAverage(range(by)?),
            ["spread", by, "min"] => Measure::Spread(range(by)?),
            ["spread", by] => Measure::Spread(range(by)?),
            ["ends", clocks] => Measure::Ends(clock_range(clocks).ok_or_else(no_clock)?),
            ["lasts", by] => Measure::Lasts(range(by)?),
            ["lasts", by, unit] => Measure::Lasts(scaled(by, unit)?),
            ["mostly", by, unit] => Measure::Mostly(scaled(by, unit)?),
            ["longest", by, unit] => Measure::Longest(scaled(by, unit)?),
            ["times", by] => Measure::TimesADay { range: range(by)?, nights: false },
            [by, unit, "a", "day"] => Measure::Minutes(scaled(by, unit)?),
            ["time", by] | [by] => Measure::Minutes(range(by)?),
            ["after", other, by, "min"] => Measure::After(other.to_owned(), range(by)?),
            ["before", other, by, "min"] => Measure::Before(other.to_owned(), range(by)?),
            ["with", other, by, "min"] => Measure::With(other.to_owned(), range(by)?),
            ["in", ..] => Measure::In(words[1..].join(" ")),
            ["is", by] => Measure::Is(range(by)?),
            _ => return Err(format!("there is no such measure as {text:?}")),
        })
    }

    /// The number of days, weeks or times of which a share is measured.
    pub fn many(&self, life: &Life, who: usize, subject: &Subject, filter: &Filter) -> f64 {
        let nights = self.is_of_nights();
        let many = match self {
            Measure::OnDays { .. } => life.days(filter, nights).len(),
            Measure::DaysAWeek(_) => life.whole_weeks().len(),
            _ => life.occurrences(who, subject, filter, nights).len(),
        };
        many as f64
    }

    /// The bounds that a measured value has to lie within, of so many days, weeks or times.
    pub fn bounds(&self, many: f64, is_twin: bool) -> Range {
        match self {
            Measure::OnDays { share, .. } if *share >= 1.0 => (all_but_a_few(many, EVERY), 1.0),
            Measure::OnDays { share, .. } => {
                let error = ERRORS * (share * (1.0 - share) / many.max(1.0)).sqrt();
                ((share - error).max(0.0), (share + error).min(1.0))
            }
            Measure::DaysAWeek(_)
            | Measure::Begins(_)
            | Measure::Ends(_)
            | Measure::After(..)
            | Measure::Before(..)
            | Measure::With(..)
            | Measure::Mostly(_)
            | Measure::In(_) => (all_but_a_few(many, MOST_OF_THEM), 1.0),
            Measure::Lasts(range) if !is_twin => (range.0 * (1.0 - OF_LENGTH), range.1 * (1.0 + OF_LENGTH)),
            Measure::Times(range)
            | Measure::TimesADay { range, .. }
            | Measure::BeginsOnAverage(range)
            | Measure::Spread(range)
            | Measure::Lasts(range)
            | Measure::Longest(range)
            | Measure::Minutes(range)
            | Measure::Is(range) => *range,
        }
    }

    /// The measured value.
    pub fn of(&self, life: &Life, who: usize, subject: &Subject, filter: &Filter) -> f64 {
        if let Measure::Is(_) = self {
            return mean(&life.daily(who, subject, filter));
        }
        let nights = matches!(self, Measure::OnDays { nights: true, .. } | Measure::TimesADay { nights: true, .. });
        let all = life.occurrences(who, subject, filter, nights);
        let share =
            |holds: &dyn Fn(&Occurrence) -> bool| all.iter().filter(|one| holds(one)).count() as f64 / all.len() as f64;
        let minutes = |span: Span| span.ratio(MINUTE);
        let days = life.days(filter, nights).len() as f64;
        let begins = |range: &Range| -> Vec<f64> { all.iter().map(|one| near(one.clock_min(), *range)).collect() };
        match self {
            Measure::OnDays { .. } => {
                let mut on: Vec<i32> = all.iter().map(|one| one.day).collect();
                on.dedup();
                on.len() as f64 / days
            }
            Measure::DaysAWeek(each) => weeks_with(&all, life, *each),
            Measure::Times(_) => all.len() as f64,
            Measure::TimesADay { .. } => all.len() as f64 / days,
            Measure::Begins(range) => share(&|one| is_then(one.clock_min(), *range)),
            // A person does not return to an activity that was interrupted shortly before its end.
            Measure::Ends((from, to)) => {
                let range = (from - GRACE_MIN, *to);
                share(&|one| is_then(minutes(one.time.end - life.midnight(one.time.end)), range))
            }
            // The day is a circle: by how much each is before or after the first.
            Measure::BeginsOnAverage(_) => {
                let first = all.first().map_or(0.0, Occurrence::clock_min);
                mean(&usual(begins(&(first, first))))
            }
            Measure::Spread(_) => {
                let first = all.first().map_or(0.0, Occurrence::clock_min);
                spread(&usual(begins(&(first, first))))
            }
            Measure::Lasts(_) => mean(&all.iter().map(|one| minutes(one.lasted)).collect::<Vec<_>>()),
            Measure::Longest(_) => all.iter().map(|one| minutes(one.time.length())).fold(0.0, f64::max),
            Measure::Mostly((from, to)) => share(&|one| (*from..=*to).contains(&minutes(one.time.length()))),
            Measure::Minutes(_) => all.iter().map(|one| minutes(one.lasted)).sum::<f64>() / days,
            Measure::After(other, range) => {
                let others = life.spans(who, &Subject::Activity(other.clone()));
                share(&|one| {
                    let last = others.iter().map(|of| of.time.end).filter(|end| *end <= one.time.begin).max();
                    last.is_some_and(|last| is_within(minutes(one.time.begin - last), *range))
                })
            }
            Measure::Before(other, range) => {
                let others = life.spans(who, &Subject::Activity(other.clone()));
                share(&|one| {
                    let next = others.iter().find(|of| of.time.begin >= one.time.begin);
                    next.is_some_and(|next| is_within(minutes(next.time.begin - one.time.begin), *range))
                })
            }
            Measure::With(other, range) => {
                let others = life.spans(who, &Subject::Activity(other.clone()));
                let off = |one: &Occurrence, of: &Occurrence| minutes(one.time.begin - of.time.begin);
                share(&|one| others.iter().any(|of| (range.0..=range.1).contains(&off(one, of))))
            }
            Measure::In(room) => {
                let [there, all] = all.iter().fold([Span::ZERO; 2], |[there, all], one| {
                    // Other places in the meantime do not count.
                    [there + life.time_in(who, room, one.time).min(one.lasted), all + one.lasted]
                });
                there.ratio(all)
            }
            Measure::Is(_) => f64::NAN,
        }
    }
}

/// The share of whole weeks that have it on so many days.
fn weeks_with(all: &[Occurrence], life: &Life, each: usize) -> f64 {
    let weeks = life.whole_weeks();
    let on = |monday: i32| (monday..monday + 7).filter(|day| all.iter().any(|one| one.day == *day)).count() == each;
    weeks.iter().filter(|monday| on(**monday)).count() as f64 / weeks.len() as f64
}

/// A minute of the day as the one of its days that lies nearest to a range.
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

/// A share as a whole number of so many, of which one may be missed where there are some.
fn all_but_a_few(many: f64, share: f64) -> f64 {
    /// Number of cases below which none may be missed (our choice).
    const SOME: f64 = 5.0;
    let missed = (many * (1.0 - share) + 1e-9).floor();
    let missed = if many >= SOME { missed.max(1.0) } else { missed };
    1.0 - missed / many.max(1.0)
}

/// Times without the one in twenty that lie farthest from their middle, as "every day" leaves out as many.
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
