//! The topics of a home, all below `prefix/home`, and those of discovery, which name it.

use crate::address::{BrokerAddress, Discovery, Style};
use crate::entities::{Device, Entity, EntityType};
use crate::names::{id_of_home, level};
use homebody_log::RunInfo;

#[derive(Clone, Debug)]
pub(crate) struct HomeTopics {
    pub base: String,
    pub id: String,
    pub style: Style,
    /// Whether Home Assistant discovers it. A device then sends unknown values too.
    pub is_discovered: bool,
    /// In the order of the run's sensors.
    pub sensors: Vec<SensorTopics>,
}

#[derive(Clone, Debug)]
pub(crate) struct SensorTopics {
    pub level: String,
    pub name: String,
    pub in_log: String,
    pub kind: String,
    pub room: Option<String>,
    pub unit: Option<String>,
    pub device: Device,
    pub topics: Vec<String>,
}

impl HomeTopics {
    /// The topics of a run's home: by its own name if it is one of several, else by its scenario's.
    pub fn for_run(address: &BrokerAddress, run: &RunInfo) -> HomeTopics {
        let home = run.home.as_ref().unwrap_or(&run.scenario);
        let base = format!("{}/{}", address.prefix, level(home));
        let placed = |sensor: &homebody_log::SensorInfo| {
            let (level, device) = (level(&sensor.name), Device::for_sensor(sensor));
            let topic = |entity: &Entity| match address.style {
                Style::HomeAssistant if entity.key.is_empty() => format!("{base}/{level}/state"),
                Style::HomeAssistant => format!("{base}/{level}/{}/state", entity.key),
                Style::Zigbee2Mqtt | Style::Plain => format!("{base}/{level}"),
            };
            SensorTopics {
                topics: device.entities.iter().map(topic).collect(),
                level,
                name: sensor.name.clone(),
                in_log: sensor.id.clone(),
                kind: sensor.kind.clone(),
                room: sensor.room.clone(),
                unit: sensor.unit.clone(),
                device,
            }
        };
        let sensors = run.sensors.iter().map(placed).collect();
        HomeTopics {
            id: id_of_home(&address.prefix, home),
            style: address.style,
            is_discovered: address.discovery != Discovery::Off,
            sensors,
            base,
        }
    }

    pub fn topic(&self, rest: &str) -> String {
        format!("{}/{rest}", self.base)
    }

    /// The topic of its status, with the messages for online and offline, as text or as Zigbee2MQTT's bridge sends them.
    pub fn status(&self) -> (String, [&'static str; 2]) {
        match self.style {
            Style::Zigbee2Mqtt => (self.topic("bridge/state"), [r#"{"state":"online"}"#, r#"{"state":"offline"}"#]),
            Style::HomeAssistant | Style::Plain => (self.topic("status"), ["online", "offline"]),
        }
    }

    pub fn command(&self) -> String {
        self.topic("command")
    }
}

impl SensorTopics {
    /// Whether an entity's state ends at once, so that no broker retains it.
    pub fn is_momentary(&self, entity: usize) -> bool {
        matches!(self.device.entities[entity].says, EntityType::Binary { on_only: true, .. })
    }
}
