//! The sensors of a log, by the home of its run.

use homebody_analysis::look::HomeSensor;
use homebody_analysis::signs::kind_in_home;
use homebody_core::scenario::load::Scenario;
use homebody_core::sensors::Sensor;
use homebody_log::text::one_word;
use homebody_log::{Log, SensorInfo};
use std::collections::BTreeMap;

pub fn home_sensors(scenario: &Scenario) -> Vec<HomeSensor> {
    let one = |sensor: &Sensor| {
        let SensorInfo { id, name, kind, unit, .. } = SensorInfo::in_home(sensor, scenario);
        let kind = kind_in_home(&kind, unit.is_some());
        HomeSensor { ids: vec![id.clone(), one_word(&id)], name, kind }
    };
    scenario.home.placed_sensors().iter().map(one).collect()
}

pub fn sensor_rooms(scenario: &Scenario) -> BTreeMap<String, String> {
    let mut rooms = BTreeMap::new();
    for sensor in scenario.home.placed_sensors() {
        let info = sensor.info(scenario.home.plan());
        let Some(room) = info.room else { continue };
        let id = scenario.logger.ids.get(&info.name).unwrap_or(&info.name);
        for name in [info.name.clone(), id.clone(), one_word(id)] {
            rooms.insert(name, room.clone());
        }
    }
    rooms
}

/// The rooms of its sensors that a log has itself.
pub(crate) fn rooms_of_log(log: &Log) -> BTreeMap<String, String> {
    let told = log.known.iter().filter_map(|known| Some((known.id.clone(), known.room.clone()?)));
    told.collect()
}

/// Replaces the ids of sensors by their names in the home, and adds their kinds and rooms.
pub(crate) fn name_sensors(log: &mut Log, scenario: &Scenario) {
    for sensor in log.sensors.iter_mut().chain(log.known.iter_mut().map(|known| &mut known.id)) {
        if let Some((name, _)) = scenario.logger.ids.iter().find(|(_, id)| *id == sensor) {
            sensor.clone_from(name);
        }
    }
    know_sensors(log, scenario);
}

pub(crate) fn know_sensors(log: &mut Log, scenario: &Scenario) {
    for sensor in scenario.home.placed_sensors() {
        let info = SensorInfo::in_home(sensor, scenario);
        let is_it = |id: &&String| **id == info.name || **id == info.id || **id == one_word(&info.id);
        let Some(id) = log.sensors.iter().find(is_it) else { continue };
        let info = SensorInfo { id: id.clone(), ..info };
        match log.known.iter_mut().find(|known| known.id == *id) {
            Some(known) => known.fill(info),
            None => log.known.push(info),
        }
    }
}
