//! The sensors of `home.json` that do not look for movement: they hang on things, lie under people or stand in rooms.

use crate::geometry::At;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A contact on a door or a piece of furniture: says `OPEN` and `CLOSE`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "contact sensor")]
pub struct ContactFile {
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// The door or piece of furniture that it hangs on.
    pub on: String,
}

/// A pneumatic strip in a bed: says `IN` and `OUT`, `RESTLESS_1` to `RESTLESS_4`, and of pulse and respiration whether they
/// are low, normal or high.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "bed sensor")]
pub struct BedFile {
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// The enterable piece of furniture that it lies in.
    pub on: String,
    /// How long a movement has lasted when it reaches each level of restlessness.
    #[serde(default = "levels")]
    #[schemars(length(min = 1, max = 4), inner(range(min = 0, max = 3_600)))]
    pub levels_s: Vec<f64>,
    /// How often it says pulse and respiration of somebody who keeps still.
    #[serde(default = "vitals_every")]
    #[schemars(range(min = 1, max = 86_400))]
    pub vitals_every_s: f64,
    /// Beats a minute: less is low, more is high.
    #[serde(default = "pulse")]
    #[schemars(inner(range(min = 1, max = 300)))]
    pub pulse_bpm: [f64; 2],
    /// Breaths a minute: less is low, more is high.
    #[serde(default = "respiration")]
    #[schemars(inner(range(min = 1, max = 100)))]
    pub respiration_pm: [f64; 2],
    /// How long somebody has lain still before it can tell pulse and respiration.
    #[serde(default = "still")]
    #[schemars(range(min = 0, max = 3_600))]
    pub still_s: f64,
}

/// A temperature sensor on a stove: says `ON` and `OFF` as its heat crosses two limits, and readings if asked to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "stove temperature sensor")]
pub struct StoveTemperatureFile {
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// The piece of furniture whose heat it takes.
    pub on: String,
    /// How hot it gets where the sensor is, in the long run.
    #[serde(default = "hot")]
    #[schemars(range(min = 25, max = 1_000))]
    pub hot_c: f64,
    /// Heating up past this, it says `ON`.
    #[serde(default = "on_above")]
    #[schemars(range(min = 23, max = 1_000))]
    pub on_above_c: f64,
    /// Cooling down past this, it says `OFF`.
    #[serde(default = "off_below")]
    #[schemars(range(min = 22.1, max = 1_000))]
    pub off_below_c: f64,
    /// How often it says its temperature too, when that has changed by a degree; without it, never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 86_400))]
    pub readings_every_s: Option<f64>,
}

/// A pressure pad in a chair or a mat on the floor: says `ON` and `OFF`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "pressure sensor")]
pub struct PressureFile {
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// The enterable piece of furniture that it lies in; in one at most 5 cm high, it is a mat.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
    /// The convex area of a mat on the floor, instead of `on`: its corners in order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 3, max = 64), inner(inner(range(min = -10_000, max = 10_000))))]
    pub area: Option<Vec<At>>,
    /// How long it is pressed, or free, before it says so.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = 3_600))]
    pub delay_s: f64,
}

/// A power meter on what draws electricity: says `ON` and `OFF`, and watts if told how many.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "power sensor")]
pub struct PowerFile {
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// The piece of furniture that it feeds, or the room whose lamp it feeds.
    pub on: String,
    /// What that draws while it is on; without it, there are no readings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.1, max = 100_000))]
    pub watts: Option<f64>,
    /// What it draws while it is off.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(range(min = 0, max = 100_000))]
    pub standby_watts: f64,
    /// How often it says the watts while it is on; without it, only as it is turned on or off.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 86_400))]
    pub readings_every_s: Option<f64>,
}

/// A flow sensor in a water pipe: says `ON` and `OFF`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "flow sensor")]
pub struct FlowFile {
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// The piece of furniture that the pipe leads to.
    pub on: String,
    /// How long water runs each time by itself, as into a cistern (about 60 s); without it, until it is turned off.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.001, max = 86_400))]
    pub runs_s: Option<f64>,
}

/// A light meter in a room: says lux.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "light sensor")]
pub struct LightFile {
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// The room that it is in.
    pub room: String,
    /// What a sun right overhead would give through the windows; 0 without a window.
    #[serde(default = "daylight")]
    #[schemars(range(min = 0, max = 100_000))]
    pub daylight_lux: f64,
    /// What the room's lamp gives.
    #[serde(default = "lamp")]
    #[schemars(range(min = 0, max = 100_000))]
    pub lamp_lux: f64,
    /// It says what has changed by more than this since it last spoke.
    #[serde(default = "change")]
    #[schemars(range(min = 0.1, max = 1_000))]
    pub change_percent: f64,
    /// How often it measures.
    #[serde(default = "light_every")]
    #[schemars(range(min = 1, max = 86_400))]
    pub every_s: f64,
}

/// A thermometer in a room: says degrees Celsius.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "temperature sensor")]
pub struct TemperatureFile {
    #[schemars(length(min = 1, max = 100))]
    pub name: String,
    /// The room that it is in.
    pub room: String,
    #[serde(default = "mean")]
    #[schemars(range(min = -40, max = 60))]
    pub mean_c: f64,
    /// How far the day takes it up, and the night down.
    #[serde(default = "swing")]
    #[schemars(range(min = 0, max = 20))]
    pub swing_c: f64,
    /// The steps in which it tells temperatures; it says what has changed by one.
    #[serde(default = "step")]
    #[schemars(range(min = 0.01, max = 10))]
    pub step_c: f64,
    /// How often it measures.
    #[serde(default = "temperature_every")]
    #[schemars(range(min = 1, max = 86_400))]
    pub every_s: f64,
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
/// Ours. That the bed sensors at TigerPlace report restlessness by the persistence of movement is said in the patent of
/// Skubic et al., paragraphs 137 to 142; that it has four levels, on the page of the University of Virginia on ALARM-NET.
fn levels() -> Vec<f64> {
    vec![0.0, 3.0, 6.0, 9.0]
}
/// Ours.
fn vitals_every() -> f64 {
    900.0
}
/// Ours.
fn pulse() -> [f64; 2] {
    [30.0, 100.0]
}
/// Ours.
fn respiration() -> [f64; 2] {
    [6.0, 30.0]
}
/// Ours.
fn still() -> f64 {
    60.0
}
/// Ours: of a sensor beside the burners.
fn hot() -> f64 {
    180.0
}
/// Ours: above what a summer or the sun gives.
fn on_above() -> f64 {
    45.0
}
/// Ours: so far below that the air over a pot does not make it speak twice.
fn off_below() -> f64 {
    38.0
}
/// Ours.
fn daylight() -> f64 {
    400.0
}
/// Ours.
fn lamp() -> f64 {
    150.0
}
/// Ours.
fn change() -> f64 {
    20.0
}
/// Half of the light sensors' messages in a CASAS home (hh111) come 600 s after the one before.
fn light_every() -> f64 {
    600.0
}
/// Ours.
fn mean() -> f64 {
    22.0
}
/// Ours. Those of a CASAS home (hh111) swing by 2 to 3 degrees in a week of June.
fn swing() -> f64 {
    1.0
}
/// Ours. Those of a CASAS home (hh111) tell whole degrees.
fn step() -> f64 {
    0.5
}
/// Ours.
fn temperature_every() -> f64 {
    900.0
}
