//! A home with its names resolved: its plan and its sensors, made once from its file.

use crate::home::form::HomeFile;
use crate::numbers::Numbers;
use crate::plan::Plan;
use crate::sensors::Sensor;
use crate::sensors::kinds::SensorFile;
use crate::sensors::messages::SensorMessage;
use std::ops::Deref;

/// A home's file with the plan that follows from it. One of a [`Scenario`](crate::scenario::load::Scenario) has passed its
/// checks besides.
#[derive(Clone, Debug, PartialEq)]
pub struct ResolvedHome {
    file: HomeFile,
    plan: Plan,
    sensors: Vec<Sensor>,
    numbers: Numbers,
}

impl ResolvedHome {
    /// Finds the parts that the file names. The models in it have their own numbers.
    ///
    /// # Errors
    ///
    /// [`SensorMessage::Unresolved`] for a sensor on a part that the home does not have.
    pub fn new(file: HomeFile) -> Result<ResolvedHome, SensorMessage> {
        let plan = Plan::new(&file);
        ResolvedHome::with_plan(file, plan, Numbers::default())
    }

    /// The same with the plan that was made of the file already, and with these numbers.
    pub(crate) fn with_plan(file: HomeFile, plan: Plan, numbers: Numbers) -> Result<ResolvedHome, SensorMessage> {
        let sensor = |sensor: &SensorFile| {
            Sensor::new(sensor, &plan).ok_or_else(|| SensorMessage::Unresolved { sensor: sensor.name().to_owned() })
        };
        let sensors = file.sensors.iter().map(sensor).collect::<Result<_, _>>()?;
        Ok(ResolvedHome { file, plan, sensors, numbers })
    }

    /// The same home with more sensors, as far as it has what they are on.
    pub(crate) fn with_sensors(&self, more: Vec<SensorFile>) -> ResolvedHome {
        let mut home = self.clone();
        home.sensors.extend(more.iter().filter_map(|sensor| Sensor::new(sensor, &self.plan)));
        home.file.sensors.extend(more);
        home
    }

    /// The same home without cameras, for callers that need the behaviour only: pictures are most of the cost of such a
    /// home.
    pub fn without_cameras(&self) -> ResolvedHome {
        let sees = |sensor: &SensorFile| sensor.camera().is_some();
        let mut home = self.clone();
        let mut files = self.file.sensors.iter();
        home.sensors.retain(|_| !files.next().is_some_and(sees));
        home.file.sensors.retain(|sensor| !sees(sensor));
        home
    }

    /// Its floor plan.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The numbers of the models that people and sensors in it are made by.
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// Its sensors as a run uses them, in the order of the file.
    pub fn placed_sensors(&self) -> &[Sensor] {
        &self.sensors
    }
}

impl Deref for ResolvedHome {
    type Target = HomeFile;

    fn deref(&self) -> &HomeFile {
        &self.file
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn home(on: &str) -> HomeFile {
        let sensor = json!({ "kind": "contact", "name": "it", "on": on });
        let rooms = json!([{ "name": "room", "outline": [[0, 0], [4, 0], [4, 4], [0, 4]] }]);
        let fridge = json!({ "name": "fridge", "at": [1, 1], "size_m": [0.6, 0.6], "height_m": 1.8 });
        serde_json::from_value(json!({ "name": "home", "rooms": rooms, "walls": [], "furniture": [fridge],
            "sensors": [sensor] }))
        .unwrap()
    }

    #[test]
    fn a_sensor_is_where_its_thing_is_or_the_home_is_refused() {
        let resolved = ResolvedHome::new(home("fridge")).unwrap();
        assert!(resolved.placed_sensors()[0].at.distance(crate::geometry::point([1.0, 1.0])) < 1e-9);
        assert_eq!(resolved.plan(), &Plan::new(&*resolved));
        let refused = ResolvedHome::new(home("oven")).unwrap_err();
        assert!(matches!(refused, SensorMessage::Unresolved { sensor } if sensor == "it"));
    }
}
