//! Killing the program or the server loses and doubles no confirmed row.
//!
//! `HOMEBODY_KILLS` says how often; the release's figures are those of 1,000 programs and 200 servers.

use crate::stage::life::{Life, patient};
use crate::stage::{Chance, Server, kills};
use homebody_log::{Policy, WriteMode};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The child's run, its place, and whether it resumes.
const CHILD: &str = "HOMEBODY_TEST_LIFE";
const NAIVE: &str = "HOMEBODY_TEST_NAIVE";
const FIRINGS: u64 = 12_000;
const UNDISTURBED: i64 = 1_000_000;

fn life(run: i64, how: WriteMode) -> Life {
    Life { settles: 4, rests: Duration::from_millis(2), how, ..Life::new(run, FIRINGS) }
}

/// The child: runs until it is killed. As a test of its own it has nothing to do.
#[test]
fn child() {
    let Ok(said) = std::env::var(CHILD) else { return };
    let [run, how, url] = said.splitn(3, ' ').collect::<Vec<_>>().try_into().unwrap();
    let how = if how == "new" { WriteMode::Create } else { WriteMode::Resume };
    life(run.parse().unwrap(), how).live(url, Some(url), Policy::default()).unwrap();
}

fn spawn(run: i64, how: &str, url: &str) -> Child {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["killed::child", "--exact", "--test-threads", "1"]).env(CHILD, format!("{run} {how} {url}"));
    command.stdout(Stdio::null()).spawn().unwrap()
}

#[test]
fn a_killed_program_loses_and_doubles_no_row() {
    let Some((server, database, url)) = Server::with_database("killed") else { return };
    let undisturbed = undisturbed(server, &database, &url);
    let (chance, wanted) = (Chance::new(11), kills(8));
    let (mut killed, mut run, mut begun, mut with_rows, mut lives) = (0, 1, false, 0, 0);
    while killed < wanted || begun {
        let mut child = spawn(run, if begun { "on" } else { "new" }, &url);
        // Once it has them all, it may come to its end.
        let until =
            Instant::now() + Duration::from_millis(if killed < wanted { 40 + chance.below(500) } else { 60_000 });
        let ended = loop {
            match child.try_wait().unwrap() {
                Some(status) => break Some(status),
                None if Instant::now() >= until => break None,
                None => std::thread::sleep(Duration::from_millis(1)),
            }
        };
        match ended {
            Some(status) => {
                assert!(status.success(), "a life that nobody kills comes to its end");
                check(server, &database, run, &undisturbed);
                (run, begun, lives) = (run + 1, false, lives + 1);
            }
            None => {
                child.kill().unwrap();
                child.wait().unwrap();
                killed += 1;
                let there = format!(
                    "SELECT to_regclass('public.homebody_run') IS NOT NULL AND EXISTS (SELECT FROM homebody_run WHERE run_id = {run})"
                );
                begun = server.psql(&database, &there) == "t";
                with_rows += usize::from(begun && rows(server, &database, run) > 0);
            }
        }
    }
    println!(
        "{killed} kills of the program in {lives} lives, {with_rows} of them with rows stored: nothing lost, nothing doubled"
    );
    assert!(with_rows > 0, "some were killed with rows stored");
}

/// The wrong way: it keeps how far it has come apart from the rows, in a table without a key.
#[test]
fn naive_child() {
    let Ok(url) = std::env::var(NAIVE) else { return };
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
    runtime.block_on(async {
        let (client, connection) = tokio_postgres::connect(&url, tokio_postgres::NoTls).await.unwrap();
        tokio::spawn(connection);
        loop {
            let add = "INSERT INTO naive SELECT generate_series(rows, rows + 99) FROM mark";
            client.batch_execute(add).await.unwrap();
            client.batch_execute("UPDATE mark SET rows = rows + 100").await.unwrap();
        }
    });
}

#[test]
fn a_watermark_apart_from_its_rows_is_caught() {
    /// In so many kills it has to show.
    const KILLS: u64 = 40;
    let Some(server) = Server::shared() else { return };
    let database = server.database("naive_killed");
    server.psql(
        &database,
        "CREATE TABLE naive (seq bigint); CREATE TABLE mark (rows bigint); INSERT INTO mark VALUES (0)",
    );
    let chance = Chance::new(3);
    let url = format!("host={} user=postgres dbname={database}", server.folder().display());
    for kill in 1..=KILLS {
        let mut command = Command::new(std::env::current_exe().unwrap());
        command.args(["killed::naive_child", "--exact", "--test-threads", "1"]).env(NAIVE, &url).stdout(Stdio::null());
        let mut child = command.spawn().unwrap();
        std::thread::sleep(Duration::from_millis(30 + chance.below(100)));
        child.kill().unwrap();
        child.wait().unwrap();
        let twice = "SELECT count(*) - count(DISTINCT seq) FROM naive";
        if server.psql(&database, twice) != "0" {
            println!("a watermark apart from its rows was caught at kill {kill}");
            return;
        }
    }
    panic!("{KILLS} kills, and nothing was seen");
}

#[test]
fn a_killed_server_loses_and_doubles_no_row() {
    let Some(mut server) = Server::start() else { return };
    let database = server.database("killed");
    let url = server.url("postgres", &database, "");
    let undisturbed = undisturbed(&server, &database, &url);
    let (chance, wanted) = (Chance::new(5), kills(8).div_ceil(3));
    let mut run = 0;
    let mut killed = 0;
    while killed < wanted {
        run += 1;
        let url = url.clone();
        // In every other life thousands of rows are on their way before a transaction ends.
        let life = Life { settles: if run % 2 == 1 { 60 } else { 4 }, ..life(run, WriteMode::Create) };
        let life = std::thread::spawn(move || life.live(&url, Some(&url), patient(60)));
        while killed < wanted && !life.is_finished() {
            std::thread::sleep(Duration::from_millis(30 + chance.below(400)));
            server.kill();
            server.restart();
            killed += 1;
        }
        life.join().unwrap().unwrap();
        check(&server, &database, run, &undisturbed);
    }
    println!("{killed} kills of the server in {run} lives: nothing lost, nothing doubled");
}

/// Lives the run once in peace: the dumps of its log and its truth.
fn undisturbed(server: &Server, database: &str, url: &str) -> [String; 2] {
    let life = Life { rests: Duration::ZERO, ..life(UNDISTURBED, WriteMode::Create) };
    life.live(url, Some(url), Policy::default()).unwrap();
    server.dumps(database, UNDISTURBED)
}

fn check(server: &Server, database: &str, run: i64, undisturbed: &[String; 2]) {
    let sql = format!("SELECT count(*), count(DISTINCT seq), max(seq) + 1 FROM firing WHERE run_id = {run}");
    assert_eq!(server.psql(database, &sql), format!("{FIRINGS}|{FIRINGS}|{FIRINGS}"), "run {run}");
    assert_eq!(&server.dumps(database, run), undisturbed, "run {run} is as if nobody had disturbed it");
}

fn rows(server: &Server, database: &str, run: i64) -> u64 {
    let sql = format!("SELECT rows[1] FROM homebody_run WHERE run_id = {run}");
    server.psql(database, &sql).parse().unwrap()
}
