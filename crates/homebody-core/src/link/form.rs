//! `link.json`: the way from the sensors to the logger, and the faults of both.

use crate::calendar::time_of_day;
use crate::geometry::At;
use crate::time::{DAY, Interval, RunTime, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `link.json`: how messages travel from the sensors to the logger, and which faults occur.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "link")]
pub struct LinkFile {
    /// Path or URL of this file's JSON Schema, for editors.
    #[serde(rename = "$schema", skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Network that sets the values of the keys below that are not given.
    pub preset: Network,
    /// The values of all sensors.
    #[serde(flatten)]
    pub rates: SensorLinkFile,
    /// A radio channel that all sensors share. No sensor listens before it sends.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radio: Option<RadioFile>,
    /// Sensors with other values, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    #[schemars(extend("maxProperties" = 2_000))]
    pub sensors: BTreeMap<String, SensorLinkFile>,
    /// Faults, each with its time.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 1_000))]
    pub faults: Vec<FaultFile>,
}

/// A network with measured or assumed values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, Default)]
#[serde(rename_all = "snake_case")]
#[schemars(title = "network")]
pub enum Network {
    /// Every message arrives at once, and nothing goes wrong.
    #[default]
    Perfect,
    /// X10 radio: five copies of every message. No sender listens before it sends.
    X10,
    /// A Zigbee mesh.
    Zigbee,
    /// A Z-Wave mesh.
    Zwave,
}

/// The numbers of the way of one sensor's messages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkRates {
    /// From being received to being logged, in seconds, least and most.
    pub delay_s: [f64; 2],
    /// Share of the messages lost on the way, from 0 to 1.
    pub loss: f64,
    /// Share of the messages that come twice, from 0 to 1.
    pub duplicates: f64,
    /// Share of the messages that come with a wrong id or a wrong value, from 0 to 1.
    pub corruption: f64,
    /// Share of what it should say that the sensor does not notice, from 0 to 1.
    pub misses: f64,
    /// The rate of false firings, per hour.
    pub false_fires_per_h: f64,
}

impl Network {
    /// The numbers of the network and of motion sensors in it.
    ///
    /// That sensors in homes miss some movements and fire for no reason is known (Panasonic's cautions on PaPIRs), how
    /// often is not: one in fifty and once in 50 hours are ours.
    pub fn rates(self) -> LinkRates {
        let rates = |delay_s, loss, duplicates, corruption| {
            let (misses, false_fires_per_h) = (0.02, 0.02);
            LinkRates { delay_s, loss, duplicates, corruption, misses, false_fires_per_h }
        };
        match self {
            Network::Perfect => LinkRates { misses: 0.0, false_fires_per_h: 0.0, ..rates([0.0, 0.0], 0.0, 0.0, 0.0) },
            // Ours, from loss by noise of 0.5 to 2 %. A code of 16 bits and their complement lets next to no wrong
            // message through; the way from the receiver to the logger takes up to 50 ms.
            Network::X10 => rates([0.0, 0.05], 0.01, 0.0, 0.0001),
            // Ours: 0.1 to 1 % are lost after the retries, which take tens of milliseconds; a receipt that gets lost
            // makes a message come twice; a checksum leaves no wrong one.
            Network::Zigbee => rates([0.02, 0.08], 0.003, 0.001, 0.0),
            // Ours: as Zigbee, on a slower radio.
            Network::Zwave => rates([0.03, 0.15], 0.003, 0.001, 0.0),
        }
    }
}

/// A channel on which every message is sent several times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "radio")]
pub struct RadioFile {
    /// Number of copies of each message.
    #[schemars(range(min = 1, max = 100))]
    pub copies: u32,
    /// Time that one copy takes on the air.
    #[schemars(range(min = 0.0001, max = 10))]
    pub frame_s: f64,
    /// Silence between copies.
    #[schemars(range(min = 0, max = 10))]
    pub gap_s: f64,
}

/// X10: a leader of 13.5 ms and 32 bits make 68 ms, with 40 ms of silence between at least five copies
/// (dokumen.tips, X10 RF receiver; rtl_433, `x10_rf.c`).
impl Default for RadioFile {
    fn default() -> Self {
        RadioFile { copies: 5, frame_s: 0.068, gap_s: 0.04 }
    }
}

/// Effects of the link on the messages of all sensors, or of one that differs from the others.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "sensor's link")]
pub struct SensorLinkFile {
    /// Shortest and longest time from reception to the log.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0, max = 3_600)))]
    pub delay_s: Option<[f64; 2]>,
    /// Share of the messages that are lost on the way, each independently.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1))]
    pub loss: Option<f64>,
    /// Share of the messages that arrive twice.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1))]
    pub duplicates: Option<f64>,
    /// Share of the messages that arrive with a wrong id or a wrong value.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1))]
    pub corruption: Option<f64>,
    /// Share of firings that are missed. The value for all sensors applies to motion sensors only.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1))]
    pub misses: Option<f64>,
    /// Rate of false firings. Only motion sensors have any.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1_000))]
    pub false_fires_per_h: Option<f64>,
}

impl LinkFile {
    /// The numbers that hold for a sensor; only those that look for movement miss it or see what is not there, unless
    /// the sensor's own entry says so.
    pub fn rates(&self, sensor: &str, looks: bool) -> LinkRates {
        let preset = self.preset.rates();
        let own = self.sensors.get(sensor).cloned().unwrap_or_default();
        let of_all = |given: Option<f64>, preset: f64| if looks { given.unwrap_or(preset) } else { 0.0 };
        let false_fires = of_all(self.rates.false_fires_per_h, preset.false_fires_per_h);
        LinkRates {
            delay_s: own.delay_s.or(self.rates.delay_s).unwrap_or(preset.delay_s),
            loss: own.loss.or(self.rates.loss).unwrap_or(preset.loss),
            duplicates: own.duplicates.or(self.rates.duplicates).unwrap_or(preset.duplicates),
            corruption: own.corruption.or(self.rates.corruption).unwrap_or(preset.corruption),
            misses: own.misses.unwrap_or(of_all(self.rates.misses, preset.misses)),
            false_fires_per_h: own.false_fires_per_h.unwrap_or(false_fires),
        }
    }

    /// The channel that the sensors share, if they can get in each other's way.
    pub fn channel(&self) -> Option<RadioFile> {
        self.radio.clone().or((self.preset == Network::X10).then(RadioFile::default))
    }
}

/// A fault. Days count from the run's start, which is day 0, and may have a fraction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[schemars(title = "fault")]
#[allow(missing_docs, reason = "each fault's form says what it is, and the schema takes it from there")]
pub enum FaultFile {
    Battery(BatteryFile),
    Stuck(StuckFile),
    FallsOff(FallsOffFile),
    Moved(MovedFile),
    Drift(DriftFile),
    FalseFires(FalseFiresFile),
    BadLink(BadLinkFile),
    Outage(OutageFile),
}

/// A battery that fades until its sensor is silent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "battery fault")]
pub struct BatteryFile {
    /// Name of the sensor in the home.
    pub sensor: String,
    /// Day on which the battery begins to fade.
    #[serde(default)]
    #[schemars(range(min = 0, max = 36_525))]
    pub from_day: f64,
    /// Duration of the fading. The share of lost messages grows evenly to all of them.
    #[serde(default)]
    #[schemars(range(min = 0, max = 36_525))]
    pub fading_days: f64,
    /// Days from `from_day` until the battery is replaced. Without it, the battery stays empty.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.00001, max = 36_525))]
    pub days: Option<f64>,
}

/// A stuck sensor: it detects nothing, and repeats its last value or is silent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "stuck fault")]
pub struct StuckFile {
    /// Name of the sensor in the home.
    pub sensor: String,
    /// Day on which the sensor gets stuck.
    #[serde(default)]
    #[schemars(range(min = 0, max = 36_525))]
    pub from_day: f64,
    /// Duration of the fault. Without it, the fault lasts to the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.00001, max = 36_525))]
    pub days: Option<f64>,
    /// Interval at which the sensor repeats its last value. Without it, the sensor is silent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.1, max = 86_400))]
    pub every_s: Option<f64>,
}

/// A sensor that has fallen off its place. It detects nothing real, and keeps its false firings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "falls_off fault")]
pub struct FallsOffFile {
    /// Name of the sensor in the home.
    pub sensor: String,
    /// Day on which the sensor falls off.
    #[serde(default)]
    #[schemars(range(min = 0, max = 36_525))]
    pub from_day: f64,
    /// Days from `from_day` until the sensor is put back. Without it, the sensor stays off its place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.00001, max = 36_525))]
    pub days: Option<f64>,
}

/// A wall sensor that hangs elsewhere from then on, until it is moved again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "moved fault")]
pub struct MovedFile {
    /// Name of a wall sensor in the home.
    pub sensor: String,
    /// Day on which the sensor is moved.
    #[serde(default)]
    #[schemars(range(min = 0, max = 36_525))]
    pub from_day: f64,
    /// Position from then on.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub at: At,
    /// Direction of the lens from then on: 0 is east, 90 is north.
    #[schemars(range(min = -360, max = 360))]
    pub facing_deg: f64,
}

/// A clock error, in a sensor whose messages carry the time of its own clock.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "drift fault")]
pub struct DriftFile {
    /// Name of the sensor in the home.
    pub sensor: String,
    /// Drift of the clock, in microseconds a second. A positive drift is too fast, a negative one too slow.
    #[serde(default)]
    #[schemars(range(min = -1_000, max = 1_000))]
    pub ppm: f64,
    /// Offset of the clock at the start of the run. A negative offset is behind.
    #[serde(default)]
    #[schemars(range(min = -86_400, max = 86_400))]
    pub offset_s: f64,
}

/// False firings, as from the sun or a heater.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "false_fires fault")]
pub struct FalseFiresFile {
    /// Name of a motion sensor in the home.
    pub sensor: String,
    /// Day on which the false firings begin.
    #[serde(default)]
    #[schemars(range(min = 0, max = 36_525))]
    pub from_day: f64,
    /// Duration of the fault. Without it, the fault lasts to the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.00001, max = 36_525))]
    pub days: Option<f64>,
    /// Rate of the false firings, in addition to those of the network.
    #[schemars(range(min = 0, max = 1_000))]
    pub per_h: f64,
    /// First and last time of day, such as `["10:00", "15:00"]`. Without it, the firings come at any time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[String; 2]>,
}

/// A link that loses more messages than the others, as over a long distance or behind a fridge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "bad_link fault")]
pub struct BadLinkFile {
    /// Name of the sensor in the home.
    pub sensor: String,
    /// Day on which the link becomes bad.
    #[serde(default)]
    #[schemars(range(min = 0, max = 36_525))]
    pub from_day: f64,
    /// Duration of the fault. Without it, the fault lasts to the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.00001, max = 36_525))]
    pub days: Option<f64>,
    /// Share of the messages lost, in addition to the network's. Bad Zigbee links lose 0.1 to 0.3 (our estimate).
    #[schemars(range(min = 0, max = 1))]
    pub loss: f64,
}

/// An outage of the logger: messages that arrive meanwhile are lost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "outage")]
pub struct OutageFile {
    /// Day on which the logger stops. With `at`, the earliest day.
    #[serde(default)]
    #[schemars(range(min = 0, max = 36_525))]
    pub from_day: f64,
    /// Time of day at which the outage begins, the first such time from `from_day` on. Without it, it begins at
    /// `from_day`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<String>,
    /// Duration of the outage.
    #[schemars(range(min = 0.0001, max = 876_600))]
    pub hours: f64,
}

impl FaultFile {
    /// The sensor with this fault; `None` for an outage of the logger.
    pub fn sensor(&self) -> Option<&str> {
        match self {
            FaultFile::Battery(BatteryFile { sensor, .. })
            | FaultFile::Stuck(StuckFile { sensor, .. })
            | FaultFile::FallsOff(FallsOffFile { sensor, .. })
            | FaultFile::Moved(MovedFile { sensor, .. })
            | FaultFile::Drift(DriftFile { sensor, .. })
            | FaultFile::FalseFires(FalseFiresFile { sensor, .. })
            | FaultFile::BadLink(BadLinkFile { sensor, .. }) => Some(sensor),
            FaultFile::Outage(_) => None,
        }
    }

    /// Its kind, as files write it.
    pub fn kind(&self) -> &'static str {
        match self {
            FaultFile::Battery(_) => "battery",
            FaultFile::Stuck(_) => "stuck",
            FaultFile::FallsOff(_) => "falls_off",
            FaultFile::Moved(_) => "moved",
            FaultFile::Drift(_) => "drift",
            FaultFile::FalseFires(_) => "false_fires",
            FaultFile::BadLink(_) => "bad_link",
            FaultFile::Outage(_) => "outage",
        }
    }

    /// From when until when in a run whose clocks show `start_of_day` as it begins: an outage waits for its time of day. Its
    /// days have 24 hours, as those of all faults.
    pub fn span_from(&self, start_of_day: Span) -> Interval<RunTime> {
        let Interval { begin, end } = self.span();
        let time = match self {
            FaultFile::Outage(outage) => outage.at.as_deref().and_then(time_of_day),
            _ => None,
        };
        let late = time.map_or(Span::ZERO, |time| (time - start_of_day - begin.since_zero()).rem_euclid(DAY));
        Interval::new(begin + late, end.saturating_add(late))
    }

    /// From when until when; what does not end ends never.
    pub fn span(&self) -> Interval<RunTime> {
        match self {
            FaultFile::Battery(fault) => days_from(fault.from_day, fault.days),
            FaultFile::Stuck(fault) => days_from(fault.from_day, fault.days),
            FaultFile::FallsOff(fault) => days_from(fault.from_day, fault.days),
            FaultFile::Moved(fault) => days_from(fault.from_day, None),
            FaultFile::Drift(_) => Interval::new(RunTime::START, RunTime::NEVER),
            FaultFile::FalseFires(fault) => days_from(fault.from_day, fault.days),
            FaultFile::BadLink(fault) => days_from(fault.from_day, fault.days),
            FaultFile::Outage(fault) => days_from(fault.from_day, Some(fault.hours / 24.0)),
        }
    }
}

/// From a day of the run on, for so many days; without `days`, for ever. Day 0 begins with the run.
fn days_from(from_day: f64, days: Option<f64>) -> Interval<RunTime> {
    let begin = RunTime::from_days(from_day);
    Interval::new(begin, days.map_or(RunTime::NEVER, |days| begin.saturating_add(Span::from_days(days))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::HOUR;

    #[test]
    fn an_outage_begins_when_clocks_next_show_its_time() {
        let begins = |from_day: f64, at: &str| {
            let outage = serde_json::json!({ "kind": "outage", "from_day": from_day, "at": at, "hours": 5 });
            let outage = serde_json::from_value::<FaultFile>(outage).unwrap().span_from(22 * HOUR);
            assert_eq!(outage.length(), 5 * HOUR);
            outage.begin.since_zero() / HOUR
        };
        assert_eq!([begins(0.0, "23:00"), begins(0.0, "22:00"), begins(0.0, "21:00")], [1, 0, 23]);
        assert_eq!([begins(1.25, "05:00"), begins(1.25, "03:00")], [31, 53]);
    }
}
