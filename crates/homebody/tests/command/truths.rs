//! The queries of `docs/reference/truth.md` run, and give the documented answers.

use crate::folder::{Folder, ROOT};
use rusqlite::Connection;
use std::path::Path;

/// The queries of the page, in its order.
fn queries() -> Vec<String> {
    let page = std::fs::read_to_string(Path::new(ROOT).join("docs/reference/truth.md")).unwrap();
    let blocks = page.split("```sql\n").skip(1);
    blocks.map(|block| block.split("```").next().unwrap().to_owned()).collect()
}

/// Lives a scenario for two days into `log.db` and `truth.db`.
fn lived(scenario: &str) -> Folder {
    let folder = Folder::new();
    let out = "--out sqlite:log.db --truth truth.db --quiet";
    folder.run(&format!("run {ROOT}/scenarios/{scenario} --for 2d {out}")).ok();
    folder
}

/// The rows of a query, which may attach the ground truth next to the database.
fn ask(folder: &Folder, database: &str, query: &str) -> Vec<Vec<String>> {
    let truth = folder.path("truth.db").display().to_string();
    let query = query.replace("'truth.db'", &format!("'{truth}'"));
    let connection = Connection::open(folder.path(database)).unwrap();
    let query = match query.split_once(";\n").filter(|(first, _)| first.starts_with("ATTACH")) {
        Some((attach, rest)) => {
            connection.execute_batch(attach).unwrap();
            rest.to_owned()
        }
        None => query,
    };
    let mut statement = connection.prepare(&query).unwrap();
    let columns = statement.column_count();
    let cell = |row: &rusqlite::Row, at| match row.get_unwrap::<_, rusqlite::types::Value>(at) {
        rusqlite::types::Value::Null => String::new(),
        rusqlite::types::Value::Text(text) => text,
        rusqlite::types::Value::Real(number) => number.to_string(),
        rusqlite::types::Value::Integer(number) => number.to_string(),
        rusqlite::types::Value::Blob(_) => panic!("the truth has no blobs"),
    };
    let rows = statement.query_map([], |row| Ok((0..columns).map(|at| cell(row, at)).collect::<Vec<_>>())).unwrap();
    rows.map(Result::unwrap).collect()
}

#[test]
fn the_queries_of_the_page_answer_what_it_says() {
    let queries = queries();
    assert_eq!(queries.len(), 4);
    let folder = lived("tigerplace");

    let first_morning = ask(&folder, "log.db", &queries[0]);
    let rows = folder.query("log.db", "SELECT count(*) FROM event WHERE ts_local < '2009-03-02 12:00'");
    assert_eq!(rows, [first_morning.len().to_string()], "each row of the log has its cause");
    assert!(first_morning.iter().any(|row| row[3..] == ["margaret", "movement", "sleeping"]));
    assert!(first_morning.iter().any(|row| row[1] == "C3" && row[5] == "preparing_breakfast"), "the stove");

    let hours =
        |rows: &[Vec<String>], last: usize| rows.iter().map(|row| row[last].parse::<f64>().unwrap()).sum::<f64>();
    let spent = ask(&folder, "truth.db", &queries[2]);
    assert_eq!(spent[0][0], "sleeping");
    // Each row is rounded to a tenth.
    assert!((hours(&spent, 2) - 48.0).abs() < 0.05 * spent.len() as f64, "{spent:?}");
    let rooms = ask(&folder, "truth.db", &queries[3]);
    assert!(rooms.iter().any(|row| row[0] == "bedroom"));
    assert!((hours(&rooms, 1) - 48.0).abs() < 1.0, "{rooms:?}");

    let folder = lived("studio");
    let offs = ask(&folder, "log.db", &queries[1]);
    let rows = folder.query("log.db", "SELECT count(*) FROM firing WHERE value = 'OFF'");
    assert_eq!(rows, [offs.len().to_string()], "each OFF of a hold follows somebody's movement");
    assert!(offs.len() > 100 && offs.iter().all(|row| row[2] == "OFF" && !row[3].is_empty()));
}
