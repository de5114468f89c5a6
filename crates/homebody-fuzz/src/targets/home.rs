//! Homes: coverage and pictures.

use super::messages;
use crate::seeds;
use crate::target::{self, CaseFiles, ReadVerdict, Target};
use homebody_analysis::coverage::{STEP_M, of_home};
use homebody_core::geometry;
use homebody_core::plan::Plan;
use homebody_core::resident::Build;
use homebody_picture::{coverage_map, floor_plan};
use homebody_simulation::ScenarioSource;
use homebody_walk::Mesh;
use std::path::Path;

pub const TARGET: Target = Target { name: "home", cases: 2_000, seeds, mutate: target::change_json, run };

/// A scenario without residents.
pub const SCENARIO: &str =
    r#"{ "name": "a", "start": "2026-01-05T00:00:00", "days": 1, "home": "home.json", "residents": [] }"#;

/// Radius of an older adult's body.
pub const BODY_M: f64 = 0.22;

fn seeds() -> Vec<CaseFiles> {
    let home = |files: CaseFiles| files.into_iter().filter(|(name, _)| name == "home.json").collect();
    seeds::named(TARGET.name).into_iter().chain(seeds::scenarios().into_iter().map(home)).collect()
}

fn run(files: &CaseFiles, _: &Path) -> Result<ReadVerdict, String> {
    let mut texts = target::texts(files);
    texts.insert("scenario.json".to_owned(), SCENARIO.to_owned());
    let scenario = match ScenarioSource::from_texts(texts.clone(), "scenario.json").scenario() {
        Ok(scenario) => scenario,
        Err(error) => return messages::error(&error, &texts).map(|()| ReadVerdict::Refused),
    };
    let home = &scenario.home;
    let plan = Plan::new(&**home);
    let mesh = Mesh::new(&plan, BODY_M);
    for rooms in plan.rooms.windows(2) {
        mesh.path(geometry::inner_point(&rooms[0].outline), geometry::inner_point(&rooms[1].outline));
    }
    let seen = of_home(home, Build::adult(), STEP_M);
    let svg = [floor_plan(home), coverage_map(&seen.home, &seen.coverage, &[])];
    if svg.iter().any(|svg| svg.contains("NaN") || svg.contains("inf\"")) {
        return Err("a picture has a value that is not a number".into());
    }
    Ok(ReadVerdict::Accepted)
}
