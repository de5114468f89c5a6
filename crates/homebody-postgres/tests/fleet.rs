//! Many homes over one connection: the server has each row once, whatever happens to server and program.

use crate::stage::life::{Life, firings, run};
use crate::stage::{Server, kills};
use homebody_core::scenario::logger::LoggerFile;
use homebody_core::time::UtcTime;
use homebody_log::fleet::{Fleet, FleetEvent, FleetHome, FleetLayout, FleetRow, FleetSink};
use homebody_log::{LogError, Policy, Url, WriteMode};
use homebody_postgres::PostgresFleet;
use std::sync::Arc;

const HOMES: u32 = 7;

fn fleet() -> Arc<Fleet> {
    let other = LoggerFile { table: Some("message".into()), ..LoggerFile::default() };
    let layouts = [LoggerFile::default(), other].map(|file| FleetLayout::new(run(0), &file).unwrap()).into();
    let home = |number: u32| FleetHome {
        name: format!("home{number:05}"),
        layout: number as usize % 2,
        run: 500 + i64::from(number),
        seed: u64::MAX,
    };
    Arc::new(Fleet { first: 1, layouts, homes: (1..=HOMES).map(home).collect() })
}

fn rows(numbers: std::ops::Range<u64>) -> Vec<FleetEvent> {
    let firings = firings(numbers.end);
    let row = |home: u32, number: u64| {
        let firing = &firings[number as usize];
        let (seq, at, sensor, value) = (firing.seq, firing.at, firing.sensor, firing.value);
        FleetEvent::Row(FleetRow { seq, at, due: UtcTime::EPOCH, home, sensor, value })
    };
    numbers.flat_map(|number| (0..HOMES).map(move |home| (home, number))).map(|(h, n)| row(h, n)).collect()
}

fn begun(url: &str, how: WriteMode) -> Result<(PostgresFleet, Vec<u64>), LogError> {
    let mut sink = PostgresFleet::new(&url.parse::<Url>().unwrap());
    sink.check(true)?;
    let there = sink.begin(&fleet(), how, &homebody_log::Deadline::default())?;
    Ok((sink, there))
}

/// Of each home: how many rows there are, the number of the last, and what the database says of both.
fn stored(server: &Server, database: &str) -> Vec<String> {
    let sql = "SELECT r.home, count(*), max(a.seq) + 1, r.rows[1] FROM homebody_run r \
               JOIN (SELECT * FROM firing UNION ALL SELECT * FROM message) a USING (run_id) GROUP BY 1, 4 ORDER BY 1";
    server.psql(database, sql).lines().map(str::to_owned).collect()
}

fn all_have(rows: u64) -> Vec<String> {
    (1..=HOMES).map(|home| format!("home{home:05}|{rows}|{rows}|{rows}")).collect()
}

#[test]
fn rows_of_many_homes_survive_killed_servers_once() {
    let Some(mut server) = Server::start() else { return };
    let database = server.database("fleet");
    let url = server.url("postgres", &database, "");
    let (mut sink, there) = begun(&url, WriteMode::Create).unwrap();
    assert_eq!(there, vec![0; HOMES as usize]);
    let mut told = 0;
    for kill in 0..kills(3) as u64 {
        for _ in 0..3 {
            sink.tell(&rows(told..told + 20)).unwrap();
            told += 20;
        }
        let next = rows(told..told + 20 + kill);
        server.kill();
        let told_to_the_dying = sink.tell(&next);
        server.restart();
        // A process of the server that outlives its first one for a moment may have taken them.
        if let Err(error) = told_to_the_dying {
            assert!(error.passes(), "{error}");
            sink.tell(&next).unwrap();
        }
        told += 20 + kill;
        assert_eq!(stored(&server, &database), all_have(told));
    }
    // After this program has died, another one gets the watermark of each home.
    drop(sink);
    let (mut sink, there) = begun(&url, WriteMode::Create).unwrap();
    assert_eq!(there, vec![told; HOMES as usize]);
    sink.tell(&rows(told..told + 5)).unwrap();
    sink.finish(UtcTime::from_micros(1_236_500_000_000_000)).unwrap();
    assert_eq!(stored(&server, &database), all_have(told + 5));
    let ended = "SELECT count(*) FROM homebody_run WHERE ended_at = '2009-03-08 08:13:20+00'";
    assert_eq!(server.psql(&database, ended).trim(), HOMES.to_string());
    // The rows are those that a home alone would have left.
    Life::new(502, told + 5)
        .live(&server.url("postgres", &database, "&schema=alone"), None, Policy::default())
        .unwrap();
    let differs = |run: i64| {
        let of = |schema: &str, run: i64| {
            format!("SELECT seq, fired_at, sensor, value FROM {schema}.firing WHERE run_id = {run}")
        };
        let sql = format!("SELECT count(*) FROM ({} EXCEPT {}) a", of("public", run), of("alone", 502));
        server.psql(&database, &sql).trim().to_owned()
    };
    assert_eq!(differs(502), "0");
    // Replaced, it begins anew.
    let (_, there) = begun(&url, WriteMode::Overwrite).unwrap();
    assert_eq!(there, vec![0; HOMES as usize]);
    assert_eq!(stored(&server, &database), Vec::<String>::new());
}

/// The control: if another program has continued a home, nothing is added.
#[test]
fn two_programs_never_run_one_home() {
    let Some((server, database, url)) = Server::with_database("twice") else { return };
    let (mut one, _) = begun(&url, WriteMode::Create).unwrap();
    let (mut other, _) = begun(&url, WriteMode::Create).unwrap();
    one.tell(&rows(0..10)).unwrap();
    let error = other.tell(&rows(0..10)).unwrap_err();
    assert!(!error.passes() && error.code() == "postgresql-resume::other-program", "{error}");
    one.tell(&rows(10..20)).unwrap();
    assert_eq!(stored(server, &database), all_have(20));
    let error = begun(&server.url("postgres", &database, "&run=7"), WriteMode::Create).err().unwrap();
    assert_eq!(error.code(), "postgresql-url::fleet-run", "{error}");
}
