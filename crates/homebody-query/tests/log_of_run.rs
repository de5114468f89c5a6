//! The log in the folder of a run.

use homebody_query::LoadedLog;
use homebody_simulation::{Destinations, template};

#[test]
fn recording_of_a_log_gives_its_zone_and_home() {
    let folder = tempfile::tempdir().unwrap();
    let run = template("tigerplace").unwrap().run().days(0.25).start().unwrap();
    let summary = run.store(&Destinations::new_folder_in(folder.path()), |_| ()).unwrap();
    let folder = summary.recorded.unwrap().parent().unwrap().to_owned();
    let read = LoadedLog::read(&folder.display().to_string(), None).unwrap();
    assert_eq!(read.zone.as_ref().unwrap().iana_name(), Some("America/Chicago"));
    let named = read.scenario().unwrap().home.placed_sensors().len();
    assert!(named > 0 && named == summary.sensors.len(), "its home is known");
}
