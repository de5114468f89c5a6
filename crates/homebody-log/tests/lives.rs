//! What a run's truth tells of its residents is read back.

mod stage;

use homebody_core::event::{Events, Fact};
use homebody_core::ids::{ResidentId, RoomId};
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::time::{Micros, SECOND};
use homebody_log::{Activity, Life, RowsOfFirings, lives};
use stage::Folder;

const HOUR: Micros = 3600 * SECOND;

#[test]
fn each_residents_activities_and_rooms_are_told() {
    let activity = |resident, at, name: Option<&str>| Fact::Activity { resident, at, name: name.map(String::from) };
    let facts = vec![
        Fact::Room { resident: ResidentId(0), at: 0, room: Some(RoomId(0)) },
        activity(ResidentId(0), 0, Some("sleeping")),
        Fact::Room { resident: ResidentId(1), at: 0, room: Some(RoomId(1)) },
        Fact::Room { resident: ResidentId(0), at: HOUR, room: None },
        activity(ResidentId(0), HOUR, None),
        Fact::Room { resident: ResidentId(0), at: HOUR + SECOND, room: Some(RoomId(1)) },
        activity(ResidentId(0), 2 * HOUR, Some("cooking")),
    ];
    // The clock on the wall, and the world's, six hours later.
    for (time, start) in [(TimeFormat::Local, 1_236_463_200 * SECOND), (TimeFormat::EpochS, 1_236_484_800 * SECOND)] {
        let folder = Folder::new(&format!("lives-{time:?}"));
        let file = LoggerFile { time, ..LoggerFile::default() };
        let path = folder.path().join("truth.db");
        let mut log = stage::open_truth(&path, &[], &file).unwrap();
        log.store(&Events { firings: Vec::new(), facts: facts.clone() }, &RowsOfFirings::default()).unwrap();
        log.finish(3 * HOUR).unwrap();

        let span = |name: &str, begin, end| Activity { name: name.into(), begin: start + begin, end: start + end };
        let ann = Life {
            resident: "margaret".into(),
            activities: vec![span("sleeping", 0, HOUR), span("cooking", 2 * HOUR, 3 * HOUR)],
            rooms: vec![span("bedroom", 0, HOUR), span("kitchen", HOUR + SECOND, 3 * HOUR)],
        };
        let bob = Life { resident: "walter".into(), activities: vec![], rooms: vec![span("kitchen", 0, 3 * HOUR)] };
        assert_eq!(lives(&path).unwrap(), [ann, bob], "{time:?}");
    }
}
