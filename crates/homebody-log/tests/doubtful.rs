//! Ambiguous tables and lists are read by evidence, or an error asks for the missing information.

use crate::stage;
use crate::stage::texts::{SEVEN, clock, read_as, read_text, rows, told, why};
use homebody_core::time::SECOND;

/// Seven in seconds since 1970.
fn seven() -> i64 {
    SEVEN.since_zero() / SECOND
}

/// A table without a heading of things that are used, five minutes apart: `row` writes one of its time in seconds since 1970, and how
/// long it lasts.
fn uses(row: impl Fn(i64, i64, &str) -> String) -> String {
    let things = ["couch", "kettle", "loo"];
    (0..12_i64).map(|at| row(seven() + 300 * at, 20 + at, things[at as usize % 3]) + "\n").collect()
}

#[test]
fn intervals_of_numbers_without_a_heading_are_intervals_or_are_asked_for() {
    let (form, log) = read_text(&uses(|at, length, thing| format!("{at},{},{thing}", at + length))).unwrap();
    assert_eq!((form.as_str(), log.rows), ("pyadlml", 24));
    assert_eq!(told(&log)[..2], [(0.0, "couch", "ON"), (20.0, "couch", "OFF")]);
    // A number that stays near the time for longer than a month is another one.
    let far = uses(|at, length, thing| format!("{at},{},{thing}", at + length * 86_400 * 20));
    assert_ne!(read_text(&far).unwrap().0, "pyadlml");
    let clock = |at: i64| format!("2009-03-02 {}", stage::texts::clock(((at - seven()) / 60) as usize));
    for (text, order) in [
        (uses(|at, length, thing| format!("{},{length},{thing}", clock(at))), "time,duration,sensor"),
        (uses(|at, length, thing| format!("{thing},{},{length}", clock(at))), "sensor,time,duration"),
        (uses(|at, length, thing| format!("{},{thing},{length}", clock(at))), "time,sensor,duration"),
    ] {
        let why = why(&text);
        assert_eq!((why.code, &why.data["intervals"]), ("log-table::ambiguous-numbers", &order.into()));
        // The hint works.
        assert_eq!(read_text(&format!("{order}\n{text}")).unwrap().0, "pyadlml", "{order}");
        assert_eq!(read_text(&format!("{}\n{text}", order.replace("duration", "value"))).unwrap().0, "csv", "{order}");
    }
    // Watts and degrees are readings.
    for things in [["kettle", "fridge", "tv"], ["bath temperature", "bed humidity", "hall temperature"]] {
        let text = uses(|at, length, thing| {
            let place = ["couch", "kettle", "loo"].iter().position(|known| *known == thing).unwrap();
            format!("{},{},{length}", clock(at), things[place])
        });
        assert_eq!(read_text(&text).unwrap().0, "csv", "{things:?}");
    }
}

#[test]
fn a_first_row_of_a_day_that_no_month_has_is_no_heading() {
    for (day, wanted) in [("2009-02-30", "there is no 30 February 2009"), ("2009/06/31", "there is no 31 June 2009")] {
        let text = format!("{day} 07:00:00,hall,ON\n")
            + &rows(12, |at, sensor, value| format!("2009-03-02 {},{sensor},{value}", clock(at)));
        let (_, log) = read_text(&text).unwrap();
        assert_eq!((log.rows, log.skipped), (12, 1), "{day}");
        assert!(log.problems[0].line == 1 && log.problems[0].why.ends_with(wanted), "{:?}", log.problems);
    }
    // Two such rows are not a heading. A heading above them stays one.
    let text = rows(12, |at, sensor, value| format!("2009-03-02 {},{sensor},{value}", clock(at)));
    let bad = "2009-02-30 07:00:00,hall,ON\n2009-02-31 07:00:00,bath,ON\n";
    for (heading, line) in [("", 1), ("time,sensor,value\n", 2)] {
        let (_, log) = read_text(&format!("{heading}{bad}{text}")).unwrap();
        assert_eq!((log.rows, log.skipped, log.problems[0].line), (12, 2, line));
    }
}

#[test]
fn a_pivoted_table_of_influx_without_annotations_has_no_sensors_called_result_and_table() {
    let rows: String =
        (0..12).map(|at| format!(",_result,0,2009-03-02T{}Z,{},{}\n", clock(at), at % 2, at % 3 % 2)).collect();
    let (form, log) = read_text(&format!(",result,table,_time,den_pir,wc_door\n{rows}")).unwrap();
    assert_eq!((form.as_str(), &log.sensors), ("influx-csv", &vec!["den_pir".to_owned(), "wc_door".to_owned()]));
    // A table of another program may have a column of results.
    let (form, log) = read_text(&format!("number,result,score,time,den_pir,wc_door\n{rows}")).unwrap();
    assert!(form != "influx-csv" && log.sensors.len() > 1, "{form}");
}

#[test]
fn an_empty_list_of_json_has_no_rows() {
    assert_eq!(read_as("log.json", "[]\n").unwrap_err().code(), "log-form::empty-json");
}
