//! The invariants with every fault, every chance and a shared channel.

use super::*;
use crate::random_home::{self, Dice, Model};
use homebody_core::calendar::Calendar;
use homebody_core::drivers::{Driver, Next, Surroundings};
use homebody_core::event::ThingUse;
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::home::form::HomeFile;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::{SensorId, ThingId};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::numbers::Numbers;
use homebody_core::plan::Plan;
use homebody_core::resident::Build;
use homebody_core::run::{DriverProvider, Guest, Run};
use homebody_core::scenario::ScenarioFile;
use homebody_core::scenario::load::Scenario;
use homebody_core::scenario::logger::LoggerFile;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

const CASES: u64 = 100;
const LENGTH: Span = SECOND.times(300);
const END: RunTime = RunTime::START.saturating_add(LENGTH);

/// Somebody who moves at random, and opens and closes the door as each move begins.
#[derive(Clone, Debug)]
struct Walker {
    life: Vec<MotionSegment>,
    door: u32,
    next: usize,
    has_acted: bool,
}

impl Driver for Walker {
    fn next(&mut self, around: &Surroundings) -> Next {
        self.has_acted = !self.has_acted;
        if self.has_acted {
            return Next::Use(ThingUse { thing: ThingId(self.door), on: self.next.is_multiple_of(2) });
        }
        self.next += 1;
        let next = self.life[self.next - 1].clone();
        assert_eq!(next.begin, around.now());
        Next::Segment(next)
    }

    fn copy(&self) -> Box<dyn Driver> {
        Box::new(self.clone())
    }
}

/// The bodies of a random home, who are all guests.
struct Walkers(u64);

impl DriverProvider for Walkers {
    fn guests(&self) -> Vec<Guest> {
        let guest = |build: Build| Guest { name: "somebody".into(), build };
        random_home::builds(self.0, 3).into_iter().map(guest).collect()
    }

    fn driver(&self, body: usize, home: &Arc<Home>, _seed: u64) -> Option<Box<dyn Driver>> {
        let mut life = random_home::life(self.0, body, home, LENGTH, 0.05);
        life.iter_mut().for_each(|next| next.doing = within(&home.plan, next.doing));
        let door = home.plan.thing("door")? as u32;
        Some(Box::new(Walker { life, door, next: 0, has_acted: false }))
    }
}

/// The same, but with the middle of a room for each place outside the home.
fn within(plan: &Plan, doing: MotionState) -> MotionState {
    let corners = &plan.rooms[0].outline;
    let middle = corners.iter().copied().sum::<Point>() / corners.len() as f64;
    let inside = |at: Point| if plan.distance_outside(at) > 0.1 { middle } else { at };
    match doing {
        MotionState::Stride { from, to } => MotionState::Stride { from: inside(from), to: inside(to) },
        MotionState::InPlace { at, amplitude_m } => MotionState::InPlace { at: inside(at), amplitude_m },
        MotionState::Rest { at } => MotionState::Rest { at: inside(at) },
        MotionState::Away => MotionState::Away,
    }
}

fn home(case: u64) -> HomeFile {
    with_contact(random_home::home(case, Model::Whole))
}

fn with_contact(mut home: HomeFile) -> HomeFile {
    let contact = json!({ "kind": "contact", "name": "contact", "on": "door" });
    home.sensors.push(serde_json::from_value(contact).unwrap());
    home
}

/// A link on which everything happens within five minutes.
fn everything(home: &HomeFile, radio: bool) -> serde_json::Value {
    let day = |seconds: f64| seconds / 86_400.0;
    let mut faults = vec![json!({ "kind": "outage", "from_day": day(150.0), "hours": 0.005 })];
    for (index, sensor) in home.sensors.iter().enumerate() {
        let sensor = sensor.name();
        faults.push(match (index, &home.sensors[index]) {
            (0, file) if file.orientation().is_some() && file.senses_motion() => {
                json!({ "kind": "moved", "sensor": sensor, "from_day": day(100.0), "at": [1, 0.05], "facing_deg": 80 })
            }
            (0 | 1, _) => json!({ "kind": "drift", "sensor": sensor, "ppm": 1000, "offset_s": -1.5 }),
            (2, _) => json!({ "kind": "battery", "sensor": sensor, "from_day": day(50.0), "fading_days": day(200.0) }),
            (3, _) => {
                json!({ "kind": "stuck", "sensor": sensor, "from_day": day(90.0), "days": day(60.0), "every_s": 7 })
            }
            (4, _) => json!({ "kind": "falls_off", "sensor": sensor, "from_day": day(200.0) }),
            _ => json!({ "kind": "bad_link", "sensor": sensor, "loss": 0.3 }),
        });
        if index == 1 {
            faults
                .push(json!({ "kind": "false_fires", "sensor": sensor, "per_h": 200, "between": ["00:01", "00:04"] }));
        }
    }
    let mut link = json!({ "preset": "zigbee", "delay_s": [0.01, 0.6], "loss": 0.05, "duplicates": 0.1,
        "corruption": 0.05, "misses": 0.05, "false_fires_per_h": 60, "faults": faults,
        "sensors": { (home.sensors[0].name()): { "loss": 0.2, "delay_s": [0, 2] } } });
    if radio {
        link["radio"] = json!({});
    }
    link
}

/// A run of a random home, its own length long.
fn run(case: u64, home: HomeFile, link: Option<serde_json::Value>, length: Span) -> Run {
    let file: ScenarioFile = serde_json::from_value(json!({ "name": "random", "start": "2009-03-02T00:00:00",
        "days": 1, "home": "home.json", "residents": [] }))
    .unwrap();
    let calendar = Calendar::new(&file.start, &file.time_zone).unwrap();
    let (logger, sources) = (LoggerFile::default(), BTreeMap::new());
    let link = link.map(link_file);
    let home = ResolvedHome::new(home).unwrap();
    let entry = "scenario.json".into();
    let scenario = Scenario { entry, file, home, link, logger, residents: Vec::new(), calendar, sources };
    Run::new(&scenario, &Walkers(case), case, length)
}

fn with_everything(case: u64) -> Run {
    let home = home(case);
    let link = everything(&home, true);
    run(case, home, Some(link), LENGTH)
}

fn lived(mut run: Run, cuts: &[RunTime]) -> Events {
    let mut events = Events::default();
    for cut in cuts {
        run.advance(*cut, &mut events).unwrap();
    }
    run.advance(RunTime::START + run.length(), &mut events).unwrap();
    events
}

#[test]
fn everything_happens() {
    let mut losses = BTreeMap::new();
    let mut whys = [0; 3];
    for case in 0..CASES {
        let events = lived(with_everything(case), &[]);
        for (.., loss) in lost(&events) {
            *losses.entry(loss).or_insert(0) += 1;
        }
        for provenance in causes(&events) {
            whys[match provenance.trigger {
                Trigger::Duplicate => 0,
                Trigger::False => 1,
                _ => 2,
            }] += 1;
        }
    }
    println!("{losses:?}, duplicates, false and real firings: {whys:?}");
    assert!(losses.len() == 8 && losses.values().all(|&count| count > 30), "{losses:?}");
    assert!(whys.iter().all(|&count| count > 300), "{whys:?}");
}

#[test]
fn speed_changes_nothing() {
    for case in 0..CASES {
        let whole = lived(with_everything(case), &[]);
        for step in [16_667, 83_333, 1_666_667].map(Span::from_micros) {
            let steps: Vec<RunTime> = (0..LENGTH / step).map(|index| RunTime::START + index * step).collect();
            assert_eq!(whole, lived(with_everything(case), &steps), "case {case}, steps of {step} microseconds");
        }
    }
}

#[test]
fn cutting_changes_nothing() {
    for case in 0..CASES {
        let whole = lived(with_everything(case), &[]);
        let dice = &mut Dice::new(case, "cuts");
        let mut cuts: Vec<RunTime> = (0..200).map(|_| dice.instant(LENGTH)).collect();
        // Exactly where something arrives or is sent, and one microsecond before and after.
        let arrived = whole.firings.iter().map(|firing| firing.at);
        let sent = lost(&whole).into_iter().map(|(at, ..)| at);
        cuts.extend(arrived.chain(sent).flat_map(|at| [at - Span::MICROSECOND, at, at + Span::MICROSECOND]));
        cuts.sort_unstable();
        assert_eq!(whole, lived(with_everything(case), &cuts), "case {case}");
    }
}

/// The negative control: a link with only its last input in memory takes the messages of others for silence.
#[test]
fn forgetting_what_is_under_way_does_change_something() {
    let mut changed = 0;
    for case in 0..20 {
        let home = home(case);
        let (file, sensors) = (link_file(json!({ "preset": "x10" })), home.sensors.clone());
        let mut said = lived(run(case, home, None, LENGTH), &[]);
        let link = Link::new(&file, &sensors, &Numbers::default(), Span::ZERO, case);
        let (mut whole, mut pieces) = (Events::default(), Events::default());
        for firing in &said.firings {
            let is_its = |fact: &&Fact| matches!(fact, Fact::Provenance { seq, .. } if *seq == firing.seq);
            let facts = vec![said.facts.iter().find(is_its).unwrap().clone()];
            let mut of_one = Events { firings: vec![*firing], facts, frames: Vec::new() };
            link.clone().carry(&mut of_one, firing.at + SECOND, &mut pieces);
        }
        link.clone().carry(&mut said, END + SECOND, &mut whole);
        changed += u32::from(times(&whole) != times(&pieces));
    }
    assert!(changed > 15, "only {changed} of 20 homes noticed");
}

#[test]
fn a_copy_of_the_run_continues_as_the_original() {
    for case in 0..CASES {
        let mut original = with_everything(case);
        original.advance(Dice::new(case, "copy").instant(LENGTH), &mut Events::default()).unwrap();
        let copy = original.clone();
        assert_eq!(lived(copy, &[]), lived(original, &[]), "case {case}");
    }
}

#[test]
fn a_stopped_run_reports_the_same_as_a_shorter_one() {
    for case in 0..CASES {
        let stop = Dice::new(case, "stop").instant(LENGTH);
        let mut stopped = Events::default();
        with_everything(case).advance(stop, &mut stopped).unwrap();
        let home = home(case);
        let link = everything(&home, true);
        assert_eq!(stopped.firings, lived(run(case, home, Some(link), stop.since_zero()), &[]).firings, "case {case}");
    }
}

#[test]
fn firings_are_in_order_numbered_and_no_later_than_settled() {
    for case in 0..CASES {
        let mut run = with_everything(case);
        let (mut all, mut settled) = (Events::default(), RunTime::MIN);
        while run.now() < END {
            let mut events = Events::default();
            run.advance(run.now() + SECOND / 2, &mut events).unwrap();
            assert!(events.firings.iter().all(|firing| firing.at >= settled), "case {case}");
            settled = run.settled();
            assert!(events.firings.iter().all(|firing| firing.at < settled), "case {case}");
            all.firings.extend(events.firings);
            all.facts.extend(events.facts);
        }
        assert!(all.firings.is_sorted_by_key(|firing| firing.at), "case {case}");
        assert!(all.firings.iter().enumerate().all(|(index, firing)| firing.seq == index as u64), "case {case}");
        let causes = all.facts.iter().filter_map(|fact| match fact {
            Fact::Provenance { seq, .. } => Some(*seq),
            _ => None,
        });
        assert!(causes.eq(0..all.firings.len() as u64), "case {case}");
        let listed = run.sensors().len() as u32;
        assert!(all.firings.iter().all(|firing| firing.sensor < SensorId(listed)), "case {case}");
    }
}

#[test]
fn a_perfect_link_changes_no_firing() {
    for case in 0..CASES {
        let plain = lived(run(case, home(case), None, LENGTH), &[]);
        let perfect = lived(run(case, home(case), Some(json!({})), LENGTH), &[]);
        assert_eq!((&plain.firings, causes(&plain)), (&perfect.firings, causes(&perfect)), "case {case}");
        assert_eq!(lost(&perfect), []);
    }
}

/// The fate of each sensor's own messages: the numbers that the logger got or never had, without copies and false ones.
fn accounted(events: &Events, sensor: u32, before: RunTime) -> usize {
    let own = |provenance: &Provenance| {
        !matches!(provenance.trigger, Trigger::Duplicate | Trigger::False) && provenance.seen_at < before
    };
    let received = events.firings.iter().zip(causes(events));
    let received = received.filter(|(firing, provenance)| firing.sensor == SensorId(sensor) && own(provenance)).count();
    let lost = events.facts.iter().filter(|fact| match fact {
        Fact::Lost { sensor: of, provenance, .. } => *of == SensorId(sensor) && own(provenance),
        _ => false,
    });
    received + lost.count()
}

#[test]
fn every_message_is_received_or_lost() {
    for case in 0..CASES {
        let home = home(case);
        let mut link = everything(&home, true);
        // A damaged id would be another sensor's, a moved sensor has other messages, and the last ones are under way.
        link["corruption"] = json!(0);
        link["faults"].as_array_mut().unwrap().retain(|fault| fault["kind"] != "moved");
        let sensors = home.sensors.len() as u32;
        let before = END - 20 * SECOND;
        let sent = lived(run(case, home.clone(), None, LENGTH), &[]);
        let events = lived(run(case, home, Some(link), LENGTH), &[]);
        for sensor in 0..sensors {
            let accounted = accounted(&events, sensor, before);
            assert_eq!(accounted, self::accounted(&sent, sensor, before), "case {case}, sensor {sensor}");
        }
    }
}

/// The messages of these sensors, received or lost, without damaged ids: one more sensor is one more id for damage.
fn fates(events: &Events, first: u32) -> BTreeSet<(RunTime, u32, String)> {
    let received = events.firings.iter().map(|firing| (firing.at, firing.sensor.0, firing.value.to_string()));
    let lost = lost(events).into_iter().filter(|(.., loss)| *loss != Loss::Garbled);
    let all = received.chain(lost.map(|(at, sensor, loss)| (at, sensor, format!("{loss:?}"))));
    all.filter(|(_, sensor, _)| *sensor >= first).map(|(at, sensor, what)| (at, sensor - first, what)).collect()
}

/// In how many homes one sensor more changes what becomes of the others' messages.
fn changed_by_another_sensor(radio: bool) -> u64 {
    (0..CASES)
        .filter(|&case| {
            // Among many sensors, a damaged id is often that of another.
            let home = with_contact(random_home::crowded(case, Model::Whole, 0));
            let link = everything(&home, radio);
            let mut more = home.clone();
            let mut added = random_home::home(case + 1_000_000, Model::Whole).sensors.remove(0);
            *added.name_mut() = "added".into();
            more.sensors.insert(0, added);
            let before = lived(run(case, home, Some(link.clone()), LENGTH), &[]);
            // Its damaged ids would be those of others.
            let mut link = link;
            link["sensors"]["added"] = json!({ "corruption": 0 });
            let after = lived(run(case, more, Some(link), LENGTH), &[]);
            fates(&before, 0) != fates(&after, 1)
        })
        .count() as u64
}

#[test]
fn adding_a_sensor_changes_no_other() {
    assert_eq!(changed_by_another_sensor(false), 0);
}

/// The one exception, and the control: on a channel that they share, sensors do get in each other's way.
#[test]
fn adding_a_sensor_to_a_channel_does_change_others() {
    let changed = changed_by_another_sensor(true);
    assert!(changed > CASES / 4, "only {changed} of {CASES} homes noticed");
}

#[test]
fn a_moved_sensor_sees_from_where_it_hangs() {
    let mut changed = 0;
    for case in 0..CASES {
        let mut file = home(case);
        // A camera takes another picture if the sensor fires from elsewhere.
        file.sensors.retain(|sensor| sensor.camera().is_none());
        let mut elsewhere = file.clone();
        let Some(sensor) = elsewhere.sensors.first_mut() else { continue };
        if !sensor.relocate([1.0, 0.05], 80.0) {
            continue;
        }
        let moved = json!({ "faults": [{ "kind": "moved", "sensor": sensor.name(), "from_day": 100.0 / 86_400.0,
            "at": [1, 0.05], "facing_deg": 80 }] });
        let here = lived(run(case, file.clone(), None, LENGTH), &[]).firings;
        let there = lived(run(case, elsewhere, None, LENGTH), &[]).firings;
        let events = lived(run(case, file, Some(moved), LENGTH), &[]);
        assert_eq!(lost(&events), []);
        // Firings of one instant may come in another order.
        let fired = |firings: &[Firing], from: RunTime, to: RunTime| -> BTreeSet<_> {
            let within = firings.iter().filter(|firing| (from..to).contains(&firing.at));
            within.map(|firing| (firing.at, firing.sensor, firing.value)).collect()
        };
        let (start, half) = (RunTime::START, RunTime::START + 100 * SECOND);
        assert_eq!(fired(&events.firings, start, half), fired(&here, start, half), "case {case}");
        assert_eq!(fired(&events.firings, half, END), fired(&there, half, END), "case {case}");
        changed += u32::from(fired(&here, half, END) != fired(&there, half, END));
    }
    assert!(changed > 20, "only {changed} homes noticed");
}
