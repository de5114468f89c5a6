//! The catalogue of motion sensors that can be bought, or once could be, with the source of each number.
//!
//! A product has a field of view, a reach and a mounting height. Makers publish few of them: where a row says so, the number
//! is that of the sensor in Godsey & Skubic 2009, or our choice.
//!
//! We assume that a product has the timing of one preset.
//!
//! A product is one row, and a sensor that becomes this product takes the numbers of the row.
//!
//! Left out: prices, and devices that react to use, weight or state, whose makes do not differ in `home.json`.

use crate::sensors::kinds::SensorFile;
use crate::sensors::motion::{field, mounting_height, reach};
use crate::sensors::preset::Preset;
use serde::Serialize;

/// A number of a device, and who says so.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ProductFact<T> {
    /// In metres or degrees, as the field of the device says.
    pub value: T,
    /// The source.
    pub source: &'static str,
}

/// A motion sensor of the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Product {
    /// The preset with its timing, which `home.json` names it by.
    pub preset: Preset,
    /// The maker.
    pub make: &'static str,
    /// The maker's name of the model.
    pub model: &'static str,
    /// The network of its messages; empty if unknown.
    pub network: &'static str,
    /// Height of the lens above the floor, in metres.
    pub height_m: ProductFact<f64>,
    /// Horizontal and vertical angle of view, in degrees.
    pub field_deg: ProductFact<[f64; 2]>,
    /// The greatest distance of a walking person that it sees, in metres.
    pub reach_m: ProductFact<f64>,
    /// The source of its timing, which the preset has.
    pub timing: &'static str,
}

const PAPER: &str = "Godsey & Skubic 2009, section III.D";
const AS_PAPER: &str = "not stated by the maker; value of Godsey & Skubic 2009";
const OURS: &str = "not stated; our choice";

impl Product {
    /// The device of a preset.
    pub fn new(preset: Preset) -> Product {
        // Values that only measurement or choice can give.
        let device = Product {
            preset,
            make: "",
            model: "",
            network: "",
            height_m: ProductFact { value: mounting_height(), source: OURS },
            field_deg: ProductFact { value: field(), source: AS_PAPER },
            reach_m: ProductFact { value: reach(), source: OURS },
            timing: OURS,
        };
        match preset {
            Preset::Paper => Product {
                make: "any",
                model: "as measured by Godsey & Skubic 2009",
                field_deg: ProductFact { value: field(), source: PAPER },
                timing: PAPER,
                ..device
            },
            Preset::X10Ms16a => Product {
                make: "X10",
                model: "ActiveEye MS16A",
                network: "X10 radio",
                height_m: ProductFact {
                    value: mounting_height(),
                    source: "our choice, above the 6 ft (1.83 m) in the manual of the related HawkEye MS13A",
                },
                timing: "X10 Active Eye setup guide",
                ..device
            },
            Preset::CasasPulse => Product {
                make: "Bosch",
                model: "unit of CASAS homes",
                timing: "measured in the log of a CASAS home",
                ..device
            },
            Preset::CasasFollow => Product {
                make: "Control4",
                model: "unit of CASAS homes",
                network: "Zigbee",
                timing: "measured in the logs of CASAS homes",
                ..device
            },
            Preset::Aqara => Product { model: "RTCGQ11LM", timing: "Zigbee2MQTT, page RTCGQ11LM", ..aqara(device) },
            Preset::AqaraP1 => Product {
                model: "P1 RTCGQ14LM",
                timing: "deCONZ REST documentation, page xiaomi_rtcgq14lm_p1_presence_sensor",
                ..aqara(device)
            },
            Preset::Hue => Product { make: "Philips", model: "Hue motion sensor", network: "Zigbee", ..device },
            Preset::Fibaro => Product {
                make: "Fibaro",
                model: "FGMS-001",
                network: "Z-Wave",
                height_m: ProductFact { value: 2.4, source: "operating manual of the FGMS-001, v2.4" },
                timing: "OpenZWave, config/fibaro/fgms.xml, parameter 2",
                ..device
            },
            Preset::Aeotec => Product {
                make: "Aeotec",
                model: "TriSensor ZWA005",
                network: "Z-Wave",
                timing: "manual of the ZWA005, parameter 1",
                ..device
            },
        }
    }

    /// The whole catalogue, in the order of the presets.
    pub fn all() -> impl Iterator<Item = Product> {
        Preset::ALL.into_iter().map(Product::new)
    }

    /// The name for people.
    pub fn name(&self) -> String {
        match self.make {
            "any" => format!("motion sensor, {}", self.model),
            make => format!("{make} {}", self.model),
        }
    }

    /// The key in `home.json`.
    pub fn key(&self) -> &'static str {
        self.preset.key()
    }

    /// Turns a sensor that looks for movement into this device: one on a wall with its field, reach and height.
    pub fn put_into(&self, sensor: &mut SensorFile) {
        sensor.set_field(self.height_m.value, self.field_deg.value, self.reach_m.value);
        sensor.change_settings(|settings| settings.preset = self.preset);
    }
}

/// The values that the sensors of Aqara share.
fn aqara(device: Product) -> Product {
    const SISTER: &str = "a review of the related T1 RTCGQ12LM (privatehomelab.com)";
    Product {
        make: "Aqara",
        network: "Zigbee",
        field_deg: ProductFact {
            value: [170.0, field()[1]],
            source: "horizontal from a review of the related T1 RTCGQ12LM (privatehomelab.com); vertical as in Godsey & Skubic 2009",
        },
        reach_m: ProductFact { value: 7.0, source: SISTER },
        ..device
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn every_preset_is_a_device_with_a_name_of_its_own_and_sources() {
        let names: std::collections::BTreeSet<String> = Product::all().map(|device| device.name()).collect();
        assert_eq!(names.len(), Preset::ALL.len(), "{names:?}");
        assert!(Preset::ALL.iter().all(|preset| serde_json::to_value(preset).unwrap() == preset.key()));
        for device in Product::all() {
            let sources = [device.height_m.source, device.field_deg.source, device.reach_m.source, device.timing];
            assert!(sources.iter().all(|source| !source.is_empty()), "{device:?}");
            assert!((1.0..3.0).contains(&device.height_m.value) && device.reach_m.value <= 20.0, "{device:?}");
        }
    }

    #[test]
    fn a_picked_device_is_what_the_file_says_of_it() {
        let file = json!({ "kind": "motion", "name": "hall", "at": [1.0, 2.0], "facing_deg": 90 });
        let mut sensor: SensorFile = serde_json::from_value(file).unwrap();
        Product::new(Preset::Fibaro).put_into(&mut sensor);
        let lens = sensor.orientation().unwrap();
        assert_eq!((sensor.preset(), lens.height_m, lens.at), (Some(Preset::Fibaro), 2.4, [1.0, 2.0]));
        assert_eq!(sensor.timing().refire_s, [8.0, 8.0]);
        assert_eq!(Product::new(Preset::AqaraP1).key(), "aqara_p1");
    }
}
