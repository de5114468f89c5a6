//! A power meter on what draws electricity.
//!
//! The device sits between plug and socket: it reports whether current flows, and the power, if the form states it.
//!
//! We assume that a thing always draws the same while it is on, and always the same while it is off. Each reading while
//! it is on has a normal error of 2 per cent (our choice).
//!
//! An act that changes the state of its thing is a message, with a reading. While the thing is on, a reading follows at
//! each interval, counted from the act that turned it on.
//!
//! Left out: the rush of current at first, things that draw more and less by themselves, such as refrigerators.

use super::entities::{EntityForm, EntityRow, SwitchWord};
use super::meaning::Meaning;
use super::messages::SensorMessage;
use super::outbox::{Change, DeviceModel, Outbox, reading};
use crate::event::{Trigger, Value};
use crate::ids::{ResidentId, ThingId};
use crate::numbers::Numbers;
use crate::plan::sun::Sun;
use crate::random::{Stream, no_stream};
use crate::sensors::form::{
    Bearer, Colour, FormProblem, KindRow, Mount, ReportedInstant, SensorForm, Shape, Site, Unit, is_zero,
};
use crate::time::{RunTime, Span};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Zigbee2MQTT's words for the state of a plug.
const STATE: [SwitchWord; 2] = [SwitchWord::Text("ON"), SwitchWord::Text("OFF")];

/// The row of the kind.
pub static ROW: KindRow = KindRow {
    key: "power",
    label: "power",
    mount: Mount::Thing(&[Bearer::Furniture, Bearer::Lamp]),
    unit: Some(Unit::WATTS),
    values: &[Value::On, Value::Off],
    shape: Shape::Bolt,
    colour: Colour::Yellow,
    casas: "P",
    meaning: Meaning::UseOrReading,
    entities: &[
        EntityRow { form: EntityForm::Switch(STATE), ..EntityRow::switch("power", "state") },
        EntityRow::further_reading("power", "Power"),
    ],
};

/// A power meter on an electrical appliance. Its events are `ON` and `OFF`, and watts if `watts` is given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "power sensor")]
pub struct PowerFile {
    /// Name of the sensor, unique in the home. The log uses it unless `logger.json` gives another id.
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// Piece of furniture that the meter supplies, or room whose lamp it supplies.
    pub on: String,
    /// Power that the appliance draws while it is on. Without it, the meter sends no readings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.1, max = 100_000))]
    pub watts: Option<f64>,
    /// Power that the appliance draws while it is off.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = 100_000), extend("default" = 0))]
    pub standby_watts: f64,
    /// Interval between readings while the appliance is on. Without it, a reading comes only when it is turned on or
    /// off.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 86_400))]
    pub readings_every_s: Option<f64>,
}

impl SensorForm for PowerFile {
    fn on(&self) -> Option<&str> {
        Some(&self.on)
    }

    fn gives_readings(&self) -> bool {
        self.watts.is_some()
    }

    fn wrong(&self) -> Vec<FormProblem> {
        let Some(watts) = self.watts else {
            let given =
                [("standby_watts", self.standby_watts > 0.0), ("readings_every_s", self.readings_every_s.is_some())];
            let wrong = |(key, _)| FormProblem::new(format!("/{key}"), SensorMessage::WithoutWatts { key });
            return given.into_iter().filter(|(_, given)| *given).map(wrong).collect();
        };
        if self.standby_watts > watts {
            let message = SensorMessage::StandbyTooLarge { standby_watts: self.standby_watts, watts };
            return vec![FormProblem::new("/standby_watts", message)];
        }
        Vec::new()
    }

    fn moment(&self) -> Option<ReportedInstant<'_>> {
        Some(ReportedInstant::Used(&self.on))
    }
}

crate::numbers! {
    /// Standard deviation of the error of a reading, as a share of it.
    static NOISE = "power.noise": 0.02, "1", [0.0, 0.5];
}

/// A power sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Power {
    thing: ThingId,
    on: bool,
    by: Option<ResidentId>,
    watts: Option<f64>,
    standby_watts: f64,
    every: Option<Span>,
    noise: f64,
    stream: Stream,
    measures: RunTime,
}

impl Power {
    /// A sensor that feeds the thing of this site.
    pub fn new(file: &PowerFile, site: &Site) -> Power {
        Power {
            thing: site.thing,
            on: false,
            by: None,
            watts: file.watts,
            standby_watts: file.standby_watts,
            every: file.readings_every_s.map(Span::from_seconds),
            noise: NOISE.value,
            stream: no_stream(),
            measures: RunTime::NEVER,
        }
    }
}

impl DeviceModel for Power {
    fn begin(&self, stream: Stream, _sun: Sun, numbers: &Numbers) -> Power {
        Power { stream, noise: numbers.of(&NOISE), ..self.clone() }
    }

    fn on_event(&mut self, at: RunTime, change: &Change, outbox: &mut Outbox) {
        let Change::Use { resident, thing, on } = *change else { return };
        if thing != self.thing || on == self.on {
            return;
        }
        // A reading that is due at this instant still counts as on.
        self.on_timer(at, outbox);
        (self.on, self.by) = (on, resident);
        outbox.send(if on { Value::On } else { Value::Off }, self.by, at, Trigger::Use(thing));
        self.measure(at, outbox);
    }

    fn timer(&self) -> RunTime {
        self.measures
    }

    fn on_timer(&mut self, at: RunTime, outbox: &mut Outbox) {
        if self.measures <= at {
            self.measure(at, outbox);
        }
    }
}

impl Power {
    fn measure(&mut self, at: RunTime, outbox: &mut Outbox) {
        let Some(watts) = self.watts else { return };
        let drawn = if self.on { self.stream.normal(watts, self.noise * watts) } else { self.standby_watts };
        outbox.send(reading(drawn), self.by, at, Trigger::Reading);
        self.measures = self.every.filter(|_| self.on).map_or(RunTime::NEVER, |every| at + every);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensors::outbox::testing::{readings, says};
    use crate::time::SECOND;

    fn power(json: serde_json::Value) -> Power {
        Power::new(&serde_json::from_value(json).unwrap(), &Site { thing: ThingId(1), ..Site::default() }).begin(
            Stream::named(1, "power"),
            Sun::default(),
            &Numbers::default(),
        )
    }

    #[test]
    fn without_watts_it_says_on_and_off() {
        let mut power = power(serde_json::json!({ "name": "p", "on": "TV bench" }));
        let uses = [(0, false), (1, true), (2, true), (3, false)].map(|(at, on)| (RunTime::from_micros(at), on));
        let said = says(&mut power, ThingId(1), &uses, RunTime::NEVER);
        assert_eq!(said.iter().map(|(_, value, _)| *value).collect::<Vec<_>>(), [Value::On, Value::Off]);
    }

    #[test]
    fn readings_come_while_it_is_on_and_lie_about_the_watts() {
        let file = serde_json::json!({ "name": "p", "on": "TV bench", "watts": 100, "standby_watts": 0.5, "readings_every_s": 10 });
        let mut power = power(file);
        let off = RunTime::START + 10_010 * SECOND;
        let said = says(&mut power, ThingId(1), &[(RunTime::START, true), (off, false)], RunTime::NEVER);
        assert_eq!(power.timer(), RunTime::NEVER);
        let (last, all) = said.split_last().unwrap();
        assert_eq!((all[0].1, all[all.len() - 1].1, last.1), (Value::On, Value::Off, Value::Reading(500)));
        let watts = readings(all);
        // At once, a thousand times, and when it is turned off.
        assert_eq!(watts.len(), 1002);
        let mean = watts.iter().sum::<f64>() / 1002.0;
        let sd = (watts.iter().map(|watt| (watt - mean) * (watt - mean)).sum::<f64>() / 1002.0).sqrt();
        assert!((mean - 100.0).abs() < 0.3 && (sd - 2.0).abs() < 0.2, "{mean} {sd}");
    }
}
