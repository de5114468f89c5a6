//! A server stops while 1,000 rows come a second: they go into a spool on disk, and the server has each once later.
//!
//! `HOMEBODY_OUTAGE_S` says for how many seconds; the figures in `docs/how-to/postgresql.md` are those of 60.

use crate::alone::is_alone;
use crate::outages::{MOST_MIB, Outage, most_mib};
use crate::stage::Server;
use crate::stage::life::{destination, firings, run};
use homebody_log::Policy;

const USUAL_S: u64 = 3;

#[test]
fn a_server_that_stops_under_load_gets_each_row_once() {
    if !is_alone("outage::a_server_that_stops_under_load_gets_each_row_once", &[]) {
        return;
    }
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
