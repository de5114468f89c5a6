//! Generated older adults, lived at home, beside what was measured of real ones.
//!
//! Each person is measured from the truth of their run, and their sensors from what these say. Each figure stands beside
//! the published one: where a source gives a range, ours lies inside or not; where it gives a mean and a spread, ours may
//! be off by half that spread; where it gives one number, by 15 %; and a spread may be off by half (these rules are ours).
//! A line without a known norm says so, and is neither inside nor outside.

mod days;
mod figures;
mod life;
mod nights;
mod person;
mod published;
mod report;
mod sensing;

#[cfg(test)]
mod tests;

pub use days::{Days, USES};
pub use life::Lived;
pub use nights::Nights;
pub use person::Person;
pub use sensing::Sensing;

use homebody_core::activity::TimeUse;
use homebody_core::statistics::{mean, sd};
use homebody_picture::{HourShares, RangeFigure, hour_chart, range_chart};
use published::{LINES, Published};
use serde::Serialize;

/// Everything the experiment found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Experiment {
    pub people: usize,
    /// Those that count: the first is left out.
    pub days: usize,
    pub seed: u64,
    pub lines: Vec<Line>,
    /// The share of each hour of the day that goes into each use of time, over all people.
    pub by_hour: Vec<Vec<f64>>,
    pub uses: [TimeUse; USES],
    pub persons: Vec<Person>,
}

/// One figure beside the published one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Line {
    pub of: &'static str,
    pub what: &'static str,
    pub unit: &'static str,
    /// As the source has it, in its words.
    pub published: &'static str,
    pub source: &'static str,
    /// The range that counts as inside; `None` without a norm.
    pub range: Option<[f64; 2]>,
    /// Nothing where too little was lived to tell.
    pub ours: Option<f64>,
    /// The standard deviation between people.
    pub between: Option<f64>,
    /// Nothing where it cannot be said.
    pub inside: Option<bool>,
    /// Reason why our value may lie outside.
    pub guess: &'static str,
}

impl Experiment {
    /// Holds people, each measured, beside what was published.
    pub fn of(persons: Vec<Person>, seed: u64) -> Experiment {
        let by_hour = (0..24).map(|hour| {
            let share =
                |of: usize| mean(&persons.iter().map(|person| person.days.by_hour[hour][of]).collect::<Vec<_>>());
            (0..USES).map(|of| share(of).unwrap_or(0.0)).collect()
        });
        Experiment {
            people: persons.len(),
            days: persons.first().map_or(0, |person| person.days.days),
            seed,
            lines: LINES.iter().map(|published| Line::of(published, &persons)).collect(),
            by_hour: by_hour.collect(),
            uses: TimeUse::ALL,
            persons,
        }
    }

    /// The lines that lie outside.
    pub fn outside(&self) -> impl Iterator<Item = &Line> {
        self.lines.iter().filter(|line| line.inside == Some(false))
    }

    /// Each figure beside what was published of it.
    pub fn chart(&self) -> String {
        let measured = self.lines.iter().filter_map(|line| {
            let [low, high] = line.range?;
            let words = format!("{}: {}", figures::number(line.ours?, line.unit), line.published);
            Some(RangeFigure { label: line.what.into(), words, low, high, value: line.ours? })
        });
        let title = format!("{} generated older adults beside published figures", self.people);
        range_chart(&title, &measured.collect::<Vec<_>>())
    }

    /// The use of the hours of the day.
    pub fn hours(&self) -> String {
        let names: Vec<String> = TimeUse::ALL.iter().map(|of| of.in_words().into()).collect();
        let title = format!("The day of {} generated older adults", self.people);
        hour_chart(&title, &HourShares { names, shares: self.by_hour.clone() })
    }
}

impl Line {
    fn of(published: &Published, persons: &[Person]) -> Line {
        let Published { of, what, unit, says, source, range, guess, figure } = *published;
        let (ours, between) = figure.of(persons);
        let inside = range.zip(ours).map(|([low, high], ours)| (low..=high).contains(&ours));
        Line { of, what, unit, published: says, source, range, ours, between, inside, guess }
    }
}

impl published::Figure {
    /// The figure of all people, and its spread between them where it is a mean of theirs.
    fn of(self, persons: &[Person]) -> (Option<f64>, Option<f64>) {
        match self {
            published::Figure::Mean(of) => {
                let each: Vec<f64> = persons.iter().filter_map(of).collect();
                (mean(&each), sd(&each))
            }
            published::Figure::Spread(of) => (sd(&persons.iter().filter_map(of).collect::<Vec<_>>()), None),
            published::Figure::Whole(of) => (of(persons), None),
        }
    }
}
