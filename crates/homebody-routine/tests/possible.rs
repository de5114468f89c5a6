//! What is lived is possible: nobody is where somebody is, and nobody visits an empty home.

use homebody_core::drivers::MotionSegment;
use homebody_core::event::MotionState;
use homebody_core::geometry::Point;
use homebody_core::run::{DriverProvider, Run};
use homebody_core::time::{DAY, Micros, SECOND};
use homebody_routine::household::Household;
use homebody_routine::routine::Kind;
use std::collections::BTreeMap;

/// The files of a shipped scenario.
macro_rules! scenario {
    ($folder:literal: $($file:literal),* $(,)?) => {
        &[$(($file, include_str!(concat!("../../../scenarios/", $folder, "/", $file)))),*]
    };
}

const COUPLE: &[(&str, &str)] = scenario!("couple-with-cat": "scenario.json", "home.json", "logger.json", "henry.json", "henry.routine", "ruth.json", "ruth.routine", "minka.json", "minka.routine");
const TIGERPLACE: &[(&str, &str)] =
    scenario!("tigerplace": "scenario.json", "home.json", "logger.json", "margaret.json", "margaret.routine");
const DECLINE: &[(&str, &str)] =
    scenario!("tigerplace-decline": "scenario.json", "home.json", "logger.json", "margaret.json", "margaret.routine");

/// Nearer than this, two are on one spot: who squeezes past somebody in a narrow place does not come as near.
const ONE_SPOT_M: f64 = 0.2;

/// What cannot be, of a life of so many days.
#[derive(Debug, Default, PartialEq)]
struct Impossible {
    /// Two who stay on one spot, and how long in all, in seconds.
    on_one_spot: usize,
    on_one_spot_s: f64,
    /// Somebody who walks through somebody who stands or walks.
    through_somebody: usize,
    /// A visitor where no host is, in seconds.
    visiting_nobody_s: f64,
}

/// Who is where in a life.
struct Lived {
    /// By body, pets left out: who lives there first.
    people: Vec<Vec<MotionSegment>>,
    /// Of each visitor, by their place in `people`, the host.
    hosts: Vec<(usize, usize)>,
}

fn live(scenario: &[(&str, &str)], days: i64) -> Lived {
    let files = scenario.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned()));
    let files: BTreeMap<String, String> = files.collect();
    let (scenario, household) = Household::load(&files, "scenario.json", &[]).unwrap();
    let residents = scenario.residents.len();
    let moves = Run::new(&scenario, &household, scenario.file.seed, days * DAY).moves().unwrap();
    let is_person = |body: usize| {
        let person = household.routine(body).and_then(|routine| routine.person.as_ref());
        person.is_none_or(|person| person.kind == Kind::Person)
    };
    let names: Vec<String> = household.guests().into_iter().map(|guest| guest.name).collect();
    let (mut people, mut hosts) = (Vec::new(), Vec::new());
    for (body, moves) in moves.into_iter().enumerate() {
        if let Some(name) = body.checked_sub(residents).map(|guest| &names[guest]) {
            let is_of = |host: &usize| name.starts_with(&format!("{}'s ", scenario.residents[*host].file.name));
            hosts.push((people.len(), (0..residents).find(is_of).unwrap()));
        }
        if is_person(body) {
            people.push(moves);
        }
    }
    Lived { people, hosts }
}

fn impossible(Lived { people, hosts }: &Lived) -> Impossible {
    let mut found = Impossible::default();
    for first in 0..people.len() {
        for second in first + 1..people.len() {
            together(&people[first], &people[second], |a, b, from, until| {
                let stays = |segment: &MotionSegment| !matches!(segment.doing, MotionState::Stride { .. });
                let nearest = nearest(a, b, from, until);
                if nearest < ONE_SPOT_M && stays(a) && stays(b) {
                    found.on_one_spot += 1;
                    found.on_one_spot_s += (until - from) as f64 / SECOND as f64;
                } else if nearest < ONE_SPOT_M && a.posture == b.posture {
                    found.through_somebody += 1;
                }
            });
        }
    }
    for &(visitor, host) in hosts {
        together(&people[visitor], &people[host], |visits, hosts, from, until| {
            let is_home = |segment: &MotionSegment| segment.doing != MotionState::Away;
            if is_home(visits) && !is_home(hosts) {
                found.visiting_nobody_s += (until - from) as f64 / SECOND as f64;
            }
        });
    }
    found
}

/// How near two come in a span of time; infinitely far while one is out.
fn nearest(a: &MotionSegment, b: &MotionSegment, from: Micros, until: Micros) -> f64 {
    let at = |instant: Micros| -> Option<f64> { Some(a.position(instant)?.distance(b.position(instant)?)) };
    let instants = (0..=4).map(|part| from + (until - from) * part / 4);
    instants.filter_map(at).fold(f64::INFINITY, f64::min)
}

/// All that two do at a time, from when until when.
fn together(
    a: &[MotionSegment],
    b: &[MotionSegment],
    mut each: impl FnMut(&MotionSegment, &MotionSegment, Micros, Micros),
) {
    let (mut of_a, mut of_b) = (a.iter().peekable(), b.iter().peekable());
    while let (Some(a), Some(b)) = (of_a.peek(), of_b.peek()) {
        let (from, until) = (a.begin.max(b.begin), a.end.min(b.end));
        if from < until {
            each(a, b, from, until);
        }
        if a.end <= b.end {
            of_a.next();
        } else {
            of_b.next();
        }
    }
}

/// Lives 90 days of a scenario in which several meet, with so many visits at least.
fn nothing_is_impossible(scenario: &[(&str, &str)], least_visits: usize) {
    let lived = live(scenario, 90);
    let visits: usize = lived.hosts.iter().map(|(visitor, _)| comings(&lived.people[*visitor])).sum();
    assert!(visits >= least_visits, "{visits} visits");
    assert_eq!(impossible(&lived), Impossible::default());
}

#[test]
fn a_couple_with_visitors_is_never_where_somebody_is() {
    nothing_is_impossible(COUPLE, 40);
}

#[test]
fn who_lives_alone_receives_visitors() {
    nothing_is_impossible(TIGERPLACE, 2);
    nothing_is_impossible(DECLINE, 2);
}

/// How often somebody comes in.
fn comings(moves: &[MotionSegment]) -> usize {
    let is_out = |segment: &MotionSegment| segment.doing == MotionState::Away;
    moves.windows(2).filter(|pair| is_out(&pair[0]) && !is_out(&pair[1])).count()
}

#[test]
fn what_is_impossible_is_found() {
    let at = |x: f64| MotionState::Rest { at: Point::new(x, 0.0) };
    let stay = |begin, end, doing| {
        let posture = homebody_core::scenario::path::Posture::Standing;
        MotionSegment { begin: begin * SECOND, end: end * SECOND, doing, posture }
    };
    let host = vec![stay(0, 10, at(0.0)), stay(10, 20, MotionState::Away)];
    let walk = MotionState::Stride { from: Point::new(1.0, 0.0), to: Point::new(-1.0, 0.0) };
    let visitor = vec![stay(0, 4, at(0.1)), stay(4, 6, walk), stay(6, 20, at(3.0))];
    let found = impossible(&Lived { people: vec![host, visitor], hosts: vec![(1, 0)] });
    let expected = Impossible { on_one_spot: 1, on_one_spot_s: 4.0, through_somebody: 1, visiting_nobody_s: 10.0 };
    assert_eq!(found, expected);
}
