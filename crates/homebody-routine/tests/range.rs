//! Rooms that a person keeps to or never enters, and rests on the way, as the truth has them.

use crate::stage::{Simulated, day};
use homebody_core::event::Fact;
use homebody_core::geometry::Point;
use homebody_core::motion::MotionState;
use homebody_core::time::SECOND;
use std::collections::BTreeSet;

const ALONE: &str = "Margaret is 82.\nShe gets up at 07:00. She goes to bed at 22:30.\n";

/// The corners of rooms of the apartment.
const KITCHEN: [[f64; 2]; 2] = [[5.5, 0.0], [9.4, 2.8]];
const LIVING_ROOM: [[f64; 2]; 2] = [[3.9, 2.8], [9.4, 6.6]];

/// The days on which the resident is in a room.
fn days_in(lives: &Simulated, [least, most]: [[f64; 2]; 2]) -> BTreeSet<i64> {
    let is_in = |at: &Point| (least[0]..most[0]).contains(&at.x) && (least[1]..most[1]).contains(&at.y);
    let days = lives.events.facts.iter().filter_map(|fact| match fact {
        Fact::Movement { resident, begin, doing, .. } if resident.index() == 0 => {
            let is_there = match doing {
                MotionState::Rest { at } | MotionState::InPlace { at, .. } => is_in(at),
                MotionState::Stride { to, .. } => is_in(to),
                _ => false,
            };
            is_there.then(|| day(*begin))
        }
        _ => None,
    });
    days.collect()
}

#[test]
fn a_room_that_she_never_enters_is_empty_from_then_on() {
    let lives = Simulated::new(&format!("{ALONE}From day 11 she never enters the kitchen."), 30);
    let days = days_in(&lives, KITCHEN);
    assert!((0..10).all(|day| days.contains(&day)), "{days:?}");
    assert!((11..30).all(|day| !days.contains(&day)), "{days:?}");
    assert!((11..30).all(|day| days_in(&lives, LIVING_ROOM).contains(&day)));
}

#[test]
fn on_some_days_she_keeps_to_a_room() {
    let stays = |text: &str| {
        let lives = Simulated::new(&format!("{ALONE}{text}"), 40);
        let days = days_in(&lives, LIVING_ROOM);
        (1..40).filter(|day| !days.contains(day)).count()
    };
    let with = stays("On 25 % of days she keeps to the bedroom.");
    assert!((4..=18).contains(&with), "{with}");
    assert_eq!(stays(""), 0);
}

/// The ways without a rest, in metres.
fn stretches(lives: &Simulated) -> Vec<f64> {
    let mut all = vec![0.0];
    for fact in &lives.events.facts {
        let Fact::Movement { resident, begin, end, doing, .. } = fact else { continue };
        match (resident.index(), doing) {
            (0, MotionState::Stride { from, to }) => *all.last_mut().expect("there is one") += from.distance(*to),
            // A turn of a few seconds is not a rest.
            (0, _) if *end - *begin >= 5 * SECOND => all.push(0.0),
            _ => {}
        }
    }
    all
}

#[test]
fn nobody_walks_further_than_the_longest_stretch() {
    let longest = |text: &str| {
        let lives = Simulated::new(&format!("{ALONE}{text}"), 10);
        stretches(&lives).into_iter().fold(0.0, f64::max)
    };
    let (with, without) = (longest("She walks at 0.6 m/s and rests after 4 m."), longest("She walks at 0.6 m/s."));
    assert!(with <= 4.01 && without > 6.0, "{with} and {without}");
}

#[test]
fn a_rest_on_the_way_has_its_length() {
    let rests = |text: &str| {
        let lives = Simulated::new(&format!("{ALONE}{text}"), 5);
        let moves = lives.events.facts.iter().filter_map(|fact| match fact {
            Fact::Movement { resident, begin, end, doing, .. } if resident.index() == 0 => Some((*begin, *end, *doing)),
            _ => None,
        });
        let facts: Vec<_> = moves.collect();
        let is_stride = |doing: &MotionState| matches!(doing, MotionState::Stride { .. });
        let between = facts.windows(3).filter(|three| {
            is_stride(&three[0].2) && is_stride(&three[2].2) && matches!(three[1].2, MotionState::Rest { .. })
        });
        between.map(|three| (three[1].1 - three[1].0).seconds()).collect::<Vec<f64>>()
    };
    let lasts = rests("She rests after 4 m for 60 seconds.");
    let near = lasts.iter().filter(|lasts| (50.0..70.0).contains(*lasts)).count();
    assert!(near > 30 && near * 10 >= lasts.len() * 8, "{near} of {}", lasts.len());
    let usual = rests("").iter().filter(|lasts| (50.0..70.0).contains(*lasts)).count();
    assert!(usual * 4 < near, "{usual}");
}
