//! The catalogue of devices as a document, with the source of each number.

#![allow(clippy::disallowed_methods, reason = "a test may read and write files; the core may not")]

#[path = "../../../tests/generated.rs"]
mod generated;

use generated::is_generated;
use homebody_core::scenario::device::Device;
use std::fmt::Write;

const HEAD: &str = "\
# Devices

Motion sensors whose timing is known, made from `crates/homebody-core/src/scenario/device.rs` and `preset.rs` beside it. `preset` in
`home.json` names one; it brings its timing and what it notices along. Mounting height, field and reach stand in `home.json` with each sensor:
in the page's *Plan*, under *Parts*, a device is picked with all of its numbers, and `homebody place --device` suggests places for it.
`homebody devices` prints the table, `homebody devices NAME` one device with its sources.

Makers publish little. Where nobody does, a number is that of the sensor which Godsey & Skubic measured in 2009, or one of ours.

| `preset` | device | network | height, m | field, ° | reach, m | first message after, s | next after, s |
|---|---|---|---|---|---|---|---|
";

fn document() -> String {
    let range = |[least, most]: [f64; 2]| if least == most { least.to_string() } else { format!("{least} to {most}") };
    let mut text = HEAD.to_owned();
    for device in Device::all() {
        let timing = device.preset.timing();
        let [across, down] = device.field_deg.value;
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {} | {across} x {down} | {} | {} | {} |",
            device.key(),
            device.name(),
            device.network,
            device.height_m.value,
            device.reach_m.value,
            range(timing.first_fire_s),
            range(timing.refire_s)
        );
    }
    text += "\n## Sources\n\n| `preset` | height | field | reach | timing |\n|---|---|---|---|---|\n";
    for device in Device::all() {
        let Device { height_m, field_deg, reach_m, timing, .. } = device;
        let key = device.key();
        let _ =
            writeln!(text, "| `{key}` | {} | {} | {} | {timing} |", height_m.source, field_deg.source, reach_m.source);
    }
    text
}

#[test]
fn the_document_has_the_catalogue() {
    is_generated("docs/reference/devices.md", &document());
}
