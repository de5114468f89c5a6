use super::firings::MotionFirings;
use super::measures::*;
use super::*;
use crate::sample::{at, log, span};
use homebody_core::random::Stream;
use homebody_core::time::SECOND;

fn close(found: Option<f64>, expected: f64) {
    assert!(found.is_some_and(|found| (found - expected).abs() < 1e-9), "{found:?} is not {expected}");
}

/// Sensors `a` and `b`, which fire at these seconds, for whole days.
fn heard(days: i64, firings: &[(i64, usize)]) -> MotionFirings {
    let firings = firings.iter().map(|&(s, sensor)| (at(s), sensor)).collect();
    MotionFirings { sensors: vec!["a".into(), "b".into()], firings, on: Vec::new(), days: 0..days }
}

#[test]
fn gaps_are_of_any_sensor_and_refires_of_each() {
    let log = heard(1, &[(0, 0), (5, 1), (7, 0), (20, 1)]);
    assert_eq!(gaps(&log), [5, 2, 13].map(|s| s * SECOND));
    assert_eq!(refires(&log), [7, 15].map(|s| s * SECOND));
    // Of the gaps 2, 5, 13 one is 2 or less, of 5, 5 none: a third; all of the second are 5 or less, and two thirds of the
    // first: a third again.
    close(ks(gaps, [&log, &heard(1, &[(0, 0), (5, 0), (10, 0)])]), 1.0 / 3.0);
}

#[test]
fn the_jensen_shannon_distance_is_the_root_of_the_divergence_in_bits() {
    close(jensen_shannon([(1.0, 2.0), (3.0, 6.0)].into_iter()), 0.0);
    close(jensen_shannon([(1.0, 0.0), (0.0, 1.0)].into_iter()), 1.0);
    // p = (1, 0), q = (1/2, 1/2), m = (3/4, 1/4): (log2(4/3) + (log2(2/3) + log2(2)) / 2) / 2 = 0.311278.
    let by_hand = ((4.0_f64 / 3.0).log2() + ((2.0_f64 / 3.0).log2() + 1.0) / 2.0) / 2.0;
    close(jensen_shannon([(5.0, 2.0), (0.0, 2.0)].into_iter()), by_hand.sqrt());
    assert!((by_hand - 0.311_278).abs() < 1e-6);
    assert_eq!(jensen_shannon([(0.0, 1.0)].into_iter()), None);
}

#[test]
fn sensors_at_once_are_counted_by_the_second() {
    // Alone from 0 to 4, both to 6, alone to 10; then three at 20 to 21.
    let on = [(span(0, 6), 0), (span(4, 10), 1), (span(20, 21), 0), (span(20, 21), 1), (span(20, 21), 2)];
    assert_eq!(at_once(&on), [8.0, 2.0, 1.0]);
}

#[test]
fn together_is_within_three_seconds_of_another() {
    // 0 and 3 are 3 s apart; 10 and 12 are of one sensor; 20 is alone.
    let log = heard(1, &[(0, 0), (3, 1), (10, 0), (12, 0), (20, 1)]);
    close(together(&log), 2.0 / 5.0);
}

#[test]
fn shares_and_ways_are_compared_where_names_agree() {
    let (a, b) = (heard(1, &[(0, 0), (1, 1), (2, 0), (3, 1)]), heard(1, &[(0, 0), (1, 1), (2, 0), (100, 1)]));
    close(shares_apart([&a, &b]), 0.0);
    // Ways a-b twice and b-a once; once each in the other, as 98 s are too long.
    close(ways_apart([&a, &b]), jensen_shannon([(2.0, 1.0), (1.0, 1.0)].into_iter()).unwrap());
    let mut other = b.clone();
    other.sensors = vec!["x".into(), "y".into()];
    assert_eq!((shares_apart([&a, &other]), ways_apart([&a, &other])), (None, None));
}

#[test]
fn days_differ_follow_and_have_empty_hours() {
    const DAY_S: i64 = 24 * 3600;
    // 2, 4, 6, 8 and 10 firings in one hour each of five days, with an empty hour after it.
    let firings: Vec<(i64, usize)> =
        (0..5).flat_map(|day| (0..2 * (day + 1)).map(move |second| (day * DAY_S + second, 0))).collect();
    let log = heard(6, &firings);
    close(days_differ(&log), 10.0_f64.sqrt() / 6.0);
    close(days_follow(&log), 1.0);
    close(empty_hours(&log), (6.0 * 24.0 - 5.0) / (6.0 * 24.0));
    assert_eq!(firings_a_day(&log), [2, 4, 6, 8, 10, 0]);
    close(Some(profile(&log)[0]), 5.0);
    assert_eq!(days_follow(&log.within(0..4)), None, "three pairs tell nothing");
}

#[test]
fn halves_have_half_of_the_days_each() {
    let log = heard(4, &[(0, 0), (2 * 86_400 - 1, 1), (2 * 86_400, 0)]);
    let [first, second] = log.halves();
    assert_eq!((first.days, second.days), (0..2, 2..4));
    assert_eq!((first.firings.len(), second.firings.len()), (2, 1));
    assert_eq!(log.each_hour().count(), 96);
    assert_eq!(log.firings_in(span(0, 3600)).len(), 1);
}

/// A log of so many days in which a firing follows the other after about `gap_s`.
fn lived(seed: u64, days: i64, gap_s: f64, hold: i64) -> Log {
    let stream = &mut Stream::named(seed, "lived");
    let (mut rows, mut at) = (Vec::new(), 0);
    while at < days * 86_400 {
        let sensor = if stream.chance(0.3) { "kitchen" } else { "hall" };
        rows.push((at, sensor, "ON"));
        rows.push((at + hold, sensor, "OFF"));
        at += hold + 1 + stream.lognormal(gap_s, 1.0) as i64;
    }
    log(&rows)
}

fn against(a: &Log, b: &Log) -> Realism {
    let told = |name, log| ComparedLog { name, log, recorded: None };
    realism(told("A", a), told("B", b)).expect("two logs")
}

#[test]
fn similar_log_is_near_and_other_is_separated() {
    let real = lived(1, 12, 300.0, 4);
    let same = against(&real, &lived(2, 12, 300.0, 4));
    assert!(same.gaps_ks.value.unwrap() < 0.05 && same.shares_js.value.unwrap() < 0.05, "{same:?}");
    assert_eq!(same.on_ks.value, Some(0.0));
    assert!((0.3..0.7).contains(&same.auc_hours.value.unwrap()), "{:?}", same.auc_hours);
    let other = against(&real, &lived(3, 12, 150.0, 9));
    assert_eq!(other.on_ks.value, Some(1.0));
    assert!(other.gaps_ks.value > same.gaps_ks.value && other.auc_days.value.unwrap() > 0.99, "{other:?}");
    assert!(other.days_told_by[0].part > 0.05 && other.days_told_by.len() == 8, "{:?}", other.days_told_by);
    assert_eq!(same.gaps_ks.floor, other.gaps_ks.floor);
    assert_eq!(against(&real, &real).gaps_ks.value, Some(0.0));
}

#[test]
fn json_has_a_value_and_a_floor_of_each() {
    let (a, b) = (lived(1, 9, 300.0, 4), lived(2, 9, 300.0, 4));
    let json = serde_json::to_value(against(&a, &b)).unwrap();
    for name in ["gaps_ks", "on_ks", "hours_js", "shares_js", "firings_ks", "auc_days", "auc_hours"] {
        assert!(json[name]["value"].is_number() && json[name]["floor"].is_number(), "{name}: {}", json[name]);
    }
}

#[test]
fn reports_all_problems_at_once() {
    let (door, short) = (log(&[(0, "door", "OPEN")]), log(&[(0, "hall", "ON"), (60, "hall", "OFF")]));
    let told = |name, log| ComparedLog { name, log, recorded: None };
    let problems = realism(told("A", &door), told("B", &short)).unwrap_err();
    assert_eq!(problems, [NotComparable::NoMotion("A".into()), NotComparable::NoDay("B".into())]);
}

#[test]
fn people_get_a_table_of_every_measure() {
    let (a, b) = (lived(1, 3, 300.0, 4), lived(2, 3, 300.0, 4));
    let realism = against(&a, &b);
    let text = realism.to_string();
    for (name, _, _) in realism.measures() {
        assert!(text.lines().any(|line| line.starts_with(name)), "{name} in {text}");
    }
    assert!(text.contains("days told apart        -       -"), "{text}");
    assert!(text.ends_with(MEASURES));
}

#[test]
fn rejects_logs_that_span_more_than_ten_years() {
    let day = 24 * 3600;
    let of_years = |years: i64| log(&[(0, "M1", "ON"), (5, "M1", "OFF"), (years * 366 * day, "M1", "ON")]);
    let (short, long) = (of_years(1), of_years(11));
    let named = |name, log| ComparedLog { name, log, recorded: None };
    let problems = realism(named("short", &short), named("long", &long)).unwrap_err();
    assert!(matches!(&problems[..], [NotComparable::TooLong { log, .. }] if log == "long"), "{problems:?}");
    assert!(realism(named("short", &short), named("short", &short)).is_ok());
}
