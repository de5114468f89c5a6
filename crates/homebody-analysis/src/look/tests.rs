use super::*;
use crate::sample::{log, parsed, span};
use crate::signs::Kind;
use homebody_core::time::{Interval, Span};
use homebody_log::Log;
use homebody_log::log::Clock;
use jiff::tz::TimeZone;

const H: i64 = 3600;

fn look_of(rows: &[(i64, &str, &str)], home: Option<(&str, &[HomeSensor])>) -> LogOverview {
    look_at(&counted(rows), Looker::new(None), home)
}

fn look_at(log: &Log, mut looker: Looker, home: Option<(&str, &[HomeSensor])>) -> LogOverview {
    looker.take(log);
    looker.look("a log", "csv", log, &|_| None, home)
}

fn counted(rows: &[(i64, &str, &str)]) -> Log {
    Log { rows: rows.len() as u64, ..log(rows) }
}

fn sensor<'l>(look: &'l LogOverview, id: &str) -> &'l SensorLook {
    look.sensors.iter().find(|sensor| sensor.id == id).unwrap()
}

#[test]
fn first_and_last_instants_are_those_of_rows() {
    let mut log = counted(&[(10, "M1", "ON"), (20, "M1", "OFF")]);
    let (begin, end) = (log.events[0].at - 5 * Span::MICROSECOND, log.events[1].at + Span::MICROSECOND);
    log.activities.push(homebody_timeline::Episode::new("sleep".to_owned(), Interval::new(begin, end)));
    let look = |log: &Log| look_at(log, Looker::new(None), None);
    let rows = look(&log);
    assert_eq!(rows.last.as_ref(), Some(&sensor(&rows, "M1").last));
    assert_eq!(rows.first.as_ref(), Some(&sensor(&rows, "M1").first));
    // A log of activities alone has theirs.
    let alone = Log { events: Vec::new(), sensors: Vec::new(), rows: 0, ..log };
    assert_ne!(look(&alone).last, rows.last);
}

#[test]
fn counts_oddities() {
    let look = look_of(
        &parsed(
            "0 M1 OFF, 1 M1 ON, 2 M1 ON, 2 M1 ON, 1 M1 OFF, 3 M1 OFF, 4 fire FIRE, 5 fire FIRE, 6 T1 20, \
             7 T1 1, 8 T1 1",
        ),
        None,
    );
    assert_eq!((look.repeated, look.missing, look.doubled), (2, 2, 1));
    assert_eq!((look.set_back, look.set_back_most_s), (1, 1.0));
    assert_eq!((sensor(&look, "M1").repeated, sensor(&look, "M1").missing), (2, 2));
    // A sensor without ends only begins, and numbers come again and again.
    assert_eq!((sensor(&look, "fire").repeated, sensor(&look, "T1").repeated), (0, 0));
    assert_eq!(sensor(&look, "T1").range, Some([1.0, 20.0]));
    assert_eq!(
        look.sensors.iter().map(|sensor| sensor.kind).collect::<Vec<_>>(),
        [Kind::Motion, Kind::Reading, Kind::Motion]
    );
    assert_eq!(look.first.as_deref(), Some("1970-01-01 00:00:00"));
}

#[test]
fn silence_and_dead_and_stuck_sensors_are_found() {
    let mut rows = Vec::new();
    for hour in 0..24 * 10 {
        rows.extend([(hour * H, "M1", "ON"), (hour * H + 4, "M1", "OFF"), (hour * H, "B1", "3100")]);
        if hour < 24 * 3 {
            rows.push((hour * H, "M2", "ON"));
            rows.push((hour * H + 9, "M2", "OFF"));
        }
        if hour == 30 {
            rows.push((hour * H, "M3", "ON"));
        }
        if hour == 40 {
            rows.push((hour * H, "M3", "OFF"));
            rows.push((hour * H + 1, "M3", "ON"));
            rows.push((hour * H + 2, "M3", "OFF"));
        }
    }
    rows.retain(|(at, ..)| !(24 * 5 * H..24 * 6 * H).contains(at));
    let look = look_of(&rows, None);
    assert_eq!(look.silences_in_all, 1);
    assert_eq!(look.silences[0].from, "1970-01-05 23:00:00");
    assert_eq!((look.days.len(), look.is_silent(5), look.is_silent(4)), (10, true, false));
    assert_eq!(sensor(&look, "M1").by_day, [48, 48, 48, 48, 48, 0, 48, 48, 48, 48]);
    assert_eq!((sensor(&look, "M1").days, sensor(&look, "M1").trouble.clone()), (9, None));
    assert_eq!(sensor(&look, "M2").trouble, Some(SensorTrouble::Dead { since: "1970-01-03 23:00:09".into() }));
    assert_eq!(
        sensor(&look, "M3").trouble,
        Some(SensorTrouble::StuckOn { since: "1970-01-02 06:00:00".into(), hours: 10.0 })
    );
    assert_eq!(sensor(&look, "B1").trouble, Some(SensorTrouble::StuckAt { value: "3100".into() }));
}

#[test]
fn a_home_says_what_does_not_fit() {
    let of = |name: &str, id: &str, kind| HomeSensor { name: name.into(), ids: vec![id.into()], kind };
    let home = [of("hall", "M1", Kind::Motion), of("door", "D1", Kind::Motion), of("bed", "B1", Kind::Used)];
    let rows = [(0, "M1", "ON"), (1, "M1", "OFF"), (2, "D1", "OPEN"), (3, "X", "ON")];
    let of_home = look_of(&rows, Some(("flat", &home))).home.unwrap();
    assert_eq!((of_home.known, of_home.known_share), (2, Some(0.75)));
    assert_eq!(of_home.unknown, [UnlistedSensor { id: "X".into(), rows: 1, share: 0.25 }]);
    assert_eq!(of_home.unheard, ["bed"]);
    assert_eq!(of_home.misfits.len(), 1);
    assert_eq!(of_home.misfits[0].id, "D1");
}

#[test]
fn an_empty_log_and_one_sensor() {
    let look = look_of(&[], None);
    assert_eq!((look.rows, &look.first, look.sensors.len(), look.days.len()), (0, &None, 0, 0));
    assert!(look.to_string().contains("0 rows of 0 sensors"));
    let look = look_of(&[(0, "M1", "ON")], None);
    assert_eq!((look.rows, look.sensors[0].days, look.silences_in_all), (1, 1, 0));
}

#[test]
fn shows_utc_on_a_known_wall() {
    let log = Log { clock: Clock::Utc, ..counted(&[(1_236_499_200, "M1", "ON")]) };
    let told = |zone: Option<TimeZone>| look_at(&log, Looker::new(zone), None).first.unwrap();
    assert_eq!(told(None), "2009-03-08 08:00:00Z");
    let zone = homebody_core::calendar::Calendar::zone("America/Chicago").unwrap();
    assert_eq!(told(Some(zone.clone())), "2009-03-08 03:00:00");
    // A log may name its own zone, as a run in a database does.
    let log = Log { zone: Some(zone), ..log.clone() };
    assert_eq!(look_at(&log, Looker::new(None).by_own_zone(), None).first.unwrap(), "2009-03-08 03:00:00");
}

#[test]
fn unknown_state_is_neither_stuck_nor_missing() {
    let rows = parsed(
        "0 kitchen motion on, 60 kitchen motion off, 3600 kitchen motion on, 3620 kitchen motion unavailable, \
         9:00:00 kitchen motion off, 9:00:00 hall motion off, 10:00:00 hall motion on, \
         10:01:00 hall motion off, 11:00:00 hall motion unavailable, 12:00:00 hall motion off",
    );
    let look = look_of(&rows, None);
    let (kitchen, hall) = (sensor(&look, "kitchen motion"), sensor(&look, "hall motion"));
    assert_eq!((look.missing, look.repeated), (0, 0));
    assert_eq!((kitchen.trouble.clone(), kitchen.unknown, kitchen.restored), (None, 1, 0));
    assert_eq!((hall.unknown, hall.restored), (1, 1));
    // The same where it says off only after eight hours.
    let rows: Vec<_> = rows.into_iter().filter(|row| row.2 != "unavailable").collect();
    assert!(matches!(sensor(&look_of(&rows, None), "kitchen motion").trouble, Some(SensorTrouble::StuckOn { .. })));
}

#[test]
fn gaps_of_the_recorder_are_listed_and_are_no_silences() {
    let rows = parsed("0 M1 on, 30 M1 off, 20:00:00 M1 off, 20:00:05 M1 on, 20:00:09 M1 off");
    let mut log = counted(&rows);
    let look = |log: &Log| look_at(log, Looker::new(None), None);
    let without = look(&log);
    assert_eq!((without.silences_in_all, without.gaps_in_all, without.missing), (1, 0, 1));
    log.gaps = vec![span(60, 19 * H), span(21 * H, 23 * H)];
    let with = look(&log);
    assert_eq!((with.silences_in_all, with.gaps_in_all, with.missing), (0, 2, 0));
    assert_eq!(with.gaps[0].to, "1970-01-01 19:00:00");
    assert!(with.to_string().contains("gaps in which nothing was recorded: 2\n"), "{with}");
}

#[test]
fn the_evidence_for_each_kind_is_shown() {
    let look = look_of(&[(0, "hall pir", "ON"), (1, "hall pir", "OFF"), (2, "S7", "ON"), (3, "T1", "20")], None);
    let words = look.to_string();
    for part in ["\"pir\" in its name", "a guess: it says that something begins", "it says numbers"] {
        assert!(words.contains(part), "{words}");
    }
    let json = serde_json::to_value(sensor(&look, "hall pir")).unwrap();
    assert_eq!((json["kind"].as_str(), json["by"].as_str()), (Some("motion"), Some("name")));
}

#[test]
fn the_order_of_rows_changes_no_count() {
    // Two sensors over two days, with a night of 14 h, on a wall without a zone.
    let mut rows = Vec::new();
    for day in 0..2 {
        for (hour, name) in [(8, "hall"), (9, "bath"), (13, "hall"), (18, "bath")] {
            let at = (24 * day + hour) * H;
            rows.extend([(at, name, "ON"), (at + 60, name, "OFF")]);
        }
    }
    let looked = |rows: &[(i64, &str, &str)]| {
        let log = counted(rows);
        let (looker, _) = looked(Looker::new(None), &mut |take| {
            take(&log);
            Ok::<_, ()>(log.clone())
        })
        .unwrap();
        looker.look("a log", "csv", &log, &|_| None, None)
    };
    let sorted = looked(&rows);
    assert_eq!((sorted.silences_in_all, sorted.missing, sorted.set_back, &sorted.remarks[..]), (1, 0, 0, &[][..]));
    let newest_first: Vec<_> = rows.iter().rev().copied().collect();
    let mut by_sensor = rows.clone();
    by_sensor.sort_by_key(|(_, name, _)| *name);
    for (rows, remark) in [(newest_first, "newest rows come first"), (by_sensor, "sensor by sensor")] {
        let look = looked(&rows);
        assert!(look.remarks.len() == 1 && look.remarks[0].contains(remark), "{:?}", look.remarks);
        let other = LogOverview { remarks: Vec::new(), ..look };
        assert_eq!(other.to_string(), sorted.to_string());
        // Taken as they come, they would tell of other silences, and of clocks.
        assert_ne!(look_of(&rows, None).to_string(), sorted.to_string());
    }
    // A clock that is set back by an hour is one, and stays so.
    let mut set = rows.clone();
    set.extend([(43 * H, "hall", "ON"), (42 * H, "hall", "OFF"), (44 * H, "bath", "ON")]);
    let look = looked(&set);
    assert_eq!((look.set_back, look.set_back_most_s, look.remarks.len()), (1, 3600.0, 0));
}

#[test]
fn the_hour_that_a_clock_on_the_wall_tells_twice_sets_no_clock_back() {
    // An hour before the clocks of Berlin are set back, and an hour after.
    let set_back = 1_761_440_400;
    let rows: Vec<_> = (-60..60_i64)
        .map(|minute| (set_back + 60 * minute, "M1", ["ON", "OFF"][minute.rem_euclid(2) as usize]))
        .collect();
    let berlin = homebody_core::calendar::Calendar::zone("Europe/Berlin").unwrap();
    let looked = |clock: Clock, rows: &[(i64, &str, &str)]| {
        look_at(&Log { clock, ..counted(rows) }, Looker::new(Some(berlin.clone())), None)
    };
    let look = looked(Clock::Utc, &rows);
    assert_eq!((look.set_back, look.last.as_deref()), (0, Some("2025-10-26 02:59:00")));
    // By a clock on the wall alone it was set back.
    let wall: Vec<_> =
        rows.iter().map(|&(at, of, says)| (if at < set_back { at } else { at - 3600 }, of, says)).collect();
    assert_eq!(looked(Clock::Local, &wall).set_back, 1);
}
