//! Interventions from outside during a run: a thing is used that no resident has touched, a sensor fails, a resident
//! falls.
//!
//! Each has its instant, and comes before all other events of that instant. A replay gets all of them beforehand, and
//! is the same run.

use crate::ids::{ResidentId, SensorId, ThingId};
use crate::intervention::{Intervention, SensorFailure, TimedIntervention};
use crate::nearest::{nearest, some_names, suggestion};
use crate::numbers::Numbers;
use crate::plan::Plan;
use crate::problem::{Diagnose, MOST_PER_FILE, Problem, readable};
use crate::problems::Problems;
use crate::scenario::load::Scenario;
use crate::time::{DAY, LONGEST, RunTime, SECOND, Span};

crate::numbers! {
    /// Time on the floor after a fall that a command from outside causes without a duration, as long as a routine's
    /// usual falls. Of those over 90 who fell and were found, 30 in 100 had lain for an hour or more (Fleming and
    /// Brayne 2008).
    static LIES_MIN = "outside.lies": 20.0, "min", [0.1, 1440.0];
}

/// The time on the floor of a fall without a stated duration.
pub fn usual_time_on_floor(numbers: &Numbers) -> Span {
    Span::from_seconds(numbers.of(&LIES_MIN) * 60.0)
}

/// Largest number of commands from outside in a run (our choice): a recording has all of them, and stays small.
pub const MOST_INTERVENTIONS: usize = 10_000;

/// Longest time that a person lies on the floor (our choice).
const LONGEST_LIE: Span = DAY;

/// The shortest and the longest interval of repetitions of a stuck sensor.
const REPEATS: std::ops::RangeInclusive<Span> = Span::from_millis(100)..=DAY;

crate::messages! {
    /// Problems with actions from outside the home: a thing is used, a sensor fails, a resident falls.
    pub enum OutsideMessage in "outside" {
        /// The home has no thing, sensor or resident with this name. Upper and lower case count.
        Unknown {
            /// The kind: `thing`, `sensor` or `resident`.
            kind: &'static str,
            name: String,
            nearest: Option<String>,
            known: Vec<String>,
        } error "unknown-name" ("there is no {kind} {name:?}")
            advice (suggestion(nearest, known));
        /// The time of an action in a recording is in microseconds since the start of the run.
        NotInRun { at_us: RunTime } error "not-in-run" ("the time of the action, {at_us} µs, is outside the run")
            hint ("give at_us in microseconds since the start of the run");
        /// A fault of a sensor has an end after its begin, or lasts until the end of the run.
        EndsTooSoon error "fault-ends-too-soon" ("a fault must end after it begins")
            hint ("give a duration above 0, or no duration");
        /// A resident lies on the floor for a second at least and for a day at most.
        LyingTime { lies_us: Span } error "lying-time" ("a resident cannot lie on the floor for {lies_us} µs")
            hint ("give a time from 1000000 µs (a second) to 86400000000 µs (a day)");
        /// The battery of a sensor fades for a time, and is empty then. With 0 it is empty at once.
        BatteryFading { fades_us: Span } error "battery-fading" ("a battery cannot fade for {fades_us} µs")
            hint ("give a time from 0 to {LONGEST} µs, the longest run");
        /// A stuck sensor repeats its last message at intervals, or is silent.
        RepeatInterval { every_us: Span }
            error "repeat-interval" ("a stuck sensor cannot repeat its message every {every_us} µs")
            hint ("give an interval from 0.1 s to a day, or no interval for a silent sensor");
        /// A bad link loses a share of all messages, in millionths.
        LostShare { lost_ppm: u32 } error "lost-share" ("a link cannot lose {lost_ppm} of 1000000 messages")
            hint ("give a number from 0 to 1000000");
        /// A recording holds a limited number of actions from outside, and each costs time in a replay.
        TooMany { most: usize } error "too-many-actions" ("the recording has more than {most} actions from outside");
        /// The thing is already in the state that the action asks for.
        AlreadySo { state: &'static str } error "already-so" ("the thing is already {state}")
            hint ("leave the action out");
        /// A resident falls where they are, so they have to be at home.
        NotAtHome error "not-at-home" ("the resident is not at home")
            hint ("wait until the resident comes back");
        /// The driver of the resident decides what happens after a fall. Only drivers of routines know falls.
        CannotFall error "cannot-fall" ("this resident cannot fall: only residents with a routine can")
            hint ("choose a resident with a routine");
    }
}

impl OutsideMessage {
    fn unknown<'n>(kind: &'static str, name: &str, known: impl Iterator<Item = &'n str> + Clone) -> OutsideMessage {
        let nearest = nearest(name, known.clone()).map(str::to_owned);
        OutsideMessage::Unknown { kind, name: name.to_owned(), nearest, known: some_names(known) }
    }
}

/// Why something cannot be done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The code of the message, such as `outside::not-at-home`; empty for a reason without one.
    pub code: &'static str,
    /// Why, in words for people.
    pub why: String,
    /// The advice.
    pub hint: String,
}

impl Refusal {
    /// For this reason.
    pub fn new(why: impl Into<String>, hint: impl Into<String>) -> Refusal {
        Refusal { code: "", why: readable(why.into()), hint: readable(hint.into()) }
    }
}

impl From<OutsideMessage> for Refusal {
    fn from(message: OutsideMessage) -> Refusal {
        let problem = message.diagnostic();
        Refusal { code: problem.code, ..Refusal::new(problem.what, problem.hint.unwrap_or_default()) }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ResolvedIntervention {
    Use { thing: ThingId, on: bool },
    Fail { sensor: SensorId, failure: SensorFailure, until: Option<RunTime> },
    Fall { resident: ResidentId, lies: Span },
}

impl ResolvedIntervention {
    /// Resolves the names of an intervention, and checks its numbers.
    pub fn new(
        intervention: &Intervention,
        at: RunTime,
        plan: &Plan,
        sensors: &[&str],
        residents: &[&str],
    ) -> Result<ResolvedIntervention, OutsideMessage> {
        match intervention {
            Intervention::Use { thing, on } => {
                let known = plan.things.iter().map(|thing| thing.name.as_str());
                let index = plan.thing(thing).ok_or_else(|| OutsideMessage::unknown("thing", thing, known))?;
                Ok(ResolvedIntervention::Use { thing: ThingId::new(index), on: *on })
            }
            Intervention::Fail { sensor, failure, until_us } => {
                let index = sensors.iter().position(|known| known == sensor);
                let index = index.ok_or_else(|| OutsideMessage::unknown("sensor", sensor, sensors.iter().copied()))?;
                possible(*failure)?;
                if until_us.is_some_and(|until| until <= at || until.since_zero() > 2 * LONGEST) {
                    return Err(OutsideMessage::EndsTooSoon);
                }
                Ok(ResolvedIntervention::Fail { sensor: SensorId::new(index), failure: *failure, until: *until_us })
            }
            Intervention::Fall { resident, lies_us } => {
                let index = residents.iter().position(|known| known == resident);
                let names = residents.iter().copied();
                let index = index.ok_or_else(|| OutsideMessage::unknown("resident", resident, names))?;
                if !(SECOND..=LONGEST_LIE).contains(lies_us) {
                    return Err(OutsideMessage::LyingTime { lies_us: *lies_us });
                }
                Ok(ResolvedIntervention::Fall { resident: ResidentId::new(index), lies: *lies_us })
            }
        }
    }
}

fn possible(failure: SensorFailure) -> Result<(), OutsideMessage> {
    match failure {
        SensorFailure::Battery { fades_us } if !(Span::ZERO..=LONGEST).contains(&fades_us) => {
            Err(OutsideMessage::BatteryFading { fades_us })
        }
        SensorFailure::Stuck { every_us: Some(every_us) } if !REPEATS.contains(&every_us) => {
            Err(OutsideMessage::RepeatInterval { every_us })
        }
        SensorFailure::BadLink { lost_ppm } if lost_ppm > 1_000_000 => Err(OutsideMessage::LostShare { lost_ppm }),
        _ => Ok(()),
    }
}

/// The problems of the actions from outside in the recording of a run of this scenario; `file` is the name of the recording.
pub fn check(done: &[TimedIntervention], scenario: &Scenario, residents: &[String], file: &str) -> Problems {
    let sensors: Vec<&str> = scenario.home.sensors.iter().map(|sensor| sensor.name()).collect();
    let residents: Vec<&str> = residents.iter().map(String::as_str).collect();
    let plan = scenario.home.plan();
    let mut problems = Vec::new();
    if done.len() > MOST_INTERVENTIONS {
        problems.push(Problem::of_file(file, OutsideMessage::TooMany { most: MOST_INTERVENTIONS }, None));
    }
    for (number, TimedIntervention { at_us, intervention }) in done.iter().take(MOST_INTERVENTIONS).enumerate() {
        // A recording with very many problems costs no more than those that are shown.
        if problems.len() > MOST_PER_FILE {
            break;
        }
        let mut wrong = |message: OutsideMessage| {
            let problem = message.diagnostic();
            let what = format!("action {} from outside: {}", number + 1, problem.what);
            problems.push(Problem::of_file(file, Problem { what, ..problem }, None));
        };
        if !(Span::ZERO..=LONGEST).contains(&at_us.since_zero()) {
            wrong(OutsideMessage::NotInRun { at_us: *at_us });
        }
        if let Err(message) = ResolvedIntervention::new(intervention, *at_us, plan, &sensors, &residents) {
            wrong(message);
        }
    }
    Problems::truncated(&problems)
}
