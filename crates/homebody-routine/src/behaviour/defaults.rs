//! Usual lengths and times of activities: those of the table of activities, unless the scenario sets them.

use crate::routine::Activity;
use homebody_core::activity::UsualLength;
use homebody_core::fuzzy::Fuzzy;
use homebody_core::numbers::{Number, Numbers};

const TABLE: &str = "activity";

const MINUTE: f64 = 60.0;
const HOUR: f64 = 3600.0;

/// All user activities share the row of `Other`.
fn all() -> impl Iterator<Item = Activity> {
    Activity::all_of_table().chain([Activity::Other(String::new())])
}

fn row(activity: &Activity) -> &str {
    match activity {
        Activity::Other(_) => "other",
        activity => activity.label(),
    }
}

pub(super) fn length(activity: &Activity, numbers: &Numbers) -> UsualLength {
    let UsualLength { median_min, sigma } = activity.usual_length();
    let row = row(activity);
    UsualLength {
        median_min: numbers.of_table([TABLE, row, "minutes"], median_min),
        sigma: numbers.of_table([TABLE, row, "spread"], sigma),
    }
}

/// In seconds since midnight; `None` without a usual time.
pub(super) fn clock(activity: &Activity, numbers: &Numbers) -> Option<Fuzzy> {
    let own = activity.usual_clock();
    if !numbers.are_set() {
        return own;
    }
    let (around_h, spread_min) = parts(&own?);
    let row = row(activity);
    let around_h = numbers.of_table([TABLE, row, "clock"], around_h);
    let spread_min = numbers.of_table([TABLE, row, "clock_spread"], spread_min);
    Some(Fuzzy::around(around_h * HOUR, spread_min * MINUTE))
}

/// In hours, and the largest deviation in minutes.
fn parts(clock: &Fuzzy) -> (f64, f64) {
    (clock.from / HOUR, (clock.high - clock.to) / MINUTE)
}

pub(super) fn numbers() -> Vec<Number> {
    let mut numbers = Vec::new();
    for activity in all() {
        let row = row(&activity);
        let mut add = |column: &str, value, unit, range, what: &str| {
            let what = format!("{what} of `{row}`, if the routine gives none.");
            numbers.push(Number::of_table([TABLE, row, column], value, unit, range, what, file!()));
        };
        let UsualLength { median_min, sigma } = activity.usual_length();
        add("minutes", median_min, "min", [0.1, 600.0], "Median duration, in minutes,");
        add("spread", sigma, "1", [0.0, 2.0], "Standard deviation of the logarithm of the duration");
        if let Some(clock) = activity.usual_clock() {
            let (around_h, spread_min) = parts(&clock);
            add("clock", around_h, "h", [0.0, 24.0], "Time of day, in hours,");
            add("clock_spread", spread_min, "min", [0.0, 360.0], "Largest deviation, in minutes, from the time of day");
        }
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn every_row_set_to_what_it_is_gives_what_there_is() {
        let own: BTreeMap<String, f64> =
            numbers().into_iter().map(|number| (number.name.into_owned(), number.value)).collect();
        let (set, none) = (Numbers::new(&own), Numbers::default());
        for activity in &all().collect::<Vec<_>>() {
            assert_eq!(length(activity, &set), length(activity, &none), "{activity:?}");
            assert_eq!(clock(activity, &set), clock(activity, &none), "{activity:?}");
        }
        let longer = Numbers::new(&[("activity.reading.minutes".to_owned(), 60.0)].into());
        assert_eq!(length(&Activity::Read, &longer), UsualLength { median_min: 60.0, ..Activity::Read.usual_length() });
        assert_eq!(length(&Activity::Phone, &longer), Activity::Phone.usual_length());
        let later = Numbers::new(&[("activity.napping.clock".to_owned(), 15.0)].into());
        assert_eq!(clock(&Activity::Nap, &later), Some(Fuzzy::around(15.0 * HOUR, 45.0 * MINUTE)));
    }

    #[test]
    fn no_name_comes_twice() {
        let mut names: Vec<_> = numbers().into_iter().map(|number| number.name).collect();
        let all = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), all);
    }
}
