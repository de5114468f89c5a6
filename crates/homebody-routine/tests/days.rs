//! Frequencies by day, quiet and busy days, and late rising, measured in the ground truth of months.

use crate::stage::{ORDINARY, Simulated, day, hour, mean, run};
use homebody_core::event::Events;
use homebody_core::time::{DAY, MINUTE, RunTime};
use homebody_routine::household::Household;
use std::sync::OnceLock;

const BASE: &str = "Margaret is 82. She walks at 0.65 m/s.\nShe gets up at 07:00.\n";
const BED: &str = "She goes to bed at 22:30.\n";
const DAYS: i64 = 90;

fn live(sentences: &str) -> Simulated {
    Simulated::new(&format!("{BASE}{sentences}\n"), DAYS)
}

/// Metres of each day with nothing said.
fn plain_metres() -> &'static [f64] {
    static METRES: OnceLock<Vec<f64>> = OnceLock::new();
    METRES.get_or_init(|| live(BED).metres_by_day())
}

impl Simulated {
    /// Day and hour of each beginning; an interruption of less than half an hour does not count.
    fn begins(&self, name: &str) -> Vec<(i64, f64)> {
        let (mut begun, mut last) = (Vec::new(), RunTime::START - DAY);
        for time in self.of(name) {
            if time.begin - last > 30 * MINUTE || name == "using_bathroom" {
                begun.push((day(time.begin), hour(time.begin)));
            }
            last = time.end;
        }
        begun
    }

    fn times_a_day(&self, name: &str, from: f64, to: f64) -> f64 {
        self.begins(name).iter().filter(|(_, hour)| (from..to).contains(hour)).count() as f64 / DAYS as f64
    }

    fn on_days(&self, name: &str, from: f64, to: f64) -> usize {
        let mut on: Vec<i64> =
            self.begins(name).iter().filter(|(_, at)| (from..to).contains(at)).map(|of| of.0).collect();
        on.dedup();
        on.len()
    }
}

#[test]
fn every_morning_and_evening_is_once_in_each() {
    for said in [
        "She prays once every morning and evening.",
        "She prays twice: morning and evening.",
        "She prays every morning and every evening.",
        "Every morning and evening she prays.",
    ] {
        let lived = live(&format!("{BED}{said}"));
        let (morning, evening) = (lived.on_days("praying", 7.0, 13.0), lived.on_days("praying", 17.5, 22.6));
        let times = lived.times_a_day("praying", 0.0, 24.0);
        assert!(morning >= 87 && evening >= 87 && (1.95..2.05).contains(&times), "{said} {morning} {evening} {times}");
    }
}

#[test]
fn seven_or_eight_times_are_seven_and_a_half() {
    for (said, name, from, to) in [
        ("She goes to the toilet seven or eight times a day.", "using_bathroom", 6.9, 22.9),
        ("She drinks seven or eight times a day.", "drinking", 0.0, 24.0),
        ("She paces seven or eight times a day.", "pacing", 0.0, 24.0),
        ("She has a snack seven or eight times a day.", "having_a_snack", 0.0, 24.0),
    ] {
        let times = live(&format!("{BED}{said}")).times_a_day(name, from, to);
        assert!((times / 7.5 - 1.0).abs() < 0.03, "{said} {times}");
    }
    let lived = live(&format!("{BED}She goes to the toilet seven or eight times a night."));
    let times = lived.times_a_day("using_bathroom", 22.9, 24.0) + lived.times_a_day("using_bathroom", 0.0, 6.9);
    assert!((times / 7.5 - 1.0).abs() < 0.03, "{times} a night");
}

#[test]
fn a_quiet_day_has_half_of_the_movement_and_a_busy_one_half_as_much_again() {
    let plain = plain_metres();
    let is_monday = |day: &usize| day.is_multiple_of(7);
    for (said, least, most) in [
        ("Mondays are quiet days.", 0.42, 0.58),
        ("Mondays are busy days.", 1.35, 1.65),
        ("On Monday she hardly leaves her chair.", 0.2, 0.42),
    ] {
        let lived = live(&format!("{BED}{said}")).metres_by_day();
        let of = |metres: &[f64], on: bool| {
            (0..DAYS as usize).filter(|day| is_monday(day) == on).map(|day| metres[day]).sum::<f64>()
        };
        let (share, others) = (of(&lived, true) / of(plain, true), of(&lived, false) / of(plain, false));
        assert!((least..most).contains(&share) && (0.93..1.07).contains(&others), "{said} {share}, of others {others}");
    }
}

#[test]
fn the_stated_share_of_days_is_quiet() {
    let plain = plain_metres();
    let lived = live(&format!(
        "{BED}One day in three is a quiet day: she hardly leaves her chair.\nOn quiet days she prays at 11:00."
    ));
    let quiet: Vec<usize> = lived.begins("praying").iter().map(|(day, _)| *day as usize).collect();
    // Three standard errors of a third of 90 days.
    assert!((17..=43).contains(&quiet.len()), "{} days", quiet.len());
    let metres = lived.metres_by_day();
    let share = |is_quiet: bool| {
        let days = (0..DAYS as usize).filter(|day| quiet.contains(day) == is_quiet);
        let (with, without) = days.fold((0.0, 0.0), |sums, day| (sums.0 + metres[day], sums.1 + plain[day]));
        with / without
    };
    assert!(share(true) < 0.5 && (0.9..1.1).contains(&share(false)), "{} and {}", share(true), share(false));
}

#[test]
fn busy_days_are_those_of_most_movement() {
    let lived = live(&format!("{BED}On busy days she prays at 11:00."));
    let busy: Vec<usize> = lived.begins("praying").iter().map(|(day, _)| *day as usize).collect();
    let metres = lived.metres_by_day();
    let of = |is_busy: bool| {
        mean(&(0..DAYS as usize).filter(|day| busy.contains(day) == is_busy).map(|day| metres[day]).collect::<Vec<_>>())
    };
    // A share of 0.2 of the days is busy.
    assert!((7..=29).contains(&busy.len()), "{} days", busy.len());
    assert!(of(true) > 1.3 * of(false), "{} m on busy days, {} m on others", of(true), of(false));
}

#[test]
fn days_that_differ_a_lot_differ_more_around_the_same_mean() {
    let spread = |metres: &[f64]| {
        let all = mean(metres);
        (mean(&metres.iter().map(|of| (of - all) * (of - all)).collect::<Vec<_>>())).sqrt() / all
    };
    let (plain, differ) = (plain_metres(), live(&format!("{BED}Her days differ a lot.")).metres_by_day());
    let ordinary = live(&format!("{BED}Some days are busy and some are quiet.")).metres_by_day();
    assert!(spread(&differ) > 1.4 * spread(plain), "{} beside {}", spread(&differ), spread(plain));
    assert!(spread(&ordinary) > 1.2 * spread(plain), "{} beside {}", spread(&ordinary), spread(plain));
    assert!((0.85..1.15).contains(&(mean(&differ) / mean(plain))), "{} of {} m", mean(&differ), mean(plain));
}

#[test]
fn a_late_bedtime_shifts_the_rising() {
    let base = "On Friday and Saturday she goes to bed at 01:00. On weekdays but not on Friday she goes to bed at 22:30. \
                On Sunday she goes to bed at 22:30.";
    for said in [
        "When she goes to bed late she gets up late.",
        "After a late night she sleeps in.",
        "If she goes to bed an hour later she gets up an hour later.",
    ] {
        let lived = live(&format!("{base}\n{said}"));
        let ups = lived.begins("getting_up");
        let of = |weekend: bool| -> Vec<f64> {
            ups.iter().filter(|(day, _)| (day % 7 >= 5) == weekend).map(|(_, hour)| *hour).collect()
        };
        let (late, early) = (of(true), of(false));
        assert!(late.len() >= 24 && early.len() >= 62, "{} and {} risings", late.len(), early.len());
        assert!((mean(&late) - 9.5).abs() < 0.35 && (mean(&early) - 7.0).abs() < 0.15, "{said} {late:?} {early:?}");
    }
    // The control, without that sentence.
    let ups = live(base).begins("getting_up");
    assert!(ups.iter().all(|(_, hour)| (hour - 7.0).abs() < 0.5), "{ups:?}");
}

#[test]
fn a_late_night_is_late_whatever_made_it_so() {
    let said = "Every third day she goes out at 19:00 for 6 hours.\nWhen she goes to bed late she gets up late.";
    let lived = live(&format!("{BED}{said}"));
    let beds = lived.begins("going_to_bed");
    let late: Vec<i64> = beds.iter().filter(|(_, hour)| *hour < 6.0).map(|(day, _)| *day).collect();
    let ups = lived.begins("getting_up");
    let up_on = |day: i64| ups.iter().find(|(of, _)| *of == day).map(|(_, hour)| *hour);
    assert!(late.len() > 25, "{} late nights", late.len());
    let by: Vec<f64> = late.iter().filter_map(|day| up_on(*day)).collect();
    assert!(by.iter().all(|hour| (8.5..11.0).contains(hour)), "{by:?}");
}

#[test]
fn a_stay_of_days_is_measured_from_coming_to_leaving() {
    let mut run = run(&format!("{BED}From day 10 her son stays for a week.\n"), DAYS);
    run.advance(RunTime::START + DAYS * DAY, &mut Events::default()).unwrap();
    let of_son = Household::differences(&run).into_iter().filter(|of| of.text.contains("her son"));
    assert_eq!(of_son.collect::<Vec<_>>(), []);
}

#[test]
fn the_ordinary_routine_runs_by_its_sentences() {
    let mut run = run(ORDINARY, DAYS);
    run.advance(RunTime::START + DAYS * DAY, &mut Events::default()).unwrap();
    assert_eq!(Household::differences(&run), []);
}

#[test]
fn a_visit_to_a_closed_door_is_reported() {
    let said = "On Tuesday and Friday she goes out at 10:05 for 2 hours.\nHer daughter visits at 10:20 on weekdays.\n";
    let mut run = run(&format!("{BED}{said}"), DAYS);
    run.advance(RunTime::START + DAYS * DAY, &mut Events::default()).unwrap();
    let reported = Household::differences(&run);
    let of_daughter = reported.iter().find(|of| of.text.contains("daughter"));
    assert!(of_daughter.is_some_and(|of| of.lost_share > 0.3), "{reported:?}");
}
