//! A scenario fitted to the log of its home: its sensors' timing, the rhythm of its resident, and the link.
//!
//! The lengths of ONs and the times between them come from the log itself (`homebody_analysis::timing`), and so do repeated and lost
//! messages. The rhythm comes from the located log: nights, outings, meals and visits to the bathroom become a diary, and the diary
//! sentences (`homebody_routine::rhythm`). The movement by day, the turning by night and the differences between days are found by
//! simulation: the fitted scenario is simulated, its firings an hour are compared with the log's, and the sentences change until they
//! agree.
//!
//! The reach and the misses of sensors are those with which a simulation of the located path fires most like the log (`sight`); the log is
//! then located anew.
//!
//! We assume one resident, whose days are all of a kind.
//!
//! Left out: the places of furniture and sensors; visitors; weekdays.

mod diary;
mod sight;
mod simulated_log;
mod timing;

use crate::error::TrackingError;
use crate::translation::locate;
use diary::{Rhythm, UsualNight};
use homebody_analysis::realism::{ComparedLog, realism};
use homebody_analysis::signs::{Kind, RowMeaning, kinds, said};
use homebody_analysis::timing::{MotionTiming, timing};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{HOUR, WallTime};
use homebody_log::{Cancel, Event, Log};
use homebody_simulation::{OpenScenario, ScenarioSource, numbers};
use serde::Serialize;
pub use sight::SensorSight;
use simulated_log::SEED;
pub use simulated_log::simulated_log;
use std::collections::BTreeMap;
use std::ops::Range;

pub struct Calibration {
    pub files: BTreeMap<String, String>,
    pub entry: String,
    /// By sensor of the log: its name in the home; its id where the home has no such sensor.
    pub names: Vec<String>,
    pub fitted: Fitted,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fitted {
    /// The timing of the sensors and of the link in the log.
    pub timing: MotionTiming,
    /// The ranges and misses of the motion sensors with enough firings.
    pub sights: Vec<SensorSight>,
    /// The number of nights in the rhythm.
    pub nights: usize,
    pub routine: Vec<String>,
    /// Factor on the usual movement while up.
    pub movement: f64,
    /// Factor on the usual turning in bed.
    pub turning: f64,
    /// The difference between days: the parameter `life.day_spread`.
    pub day_spread: f64,
    /// Firings an hour while up and in bed, in the log and in the fitted scenario.
    pub firings_an_hour: [FiringRates; 2],
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct FiringRates {
    pub up: f64,
    pub in_bed: f64,
}

/// Number of rounds of simulation and fitting (our choice): after two changes, the rates differ more between runs than
/// from the log's.
const ROUNDS: usize = 3;
/// Days that are simulated in each round (our choice).
const DAYS: u32 = 28;
/// Smallest and largest factors on the amount of movement, and on turning in bed (our choice).
const MOVEMENT: Range<f64> = 0.1..4.0;
const TURNING: Range<f64> = 0.05..10.0;
/// Difference from 1 below which a factor is omitted (our choice): runs differ by more.
const ABOUT_AS_USUAL: f64 = 0.05;
/// The parameter of the differences between days.
const DAY_SPREAD: &str = "life.day_spread";
/// Largest value of the parameter.
const MOST_DAY_SPREAD: f64 = 2.0;
/// Number of days below which the difference between days is unknown (our choice).
const LEAST_DAYS: i64 = 5;
/// Number of nights below which a rhythm is only approximate (our choice).
const FEW_NIGHTS: usize = 5;
const ROUTINE: &str = "fitted.routine";

homebody_core::messages! {
    /// Problems with fitting a scenario to a log.
    pub enum CalibrationMessage in "fit" {
        /// Sensors do not tell several residents apart, so Homebody cannot learn the rhythm of each.
        NotAlone { scenario: String, residents: usize } error "not-alone" ("{scenario:?} has {residents} residents, and Homebody fits only a resident who lives alone")
            hint ("use a scenario with one resident");
        /// The rhythm of a day begins and ends in bed. Homebody finds the night by the sensors of the bed or the bedroom.
        NoNight error "no-night" ("the log contains no night between two days")
            hint ("use a log with at least two nights, of a home with a sensor at the bed or in the bedroom");
        /// Homebody fits times and counts as averages over nights and days. Averages over a few of them are rough.
        FewNights { nights: usize } warning "few-nights" ("the fitted rhythm is rough: the log has {nights} nights")
            hint ("use a log of a week or more");
    }
}

/// Fits a scenario to a log of its home. `progress` gets the share that is done, from 0 to 1.
///
/// Sensors are those whose names the home has, or whose ids its logger says. The log is on the clock on the wall.
pub fn calibrate(log: &Log, home: &OpenScenario, mut progress: impl FnMut(f64)) -> Result<Calibration, TrackingError> {
    let scenario = home.scenario();
    if scenario.residents.len() != 1 {
        let count = scenario.residents.len();
        let message = CalibrationMessage::NotAlone { scenario: home.name().to_owned(), residents: count };
        return Err(TrackingError::Calibration(message.into()));
    }
    let timing = timing(log);
    let sensed = timing::fitted(scenario.edit(), &timing, &scenario.logger, scenario.link.as_ref()).load()?;
    let (seen, sights) = sight::fitted(&sensed, log, |share| progress(share * 0.5))?;
    let walked = ScenarioSource::from_texts(seen.sources.clone(), seen.entry.clone()).open()?;
    let translation = locate(log, walked.scenario(), &Cancel::new(), |share| progress(0.5 + share * 0.3))?;
    let log = Log { sensors: translation.names.clone(), ..log.clone() };
    let rhythm = Rhythm::new(&translation, walked.scenario());
    let Some(night) = rhythm.night() else {
        return Err(TrackingError::Calibration(CalibrationMessage::NoNight.into()));
    };
    let real = FiringRates::new(&log, &night);
    let mut fitted = Fitted {
        timing,
        sights,
        nights: rhythm.nights(),
        routine: rhythm.sentences(),
        movement: 1.0,
        turning: 1.0,
        day_spread: day_spread(walked.scenario()),
        firings_an_hour: [real, FiringRates::default()],
    };
    for round in 0..ROUNDS {
        let simulated = simulated_log(&open(&walked, &fitted)?, SEED, DAYS)?;
        let rates = FiringRates::new(&simulated, &night);
        fitted.movement = toward(fitted.movement, real.up, rates.up, MOVEMENT);
        fitted.turning = toward(fitted.turning, real.in_bed, rates.in_bed, TURNING);
        // Once: how much a few days differ is known too roughly to be come nearer to.
        if let Some(times) = days_differ(&log, &simulated).filter(|_| round == 0) {
            fitted.day_spread = (fitted.day_spread * times).min(MOST_DAY_SPREAD);
        }
        progress(0.8 + 0.2 * (round + 1) as f64 / (ROUNDS + 1) as f64);
    }
    let open = open(&walked, &fitted)?;
    fitted.firings_an_hour[1] = FiringRates::new(&simulated_log(&open, SEED, DAYS)?, &night);
    let Scenario { sources: files, entry, .. } = open.scenario().clone();
    Ok(Calibration { files, entry, names: translation.names, fitted })
}

impl Fitted {
    /// A warning about a rough fit.
    pub fn doubt(&self) -> Option<CalibrationMessage> {
        (self.nights < FEW_NIGHTS).then_some(CalibrationMessage::FewNights { nights: self.nights })
    }

    fn text(&self) -> String {
        let mut sentences = self.routine.clone();
        let said = |times: f64, less: &str, more: &str| {
            let percent = ((times - 1.0).abs() * 100.0).round();
            let what = if times < 1.0 { less } else { more };
            ((times - 1.0).abs() > ABOUT_AS_USUAL).then(|| what.replace('#', &percent.to_string()))
        };
        sentences.extend(said(self.movement, "She is # % less active.", "She is # % more active."));
        sentences.extend(said(self.turning, "She turns in bed # % less.", "She turns in bed # % more."));
        sentences.join("\n") + "\n"
    }
}

impl FiringRates {
    /// The rates of a log, with its usual night as times of day. By day, hours without any firing do not count: the resident was out.
    fn new(log: &Log, night: &UsualNight) -> FiringRates {
        let kinds = kinds(log);
        let is_firing =
            |(event, said): &(&Event, RowMeaning)| kinds[event.sensor as usize] == Kind::Motion && said.begins();
        let mut hours: BTreeMap<i64, f64> = BTreeMap::new();
        for (event, _) in log.events.iter().zip(said(log)).filter(is_firing) {
            *hours.entry(event.at.since_zero().div_euclid(HOUR)).or_default() += 1.0;
        }
        let Some((first, last)) = hours.keys().next().copied().zip(hours.keys().last().copied()) else {
            return FiringRates::default();
        };
        let of = |in_bed: bool| {
            let at_night = |hour: &i64| night.covers_hour(WallTime::EPOCH + *hour * HOUR) == Some(in_bed);
            let counts: Vec<f64> = (first..=last)
                .filter(at_night)
                .map(|hour| hours.get(&hour).copied().unwrap_or(0.0))
                .filter(|count| in_bed || *count > 0.0)
                .collect();
            counts.iter().sum::<f64>() / counts.len().max(1) as f64
        };
        FiringRates { up: of(false), in_bed: of(true) }
    }
}

/// The change that makes one rate the other, if rates follow it.
fn toward(now: f64, real: f64, lived: f64, within: Range<f64>) -> f64 {
    if real > 0.0 && lived > 0.0 { (now * real / lived).clamp(within.start, within.end) } else { now }
}

/// The ratio of the differences between days in a log and in a simulation; nothing with too few days.
fn days_differ(log: &Log, lived: &Log) -> Option<f64> {
    let told = |name, log| ComparedLog { name, log, recorded: None };
    let held = realism(told("log", log), told("life", lived)).ok()?;
    let [real, ours] = held.days_differ.of?;
    let (real, ours) = (real?, ours?);
    (held.a.days as i64 >= LEAST_DAYS && ours > 0.0).then_some(real / ours)
}

/// The difference between days in a scenario before the fit.
fn day_spread(scenario: &Scenario) -> f64 {
    let usual = || numbers().into_iter().find(|number| number.name == DAY_SPREAD).map(|number| number.value);
    scenario.file.numbers.get(DAY_SPREAD).copied().or_else(usual).unwrap_or_default()
}

fn open(walked: &OpenScenario, fitted: &Fitted) -> Result<OpenScenario, TrackingError> {
    let edit = walked.scenario().edit().routine(0, ROUTINE, fitted.text()).file(|file| {
        // A thousandth more or less is nothing that a few days can tell.
        let day_spread = (fitted.day_spread * 1000.0).round() / 1000.0;
        file.numbers.insert(DAY_SPREAD.into(), day_spread);
    });
    let entry = edit.entry().to_owned();
    Ok(ScenarioSource::from_texts(edit.into_texts(), entry).open()?)
}
