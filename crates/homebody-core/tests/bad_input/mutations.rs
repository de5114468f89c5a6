//! Loading a mutated scenario ends, and its problems are at places that exist.

use super::link::linked;
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, RunTime};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use std::collections::BTreeMap;

#[test]
fn no_mutation_of_a_scenario_makes_the_loader_or_a_run_panic() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let (mut refused, mut accepted) = (0, 0);
    for _ in 0..4000 {
        let files = mutated(&mut random);
        match Scenario::load(&files, "scenario.json") {
            Ok(scenario) => {
                accepted += 1;
                let mut run = Run::new(&scenario, &(), 1, DAY);
                while run.now() < RunTime::START + DAY {
                    run.advance(run.now() + DAY / 24, &mut Events::default()).unwrap();
                }
            }
            Err(problems) => {
                refused += 1;
                assert!(!problems.0.is_empty());
                for problem in &problems.0 {
                    // Shape and types say the same: serde never has to refuse what the schema let through.
                    assert_ne!(problem.code, "schema::invalid", "{problem}");
                    let lines: Vec<&str> = files[&problem.file].split(['\n', '\r']).collect();
                    assert!(problem.line as usize <= lines.len(), "{problem}");
                }
                assert!(!problems.render().is_empty());
            }
        }
    }
    // The mutations reach both sides of the border.
    assert!(refused > 1000 && accepted > 100, "{refused} refused, {accepted} accepted");
}

/// The characters that matter in JSON's grammar.
const MARKS: &[u8] = b"{}[],:\"-.0123456789e\\\n\r\t tfn";

fn mutated(random: &mut ChaCha8Rng) -> BTreeMap<String, String> {
    let mut files = linked();
    let names: Vec<String> = files.keys().cloned().collect();
    let name = &names[below(random, names.len())];
    let mut bytes = files[name].clone().into_bytes();
    for _ in 0..=below(random, 3) {
        let at = below(random, bytes.len());
        match below(random, 6) {
            0 => bytes[at] = random.next_u32() as u8,
            1 => bytes.insert(at, MARKS[below(random, MARKS.len())]),
            2 => drop(bytes.remove(at)),
            3 => {
                let end = (at + below(random, 30)).min(bytes.len());
                drop(bytes.drain(at..end));
            }
            4 => {
                let end = (at + below(random, 30)).min(bytes.len());
                let copy = bytes[at..end].to_vec();
                let to = below(random, bytes.len());
                bytes.splice(to..to, copy);
            }
            _ => {
                let digits: Vec<usize> = (0..bytes.len()).filter(|&i| bytes[i].is_ascii_digit()).collect();
                if let Some(&digit) = digits.get(below(random, digits.len().max(1))) {
                    bytes[digit] = b"0123456789-"[below(random, 11)];
                }
            }
        }
    }
    files.insert(name.clone(), String::from_utf8_lossy(&bytes).into_owned());
    files
}

fn below(random: &mut ChaCha8Rng, limit: usize) -> usize {
    random.next_u32() as usize % limit
}
