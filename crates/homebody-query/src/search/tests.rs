use super::*;
use homebody_core::time::{ClockChange, DAY, HOUR, RunTime};

/// So long after the start.
fn at(span: Span) -> RunTime {
    RunTime::START + span
}

fn day(begin: Span, end: Span) -> SearchDay<RunTime> {
    SearchDay { begin: at(begin), end: at(end), clock: Span::ZERO, turn: None }
}

fn intervals<const N: usize>(of: [(Span, Span); N]) -> Vec<Interval<RunTime>> {
    of.map(|(begin, end)| Interval::new(at(begin), at(end))).to_vec()
}

fn stay(begin: Span, end: Span, who: &'static str, name: &'static str) -> KnownStay<'static, RunTime> {
    let who = (!who.is_empty()).then_some(Cow::Borrowed(who));
    KnownStay { time: Interval::new(at(begin), at(end)), who, name: Cow::Borrowed(name), words: Cow::Borrowed("") }
}

fn sensors() -> Vec<Listener> {
    let sensor =
        |name: &str, room: &str| Listener { name: name.into(), room: Some(room.into()), ..Listener::default() };
    vec![sensor("bath motion", "bathroom"), sensor("hall motion", "hall"), sensor("stove", "kitchen")]
}

fn asked(what: SearchSubject, name: &str, hours: &str, least: Span) -> Query {
    let name = (!name.is_empty()).then(|| name.to_owned());
    Query { what, name, hours: (!hours.is_empty()).then(|| hours.parse().unwrap()), least }
}

/// The matches in these rows over two days, with the known intervals.
fn found(
    query: &Query,
    rows: &[(Span, u32, u32)],
    told: Option<Vec<KnownStay<RunTime>>>,
    home: Option<Vec<Interval<RunTime>>>,
) -> Result<Vec<Interval<RunTime>>, SearchError> {
    let values = ["ON", "OFF", "21.5"].map(str::to_owned);
    let mut hand_over = |take: &mut TakeSearchRow<RunTime>| {
        rows.iter().for_each(|&(since, sensor, value)| take(at(since), sensor, value));
        Ok(())
    };
    let rows: &mut SearchRows<RunTime> = &mut hand_over;
    let mut ground = SearchGround {
        span: Interval::starting(RunTime::START, 2 * DAY),
        days: vec![day(Span::ZERO, DAY), day(DAY, 2 * DAY)],
        told,
        home,
        sensors: sensors(),
        values: &values,
        gaps: Vec::new(),
        rows,
    };
    let found = find(query, &mut ground)?;
    Ok(found.hits.iter().map(|hit| hit.time).collect())
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
    let ask = |hours, least| {
        found(&asked(SearchSubject::Room, "Bathroom", hours, least), &[], Some(told.clone()), None).unwrap()
    };
    assert_eq!(
        ask("0-6", 5 * MINUTE),
        intervals([
            (5 * HOUR + 50 * MINUTE, 6 * HOUR),
            // Somebody who is back within a minute has not left.
            (DAY + HOUR, DAY + HOUR + 12 * MINUTE)
        ])
    );
    let long = intervals([(DAY + HOUR, DAY + HOUR + 12 * MINUTE)]);
    assert_eq!(ask("0-6", 11 * MINUTE), long);
    assert_eq!(ask("", Span::ZERO).len(), 3);
    assert_eq!(ask("22-5", Span::ZERO), long);
}

#[test]
fn without_a_truth_sensors_show_the_room_until_others_fire() {
    let rows = [(HOUR, 0, ON), (HOUR + MINUTE, 0, OFF), (2 * HOUR, 1, ON), (3 * HOUR, 0, ON), (4 * HOUR, 0, READING)];
    let query = asked(SearchSubject::Room, "bathroom", "", Span::ZERO);
    let wanted = intervals([(HOUR, 2 * HOUR), (3 * HOUR, 4 * HOUR)]);
    assert_eq!(found(&query, &rows, None, None).unwrap(), wanted);
}

#[test]
fn sensor_is_on_until_it_is_off_or_stops_repeating() {
    let query = asked(SearchSubject::On, "stove", "", 30 * MINUTE);
    let soon = HOUR + Span::from_micros(5);
    let rows = [(HOUR, 2, ON), (soon, 1, ON), (2 * HOUR, 2, OFF), (3 * HOUR, 2, ON), (3 * HOUR + MINUTE, 2, OFF)];
    assert_eq!(found(&query, &rows, None, None).unwrap(), intervals([(HOUR, 2 * HOUR)]));
    // One that never says that it is off.
    let rows: Vec<(Span, u32, u32)> = (0..8).map(|step| (HOUR + step * 9 * MINUTE, 2, ON)).collect();
    assert_eq!(found(&query, &rows, None, None).unwrap(), intervals([(HOUR, HOUR + 63 * MINUTE)]));
    let rows: Vec<(Span, u32, u32)> = (0..8).map(|step| (HOUR + step * 11 * MINUTE, 2, ON)).collect();
    assert_eq!(found(&query, &rows, None, None).unwrap(), []);
}

#[test]
fn home_is_still_while_no_sensor_fires_and_a_person_is_at_home() {
    let rows =
        [(9 * HOUR, 0, ON), (10 * HOUR, 1, READING), (14 * HOUR, 0, ON), (15 * HOUR, 0, OFF), (40 * HOUR, 0, ON)];
    let query = asked(SearchSubject::Still, "", "8-20", 3 * HOUR);
    let all = found(&query, &rows, None, None).unwrap();
    let [first, others @ ..] = [(9, 14), (15, 20), (32, 40), (40, 44)].map(|(begin, end)| (begin * HOUR, end * HOUR));
    assert_eq!(all, [intervals([first]), intervals(others)].concat());
    let home = Some(intervals([(Span::ZERO, 11 * HOUR), (12 * HOUR, 2 * DAY)]));
    let at_home = found(&query, &rows, None, home).unwrap();
    assert_eq!(at_home, intervals(others));
}

#[test]
fn falls_lost_messages_and_alerts_need_a_truth() {
    let told = vec![stay(HOUR, 2 * HOUR, "ada", "fallen"), stay(30 * HOUR, 30 * HOUR, "", "stove")];
    let at_once = intervals([(30 * HOUR, 30 * HOUR)]);
    for what in [SearchSubject::Fall, SearchSubject::Lost, SearchSubject::Alert] {
        assert_eq!(found(&asked(what, "", "", Span::ZERO), &[], Some(told.clone()), None).unwrap().len(), 2);
        assert_eq!(found(&asked(what, "", "5-7", Span::ZERO), &[], Some(told.clone()), None).unwrap(), at_once);
        assert_eq!(found(&asked(what, "stove", "", Span::ZERO), &[], Some(told.clone()), None).unwrap().len(), 1);
        assert!(matches!(found(&asked(what, "", "", Span::ZERO), &[], None, None), Err(SearchError::NoTruth(_))));
    }
}

#[test]
fn unknown_name_has_the_nearest_as_hint() {
    let error = found(&asked(SearchSubject::On, "stov", "", Span::ZERO), &[], None, None).unwrap_err().to_string();
    assert!(error.contains("did you mean \"stove\"?"), "{error}");
    let error = found(&asked(SearchSubject::Room, "attic", "", Span::ZERO), &[], None, None).unwrap_err().to_string();
    assert!(error.contains("bathroom, hall, kitchen"), "{error}");
    assert!(matches!(
        found(&asked(SearchSubject::Room, "", "", Span::ZERO), &[], None, None),
        Err(SearchError::NoName("room"))
    ));
}

#[test]
fn hours_are_those_of_the_wall_also_where_clocks_are_set() {
    // At two the clock is set to three: from then on an hour of the wall comes an hour earlier.
    let turn = Some(ClockChange { at: at(2 * HOUR), by: HOUR });
    let days = [SearchDay { turn, ..day(Span::ZERO, 23 * HOUR) }, day(23 * HOUR, 47 * HOUR)];
    let over = |text: &str| text.parse::<DayHours>().unwrap().over(&days);
    assert_eq!(over("1-6"), intervals([(HOUR, 5 * HOUR), (24 * HOUR, 29 * HOUR)]));
    assert_eq!(over("22-1"), intervals([(Span::ZERO, HOUR), (21 * HOUR, 24 * HOUR), (45 * HOUR, 47 * HOUR)]));
    // A run that begins at noon.
    let noon = SearchDay { clock: 12 * HOUR, ..day(Span::ZERO, 12 * HOUR) };
    assert_eq!("6-13".parse::<DayHours>().unwrap().over(&[noon]), intervals([(Span::ZERO, HOUR)]));
    for wrong in ["", "6", "25-3", "3-3", "a-b", "1:70-3"] {
        assert!(wrong.parse::<DayHours>().is_err(), "{wrong}");
    }
    assert_eq!("8:30-20".parse::<DayHours>().unwrap().to_string(), "08:30-20:00");
}
