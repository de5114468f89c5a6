//! The reach and the misses of sensors.
//!
//! A located log is a path, and a path can be simulated again in the same home with other sensors. Sensors do not affect each other, so
//! that one simulation tries a value for all of them at once.
//!
//! | parameter | value |
//! |---|---|
//! | reach | the sensor's firings are most like the log's: `2 m / (a + b)` is highest, for `a` firings in the log and `b` in the simulation, `m` of them no more than 10 s apart |
//! | misses | the sensor fires as often as in the log |
//!
//! A located path is where the sensors fired rather than where the person was, so that both values are biased. They are biased in the same
//! way for a simulation in the same home with known sensors: the same is done with its log, and only the difference is believed (indirect
//! inference: Gouriéroux, Monfort & Renault 1993).
//!
//! We assume that the scenario's resident passes the sensors as the one in the log does. The log is located anew with the fitted sensors;
//! the sensors are not fitted again.
//!
//! Left out: the places and directions of sensors, and the smallest movement that they notice. A sensor that notices every movement misses
//! nothing.

use super::simulated_log::{SEED, log_for};
use crate::error::TrackingError;
use crate::located_folder::beginning;
use crate::translation::locate;
use homebody_analysis::explanation::{ExplainedCounts, explained};
use homebody_core::scenario::edit::ScenarioEdit;
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::sensors::notice::{ChanceFile, Notice};
use homebody_core::time::Span;
use homebody_log::{Cancel, Log};
use homebody_simulation::ScenarioSource;
use serde::Serialize;

/// Factors on a sensor's reach that are tried (our choice).
const REACHES: [f64; 6] = [1.0, 0.5, 0.7, 0.85, 1.2, 1.5];
/// Shares of missed passings that are tried (our choice).
const MISSES: [f64; 7] = [0.0, 0.12, 0.25, 0.4, 0.55, 0.7, 0.85];
/// Firings below which a sensor has too little data (our choice).
const LEAST_FIRINGS: u64 = 30;
/// Improvement of the agreement below which it is chance (our choice).
const BETTER: f64 = 0.02;
/// Ratio of the firings to those of the log, in either direction, within which the difference may be chance (our
/// choice).
const OFTENER: f64 = 1.2;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorSight {
    pub sensor: String,
    /// Factor on its reach in the scenario.
    pub reach: f64,
    /// The share of passings that it misses; `None` if it notices every movement.
    pub missed: Option<f64>,
    /// The agreement of its firings with the log's before and after, from 0 to 1.
    pub agreement: [f64; 2],
}

/// The scenario with the reach and the misses of its sensors of movement, as a log tells them.
/// `progress` gets the share that is done, from 0 to 1.
pub fn fitted(
    scenario: &Scenario,
    log: &Log,
    mut progress: impl FnMut(f64),
) -> Result<(Scenario, Vec<SensorSight>), TrackingError> {
    let as_it_is = ScenarioSource::from_texts(scenario.sources.clone(), scenario.entry.clone()).open()?;
    let real = Resimulation::new(scenario, log)?;
    progress(0.3);
    let own = Resimulation::new(scenario, &log_for(&as_it_is, SEED, real.length)?)?;
    progress(0.6);
    let given = scenario.home.sensors.clone();
    let tries: Vec<(f64, Vec<SensorFile>)> =
        REACHES.into_iter().map(|times| (times, seeing_as_far(scenario, times))).collect();
    let (seen, usual) = (real.reaches(&tries)?, own.reaches(&tries)?);
    progress(0.8);
    let (mut sensors, mut reach) = (given.clone(), vec![1.0; given.len()]);
    for number in 0..given.len() {
        let times = nearest(&REACHES, seen[number] / usual[number]);
        if let Some((_, tried)) = tries.iter().find(|(tried, _)| *tried == times).filter(|_| times != 1.0) {
            sensors[number] = tried[number].clone();
            reach[number] = if sensors[number] == given[number] { 1.0 } else { times };
        }
    }
    let usual = own.oftener(&given)?;
    for (number, share) in real.misses(&sensors, &usual)?.into_iter().enumerate() {
        if let Some(changed) = share.and_then(|share| missing(&sensors[number], share)) {
            sensors[number] = changed;
        }
    }
    let [before, after] = [real.counts(&given)?, real.counts(&sensors)?];
    let sight = |number: usize| SensorSight {
        sensor: given[number].name().into(),
        reach: reach[number],
        missed: missed(&sensors[number]),
        agreement: [agreement(&before[number]), agreement(&after[number])],
    };
    let told = (0..given.len()).filter(|&number| given[number].senses_motion() && is_told_of(&before[number]));
    let sights = told.map(sight).collect();
    progress(1.0);
    Ok((scenario.edit().home(|home| home.sensors = sensors).load()?, sights))
}

/// The path of a located log, to simulate with other sensors.
struct Resimulation {
    path: ScenarioEdit,
    length: Span,
    log: Log,
}

impl Resimulation {
    fn new(scenario: &Scenario, log: &Log) -> Result<Resimulation, TrackingError> {
        let walked = locate(log, scenario, &Cancel::new(), |_| ())?;
        let path = ScenarioSource::from_texts(walked.files.clone(), walked.entry.clone()).open()?.scenario().edit();
        Ok(Resimulation { path, length: walked.acted_out, log: beginning(log, &walked) })
    }

    /// By sensor of the home, the agreement of its firings with the log's.
    fn counts(&self, sensors: &[SensorFile]) -> Result<Vec<ExplainedCounts>, TrackingError> {
        let edit = self.path.clone().home(|home| home.sensors = sensors.to_vec());
        let entry = edit.entry().to_owned();
        let open = ScenarioSource::from_texts(edit.into_texts(), entry).open()?;
        let told = explained(&self.log, &log_for(&open, SEED, self.length)?);
        let of = |sensor: &SensorFile| {
            told.sensors
                .iter()
                .find(|one| one.sensor == sensor.name())
                .map_or(ExplainedCounts::default(), |one| one.counts)
        };
        Ok(sensors.iter().map(of).collect())
    }

    /// By sensor, the factor on its reach with the best agreement.
    fn reaches(&self, tries: &[(f64, Vec<SensorFile>)]) -> Result<Vec<f64>, TrackingError> {
        let mut best: Vec<(f64, f64)> = Vec::new();
        for (times, sensors) in tries {
            best.resize(sensors.len(), (1.0, 0.0));
            for (counts, best) in self.counts(sensors)?.iter().zip(&mut best) {
                if is_told_of(counts) && agreement(counts) > best.1 + BETTER {
                    *best = (*times, agreement(counts));
                }
            }
        }
        Ok(best.into_iter().map(|(times, _)| times).collect())
    }

    /// By sensor, the ratio of its firings to those of the log; `None` where that is unknown.
    fn oftener(&self, sensors: &[SensorFile]) -> Result<Vec<Option<f64>>, TrackingError> {
        let counts = self.counts(sensors)?;
        let times = |counts: &ExplainedCounts| counts.relived.max(1) as f64 / counts.real as f64;
        Ok(counts.iter().map(|counts| is_told_of(counts).then(|| times(counts))).collect())
    }

    /// By sensor, the share to miss with which that ratio is the usual one; `None` where it is so already.
    fn misses(&self, sensors: &[SensorFile], usual: &[Option<f64>]) -> Result<Vec<Option<f64>>, TrackingError> {
        let off = |times: &[Option<f64>]| -> Vec<f64> {
            let each = times.iter().zip(usual).map(|(times, usual)| Some(libm::log((*times)? / (*usual)?).abs()));
            each.map(|off| off.unwrap_or(0.0)).collect()
        };
        let mut best: Vec<(Option<f64>, f64)> =
            off(&self.oftener(sensors)?).into_iter().map(|off| (None, off)).collect();
        let is_off: Vec<bool> = best.iter().map(|(_, off)| *off > libm::log(OFTENER)).collect();
        for share in MISSES {
            let tried: Vec<SensorFile> =
                sensors.iter().map(|sensor| missing(sensor, share).unwrap_or_else(|| sensor.clone())).collect();
            for ((off, best), is_off) in off(&self.oftener(&tried)?).into_iter().zip(&mut best).zip(&is_off) {
                if *is_off && off < best.1 {
                    *best = (Some(share), off);
                }
            }
        }
        Ok(best.into_iter().map(|(share, _)| share).collect())
    }
}

fn is_told_of(counts: &ExplainedCounts) -> bool {
    counts.real >= LEAST_FIRINGS
}

/// From 0 to 1: the share of all firings of both with a partner in the other.
fn agreement(counts: &ExplainedCounts) -> f64 {
    2.0 * counts.matched as f64 / (counts.real + counts.relived).max(1) as f64
}

/// The nearest of some values, by their ratio.
fn nearest(values: &[f64], wanted: f64) -> f64 {
    let off = |value: f64| libm::log(value / wanted).abs();
    values.iter().copied().min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or(wanted)
}

/// The sensors of a home with another reach, except those that would see through walls then.
fn seeing_as_far(scenario: &Scenario, times: f64) -> Vec<SensorFile> {
    let sensors = &scenario.home.sensors;
    let changed = |(number, given): (usize, &SensorFile)| {
        let fits =
            |sensor: &SensorFile| scenario.edit().home(|home| home.sensors[number] = sensor.clone()).load().is_ok();
        scaled(given, times).filter(fits).unwrap_or_else(|| given.clone())
    };
    sensors.iter().enumerate().map(changed).collect()
}

fn scaled(sensor: &SensorFile, times: f64) -> Option<SensorFile> {
    let mut sensor = sensor.clone();
    sensor.scale_reach(times).then_some(sensor)
}

/// A sensor that misses such a share of passings; `None` for one that notices every movement.
fn missing(sensor: &SensorFile, share: f64) -> Option<SensorFile> {
    let Some(Notice::Chance(chance)) = sensor.notice() else { return None };
    let mut sensor = sensor.clone();
    sensor.change_settings(|settings| settings.notice = Some(Notice::Chance(ChanceFile { missed: share, ..chance })));
    Some(sensor)
}

fn missed(sensor: &SensorFile) -> Option<f64> {
    match sensor.notice() {
        Some(Notice::Chance(chance)) => Some(chance.missed),
        _ => None,
    }
}
