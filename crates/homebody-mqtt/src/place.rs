//! The topics of a home, all below `prefix/home`, and those of discovery, which name it.

use crate::address::{Address, Discovery, Style};
use crate::entities::{Device, Entity, Says};
use crate::names::{id_of_home, level};
use homebody_log::RunInfo;

/// A home on a broker.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    /// `prefix/home`.
    pub base: String,
    /// The home's id in discovery.
    pub id: String,
    pub style: Style,
    /// Whether Home Assistant is told of it: it wants a device to say also what it does not know.
    pub is_discovered: bool,
    /// In the order of the run's sensors.
    pub sensors: Vec<Placed>,
}

/// A sensor on a broker.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    /// Its level below the home.
    pub level: String,
    pub name: String,
    /// What the log calls it.
    pub in_log: String,
    pub kind: String,
    pub room: Option<String>,
    pub unit: Option<String>,
    pub device: Device,
    /// The topic of each of its entities.
    pub topics: Vec<String>,
}

impl Place {
    /// Where a run's home is: by its own name where it is one of several, else by its scenario's.
    pub fn of(address: &Address, run: &RunInfo) -> Place {
        let home = run.home.as_ref().unwrap_or(&run.scenario);
        let base = format!("{}/{}", address.prefix, level(home));
        let placed = |sensor: &homebody_log::SensorInfo| {
            let (level, device) = (level(&sensor.name), Device::of(sensor));
            let topic = |entity: &Entity| match address.style {
                Style::HomeAssistant if entity.key.is_empty() => format!("{base}/{level}/state"),
                Style::HomeAssistant => format!("{base}/{level}/{}/state", entity.key),
                Style::Zigbee2Mqtt | Style::Plain => format!("{base}/{level}"),
            };
            Placed {
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
        Place {
            id: id_of_home(&address.prefix, home),
            style: address.style,
            is_discovered: address.discovery != Discovery::Off,
            sensors,
            base,
        }
    }

    /// A topic of the home's own.
    pub fn topic(&self, rest: &str) -> String {
        format!("{}/{rest}", self.base)
    }

    /// Where it says whether it is there: as text, or as Zigbee2MQTT's bridge does.
    pub fn status(&self) -> (String, [&'static str; 2]) {
        match self.style {
            Style::Zigbee2Mqtt => (self.topic("bridge/state"), [r#"{"state":"online"}"#, r#"{"state":"offline"}"#]),
            Style::HomeAssistant | Style::Plain => (self.topic("status"), ["online", "offline"]),
        }
    }

    /// Where it is told what to do.
    pub fn command(&self) -> String {
        self.topic("command")
    }
}

impl Placed {
    /// Whether what an entity says is over at once, so that no broker keeps it.
    pub fn is_momentary(&self, entity: usize) -> bool {
        matches!(self.device.entities[entity].says, Says::Binary { on_only: true, .. })
    }
}
