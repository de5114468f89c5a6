//! Logs that gateways of sensors write: texts of ESPHome, Mosquitto, Tasmota and Zigbee2MQTT.

pub(crate) mod esphome;
pub(crate) mod mosquitto;
pub(crate) mod tasmota;
pub(crate) mod zigbee2mqtt;
