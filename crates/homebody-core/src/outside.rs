//! What is done to a home from outside while it is lived: a thing is used that nobody there has touched, a sensor fails,
//! somebody falls.
//!
//! Each has its instant, and happens before all that happens in the home at that instant. A run that is lived again is told all
//! of it beforehand, and lives the same life.

use crate::deed::{Deed, Failure, FromOutside};
use crate::home::plan::Plan;
use crate::ids::{ResidentId, SensorId, ThingId};
use crate::numbers::Numbers;
use crate::problem::{MOST_PER_FILE, Problem, Problems, readable};
use crate::scenario::load::Scenario;
use crate::scenario::nearest::nearest;
use crate::time::{DAY, LONGEST, Micros, SECOND, micros};

crate::numbers! {
    /// Time on the floor after a fall that a command from outside causes without a duration, as long as a routine's
    /// usual falls. Of those over 90 who fell and were found, 30 in 100 had lain for an hour or more (Fleming and
    /// Brayne 2008).
    static LIES_MIN = "outside.lies": 20.0, "min", [0.1, 1440.0];
}

/// How long somebody lies who falls and of whom nobody says how long.
pub fn usual_lie(numbers: &Numbers) -> Micros {
    micros(numbers.of(&LIES_MIN) * 60.0)
}

/// Largest number of commands from outside in a run (our choice): a recording has all of them, and stays small.
pub const MOST_DEEDS: usize = 10_000;

/// Longest time that a person lies on the floor (our choice).
const LONGEST_LIE: Micros = DAY;

/// The least and the most between what a stuck sensor repeats.
const REPEATS: std::ops::RangeInclusive<Micros> = SECOND / 10..=DAY;

/// Largest number of names in the hint for an unknown name (our choice).
const SHOWN: usize = 12;

/// Why something cannot be done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// Why, in words for people.
    pub why: String,
    /// What to do instead.
    pub hint: String,
}

impl Refusal {
    /// For this reason.
    pub fn new(why: impl Into<String>, hint: impl Into<String>) -> Refusal {
        Refusal { why: readable(why.into()), hint: readable(hint.into()) }
    }

    fn unknown<'n>(what: &str, name: &str, known: impl Iterator<Item = &'n str> + Clone) -> Refusal {
        let hint = match nearest(name, known.clone()) {
            Some(near) => format!("did you mean {near:?}?"),
            None => {
                let some: Vec<String> = known.take(SHOWN).map(|known| format!("{known:?}")).collect();
                format!("there are such as {}", some.join(", "))
            }
        };
        Refusal::new(format!("there is no {what} {name:?}"), hint)
    }
}

/// A deed with what it names found.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Known {
    Use { thing: ThingId, on: bool },
    Fail { sensor: SensorId, failure: Failure, until: Option<Micros> },
    Fall { resident: ResidentId, lies: Micros },
}

impl Known {
    /// Finds what a deed names among what there is, and looks at its numbers.
    pub fn of(deed: &Deed, at: Micros, plan: &Plan, sensors: &[&str], residents: &[&str]) -> Result<Known, Refusal> {
        match deed {
            Deed::Use { thing, on } => {
                let known = plan.things.iter().map(|thing| thing.name.as_str());
                let index = plan.thing(thing).ok_or_else(|| Refusal::unknown("thing", thing, known))?;
                Ok(Known::Use { thing: ThingId::of(index), on: *on })
            }
            Deed::Fail { sensor, failure, until_us } => {
                let index = sensors.iter().position(|known| known == sensor);
                let index = index.ok_or_else(|| Refusal::unknown("sensor", sensor, sensors.iter().copied()))?;
                possible(*failure)?;
                if until_us.is_some_and(|until| until <= at || until > 2 * LONGEST) {
                    return Err(Refusal::new("a fault ends after it begins", "say a time above 0, or none"));
                }
                Ok(Known::Fail { sensor: SensorId::of(index), failure: *failure, until: *until_us })
            }
            Deed::Fall { resident, lies_us } => {
                let index = residents.iter().position(|known| known == resident);
                let index = index.ok_or_else(|| Refusal::unknown("resident", resident, residents.iter().copied()))?;
                if !(SECOND..=LONGEST_LIE).contains(lies_us) {
                    return Err(Refusal::new("nobody lies there so long", "say from a second to a day"));
                }
                Ok(Known::Fall { resident: ResidentId::of(index), lies: *lies_us })
            }
        }
    }
}

fn possible(failure: Failure) -> Result<(), Refusal> {
    let (is_possible, hint) = match failure {
        Failure::Battery { fades_us } => ((0..=LONGEST).contains(&fades_us), "a battery fades for a time from 0 on"),
        Failure::Stuck { every_us } => {
            (every_us.is_none_or(|every| REPEATS.contains(&every)), "a sensor repeats itself every 0.1 s to a day")
        }
        Failure::FallsOff => (true, ""),
        Failure::BadLink { lost_ppm } => (lost_ppm <= 1_000_000, "no more is lost than all"),
    };
    if is_possible { Ok(()) } else { Err(Refusal::new("no sensor fails like this", hint)) }
}

/// What is wrong with what a recording says was done from outside to a run of this scenario; `file` is what the recording is
/// called.
pub fn check(done: &[FromOutside], scenario: &Scenario, residents: &[String], file: &str) -> Problems {
    let sensors: Vec<&str> = scenario.home.sensors.iter().map(|sensor| sensor.name()).collect();
    let residents: Vec<&str> = residents.iter().map(String::as_str).collect();
    let plan = scenario.home.plan();
    let mut problems = Vec::new();
    if done.len() > MOST_DEEDS {
        problems.push(Problem::of_file(file, format!("more than {MOST_DEEDS} things are done from outside"), None));
    }
    for (number, FromOutside { at_us, deed }) in done.iter().take(MOST_DEEDS).enumerate() {
        // One that is wrong throughout costs no more than anybody reads.
        if problems.len() > MOST_PER_FILE {
            break;
        }
        let mut wrong = |refusal: Refusal| {
            let what = format!("what is done from outside, number {}: {}", number + 1, refusal.why);
            problems.push(Problem::of_file(file, what, Some(refusal.hint)));
        };
        if !(0..=LONGEST).contains(at_us) {
            wrong(Refusal::new("its instant is in no run", "at_us counts from the run's start, in microseconds"));
        }
        if let Err(refusal) = Known::of(deed, *at_us, plan, &sensors, &residents) {
            wrong(refusal);
        }
    }
    Problems::truncated(&problems)
}
