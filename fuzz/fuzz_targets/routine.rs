//! Any text is read or refused, as a routine and as a condition; whatever is understood can be explained.
//!
//! `cargo install cargo-fuzz` brings what runs it. A stable compiler will do if it is told to take what is not stable yet;
//! from the folder of the whole project:
//!
//! ```sh
//! mkdir -p fuzz/corpus/routine && cp scenarios/*/*.routine conditions/*.routine fuzz/corpus/routine
//! RUSTC_BOOTSTRAP=1 cargo fuzz run routine -s none -- -max_total_time=300 -max_len=2048 -timeout=10
//! ```
//!
//! `-s none` leaves the sanitizer out, which has nothing to find where no code is unsafe.

#![no_main]

use homebody_routine::explain::explain;
use homebody_routine::language::{Known, condition, routine};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let list = |names: &str| names.split(", ").map(str::to_owned).collect();
    let known = Known {
        person: Some("Margaret".into()),
        places: list("armchair, sofa, bed, stove, living room window"),
        things: list("stove, fridge, front door, television"),
        rooms: list("bedroom, bathroom, kitchen, living room"),
        conditions: list("depression, heart-failure"),
        first_date: Some((2009, 3, 2)),
        ..Known::default()
    };
    for (understood, _) in [routine("a.routine", text, &known), condition("a.routine", text, &known)] {
        explain(&understood).to_text();
    }
});
