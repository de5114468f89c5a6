//! Logs of gateways and devices: MQTT payloads, Zigbee2MQTT, ESPHome, Tasmota, radio devices and hubs.

use super::{SIX, about, has_remark, is_used, known, log, result, told};
use crate::stage::Folder;
use homebody_core::time::SECOND;
use homebody_log::LogSource;
use homebody_log::log::{Clock, ColumnRole};
use std::fs;

const CLOSED: &str = "read as OPEN and CLOSE";

#[test]
fn each_key_of_a_payload_is_a_reading() {
    let folder = Folder::new("payloads");
    let printed = "2026-02-02T06:00:00+0000 zigbee2mqtt/hall {\"occupancy\":true,\"battery\":97,\"update\":{\"state\":\"idle\"}}\n\
                   2026-02-02T06:01:00+0000 zigbee2mqtt/door {\"contact\":false,\"linkquality\":80,\"voltage\":null}\n\
                   2026-02-02T06:02:00+0000 zigbee2mqtt/door {\"contact\":true}\n\
                   2026-02-02T06:02:30+0000 zigbee2mqtt/bridge/state {\"state\":\"online\"}\n\
                   2026-02-02T06:02:40+0000 zigbee2mqtt/lamp/set {\"state\":\"ON\"}\n\
                   2026-02-02T06:03:00+0000 zigbee2mqtt/hall/availability offline\n\
                   2026-02-02T06:04:00+0000 zigbee2mqtt/hall/availability {\"state\":\"online\"}\n\
                   2026-02-02T06:05:00+0000 home/stair/motion ON\n";
    let rows = [
        (0.0, "hall occupancy", "true"),
        (0.0, "hall battery", "97"),
        (0.0, "hall update state", "idle"),
        (1.0, "door contact", "OPEN"),
        (1.0, "door linkquality", "80"),
        (2.0, "door contact", "CLOSE"),
        (3.0, "hall battery", "unavailable"),
        (3.0, "hall occupancy", "unavailable"),
        (3.0, "hall update state", "unavailable"),
        (5.0, "home/stair/motion", "ON"),
    ];
    let text = log(&folder, "mosquitto", "messages.txt", printed);
    assert_eq!((told(&text), text.skipped, text.clock), (rows.to_vec(), 0, Clock::Utc));
    let kinds =
        ["hall occupancy", "hall battery", "hall update state", "door contact"].map(|sensor| about(&text, sensor)[1]);
    assert_eq!(kinds, ["occupancy", "battery", "update", "contact"]);
    assert!(has_remark(&text, CLOSED) && has_remark(&text, "asks a device") || has_remark(&text, "ask a device"));
    // The same as JSON Lines, with payloads as objects, as texts, and as mosquitto_sub prints them.
    let lines = |payload: &dyn Fn(&str) -> String, time: &str| {
        let line = |line: &str| {
            let mut parts = line.splitn(3, ' ');
            let (at, topic, said) = (parts.next().unwrap(), parts.next().unwrap(), parts.next().unwrap());
            let at = at.replace("+0000", if time == "tst" { ".000000Z+0000" } else { "Z" });
            format!("{{\"{time}\": \"{at}\", \"topic\": \"{topic}\", \"qos\": 0, \"payload\": {}}}\n", payload(said))
        };
        printed.lines().map(line).collect::<String>()
    };
    let quoted = |said: &str| format!("{said:?}");
    let plain = |said: &str| if said.starts_with('{') { said.to_owned() } else { quoted(said) };
    for (name, text) in [("a.jsonl", lines(&plain, "timestamp")), ("b.jsonl", lines(&quoted, "tst"))] {
        let log = log(&folder, "jsonl", name, &text);
        assert_eq!((told(&log), log.skipped), (rows.to_vec(), 0), "{text}");
        assert!(has_remark(&log, CLOSED), "{:?}", log.remarks);
    }
    // A contact of another program keeps its value.
    let other = "2026-02-02T06:00:00+0000 home/door {\"contact\":true}\n";
    let other = log(&folder, "mosquitto", "other.txt", other);
    assert_eq!((told(&other), has_remark(&other, CLOSED)), (vec![(0.0, "home/door contact", "true")], false));
    // Words alone stay rows of three words.
    let words = "2026-02-02T06:00:00+0000 home/hall/motion ON\n2026-02-02T06:01:00+0000 home/hall/motion OFF\n";
    assert_eq!(told(&log(&folder, "casas", "words.txt", words)).len(), 2);
}

#[test]
fn both_ages_of_zigbee2mqtt_write_what_they_publish() {
    let folder = Folder::new("zigbee");
    let first = "Zigbee2MQTT:info  2026-02-02 05:59:00: Logging to console and file\n\
                 Zigbee2MQTT:info  2026-02-02 06:00:00: MQTT publish: topic 'zigbee2mqtt/hall', payload '{\"occupancy\":true}'\n\
                 Zigbee2MQTT:debug 2026-02-02 06:00:30: Received Zigbee message from 'hall'\n\
                 Zigbee2MQTT:info  2026-02-02 06:01:00: MQTT publish: topic 'zigbee2mqtt/door', payload '{\"contact\":true}'\n";
    let second = "[2026-02-02 05:59:00] info: \tz2m: Starting Zigbee2MQTT version 2.1.0\n\
                  [2026-02-02 06:00:00] info: \tz2m:mqtt: MQTT publish: topic 'zigbee2mqtt/hall', payload '{\"occupancy\":true}'\n\
                  [2026-02-02 06:00:30] debug: \tz2m: Received Zigbee message from 'hall'\n\
                  [2026-02-02 06:01:00] info: \tz2m:mqtt: MQTT publish: topic 'zigbee2mqtt/door', payload '{\"contact\":true}'\n";
    for text in [first, second] {
        let log = log(&folder, "zigbee2mqtt", "z.log", text);
        assert_eq!(told(&log), [(0.0, "hall occupancy", "true"), (1.0, "door contact", "CLOSE")]);
        assert_eq!((log.skipped, log.clock), (0, Clock::Local));
        assert!(has_remark(&log, "about the program itself: 2"), "{:?}", log.remarks);
    }
    let silent = "[2026-02-02 05:59:00] info: \tz2m: Starting Zigbee2MQTT version 2.1.0\n[2026-02-02 05:59:01] info: \tz2m: Started\n";
    let error = result(&folder, "zigbee2mqtt", "silent.log", silent).unwrap_err();
    assert_eq!(error.code(), "log-form::no-messages", "{error}");
}

#[test]
fn a_log_of_esphome_takes_its_day_from_its_name_or_is_refused() {
    let folder = Folder::new("esphome");
    let text = "[05:59:00][C][wifi:599]: WiFi:\n\
                \u{1b}[0;36m[06:00:00][D][binary_sensor:036]: 'Hall': Sending state ON\u{1b}[0m\n\
                [06:01:00.500][D][sensor:093]: 'Warmth': Sending state 21.50000 °C with 1 decimals of accuracy\n\
                [06:02:00][D][text_sensor:064]: 'Mode': Sending state 'night'\n\
                [06:03:00][D][binary_sensor:036]: 'Hall': New state is OFF\n\
                [00:30:00][D][sensor:093]: 'Warmth': Sending state nan °C with 1 decimals of accuracy\n";
    let dated = log(&folder, "esphome", "hall-2026-02-02.log", text);
    let rows = [
        (0.0, "Hall", "ON"),
        (1.0 + 0.5 / 60.0, "Warmth", "21.50000"),
        (2.0, "Mode", "night"),
        (3.0, "Hall", "OFF"),
        (18.5 * 60.0, "Warmth", "unknown"),
    ];
    assert_eq!((told(&dated), dated.skipped, dated.clock), (rows.to_vec(), 0, Clock::Local));
    assert_eq!(about(&dated, "Warmth"), ["Warmth", "sensor", "°C", ""]);
    assert!(is_used(&dated, "the file's name", ColumnRole::Time));
    let error = result(&folder, "esphome", "hall.log", text).unwrap_err();
    assert_eq!(error.code(), "log-form::no-date", "{error}");
    // Dates that another program has put before the lines count.
    let before = text.replace("[0", "2026-02-02 [0").replace("2026-02-02 [0;", "[0;");
    assert!(result(&folder, "esphome", "before.log", &before).is_err(), "a date alone is no instant");
    let stamped = "2026-02-02 06:00:01 [23:00:01][D][switch:055]: 'Fan' >> ON\n2026-02-02 06:01:01 [23:01:01][D][switch:055]: 'Fan' >> OFF\n";
    let stamped = log(&folder, "esphome", "stamped.log", stamped);
    assert_eq!(told(&stamped).iter().map(|row| row.2).collect::<Vec<_>>(), ["ON", "OFF"]);
    assert_eq!(stamped.events[0].at, SIX + SECOND);
}

#[test]
fn a_log_of_tasmota_takes_its_day_from_its_telemetry() {
    let folder = Folder::new("tasmota");
    let text = "23:59:00.000 CMD: Group 0\n\
                23:59:30.000 MQT: stat/hall/RESULT = {\"POWER\":\"ON\"}\n\
                23:59:30.010 MQT: stat/hall/POWER = ON\n\
                00:00:30.000 MQT: tele/hall/SENSOR = {\"Time\":\"2026-02-02T00:00:30\",\"SR501\":{\"Motion\":1},\"TempUnit\":\"C\"} (retained)\n\
                06:00:00.000 MQT: stat/hall/POWER = OFF\n\
                06:01:00.000 MQT: tele/hall/LWT = Offline\n";
    let rows = [
        (-360.5, "hall POWER", "ON"),
        (-359.5, "hall SR501 Motion", "1"),
        (-359.5, "hall TempUnit", "C"),
        (0.0, "hall POWER", "OFF"),
        (1.0, "hall POWER", "unavailable"),
        (1.0, "hall SR501 Motion", "unavailable"),
        (1.0, "hall TempUnit", "unavailable"),
    ];
    let told_day = log(&folder, "tasmota", "hall.log", text);
    assert_eq!((told(&told_day), told_day.skipped), (rows.to_vec(), 0));
    assert_eq!(about(&told_day, "hall SR501 Motion")[1], "motion");
    assert!(has_remark(&told_day, "under a second topic"), "{:?}", told_day.remarks);
    let undated = text.replace("\"Time\":\"2026-02-02T00:00:30\",", "");
    let named = log(&folder, "tasmota", "hall_20260201.log", &undated);
    assert_eq!(told(&named), rows);
    let error = result(&folder, "tasmota", "hall2.log", &undated).unwrap_err();
    assert_eq!(error.code(), "log-form::no-date", "{error}");
}

#[test]
fn messages_of_radio_devices_have_a_reading_under_each_key() {
    let folder = Folder::new("radio");
    let text = r#"{"time" : "2026-02-02 06:00:00", "model" : "Tower", "id" : 9321, "channel" : "A", "battery_ok" : 1, "temperature_C" : 18.4, "mic" : "CRC"}
{"time" : "2026-02-02 06:01:00", "model" : "Door", "id" : 90112, "opened" : 1, "state" : "open"}
{"time" : "2026-02-02 06:02:00", "model" : "Door", "id" : 90112, "opened" : 0, "state" : "closed"}
"#;
    let rows = [
        (0.0, "Tower 9321 A battery_ok", "1"),
        (0.0, "Tower 9321 A temperature_C", "18.4"),
        (1.0, "Door 90112", "open"),
        (2.0, "Door 90112", "closed"),
    ];
    let log = log(&folder, "jsonl", "rtl.json", text);
    assert_eq!((told(&log), log.skipped), (rows.to_vec(), 0));
    let text = r#"{"end_device_ids": {"device_id": "bath"}, "received_at": "2026-02-02T06:00:00.5Z", "uplink_message": {"f_cnt": 0, "decoded_payload": {"humidity": 51}, "rx_metadata": [{"rssi": -64}]}}"#;
    let log = self::log(&folder, "jsonl", "uplinks.jsonl", text);
    assert_eq!(log.sensors, ["bath humidity"]);
}

#[test]
fn a_guess_by_place_takes_no_id_and_leaves_no_number_without_a_word() {
    let folder = Folder::new("by_place");
    let text = r#"{"um": "2026-02-02T06:00:00", "wer": "hall", "zahl_id": 7, "warm": 21.5, "feucht": 40}"#;
    let log = log(&folder, "jsonl", "ids.jsonl", text);
    assert!(
        log.sensors.iter().any(|sensor| sensor == "hall warm")
            && log.sensors.iter().any(|sensor| sensor == "hall feucht")
    );
    let text = r#"{"um": "2026-02-02T06:00:00", "wer": "hall", "was": "an", "warm": 21.5}"#;
    let log = self::log(&folder, "jsonl", "words.jsonl", text);
    assert_eq!(told(&log), [(0.0, "hall", "an")]);
    assert!(has_remark(&log, "the numbers under \"warm\""), "{:?}", log.remarks);
}

#[test]
fn an_attribute_parts_the_readings_of_a_device() {
    let folder = Folder::new("attributes");
    let text = r#"[
  {"id": 1000, "timestamp": 1770012000, "deviceID": 57, "deviceType": "com.fibaro.motionSensor", "propertyName": "value", "oldValue": "0", "newValue": "1", "event": null},
  {"id": 1001, "timestamp": 1770012060, "deviceID": 57, "propertyName": "batteryLevel", "oldValue": "80", "newValue": "79", "event": null}
]"#;
    let log = log(&folder, "json", "events.json", text);
    assert_eq!(told(&log), [(0.0, "57", "1"), (1.0, "57 batteryLevel", "79")]);
    assert_eq!(known(&log, "57").kind, "com.fibaro.motionsensor");
}

#[test]
fn a_file_names_the_sensor_of_its_rows_if_it_has_a_word_for_one() {
    let folder = Folder::new("of_file");
    let text = r#"[{"val":21.02,"ts":1770012000000,"ack":1,"q":0},{"val":21.9,"ts":1770012060000,"ack":1,"q":0}]"#;
    let log = log(&folder, "json", "history.zigbee.0.hall.temperature.json", text);
    assert_eq!(told(&log), [(0.0, "zigbee.0.hall.temperature", "21.02"), (1.0, "zigbee.0.hall.temperature", "21.9")]);
    let text = r#"[{"dateTime": "2026-02-02T06:00:00Z", "value": {"bpm": 51}}, {"dateTime": "2026-02-02T06:01:00Z", "value": {"bpm": 52}}]"#;
    let log = self::log(&folder, "json", "heart_rate-2026-02-02.json", text);
    assert_eq!(log.sensors, ["heart_rate bpm"]);
    let error = result(&folder, "json", "rows.json", text).unwrap_err().to_string();
    assert!(error.contains("nothing names its sensor"), "{error}");
}

#[test]
fn lists_of_one_length_are_the_columns_of_a_table() {
    let folder = Folder::new("columns");
    let text = r#"{"latitude": 52.5, "hourly_units": {"time": "iso8601", "warm": "C"},
 "hourly": {"time": ["2026-02-02T06:00", "2026-02-02T06:01"], "warm": [2.5, 2.25], "wet": [80, null]}}"#;
    let log = log(&folder, "json", "weather.json", text);
    assert_eq!(told(&log), [(0.0, "warm", "2.5"), (0.0, "wet", "80"), (1.0, "warm", "2.25")]);
    let text = r#"{"time": {"0": 1770012000, "1": 1770012060}, "sensor": {"0": "hall", "1": "bath"}, "value": {"0": "ON", "1": "OFF"}}"#;
    let log = self::log(&folder, "json", "frame.json", text);
    assert_eq!(told(&log), [(0.0, "hall", "ON"), (1.0, "bath", "OFF")]);
}

#[test]
fn a_service_of_hue_is_read_from_its_events() {
    let folder = Folder::new("hue");
    let event = |minute: u8, is: bool| {
        format!(
            r#"[{{"creationtime":"2026-02-02T06:0{minute}:00Z","data":[{{"id":"a1","motion":{{"motion":{is},"motion_valid":true}},"owner":{{"rid":"d1"}},"type":"motion"}}],"id":"e{minute}","type":"update"}}]"#
        )
    };
    let log = log(&folder, "json", "events.json", &format!("{}\n{}\n", event(0, true), event(2, false)));
    assert_eq!(told(&log), [(0.0, "a1 motion", "true"), (2.0, "a1 motion", "false")]);
    // The stream of the bridge is text around JSON: a hint takes that out.
    let path = folder.path().join("stream.txt");
    fs::write(&path, format!(": hi\n\nid: 1:0\ndata: {}\n\nid: 2:0\ndata: {}\n\n", event(0, true), event(2, false)))
        .unwrap();
    let error = LogSource::recognise(&path).unwrap_err().to_string();
    assert!(error.contains("sed -n 's/^data: //p'"), "{error}");
}
