//! Rows into PostgreSQL: what a destination with all its promises costs beside a bare loop of binary COPY of the same rows, and
//! what it costs to keep how far a run has come in the transactions of its rows.
//!
//! Both sides of a ratio take turns in one run, on a server that waits for the disk at each commit. Ends with one line per
//! figure: `RATIO <name> <median> <min>..<max>`. Where PostgreSQL is not installed, nothing is measured.

#[path = "../../homebody-core/benches/measure/spread.rs"]
mod spread;
#[path = "../tests/stage/mod.rs"]
mod stage;

use homebody_core::event::Value;
use homebody_core::scenario::logger::TimeFormat;
use homebody_core::time::RunTime;
use homebody_log::table::{Batch, Cell, Column, ColumnKind, Table, TextPool};
use homebody_log::{Begin, Sink, WriteMode};
use homebody_postgres::Postgres;
use spread::Spread;
use stage::{Server, life};
use std::pin::pin;
use std::time::{Duration, Instant, SystemTime};
use tokio::runtime::{Builder, Runtime};
use tokio_postgres::binary_copy::BinaryCopyInWriter;
use tokio_postgres::types::Type;
use tokio_postgres::{Client, NoTls};

const ROUNDS: usize = 9;
const ROWS: u64 = 400_000;
/// Rows of a batch, as a run hands them over.
const BATCH: usize = 4096;
/// Rows of a transaction where the cost of a watermark is measured: as the destination ends one that is filled as fast as it can be.
const TRANSACTION: usize = 200_000;
/// Transactions of either kind in a round.
const PARTS: usize = ROWS as usize / TRANSACTION / 2;

const TABLE: &str = "CREATE TABLE firing (run_id bigint, seq bigint, fired_at timestamp with time zone, sensor text, value text, \
                     PRIMARY KEY (run_id, seq))";
const COPY: &str = "COPY firing (run_id, seq, fired_at, sensor, value) FROM STDIN (FORMAT binary)";
const TYPES: [Type; 5] = [Type::INT8, Type::INT8, Type::TIMESTAMPTZ, Type::TEXT, Type::TEXT];

/// A row as the bare loop has it.
type Bare = (i64, SystemTime, &'static str, String);

fn main() {
    let Some(server) = Server::start_with(&["max_wal_size=4GB"]) else { return };
    let rows = bare_rows();
    let batches = batches();
    let runtime = Builder::new_current_thread().enable_all().build().expect("a runtime");
    let mut lines = Vec::new();
    let mut ratios = Vec::new();
    for round in 0..ROUNDS {
        let mut both = [0.0; 2];
        // The order alternates, so that neither always finds the disk busy with the other's rows.
        for side in if round % 2 == 0 { [0, 1] } else { [1, 0] } {
            server.psql("postgres", "DROP TABLE IF EXISTS firing, homebody_run");
            server.psql("postgres", "CHECKPOINT");
            both[side] = if side == 0 { bare(&runtime, &server, &rows) } else { sink(&server, &batches) };
            assert_eq!(server.psql("postgres", "SELECT count(*) FROM firing"), ROWS.to_string());
        }
        println!("{ROWS} rows: bare loop {:.3} s, destination {:.3} s", both[0], both[1]);
        ratios.push(both[0] / both[1]);
    }
    lines.push(Spread::of(&ratios).line("destination_vs_bare_copy", 3));
    let [mut without, mut with] = [Vec::new(), Vec::new()];
    for round in 0..2 * ROUNDS {
        server.psql(
            "postgres",
            "DROP TABLE IF EXISTS firing, mark; CREATE TABLE mark (run_id bigint PRIMARY KEY, rows bigint[])",
        );
        server.psql("postgres", "INSERT INTO mark VALUES (1, '{0}')");
        server.psql("postgres", "CHECKPOINT");
        transactions(&runtime, &server, &rows, round, [&mut without, &mut with]);
    }
    let ratios: Vec<f64> = without.chunks(PARTS).zip(with.chunks(PARTS)).map(|(a, b)| middle(b) / middle(a)).collect();
    let medians = [&without, &with].map(|all| middle(all));
    println!("a transaction of {TRANSACTION} rows: {:.4} s, with a watermark {:.4} s", medians[0], medians[1]);
    println!("by rounds: {}", Spread::of(&ratios).line("", 3));
    lines.push(format!(
        "RATIO with_watermarks_vs_without {:.3}, of medians of {} each",
        medians[1] / medians[0],
        with.len()
    ));
    lines.iter().for_each(|line| println!("{line}"));
}

fn bare_rows() -> Vec<Bare> {
    let start = SystemTime::UNIX_EPOCH + Duration::from_secs(1_235_999_523);
    let row = |firing: &homebody_core::event::Firing| {
        let sensor = ["bedroom motion", "kitchen motion", "thermometer"][firing.sensor.index()];
        let value = if firing.value == Value::Fire { "ON".to_owned() } else { firing.value.to_string() };
        (firing.seq as i64, start + firing.at.since_zero().to_duration(), sensor, value)
    };
    life::firings(ROWS).iter().map(row).collect()
}

fn batches() -> Vec<Batch> {
    let mut texts = TextPool::default();
    let sensors = texts.ids(&["bedroom motion", "kitchen motion", "thermometer"].map(String::from));
    let on = Cell::Text(texts.id("ON"));
    let batch = |firings: &[homebody_core::event::Firing]| {
        let mut batch = Batch::with_capacity(BATCH, 4);
        for firing in firings {
            let value = if let Value::Reading(number) = firing.value { Cell::Thousandths(number) } else { on };
            let sensor = Cell::Text(sensors[firing.sensor.index()]);
            batch.push(0, [Cell::Integer(firing.seq as i64), Cell::Instant(firing.at), sensor, value]);
        }
        batch.with(&texts)
    };
    life::firings(ROWS).chunks(BATCH).map(batch).collect()
}

fn connected(runtime: &Runtime, server: &Server) -> Client {
    runtime.block_on(async {
        let url = format!("host={} user=postgres dbname=postgres", server.folder().display());
        let (client, connection) = tokio_postgres::connect(&url, NoTls).await.expect("a connection");
        tokio::spawn(connection);
        client
    })
}

async fn copy(client: &Client, rows: &[Bare]) {
    let mut writer = pin!(BinaryCopyInWriter::new(client.copy_in(COPY).await.expect("a COPY"), &TYPES));
    for (seq, at, sensor, value) in rows {
        writer.as_mut().write(&[&1_i64, seq, at, sensor, value]).await.expect("a row");
    }
    writer.finish().await.expect("all rows");
}

/// One COPY; seconds, with the connection and the table.
fn bare(runtime: &Runtime, server: &Server, rows: &[Bare]) -> f64 {
    let start = Instant::now();
    let client = connected(runtime, server);
    runtime.block_on(async {
        client.batch_execute(TABLE).await.expect("a table");
        copy(&client, rows).await;
    });
    start.elapsed().as_secs_f64()
}

/// The destination, from its beginning to its end; seconds.
fn sink(server: &Server, batches: &[Batch]) -> f64 {
    let start = Instant::now();
    let run = life::run(1);
    let url = server.url("postgres", "postgres", "").parse().expect("a URL");
    let column = |name: &str, kind| Column { name: name.into(), kind, unit: "", about: "" };
    let columns = vec![
        column("seq", ColumnKind::Integer),
        column("fired_at", ColumnKind::Instant),
        column("sensor", ColumnKind::Text),
        column("value", ColumnKind::Text),
    ];
    let table = Table { name: "firing".into(), about: "", columns, is_numbered: true, is_frequent: true };
    let mut sink = Postgres::new(&url);
    let begin = Begin::new(run.into(), vec![table], TimeFormat::Utc, WriteMode::Create);
    sink.begin(&begin).expect("a destination");
    for batch in batches {
        sink.write(batch).expect("taken rows");
    }
    sink.finish(RunTime::START).expect("a finished run");
    start.elapsed().as_secs_f64()
}

/// Transactions of COPY that have a watermark and that have none, in turns; the seconds of each.
fn transactions(runtime: &Runtime, server: &Server, rows: &[Bare], round: usize, took: [&mut Vec<f64>; 2]) {
    let client = connected(runtime, server);
    runtime.block_on(async {
        client.batch_execute(TABLE).await.expect("a table");
        for (number, rows) in rows.chunks(TRANSACTION).enumerate() {
            let has_watermark = (number + round) % 2 == 1;
            let start = Instant::now();
            client.batch_execute("BEGIN").await.expect("a transaction");
            if has_watermark {
                let look = "SELECT rows FROM mark WHERE run_id = $1 FOR UPDATE";
                client.query_one(look, &[&1_i64]).await.expect("a watermark");
            }
            copy(&client, rows).await;
            if has_watermark {
                let then = vec![(number * TRANSACTION + rows.len()) as i64];
                let set = "UPDATE mark SET rows = $2 WHERE run_id = $1";
                client.execute(set, &[&1_i64, &then]).await.expect("a watermark");
            }
            client.batch_execute("COMMIT").await.expect("a commit");
            took[usize::from(has_watermark)].push(start.elapsed().as_secs_f64());
        }
    });
}

fn middle(values: &[f64]) -> f64 {
    Spread::of(values).median
}
