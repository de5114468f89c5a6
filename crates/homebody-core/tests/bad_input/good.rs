//! A small valid scenario, in which the tests break one thing at a time. It has an example of everything, and messages
//! name its lines: so it is not the flat of other tests.

use std::collections::BTreeMap;

const SCENARIO: &str = r#"{
  "name": "two rooms",
  "start": "2009-03-02T00:00:00",
  "time_zone": "America/Chicago",
  "days": 2,
  "home": "home.json",
  "logger": "logger.json",
  "residents": ["ann.json", "bob.json"]
}
"#;

/// Two rooms with a door between them and one to the outside, in walls 0.1 m thick.
const HOME: &str = r#"{
  "name": "two rooms",
  "rooms": [
    { "name": "kitchen", "outline": [[0, 0], [4, 0], [4, 3], [0, 3]] },
    { "name": "bedroom", "outline": [[4, 0], [8, 0], [8, 3], [4, 3]] }
  ],
  "walls": [
    { "from": [0, 0], "to": [8, 0] },
    { "from": [8, 0], "to": [8, 3] },
    { "from": [8, 3], "to": [0, 3] },
    { "from": [0, 3], "to": [0, 0] },
    { "from": [4, 0], "to": [4, 3] }
  ],
  "doors": [
    { "name": "bedroom door", "from": [4, 1], "to": [4, 2] },
    { "name": "front door", "from": [1, 0], "to": [2, 0], "open": false, "outside": true }
  ],
  "furniture": [
    { "name": "table", "at": [2, 2.2], "size_m": [1.2, 0.8], "height_m": 0.7 },
    { "name": "bed", "outline": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]], "height_m": 0.5, "enterable": true }
  ],
  "places": [
    { "name": "sink", "at": [0.5, 1.5] },
    { "name": "window", "at": [5, 0.5] }
  ],
  "sensors": [
    { "name": "kitchen motion", "kind": "motion", "at": [0.05, 1.5], "facing_deg": 0 },
    { "name": "bedroom motion", "kind": "motion", "at": [7.9, 0.1], "height_m": 2.1, "facing_deg": 135,
      "preset": "hue", "level": { "sensitivity": { "threshold_deg": 2 } } },
    { "name": "bed", "kind": "ceiling_motion", "area": [[6, 1.5], [7.9, 1.5], [7.9, 2.9], [6, 2.9]],
      "refire_s": [6, 8], "persist_s": 1 }
  ]
}
"#;

const LOGGER: &str = r#"{
  "to": ["sqlite:log.db", "casas:log.txt"],
  "table": "event",
  "columns": { "time": "at", "sensor": "device" },
  "ids": { "kitchen motion": "A1", "bedroom motion": "A2" },
  "messages": { "on_off": { "hold_s": 4 } },
  "time": "utc"
}
"#;

const ANN: &str = r#"{ "name": "Ann", "pace_mps": 0.6, "driver": { "path": "ann.path.json" } }
"#;

const ANN_PATH: &str = r#"{
  "start": "bed",
  "posture": "lying",
  "steps": [
    { "wait": { "until": "07:30", "posture": "lying" } },
    { "repeat": { "steps": [
      { "go": { "to": [[5, 1.5], "sink"], "pace_mps": 0.5 } },
      { "activity": "breakfast" },
      { "wait": { "for_s": 600, "stir": { "every_s": 20, "for_s": 2 } } },
      { "go": { "to": [[5, 1.5], "bed"], "in_s": 30 } },
      { "away": { "for_s": 60 } },
      { "wait": { "until": "08:00:00.5" } }
    ] } }
  ]
}
"#;

const BOB: &str = r#"{
  "name": "Bob",
  "driver": { "live": { "keys": "bob.keys.json", "start": [5, 1] } }
}
"#;

const BOB_KEYS: &str = r#"{
  "keys": [
    { "at_s": 1, "held": ["up", "fast"] },
    { "at_s": 2.5, "held": [] }
  ]
}
"#;

pub fn good() -> BTreeMap<String, String> {
    let files = [
        ("scenario.json", SCENARIO),
        ("home.json", HOME),
        ("logger.json", LOGGER),
        ("ann.json", ANN),
        ("ann.path.json", ANN_PATH),
        ("bob.json", BOB),
        ("bob.keys.json", BOB_KEYS),
    ];
    files.into_iter().map(|(name, text)| (name.into(), text.into())).collect()
}
