//! Sensors that are informed of acts: their messages and the times of these.

use homebody_core::event::{Events, Fact, ThingUse, Trigger, Value, Vitals};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::{ResidentId, ThingId};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::resident::Build;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_core::world::World;
use serde_json::json;
use std::sync::Arc;

/// Something that happens at an instant, in seconds.
enum Happens {
    Body(MotionState, Posture),
    Vitals(f64, f64),
    Act(&'static str, bool),
}
use Happens::{Body, Vitals as Feels};
use Posture::{Lying, Sitting, Standing};

const IN_BED: Point = Point::new(1.0, 1.0);
const BESIDE: Point = Point::new(3.0, 1.0);
const AWAY: Happens = Body(MotionState::Away, Standing);

fn rest(at: Point, posture: Posture) -> Happens {
    Body(MotionState::Rest { at }, posture)
}

fn stir(at: Point) -> Happens {
    Body(MotionState::InPlace { at, amplitude_m: 0.2 }, Lying)
}

fn stride(from: Point, to: Point) -> Happens {
    Body(MotionState::Stride { from, to }, Standing)
}

/// A room of 8 by 6 m with a bed from (0, 0) to (2, 2), an armchair around (5, 1), a rug around (5, 3), and a stove.
fn home(sensor: serde_json::Value) -> Home {
    let mut sensor = sensor;
    sensor.as_object_mut().unwrap().insert("name".into(), json!("it"));
    let file = json!({
        "name": "one room",
        "rooms": [{ "name": "room", "outline": [[0, 0], [8, 0], [8, 6], [0, 6]] }],
        "walls": [],
        "furniture": [
            { "name": "bed", "at": [1, 1], "size_m": [2, 2], "height_m": 0.5, "enterable": true },
            { "name": "armchair", "at": [5, 1], "size_m": [1, 1], "height_m": 0.4, "enterable": true },
            { "name": "rug", "at": [5, 3], "size_m": [2, 1], "height_m": 0.01, "enterable": true },
            { "name": "stove", "at": [7, 5], "size_m": [0.6, 0.6], "height_m": 0.9 },
        ],
        "sensors": [sensor],
    });
    let build = Build { radius_m: 0.2, height_m: 1.7 };
    Home::bake(&ResolvedHome::new(serde_json::from_value(file).unwrap()).unwrap(), &[build, build])
}

/// The messages of the sensor until `until`: instants, values, and residents. Bodies continue until their next
/// movement; at `cuts`, in seconds, all movements are reported again.
fn said(
    home: Home,
    happens: &[(f64, usize, Happens)],
    until: f64,
    cuts: &[f64],
) -> Vec<(RunTime, Value, Option<ResidentId>, RunTime, Trigger)> {
    let instant = |seconds: f64| RunTime::START + Span::from_seconds(seconds);
    let mut world = World::new(Arc::new(home), 2, 1);
    let mut events = Events::default();
    let mut doing: [Option<MotionSegment>; 2] = [None, None];
    let mut instants: Vec<RunTime> = happens.iter().map(|(at, ..)| instant(*at)).collect();
    instants.extend(cuts.iter().map(|&cut| instant(cut)));
    instants.push(instant(until));
    instants.sort_unstable();
    instants.dedup();
    for at in instants {
        world.advance(at, &mut events);
        for (_, who, what) in happens.iter().filter(|(happens, ..)| instant(*happens) == at) {
            match what {
                Happens::Act(name, on) => {
                    let thing = ThingId::new(world.home().plan.thing(name).unwrap());
                    world.act(Some(ResidentId::new(*who)), ThingUse { thing, on: *on });
                }
                Feels(pulse, respiration) => {
                    world.feel(ResidentId::new(*who), Vitals { pulse: *pulse, respiration: *respiration });
                }
                Body(does, posture) => {
                    let later = happens.iter().filter(|(later, other, what)| {
                        other == who && instant(*later) > at && matches!(what, Body(..))
                    });
                    let end = later.map(|(later, ..)| instant(*later)).min().unwrap_or(instant(until));
                    doing[*who] = Some(MotionSegment { begin: at, end, doing: *does, posture: *posture });
                }
            }
        }
        for (who, next) in doing.iter().enumerate() {
            if let Some(next) = next
                && (next.begin == at || cuts.iter().any(|&cut| instant(cut) == at))
            {
                world.begin(ResidentId::new(who), next);
            }
        }
    }
    let causes = events
        .facts
        .iter()
        .filter_map(|fact| if let Fact::Provenance { provenance, .. } = fact { Some(provenance) } else { None });
    let firings = events.firings.iter().zip(causes);
    firings
        .map(|(firing, provenance)| {
            (firing.at, firing.value, provenance.resident, provenance.seen_at, provenance.trigger)
        })
        .collect()
}

/// The same, without causes, and in seconds; cut or not, which changes nothing.
fn says(sensor: serde_json::Value, happens: &[(f64, usize, Happens)], until: f64) -> Vec<(f64, Value)> {
    let whole = said(home(sensor.clone()), happens, until, &[]);
    let mut cuts: Vec<f64> = (0..200).map(|cut| until * f64::from(cut) / 200.0).collect();
    for (at, _, _, seen_at, _) in &whole {
        for around in [-Span::MICROSECOND, Span::ZERO, Span::MICROSECOND] {
            cuts.extend([*at + around, *seen_at + around].map(|at| at.max(RunTime::START).seconds()));
        }
    }
    assert_eq!(whole, said(home(sensor), happens, until, &cuts), "cutting has changed something");
    whole.into_iter().map(|(at, value, ..)| (at.seconds(), value)).collect()
}

fn bed() -> serde_json::Value {
    // No vitals, which have tests of their own.
    json!({ "kind": "bed", "on": "bed", "still_s": 3600 })
}

#[test]
fn a_bed_says_who_sits_or_lies_in_it_and_not_who_walks_or_stands_there() {
    let happens = [
        (0.0, 0, stride(BESIDE, IN_BED)),
        (2.0, 0, rest(IN_BED, Standing)),
        (3.0, 0, rest(IN_BED, Sitting)),
        (4.0, 0, rest(IN_BED, Lying)),
        (5.0, 0, rest(BESIDE, Lying)),
        (6.0, 0, rest(IN_BED, Lying)),
        (9.0, 0, stride(IN_BED, BESIDE)),
    ];
    let expected = [(3.0, Value::In), (5.0, Value::Out), (6.0, Value::In), (9.0, Value::Out)];
    assert_eq!(says(bed(), &happens, 20.0), expected);
}

#[test]
fn a_bed_with_two_in_it_is_left_when_both_have_left() {
    let happens = [
        (0.0, 0, rest(BESIDE, Standing)),
        (1.0, 1, rest(IN_BED, Lying)),
        (2.0, 0, rest(IN_BED, Lying)),
        (3.0, 1, AWAY),
        (4.0, 0, rest(BESIDE, Sitting)),
        // One comes at the instant at which the other leaves.
        (5.0, 1, rest(IN_BED, Lying)),
        (6.0, 0, rest(IN_BED, Lying)),
        (6.0, 1, AWAY),
        (7.0, 0, AWAY),
    ];
    let whole = said(home(bed()), &happens, 20.0, &[]);
    let whole: Vec<_> =
        whole.into_iter().map(|(at, value, by, ..)| (at.since_zero() / SECOND, value, by.map(|by| by.0))).collect();
    let expected =
        [(1, Value::In, Some(1)), (4, Value::Out, Some(0)), (5, Value::In, Some(1)), (7, Value::Out, Some(0))];
    assert_eq!(whole, expected);
    assert_eq!(says(bed(), &happens, 20.0).len(), 4);
}

#[test]
fn restlessness_goes_by_how_long_a_movement_persists() {
    let happens = [
        (0.0, 0, rest(IN_BED, Lying)),
        // Two stirs at once after each other: 10 s of movement.
        (10.0, 0, stir(IN_BED)),
        (15.0, 0, stir(IN_BED + Point::X * 0.1)),
        (20.0, 0, rest(IN_BED, Lying)),
        // 6 s, not more: it is over when it would be the third level.
        (30.0, 0, stir(IN_BED)),
        (36.0, 0, rest(IN_BED, Lying)),
        // A body that sits, or lies elsewhere, is not restless.
        (40.0, 0, Body(MotionState::InPlace { at: IN_BED, amplitude_m: 0.2 }, Sitting)),
        (50.0, 0, stir(BESIDE)),
    ];
    let level = |level| Value::Restless(level);
    let expected = [
        (0.0, Value::In),
        (10.0, level(1)),
        (13.0, level(2)),
        (16.0, level(3)),
        (19.0, level(4)),
        (30.0, level(1)),
        (33.0, level(2)),
        (50.0, Value::Out),
    ];
    assert_eq!(says(bed(), &happens, 60.0), expected);
}

#[test]
fn the_movement_of_either_of_two_is_one_movement() {
    let happens = [
        (0.0, 0, rest(IN_BED, Lying)),
        (0.0, 1, rest(IN_BED, Lying)),
        (10.0, 1, stir(IN_BED)),
        // The one begins as the other ends.
        (12.0, 0, stir(IN_BED)),
        (12.0, 1, rest(IN_BED, Lying)),
        (14.0, 0, rest(IN_BED, Lying)),
        (20.0, 0, stir(IN_BED)),
        (22.0, 0, rest(IN_BED, Lying)),
        (22.0, 1, stir(IN_BED)),
        (24.0, 1, rest(IN_BED, Lying)),
    ];
    let expected = [
        (0.0, Value::In),
        (10.0, Value::Restless(1)),
        (13.0, Value::Restless(2)),
        (20.0, Value::Restless(1)),
        (23.0, Value::Restless(2)),
    ];
    assert_eq!(says(bed(), &happens, 60.0), expected);
}

#[test]
fn vitals_are_read_of_who_keeps_still_every_so_often_and_at_a_change_of_class() {
    use homebody_core::event::Band::{High, Low, Normal};
    let sensor = json!({ "kind": "bed", "on": "bed", "vitals_every_s": 300 });
    let happens = [
        (0.0, 0, rest(IN_BED, Lying)),
        // Before the first reading.
        (50.0, 0, stir(IN_BED)),
        (52.0, 0, rest(IN_BED, Lying)),
        // Over the second, at 112 + 300.
        (400.0, 0, stir(IN_BED)),
        (415.0, 0, rest(IN_BED, Lying)),
        (500.0, 0, Feels(130.0, 15.0)),
        // Nothing new.
        (510.0, 0, Feels(131.0, 15.0)),
        (520.0, 0, stir(IN_BED)),
        (530.0, 0, Feels(60.0, 2.0)),
        (532.0, 0, rest(IN_BED, Lying)),
        (700.0, 0, AWAY),
    ];
    let both = |at: f64, pulse, respiration| [(at, Value::Pulse(pulse)), (at, Value::Respiration(respiration))];
    let expected =
        [both(112.0, Normal, Normal), both(475.0, Normal, Normal), both(500.0, High, Normal), both(592.0, Normal, Low)];
    let vitals = says(sensor, &happens, 800.0);
    let vitals: Vec<_> =
        vitals.into_iter().filter(|(_, v)| matches!(v, Value::Pulse(_) | Value::Respiration(_))).collect();
    assert_eq!(vitals, expected.concat());
}

#[test]
fn vitals_are_those_of_who_came_first() {
    use homebody_core::event::Band::{High, Low};
    let sensor = json!({ "kind": "bed", "on": "bed", "vitals_every_s": 1000 });
    let happens = [
        (0.0, 0, Feels(130.0, 2.0)),
        (0.0, 1, Feels(15.0, 50.0)),
        (1.0, 1, rest(IN_BED, Lying)),
        (2.0, 0, rest(IN_BED, Lying)),
        (200.0, 1, AWAY),
    ];
    let expected = [
        (1.0, Value::In),
        (61.0, Value::Pulse(Low)),
        (61.0, Value::Respiration(High)),
        (260.0, Value::Pulse(High)),
        (260.0, Value::Respiration(Low)),
    ];
    assert_eq!(says(sensor, &happens, 800.0), expected);
}

#[test]
fn readings_scatter_about_the_truth() {
    use homebody_core::event::Band::{High, Normal};
    // The truth is at the limit, so half of the readings are beyond; of the respiration, with a deviation of 1, a sixth.
    let sensor = json!({ "kind": "bed", "on": "bed", "vitals_every_s": 1, "still_s": 0 });
    let happens = [(0.0, 0, Feels(100.0, 29.0)), (0.0, 0, rest(IN_BED, Lying))];
    let values: Vec<Value> =
        said(home(sensor), &happens, 4000.0, &[]).into_iter().map(|(_, value, ..)| value).collect();
    let count = |wanted| values.iter().filter(|&&value| value == wanted).count();
    assert_eq!(count(Value::Pulse(High)) + count(Value::Pulse(Normal)), 4000);
    assert!((1_850..2_150).contains(&count(Value::Pulse(High))), "{}", count(Value::Pulse(High)));
    assert!((560..710).contains(&count(Value::Respiration(High))), "{}", count(Value::Respiration(High)));
}

#[test]
fn a_stove_is_hot_and_cool_when_the_closed_form_says() {
    let happens = [(5.0, 0, Happens::Act("stove", true)), (605.0, 1, Happens::Act("stove", false))];
    let found = said(home(json!({ "kind": "stove_temperature", "on": "stove" })), &happens, 7200.0, &[]);
    let thing = ThingId(3);
    // 240 ln(158 / 135); then from 180 - 158 exp(-2.5), 1200 ln((that - 22) / 16).
    let on = 5.0 + 240.0 * libm::log(158.0 / 135.0);
    let off = 605.0 + 1200.0 * libm::log((158.0 - 158.0 * libm::exp(-2.5)) / 16.0);
    let at = |seconds: f64| RunTime::START + Span::from_seconds(seconds);
    let expected = [
        (at(on), Value::On, Some(ResidentId(0)), at(5.0), Trigger::Use(thing)),
        (at(off), Value::Off, Some(ResidentId(1)), at(605.0), Trigger::Use(thing)),
    ];
    assert_eq!(found, expected);
    let with_readings =
        says(json!({ "kind": "stove_temperature", "on": "stove", "readings_every_s": 60 }), &happens, 7200.0);
    assert!(with_readings.len() > 40);
}

#[test]
fn a_chair_feels_who_sits_in_it_alone() {
    let chair = Point::new(5.0, 1.0);
    let happens = [
        (0.0, 0, stride(BESIDE, Point::new(7.0, 1.0))),
        (4.0, 0, stride(Point::new(7.0, 1.0), chair)),
        (6.0, 0, rest(chair, Sitting)),
        (8.0, 0, Body(MotionState::InPlace { at: chair, amplitude_m: 0.1 }, Sitting)),
        (9.0, 0, rest(chair, Standing)),
    ];
    let sensor = json!({ "kind": "pressure", "on": "armchair" });
    assert_eq!(says(sensor, &happens, 20.0), [(6.0, Value::On), (9.0, Value::Off)]);
}

#[test]
fn a_mat_is_pressed_from_where_a_stride_enters_to_where_it_leaves() {
    // The rug lies from x = 4 to 6 and y = 2.5 to 3.5. At 1 m/s from x = 1: from 3 to 5 s.
    let along = |y: f64| {
        [(0.0, 0, stride(Point::new(1.0, y), Point::new(7.0, y))), (6.0, 0, rest(Point::new(7.0, y), Sitting))]
    };
    let rug = json!({ "kind": "pressure", "on": "rug" });
    let area = json!({ "kind": "pressure", "area": [[4, 2.5], [6, 2.5], [6, 3.5], [4, 3.5]] });
    for mat in [rug, area.clone()] {
        assert_eq!(says(mat.clone(), &along(3.0), 20.0), [(3.0, Value::On), (5.0, Value::Off)]);
        assert_eq!(says(mat, &along(2.0), 20.0), []);
    }
    // On a slant, to a third of a microsecond: from x = 1 to 8 in 7 s it enters at 3, but y is 2.5 only at 7 * 2.5 / 5.3.
    let slant = [(0.0, 0, stride(Point::new(1.0, 0.0), Point::new(8.0, 5.3))), (7.0, 0, AWAY)];
    let found = said(home(area.clone()), &slant, 20.0, &[]);
    let found: Vec<_> =
        found.into_iter().map(|(at, value, _, seen_at, _)| (at.micros(), value, seen_at.micros())).collect();
    assert_eq!(found, [(3_301_887, Value::On, 3_301_887), (4_622_642, Value::Off, 4_622_642)]);
    // A body that stays on it presses it all the while, over several moves.
    let stays = [
        (0.0, 0, stride(Point::new(1.0, 3.0), Point::new(5.0, 3.0))),
        (4.0, 0, rest(Point::new(5.0, 3.0), Standing)),
        (8.0, 0, stride(Point::new(5.0, 3.0), Point::new(5.5, 3.0))),
        (8.5, 0, stride(Point::new(5.5, 3.0), Point::new(5.5, 5.0))),
        (10.5, 0, AWAY),
    ];
    assert_eq!(says(area, &stays, 20.0), [(3.0, Value::On), (9.0, Value::Off)]);
}

/// The negative control: who looks where a body is four times a second presses a mat late, and misses a narrow one.
#[test]
fn looking_at_samples_does_change_a_mat() {
    let (from, to) = (Point::new(0.1, 3.0), Point::new(7.1, 3.0));
    let whole = [(0.0, 0, stride(from, to)), (3.5, 0, AWAY)];
    let samples = (0..14).map(|sample| f64::from(sample) * 0.25);
    let sampled: Vec<_> =
        samples.map(|at| (at, 0, rest(from + (to - from) * (at / 3.5), Standing))).chain([(3.5, 0, AWAY)]).collect();
    let narrow = json!({ "kind": "pressure", "area": [[4.2, 2.5], [4.5, 2.5], [4.5, 3.5], [4.2, 3.5]] });
    assert_eq!(says(narrow.clone(), &whole, 9.0), [(2.05, Value::On), (2.2, Value::Off)]);
    assert_eq!(says(narrow, &sampled, 9.0), []);
}

#[test]
fn a_mat_under_two_is_free_when_both_are_off() {
    let area = json!({ "kind": "pressure", "area": [[4, 2.5], [6, 2.5], [6, 3.5], [4, 3.5]] });
    let walk = |from, who| {
        [
            (from, who, stride(Point::new(1.0, 3.0), Point::new(7.0, 3.0))),
            (from + 6.0, who, rest(Point::new(7.0, 3.0), Standing)),
        ]
    };
    let happens: Vec<_> = walk(0.0, 0).into_iter().chain(walk(1.0, 1)).collect();
    assert_eq!(says(area.clone(), &happens, 20.0), [(3.0, Value::On), (6.0, Value::Off)]);
    // The second comes as the first leaves.
    let happens: Vec<_> = walk(0.0, 1).into_iter().chain(walk(2.0, 0)).collect();
    assert_eq!(says(area, &happens, 20.0), [(3.0, Value::On), (7.0, Value::Off)]);
}

#[test]
fn a_delay_waits_for_what_lasts() {
    let chair = Point::new(5.0, 1.0);
    let (sits, stands) = (|| rest(chair, Sitting), || rest(chair, Standing));
    // Pressed for 3 s from 10, but for 2 s only from 0; free for 2 s from 20, and from 30 on.
    let happens = [
        (0.0, 0, sits()),
        (2.0, 0, stands()),
        (10.0, 0, sits()),
        (20.0, 0, stands()),
        (22.0, 0, sits()),
        (30.0, 0, stands()),
    ];
    let sensor = json!({ "kind": "pressure", "on": "armchair", "delay_s": 2 });
    assert_eq!(says(sensor, &happens, 60.0), [(12.0, Value::On), (32.0, Value::Off)]);
}

#[test]
fn a_lamp_is_seen_and_metered_at_once() {
    let happens = [(0.0, 0, AWAY), (700.5, 1, Happens::Act("room", true)), (900.0, 1, Happens::Act("room", false))];
    // The run begins at midnight.
    let light = says(json!({ "kind": "light", "room": "room" }), &happens, 3000.0);
    assert_eq!(light[1..], [(700.5, Value::Reading(150_000)), (900.0, Value::Reading(0))]);
    assert!(light[0].0 < 600.0 && light[0].1 == Value::Reading(0));
    let power = says(json!({ "kind": "power", "on": "room" }), &happens, 3000.0);
    assert_eq!(power, [(700.5, Value::On), (900.0, Value::Off)]);
}

#[test]
fn messages_of_one_instant_are_in_the_order_of_sensors() {
    let file = json!({
        "name": "one room",
        "rooms": [{ "name": "room", "outline": [[0, 0], [8, 0], [8, 6], [0, 6]] }],
        "walls": [],
        "furniture": [
            { "name": "fridge", "at": [1, 1], "size_m": [1, 1], "height_m": 2 },
            { "name": "sink", "at": [3, 1], "size_m": [1, 1], "height_m": 0.9 },
        ],
        "sensors": [
            { "kind": "flow", "name": "a", "on": "sink" },
            { "kind": "contact", "name": "b", "on": "fridge" },
        ],
    });
    let build = Build { radius_m: 0.2, height_m: 1.7 };
    let home = Home::bake(&ResolvedHome::new(serde_json::from_value(file).unwrap()).unwrap(), &[build, build]);
    let happens = [
        (1.0, 0, Happens::Act("fridge", true)),
        (1.0, 0, Happens::Act("fridge", false)),
        (1.0, 0, Happens::Act("sink", true)),
    ];
    let found: Vec<Value> = said(home, &happens, 2.0, &[]).into_iter().map(|(_, value, ..)| value).collect();
    assert_eq!(found, [Value::On, Value::Open, Value::Close]);
}
