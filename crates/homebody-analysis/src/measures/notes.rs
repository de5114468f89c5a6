//! Measures by the notes of activities in a log, and their comparison with measures by its sensors.
//!
//! Labels are free words. A log without notes of rooms, for example, has no measure of room changes. The values of a day follow from the
//! notes that have begun by its end.

use super::measure::{DailyMeasure, NoteMeaning};
use super::measured_day::{DayContext, MeasuredDay};
use super::registry::MEASURES;
use super::timeline::{LEAST_NIGHT, MeasureTimeline, OUT_OF_BED};
use super::values::{DayMeasures, Measures, NoteComparison, NotedDay, NotedMeasure};
use homebody_core::activity::{AWAY, EATING_LUNCH, SHOWERING, SLEEPING};
use homebody_core::names::words;
use homebody_core::problem::counted;
use homebody_core::statistics::mean;
use homebody_core::time::{DAY, HOUR, Interval, MINUTE, Span, WallTime, joined, union, without};
use homebody_timeline::{Episode, PersonTimeline};

/// The meaning of a label, by the beginning of one of its words (our choice). The first that fits counts.
const MEANINGS: [(NoteMeaning, &[&str]); 8] = [
    (NoteMeaning::Shower, &["shower", "bathe", "bathing"]),
    (NoteMeaning::Bathroom, &["toilet", "hygien", "groom", "bathroom"]),
    (NoteMeaning::Bed, &["sleep", "bed"]),
    (NoteMeaning::Meal, &["breakfast", "lunch", "dinner", "supper"]),
    (NoteMeaning::Eats, &["eat", "meal"]),
    (NoteMeaning::Cooks, &["cook"]),
    (NoteMeaning::Leaves, &["leav"]),
    (NoteMeaning::Comes, &["enter", "return"]),
];

/// Longest gap between bathroom activities of one visit, with no other activity between them (our choice).
const ONE_VISIT: Span = MINUTE.times(10);
/// Longest gap between notes of food of one meal, and shortest meal without a name (our choice). A bite is shorter.
const ONE_MEAL: Span = MINUTE.times(15);
const LEAST_MEAL: Span = MINUTE.times(3);
/// Longest time of a day without a note of anything, on a day that the notes cover, and longest such time before midnight (our choice):
/// notes that stop in the afternoon lack the evening.
const UNNOTED: Span = HOUR.times(12);
const UNNOTED_AT_END: Span = HOUR.times(6);
/// Time before a day whose notes are read with it, as a night begins before midnight.
const BEFORE: Span = DAY.times(2);

impl NoteMeaning {
    fn of_label(label: &str) -> Option<NoteMeaning> {
        let said = words(label);
        if said == [AWAY] {
            return Some(NoteMeaning::Leaves);
        }
        let fits = |begins: &&str| said.iter().any(|word| word.starts_with(begins));
        MEANINGS.iter().find(|(_, begins)| begins.iter().any(fits)).map(|(tells, _)| *tells)
    }

    /// A note of this shows the count of a measure that follows from the other.
    fn shows(self, other: NoteMeaning) -> bool {
        self == other || other == NoteMeaning::Meal && self == NoteMeaning::Eats
    }

    fn is_in_bathroom(self) -> bool {
        matches!(self, NoteMeaning::Shower | NoteMeaning::Bathroom)
    }

    fn is_of_food(self) -> bool {
        matches!(self, NoteMeaning::Meal | NoteMeaning::Eats | NoteMeaning::Cooks)
    }
}

/// A note up to the end of a day.
#[derive(Clone, Copy)]
struct NotedTime {
    meaning: Option<NoteMeaning>,
    time: Interval<WallTime>,
}

/// The notes of the last days, and the kinds of all notes so far.
#[derive(Default)]
struct NotesSoFar {
    kinds: Vec<NoteMeaning>,
    recent: Vec<NotedTime>,
}

impl NotesSoFar {
    fn take(&mut self, note: NotedTime) {
        self.recent.push(note);
        self.kinds.extend(note.meaning.filter(|meaning| !self.kinds.contains(meaning)));
    }

    /// Drops the notes that ended before an instant. A departure stays until the resident has come home.
    fn forget(&mut self, before: WallTime) {
        let mut next = WallTime::MAX;
        let mut kept = std::mem::take(&mut self.recent);
        kept.reverse();
        kept.retain(|note| match note.meaning {
            Some(NoteMeaning::Leaves) => std::mem::replace(&mut next, note.time.end).max(note.time.end) > before,
            Some(NoteMeaning::Comes) => {
                next = note.time.end;
                note.time.end > before
            }
            _ => note.time.end > before,
        });
        kept.reverse();
        self.recent = kept;
    }

    /// The notes that mean something, up to an instant.
    fn told(&self, until: WallTime) -> Vec<(NoteMeaning, Interval<WallTime>)> {
        let clipped = |time: Interval<WallTime>| Interval { end: time.end.min(until), ..time };
        self.recent.iter().filter_map(|note| Some((note.meaning?, clipped(note.time)))).collect()
    }

    /// The times out. Of a departure that has its own note, the end is the note of coming home. A person who leaves twice without coming has
    /// left with the second. A person who has left is out until there is another note.
    fn away(&self, until: WallTime) -> Vec<Interval<WallTime>> {
        let told = self.told(until);
        let left = told.iter().enumerate().filter(|(_, (meaning, _))| *meaning == NoteMeaning::Leaves);
        if !self.kinds.contains(&NoteMeaning::Comes) {
            return left.map(|(_, (_, time))| *time).collect();
        }
        let out = left.filter_map(|(number, (_, left))| {
            let mut rest = told[number + 1..].iter();
            let next = rest.find(|(meaning, _)| matches!(meaning, NoteMeaning::Leaves | NoteMeaning::Comes));
            let end = match next {
                Some((NoteMeaning::Comes, comes)) => Some(comes.end),
                None if number + 1 == told.len() => Some(until),
                _ => None,
            };
            Some(Interval::new(left.begin, end?))
        });
        out.collect()
    }

    /// The meals, by notes of food that are near each other.
    fn meals(&self, until: WallTime) -> Vec<Interval<WallTime>> {
        let told = self.told(until);
        let food = || told.iter().filter(|(meaning, _)| meaning.is_of_food());
        let periods = joined(food().map(|(_, time)| *time), ONE_MEAL);
        let is_meal = |period: &Interval<WallTime>| {
            food().filter(|(_, time)| period.begin <= time.begin && time.end <= period.end).any(|(meaning, _)| {
                *meaning == NoteMeaning::Meal || *meaning == NoteMeaning::Eats && period.length() >= LEAST_MEAL
            })
        };
        periods.into_iter().filter(is_meal).collect()
    }

    /// The times in bed. A short one soon after the night, with a meal or a time out between them, is a nap and no part of the night.
    fn in_bed(&self, until: WallTime, is_up: &[Interval<WallTime>]) -> Vec<Interval<WallTime>> {
        let told = self.told(until);
        let lain = told.iter().filter(|(meaning, _)| *meaning == NoteMeaning::Bed).map(|(_, time)| *time);
        let mut parts: Vec<Vec<Interval<WallTime>>> = Vec::new();
        for time in lain {
            let is_same = |last: &Interval<WallTime>| {
                time.begin - last.end <= OUT_OF_BED
                    && !is_up.iter().any(|up| up.begin >= last.end && up.end <= time.begin)
            };
            match parts.last_mut().filter(|part| part.last().is_some_and(is_same)) {
                Some(part) => part.push(time),
                None => parts.push(vec![time]),
            }
        }
        let mut night_end: Option<WallTime> = None;
        let kept = parts.into_iter().filter(|part| {
            let (begin, end) = (part[0].begin, part[part.len() - 1].end);
            let is_soon = night_end.is_some_and(|night_end| begin - night_end <= OUT_OF_BED);
            let is_nap = is_soon && end - begin < LEAST_NIGHT;
            night_end = if is_nap { night_end } else { Some(end) };
            !is_nap
        });
        kept.flatten().collect()
    }

    /// The visits to the bathroom.
    fn in_bathroom(&self, until: WallTime) -> Vec<Interval<WallTime>> {
        let mut visits: Vec<Interval<WallTime>> = Vec::new();
        let mut was_there = false;
        for (meaning, time) in self.told(until) {
            let is_there = meaning.is_in_bathroom();
            // Without another note in between, the resident stayed.
            match visits.last_mut().filter(|last| was_there && time.begin - last.end <= ONE_VISIT) {
                Some(last) if is_there => *last = last.hull(time),
                _ if is_there => visits.push(time),
                _ => {}
            }
            was_there = is_there;
        }
        visits
    }

    fn person(&self, until: WallTime) -> PersonTimeline<WallTime> {
        let (away, meals) = (self.away(until), self.meals(until));
        let is_up: Vec<Interval<WallTime>> = meals.iter().chain(&away).copied().collect();
        let told = self.told(until);
        let showers = told.iter().filter(|(meaning, _)| *meaning == NoteMeaning::Shower).map(|(_, time)| *time);
        let all = |label: &str, times: Vec<Interval<WallTime>>| {
            times.into_iter().map(|time| Episode::new(label.to_owned(), time)).collect::<Vec<_>>()
        };
        PersonTimeline {
            activities: [
                all(SLEEPING, self.in_bed(until, &is_up)),
                all(EATING_LUNCH, meals),
                all(SHOWERING, showers.collect()),
                all(AWAY, away),
            ]
            .concat(),
            rooms: all("bathroom", self.in_bathroom(until)),
            ..PersonTimeline::default()
        }
    }

    /// The notes cover a day: no long part of it is without any.
    fn covers(&self, day: Interval<WallTime>) -> bool {
        let noted = self.recent.iter().map(|note| note.time).chain(self.away(day.end));
        let longest = |gap: &Interval<WallTime>| if gap.end == day.end { UNNOTED_AT_END } else { UNNOTED };
        without(&[day], &union(noted)).iter().all(|gap| gap.length() <= longest(gap))
    }

    fn value(&self, measure: &DailyMeasure, day: &MeasuredDay, is_covered: bool) -> Option<f64> {
        let meaning = measure.noted?;
        // Before the first note of a kind, its count is not known. Nights have notes of their own.
        let is_known = self.kinds.iter().any(|kind| kind.shows(meaning)) && (is_covered || meaning == NoteMeaning::Bed);
        (measure.of)(day).filter(|_| is_known)
    }
}

impl Measures {
    /// By the notes of a log, for the days that touch `recorded`; `None` if no note has a meaning for any measure.
    pub fn from_notes(name: &str, activities: &[Episode<WallTime>], recorded: Interval<WallTime>) -> Option<Measures> {
        let mut notes: Vec<NotedTime> = activities
            .iter()
            .map(|one| NotedTime { meaning: NoteMeaning::of_label(&one.label), time: one.time })
            .collect();
        notes.sort_by_key(|note| note.time.begin);
        let shows = |meaning| notes.iter().filter_map(|note| note.meaning).any(|one| one.shows(meaning));
        if !MEASURES.iter().filter_map(|measure| measure.noted).any(shows) {
            return None;
        }
        let mut left = notes.into_iter().peekable();
        let mut so_far = NotesSoFar::default();
        let mut begin = WallTime::midnight(recorded.begin.date());
        let mut days = Vec::new();
        while begin < recorded.end {
            let day = Interval::starting(begin, DAY);
            while let Some(note) = left.next_if(|note| note.time.begin < day.end) {
                so_far.take(note);
            }
            so_far.forget(begin - BEFORE);
            let read = Interval::new(recorded.begin.max(begin - BEFORE), recorded.end.min(day.end));
            let timeline = MeasureTimeline::from_truth(&so_far.person(day.end), read);
            let common = DayContext::new(&timeline, None);
            let measured = MeasuredDay::new(&common, timeline.days() - 1, true);
            let is_covered = so_far.covers(day);
            let values = MEASURES.iter().map(|measure| so_far.value(measure, &measured, is_covered)).collect();
            days.push(DayMeasures { date: begin.date(), is_whole: measured.is_known(), values });
            begin = day.end;
        }
        Some(Measures { name: name.to_owned(), measures: MEASURES, days, ..Measures::default() })
    }

    /// Compares measures by sensors with measures by the notes of a log, and takes the values of the notes where they have them.
    pub(super) fn use_notes(&mut self, notes: &[Episode<WallTime>], recorded: Interval<WallTime>) {
        let Some(told) = Measures::from_notes(&self.name, notes, recorded) else { return };
        // A day that is not over can still have notes; its night is over.
        let open = self.days.last().filter(|day| !day.is_whole).map(|day| day.date);
        for (number, measure) in MEASURES.iter().enumerate() {
            let mut both = Vec::new();
            let mut taken = Vec::new();
            for day in &mut self.days {
                let noted = told.days.iter().find(|noted| noted.date == day.date);
                let Some(by_notes) = noted.and_then(|noted| noted.values[number]) else { continue };
                let is_of_night = measure.occasion == "night" || measure.noted == Some(NoteMeaning::Bed);
                let is_over = is_of_night || open != Some(day.date);
                let by_sensors = day.values[number];
                both.extend(by_sensors.map(|by_sensors| NotedDay { date: day.date, by_notes, by_sensors }));
                if is_over {
                    day.values[number] = Some(by_notes);
                    taken.push(day.date);
                }
            }
            self.noted.extend(NoteComparison::over_days(measure, both));
            if !taken.is_empty() {
                self.from_notes.push(NotedMeasure { measure: measure.name, days: taken });
            }
        }
        self.tell_of_notes();
    }

    /// Adds remarks on the values from notes, and drops the guesses that the notes replace.
    fn tell_of_notes(&mut self) {
        let known = |measure: &str| self.days.iter().filter(|day| day.value(measure).is_some()).count();
        let mut all = Vec::new();
        let mut some = Vec::new();
        for NotedMeasure { measure, days } in &self.from_notes {
            match known(measure) - days.len() {
                0 => all.push(*measure),
                _ => some.push(format!("{measure} (on {} of {})", days.len(), counted(known(measure), "day", "days"))),
            }
        }
        self.guesses.retain(|guess| !all.contains(guess));
        let remark = |begins: &str, measures: String| format!("{begins}: {measures}");
        if !all.is_empty() {
            self.remarks.push(remark("Taken from the log's notes, not from its sensors", all.join(", ")));
        }
        if !some.is_empty() {
            self.remarks.push(remark(
                "Taken from the log's notes on the days that they cover, and from the sensors on the others, so that a change of the values may come from the change of the source",
                some.join(", "),
            ));
        }
    }
}

impl NoteComparison {
    /// `None` without days.
    fn over_days(measure: &DailyMeasure, by_day: Vec<NotedDay>) -> Option<NoteComparison> {
        let mean_of = |of: fn(&NotedDay) -> f64| mean(&by_day.iter().map(of).collect::<Vec<f64>>());
        Some(NoteComparison {
            measure: measure.name,
            unit: measure.unit.name,
            days: by_day.len(),
            by_notes: mean_of(|day| day.by_notes)?,
            by_sensors: mean_of(|day| day.by_sensors)?,
            apart: mean_of(|day| (day.by_sensors - day.by_notes).abs())?,
            by_day,
        })
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
            one("Spare_Time/TV", 14.0, 17.0),
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

    /// The notes of a day at home, without its outing.
    fn at_home() -> [Episode<WallTime>; 2] {
        [one("Sleeping", 0.0, 7.0), one("Reading", 13.0, 24.0)]
    }

    fn out(notes: &[Episode<WallTime>]) -> [Option<f64>; 2] {
        let measures = Measures::from_notes("log", &[notes, &at_home()].concat(), RECORDED).unwrap();
        ["time_out", "outings"].map(|name| on_day_1(&measures, name))
    }

    #[test]
    fn outing_lasts_from_leaving_to_coming() {
        let activities = [one("Leave_Home", 9.0, 9.0 + 1.0 / 60.0), one("Enter_Home", 11.0, 11.0)];
        assert_eq!(out(&activities), [Some(2.0), Some(1.0)]);
        // The first time there is no note of coming.
        let twice = [one("Leave_Home", 7.0, 7.0), activities[0].clone(), activities[1].clone()];
        assert_eq!(out(&twice)[0], Some(2.0));
        assert_eq!(out(&[one("Leaving", 9.0, 10.0)])[0], Some(1.0));
    }

    #[test]
    fn a_day_without_notes_for_long_is_left_to_the_sensors() {
        let notes =
            |from: f64, to: f64| [one("Sleeping", -1.0, 7.0), one("breakfast", 8.0, 8.2), one("Reading", from, to)];
        let measured = |from: f64, to: f64| Measures::from_notes("log", &notes(from, to), RECORDED).unwrap();
        let meals = |from: f64, to: f64| on_day_1(&measured(from, to), "meals");
        assert_eq!([meals(20.0, 24.0), meals(20.5, 24.0)], [Some(1.0), None]);
        assert_eq!([meals(14.0, 18.5), meals(14.0, 17.5)], [Some(1.0), None]);
        // Its night has a note.
        assert_eq!(on_day_1(&measured(20.5, 24.0), "rising"), Some(7.0));
    }

    #[test]
    fn a_bite_is_no_meal_and_a_nap_after_breakfast_no_part_of_the_night() {
        let notes = [
            one("Sleep", -1.0, 7.0),
            one("Eat", 7.05, 7.11),
            one("Sleep", 7.8, 8.8),
            one("Work", 9.0, 17.0),
            one("Eat", 15.0, 15.02),
            one("Cook", 18.0, 18.2),
            one("Eat", 18.25, 18.26),
            one("Relax", 19.0, 24.0),
        ];
        let measures = Measures::from_notes("log", &notes, RECORDED).unwrap();
        let values = ["meals", "rising", "time_in_bed"].map(|name| on_day_1(&measures, name).unwrap());
        assert_eq!(values, [2.0, 7.0, 8.0]);
    }

    #[test]
    fn the_values_of_a_day_follow_from_the_notes_until_its_end() {
        let day = |number: i64| {
            let later = |note: Episode<WallTime>| {
                let shift = (number - 1) * DAY;
                Episode::new(note.label, note.time.map(|at| at + shift))
            };
            let mut notes = vec![one("Sleep", -1.0 + (number % 2) as f64, 7.0), one("Lunch", 12.0, 12.5)];
            notes.extend([one("Shower", 8.0, 8.2), one("Work", 13.0, 17.0), one("Toilet", 19.0, 19.1)]);
            match number % 4 {
                0 => notes.extend([one("Leave_Home", 20.0, 20.0), one("Enter_Home", 25.0, 25.0)]),
                1 => notes.extend([one("Leave_Home", 20.0, 20.0)]),
                _ => notes.extend([one("Relax", 20.0, 23.0)]),
            }
            notes.into_iter().map(later).collect::<Vec<_>>()
        };
        let all: Vec<Episode<WallTime>> = (0..12).flat_map(day).collect();
        let until = |days: i64| {
            let recorded = Interval::starting(WallTime::EPOCH, days * DAY);
            let begun = all.iter().filter(|note| note.begin() < recorded.end).cloned();
            let known = begun
                .map(|note| Episode::new(note.label, Interval { end: note.time.end.min(recorded.end), ..note.time }));
            Measures::from_notes("log", &known.collect::<Vec<_>>(), recorded).unwrap().days
        };
        let whole = until(12);
        assert!(whole.iter().filter(|day| day.value("time_out").is_some()).count() > 6, "{whole:?}");
        for days in 1..12 {
            assert_eq!(until(days), whole[..days as usize], "of {days} days");
        }
    }
}
