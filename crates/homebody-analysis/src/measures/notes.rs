//! Measures by the notes of activities in a log, and their comparison with measures by its sensors.
//!
//! Labels are free words. A log without notes of rooms, for example, has no measure of room changes.

use super::measure::NoteMeaning;
use super::registry::MEASURES;
use super::timeline::MeasureTimeline;
use super::values::{Measures, NoteComparison};
use homebody_core::activity::{AWAY, EATING_LUNCH, SHOWERING, SLEEPING};
use homebody_core::names::words;
use homebody_core::statistics::mean;
use homebody_core::time::{Interval, MINUTE, Span, WallTime};
use homebody_timeline::{Episode, PersonTimeline};

/// The meaning of a label, by the beginning of one of its words (our choice). The first that fits counts.
const MEANINGS: [(NoteMeaning, &[&str]); 6] = [
    (NoteMeaning::Shower, &["shower", "bathe", "bathing"]),
    (NoteMeaning::Bathroom, &["toilet", "hygien", "groom", "bathroom"]),
    (NoteMeaning::Bed, &["sleep", "bed"]),
    (NoteMeaning::Meal, &["breakfast", "lunch", "dinner", "supper", "eat", "meal"]),
    (NoteMeaning::Leaves, &["leav"]),
    (NoteMeaning::Comes, &["enter", "return"]),
];

/// Longest gap between bathroom activities of one visit, with no other activity between them (our choice).
const ONE_VISIT: Span = MINUTE.times(10);

impl NoteMeaning {
    fn of_label(label: &str) -> Option<NoteMeaning> {
        let said = words(label);
        if said == [AWAY] {
            return Some(NoteMeaning::Leaves);
        }
        let fits = |begins: &&str| said.iter().any(|word| word.starts_with(begins));
        MEANINGS.iter().find(|(_, begins)| begins.iter().any(fits)).map(|(tells, _)| *tells)
    }
}

impl Measures {
    /// By the notes of a log, for the days that touch `recorded`; `None` if no note has a meaning for any measure.
    pub fn from_notes(name: &str, activities: &[Episode<WallTime>], recorded: Interval<WallTime>) -> Option<Measures> {
        let mut told: Vec<(NoteMeaning, &Episode<WallTime>)> =
            activities.iter().filter_map(|one| Some((NoteMeaning::of_label(&one.label)?, one))).collect();
        told.sort_by_key(|(_, one)| one.begin());
        let has = |tells: NoteMeaning| told.iter().any(|(other, _)| *other == tells);
        if MEASURES.iter().filter_map(|measure| measure.noted).all(|meaning| !has(meaning)) {
            return None;
        }
        let mut person = PersonTimeline::default();
        for (number, &(tells, one)) in told.iter().enumerate() {
            let mut add = |label: &str, end: WallTime| {
                person.activities.push(Episode::new(label.to_owned(), Interval::new(one.begin(), end)));
            };
            match tells {
                NoteMeaning::Bed => add(SLEEPING, one.end()),
                NoteMeaning::Meal => add(EATING_LUNCH, one.end()),
                NoteMeaning::Shower => add(SHOWERING, one.end()),
                // A person who leaves twice without coming has left with the second.
                NoteMeaning::Leaves if has(NoteMeaning::Comes) => {
                    let next = told[number + 1..]
                        .iter()
                        .find(|(tells, _)| matches!(tells, NoteMeaning::Leaves | NoteMeaning::Comes));
                    let comes = next.filter(|(tells, _)| *tells == NoteMeaning::Comes);
                    comes.iter().for_each(|(_, comes)| add(AWAY, comes.end()));
                }
                NoteMeaning::Leaves => add(AWAY, one.end()),
                NoteMeaning::Bathroom | NoteMeaning::Comes => {}
            }
            if matches!(tells, NoteMeaning::Shower | NoteMeaning::Bathroom) {
                // There is no other note in between, so the person stayed.
                let is_next = told[..number]
                    .last()
                    .is_some_and(|(tells, _)| matches!(tells, NoteMeaning::Shower | NoteMeaning::Bathroom));
                match person.rooms.last_mut().filter(|last| is_next && one.begin() - last.end() <= ONE_VISIT) {
                    Some(last) => last.time = last.time.hull(one.time),
                    None => person.rooms.push(Episode::new("bathroom".to_owned(), one.time)),
                }
            }
        }
        let mut measures = Measures::from_timeline(name, &MeasureTimeline::from_truth(&person, recorded), Vec::new());
        let first =
            |tells: NoteMeaning| told.iter().find(|(other, _)| *other == tells).map(|(_, one)| one.begin().date());
        for (number, measure) in MEASURES.iter().enumerate() {
            // Before the first note of a kind, its count is not known.
            let since = measure.noted.and_then(first);
            for day in measures.days.iter_mut().filter(|day| since.is_none_or(|since| day.date < since)) {
                day.values[number] = None;
            }
        }
        Some(measures)
    }

    /// Compares measures by sensors with measures by the notes of a log. A measure that no sensor has given yet is taken from the notes.
    pub(super) fn compare_with_notes(&mut self, notes: &[Episode<WallTime>], recorded: Interval<WallTime>) {
        let Some(told) = Measures::from_notes(&self.name, notes, recorded) else { return };
        for (number, measure) in MEASURES.iter().enumerate() {
            let noted = |date| told.days.iter().find(|day| day.date == date)?.values[number];
            let both = self.days.iter().filter_map(|day| day.values[number].zip(noted(day.date)));
            let (by_sensors, by_notes): (Vec<f64>, Vec<f64>) = both.unzip();
            let apart: Vec<f64> = by_sensors.iter().zip(&by_notes).map(|(a, b)| (a - b).abs()).collect();
            let days = apart.len();
            if let (Some(by_notes), Some(by_sensors), Some(apart)) = (mean(&by_notes), mean(&by_sensors), mean(&apart))
            {
                self.noted.push(NoteComparison {
                    measure: measure.name,
                    unit: measure.unit.name,
                    days,
                    by_notes,
                    by_sensors,
                    apart,
                });
            }
            let silent = self.days.iter().position(|day| day.values[number].is_some()).unwrap_or(self.days.len());
            let mut is_taken = false;
            for day in &mut self.days[..silent] {
                day.values[number] = noted(day.date);
                is_taken |= day.values[number].is_some();
            }
            if is_taken {
                self.from_notes.push(measure.name);
            }
        }
        if !self.from_notes.is_empty() {
            self.remarks.push(format!(
                "Taken from the log's notes until a sensor gives a value: {}",
                self.from_notes.join(", ")
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_core::time::{DAY, HOUR};

    const RECORDED: Interval<WallTime> = Interval::new(WallTime::EPOCH, WallTime::from_micros(DAY.times(2).micros()));

    /// From one hour of the second day to another.
    fn one(name: &str, begin_h: f64, end_h: f64) -> Episode<WallTime> {
        let at = |hours: f64| WallTime::EPOCH + DAY + HOUR.scaled(hours);
        Episode::new(name.to_owned(), Interval::new(at(begin_h), at(end_h)))
    }

    fn on_day_1(measures: &Measures, name: &str) -> Option<f64> {
        measures.days[1].value(name)
    }

    #[test]
    fn measures_free_labels() {
        let activities = [
            one("Sleeping", -1.0, 7.0),
            one("Bed_Toilet_Transition", 3.0, 3.05),
            one("use toilet", 8.0, 8.05),
            one("Showering", 9.0, 9.2),
            one("prepare Dinner", 18.0, 19.0),
            one("Spare_Time/TV", 20.0, 21.0),
        ];
        let measures = Measures::from_notes("log", &activities, RECORDED).unwrap();
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
        assert!(Measures::from_notes("log", &activities[5..], RECORDED).is_none());
    }

    #[test]
    fn outing_lasts_from_leaving_to_coming() {
        let activities = [one("Leave_Home", 9.0, 9.0 + 1.0 / 60.0), one("Enter_Home", 11.0, 11.0)];
        let measures = Measures::from_notes("log", &activities, RECORDED).unwrap();
        assert_eq!((on_day_1(&measures, "time_out"), on_day_1(&measures, "outings")), (Some(2.0), Some(1.0)));
        // The first time there is no note of coming.
        let twice = [one("Leave_Home", 7.0, 7.0), activities[0].clone(), activities[1].clone()];
        let measures = Measures::from_notes("log", &twice, RECORDED).unwrap();
        assert_eq!(on_day_1(&measures, "time_out"), Some(2.0));
        let measures = Measures::from_notes("log", &[one("Leaving", 9.0, 10.0)], RECORDED).unwrap();
        assert_eq!(on_day_1(&measures, "time_out"), Some(1.0));
    }
}
