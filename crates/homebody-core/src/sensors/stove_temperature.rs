//! A temperature sensor on a stove.
//!
//! The device is a thermometer next to the burners that reports a hot stove and a cooled one (Godsey & Skubic 2009,
//! section III.D, name it without details).
//!
//! We assume that its place warms and cools as one body does by Newton's law: towards 180 degrees Celsius with a time constant of
//! 240 s while the stove is on, and towards a room of 22 with one of 1,200 s while it is off (all ours). Between two limits it
//! keeps saying what it said, so that it is `ON` from the instant at which it heats up past the upper one to that at which it
//! cools down past the lower.
//!
//! Between two acts the temperature is target + (start - target) exp(-t / tau), so the instant of a crossing is
//! tau ln((start - target) / (limit - target)), to the nearest microsecond. A crossing counts as reached when the stove is
//! turned at that very instant. If asked to, it also measures every so often, and tells what has changed by a degree.
//!
//! Left out: several burners, pots, the oven, noise, the room's own temperature.

use super::entities::EntityRow;
use super::meaning::Meaning;
use super::messages::SensorMessage;
use super::outbox::{Change, DeviceModel, Outbox, reading};
use super::rounds::Rounds;
use crate::event::{Trigger, Value};
use crate::ids::{ResidentId, ThingId};
use crate::numbers::Numbers;
use crate::plan::sun::Sun;
use crate::random::Stream;
use crate::sensors::form::{Bearer, Colour, FormProblem, KindRow, Mount, SensorForm, Shape, Site, Unit};
use crate::time::{RunTime, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "stove_temperature",
    label: "stove temperature",
    mount: Mount::Thing(&[Bearer::Furniture]),
    unit: Some(Unit::CELSIUS),
    values: &[Value::On, Value::Off],
    shape: Shape::Flame,
    colour: Colour::Vermillion,
    casas: "T",
    meaning: Meaning::UseOrReading,
    entities: &[EntityRow::switch("heat", "heat"), EntityRow::further_reading("temperature", "Temperature")],
};

/// A temperature sensor on a stove. Its events are `ON` and `OFF` as the temperature crosses two limits, and readings
/// if `readings_every_s` is given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "stove temperature sensor")]
pub struct StoveTemperatureFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Piece of furniture whose temperature the sensor measures.
    pub on: String,
    /// Temperature that the sensor reaches in the long run.
    #[serde(default = "hot")]
    #[schemars(range(min = 25, max = 1_000))]
    pub hot_c: f64,
    /// Temperature above which the sensor sends `ON` as the stove heats up.
    #[serde(default = "on_above")]
    #[schemars(range(min = 23, max = 1_000))]
    pub on_above_c: f64,
    /// Temperature below which the sensor sends `OFF` as the stove cools down.
    #[serde(default = "off_below")]
    #[schemars(range(min = 22.1, max = 1_000))]
    pub off_below_c: f64,
    /// Interval between measurements. A measurement that differs from the last reading by a degree is sent. Without it,
    /// the sensor sends no readings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 86_400))]
    pub readings_every_s: Option<f64>,
}

impl SensorForm for StoveTemperatureFile {
    fn on(&self) -> Option<&str> {
        Some(&self.on)
    }

    fn gives_readings(&self) -> bool {
        self.readings_every_s.is_some()
    }

    /// Each of the temperatures must be above the one before.
    fn wrong(&self) -> Vec<FormProblem> {
        let mut wrong = Vec::new();
        let limits = [("off_below_c", self.off_below_c), ("on_above_c", self.on_above_c), ("hot_c", self.hot_c)];
        if self.off_below_c <= ROOM_C {
            wrong.push(FormProblem::new("/off_below_c", SensorMessage::BelowRoom { room_c: ROOM_C }));
        }
        for pair in limits.windows(2) {
            let [(lower, low_c), (upper, high_c)] = [pair[0], pair[1]];
            if low_c >= high_c {
                let message = SensorMessage::LimitOrder { lower, low_c, upper, high_c };
                wrong.push(FormProblem::new(format!("/{upper}"), message));
            }
        }
        wrong
    }
}

/// Temperature of a cold stove in degrees Celsius (our choice). The limits in a file lie above it.
pub const ROOM_C: f64 = 22.0;

crate::numbers! {
    /// Time constant of a stove that heats up: a burner is hot after some minutes.
    static HEATING_S = "stove.heating": 240.0, "s", [10.0, 3_600.0];
    /// Time constant of a stove that cools down: a plate is cool enough to touch after half an hour.
    static COOLING_S = "stove.cooling": 1_200.0, "s", [60.0, 14_400.0];
    /// Change of temperature that makes a stove's sensor send a reading.
    static CHANGE_C = "stove.change": 1.0, "°C", [0.01, 50.0];
}

/// A stove's temperature sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct StoveTemperature {
    /// Index into the home's things.
    thing: ThingId,
    hot_c: f64,
    on_above_c: f64,
    off_below_c: f64,
    rounds: Option<Rounds>,
    heating_s: f64,
    cooling_s: f64,
    change_c: f64,
    /// The state of the stove, its start, the resident who caused it, and the temperature at that time.
    on: bool,
    since: RunTime,
    by: Option<ResidentId>,
    start_c: f64,
    says_on: bool,
    crossing: RunTime,
    told_c: f64,
    measures: RunTime,
}

impl StoveTemperature {
    /// A sensor on the thing of this site.
    pub fn new(file: &StoveTemperatureFile, site: &Site) -> StoveTemperature {
        StoveTemperature {
            thing: site.thing,
            hot_c: file.hot_c,
            on_above_c: file.on_above_c,
            off_below_c: file.off_below_c,
            rounds: file.readings_every_s.map(|every| Rounds::new(Span::from_seconds(every))),
            heating_s: HEATING_S.value,
            cooling_s: COOLING_S.value,
            change_c: CHANGE_C.value,
            on: false,
            since: RunTime::START,
            by: None,
            start_c: ROOM_C,
            says_on: false,
            crossing: RunTime::NEVER,
            told_c: ROOM_C,
            measures: RunTime::NEVER,
        }
    }
}

impl DeviceModel for StoveTemperature {
    fn begin(&self, mut stream: Stream, _sun: Sun, numbers: &Numbers) -> StoveTemperature {
        let [heating_s, cooling_s, change_c] = [&HEATING_S, &COOLING_S, &CHANGE_C].map(|number| numbers.of(number));
        let rounds = self.rounds.map(|rounds| rounds.begin(&mut stream));
        StoveTemperature { rounds, heating_s, cooling_s, change_c, ..self.clone() }
    }

    fn on_event(&mut self, at: RunTime, change: &Change, outbox: &mut Outbox) {
        let Change::Use { resident, thing, on } = *change else { return };
        if thing != self.thing || on == self.on {
            return;
        }
        self.on_timer(at, outbox);
        let start_c = self.temperature_c(at);
        (self.on, self.since, self.by, self.start_c) = (on, at, resident, start_c);
        self.crossing = self.next_crossing();
        self.measures = self.next_measurement(at);
    }

    fn timer(&self) -> RunTime {
        self.crossing.min(self.measures)
    }

    fn on_timer(&mut self, at: RunTime, outbox: &mut Outbox) {
        if self.crossing <= at {
            self.says_on = self.on;
            self.crossing = RunTime::NEVER;
            outbox.send(if self.on { Value::On } else { Value::Off }, self.by, self.since, Trigger::Use(self.thing));
        }
        if self.measures <= at {
            let now_c = self.temperature_c(at);
            if (now_c - self.told_c).abs() >= self.change_c {
                self.told_c = now_c;
                outbox.send(reading(now_c), self.by, at, Trigger::Reading);
            }
            self.measures = self.next_measurement(at);
        }
    }
}

impl StoveTemperature {
    fn target(&self) -> (f64, f64) {
        if self.on { (self.hot_c, self.heating_s) } else { (ROOM_C, self.cooling_s) }
    }

    fn temperature_c(&self, at: RunTime) -> f64 {
        let (target_c, tau_s) = self.target();
        target_c + (self.start_c - target_c) * libm::exp(-(at - self.since).seconds() / tau_s)
    }

    /// When it will say something else than it says, as the stove is now.
    fn next_crossing(&self) -> RunTime {
        let limit_c = match (self.on, self.says_on) {
            (true, false) => self.on_above_c,
            (false, true) => self.off_below_c,
            _ => return RunTime::NEVER,
        };
        let (target_c, tau_s) = self.target();
        // At most 1, or the limit is behind it already.
        let share = ((limit_c - target_c) / (self.start_c - target_c)).min(1.0);
        self.since + Span::from_seconds(-tau_s * libm::log(share))
    }

    /// The next measurement; none if the temperature stays as near to the last report.
    fn next_measurement(&self, at: RunTime) -> RunTime {
        let (target_c, _) = self.target();
        let far = |c: f64| (c - self.told_c).abs() >= self.change_c;
        let Some(rounds) = self.rounds.filter(|_| far(target_c) || far(self.temperature_c(at))) else {
            return RunTime::NEVER;
        };
        rounds.after(at)
    }
}

super::form::usual! {
    /// Our choice, for a sensor next to the burners.
    fn hot() -> f64 = 180.0;
    /// Ours: above what a summer or the sun gives.
    fn on_above() -> f64 = 45.0;
    /// Ours: so far below that the air over a pot does not make it speak twice.
    fn off_below() -> f64 = 38.0;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensors::outbox::testing::{says, used};
    use crate::time::SECOND;

    fn stove(json: serde_json::Value) -> StoveTemperature {
        let mut file = serde_json::json!({ "name": "stove heat", "on": "stove" });
        file.as_object_mut().unwrap().extend(json.as_object().unwrap().clone());
        StoveTemperature::new(&serde_json::from_value(file).unwrap(), &Site { thing: ThingId(2), ..Site::default() })
    }

    fn at(seconds: i64) -> RunTime {
        RunTime::START + seconds * SECOND
    }

    fn outbox(mut stove: StoveTemperature, acts: &[(RunTime, bool)], until: RunTime) -> Vec<(RunTime, Value)> {
        let said = says(&mut stove, ThingId(2), acts, until);
        said.into_iter().map(|(at, value, _)| (at, value)).collect()
    }

    #[test]
    fn a_stove_that_is_turned_off_too_early_says_nothing_and_one_turned_on_again_nothing_new() {
        assert_eq!(outbox(stove(serde_json::json!({})), &[(at(0), true), (at(37), false)], at(7200)), []);
        let again = [(at(0), true), (at(600), false), (at(900), true), (at(1000), true)];
        assert_eq!(outbox(stove(serde_json::json!({})), &again, at(1200)).len(), 1);
    }

    #[test]
    fn a_crossing_at_the_instant_of_an_act_is_said_once_whichever_comes_first() {
        let crossing = outbox(stove(serde_json::json!({})), &[(at(0), true)], at(100))[0].0;
        let mut told_first = stove(serde_json::json!({}));
        let mut due_first = told_first.clone();
        let (mut a, mut b) = (Outbox::default(), Outbox::default());
        let act = |on| used(ThingId(2), on);
        told_first.on_event(at(0), &act(true), &mut a);
        due_first.on_event(at(0), &act(true), &mut b);
        due_first.on_timer(crossing, &mut b);
        told_first.on_event(crossing, &act(false), &mut a);
        due_first.on_event(crossing, &act(false), &mut b);
        told_first.on_timer(crossing, &mut a);
        assert_eq!((a.messages.clone(), told_first), (b.messages, due_first));
        assert_eq!(a.messages.len(), 1);
    }

    #[test]
    fn readings_come_while_it_changes_and_are_a_degree_apart() {
        let mut stove = stove(serde_json::json!({ "readings_every_s": 30 }));
        stove.rounds = Some(Rounds::new(30 * SECOND));
        let messages = outbox(stove, &[(at(0), true)], at(3600));
        let readings: Vec<i32> = messages
            .iter()
            .filter_map(|&(_, value)| if let Value::Reading(thousandths) = value { Some(thousandths) } else { None })
            .collect();
        // 180 - 158 exp(-1 / 8) and 180 - 158 exp(-1 / 4).
        assert_eq!(readings[..2], [40_565, 56_949]);
        assert!(readings.windows(2).all(|pair| pair[1] - pair[0] >= 1_000), "{readings:?}");
        assert!(readings.last().is_some_and(|&last| (179_000..180_000).contains(&last)), "{readings:?}");
    }
}
