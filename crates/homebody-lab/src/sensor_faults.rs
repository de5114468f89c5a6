//! What is wrong with sensors, by the logs of their homes alone, held against the faults that were planted.
//!
//! Homes are lived with faulty links, and each log is walked back. A fault is found where something is said of its sensor for
//! a time that overlaps with it, and named where it is said what it is. All else that is said is a false alarm.

use crate::locating::truth::MessagesWithTruth;
use crate::locating::{Home, LocatingError};
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

/// How one home's faults were found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Case {
    /// The scenario's name.
    pub home: String,
    /// The number that all randomness of the lives comes from.
    pub seed: u64,
    /// The faults that were planted.
    pub faults: Vec<Planted>,
    /// What was said without a fault: the sensor's name, and what.
    pub false_alarms: Vec<FalseAlarm>,
    /// How many sensors were watched, each for all days.
    pub sensors: usize,
    /// For how many days.
    pub days: u32,
}

/// A fault, and what was said of its sensor meanwhile.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Planted {
    /// The kind of the fault, as `link.json` has it; of a stuck sensor, whether it repeats itself.
    pub kind: &'static str,
    /// The sensor's name.
    pub sensor: String,
    /// Whether something was said of it.
    pub found: bool,
    /// Whether that was what it is.
    pub named: bool,
    /// How many days after the fault's beginning what was found begins; below 0 before it.
    pub late_days: Option<f64>,
    /// What was said.
    pub said: Option<SensorFault>,
}

/// Something that was said of a sensor that was well.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FalseAlarm {
    /// The sensor's name.
    pub sensor: String,
    /// What was said.
    pub said: SensorFault,
}

/// The kinds of faults that are planted, in this order.
pub const KINDS: [&str; 8] =
    ["battery", "stuck, repeating", "drift", "bad_link", "stuck, silent", "falls_off", "false_fires", "moved"];

/// A link with half of the kinds of faults, each of another of the motion sensors: the half and the sensors go by `number`.
pub fn faulty(scenario: &Scenario, number: usize, length: u32) -> LinkFile {
    let sensors = scenario.home.placed_sensors();
    let mut motion: Vec<String> =
        sensors.iter().filter(|sensor| sensor.senses_motion()).map(|sensor| sensor.name.clone()).collect();
    let mut stream = Stream::named(number as u64, "planted");
    for place in (1..motion.len()).rev() {
        let other = (stream.unit() * (place + 1) as f64) as usize;
        motion.swap(place, other.min(place));
    }
    let half = KINDS.len() / 2;
    let kinds = &KINDS[number % 2 * half..][..half];
    let faults = kinds.iter().zip(motion).filter_map(|(kind, sensor)| fault(scenario, kind, sensor, f64::from(length)));
    LinkFile { preset: Network::Zigbee, faults: faults.collect(), ..LinkFile::default() }
}

/// A fault of a kind in a run of so many days. What is moved hangs where the next wall sensor of another room hangs.
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

/// Lives a home with a faulty link for some days, walks its log back, and asks what is wrong with its sensors.
///
/// # Errors
///
/// If the simulation fails, or the response of a sensor cannot be computed.
pub fn case(home: &Home, seed: u64, length: u32) -> Result<Case, LocatingError> {
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
    let faults: Vec<(&FaultFile, Planted)> =
        faults.filter_map(|fault| Some((fault, planted(fault, &names, &findings)?))).collect();
    let is_of = |finding: &FaultFinding, fault: &FaultFile| {
        fault.sensor() == Some(names[finding.sensor]) && overlaps(finding, fault)
    };
    let alarms = findings.iter().filter(|finding| !faults.iter().any(|(fault, _)| is_of(finding, fault)));
    let alarm = |finding: &FaultFinding| FalseAlarm { sensor: names[finding.sensor].into(), said: finding.ailment };
    Ok(Case {
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

/// What was said of a fault; of one of the logger nothing is asked.
fn planted(fault: &FaultFile, names: &[&str], findings: &[FaultFinding]) -> Option<Planted> {
    let sensor = fault.sensor()?;
    let of = |finding: &&FaultFinding| names[finding.sensor] == sensor && overlaps(finding, fault);
    let all: Vec<&FaultFinding> = findings.iter().filter(of).collect();
    let right = all.iter().find(|finding| is_named(fault, finding.ailment));
    let said = right.or(all.first());
    let late = |from: RunTime| (from - fault.span().begin).ratio(DAY);
    Some(Planted {
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

/// Whether this is what a fault looks like.
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
