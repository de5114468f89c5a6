//! A database that was restored from a backup gets all rows that it lacks: the program asks it, and trusts no note.

use crate::folder::Folder;
use crate::postgres::Server;

#[test]
fn a_database_that_was_put_back_misses_no_row() {
    let Some(server) = Server::start() else { return };
    let folder = Folder::with("studio");
    let url = server.url("postgres", &server.database("put_back"), "");
    let rows = || -> u64 {
        server.try_psql("put_back", "SELECT count(*) FROM firing").map_or(0, |rows| rows.parse().unwrap())
    };
    let stop_beyond = |words: &str, wanted: u64| {
        let running = folder.start(&format!("{words} --quiet --out {url}"));
        folder.until("rows are there", |_| rows() > wanted);
        running.signal("INT");
        assert_eq!(running.finish().code, Some(130));
        rows()
    };
    let first = stop_beyond("run studio --for 3000d", 100);
    server.psql("postgres", "CREATE DATABASE put_back_backup TEMPLATE put_back");
    let second = stop_beyond("run --resume runs/studio-1", first + 100);
    server.psql("postgres", "DROP DATABASE put_back");
    server.psql("postgres", "ALTER DATABASE put_back_backup RENAME TO put_back");
    assert_eq!(rows(), first, "the control: it was put back");
    let last = stop_beyond("run --resume runs/studio-1", second + 100);
    let found = server.psql("put_back", "SELECT count(DISTINCT seq) || ' ' || max(seq) + 1 FROM firing");
    assert_eq!(found, format!("{last} {last}"), "a row is missing");
}
