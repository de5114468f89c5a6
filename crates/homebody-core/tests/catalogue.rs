//! The catalogue of devices as a document, with the source of each number.

use crate::generated::is_generated;
use homebody_core::sensors::products::Product;
use std::fmt::Write;

const HEAD: &str = "\
# Devices

This page lists the motion sensors with known timing that `preset` in `home.json` can name.

A preset sets a sensor's timing and which movements it notices. Height, field and reach are keys of each sensor in `home.json`. To set
all of a device's values at once, pick it on the page under *Plan*, *Install*. `homebody suggest-sensors --device` suggests positions for
a device, and `homebody devices NAME` prints one with its sources.

Manufacturers state few of these values. The other values are those of the sensor that Godsey & Skubic measured in 2009, or our choice.

This page is made from `crates/homebody-core/src/sensors/products.rs` and `preset.rs`.

| `preset` | device | network | height, m | field, ° | reach, m | first event after, s | next event after, s |
|---|---|---|---|---|---|---|---|
";

fn document() -> String {
    let range = |[least, most]: [f64; 2]| if least == most { least.to_string() } else { format!("{least} to {most}") };
    let mut text = HEAD.to_owned();
    for device in Product::all() {
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
    for device in Product::all() {
        let Product { height_m, field_deg, reach_m, timing, .. } = device;
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
