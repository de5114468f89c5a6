//! `homebody devices`: the catalogue of motion sensors.

use crate::failure::Failure;
use crate::print::{print_json, print_text};
use crate::text_table::TextTable;
use homebody_core::nearest::nearest;
use homebody_core::sensors::products::Product;
use serde_json::{Value, json};
use std::fmt::Write;

homebody_core::messages! {
    /// Problems with the devices of the catalogue.
    pub enum DeviceMessage in "device" {
        /// Homebody knows the values of some makes of motion sensors. `homebody devices` lists them by name.
        Unknown { name: String, nearest: Option<String>, known: Vec<String> } error "unknown" ("no device is called {name:?}")
            advice (Some(match nearest {
                Some(nearest) => format!("did you mean {nearest:?}?"),
                None => format!("the devices are {}", known.join(", ")),
            }));
    }
}

/// List the motion sensors of the catalogue, with sources
///
/// Each device has maker and model, network, mounting height, field of view, reach and timing, with their sources. The first column
/// is the value for "preset" in home.json.
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody devices
  homebody devices fibaro
  homebody devices --json")]
pub struct DevicesArguments {
    /// Show this device only, with the sources of its values
    name: Option<String>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

impl DevicesArguments {
    pub fn run(self) -> Result<(), Failure> {
        let one = self.name.as_deref().map(device).transpose()?;
        let devices: Vec<Product> = one.map_or_else(|| Product::all().collect(), |one| vec![one]);
        if self.json {
            return print_json(&json!({ "devices": devices.iter().map(row).collect::<Vec<_>>() }));
        }
        match one {
            Some(device) => print_text(&sheet(&device)),
            None => print_text(&table(&devices)),
        }
    }
}

pub fn device(name: &str) -> Result<Product, Failure> {
    Product::all().find(|device| device.key() == name).ok_or_else(|| {
        let known: Vec<String> = Product::all().map(|device| device.key().to_owned()).collect();
        let nearest = nearest(name, known.iter().map(String::as_str)).map(str::to_owned);
        Failure::asked(DeviceMessage::Unknown { name: name.to_owned(), nearest, known })
    })
}

fn row(device: &Product) -> Value {
    let timing = device.preset.timing();
    json!({
        "name": device.key(), "make": device.make, "model": device.model, "network": device.network,
        "height_m": device.height_m, "field_deg": device.field_deg, "reach_m": device.reach_m,
        "first_fire_s": timing.first_fire_s, "refire_s": timing.refire_s, "persist_s": timing.persist_s,
        "timing_source": device.timing,
    })
}

fn table(devices: &[Product]) -> String {
    let table =
        TextTable::new("-14 name|-48 make and model|-10 network|8 height m|12 field °|7 reach m|14 next after s");
    let row = |device: &Product| {
        let [across, down] = device.field_deg.value;
        let field = format!("{across} x {down}");
        let (height_m, reach_m, next) =
            (device.height_m.value, device.reach_m.value, range(device.preset.timing().refire_s));
        table.row(&[&device.key(), &device.name(), &device.network, &height_m, &field, &reach_m, &next])
    };
    std::iter::once(table.heading()).chain(devices.iter().map(row)).collect()
}

fn sheet(device: &Product) -> String {
    let timing = device.preset.timing();
    let [across, down] = device.field_deg.value;
    let rows = [
        ("mounting height", format!("{} m", device.height_m.value), device.height_m.source),
        ("field of view", format!("{across}° across, {down}° up and down"), device.field_deg.source),
        ("reach", format!("{} m", device.reach_m.value), device.reach_m.source),
        ("first message", format!("after {} s", range(timing.first_fire_s)), device.timing),
        ("next message", format!("after {} s", range(timing.refire_s)), device.timing),
    ];
    let network = if device.network.is_empty() { String::new() } else { format!(", {}", device.network) };
    let mut text = format!("{} ({}{network})\n\n", device.name(), device.key());
    for (what, value, source) in rows {
        let _ = writeln!(text, "{what:16} {value:32} {source}");
    }
    text
}

fn range([least, most]: [f64; 2]) -> String {
    if least == most { least.to_string() } else { format!("{least} to {most}") }
}
