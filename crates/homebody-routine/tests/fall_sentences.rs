//! Sentences about falls: frequency, time of day, activity, and end.

use crate::home::{problems, short, understood};
use homebody_routine::explain::explain;

/// The meaning in short; no part of the sentence may be lost.
#[track_caller]
fn falls(sentence: &str) -> String {
    let routine = understood(sentence);
    assert!(routine.remarks.is_empty(), "{sentence}: {:?}", routine.remarks);
    short(&routine)
}

#[test]
fn mostly_at_some_time_goes_with_every_rhythm() {
    for (often, rhythm) in [
        ("once a week", " p0.143"),
        ("about once a week", " p0.143"),
        ("twice a week", " p0.286"),
        ("every two weeks", " Every every 14"),
        ("every other week", " Every every 14"),
        ("once every two weeks", " Every every 14"),
        ("about once every two weeks", " p0.071"),
        ("twice every two weeks", " p0.143"),
        ("about every two weeks", " p0.071"),
        ("once or twice a month", " p0.049"),
        ("every other day", " Every every 2"),
        ("every day", " Every"),
        ("every week", " p0.143"),
        ("on Mondays", " Every days 0000001"),
        ("twice a day", " Every"),
    ] {
        for (mostly, part) in
            [("mostly at night", "Night"), ("mainly by day", "Day"), ("usually in the morning", "Morning"), ("", "")]
        {
            for (from, fall) in [("on the way to the bathroom", "on the way to the bathroom"), ("", "")] {
                for (ends, end) in
                    [("and lies there until somebody comes", "lies there until somebody comes"), ("", "")]
                {
                    let behind = format!("{mostly} {from}");
                    let comma = if behind.trim().is_empty() { "" } else { "," };
                    let sentence = format!("From week 2 she falls {often}{comma} {behind} {ends}.");
                    let said = [fall, end].into_iter().filter(|said| !said.is_empty()).collect::<Vec<_>>().join(", ");
                    let said = if said.is_empty() { said } else { format!(" ({said})") };
                    let mostly = if part.is_empty() { String::new() } else { format!(" mostly {part}") };
                    let times = if often == "twice a day" { " times (2, 2)" } else { "" };
                    let meant = format!("Fall{said}{mostly}{rhythm}{times} from Day(7)");
                    assert_eq!(falls(&sentence), meant, "{sentence}");
                }
            }
        }
    }
}

#[test]
fn mostly_may_stand_anywhere() {
    for sentence in [
        "She falls mostly at night about twice a week.",
        "Mostly at night she falls about twice a week.",
        "She usually falls at night, twice a week.",
        "About twice a week she falls, mainly at night.",
    ] {
        assert_eq!(falls(sentence), "Fall mostly Night p0.286", "{sentence}");
    }
    // "On most nights" is a frequency.
    assert_eq!(falls("On most nights she falls."), "Fall Most Night");
}

#[test]
fn explains_the_usual_time_of_falls() {
    let row = explain(&understood("She falls once a week, mostly at night.")).sentences.remove(0);
    assert_eq!(row.when, "mostly night");
    assert_eq!(row.in_words, "Once a week, she falls mostly at night.");
}

#[track_caller]
fn refused(text: &str, what: &str) {
    let problems = problems(text);
    let all: Vec<String> = problems.iter().map(|one| format!("{} {one}", one.code)).collect();
    assert!(all.iter().any(|one| one.contains(what)), "{text}: {all:?}");
}

#[test]
fn no_time_of_a_fall_is_left_out() {
    refused("She falls twice a week at 03:00, mostly at night.", "routine::two-times-of-fall");
    refused("She falls mostly between 22:00 and 06:00, once a week.", "routine::twice");
    refused("She nearly falls once a week, mostly at night.", "mostly");
    refused("She falls at night and lies there until somebody comes in the morning.", "routine::twice");
}

#[test]
fn falls_out_of_bed_are_at_night_by_default() {
    for (sentence, meant) in [
        ("She falls out of bed every day.", "Fall (out of bed) Every Night"),
        ("He slides out of bed twice a year.", "Fall (slowly, out of bed) p0.005 Night"),
        ("She falls every night in bed.", "Fall (out of bed) Every Night"),
        ("In bed she falls once a month.", "Fall (out of bed) p0.033 Night"),
        ("She falls out of bed once a week, mostly in the morning.", "Fall (out of bed) mostly Morning p0.143"),
        ("She falls out of bed once a month at 13:00.", "Fall (out of bed) p0.033 at 46500/46800/46800/47100"),
        ("She falls beside the bed once a month.", "Fall @bed p0.033"),
    ] {
        assert_eq!(falls(sentence), meant, "{sentence}");
    }
}

#[test]
fn accepts_who_finds_her() {
    let found = "Fall (lies there until somebody comes) p0.033 & daughter: Visit Every";
    for ends in [
        "lies there until her daughter comes",
        "lies on the floor until her daughter finds her",
        "lies there until the daughter helps her up",
        "is found by her daughter",
        "is found there by her daughter",
        "lies there until somebody finds her",
        "lies there until found",
    ] {
        let text = format!("She falls once a month and {ends}.\nHer daughter visits every day.");
        assert_eq!(falls(&text), found, "{ends}");
    }
    refused(
        "She falls once a month and lies there until her daughter comes.",
        "no sentence says that the daughter visits",
    );
    refused("She falls once a month and is found by the carer.", "routine::finder-never-comes");
}

#[test]
fn sinking_down_is_a_slow_fall() {
    for says in
        ["sinks down", "sinks down slowly", "sinks slowly to the floor", "slides down to the floor", "slumps down"]
    {
        assert_eq!(falls(&format!("She {says} once a week.")), "Fall (slowly) p0.143", "{says}");
    }
    // A chair is a place to sit.
    assert!(!problems("She sinks down into her chair once a week.").is_empty());
}
