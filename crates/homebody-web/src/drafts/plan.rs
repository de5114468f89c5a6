//! Drafts of a home: problems, picture, and coverage by sensors.

use super::{DraftService, problems};
use crate::draw;
use crate::messages::DraftMessage;
use crate::wire::{CoverageView, DeadZoneView, Draft, FloorView, ImportView, PlanView};
use homebody_analysis::coverage::{self, Coverage, STEP_M, SeenFloor, SeenHome};
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::plan::Plan;
use homebody_core::problem::Problem;
use homebody_core::resident::{Build, ResidentFile};
use homebody_core::scenario::load::{Files, NoText, Scenario};
use homebody_import::{ImportError, Imported, SCHEMA, sweet_home};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Number of cells that are examined in a tenth of a second or two (our choice): those of a home of 20 by 20 m.
const MOST_CELLS: f64 = 160_000.0;

/// A cell without room for a body.
const NO_FLOOR: u8 = 255;

impl DraftService {
    pub fn plan(&self, draft: Draft) -> PlanView {
        let files = self.with(draft);
        let (home, wrong) = match file(&files, &self.folders.entry) {
            Ok((name, text)) => match home_of_file(&name, text.clone()) {
                Ok(home) => (Some(home), Vec::new()),
                // Two equal names do not change coverage.
                Err(wrong) => (shapes(&text).and_then(|text| home_of_file(&name, text).ok()), wrong),
            },
            Err(wrong) => (None, wrong),
        };
        let Some(home) = home else { return PlanView { problems: problems(&wrong), home: None, coverage: None } };
        let seen = coverage::of_home(&home, build(&files, &self.folders.entry), step_m(home.plan()));
        let view = draw::home(&home, home.plan(), home.placed_sensors());
        PlanView { problems: problems(&wrong), home: Some(view), coverage: Some(coverage_view(&seen)) }
    }
}

impl DraftService {
    /// Imports the bytes of a Sweet Home 3D file, under the name of this home.
    pub fn import(&self, bytes: &[u8]) -> Result<ImportView, ImportError> {
        let home = self.files().home.map(|file| self.json(&file)).unwrap_or_default();
        let name = home["name"].as_str().unwrap_or("home");
        let Imported { mut home_json, remarks } = sweet_home(bytes, name, None)?;
        // The present home knows the path to the schemas of this folder.
        if let Some(schema) = home["$schema"].as_str() {
            home_json = home_json.replacen(&format!("\"{SCHEMA}\""), &json!(schema).to_string(), 1);
        }
        Ok(ImportView { text: home_json, remarks })
    }
}

/// The home of a scenario, whatever is wrong with other files.
pub fn home(files: &dyn Files, entry: &str) -> Result<ResolvedHome, Vec<Problem>> {
    let (name, text) = file(files, entry)?;
    home_of_file(&name, text)
}

/// The name and the text of the home's file.
fn file(files: &dyn Files, entry: &str) -> Result<(String, String), Vec<Problem>> {
    let of_entry = |message: DraftMessage| vec![Problem::of_file(entry, message, None)];
    let unread = |name: &str, why: NoText| of_entry(DraftMessage::NotRead { file: name.into(), why: why.to_string() });
    let text = files.read(entry).map_err(|why| unread(entry, why))?;
    let unparsed = |error: serde_json::Error| of_entry(DraftMessage::NotJson { why: error.to_string() });
    let root: serde_json::Value = serde_json::from_str(&text).map_err(unparsed)?;
    let name = root["home"].as_str().ok_or_else(|| of_entry(DraftMessage::NoHome))?;
    let text = files.read(name).map_err(|why| unread(name, why))?;
    Ok((name.to_owned(), text))
}

/// The home of a file, in a scenario without residents.
fn home_of_file(name: &str, text: String) -> Result<ResolvedHome, Vec<Problem>> {
    let nobody = json!({ "name": "home", "start": "2009-03-02T00:00:00", "days": 1, "home": name, "residents": [] });
    let around = if name == "scenario.json" { "around.json" } else { "scenario.json" };
    let alone: BTreeMap<String, String> = [(around.to_owned(), nobody.to_string()), (name.to_owned(), text)].into();
    Scenario::load(&alone, around).map(|scenario| scenario.home).map_err(|problems| problems.0)
}

/// A home's file reduced to what coverage needs: without places and roles, and with unique names. The first of several things with a
/// name keeps it, because sensors may refer to it.
fn shapes(text: &str) -> Option<String> {
    let mut home: Value = serde_json::from_str(text).ok()?;
    let folded = |name: &str| name.trim().to_lowercase();
    home.as_object_mut()?.remove("places");
    let mut rooms = BTreeSet::new();
    for list in ["rooms", "doors", "furniture", "sensors"] {
        let mut known = BTreeSet::new();
        let things = home.get_mut(list).and_then(Value::as_array_mut);
        for (number, thing) in things.into_iter().flatten().enumerate() {
            let is_entered = list == "furniture" && thing["enterable"] == true;
            if list == "furniture" && !is_entered {
                thing.as_object_mut()?.remove("role");
            }
            let name = folded(thing["name"].as_str()?);
            let is_taken = name.is_empty() || known.contains(&name) || is_entered && rooms.contains(&name);
            if is_taken {
                thing["name"] = json!(format!("{name} ({})", number + 1));
            } else {
                known.insert(name);
            }
        }
        if list == "rooms" {
            rooms = known;
        }
    }
    Some(home.to_string())
}

/// The body of the first resident, or of an adult if the file cannot be read.
pub fn build(files: &dyn Files, entry: &str) -> Build {
    let first = || -> Option<ResidentFile> {
        let root: serde_json::Value = serde_json::from_str(&files.read(entry).ok()?).ok()?;
        let name = root["residents"][0].as_str()?.to_owned();
        serde_json::from_str(&files.read(&name).ok()?).ok()
    };
    first().map_or_else(Build::adult, |file| Build::new(&file))
}

/// The side of a cell: that of the command, and longer in a very large home, whose coverage is drawn while a person edits it.
pub fn step_m(plan: &Plan) -> f64 {
    let (least, most) = plan.bounds();
    let area = (most.x - least.x) * (most.y - least.y);
    let times = (area / (STEP_M * STEP_M * MOST_CELLS)).sqrt().ceil().max(1.0);
    STEP_M * times
}

pub fn coverage_view(SeenHome { coverage, .. }: &SeenHome) -> CoverageView {
    let Coverage { step_m, whole, rooms, doorways, sensors, overlaps, dead_zones, grid, .. } = coverage;
    let cell =
        |cell: usize| grid.watchers(cell).map_or(NO_FLOOR, |watchers| watchers.min(usize::from(NO_FLOOR) - 1) as u8);
    let half = step_m / 2.0;
    let corner = if grid.cells.is_empty() { [0.0; 2] } else { draw::at(grid.middle(0)).map(|middle| middle - half) };
    let zone = |zone: &coverage::DeadZone| DeadZoneView {
        number: zone.number as u32,
        room: zone.room.clone(),
        area_m2: zone.area_m2,
        middle: zone.middle,
        outline: zone.outline.clone(),
        holes: zone.holes.clone(),
    };
    CoverageView {
        step_m: *step_m,
        corner,
        columns: grid.columns as u32,
        cells: (0..grid.cells.len()).map(cell).collect(),
        whole: floor(whole),
        rooms: rooms.iter().chain(doorways).map(floor).collect(),
        sensors: sensors.clone(),
        overlaps: overlaps
            .iter()
            .map(|overlap| {
                let [one, other] = overlap.sensors.clone();
                (one, other, overlap.shared_m2)
            })
            .collect(),
        dead_zones: dead_zones.iter().map(zone).collect(),
    }
}

fn floor(SeenFloor { name, floor_m2, seen_by, .. }: &SeenFloor) -> FloorView {
    let seen_by = [seen_by.none, seen_by.one, seen_by.two, seen_by.three_or_more];
    FloorView { name: name.clone(), floor_m2: *floor_m2, seen_by }
}
