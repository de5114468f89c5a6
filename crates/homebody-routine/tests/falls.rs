//! Falls of routines, in the ground truth, in bodies and in passive sensors.

use crate::stage::{Simulated, files, hour, household};
use homebody_core::event::Fact;
use homebody_core::geometry::Point;
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, RunTime, Span, joined};

const BASE: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 07:00.\nShe goes to bed at 22:30.\n";

#[derive(Clone, Copy, Debug)]
struct Piece {
    time: Interval<RunTime>,
    doing: MotionState,
    posture: Posture,
}

fn live(sentences: &str, days: i64) -> Simulated {
    Simulated::new(&format!("{BASE}{sentences}"), days)
}

impl Simulated {
    fn pieces(&self, body: usize) -> impl Iterator<Item = Piece> + '_ {
        self.events.facts.iter().filter_map(move |fact| match *fact {
            Fact::Movement { resident, begin, end, doing, posture } if resident.index() == body => {
                Some(Piece { time: Interval::new(begin, end), doing, posture })
            }
            _ => None,
        })
    }

    /// Each time on the floor as one interval.
    fn lies(&self) -> Vec<Interval<RunTime>> {
        let down = self.pieces(0).filter(|piece| piece.posture == Posture::Down);
        joined(down.map(|piece| piece.time), Span::ZERO)
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
fn falls_at_night_happen_on_the_way_to_the_bathroom_for_the_stated_time() {
    let lived = live(
        "On half of the days she falls, mostly at night on the way to the bathroom, and lies there for 20 minutes.\n",
        60,
    );
    let lies = lived.lies();
    assert!((20..=42).contains(&lies.len()), "{} falls", lies.len());
    for lie in &lies {
        assert!((18 * MINUTE..=22 * MINUTE).contains(&lie.length()), "{} s", lie.length().seconds());
    }
    let by_night = lies.iter().filter(|lie| !(7.0..22.0).contains(&hour(lie.begin))).count();
    let share = by_night as f64 / lies.len() as f64;
    assert!((0.55..0.95).contains(&share), "{share} by night");
    // After rising, the walk continues to its goal.
    let visits: Vec<RunTime> = lived.of("using_bathroom").map(|visit| visit.begin).collect();
    let goes_on = |end: RunTime| visits.iter().any(|visit| (Span::ZERO..5 * MINUTE).contains(&(*visit - end)));
    assert!(lies.iter().all(|lie| goes_on(lie.end)), "{lies:?} {visits:?}");
    // The label in the ground truth.
    assert_eq!(lived.of("fallen").count(), lies.len());
}

#[test]
fn sensors_hardly_notice_a_person_on_the_floor() {
    let lived = live("Every day she falls and lies there for 2 hours.\n", 20);
    let lies = lived.lies();
    assert!(lies.len() >= 18);
    let within =
        |time: Interval<RunTime>| lived.events.firings.iter().filter(|firing| time.contains(firing.at)).count() as f64;
    let lying: f64 = lies.iter().map(|lie| within(*lie)).sum::<f64>() / lies.len() as f64;
    let two_hours = |lie: &Interval<RunTime>| Interval::new(lie.begin - 2 * HOUR, lie.begin);
    let before: f64 = lies.iter().map(|lie| within(two_hours(lie))).sum::<f64>() / lies.len() as f64;
    assert!(lying < 0.7 * before, "{lying} firings while she lies there, {before} before");
}

#[test]
fn a_fall_out_of_bed_or_a_seat_ends_next_to_it() {
    for (said, from) in [("out of bed", "bed"), ("while getting up from her chair", "armchair")] {
        let lived = live(&format!("Every day she falls {said} and lies there for 10 minutes.\n"), 20);
        let seat = lived.at(from);
        let lies = lived.lies();
        assert!(lies.len() >= 15, "{said}: {}", lies.len());
        let (mut from_there, all) = (0, lies.len());
        for lie in lies {
            let last = lived.pieces(0).filter(|piece| lie.contains(piece.time.begin)).last().unwrap();
            let off = place(last.doing).unwrap().distance(seat);
            assert!((0.3..2.2).contains(&off), "{said}: {off} m");
            let is_before = |piece: &Piece| piece.time.end <= lie.begin && piece.time.begin > lie.begin - 5 * MINUTE;
            let before = lived.pieces(0).filter(is_before);
            let on_it = before.filter(|piece| piece.posture != Posture::Standing && place(piece.doing) == Some(seat));
            from_there += usize::from(on_it.count() > 0);
        }
        // Sometimes she rose some minutes before.
        assert!(5 * from_there >= 4 * all, "{said}: {from_there} of {all} from there");
    }
}

#[test]
fn reaching_the_phone_is_a_crawl() {
    let lived = live("Every day she falls and lies there until she reaches the phone.\n", 20);
    let crawls: Vec<Piece> = lived
        .pieces(0)
        .filter(|piece| piece.posture == Posture::Down && matches!(piece.doing, MotionState::Stride { .. }))
        .collect();
    assert!(crawls.len() >= 15, "{}", crawls.len());
    for piece in &crawls {
        let MotionState::Stride { from, to } = piece.doing else { continue };
        let mps = from.distance(to) / piece.time.length().seconds();
        assert!(mps < 0.2, "{mps} m/s");
    }
}

#[test]
fn a_visitor_finds_a_fallen_person() {
    let sentences = "Every night she falls on the way to the bathroom and lies there until somebody comes.\n\
        Her daughter visits every day at 09:00 for 30 minutes.\n";
    let lived = live(sentences, 20);
    let lies = lived.lies();
    assert!(lies.len() >= 12, "{}", lies.len());
    for lie in lies {
        let hour = hour(lie.end);
        // A visitor's arrival varies.
        assert!((8.9..10.0).contains(&hour), "found at {hour}");
        assert!(lie.length() > HOUR, "{}", lie.length() / MINUTE);
    }
    // She lets herself in, and leaves.
    let visits = lived.pieces(1).filter(|piece| place(piece.doing).is_some()).count();
    assert!(visits > 20, "{visits}");
}

#[test]
fn reports_before_the_run_that_no_one_can_come() {
    let told = |sentences: &str| household(&files(&format!("{BASE}{sentences}"), &[]), &[]).err();
    let alone = told("She falls once a month and lies there until somebody comes.\n").unwrap();
    assert!(alone.contains("no person can find") && alone.contains("her daughter visits"), "{alone}");
    // A cat does not find anyone.
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
fn a_near_fall_does_not_end_on_the_floor() {
    let lived = live("Every day she nearly falls.\n", 20);
    assert!(lived.of("stumbling").count() >= 15, "{}", lived.of("stumbling").count());
    assert_eq!(lived.lies(), []);
    assert!(lived.pieces(0).any(|piece| piece.posture == Posture::Bending));
}

#[test]
fn mostly_at_some_time_is_three_of_four_falls_with_every_rhythm() {
    // Falls in 120 days, a tolerance, and the hours of most of them.
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
        let hour = |lie: &&Interval<RunTime>| hour(lie.begin) as i64;
        let then = lies.iter().filter(|lie| hours.contains(&hour(lie)) || hours.contains(&(hour(lie) + 24)));
        let share = then.count() as f64 / lies.len() as f64;
        // Four standard deviations of a share of 3/4.
        let off = 4.0 * (0.75 * 0.25 / lies.len() as f64).sqrt();
        println!("{said}: {} falls, {share:.2} then", lies.len());
        assert!((share - 0.75).abs() < off, "{said}: {share} of {}", lies.len());
    }
}

#[test]
fn falls_out_of_bed_interrupt_sleep() {
    for said in ["falls out of bed every day", "falls every night in bed", "slides out of bed every day"] {
        let lived = live(&format!("She {said}.\n"), 30);
        let lies = lived.lies();
        assert!((27..=31).contains(&lies.len()), "{said}: {}", lies.len());
        let bed = lived.at("bed");
        for lie in &lies {
            let hour = hour(lie.begin);
            assert!(!(7.0..22.0).contains(&hour), "{said}: at {hour}");
            // She was in bed before.
            let before = Interval::new(lie.begin - 20 * MINUTE, lie.begin);
            let in_bed =
                lived.pieces(0).filter(|piece| piece.posture == Posture::Lying && place(piece.doing) == Some(bed));
            let lay: Span = in_bed.map(|piece| piece.time.overlap(before)).sum();
            assert!(lay > Span::ZERO, "{said}: not from bed at {hour}");
        }
        let is_from = |sleep: Interval<RunTime>, at: RunTime| sleep.begin < at && at - sleep.end < 5 * MINUTE;
        let from_sleep = lies.iter().filter(|lie| lived.of("sleeping").any(|sleep| is_from(sleep, lie.begin))).count();
        println!("{said}: {from_sleep} of {} out of their sleep", lies.len());
        assert!(4 * from_sleep >= 3 * lies.len(), "{said}: {from_sleep} of {}", lies.len());
    }
}

/// She wakes, falls next to the seat, and continues the nap.
#[test]
fn a_fall_that_has_its_time_breaks_into_a_nap() {
    let said = "Every day she naps in the armchair at 15:00 for 2 hours.\n\
                Every day at 15:10 she goes to the bathroom.\n\
                Every day at 15:30 she falls and lies there for 10 minutes.\n";
    let days = 6;
    let lived = live(said, days);
    let falls: Vec<_> = lived.of("fallen").collect();
    assert_eq!(falls.len() as i64, days, "{falls:?}");
    for Interval { begin, end } in falls {
        let time = begin.since_zero().rem_euclid(DAY);
        assert!((time - (15 * HOUR + 30 * MINUTE)).abs() < 10 * MINUTE, "{time}");
        let naps_around = lived.of("napping").any(|nap| (begin - 2 * MINUTE..=begin).contains(&nap.end))
            && lived.of("napping").any(|nap| (end..end + 5 * MINUTE).contains(&nap.begin));
        assert!(naps_around, "{begin} to {end}: {:?}", lived.of("napping").collect::<Vec<_>>());
    }
}
