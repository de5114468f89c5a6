//! Homes: what is seen of them, and how they are drawn.

use super::told;
use crate::corpus;
use crate::dice::Dice;
use crate::mutate::json;
use crate::target::{self, Files, Target, Verdict};
use homebody_analysis::coverage::{STEP_M, of_home};
use homebody_core::geometry;
use homebody_core::home::Build;
use homebody_core::home::plan::Plan;
use homebody_kit::Source;
use homebody_picture::{coverage_map, floor_plan};
use homebody_walk::Mesh;
use std::path::Path;

pub const TARGET: Target =
    Target { name: "home", about: "homes: coverage, ways, pictures", cases: 2_000, corpus, mutate, run };

/// A scenario in which nobody lives.
const SCENARIO: &str =
    r#"{ "name": "a", "start": "2026-01-05T00:00:00", "days": 1, "home": "home.json", "residents": [] }"#;

/// An older adult's body.
const BODY_M: f64 = 0.22;

fn corpus() -> Vec<Files> {
    let home = |files: Files| files.into_iter().filter(|(name, _)| name == "home.json").collect();
    corpus::of(TARGET.name).into_iter().chain(corpus::scenarios().into_iter().map(home)).collect()
}

fn mutate(files: &mut Files, corpus: &[Files], dice: &mut Dice) {
    target::change(files, corpus, dice, |_, text, others, dice| {
        json::json(text, others, dice);
    });
}

fn run(files: &Files, _: &Path) -> Result<Verdict, String> {
    let mut texts = target::texts(files);
    texts.insert("scenario.json".to_owned(), SCENARIO.to_owned());
    let scenario = match Source::of_texts(texts.clone(), "scenario.json").scenario() {
        Ok(scenario) => scenario,
        Err(error) => return told::error(&error, &texts).map(|()| Verdict::Refused),
    };
    let home = &scenario.home;
    let plan = Plan::new(home);
    let mesh = Mesh::new(&plan, BODY_M);
    for rooms in plan.rooms.windows(2) {
        mesh.path(geometry::inner_point(&rooms[0].outline), geometry::inner_point(&rooms[1].outline));
    }
    let seen = of_home(home, Build::adult(), STEP_M);
    let svg = [floor_plan(home), coverage_map(&seen.home, &seen.coverage, &[])];
    if svg.iter().any(|svg| svg.contains("NaN") || svg.contains("inf\"")) {
        return Err("a picture with a number that is none".into());
    }
    Ok(Verdict::Accepted)
}
