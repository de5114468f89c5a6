//! Activities recognised in a real home after training on simulated days alone.
//!
//! The home is a flat of one adult with a public log and annotations ("ADLs Recognition Using Binary Sensors", Ordonez, de Toledo and
//! Sanchis 2013, home A), built as a scenario. A routine is written from the first half of its days. A random forest
//! (`homebody_analysis::forest`) learns classes of activities from windows of five minutes. Its score on the second half is the mean F1 of
//! the classes, after training on simulated days, on the real first half, on three days of that half, and on simulated days with these
//! three.
//!
//! We assume that a class counts if it has a few windows in each half, and that windows without an annotation have no class.
//!
//! Left out: the rest of the data set, a second home with people whom these sensors do not describe as well.

mod classes;
mod diary;
mod flat;
mod report;
mod score;
mod windows;

pub use classes::CLASSES;
use classes::COUNT;
use flat::Flat;
pub use flat::FlatError;
use homebody_analysis::forest::{Examples, Forest};
use homebody_core::random::Stream;
use homebody_core::statistics::{mean, sd};
use homebody_core::time::{DAY, Interval, Span, WallTime};
use homebody_log::Log;
use homebody_routine::rhythm::sentences;
pub use score::Confusion;
use serde::Serialize;
use windows::{Window, ons, windows};

/// Smallest number of windows in each half of a class that counts (our choice).
const LEAST_WINDOWS: usize = 5;
/// Trees of a forest.
const TREES: usize = 200;
/// Days of a recogniser that knows little of a home.
const FEW_DAYS: usize = 3;

pub const LEARNT_FROM: [&str; 4] =
    ["simulated days", "real first half", "three real days", "simulated days and these three"];

homebody_core::messages! {
    /// Reasons why the experiment with recognisers is not possible.
    pub enum RecogniserError in "recogniser" {
        /// A recogniser is trained on activities that people noted. The data set has them in a file of its own, next to the file of the
        /// sensors.
        NoActivities error "no-activities" ("the log has no activities")
            hint ("put the file of activities, such as OrdonezA_ADLs.txt, into the folder of the log");
        /// The experiment trains on the first half of the days, and tests on the second. Each half must have some days.
        TooFewDays(days: i64) error "too-few-days" ("the log has only {days} days, and each of its halves needs {FEW_DAYS} days");
        /// The experiment simulates the flat of home A of the data set, with all its sensors. The log must have the same.
        NoSensor(sensor: String) error "no-sensor" ("the log has no sensor {sensor:?}")
            hint ("name the log of home A of the data set");
        => inner {
            /// The flat cannot be simulated.
            Flat(FlatError);
        }
    }
}

from_errors!(RecogniserError: Flat(FlatError));

/// The real days, and the flat with the routine from their first half.
pub struct Prepared {
    flat: Flat,
    pub routine: String,
    halves: [Vec<Window>; 2],
    first: Interval<WallTime>,
    classes: Vec<usize>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RecogniserCase {
    pub seed: u64,
    /// In the order of [`LEARNT_FROM`].
    pub macro_f1: [f64; 4],
    /// Counts of windows, in the same order.
    pub confusion: [Confusion; 4],
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RecogniserExperiment {
    pub simulated_days: u32,
    /// Real days of each half.
    pub real_days: [usize; 2],
    pub routine: String,
    /// The classes that count, by name.
    pub classes: Vec<&'static str>,
    /// By training data: the mean score and its spread between seeds.
    pub scores: Vec<Score>,
    pub cases: Vec<RecogniserCase>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Score {
    pub learnt_from: &'static str,
    /// The mean over the seeds.
    pub macro_f1: f64,
    /// The standard deviation between seeds.
    pub spread: f64,
    /// The mean, relative to that of the real first half.
    pub of_real: f64,
    /// The F1 of each class that counts, all seeds together.
    pub f1: Vec<f64>,
    /// The windows of each class, by row, and their predicted class, by column, per seed.
    pub confusion: Vec<Vec<f64>>,
}

impl Prepared {
    /// Splits a log of the flat into halves, and writes the routine.
    pub fn new(log: &Log) -> Result<Prepared, RecogniserError> {
        let begins =
            log.activities.iter().map(|activity| activity.begin()).min().ok_or(RecogniserError::NoActivities)?;
        let ends = log.activities.iter().map(|activity| activity.end()).max().unwrap_or(begins);
        let (first_day, last_day) = (begins.day_number(), (ends - Span::MICROSECOND).day_number() + 1);
        let half = (last_day - first_day) / 2;
        if half < FEW_DAYS as i64 {
            return Err(RecogniserError::TooFewDays(last_day - first_day));
        }
        let midnight = |day: i64| WallTime::EPOCH + day * DAY;
        let spans = [(first_day, first_day + half), (first_day + half, last_day)]
            .map(|(from, until)| Interval::new(midnight(from), midnight(until)));
        let sensors = Flat::new("")?;
        if let Some(missing) = sensors.sensors.iter().find(|name| !log.sensors.contains(name)) {
            return Err(RecogniserError::NoSensor(missing.clone()));
        }
        let all = ons(log, &sensors.sensors);
        let kitchen: Vec<_> = all.iter().filter(|on| sensors.in_kitchen[on.sensor]).copied().collect();
        let noted = diary::diary_entries(&log.activities, &kitchen, spans[0]);
        let routine = sentences(&noted, &diary::known()).join("\n") + "\n";
        let halves = spans.map(|span| windows(log, &sensors.sensors, span));
        let has_enough = |class: &usize| {
            let count = |half: &Vec<Window>| half.iter().filter(|window| window.class == *class).count();
            halves.iter().all(|half| count(half) >= LEAST_WINDOWS)
        };
        let classes = (0..COUNT).filter(has_enough).collect();
        Ok(Prepared { flat: Flat::new(&routine)?, routine, halves, first: spans[0], classes })
    }

    pub fn case(&self, seed: u64, days: u32) -> Result<RecogniserCase, RecogniserError> {
        // The first day starts at midnight without a history.
        let log = self.flat.simulate(seed, days + 1, self.first.begin - DAY)?;
        let span = Interval::starting(self.first.begin, i64::from(days) * DAY);
        let simulated = windows(&log, &self.flat.sensors, span);
        let [first, second] = &self.halves;
        let few = few_days(first, seed);
        let learnt: [Vec<&Window>; 4] =
            [simulated.iter().collect(), first.iter().collect(), few.clone(), simulated.iter().chain(few).collect()];
        let confusion = learnt.map(|learnt| confusion_of(&learnt, second, seed));
        let macro_f1 = confusion.each_ref().map(|confusion| confusion.macro_f1(&self.classes));
        Ok(RecogniserCase { seed, macro_f1, confusion })
    }

    pub fn experiment(&self, cases: Vec<RecogniserCase>, simulated_days: u32) -> RecogniserExperiment {
        let scores = |which: usize| cases.iter().map(|case| case.macro_f1[which]).collect::<Vec<f64>>();
        let mean_of = |which: usize| mean(&scores(which)).unwrap_or(0.0);
        let score = |which: usize| {
            let macro_f1 = mean_of(which);
            let all = Confusion::sum(cases.iter().map(|case| &case.confusion[which]));
            let per_seed = |is: &usize| {
                self.classes.iter().map(|&class| f64::from(all.0[*is][class]) / cases.len().max(1) as f64).collect()
            };
            Score {
                learnt_from: LEARNT_FROM[which],
                macro_f1,
                spread: sd(&scores(which)).unwrap_or(0.0),
                of_real: macro_f1 / mean_of(1),
                f1: self.classes.iter().map(|&class| all.f1(class).unwrap_or(0.0)).collect(),
                confusion: self.classes.iter().map(per_seed).collect(),
            }
        };
        RecogniserExperiment {
            simulated_days,
            real_days: self.halves.each_ref().map(|half| days_of(half).len()),
            routine: self.routine.clone(),
            classes: self.classes.iter().map(|&class| CLASSES[class]).collect(),
            scores: (0..LEARNT_FROM.len()).map(score).collect(),
            cases,
        }
    }
}

fn few_days(windows: &[Window], seed: u64) -> Vec<&Window> {
    let mut days = days_of(windows);
    let stream = &mut Stream::named(seed, "recogniser/days");
    while days.len() > FEW_DAYS {
        days.remove((stream.unit() * days.len() as f64) as usize % days.len());
    }
    windows.iter().filter(|window| days.contains(&window.begin.day_number())).collect()
}

fn days_of(windows: &[Window]) -> Vec<i64> {
    let mut days: Vec<i64> = windows.iter().map(|window| window.begin.day_number()).collect();
    days.dedup();
    days
}

fn confusion_of(learnt: &[&Window], judged: &[Window], seed: u64) -> Confusion {
    let figures: Vec<Vec<f64>> = learnt.iter().map(|window| window.figures.clone()).collect();
    let class: Vec<usize> = learnt.iter().map(|window| window.class).collect();
    let from: Vec<Vec<usize>> =
        (0..COUNT).map(|of| (0..class.len()).filter(|&row| class[row] == of).collect()).collect();
    let each: Vec<usize> = from.iter().map(Vec::len).collect();
    let examples = Examples { figures: &figures, class: &class, classes: COUNT };
    let forest = Forest::grow(examples, &from, &each, TREES, &mut Stream::named(seed, "recogniser/forest"));
    Confusion::from_pairs(judged.iter().map(|window| (window.class, forest.class_of(&window.figures))))
}

#[cfg(test)]
mod tests;
