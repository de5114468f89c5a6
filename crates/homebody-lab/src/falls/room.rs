use super::cases::FallCase;
use homebody_core::random::Stream;
use homebody_core::scenario::load::Scenario;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    Usual,
    NoNoise,
    /// Silhouettes with about three times the usual noise.
    MoreNoise,
    /// A bookcase, a sideboard and a table hide the floor behind them.
    Furniture,
}

impl Condition {
    /// All of them.
    pub const ALL: [Condition; 4] = [Condition::Usual, Condition::NoNoise, Condition::MoreNoise, Condition::Furniture];

    pub fn name(self) -> &'static str {
        match self {
            Condition::Usual => "as usual",
            Condition::NoNoise => "without noise",
            Condition::MoreNoise => "three times the noise",
            Condition::Furniture => "behind furniture",
        }
    }

    fn numbers(self) -> Value {
        match self {
            Condition::Usual | Condition::Furniture => json!({}),
            Condition::NoNoise => json!({ "camera.flicker": 0, "camera.holes": 0, "camera.shadow": 0,
                "camera.specks": 0, "camera.light": 0 }),
            Condition::MoreNoise => json!({ "camera.flicker": 0.45, "camera.holes": 0.45, "camera.shadow": 0.75,
                "camera.specks": 1.5 }),
        }
    }
}

pub(super) fn scenario(case: FallCase, seed: u64, condition: Condition) -> (Scenario, f64) {
    let mut stream = Stream::named(seed, &format!("falls/{}", case.name()));
    let story = case.story(&mut stream);
    let [height_m, radius_m] = if case == FallCase::Cat { [0.3, 0.1] } else { [stream.between(1.5, 1.8), 0.2] };
    let entry = json!({ "name": "falls", "start": "2026-03-02T09:00:00", "time_zone": "UTC", "home": "home.json",
        "days": 1, "residents": ["somebody.json"], "numbers": condition.numbers() });
    let somebody =
        json!({ "name": "somebody", "radius_m": radius_m, "height_m": height_m, "driver": { "path": "path.json" } });
    let files = [
        ("scenario.json", entry),
        ("home.json", home(condition == Condition::Furniture)),
        ("path.json", story.path),
        ("somebody.json", somebody),
    ];
    let texts: BTreeMap<String, String> =
        files.into_iter().map(|(name, text)| (name.to_owned(), text.to_string())).collect();
    let scenario = Scenario::load(&texts, "scenario.json");
    (scenario.unwrap_or_else(|problems| panic!("the experiment's own room: {problems}")), story.length_s)
}

fn home(has_more: bool) -> Value {
    let mut furniture = vec![
        json!({ "name": "bed", "at": [1.1, 3.4], "size_m": [2.0, 0.9], "height_m": 0.55, "enterable": true }),
        json!({ "name": "armchair", "at": [0.8, 1.0], "size_m": [0.8, 0.8], "height_m": 0.95, "enterable": true }),
        json!({ "name": "chair", "at": [4.5, 2.7], "size_m": [0.45, 0.45], "height_m": 0.9, "enterable": true }),
        json!({ "name": "table", "at": [4.5, 3.4], "size_m": [0.8, 0.8], "height_m": 0.75 }),
    ];
    if has_more {
        furniture.push(json!({ "name": "sideboard", "at": [1.0, 0.3], "size_m": [1.2, 0.3], "height_m": 1.0 }));
        furniture.push(json!({ "name": "bookcase", "at": [3.9, 0.3], "size_m": [0.8, 0.3], "height_m": 1.8 }));
        furniture.push(json!({ "name": "low table", "at": [2.5, 0.65], "size_m": [1.4, 0.4], "height_m": 0.75 }));
    }
    let camera = |name: &str, at: [f64; 2], facing_deg: f64| {
        json!({ "kind": "camera", "name": name, "at": at, "facing_deg": facing_deg, "sleeps_after_s": 20,
            "field_deg": 90, "woken_by": ["room motion", "armchair motion", "bed motion"] })
    };
    let over = |name: &str, [west, south]: [f64; 2], [east, north]: [f64; 2]| {
        let area = [[west, south], [east, south], [east, north], [west, north]];
        json!({ "kind": "ceiling_motion", "name": name, "area": area, "preset": "casas_pulse" })
    };
    json!({ "name": "one room",
        "rooms": [{ "name": "room", "outline": [[0, 0], [5, 0], [5, 4], [0, 4]] }],
        "walls": [{ "from": [0, 0], "to": [5, 0] }, { "from": [5, 0], "to": [5, 4] },
            { "from": [5, 4], "to": [0, 4] }, { "from": [0, 4], "to": [0, 0] }],
        "furniture": furniture,
        "sensors": [
            { "kind": "motion", "name": "room motion", "at": [4.9, 3.9], "height_m": 2.1, "facing_deg": 215,
                "preset": "x10_ms16a" },
            over("armchair motion", [0.4, 0.6], [1.2, 1.4]),
            over("bed motion", [0.1, 2.95], [2.1, 3.85]),
            camera("south-west", [0.15, 0.15], 40.0), camera("south-east", [4.85, 0.15], 140.0)] })
}
