//! The page about the language: its examples, its rejected sentences, and its figures.

mod home;

use home::{home, problems, understood};
use homebody_core::fuzzy::Quantifier;
use homebody_core::problem::Problems;
use homebody_routine::language::amounts::{ABOUT_SHARE, MONTH_DAYS, PLAIN_SHARE, YEAR_DAYS};
use homebody_routine::language::times::{ABOUT_TIME_S, PLAIN_TIME_S};
use homebody_routine::language::{LONGEST_LINE, MOST_SENTENCES, condition};
use homebody_routine::routine::PartOfDay;

const PAGE: &str = include_str!("../../../docs/reference/routine-language.md");

fn blocks(kind: &str) -> Vec<&'static str> {
    let fence = format!("```{kind}\n");
    PAGE.split(fence.as_str()).skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
}

/// Cells of all tables, by row.
fn rows() -> Vec<Vec<&'static str>> {
    let rows = PAGE.lines().filter(|line| line.starts_with('|'));
    rows.map(|row| row.trim_matches('|').split('|').map(str::trim).collect()).collect()
}

#[track_caller]
fn row(first: &str) -> Vec<&'static str> {
    rows().into_iter().find(|row| row[0] == first).unwrap_or_else(|| panic!("no row {first:?}"))
}

#[test]
fn every_example_of_the_page_is_understood() {
    let blocks = blocks("routine");
    assert!(blocks.len() > 20);
    for block in blocks {
        understood(block);
    }
}

#[test]
fn the_condition_of_the_page_is_understood() {
    for block in blocks("condition") {
        assert_eq!(condition("depression.routine", block, &home()).1, []);
    }
}

#[test]
fn every_way_of_saying_an_activity_is_understood() {
    let table = PAGE.split("| activity | ways of saying it |").nth(1).unwrap().split("\n\n").next().unwrap();
    for row in table.lines().filter(|line| line.starts_with("| ") && !line.contains("meals |")) {
        let ways = row.split('|').nth(2).unwrap().split([',', ';']).map(str::trim);
        // A noun alone needs the verb before it.
        for way in ways.filter(|way| {
            way.split(' ').next().unwrap().ends_with('s') && !way.starts_with("tablets") && !way.starts_with("pills")
        }) {
            understood(&format!("She leaves the apartment. She {way}."));
        }
    }
}

#[test]
fn refusals_have_the_words_of_the_page() {
    let section = PAGE.split("## Refused sentences").nth(1).unwrap().split("\n## ").next().unwrap();
    let rows: Vec<Vec<&str>> =
        section.lines().filter(|line| line.starts_with("| `")).map(|line| line.split('`').collect()).collect();
    assert!(rows.len() > 20);
    for row in rows {
        let found = Problems(problems(row[1])).to_string();
        assert!(found.contains(row[3]), "{}: {}\n{found}", row[1], row[3]);
    }
}

#[test]
fn the_quantifiers_of_the_page_are_those_of_the_code() {
    for quantifier in Quantifier::ALL {
        let (row, share) = (row(quantifier.word()), quantifier.share());
        assert_eq!(row[1], quantifier.probability().to_string());
        assert_eq!(row[2], format!("{} to {}", share.from, share.to));
    }
}

#[test]
fn the_numbers_of_the_page_are_those_of_the_code() {
    let give_or_take = |seconds: f64| format!("give or take {} minutes", seconds / 60.0);
    assert_eq!(row("at 06:45, at 7:30 pm")[1], give_or_take(PLAIN_TIME_S));
    assert_eq!(row("at about 06:45, around 8 pm")[1], give_or_take(ABOUT_TIME_S));
    assert_eq!(row("for 20 minutes")[1], format!("give or take {} %", PLAIN_SHARE * 100.0));
    assert_eq!(row("for about 2 hours")[1], format!("give or take {} %", ABOUT_SHARE * 100.0));
    assert!(PAGE.contains(&format!("A month counts as {MONTH_DAYS} days, a year as {YEAR_DAYS}")));
    assert!(PAGE.contains(&format!("more than {LONGEST_LINE} characters")));
    assert!(PAGE.contains(&format!("more than {MOST_SENTENCES} sentences")));
}

#[test]
fn the_parts_of_the_day_of_the_page_are_those_of_the_code() {
    let clock = |seconds: f64| format!("{:02}:{:02}", seconds as u32 / 3600 % 24, seconds as u32 / 60 % 60);
    for (words, part) in [
        ("in the morning", PartOfDay::Morning),
        ("at noon", PartOfDay::Noon),
        ("in the afternoon", PartOfDay::Afternoon),
        ("in the evening", PartOfDay::Evening),
        ("during the day", PartOfDay::Day),
    ] {
        let (from, to) = part.hours();
        assert_eq!(row(words)[1], format!("any time from {} to {}", clock(from), clock(to)));
    }
    assert!(row("at night")[1].starts_with("for the bathroom, lying awake,"));
}
