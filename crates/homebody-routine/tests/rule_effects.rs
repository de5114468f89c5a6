//! The effect of rules, measured in the ground truth of weeks.

mod stage;

use homebody_core::event::Events;
use homebody_core::run::Run;
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, RunTime, Span};
use stage::{activities, day, events, files, hour, household};

const DAYS: i64 = 28;
const BASE: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 07:00.\nShe eats lunch at 12:00 for 30 minutes.\n\
                    She goes to bed at 22:30.\n";

struct Lived(Vec<(Interval<RunTime>, String)>, Events);

fn live(sentences: &str) -> Lived {
    let mut files = files(&format!("{BASE}{sentences}"), &[]);
    let scenario = files["scenario.json"].replace("America/Chicago", "UTC").replace("2009-03-02", "2009-01-05");
    files.insert("scenario.json".into(), scenario);
    let (scenario, household) = household(&files, &[]).unwrap_or_else(|problems| panic!("{problems}"));
    let events = events(Run::new(&scenario, &household, 11, DAYS * DAY), DAY);
    Lived(activities(&events, 0, DAYS * DAY), events)
}

impl Lived {
    fn of<'a>(&'a self, name: &'a str) -> impl Iterator<Item = Interval<RunTime>> + 'a {
        self.0.iter().filter(move |(_, what)| what == name).map(|(time, _)| *time)
    }

    /// By instant, the minutes until an activity begins; `None` if it does not begin in time.
    fn after(&self, instants: &[RunTime], name: &str, within: Span) -> Vec<f64> {
        let gaps = |at: RunTime| self.of(name).map(move |one| one.begin - at);
        let next = |at: &RunTime| gaps(*at).find(|gap| (Span::ZERO..within).contains(gap));
        instants.iter().filter_map(next).map(|gap| gap.ratio(MINUTE)).collect()
    }

    fn ends(&self, name: &str) -> Vec<RunTime> {
        self.of(name).map(|one| one.end).collect()
    }
}

#[test]
fn the_end_of_a_step_brings_the_next() {
    let life = live("Whenever she has eaten lunch, she naps for 20 minutes, then reads for 10 minutes.");
    let lunches = life.ends("eating_lunch");
    assert!(lunches.len() as i64 >= DAYS - 1);
    let naps = life.after(&lunches, "napping", 20 * MINUTE);
    assert!(naps.len() * 10 >= lunches.len() * 9, "{} of {}", naps.len(), lunches.len());
    let ends: Vec<RunTime> =
        lunches.iter().flat_map(|&at| life.of("napping").find(|nap| nap.begin >= at)).map(|nap| nap.end).collect();
    let reads = life.after(&ends, "reading", 5 * MINUTE);
    assert!(reads.len() * 10 >= ends.len() * 9, "{} of {}", reads.len(), ends.len());
}

#[test]
fn conditions_of_a_rule_are_checked_when_it_is_due() {
    let naps =
        |rule: &str| live(rule).of("napping").filter(|nap| (12.0..14.0).contains(&hour(nap.begin))).count() as i64;
    let always = naps("Whenever she has eaten lunch, she naps for 20 minutes.");
    let never = naps("Whenever she has eaten lunch, she naps for 20 minutes unless it is after 12:00.");
    let before = naps("Whenever she has eaten lunch and it is before 15:00, she naps for 20 minutes.");
    assert!(always >= DAYS - 3 && before >= DAYS - 3 && never <= 3, "{always} {before} {never}");
}

#[test]
fn a_rule_notices_arrivals_and_an_empty_home() {
    let visit = "Her daughter visits on Sunday at 14:00 for 2 hours.\n";
    let life = live(&format!("{visit}Whenever her daughter comes, she has a drink."));
    let visits: Vec<RunTime> = life.of("visit").map(|visit| visit.begin).filter(|at| day(*at) % 7 == 6).collect();
    let begun: Vec<RunTime> = visits.iter().copied().filter(|at| (13.8..14.3).contains(&hour(*at))).collect();
    let mut firsts = begun.clone();
    firsts.dedup_by_key(|at| day(*at));
    assert!(firsts.len() >= 3, "{}", firsts.len());
    assert!(life.after(&firsts, "drinking", 5 * MINUTE).len() >= firsts.len() - 1);
    let life = live(&format!("{visit}Whenever she has been alone for 20 hours, she paces for 10 minutes."));
    assert!(life.of("pacing").count() >= 3);
    let life = live(&format!("{visit}Whenever her daughter has been there for 5 hours, she paces for 10 minutes."));
    assert_eq!(life.of("pacing").count(), 0);
}

#[test]
fn dusk_is_noticed_every_day() {
    let life = live("Whenever it gets dark, she paces for 5 minutes.");
    let paces: Vec<f64> = life.of("pacing").map(|pacing| hour(pacing.begin)).collect();
    assert!(paces.len() as i64 >= DAYS - 2, "{}", paces.len());
    let mean = paces.iter().sum::<f64>() / paces.len() as f64;
    assert!(paces.iter().all(|at| (at - mean).abs() < 2.0), "{paces:?}");
}

#[test]
fn a_person_who_has_sat_for_long_rises() {
    let sits = "She reads in the armchair from 14:00 to 17:00.\n";
    let walks = |rule: &str| {
        live(&format!("{sits}{rule}")).of("wandering").filter(|walk| (14.0..17.2).contains(&hour(walk.begin))).count()
    };
    let rises = walks("Whenever she has been sitting for 50 minutes, she walks around for 3 minutes.");
    assert!(rises as i64 >= DAYS, "{rises}");
    assert_eq!(walks(""), 0);
}

#[test]
fn a_forgotten_response_comes_later() {
    let life = live(
        "Whenever she has eaten lunch, she naps for 10 minutes, but she forgets it on 50 % of days and does it 2 hours later.",
    );
    let lunches = life.ends("eating_lunch");
    let naps = life.after(&lunches, "napping", 3 * HOUR);
    let (soon, late): (Vec<f64>, Vec<f64>) = naps.into_iter().partition(|gap| *gap < 30.0);
    assert!(soon.len() >= 6 && late.len() >= 6, "{} {}", soon.len(), late.len());
    assert!(late.iter().all(|gap| (80.0..180.0).contains(gap)), "{late:?}");
}

#[test]
fn the_first_rule_of_the_text_goes_first_and_the_others_wait() {
    let (nap, pace) = (
        "Whenever she has eaten lunch, she naps for 30 minutes.",
        "Whenever she has eaten lunch, she paces for 5 minutes.",
    );
    for (text, first, second) in
        [(format!("{nap}\n{pace}"), "napping", "pacing"), (format!("{pace}\n{nap}"), "pacing", "napping")]
    {
        let life = live(&text);
        let lunches = life.ends("eating_lunch");
        let (firsts, seconds) = (life.after(&lunches, first, HOUR), life.after(&lunches, second, 2 * HOUR));
        assert!(
            firsts.len() as i64 >= DAYS - 4 && seconds.len() as i64 >= DAYS - 4,
            "{} {}",
            firsts.len(),
            seconds.len()
        );
        let is_first = firsts.iter().zip(&seconds).filter(|(a, b)| a < b).count();
        assert!(is_first * 10 >= firsts.len() * 9, "{is_first} of {}: {text}", firsts.len());
    }
}

#[test]
fn a_rule_may_follow_another() {
    let life = live(
        "Whenever she has eaten lunch, she naps for 20 minutes.\nWhenever she has done so for 2 hours, she paces for 5 minutes.",
    );
    assert!(life.of("pacing").count() as i64 >= DAYS - 6, "{}", life.of("pacing").count());
    assert!(!life.1.facts.is_empty());
}
