//! The random numbers of a sentence depend on its meaning, and on nothing else in the text.
#![expect(clippy::disallowed_methods, reason = "the scenarios are read from their folders")]

use crate::stage::{ORDINARY, events, files, household};
use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, RunTime};
use homebody_routine::behaviour::agenda::Agenda;
use homebody_routine::behaviour::item::Item;
use homebody_routine::household::{CONDITIONS, Household};
use homebody_routine::routine::Activity;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

const SCENARIOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios");

/// By path within the folder.
fn folder(path: &Path) -> BTreeMap<String, String> {
    let mut files = BTreeMap::new();
    let mut open = vec![PathBuf::new()];
    while let Some(inner) = open.pop() {
        for entry in fs::read_dir(path.join(&inner)).unwrap() {
            let entry = entry.unwrap();
            let name = inner.join(entry.file_name());
            match (entry.file_type().unwrap().is_dir(), fs::read_to_string(entry.path())) {
                (true, _) => open.push(name),
                (false, Ok(text)) => drop(files.insert(name.to_str().unwrap().to_owned(), text)),
                (false, Err(_)) => {}
            }
        }
    }
    files
}

/// All scenarios with routines, by name, with the built-in conditions as files.
fn shipped() -> Vec<(String, BTreeMap<String, String>)> {
    let mut all = Vec::new();
    for entry in fs::read_dir(SCENARIOS).unwrap() {
        let path = entry.unwrap().path();
        let mut files = folder(&path);
        if files.keys().any(|name| name.ends_with(".routine")) {
            files.extend(CONDITIONS.map(|(name, text)| (format!("conditions/{name}.routine"), text.to_owned())));
            all.push((path.file_name().unwrap().to_str().unwrap().to_owned(), files));
        }
    }
    assert!(all.len() >= 6, "{}", all.len());
    all
}

/// Changes each line of each routine and condition.
fn with_lines(files: &BTreeMap<String, String>, change: impl Fn(&str) -> String) -> BTreeMap<String, String> {
    let mut files = files.clone();
    for (_, text) in files.iter_mut().filter(|(name, _)| name.ends_with(".routine")) {
        *text = text.lines().map(&change).collect();
    }
    files
}

/// The plan of every fortieth day of two years, and the events of the first.
fn lived(files: &BTreeMap<String, String>) -> (Vec<Agenda>, Events) {
    let (scenario, household) = household(files, &[]).unwrap();
    (plans(&scenario, &household), events(Run::new(&scenario, &household, scenario.file.seed, DAY), DAY))
}

fn plans(scenario: &Scenario, household: &Household) -> Vec<Agenda> {
    let lives = (0..scenario.residents.len()).filter_map(|resident| household.life(resident, scenario.file.seed));
    let plans = |life| (0..19).map(move |day| Agenda::new(&life, day * 40, &life.parameters(day * 40)));
    lives.flat_map(plans).collect()
}

#[test]
fn a_blank_line_changes_nothing() {
    type Way = (&'static str, fn(&str) -> String);
    let ways: [Way; 5] = [
        ("blank lines and comments between", |line| format!("\n# A comment.\n{line}\n \t\n")),
        ("indentation", |line| match line.starts_with(' ') {
            true => format!("\t   {line}\n"),
            false => format!("{line}\n"),
        }),
        ("ends of lines", |line| format!("{line}\r\n")),
        ("comments and blanks behind", |line| format!("{line}  \t# so it is\n")),
        ("blanks within", |line| {
            let own = line.trim_start();
            format!("{}{}\n", &line[..line.len() - own.len()], own.replace(' ', "   "))
        }),
    ];
    let mut told_apart = BTreeSet::new();
    for (name, files) in shipped() {
        let (plans, events) = lived(&files);
        assert!(plans.iter().any(|plan| plan.items.len() > 5) && events.firings.len() > 100, "{name}");
        let mut at_the_top = with_lines(&files, |line| format!("{line}\n"));
        for (_, text) in at_the_top.iter_mut().filter(|(name, _)| name.ends_with(".routine")) {
            *text = format!("# One line.\n\n{text}");
        }
        let changed = ways.iter().map(|(way, change)| (*way, with_lines(&files, change)));
        for (way, changed) in changed.chain([("a comment at the top", at_the_top)]) {
            // Some routines have no lines to indent.
            if files == changed {
                continue;
            }
            told_apart.insert(way);
            let (planned, happened) = lived(&changed);
            for (before, after) in plans.iter().zip(&planned) {
                assert_eq!((&before.items, &before.breaks), (&after.items, &after.breaks), "{name}: {way}");
                assert_eq!((before.up, before.bed), (after.up, after.bed), "{name}: {way}");
            }
            assert!(events == happened, "{name}: {way}");
        }
    }
    assert_eq!(told_apart.len(), ways.len() + 1, "each way changed the text of some routine: {told_apart:?}");
}

/// The plans of the apartment's resident.
fn planned(routine: &str) -> Vec<Agenda> {
    let (scenario, household) = household(&files(routine, &[]), &[]).unwrap();
    let mut plans = plans(&scenario, &household);
    // Without the position of the sentence.
    for plan in &mut plans {
        plan.items.iter_mut().chain(&mut plan.breaks).for_each(|item| (item.of, item.follows) = (None, None));
        // A part of the day makes room for another time; what is drawn stays.
        for item in plan.items.iter_mut().filter(|item| item.open.is_some()) {
            (item.latest, item.start) = (item.latest - (item.start - RunTime::START), RunTime::START);
        }
    }
    plans
}

fn items(plans: &[Agenda]) -> impl Iterator<Item = (i32, &Item)> {
    plans.iter().flat_map(|plan| plan.items.iter().chain(&plan.breaks).map(|item| (plan.day, item)))
}

#[test]
fn another_sentence_leaves_the_numbers_of_the_others() {
    let before = planned(ORDINARY);
    let (head, rest) = ORDINARY.split_at(ORDINARY.find("\nMost nights").unwrap());
    for (said, adds) in [
        ("She does her exercises in the morning for 2 to 20 minutes.", true),
        ("On Saturday she watches television at about 15:00, then naps for 5 to 50 minutes.", true),
        ("Whenever she has been in the living room for 3 hours, she relaxes for 5 minutes.", false),
        ("She goes to the bathroom twice as often at night.", false),
    ] {
        for routine in [format!("{said}\n{ORDINARY}"), format!("{head}\n{said}\n{rest}"), format!("{ORDINARY}{said}\n")]
        {
            let after = planned(&routine);
            for (day, item) in items(&before) {
                let same = items(&after).any(|(of, other)| of == day && other == item);
                // Only the frequency of the bathroom may change.
                let is_touched = said.contains("bathroom") && item.activity == Activity::UseBathroom;
                assert!(same || is_touched, "{said} changes {item:?}");
            }
            assert_eq!(items(&after).count() > items(&before).count(), adds || said.contains("bathroom"), "{said}");
        }
    }
}

#[test]
fn sentences_with_one_meaning_differ_by_their_order() {
    let one = "Margaret is 82.\nOn Monday she reads at about 15:00 for 10 to 60 minutes.\n";
    let two = format!("{one}On Tuesday she reads at about 15:00 for 10 to 60 minutes.\n");
    let twice = format!("{one}On Monday she reads at about 3 pm for 10-60 minutes.\n");
    let reading = |routine: &str| -> Vec<(i32, Item)> {
        let plans = planned(routine);
        items(&plans)
            .filter(|(_, item)| item.activity.label() == "reading")
            .map(|(d, item)| (d, item.clone()))
            .collect()
    };
    let (one, two, twice) = (reading(one), reading(&two), reading(&twice));
    assert!(!one.is_empty() && two.len() > one.len() && twice.len() == 2 * one.len());
    // Synonyms have equal numbers; a repeated sentence has numbers of its own.
    for (day, item) in &one {
        assert!(two.contains(&(*day, item.clone())) && twice.contains(&(*day, item.clone())));
        let other = twice.iter().find(|(of, other)| of == day && other.key != item.key).unwrap();
        assert_ne!((item.start, item.lasts), (other.1.start, other.1.lasts));
    }
}

/// The negative control of both.
#[test]
fn a_changed_sentence_changes_its_own_numbers() {
    let changed = ORDINARY.replace("in the afternoon for about 40 minutes", "in the afternoon for about 41 minutes");
    assert_ne!(changed, ORDINARY);
    let (before, after) = (planned(ORDINARY), planned(&changed));
    let of = |plans: &[Agenda], name: &str| -> Vec<(i32, RunTime)> {
        items(plans).filter(|(_, item)| item.activity.label() == name).map(|(day, item)| (day, item.start)).collect()
    };
    assert_ne!(of(&before, "reading"), of(&after, "reading"));
    assert_eq!(of(&before, "telephoning"), of(&after, "telephoning"));
    let events_of = |routine: &str| lived(&files(routine, &[])).1;
    assert!(events_of(ORDINARY) != events_of(&ORDINARY.replace("06:45", "06:40")));
}
