//! The kinds of sensors: the one list of them.
//!
//! It says of each kind what check, page and the destinations of logs have to know.
//!
//! We assume that all sensors of a kind say the same things, but for readings that a sensor's form turns off.
//!
//! A device is one line of `devices!`: the variant that it is of [`SensorFile`] and of
//! [`SensorDevice`], and its module, which has its row, its form and its model.
//!
//! Left out: how a sensor works, which its module says.

use super::ceiling_motion::CeilingMotionFile;
use super::form::{Colour, DeviceForm, FormProblem, KindRow, Mount, ReportedInstant, Shape, Site};
use super::motion::{LevelFile, MotionFile};
use super::notice::{Notice, NoticeChance};
use super::outbox::{Change, DeviceModel, Outbox};
use super::preset::{Preset, TimingSeconds};
use crate::event::Value;
use crate::geometry::At;
use crate::numbers::Numbers;
use crate::plan::sun::Sun;
use crate::random::Stream;
use crate::time::RunTime;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Hands the devices to a macro, in the order in which documents list them.
macro_rules! devices {
    ($to:ident) => {
        $to! {
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
    };
}

macro_rules! rows {
    ($($kind:ident($module:ident, $form:ident))*) => {
        /// All kinds of sensors: those that look for movement, then those that are told what happens.
        pub static KINDS: &[&KindRow] = &[&MOTION, &CEILING_MOTION, $(&super::$module::ROW),*];
    };
}
devices!(rows);

/// A sensor on a wall.
pub static MOTION: KindRow = KindRow {
    key: "motion",
    label: "motion, on a wall",
    mount: Mount::Wall,
    unit: None,
    values: &[Value::Fire],
    shape: Shape::Arrow,
    colour: Colour::Blue,
    casas: "M",
};

/// A sensor on the ceiling.
pub static CEILING_MOTION: KindRow = KindRow {
    key: "ceiling_motion",
    label: "motion, from the ceiling",
    mount: Mount::Ceiling,
    unit: None,
    values: &[Value::Fire],
    shape: Shape::Ring,
    colour: Colour::Sky,
    casas: "M",
};

macro_rules! sensor_file {
    ($($kind:ident($module:ident, $form:ident))*) => {
        /// A sensor, by kind.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(tag = "kind", rename_all = "snake_case")]
        #[schemars(title = "sensor")]
        #[allow(missing_docs, reason = "each kind's form says what it is, and the schema takes it from there")]
        pub enum SensorFile {
            Motion(MotionFile),
            CeilingMotion(CeilingMotionFile),
            $($kind(crate::sensors::$module::$form)),*
        }

        impl SensorFile {
            /// Its name, which no other sensor of the home has.
            pub fn name(&self) -> &str {
                match self {
                    SensorFile::Motion(sensor) => &sensor.name,
                    SensorFile::CeilingMotion(sensor) => &sensor.name,
                    $(SensorFile::$kind(sensor) => &sensor.name),*
                }
            }

            /// Its name, to be changed.
            pub fn name_mut(&mut self) -> &mut String {
                match self {
                    SensorFile::Motion(sensor) => &mut sensor.name,
                    SensorFile::CeilingMotion(sensor) => &mut sensor.name,
                    $(SensorFile::$kind(sensor) => &mut sensor.name),*
                }
            }

            /// The form of a sensor that is told what happens.
            fn device(&self) -> Option<&dyn DeviceForm> {
                match self {
                    SensorFile::Motion(_) | SensorFile::CeilingMotion(_) => None,
                    $(SensorFile::$kind(sensor) => Some(sensor)),*
                }
            }
        }
    };
}

devices!(sensor_file);

impl SensorFile {
    /// What there is to know of its kind.
    pub fn row(&self) -> &'static KindRow {
        match self {
            SensorFile::Motion(_) => &MOTION,
            SensorFile::CeilingMotion(_) => &CEILING_MOTION,
            _ => self.device().expect("all others are told what happens").row(),
        }
    }

    /// The thing that it hangs on, where it hangs on one.
    pub fn on(&self) -> Option<&str> {
        self.device().and_then(DeviceForm::on)
    }

    /// The room whose light or warmth it measures, where it measures either.
    pub fn room(&self) -> Option<&str> {
        self.device().and_then(DeviceForm::room)
    }

    /// The corners of the floor that it covers, where it lies on the floor.
    pub fn area(&self) -> Option<&[At]> {
        self.device().and_then(DeviceForm::area)
    }

    /// Where it hangs, where its form says the point and it does not look for movement.
    pub fn spot(&self) -> Option<At> {
        self.device().and_then(DeviceForm::spot)
    }

    /// The names of the sensors whose words wake it, where it sleeps.
    pub fn woken_by(&self) -> &[String] {
        self.device().map(DeviceForm::woken_by).unwrap_or_default()
    }

    /// What is wrong with it whatever the home is like, as far as its kind alone knows.
    pub fn wrong(&self) -> Vec<FormProblem> {
        self.device().map(DeviceForm::wrong).unwrap_or_default()
    }

    /// What it tells the very instant of.
    pub fn moment(&self) -> Option<ReportedInstant<'_>> {
        self.device().and_then(DeviceForm::moment)
    }

    /// Whether it says readings, where its kind has a unit.
    pub fn gives_readings(&self) -> bool {
        self.device().is_some_and(DeviceForm::gives_readings)
    }

    /// Whether it looks for movement, rather than being told what happens.
    pub fn senses_motion(&self) -> bool {
        matches!(self, SensorFile::Motion(_) | SensorFile::CeilingMotion(_))
    }

    /// What it notices of the movements in its field, where it looks for any: the preset's, unless the file says otherwise.
    pub fn notice(&self) -> Option<Notice> {
        match self {
            SensorFile::Motion(MotionFile { level: LevelFile::Zones(_), .. }) => Some(Notice::All),
            SensorFile::Motion(s) => Some(s.notice.unwrap_or(s.preset.notice())),
            SensorFile::CeilingMotion(s) => Some(s.notice.unwrap_or(s.preset.notice())),
            _ => None,
        }
    }

    /// The chance by which it notices movements; `None` for a sensor that notices all, or does not look for movement.
    pub fn notice_chance(&self) -> Option<NoticeChance> {
        let is_wide = matches!(self, SensorFile::Motion(wall) if wall.preset.is_casas());
        NoticeChance::new(self.notice()?, is_wide)
    }

    /// The device that it is, where it looks for movement.
    pub fn preset(&self) -> Option<Preset> {
        match self {
            SensorFile::Motion(sensor) => Some(sensor.preset),
            SensorFile::CeilingMotion(sensor) => Some(sensor.preset),
            _ => None,
        }
    }

    /// The numbers of the timing state machine: the preset's, with whatever the file overrides.
    ///
    /// A device's first delay holds the time of the pulses that it counts. A sensor at level `zones` has counted them
    /// when it sees, so that only its electronics are left.
    pub fn timing(&self) -> TimingSeconds {
        /// Shortest and longest delay of a sensor's electronics after it has counted its pulses (our choice).
        const COUNTED_S: [f64; 2] = [0.3, 0.8];
        let has_counted = matches!(self, SensorFile::Motion(MotionFile { level: LevelFile::Zones(_), .. }));
        let (preset, first, refire, persist) = match self {
            SensorFile::Motion(s) => (s.preset, s.first_fire_s, s.refire_s, s.persist_s),
            SensorFile::CeilingMotion(s) => (s.preset, s.first_fire_s, s.refire_s, s.persist_s),
            _ => (Preset::default(), None, None, None),
        };
        let timing = preset.timing();
        let [least, most] = timing.first_fire_s;
        let delay = if has_counted { [least.min(COUNTED_S[0]), most.min(COUNTED_S[1])] } else { [least, most] };
        TimingSeconds {
            first_fire_s: first.unwrap_or(delay),
            refire_s: refire.unwrap_or(timing.refire_s),
            persist_s: persist.unwrap_or(timing.persist_s),
        }
    }
}

macro_rules! device {
    ($($kind:ident($module:ident, $form:ident))*) => {
        /// A sensor that is told, one kind each.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(missing_docs, reason = "each kind's model says what it is, in a file of its own")]
        pub enum SensorDevice {
            $($kind(super::$module::$kind)),*
        }

        impl SensorDevice {
            /// The device that a file that has passed its checks describes, at its site; nothing for sensors that look for
            /// movement.
            pub fn new(file: &SensorFile, site: &Site) -> Option<SensorDevice> {
                match file {
                    SensorFile::Motion(_) | SensorFile::CeilingMotion(_) => None,
                    $(SensorFile::$kind(file) => Some(SensorDevice::$kind(super::$module::$kind::new(file, site)))),*
                }
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
devices!(device);
