//! Each kind is counted once in a truth with one such event, and not at all in the same truth without it.

use super::*;
use homebody_core::event::ThingUse;
use homebody_core::geometry::Point;
use homebody_core::ids::{ResidentId, RoomId, ThingId};

fn at(minutes: f64) -> RunTime {
    RunTime::START + Span::from_seconds(minutes * 60.0)
}

/// A host, a visitor and their front door; the second room is the bathroom.
struct ShortTruth(HouseholdTruth);

impl ShortTruth {
    fn new() -> ShortTruth {
        let home = HouseholdHome { front_door: Some(0), are_bathrooms: vec![false, true] };
        ShortTruth(HouseholdTruth::new(vec![true, true], vec![(1, 0)], home))
    }

    /// Movements of a body, with begin and end in minutes.
    fn moves(mut self, body: usize, spans: &[(f64, f64, MotionState)]) -> ShortTruth {
        for &(begin, end, doing) in spans {
            let (resident, posture) = (ResidentId::new(body), Posture::Standing);
            self.0.take(&Fact::Movement { resident, begin: at(begin), end: at(end), doing, posture });
        }
        self
    }

    fn does(mut self, body: usize, rows: &[(f64, &str)]) -> ShortTruth {
        for &(begin, name) in rows {
            let name = (!name.is_empty()).then(|| name.to_owned());
            self.0.take(&Fact::Activity { resident: ResidentId::new(body), at: at(begin), name });
        }
        self
    }

    fn enters(mut self, body: usize, rooms: &[(f64, usize)]) -> ShortTruth {
        for &(begin, room) in rooms {
            let room = Some(RoomId::new(room));
            self.0.take(&Fact::Room { resident: ResidentId::new(body), at: at(begin), room });
        }
        self
    }

    fn door(mut self, uses: &[(f64, bool)]) -> ShortTruth {
        for &(time, on) in uses {
            let act = ThingUse { thing: ThingId(0), on };
            self.0.take(&Fact::Use { resident: Some(ResidentId::new(0)), at: at(time), act });
        }
        self
    }

    #[track_caller]
    fn counts(self, expected: &[ImpossibleKind]) {
        let found = self.0.impossible();
        let kinds: Vec<ImpossibleKind> = found.0.keys().copied().collect();
        assert_eq!(kinds, expected, "{found:?}");
        assert!(found.0.values().all(|count| count.events == 1), "{found:?}");
        assert_eq!(found.is_nothing(), expected.is_empty());
    }
}

fn rest(x: f64) -> MotionState {
    MotionState::Rest { at: Point::new(x, 0.0) }
}

fn walk(from: f64, to: f64) -> MotionState {
    MotionState::Stride { from: Point::new(from, 0.0), to: Point::new(to, 0.0) }
}

const OUT: MotionState = MotionState::Away;

#[test]
fn counts_people_who_touch_in_passing() {
    let passes = |by: f64| {
        let way = MotionState::Stride { from: Point::new(-2.0, by), to: Point::new(2.0, by) };
        ShortTruth::new().moves(0, &[(0.0, 1.0, rest(0.0))]).moves(1, &[(0.0, 1.0, way)])
    };
    passes(0.2).counts(&[ImpossibleKind::TooNear]);
    passes(0.35).counts(&[]);
    let stand = |by: f64| ShortTruth::new().moves(0, &[(0.0, 1.0, rest(0.0))]).moves(1, &[(0.0, 1.0, rest(by))]);
    stand(0.2).counts(&[ImpossibleKind::TooNear]);
    stand(0.5).counts(&[]);
}

#[test]
fn counts_waits_of_many_minutes() {
    ShortTruth::new().does(0, &[(0.0, WAITING), (5.0, "")]).counts(&[ImpossibleKind::LongWait]);
    ShortTruth::new().does(0, &[(0.0, WAITING), (1.0, ""), (2.0, WAITING), (3.0, "")]).counts(&[]);
}

#[test]
fn counts_activities_of_the_bathroom_in_other_rooms() {
    let queues = |until: f64| {
        let lives = ShortTruth::new().does(0, &[(0.0, "walking"), (until, SHOWERING), (10.0, "")]);
        lives.enters(0, &[(0.0, 0), (4.0, 1), (11.0, 0)])
    };
    queues(1.0).counts(&[ImpossibleKind::BathroomElsewhere]);
    queues(4.0).counts(&[]);
}

#[test]
fn counts_ways_within_sleep() {
    let sleeps = |from: f64| {
        let lives = ShortTruth::new().moves(0, &[(0.0, 1.0, walk(0.0, 3.0)), (1.0, 60.0, rest(3.0))]);
        lives.does(0, &[(0.0, "walking"), (from, NAPPING), (60.0, "")])
    };
    sleeps(0.5).counts(&[ImpossibleKind::WalksAsleep]);
    sleeps(1.0).counts(&[]);
}

#[test]
fn counts_passages_of_a_shut_door_and_doors_that_nobody_passes() {
    let leaves = || ShortTruth::new().moves(0, &[(0.0, 5.0, rest(0.0)), (5.0, 60.0, OUT)]);
    leaves().door(&[(4.0, true), (5.0, false)]).counts(&[]);
    leaves().counts(&[ImpossibleKind::ThroughShutDoor]);
    leaves().door(&[(4.0, true), (5.0, false), (9.0, true), (9.5, false)]).counts(&[ImpossibleKind::OpenedForNobody]);
    // The mail is outside of the door.
    let mail = leaves().does(0, &[(8.0, FETCHING_MAIL), (10.0, "")]);
    mail.door(&[(4.0, true), (5.0, false), (9.0, true), (9.5, false)]).counts(&[]);
    leaves().door(&[(5.0, true), (5.0, false)]).counts(&[ImpossibleKind::OpenForAnInstant]);
}

/// A visit of the second body from minute 10 to 40.
fn visit() -> ShortTruth {
    let host = ShortTruth::new().moves(0, &[(0.0, 100.0, rest(0.0))]);
    let both = host.moves(1, &[(0.0, 10.0, OUT), (10.0, 40.0, rest(2.0)), (40.0, 100.0, OUT)]);
    both.door(&[(9.0, true), (10.0, false), (40.0, true), (40.1, false)])
}

#[test]
fn counts_visits_without_a_visitor_or_a_host() {
    visit().does(0, &[(9.0, VISIT), (41.0, "")]).counts(&[]);
    visit().does(0, &[(50.0, VISIT), (60.0, "")]).counts(&[ImpossibleKind::HostAlone]);
    let leaves = |until: f64| {
        let host = ShortTruth::new().moves(0, &[(0.0, until, rest(0.0)), (until, 100.0, OUT)]);
        let both = host.moves(1, &[(0.0, 10.0, OUT), (10.0, 40.0, rest(2.0)), (40.0, 100.0, OUT)]);
        both.door(&[(9.0, true), (10.0, false), (until - 1.0, true), (until, false), (39.0, true), (41.0, false)])
    };
    leaves(20.0).counts(&[ImpossibleKind::VisitToNobody]);
    leaves(39.0).counts(&[]);
}

#[test]
fn counts_guests_who_do_not_eat_with_their_host() {
    let meal = || visit().does(0, &[(15.0, EATING_LUNCH), (35.0, "")]);
    meal().counts(&[ImpossibleKind::HungryGuest]);
    meal().does(1, &[(16.0, EATING_LUNCH), (34.0, "")]).counts(&[]);
}

#[test]
fn counts_meals_that_are_eaten_before_they_are_cooked() {
    let cooks = |until: f64| ShortTruth::new().does(0, &[(0.0, PREPARING_LUNCH), (until, ""), (200.0, "")]);
    cooks(20.0).does(1, &[(10.0, EATING_LUNCH), (30.0, "")]).counts(&[ImpossibleKind::EatenUncooked]);
    cooks(20.0).does(1, &[(20.0, EATING_LUNCH), (30.0, "")]).counts(&[]);
    let alone = |eats: f64| {
        let mut rows = [(100.0, PREPARING_DINNER), (120.0, ""), (eats, EATING_DINNER), (eats + 20.0, "")];
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        ShortTruth::new().does(0, &rows)
    };
    alone(60.0).counts(&[ImpossibleKind::PreparedTooLate]);
    alone(121.0).counts(&[]);
    alone(180.0).counts(&[ImpossibleKind::EatenCold]);
}

#[test]
fn counts_rows_without_length() {
    ShortTruth::new().does(0, &[(0.0, "reading"), (0.0, "away"), (1.0, "")]).counts(&[ImpossibleKind::NoLength]);
    ShortTruth::new().does(0, &[(0.0, "reading"), (0.5, "away"), (1.0, "")]).counts(&[]);
    ShortTruth::new().moves(0, &[(0.0, 1.0, rest(0.0)), (2.0, 1.0, rest(0.0))]).counts(&[ImpossibleKind::NoLength]);
}
