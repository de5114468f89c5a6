//! Things that are on during something else or for a time, and things that are not used, as the truth has them.

use crate::stage::{Simulated, day, files, hour};
use homebody_core::event::Fact;
use homebody_core::geometry::Point;
use homebody_core::motion::MotionState;
use homebody_core::time::{DAY, Interval, MINUTE, RunTime, Span};
use homebody_routine::routine::{Habit, Routine};

const ALONE: &str =
    "Margaret is 82.\nShe gets up at 07:00. She goes to bed at 22:30. She does not go out. She does not nap.\n";

impl Simulated {
    /// The spans in which a thing is on or open.
    fn spans_on(&self, thing: &str) -> Vec<Interval<RunTime>> {
        let thing = self.things.iter().position(|name| name == thing).expect("the home has it");
        let mut spans: Vec<Interval<RunTime>> = Vec::new();
        let end = RunTime::START + self.days * DAY;
        for fact in &self.events.facts {
            let Fact::Use { at, act, .. } = fact else { continue };
            let is_on = spans.last().is_some_and(|last| last.end == end);
            match act.on {
                true if act.thing.index() == thing && !is_on => spans.push(Interval::new(*at, end)),
                false if act.thing.index() == thing && is_on => {
                    spans.last_mut().expect("it is on").end = *at;
                }
                _ => {}
            }
        }
        spans
    }

    /// The share of an activity's time in which a thing is on.
    fn share_on(&self, activity: &str, thing: &str) -> f64 {
        let on = self.spans_on(thing);
        let of =
            |time: Interval<RunTime>| on.iter().map(|on| on.intersection(time).length().max(Span::ZERO)).sum::<Span>();
        let all: Span = self.of(activity).map(|time| time.length()).sum();
        self.of(activity).map(of).sum::<Span>().ratio(all)
    }

    /// The place of a rest in an interval.
    fn rests_at(&self, time: Interval<RunTime>) -> Vec<Point> {
        let at = |fact: &Fact| match fact {
            Fact::Movement { resident, begin, doing: MotionState::Rest { at }, .. }
                if resident.index() == 0 && time.contains(*begin) =>
            {
                Some(*at)
            }
            _ => None,
        };
        self.events.facts.iter().filter_map(at).collect()
    }
}

fn without_thing(routine: &mut Routine) {
    routine.habits.iter_mut().for_each(|habit| habit.thing_on = None);
}

#[test]
fn the_television_is_on_while_she_knits_and_off_afterwards() {
    let text =
        format!("{ALONE}She never watches television. She knits at 15:00 for 60 minutes with the television on.");
    let lives = Simulated::new(&text, 20);
    assert!(lives.firsts("handicraft").len() >= 18, "{:?}", lives.firsts("handicraft").len());
    assert!(lives.share_on("handicraft", "TV bench") > 0.95, "{}", lives.share_on("handicraft", "TV bench"));
    for on in lives.spans_on("TV bench") {
        let knits = |time: Interval<RunTime>| time.intersection(on).length() > Span::ZERO;
        assert!(lives.of("handicraft").any(knits) && on.length() < 2 * 60 * MINUTE, "{on:?}");
    }
    let without = Simulated::of_changed(&text, 20, without_thing);
    assert_eq!(without.spans_on("TV bench"), []);
}

#[test]
fn lunch_in_front_of_the_television_is_eaten_where_it_can_be_seen() {
    let text = format!("{ALONE}She eats lunch in front of the television at 12:30 for 30 minutes.");
    let lives = Simulated::new(&text, 15);
    assert!(lives.share_on("eating_lunch", "TV bench") > 0.9, "{}", lives.share_on("eating_lunch", "TV bench"));
    let chair = |lives: &Simulated| {
        let dining = lives.places.iter().find(|(name, _)| name == "dining chair").expect("a dining chair").1;
        let rests: Vec<Point> = lives.of("eating_lunch").flat_map(|time| lives.rests_at(time)).collect();
        assert!(!rests.is_empty());
        rests.iter().filter(|at| at.distance(dining) < 0.5).count() as f64 / rests.len() as f64
    };
    let without = Simulated::new(&format!("{ALONE}She eats lunch at 12:30 for 30 minutes."), 15);
    assert!(without.share_on("eating_lunch", "TV bench") < 0.5);
    assert!(chair(&without) > 0.9);
}

#[test]
fn what_she_does_while_she_watches_television_leaves_it_on_and_its_time_as_stated() {
    let tv = "She watches television at 19:00 for 90 minutes.";
    let text = format!("{ALONE}{tv} She knits while she watches television for 30 minutes.");
    let lives = Simulated::new(&text, 20);
    assert!(lives.of("handicraft").count() >= 18, "{}", lives.of("handicraft").count());
    assert!(lives.share_on("handicraft", "TV bench") > 0.95, "{}", lives.share_on("handicraft", "TV bench"));
    let of_evening = |lives: &Simulated| -> Vec<f64> {
        let on = lives.spans_on("TV bench").into_iter().filter(|on| (18.8..19.4).contains(&hour(on.begin)));
        on.map(|on| on.length().ratio(MINUTE)).collect()
    };
    let evenings = of_evening(&lives);
    assert!(evenings.len() >= 18, "{}", evenings.len());
    let near = evenings.iter().filter(|minutes| (60.0..125.0).contains(*minutes)).count();
    assert!(near >= 16, "{evenings:?}");
    let without = Simulated::new(&format!("{ALONE}{tv} She knits at 10:00 for 30 minutes."), 20);
    assert!(without.share_on("handicraft", "TV bench") < 0.3);
}

#[test]
fn a_lamp_is_on_all_night_and_off_by_day() {
    let text = format!("{ALONE}She leaves the light in the hall on all night.");
    let lives = Simulated::new(&text, 15);
    let at_three = |lives: &Simulated| {
        let on = lives.spans_on("hall");
        (1..15).filter(|&day| on.iter().any(|on| on.contains(RunTime::START + day * DAY + 3 * 60 * MINUTE))).count()
    };
    assert!(at_three(&lives) >= 13, "{}", at_three(&lives));
    let noons = (1..15).filter(|&day| {
        lives.spans_on("hall").iter().any(|on| on.contains(RunTime::START + day * DAY + 12 * 60 * MINUTE))
    });
    assert!(noons.count() <= 1);
    assert!(at_three(&Simulated::new(ALONE, 15)) <= 2);
}

#[test]
fn a_thing_is_on_from_one_time_until_another() {
    let text = format!("{ALONE}On 50 % of days she leaves the washing machine on from 14:00 until 15:30.");
    let lives = Simulated::new(&text, 40);
    let on: Vec<Interval<RunTime>> =
        lives.spans_on("washing machine").into_iter().filter(|on| (13.5..14.8).contains(&hour(on.begin))).collect();
    assert!((12..28).contains(&on.len()), "{}", on.len());
    let days: Vec<i64> = on.iter().map(|on| day(on.begin)).collect();
    let as_said = on.iter().filter(|on| (15.2..16.2).contains(&hour(on.end))).count();
    assert!(as_said * 10 >= on.len() * 8, "{as_said} of {} on {days:?}", on.len());
    let without = Simulated::new(ALONE, 40).spans_on("washing machine");
    assert!(without.iter().filter(|on| on.length() > 60 * MINUTE).count() < 3);
}

#[test]
fn a_thing_that_she_never_uses_is_off_on_those_days() {
    let meals = "She prepares lunch at 11:45, then eats. She makes tea 3 times a day.";
    let uses = |text: &str| {
        let lives = Simulated::new(&format!("{ALONE}{meals}{text}"), 28);
        let is_weekend = |on: &&Interval<RunTime>| day(on.begin) % 7 >= 5;
        let on = lives.spans_on("stove");
        (on.iter().filter(is_weekend).count(), on.iter().filter(|on| !is_weekend(on)).count())
    };
    let (at_weekends, on_weekdays) = uses(" At weekends she never uses the stove.");
    assert_eq!(at_weekends, 0);
    assert!(on_weekdays > 15);
    assert!(uses("").0 > 5);
}

#[test]
fn a_meal_is_made_with_the_stated_appliance() {
    let microwave = |routine: &str| {
        let mut files = files(&format!("{ALONE}{routine}"), &[]);
        let piece =
            r#""furniture": [ { "name": "microwave", "at": [9.0, 2.3], "size_m": [0.4, 0.3], "height_m": 1.2 },"#;
        let home = files["home.json"].replace("\"furniture\": [", piece);
        files.insert("home.json".into(), home);
        let lives = Simulated::of_files(files, 20, |_| {});
        let cooking = |thing: &str| lives.share_on("preparing_dinner", thing);
        (cooking("microwave"), cooking("stove"))
    };
    let (warmed, cooked) = microwave("She uses the microwave for dinner. She does not prepare lunch.");
    assert!(warmed > 0.4 && cooked == 0.0, "{warmed} {cooked}");
    let (_, cooked) = microwave("She prepares dinner. She does not prepare lunch.");
    assert!(cooked > 0.2, "{cooked}");
}

#[test]
fn the_field_of_a_habit_is_what_turns_the_thing_on() {
    let text = format!("{ALONE}She reads at 10:00 for 40 minutes.");
    let with = Simulated::of_changed(&text, 10, |routine| {
        let reads = |habit: &&mut Habit| habit.activity.label() == "reading";
        routine.habits.iter_mut().filter(reads).for_each(|habit| habit.thing_on = Some("TV bench".into()));
    });
    assert!(with.share_on("reading", "TV bench") > 0.8, "{}", with.share_on("reading", "TV bench"));
    assert!(Simulated::new(&text, 10).share_on("reading", "TV bench") < 0.2);
}
