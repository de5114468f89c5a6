//! Simulated older adults at home, compared with measurements of real ones.
//!
//! Each person is measured in the ground truth of the run, and the sensors in their firings. A figure is inside if it lies in the
//! published range; if the source has a mean and a spread, within half the spread of the mean; if it has one number, within 15 %. A
//! spread may differ by half. These rules are our choice. A line without a norm is neither inside nor outside.

mod days;
mod figures;
mod nights;
mod person;
mod published;
mod record;
mod report;
mod sensing;

#[cfg(test)]
mod tests;

pub use days::{DailyFigures, USES};
pub use nights::NightlyFigures;
pub use person::PersonFigures;
pub use record::PersonRecord;
pub use sensing::SensingFigures;

use homebody_core::activity::TimeUse;
use homebody_core::statistics::{mean, sd};
use homebody_picture::{HourShares, RangeFigure, hour_chart, range_chart};
use published::{LINES, PublishedFigure};
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DailyLifeExperiment {
    pub people: usize,
    /// Days that count: the first day does not.
    pub days: usize,
    pub seed: u64,
    pub lines: Vec<FigureLine>,
    /// The share of each hour of the day that goes into each use of time, over all people.
    pub by_hour: Vec<Vec<f64>>,
    pub uses: [TimeUse; USES],
    pub persons: Vec<PersonFigures>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureLine {
    pub of: &'static str,
    pub what: &'static str,
    pub unit: &'static str,
    pub published: &'static str,
    pub source: &'static str,
    /// The range that counts as inside; `None` without a norm.
    pub range: Option<[f64; 2]>,
    /// `None` if the simulation is too short.
    pub ours: Option<f64>,
    /// The standard deviation between people.
    pub between: Option<f64>,
    /// `None` without a norm or a value.
    pub inside: Option<bool>,
    /// A reason why our value may lie outside.
    pub guess: &'static str,
}

impl DailyLifeExperiment {
    pub fn from_people(persons: Vec<PersonFigures>, seed: u64) -> DailyLifeExperiment {
        let by_hour = (0..24).map(|hour| {
            let share =
                |of: usize| mean(&persons.iter().map(|person| person.days.by_hour[hour][of]).collect::<Vec<_>>());
            (0..USES).map(|of| share(of).unwrap_or(0.0)).collect()
        });
        DailyLifeExperiment {
            people: persons.len(),
            days: persons.first().map_or(0, |person| person.days.days),
            seed,
            lines: LINES.iter().map(|published| FigureLine::new(published, &persons)).collect(),
            by_hour: by_hour.collect(),
            uses: TimeUse::ALL,
            persons,
        }
    }

    pub fn outside(&self) -> impl Iterator<Item = &FigureLine> {
        self.lines.iter().filter(|line| line.inside == Some(false))
    }

    pub fn chart(&self) -> String {
        let measured = self.lines.iter().filter_map(|line| {
            let [low, high] = line.range?;
            let words = format!("{}: {}", figures::number(line.ours?, line.unit), line.published);
            Some(RangeFigure { label: line.what.into(), words, low, high, value: line.ours? })
        });
        let title = format!("{} generated older adults beside published figures", self.people);
        range_chart(&title, &measured.collect::<Vec<_>>())
    }

    pub fn hours(&self) -> String {
        let names: Vec<String> = TimeUse::ALL.iter().map(|of| of.in_words().into()).collect();
        let title = format!("The day of {} generated older adults", self.people);
        hour_chart(&title, &HourShares { names, shares: self.by_hour.clone() })
    }
}

impl FigureLine {
    fn new(published: &PublishedFigure, persons: &[PersonFigures]) -> FigureLine {
        let PublishedFigure { of, what, unit, says, source, range, guess, figure } = *published;
        let (ours, between) = figure.value(persons);
        let inside = range.zip(ours).map(|([low, high], ours)| (low..=high).contains(&ours));
        FigureLine { of, what, unit, published: says, source, range, ours, between, inside, guess }
    }
}

impl published::FigureSource {
    /// The figure of all people, and its spread between people if the figure is a mean.
    fn value(self, persons: &[PersonFigures]) -> (Option<f64>, Option<f64>) {
        match self {
            published::FigureSource::Mean(of) => {
                let each: Vec<f64> = persons.iter().filter_map(of).collect();
                (mean(&each), sd(&each))
            }
            published::FigureSource::Spread(of) => (sd(&persons.iter().filter_map(of).collect::<Vec<_>>()), None),
            published::FigureSource::Whole(of) => (of(persons), None),
        }
    }
}
