//! Tables as people keep them: headings and cells decide how each is read, or an error gives the reason. The texts are invented.

use crate::stage::texts::{SEVEN, clock, folder, read_text, read_with, rows, told, why};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::{DAY, HOUR, MINUTE, WallTime};
use homebody_log::log::{Clock, ColumnRole};
use homebody_log::source::{DateOrder, DecimalMark, HomeColumn, TableOptions};
use homebody_log::{Log, LogError, read};
use std::fs;

/// Reads a text as a table, whatever it looks like.
fn read_as_csv(text: &str) -> Result<Log, LogError> {
    let folder = folder();
    let url = folder.url("csv:log.csv");
    fs::write(folder.path().join("log.csv"), text).unwrap();
    read(&url, &LoggerFile::default())
}

/// The headings that were taken for this.
fn taken(log: &Log, role: ColumnRole) -> Vec<&str> {
    log.columns.iter().filter(|of| of.used_as == role).map(|of| of.column.as_str()).collect()
}

#[test]
fn headings_of_many_languages_and_none_are_the_same_log() {
    let first = (0.0, "hall", "ON");
    for (heading, row) in [
        ("time,sensor,value", "T,S,V"),
        ("Zeitstempel;Gerät;Zustand", "T;S;V"),
        ("horodatage,capteur,valeur", "T,S,V"),
        ("a,b,c", "T,S,V"),
        ("note,what,who,when_it_was", ",V,S,T"),
        (",time,device,val,battery", "N,T,S,V,80"),
        ("Unnamed: 0,created_at,entity,status", "N,T,S,V"),
        ("time\tsensor\tvalue", "T\tS\tV"),
        ("", "T,S,V"),
    ] {
        let row = |index: usize, sensor: &str, value: &str| {
            let (time, number) = (format!("2009-03-02 {}", clock(index)), index.to_string());
            row.replace('N', &number).replace('T', &time).replace('S', sensor).replace('V', value)
        };
        let heading = if heading.is_empty() { String::new() } else { format!("{heading}\n") };
        let (form, log) = read_text(&format!("{heading}{}", rows(40, row))).unwrap();
        assert_eq!((form.as_str(), log.rows, log.skipped, log.sensors.len()), ("csv", 40, 0, 3), "{heading}");
        assert_eq!((told(&log)[0], log.columns.is_empty()), (first, false), "{heading}");
    }
}

#[test]
fn each_column_has_its_use_and_its_reason() {
    let text =
        rows(20, |index, sensor, value| format!("{index},2009-03-02 {},{sensor},{value},some room", clock(index)));
    let (_, log) = read_text(&format!(",when_it_was,thing,says,Room\n{text}")).unwrap();
    let uses: Vec<(&str, ColumnRole)> = log.columns.iter().map(|of| (of.column.as_str(), of.used_as)).collect();
    use ColumnRole::{Room, Sensor, Time, Unused, Value};
    assert_eq!(uses, [("column 1", Unused), ("when_it_was", Time), ("thing", Sensor), ("says", Value), ("Room", Room)]);
    assert_eq!(log.columns[1].because, "20 of 20 cells are instants");
    assert!(log.columns[1].is_guess && !log.columns[2].is_guess && !log.columns[0].is_guess);
    assert_eq!(log.known[0].room.as_deref(), Some("some room"));
}

#[test]
fn intervals_without_a_heading_are_an_on_and_an_off() {
    let row = |index: usize, sensor: &str, _: &str| {
        let kind = ["Magnetic", "PIR"][index % 2];
        format!(
            "2009-03-02 {0},2009-03-02 {1}30,{sensor}{2},{kind},Kitchen",
            clock(index),
            &clock(index)[..6],
            index % 2
        )
    };
    let (form, log) = read_text(&rows(60, row)).unwrap();
    assert_eq!((form.as_str(), log.rows, log.sensors.len(), log.skipped), ("pyadlml", 120, 6, 0));
    assert_eq!(told(&log)[..2], [(0.0, "hall0", "ON"), (30.0, "hall0", "OFF")]);
    assert_eq!(taken(&log, ColumnRole::End), ["column 2"]);
    assert_eq!((log.known[1].kind.as_str(), log.known[1].is_motion), ("PIR", true));
    // Words of activities are labels.
    let activities =
        "2009-03-02 07:00:00,2009-03-02 07:10:00,Sleeping\n2009-03-02 07:20:00,2009-03-02 07:25:00,Breakfast\n";
    let (_, log) = read_text(&activities.repeat(3)).unwrap();
    assert_eq!((log.rows, log.activities.len()), (0, 6));
    // The control: two instants of one event, as in an export with when it came and when it was stored, are one event.
    let row = |index: usize, sensor: &str, value: &str| {
        format!("2009-03-02 {0},2009-03-02T{0}.5Z,{sensor},{value}", clock(index))
    };
    let (form, log) = read_text(&format!("last_changed,last_updated,entity_id,state\n{}", rows(20, row))).unwrap();
    assert_eq!((form.as_str(), log.rows, told(&log)[0]), ("csv", 20, (0.0, "hall", "ON")));
}

#[test]
fn durations_end_intervals() {
    for (heading, epoch, duration) in [
        ("timestamp,duration,sensor", "1235977200", "90"),
        ("ts,duration_ms,sensor", "1235977200000", "90000"),
        ("ts,Dauer (min),Sensor", "1235977200000000", "1.5"),
        ("ts,duration,sensor", "1235977200000000000", "00:01:30"),
    ] {
        let (form, log) = read_text(&format!("{heading}\n{epoch},{duration},bed\n")).unwrap();
        assert_eq!((form.as_str(), log.clock), ("pyadlml", Clock::Utc), "{heading}");
        assert_eq!(told(&log), [(0.0, "bed", "ON"), (90.0, "bed", "OFF")], "{heading}");
    }
    let (_, log) = read_text("start,end,name,index\n4.5,6.25,study,7\n20.5,22,stairs,6\n30,31,study,7\n").unwrap();
    assert_eq!((log.rows, log.events[0].at), (6, WallTime::from_micros(4_500_000)));
    assert!(log.remarks[0].contains("dates are not known"), "{:?}", log.remarks);
}

#[test]
fn a_column_for_each_sensor_becomes_changes_and_readings() {
    let row = |index: usize| {
        let hall = usize::from(index % 10 == 1);
        format!(
            "2009-03-02 {},{hall},{},0,{}.5,{}\n",
            clock(index),
            usize::from(index < 5),
            20 + index % 3,
            ["sun", "rain"][index / 30]
        )
    };
    let text: String = (0..60).map(row).collect();
    let (form, log) = read_text(&format!("timestamp,hall,kitchen,attic door,temperature,weather\n{text}")).unwrap();
    assert_eq!((form.as_str(), log.skipped), ("wide", 0));
    let of = |sensor: &str| told(&log).into_iter().filter(|row| row.1 == sensor).collect::<Vec<_>>();
    assert_eq!((of("hall").len(), of("hall")[0], of("hall")[1]), (12, (60.0, "hall", "ON"), (120.0, "hall", "OFF")));
    assert_eq!(of("kitchen"), [(0.0, "kitchen", "ON"), (300.0, "kitchen", "OFF")]);
    assert_eq!((of("temperature").len(), of("temperature")[0].2), (60, "20.5"));
    assert_eq!(of("weather").len(), 2);
    assert_eq!(taken(&log, ColumnRole::OneSensor).len(), 5);
    assert!(log.remarks.iter().any(|remark| remark.contains("columns are sensors")), "{:?}", log.remarks);
    // --wide takes any columns.
    let table = "time,sensor,value\n2009-03-02 07:00:00,21,1\n2009-03-02 07:01:00,22,0\n";
    let wide = TableOptions { is_wide: true, ..TableOptions::default() };
    let (_, log) = read_with(&folder(), "log.csv", table, wide).unwrap();
    assert_eq!(told(&log)[0], (0.0, "sensor", "21"));
    // The control: without it the same table is a log of events.
    assert_eq!(told(&read_text(table).unwrap().1)[0], (0.0, "21", "1"));
}

#[test]
fn energy_tables_of_many_columns_have_a_sensor_each() {
    let names: String = (1..=120).map(|number| format!(",Appliance{number}")).collect();
    let row = |index: usize| {
        let cells: String = (1..=120).map(|number| format!(",{}", number * index % 400)).collect();
        format!("2009-03-02 {},{}{cells}\n", clock(index), 1_235_977_200 + 60 * index)
    };
    let text: String = (0..50).map(row).collect();
    let (form, log) = read_text(&format!("Time,Unix{names}\n{text}")).unwrap();
    assert_eq!((form.as_str(), log.sensors.len(), log.rows), ("wide", 120, 6000));
    assert_eq!((log.sensors[0].as_str(), taken(&log, ColumnRole::Time)), ("Appliance1", vec!["Time"]));
}

#[test]
fn several_readings_of_a_device_in_a_row_are_several_sensors() {
    let row = |index: usize, sensor: &str, _: &str| {
        format!("2009-03-02 {},{sensor},{}.5,{}", clock(index), 20 + index % 4, 40 + index % 7)
    };
    let (form, log) = read_text(&format!("time,device,temperature,humidity\n{}", rows(60, row))).unwrap();
    assert_eq!((form.as_str(), log.rows, log.sensors.len()), ("wide", 120, 6));
    assert_eq!(told(&log)[..2], [(0.0, "hall temperature", "20.5"), (0.0, "hall humidity", "40")]);
    let row = |index: usize, sensor: &str, value: &str| {
        let (kind, value) = if index % 4 < 2 { ("motion", value) } else { ("battery", "80") };
        format!("2009-03-02 {} UTC,{kind},{value},,{sensor}", clock(index))
    };
    let (form, log) = read_text(&rows(80, row)).unwrap();
    assert_eq!((form.as_str(), log.rows, log.clock), ("csv", 80, Clock::Utc));
    assert!(log.sensors.contains(&"hall motion".to_owned()) && log.sensors.contains(&"hall battery".to_owned()));
}

#[test]
fn a_table_of_a_time_and_a_value_is_the_sensor_of_its_name() {
    let folder = folder();
    let text: String = (0..9).map(|index| format!("2009-03-02 {},{}\n", clock(index), 20 + index)).collect();
    let read = |heading: &str| {
        read_with(&folder, "bed temperature.csv", &format!("{heading}\n{text}"), TableOptions::default()).unwrap().1
    };
    assert_eq!(
        (read("time,value").sensors, read("time,Radiator").sensors),
        (vec!["bed temperature".into()], vec!["Radiator".into()])
    );
}

#[test]
fn homes_in_one_table_are_not_mixed() {
    let text = rows(60, |index, sensor, value| format!("H{},2009-03-02 {},{sensor},{value}", index / 20, clock(index)));
    let text = format!("home_id,time,sensor,value\n{text}");
    let error = why(&text);
    assert_eq!(error.code, "log-table::several-homes");
    assert_eq!(error.data["homes"], "\"H0\", \"H1\", \"H2\"");
    assert!(error.hint.unwrap().contains("--home-column 'home_id=H0'"));
    let folder = folder();
    let asked = |home: Option<&str>| {
        let home = HomeColumn { column: "home_id".into(), home: home.map(str::to_owned) };
        read_with(&folder, "log.csv", &text, TableOptions { home: Some(home), ..TableOptions::default() })
    };
    assert_eq!(asked(Some("H1")).unwrap().1.rows, 20);
    assert_eq!(asked(Some("*")).unwrap().1.rows, 60);
    assert!(asked(None).is_err());
    let error = asked(Some("H9")).unwrap_err();
    assert!(error.code() == "log-table::no-such-home" && error.to_string().contains("\"H2\""), "{error}");
    // A second home is noticed wherever it comes.
    let late = rows(3000, |index, sensor, value| format!("P{},1235977{index:03},{sensor},{value}", index / 2999));
    assert_eq!(why(&format!("patient,epoch,sensor,value\n{late}")).code, "log-table::several-homes");
    // The control: one home alone.
    let one = rows(20, |index, sensor, value| format!("H1,2009-03-02 {},{sensor},{value}", clock(index)));
    let (_, log) = read_text(&format!("home_id,time,sensor,value\n{one}")).unwrap();
    assert_eq!((log.rows, taken(&log, ColumnRole::Home)), (20, vec!["home_id"]));
}

#[test]
fn decimal_commas_become_points_and_undecided_ones_are_refused() {
    let table = |mark: &str, values: [&str; 2]| {
        let row = |index: usize, sensor: &str, _: &str| {
            format!("2009-03-02 {}{mark}{sensor}{mark}{}", clock(index), values[index % 2])
        };
        format!("time{mark}sensor{mark}value\n{}", rows(12, row))
    };
    for (text, first) in [
        (table(";", ["21,5", "22"]), "21.5"),
        (table(";", ["1.021,5", "22"]), "1021.5"),
        (table(",", ["\"21,5\"", "22"]), "21.5"),
        (table(",", ["21.5", "22"]), "21.5"),
        (table(";", ["1,021", "22,5"]), "1.021"),
    ] {
        assert_eq!(told(&read_text(&text).unwrap().1)[0].2, first, "{text}");
    }
    let error = why(&table(";", ["1,021", "1,022"]));
    assert_eq!((error.code, &error.data["example"]), ("log-table::ambiguous-decimals", &"\"1,021\"".into()));
    let comma = TableOptions { decimals: Some(DecimalMark::Comma), ..TableOptions::default() };
    let (_, log) = read_with(&folder(), "a.csv", &table(";", ["1,021", "1,022"]), comma).unwrap();
    assert_eq!(told(&log)[0].2, "1.021");
    let error = why(&table(",", ["21,5", "22,5"]));
    assert_eq!(error.code, "log-table::more-cells");
}

#[test]
fn date_and_time_may_stand_in_two_columns() {
    for (heading, row, form) in [
        ("date,time,sensor,value", "2009-03-02,T,S,V", "csv"),
        ("Datum;Uhrzeit;Sensor;Wert", "02.03.2009;T;S;V", "csv"),
        ("", "3/2/2009,P,S,V,,,", "csv"),
        ("", "20090302,T,S,V", "csv"),
        ("value,sensor,time,day", "V,S,T,2009/03/02", "csv"),
    ] {
        let row = |index: usize, sensor: &str, value: &str| {
            let of_twelve = format!("{}{} AM", 7 + index / 60, &clock(index)[2..]);
            row.replace('T', &clock(index)).replace('S', sensor).replace('V', value).replace('P', &of_twelve)
        };
        let heading = if heading.is_empty() { String::new() } else { format!("{heading}\n") };
        let (read_as, log) = read_text(&format!("{heading}{}", rows(30, row))).unwrap();
        assert_eq!((read_as.as_str(), log.rows, told(&log)[1]), (form, 30, (60.0, "hall", "OFF")), "{heading}");
        assert_eq!(taken(&log, ColumnRole::Time).len(), 2, "{heading}");
    }
}

#[test]
fn dates_in_numbers_are_read_in_the_order_that_the_rows_decide() {
    let table = |date: &dyn Fn(usize) -> String| {
        format!("time,device,value\n{}", rows(60, |index, sensor, value| format!("{},{sensor},{value}", date(index))))
    };
    let first = |text: &str| read_text(text).unwrap().1.events[0].at;
    let day = |day: i64| SEVEN + (day - 2) * DAY;
    assert_eq!(first(&table(&|index| format!("26.03.2009 {}", clock(index)))), day(26));
    assert_eq!(first(&table(&|index| format!("02.03.2009 {}", clock(index)))), day(2));
    assert_eq!(first(&table(&|index| format!("27-03-2009 {}", clock(index)))), day(27));
    assert_eq!(first(&table(&|index| format!("03/28/2009 {}", clock(index)))), day(28));
    assert_eq!(first(&table(&|index| format!("3/2/2009 {} AM", clock(index % 60)))), day(2));
    // Days follow each other, if the right number is the day.
    assert_eq!(first(&table(&|index| format!("{:02}/03/2009 07:00:00", 2 + index / 8))), day(2));
    assert_eq!(first(&table(&|index| format!("03/{:02}/2009 07:00:00", 2 + index / 8))), day(2));
    let undecided = table(&|index| format!("02/03/2009 {}", clock(index)));
    let error = why(&undecided);
    assert_eq!(error.code, "log-table::ambiguous-dates");
    for (order, month) in [(DateOrder::DayFirst, 0), (DateOrder::MonthFirst, -28)] {
        let options = TableOptions { dates: Some(order), ..TableOptions::default() };
        let (_, log) = read_with(&folder(), "log.csv", &undecided, options).unwrap();
        assert_eq!(log.events[0].at, if month == 0 { day(2) } else { day(2) + (month + 1) * DAY });
    }
    // A row far down decides, too.
    let far = rows(4000, |index, sensor, value| {
        format!("{}/03/2009 07:00:{:02},{sensor},{value}", if index < 3990 { "02" } else { "13" }, index % 60)
    });
    assert_eq!(first(&format!("time,device,value\n{far}")), day(2));
    let error = why(&table(&|index| format!("{}/2009 07:00:00", ["13/02", "02/13"][index % 2])));
    assert_eq!(error.code, "log-table::mixed-dates");
}

#[test]
fn a_heading_alone_has_no_rows() {
    for text in ["time,device,val\n", "time,device,value", "\u{feff}Zeit;Sensor;Wert\r\n"] {
        assert_eq!(why(text).code, "log-table::no-rows");
    }
}

#[test]
fn rows_without_a_value_are_firings() {
    let text = rows(40, |index, sensor, _| format!("2009-03-02 {},{sensor}", clock(index)));
    for (heading, text) in [("time,sensor\n", &text), ("date,location_name\n", &text), ("", &text), ("x,y\n", &text)] {
        let (_, log) = read_text(&format!("{heading}{text}")).unwrap();
        assert_eq!((log.rows, log.sensors.len(), told(&log)[0]), (40, 3, (0.0, "hall", "ON")), "{heading}");
        let supplied = log.columns.iter().find(|of| of.column.is_empty()).unwrap();
        assert!(supplied.because.contains("ON is the reader's own word"), "{supplied:?}");
    }
    // The control: a table with values has none of the reader's own.
    let (_, log) = read_text("time,sensor,value\n2009-03-02 07:00:00,hall,ON\n").unwrap();
    assert!(log.columns.iter().all(|of| !of.column.is_empty()));
}

#[test]
fn offsets_of_instants_are_kept() {
    let text = "time,sensor,value\n2009-03-29T00:30:00+01:00,hall,ON\n2009-03-29T01:59:00+01:00,hall,OFF\n\
                2009-03-29T03:01:00+02:00,hall,ON\n2009-03-29T04:00:00+02:00,hall,OFF\n";
    let (_, log) = read_text(text).unwrap();
    assert_eq!((log.clock, log.rows), (Clock::Utc, 4));
    assert_eq!(log.offsets.iter().map(|span| span.ahead).collect::<Vec<_>>(), [HOUR, 2 * HOUR]);
    let (_, log) = read_text("time,sensor,value\n2009-03-29T00:30:00Z,hall,ON\n").unwrap();
    assert!(log.offsets.is_empty());
}

#[test]
fn tables_that_are_no_logs_are_refused_with_the_reason() {
    let lines = |heading: &str, row: &dyn Fn(usize) -> String| {
        format!("{heading}\n{}", (0..60).map(|index| row(index) + "\n").collect::<String>())
    };
    for (text, code) in [
        (
            lines("time,level,logger,message", &|index| {
                format!(
                    "2009-03-02 {},{},http,handled request {index} in some ms",
                    clock(index),
                    ["INFO", "WARN"][index % 2]
                )
            }),
            "log-table::program-log",
        ),
        (
            lines("invoice_date,supplier,amount,kwh", &|index| {
                format!("2009-{:02}-01,power,{index}.5,{}", 1 + index % 12, 100 + index)
            }),
            "log-table::dates-without-times",
        ),
        (
            lines("id,name,created_at,status", &|index| {
                format!("{},person {index},2009-03-02 {},active", 7 * index, clock(index))
            }),
            "log-table::many-names",
        ),
        (
            lines("time,name,message", &|index| {
                format!("2009-03-02 {},app,the user number {index} has logged in", clock(index))
            }),
            "log-table::sentences",
        ),
        (lines("id,name,room", &|index| format!("{index},sensor {index},hall")), "log-table::no-instants"),
        (lines("time,sensor,value", &|index| format!("{},hall,ON", clock(index))), "log-table::times-without-dates"),
    ] {
        let error = match read_as_csv(&text) {
            Err(error) => error,
            Ok(log) => panic!("{} rows of {text}", log.rows),
        };
        assert_eq!(error.code(), code, "{error}");
    }
}

#[test]
fn names_of_which_none_comes_again_are_no_sensors() {
    let text: String = (0..3000).map(|index| format!("2009-03-02 07:00:00,key{index},ON\n")).collect();
    let error = why(&format!("time,sensor,value\n{text}"));
    assert_eq!(error.code, "log-form::many-names");
    // The control: so many sensors that come again are a log.
    let again: String = (0..3000).map(|index| format!("2009-03-02 07:00:00,key{},ON\n", index % 1400)).collect();
    assert_eq!(read_text(&format!("time,sensor,value\n{again}")).unwrap().1.sensors.len(), 1400);
}

/// The rows of a text as its number of rows and its sensors in order, and its log.
fn sensors_of(text: &str) -> (u64, Vec<String>, Log) {
    let (_, log) = read_text(text).unwrap_or_else(|error| panic!("{error} in {text}"));
    let mut sensors = log.sensors.clone();
    sensors.sort();
    (log.rows, sensors, log)
}

/// A heading and rows, a minute apart: `T` is the instant, `I` the row's number.
fn table(heading: &str, count: usize, row: impl Fn(usize) -> String) -> String {
    let line = |index: usize| row(index).replacen('T', &format!("2009-03-02 {}", clock(index)), 1) + "\n";
    format!("{heading}\n{}", (0..count).map(line).collect::<String>())
}

#[test]
fn numbers_that_name_something_are_no_instants_and_no_sensors() {
    let row = |index: usize| format!("{},hall,{},Mar 2 2009 {}", 1_000_000_100 + index, index % 2, clock(index));
    let (rows, sensors, log) = sensors_of(&table("event_id,sensor,state,when_it_was", 24, row));
    assert_eq!(
        (rows, &sensors[..], taken(&log, ColumnRole::Time)),
        (24, &["hall".to_owned()][..], vec!["when_it_was"])
    );
    assert_eq!(told(&log)[1].0, 60.0);
    let row = |index: usize| format!("1000000123,{index},T,{index}.5");
    let (rows, sensors, _) = sensors_of(&table("account_id,entry_id,reading_time,kwh", 24, row));
    assert_eq!((rows, &sensors[..]), (24, &["kwh".to_owned()][..]));
    // The control: numbers since 1970 under a heading of their own are the time.
    let row = |index: usize| format!("{},hall,{}", 1_235_977_200 + 60 * index, index % 2);
    assert_eq!(sensors_of(&table("time,sensor,state", 24, row)).2.events[1].at, SEVEN + MINUTE);
}

#[test]
fn values_of_intervals_are_kept_and_nothing_is_lost_without_a_word() {
    let values = |word: &dyn Fn(usize) -> &'static str| {
        let (rows, _, log) =
            sensors_of(&table("start,end,sensor,value", 24, |row| format!("T,2009-03-02 09:00:00,bed,{}", word(row))));
        (rows, log.values)
    };
    assert_eq!(values(&|_| "closed"), (24, vec!["closed".to_owned()]));
    assert_eq!(values(&|row| ["DONE", "MISSED"][row % 2]), (24, vec!["DONE".to_owned(), "MISSED".into()]));
    let numbers = table("Consumption (kwh),Start,End", 24, |row| format!("0.{row},T,2009-03-02 08:00:00"));
    let (rows, sensors, log) = sensors_of(&numbers);
    assert_eq!((rows, &sensors[..]), (24, &["Consumption (kwh)".to_owned()][..]));
    assert!(log.remarks.iter().any(|remark| remark.contains("are left out")), "{:?}", log.remarks);
}

#[test]
fn the_sensor_is_the_column_that_parts_the_rows() {
    let named = |text: &str| sensors_of(text).1;
    let two = |a: &str, b: &str| vec![a.to_owned(), b.to_owned()];
    // A column that never changes loses, whatever its heading.
    let row = |index: usize| format!("T,{},***,ON", ["hall", "bath"][index % 2]);
    assert_eq!(named(&table("Time,Door,Name,Result", 24, row)), two("bath", "hall"));
    let row = |index: usize| format!("MAC{},Std,2009-03-02 {},0.{index},A,KWH", index / 12, clock(index % 12));
    assert_eq!(named(&table("LCLid,tariff,DateTime,KWH/hh,group,Unity", 24, row)), two("MAC0", "MAC1"));
    // Numbers of meters are names.
    let row = |index: usize| format!("57131317400000000{},2009-03-02 {},0.{index},KWH", index / 12, clock(index % 12));
    assert_eq!(named(&table("MeterID,from,amount of energy,Unity", 24, row)).len(), 2);
    // Notes in some rows name no sensor.
    let row = |index: usize| format!("T,36.{index},{}", if index.is_multiple_of(3) { "took a pill" } else { "" });
    assert_eq!(named(&table("Time,Temperature,Remarks", 24, row)), ["Temperature"]);
    // Two columns with the same names are not guessed.
    let row = |index: usize| format!("T,{},{},{index}", ["A", "B"][index % 2], ["B", "A", "C"][index % 3]);
    let error = why(&table("Time,from team,to team,goals", 24, row));
    assert_eq!(error.code, "log-table::ambiguous-sensors");
}

#[test]
fn columns_about_a_device_are_part_of_the_sensor_name() {
    let row = |index: usize| match index % 3 {
        0 => "Hall PIR,motion,active,T".to_owned(),
        1 => "Hall PIR,motion,inactive,T".to_owned(),
        _ => format!("Hall PIR,temperature,20.{index},T"),
    };
    let (rows, sensors, _) = sensors_of(&table("Device,Name,Value,Date", 24, row));
    assert_eq!((rows, sensors), (24, vec!["Hall PIR motion".to_owned(), "Hall PIR temperature".into()]));
    let row = |index: usize| format!("b1,{},{},T", ["va_temperature", "va_humidity"][index % 2], 40 + index);
    assert_eq!(sensors_of(&table("Device ID,DP Code,Value,Event Time", 24, row)).1.len(), 2);
    // The control: a word that only repeats the value is not part of the name.
    let row = |index: usize| format!("b1,{},{},T", ["has come on", "is off"][index % 2], ["ON", "OFF"][index % 2]);
    assert_eq!(sensors_of(&table("Device,Code,Value,Date", 24, row)).1, ["b1"]);
}

#[test]
fn units_brackets_and_thousands_are_no_part_of_a_number() {
    let row = |index: usize| format!("T,21.{} °C,{} W,{}%", 10 + index, [0, 120][index % 2], index);
    let (rows, sensors, log) = sensors_of(&table("Time,Living,Power,Damper", 24, row));
    assert_eq!((rows, sensors.len(), &*log.values[0]), (72, 3, "21.10"));
    assert_eq!(log.known.iter().filter(|known| known.unit.is_some()).count(), 3);
    let (rows, sensors, log) =
        sensors_of(&table("start,duration,value", 24, |index| format!("T,[60],[{}]", 60 + index)));
    assert_eq!((rows, sensors.len(), &*log.values[0]), (24, 1, "60"));
    let row = |index: usize| format!("T;12.3{},85;1.{}", 10 + index, 280 + index);
    let (_, _, log) = sensors_of(&table("Zeit;Zähler;Leistung", 24, row));
    assert_eq!(&log.values[..2], ["12310.85", "1280"]);
    // The control: a point before two digits is one of decimals.
    let (_, _, log) = sensors_of(&table("Zeit;Zähler;Leistung", 24, |index| format!("T;1,{index};1.2")));
    assert_eq!(log.values[1], "1.2");
}

#[test]
fn skips_and_reports_rows_above_the_heading() {
    let row = |index: usize| format!("T;{};{}", ["hall", "bath"][index % 2], ["ON", "OFF"][index / 2 % 2]);
    for (above, told_of) in [
        ("sep=;\n", "line 1 is above"),
        ("# made by a program\n# in 2009\n", "lines 1 to 2 are above"),
        ("Name;Jane\nStreet;Main\n\n", "lines 1 to 2 are above"),
        ("Station;Long;Lat\nhome;8.54;47.37\n", "lines 1 to 2 are above"),
    ] {
        let (rows, sensors, log) = sensors_of(&format!("{above}{}", table("Time;Sensor;State", 24, row)));
        assert_eq!((rows, sensors.len(), log.skipped), (24, 2, 0), "{above}");
        assert!(log.remarks.iter().any(|remark| remark.contains(told_of)), "{:?}", log.remarks);
    }
    let units = table("Time;EG;OG\n[-];[°C];[°C]", 24, |index| format!("T;2{}.5;19.{index}", index % 3));
    assert_eq!(sensors_of(&units).1, ["EG", "OG"]);
    let twice = ";SN 1;SN 1;SN 2;SN 2\n;yield;power;yield;power\nformat;kWh;kW;kWh;kW";
    let twice = table(twice, 24, |index| format!("T;1,{index};2,{index};3,{index};4,{index}"));
    assert_eq!(sensors_of(&twice).1, ["SN 1 power", "SN 1 yield", "SN 2 power", "SN 2 yield"]);
    // A column of the rows' numbers may be called `#`.
    let counted = table("#,time,sensor,value", 24, |index| format!("{index},T,hall,{}", ["ON", "OFF"][index % 2]));
    assert_eq!(sensors_of(&counted).1, ["hall"]);
}

#[test]
fn letters_of_windows_midnights_and_clocks_are_read() {
    let path = folder();
    let mut bytes = b"time,sensor,value\n".to_vec();
    (0..24).for_each(|index| bytes.extend(format!("2009-03-02 {},K\u{1}che,ON\n", clock(index)).bytes()));
    bytes.iter_mut().filter(|byte| **byte == 1).for_each(|byte| *byte = 0xfc);
    fs::write(path.path().join("log.csv"), bytes).unwrap();
    let log = read(&path.url("csv:log.csv"), &LoggerFile::default()).unwrap();
    assert_eq!(log.sensors, ["Küche"]);
    assert!(log.remarks.iter().any(|remark| remark.contains("windows-1252")), "{:?}", log.remarks);
    let midnight =
        table("date;clock;kWh", 24, |index| format!("02.03.2009;{};0,{index}", ["23:00", "24:00"][index % 2]));
    assert_eq!(sensors_of(&midnight).2.skipped, 0);
    assert_eq!(sensors_of(&table("Date/time UTC,hall", 24, |index| format!("T,2{index}.5"))).2.clock, Clock::Utc);
    let days = table("Time,Sensor,State", 24, |index| format!("39874.{},hall,{}", 300 + index, index % 2));
    assert_eq!(sensors_of(&days).2.events[0].at, SEVEN + 12 * MINUTE);
    let labels = table("Time,ItemName,Value", 24, |index| match index {
        2 => "T,label,START:Kitchen|Cooking".to_owned(),
        9 => "T,label,STOP:Kitchen|Cooking".to_owned(),
        _ => format!("T,door,{}", ["ON", "OFF"][index % 2]),
    });
    let (rows, sensors, log) = sensors_of(&labels);
    assert_eq!((rows, sensors.len(), log.activities.len()), (22, 1, 1));
}

#[test]
fn lists_of_other_things_are_refused_with_the_reason() {
    let place = |index: usize| ["web", "mail", "news"][index % 3];
    for (text, code) in [
        (
            table("When,Url,Page", 24, |row| format!("T,https://example.org/{row},{}", place(row))),
            "log-table::other-list",
        ),
        (table("Call,When,Number", 24, |row| format!("{},T,+4179555{row:04}", place(row))), "log-table::other-list"),
        (table("When,Email,Task", 24, |row| format!("T,a@example.org,{}", place(row))), "log-table::other-list"),
        (
            table("When,Product,Quantity,Price", 24, |row| format!("T,{},{row},19.9", place(row))),
            "log-table::other-list",
        ),
        (table("When,Are you well?,Note", 24, |row| format!("T,{row},{}", place(row))), "log-table::other-list"),
        (table("when,author,subject", 24, |row| format!("T,{},mend the part {row}", place(row))), "log-table::prose"),
        (
            rows(24, |row, _, _| format!("2026-02-02 {},Z-Wave,the lamp {row} was set to on", clock(row))),
            "log-table::rows-in-sentences",
        ),
        (table("time,lat,lon,speed", 24, |row| format!("T,47.{row},8.{row},{row}")), "log-table::track"),
    ] {
        let error = why(&text);
        assert_eq!(error.code, code, "{error}");
    }
}

#[test]
fn persons_who_turn_a_lock_are_no_homes() {
    let row =
        |index: usize| format!("T,Front door,{},{}", ["Unlock", "Lock"][index % 2], ["Ben", "", "Ann"][index % 3]);
    let (rows, sensors, _) = sensors_of(&table("Date,Device,Action,User", 24, row));
    assert_eq!((rows, sensors), (24, vec!["Front door".to_owned()]));
}
