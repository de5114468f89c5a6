//! German as data: a German and an English sentence mean the same.

use crate::home::{home, problems, understood};
use homebody_core::problem::Problems;
use homebody_routine::language::routine;
use homebody_routine::language::statement::statements;
use homebody_routine::routine::Routine;

/// The sentences of the statements, which are English.
fn printed(found: &Routine) -> Vec<String> {
    statements(found).into_iter().flat_map(|(_, statement)| statement.sentences()).collect()
}

fn pairs() -> Vec<(&'static str, &'static str)> {
    let lines = include_str!("german.txt").lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    lines.map(|line| line.split_once(" | ").unwrap()).collect()
}

#[test]
fn german_and_english_sentences_give_the_same_statements() {
    let mut wrong = Vec::new();
    for (german, english) in pairs() {
        let (found, problems) = routine("margaret.routine", &format!("Sprache: Deutsch\n{german}"), &home());
        if !problems.is_empty() {
            wrong.push(format!("{german}\n{}", Problems(problems).render()));
            continue;
        }
        let (found, meant) = (printed(&found), printed(&understood(english)));
        if found != meant || meant.is_empty() {
            wrong.push(format!("{german}\n  gives {found:?}\n  meant {meant:?}"));
        }
    }
    assert!(pairs().len() >= 60, "{}", pairs().len());
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), pairs().len(), wrong.join("\n"));
}

#[test]
fn a_language_is_read_alone() {
    let (german, english) = ("Sie steht um 7 Uhr auf.", "She gets up at 7:00.");
    assert!(!problems(german).is_empty(), "German without a first line");
    assert!(!problems(&format!("Language: German\n{english}")).is_empty(), "English in a German routine");
    assert_eq!(problems(&format!("Language: English\n{english}")), []);
    assert_eq!(problems(&format!("# Morgens.\n\nsprache: deutsch\n{german}")), []);
}

#[test]
fn rejects_an_unknown_language() {
    let found = problems("Language: Klingon\nShe gets up at 7:00.");
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].code, found[0].line, found[0].column), ("routine::unknown-language", 1, 11));
}

#[test]
fn the_german_example_of_the_page_is_understood() {
    let page = include_str!("../../../docs/reference/routine-language.md");
    let example = page.split("```text\n").find(|block| block.starts_with("Sprache")).unwrap();
    let found = understood(example.split("```").next().unwrap());
    assert_eq!(found.person.unwrap().age_years, Some(82.0));
    assert_eq!((found.habits.len(), found.changes.len()), (4, 1));
}
