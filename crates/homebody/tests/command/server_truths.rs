//! Ground truth on a server: a killed run continues it there, and refuses one that it cannot continue.

use crate::folder::Folder;
use crate::postgres::Server;

#[test]
fn a_truth_on_a_server_is_completed_after_a_death() {
    let Some(server) = Server::start() else { return };
    let folder = Folder::with("studio");
    let places = |database: &str| {
        let url = server.url("postgres", &server.database(database), "");
        format!("--quiet --out {url} --truth {url}")
    };
    let (killed, whole) = (places("killed"), places("whole"));
    let rows = || -> u64 {
        let movements = "SELECT count(*) FROM truth.movement";
        server.try_psql("killed", movements).map_or(0, |rows| rows.parse().unwrap())
    };
    let running = folder.start(&format!("run studio --for 6d --speed 1000 {killed}"));
    folder.until("the truth has rows", |_| rows() > 20);
    running.signal("KILL");
    running.finish();
    let before = rows();
    folder.run(&format!("run --resume runs/studio-1 {killed}")).ok();
    folder.run(&format!("run studio --for 6d {whole}")).ok();
    let run = server.psql("whole", "SELECT run_id FROM truth.homebody_run").parse().unwrap();
    for schema in ["public", "truth"] {
        assert_eq!(server.dump("killed", schema, run), server.dump("whole", schema, run), "{schema}");
    }
    assert!(rows() > before, "the control: the death was before the end");
    folder.run("run --resume runs/studio-1 --truth truth.db").fails(2, "error[run::middle-of-run]");
}
