//! The faults of the sensors of a home, by its log.

use crate::error::TrackingError;
use crate::translation::{HomeMessages, bodies, misfits};
use homebody_core::problem::counted;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::RunTime;
use homebody_infer::{Examination, ExaminationPass, FaultFinding, PassCounts, SensorFault};
use homebody_log::Log;
use rayon::ScopeFifo;
use serde::Serialize;
use std::fmt;
use std::sync::{Mutex, PoisonError};

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Health {
    pub sensors: usize,
    /// The begin of the log, on the clock on the wall.
    pub from: String,
    /// The end of its last hour.
    pub to: String,
    pub findings: Vec<SensorFinding>,
    /// The mismatches of the log and the home, in sentences.
    pub remarks: Vec<String>,
}

/// A fault of a sensor for a time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SensorFinding {
    pub sensor: String,
    pub from: String,
    pub to: String,
    #[serde(flatten)]
    pub ailment: SensorFault,
}

/// Asks what is wrong with the sensors of a scenario's home, by a log of it. `progress` gets the share that is done, from 0 to 1.
pub fn health(log: &Log, scenario: &Scenario, progress: impl FnMut(f64) + Send) -> Result<Health, TrackingError> {
    let names: Vec<String> = scenario.home.placed_sensors().iter().map(|sensor| sensor.name.clone()).collect();
    let heard = HomeMessages::new(log, scenario, &names)?;
    let (bodies, _) = bodies(scenario)?;
    let wall = |at| heard.calendar.wall_clock(at);
    let found = |finding: FaultFinding| SensorFinding {
        sensor: names[finding.sensor].clone(),
        from: wall(finding.from),
        to: wall(finding.to.min(heard.end)),
        ailment: finding.ailment,
    };
    let examination = Examination::new(&bodies, &heard.messages, heard.end);
    let findings = examination.map(|examination| findings(&examination, progress)).unwrap_or_default();
    Ok(Health {
        sensors: names.len() - heard.unheard.len(),
        from: wall(RunTime::START),
        to: wall(heard.end),
        findings: findings.into_iter().map(found).collect(),
        remarks: misfits([heard.messages.len() as u64, log.events.len() as u64], &heard.strangers, &heard.unheard),
    })
}

/// Runs the passes of an examination in parallel, as far as there are processors.
fn findings(examination: &Examination, progress: impl FnMut(f64) + Send) -> Vec<FaultFinding> {
    let passes = Passes {
        shares: Mutex::new((vec![0.0; Examination::PASSES], progress)),
        counted: Mutex::new((0..Examination::PASSES).map(|_| None).collect()),
    };
    rayon::scope_fifo(|scope| {
        (0..Examination::PASSES).for_each(|number| passes.go_on(scope, number, examination.pass(number)));
    });
    let counted = passes.counted.into_inner().unwrap_or_else(PoisonError::into_inner);
    examination.findings(&counted.into_iter().flatten().collect::<Vec<PassCounts>>())
}

/// The passes of an examination. They take turns: without turns one processor would run the last of five passes, and the
/// other one would wait.
struct Passes<F> {
    /// The finished share of each, and the receiver of the mean.
    shares: Mutex<(Vec<f64>, F)>,
    counted: Mutex<Vec<Option<PassCounts>>>,
}

impl<F: FnMut(f64) + Send> Passes<F> {
    /// Gives a pass one turn. It queues behind the others for the next.
    fn go_on<'a>(&'a self, scope: &ScopeFifo<'a>, number: usize, mut pass: ExaminationPass<'a>) {
        scope.spawn_fifo(move |scope| {
            let share = pass.advance();
            // A turn that ends while another one tells its share leaves it to the next one.
            if let Ok(mut shares) = self.shares.try_lock() {
                let (shares, progress) = &mut *shares;
                shares[number] = share.unwrap_or(1.0);
                progress(shares.iter().sum::<f64>() / Examination::PASSES as f64);
            }
            if share.is_some() {
                return self.go_on(scope, number, pass);
            }
            self.counted.lock().unwrap_or_else(PoisonError::into_inner)[number] = Some(pass.counted());
        });
    }
}

impl fmt::Display for SensorFinding {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let SensorFinding { sensor, from, to, ailment } = self;
        write!(f, "{} to {}  {sensor} ", &from[..16], &to[..16])?;
        match ailment {
            SensorFault::Stuck => write!(f, "is stuck: it repeats itself at even spaces"),
            SensorFault::Dead => write!(f, "is dead: it notices nobody who is there"),
            SensorFault::Fading => write!(f, "fades: it noticed less and less, as with a weak battery"),
            SensorFault::Loses { share } => write!(f, "loses {:.0} % of what it noticed before", share * 100.0),
            SensorFault::Noisy { per_h } => write!(f, "fires for no reason, {per_h:.1} times an hour"),
            SensorFault::Moved => write!(f, "looks elsewhere than the plan says"),
            SensorFault::Clock { ahead_s, ppm } => {
                let way = if *ahead_s < 0.0 { "behind" } else { "ahead" };
                write!(f, "has a clock that is {:.0} s {way} at the end, and runs {ppm:+.0} ppm off", ahead_s.abs())
            }
        }
    }
}

impl fmt::Display for Health {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let sensors = counted(self.sensors, "sensor", "sensors");
        writeln!(f, "{sensors} from {} to {}", &self.from[..16], &self.to[..16])?;
        if self.findings.is_empty() {
            return writeln!(f, "Nothing seems to be wrong with them.");
        }
        self.findings.iter().try_for_each(|found| writeln!(f, "  {found}"))
    }
}
