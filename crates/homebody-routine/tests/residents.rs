//! Invariants of runs with routines, and agreement of routines with the ground truth.

use crate::stage::{ORDINARY, activities, day, events, files, hour, household, run, starts};
use homebody_core::event::{Events, Fact};
use homebody_core::fuzzy::Quantifier;
use homebody_core::geometry::Point;
use homebody_core::ids::{SensorId, ThingId};
use homebody_core::motion::MotionState;
use homebody_core::run::Run;
use homebody_core::time::{DAY, HOUR, MINUTE, RunTime, SECOND, Span};

const DECLINE: &str = include_str!("../../../scenarios/tigerplace-decline/margaret.routine");
/// A link with all faults.
const LINK: &str = r#"{ "preset": "x10", "false_fires_per_h": 0.5, "misses": 0.02, "duplicates": 0.01, "faults": [
    { "kind": "battery", "sensor": "hall motion", "from_day": 1, "fading_days": 2 },
    { "kind": "outage", "from_day": 2, "hours": 3 } ] }"#;

/// Conditions, a link with faults, and every kind of act.
fn everything(days: i64) -> Run {
    let routine = DECLINE.replace("From day 90, over 400 days,", "From day 1, over 2 days,");
    let mut files = files(&routine, &[("link.json", LINK)]);
    let scenario = &files["scenario.json"];
    let linked =
        scenario.replace("\"logger\": \"logger.json\",", "\"logger\": \"logger.json\",\n  \"link\": \"link.json\",");
    assert_ne!(*scenario, linked);
    files.insert("scenario.json".into(), linked);
    let (scenario, household) = household(&files, &[]).unwrap();
    Run::new(&scenario, &household, 7, days * DAY)
}

#[test]
fn in_which_steps_a_life_is_lived_changes_nothing() {
    let whole = events(everything(3), 100 * DAY);
    assert!(whole.firings.len() > 5_000, "{}", whole.firings.len());
    for step in [6 * HOUR, 17 * SECOND + Span::MICROSECOND] {
        let cut = events(everything(3), step);
        assert_eq!(whole.firings, cut.firings, "in steps of {step} microseconds");
        assert_eq!(whole.facts.len(), cut.facts.len());
    }
}

#[test]
fn a_copy_of_a_life_continues_as_the_original() {
    let mut original = everything(4);
    let mut before = Events::default();
    original.advance(RunTime::START + 2 * DAY + 5 * HOUR + Span::from_micros(7), &mut before).unwrap();
    let copy = original.clone();
    assert_eq!(events(original, HOUR), events(copy, 2 * HOUR));
}

#[test]
fn a_sensor_more_changes_neither_the_life_nor_other_sensors() {
    let of = |files| {
        let (scenario, household) = household(&files, &[]).unwrap();
        Run::new(&scenario, &household, 5, 2 * DAY)
    };
    let fewer = events(of(files(ORDINARY, &[])), DAY);
    let mut more = files(ORDINARY, &[]);
    let home = more["home.json"].replace(
        "\"sensors\": [",
        "\"sensors\": [\n    { \"kind\": \"contact\", \"name\": \"added\", \"on\": \"fridge\" },",
    );
    more.insert("home.json".into(), home);
    let more = events(of(more), DAY);
    let others: Vec<_> = more
        .firings
        .iter()
        .filter(|firing| firing.sensor > SensorId(0))
        .map(|f| (f.at, SensorId(f.sensor.0 - 1)))
        .collect();
    let alone: Vec<_> = fewer.firings.iter().map(|firing| (firing.at, firing.sensor)).collect();
    assert!(more.firings.len() > others.len(), "the fridge was opened");
    assert_eq!(others, alone);
}

#[test]
fn another_resident_changes_no_plans() {
    let mut two = files(ORDINARY, &[("henry.routine", "Henry is 80.\n"), ("henry.json", "")]);
    let henry = two["margaret.json"].replace("margaret", "henry");
    two.insert("henry.json".into(), henry);
    let scenario = two["scenario.json"].replace("[\"margaret.json\"]", "[\"margaret.json\", \"henry.json\"]");
    two.insert("scenario.json".into(), scenario);
    let (scenario, household) = household(&two, &[]).unwrap();
    let both = events(Run::new(&scenario, &household, scenario.file.seed, 20 * DAY), DAY);
    let alone = events(run(ORDINARY, 20), DAY);
    let rises = [&both, &alone].map(|events| starts(events, 20, "getting_up"));
    // They wait for each other at the basin, and rise independently.
    let near = |(a, b): (&RunTime, &RunTime)| (*a - *b).abs() < 2 * MINUTE;
    assert_eq!(rises[0].len(), 20);
    assert!(rises[0].iter().zip(&rises[1]).all(near), "{rises:?}");
    assert_ne!(activities(&both, 0, 20 * DAY), activities(&both, 1, 20 * DAY));
}

#[test]
fn twins_differ_from_the_onset_on() {
    let routine = format!("{ORDINARY}\nFrom day 8, over 4 days, she shows severe depression.\n");
    let twin = |without: &[&str]| {
        let (scenario, household) = household(&files(&routine, &[]), without).unwrap();
        let onset = scenario.calendar.instant(7, Span::ZERO);
        (events(Run::new(&scenario, &household, 3, 16 * DAY), DAY), onset)
    };
    let ((with, onset), (without, _)) = (twin(&[]), twin(&["depression"]));
    let before = |events: &Events| events.firings.iter().filter(|f| f.at < onset).copied().collect::<Vec<_>>();
    assert!(before(&with).len() > 10_000);
    assert_eq!(before(&with), before(&without));
    let out_of_bed = |events: &Events| {
        let ups = starts(events, 16, "getting_up").into_iter().map(RunTime::since_zero).filter(|&up| up > 12 * DAY);
        ups.map(|up| up % DAY).sum::<Span>() / 4
    };
    let later = out_of_bed(&with) - out_of_bed(&without);
    assert!((45 * MINUTE..3 * HOUR).contains(&later), "up {} minutes later", later / MINUTE);
}

#[test]
fn a_condition_leaves_the_other_random_numbers() {
    let own = [("conditions/no-lunch.routine", "She skips lunch on 100 % of days.\n")];
    let routine = format!("{ORDINARY}\nFrom day 4 she shows no lunch.\n");
    let twin = |without: &[&str]| {
        let (scenario, household) = household(&files(&routine, &own), without).unwrap();
        let events = events(Run::new(&scenario, &household, 11, 12 * DAY), DAY);
        let at = |name: &str| starts(&events, 12, name);
        (at("getting_up"), at("eating_lunch"), at("showering").len(), at("eating_dinner").len())
    };
    let ((up, lunches, showers, dinners), (up_without, lunches_without, ..)) = (twin(&["no-lunch"]), twin(&[]));
    assert_eq!(up, up_without, "she gets up when she does");
    assert!(lunches.len() >= 12 && lunches_without.len() <= 4, "{} and {}", lunches.len(), lunches_without.len());
    let (_, _, showers_with, dinners_with) = twin(&[]);
    assert_eq!((showers, dinners > 0), (showers_with, dinners_with > 0));
}

/// Segments are continuous in time, and in space except for absences.
#[test]
fn a_resident_is_in_one_place() {
    for moves in everything(20).moves().unwrap() {
        let mut at: Option<Point> = None;
        for pair in moves.windows(2) {
            assert_eq!(pair[0].end, pair[1].begin);
        }
        for next in &moves {
            let (from, to) = match next.doing {
                MotionState::Stride { from, to } => (from, Some(to)),
                MotionState::InPlace { at, .. } | MotionState::Rest { at } => (at, Some(at)),
                MotionState::Away => (at.unwrap_or(Point::ZERO), None),
            };
            if let Some(at) = at {
                assert!(at.distance(from) < 1e-9, "from {at} to {from} at {}", next.begin);
            }
            at = to;
        }
    }
}

/// Frequencies in the ground truth agree with the quantifiers.
#[test]
fn frequencies_agree_with_the_quantifiers() {
    let days = 90;
    let end = days * DAY;
    let events = events(run(ORDINARY, days), DAY);
    let lived = activities(&events, 0, end);
    // The run begins at midnight; clocks went forward on its seventh day.
    let local = |at: RunTime| at + if day(at) >= 6 { HOUR } else { Span::ZERO };
    let (hour_of, day_of) = (|at| hour(local(at)), |at| day(local(at)));
    let days_with = |name: &str, from: f64, to: f64| {
        let of = lived.iter().filter(|(time, what)| what == name && (from..to).contains(&hour_of(time.begin)));
        let mut on: Vec<i64> = of.map(|(time, _)| day_of(time.begin)).collect();
        on.dedup();
        on.len() as f64 / days as f64
    };
    for (name, from, to, quantifier) in [
        ("reading", 13.0, 18.0, Quantifier::Often),
        ("napping", 13.5, 16.5, Quantifier::Often),
        ("washing_up", 17.0, 21.0, Quantifier::Most),
        ("eating_breakfast", 7.0, 10.0, Quantifier::Every),
        ("taking_medicine", 7.0, 10.0, Quantifier::Every),
        ("watching_television", 18.0, 23.0, Quantifier::Every),
    ] {
        let share = days_with(name, from, to);
        let agreement = quantifier.share().agreement((share * 100.0).round() / 100.0);
        assert!(agreement >= 0.9, "{name} on {share:.2} of days is {agreement:.2} of {quantifier:?}");
    }
    let up: Vec<f64> = starts(&events, days, "getting_up").into_iter().map(hour_of).collect();
    assert!((days as usize - 1..=days as usize).contains(&up.len()));
    assert!(up.iter().all(|hour| (5.99..7.7).contains(hour)), "in local time, also after clocks went forward: {up:?}");
    let outings = starts(&events, days, "away");
    let on = |weekday: i64| outings.iter().filter(|&&outing| day_of(outing) % 7 == weekday).count();
    // 2 March 2009 was a Monday.
    assert!([1, 3, 4, 6].iter().all(|&weekday| on(weekday) >= 11), "Tuesday, Thursday, Friday, Sunday");
    assert_eq!(on(0) + on(2) + on(5), 0, "the others");
}

#[test]
fn a_leap_day_is_a_day() {
    let mut leap = files(ORDINARY, &[]);
    let scenario = leap["scenario.json"].replace("2009-03-02", "2012-02-27");
    leap.insert("scenario.json".into(), scenario);
    let (scenario, household) = household(&leap, &[]).unwrap();
    let events = events(Run::new(&scenario, &household, 1, 5 * DAY), DAY);
    let up = starts(&events, 5, "getting_up").into_iter();
    let dates: Vec<_> = up.map(|up| scenario.calendar.date(scenario.calendar.day(up))).collect();
    assert_eq!(dates, [(2012, 2, 27), (2012, 2, 28), (2012, 2, 29), (2012, 3, 1), (2012, 3, 2)]);
}

fn stove_spans(events: &Events, stove: u32) -> Vec<Span> {
    let (mut on, mut spans) = (None, Vec::new());
    for fact in &events.facts {
        if let Fact::Use { at, act, .. } = fact
            && act.thing == ThingId(stove)
        {
            match (act.on, on) {
                (true, None) => on = Some(*at),
                (false, Some(since)) => {
                    spans.push(*at - since);
                    on = None;
                }
                _ => {}
            }
        }
    }
    spans
}

#[test]
fn a_rule_turns_off_what_was_forgotten() {
    // No one turns the stove off while she is out.
    let forgetful = "Margaret is 82.\nShe does not go out.\nShe forgets the stove on 100 % of occasions.\n";
    let rule = "Whenever the stove has been on for 40 minutes, she turns it off.\n";
    let live = |routine: &str| {
        let run = run(routine, 14);
        let stove = run.home().plan.thing("stove").unwrap() as u32;
        stove_spans(&events(run, DAY), stove)
    };
    let (without, with) = (live(forgetful), live(&format!("{forgetful}{rule}")));
    let longest = |spans: &[Span]| spans.iter().max().copied().unwrap_or_default() / MINUTE;
    assert!(longest(&without) > 90, "{} minutes", longest(&without));
    // Uninterruptible activities, such as a meal, come first.
    assert!(longest(&with) < 90, "{} minutes", longest(&with));
    assert!(with.len() > 10);
}

/// The time in the home of the only visitor.
fn visiting(run: Run) -> Span {
    let moves = run.moves().unwrap();
    moves[1].iter().filter(|next| next.doing != MotionState::Away).map(|next| next.end - next.begin).sum()
}

#[test]
fn visitors_come_stay_and_leave() {
    let run = run("Margaret is 82.\nOn Tuesday her daughter visits at about 15:00 for 1 hour.\n", 9);
    assert_eq!(run.names(), ["margaret", "margaret's daughter"]);
    let hours = visiting(run).ratio(HOUR);
    assert!((1.8..2.6).contains(&hours), "two visits take {hours} hours");
}

/// Hours of the day at which an activity begins.
fn hours_of(routine: &str, days: i64, name: &str) -> Vec<f64> {
    starts(&events(run(routine, days), DAY), days, name).into_iter().map(hour).collect()
}

#[test]
fn then_also_follows_getting_up_and_the_toilet() {
    let routine = "Margaret is 82.\nEvery day\n  she gets up at 7:00, then takes a shower\n\
        \x20 she goes to the toilet at 16:00, then reads for 30 minutes\n";
    let (showers, reading) = (hours_of(routine, 4, "showering"), hours_of(routine, 4, "reading"));
    assert!(showers.len() == 4 && showers.iter().all(|hour| (7.0..7.7).contains(hour)), "{showers:?}");
    assert!(reading.len() >= 4 && reading.iter().all(|hour| (16.0..17.7).contains(hour)), "{reading:?}");
}

#[test]
fn late_risers_wash_and_dress_first() {
    let late = ORDINARY.replace("at about 06:45, give or take 45 minutes", "at about 11:00, give or take 15 minutes");
    assert_ne!(late, ORDINARY);
    let events = events(run(&late, 14), DAY);
    let next = |from: RunTime, name: &str| starts(&events, 14, name).into_iter().find(|&start| start >= from);
    for up in &starts(&events, 14, "getting_up")[..13] {
        let (washing, dressing) = (next(*up, "washing").unwrap(), next(*up, "dressing").unwrap());
        let first =
            ["preparing_breakfast", "leaving_home"].into_iter().filter_map(|name| next(*up, name)).min().unwrap();
        assert!(washing < first && dressing < first && dressing - *up < 2 * HOUR, "on day {}", day(*up));
    }
}

#[test]
fn activities_at_night_happen_at_night() {
    let tea = hours_of("Margaret is 82.\nShe makes tea at 3:00 at night.\n", 4, "drinking");
    assert!(tea.iter().filter(|hour| (2.9..3.6).contains(*hour)).count() >= 3, "{tea:?}");
}

#[test]
fn an_outing_ends_as_she_comes_home() {
    let home =
        hours_of("Margaret is 82.\nEvery day\n  she goes out at 10:00\n  she comes home at 12:00\n", 4, "coming_home");
    assert!(home.iter().filter(|hour| (11.8..12.2).contains(*hour)).count() == 4, "{home:?}");
}

#[test]
fn once_a_week_is_once_in_each_week() {
    let days = 42;
    let routine = "Margaret is 82.\nShe exercises twice a week at about 11:00 for 10 minutes.\n";
    // An activity that a need interrupts continues on the same day.
    let mut on: Vec<i64> = starts(&events(run(routine, days), DAY), days, "exercising").into_iter().map(day).collect();
    on.dedup();
    let mut weeks = vec![0; 6];
    on.iter().for_each(|day| weeks[(day / 7) as usize] += 1);
    assert_eq!(weeks, [2; 6]);
}

#[test]
fn a_rule_breaks_off_a_meal() {
    let routine = "Margaret is 82.\nEvery day she eats lunch at 12:00 for 60 minutes.\n\
        Whenever she has been on the dining chair for 20 minutes, she relaxes in the armchair for 5 minutes.\n";
    let run = run(routine, 3);
    let lived = activities(&events(run, DAY), 0, 3 * DAY);
    let longest = lived.iter().filter(|(_, name)| name == "eating_lunch").map(|(lunch, _)| lunch.length()).max();
    assert!(longest.is_some_and(|longest| longest < 27 * MINUTE), "{longest:?}");
}

#[test]
fn a_rule_about_the_host_does_not_bring_visitors() {
    let routine = "Margaret is 82.\nOn Tuesday her daughter visits at 15:00 for 1 hour.\n\
        On Wednesday she goes out at 9:00 for 6 hours.\n\
        Whenever she has been out for 4 hours, she rests on the sofa for 20 minutes.\n";
    let here = visiting(run(routine, 7));
    assert!((40 * MINUTE..2 * HOUR).contains(&here), "{} minutes", here / MINUTE);
}

#[test]
fn a_condition_ends_after_its_time() {
    let routine = "Margaret is 82.\nFrom day 3 to day 5 she shows insomnia.\n";
    let told: Vec<(i64, f64)> = events(run(routine, 9), DAY)
        .facts
        .iter()
        .filter_map(|fact| match fact {
            Fact::Condition { at, severity, .. } => Some((day(*at), *severity)),
            _ => None,
        })
        .collect();
    assert_eq!(told, [(2, 1.0), (3, 1.0), (4, 1.0), (5, 0.0)]);
}

#[test]
fn reports_unreachable_places_before_the_run() {
    let mut closed = files(ORDINARY, &[]);
    let home = closed["home.json"].replace(
        "\"name\": \"bathroom door\", \"from\": [2.6, 1.65], \"to\": [2.6, 2.55]",
        "\"name\": \"bathroom door\", \"from\": [2.6, 1.65], \"to\": [2.6, 2.55], \"open\": false",
    );
    assert_ne!(home, closed["home.json"]);
    closed.insert("home.json".into(), home);
    let said = household(&closed, &[]).unwrap_err();
    assert!(said.contains("margaret cannot get from \"bed\" to \"toilet\""), "{said}");
}

#[test]
fn conditions_that_show_each_other_are_refused() {
    let others = [
        ("conditions/sorrow.routine", "She shows mild worry.\n"),
        ("conditions/worry.routine", "She shows mild sorrow.\n"),
    ];
    let said = household(&files("Margaret is 82.\nShe shows sorrow.\n", &others), &[]).unwrap_err();
    assert!(said.contains("show each other"), "{said}");
}

#[test]
fn a_condition_of_ones_own_needs_no_rust() {
    let own = [("conditions/winter-sleep.routine", "# Ours.\nShe gets up 2 hours later.\n")];
    let (scenario, household) = household(&files("Margaret is 82.\nShe shows winter sleep.\n", &own), &[]).unwrap();
    assert!(scenario.sources.contains_key("conditions/winter-sleep.routine"));
    let up = |run: Run| starts(&events(run, DAY), 3, "getting_up")[0];
    let late = Run::new(&scenario, &household, scenario.file.seed, 3 * DAY);
    assert_eq!(up(late) - up(run("Margaret is 82.\n", 3)), 2 * HOUR);
}

#[test]
fn every_condition_of_the_program_can_run() {
    for (name, text) in homebody_routine::household::CONDITIONS {
        let routine =
            format!("Margaret is 82.\nFrom day 2, over 2 days, she shows severe {}.\n", name.replace('-', " "));
        let (scenario, household) = household(&files(&routine, &[]), &[]).unwrap();
        let events = events(Run::new(&scenario, &household, 1, 4 * DAY), DAY);
        let told = |fact: &&Fact| matches!(fact, Fact::Condition { name: of, .. } if of == name);
        assert!(events.facts.iter().filter(told).count() >= 2, "{name}");
        assert!(text.starts_with('#') && text.contains("ours"), "{name} says where its numbers are from");
    }
}

#[test]
fn rejects_leaving_out_a_condition_that_no_resident_has() {
    let said = household(&files(DECLINE, &[]), &["depresion"]).unwrap_err();
    assert!(said.contains("no resident shows \"depresion\"") && said.contains("cognitive-decline"), "{said}");
}

#[test]
fn a_pace_that_is_said_exactly_is_that_of_all_of_many() {
    let paces = |routine: &str| {
        let (_, household) = household(&files(routine, &[]), &[]).unwrap();
        let many = household.one_of_many();
        [1, 2, 3].map(|seed| many.life(0, seed).unwrap().pace_mps)
    };
    assert_eq!(paces("She walks at 0.5 m/s."), [0.5; 3]);
    let about = paces("She walks at about 0.5 m/s.");
    assert!(about.iter().all(|&pace| pace != 0.5) && about[0] != about[1], "{about:?}");
}
