//! The design's invariants, each as a test by its name, on random homes with every level of sensor,
//! up to three bodies, and times that tie.

use crate::random_home::{self, Dice, Done, Model};
use homebody_core::drivers::path::{PathDriver, ResolvedPath};
use homebody_core::event::{Events, Fact, Firing, Provenance, Value};
use homebody_core::geometry::Point;
use homebody_core::home::Home;
use homebody_core::home::form::HomeFile;
use homebody_core::home::resolved::ResolvedHome;
use homebody_core::ids::{ResidentId, SensorId};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::resident::Build;
use homebody_core::run::Run;
use homebody_core::sensor_set::SensorSet;
use homebody_core::sensors::kinds::KINDS;
use homebody_core::time::{RunTime, SECOND, Span};
use homebody_core::world::World;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A world and what each of its residents does.
#[derive(Clone)]
struct Case {
    world: World,
    lives: Vec<Vec<MotionSegment>>,
    doings: Vec<Vec<(RunTime, Done)>>,
    length: Span,
}

impl Case {
    fn new(case: u64) -> Case {
        Case::with(case, random_home::home(case, Model::Whole), random_home::builds(case, 3))
    }

    fn with(case: u64, file: HomeFile, builds: Vec<Build>) -> Case {
        let home = Arc::new(Home::bake(&ResolvedHome::new(file).unwrap(), &builds));
        let length = 300 * SECOND;
        let lives = (0..builds.len()).map(|i| random_home::life(case, i, &home, length, 0.05)).collect();
        let doings = (0..builds.len()).map(|i| random_home::doings(case, i, &home, length)).collect();
        Case { world: World::new(home, builds.len(), case), lives, doings, length }
    }

    /// Lives until `until`, cutting time at `cuts` as well as wherever a move ends.
    fn live(&mut self, until: RunTime, cuts: &[RunTime], events: &mut Events) {
        while self.world.now() < until {
            let now = self.world.now();
            let mut end = until;
            for (resident, life) in self.lives.iter().enumerate() {
                let next = &life[life.partition_point(|next| next.end <= now)];
                // Beginning the same move again in its middle is what cutting it means.
                self.world.begin(ResidentId::new(resident), next);
                end = end.min(next.end);
                let doings = &self.doings[resident];
                let (now, later) = (at(doings, now), at(doings, now + Span::MICROSECOND));
                for &(_, done) in &doings[now..later] {
                    match done {
                        Done::Use(act) => self.world.act(Some(ResidentId::new(resident)), act),
                        Done::Vitals(vitals) => self.world.feel(ResidentId::new(resident), vitals),
                    }
                }
                end = end.min(doings.get(later).map_or(end, |&(at, _)| at));
            }
            let cut = cuts.partition_point(|&cut| cut <= now);
            self.world.advance(end.min(cuts.get(cut).copied().unwrap_or(RunTime::MAX)), events);
        }
    }

    fn events(mut self, cuts: &[RunTime]) -> Events {
        let mut events = Events::default();
        self.live(RunTime::START + self.length, cuts, &mut events);
        events
    }
}

const CASES: u64 = 300;

/// The number of doings before an instant.
fn at(doings: &[(RunTime, Done)], at: RunTime) -> usize {
    doings.partition_point(|&(done, _)| done < at)
}

/// The firings alone, so that a failure is readable.
fn firings(events: &Events) -> Vec<(RunTime, u32, Value)> {
    events.firings.iter().map(|firing| (firing.at, firing.sensor.0, firing.value)).collect()
}

#[test]
fn the_cases_have_something_to_say() {
    let mut values: BTreeMap<(&str, Value), usize> = BTreeMap::new();
    for case in (0..CASES).map(Case::new) {
        let infos = case.world.home().sensor_infos();
        for Firing { sensor, value, .. } in case.events(&[]).firings {
            let (info, reading) = (&infos[sensor.index()], matches!(value, Value::Reading(_)));
            assert!(if reading { info.unit.is_some() } else { info.values.contains(&value) }, "{info:?} says {value}");
            *values.entry((info.kind.key, if reading { Value::Reading(0) } else { value })).or_insert(0) += 1;
        }
    }
    let firings: usize = values.values().sum();
    assert!(firings > 50 * CASES as usize && values[&("motion", Value::Fire)] > 20 * CASES as usize, "{values:?}");
    // Each value of each kind of sensor occurs.
    for kind in KINDS {
        for value in kind.values.iter().copied().chain(kind.unit.map(|_| Value::Reading(0))) {
            let count = values.get(&(kind.key, value)).copied().unwrap_or(0);
            assert!(count > 0, "no {} sensor says {value}", kind.key);
        }
    }
}

#[test]
fn speed_changes_nothing() {
    for case in 0..CASES {
        let whole = Case::new(case).events(&[]);
        for step in [16_667, 83_333, 1_666_667].map(Span::from_micros) {
            let steps: Vec<RunTime> = (0..300 * SECOND / step).map(|i| RunTime::START + i * step).collect();
            assert_eq!(whole, Case::new(case).events(&steps), "case {case}, steps of {step} microseconds");
        }
    }
}

#[test]
fn cutting_a_stride_changes_nothing() {
    for case in 0..CASES {
        let whole = Case::new(case).events(&[]);
        // At random, and exactly where something happens, one microsecond before and one after.
        let dice = &mut Dice::new(case, "cuts");
        let mut cuts: Vec<RunTime> = (0..400).map(|_| dice.instant(300 * SECOND)).collect();
        for (fact, firing) in whole.facts.iter().zip(&whole.firings) {
            let Fact::Provenance { provenance: Provenance { seen_at, .. }, .. } = fact else { continue };
            cuts.extend(
                [*seen_at, firing.at].into_iter().flat_map(|at| [at - Span::MICROSECOND, at, at + Span::MICROSECOND]),
            );
        }
        cuts.sort_unstable();
        assert_eq!(whole, Case::new(case).events(&cuts), "case {case}");
    }
}

/// The negative control: a world that only looks at places, four times a second, loses and gains firings.
#[test]
fn looking_at_samples_does_change_something() {
    let mut changed = 0;
    for case in 0..40 {
        let whole = Case::new(case);
        let mut sampled = whole.clone();
        for life in &mut sampled.lives {
            *life = life.iter().flat_map(sample).collect();
        }
        changed += u32::from(firings(&whole.events(&[])) != firings(&sampled.events(&[])));
    }
    assert!(changed > 30, "only {changed} of 40 homes noticed");
}

/// A stride as four looks a second show it: still, then elsewhere.
fn sample(whole: &MotionSegment) -> Vec<MotionSegment> {
    let MotionState::Stride { from, to } = whole.doing else { return vec![whole.clone()] };
    let step = SECOND / 4;
    (whole.begin.micros()..whole.end.micros())
        .step_by(step.micros() as usize)
        .map(|begin| {
            let begin = RunTime::from_micros(begin);
            let at = from + (to - from) * (begin - whole.begin).ratio(whole.end - whole.begin);
            MotionSegment {
                begin,
                end: whole.end.min(begin + step),
                doing: MotionState::InPlace { at, amplitude_m: 0.2 },
                ..*whole
            }
        })
        .collect()
}

#[test]
fn sensors_see_a_still_body_at_once_or_never() {
    for case in 0..CASES {
        let mut still = Case::new(case);
        let run = RunTime::START..RunTime::START + still.length;
        for life in &mut still.lives {
            let mut strides = life.iter().filter_map(|next| match next.doing {
                MotionState::Stride { from, .. } => Some(from),
                _ => None,
            });
            let from = strides.next_back().unwrap_or(Point::new(1.0, 1.0));
            let to = if case % 2 == 0 { from } else { Point::new(from.x.next_up(), from.y) };
            let doing = MotionState::Stride { from, to };
            let end = run.end + Span::MICROSECOND;
            *life = vec![MotionSegment { begin: run.start, end, doing, posture: Posture::Standing }];
        }
        let whole = still.clone().events(&[]);
        for fact in &whole.facts {
            let Fact::Provenance { provenance: Provenance { seen_at, .. }, .. } = fact else { continue };
            assert!(run.contains(seen_at), "case {case}: seen at {seen_at}");
        }
        let cuts = [Span::from_micros(7), SECOND, 100 * SECOND].map(|after| RunTime::START + after);
        assert_eq!(whole, still.events(&cuts), "case {case}");
    }
}

#[test]
fn the_truth_ends_with_the_run() {
    let home = ResolvedHome::new(random_home::home(0, Model::Whole)).unwrap();
    let home = Arc::new(Home::bake(&home, &[BODY]));
    let path = serde_json::json!({ "start": [1, 1], "steps": [{ "go": { "to": [[7, 1]], "in_s": 60 } }] });
    let path = ResolvedPath::new(serde_json::from_value(path).unwrap(), &home.plan, 1.0).unwrap();
    let path = PathDriver::new(&path, Span::ZERO);
    let length = 20 * SECOND;
    let mut run = Run::from_drivers(home.clone(), vec![BODY], vec![Box::new(path)], 1, length);
    let mut events = Events::default();
    let stops = RunTime::START + length;
    run.advance(stops, &mut events).unwrap();
    let movement = events.facts.iter().find(|fact| matches!(fact, Fact::Movement { .. }));
    let Some(Fact::Movement { end, doing: MotionState::Stride { to, .. }, .. }) = movement else { panic!("no stride") };
    assert_eq!((*end, *to), (stops, Point::new(3.0, 1.0)));
    for fact in &events.facts {
        assert!(!matches!(fact, Fact::Room { at, .. } if *at >= stops), "{fact:?}");
    }
}

const BODY: Build = Build { radius_m: 0.2, height_m: 1.7 };

#[test]
fn a_copy_of_the_world_continues_as_the_original() {
    for case in 0..CASES {
        let mut original = Case::new(case);
        let mut begun = Events::default();
        original.live(Dice::new(case, "copy").instant(300 * SECOND), &[], &mut begun);
        let copy = original.clone();
        assert_eq!(copy.events(&[]), original.events(&[]), "case {case}");
    }
}

#[test]
fn adding_a_sensor_changes_no_other() {
    for case in 0..CASES {
        let file = random_home::home(case, Model::Whole);
        let builds = random_home::builds(case, 3);
        let before = Case::with(case, file.clone(), builds.clone()).events(&[]);
        let mut more = file.clone();
        let mut added = match case % 2 {
            0 => random_home::home(case + 1_000_000, Model::Whole).sensors.remove(0),
            _ => {
                let device = random_home::device(&mut Dice::new(case, "added"), 0, 4.0, 3.0);
                serde_json::from_value(device).unwrap()
            }
        };
        *added.name_mut() = "added".into();
        more.sensors.insert(0, added);
        let after = Case::with(case, more, builds).events(&[]);
        let others: Vec<(RunTime, u32, Value)> =
            firings(&after).into_iter().filter(|&(_, sensor, _)| sensor > 0).map(|(at, s, v)| (at, s - 1, v)).collect();
        let mut before = firings(&before);
        before.sort_unstable();
        let mut others = others;
        others.sort_unstable();
        assert_eq!(before, others, "case {case}");
    }
}

/// Masks hold 128 sensors each: the first hundred, and the last, fire in a crowd as they do alone.
#[test]
fn sensors_beyond_a_mask_change_no_other() {
    for (case, more) in [(1, 300), (2, 1000)] {
        let mut file = random_home::crowded(case, Model::Whole, more);
        // A camera hears others.
        file.sensors.retain(|sensor| sensor.camera().is_none());
        let all = firings(&Case::with(case, file.clone(), vec![BODY]).events(&[]));
        let last = file.sensors.len() - 100;
        for part in [0..100, last..last + 100] {
            let mut few = file.clone();
            few.sensors = file.sensors[part.clone()].to_vec();
            let alone = firings(&Case::with(case, few, vec![BODY]).events(&[]));
            let of_part = all.iter().filter(|(_, sensor, _)| part.contains(&(*sensor as usize)));
            let in_crowd: Vec<_> =
                of_part.map(|&(at, sensor, value)| (at, sensor - part.start as u32, value)).collect();
            assert!(alone.len() > 300, "case {case}: only {} firings", alone.len());
            assert_eq!(alone, in_crowd, "case {case}, sensors {part:?}");
        }
    }
}

#[test]
fn adding_a_resident_whom_no_sensor_sees_changes_nothing() {
    for case in 0..CASES {
        let file = random_home::home(case, Model::Whole);
        let build = Build { radius_m: 0.2, height_m: 1.7 };
        let alone = Case::with(case, file.clone(), vec![build]).events(&[]);
        let mut two = Case::with(case, file, vec![build, Build { radius_m: 0.3, height_m: 1.2 }]);
        let (begin, end) = (RunTime::START, RunTime::START + two.length);
        let posture = two.lives[1][0].posture;
        two.doings[1].clear();
        two.lives[1] = vec![MotionSegment { begin, end, doing: MotionState::Away, posture }];
        assert_eq!(firings(&alone), firings(&two.events(&[])), "case {case}");
    }
}

#[test]
fn the_grid_changes_nothing() {
    for case in 0..CASES {
        let file = random_home::home(case, Model::Whole);
        let home = Home::bake(&ResolvedHome::new(file).unwrap(), &random_home::builds(case, 3));
        let dice = &mut Dice::new(case, "places");
        let (least, most) = home.plan.bounds();
        for field in &home.fields {
            for _ in 0..300 {
                let p = homebody_core::geometry::Point::new(
                    dice.between(least.x - 1.0, most.x + 1.0),
                    dice.between(least.y - 1.0, most.y + 1.0),
                );
                let on_plan = p.cmpge(least).all() && p.cmple(most).all();
                let seen = (0..home.sensors.len()).filter(|&sensor| on_plan && field.sees(sensor, p));
                let seen: SensorSet = seen.map(SensorId::new).collect();
                assert!(!on_plan || field.seen_at(p) == seen, "case {case} at {p}");
            }
        }
    }
}

#[test]
fn firings_are_in_order_and_numbered_without_gaps() {
    for case in 0..CASES {
        let events = Case::new(case).events(&[]);
        let order: Vec<Firing> = events.firings.clone();
        assert!(order.is_sorted_by_key(|firing| (firing.at, firing.sensor)), "case {case}");
        assert!(order.iter().enumerate().all(|(index, firing)| firing.seq == index as u64), "case {case}");
    }
}
