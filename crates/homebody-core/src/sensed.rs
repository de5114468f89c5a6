//! Kinds of sensors by the words that sources have for them: one table for all readers.
//!
//! Sources say `device_class: door`, `Control4-Motion`, `occupancy`, `Magnetic`, or begin an id with `light.`. A person writes
//! `contact` into a table of sensors. Each of these words stands here once, with the kind of sensor that it means.
//!
//! Left out: sensors without such a word. Their names and their rows are left.

use crate::names::words;
use crate::sensors::kinds::KINDS;
pub use crate::sensors::meaning::{Kind, Meaning};

const MOTION: Meaning = Meaning::Is(Kind::Motion);
const CONTACT: Meaning = Meaning::Is(Kind::Contact);
const USED: Meaning = Meaning::Is(Kind::Used);
const READING: Meaning = Meaning::Is(Kind::Reading);
const OTHER: Meaning = Meaning::Is(Kind::Other);

/// The words for kinds, in small letters and joined by `_`, blanks between. The keys of our own kinds have their meaning in their rows.
const WORDS: [(Meaning, &str); 8] = [
    (
        MOTION,
        "motion_area motion_sensor motion_detected motion_detector pir pir_sensor movement moving_target radar \
        mmwave human",
    ),
    (
        CONTACT,
        "door window opening garage_door garage gate magnetic magnet reed door_sensor door_contact window_contact \
        contact_sensor door_window open opened closed drawer",
    ),
    (Meaning::PresenceByName, "occupancy occupied presence occupancy_sensor presence_sensor person_present"),
    (
        USED,
        "used chair seat sofa couch armchair mattress mat bed_sensor flush item button action click press shake burner faucet tap \
        appliance toilet stove oven microwave dishwasher washer dryer washing_machine fridge freezer tv television media_player fan \
        lock vibration experimenter_switch switch lamp outlet socket relay dimmer doorbell kettle toaster coffee_maker \
        moving pill_box cupboard cabinet",
    ),
    (Meaning::UseOrReading, "water electric electricity use usage state current"),
    (Meaning::ReadingOnly, "sensor"),
    (
        READING,
        "reading temp humidity battery battery_percent battery_level battery_voltage voltage energy illuminance \
        illuminance_lux lux luminance light_sensor light_level brightness atmospheric_pressure barometer signal_strength linkquality \
        rssi lqi carbon_dioxide co2 eco2 pm1 pm10 pm25 pm4 nitrogen_dioxide nitrogen_monoxide nitrous_oxide ozone sulphur_dioxide \
        volatile_organic_compounds volatile_organic_compounds_parts voc tvoc aqi air_quality noise sound_pressure speed wind_speed \
        wind_direction distance volume volume_storage volume_flow_rate weight uv_index moisture_level soil_moisture precipitation \
        precipitation_intensity frequency power_factor apparent_power reactive_power reactive_energy energy_storage energy_distance \
        duration data_size data_rate ph irradiance thermostat area conductivity blood_glucose_concentration monetary gauge counter \
        meter numeric heart_rate step_count steps device_temperature cpu_temperature local_temperature target_distance",
    ),
    (
        OTHER,
        "other none_of_somebody update automation zone sun script scene weather person device_tracker cover connectivity problem running \
        tamper battery_low low_battery battery_charging safety smoke gas carbon_monoxide heat cold leak water_leak moisture sound \
        update_available update_state system diagnostic config radio_error online available availability status restart uptime \
        timestamp date enum ip version child_lock plug power_on_behavior identify firmware",
    ),
];

/// The domains of Home Assistant's ids, and the meaning of each without a class.
const DOMAINS: [(Option<Meaning>, &str); 4] = [
    (None, "binary_sensor"),
    (Some(Meaning::ReadingOnly), "sensor"),
    (Some(USED), "light switch fan media_player lock"),
    (
        Some(OTHER),
        "ai_task air_quality alarm_control_panel alert assist_satellite automation button calendar camera climate conversation counter cover \
        date datetime device_tracker event geo_location group humidifier image image_processing input_boolean input_button input_datetime \
        input_number input_select input_text lawn_mower notify number persistent_notification person plant proximity remote scene schedule \
        script select siren stt sun tag text time timer todo tts update utility_meter vacuum valve wake_word water_heater weather zone",
    ),
];

/// Classes of Home Assistant's binary sensors that mean something else elsewhere.
const BINARY: [(Meaning, &str); 2] = [
    (USED, "light power lock vibration moving"),
    (
        OTHER,
        "battery battery_charging carbon_monoxide cold connectivity gas heat moisture plug problem running safety smoke sound tamper \
        update diagnostic config",
    ),
];

/// Words that add nothing to others.
const VAGUE: &str = "sensor state use usage item status system current open area action";

/// The meaning of a source's word for a kind and of the domain of an id. `None`: neither says anything.
pub fn meaning(kind: &str, id: &str) -> Option<Meaning> {
    let words = words(kind);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match (domain_of(id), &words[..]) {
        (Some("binary_sensor"), ["binary", "sensor", class @ ..]) | (None, ["binary", "sensor", class @ ..]) => {
            binary(class)
        }
        (Some("binary_sensor"), class) => binary(class),
        (Some("sensor"), class) => Some(match known(&class.concat()) {
            Some(said @ (MOTION | CONTACT | Meaning::PresenceByName)) => said,
            Some(OTHER) if matches!(class, ["timestamp" | "date"]) => OTHER,
            _ => Meaning::ReadingOnly,
        }),
        (Some(_), ["config" | "diagnostic"]) => Some(OTHER),
        (Some(domain), _) => DOMAINS.iter().find(|(_, known)| has(known, domain)).and_then(|(meaning, _)| *meaning),
        (None, said) => known(&said.concat()).or_else(|| within(said)),
    }
}

/// The domain of an id of Home Assistant, as in `light.hall`.
pub fn domain_of(id: &str) -> Option<&str> {
    let (domain, name) = id.split_once('.')?;
    let is_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let is_known = DOMAINS.iter().any(|(_, known)| has(known, domain));
    (is_known && !name.is_empty() && name.chars().all(is_name)).then_some(domain)
}

fn binary(class: &[&str]) -> Option<Meaning> {
    let class = class.concat();
    whole(&BINARY, &class).or_else(|| known(&class))
}

/// The meaning of all words for a kind together: a kind of our own, or one of the words of others.
fn known(said: &str) -> Option<Meaning> {
    let own = KINDS.iter().find(|row| has(row.key, said)).map(|row| row.meaning);
    own.or_else(|| whole(&WORDS, said))
}

/// The meaning of a word in a table.
fn whole(table: &[(Meaning, &str)], said: &str) -> Option<Meaning> {
    table.iter().find(|(_, known)| has(known, said)).map(|(meaning, _)| *meaning)
}

/// The meaning of the longest part of the words that has one, as in `Control4-MotionArea`.
fn within(words: &[&str]) -> Option<Meaning> {
    let parts = (1..words.len()).rev().flat_map(|length| words.windows(length));
    let parts: Vec<String> = parts.map(<[&str]>::concat).filter(|part| !has(VAGUE, part)).collect();
    parts.iter().find_map(|part| known(part))
}

/// Whether one of some words, separated by blanks, is this one in any spelling.
fn has(known: &str, word: &str) -> bool {
    known.split_whitespace().any(|known| known == word || known.replace('_', "") == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_means_the_same_in_whatever_way_a_source_writes_it() {
        #[rustfmt::skip]
        let cases = [
            ("motion", MOTION), ("Control4-Motion", MOTION), ("Control4-MotionArea", MOTION), ("PIR", MOTION),
            ("ceiling_motion", MOTION), ("binary_sensor motion", MOTION), ("binary_sensor.door", CONTACT),
            ("Control4-Door", CONTACT), ("Magnetic", CONTACT), ("contact", CONTACT), ("occupancy", Meaning::PresenceByName),
            ("Flush", USED), ("Electric", Meaning::UseOrReading), ("Pressure", Meaning::UseOrReading),
            ("Control4-Temperature", READING), ("Control4-BatteryPercent", READING), ("Control4-LightSensor", READING),
            ("Control4-Light", Meaning::UseOrReading), ("illuminance_lux", READING), ("co2", READING), ("pm2.5", READING),
            ("linkquality", READING), ("update_available", OTHER), ("Other", OTHER),
        ];
        for (kind, wanted) in cases {
            assert_eq!(meaning(kind, "S1"), Some(wanted), "{kind}");
        }
        for unknown in ["", "thing", "sensor 7", "binary_sensor", "Zustand"] {
            assert_eq!(meaning(unknown, "S1"), None, "{unknown}");
        }
    }

    #[test]
    fn the_domain_of_an_id_says_what_an_entity_is() {
        for (kind, id, wanted) in [
            ("", "automation.hall_light", Some(OTHER)),
            ("", "update.core", Some(OTHER)),
            ("", "zone.home", Some(OTHER)),
            ("blind", "cover.blind", Some(OTHER)),
            ("garage", "cover.garage", Some(OTHER)),
            ("", "person.margaret", Some(OTHER)),
            ("", "input_boolean.guest", Some(OTHER)),
            ("", "light.hall", Some(USED)),
            ("outlet", "switch.kettle", Some(USED)),
            ("config", "switch.child_lock", Some(OTHER)),
            ("", "media_player.tv", Some(USED)),
            ("power", "sensor.kettle_power", Some(Meaning::ReadingOnly)),
            ("", "sensor.hall", Some(Meaning::ReadingOnly)),
            ("timestamp", "sensor.last_boot", Some(OTHER)),
            ("power", "binary_sensor.kettle", Some(USED)),
            ("battery", "binary_sensor.hall", Some(OTHER)),
            ("connectivity", "binary_sensor.bridge", Some(OTHER)),
            ("running", "binary_sensor.pump", Some(OTHER)),
            ("opening", "binary_sensor.eingang", Some(CONTACT)),
            ("", "binary_sensor.eingang", None),
            // Ids of other systems.
            ("", "Light.Hall", None),
            ("", "door.hall", None),
            ("", "light.", None),
        ] {
            assert_eq!(meaning(kind, id), wanted, "{kind} {id}");
        }
    }

    #[test]
    fn no_word_has_two_meanings() {
        let own: Vec<(Meaning, &str)> = KINDS.iter().map(|row| (row.meaning, row.key)).collect();
        for table in [[&WORDS[..], &own].concat(), BINARY.to_vec()] {
            let mut words: Vec<&str> = table.iter().flat_map(|(_, known)| known.split_whitespace()).collect();
            let all = words.len();
            words.sort_unstable();
            words.dedup();
            assert_eq!(words.len(), all);
        }
    }

    #[test]
    fn all_kinds_of_our_own_sensors_have_a_meaning() {
        for row in KINDS {
            assert_eq!(meaning(row.key, ""), Some(row.meaning));
            assert_eq!(row.meaning == MOTION, row.senses_motion(), "{}", row.key);
        }
        assert!(Kind::ALL.iter().all(|kind| meaning(kind.word(), "").is_some()));
    }
}
