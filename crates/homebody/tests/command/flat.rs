//! A small flat in which somebody moves from the first moment on, so that short runs have firings.
//!
//! Ann walks up and down the kitchen by a path, Bob steps about the bedroom by keys; nobody is in the study, whose
//! door is shut. The sensors of the floor fire more often than real ones.

use crate::folder::Folder;

const SCENARIO: &str = r#"{
  "name": "flat",
  "start": "2009-03-02T08:00:00",
  "time_zone": "America/Chicago",
  "days": 0.01,
  "seed": 7,
  "home": "home.json",
  "logger": "logger.json",
  "residents": ["ann.json", "bob.json"]
}
"#;

const HOME: &str = r#"{
  "name": "flat",
  "rooms": [
    { "name": "kitchen", "outline": [[0, 0], [4, 0], [4, 3], [0, 3]] },
    { "name": "bedroom", "outline": [[4, 0], [8, 0], [8, 3], [4, 3]] },
    { "name": "study", "outline": [[8, 0], [11, 0], [11, 3], [8, 3]] }
  ],
  "walls": [
    { "from": [0, 0], "to": [11, 0] },
    { "from": [11, 0], "to": [11, 3] },
    { "from": [11, 3], "to": [0, 3] },
    { "from": [0, 3], "to": [0, 0] },
    { "from": [4, 0], "to": [4, 3] },
    { "from": [8, 0], "to": [8, 3] }
  ],
  "doors": [
    { "name": "bedroom door", "from": [4, 1], "to": [4, 2] },
    { "name": "study door", "from": [8, 1], "to": [8, 2], "open": false }
  ],
  "sensors": [
    { "name": "KitchenWall", "kind": "motion", "at": [0.05, 1.5], "facing_deg": 0 },
    { "name": "KitchenFloor", "kind": "ceiling_motion", "area": [[1.5, 0.5], [2.5, 0.5], [2.5, 2.5], [1.5, 2.5]],
      "first_fire_s": [0.05, 0.1], "refire_s": [0.1, 0.3], "persist_s": 0.1 },
    { "name": "BedroomWall", "kind": "motion", "at": [7.9, 0.1], "facing_deg": 135 },
    { "name": "BedroomFloor", "kind": "ceiling_motion", "area": [[4.5, 0.5], [7.5, 0.5], [7.5, 2.5], [4.5, 2.5]],
      "first_fire_s": [0.05, 0.1], "refire_s": [0.1, 0.3], "persist_s": 0.1 },
    { "name": "StudyFloor", "kind": "ceiling_motion", "area": [[8.5, 0.5], [10.5, 0.5], [10.5, 2.5], [8.5, 2.5]] }
  ]
}
"#;

const LOGGER: &str = "{ \"to\": [\"sqlite:log.db\"] }\n";

const ANN: &str = r#"{ "name": "Ann", "pace_mps": 0.8, "driver": { "path": "ann.path.json" } }
"#;

const ANN_PATH: &str = r#"{
  "start": [1, 1.5],
  "steps": [
    { "activity": "strolling" },
    { "repeat": { "steps": [
      { "go": { "to": [[3, 1.5]] } },
      { "wait": { "for_s": 5, "stir": { "every_s": 2, "for_s": 0.7 } } },
      { "go": { "to": [[1, 1.5]], "in_s": 3.5 } }
    ] } }
  ]
}
"#;

const BOB: &str = r#"{ "name": "Bob", "driver": { "live": { "keys": "bob.keys.json", "start": [5, 1] } } }
"#;

/// For an hour, four seconds to and four fro.
fn bobs_keys() -> String {
    let changes = (0..450).map(|turn| {
        let at = turn * 8;
        format!(
            r#"{{ "at_s": {at}, "held": ["right"] }}, {{ "at_s": {}, "held": ["left", "up"] }}, {{ "at_s": {}, "held": [] }}"#,
            at + 4,
            at + 6
        )
    });
    format!("{{ \"keys\": [\n{}\n] }}\n", changes.collect::<Vec<_>>().join(",\n"))
}

/// Writes the flat into the folder `flat`.
pub fn build(folder: &Folder) {
    let keys = bobs_keys();
    for (name, text) in [
        ("scenario.json", SCENARIO),
        ("home.json", HOME),
        ("logger.json", LOGGER),
        ("ann.json", ANN),
        ("ann.path.json", ANN_PATH),
        ("bob.json", BOB),
        ("bob.keys.json", &keys),
    ] {
        folder.write(&format!("flat/{name}"), text);
    }
}

/// A folder with the flat in it.
pub fn flat() -> Folder {
    let folder = Folder::new();
    build(&folder);
    folder
}
