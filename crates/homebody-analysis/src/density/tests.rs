use super::*;
use crate::sample::{TestRandom, at, log};
use homebody_core::time::{DAY, Interval, WallTime};
use jiff::civil::date;

const H: i64 = 3600;

fn map(rows: &[(i64, &str, &str)], asked: &DensityOptions) -> Map {
    Map::from_log("log", &log(rows), asked).unwrap()
}

#[test]
fn a_cell_is_events_by_hours_at_home() {
    // Thirty minutes of the first hour, ten of the next, are recorded.
    let rows =
        [(1800, "M1", "ON"), (1900, "M1", "OFF"), (2000, "M2", "ON"), (3599, "T1", "21.5"), (H + 599, "M1", "ON")];
    let map = map(&rows, &DensityOptions::default());
    assert_eq!((map.events, map.motion_sensors, map.from), (3, 2, date(1970, 1, 1)));
    assert_eq!(map.cells[0][0].state(), HourState::Density(4.0));
    // A microsecond belongs to the last row.
    let DensityCell { events, recorded_h, .. } = map.cells[0][1];
    assert!(events == 1 && (recorded_h - 599.000001 / 3600.0).abs() < 1e-12);
    assert_eq!(map.cells[0][1].state(), HourState::NoData, "less than ten minutes are known");
    assert_eq!(map.cells[0][2].state(), HourState::NoData);
}

#[test]
fn an_hour_that_is_known_for_minutes_is_not_the_darkest() {
    let last = |seconds: i64| {
        let rows = [(0, "M1", "ON"), (1800, "M1", "OFF"), (H + 60, "M1", "ON"), (H + seconds, "M1", "ON")];
        map(&rows, &DensityOptions::default()).cells[0][1].state()
    };
    assert_eq!(last(11 * 60), HourState::NoData);
    assert!(matches!(last(16 * 60), HourState::Density(density) if (7.0..8.0).contains(&density)), "the control");
}

#[test]
fn hours_away_do_not_count_as_hours_at_home() {
    // Leaves at 01:30 by the front door and comes back at 03:00; the run was a whole day.
    let front = "front door";
    let leave = [(5380, "hall", "ON"), (5390, "hall", "ON"), (5400, front, "ON")];
    let come = [(10_800, front, "ON"), (10_810, "hall", "ON"), (10_820, "hall", "ON")];
    let rows: Vec<_> = leave.into_iter().chain([(8000, "hall", "ON")]).chain(come).collect();
    let asked =
        DensityOptions { recorded: Some(Interval::starting(WallTime::EPOCH, DAY)), ..DensityOptions::default() };
    let map = map(&rows, &asked);
    assert_eq!(map.entrance, Entrance { sensors: vec![front.into()], chosen: EntranceSource::Known });
    assert_eq!(map.absences, [HomeAbsence { begin: at(5400), end: at(10_800), stray: 1, is_guess: true }]);
    let states: Vec<HourState> = map.cells[0].iter().map(DensityCell::state).collect();
    assert_eq!(
        states[..4],
        [HourState::Density(0.0), HourState::Density(6.0), HourState::Away, HourState::Density(3.0)]
    );
    assert_eq!((map.away_h, map.away_h_per_day, map.recorded_h), (1.5, 1.5, 24.0));
    // Six firings at home in 22.5 hours; the stray one in the hour away is left out of it, but counted.
    assert_eq!((map.density_per_h, map.events), (Some(6.0 / 22.5), 7));
    assert!(map.csv().contains("1970-01-01,1,3,0.5000,6.0000\n1970-01-01,2,1,0.0000,\n"), "{}", map.csv());

    // If clocks are set from 2 to 3, that hour does not come; if they are set back, the hour from 1 to 2 comes twice.
    let zone = |rule: &str| Some(jiff::tz::TimeZone::posix(rule).unwrap());
    let set_on = self::map(&rows, &DensityOptions { zone: zone("EST5EDT,J1,J200"), ..asked.clone() });
    assert_eq!((set_on.recorded_h, set_on.cells[0][2].state(), set_on.away_h), (23.0, HourState::NoData, 0.5));
    let set_back = self::map(&rows, &DensityOptions { zone: zone("EST5EDT,J100,J1"), ..asked.clone() });
    assert_eq!((set_back.recorded_h, set_back.cells[0][1].recorded_h, set_back.away_h), (25.0, 2.0, 2.0));

    // With the hall as the entrance it is the same, with the bedroom there is an empty list.
    let doors = |door: &str| DensityOptions { doors: vec![door.into()], ..asked.clone() };
    assert_eq!(self::map(&rows, &doors("hall")).absences.len(), 1);
    assert_eq!(self::map(&rows, &doors("bedroom")).absences.len(), 0);
}

#[test]
fn no_event_is_lost_or_doubled() {
    let mut numbers = TestRandom(3);
    let mut random = |below: i64| numbers.below(below);
    for _ in 0..50 {
        let names = ["entrance", "hall", "bedroom", "D1", "T1"];
        let mut rows: Vec<(i64, &str, &str)> = Vec::new();
        for _ in 0..1 + random(400) {
            let (at, name) = (random(20 * 86_400) - 5 * 86_400, names[random(5) as usize]);
            let value = match name {
                "D1" => ["OPEN", "CLOSE"][random(2) as usize],
                "T1" => "21.5",
                _ => ["ON", "OFF"][random(2) as usize],
            };
            rows.push((at, name, value));
        }
        rows.push((0, "hall", "ON"));
        rows.push((0, "hall", "ON"));
        let map = map(&rows, &DensityOptions::default());
        let events = rows.iter().filter(|(_, _, value)| *value == "ON").count() as u64;
        assert_eq!(map.events, events);
        assert_eq!(map.days.iter().map(|day| day.sum.events).sum::<u64>(), events);
        assert_eq!(map.hours.iter().map(|hour| hour.sum.events).sum::<u64>(), events);
        let in_csv: u64 =
            map.csv().lines().skip(1).map(|line| line.split(',').nth(2).unwrap().parse::<u64>().unwrap()).sum();
        assert_eq!(events, in_csv);
        for cell in map.cells.iter().flatten() {
            let whole = 1.0 + 1e-9;
            assert!(cell.recorded_h <= whole && cell.away_h <= whole && cell.at_home_h() >= 0.0, "{cell:?}");
        }
    }
}

#[test]
fn a_part_of_the_days_is_cut_out() {
    let rows = [(0, "hall", "ON"), (86_400, "hall", "ON"), (2 * 86_400, "hall", "ON"), (2 * 86_400 + 5, "hall", "ON")];
    let part = |from: i8, days| DensityOptions { from: Some(date(1970, 1, from)), days, ..DensityOptions::default() };
    assert_eq!(map(&rows, &part(2, Some(1))).events, 1);
    assert_eq!(map(&rows, &part(2, None)).events, 3);
    assert_eq!(map(&rows, &part(3, Some(9))).days.len(), 1, "there are no more days than the log has");
    let (first, last) = (date(1970, 1, 1), date(1970, 1, 3));
    let wrong = Map::from_log("log", &log(&rows), &part(4, None));
    assert_eq!(wrong, Err(NoMap::NoDay { date: date(1970, 1, 4), first, last }));
}

#[test]
fn rejects_log_without_motion() {
    for rows in [[(0, "T1", "21.5")], [(0, "D1", "OPEN")], [(0, "M1", "OFF")]] {
        assert_eq!(Map::from_log("log", &log(&rows), &DensityOptions::default()), Err(NoMap::NoMotion));
    }
    assert_eq!(Map::from_log("log", &log(&[]), &DensityOptions::default()), Err(NoMap::Empty));
    let far = [(0, "M1", "ON"), (3661 * 86_400, "M1", "ON")];
    assert_eq!(Map::from_log("log", &log(&far), &DensityOptions::default()), Err(NoMap::TooLong(3662)));
}

#[test]
fn silence_of_days_is_without_data() {
    let rows = [(0, "M1", "ON"), (H, "M1", "ON"), (80 * H, "M1", "ON"), (81 * H, "M1", "ON")];
    let quiet = map(&rows, &DensityOptions::default());
    assert!((quiet.recorded_h - 2.0).abs() < 1e-6, "{}", quiet.recorded_h);
    let run = map(
        &rows,
        &DensityOptions { recorded: Some(Interval::starting(WallTime::EPOCH, 4 * DAY)), ..DensityOptions::default() },
    );
    assert_eq!(run.recorded_h, 96.0);
}

#[test]
fn distance_of_a_map_from_itself_is_0() {
    let day = |day: i64, every: i64| (0..86_400 / every).map(move |i| (day * 86_400 + i * every, "M1", "ON"));
    let steady = log(&(0..21).flat_map(|number| day(number, 600)).collect::<Vec<_>>());
    let other = log(&(0..21).flat_map(|number| day(number, 200 + 100 * number)).collect::<Vec<_>>());
    let asked = DensityOptions::default();
    let apart = |a: &Log, b: &Log| {
        let density = density(("a", a, &asked), Some(("b", b, &asked))).unwrap();
        let against = density.against.unwrap();
        (against.distance.unwrap(), against.weeks_apart.unwrap())
    };
    assert_eq!(apart(&steady, &steady).0, 0.0);
    let (distance, [median, most]) = apart(&steady, &other);
    assert!(distance > 0.05 && median <= most && most > 0.0, "{distance} {median} {most}");
    assert_eq!(apart(&other, &steady).0, distance);
}

#[test]
fn steps_are_round_and_few_cells_are_above_the_top() {
    let rows: Vec<_> = (0..864).map(|i| (i * 100, "M1", "ON")).collect();
    // 36 firings an hour: eight steps of 5 hold them, of 4 not.
    let map = map(&rows, &DensityOptions::default());
    assert_eq!(step_per_h([&map].into_iter()), 5.0);
    assert_eq!(step_per_h(std::iter::empty()), 1.0);
}
