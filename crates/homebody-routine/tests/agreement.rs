//! Sentences that touch each other, in the truth: dates, brought meals, late evenings, meals out.

use crate::home::understood;
use crate::stage::{Simulated, day, files, hour, household, run};
use homebody_core::event::{Events, Fact};
use homebody_core::motion::MotionState;
use homebody_core::time::{DAY, RunTime};
use homebody_routine::explain::explain;
use homebody_routine::household::Household;

const BASE: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 07:00.\n";
const BED: &str = "She goes to bed at 22:30.\n";
const DAYS: i64 = 42;

fn lived(said: &str) -> Simulated {
    Simulated::new(&format!("{BASE}{BED}{said}\n"), DAYS)
}

/// The days of an activity, from 0.
fn days(lived: &Simulated, name: &str) -> Vec<i64> {
    lived.firsts(name).into_iter().map(day).collect()
}

/// The difference of the sentence with these words, in a run from a Monday in March.
fn difference(said: &str, words: &str) -> Option<String> {
    let mut run = run(&format!("{BASE}{said}\n"), DAYS);
    run.advance(RunTime::START + DAYS * DAY, &mut Events::default()).unwrap();
    let of = Household::differences(&run).into_iter().find(|of| of.text.contains(words));
    of.map(|of| of.lived)
}

#[test]
fn every_other_saturday_and_every_other_sunday_are_one_weekend() {
    let said = "Every other Saturday she prays at 10:00 for 20 minutes.\nEvery other Sunday she exercises at 10:00.";
    let alternate = lived(said);
    let (saturdays, sundays) = (days(&alternate, "praying"), days(&alternate, "exercising"));
    let after: Vec<i64> = saturdays.iter().map(|day| day + 1).collect();
    assert!(saturdays.len() == 3 && sundays == after, "{saturdays:?} {sundays:?}");
    // Days without a day of the week are counted from the first.
    assert_eq!(days(&lived("Every 14 days she prays at 10:00 for 20 minutes."), "praying"), [0, 14, 28]);
    // Seven weeks are not every week.
    assert_eq!(days(&lived("Every 7 weeks on Monday she prays at 10:00 for 20 minutes."), "praying"), [0]);
}

#[test]
fn a_run_gives_sentences_their_dates() {
    let (scenario, _) = household(&files(&format!("{BASE}{BED}"), &[]), &[]).unwrap();
    let dates = |sentence: &str| {
        let explained = explain(&understood(sentence)).dated(&scenario.calendar, 30);
        explained.sentences[0].dates.clone()
    };
    let of = |sentence: &str| dates(sentence).unwrap_or_default();
    assert_eq!(of("She prays every other Saturday."), "first on day 6, Saturday 7 March 2009");
    assert_eq!(of("Until day 7 she prays at 10:00."), "the last day is day 6, Saturday 7 March 2009");
    assert_eq!(of("Until 1 April 2009 she prays."), "the last day is day 30, Tuesday 31 March 2009");
    assert_eq!(of("In December she prays at 10:00."), "applies on no day of this run");
    assert_eq!((dates("In March she prays at 10:00."), dates("She prays.")), (None, None));
}

#[test]
fn a_sentence_for_another_season_is_reported() {
    let nothing = Some("nothing: it applies on no day of this run".to_owned());
    let said = |when: &str| format!("{BED}{when} she prays at 10:00 for 20 minutes.");
    assert_eq!(difference(&said("In June, July and August"), "prays"), nothing);
    let bed = "In December, January and February she goes to bed at 20:45.";
    assert_eq!(difference(bed, "to bed"), nothing);
    assert_eq!(difference(&said("In March and April"), "prays"), None);
}

#[test]
fn a_brought_meal_is_eaten_when_it_has_come_and_cooked_by_nobody() {
    let said = "She eats lunch at about 12:20 for 25 minutes.\n\
        From day 15 a volunteer brings her lunch every day at 12:55 for 10 minutes.";
    let brought = lived(said);
    let cooked = days(&brought, "preparing_lunch");
    assert!(cooked.len() >= 12 && cooked.iter().all(|day| *day < 14), "{cooked:?}");
    let eaten: Vec<f64> = brought.firsts("eating_lunch").into_iter().filter(|at| day(*at) >= 14).map(hour).collect();
    let in_time = eaten.iter().filter(|hour| (12.9..13.42).contains(*hour)).count();
    assert!(eaten.len() == 28 && in_time >= 27, "{eaten:.2?}");
    // Food that comes before the stated time waits for it.
    let early = lived("She eats lunch at 12:20.\nA volunteer brings her lunch every day at 11:50 for 10 minutes.");
    let in_time = early.firsts("eating_lunch").into_iter().filter(|at| (12.2..12.6).contains(&hour(*at))).count();
    assert!(in_time >= 38 && days(&early, "preparing_lunch").is_empty(), "{in_time}");
    // A meal without a sentence of its own is not put off until after a stated rest.
    let soon =
        lived("She rests in bed from 13:15 to 15:00.\nA carer brings her lunch every day at 12:30 for 30 minutes.");
    let in_time = soon.firsts("eating_lunch").into_iter().filter(|at| (12.5..13.3).contains(&hour(*at))).count();
    assert!(in_time >= 38, "{in_time}");
    let late = difference(&format!("{BED}{said}"), "eats lunch").unwrap_or_default();
    assert!(late.contains("late") && late.contains("the visit by \"volunteer\""), "{late}");
}

#[test]
fn a_late_bedtime_is_reported_with_what_took_the_time() {
    let bed = |until: &str| difference(&format!("{BED}She plays the piano from 21:30 until {until}."), "to bed");
    let late = bed("23:10").unwrap_or_default();
    assert!(late.contains("late 4") && late.contains("\"makes music\", until about 23:"), "{late}");
    assert_eq!(bed("22:10"), None);
}

#[test]
fn a_drink_is_had_at_its_place() {
    let (scenario, _) = household(&files(&format!("{BASE}{BED}"), &[]), &[]).unwrap();
    let plan = scenario.home.plan();
    let minutes_in = |said: &str, furniture: &str| {
        let lived = lived(said);
        let place = lived.places.iter().find(|(name, _)| name == furniture).unwrap().1;
        let times: Vec<_> = lived.of("drinking").filter(|one| (14.9..15.5).contains(&hour(one.begin))).collect();
        let stays = lived.events.facts.iter().filter_map(|fact| match fact {
            Fact::Movement {
                resident,
                begin,
                end,
                doing: MotionState::Rest { at } | MotionState::InPlace { at, .. },
                ..
            } if resident.index() == 0 && times.iter().any(|time| time.contains(*begin)) => {
                Some((*at, (*end - *begin).seconds() / 60.0))
            }
            _ => None,
        });
        let there = stays.filter(|(at, _)| plan.room_at(*at) == plan.room_at(place));
        there.map(|(_, minutes)| minutes).sum::<f64>() / times.len() as f64
    };
    let bed = "bed";
    assert!(minutes_in("She has a drink in the bedroom at 15:00 for 20 minutes.", bed) > 13.0);
    assert!(minutes_in("She has a drink at 15:00 for 20 minutes.", bed) < 1.0);
}

#[test]
fn a_meal_out_replaces_the_meal_at_home() {
    let lunch = "She prepares lunch at about 11:50 for 25 minutes.\nShe eats lunch at about 12:20 for 25 minutes.\n";
    let wednesdays = |outing: &str| {
        let lived = lived(&format!("{lunch}On Wednesday she {outing} from 11:15 to 14:30."));
        ["preparing_lunch", "eating_lunch", "away"].map(|name| {
            let days = days(&lived, name);
            (days.len(), days.iter().filter(|day| *day % 7 == 2).count())
        })
    };
    for outing in ["goes to the lunch club", "goes to the club", "goes to the day centre", "visits her sister"] {
        let [cooked, eaten, away] = wednesdays(outing);
        assert!(cooked.1 == 0 && eaten == (36, 0) && away.1 == 6, "{outing} {cooked:?} {eaten:?} {away:?}");
    }
    let [.., eaten, _] = wednesdays("goes to the shops");
    assert!(eaten.1 >= 5, "{eaten:?}");
    let late = difference(&format!("{BED}{lunch}On weekdays she goes to the shops from 11:15 to 14:30."), "eats lunch");
    assert!(late.as_ref().is_some_and(|late| late.contains("\"leaves the apartment\"")), "{late:?}");
}
