use super::*;
use homebody_core::time::DAY;

const HOUR: Micros = 60 * MINUTE;

fn days(count: i64) -> Vec<DayClock> {
    (0..count).map(|day| DayClock { begin: day * DAY, end: (day + 1) * DAY, clock: 0, turn: None }).collect()
}

fn stay(begin: Micros, end: Micros, who: &'static str, name: &'static str) -> Stay<'static> {
    let who = (!who.is_empty()).then_some(Cow::Borrowed(who));
    Stay { begin, end, who, name: Cow::Borrowed(name), words: Cow::Borrowed("") }
}

fn sensors() -> Vec<Listener> {
    let sensor =
        |name: &str, room: &str| Listener { name: name.into(), room: Some(room.into()), ..Listener::default() };
    vec![sensor("bath motion", "bathroom"), sensor("hall motion", "hall"), sensor("stove", "kitchen")]
}

fn asked(what: What, name: &str, hours: &str, least: Micros) -> Query {
    let name = (!name.is_empty()).then(|| name.to_owned());
    Query { what, name, hours: (!hours.is_empty()).then(|| hours.parse().unwrap()), least }
}

/// What is found in these rows over two days, with what is told.
fn found(
    query: &Query,
    rows: &[(Micros, u32, u32)],
    told: Option<Vec<Stay>>,
    home: Option<Vec<Span>>,
) -> Result<Vec<Span>, Unfindable> {
    let values = ["ON", "OFF", "21.5"].map(str::to_owned);
    let mut hand_over = |take: &mut TakeRow| {
        rows.iter().for_each(|&(at, sensor, value)| take(at, sensor, value));
        Ok(())
    };
    let rows: &mut Rows = &mut hand_over;
    let mut ground = Ground {
        span: (0, 2 * DAY),
        days: days(2),
        told,
        home,
        sensors: sensors(),
        values: &values,
        gaps: Vec::new(),
        rows,
    };
    let found = find(query, &mut ground)?;
    Ok(found.hits.iter().map(|hit| (hit.begin, hit.end)).collect())
}

const ON: u32 = 0;
const OFF: u32 = 1;
const READING: u32 = 2;

#[test]
fn in_a_room_between_hours_is_the_part_of_a_stay_that_lies_in_them() {
    let told = vec![
        stay(5 * HOUR + 50 * MINUTE, 6 * HOUR + 10 * MINUTE, "ada", "bathroom"),
        stay(12 * HOUR, 13 * HOUR, "ada", "bathroom"),
        stay(DAY + HOUR, DAY + HOUR + MINUTE, "ada", "bathroom"),
        stay(DAY + HOUR + 2 * MINUTE, DAY + HOUR + 12 * MINUTE, "ada", "bathroom"),
        stay(DAY + HOUR, DAY + 2 * HOUR, "bob", "hall"),
    ];
    let ask =
        |hours, least| found(&asked(What::Room, "Bathroom", hours, least), &[], Some(told.clone()), None).unwrap();
    assert_eq!(
        ask("0-6", 5 * MINUTE),
        [
            (5 * HOUR + 50 * MINUTE, 6 * HOUR),
            // Somebody who is back within a minute has not left.
            (DAY + HOUR, DAY + HOUR + 12 * MINUTE)
        ]
    );
    assert_eq!(ask("0-6", 11 * MINUTE), [(DAY + HOUR, DAY + HOUR + 12 * MINUTE)]);
    assert_eq!(ask("", 0).len(), 3);
    assert_eq!(ask("22-5", 0), [(DAY + HOUR, DAY + HOUR + 12 * MINUTE)]);
}

#[test]
fn without_a_truth_somebody_is_where_sensors_say_so_until_others_do() {
    let rows = [(HOUR, 0, ON), (HOUR + MINUTE, 0, OFF), (2 * HOUR, 1, ON), (3 * HOUR, 0, ON), (4 * HOUR, 0, READING)];
    let query = asked(What::Room, "bathroom", "", 0);
    assert_eq!(found(&query, &rows, None, None).unwrap(), [(HOUR, 2 * HOUR), (3 * HOUR, 4 * HOUR)]);
}

#[test]
fn what_is_on_is_so_until_its_sensor_says_otherwise_or_no_longer_says_so() {
    let query = asked(What::On, "stove", "", 30 * MINUTE);
    let rows = [(HOUR, 2, ON), (HOUR + 5, 1, ON), (2 * HOUR, 2, OFF), (3 * HOUR, 2, ON), (3 * HOUR + MINUTE, 2, OFF)];
    assert_eq!(found(&query, &rows, None, None).unwrap(), [(HOUR, 2 * HOUR)]);
    // One that never says that it is off.
    let rows: Vec<(Micros, u32, u32)> = (0..8).map(|step| (HOUR + step * 9 * MINUTE, 2, ON)).collect();
    assert_eq!(found(&query, &rows, None, None).unwrap(), [(HOUR, HOUR + 63 * MINUTE)]);
    let rows: Vec<(Micros, u32, u32)> = (0..8).map(|step| (HOUR + step * 11 * MINUTE, 2, ON)).collect();
    assert_eq!(found(&query, &rows, None, None).unwrap(), []);
}

#[test]
fn nothing_stirs_where_no_sensor_speaks_while_somebody_is_at_home() {
    let rows =
        [(9 * HOUR, 0, ON), (10 * HOUR, 1, READING), (14 * HOUR, 0, ON), (15 * HOUR, 0, OFF), (40 * HOUR, 0, ON)];
    let query = asked(What::Still, "", "8-20", 3 * HOUR);
    let all = found(&query, &rows, None, None).unwrap();
    assert_eq!(all, [(9 * HOUR, 14 * HOUR), (15 * HOUR, 20 * HOUR), (32 * HOUR, 40 * HOUR), (40 * HOUR, 44 * HOUR)]);
    let home = Some(vec![(0, 11 * HOUR), (12 * HOUR, 2 * DAY)]);
    let at_home = found(&query, &rows, None, home).unwrap();
    assert_eq!(at_home, [(15 * HOUR, 20 * HOUR), (32 * HOUR, 40 * HOUR), (40 * HOUR, 44 * HOUR)]);
}

#[test]
fn falls_lost_messages_and_alerts_are_those_that_are_told_and_nobody_knows_them_otherwise() {
    let told = vec![stay(HOUR, 2 * HOUR, "ada", "fallen"), stay(30 * HOUR, 30 * HOUR, "", "stove")];
    for what in [What::Fall, What::Lost, What::Alert] {
        assert_eq!(found(&asked(what, "", "", 0), &[], Some(told.clone()), None).unwrap().len(), 2);
        assert_eq!(found(&asked(what, "", "5-7", 0), &[], Some(told.clone()), None).unwrap(), [(30 * HOUR, 30 * HOUR)]);
        assert_eq!(found(&asked(what, "stove", "", 0), &[], Some(told.clone()), None).unwrap().len(), 1);
        assert!(matches!(found(&asked(what, "", "", 0), &[], None, None), Err(Unfindable::NoTruth(_))));
    }
}

#[test]
fn a_name_that_leads_nowhere_is_told_with_the_nearest() {
    let error = found(&asked(What::On, "stov", "", 0), &[], None, None).unwrap_err().to_string();
    assert!(error.contains("did you mean \"stove\"?"), "{error}");
    let error = found(&asked(What::Room, "attic", "", 0), &[], None, None).unwrap_err().to_string();
    assert!(error.contains("bathroom, hall, kitchen"), "{error}");
    assert!(matches!(found(&asked(What::Room, "", "", 0), &[], None, None), Err(Unfindable::NoName("room"))));
}

#[test]
fn hours_are_those_of_the_wall_also_where_clocks_are_set() {
    // At two the clock is set to three: from then on an hour of the wall comes an hour earlier.
    let day = DayClock { begin: 0, end: 23 * HOUR, clock: 0, turn: Some((2 * HOUR, HOUR)) };
    let next = DayClock { begin: 23 * HOUR, end: 47 * HOUR, clock: 0, turn: None };
    let over = |text: &str| text.parse::<Hours>().unwrap().over(&[day, next]);
    assert_eq!(over("1-6"), [(HOUR, 5 * HOUR), (24 * HOUR, 29 * HOUR)]);
    assert_eq!(over("22-1"), [(0, HOUR), (21 * HOUR, 24 * HOUR), (45 * HOUR, 47 * HOUR)]);
    // A run that begins at noon.
    let noon = DayClock { begin: 0, end: 12 * HOUR, clock: 12 * HOUR, turn: None };
    assert_eq!("6-13".parse::<Hours>().unwrap().over(&[noon]), [(0, HOUR)]);
    for wrong in ["", "6", "25-3", "3-3", "a-b", "1:70-3"] {
        assert!(wrong.parse::<Hours>().is_err(), "{wrong}");
    }
    assert_eq!("8:30-20".parse::<Hours>().unwrap().to_string(), "08:30-20:00");
}
