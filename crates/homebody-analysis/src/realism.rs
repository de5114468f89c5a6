//! The distance of a log from another in figures that give simulated logs away, and the separation of both by a forest.
//!
//! | measure | definition |
//! |---|---|
//! | gaps | the Kolmogorov-Smirnov distance of the times from each firing in the home to the next |
//! | refiring | that of the times from each firing of a sensor to its next |
//! | ON lengths | that of the lengths of ONs, where both logs tell when an ON ends |
//! | firings a day | that of the firings of each day |
//! | hours, sensor shares, ways | the Jensen-Shannon distance, the root of the divergence in bits, of the distributions of the firings over the hours of the day, over the sensors, and over the pairs of a sensor and another that fires next within a minute |
//! | at once | that of the times in which one, two, and three and more sensors are ON |
//! | density maps | the distance of `density`'s maps |
//! | together | the share of firings within 3 s of another sensor's |
//! | days differ | the standard deviation of the firings an hour of each day, over their mean; only hours and days with firings count |
//! | days follow | the correlation of the same with that of the day before |
//! | empty hours | the share of hours without firings |
//! | days, hours told apart | the area under the curve of a random forest that has not seen the day that it judges: 0.5 is guessing, 1 is without fail |
//!
//! The floor of a measure is its value for the two halves of the first log's days: no log of another home can be nearer than a home is to
//! itself. If a measure is a figure of one log, its value is the difference of the two figures.
//!
//! We assume that a day counts if all but an hour of it was recorded, that both logs have local time, and that sensors of one name are one;
//! if names differ, shares and ways are not compared. Only motion sensors count.

mod figures;
mod forest;
mod firings;
mod measures;
mod table;

use crate::dates::MOST_DAYS;
use crate::density::{self, density};
use figures::DayFigures;
use firings::{MotionFirings, of_days};
use forest::FigureRows;
pub use forest::area_under_curve;
use homebody_core::time::{Interval, Span, WallTime};
use homebody_log::Log;
use measures::{
    at_once_apart, days_differ, days_follow, empty_hours, firings_a_day, gaps, hours_apart, ks, on_lengths, profile,
    refires, shares_apart, together, ways_apart,
};
use serde::Serialize;
pub use table::MEASURES;

/// A log with its name, and the time of its recording, if that is known.
#[derive(Clone, Copy, Debug)]
pub struct ComparedLog<'a> {
    pub name: &'a str,
    pub log: &'a Log,
    /// From its first row to its last by default.
    pub recorded: Option<Interval<WallTime>>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Realism {
    /// The log that is taken as real: the floor is its own.
    pub a: LogSummary,
    pub b: LogSummary,
    /// Of the times from any firing to the next.
    pub gaps_ks: RealismMeasure,
    /// Of the times from a sensor's firing to its next.
    pub refires_ks: RealismMeasure,
    pub on_ks: RealismMeasure,
    pub hours_js: RealismMeasure,
    pub shares_js: RealismMeasure,
    pub ways_js: RealismMeasure,
    pub at_once_js: RealismMeasure,
    pub firings_ks: RealismMeasure,
    pub density_distance: RealismMeasure,
    pub together: RealismMeasure,
    pub days_differ: RealismMeasure,
    /// The similarity of each day to the one before.
    pub days_follow: RealismMeasure,
    pub empty_hours: RealismMeasure,
    pub auc_days: RealismMeasure,
    pub auc_hours: RealismMeasure,
    /// The figures that separate days, the best first.
    pub days_told_by: Vec<TellingFigure>,
    /// The figures that separate hours, the best first.
    pub hours_told_by: Vec<TellingFigure>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LogSummary {
    pub name: String,
    pub days: usize,
    pub motion_sensors: usize,
    pub firings_a_day: f64,
    pub hours: [f64; 24],
    /// The percentiles of the gaps from 5 to 95 in steps of 5, in seconds.
    pub gaps_s: Vec<f64>,
    /// The same of the lengths of ONs; empty where the log does not have them.
    pub on_s: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RealismMeasure {
    /// For the two logs; `None` where it is unknown.
    pub value: Option<f64>,
    /// For the first log's own halves.
    pub floor: Option<f64>,
    /// The figure of each log, where the measure is their difference.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub of: Option<[Option<f64>; 2]>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TellingFigure {
    pub figure: String,
    /// Its part in the separation, from 0 to 1.
    pub part: f64,
    pub medians: [f64; 2],
}

homebody_core::messages! {
    /// Reasons why two logs cannot be compared.
    #[derive(Clone, PartialEq, Eq)]
    pub enum NotComparable in "realism" {
        /// The measures of realism compare movements, which motion sensors report. Homebody recognises a motion sensor by its kind, its name
        /// and its values.
        NoMotion(log: String) error "no-motion-sensors" ("{log}: no sensor reports motion")
            hint ("motion sensors send ON, FIRE, true or 1 when they see a person");
        /// The measures of realism compare whole days, from midnight to midnight. The first and the last day of a log are rarely whole.
        NoDay(log: String) error "no-whole-day" ("{log}: the log has no whole day")
            hint ("record or simulate two days or more");
        /// The comparison has a limit of ten years, so that a wrong date does not exhaust the memory.
        TooLong { log: String, days: usize } error "too-many-days"
            ("{log}: the log covers {days} days, and the limit is ten years")
            hint ("compare a shorter log");
    }
}

/// Number of days on each side below which a separation of days is unknown.
const LEAST_DAYS: usize = 4;
/// The same for hours: each day has 24.
const LEAST_DAYS_OF_HOURS: usize = 2;
/// Largest number of figures in the report, those that tell the logs apart best.
const MOST_SIGNS: usize = 8;

pub fn realism(a: ComparedLog, b: ComparedLog) -> Result<Realism, Vec<NotComparable>> {
    let logs = [a, b].map(|told| MotionFirings::from_log(told.log, told.recorded));
    let problem = |(told, heard): (&ComparedLog, &MotionFirings)| match () {
        () if heard.days_count() > MOST_DAYS => {
            Some(NotComparable::TooLong { log: told.name.into(), days: heard.days_count() })
        }
        () if heard.sensors.is_empty() => Some(NotComparable::NoMotion(told.name.into())),
        () if heard.days_count() == 0 => Some(NotComparable::NoDay(told.name.into())),
        () => None,
    };
    let problems: Vec<NotComparable> = [a, b].iter().zip(&logs).filter_map(problem).collect();
    if !problems.is_empty() {
        return Err(problems);
    }
    let both = [&logs[0], &logs[1]];
    let halves = logs[0].halves();
    let own = [&halves[0], &halves[1]];
    let measure =
        |of: &dyn Fn([&MotionFirings; 2]) -> Option<f64>| RealismMeasure { value: of(both), floor: of(own), of: None };
    let figure = |of: fn(&MotionFirings) -> Option<f64>| {
        let apart = |logs: [&MotionFirings; 2]| Some((of(logs[0])? - of(logs[1])?).abs());
        RealismMeasure { value: apart(both), floor: apart(own), of: Some(both.map(of)) }
    };
    let (days, hours) = (told_apart(both, true), told_apart(both, false));
    let auc = |told: &Option<(f64, Vec<TellingFigure>)>, of_days| RealismMeasure {
        value: told.as_ref().map(|told| told.0),
        floor: told_apart(own, of_days).map(|told| told.0),
        of: None,
    };
    Ok(Realism {
        gaps_ks: measure(&|logs| ks(gaps, logs)),
        refires_ks: measure(&|logs| ks(refires, logs)),
        on_ks: measure(&|logs| ks(on_lengths, logs)),
        hours_js: measure(&hours_apart),
        shares_js: measure(&shares_apart),
        ways_js: measure(&ways_apart),
        at_once_js: measure(&at_once_apart),
        firings_ks: measure(&|logs| ks(firings_a_day, logs)),
        density_distance: RealismMeasure {
            value: maps_apart([a, b], &logs),
            floor: maps_apart([a, a], &halves),
            of: None,
        },
        together: figure(together),
        days_differ: figure(days_differ),
        days_follow: figure(days_follow),
        empty_hours: figure(empty_hours),
        auc_days: auc(&days, true),
        auc_hours: auc(&hours, false),
        days_told_by: days.map(|told| told.1).unwrap_or_default(),
        hours_told_by: hours.map(|told| told.1).unwrap_or_default(),
        a: LogSummary::from_firings(a.name, both[0]),
        b: LogSummary::from_firings(b.name, both[1]),
    })
}

impl Realism {
    /// Every measure, with its name and its meaning, in the order of reports.
    pub fn measures(&self) -> [(&'static str, &'static str, RealismMeasure); 15] {
        [
            ("gaps", "KS of the times from any firing to the next", self.gaps_ks),
            ("refiring", "KS of the times from a sensor's firing to its next", self.refires_ks),
            ("ON lengths", "KS of how long an ON lasts", self.on_ks),
            ("hours", "JS of the firings over the hours of the day", self.hours_js),
            ("sensor shares", "JS of the firings over the sensors", self.shares_js),
            ("ways", "JS of the transitions from sensor to sensor", self.ways_js),
            ("at once", "JS of how long 1, 2, 3 and more sensors are ON", self.at_once_js),
            ("firings a day", "KS of the firings of each day", self.firings_ks),
            ("density maps", "distance of the motion density maps, 0 to 2.24", self.density_distance),
            ("together", "share of firings within 3 s of another sensor's", self.together),
            ("days differ", "spread over the days of their firings per active hour", self.days_differ),
            ("days follow", "correlation of the same with the day before", self.days_follow),
            ("empty hours", "share of hours in which nothing fires", self.empty_hours),
            ("days told apart", "area under the curve of a forest on days", self.auc_days),
            ("hours told apart", "area under the curve of a forest on hours", self.auc_hours),
        ]
    }
}

impl LogSummary {
    fn from_firings(name: &str, log: &MotionFirings) -> LogSummary {
        let percentiles = |mut sample: Vec<Span>| {
            sample.sort_unstable();
            let sorted: Vec<f64> = sample.into_iter().map(Span::seconds).collect();
            (1..20).filter_map(|step| measures::quantile(&sorted, f64::from(step) / 20.0)).collect()
        };
        LogSummary {
            name: name.into(),
            days: log.days_count(),
            motion_sensors: log.sensors.len(),
            firings_a_day: log.firings.len() as f64 / log.days_count() as f64,
            hours: profile(log),
            gaps_s: percentiles(gaps(log)),
            on_s: percentiles(on_lengths(log)),
        }
    }
}

fn maps_apart(told: [ComparedLog; 2], heard: &[MotionFirings; 2]) -> Option<f64> {
    let asked = |heard: &MotionFirings| density::DensityOptions {
        recorded: Some(of_days(&heard.days)),
        ..density::DensityOptions::default()
    };
    let logs: [Log; 2] = std::array::from_fn(|which| {
        let span = of_days(&heard[which].days);
        let events = told[which].log.events.iter().filter(|event| span.contains(event.at)).copied().collect();
        Log { events, ..told[which].log.clone() }
    });
    let against = asked(&heard[1]);
    let density =
        density((told[0].name, &logs[0], &asked(&heard[0])), Some((told[1].name, &logs[1], &against))).ok()?;
    density.against?.distance
}

/// The separation of the days, or the hours, of two logs by a forest, and the figures that separate them.
fn told_apart(logs: [&MotionFirings; 2], of_days: bool) -> Option<(f64, Vec<TellingFigure>)> {
    let figures = DayFigures::from_firings(logs, of_days);
    let mut rows = FigureRows { figures: Vec::new(), is_second: Vec::new(), day: Vec::new() };
    for (log, is_second) in logs.into_iter().zip([false, true]) {
        let spans: Vec<Interval<WallTime>> = if of_days { log.each_day().collect() } else { log.each_hour().collect() };
        for span in spans {
            rows.figures.push(figures.row(log, span));
            rows.is_second.push(is_second);
            rows.day.push((span.begin.day_number() - log.days.start) as usize);
        }
    }
    let told = rows.told_apart(if of_days { LEAST_DAYS } else { LEAST_DAYS_OF_HOURS })?;
    let mut signs: Vec<(f64, usize)> = told.importance.iter().copied().zip(0..).collect();
    signs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let names = figures.names();
    let sign = |(part, index): (f64, usize)| TellingFigure {
        figure: names[index].clone(),
        part,
        medians: [false, true].map(|which| {
            let of_log = rows.figures.iter().zip(&rows.is_second).filter(|(_, second)| **second == which);
            let mut values: Vec<f64> = of_log.map(|(row, _)| row[index]).collect();
            values.sort_by(f64::total_cmp);
            measures::quantile(&values, 0.5).unwrap_or(0.0)
        }),
    };
    Some((told.auc, signs.into_iter().take(MOST_SIGNS).map(sign).collect()))
}

#[cfg(test)]
mod tests;
