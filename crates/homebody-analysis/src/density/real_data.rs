//! The rule of absences held against real homes, where HOMEBODY_DATA names the folder that holds their logs; they are not
//! part of the repository.

use super::*;
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::{HOUR, Interval, MINUTE, WallTime};
use homebody_log::{Url, read};
use jiff::civil::{DateTime, date};
use std::path::PathBuf;

/// The file of a real home; prints a message and returns `None` where it is missing.
fn recorded(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("HOMEBODY_DATA").map(|data| PathBuf::from(data).join(name));
    let path = path.filter(|path| path.is_file());
    if path.is_none() {
        eprintln!("skipped: HOMEBODY_DATA does not name a folder that holds {name}");
    }
    path
}

fn of(url: Url) -> Map {
    Map::from_log("real", &read(&url, &LoggerFile::default()).unwrap(), &DensityOptions::default()).unwrap()
}

#[test]
fn a_journey_of_days_is_found_in_spite_of_stray_firings() {
    let Some(path) = recorded("casas_tm000/tm000.multiday_absence.txt") else { return };
    let map = of(Url::new(Scheme::Casas, path));
    assert_eq!(map.entrance.sensors, ["EntrywayB", "MainEntryway"]);
    let longest = map.absences.iter().max_by_key(|absence| absence.interval().length()).unwrap();
    assert_eq!((longest.begin.date(), longest.end.date()), (date(2016, 7, 13), date(2016, 7, 16)));
    assert!(longest.stray > 0 && map.days[2].sum.density_per_h.is_none() && map.days[3].sum.density_per_h.is_none());
    // No night at home is taken for an absence.
    let at_night = |absence: &&HomeAbsence| absence.hours() < 24.0 && absence.begin.time_of_day() / HOUR < 6;
    assert_eq!(map.absences.iter().filter(at_night).count(), 0);
}

#[test]
fn absences_are_those_that_the_residents_noted() {
    let Some(path) = recorded("casas_hh111_week1/hh111week1.csv") else { return };
    let text = std::fs::read_to_string(&path).unwrap();
    // From the last row of each Leave_Home to the first of the next Enter_Home.
    let (mut noted, mut left, mut last) = (Vec::new(), None, None);
    for line in text.lines() {
        let fields: Vec<&str> = line.split(',').collect();
        let at: DateTime = fields[0].replace(' ', "T").parse().unwrap();
        let at = WallTime::midnight(at.date()) + i64::from(at.hour()) * HOUR + i64::from(at.minute()) * MINUTE;
        match (last, fields[3]) {
            (_, "Leave_Home") => left = Some(at),
            (before, "Enter_Home") if before != Some("Enter_Home") => {
                noted.extend(left.take().map(|left| Interval::new(left, at)).filter(|left| left.length() > LEAST));
            }
            _ => {}
        }
        last = Some(fields[3]);
    }
    let map = of(Url::new(Scheme::Csv, path));
    let minutes = |a: WallTime, b: WallTime| (a - b).abs() <= 2 * MINUTE;
    let is_noted = |absence: &&HomeAbsence| {
        noted
            .iter()
            .any(|noted: &Interval<WallTime>| minutes(absence.begin, noted.begin) && minutes(absence.end, noted.end))
    };
    let found = map.absences.iter().filter(is_noted).count();
    assert_eq!((noted.len(), map.absences.len(), found), (15, 15, 15), "{:?}", map.absences);
}
