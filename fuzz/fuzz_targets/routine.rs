//! Any text is read or refused, as a routine and as a condition; whatever is understood can be explained.

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
    };
    for (understood, _) in [routine("a.routine", text, &known), condition("a.routine", text, &known)] {
        explain(&understood).to_text();
    }
});
