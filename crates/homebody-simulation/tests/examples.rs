//! The examples work as described.

#[path = "../examples/own_driver.rs"]
mod own_driver;
#[path = "../examples/own_sink.rs"]
mod own_sink;
#[path = "../examples/run.rs"]
mod run;

use homebody_simulation::Destinations;

#[test]
fn the_run_has_the_firings_that_the_same_run_stores() {
    let folder = tempfile::tempdir().unwrap();
    let same =
        homebody_simulation::template("tigerplace-depression").unwrap().run().seed(7).days(2).without(["depression"]);
    let lived = same.start().unwrap().store(&Destinations::new_folder_in(folder.path()), |_| ()).unwrap();
    assert_eq!(run::firings(2).unwrap() as u64, lived.recording.firings);
    assert_ne!(run::firings(1).unwrap() as u64, lived.recording.firings);
    run::main().unwrap();
}

#[test]
fn the_driver_walks_where_it_says_and_nowhere_else() {
    let firings = own_driver::firings().unwrap();
    let of = |name: &str| firings.iter().find(|(known, _)| known == name).unwrap().1;
    assert!(of("living room motion") > 500, "{firings:?}");
    assert_eq!((of("bedroom motion"), of("bathroom motion")), (0, 0), "{firings:?}");
    own_driver::main().unwrap();
}

#[test]
fn the_sink_takes_every_firing_in_its_hour() {
    let own_sink::ByHour(sensors) = own_sink::by_hour(2).unwrap();
    let mut run = homebody_simulation::template("tigerplace").unwrap().run().days(2).start().unwrap();
    assert_eq!(sensors.len(), run.sensors().count());
    let mut firings = 0;
    while let Some(batch) = run.next_batch().unwrap() {
        firings += batch.firings.len() as u64;
    }
    assert_eq!(sensors.values().flatten().sum::<u64>(), firings);
    let nights: u64 = sensors.values().map(|hours| hours[2] + hours[3]).sum();
    assert!(nights * 6 < firings, "two hours in which she mostly sleeps: {nights} of {firings}");
    own_sink::main().unwrap();
}
