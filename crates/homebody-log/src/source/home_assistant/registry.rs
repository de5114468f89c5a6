//! Home Assistant's registries of entities, devices and areas: classes, rooms, and categories.
//!
//! They lie in the database's folder, or in `.storage` below it. A person may have put the room on the device alone.

use crate::files::plain;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;

/// Largest size of a registry: one of ten thousand entities has a tenth of it.
const LARGEST_BYTES: u64 = 64 << 20;

/// The entries of entities, by their ids.
#[derive(Default)]
pub(crate) struct EntityRegistry(BTreeMap<String, EntityInfo>);

pub(crate) struct EntityInfo {
    pub class: Option<String>,
    /// `config` or `diagnostic`, if it has one of these categories.
    pub category: Option<String>,
    pub area: Option<String>,
}

#[derive(Deserialize)]
struct StorageFile<T> {
    data: T,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Entities {
    entities: Vec<EntityEntry>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct EntityEntry {
    entity_id: String,
    device_class: Option<String>,
    original_device_class: Option<String>,
    entity_category: Option<String>,
    area_id: Option<String>,
    device_id: Option<String>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Devices {
    devices: Vec<DeviceEntry>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct DeviceEntry {
    id: String,
    area_id: Option<String>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Areas {
    areas: Vec<Area>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Area {
    id: String,
    name: String,
}

impl EntityRegistry {
    /// The registries of a database. One that cannot be read is a remark.
    pub fn beside(database: &Path, remarks: &mut Vec<String>) -> EntityRegistry {
        let entities: Entities = stored(database, "core.entity_registry", remarks);
        let devices: Devices = stored(database, "core.device_registry", remarks);
        let areas: Areas = stored(database, "core.area_registry", remarks);
        let area_of_device: BTreeMap<String, String> =
            devices.devices.into_iter().filter_map(|device| Some((device.id, device.area_id?))).collect();
        let names: BTreeMap<String, String> = areas.areas.into_iter().map(|area| (area.id, area.name)).collect();
        let entry = |entity: EntityEntry| {
            let area = entity.area_id.or_else(|| area_of_device.get(&entity.device_id?).cloned());
            let said = |text: Option<String>| text.filter(|text| !text.is_empty());
            let entry = EntityInfo {
                class: said(entity.device_class).or(said(entity.original_device_class)),
                category: said(entity.entity_category),
                area: area.and_then(|id| names.get(&id).cloned()),
            };
            (entity.entity_id, entry)
        };
        EntityRegistry(entities.entities.into_iter().map(entry).collect())
    }

    pub fn entity(&self, id: &str) -> Option<&EntityInfo> {
        self.0.get(id)
    }
}

fn stored<T: DeserializeOwned + Default>(database: &Path, name: &str, remarks: &mut Vec<String>) -> T {
    let folder = database.parent().unwrap_or(Path::new(""));
    for path in [folder.join(".storage").join(name), folder.join(name)] {
        let text = match plain::read(&path, LARGEST_BYTES) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => continue,
            Err(error) => {
                remarks.push(format!("{name} is not read: {error}"));
                continue;
            }
        };
        match serde_json::from_slice::<StorageFile<T>>(&text) {
            Ok(stored) => return stored.data,
            Err(error) => remarks.push(format!("{name} is not read: {error}")),
        }
    }
    T::default()
}
