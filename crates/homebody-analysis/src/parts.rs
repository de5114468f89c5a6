//! The parts list of an installer: each sensor with its device, its place in words, its height and its angles.
//!
//! A place is given by distances from two walls, measured on the floor from their faces to the lens, or to the middle of a sensor on a
//! ceiling or a floor. Sensors on a thing are at the place of the thing.
//!
//! We assume that a wall is where the home's file has one: where a room ends without a wall, its outline counts as one.
//!
//! Left out: prices, batteries and cables.

mod layouts;
mod place;

pub use layouts::{LayoutComparison, LayoutSummary, SensorDifference, SensorLayout, beside};

use homebody_core::geometry::{self, Point};
use homebody_core::home::form::HomeFile;
use homebody_core::plan::Plan;
use homebody_core::sensors::Sensor;
use homebody_core::sensors::form::{Mount, Orientation};
use homebody_core::sensors::kinds::SensorFile;
use homebody_core::sensors::products::Product;
use serde::Serialize;
use std::fmt::{self, Write};

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartsList {
    pub home: String,
    /// The devices with their counts, the most first.
    pub devices: Vec<Count>,
    pub parts: Vec<SensorPart>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Count {
    pub device: String,
    pub count: usize,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SensorPart {
    /// From 1, in the order of the home's file.
    pub number: usize,
    pub name: String,
    /// Its kind, as `home.json` has it.
    pub kind: &'static str,
    /// Make and model, or the kind where any model will do.
    pub device: String,
    /// The network of its messages; empty where the device has no fixed one.
    pub network: &'static str,
    /// The room; `None` between rooms, as on a door.
    pub room: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor: Option<String>,
    pub place: String,
    /// The place on the plan, in metres to the east and to the north.
    pub at: [f64; 2],
    /// The height of its lens above the floor, in metres, if it has a lens.
    pub height_m: Option<f64>,
    /// The direction of its lens: 0 is east, 90 is north.
    pub facing_deg: Option<f64>,
    pub looks: Option<String>,
    /// The tilt of its lens downward, in degrees.
    pub tilt_deg: Option<f64>,
    /// Its angle of view, horizontal and vertical, in degrees.
    pub field_deg: Option<[f64; 2]>,
    pub reach_m: Option<f64>,
}

impl PartsList {
    pub fn from_home(home: &HomeFile) -> PartsList {
        let plan = Plan::new(home);
        let sensors = home.sensors.iter().zip(1..);
        let parts: Vec<SensorPart> =
            sensors.filter_map(|(file, number)| SensorPart::from_file(file, number, home, &plan)).collect();
        let mut devices: Vec<Count> = Vec::new();
        for part in &parts {
            match devices.iter_mut().find(|count| count.device == part.device) {
                Some(count) => count.count += 1,
                None => devices.push(Count { device: part.device.clone(), count: 1 }),
            }
        }
        devices.sort_by_key(|count| std::cmp::Reverse(count.count));
        PartsList { home: home.name.clone(), devices, parts }
    }

    /// As comma-separated values with a head, as spreadsheets read them.
    pub fn csv(&self) -> String {
        let mut text = "number,name,device,network,floor,room,place,east_m,north_m,height_m,facing_deg,looks,tilt_deg,\
                        field_across_deg,field_down_deg,reach_m\n"
            .to_owned();
        for part in &self.parts {
            let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
            let cells = [
                part.number.to_string(),
                quoted(&part.name),
                quoted(&part.device),
                part.network.to_owned(),
                quoted(part.floor.as_deref().unwrap_or_default()),
                quoted(part.room.as_deref().unwrap_or_default()),
                quoted(&part.place),
                part.at[0].to_string(),
                part.at[1].to_string(),
                number(part.height_m),
                number(part.facing_deg),
                quoted(part.looks.as_deref().unwrap_or_default()),
                number(part.tilt_deg),
                number(part.field_deg.map(|field| field[0])),
                number(part.field_deg.map(|field| field[1])),
                number(part.reach_m),
            ];
            let _ = writeln!(text, "{}", cells.join(","));
        }
        text
    }
}

/// A cell as RFC 4180 has it. It escapes what a spreadsheet would take for a formula.
fn quoted(cell: &str) -> String {
    let plain = if cell.starts_with(['=', '+', '-', '@']) { format!("'{cell}") } else { cell.to_owned() };
    match plain.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", plain.replace('"', "\"\"")),
        false => plain,
    }
}

impl SensorPart {
    fn from_file(file: &SensorFile, number: usize, home: &HomeFile, plan: &Plan) -> Option<SensorPart> {
        let sensor = Sensor::new(file, plan)?;
        let device = file.preset().map(Product::new);
        let room = plan.room_at(sensor.at).map(|room| &home.rooms[room]);
        let rounded = |value: f64| (value * 100.0).round() / 100.0;
        let mut part = SensorPart {
            number,
            name: file.name().to_owned(),
            kind: file.row().key,
            device: device.map_or_else(|| format!("{} sensor, any make", file.row().label), |device| device.name()),
            network: device.map_or("", |device| device.network),
            room: room.map(|room| room.name.clone()),
            floor: room.and_then(|room| room.floor.clone()),
            place: words(file, plan, sensor.at),
            at: [rounded(sensor.at.x), rounded(sensor.at.y)],
            ..SensorPart::default()
        };
        if let Some(Orientation { height_m, facing_deg, tilt_deg, field_deg, reach_m, .. }) = file.orientation() {
            let facing_deg = facing_deg.rem_euclid(360.0);
            (part.height_m, part.facing_deg, part.tilt_deg) = (Some(height_m), Some(facing_deg), Some(tilt_deg));
            (part.field_deg, part.reach_m) = (Some(field_deg), reach_m);
            part.looks = Some(place::looks(plan, sensor.at, facing_deg));
        }
        Some(part)
    }
}

fn words(file: &SensorFile, plan: &Plan, at: Point) -> String {
    let from_walls = place::from_walls(plan, at);
    let extent = |area: &[[f64; 2]]| {
        let (least, most) = geometry::bounds(area.iter().map(|&at| geometry::point(at)));
        let size = most - least;
        format!("{:.1} x {:.1} m", size.x, size.y)
    };
    if file.row().mount == Mount::Wall {
        return place::on_wall(plan, at);
    }
    if let Some(area) = file.area_below() {
        return format!("on the ceiling, {from_walls}; looks down on {}", extent(area));
    }
    match (file.area(), file.on(), file.room()) {
        (Some(area), ..) => format!("on the floor, its middle {from_walls}; {} large", extent(area)),
        (_, Some(on), _) if plan.rooms.iter().any(|room| room.name == on) => format!("at the lamp of {on}"),
        (_, Some(on), _) => format!("at {on}, {from_walls}"),
        (_, _, Some(room)) => format!("anywhere in {room}"),
        _ => from_walls,
    }
}

impl fmt::Display for PartsList {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{}: what is put up\n", self.home)?;
        if self.parts.is_empty() {
            return writeln!(f, "The home has no sensors.");
        }
        for Count { device, count } in &self.devices {
            writeln!(f, "{count:>4}  {device}")?;
        }
        for part in &self.parts {
            writeln!(f, "\n{:>4}  {}: {}", part.number, part.name, part.device)?;
            writeln!(f, "      {}", part.whereabouts())?;
            if let Some(aim) = part.aim() {
                writeln!(f, "      {aim}")?;
            }
        }
        Ok(())
    }
}

impl SensorPart {
    pub fn whereabouts(&self) -> String {
        let room = self.room.as_deref().filter(|room| !self.place.ends_with(room));
        let parts = [self.floor.as_deref(), room, Some(&*self.place)];
        parts.into_iter().flatten().collect::<Vec<_>>().join(": ")
    }

    /// Height, direction and field in one line; `None` without a lens.
    pub fn aim(&self) -> Option<String> {
        let (height_m, tilt_deg) = (self.height_m?, self.tilt_deg?);
        let looks = self.looks.as_deref().unwrap_or_default();
        let mut aim = format!("{height_m:.2} m high, looks {looks}, {tilt_deg:.0}° down");
        if let Some([across, down]) = self.field_deg {
            let _ = write!(aim, "; sees {across:.0}° by {down:.0}°");
        }
        if let Some(reach_m) = self.reach_m {
            let _ = write!(aim, ", {reach_m:.0} m far");
        }
        Some(aim)
    }
}
