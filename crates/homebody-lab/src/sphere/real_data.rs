//! The recordings themselves, where HOMEBODY_DATA names the folder that holds them; they are not part of the repository.

use super::*;
use homebody_core::drivers::path::form::{Go, PathFile, PathStep};
use homebody_core::geometry::{Point, point};
use homebody_core::plan::Plan;
use homebody_core::plan::form::Spot;
use std::fs;
use std::path::PathBuf;

fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The recordings; none if HOMEBODY_DATA is not set.
fn recordings() -> Vec<AnnotatedRun> {
    let Some(data) = std::env::var_os("HOMEBODY_DATA").map(PathBuf::from) else {
        eprintln!("skipped: HOMEBODY_DATA does not name a folder that holds sphere_challenge");
        return Vec::new();
    };
    let entries = fs::read_dir(data.join("sphere_challenge/train")).unwrap();
    let mut folders: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    let read = |folder: &PathBuf, name: &str| fs::read_to_string(folder.join(name));
    let recording = |folder: PathBuf| {
        let [location, annotations, pir] =
            ["location_0.csv", "annotations_0.csv", "pir.csv"].map(|name| read(&folder, name).unwrap());
        let second = read(&folder, "location_1.csv").ok();
        let texts = RecordingTexts {
            location: &location,
            annotations: &annotations,
            pir: &pir,
            second_location: second.as_deref(),
        };
        parse(&texts).unwrap()
    };
    folders.into_iter().map(recording).collect()
}

fn plan() -> Plan {
    let text = fs::read_to_string(repository().join("scenarios/sphere-house/home.json")).unwrap();
    Plan::new(&serde_json::from_str(&text).unwrap())
}

fn rooms() -> Vec<String> {
    ["bath", "bed1", "bed2", "hall", "kitchen", "living", "stairs", "study", "toilet"].map(String::from).to_vec()
}

/// A straight leg of a path, or a stay at its end; seconds of the recording.
struct Leg {
    begin_s: f64,
    end_s: f64,
    from: Point,
    to: Point,
}

fn legs(path: &PathFile, begin_s: f64) -> Vec<Leg> {
    let at = |spot: &Spot| match spot {
        Spot::At(at) => point(*at),
        Spot::Place(name) => panic!("{name:?} is a name"),
    };
    let (mut now, mut here, mut legs) = (begin_s, at(&path.start), Vec::new());
    for step in &path.steps {
        match step {
            PathStep::Wait(wait) => {
                let end_s = now + wait.for_s.unwrap();
                legs.push(Leg { begin_s: now, end_s, from: here, to: here });
                now = end_s;
            }
            PathStep::Go(Go { to, in_s, .. }) => {
                let points: Vec<Point> = [here].into_iter().chain(to.iter().map(at)).collect();
                let length_m: f64 = points.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
                for leg in points.windows(2) {
                    let end_s = now + in_s.unwrap() * leg[0].distance(leg[1]) / length_m;
                    legs.push(Leg { begin_s: now, end_s, from: leg[0], to: leg[1] });
                    (now, here) = (end_s, leg[1]);
                }
            }
            step => panic!("unexpected {step:?}"),
        }
    }
    legs
}

#[test]
fn recordings_become_walks_that_a_person_can_walk() {
    let plan = plan();
    let mut house = SphereHouse::new(&plan, 0.22);
    for run in recordings() {
        let legs = legs(&path_of(&run, &mut house).unwrap(), run.begin_s());
        assert!((legs[legs.len() - 1].end_s - run.end_s()).abs() < 1e-3);
        assert_eq!(without_short_stays(&run, &mut house).unwrap(), (run.clone(), Vec::new()));
        let (mut as_annotated, mut seconds) = (0, 0);
        for Leg { begin_s, end_s, from, to } in &legs {
            let speed_mps = from.distance(*to) / (end_s - begin_s);
            assert!(speed_mps < 2.0, "{speed_mps} m/s at {begin_s} s");
        }
        for at_s in moments(run.begin_s(), run.end_s()) {
            let leg = legs.iter().find(|leg| at_s < leg.end_s).unwrap();
            let at = leg.from.lerp(leg.to, (at_s - leg.begin_s) / (leg.end_s - leg.begin_s));
            let room = plan.room_at(at).map(|room| plan.rooms[room].name.as_str());
            as_annotated += usize::from(room == at_moment(&run.rooms, at_s));
            seconds += 1;
        }
        let share = as_annotated as f64 / seconds as f64;
        assert!(share > 0.97, "only {share} of the time in the annotated room");
    }
}

#[test]
fn recordings_pass_the_checks_of_every_path() {
    let recordings: Vec<(String, AnnotatedRun)> =
        recordings().into_iter().enumerate().map(|(index, run)| (index.to_string(), run)).collect();
    let house = experiment::tests::house();
    let experiment = SphereExperiment::run(&recordings, &house, 1).unwrap();
    assert_eq!(experiment.by_recording.len(), recordings.len());
}

#[test]
fn annotators_agree_on_rooms() {
    for (same, all) in recordings().iter().filter_map(AnnotatedRun::annotators_agree) {
        assert!(same as f64 > 0.97 * all as f64, "{same} of {all}");
    }
}

#[test]
fn the_real_sensors_are_known_well() {
    let recordings = recordings();
    let itself: Vec<(&AnnotatedRun, &[Interval])> = recordings.iter().map(|run| (run, &run.pir[..])).collect();
    let comparison = compare_runs(&itself, &rooms());
    if comparison.recordings == 0 {
        return;
    }
    let seen = |name: &str| {
        let room = comparison.rooms.iter().find(|room| room.room == name).unwrap();
        room.real.visits_seen as f64 / room.visits as f64
    };
    for room in ["bath", "bed1", "bed2", "kitchen", "living", "toilet"] {
        assert_eq!(seen(room), 1.0, "{room}");
    }
    assert!(seen("hall") < 0.2, "{}", seen("hall"));
    assert!((0.7..1.0).contains(&comparison.overall.real.precision.unwrap()));
}
