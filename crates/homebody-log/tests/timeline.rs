//! Timelines of residents are built from the truth of a run.

use crate::stage::{self, Folder};
use homebody_core::calendar::Calendar;
use homebody_core::event::{Events, Fact};
use homebody_core::geometry::Point;
use homebody_core::ids::{ResidentId, RoomId};
use homebody_core::motion::MotionState;
use homebody_core::posture::Posture;
use homebody_core::scenario::logger::{LoggerFile, TimeFormat};
use homebody_core::scenario::scheme::Scheme;
use homebody_core::time::{HOUR, Interval, MINUTE, RunTime, SECOND, Span, TimeScale};
use homebody_log::{RowsOfFirings, RunInfo, TruthLog, Url, WriteMode, read_timeline};
use homebody_timeline::{Episode, PersonTimeline};
use std::sync::Arc;

fn at(span: Span) -> RunTime {
    RunTime::START + span
}

#[test]
fn reads_activities_and_rooms_of_each_resident() {
    let activity = |resident, after: Span, name: Option<&str>| Fact::Activity {
        resident,
        at: at(after),
        name: name.map(String::from),
    };
    let facts = vec![
        Fact::Room { resident: ResidentId(0), at: at(Span::ZERO), room: Some(RoomId(0)) },
        activity(ResidentId(0), Span::ZERO, Some("sleeping")),
        Fact::Room { resident: ResidentId(1), at: at(Span::ZERO), room: Some(RoomId(1)) },
        Fact::Room { resident: ResidentId(0), at: at(HOUR), room: None },
        activity(ResidentId(0), HOUR, None),
        Fact::Room { resident: ResidentId(0), at: at(HOUR + SECOND), room: Some(RoomId(1)) },
        activity(ResidentId(0), 2 * HOUR, Some("cooking")),
    ];
    // The clock on the wall, and the world's, six hours later.
    for (time, start) in [(TimeFormat::Local, 1_236_463_200), (TimeFormat::EpochS, 1_236_484_800)] {
        let start = at(start * SECOND);
        let folder = Folder::new(&format!("timeline-{time:?}"));
        let file = LoggerFile { time, ..LoggerFile::default() };
        let path = folder.path().join("truth.db");
        let mut log = stage::open_truth(&path, &[], &file).unwrap();
        log.store(&Events { facts: facts.clone(), ..Events::default() }, &RowsOfFirings::default()).unwrap();
        log.finish(at(3 * HOUR)).unwrap();

        let span = |label: &str, begin, end| Episode::new(label.to_owned(), Interval::new(start + begin, start + end));
        let ann = PersonTimeline {
            name: "margaret".into(),
            activities: vec![span("sleeping", Span::ZERO, HOUR), span("cooking", 2 * HOUR, 3 * HOUR)],
            rooms: vec![span("bedroom", Span::ZERO, HOUR), span("kitchen", HOUR + SECOND, 3 * HOUR)],
        };
        let rooms = vec![span("kitchen", Span::ZERO, 3 * HOUR)];
        let bob = PersonTimeline { name: "walter".into(), activities: vec![], rooms };
        let read = read_timeline(&Url::new(Scheme::Sqlite, &path), &TimeScale::one()).unwrap();
        assert_eq!(read.people, [ann, bob], "{time:?}");
    }
}

/// A resident who sleeps through the first of the two hours from one to two, and gets up in the second.
#[test]
fn movements_tell_a_repeated_hour() {
    let calendar = Calendar::new("2009-11-01T00:00:00", "America/Chicago").unwrap();
    let margaret = ResidentId(0);
    let end = at(5 * HOUR);
    let up = at(150 * MINUTE);
    let movement =
        |begin, end, doing| Fact::Movement { resident: margaret, begin, end, doing, posture: Posture::Lying };
    let [bed, kitchen] = [Point::new(1.0, 1.0), Point::new(4.0, 1.0)];
    let activity = |at, name: Option<&str>| Fact::Activity { resident: margaret, at, name: name.map(String::from) };
    let mut facts = vec![
        Fact::Room { resident: margaret, at: RunTime::START, room: Some(RoomId(0)) },
        activity(RunTime::START, Some("sleeping")),
    ];
    // The sleeper turns over now and then.
    let turns = [0, 40, 80, 118, 140].map(|minute| at(minute * MINUTE));
    for (index, &turn) in turns.iter().enumerate() {
        let until = turns.get(index + 1).copied().unwrap_or(up);
        facts.push(movement(turn, turn + SECOND, MotionState::InPlace { at: bed, amplitude_m: 0.1 }));
        facts.push(movement(turn + SECOND, until, MotionState::Rest { at: bed }));
    }
    facts.push(activity(up, Some("drinking")));
    facts.push(Fact::Room { resident: margaret, at: up + 2 * SECOND, room: Some(RoomId(1)) });
    facts.push(movement(up, up + 3 * SECOND, MotionState::Stride { from: bed, to: kitchen }));
    facts.push(movement(up + 3 * SECOND, end, MotionState::Rest { at: kitchen }));

    let span = |label: &str, begin, end| Episode::new(label.to_owned(), Interval::new(begin, end));
    let expected = PersonTimeline {
        name: "margaret".into(),
        activities: vec![span("sleeping", RunTime::START, up), span("drinking", up, end)],
        rooms: vec![span("bedroom", RunTime::START, up + 2 * SECOND), span("kitchen", up + 2 * SECOND, end)],
    };
    let scale = calendar.scale(end.since_zero());
    for (time, scale) in [(TimeFormat::Local, scale.clone()), (TimeFormat::Utc, scale.with_wall_of_utc())] {
        for scheme in [Scheme::Sqlite, Scheme::Csv] {
            let folder = Folder::new(&format!("turns-{time:?}-{scheme:?}"));
            let run = Arc::new(RunInfo { calendar: calendar.clone(), ..stage::run() });
            let url = Url::new(scheme, folder.path().join("truth"));
            let file = LoggerFile { time, ..LoggerFile::default() };
            let mut log = TruthLog::open(&url, &[], &file, &run, WriteMode::Create).unwrap();
            log.store(&Events { facts: facts.clone(), ..Events::default() }, &RowsOfFirings::default()).unwrap();
            log.finish(end).unwrap();
            assert_eq!(
                read_timeline(&url, &scale).unwrap().people,
                std::slice::from_ref(&expected),
                "{time:?}, {scheme:?}"
            );
            // Without the run, an activity on a wall that is set back is in two pieces, whose lengths are right.
            let pieces = &read_timeline(&url, &TimeScale::one()).unwrap().people[0].activities;
            let is_local = time == TimeFormat::Local;
            let slept: Span = pieces.iter().filter(|piece| piece.label == "sleeping").map(Episode::length).sum();
            let between_pieces = if is_local { Span::MICROSECOND } else { Span::ZERO };
            assert_eq!(slept + between_pieces, up.since_zero(), "{pieces:?}");
            assert!(pieces.iter().all(|piece| !piece.time.is_empty()), "{pieces:?}");
            // The control: the wall does go back.
            assert_eq!(pieces.windows(2).any(|pair| pair[1].begin() < pair[0].end()), is_local, "{pieces:?}");
        }
    }
}
