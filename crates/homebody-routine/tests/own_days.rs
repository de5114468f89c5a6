//! A resident's own days: a statement's numbers against the ground truth of a short life.

use crate::stage::{Simulated, activities, day, events, files, hour, household, mean};
use homebody_core::event::Fact;
use homebody_core::fuzzy::Fuzzy;
use homebody_core::motion::MotionState;
use homebody_core::run::Run;
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, RunTime, SECOND, Span};
use homebody_routine::routine::{Activity, HabitTime, Phase, PhaseDay};

const BASE: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 07:00.\n";
const MEALS: &str = "She prepares breakfast at 07:45 for 15 minutes, then eats for 20 minutes.
She prepares lunch at 11:50 for 25 minutes, then eats for 25 minutes.
She prepares dinner at 17:15 for 30 minutes, then eats for 30 minutes.
";

fn live(sentences: &str, days: i64) -> Simulated {
    Simulated::new(&format!("{BASE}{sentences}"), days)
}

fn minutes(span: Span) -> f64 {
    span.ratio(MINUTE)
}

impl Simulated {
    /// Per day, from one day to another.
    fn often(&self, name: &str, from: i64, to: i64) -> f64 {
        self.of(name).filter(|one| (from..to).contains(&day(one.begin))).count() as f64 / (to - from) as f64
    }

    fn minutes_between(&self, name: &str, from: i64, to: i64) -> f64 {
        let all = self.of(name).filter(|one| (from..to).contains(&day(one.begin)));
        all.map(|one| minutes(one.length())).sum::<f64>() / (to - from) as f64
    }

    fn hours_between(&self, name: &str, from: i64, to: i64) -> Vec<f64> {
        self.of(name).filter(|one| (from..to).contains(&day(one.begin))).map(|one| hour(one.begin)).collect()
    }

    /// The last end of an activity before an instant of the same day.
    fn last_end(&self, name: &str, before: RunTime) -> Option<RunTime> {
        self.of(name)
            .map(|one| one.end)
            .filter(|end| *end <= before + SECOND)
            .max()
            .filter(|end| before - *end < DAY / 2)
    }

    /// Minutes from the end of one activity to the beginning of another, in each evening.
    fn gaps(&self, after: &str, name: &str) -> Vec<f64> {
        let mut last = RunTime::START;
        let first = |one: &Interval<RunTime>| std::mem::replace(&mut last, one.end) + 4 * HOUR < one.begin;
        let begun = self.of(name).filter(first).map(|one| one.begin);
        begun.filter_map(|begin| Some(minutes(begin - self.last_end(after, begin)?))).collect()
    }
}

#[test]
fn a_bedtime_follows_what_it_is_said_to_follow() {
    for (said, after, gap) in [
        ("She goes to bed an hour after dinner.\n", "eating_dinner", 60.0),
        ("She watches television from 20:00 to 21:30, then goes to bed.\n", "watching_television", 0.0),
        (
            "She watches television at 21:00 for 40 minutes.\nShe goes to bed right after the news.\n",
            "watching_television",
            0.0,
        ),
        ("She reads at 21:00 for 30 minutes.\nShe goes to bed 20 minutes after she reads.\n", "reading", 20.0),
    ] {
        let lived = live(&format!("{MEALS}{said}"), 21);
        let gaps = lived.gaps(after, "going_to_bed");
        // She washes and goes to the bathroom on the way.
        let (least, most) = (gap - 8.0, gap + 35.0);
        assert!(gaps.len() >= 20 && gaps.iter().all(|by| (least..most).contains(by)), "{said}{gaps:.0?}");
        assert!((mean(&gaps) - gap).abs() < 20.0, "{said}{gaps:.0?}");
    }
}

#[test]
fn a_bedtime_waits_for_a_late_activity() {
    // The outing delays dinner on Tuesdays.
    let said = "On Tuesday she goes out from 15:00 to 20:00.\nShe goes to bed an hour after dinner.\n";
    let lived = live(&format!("{MEALS}{said}"), 28);
    let gaps = lived.gaps("eating_dinner", "going_to_bed");
    assert!(gaps.len() >= 27 && gaps.iter().all(|by| *by > 50.0), "{gaps:.0?}");
}

#[test]
fn a_rising_precedes_what_it_is_said_to_precede() {
    let said = "Margaret is 82.\nShe eats breakfast at 09:30.\nShe gets up an hour before breakfast.\n";
    let ups = Simulated::new(said, 14).hours_between("getting_up", 1, 14);
    assert!(ups.len() == 13 && ups.iter().all(|up| (8.2..8.8).contains(up)), "{ups:.2?}");
}

#[test]
fn no_rule_stops_a_run() {
    let recipes = [
        "3 times a week she exercises for 20 minutes.\nOn Sunday her son visits at 14:00 for 2 hours.\n\
         Whenever her son comes, she makes tea.\n\
         Whenever she has eaten lunch, unless her son is there, she naps for 45 minutes.\n",
        "Whenever it is 06:30, she goes to the front door, opens it, and closes it.\n",
        "Whenever it is dark, she phones for 5 minutes.\nWhenever she is alone, she drinks.\n",
    ];
    for recipe in recipes {
        let (scenario, household) = household(&files(&format!("{BASE}{recipe}"), &[]), &[]).unwrap();
        for seed in 1..=10 {
            // It stops at a segment that does not begin where the one before ends.
            let run = Run::new(&scenario, &household, seed, 20 * DAY);
            assert!(activities(&events(run, DAY), 0, 20 * DAY).len() > 400);
        }
    }
}

#[test]
fn a_changed_meal_moves_with_its_preparation() {
    for (meal, verb, by) in [
        ("dinner", "eats dinner an hour earlier", -1.0),
        ("lunch", "eats lunch an hour later", 1.0),
        ("breakfast", "eats breakfast half an hour later", 0.5),
        ("dinner", "prepares dinner an hour later", 1.0),
    ] {
        let lived = live(&format!("{MEALS}From day 15 she {verb}.\n"), 30);
        for name in [format!("preparing_{meal}"), format!("eating_{meal}")] {
            let [before, after] = [(0, 14), (14, 30)].map(|(from, to)| lived.hours_between(&name, from, to));
            let shift = mean(&after) - mean(&before);
            assert!((shift - by).abs() < 0.25 && after.len() >= 15, "{verb}: {name} by {shift} h");
        }
    }
}

#[test]
fn what_follows_a_meal_never_comes_before_it() {
    let said = "On Tuesday and Friday she goes out at 10:00 for 3 hours.\nShe naps after lunch for 40 minutes.\n\
                She takes her medicine after lunch.\nShe goes for a walk 30 minutes after lunch for 20 minutes.\n";
    for meals in ["", MEALS] {
        let lived = live(&format!("{meals}{said}"), 60);
        let mut counts = Vec::new();
        for (name, from) in [("napping", 11.0), ("taking_medicine", 0.0), ("away", 13.4)] {
            let all: Vec<RunTime> = lived.of(name).map(|one| one.begin).filter(|at| hour(*at) > from).collect();
            let before = all.iter().filter(|at| {
                lived.of("eating_lunch").any(|lunch| day(lunch.begin) == day(**at) && lunch.end > **at + SECOND)
            });
            counts.push((name, before.count(), all.len()));
        }
        assert!(counts.iter().all(|(_, before, all)| *before == 0 && *all >= 50), "{counts:?}");
    }
}

#[test]
fn the_place_of_sleep_is_that_of_the_night() {
    let room = |lived: &Simulated, night: Interval<RunTime>| {
        let mut at = lived.events.facts.iter().filter_map(|fact| match fact {
            Fact::Movement { resident, begin, doing: MotionState::Rest { at }, .. }
                if resident.index() == 0 && night.contains(*begin) =>
            {
                Some(*at)
            }
            _ => None,
        });
        let at = at.next_back()?;
        let near = |name: &str| {
            let place = lived.places.iter().find(|(place, _)| place == name);
            place.is_some_and(|(_, place)| place.distance(at) < 1.2)
        };
        ["bed", "armchair"].into_iter().find(|name| near(name))
    };
    let shares = |said: &str| {
        let lived = live(said, 60);
        let nights: Vec<(i64, bool)> = lived
            .of("sleeping")
            .filter(|night| night.length() > HOUR)
            .filter_map(|night| Some((day(night.begin), room(&lived, night)? == "armchair")))
            .collect();
        let share = |from: i64, to: i64| {
            let of: Vec<f64> = nights
                .iter()
                .filter(|(day, _)| (from..to).contains(day))
                .map(|(_, is_in_chair)| f64::from(u8::from(*is_in_chair)))
                .collect();
            mean(&of)
        };
        (share(1, 29), share(31, 59))
    };
    let dated = "Until day 31 she goes to bed at 22:30.\nFrom day 31 she goes to bed in the armchair at 22:30.\n";
    assert_eq!(shares(dated), (0.0, 1.0));
    let back = "Until day 31 she goes to bed in the armchair at 22:30.\nFrom day 31 she goes to bed at 22:30.\n";
    assert_eq!(shares(back), (1.0, 0.0));
    let (before, after) = shares("On 25 % of nights she goes to bed in the armchair.\n");
    let share = (before + after) / 2.0;
    assert!((0.1..0.45).contains(&share), "{share}");
}

#[test]
fn who_does_not_eat_does_not_cook_and_who_does_not_cook_eats_cold() {
    for meals in ["", MEALS] {
        let no_lunch = live(&format!("{meals}From day 2 she does not eat lunch.\n"), 30);
        let [eaten, cooked] = ["eating_lunch", "preparing_lunch"].map(|name| no_lunch.often(name, 2, 30));
        assert_eq!((eaten, cooked), (0.0, 0.0));
        let cold = live(&format!("{meals}From day 15 she does not prepare dinner.\n"), 30);
        assert_eq!(cold.often("preparing_dinner", 14, 30), 0.0);
        assert!(cold.often("eating_dinner", 14, 30) > 0.9, "{}", cold.often("eating_dinner", 14, 30));
        let [before, after] =
            [(0, 14), (14, 30)].map(|(from, to)| mean(&cold.hours_between("eating_dinner", from, to)));
        assert!((before - after).abs() < 0.4, "from {before} to {after}");
        let half = live(&format!("{meals}From day 1 she eats dinner half as often.\n"), 60);
        let [cooked, eaten] = ["preparing_dinner", "eating_dinner"].map(|name| half.often(name, 0, 60));
        assert!((eaten - 0.5).abs() < 0.2 && (cooked - eaten).abs() < 0.05, "{cooked} cooked, {eaten} eaten");
    }
}

#[test]
fn what_a_sentence_has_ended_does_not_come_back() {
    let lived = live("Until day 30 she goes out on Tuesday and Friday at 10:00 for 2 hours.\n", 60);
    let (before, after) = (lived.often("away", 0, 29), lived.often("away", 30, 60));
    assert!((0.2..0.35).contains(&before) && after == 0.0, "{before}, then {after}");
    let lived = live("Until day 30 she watches television in the evening for 2 hours.\n", 60);
    assert_eq!(lived.minutes_between("watching_television", 30, 60), 0.0);
    // An episode leaves the usual days around it.
    let lived = live("From day 10 to day 20 she goes out at 10:00 for 2 hours.\n", 60);
    assert!(lived.often("away", 20, 60) > 0.6, "{}", lived.often("away", 20, 60));
    // All people eat.
    let lived = live("Until day 30 she eats lunch at 13:00.\n", 60);
    assert!(lived.often("eating_lunch", 30, 60) > 0.8, "{}", lived.often("eating_lunch", 30, 60));
}

#[test]
fn a_chain_at_night_is_done_to_its_end() {
    for when in ["On 2 or 3 nights a week", "On 40 % of nights", "Every night"] {
        let lived = live(&format!("{when} she dresses at 02:00 for 10 minutes, then washes for 10 minutes.\n"), 60);
        let at_night = |name| lived.of(name).filter(|one| (1.8..3.2).contains(&hour(one.begin))).count();
        let (first, second) = (at_night("dressing"), at_night("washing"));
        assert!(first >= 12 && second * 10 >= first * 9, "{when}: {first} and {second}");
    }
}

#[test]
fn cooked_food_is_eaten_within_half_an_hour_and_not_before() {
    let scenarios = [
        String::new(),
        MEALS.to_owned(),
        format!(
            "{MEALS}She takes a shower at 07:55.\nShe goes out at 17:30 for 90 minutes.\nShe takes her medicine with dinner.\n"
        ),
        "She lies down before dinner for 40 minutes.\nShe naps after lunch.\nShe goes out at 12:10 for 2 hours.\n"
            .to_owned(),
    ];
    for said in scenarios {
        let lived = live(&said, 60);
        for meal in ["breakfast", "lunch", "dinner"] {
            let (cooking, eating) = (format!("preparing_{meal}"), format!("eating_{meal}"));
            let mut late = 0;
            let cooked: Vec<Interval<RunTime>> = lived.of(&cooking).collect();
            for one in &cooked {
                let next = cooked.iter().map(|other| other.begin).find(|begin| *begin > one.begin);
                // Only the last part of an interrupted preparation.
                if next.is_some_and(|next| next - one.end < HOUR) {
                    continue;
                }
                let eaten = lived.of(&eating).find(|eaten| eaten.end > one.end);
                late += u32::from(eaten.is_none_or(|eaten| eaten.begin - one.end > 30 * MINUTE));
            }
            assert!(late <= 1, "{said}{meal}: {late} of {}", cooked.len());
            let early = lived
                .of(&eating)
                .filter(|eaten| cooked.iter().any(|one| day(one.begin) == day(eaten.begin) && one.begin >= eaten.end));
            assert_eq!(early.count(), 0, "{said}{meal}");
        }
    }
}

#[test]
fn every_activity_takes_time() {
    for said in
        ["", "She goes out at 10:00 until 10:05.\nWhenever the stove has been on for 5 minutes, she turns it off.\n"]
    {
        let lived = live(said, 120);
        let empty: Vec<_> = lived.activities.iter().filter(|(time, _)| time.length() <= Span::ZERO).collect();
        assert!(empty.is_empty(), "{empty:?}");
    }
}

#[test]
fn a_longer_pastime_is_longer_by_what_is_said() {
    for (said, factor) in [
        ("She watches television at 19:00 for 2 hours.\nFrom day 31 she watches television 60 % longer.\n", 1.6),
        ("From day 31 she watches television 20 % longer.\n", 1.2),
        ("From day 31 she watches television half as long.\n", 0.5),
        ("From day 31 she reads twice as long.\n", 2.0),
    ] {
        let lived = live(said, 60);
        let name = if said.contains("reads") { "reading" } else { "watching_television" };
        let (before, after) = (lived.minutes_between(name, 0, 30), lived.minutes_between(name, 30, 60));
        assert!((after / before / factor - 1.0).abs() < 0.12, "{said}from {before} to {after}");
    }
}

#[test]
fn a_changed_pace_is_that_of_the_strides() {
    let pace = |lived: &Simulated, from: i64, to: i64| {
        let strides = lived.events.facts.iter().filter_map(|fact| match fact {
            Fact::Movement { resident, begin, end, doing: MotionState::Stride { from, to }, .. }
                if resident.index() == 0 =>
            {
                Some((*begin, from.distance(*to), (*end - *begin).seconds()))
            }
            _ => None,
        });
        let of: Vec<_> = strides.filter(|(begin, ..)| (from..to).contains(&day(*begin))).collect();
        of.iter().map(|(_, metres, _)| metres).sum::<f64>() / of.iter().map(|(.., seconds)| seconds).sum::<f64>()
    };
    for (said, factor) in [("33 % slower", 0.67), ("20 % faster", 1.2), ("50 % slower", 0.5)] {
        let lived = live(&format!("From day 21 she walks {said}.\n"), 40);
        let change = pace(&lived, 20, 40) / pace(&lived, 0, 20);
        assert!((change / factor - 1.0).abs() < 0.05, "{said}: {change}");
    }
}

#[test]
fn two_counts_of_a_night_hold_in_their_phases() {
    let said = "Until day 31 she goes to the bathroom twice a night.\nFrom day 31 she goes to the bathroom four times a night.\n";
    let lived = live(&format!("{said}She goes to bed at 22:00.\n"), 60);
    let nightly = |from: i64, to: i64| {
        let at_night = lived.hours_between("using_bathroom", from, to);
        at_night.iter().filter(|hour| !(6.75..22.4).contains(*hour)).count() as f64 / (to - from) as f64
    };
    let (before, after) = (nightly(1, 30), nightly(31, 60));
    assert!((before - 2.0).abs() < 0.4 && (after - 4.0).abs() < 0.5, "{before}, then {after}");
}

#[test]
fn a_total_counts_the_visits_with_a_time() {
    let said = "She goes to bed at 22:00.\nShe goes to the bathroom at 01:30.\nShe goes to the bathroom three times a night.\n";
    let nightly = |is_total: bool| {
        let lived = Simulated::of_changed(&format!("{BASE}{said}"), 40, |routine| {
            let all = routine.habits.iter_mut().map(|habit| &mut habit.when).filter(|when| when.times == (3, 3));
            all.for_each(|when| when.is_total = is_total);
        });
        let hours = lived.hours_between("using_bathroom", 1, 40);
        hours.iter().filter(|hour| !(6.75..22.4).contains(*hour)).count() as f64 / 39.0
    };
    let (added, total) = (nightly(false), nightly(true));
    assert!((added - 4.0).abs() < 0.4 && (total - 3.0).abs() < 0.3, "{added} added, {total} in all");
}

#[test]
fn a_time_in_bed_has_its_length() {
    const NIGHT_S: f64 = 10.5 * 3_600.0;
    let of = |timed: bool| {
        let lived = Simulated::of_changed(&format!("{BASE}She goes to bed at 22:30.\n"), 40, |routine| {
            let at = routine.habits.iter().position(|habit| habit.activity == Activity::GoToBed).unwrap();
            let phase = Phase { from: Some(PhaseDay::Day(20)), ..Phase::default() };
            let mut longer = routine.habits[at].clone();
            (longer.when.lasts, longer.when.phase) = (Some(Fuzzy::exactly(NIGHT_S)), phase);
            if timed {
                routine.habits[at].when.phase.until = Some(PhaseDay::Day(20));
            } else {
                longer.when.time = HabitTime::AnyTime;
            }
            routine.habits.push(longer);
        });
        let ups: Vec<RunTime> = lived.of("getting_up").map(|one| one.begin).collect();
        let bed = |up: RunTime| {
            let to_bed = lived.of("going_to_bed").map(|one| one.begin).filter(|at| up - *at < 15 * HOUR && *at < up);
            to_bed.min()
        };
        let nights = |from: i64, to: i64| {
            let of = ups.iter().filter(|up| (from..to).contains(&day(**up)));
            mean(&of.filter_map(|up| Some((*up - bed(*up)?).ratio(HOUR))).collect::<Vec<f64>>())
        };
        let hours = lived.hours_between("getting_up", 22, 40);
        (nights(1, 20), nights(22, 40), mean(&hours))
    };
    // A time in bed with its bedtime delays the rising; without one it begins earlier.
    let ((before, after, up), (_, earlier, stays)) = (of(true), of(false));
    assert!(
        (before - 8.5).abs() < 0.4 && (after - 10.5).abs() < 0.4 && (up - 9.0).abs() < 0.3,
        "{before} {after} {up}"
    );
    assert!((earlier - 10.5).abs() < 0.4 && (stays - 7.0).abs() < 0.2, "{earlier} {stays}");
}

#[test]
fn a_probability_is_that_of_each_day_that_matches() {
    let days = 52 * 7;
    let lived = live("On 23 % of Sundays she bakes at 15:00 for 60 minutes.\n", days);
    let on: Vec<i64> = lived.of("baking").map(|one| day(one.begin)).collect();
    assert!(on.iter().all(|day| day % 7 == 6), "{on:?}");
    assert!((7..=17).contains(&on.len()), "{} of 52 Sundays, expected 12", on.len());
}

#[test]
fn a_day_in_bed_is_left_for_needs_and_visitors_alone() {
    let carer = "A carer visits every day at 11:00 for 30 minutes.\n";
    let lived = live(&format!("{carer}From day 11, for 5 days, she stays in bed.\n"), 25);
    let hours = |day: i64, name: &str| {
        let of_day = lived.of(name).filter(|one| self::day(one.begin) == day);
        of_day.map(|one| one.length().ratio(HOUR)).sum::<f64>()
    };
    for day in 10..15 {
        let in_bed = hours(day, "resting_in_bed") + hours(day, "napping");
        assert!(in_bed > 13.0, "{in_bed} on {day}");
        assert!(hours(day, "using_bathroom") > 0.0 && hours(day, "visit") > 0.4);
        assert_eq!(hours(day, "eating_lunch") + hours(day, "dressing") + hours(day, "away"), 0.0);
    }
    for day in [8, 9, 15, 16] {
        assert!(hours(day, "resting_in_bed") == 0.0 && hours(day, "eating_lunch") > 0.1, "{day}");
    }
    let some = live("Twice a week she stays in bed all day.\n", 56);
    let days: std::collections::BTreeSet<i64> = some.of("resting_in_bed").map(|one| self::day(one.begin)).collect();
    assert_eq!(days.len(), 16);
}
