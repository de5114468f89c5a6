//! Stated activities come before usual ones: at their time, to their end, and as often as stated.

use crate::stage::{Simulated, day, files, hour};
use homebody_core::event::Fact;
use homebody_core::time::{HOUR, Interval, MINUTE, RunTime, SECOND, Span};

const BASE: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 07:00.\nShe goes to bed at 22:30.\n";
const LATE_RISER: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 10:15.\nShe goes to bed at 01:15.\n";

fn simulate(base: &str, said: &str, days: i64) -> Simulated {
    Simulated::new(&format!("{base}{said}\n"), days)
}

/// The share of times within some minutes of an hour of the day.
fn share_at(times: &[RunTime], at: f64, within_min: f64) -> f64 {
    times.iter().filter(|time| ((hour(**time) - at) * 60.0).abs() <= within_min).count() as f64 / times.len() as f64
}

/// Minutes from the last end of an activity, on the same day, to each of these times.
fn minutes_after(lived: &Simulated, name: &str, times: &[RunTime]) -> Vec<f64> {
    let last = |at: RunTime| lived.of(name).map(|one| one.end).filter(|end| *end <= at + SECOND).max();
    let of_day = |at: &RunTime| last(*at).filter(|end| day(*end) == day(*at)).map(|end| (*at - end).ratio(MINUTE));
    times.iter().filter_map(of_day).collect()
}

#[test]
fn a_usual_meal_with_its_preparation_leaves_a_stated_time_free() {
    for (said, name, at) in [
        ("She makes her bed at 8:30.", "housework", 8.5),
        ("She prays from 18:25 until 19:25.", "praying", 18.0 + 25.0 / 60.0),
        ("She takes her medicine at 12:30.", "taking_medicine", 12.5),
    ] {
        let lived = simulate(BASE, said, 60);
        let times = lived.firsts(name);
        let share = share_at(&times, at, 8.0);
        assert!(times.len() >= 59 && share > 0.93, "{said} {share} of {}", times.len());
        for meal in ["breakfast", "lunch", "dinner"] {
            let eaten = lived.firsts(&format!("eating_{meal}")).len();
            assert!(eaten >= 57, "{said} {meal} on {eaten} days");
        }
    }
}

#[test]
fn a_stated_meal_does_not_wait_for_a_stated_time() {
    // Both are stated. The meal begins first and is eaten as it is cooked.
    let said = "She prepares breakfast at 08:05 for 15 minutes, then eats for 20 minutes.\nShe makes her bed at 8:30.";
    let lived = simulate(BASE, said, 40);
    assert!(share_at(&lived.firsts("preparing_breakfast"), 8.0 + 5.0 / 60.0, 8.0) > 0.93);
    assert!(share_at(&lived.firsts("housework"), 8.5, 8.0) < 0.3);
}

#[test]
fn a_stated_pastime_is_left_for_a_usual_meal_only_if_it_is_long() {
    let broken = |said: &str, name: &str| {
        let lived = simulate(BASE, said, 40);
        let dinner: Vec<RunTime> = lived.firsts("preparing_dinner");
        let spans: Vec<Interval<RunTime>> = lived.of(name).filter(|one| hour(one.begin) > 16.5).collect();
        let is_broken = |of: i64| {
            let of_day = || spans.iter().filter(|one| day(one.begin) == of);
            let (Some(first), Some(last)) = (of_day().next(), of_day().next_back()) else { return false };
            dinner.iter().any(|at| (first.begin..last.begin).contains(at))
        };
        (0..40).filter(|&day| is_broken(day)).count()
    };
    assert_eq!(broken("She prays from 17:05 until 18:15.", "praying"), 0);
    // Nobody plays for five hours without dinner.
    assert!(broken("She plays the piano from 17:05 until 22:00.", "making_music") > 30);
}

#[test]
fn an_activity_is_over_at_its_stated_end() {
    let noon = "She prepares lunch at 12:00 for 25 minutes, then eats for 25 minutes.\n";
    for (said, name) in [
        ("She exercises from 11:15 until 13:00.", "exercising"),
        ("She does the housework from 11:15 until 13:00.", "housework"),
        ("She does the laundry from 11:50 until 12:10.", "laundry"),
        ("She reads from 11:15 until 13:00.", "reading"),
        ("She watches television from 11:15 until 13:00.", "watching_television"),
        ("She prays from 11:15 until 12:30.", "praying"),
    ] {
        let until = if said.contains("12:10") {
            12.0 + 10.0 / 60.0
        } else if said.contains("12:30") {
            12.5
        } else {
            13.0
        };
        let lived = simulate(BASE, &format!("{noon}{said}"), 40);
        let noon = lived.of(name).filter(|one| (11.0..13.0).contains(&hour(one.begin)));
        // The end itself varies by up to 5 minutes.
        let late: Vec<f64> = noon.map(|one| (hour(one.end) - until) * 60.0).filter(|late| *late > 6.0).collect();
        assert!(lived.firsts(name).len() >= 39 && late.is_empty(), "{said} {late:.1?} min");
    }
    // A length has no end, so what a meal interrupts is done after it.
    let lived = simulate(BASE, &format!("{noon}She exercises at 11:15 for 105 minutes."), 40);
    let after = lived.of("exercising").filter(|one| hour(one.end) > 13.2).count();
    assert!(after > 30, "on {after} of 40 days");
}

#[test]
fn what_was_turned_on_is_off_after_the_stated_end() {
    let said = "She prepares lunch at 12:00 for 25 minutes, then eats for 25 minutes.\n\
                She watches television from 11:15 until 12:40.\nShe takes a shower from 09:00 until 09:12.";
    let lived = simulate(BASE, said, 40);
    for (thing, from, to) in [("TV bench", 12.0, 13.3), ("shower", 9.0, 9.4)] {
        let on = lived.on(thing);
        let of_then = on.iter().filter(|one| hour(one.begin) < from + 0.4 && hour(one.end) > from);
        let late: Vec<f64> = of_then.map(|one| hour(one.end)).filter(|end| *end > to).collect();
        assert!(on.len() >= 39 && late.is_empty(), "{thing} {late:.2?}");
    }
}

impl Simulated {
    /// The times of a thing that is on.
    fn on(&self, thing: &str) -> Vec<Interval<RunTime>> {
        let mut all: Vec<Interval<RunTime>> = Vec::new();
        let mut since = None;
        for fact in &self.events.facts {
            let Fact::Use { at, act, .. } = fact else { continue };
            if self.things[act.thing.index()] != thing {
                continue;
            }
            match (act.on, since) {
                (true, None) => since = Some(*at),
                (false, Some(begin)) => {
                    all.push(Interval::new(begin, *at));
                    since = None;
                }
                _ => {}
            }
        }
        all
    }

    /// The share of nights with an activity between bedtime and rising.
    fn nights_with(&self, name: &str) -> f64 {
        let noon = |at: RunTime| day(at - 12 * 60 * MINUTE);
        let mut nights: Vec<i64> =
            self.of(name).filter(|one| !(8.0..22.0).contains(&hour(one.begin))).map(|one| noon(one.begin)).collect();
        nights.dedup();
        nights.len() as f64 / self.days as f64
    }
}

#[test]
fn a_night_awake_is_as_frequent_as_stated() {
    for (said, least, most) in [
        ("Often she lies awake at night for 30 minutes.", 0.55, 0.85),
        ("On 30 % of nights she lies awake for 30 minutes.", 0.17, 0.43),
        ("Every night she lies awake for 30 minutes.", 0.95, 1.0),
    ] {
        let share = simulate(BASE, said, 90).nights_with("lying_awake");
        assert!((least..=most).contains(&share), "{said} {share}");
    }
    assert!(simulate(BASE, "She does not lie awake at night.", 90).nights_with("lying_awake") < 0.05);
    // Without a statement about a night, its wakings are as usual.
    assert!(simulate(BASE, "", 90).nights_with("lying_awake") > 0.85);
    let share = simulate(BASE, "She lies awake at 03:00 on Sunday for 30 minutes.", 90).nights_with("lying_awake");
    assert!(share > 0.85, "{share}");
}

#[test]
fn what_follows_another_activity_comes_right_after_it() {
    for (base, said, name, after, gap, days) in [
        (
            LATE_RISER,
            "She goes out after breakfast on Monday and Sunday for 2 hours.",
            "leaving_home",
            "eating_breakfast",
            0.0,
            70,
        ),
        (LATE_RISER, "She naps after breakfast on Monday and Wednesday.", "napping", "eating_breakfast", 0.0, 70),
        (BASE, "She paces 10 minutes after she gets up for 5 to 25 minutes.", "pacing", "getting_up", 10.0, 90),
        (BASE, "She bakes a cake 30 minutes after she gets up.", "baking", "getting_up", 30.0, 90),
        (BASE, "She plays the piano after lunch for 40 minutes.", "making_music", "eating_lunch", 0.0, 60),
    ] {
        let lived = simulate(base, said, days);
        let firsts = lived.firsts(name);
        let outings = |at: &RunTime| name != "leaving_home" || [0, 6].contains(&(day(*at) % 7));
        let firsts: Vec<RunTime> = firsts.into_iter().filter(outings).collect();
        let gaps = minutes_after(&lived, after, &firsts);
        // A visit to the bathroom may come first.
        let in_time = gaps.iter().filter(|by| (gap - 3.0..gap + 13.0).contains(*by)).count();
        assert!(gaps.len() >= 19 && in_time * 10 >= gaps.len() * 9, "{said} {in_time} of {gaps:.0?}");
    }
}

#[test]
fn a_usual_outing_leaves_room_for_a_stated_part_of_the_day() {
    let said = "Her son visits at 17:05 for 100 minutes.\nShe does the laundry in the afternoon for 15 minutes.";
    let lived = simulate(BASE, said, 60);
    let late: Vec<f64> = lived.firsts("laundry").iter().map(|at| hour(*at)).filter(|at| *at > 19.2).collect();
    assert!(lived.firsts("laundry").len() >= 58 && late.is_empty(), "{late:.1?}");
    // She still goes out as usual.
    assert!(lived.firsts("leaving_home").len() > 40);
}

#[test]
fn what_goes_with_a_meal_comes_between_its_preparation_and_it() {
    let breakfast = "She prepares breakfast at 09:00 for 8 minutes, then eats for 20 minutes.\n";
    let letters = "She writes letters at 08:55 for 40 minutes.\n";
    for (base, said, name, meal) in [
        (BASE, format!("{breakfast}{letters}She takes her pills with breakfast."), "taking_medicine", "breakfast"),
        (BASE, format!("{breakfast}She takes her pills with breakfast."), "taking_medicine", "breakfast"),
        (BASE, format!("{breakfast}She listens to the radio with breakfast for 40 minutes."), "listening", "breakfast"),
        (BASE, "She waters her plants with lunch for 8 minutes.".to_owned(), "caring_for_plants", "lunch"),
        (
            LATE_RISER,
            "She writes letters at 10:40 for 35 minutes.\nShe takes her pills with breakfast.".to_owned(),
            "taking_medicine",
            "breakfast",
        ),
        (
            LATE_RISER,
            "She eats lunch at 12:45.\nShe checks her blood pressure with lunch for 5 minutes.".to_owned(),
            "checking_health",
            "lunch",
        ),
        (
            BASE,
            "She goes out at 10:00 for 3 hours.\nShe takes her pills with lunch.".to_owned(),
            "taking_medicine",
            "lunch",
        ),
    ] {
        let lived = simulate(base, &said, 60);
        let taken = lived.firsts(name);
        let [cooked, eaten] = ["preparing", "eating"].map(|verb| lived.firsts(&format!("{verb}_{meal}")));
        let is_between = |at: &&RunTime| {
            let of_day = |times: &[RunTime]| times.iter().copied().find(|time| day(*time) == day(**at));
            of_day(&cooked).is_none_or(|cooked| cooked < **at)
                && of_day(&eaten).is_some_and(|eaten| **at < eaten + MINUTE)
        };
        let between = taken.iter().filter(is_between).count();
        assert!(taken.len() >= 57 && between * 20 >= taken.len() * 19, "{said} {between} of {}", taken.len());
    }
}

#[test]
fn a_forgotten_stove_stays_on_in_a_home_of_one_room() {
    let meals = "She prepares lunch at 12:00 for 25 minutes, then eats for 25 minutes.\n";
    let long = |said: &str, (home, logger): (&str, &str)| {
        let files = files(&format!("{BASE}{meals}{said}"), &[("home.json", home), ("logger.json", logger)]);
        let lived = Simulated::of_files(files, 60, |_| {});
        let ends: Vec<RunTime> = lived.of("preparing_lunch").map(|one| one.end).collect();
        let on = lived.on("stove");
        let left = |end: &&RunTime| on.iter().any(|one| one.begin < **end && one.end > **end + 3 * MINUTE);
        let longest = on.iter().map(|one| one.length()).fold(Span::ZERO, Span::max);
        (ends.iter().filter(left).count() as f64 / ends.len() as f64, longest)
    };
    let studio =
        (include_str!("../../../scenarios/studio/home.json"), include_str!("../../../scenarios/studio/logger.json"));
    let (share, longest) = long("She forgets the stove on 50 % of occasions.", studio);
    assert!((0.3..0.7).contains(&share), "{share}");
    // It is seen on the way back from another room.
    assert!(longest < 6 * 60 * MINUTE, "{longest}");
    let (share, _) = long("", studio);
    assert_eq!(share, 0.0);
    let apartment = (
        include_str!("../../../scenarios/tigerplace/home.json"),
        include_str!("../../../scenarios/tigerplace/logger.json"),
    );
    let (share, _) = long("She forgets the stove on 50 % of occasions.", apartment);
    assert!((0.3..0.7).contains(&share), "{share}");
}

#[test]
fn a_meal_cooked_too_late_does_not_stop_the_days_after() {
    let lived = simulate(BASE, "She prepares dinner at 22:05 for 40 minutes, then eats for 40 minutes.", 40);
    let late = lived.firsts("preparing_dinner").iter().filter(|at| hour(**at) > 21.5).count();
    let eaten = lived.firsts("eating_dinner").len();
    assert!(late >= 35 && eaten < 5, "{late} cooked, {eaten} eaten");
    for name in ["eating_breakfast", "preparing_lunch", "eating_lunch"] {
        let days = lived.firsts(name).len();
        assert!(days >= 39, "{name} on {days} days");
    }
}

#[test]
fn a_stated_part_of_the_day_finds_the_time_between_stated_times() {
    let said = "She prepares lunch at 12:00 for 25 minutes, then eats for 25 minutes.\nShe prays from 15:45 until 17:30.\n\
        She prepares dinner at 17:30 for 30 minutes, then eats for 30 minutes.\n\
        She goes out in the afternoon for 60 to 65 minutes.";
    let lived = simulate(BASE, said, 40);
    let out = lived.firsts("away");
    let in_time = out.iter().filter(|at| (12.0..17.5).contains(&hour(**at))).count();
    assert!(out.len() >= 39 && 10 * in_time >= 9 * out.len(), "{in_time} of {}", out.len());
    assert!(share_at(&lived.firsts("praying"), 15.75, 12.0) > 0.93);
}

#[test]
fn nobody_naps_in_the_time_of_a_stated_activity() {
    let said = "Usually she naps.\nShe looks out of the window from 14:00 until 15:30.";
    let lived = simulate(BASE, said, 60);
    let begun = |at: RunTime| (13.9..15.4).contains(&hour(at));
    assert_eq!(lived.of("napping").filter(|one| begun(one.begin)).count(), 0);
    assert!(share_at(&lived.firsts("looking_out"), 14.0, 15.0) > 0.93);
    // On a day without it she does.
    assert!(simulate(BASE, "Usually she naps.", 60).of("napping").count() > 20);
}

#[test]
fn twice_as_often_is_on_twice_as_many_days() {
    let days = |said: &str| simulate(BASE, said, 120).firsts("exercising").len();
    let some = days("On 40 % of days she exercises at 10:00.");
    let more = days("On 40 % of days she exercises at 10:00.\nShe exercises twice as often.");
    assert!((35..62).contains(&some) && (84..108).contains(&more), "{some} {more}");
    let weekly = days("She exercises 3 times a week at 10:00.\nShe exercises twice as often.");
    assert!((100..106).contains(&weekly), "{weekly}");
}

#[test]
fn so_often_within_some_days_is_no_absence_of_these_days() {
    let lived = simulate(BASE, "From day 8, for 28 days, she goes out at 18:40 4 times a week for 1 hour.", 50);
    let evenings: Vec<i64> =
        lived.of("away").filter(|one| (18.5..19.0).contains(&hour(one.begin))).map(|one| day(one.begin)).collect();
    assert!((15..=17).contains(&evenings.len()) && evenings.iter().all(|day| (7..35).contains(day)), "{evenings:?}");
    assert!(lived.of("away").all(|one| one.length() < 10 * 60 * MINUTE));
}

#[test]
fn an_early_rising_moves_what_follows_it() {
    let said = "Whenever she has been in bed for 6 hours, she gets up.\nShe prays 30 minutes after she gets up for 20 minutes.";
    let lived = simulate(BASE, said, 40);
    let prayers = lived.firsts("praying");
    let gaps = minutes_after(&lived, "getting_up", &prayers);
    let right = gaps.iter().filter(|gap| (28.0..45.0).contains(*gap)).count();
    assert!(right as f64 > 0.85 * gaps.len() as f64 && gaps.len() > 30, "{gaps:?}");
}

/// How often an activity is done on each of these days, and in the nights before them.
fn by_day_and_night(lived: &Simulated, name: &str, days: std::ops::Range<i64>) -> (Vec<usize>, Vec<usize>) {
    let hours: Vec<f64> = lived.of(name).map(|one| one.begin.since_zero().ratio(HOUR)).collect();
    let between = |from: f64, to: f64| hours.iter().filter(|hour| (from..to).contains(*hour)).count();
    let start = |day: i64| day as f64 * 24.0;
    let nights = days.clone().map(|day| between(start(day) - 1.2, start(day) + 6.75)).collect();
    (days.map(|day| between(start(day) + 6.75, start(day) + 22.8)).collect(), nights)
}

#[test]
fn stated_times_of_a_night_are_all_its_visits() {
    let nights = |said: &str| by_day_and_night(&simulate(BASE, said, 60), "using_bathroom", 1..60).1;
    let exact = nights("She goes to the bathroom at about 01:00 and at about 04:00.");
    assert!(exact.iter().filter(|of| **of == 2).count() >= 57, "{exact:?}");
    let usual = nights("");
    assert!(usual.iter().filter(|of| **of == 2).count() < 40, "{usual:?}");
    let dated = nights("On day 6 she goes to the bathroom at 03:15.");
    assert_eq!(dated[4], 1, "{dated:?}");
    assert!(dated.iter().sum::<usize>() > usual.iter().sum::<usize>() / 2);
}

#[test]
fn so_many_times_a_day_between_two_hours_are_all_of_the_day() {
    let said = "5 times a day she goes to the bathroom between 06:45 and 19:00.";
    let (days, nights) = by_day_and_night(&simulate(BASE, said, 60), "using_bathroom", 1..60);
    assert!(days.iter().filter(|of| **of == 5).count() >= 56, "{days:?}");
    assert!(nights.iter().sum::<usize>() > 40, "{nights:?}");
    let lived = simulate(BASE, "7 to 8 times a day she has a drink between 07:00 and 20:00.", 60);
    let (days, _) = by_day_and_night(&lived, "drinking", 1..60);
    assert!(days.iter().filter(|of| (7..=8).contains(*of)).count() >= 54, "{days:?}");
    let late = lived.of("drinking").filter(|one| hour(one.begin) > 20.25).count();
    assert!(late <= 1, "{late}");
    // A single time adds to the usual drinks.
    assert!(simulate(BASE, "She has a drink at 16:00.", 60).of("drinking").count() > 120);
}

#[test]
fn who_needs_help_in_the_shower_takes_no_other() {
    let showers = |said: &str| {
        let lived = simulate(BASE, said, 56);
        let days: Vec<i64> = lived.firsts("showering").into_iter().map(day).collect();
        days
    };
    let helped = showers("On Saturday her daughter helps her take a shower at 10:00 for 40 minutes.");
    assert!(helped.len() >= 7 && helped.iter().all(|day| day % 7 == 5), "{helped:?}");
    assert!(showers("").len() > 20);
}

#[test]
fn a_later_outing_comes_on_top_of_the_usual_ones() {
    let outings = |said: &str| {
        let lived = simulate(BASE, said, 120);
        let days: Vec<i64> = lived.firsts("away").into_iter().map(day).collect();
        [0..60, 60..120].map(|days_of| days.iter().filter(|day| days_of.contains(*day)).count() as f64)
    };
    let [before, after] = outings("From day 61 on Wednesday she goes to the post office at 10:30 for 45 minutes.");
    assert!(before > 30.0 && after > 0.75 * before, "{before}, then {after}");
    // A frequency replaces them.
    let [before, after] = outings("From day 61 she goes out once a week.");
    assert!(before > 30.0 && after < 10.0, "{before}, then {after}");
}

#[test]
fn a_meal_is_skipped_as_many_times_a_week_as_stated() {
    let lived = simulate(BASE, "Twice a week she skips lunch.", 70);
    let eaten: Vec<i64> = lived.firsts("eating_lunch").into_iter().map(day).collect();
    let weeks: Vec<usize> = (0..10).map(|week| 7 - eaten.iter().filter(|day| **day / 7 == week).count()).collect();
    assert!(weeks.iter().filter(|skipped| **skipped == 2).count() >= 9, "{weeks:?}");
}

#[test]
fn nobody_has_a_snack_just_before_a_meal() {
    let lived = simulate(BASE, "She eats lunch at 12:45 for 25 minutes.", 90);
    let meals: Vec<RunTime> =
        ["breakfast", "lunch", "dinner"].into_iter().flat_map(|meal| lived.firsts(&format!("eating_{meal}"))).collect();
    let snacks: Vec<Interval<RunTime>> = lived.of("having_a_snack").collect();
    assert!(snacks.len() > 20, "{}", snacks.len());
    for snack in snacks {
        let soon = Interval::new(snack.end, snack.end + 40 * MINUTE);
        assert!(!meals.iter().any(|meal| soon.contains(*meal)), "a snack before a meal, {snack:?}");
    }
}

#[test]
fn a_usual_outing_does_not_delay_a_meal_that_something_comes_before() {
    let lived = simulate(BASE, "She rests in bed 50 minutes before lunch for 70 minutes.", 60);
    let gaps = minutes_after(&lived, "resting_in_bed", &lived.firsts("eating_lunch"));
    let near = gaps.iter().filter(|gap| **gap <= 70.0).count();
    assert!(gaps.len() > 50 && near * 10 > gaps.len() * 9, "{near} of {} {gaps:?}", gaps.len());
}
