//! What is done to a home from outside while it is lived: a thing is used that nobody there has touched, a sensor fails,
//! somebody falls.
//!
//! Each has its instant, and happens before all that happens in the home at that instant. A run that is lived again is told all
//! of it beforehand, and lives the same life.

use crate::drivers::Surroundings;
use crate::home::plan::Plan;
use crate::ids::{ResidentId, SensorId, ThingId};
use crate::problem::{Problem, Problems, readable};
use crate::recording::LONGEST;
use crate::run::Run;
use crate::scenario::load::Scenario;
use crate::scenario::nearest::nearest;
use crate::time::{DAY, Micros, SECOND};
use serde::{Deserialize, Serialize};

crate::numbers! {
    /// How long somebody lies on the floor who falls because somebody outside says so and says no time: as long as the falls of
    /// routines usually take (ours). Of those over 90 who fell and were found, 30 in 100 had lain for an hour or more (Fleming and
    /// Brayne 2008).
    pub static LIES_MIN = "outside.lies": 20.0, "min", [0.1, 1440.0];
}

/// So much is done to a run from outside, at most (ours): a recording has all of it, and stays small.
pub const MOST_DEEDS: usize = 10_000;

/// The longest that somebody lies on the floor (ours).
const LONGEST_LIE: Micros = DAY;

/// The least and the most between what a stuck sensor repeats.
const REPEATS: std::ops::RangeInclusive<Micros> = SECOND / 10..=DAY;

/// Something that is done from outside, and when.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FromOutside {
    /// When, in microseconds since the run's start.
    pub at_us: Micros,
    /// What is done.
    pub deed: Deed,
}

/// What is done from outside.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Deed {
    /// A thing is opened, closed, turned on or off.
    Use {
        /// Its name.
        thing: String,
        /// How it is afterwards: open or on, or closed or off.
        on: bool,
    },
    /// A sensor fails.
    Fail {
        /// Its name in the home.
        sensor: String,
        /// How.
        failure: Failure,
        /// Until when; None for the rest of the run.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        until_us: Option<Micros>,
    },
    /// Somebody falls where they are.
    Fall {
        /// Their name.
        resident: String,
        /// How long they lie before they get up.
        lies_us: Micros,
    },
}

/// How a sensor fails, as the faults of a link file have it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Failure {
    /// Its battery fades for so long, and is empty then.
    Battery {
        /// How long; 0 where it is empty at once.
        fades_us: Micros,
    },
    /// It hears nothing, and repeats itself or is silent.
    Stuck {
        /// How often it says again what it said last; None where it is silent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        every_us: Option<Micros>,
    },
    /// It comes off its place, and sees nothing real.
    FallsOff,
    /// So many of a million of its messages are lost on the way.
    BadLink {
        /// How many.
        lost_ppm: u32,
    },
}

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
            None => format!("there are {}", known.map(|known| format!("{known:?}")).collect::<Vec<_>>().join(", ")),
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

impl Deed {
    /// Finds what it names among what there is, and looks at its numbers.
    fn known(&self, at: Micros, plan: &Plan, sensors: &[&str], residents: &[&str]) -> Result<Known, Refusal> {
        match self {
            Deed::Use { thing, on } => {
                let known = plan.things.iter().map(|thing| thing.name.as_str());
                let index = plan.thing(thing).ok_or_else(|| Refusal::unknown("thing", thing, known))?;
                Ok(Known::Use { thing: ThingId::of(index), on: *on })
            }
            Deed::Fail { sensor, failure, until_us } => {
                let index = sensors.iter().position(|known| known == sensor);
                let index = index.ok_or_else(|| Refusal::unknown("sensor", sensor, sensors.iter().copied()))?;
                failure.is_possible()?;
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

    /// What it is, in a word.
    pub fn word(&self) -> &'static str {
        match self {
            Deed::Use { on: true, .. } => "on",
            Deed::Use { on: false, .. } => "off",
            Deed::Fail { failure, .. } => failure.word(),
            Deed::Fall { .. } => "fall",
        }
    }
}

impl Failure {
    /// What it is, in a word, as link files have it.
    pub fn word(self) -> &'static str {
        match self {
            Failure::Battery { .. } => "battery",
            Failure::Stuck { .. } => "stuck",
            Failure::FallsOff => "falls_off",
            Failure::BadLink { .. } => "bad_link",
        }
    }

    fn is_possible(self) -> Result<(), Refusal> {
        let (is_possible, hint) = match self {
            Failure::Battery { fades_us } => {
                ((0..=LONGEST).contains(&fades_us), "a battery fades for a time from 0 on")
            }
            Failure::Stuck { every_us } => {
                (every_us.is_none_or(|every| REPEATS.contains(&every)), "a sensor repeats itself every 0.1 s to a day")
            }
            Failure::FallsOff => (true, ""),
            Failure::BadLink { lost_ppm } => (lost_ppm <= 1_000_000, "no more is lost than all"),
        };
        if is_possible { Ok(()) } else { Err(Refusal::new("no sensor fails like this", hint)) }
    }
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
        let mut wrong = |refusal: Refusal| {
            let what = format!("what is done from outside, number {}: {}", number + 1, refusal.why);
            problems.push(Problem::of_file(file, what, Some(refusal.hint)));
        };
        if !(0..=LONGEST).contains(at_us) {
            wrong(Refusal::new("its instant is in no run", "at_us counts from the run's start, in microseconds"));
        }
        if let Err(refusal) = deed.known(*at_us, plan, &sensors, &residents) {
            wrong(refusal);
        }
    }
    Problems::truncated(&problems)
}

impl Run {
    /// Whether this can be done from outside now.
    ///
    /// # Errors
    ///
    /// Why not: the home has no such thing, sensor or resident; it is so already; nobody can fall who is out or whose driver knows
    /// no falls.
    pub fn can_be_done(&self, deed: &Deed) -> Result<(), Refusal> {
        match self.known(self.now(), deed)? {
            Known::Use { thing, on } if self.will_be_on(thing) == on => {
                let what = if on { "open, or on," } else { "closed, or off," };
                Err(Refusal::new(format!("it is {what} already"), "nothing is to be done"))
            }
            Known::Fall { resident, lies } => self.can_fall(resident, lies),
            _ => Ok(()),
        }
    }

    pub(crate) fn known(&self, at: Micros, deed: &Deed) -> Result<Known, Refusal> {
        let sensors: Vec<&str> = self.sensors().iter().map(|sensor| sensor.name.as_str()).collect();
        let names = self.names();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        deed.known(at, &self.home().plan, &sensors, &names)
    }

    fn can_fall(&self, resident: ResidentId, lies: Micros) -> Result<(), Refusal> {
        let around: Surroundings = self.surroundings(resident);
        if around.body().is_none() {
            return Err(Refusal::new("they are not at home", "wait until they have come back"));
        }
        // Whether a driver can is known once it has.
        match self.driver(resident).is_some_and(|driver| driver.copy().falls(&around, lies)) {
            true => Ok(()),
            false => Err(Refusal::new("they cannot fall", "only who lives by a routine falls")),
        }
    }
}
