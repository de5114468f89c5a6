//! Any bytes are imported or refused, as a file and as the `Home.xml` of one; what is imported passes the check, and
//! somebody can look for ways in it.
//!
//! It is run as `routine.rs` is, beside plans to begin with:
//!
//! ```sh
//! mkdir -p fuzz/corpus/import && cp fuzz/seeds/import/*.xml fuzz/corpus/import
//! RUSTC_BOOTSTRAP=1 cargo fuzz run import -s none -- -max_total_time=600 -max_len=8192 -timeout=10 -dict=fuzz/import.dict
//! ```

#![no_main]

use homebody_core::geometry::{self, Point};
use homebody_core::home::plan::Plan;
use homebody_core::random::Stream;
use homebody_core::scenario::load::Scenario;
use homebody_import::{Imported, sweet_home};
use homebody_walk::Mesh;
use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use std::collections::BTreeMap;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// The smallest scenario in which a home can be checked.
const SCENARIO: &str =
    r#"{ "name": "check", "start": "2026-01-05T00:00:00", "days": 1, "home": "home.json", "residents": [] }"#;

/// An older adult's body.
const BODY_M: f64 = 0.22;

fuzz_target!(|bytes: &[u8]| {
    for file in [bytes, &archive(bytes)] {
        match sweet_home(file, "fuzz", None) {
            Ok(Imported { home_json, remarks }) => {
                assert!(remarks.len() < 50, "nobody reads {} remarks", remarks.len());
                find_ways(&home_json);
            }
            Err(error) => assert!(error.to_string().contains("\n  hint: "), "{error}"),
        }
    }
});

fn archive(xml: &[u8]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    writer.start_file("Home.xml", stored).expect("an archive takes an entry");
    writer.write_all(xml).expect("memory can be written");
    writer.finish().expect("memory can be written").into_inner()
}

/// Goes from each room and piece of furniture to the next, and in by each door.
fn find_ways(home_json: &str) {
    let files = [("scenario.json", SCENARIO), ("home.json", home_json)];
    let files: BTreeMap<String, String> = files.map(|(name, text)| (name.to_owned(), text.to_owned())).into();
    let scenario = Scenario::load(&files, "scenario.json");
    let home = scenario.unwrap_or_else(|problems| panic!("{}\n{home_json}", problems.render())).home;
    let plan = Plan::new(&home);
    let mesh = Mesh::new(&plan, BODY_M);
    let rooms = plan.rooms.iter().map(|room| geometry::inner_point(&room.outline));
    let places: Vec<Point> = rooms.chain(home.furniture.iter().filter_map(|piece| piece.at.map(Point::from))).collect();
    for ends in places.windows(2) {
        mesh.path(ends[0], ends[1]);
    }
    for door in &home.doors {
        mesh.inside_of((geometry::point(door.from) + geometry::point(door.to)) / 2.0);
    }
}

// Half of the mutants are of the text, the others of what it draws.
fuzz_mutator!(|bytes: &mut [u8], size: usize, most: usize, seed: u32| {
    let mutant = std::str::from_utf8(&bytes[..size]).ok().and_then(|xml| redrawn(xml, seed));
    match mutant.filter(|mutant| seed % 2 == 0 && mutant.len() <= most.min(bytes.len())) {
        Some(mutant) => {
            bytes[..mutant.len()].copy_from_slice(mutant.as_bytes());
            mutant.len()
        }
        None => fuzzer_mutate(bytes, size, most),
    }
});

/// The plan with a tag more or fewer, or with a number moved a little or onto another.
fn redrawn(xml: &str, seed: u32) -> Option<String> {
    let dice = &mut Stream::named(u64::from(seed), "redrawn");
    let mut one_of = |count: usize| (dice.unit() * count as f64) as usize;
    let mark = if one_of(4) == 0 { '<' } else { '\'' };
    let mut parts: Vec<String> = xml.split(mark).map(str::to_owned).collect();
    if mark == '<' {
        let (tag, place) = (parts[one_of(parts.len())].clone(), one_of(parts.len()));
        match one_of(3) {
            0 => drop(parts.remove(place)),
            _ => parts.insert(place, tag),
        }
    } else {
        let numbers: Vec<(usize, f64)> =
            parts.iter().enumerate().filter_map(|(place, part)| Some((place, part.parse().ok()?))).collect();
        let ((place, number), (_, other)) = (*numbers.get(one_of(numbers.len()))?, numbers[one_of(numbers.len())]);
        let step = [0.05, 0.2, 1.0, 10.0, 100.0][one_of(5)] * [1.0, -1.0][one_of(2)];
        parts[place] = [other, other, other + step, number + step, -number][one_of(5)].to_string();
    }
    Some(parts.join(&mark.to_string()))
}
