//! Sensor faults diagnosed from the logs of homes alone, compared with the planted faults.
//!
//! A fault is found if a finding about its sensor overlaps with its time, and named if the finding has its kind. All other findings are
//! false alarms.

use crate::locating::truth::MessagesWithTruth;
use crate::locating::{LocatingError, SimulatedHome};
use homebody_core::link::form::{
    BadLinkFile, BatteryFile, DriftFile, FallsOffFile, FalseFiresFile, FaultFile, LinkFile, MovedFile, Network,
    StuckFile,
};
use homebody_core::random::Stream;
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::sensors::motion::MotionFile;
use homebody_core::time::{DAY, Interval, RunTime};
use homebody_infer::{FaultFinding, Senses, SensorFault, health};
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FaultCase {
    pub home: String,
    pub seed: u64,
    pub faults: Vec<PlantedFault>,
    /// Findings without a fault.
    pub false_alarms: Vec<FalseAlarm>,
    pub sensors: usize,
    pub days: u32,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlantedFault {
    /// The kind, as in `link.json`; for a stuck sensor also whether it repeats itself.
    pub kind: &'static str,
    pub sensor: String,
    pub found: bool,
    /// True if the finding names the fault.
    pub named: bool,
    /// Days from the start of the fault to the start of the finding; negative before it.
    pub late_days: Option<f64>,
    pub said: Option<SensorFault>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FalseAlarm {
    pub sensor: String,
    pub said: SensorFault,
}

pub const PLANTED_KINDS: [&str; 8] =
    ["battery", "stuck, repeating", "drift", "bad_link", "stuck, silent", "falls_off", "false_fires", "moved"];

/// A link with half of the kinds of faults, each in another motion sensor; `number` selects the half and the sensors.
pub fn faulty(scenario: &Scenario, number: usize, length: u32) -> LinkFile {
    let sensors = scenario.home.placed_sensors();
    let mut motion: Vec<String> =
        sensors.iter().filter(|sensor| sensor.senses_motion()).map(|sensor| sensor.name.clone()).collect();
    let mut stream = Stream::named(number as u64, "planted");
    for place in (1..motion.len()).rev() {
        let other = (stream.unit() * (place + 1) as f64) as usize;
        motion.swap(place, other.min(place));
    }
    let half = PLANTED_KINDS.len() / 2;
    let kinds = &PLANTED_KINDS[number % 2 * half..][..half];
    let faults = kinds.iter().zip(motion).filter_map(|(kind, sensor)| fault(scenario, kind, sensor, f64::from(length)));
    LinkFile { preset: Network::Zigbee, faults: faults.collect(), ..LinkFile::default() }
}

/// A fault of a kind in a run of `length` days. A moved sensor takes the place of the next wall sensor in another room.
fn fault(scenario: &Scenario, kind: &str, sensor: String, length: f64) -> Option<FaultFile> {
    let from_day = length * 0.4;
    let days = Some(length * 0.5);
    Some(match kind {
        "battery" => FaultFile::Battery(BatteryFile { sensor, from_day, fading_days: length * 0.35, days }),
        "stuck, repeating" => FaultFile::Stuck(StuckFile { sensor, from_day, days, every_s: Some(90.0) }),
        "stuck, silent" => FaultFile::Stuck(StuckFile { sensor, from_day, days, every_s: None }),
        "drift" => FaultFile::Drift(DriftFile { sensor, ppm: 150.0, offset_s: 40.0 }),
        "bad_link" => FaultFile::BadLink(BadLinkFile { sensor, from_day, days, loss: 0.6 }),
        "falls_off" => FaultFile::FallsOff(FallsOffFile { sensor, from_day, days }),
        "false_fires" => FaultFile::FalseFires(FalseFiresFile { sensor, from_day, days, per_h: 2.0, between: None }),
        _ => {
            let on_wall = |file: &SensorFile| match file {
                SensorFile::Motion(motion) => Some(motion.clone()),
                _ => None,
            };
            let walls: Vec<MotionFile> = scenario.home.sensors.iter().filter_map(on_wall).collect();
            let own = walls.iter().find(|one| one.name == sensor)?;
            let far = |one: &&MotionFile| (one.at[0] - own.at[0]).hypot(one.at[1] - own.at[1]) > 4.0;
            let other = walls.iter().find(far)?;
            FaultFile::Moved(MovedFile { sensor, from_day, at: other.at, facing_deg: other.facing_deg })
        }
    })
}

pub fn case(home: &SimulatedHome, seed: u64, length: u32) -> Result<FaultCase, LocatingError> {
    let scenario = home.scenario;
    let lasts = i64::from(length) * DAY;
    let residents = scenario.residents.len();
    let mut bodies = (0..residents).map(|body| Senses::learn(scenario, body)).collect::<Result<Vec<_>, _>>()?;
    if residents == 1 {
        bodies.push(bodies[0].for_visitor());
    }
    let simulated = MessagesWithTruth::simulate(home, seed, lasts)?;
    let names: Vec<&str> = scenario.home.placed_sensors().iter().map(|sensor| sensor.name.as_str()).collect();
    let findings = health(&bodies, &simulated.messages, RunTime::START + lasts);
    let faults = scenario.link.iter().flat_map(|link| &link.faults);
    let faults: Vec<(&FaultFile, PlantedFault)> =
        faults.filter_map(|fault| Some((fault, planted(fault, &names, &findings)?))).collect();
    let is_of = |finding: &FaultFinding, fault: &FaultFile| {
        fault.sensor() == Some(names[finding.sensor]) && overlaps(finding, fault)
    };
    let alarms = findings.iter().filter(|finding| !faults.iter().any(|(fault, _)| is_of(finding, fault)));
    let alarm = |finding: &FaultFinding| FalseAlarm { sensor: names[finding.sensor].into(), said: finding.ailment };
    Ok(FaultCase {
        home: scenario.file.name.clone(),
        seed,
        false_alarms: alarms.map(alarm).collect(),
        faults: faults.into_iter().map(|(_, planted)| planted).collect(),
        sensors: names.len(),
        days: length,
    })
}

fn overlaps(finding: &FaultFinding, fault: &FaultFile) -> bool {
    fault.span().overlaps(Interval::new(finding.from, finding.to))
}

/// The finding about a fault; `None` for a fault of the logger.
fn planted(fault: &FaultFile, names: &[&str], findings: &[FaultFinding]) -> Option<PlantedFault> {
    let sensor = fault.sensor()?;
    let of = |finding: &&FaultFinding| names[finding.sensor] == sensor && overlaps(finding, fault);
    let all: Vec<&FaultFinding> = findings.iter().filter(of).collect();
    let right = all.iter().find(|finding| is_named(fault, finding.ailment));
    let said = right.or(all.first());
    let late = |from: RunTime| (from - fault.span().begin).ratio(DAY);
    Some(PlantedFault {
        kind: kind(fault),
        sensor: sensor.into(),
        found: said.is_some(),
        named: right.is_some(),
        late_days: said.map(|finding| late(finding.from)),
        said: said.map(|finding| finding.ailment),
    })
}

fn kind(fault: &FaultFile) -> &'static str {
    match fault {
        FaultFile::Stuck(StuckFile { every_s: Some(_), .. }) => "stuck, repeating",
        FaultFile::Stuck(_) => "stuck, silent",
        other => other.kind(),
    }
}

fn is_named(fault: &FaultFile, said: SensorFault) -> bool {
    match fault {
        FaultFile::Battery(_) => said == SensorFault::Fading,
        FaultFile::Stuck(StuckFile { every_s: Some(_), .. }) => said == SensorFault::Stuck,
        FaultFile::Stuck(_) | FaultFile::FallsOff(_) => said == SensorFault::Dead,
        FaultFile::Moved(_) => said == SensorFault::Moved,
        FaultFile::Drift(_) => matches!(said, SensorFault::Clock { .. }),
        FaultFile::FalseFires(_) => matches!(said, SensorFault::Noisy { .. }),
        FaultFile::BadLink(_) => matches!(said, SensorFault::Loses { .. }),
        FaultFile::Outage(_) => false,
    }
}
