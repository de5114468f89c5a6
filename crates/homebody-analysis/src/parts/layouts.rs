//! Two layouts of sensors in one home, side by side: what each sees, and in what they differ.

use super::{PartsList, SensorPart};
use crate::coverage::{self, STEP_M, SeenFloor};
use homebody_core::home::form::HomeFile;
use homebody_core::resident::Build;
use serde::Serialize;
use std::fmt;

/// Difference below which two positions are equal, in metres, in degrees and in hundredths of a floor (our choice): no
/// sensor is mounted more exactly.
const LEAST: f64 = 0.5;
const LEAST_M: f64 = 0.01;

#[derive(Clone, Copy, Debug)]
pub struct SensorLayout<'a> {
    pub name: &'a str,
    pub home: &'a HomeFile,
    pub build: Build,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayoutSummary {
    pub name: String,
    pub sensors: usize,
    #[serde(flatten)]
    pub parts: PartsList,
    pub whole: SeenFloor,
    /// The same of each room.
    pub rooms: Vec<SeenFloor>,
    pub dead_zones: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "wire", derive(ts_rs::TS))]
pub struct SensorDifference {
    pub sensor: String,
    /// The differences in the second layout.
    pub what: String,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayoutComparison {
    pub layouts: [LayoutSummary; 2],
    pub differences: Vec<SensorDifference>,
}

pub fn beside(layouts: [SensorLayout; 2]) -> LayoutComparison {
    let layouts = layouts.map(LayoutSummary::from_layout);
    let [one, other] = &layouts;
    let differences = differences(&one.parts.parts, &other.parts.parts);
    LayoutComparison { layouts, differences }
}

impl LayoutSummary {
    fn from_layout(layout: SensorLayout) -> LayoutSummary {
        let seen = coverage::of_home(layout.home, layout.build, STEP_M).coverage;
        LayoutSummary {
            name: layout.name.to_owned(),
            sensors: layout.home.sensors.len(),
            parts: PartsList::from_home(layout.home),
            whole: seen.whole,
            rooms: seen.rooms,
            dead_zones: seen.dead_zones.len(),
        }
    }
}

fn differences(one: &[SensorPart], other: &[SensorPart]) -> Vec<SensorDifference> {
    let named = |parts: &[SensorPart], name: &str| parts.iter().find(|part| part.name == name).cloned();
    let of_first = one.iter().filter_map(|part| {
        let what = match named(other, &part.name) {
            Some(same) => changed(part, &same)?,
            None => format!("goes: {}, {}", part.device, part.place),
        };
        Some(SensorDifference { sensor: part.name.clone(), what })
    });
    let fresh = other.iter().filter(|part| named(one, &part.name).is_none());
    let fresh = fresh.map(|part| SensorDifference {
        sensor: part.name.clone(),
        what: format!("comes: {}, {}", part.device, part.place),
    });
    of_first.chain(fresh).collect()
}

/// The differences of the second part, if there are any.
fn changed(one: &SensorPart, other: &SensorPart) -> Option<String> {
    let mut what: Vec<String> = Vec::new();
    if one.device != other.device {
        what.push(format!("is {} instead of {}", other.device, one.device));
    }
    let moved_m = (one.at[0] - other.at[0]).hypot(one.at[1] - other.at[1]);
    if moved_m > LEAST_M {
        what.push(format!("hangs {moved_m:.2} m away, {}", other.place));
    } else if one.place != other.place {
        what.push(format!("is {} instead of {}", other.place, one.place));
    }
    let mut told = |name: &str, unit: &str, least: f64, one: Option<f64>, other: Option<f64>| {
        if let (Some(one), Some(other)) = (one, other)
            && (one - other).abs() > least
        {
            what.push(format!("{name} {other}{unit} instead of {one}{unit}"));
        }
    };
    told("height", " m", LEAST_M, one.height_m, other.height_m);
    told("looks to", "°", LEAST, one.facing_deg, other.facing_deg);
    told("tilt", "°", LEAST, one.tilt_deg, other.tilt_deg);
    let across = |part: &SensorPart| part.field_deg.map(|field| field[0]);
    let down = |part: &SensorPart| part.field_deg.map(|field| field[1]);
    told("field across", "°", LEAST, across(one), across(other));
    told("field up and down", "°", LEAST, down(one), down(other));
    told("reach", " m", LEAST_M, one.reach_m, other.reach_m);
    (!what.is_empty()).then(|| what.join("; "))
}

impl fmt::Display for LayoutComparison {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [one, other] = &self.layouts;
        writeln!(f, "Two layouts\n")?;
        writeln!(f, "{:28} {:>16} {:>16}", "", shortened(&one.name), shortened(&other.name))?;
        writeln!(f, "{:28} {:>16} {:>16}", "sensors", one.sensors, other.sensors)?;
        writeln!(f, "{:28} {:>16} {:>16}", "places that none sees", one.dead_zones, other.dead_zones)?;
        let seen = |floor: &SeenFloor| format!("{:.1} %", 100.0 * (1.0 - floor.seen_by.none));
        writeln!(f, "{:28} {:>16} {:>16}", "floor that is seen", seen(&one.whole), seen(&other.whole))?;
        for floor in &one.rooms {
            let same = other.rooms.iter().find(|same| same.name == floor.name);
            let other = same.map_or("-".into(), seen);
            writeln!(f, "{:28} {:>16} {other:>16}", format!("  {}", shortened(&floor.name)), seen(floor))?;
        }
        for floor in other.rooms.iter().filter(|floor| one.rooms.iter().all(|room| room.name != floor.name)) {
            writeln!(f, "{:28} {:>16} {:>16}", format!("  {}", shortened(&floor.name)), "-", seen(floor))?;
        }
        if self.differences.is_empty() {
            return writeln!(f, "\nThe sensors are the same.");
        }
        writeln!(f, "\nWhat is different in the second")?;
        for SensorDifference { sensor, what } in &self.differences {
            writeln!(f, "  {sensor}: {what}")?;
        }
        Ok(())
    }
}

/// A name as long as a column of a table has room for; JSON has the whole name.
fn shortened(name: &str) -> String {
    const LETTERS: usize = 16;
    match name.chars().count() > LETTERS {
        true => name.chars().take(LETTERS - 1).chain(['…']).collect(),
        false => name.to_owned(),
    }
}
