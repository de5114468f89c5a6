//! What measures are taken from, as people wrote down what they did: the activities that logs of real homes come with.
//!
//! Labels are anybody's words. What is not told, such as in which room somebody was all day, has no measure.

use super::held::Measures;
use super::kinds::MEASURES;
use super::timeline::Timeline;
use crate::dates::date_of;
use homebody_core::activity::{AWAY, EATING_LUNCH, SHOWERING, SLEEPING};
use homebody_core::names::words;
use homebody_core::time::{Micros, SECOND};
use homebody_log::{Activity, Life};
use std::ops::Range;

/// What a label tells, by how one of its words begins (ours); the first that fits counts.
const TELLS: [(Tells, &[&str]); 6] = [
    (Tells::Shower, &["shower", "bathe", "bathing"]),
    (Tells::Bathroom, &["toilet", "hygien", "groom", "bathroom"]),
    (Tells::Bed, &["sleep", "bed"]),
    (Tells::Meal, &["breakfast", "lunch", "dinner", "supper", "eat", "meal"]),
    (Tells::Leaves, &["leav"]),
    (Tells::Comes, &["enter", "return"]),
];

/// For which measures something has to be told.
const MEASURED: [(&str, Tells); 9] = [
    ("time_in_bed", Tells::Bed),
    ("bedtime", Tells::Bed),
    ("rising", Tells::Bed),
    ("bathroom_night", Tells::Bathroom),
    ("bathroom_day", Tells::Bathroom),
    ("showers", Tells::Shower),
    ("meals", Tells::Meal),
    ("time_out", Tells::Leaves),
    ("outings", Tells::Leaves),
];

/// Longest gap between bathroom activities of one visit, with no other activity between them (our choice).
const ONE_VISIT: Micros = 10 * 60 * SECOND;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Tells {
    Shower,
    Bathroom,
    Bed,
    Meal,
    /// Being out, or the beginning of it where a label tells of its end, too.
    Leaves,
    Comes,
}

impl Tells {
    fn of(label: &str) -> Option<Tells> {
        let said = words(label);
        if said == [AWAY] {
            return Some(Tells::Leaves);
        }
        let fits = |begins: &&str| said.iter().any(|word| word.starts_with(begins));
        TELLS.iter().find(|(_, begins)| begins.iter().any(fits)).map(|(tells, _)| *tells)
    }
}

impl Measures {
    /// Of the activities that a log tells, for the days that touch `recorded`. `None` where no label tells of anything that is measured.
    pub fn told(name: &str, activities: &[Activity], recorded: Range<Micros>) -> Option<Measures> {
        let mut told: Vec<(Tells, &Activity)> =
            activities.iter().filter_map(|one| Some((Tells::of(&one.name)?, one))).collect();
        told.sort_by_key(|(_, one)| one.begin);
        let has = |tells: Tells| told.iter().any(|(other, _)| *other == tells);
        if MEASURED.iter().all(|(_, tells)| !has(*tells)) {
            return None;
        }
        let mut life = Life::default();
        for (number, &(tells, one)) in told.iter().enumerate() {
            let mut add = |name: &str, end: Micros| {
                life.activities.push(Activity { name: name.to_owned(), begin: one.begin, end });
            };
            match tells {
                Tells::Bed => add(SLEEPING, one.end),
                Tells::Meal => add(EATING_LUNCH, one.end),
                Tells::Shower => add(SHOWERING, one.end),
                // Who leaves twice without coming has left with the second.
                Tells::Leaves if has(Tells::Comes) => {
                    let next =
                        told[number + 1..].iter().find(|(tells, _)| matches!(tells, Tells::Leaves | Tells::Comes));
                    let comes = next.filter(|(tells, _)| *tells == Tells::Comes);
                    comes.iter().for_each(|(_, comes)| add(AWAY, comes.end));
                }
                Tells::Leaves => add(AWAY, one.end),
                Tells::Bathroom | Tells::Comes => {}
            }
            if matches!(tells, Tells::Shower | Tells::Bathroom) {
                // Nothing else is noted in between, so nobody left.
                let is_next =
                    told[..number].last().is_some_and(|(tells, _)| matches!(tells, Tells::Shower | Tells::Bathroom));
                match life.rooms.last_mut().filter(|last| is_next && one.begin - last.end <= ONE_VISIT) {
                    Some(last) => last.end = last.end.max(one.end),
                    None => life.rooms.push(Activity { name: "bathroom".to_owned(), ..one.clone() }),
                }
            }
        }
        let mut measures = Measures::of(name, &Timeline::lived(&life, recorded), Vec::new());
        let first = |tells: Tells| told.iter().find(|(other, _)| *other == tells).map(|(_, one)| date_of(one.begin));
        for (number, measure) in MEASURES.iter().enumerate() {
            // Before the first note of a kind, its count is not known.
            let since = MEASURED.iter().find(|(name, _)| *name == measure.name).and_then(|(_, tells)| first(*tells));
            for day in measures.days.iter_mut().filter(|day| since.is_none_or(|since| day.date < since)) {
                day.values[number] = None;
            }
        }
        Some(measures)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::DAY;

    const H: Micros = 3600 * SECOND;

    fn one(name: &str, begin: Micros, end: Micros) -> Activity {
        Activity { name: name.to_owned(), begin, end }
    }

    fn on_day_1(measures: &Measures, name: &str) -> Option<f64> {
        measures.days[1].value(name)
    }

    #[test]
    fn labels_in_anybodys_words_are_measured() {
        let activities = [
            one("Sleeping", DAY - H, DAY + 7 * H),
            one("Bed_Toilet_Transition", DAY + 3 * H, DAY + 3 * H + H / 20),
            one("use toilet", DAY + 8 * H, DAY + 8 * H + H / 20),
            one("Showering", DAY + 9 * H, DAY + 9 * H + H / 5),
            one("prepare Dinner", DAY + 18 * H, DAY + 19 * H),
            one("Spare_Time/TV", DAY + 20 * H, DAY + 21 * H),
        ];
        let measures = Measures::told("log", &activities, 0..2 * DAY).unwrap();
        let expected = [
            ("time_in_bed", 8.0),
            ("rising", 7.0),
            ("bathroom_night", 1.0),
            ("bathroom_day", 2.0),
            ("showers", 1.0),
            ("meals", 1.0),
        ];
        for (name, value) in expected {
            assert_eq!(on_day_1(&measures, name), Some(value), "{name}");
        }
        // Nothing tells of being out, or of rooms.
        assert_eq!((on_day_1(&measures, "time_out"), on_day_1(&measures, "room_changes")), (None, None));
        assert!(Measures::told("log", &activities[5..], 0..2 * DAY).is_none());
    }

    #[test]
    fn who_leaves_is_out_until_they_come() {
        let activities =
            [one("Leave_Home", DAY + 9 * H, DAY + 9 * H + H / 60), one("Enter_Home", DAY + 11 * H, DAY + 11 * H)];
        let measures = Measures::told("log", &activities, 0..2 * DAY).unwrap();
        assert_eq!((on_day_1(&measures, "time_out"), on_day_1(&measures, "outings")), (Some(2.0), Some(1.0)));
        // The first time nobody noted when they came.
        let twice = [one("Leave_Home", DAY + 7 * H, DAY + 7 * H), activities[0].clone(), activities[1].clone()];
        let measures = Measures::told("log", &twice, 0..2 * DAY).unwrap();
        assert_eq!(on_day_1(&measures, "time_out"), Some(2.0));
        let measures = Measures::told("log", &[one("Leaving", DAY + 9 * H, DAY + 10 * H)], 0..2 * DAY).unwrap();
        assert_eq!(on_day_1(&measures, "time_out"), Some(1.0));
    }
}
