//! Motion sensors whose timing is known.
//!
//! A device reports a movement after a short delay, then again at intervals, and notices only some movements.
//!
//! We assume that all units of a make behave alike.
//!
//! A preset is a name in `home.json`. The timing of each is in one table, with its source.
//!
//! Left out: height, field and reach, which are in the catalogue of [`products`](super::products).

use crate::sensors::notice::{ChanceFile, Notice};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

crate::worded::worded! {
    /// A motion sensor with a known timing.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema, Default)]
    #[serde(rename_all = "snake_case")]
    #[schemars(title = "preset")]
    pub enum Preset {
        /// The sensor of Godsey & Skubic 2009: first firing after 1-2 s, then every 6-8 s.
        #[default]
        Paper = "paper",
        /// X10 ActiveEye MS16A: 10 s between detections, by its manual.
        X10Ms16a = "x10_ms16a",
        /// CASAS homes with Bosch units: their ON lasts a fixed 4 s.
        CasasPulse = "casas_pulse",
        /// CASAS homes with Control4 units: their ON follows the movement.
        CasasFollow = "casas_follow",
        /// Aqara RTCGQ11LM: blind for 60 s after a detection.
        Aqara = "aqara",
        /// Philips Hue indoor motion sensor.
        Hue = "hue",
        /// Aqara P1 RTCGQ14LM: blind for 30 s after a detection, the factory setting.
        AqaraP1 = "aqara_p1",
        /// Fibaro FGMS-001: blind for 8 s after a detection, the factory setting.
        Fibaro = "fibaro",
        /// Aeotec TriSensor ZWA005: blind for 30 s after a detection, the factory setting.
        Aeotec = "aeotec",
    }
    /// Every preset, in the order of documents.
    ALL
    /// The key in `home.json`.
    fn key
}

impl Preset {
    /// Whether it is a unit of the CASAS homes, which have wide sensors on walls as well as narrow ones on ceilings.
    pub fn is_casas(self) -> bool {
        matches!(self, Preset::CasasPulse | Preset::CasasFollow)
    }

    /// The movements that the device notices. The paper's notices all: its rays are cast at all moving bodies.
    pub fn notice(self) -> Notice {
        match self {
            Preset::Paper => Notice::All,
            _ => Notice::Chance(ChanceFile::default()),
        }
    }
}

/// The keys that the forms of all sensors that look for movement share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "settings of motion sensors")]
pub struct MotionSettings {
    /// Device model. It sets the timing of events and which movements the sensor notices.
    #[serde(default)]
    pub preset: Preset,
    /// Overrides the preset: which movements in its field the sensor notices.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub notice: Option<Notice>,
    /// Overrides the preset: shortest and longest delay from the first movement to the first firing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0, max = 86_400)))]
    pub first_fire_s: Option<[f64; 2]>,
    /// Overrides the preset: shortest and longest wait between firings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = 0.01, max = 86_400)))]
    pub refire_s: Option<[f64; 2]>,
    /// Overrides the preset: how long before the end of a wait a movement still counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 86_400))]
    pub persist_s: Option<f64>,
}

/// The numbers of the timing state machine, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimingSeconds {
    /// From the first movement to the first firing, least and most.
    pub first_fire_s: [f64; 2],
    /// From a firing to the decision about the next, least and most.
    pub refire_s: [f64; 2],
    /// The time before that decision in which a movement still counts.
    pub persist_s: f64,
}

impl Preset {
    /// The timing of the device. If a maker states one number, the range collapses to it.
    ///
    /// No source gives `persist_s`: 1 s is ours. Of first delays only the paper's are measured: 0.1 to 0.5 s is ours.
    pub fn timing(self) -> TimingSeconds {
        let timing = |first_fire_s, refire_s, persist_s| TimingSeconds { first_fire_s, refire_s, persist_s };
        match self {
            // Godsey & Skubic 2009, section III.D, but for `persist_s`.
            Preset::Paper => timing([1.0, 2.0], [6.0, 8.0], 1.0),
            // X10 Active Eye setup guide: 10 s until it trips again. The first delay is the paper's, whose sensors
            // are of this class.
            Preset::X10Ms16a => timing([1.0, 2.0], [10.0, 10.0], 1.0),
            // Read off a CASAS home with Bosch units: never again before about 5.4 s, and then with the next movement that is
            // noticed. That makes the 5th percentile of ON to ON, 5.5 s, and leaves the median, 8.8 s, to chance.
            Preset::CasasPulse => timing([0.05, 0.4], [5.4, 5.6], 0.1),
            // Read off CASAS homes with Control4 units: of the ONs that are longer than the shortest, 1.1 s, the shortest last 1.7 s:
            // a movement 0.55 s after the last prolongs the ON to 1.1 s after itself.
            Preset::CasasFollow => timing([0.05, 0.4], [0.55, 0.65], 0.45),
            // Zigbee2MQTT, page RTCGQ11LM: ignores movement for exactly 60 s.
            Preset::Aqara => timing([0.1, 0.5], [60.0, 60.0], 1.0),
            // Ours: the maker publishes no blind time.
            Preset::Hue => timing([0.1, 0.5], [10.0, 10.0], 1.0),
            // deCONZ, page of the RTCGQ14LM: 30 s unless it is set otherwise.
            Preset::AqaraP1 => timing([0.1, 0.5], [30.0, 30.0], 1.0),
            // OpenZWave, fibaro/fgms.xml: half a second times one more than parameter 2, which is 15.
            Preset::Fibaro => timing([0.1, 0.5], [8.0, 8.0], 1.0),
            // Aeotec's manual of the ZWA005: parameter 1, the time until it can be triggered again, is 30 s.
            Preset::Aeotec => timing([0.1, 0.5], [30.0, 30.0], 1.0),
        }
    }
}
