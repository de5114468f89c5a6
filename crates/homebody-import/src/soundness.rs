//! Removal of the parts of a home that the check refuses, reported in the check's words.

use crate::error::ImportError;
use crate::text::{self, List};
use homebody_core::home::form::HomeFile;
use homebody_core::problem::{Problem, counted};
use homebody_core::scenario::load::Scenario;
use std::collections::{BTreeMap, BTreeSet};

/// Number of times that a home is checked (our choice): removing a part may reveal another problem, and one check
/// reports a hundred.
const ROUNDS: usize = 30;

/// Largest number of problems that are reported in their own words (our choice).
const MOST_TOLD: usize = 10;

/// The smallest scenario for the check of a home.
const SCENARIO: &str =
    r#"{ "name": "check", "start": "2026-01-05T00:00:00", "days": 1, "home": "home.json", "residents": [] }"#;

/// The text of the home after removal of the parts that the check refuses.
pub fn text(home: HomeFile, remarks: &mut Vec<String>) -> Result<String, ImportError> {
    passing(home, remarks).map(|home| text::home_text(&home))
}

pub fn is_passing(home: &HomeFile) -> bool {
    problems(&text::home_text(home)).is_empty()
}

pub fn passing(mut home: HomeFile, remarks: &mut Vec<String>) -> Result<HomeFile, ImportError> {
    let mut told = Vec::new();
    for _ in 0..ROUNDS {
        let (text, lines) = text::with_elements(&home);
        let problems = problems(&text);
        let Some(first) = problems.first() else {
            let more = told.len().saturating_sub(MOST_TOLD);
            told.truncate(MOST_TOLD);
            remarks.extend(told);
            if more > 0 {
                remarks.push(format!("left out: {} for like reasons", counted(more, "thing", "things")));
            }
            return Ok(home);
        };
        let first = first.what.clone();
        let mut wrong = BTreeSet::new();
        for problem in problems {
            let line = (problem.line as usize).checked_sub(1).and_then(|line| lines.get(line).copied().flatten());
            if let Some(element) = line
                && wrong.insert(element)
            {
                told.push(format!("left out: {}", problem.what));
            }
        }
        if wrong.is_empty() {
            return Err(ImportError::Unsound(first));
        }
        drop(&mut home.rooms, &wrong, List::Rooms);
        drop(&mut home.walls, &wrong, List::Walls);
        drop(&mut home.doors, &wrong, List::Doors);
        drop(&mut home.furniture, &wrong, List::Furniture);
        drop(&mut home.places, &wrong, List::Places);
        drop(&mut home.sensors, &wrong, List::Sensors);
    }
    Err(ImportError::Unsound("it has too many problems".to_owned()))
}

fn problems(text: &str) -> Vec<Problem> {
    let files = [("scenario.json", SCENARIO), ("home.json", text)];
    let files: BTreeMap<String, String> = files.map(|(name, text)| (name.to_owned(), text.to_owned())).into();
    Scenario::load(&files, "scenario.json").map_or_else(|problems| problems.0, |_| Vec::new())
}

fn drop<T>(elements: &mut Vec<T>, wrong: &BTreeSet<(List, usize)>, list: List) {
    let mut index = 0..;
    elements.retain(|_| index.next().is_none_or(|index| !wrong.contains(&(list, index))));
}
