//! A server that is stopped while a thousand rows come a second: they are put aside on disk, and then it has each once.
//!
//! `HOMEBODY_OUTAGE_S` says for how many seconds; the figures in `docs/how-to/postgresql.md` are those of 60.

#[path = "../../../tests/outage.rs"]
mod outage;
mod stage;

use homebody_log::Policy;
use outage::{MOST_MIB, Outage, most_mib};
use stage::Server;
use stage::life::{destination, firings, run};

const USUAL_S: u64 = 3;

#[test]
fn a_stopped_server_has_each_row_of_a_fast_run_once() {
    let Some(mut server) = Server::start() else { return };
    let outage = Outage::of(USUAL_S);
    let to = destination(&server.url("postgres", &server.database("outage"), ""), &Policy::default());
    let rows = outage.rows();
    let turn = |is_back| if is_back { server.restart() } else { server.stop() };
    let most_aside = outage.live(to, run(1), &firings(rows), turn);
    let found = server.psql("outage", "SELECT count(*), count(DISTINCT seq), max(seq) FROM firing");
    println!(
        "stopped for {} s: {rows} rows, {found} found, counted and the highest; {} kB put aside, {} MiB at most",
        outage.seconds,
        most_aside / 1000,
        most_mib()
    );
    assert_eq!(found, format!("{rows}|{rows}|{}", rows - 1), "none is lost, none is there twice");
    assert!(most_mib() <= MOST_MIB, "{} MiB", most_mib());
}
