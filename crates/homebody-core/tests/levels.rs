//! The movement that a wall sensor detects at each level, in a room of 12 by 8 metres with one lens at the origin of x, in the middle of
//! its western side. Expected instants are computed by hand.

use homebody_core::event::{Events, Fact};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::home::form::HomeFile;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::ResidentId;
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::plan::Plan;
use homebody_core::posture::Posture;
use homebody_core::resident::Build;
use homebody_core::time::{RunTime, Span};
use homebody_core::world::World;
use serde_json::{Value, json};
use std::sync::Arc;

/// No instants.
const NONE: [i64; 0] = [];

/// Somebody's moves, one after another.
struct Life(Vec<MotionSegment>);

impl Life {
    fn new() -> Life {
        Life(Vec::new())
    }

    fn then(mut self, seconds: f64, posture: Posture, doing: MotionState) -> Life {
        let begin = self.end();
        self.0.push(MotionSegment { begin, end: begin + Span::from_seconds(seconds), doing, posture });
        self
    }

    fn end(&self) -> RunTime {
        self.0.last().map_or(RunTime::START, |last| last.end)
    }

    fn rest(self, seconds: f64, posture: Posture, at: (f64, f64)) -> Life {
        self.then(seconds, posture, MotionState::Rest { at: at.into() })
    }

    fn stir(self, seconds: f64, posture: Posture, at: (f64, f64), amplitude_m: f64) -> Life {
        self.then(seconds, posture, MotionState::InPlace { at: at.into(), amplitude_m })
    }

    fn walk(self, pace_mps: f64, from: (f64, f64), to: (f64, f64)) -> Life {
        let (from, to) = (Point::from(from), Point::from(to));
        self.then(from.distance(to) / pace_mps, Posture::Standing, MotionState::Stride { from, to })
    }
}

/// When the sensor notices movement, in microseconds, and whose. It looks again 10 ms after each time.
fn noticed(sensor: &Value, lives: &[Life]) -> Vec<(i64, u32)> {
    let file = json!({
        "name": "home", "walls": [],
        "rooms": [{ "name": "room", "outline": [[0, 0], [12, 0], [12, 8], [0, 8]] }],
    });
    noticed_in(file, sensor, lives)
}

/// The same in a home of 12 by 8 metres.
fn noticed_in(mut file: Value, sensor: &Value, lives: &[Life]) -> Vec<(i64, u32)> {
    // The lens stands 2 cm off the wall: at (0, 4).
    file["sensors"] = json!([{
        "name": "sensor", "kind": "motion", "at": [-0.02, 4], "facing_deg": 0,
        "first_fire_s": [0, 0], "refire_s": [0.01, 0.01], "persist_s": 0,
    }]);
    let fields = file["sensors"][0].as_object_mut().expect("an object");
    fields.extend(sensor.as_object().expect("an object").clone());
    let file: HomeFile = serde_json::from_value(file).expect("a home");
    let builds = vec![Build { radius_m: 0.2, height_m: 1.65 }; lives.len()];
    let home = Home::bake(&ResolvedHome::new(file).unwrap(), &builds);
    let mut world = World::new(Arc::new(home), lives.len(), 1);
    let mut events = Events::default();
    let end = lives.iter().map(Life::end).min().unwrap_or_default();
    while world.now() < end {
        let now = world.now();
        let mut until = end;
        for (resident, life) in lives.iter().enumerate() {
            let next = &life.0[life.0.partition_point(|next| next.end <= now)];
            if next.begin == now {
                world.begin(ResidentId::new(resident), next);
            }
            until = until.min(next.end);
        }
        world.advance(until, &mut events);
    }
    let provenance = |fact| match fact {
        Fact::Provenance { provenance, .. } => Some((provenance.seen_at.micros(), provenance.resident?.0)),
        _ => None,
    };
    events.facts.into_iter().filter_map(provenance).collect()
}

fn alone(sensor: &Value, life: Life) -> Vec<i64> {
    noticed(sensor, &[life]).into_iter().map(|(at, _)| at).collect()
}

/// One beam due east.
fn beam(level: Value) -> Value {
    json!({ "beams": 1, "level": level })
}

fn sensitive() -> Value {
    beam(json!({ "sensitivity": { "threshold_deg": 3 } }))
}

/// Zones at -45, 0 and 45 degrees, the outer ones positive, as high as the body: from the lens to 5 m.
fn zones(pulses: u32, window_s: f64) -> Value {
    json!({
        "height_m": 1.65, "field_deg": [90, 50], "reach_m": 5,
        "level": { "zones": { "rows": [3, 0, 0], "pulses": pulses, "window_s": window_s } },
    })
}

#[test]
fn a_stir_is_noticed_only_where_it_spans_the_threshold() {
    let stir = |sensor: &Value, x: f64, amplitude_m: f64| {
        let life = Life::new().rest(5.0, Posture::Standing, (x, 4.0));
        alone(sensor, life.stir(2.0, Posture::Standing, (x, 4.0), amplitude_m)).first().copied()
    };
    // 0.3 / tan 3 = 5.724 m, 0.5 / tan 3 = 9.541 m.
    assert_eq!(stir(&sensitive(), 5.72, 0.3), Some(5_000_000));
    assert_eq!(stir(&sensitive(), 5.73, 0.3), None);
    assert_eq!(stir(&sensitive(), 9.54, 0.5), Some(5_000_000));
    assert_eq!(stir(&sensitive(), 9.55, 0.5), None);
    // At the level of the paper the far one is noticed, too.
    assert_eq!(stir(&beam(json!("paper")), 9.55, 0.3), Some(5_000_000));
}

#[test]
fn an_approach_is_noticed_from_where_a_second_of_it_spans_the_threshold() {
    // A second at 0.3 m/s spans 3 degrees at 0.3 / tan 3 = 5.724341 m: (9 - 5.724341) / 0.3 = 10.918863 s from 9 m.
    let toward = alone(&sensitive(), Life::new().walk(0.3, (9.0, 4.0), (3.0, 4.0)));
    assert_eq!(toward.first(), Some(&10_918_864));
    // And the other way until (5.724341 - 3) / 0.3 = 9.081137 s; it looks every 10 ms.
    let away = alone(&sensitive(), Life::new().walk(0.3, (3.0, 4.0), (9.0, 4.0)));
    assert_eq!(away.first(), Some(&0));
    assert!(away.last().is_some_and(|&last| (9_071_136..=9_081_136).contains(&last)), "{:?}", away.last());
}

#[test]
fn a_slow_walk_across_is_noticed_near_and_not_far() {
    let across =
        |pace_mps: f64, x: f64| alone(&sensitive(), Life::new().walk(pace_mps, (x, 3.0), (x, 5.0))).first().copied();
    // The body is at the beam 0.8 m on, 5.004 m from the lens; at 7 m it would take 7 * tan 3 = 0.367 m/s.
    assert_eq!(across(0.3, 5.0), Some(2_666_667));
    assert_eq!(across(0.3, 7.0), None);
    assert_eq!(across(0.4, 7.0), Some(2_000_000));
}

#[test]
fn crossing_zones_within_the_window_is_noticed() {
    let across = |pulses, window_s| alone(&zones(pulses, window_s), Life::new().walk(1.0, (2.0, 1.0), (2.0, 7.0)));
    // The body comes to the zones at y = 2 - 0.2 * sqrt(2), 3.8 and 6 - 0.2 * sqrt(2).
    assert_eq!(across(1, 1.0), [717_158, 2_800_000, 4_717_158]);
    assert_eq!(across(2, 2.1), [2_800_000, 4_717_158]);
    assert_eq!(across(2, 2.0), [4_717_158]);
    assert_eq!(across(2, 1.9), NONE);
    assert_eq!(across(3, 4.0), [4_717_158]);
    assert_eq!(across(3, 3.99), NONE);
}

#[test]
fn approaching_along_a_zone_is_not_noticed() {
    let along = || Life::new().walk(1.0, (9.0, 4.0), (1.0, 4.0));
    // One pulse, 0.2 m before the zone's end.
    assert_eq!(alone(&zones(1, 2.0), along()), [3_800_000]);
    assert_eq!(alone(&zones(2, 60.0), along()), NONE);
}

#[test]
fn two_people_who_cross_a_zone_each_are_noticed_together() {
    let first = || Life::new().walk(1.0, (2.0, 1.0), (2.0, 3.0)).rest(8.0, Posture::Standing, (2.0, 3.0));
    let still = || Life::new().rest(10.0, Posture::Standing, (3.0, 3.0));
    let second = || Life::new().rest(1.5, Posture::Standing, (3.0, 3.0)).walk(1.0, (3.0, 3.0), (3.0, 5.0));
    // The second comes to the middle zone 0.8 m on, 1.583 s after the first to the southern one.
    let together = noticed(&zones(2, 2.0), &[first(), second()]);
    assert_eq!(together, [(2_300_000, 1)]);
    assert_eq!(noticed(&zones(2, 2.0), &[first(), still()]), []);
    assert_eq!(noticed(&zones(2, 2.0), &[second()]), []);
}

/// A quarter of a metre before the lens all three zones are less than 0.2 m away.
const BEFORE_THE_LENS: (f64, f64) = (0.25, 4.0);

#[test]
fn zones_miss_a_body_that_leaves_from_inside_them() {
    let off = |life: Life| life.walk(1.0, BEFORE_THE_LENS, (4.0, 4.0));
    let arrives = || Life::new().walk(1.0, (9.0, 4.0), BEFORE_THE_LENS).rest(30.0, Posture::Standing, BEFORE_THE_LENS);
    // The arrival comes to the middle zone at 5.2 m, and to both others at 0.2 * sqrt(2) = 0.282843 m, each time once.
    assert_eq!(alone(&zones(1, 2.0), off(arrives())), [3_800_000, 8_717_158]);
    assert_eq!(alone(&zones(2, 2.0), off(arrives())), NONE);
    assert_eq!(alone(&zones(2, 2.0), off(Life::new().rest(30.0, Posture::Sitting, BEFORE_THE_LENS))), NONE);
}

#[test]
fn a_stir_is_noticed_only_where_it_spans_the_pitch_of_the_zones() {
    let stir = |x: f64| {
        let sensor = json!({ "level": { "zones": {} } });
        let life = Life::new().rest(1.0, Posture::Sitting, (x, 4.0));
        alone(&sensor, life.stir(1.0, Posture::Sitting, (x, 4.0), 0.3)).first().copied()
    };
    // Eleven zones over 145 degrees are 14.5 degrees, 0.253073 apart: 0.3 / 0.253073 = 1.1854 m.
    assert_eq!(stir(1.18), Some(1_000_000));
    assert_eq!(stir(1.19), None);
}

#[test]
fn zones_miss_a_body_that_leaves_from_where_it_was_first() {
    let stands = |life: Life| life.rest(30.0, Posture::Standing, BEFORE_THE_LENS);
    for (first, life) in [
        ("it leaves at once", Life::new()),
        ("it stood there", stands(Life::new())),
        ("it moved there", Life::new().stir(30.0, Posture::Standing, BEFORE_THE_LENS, 0.19)),
        ("it came back there", stands(Life::new().then(10.0, Posture::Standing, MotionState::Away))),
    ] {
        assert_eq!(alone(&zones(2, 2.0), life.walk(1.0, BEFORE_THE_LENS, (4.0, 4.0))), NONE, "{first}");
    }
}

#[test]
fn a_walk_across_zones_makes_the_sensor_fire_within_one_to_two_seconds() {
    let sensor = json!({ "level": { "zones": {} } });
    let mut delays_s = Vec::new();
    for x in [2.0, 3.0, 4.0] {
        for pace in [0.6, 0.8, 1.0, 1.2] {
            for start in 0..10 {
                let from = (x, 3.0 + f64::from(start) * 0.07);
                let life = Life::new().rest(1.0, Posture::Standing, from).walk(pace, from, (x, 7.0));
                let first = alone(&sensor, life).first().copied().expect("a walk across is noticed");
                // Half-way between 0.3 and 0.8 s after the second pulse.
                delays_s.push((first - 1_000_000) as f64 / 1e6 + 0.55);
            }
        }
    }
    delays_s.sort_by(f64::total_cmp);
    let median_s = delays_s[delays_s.len() / 2];
    assert!((1.0..2.0).contains(&median_s), "{median_s}");
}

/// The share of 400 repetitions of a movement, a minute apart, that a narrow sensor above (5, 4) sees.
fn share_seen(notice: &Value, once: impl Fn(Life) -> Life) -> f64 {
    const TIMES: usize = 400;
    let file = json!({
        "name": "home", "walls": [],
        "rooms": [{ "name": "room", "outline": [[0, 0], [12, 0], [12, 8], [0, 8]] }],
        "sensors": [{
            "name": "narrow", "kind": "ceiling_motion", "area": [[4.75, 3.75], [5.25, 3.75], [5.25, 4.25], [4.75, 4.25]],
            "preset": "casas_pulse", "notice": notice,
        }],
    });
    let file: HomeFile = serde_json::from_value(file).expect("a home");
    let home = Home::bake(&ResolvedHome::new(file).unwrap(), &[Build { radius_m: 0.2, height_m: 1.65 }]);
    let mut world = World::new(Arc::new(home), 1, 1);
    let (mut life, mut begins) = (Life::new(), Vec::new());
    for _ in 0..TIMES {
        begins.push(life.end());
        life = once(life).rest(60.0, Posture::Standing, (1.0, 1.0));
    }
    let mut events = Events::default();
    for next in &life.0 {
        world.begin(ResidentId::new(0), next);
        world.advance(next.end, &mut events);
    }
    let mut seen: Vec<usize> =
        events.firings.iter().map(|firing| begins.partition_point(|&at| at <= firing.at)).collect();
    seen.dedup();
    seen.len() as f64 / TIMES as f64
}

#[test]
fn passing_is_seen_nine_times_in_ten_and_the_edge_is_soft() {
    let (all, chance) = (json!("all"), json!({ "chance": {} }));
    let pass = |y: f64| move |life: Life| life.walk(0.65, (2.0, y), (8.0, y));
    assert_eq!(share_seen(&all, pass(4.0)), 1.0);
    assert_eq!(share_seen(&all, pass(4.4)), 1.0, "0.15 m beside the area it still touches a body of 0.2 m");
    let [middle, edge] = [4.0, 4.4].map(|y| share_seen(&chance, pass(y)));
    assert!((0.82..0.97).contains(&middle), "{middle}");
    assert!((0.05..middle - 0.1).contains(&edge), "{edge}");
    assert_eq!(share_seen(&chance, pass(4.5)), 0.0);
    // Most of the missed movements in the middle are in spans without any notice.
    let never = json!({ "chance": { "missed": 0 } });
    assert!(share_seen(&never, pass(4.0)) > 0.97);
}

#[test]
fn misses_most_small_movements() {
    let chance = json!({ "chance": { "looks_per_s": 2, "sure_deg": 20, "missed": 0 } });
    let stir = |amplitude_m: f64| move |life: Life| life.stir(3.0, Posture::Sitting, (5.0, 4.0), amplitude_m);
    let [blanket, hand, arm] = [0.1, 0.2, 0.5].map(|amplitude_m| share_seen(&chance, stir(amplitude_m)));
    // Six looks notice 0.1 m 1.5 m below the lens, 3.8 degrees, with the square of 3.8 / 20: 0.036.
    let by_hand = |metres: f64| {
        let angle = metres / 1.5 / 20.0_f64.to_radians();
        1.0 - libm::pow(1.0 - (angle * angle).min(1.0), 6.0)
    };
    for (found, metres) in [(blanket, 0.1), (hand, 0.2), (arm, 0.5)] {
        assert!((found - by_hand(metres)).abs() < 0.06, "{metres} m: {found} instead of {}", by_hand(metres));
    }
    assert_eq!(share_seen(&json!("all"), stir(0.1)), 1.0);
}

#[test]
fn people_go_through_a_door_that_they_shut_behind_them_and_beams_do_not() {
    let home = |shut_behind: bool| {
        json!({
            "name": "home",
            "rooms": [{ "name": "near", "outline": [[0, 0], [4, 0], [4, 8], [0, 8]] },
                { "name": "far", "outline": [[4, 0], [12, 0], [12, 8], [4, 8]] }],
            "walls": [{ "from": [4, 0], "to": [4, 8] }],
            "doors": [{ "name": "door", "from": [4, 3.5], "to": [4, 4.5], "shut_behind": shut_behind }],
        })
    };
    let beyond = || [Life::new().walk(1.0, (6.0, 3.0), (6.0, 5.0))];
    assert!(!noticed_in(home(false), &json!({}), &beyond()).is_empty());
    assert_eq!(noticed_in(home(true), &json!({}), &beyond()), []);
    let plan = Plan::new(&serde_json::from_value(home(true)).expect("a home"));
    assert!(plan.is_walkable(Point::new(4.0, 4.0), 0.2) && !plan.is_walkable(Point::new(4.0, 2.0), 0.2));
    // A body that comes through is seen on this side.
    let through = [Life::new().walk(1.0, (6.0, 4.0), (2.0, 4.0))];
    let seen = noticed_in(home(true), &json!({}), &through);
    assert!(seen.first().is_some_and(|(at, _)| (1_500_000..2_500_000).contains(at)), "{seen:?}");
}

#[test]
fn a_threshold_holds_in_addition_to_chance() {
    let sensor = |threshold_deg: f64| {
        json!({ "level": { "sensitivity": { "threshold_deg": threshold_deg } },
            "notice": { "chance": { "looks_per_s": 50, "sure_deg": 5, "edge_m": 0, "missed": 0 } } })
    };
    // 0.3 m at 3 m are 5.7 degrees.
    let life = || [Life::new().stir(10.0, Posture::Sitting, (3.0, 4.0), 0.3)];
    assert!(!noticed(&sensor(5.0), &life()).is_empty());
    assert_eq!(noticed(&sensor(6.0), &life()), []);
}
