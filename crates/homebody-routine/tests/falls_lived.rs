//! Falls as they are said, in the truth, in bodies and in what passive sensors say.

mod stage;

use homebody_core::event::{Events, Fact, MotionState};
use homebody_core::geometry::Point;
use homebody_core::run::Run;
use homebody_core::scenario::path::Posture;
use homebody_core::time::{DAY, Micros, SECOND};
use stage::{HOUR, activities, events, files, household};

const BASE: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 07:00.\nShe goes to bed at 22:30.\n";

const MINUTE: Micros = 60 * SECOND;

struct Lived {
    events: Events,
    all: Vec<(Micros, Micros, String)>,
    places: Vec<(String, Point)>,
}

/// What somebody's body did.
#[derive(Clone, Copy, Debug)]
struct Span {
    begin: Micros,
    end: Micros,
    doing: MotionState,
    posture: Posture,
}

fn live(sentences: &str, days: i64) -> Lived {
    let mut files = files(&format!("{BASE}{sentences}"), &[]);
    let scenario = files["scenario.json"].replace("America/Chicago", "UTC").replace("2009-03-02", "2009-01-05");
    files.insert("scenario.json".into(), scenario);
    let (scenario, household) = household(&files, &[]).unwrap();
    let events = events(Run::new(&scenario, &household, 11, days * DAY), DAY);
    let all = activities(&events, 0, days * DAY);
    Lived { events, all, places: scenario.home.plan().places.clone() }
}

impl Lived {
    fn of<'a>(&'a self, name: &'a str) -> impl Iterator<Item = (Micros, Micros)> + 'a {
        self.all.iter().filter(move |(.., what)| what == name).map(|(from, to, _)| (*from, *to))
    }

    fn spans(&self, body: usize) -> impl Iterator<Item = Span> + '_ {
        self.events.facts.iter().filter_map(move |fact| match *fact {
            Fact::Movement { resident, begin, end, doing, posture } if resident.index() == body => {
                Some(Span { begin, end, doing, posture })
            }
            _ => None,
        })
    }

    /// The times on the floor, each in one piece.
    fn lies(&self) -> Vec<(Micros, Micros)> {
        let mut lies: Vec<(Micros, Micros)> = Vec::new();
        for span in self.spans(0).filter(|span| span.posture == Posture::Down) {
            match lies.last_mut() {
                Some((_, end)) if *end == span.begin => *end = span.end,
                _ => lies.push((span.begin, span.end)),
            }
        }
        lies
    }

    fn at(&self, name: &str) -> Point {
        self.places.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).unwrap().1
    }
}

fn place(doing: MotionState) -> Option<Point> {
    match doing {
        MotionState::Rest { at } | MotionState::InPlace { at, .. } => Some(at),
        MotionState::Stride { to, .. } => Some(to),
        MotionState::Away => None,
    }
}

#[test]
fn falls_at_night_on_the_way_to_the_bathroom_are_there_and_last_as_said() {
    let lived = live(
        "On half of the days she falls, mostly at night on the way to the bathroom, and lies there for 20 minutes.\n",
        60,
    );
    let lies = lived.lies();
    assert!((20..=42).contains(&lies.len()), "{} falls", lies.len());
    for (begin, end) in &lies {
        assert!((18 * MINUTE..=22 * MINUTE).contains(&(end - begin)), "{} s", (end - begin) / SECOND);
    }
    let by_night = lies.iter().filter(|(begin, _)| !(7 * HOUR..22 * HOUR).contains(&(begin % DAY))).count();
    let share = by_night as f64 / lies.len() as f64;
    assert!((0.55..0.95).contains(&share), "{share} by night");
    // Who gets up again goes on to where they were going.
    let visits: Vec<Micros> = lived.of("using_bathroom").map(|(from, _)| from).collect();
    let goes_on = |end: &Micros| visits.iter().any(|visit| (0..5 * MINUTE).contains(&(visit - end)));
    assert!(lies.iter().all(|(_, end)| goes_on(end)), "{lies:?} {visits:?}");
    // The truth calls it so.
    assert_eq!(lived.of("fallen").count(), lies.len());
}

#[test]
fn who_lies_still_is_heard_of_by_hardly_any_sensor() {
    let lived = live("Every day she falls and lies there for 2 hours.\n", 20);
    let lies = lived.lies();
    assert!(lies.len() >= 18);
    let within = |from: Micros, to: Micros| {
        lived.events.firings.iter().filter(|firing| (from..to).contains(&firing.at)).count() as f64
    };
    let lying: f64 = lies.iter().map(|&(from, to)| within(from, to)).sum::<f64>() / lies.len() as f64;
    let before: f64 = lies.iter().map(|&(from, _)| within(from - 2 * HOUR, from)).sum::<f64>() / lies.len() as f64;
    assert!(lying < 0.7 * before, "{lying} firings while she lies there, {before} before");
}

#[test]
fn who_falls_out_of_bed_or_a_seat_lies_beside_it() {
    for (said, from) in [("out of bed", "bed"), ("while getting up from her chair", "armchair")] {
        let lived = live(&format!("Every day she falls {said} and lies there for 10 minutes.\n"), 20);
        let seat = lived.at(from);
        let lies = lived.lies();
        assert!(lies.len() >= 15, "{said}: {}", lies.len());
        let (mut from_there, all) = (0, lies.len());
        for (begin, end) in lies {
            let last = lived.spans(0).filter(|span| (begin..end).contains(&span.begin)).last().unwrap();
            let off = place(last.doing).unwrap().distance(seat);
            assert!((0.3..2.2).contains(&off), "{said}: {off} m");
            let before = lived.spans(0).filter(|span| span.end <= begin && span.begin > begin - 5 * MINUTE);
            let on_it = before.filter(|span| span.posture != Posture::Standing && place(span.doing) == Some(seat));
            from_there += usize::from(on_it.count() > 0);
        }
        // Now and then she has got up some minutes before.
        assert!(5 * from_there >= 4 * all, "{said}: {from_there} of {all} from there");
    }
}

#[test]
fn who_reaches_the_phone_crawls_there() {
    let lived = live("Every day she falls and lies there until she reaches the phone.\n", 20);
    let crawls: Vec<Span> = lived
        .spans(0)
        .filter(|span| span.posture == Posture::Down && matches!(span.doing, MotionState::Stride { .. }))
        .collect();
    assert!(crawls.len() >= 15, "{}", crawls.len());
    for span in &crawls {
        let MotionState::Stride { from, to } = span.doing else { continue };
        let mps = from.distance(to) / ((span.end - span.begin) as f64 / 1e6);
        assert!(mps < 0.2, "{mps} m/s");
    }
}

#[test]
fn who_lies_until_somebody_comes_is_found_by_the_visitor() {
    let sentences = "Every night she falls on the way to the bathroom and lies there until somebody comes.\n\
        Her daughter visits every day at 09:00 for 30 minutes.\n";
    let lived = live(sentences, 20);
    let lies = lived.lies();
    assert!(lies.len() >= 12, "{}", lies.len());
    for (begin, end) in lies {
        let hour = (end % DAY) as f64 / HOUR as f64;
        // A visitor is not there to the second.
        assert!((8.9..10.0).contains(&hour), "found at {hour}");
        assert!(end - begin > HOUR, "{}", (end - begin) / MINUTE);
    }
    // She comes in by herself, and goes.
    let visits = lived.spans(1).filter(|span| place(span.doing).is_some()).count();
    assert!(visits > 20, "{visits}");
}

#[test]
fn that_nobody_comes_is_told_before_the_run() {
    let told = |sentences: &str| household(&files(&format!("{BASE}{sentences}"), &[]), &[]).err();
    let alone = told("She falls once a month and lies there until somebody comes.\n").unwrap();
    assert!(alone.contains("no person can find") && alone.contains("her daughter visits"), "{alone}");
    // A cat finds nobody.
    let cat = include_str!("../../../scenarios/couple-with-cat/minka.json");
    let lies = format!("{BASE}She falls once a month and lies there until somebody comes.\n");
    let mut with_cat = files(&lies, &[("minka.json", cat), ("minka.routine", "Minka is a cat.\n")]);
    let residents = with_cat["scenario.json"].replace("\"margaret.json\"", "\"margaret.json\", \"minka.json\"");
    with_cat.insert("scenario.json".into(), residents);
    assert!(household(&with_cat, &[]).err().unwrap().contains("no person can find"));
    let visited = "She falls once a month and lies there until somebody comes.\nHer daughter visits on Sunday.\n";
    assert_eq!(told(visited), None);
}

#[test]
fn who_nearly_falls_is_not_on_the_floor() {
    let lived = live("Every day she nearly falls.\n", 20);
    assert!(lived.of("stumbling").count() >= 15, "{}", lived.of("stumbling").count());
    assert_eq!(lived.lies(), []);
    assert!(lived.spans(0).any(|span| span.posture == Posture::Bending));
}

#[test]
fn mostly_at_some_time_is_three_of_four_falls_with_every_rhythm() {
    // Falls in 120 days, how many more or fewer there may be, and at which hours they mostly are.
    for (said, count, spread, hours) in [
        ("every other day, mostly at night on the way to the bathroom", 60, 2, 22..31),
        ("every day, mostly by day", 120, 4, 8..21),
        ("three times a week, mostly in the morning", 51, 4, 8..12),
        ("on 2 days a week, mostly at night, and lies there for 20 minutes", 34, 3, 22..31),
        ("ten times every two weeks, mostly at night", 86, 16, 22..31),
    ] {
        let lived = live(&format!("She falls {said}.\n"), 120);
        let lies = lived.lies();
        assert!(lies.len().abs_diff(count) <= spread, "{said}: {} falls", lies.len());
        let hour = |begin: Micros| (begin % DAY) / HOUR;
        let then =
            lies.iter().filter(|(begin, _)| hours.contains(&hour(*begin)) || hours.contains(&(hour(*begin) + 24)));
        let share = then.count() as f64 / lies.len() as f64;
        // Four standard deviations of a share of 3/4.
        let off = 4.0 * (0.75 * 0.25 / lies.len() as f64).sqrt();
        println!("{said}: {} falls, {share:.2} then", lies.len());
        assert!((share - 0.75).abs() < off, "{said}: {share} of {}", lies.len());
    }
}

#[test]
fn who_falls_out_of_bed_falls_out_of_their_sleep() {
    for said in ["falls out of bed every day", "falls every night in bed", "slides out of bed every day"] {
        let lived = live(&format!("She {said}.\n"), 30);
        let lies = lived.lies();
        assert!((27..=31).contains(&lies.len()), "{said}: {}", lies.len());
        let bed = lived.at("bed");
        for &(begin, _) in &lies {
            let hour = begin % DAY / HOUR;
            assert!(!(7..22).contains(&hour), "{said}: at {hour}");
            // She does not come to the bed for it.
            let before = lived.spans(0).filter(|span| span.begin < begin && span.end > begin - 20 * MINUTE);
            let in_bed = before.filter(|span| span.posture == Posture::Lying && place(span.doing) == Some(bed));
            let lay: Micros = in_bed.map(|span| span.end.min(begin) - span.begin.max(begin - 20 * MINUTE)).sum();
            assert!(lay > 0, "{said}: not from bed at {hour}");
        }
        let asleep = |begin: &Micros| lived.of("sleeping").any(|(from, to)| from < *begin && begin - to < 5 * MINUTE);
        let from_sleep = lies.iter().filter(|(begin, _)| asleep(begin)).count();
        println!("{said}: {from_sleep} of {} out of their sleep", lies.len());
        assert!(4 * from_sleep >= 3 * lies.len(), "{said}: {from_sleep} of {}", lies.len());
    }
}

/// Who naps then is woken by it, falls beside the seat, and naps on.
#[test]
fn a_fall_that_has_its_time_breaks_into_a_nap() {
    let said = "Every day she naps in the armchair at 15:00 for 2 hours.\n\
                Every day at 15:10 she goes to the bathroom.\n\
                Every day at 15:30 she falls and lies there for 10 minutes.\n";
    let days = 6;
    let lived = live(said, days);
    let falls: Vec<_> = lived.of("fallen").collect();
    assert_eq!(falls.len() as i64, days, "{falls:?}");
    for (begin, end) in falls {
        let time = begin.rem_euclid(DAY);
        assert!((time - (15 * HOUR + 30 * MINUTE)).abs() < 10 * MINUTE, "{time}");
        let naps_around = lived.of("napping").any(|(_, to)| (begin - 2 * MINUTE..=begin).contains(&to))
            && lived.of("napping").any(|(from, _)| (end..end + 5 * MINUTE).contains(&from));
        assert!(naps_around, "{begin} to {end}: {:?}", lived.of("napping").collect::<Vec<_>>());
    }
}
