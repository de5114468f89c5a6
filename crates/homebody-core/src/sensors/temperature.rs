//! A thermometer in a room.
//!
//! The device measures at a fixed interval, and reports the temperature, rounded to a step, when it has changed by a step.
//!
//! We assume that the room's temperature is the sum of a mean, a daily swing that peaks three hours after solar noon, and a slow
//! random wander. The wander is normal, with a standard deviation of 0.4 degrees and a time constant of 6 hours (all ours).
//!
//! The swing is a cosine of the solar time. The wander is a first-order autoregression: each measurement keeps exp(-interval /
//! 6 h) of the last value, and adds a normal random number such that the standard deviation stays. The temperature is reported
//! if it differs from the last report by a step or more. The first measurement is always reported.
//!
//! Left out: seasons, heating and its thermostat, cooking, open windows, other rooms.

use super::entities::EntityRow;
use super::meaning::{Kind, Meaning};
use super::outbox::{DeviceModel, Outbox, reading};
use super::rounds::Rounds;
use crate::event::Trigger;
use crate::numbers::Numbers;
use crate::plan::sun::Sun;
use crate::random::{Stream, no_stream};
use crate::sensors::form::{Colour, KindRow, Mount, SensorForm, Shape, Site, Unit};
use crate::time::{RunTime, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "temperature",
    label: "temperature",
    mount: Mount::Room,
    unit: Some(Unit::CELSIUS),
    values: &[],
    shape: Shape::Cross,
    colour: Colour::Vermillion,
    casas: "T",
    meaning: Meaning::Is(Kind::Reading),
    entities: &[EntityRow::reading("temperature")],
};

/// A thermometer in a room. Its events are temperatures in degrees Celsius.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "temperature sensor")]
pub struct TemperatureFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Room that the sensor is in.
    pub room: String,
    /// Mean temperature of the room over a day.
    #[serde(default = "mean")]
    #[schemars(range(min = -40, max = 60))]
    pub mean_c: f64,
    /// Amplitude of the daily change, up by day and down by night.
    #[serde(default = "swing")]
    #[schemars(range(min = 0, max = 20))]
    pub swing_c: f64,
    /// Resolution of the temperatures. The sensor sends an event when the temperature has changed by one step.
    #[serde(default = "step")]
    #[schemars(range(min = 0.01, max = 10))]
    pub step_c: f64,
    /// Interval between measurements.
    #[serde(default = "temperature_every")]
    #[schemars(range(min = 1, max = 86_400))]
    pub every_s: f64,
}

impl SensorForm for TemperatureFile {
    fn room(&self) -> Option<&str> {
        Some(&self.room)
    }
}

crate::numbers! {
    /// Time from solar noon until a room is at its warmest.
    static LAG_S = "temperature.lag": 3.0 * 3600.0, "s", [0.0, 43_200.0];
    /// Standard deviation of the slow random changes of a room's temperature.
    static WANDER_C = "temperature.wander": 0.4, "°C", [0.0, 10.0];
    /// Time constant of the slow random changes of a room's temperature.
    static MEMORY_S = "temperature.memory": 6.0 * 3600.0, "s", [60.0, 2_592_000.0];
}

/// A temperature sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Temperature {
    mean_c: f64,
    swing_c: f64,
    step_c: f64,
    sun: Sun,
    stream: Stream,
    rounds: Rounds,
    lag: Span,
    spread_c: f64,
    memory_s: f64,
    wander_c: f64,
    said_c: Option<f64>,
}

impl Temperature {
    /// A sensor in a room.
    pub fn new(file: &TemperatureFile, _site: &Site) -> Temperature {
        Temperature {
            mean_c: file.mean_c,
            swing_c: file.swing_c,
            step_c: file.step_c,
            sun: Sun::default(),
            stream: no_stream(),
            rounds: Rounds::new(Span::from_seconds(file.every_s)),
            lag: Span::ZERO,
            spread_c: 0.0,
            memory_s: 1.0,
            wander_c: 0.0,
            said_c: None,
        }
    }
}

impl DeviceModel for Temperature {
    fn begin(&self, mut stream: Stream, sun: Sun, numbers: &Numbers) -> Temperature {
        let rounds = self.rounds.begin(&mut stream);
        let [spread_c, memory_s] = [&WANDER_C, &MEMORY_S].map(|number| numbers.of(number));
        let (lag, wander_c) = (Span::from_seconds(numbers.of(&LAG_S)), stream.normal(0.0, spread_c));
        Temperature { sun, rounds, lag, spread_c, memory_s, wander_c, stream, ..self.clone() }
    }

    fn timer(&self) -> RunTime {
        self.rounds.next()
    }

    fn on_timer(&mut self, at: RunTime, outbox: &mut Outbox) {
        let now = self.mean_c + self.swing_c * self.sun.hour_angle_cosine(at - self.lag) + self.wander_c;
        if self.said_c.is_none_or(|before| (now - before).abs() >= self.step_c) {
            let told = libm::round(now / self.step_c) * self.step_c;
            self.said_c = Some(told);
            outbox.send(reading(told), None, at, Trigger::Reading);
        }
        let left = libm::exp(-self.rounds.every().seconds() / self.memory_s);
        self.wander_c = left * self.wander_c + self.stream.normal(0.0, self.spread_c * libm::sqrt(1.0 - left * left));
        self.rounds.advance(at);
    }
}

super::form::usual! {
    /// Ours.
    fn mean() -> f64 = 22.0;
    /// Ours. Those of a CASAS home (hh111) swing by 2 to 3 degrees in a week of June.
    fn swing() -> f64 = 1.0;
    /// Ours. Those of a CASAS home (hh111) tell whole degrees.
    fn step() -> f64 = 0.5;
    /// Ours.
    fn temperature_every() -> f64 = 900.0;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::ThingId;
    use crate::sensors::outbox::testing;
    use crate::time::{DAY, HOUR};

    fn thermometer(json: serde_json::Value) -> Temperature {
        let mut file = serde_json::json!({ "name": "t", "room": "kitchen" });
        file.as_object_mut().unwrap().extend(json.as_object().unwrap().clone());
        let sun = Sun { day_of_year: 80.0, time_of_day: Span::ZERO, latitude_deg: 40.0 };
        Temperature::new(&serde_json::from_value(file).unwrap(), &Site::default()).begin(
            Stream::named(2, "t"),
            sun,
            &Numbers::default(),
        )
    }

    fn readings(mut device: Temperature, days: i64) -> Vec<(RunTime, f64)> {
        let said = testing::says(&mut device, ThingId(0), &[], RunTime::START + days * DAY);
        said.iter().map(|&(at, ..)| at).zip(testing::readings(&said)).collect()
    }

    #[test]
    fn it_tells_steps_and_never_the_same_twice() {
        let readings = readings(thermometer(serde_json::json!({})), 30);
        assert!(readings.len() > 60, "{} in a month", readings.len());
        assert!(readings.iter().all(|(_, c)| (c * 2.0).fract() == 0.0 && (19.0..=25.0).contains(c)), "{readings:?}");
        assert!(readings.windows(2).all(|pair| pair[0].1 != pair[1].1));
    }

    #[test]
    fn the_day_swings_and_is_warmest_at_three() {
        // A swing that dwarfs the wander.
        let json = serde_json::json!({ "mean_c": 20, "swing_c": 20, "step_c": 0.01 });
        let readings = readings(thermometer(json), 20);
        let mean = |hour: i64| {
            let at_hour = readings.iter().filter(|(at, _)| at.since_zero() / HOUR % 24 == hour);
            let found: Vec<f64> = at_hour.map(|(_, c)| *c).collect();
            found.iter().sum::<f64>() / found.len() as f64
        };
        // Of the hours around: cos(7.5 degrees) = 0.991, and half of the way between for the quarters.
        assert!((mean(14) - 39.8).abs() < 0.5 && (mean(15) - 39.8).abs() < 0.5, "{} {}", mean(14), mean(15));
        assert!((mean(2) - 0.2).abs() < 0.5 && (mean(3) - 0.2).abs() < 0.5, "{} {}", mean(2), mean(3));
    }

    #[test]
    fn the_wander_has_its_deviation_and_its_memory() {
        let mut device = thermometer(serde_json::json!({ "swing_c": 0, "step_c": 0.01 }));
        let mut wander = Vec::new();
        for _ in 0..200_000 {
            let due = device.timer();
            device.on_timer(due, &mut Outbox::default());
            wander.push(device.wander_c);
        }
        let product = |lag: usize| {
            let pairs = wander.iter().zip(&wander[lag..]);
            pairs.map(|(a, b)| a * b).sum::<f64>() / (wander.len() - lag) as f64
        };
        assert!((product(0).sqrt() - WANDER_C.value).abs() < 0.02, "{}", product(0).sqrt());
        // After six hours, 24 measurements, 1 / e is left.
        assert!((product(24) / product(0) - 0.368).abs() < 0.04, "{}", product(24) / product(0));
    }
}
