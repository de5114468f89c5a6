//! The list of all kinds of sensors.
//!
//! Check, page and the destinations of logs read it.
//!
//! We assume that all sensors of a kind send the same values, except for readings that a sensor's form turns off.
//!
//! A kind is one line of `sensors!`: its variant of [`SensorFile`], and its module with its row, its form and its model. Kinds that
//! look for movement come first; devices, which react to use, weight or state, follow.
//!
//! Left out: the models, which are in the modules of the kinds.

use super::camera::CameraFile;
use super::form::{KindRow, Mount, SensorForm, Site};
use super::looking::{DetectionLevel, LookingModel};
use super::motion::Motion;
use super::notice::{Notice, NoticeChance, View};
use super::outbox::{Change, DeviceModel, Outbox};
use super::preset::{MotionSettings, Preset, TimingSeconds};
use crate::geometry::Point;
use crate::numbers::Numbers;
use crate::plan::Plan;
use crate::plan::sun::Sun;
use crate::random::Stream;
use crate::stride::Beam;
use crate::time::RunTime;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::{Deref, DerefMut};

/// Passes the kinds to a macro, in the order of documents.
macro_rules! sensors {
    ($to:ident) => {
        $to! {
            looking {
                Motion(motion, MotionFile)
                CeilingMotion(ceiling_motion, CeilingMotionFile)
            }
            devices {
                Contact(contact, ContactFile)
                Bed(bed, BedFile)
                StoveTemperature(stove_temperature, StoveTemperatureFile)
                Pressure(pressure, PressureFile)
                Power(power, PowerFile)
                Flow(flow, FlowFile)
                Light(light, LightFile)
                Temperature(temperature, TemperatureFile)
                Camera(camera, CameraFile)
            }
        }
    };
}

macro_rules! sensor_file {
    (
        looking { $($look:ident($look_module:ident, $look_form:ident))* }
        devices { $($kind:ident($module:ident, $form:ident))* }
    ) => {
        /// The rows of all kinds of sensors.
        pub static KINDS: &[&KindRow] = &[$(&super::$look_module::ROW,)* $(&super::$module::ROW),*];

        /// A sensor, by kind.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(tag = "kind", rename_all = "snake_case")]
        #[schemars(title = "sensor")]
        #[allow(missing_docs, reason = "each kind's form says what it is, and the schema takes it from there")]
        pub enum SensorFile {
            $($look(crate::sensors::$look_module::$look_form),)*
            $($kind(crate::sensors::$module::$form)),*
        }

        impl SensorFile {
            /// The row of its kind.
            pub fn row(&self) -> &'static KindRow {
                match self {
                    $(SensorFile::$look(_) => &super::$look_module::ROW,)*
                    $(SensorFile::$kind(_) => &super::$module::ROW),*
                }
            }

            /// The name, unique in the home.
            pub fn name(&self) -> &str {
                match self {
                    $(SensorFile::$look(sensor) => &sensor.name,)*
                    $(SensorFile::$kind(sensor) => &sensor.name),*
                }
            }

            /// The name, to be changed.
            pub fn name_mut(&mut self) -> &mut String {
                match self {
                    $(SensorFile::$look(sensor) => &mut sensor.name,)*
                    $(SensorFile::$kind(sensor) => &mut sensor.name),*
                }
            }

            /// The settings of a sensor that looks for movement.
            pub fn settings(&self) -> Option<MotionSettings> {
                match self {
                    $(SensorFile::$look(sensor) => Some(sensor.settings),)*
                    $(SensorFile::$kind(_) => None),*
                }
            }

            /// Changes the settings of a sensor that looks for movement. Devices stay the same.
            pub fn change_settings(&mut self, change: impl FnOnce(&mut MotionSettings)) {
                match self {
                    $(SensorFile::$look(sensor) => change(&mut sensor.settings),)*
                    $(SensorFile::$kind(_) => {})*
                }
            }
        }

        impl Deref for SensorFile {
            type Target = dyn SensorForm;

            fn deref(&self) -> &Self::Target {
                match self {
                    $(SensorFile::$look(sensor) => sensor,)*
                    $(SensorFile::$kind(sensor) => sensor),*
                }
            }
        }

        impl DerefMut for SensorFile {
            fn deref_mut(&mut self) -> &mut Self::Target {
                match self {
                    $(SensorFile::$look(sensor) => sensor,)*
                    $(SensorFile::$kind(sensor) => sensor),*
                }
            }
        }
    };
}
sensors!(sensor_file);

impl SensorFile {
    /// The form of a camera.
    pub fn camera(&self) -> Option<&CameraFile> {
        match self {
            SensorFile::Camera(camera) => Some(camera),
            _ => None,
        }
    }

    /// Whether it looks for movement, unlike a device.
    pub fn senses_motion(&self) -> bool {
        self.row().senses_motion()
    }

    /// The movements in its field that it notices, if it looks for movement.
    pub fn notice(&self) -> Option<Notice> {
        let MotionSettings { notice, preset, .. } = self.settings()?;
        Some(if self.counts_pulses() { Notice::All } else { notice.unwrap_or(preset.notice()) })
    }

    /// The chance by which it notices movements; `None` for a sensor that notices all, or does not look for movement.
    pub fn notice_chance(&self) -> Option<NoticeChance> {
        let is_wide = self.row().mount == Mount::Wall && self.preset()?.is_casas();
        NoticeChance::new(self.notice()?, is_wide)
    }

    /// The device model of a sensor that looks for movement.
    pub fn preset(&self) -> Option<Preset> {
        Some(self.settings()?.preset)
    }

    /// The numbers of the timing state machine: the preset's, unless the file overrides them.
    ///
    /// A device's first delay holds the time of the pulses that it counts. A sensor at level `zones` has counted them
    /// when it sees, so that only its electronics are left.
    pub fn timing(&self) -> TimingSeconds {
        /// Shortest and longest delay of a sensor's electronics after it has counted its pulses (our choice).
        const COUNTED_S: [f64; 2] = [0.3, 0.8];
        let settings = self.settings();
        let timing = settings.map_or(Preset::default(), |settings| settings.preset).timing();
        let [least, most] = timing.first_fire_s;
        let delay =
            if self.counts_pulses() { [least.min(COUNTED_S[0]), most.min(COUNTED_S[1])] } else { [least, most] };
        TimingSeconds {
            first_fire_s: settings.and_then(|settings| settings.first_fire_s).unwrap_or(delay),
            refire_s: settings.and_then(|settings| settings.refire_s).unwrap_or(timing.refire_s),
            persist_s: settings.and_then(|settings| settings.persist_s).unwrap_or(timing.persist_s),
        }
    }
}

macro_rules! model {
    (
        looking { $($look:ident($look_module:ident, $look_form:ident))* }
        devices { $($kind:ident($module:ident, $form:ident))* }
    ) => {
        /// A sensor that looks for movement, by kind.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs, reason = "each kind's model says what it is, in a file of its own")]
        pub enum LookingSensor {
            $($look(super::$look_module::$look)),*
        }

        /// A sensor that reacts to use, weight or state, by kind.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs, reason = "each kind's model says what it is, in a file of its own")]
        pub enum SensorDevice {
            $($kind(super::$module::$kind)),*
        }

        impl SensorKind {
            /// The model of a checked file and its position; `None` for a device without a site.
            pub(super) fn placed(file: &SensorFile, site: impl FnOnce() -> Option<Site>) -> Option<(SensorKind, Point)> {
                Some(match file {
                    $(SensorFile::$look(file) => {
                        let looking = LookingSensor::$look(super::$look_module::$look::new(file));
                        let lens = looking.lens();
                        (SensorKind::Looking(looking), lens)
                    })*
                    $(SensorFile::$kind(file) => {
                        let site = site()?;
                        let device = SensorDevice::$kind(super::$module::$kind::new(file, &site));
                        (SensorKind::Device(Box::new(device)), site.at)
                    })*
                })
            }
        }

        impl LookingModel for LookingSensor {
            fn lens(&self) -> Point {
                match self { $(LookingSensor::$look(looking) => looking.lens()),* }
            }

            fn beams(&self, plan: &Plan, body_m: f64) -> Vec<Beam> {
                match self { $(LookingSensor::$look(looking) => looking.beams(plan, body_m)),* }
            }

            fn view(&self, at: Point) -> View {
                match self { $(LookingSensor::$look(looking) => looking.view(at)),* }
            }

            fn level(&self) -> DetectionLevel {
                match self { $(LookingSensor::$look(looking) => looking.level()),* }
            }

            fn area_below(&self) -> Option<&[Point]> {
                match self { $(LookingSensor::$look(looking) => looking.area_below()),* }
            }
        }

        impl DeviceModel for SensorDevice {
            fn begin(&self, stream: Stream, sun: Sun, numbers: &Numbers) -> SensorDevice {
                match self { $(SensorDevice::$kind(device) => SensorDevice::$kind(device.begin(stream, sun, numbers))),* }
            }

            fn feels_bodies(&self) -> bool {
                match self { $(SensorDevice::$kind(device) => device.feels_bodies()),* }
            }

            fn sees_bodies(&self) -> bool {
                match self { $(SensorDevice::$kind(device) => device.sees_bodies()),* }
            }

            fn woken_by(&self) -> &[String] {
                match self { $(SensorDevice::$kind(device) => device.woken_by()),* }
            }

            fn is_awake(&self) -> bool {
                match self { $(SensorDevice::$kind(device) => device.is_awake()),* }
            }

            fn on_event(&mut self, at: RunTime, change: &Change, outbox: &mut Outbox) {
                match self { $(SensorDevice::$kind(device) => device.on_event(at, change, outbox)),* }
            }

            fn timer(&self) -> RunTime {
                match self { $(SensorDevice::$kind(device) => device.timer()),* }
            }

            fn on_timer(&mut self, at: RunTime, outbox: &mut Outbox) {
                match self { $(SensorDevice::$kind(device) => device.on_timer(at, outbox)),* }
            }
        }
    };
}
sensors!(model);

/// The model of a sensor.
#[derive(Clone, Debug, PartialEq)]
pub enum SensorKind {
    /// It looks for movement.
    Looking(LookingSensor),
    /// It reacts to use, weight or state; in its state when a run begins.
    Device(Box<SensorDevice>),
}

impl SensorKind {
    /// The model, if it looks for movement.
    pub fn looking(&self) -> Option<&LookingSensor> {
        match self {
            SensorKind::Looking(looking) => Some(looking),
            SensorKind::Device(_) => None,
        }
    }

    /// The fan of blades, if it has one. Levels other than `paper` need it.
    pub fn fan(&self) -> Option<&Motion> {
        match self {
            SensorKind::Looking(LookingSensor::Motion(fan)) => Some(fan),
            _ => None,
        }
    }

    /// Its beams on bodies of this height; a device has none.
    pub fn beams(&self, plan: &Plan, body_m: f64) -> Vec<Beam> {
        self.looking().map(|looking| looking.beams(plan, body_m)).unwrap_or_default()
    }

    /// The outline of the area below it, counter-clockwise.
    pub fn area_below(&self) -> Option<&[Point]> {
        self.looking()?.area_below()
    }
}
