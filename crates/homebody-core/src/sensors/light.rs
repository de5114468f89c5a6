//! A light meter in a room.
//!
//! The device measures illuminance every so often, as those of the CASAS homes do, and says it, in whole lux, when it has
//! changed by enough.
//!
//! We assume that daylight in the room follows the sine of the sun's height to the power of 1.2, because the air
//! absorbs more of a low sun (our choice), and that the room's lamp always adds the same. The sensor notices at once
//! that a lamp is turned on or off.
//!
//! It speaks up when what it measures differs from what it last said by more than the given share of that, and by a lux at
//! least, which is the step of CASAS' own. Its first measurement is always said.
//!
//! Left out: clouds, curtains, which way the windows look, light from the next room, twilight, noise.

use super::entities::EntityRow;
use super::meaning::Meaning;
use super::outbox::{Change, DeviceModel, Outbox, reading};
use super::rounds::Rounds;
use crate::event::Trigger;
use crate::ids::{ResidentId, ThingId};
use crate::numbers::Numbers;
use crate::plan::sun::Sun;
use crate::random::Stream;
use crate::sensors::form::{Colour, KindRow, Mount, SensorForm, Shape, Site, Unit};
use crate::time::{RunTime, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "light",
    label: "light",
    mount: Mount::Room,
    unit: Some(Unit::LUX),
    values: &[],
    shape: Shape::Star,
    colour: Colour::Yellow,
    casas: "LS",
    meaning: Meaning::UseOrReading,
    entities: &[EntityRow::reading("illuminance")],
};

/// A light meter in a room. Its events are readings in lux.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "light sensor")]
pub struct LightFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Room that the sensor is in.
    pub room: String,
    /// Daylight through the windows with the sun at the zenith. It is 0 without a window.
    #[serde(default = "daylight")]
    #[schemars(range(min = 0, max = 100_000))]
    pub daylight_lux: f64,
    /// Light of the room's lamp.
    #[serde(default = "lamp")]
    #[schemars(range(min = 0, max = 100_000))]
    pub lamp_lux: f64,
    /// Smallest change since the last event that makes the sensor send a reading.
    #[serde(default = "change")]
    #[schemars(range(min = 0.1, max = 1_000))]
    pub change_percent: f64,
    /// Interval between measurements.
    #[serde(default = "light_every")]
    #[schemars(range(min = 1, max = 86_400))]
    pub every_s: f64,
}

impl SensorForm for LightFile {
    fn room(&self) -> Option<&str> {
        Some(&self.room)
    }
}

crate::numbers! {
    /// Exponent of the sine of the sun's elevation in the daylight of a room.
    static POWER = "light.power": 1.2, "1", [0.5, 3.0];
}

/// Resolution, in lux.
const STEP_LUX: f64 = 1.0;

/// A light sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The room's lamp: index into the home's things.
    lamp: ThingId,
    lamp_on: bool,
    /// The last use of the lamp since the last measurement, with the user; `Some(None)` from outside.
    by: Option<Option<ResidentId>>,
    daylight_lux: f64,
    lamp_lux: f64,
    change: f64,
    sun: Sun,
    power: f64,
    rounds: Rounds,
    said_lux: Option<f64>,
}

impl Light {
    /// A sensor in the room whose lamp is that of this site.
    pub fn new(file: &LightFile, site: &Site) -> Light {
        Light {
            lamp: site.thing,
            lamp_on: false,
            by: None,
            daylight_lux: file.daylight_lux,
            lamp_lux: file.lamp_lux,
            change: file.change_percent / 100.0,
            sun: Sun::default(),
            power: POWER.value,
            rounds: Rounds::new(Span::from_seconds(file.every_s)),
            said_lux: None,
        }
    }
}

impl DeviceModel for Light {
    fn begin(&self, mut stream: Stream, sun: Sun, numbers: &Numbers) -> Light {
        let rounds = self.rounds.begin(&mut stream);
        Light { sun, rounds, power: numbers.of(&POWER), ..self.clone() }
    }

    fn on_event(&mut self, at: RunTime, change: &Change, _outbox: &mut Outbox) {
        if let Change::Use { resident, thing, on } = *change
            && thing == self.lamp
            && on != self.lamp_on
        {
            (self.lamp_on, self.by) = (on, Some(resident));
            self.rounds.wake(at);
        }
    }

    fn timer(&self) -> RunTime {
        self.rounds.next()
    }

    fn on_timer(&mut self, at: RunTime, outbox: &mut Outbox) {
        let now = self.lux(at);
        let by = self.by.take();
        if self.said_lux.is_none_or(|before| (now - before).abs() > (self.change * before).max(STEP_LUX)) {
            self.said_lux = Some(libm::round(now));
            let why = if by.is_some() { Trigger::Use(self.lamp) } else { Trigger::Reading };
            outbox.send(reading(libm::round(now)), by.flatten(), at, why);
        }
        self.rounds.advance(at);
    }
}

impl Light {
    fn lux(&self, at: RunTime) -> f64 {
        let daylight = self.daylight_lux * libm::pow(self.sun.elevation_sine(at).max(0.0), self.power);
        daylight + if self.lamp_on { self.lamp_lux } else { 0.0 }
    }
}

super::form::usual! {
    /// Ours.
    fn daylight() -> f64 = 400.0;
    /// Ours.
    fn lamp() -> f64 = 150.0;
    /// Ours.
    fn change() -> f64 = 20.0;
    /// Half of the light sensors' messages in a CASAS home (hh111) come 600 s after the one before.
    fn light_every() -> f64 = 600.0;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::event::Value;
    use crate::sensors::outbox::testing::{USER, readings, says};
    use crate::time::{DAY, HOUR, MINUTE};

    fn light() -> Light {
        let file = serde_json::json!({ "name": "l", "room": "kitchen" });
        let light = Light::new(&serde_json::from_value(file).unwrap(), &Site { thing: ThingId(3), ..Site::default() });
        // The equinox on the equator: the sun goes straight up and down, from 6 to 18 o'clock.
        let sun = Sun { day_of_year: 80.0, time_of_day: Span::ZERO, latitude_deg: 0.0 };
        Light { sun, ..light }
    }

    #[test]
    fn daylight_follows_the_sun() {
        let light = light();
        let lux = |hour: i64| light.lux(RunTime::START + hour * HOUR);
        assert_eq!([0, 5, 19].map(lux), [0.0; 3]);
        // Overhead but for the declination of the 22nd of March, cos(0.4 degrees).
        assert!((lux(12) - 400.0).abs() < 0.1);
        // At 9 it stands at 45 degrees: 400 * 0.7071^1.2 = 263.9.
        assert!((lux(9) - 263.9).abs() < 0.1);
    }

    #[test]
    fn it_says_what_has_changed_by_a_fifth_and_the_lamp_at_once() {
        let [start, one, two] =
            [RunTime::START, RunTime::START + HOUR + Span::from_micros(7), RunTime::START + 2 * HOUR];
        let uses = [(one, true), (one, true), (two, false)];
        let messages = says(&mut light(), ThingId(3), &uses, RunTime::START + DAY);
        let at_night = [(start, 0, None), (one, 150_000, Some(USER)), (two, 0, Some(USER))];
        assert_eq!(messages[..3], at_night.map(|(at, lux, by)| (at, Value::Reading(lux), by)));
        let lux = readings(&messages[2..]);
        assert!(lux.windows(2).all(|pair| (pair[1] - pair[0]).abs() > (0.2 * pair[0]).max(1.0) - 0.5), "{lux:?}");
        assert!((15..50).contains(&lux.len()), "{lux:?}");
        assert!(messages.iter().all(|(at, _, by)| by.is_some() || at.since_zero() % (10 * MINUTE) == Span::ZERO));
    }
}
