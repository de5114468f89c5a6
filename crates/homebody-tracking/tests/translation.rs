//! Locating people from a log: the probabilities of their places, and the folder of the result.

use homebody_core::time::RunTime;
use homebody_query::LoadedLog;
use homebody_simulation::{Cancel, Destinations, SimulationError, template};
use homebody_tracking::located_folder::{GIVEN, LocatingSummary, REPORT, ROOMS, doubts, locate_into};
use homebody_tracking::{PlaceChance, PossiblePlace, TrackingError, locate};
use std::collections::BTreeMap;
use std::fs;
use tempfile::TempDir;

/// A day of a scenario, as a log.
fn log(name: &str, folder: &TempDir) -> LoadedLog {
    let url = format!("csv:{}", folder.path().join("log.csv").display());
    template(name).unwrap().run().days(1).start().unwrap().store(&Destinations::log(&url).unwrap(), |_| ()).unwrap();
    LoadedLog::read(&url, None).unwrap()
}

fn number(place: PossiblePlace) -> i64 {
    match place {
        PossiblePlace::Out => -1,
        PossiblePlace::Between => -2,
        PossiblePlace::Room(room) => room as i64,
    }
}

#[test]
fn probabilities_sum_to_one_and_the_likeliest_place_is_reported() {
    for name in ["studio", "couple-with-cat"] {
        let folder = TempDir::new().unwrap();
        let (home, read) = (template(name).unwrap(), log(name, &folder));
        let told = locate(&read.log, home.scenario(), &Cancel::new(), |_| ()).unwrap();
        assert!(told.doubts.is_sorted_by_key(|doubt| doubt.at));
        // By person, what holds at an instant.
        let mut known: BTreeMap<usize, BTreeMap<i64, f32>> = BTreeMap::new();
        let mut next = 0;
        let (mut same, mut all) = (0, 0);
        for at in &told.whereabouts {
            for doubt in told.doubts[next..].iter().take_while(|doubt| doubt.at <= at.at) {
                known.entry(doubt.who).or_default().insert(number(doubt.place), doubt.chance);
                next += 1;
            }
            let chances = &known[&at.who];
            let sum: f32 = chances.values().sum();
            assert!((sum - 1.0).abs() < 0.05 * chances.len() as f32, "{name}: {chances:?}");
            let best = chances.iter().max_by(|a, b| a.1.total_cmp(b.1)).map(|(place, _)| *place);
            let place = at.place.map_or(-1, |_| at.room.map_or(-2, |room| room as i64));
            all += 1;
            same += usize::from(best == Some(place));
        }
        assert!(all > 300 && same * 100 > all * 90, "{name}: {same} of {all}");
    }
}

#[test]
fn reads_a_folder_back_and_reports_damage_with_its_line() {
    let folder = TempDir::new().unwrap();
    let (home, read) = (template("studio").unwrap(), log("studio", &folder));
    let to = folder.path().join("walked");
    let mut shares = Vec::new();
    locate_into(&to, ("log.csv", &read), home.scenario(), &Cancel::new(), |share| shares.push(share)).unwrap();
    assert!(shares.is_sorted() && shares.len() > 2 && shares.iter().all(|share| (0.0..=1.0).contains(share)));
    assert_eq!(fs::read(to.join(GIVEN).join("log.csv")).unwrap(), fs::read(folder.path().join("log.csv")).unwrap());
    let told = locate(&read.log, home.scenario(), &Cancel::new(), |_| ()).unwrap();
    let reported: LocatingSummary = serde_json::from_str(&fs::read_to_string(to.join(REPORT)).unwrap()).unwrap();
    let (plan, clock) = (home.scenario().home.plan(), told.calendar.scale(told.length));
    let read_back = || doubts(&to.join(ROOMS), &reported.people, plan, &clock);
    let rounded = |doubts: &[PlaceChance]| -> Vec<(RunTime, usize, i64, i64)> {
        let each =
            |doubt: &PlaceChance| (doubt.at, doubt.who, number(doubt.place), (doubt.chance * 1000.0).round() as i64);
        doubts.iter().map(each).collect()
    };
    assert_eq!(rounded(&read_back().unwrap()), rounded(&told.doubts));
    let table = fs::read_to_string(to.join(ROOMS)).unwrap();
    for wrong in [
        "2026,walter,room,0.5",
        "2025-06-02 00:00:00,nobody,room,0.5",
        "2025-06-02 00:00:00,walter,attic,0.5",
        "2025-06-02 00:00:00,walter,room,7",
    ] {
        fs::write(to.join(ROOMS), format!("{table}{wrong}\n")).unwrap();
        let line = table.lines().count() + 1;
        let told = read_back().unwrap_err().to_string();
        assert!(told.contains(&format!("line {line} is not a row")), "{told}");
    }
}

#[test]
fn a_cancelled_search_leaves_nothing() {
    let folder = TempDir::new().unwrap();
    let (home, read) = (template("studio").unwrap(), log("studio", &folder));
    let cancel = Cancel::new();
    let to = folder.path().join("walked");
    let cancelled = locate_into(&to, ("log.csv", &read), home.scenario(), &cancel, |_| {
        cancel.cancel();
    });
    assert!(matches!(cancelled, Err(TrackingError::Simulation(SimulationError::Cancelled))));
    assert!(!to.exists());
}

#[test]
fn a_home_of_the_longest_name_is_walked_back() {
    let folder = TempDir::new().unwrap();
    let (home, read) = (template("studio").unwrap(), log("studio", &folder));
    let name = "é".repeat(100);
    let named = home.scenario().edit().file(|file| file.name.clone_from(&name)).load().unwrap();
    let told = locate(&read.log, &named, &Cancel::new(), |_| ()).unwrap();
    let walked: serde_json::Value = serde_json::from_str(&told.files[&told.entry]).unwrap();
    assert_eq!(walked["name"], format!("{}, located", "é".repeat(91)));
}
