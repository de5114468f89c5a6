//! Parts of benchmarks: the rows of a log, a bare loop that inserts them, and the middle of some measurements.

mod spread;

use rusqlite::{Connection, params};
pub use spread::Spread;
use std::fs;
use std::path::Path;
use std::time::Instant;

/// The rows of a log: time, sensor, value.
pub fn rows(path: &Path) -> Vec<[String; 3]> {
    let connection = Connection::open(path).expect("the log");
    let mut select = connection.prepare("SELECT fired_at, sensor, value FROM firing ORDER BY seq").expect("a table");
    let rows = select.query_map([], |row| Ok([row.get(0)?, row.get(1)?, row.get(2)?])).expect("rows");
    rows.collect::<Result<_, _>>().expect("rows of text")
}

/// One prepared statement in one transaction, a row at a time; seconds.
pub fn insert(path: &Path, rows: &[[String; 3]]) -> f64 {
    let _ = fs::remove_file(path);
    let start = Instant::now();
    let mut connection = Connection::open(path).expect("a database");
    let table = "CREATE TABLE firing (run_id INTEGER, seq INTEGER, fired_at TEXT, sensor TEXT, value TEXT, \
                 PRIMARY KEY (run_id, seq)) WITHOUT ROWID";
    connection.execute_batch(table).expect("a table");
    let transaction = connection.transaction().expect("a transaction");
    {
        let mut insert = transaction.prepare("INSERT INTO firing VALUES (?, ?, ?, ?, ?)").expect("a statement");
        for (seq, [fired_at, sensor, value]) in rows.iter().enumerate() {
            insert.execute(params![1, seq as i64, fired_at, sensor, value]).expect("a row");
        }
    }
    transaction.commit().expect("a commit");
    connection.close().expect("a closed database");
    start.elapsed().as_secs_f64()
}
