//! Visits and guests, and two people in one home, as the truth has them.

use crate::stage::{activities, events, files, household};
use homebody_core::event::{Events, Fact};
use homebody_core::motion::{MotionSegment, MotionState};
use homebody_core::posture::Posture;
use homebody_core::run::{DriverProvider, Run};
use homebody_core::scenario::load::Scenario;
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, RunTime, SECOND, Span};
use homebody_routine::household::Household;
use homebody_routine::routine::{Activity, Meal, Routine};
use std::collections::BTreeMap;

const ALONE: &str = "Margaret is 82.\nEvery day\n  she gets up at 07:00\n  she goes to bed at 22:30\n  she eats lunch at 12:30 for 30 minutes\n\
    She does not go out.\nShe does not nap.\n";

/// A household's life, from Monday on.
struct Lives {
    length: Span,
    events: Events,
    moves: Vec<Vec<MotionSegment>>,
    scenario: Scenario,
}

/// The intervals of a body at home, and its rows.
type Row = (Interval<RunTime>, String);

impl Lives {
    fn new(files: &BTreeMap<String, String>, days: i64, edit: impl Fn(&mut Routine)) -> Lives {
        let (scenario, household): (Scenario, Household) =
            household(files, &[]).unwrap_or_else(|problems| panic!("{problems}"));
        let mut routine = household.routine(0).unwrap().clone();
        edit(&mut routine);
        let household = household.with_routine(0, routine);
        let run = Run::new(&scenario, &household, 11, days * DAY);
        assert_eq!(household.guests().len() + scenario.residents.len(), run.names().len());
        let moves = run.clone().moves().unwrap();
        Lives { length: days * DAY, events: events(run, DAY), moves, scenario }
    }

    /// Margaret in the example's apartment, in UTC.
    fn of(sentences: &str, days: i64, edit: impl Fn(&mut Routine)) -> Lives {
        Lives::said(&format!("{ALONE}{sentences}\n"), days, edit)
    }

    fn said(routine: &str, days: i64, edit: impl Fn(&mut Routine)) -> Lives {
        let mut files = files(routine, &[]);
        let scenario = files["scenario.json"].replace("America/Chicago", "UTC").replace("2009-03-02", "2009-01-05");
        files.insert("scenario.json".into(), scenario);
        Lives::new(&files, days, edit)
    }

    fn couple(days: i64) -> Lives {
        Lives::couple_with("", "", days)
    }

    /// With further sentences about Henry and Ruth.
    fn couple_with(henry: &str, ruth: &str, days: i64) -> Lives {
        macro_rules! file {
            ($($name:literal)*) => {
                [$(($name, include_str!(concat!("../../../scenarios/couple-with-cat/", $name)))),*]
            };
        }
        let files = file!("scenario.json" "home.json" "logger.json" "henry.json" "henry.routine" "ruth.json" "ruth.routine"
            "minka.json" "minka.routine");
        let mut files = BTreeMap::from(files.map(|(name, text)| (name.to_owned(), text.to_owned())));
        for (name, more) in [("henry.routine", henry), ("ruth.routine", ruth)] {
            *files.get_mut(name).unwrap() += more;
        }
        Lives::new(&files, days, |_| {})
    }

    fn rows(&self, body: u32) -> Vec<Row> {
        activities(&self.events, body, self.length)
    }

    fn rows_of(&self, body: u32, name: &str) -> Vec<Interval<RunTime>> {
        self.rows(body).into_iter().filter(|(_, what)| what == name).map(|(time, _)| time).collect()
    }

    fn stays(&self, body: usize) -> Vec<Interval<RunTime>> {
        let mut stays: Vec<Interval<RunTime>> = Vec::new();
        for segment in self.moves[body].iter().filter(|segment| segment.doing != MotionState::Away) {
            match stays.last_mut().filter(|stay| stay.end == segment.begin) {
                Some(stay) => stay.end = segment.end,
                None => stays.push(Interval::new(segment.begin, segment.end)),
            }
        }
        stays
    }

    /// Intervals with an open front door.
    fn open(&self) -> Vec<Interval<RunTime>> {
        let door = self.scenario.home.plan().thing("front door").unwrap();
        let mut open = Vec::new();
        let mut since = None;
        for fact in &self.events.facts {
            if let Fact::Use { at, act, .. } = fact
                && act.thing.index() == door
            {
                match since {
                    None if act.on => since = Some(*at),
                    Some(begin) if !act.on => {
                        open.push(Interval::new(begin, *at));
                        since = None;
                    }
                    _ => {}
                }
            }
        }
        open
    }
}

/// Minutes after a time of day.
fn minutes_after(at: RunTime, hour: f64) -> f64 {
    (at.since_zero() % DAY).ratio(HOUR) * 60.0 - hour * 60.0
}

#[track_caller]
fn is_about(at: RunTime, hour: f64, within_min: f64) {
    let by = minutes_after(at, hour);
    assert!(by.abs() <= within_min, "{by:.1} minutes after {hour}");
}

#[test]
fn a_visit_from_one_time_to_another_lasts_until_then() {
    let sentence = "Every Tuesday her friend visits from 14:00 to 17:00.";
    let stays = Lives::of(sentence, 28, |_| {}).stays(1);
    assert_eq!(stays.len(), 4);
    for stay in stays {
        is_about(stay.begin, 14.0, 12.0);
        is_about(stay.end, 17.0, 6.0);
    }
    let without =
        Lives::of(sentence, 28, |routine| routine.habits.iter_mut().for_each(|habit| habit.when.until = None));
    assert!(without.stays(1).iter().any(|stay| minutes_after(stay.end, 17.0).abs() > 20.0), "the end matters");
}

#[test]
fn guests_stay_for_nights_and_sleep_there() {
    let lives = Lives::of("On Friday her son visits at 18:00.", 15, |routine| {
        routine.habits.iter_mut().filter(|habit| habit.visitor.is_some()).for_each(|habit| habit.when.nights = 2);
    });
    let stays = lives.stays(1);
    assert_eq!(stays.len(), 2, "{stays:?}");
    for stay in stays {
        is_about(stay.begin, 18.0, 12.0);
        let until = stay.begin + 44 * HOUR..stay.begin + 49 * HOUR;
        assert!(until.contains(&stay.end), "until Sunday afternoon: {:?}", stay.end);
        let nights = lives.rows_of(1, "sleeping").into_iter().filter(|night| stay.contains(night.begin));
        let nights: Vec<Span> = nights.map(|night| night.length()).filter(|night| *night > 6 * HOUR).collect();
        assert_eq!(nights.len(), 2, "{nights:?}");
    }
}

#[test]
fn nights_away_end_after_them() {
    let lives = Lives::said("Margaret is 82.\nOn Friday she goes for a walk at 10:00.\n", 14, |routine| {
        let walks = routine
            .habits
            .iter_mut()
            .filter(|habit| habit.activity == Activity::Leave && habit.when.chance.probability > 0.0);
        walks.for_each(|habit| habit.when.nights = 2);
    });
    let away = lives.rows_of(0, "away");
    let long: Vec<_> = away.iter().filter(|away| away.length() > DAY).collect();
    assert_eq!(long.len(), 2, "{away:?}");
    assert!(long.iter().all(|away| (50 * HOUR..58 * HOUR).contains(&away.length())), "{long:?}");
}

/// The smallest distance of two people who stand or walk.
fn nearest_m(lives: &Lives, a: usize, b: usize) -> f64 {
    let is_up = |segment: &&MotionSegment| segment.posture == Posture::Standing && segment.doing != MotionState::Away;
    let mut nearest = f64::INFINITY;
    let mut others = lives.moves[b].iter().filter(is_up).peekable();
    for one in lives.moves[a].iter().filter(is_up) {
        while others.peek().is_some_and(|other| other.end <= one.begin) {
            others.next();
        }
        for other in others.clone().take_while(|other| other.begin < one.end) {
            let both = Interval::new(one.begin.max(other.begin), one.end.min(other.end));
            let at = (0..5).map(|part| both.begin + both.length() * part / 4);
            let apart = at.filter_map(|at| Some(one.position(at)?.distance(other.position(at)?)));
            nearest = apart.fold(nearest, f64::min);
        }
    }
    nearest
}

#[test]
fn a_couple_neither_blocks_nor_touches_each_other() {
    let lives = Lives::couple(28);
    for body in 0..2 {
        let waits = lives.rows_of(body, "waiting").into_iter().map(|wait| wait.length());
        assert!(waits.max().unwrap_or(Span::ZERO) <= 3 * MINUTE);
        let medicine = lives.rows_of(body, "taking_medicine").into_iter().map(|row| row.length());
        assert!(medicine.max().unwrap_or(Span::ZERO) < 12 * MINUTE);
    }
    let breakfasts = lives.rows_of(1, "preparing_breakfast").into_iter().map(|row| row.length());
    assert!(breakfasts.max().is_some_and(|longest| longest < 30 * MINUTE));
    for (a, b) in [(0, 1), (0, 3), (0, 4), (1, 3), (1, 4)] {
        let apart_m = nearest_m(&lives, a, b);
        assert!(apart_m >= 0.3, "{a} and {b}: {apart_m:.4} m");
    }
}

#[test]
fn two_in_a_narrow_room_do_not_stay_stuck() {
    let henry = "\nHe uses the computer every day at 13:05 for 10 minutes.\n";
    let ruth = "\nShe looks out of the window in the study every day at 13:00 for 25 minutes.\n";
    let lives = Lives::couple_with(henry, ruth, 60);
    for body in 0..2 {
        for day in 0..60 {
            let of_day = Interval::new(RunTime::START + day * DAY, RunTime::START + (day + 1) * DAY);
            let waits = lives.rows_of(body, "waiting").into_iter().map(|wait| wait.overlap(of_day)).sum::<Span>();
            assert!(waits < 40 * MINUTE, "{body} on day {day}: {waits:?}");
        }
    }
}

#[test]
fn the_way_to_an_activity_and_a_wait_for_it_are_rows_of_their_own() {
    let lives = Lives::couple(28);
    let plan = lives.scenario.home.plan();
    for body in 0..2 {
        let rows = lives.rows(body);
        assert!(rows.iter().all(|(time, _)| time.end > time.begin));
        let here = |time: Interval<RunTime>| {
            lives.moves[body as usize].iter().filter(move |one| one.begin < time.end && one.end > time.begin)
        };
        for (time, name) in rows.iter().filter(|(_, name)| name == "showering" || name == "using_bathroom") {
            let is_there = |one: &MotionSegment| {
                let room = one.position(one.begin.max(time.begin)).and_then(|at| plan.room_at(at));
                room.is_some_and(|room| plan.rooms[room].name.contains("bath"))
            };
            assert!(here(*time).all(is_there), "{name} at {:?}", time.begin);
        }
    }
}

#[test]
fn guests_pass_an_open_door_and_the_visit_ends_with_them() {
    let lives = Lives::of(
        "Every day her neighbour visits at 11:45 for 1 hour.\nEvery day her friend visits at 15:00 for 90 minutes.",
        14,
        |_| {},
    );
    let open = lives.open();
    assert!(open.iter().all(|open| open.length() >= SECOND), "{open:?}");
    let stays: Vec<_> = [1, 2].into_iter().flat_map(|guest| lives.stays(guest)).collect();
    assert!(stays.len() >= 26, "{}", stays.len());
    let is_open = |at: RunTime| open.iter().any(|open| open.begin <= at && at <= open.end);
    assert!(stays.iter().all(|stay| is_open(stay.begin) && is_open(stay.end)));
    // Somebody passes each time.
    let passed = |open: &&Interval<RunTime>| {
        let ends = stays.iter().flat_map(|stay| [stay.begin, stay.end]);
        ends.into_iter().any(|at| open.begin <= at && at <= open.end)
    };
    let mail: Vec<_> = lives.rows_of(0, "fetching_mail");
    let is_for_mail = |open: &&Interval<RunTime>| mail.iter().any(|mail| mail.contains(open.begin));
    let for_nobody: Vec<_> = open.iter().filter(|open| !passed(open) && !is_for_mail(open)).collect();
    assert!(for_nobody.is_empty(), "{for_nobody:?}");
    for visit in lives.rows_of(0, "visit") {
        let guest = stays.iter().find(|stay| !stay.intersection(visit).is_empty());
        assert!(guest.is_some_and(|guest| visit.end <= guest.end + 2 * MINUTE), "{visit:?}");
    }
}

#[test]
fn a_guest_eats_with_the_host() {
    let lives = Lives::of("Every day her friend visits from 11:00 to 14:30.", 7, |_| {});
    let lunches = lives.rows_of(0, "eating_lunch");
    let shared = lives.rows_of(1, "eating_lunch");
    assert_eq!(lunches.len(), 7);
    for lunch in lunches {
        let with: Span = shared.iter().map(|row| row.intersection(lunch).length().max(Span::ZERO)).sum();
        assert!(with * 2 > lunch.length(), "{lunch:?}: {with:?}");
    }
}

#[test]
fn a_deed_has_its_time_although_a_guest_is_there() {
    let lives = Lives::of(
        "On Tuesday her friend visits from 14:00 to 17:00.\nOn Tuesday she bakes at 14:45 for 30 minutes.",
        21,
        |_| {},
    );
    let (baking, stays) = (lives.rows_of(0, "baking"), lives.stays(1));
    assert_eq!(stays.len(), 3);
    let begins: Vec<RunTime> =
        stays.iter().map(|stay| baking.iter().find(|row| row.begin > stay.begin).unwrap().begin).collect();
    begins.into_iter().for_each(|at| is_about(at, 14.75, 10.0));
    stays.iter().for_each(|stay| is_about(stay.end, 17.0, 6.0));
}

#[test]
fn two_guests_at_one_time_both_come() {
    let lives = Lives::of(
        "On Wednesday her daughter visits at 15:00 for 2 hours.\nOn Wednesday her friend visits at 15:00 for 2 hours.",
        28,
        |_| {},
    );
    for guest in [1, 2] {
        let stays = lives.stays(guest);
        assert_eq!(stays.len(), 4);
        stays.iter().for_each(|stay| is_about(stay.begin, 15.0, 15.0));
    }
}

#[test]
fn the_bell_wakes_a_host_and_so_does_a_carer_with_a_key() {
    for key in [false, true] {
        let lives = Lives::of("Every day a carer visits at 06:40 for 45 minutes.", 8, |routine| {
            routine.habits.iter_mut().filter(|habit| habit.visitor.is_some()).for_each(|habit| habit.key = key);
        });
        let stays = lives.stays(1);
        assert!(stays.len() >= 7, "{}", stays.len());
        stays.iter().for_each(|stay| is_about(stay.begin, 6.0 + 2.0 / 3.0, 10.0));
        // Without the carer she would sleep until seven.
        let rises = lives.rows_of(0, "getting_up");
        rises.iter().for_each(|row| is_about(row.begin, 6.0 + 2.0 / 3.0, 5.0));
        for stay in stays.iter().filter(|_| key) {
            let rise = rises.iter().find(|row| row.begin > stay.begin - 10 * MINUTE).unwrap();
            assert!(rise.begin > stay.begin, "she is woken at her bed");
        }
    }
}

#[test]
fn a_helper_does_the_work_with_her_own_body() {
    let work = [Activity::Prepare(Meal::Lunch), Activity::Housework, Activity::Shower];
    let lives = Lives::of("Every day a carer visits from 10:30 to 12:45.", 7, |routine| {
        routine.habits.iter_mut().filter(|habit| habit.visitor.is_some()).for_each(|habit| habit.does = work.to_vec());
    });
    let plan = lives.scenario.home.plan();
    let minutes_in = |body: usize, name: &str, room: &str| -> f64 {
        let rows = lives.rows_of(body as u32, name);
        let stays = lives.moves[body].iter().filter(|one| {
            let at = one.position(one.begin).and_then(|at| plan.room_at(at));
            at.is_some_and(|at| plan.rooms[at].name == room) && rows.iter().any(|row| row.contains(one.begin))
        });
        stays.map(|one| (one.end - one.begin).ratio(MINUTE)).sum()
    };
    assert!(minutes_in(1, "preparing_lunch", "kitchen") > 7.0 * 10.0, "she cooks");
    assert!(lives.rows_of(0, "preparing_lunch").is_empty(), "and the host does not");
    assert!(lives.rows_of(1, "housework").len() >= 7, "she cleans");
    assert!(lives.rows_of(0, "showering").len() >= 7, "the host is washed");
    assert!(minutes_in(1, "helping", "bathroom") > 7.0 * 3.0, "by her");
}

#[test]
fn a_host_does_not_open_for_a_visitor_who_has_left() {
    let base = "Margaret is 82.\nShe gets up at 07:00.\nShe goes to bed at 22:30.\n";
    let lives = Lives::said(
        &format!(
            "{base}She prepares lunch at about 12:00 for 25 minutes, then eats for 25 minutes.\n\
             She goes out at about 10:30 for 2 hours.\nHer friend visits from about 11:30 until about 13:05.\n"
        ),
        60,
        |_| {},
    );
    let (visits, stays) = (lives.rows_of(0, "visit"), lives.stays(1));
    assert!(visits.len() >= 5 && stays.len() < 50, "{} visits, {} stays", visits.len(), stays.len());
    for visit in visits {
        assert!(stays.iter().any(|stay| !stay.intersection(visit).is_empty()), "nobody came at {visit:?}");
    }
}
