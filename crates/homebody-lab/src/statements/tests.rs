//! Drawn statements are the same on any number of threads, and wrong ones are found.

use super::days::DrawnWhen;
use super::deeds::{PASTIMES, VISIT};
use super::draw::{DrawnLife, DrawnStatement};
use super::habit::{DrawnDetail, DrawnHabit, DrawnPlace, DrawnTime};
use super::homes::{DrawnBase, HOMES, LifeContext, STARTS};
use super::{FieldVerdict, StatementsExperiment};
use homebody_core::fuzzy::Fuzzy;

const DAYS: i32 = 20;

/// "Prays at 10:00" in the apartment, in winter.
fn prays() -> DrawnHabit {
    let prays = PASTIMES.into_iter().find(|deed| deed.label == "praying").expect("it is in the table");
    let at = DrawnTime::At { words: " at 10:00".to_owned(), at: Fuzzy::around(600.0, 5.0) };
    DrawnHabit { when: DrawnWhen::ALWAYS, time: at, ..DrawnHabit::new("pastime", prays) }
}

fn life(statement: DrawnStatement) -> DrawnLife {
    let base = DrawnBase { up_min: 420.0, bed_min: 1350.0, sentences: Vec::new(), about: Vec::new() };
    DrawnLife {
        first: 0,
        seed: 3,
        context: LifeContext { days: DAYS, home: &HOMES[0], start: STARTS[0], base },
        statements: vec![statement],
    }
}

#[test]
fn the_first_statements_do_not_depend_on_how_many_follow() {
    let (some, more) = (DrawnLife::draw_all(30, 5, &(30..=90)), DrawnLife::draw_all(90, 5, &(30..=90)));
    let texts = |lives: &[DrawnLife]| -> Vec<String> {
        lives.iter().flat_map(|life| life.statements.iter().map(|of| of.words(life.context.home))).collect()
    };
    let (some, more) = (texts(&some), texts(&more));
    assert!(some.len() >= 30 && more.len() >= 90);
    assert_eq!(some, more[..some.len()]);
    assert_ne!(some, texts(&DrawnLife::draw_all(30, 6, &(30..=90))));
}

#[test]
fn a_true_statement_happens_in_each_field() {
    let rows = life(DrawnStatement::Habit(prays())).measure();
    assert!(rows.len() > 3 && rows.iter().all(|row| row.verdict == FieldVerdict::Happened), "{rows:#?}");
}

/// The negative control: the life of one statement, measured against others that differ in a single field.
#[test]
fn each_field_that_is_not_as_stated_is_found() {
    let own = life(DrawnStatement::Habit(prays()));
    let simulated = own.simulate(&[0]).map_err(|why| format!("{why:?}")).unwrap();
    let view = own.view(&simulated);
    let mut later = prays();
    later.time = DrawnTime::At { words: String::new(), at: Fuzzy::around(660.0, 5.0) };
    let mut rarer = prays();
    rarer.when.days = super::days::DrawnDays::Weekdays(0x1f);
    let mut elsewhere = prays();
    elsewhere.place = Some(DrawnPlace::Room("kitchen"));
    let mut ends = prays();
    ends.until = Some(Fuzzy::around(720.0, 5.0));
    let mut oftener = prays();
    oftener.times = Some((2, 2));
    let mut after = prays();
    after.time = DrawnTime::After(2, None);
    for (wrong, field) in [
        (later, "at"),
        (rarer, "not on other days (days of the week)"),
        (elsewhere, "room"),
        (ends, "end"),
        (oftener, "times a day"),
        (after, "after"),
    ] {
        let fields = wrong.judge(&view);
        let found = fields.iter().find(|of| of.field == field);
        assert!(found.is_some_and(|of| !of.holds), "{field}: {fields:#?}");
    }
    let rows = own.rows(
        0,
        {
            let mut wrong = prays();
            wrong.times = Some((2, 2));
            wrong.judge(&view)
        },
        &simulated,
    );
    let experiment = StatementsExperiment::from_rows(rows, 1, 3);
    assert!(experiment.neither == 1 && experiment.to_string().contains("Neither happened nor told:"), "{experiment}");
}

/// Each detail holds in a life with its words, and is found missing in a life without them.
#[test]
fn a_detail_holds_only_where_it_is_stated() {
    let visits = |minute: f64, words: &str| DrawnHabit {
        visitor: Some("niece"),
        time: DrawnTime::At { words: words.to_owned(), at: Fuzzy::around(minute, 5.0) },
        ..DrawnHabit::new("guest", VISIT)
    };
    let pastime = DrawnHabit {
        deed: PASTIMES.into_iter().find(|deed| deed.label == "handicraft").expect("it is in the table"),
        time: DrawnTime::At { words: " at 15:00".to_owned(), at: Fuzzy::around(900.0, 5.0) },
        ..prays()
    };
    let when = DrawnWhen { days: super::days::DrawnDays::Weekdays(0x10), ..DrawnWhen::ALWAYS };
    let on_fridays = DrawnHabit { when, ..visits(1020.0, " at 17:00") };
    let morning = || visits(600.0, " at 10:00 for 1 hour");
    for (plain, besides, field) in [
        (morning(), DrawnDetail::Key, "key"),
        (on_fridays, DrawnDetail::Overnight, "night"),
        (morning(), DrawnDetail::Work(" and does the housework", "housework"), "work"),
        (morning(), DrawnDetail::Help(" and helps her wash", "washing"), "help"),
        (pastime, DrawnDetail::Meanwhile(" with the television on", "tv bench"), "meanwhile"),
    ] {
        let stated = DrawnHabit { besides, ..plain.clone() };
        let holds = |simulated: &DrawnHabit| {
            let own = life(DrawnStatement::Habit(simulated.clone()));
            let run = own.simulate(&[0]).map_err(|why| format!("{why:?}")).unwrap();
            let fields = stated.judge(&own.view(&run));
            fields.iter().find(|of| of.field == field).map(|of| of.holds)
        };
        assert_eq!((holds(&stated), holds(&plain)), (Some(true), Some(false)), "{field}");
    }
}

#[test]
fn a_refused_statement_is_told() {
    let mut never = prays();
    never.time = DrawnTime::At { words: " at 27:00".to_owned(), at: Fuzzy::around(1620.0, 5.0) };
    let rows = life(DrawnStatement::Habit(never)).measure();
    assert_eq!(rows.iter().map(|row| row.verdict).collect::<Vec<_>>(), [FieldVerdict::Told]);
}
