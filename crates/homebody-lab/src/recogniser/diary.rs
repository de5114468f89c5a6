//! The annotations of a log as a diary that a routine can be written from.

use super::windows::On;
use homebody_core::time::{Interval, WallTime};
use homebody_routine::rhythm::DiaryEntry;
use homebody_routine::routine::{Activity, Meal};
use homebody_timeline::Episode;

/// The activity behind each annotation. Spare time is the rest, so no entry is made for it.
const NAMES: [(&str, Activity); 9] = [
    ("Sleeping", Activity::GoToBed),
    ("Toileting", Activity::UseBathroom),
    ("Showering", Activity::Shower),
    ("Grooming", Activity::Wash),
    ("Breakfast", Activity::Eat(Meal::Breakfast)),
    ("Lunch", Activity::Eat(Meal::Lunch)),
    ("Dinner", Activity::Eat(Meal::Dinner)),
    ("Snack", Activity::Snack),
    ("Leaving", Activity::Leave),
];

/// The activities that the annotations cover, under any name: meals include their preparation, and sleep includes naps.
pub fn known() -> Vec<Activity> {
    let meals = [Meal::Breakfast, Meal::Lunch, Meal::Dinner].map(Activity::Prepare);
    NAMES.map(|(_, activity)| activity).into_iter().chain(meals).chain([Activity::Nap]).collect()
}

/// The activities within an interval. A meal is prepared until the last time that a sensor of the kitchen begins or ends in it, and eaten
/// then.
pub fn diary_entries(annotations: &[Episode<WallTime>], kitchen: &[On], within: Interval<WallTime>) -> Vec<DiaryEntry> {
    let mut noted = Vec::new();
    for Episode { label, time: Interval { begin, end } } in annotations {
        let Some((_, what)) = NAMES.iter().find(|(called, _)| called == label) else { continue };
        let (begin, end) = (*begin, *end);
        if !within.contains(begin) || end > within.end {
            continue;
        }
        if let Activity::Eat(meal) = what {
            let used =
                kitchen.iter().flat_map(|on| [on.time.begin, on.time.end]).filter(|at| (begin..=end).contains(at));
            let prepared = used.max().unwrap_or(begin);
            noted.push(DiaryEntry { what: Activity::Prepare(*meal), begin, end: prepared });
            noted.push(DiaryEntry { what: what.clone(), begin: prepared, end });
        } else {
            noted.push(DiaryEntry { what: what.clone(), begin, end });
        }
    }
    noted.retain(|one| one.end > one.begin);
    noted.sort_by_key(|one| one.begin);
    noted
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::SECOND;

    #[test]
    fn a_meal_is_prepared_until_the_kitchen_is_left() {
        let second = |second: i64| WallTime::EPOCH + second * SECOND;
        let annotation =
            |label: &str, begin, end| Episode::new(label.to_owned(), Interval::new(second(begin), second(end)));
        let annotations = [
            annotation("Lunch", 100, 400),
            annotation("Spare_Time/TV", 400, 900),
            annotation("Snack", 900, 910),
            annotation("Leaving", 990, 2000),
        ];
        let on = |begin, end| On { sensor: 0, time: Interval::new(second(begin), second(end)) };
        let kitchen = [on(90, 120), on(150, 250), on(500, 510)];
        let noted = diary_entries(&annotations, &kitchen, Interval::new(second(0), second(1000)));
        let entries: Vec<(Activity, WallTime, WallTime)> =
            noted.into_iter().map(|one| (one.what, one.begin, one.end)).collect();
        let wanted = [
            (Activity::Prepare(Meal::Lunch), second(100), second(250)),
            (Activity::Eat(Meal::Lunch), second(250), second(400)),
            (Activity::Snack, second(900), second(910)),
        ];
        assert_eq!(entries, wanted);
    }

    #[test]
    fn every_annotation_has_a_class() {
        for (name, activity) in NAMES {
            assert_eq!(
                super::super::classes::class_of(name),
                super::super::classes::class_of(activity.label()),
                "{name}"
            );
        }
    }
}
