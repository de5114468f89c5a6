//! Drivers from other crates: what they see, and how a run ends after an invalid answer.
#![expect(clippy::disallowed_types, reason = "what a driver saw is told to the test by a lock")]

use homebody_core::drivers::error::{DriverError, DriverFault, MOST_ANSWERS};
use homebody_core::drivers::input::{DriveKey, Input};
use homebody_core::drivers::live::{KeyTrack, LiveDriver};
use homebody_core::drivers::{Driver, Next, Surroundings};
use homebody_core::event::{BodilyNeed, Events, Fact, ThingUse, Vitals};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::{ResidentId, RoomId, ThingId};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::problem::Diagnose;
use homebody_core::resident::Build;
use homebody_core::run::Run;
use homebody_core::time::{HOUR, MINUTE, RunTime, SECOND, Span};
use std::collections::VecDeque;
use std::sync::{Arc, LazyLock, Mutex};

/// The flat of the tests: a kitchen with sensors, and a bedroom to the east of it through an open door.
static HOME: LazyLock<Arc<Home>> = LazyLock::new(|| {
    let home = serde_json::from_str(include_str!("../../../tests/flat/home.json")).unwrap();
    Arc::new(Home::bake(&ResolvedHome::new(home).unwrap(), &[Build::adult(); 3]))
});

/// Gives one answer after the other, and the last one again and again.
#[derive(Clone, Debug)]
struct Says {
    answers: VecDeque<Next>,
    last: Next,
}

impl Driver for Says {
    fn next(&mut self, _around: &Surroundings) -> Next {
        self.answers.pop_front().unwrap_or_else(|| self.last.clone())
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}

fn says(answers: Vec<Next>, last: Next) -> Box<dyn Driver> {
    Box::new(Says { answers: answers.into(), last })
}

fn at(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

/// Seconds of a run.
fn seconds(seconds: i64) -> RunTime {
    RunTime::START + seconds * SECOND
}

fn segment(begin: RunTime, end: RunTime, doing: MotionState) -> Next {
    Next::Segment(MotionSegment { begin, end, doing, posture: Posture::Standing })
}

/// A walk in the kitchen in the first ten seconds, which its sensors see.
fn walk() -> Vec<Next> {
    vec![segment(seconds(0), seconds(10), MotionState::Stride { from: at(1.0, 1.0), to: at(3.0, 2.0) })]
}

/// A rest where the walk has ended, for ever.
fn rest() -> Next {
    segment(seconds(10), RunTime::NEVER, MotionState::Rest { at: at(3.0, 2.0) })
}

const LENGTH: Span = MINUTE;
const END: RunTime = RunTime::START.saturating_add(LENGTH);

fn run(drivers: Vec<Box<dyn Driver>>) -> Run {
    let builds = vec![Build::adult(); drivers.len()];
    Run::from_drivers(HOME.clone(), builds, drivers, 1, LENGTH)
}

/// A run with a walk of ten seconds and then this answer.
fn after_a_walk(last: Next) -> (Run, Events, Result<(), DriverError>) {
    let mut run = run(vec![says(walk(), last)]);
    let mut events = Events::default();
    let lived = run.advance(END, &mut events);
    (run, events, lived)
}

#[test]
fn an_impossible_answer_ends_the_run() {
    let (begin, end, here) = (seconds(10), seconds(20), at(3.0, 2.0));
    let (mut sound, mut before) = (run(vec![says(walk(), rest())]), Events::default());
    sound.advance(begin, &mut before).unwrap();
    assert!(!before.firings.is_empty(), "the walk is seen");
    before.facts.extend(sound.under_way());
    let resting = |here| MotionState::Rest { at: here };
    let (earlier, later) = (begin - Span::MICROSECOND, begin + Span::MICROSECOND);
    let no_number = |what| DriverFault::NoNumber { what };
    let vitals = Vitals { pulse: f64::NAN, respiration: 15.0 };
    let nonsense = [
        (segment(earlier, end, resting(here)), DriverFault::BeginsElsewhen { begin: earlier }),
        (segment(later, end, resting(here)), DriverFault::BeginsElsewhen { begin: later }),
        (segment(begin, begin, resting(here)), DriverFault::EndsTooSoon { end: begin }),
        (segment(begin, earlier, resting(here)), DriverFault::EndsTooSoon { end: earlier }),
        (segment(begin, RunTime::MIN, resting(here)), DriverFault::EndsTooSoon { end: RunTime::MIN }),
        (segment(begin, end, resting(at(f64::NAN, 2.0))), no_number("the place")),
        (segment(begin, end, MotionState::Stride { from: here, to: at(3.0, f64::INFINITY) }), no_number("the place")),
        (segment(begin, end, MotionState::InPlace { at: here, amplitude_m: -0.1 }), no_number("the amplitude")),
        (segment(begin, end, MotionState::InPlace { at: here, amplitude_m: f64::NAN }), no_number("the amplitude")),
        (Next::Vitals(vitals), no_number("the vitals")),
        (Next::Need(BodilyNeed::Thirst, f64::INFINITY), no_number("the level of a need")),
        (Next::Condition("flu".into(), f64::NAN), no_number("the severity of a condition")),
        (segment(begin, end, resting(at(1.0, 1.0))), DriverFault::Jump { from: here, to: at(1.0, 1.0) }),
        (
            segment(begin, end, MotionState::Stride { from: at(3.02, 2.0), to: here }),
            DriverFault::Jump { from: here, to: at(3.02, 2.0) },
        ),
        (
            segment(begin, end, MotionState::Stride { from: here, to: at(3.0, 30.0) }),
            DriverFault::Outside { at: at(3.0, 30.0) },
        ),
        (
            Next::Use(ThingUse { thing: ThingId(5), on: true }),
            DriverFault::NoSuchThing { thing: ThingId(5), things: 5 },
        ),
        (Next::Activity(None), DriverFault::NoEnd { answers: MOST_ANSWERS }),
    ];
    for (answer, fault) in nonsense {
        let (mut run, mut events, lived) = after_a_walk(answer.clone());
        let error = lived.expect_err(&format!("{answer:?}"));
        assert_eq!(error, DriverError { resident: "resident 1".into(), at: begin, fault }, "{answer:?}");
        let problem = error.diagnostic();
        assert!(problem.code.starts_with("driver::") && problem.hint.is_some(), "{problem:?}");
        assert_eq!((&problem.data["resident"], &problem.data["at_us"]), (&"resident 1".into(), &begin.micros().into()));
        // It stands at that instant, with all that was before, and goes no further.
        events.facts.retain(|fact| !matches!(fact, Fact::Activity { .. }));
        assert_eq!((run.now(), &events), (begin, &before), "{answer:?}");
        assert_eq!((run.advance(END, &mut events), run.failure()), (Err(error.clone()), Some(&error)));
        assert_eq!((run.now(), &events), (begin, &before), "{answer:?}");
        assert_eq!(run.clone().moves(), Err(error));
    }
}

#[test]
fn a_driver_that_fails_at_once_does_nothing() {
    let mut run = run(vec![says(Vec::new(), segment(seconds(0), seconds(0), MotionState::Away))]);
    let mut events = Events::default();
    let error = run.advance(END, &mut events).unwrap_err();
    assert_eq!((error.at, error.fault), (seconds(0), DriverFault::EndsTooSoon { end: seconds(0) }));
    assert_eq!((run.now(), events), (seconds(0), Events::default()));
}

#[test]
fn accepts_every_possible_step() {
    let (begin, end, here) = (seconds(10), RunTime::NEVER, at(3.0, 2.0));
    // Rounding is not a jump; a body in a wall or a door is inside.
    let close = at(3.005, 2.0);
    let away = segment(begin, seconds(20), MotionState::Away);
    let elsewhere = segment(seconds(20), end, MotionState::Rest { at: at(7.0, 1.0) });
    let sound = [
        vec![rest()],
        vec![segment(begin, end, MotionState::Rest { at: close })],
        vec![segment(begin, end, MotionState::Stride { from: here, to: at(3.0, 3.04) })],
        vec![segment(begin, end, MotionState::Stride { from: here, to: at(4.0, 1.5) })],
        vec![away, elsewhere],
    ];
    for mut answers in sound {
        let last = answers.pop().unwrap();
        let mut run = run(vec![says(walk().into_iter().chain(answers).collect(), last.clone())]);
        run.advance(END, &mut Events::default()).unwrap_or_else(|error| panic!("{last:?}: {error}"));
        assert_eq!((run.now(), run.failure()), (END, None));
    }
}

/// The view of a driver at an instant.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    now: RunTime,
    own: Option<(Point, Posture)>,
    others: Vec<(ResidentId, Point, Posture, Option<RoomId>)>,
    door: bool,
}

/// Stands for a second, sits for a second, and writes down what it sees.
#[derive(Clone, Debug)]
struct Watcher(Arc<Mutex<Vec<Seen>>>);

impl Driver for Watcher {
    fn next(&mut self, around: &Surroundings) -> Next {
        let begin = around.now();
        let others = around.others().map(|body| (body.resident, body.at, body.posture, around.room_at(body.at)));
        self.0.lock().unwrap().push(Seen {
            now: begin,
            own: around.body().map(|body| (body.at, body.posture)),
            others: others.collect(),
            door: around.is_on(ThingId::new(around.plan().thing("bedroom door").unwrap())),
        });
        assert!(!around.is_on(ThingId(100)), "what does not exist is not on");
        let posture = if begin.since_zero() / SECOND % 2 == 0 { Posture::Standing } else { Posture::Sitting };
        let doing = MotionState::Rest { at: at(1.0, 2.5) };
        Next::Segment(MotionSegment { begin, end: begin + SECOND, doing, posture })
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}

#[test]
fn a_driver_sees_the_state_of_the_home() {
    let door = |on| Next::Use(ThingUse { thing: ThingId(0), on });
    let arrives = RunTime::from_micros(12_345_678);
    // From room to room, the door shut behind, and out.
    let others = vec![
        segment(seconds(0), arrives, MotionState::Stride { from: at(1.0, 1.5), to: at(7.0, 1.5) }),
        door(false),
        segment(arrives, seconds(30), MotionState::InPlace { at: at(7.0, 1.5), amplitude_m: 0.1 }),
    ];
    let away = segment(seconds(30), RunTime::NEVER, MotionState::Away);
    let seen = Arc::new(Mutex::new(Vec::new()));
    let mut run = run(vec![Box::new(Watcher(seen.clone())), says(others, away)]);
    let mut scenes = Vec::new();
    for second in 0..60 {
        run.advance(seconds(second), &mut Events::default()).unwrap();
        let scene = run.scene();
        let body = |resident: usize| scene.bodies[resident].map(|body| (body.at, body.posture));
        scenes.push(Seen {
            now: scene.now,
            own: body(0),
            others: body(1).into_iter().map(|(at, posture)| (ResidentId(1), at, posture, None)).collect(),
            door: scene.on.contains(&ThingId(0)),
        });
    }
    run.advance(END, &mut Events::default()).unwrap();
    let mut seen = seen.lock().unwrap().clone();
    let rooms: Vec<_> = seen.iter_mut().map(|seen| seen.others.first_mut().and_then(|other| other.3.take())).collect();
    assert_eq!(seen, scenes);
    let in_the_kitchen = rooms.iter().filter(|&&room| room == Some(RoomId(0))).count();
    let in_the_bedroom = rooms.iter().filter(|&&room| room == Some(RoomId(1))).count();
    assert_eq!((in_the_kitchen, in_the_bedroom), (6, 24), "{rooms:?}");
    assert!(seen[12].door && !seen[13].door);
    assert!(seen[29].others.len() == 1 && seen[31].others.is_empty());
    assert_eq!((seen[0].own, seen[1].own), (None, Some((at(1.0, 2.5), Posture::Standing))));
    // The control: a second later it is not the same any more.
    assert!(seen[1..13].iter().zip(&scenes[2..]).all(|(seen, scene)| seen.others != scene.others));
}

/// A room with a resident under held keys.
fn by_keys() -> Run {
    let keys = LiveDriver::new(&HOME.plan, at(1.0, 2.0), 0.22, 0.6, KeyTrack::live());
    let mut run = Run::from_drivers(HOME.clone(), vec![Build::adult()], vec![Box::new(keys)], 1, HOUR);
    assert!(run.open_input(ResidentId(0)));
    run
}

fn movements(facts: impl IntoIterator<Item = Fact>) -> Vec<MotionSegment> {
    let movement = |fact| match fact {
        Fact::Movement { begin, end, doing, posture, .. } => Some(MotionSegment { begin, end, doing, posture }),
        _ => None,
    };
    facts.into_iter().filter_map(movement).collect()
}

#[test]
fn standing_still_under_held_keys_adds_no_truth() {
    let mut run = by_keys();
    let mut events = Events::default();
    let (stands, walks) = (seconds(600) + Span::from_micros(12_345), SECOND / 2);
    while run.now() < stands {
        // As a page does it, 60 times a second.
        run.advance(stands.min(run.now() + SECOND / 60), &mut events).unwrap();
    }
    let key = |key: Option<DriveKey>| Input { held: key.into_iter().collect(), ..Input::default() };
    run.input(ResidentId(0), key(Some(DriveKey::Right)));
    run.advance(stands + walks, &mut events).unwrap();
    run.input(ResidentId(0), key(None));
    run.advance(stands + stands.since_zero(), &mut events).unwrap();
    let mut told = movements(events.facts);
    let all_told = told.len();
    told.extend(movements(run.under_way()));
    // The first step of 1/60 s that begins after the key was pressed moves the body, to the microsecond.
    assert_eq!((told[0].begin, told[0].end), (seconds(0), RunTime::from_micros(600_016_666)));
    assert!(matches!(told[0].doing, MotionState::Rest { .. }));
    let strides = told.iter().filter(|next| matches!(next.doing, MotionState::Stride { .. })).count();
    assert_eq!((strides, told.len(), all_told), (30, 32, 31));
    assert!(told.windows(2).all(|pair| pair[0].end == pair[1].begin));
    assert_eq!(told.last().map(|last| last.end), Some(run.now()), "what is under way is told up to now");
    run.advance(RunTime::START + run.length(), &mut Events::default()).unwrap();
    assert_eq!(run.under_way().count(), 0);
}

#[test]
fn a_repeated_stay_is_one_movement() {
    let lying = |begin, end| MotionSegment {
        begin,
        end,
        doing: MotionState::InPlace { at: at(3.0, 2.0), amplitude_m: 0.1 },
        posture: Posture::Lying,
    };
    let life = |cuts: &[RunTime], postures: fn(usize) -> Posture| {
        let mut answers = walk();
        for (index, cut) in cuts.windows(2).enumerate() {
            answers.push(Next::Segment(MotionSegment { posture: postures(index), ..lying(cut[0], cut[1]) }));
        }
        let last = segment(*cuts.last().unwrap(), RunTime::NEVER, MotionState::Away);
        let mut run = run(vec![says(answers, last)]);
        let mut events = Events::default();
        run.advance(END, &mut events).unwrap();
        events
    };
    let cuts: Vec<RunTime> = (10..=40).map(seconds).collect();
    let whole = life(&[seconds(10), seconds(40)], |_| Posture::Lying);
    assert_eq!(life(&cuts, |_| Posture::Lying), whole);
    assert_eq!(movements(whole.facts).len(), 3);
    // The control: a turn from one posture to another is a change.
    let turning = |index: usize| if index.is_multiple_of(2) { Posture::Lying } else { Posture::Sitting };
    assert_eq!(movements(life(&cuts, turning).facts).len(), 2 + 30);
}
