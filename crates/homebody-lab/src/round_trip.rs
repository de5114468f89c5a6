//! Round trips: a routine is simulated, its log is summarised, and each sentence of the summary is compared with the routine.
//!
//! The sentences of routines are random: times of getting up and going to bed, bathroom visits at night, showers, meals, outings, and a
//! change after four weeks. A routine gives a distribution for each day, from the fuzzy numbers and chances of its sentences. The truth of
//! a summary's sentence by the routine is the share of days that it describes. A sentence with "every" is compared as "nearly all",
//! because a routine promises no single day.
//!
//! Sentences about measures that no routine determines, such as sleep and sitting, are not checkable.

use crate::locating::SimulatedHome;
use homebody_analysis::measures::Measures;
use homebody_analysis::summaries::{SummarySentence, SummarySubject, TRUE_ENOUGH, summarise, truth};
use homebody_core::fuzzy::{Fuzzy, Quantifier};
use homebody_core::random::Stream;
use homebody_placement::simulated::{SimulatedLog, SimulatedLogError};
use homebody_routine::behaviour::resident_routine::{InForce, ResidentRoutine};
use homebody_routine::routine::{Activity, Habit, HabitTime, Meal};
use serde::Serialize;
use std::fmt::Write;

/// Days to simulate. The last ones are summarised; changes start with the first of these.
pub const DAYS: u32 = 56;
const LAST: usize = 28;
/// Number of draws of a routine's statement about a day (our choice).
const DRAWS: usize = 50;
const HOUR: f64 = 3600.0;
/// Hours out of bed for a visit to the bathroom (our choice): the median of the activity.
const VISIT_H: f64 = 0.1;

#[derive(Clone, Debug, Serialize)]
pub struct CheckedSentence {
    pub sentence: String,
    pub measure: &'static str,
    /// Truth by the log.
    pub truth: f64,
    /// Truth by the routine; `None` if the routine does not determine it.
    pub by_routine: Option<f64>,
    /// Truth by the activities of the resident.
    pub by_life: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

impl CheckedSentence {
    pub fn agrees(&self) -> Option<bool> {
        self.by_routine.map(|truth| truth >= TRUE_ENOUGH)
    }

    pub fn is_lived(&self) -> bool {
        self.by_life >= TRUE_ENOUGH
    }
}

pub fn drawn_routine(name: &str, seed: u64) -> String {
    let mut stream = Stream::named(seed, "round-trip/routine");
    let mut drawn = |count: usize| (stream.unit() * count as f64) as usize;
    let clock = |quarters: usize| format!("{:02}:{:02}", quarters / 4 % 24, quarters % 4 * 15);
    let mut text = format!("{name} is 80.\n\n");
    let mut say = |sentence: String| {
        let _ = writeln!(text, "{sentence}");
    };
    let spread = ["15", "30", "45"];
    let (up, bed) = (6 * 4 + drawn(12), 21 * 4 + 2 + drawn(10));
    say(format!("She gets up at about {}, give or take {} minutes.", clock(up), spread[drawn(3)]));
    let change = drawn(3);
    let about = |quarters: usize, spread: &str| {
        format!("goes to bed at about {}, give or take {spread} minutes", clock(quarters))
    };
    let give = spread[drawn(3)];
    if change == 0 {
        say(format!("Until day {}, she {}.", DAYS as usize - LAST, about(bed, give)));
        say(format!("From day {}, she {}.", DAYS as usize - LAST + 1, about(bed + 6, give)));
    } else {
        say(format!("She {}.", about(bed, give)));
    }
    let often = ["once", "twice", "three times"];
    let times = drawn(2);
    if change == 1 {
        say(format!("Until day {}, every night she goes to the bathroom {}.", DAYS as usize - LAST, often[times]));
        say(format!(
            "From day {}, every night she goes to the bathroom {}.",
            DAYS as usize - LAST + 1,
            ["three times", "four times"][times]
        ));
    } else {
        let how = ["Every night", "Most nights"][drawn(2)];
        say(format!("{how} she goes to the bathroom {}.", often[drawn(3)]));
    }
    say([
        "Every day she takes a shower in the morning.",
        "Most days she takes a shower in the morning.",
        "On Monday, Wednesday and Saturday she takes a shower in the morning.",
    ][drawn(3)]
    .into());
    if drawn(3) == 0 {
        say("She almost never eats lunch.".into());
    }
    let hours = ["1 hour", "2 hours", "3 hours"][drawn(3)];
    say(match drawn(3) {
        0 => format!("Every day she leaves the apartment at about 14:00 for {hours}."),
        1 => format!("On Tuesday and Friday she leaves the apartment at about 10:00 for {hours}."),
        _ => format!("Most days she leaves the apartment at about 15:00 for {hours}."),
    });
    text
}

/// Simulates a home, summarises its log, and compares each sentence with the routine of its first resident.
pub fn round_trip(
    home: &SimulatedHome,
    life: &ResidentRoutine,
    seed: u64,
) -> Result<Vec<CheckedSentence>, SimulatedLogError> {
    let log = SimulatedLog::simulate(home.scenario, home.drivers, seed, DAYS)?;
    let (heard, lived) = (log.measures()?, log.true_measures());
    let summary = summarise(&heard, SummarySubject { subject: "the resident", last: LAST });
    let said = RoutineClaims { life };
    Ok(summary.sentences.iter().map(|sentence| check_sentence(sentence, &said, &heard, &lived)).collect())
}

fn check_sentence(
    sentence: &SummarySentence,
    said: &RoutineClaims,
    heard: &Measures,
    lived: &Measures,
) -> CheckedSentence {
    let quantifier = match sentence.quantifier {
        Quantifier::Every => Quantifier::AlmostAlways,
        other => other,
    };
    let values: Option<Vec<f64>> = (DAYS as usize - LAST..DAYS as usize)
        .map(|day| said.values(sentence.measure, day as i32))
        .collect::<Option<Vec<_>>>()
        .map(|days| days.concat());
    let mean_said = values.as_ref().map(|values| values.iter().sum::<f64>() / values.len().max(1) as f64);
    let by_routine = values.map(|values| truth(quantifier, sentence.set, values.into_iter()).1);
    let lived_values = lived.days[DAYS as usize - LAST..].iter().filter_map(|day| day.value(sentence.measure));
    // The truth by the log may refer to earlier days; the truth by the activities does not.
    let by_life = truth(quantifier, sentence.set, lived_values).1;
    let differs = by_routine.filter(|truth| *truth < TRUE_ENOUGH).zip(mean_said);
    let why = differs.map(|(_, said)| why(sentence, by_life, heard, lived, said));
    CheckedSentence {
        sentence: sentence.expert.clone(),
        measure: sentence.measure,
        truth: sentence.truth,
        by_routine,
        by_life,
        why,
    }
}

fn why(sentence: &SummarySentence, by_life: f64, heard: &Measures, lived: &Measures, said: f64) -> String {
    let mean = |of: &Measures| {
        let values: Vec<f64> =
            of.days[DAYS as usize - LAST..].iter().filter_map(|day| day.value(sentence.measure)).collect();
        values.iter().sum::<f64>() / values.len().max(1) as f64
    };
    let (heard, lived) = (mean(heard), mean(lived));
    if by_life < TRUE_ENOUGH {
        format!(
            "the log does not tell it rightly: {heard:.2} by the log, {lived:.2} by what was done, {said:.2} by the routine"
        )
    } else {
        format!("it was lived otherwise than the routine says: {lived:.2}, and {said:.2} by the routine")
    }
}

struct RoutineClaims<'a> {
    life: &'a ResidentRoutine,
}

impl RoutineClaims<'_> {
    /// Random values of a measure on a day; `None` if the routine does not determine it.
    fn values(&self, measure: &str, day: i32) -> Option<Vec<f64>> {
        let mut stream = Stream::named(0, &format!("round-trip/{measure}/{day}"));
        let mut draws = || -> Option<f64> {
            match measure {
                "rising" => self.clock(&Activity::GetUp, day, &mut stream),
                "bedtime" => self.bedtime(day, &mut stream),
                "time_in_bed" => {
                    let lain =
                        24.0 + self.clock(&Activity::GetUp, day, &mut stream)? - self.bedtime(day, &mut stream)?;
                    let is_visit = |habit: &Habit| habit.is_how_often(&Activity::UseBathroom, true);
                    // The last visit comes before going to bed.
                    Some(lain - (1.0 + self.times(day, &mut stream, is_visit)?) * VISIT_H)
                }
                "bathroom_night" => {
                    self.times(day, &mut stream, |habit| habit.is_how_often(&Activity::UseBathroom, true))
                }
                "showers" => self.times(day, &mut stream, |habit| habit.activity == Activity::Shower),
                "meals" => {
                    let meals = [Meal::Breakfast, Meal::Lunch, Meal::Dinner];
                    meals
                        .iter()
                        .map(|meal| self.times(day, &mut stream, |habit| habit.activity == Activity::Eat(*meal)))
                        .sum()
                }
                "outings" => self.times(day, &mut stream, |habit| habit.activity == Activity::Leave),
                "time_out" => self.hours_out(day, &mut stream),
                _ => None,
            }
        };
        (0..DRAWS).map(|_| draws()).collect()
    }

    /// The habits that hold on a day: those of the routine, or the defaults where it has none.
    fn habits(&self, day: i32, is_it: impl Fn(&Habit) -> bool) -> Vec<InForce<'_, Habit>> {
        let holds = |habit: &InForce<Habit>| {
            habit.said.visitor.is_none()
                && is_it(habit.said)
                && self.life.is_meant(habit.said, day)
                && (habit.source != ResidentRoutine::UNSAID || !self.life.says(habit.said, day))
        };
        self.life.habits(day).filter(holds).collect()
    }

    fn clock(&self, activity: &Activity, day: i32, stream: &mut Stream) -> Option<f64> {
        let habits = self.habits(day, |habit| habit.activity == *activity);
        let at = habits.iter().find_map(|habit| match &habit.said.when.time {
            HabitTime::At(time) => Some(time),
            _ => None,
        });
        at.map(|time| time.draw(stream) / HOUR)
    }

    /// The bedtime of the evening before, which lasts to noon of the next day.
    fn bedtime(&self, day: i32, stream: &mut Stream) -> Option<f64> {
        let hour = self.clock(&Activity::GoToBed, day - 1, stream)?;
        Some(if hour < 12.0 { hour + 24.0 } else { hour })
    }

    fn times(&self, day: i32, stream: &mut Stream, is_it: impl Fn(&Habit) -> bool) -> Option<f64> {
        let habits = self.habits(day, is_it);
        let times = habits.iter().map(|habit| {
            let (least, most) = habit.said.when.times;
            let times = f64::from(least) + (f64::from(most - least + 1) * stream.unit()).floor();
            let holds = stream.unit() < self.life.chance(habit.said, habit.strength, day);
            if holds { times } else { 0.0 }
        });
        Some(times.sum())
    }

    fn hours_out(&self, day: i32, stream: &mut Stream) -> Option<f64> {
        let habits = self.habits(day, |habit| habit.activity == Activity::Leave);
        let mut sum = 0.0;
        for habit in habits {
            let lasts: Fuzzy = habit.said.when.lasts?;
            let hours = lasts.draw(stream) / HOUR;
            let holds = stream.unit() < self.life.chance(habit.said, habit.strength, day);
            sum += if holds { hours } else { 0.0 };
        }
        Some(sum)
    }
}
