//! The meaning of a routine: the output of the language, and the input of the driver.
//!
//! It holds only what the text states; defaults, such as the length of a breakfast, come later.

pub use activity::{Activity, Meal};
pub use days::{DayEpisode, DayKind, DaySelection, PartOfDay, Phase, PhaseDay, Weather};
pub use falling::{FallEnds, Falling, FallsFrom, USUAL_SHARE};
use homebody_core::fuzzy::{Fuzzy, Quantifier};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

mod activity;
mod days;
mod falling;

/// A routine file, or a condition file, which names no person.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Routine {
    pub file: String,
    /// `None` in a condition.
    pub person: Option<RoutinePerson>,
    /// In the order of the file.
    pub habits: Vec<Habit>,
    pub rules: Vec<RoutineRule>,
    pub changes: Vec<RoutineChange>,
    /// Facts without effect on behaviour, which `explain` lists.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<Quote>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RoutinePerson {
    /// The first sentence about the person.
    #[serde(skip)]
    pub said: Quote,
    /// The name of the resident.
    pub name: String,
    #[serde(rename = "species")]
    pub kind: ResidentKind,
    /// Age in years.
    pub age_years: Option<f64>,
    /// Usual walking speed in metres a second.
    pub pace_mps: Option<Fuzzy>,
    /// Rests on the way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rests: Option<WalkRests>,
    /// The sentences with kind, age, pace and rests.
    #[serde(skip)]
    pub kind_said: Option<Quote>,
    #[serde(skip)]
    pub age_said: Option<Quote>,
    #[serde(skip)]
    pub pace_said: Option<Quote>,
    #[serde(skip)]
    pub rests_said: Option<Quote>,
}

/// Rests of a person who cannot walk far at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WalkRests {
    /// The longest stretch without a rest, in metres.
    pub after_m: f64,
    /// Length of a rest in seconds.
    #[serde(rename = "lasts_s")]
    pub lasts: Fuzzy,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ResidentKind {
    #[default]
    Person,
    Cat,
    Dog,
}

/// The sentence that something was read from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Quote {
    /// Counted from 1.
    pub line: u32,
    /// Counted from 1, in characters.
    pub column: u32,
    pub text: String,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Habit {
    #[serde(skip)]
    pub said: Quote,
    /// The person who comes, such as `daughter` or `nurse`; left out for the resident.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub visitor: Option<String>,
    pub activity: Activity,
    /// The name of a place, a piece of furniture or a room, if stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<String>,
    #[serde(default)]
    pub when: When,
    /// Of an outing: whether it is to a place where people eat, such as a lunch club. It replaces a meal at its time.
    #[serde(default, skip_serializing_if = "is_usual")]
    pub eats_out: bool,
    /// A thing that is on meanwhile, such as the television.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thing_on: Option<String>,
    /// Whether the visitor lets themselves in and out.
    #[serde(default, skip_serializing_if = "is_usual")]
    pub key: bool,
    /// Activities that the visitor does for the person, or helps with.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub does: Vec<Activity>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub falling: Option<Falling>,
}

/// The days, the times of day, the length and the frequency of what a statement says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct When {
    #[serde(skip_serializing_if = "is_usual")]
    pub phase: Phase,
    #[serde(skip_serializing_if = "is_usual")]
    pub days: DaySelection,
    #[serde(skip_serializing_if = "is_usual")]
    pub chance: HabitChance,
    #[serde(skip_serializing_if = "is_usual")]
    pub time: HabitTime,
    /// Duration in seconds, if stated.
    #[serde(rename = "lasts_s", skip_serializing_if = "Option::is_none")]
    pub lasts: Option<Fuzzy>,
    /// End in seconds since midnight, if stated.
    #[serde(rename = "until_s", skip_serializing_if = "Option::is_none")]
    pub until: Option<Fuzzy>,
    /// Number of nights from its start to its end: of a visitor who stays, or away.
    #[serde(skip_serializing_if = "is_usual")]
    pub nights: u32,
    /// The least and the most repetitions in each span that `time` names.
    #[serde(skip_serializing_if = "is_once")]
    pub times: (u32, u32),
    /// Whether `times` are all repetitions of the activity in that span: those with a time of their own, which other
    /// habits state, count as some of them. Otherwise they are additional.
    #[serde(skip_serializing_if = "is_usual")]
    pub is_total: bool,
}

fn is_usual<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

fn is_once(times: &(u32, u32)) -> bool {
    *times == (1, 1)
}

impl Default for When {
    /// Once on each day, at any time.
    fn default() -> When {
        When {
            phase: Phase::default(),
            days: DaySelection::default(),
            chance: HabitChance::default(),
            time: HabitTime::default(),
            lasts: None,
            until: None,
            nights: 0,
            times: (1, 1),
            is_total: false,
        }
    }
}

impl When {
    /// The part of the day, if it is all that is stated about the time of day.
    pub fn part(&self) -> Option<PartOfDay> {
        match self.time {
            HabitTime::Within(part) => Some(part),
            _ => None,
        }
    }
}

/// The probability of a habit on each day, night or occasion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HabitChance {
    /// The quantifier of the sentence, if any.
    #[serde(skip)]
    pub quantifier: Option<Quantifier>,
    #[schemars(range(min = 0.0, max = 1.0))]
    pub probability: f64,
    /// A later probability, and its day: "rarely at first, often by day 160".
    #[serde(skip_serializing_if = "Option::is_none")]
    pub becomes: Option<(f64, PhaseDay)>,
    /// Exactly this number of days of each week, whatever the probability.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub days_a_week: Option<u8>,
}

/// The time of a habit. Times of day are seconds since local midnight; above 86,400 is after midnight.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HabitTime {
    #[default]
    AnyTime,
    At(Fuzzy),
    /// At some time of the part.
    Within(PartOfDay),
    /// Seconds after the end of an activity; at once if `None`.
    After(Activity, Option<Fuzzy>),
    Before(Activity, Option<Fuzzy>),
    /// At the beginning of an activity.
    With(Activity),
    /// After the previous habit in the file, and only if that is done.
    Then,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoutineRule {
    #[serde(skip)]
    pub said: Quote,
    pub whenever: RuleTrigger,
    /// Seconds that the trigger must last.
    #[serde(rename = "lasts_s", default = "at_once")]
    pub lasts: Fuzzy,
    /// Further conditions when it is due.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub only_if: Vec<Circumstance>,
    /// The days and the probability; the trigger gives the time.
    #[serde(default)]
    pub when: When,
    pub response: Response,
    /// Responses after the first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub then: Vec<Response>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lapse: Option<Lapse>,
}

fn at_once() -> Fuzzy {
    Fuzzy::exactly(0.0)
}

impl RoutineRule {
    pub fn answers(&self) -> impl Iterator<Item = &Response> {
        std::iter::once(&self.response).chain(&self.then)
    }
}

/// A state that has to hold, or must not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Circumstance {
    pub holds: bool,
    pub state: RuleTrigger,
}

/// The probability of forgetting the response, and the delay in seconds until it is remembered; never if `None`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Lapse {
    #[schemars(range(min = 0.0, max = 1.0))]
    pub probability: f64,
    pub later: Option<Fuzzy>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RuleTrigger {
    /// A thing is on or open.
    On(String),
    /// The person is at a place, a piece of furniture or in a room.
    At(String),
    Away,
    InBed,
    /// Anyone has turned a thing on, such as a doorbell.
    Rings(String),
    /// Outdoors; in a room, its lamp is off as well.
    Dark(Option<String>),
    /// Another person is at home: anyone, or a visitor by name.
    Company(Option<String>),
    Alone,
    Sitting,
    Doing(Activity),
    Done(Activity),
    /// In seconds since midnight.
    Between(f64, f64),
    /// The previous rule in the text has been answered.
    Follows,
    /// The person wakes at night, whatever for.
    Wakes,
}

impl RuleTrigger {
    /// Whether it must be polled, because others or the light decide it.
    pub fn is_polled(&self) -> bool {
        matches!(
            self,
            RuleTrigger::Rings(_)
                | RuleTrigger::Dark(_)
                | RuleTrigger::Company(_)
                | RuleTrigger::Alone
                | RuleTrigger::Sitting
                | RuleTrigger::Between(..)
        )
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Response {
    /// On or open if true; off or closed if false.
    Turn { thing: String, on: bool },
    /// At a place and for seconds, if stated.
    Do { activity: Activity, place: Option<String>, lasts: Option<Fuzzy> },
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoutineChange {
    #[serde(skip)]
    pub said: Quote,
    /// The time is a part of the day or none, or that of a thing; the chance is that of each day or occasion.
    #[serde(default)]
    pub when: When,
    pub effect: Effect,
}

/// The effect of a change at full strength. A factor of 1 has no effect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// The changes of a condition file; 1 is a moderate severity.
    Shows { condition: String, severity: f64 },
    /// Factor on the walking speed.
    Pace(Fuzzy),
    /// Metres per second added to the walking speed per week of the phase.
    PaceEachWeek(Fuzzy),
    /// Seconds later; earlier if negative.
    Later {
        activity: Activity,
        #[serde(rename = "by_s")]
        by: Fuzzy,
    },
    /// Factor on durations.
    Longer { activity: Activity, factor: Fuzzy },
    /// Seconds added to durations; shorter if negative.
    LongerBy {
        activity: Activity,
        #[serde(rename = "by_s")]
        by: Fuzzy,
    },
    /// Factor on frequency, in the part of the day if one is stated.
    Oftener { activity: Activity, factor: Fuzzy },
    /// Skipped on a day, with the stated chance.
    Skips { activity: Activity },
    /// Factor on the variation of times and durations between days.
    Irregular(Fuzzy),
    /// Factor on movement while awake and at home, in the part of the day if one is stated.
    Active { factor: Fuzzy },
    /// Factor on the variation of activity levels between days.
    DaysDiffer(Fuzzy),
    /// Days of this kind, with the stated chance; `very` squares the factor of the kind.
    DaysAre { kind: DayKind, very: bool },
    /// A late bedtime delays rising by as much.
    SleepsIn,
    /// Factor on movements in bed.
    Restless(Fuzzy),
    /// A thing stays on or open after a use, with the stated chance.
    Forgets { thing: String },
    /// A thing is turned on or opened at the stated time, and off or closed at its end; all night if it is of the night.
    KeepsOn { thing: String },
    /// A room or a floor that the person does not leave, or does not enter, with the stated chance.
    Range { place: String, inside: bool },
    /// A thing is not used.
    Spares { thing: String },
    /// Beats per minute added.
    Pulse(Fuzzy),
    /// Breaths per minute added.
    Respiration(Fuzzy),
    /// The gain of a motor schema while wandering, relative to a goal of 1, or pauses per minute.
    Shy { of: Shy, gain: f64 },
}

/// Aversions of a person who wanders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Shy {
    /// The person keeps close to walls.
    OpenFloor,
    /// The person keeps away from other people.
    People,
    /// The person stops now and then.
    GoingOn,
}

impl Routine {
    /// As opposed to an animal.
    pub fn is_of_person(&self) -> bool {
        self.person.as_ref().is_none_or(|person| person.kind == ResidentKind::Person)
    }
}

impl Habit {
    /// Whether it states the frequency of an activity by day or by night. A preceding activity, or a time without a number
    /// of repetitions, only describes one occasion.
    pub fn is_how_often(&self, activity: &Activity, at_night: bool) -> bool {
        let span = match &self.when.time {
            HabitTime::AnyTime | HabitTime::Within(PartOfDay::Day) => Some(false),
            HabitTime::Within(PartOfDay::Night) => Some(true),
            // "5 times a day between 07:00 and 19:00".
            HabitTime::At(time) if self.when.times.1 > 1 => Some(PartOfDay::Night.contains(time.mean())),
            _ => None,
        };
        self.activity == *activity && self.visitor.is_none() && span == Some(at_night)
    }

    /// Whether it replaces a usual habit: the same activity, and after the same one if several differ by that.
    /// Help with the shower or the laundry replaces what the resident does alone, on all days.
    pub(crate) fn stands_for(&self, usual: &Habit) -> bool {
        // A week in hospital does not replace usual outings.
        let is_long = self.when.nights > 0 || self.when.lasts.is_some_and(|lasts| lasts.low >= 86_400.0);
        let is_after_another = match (&self.when.time, &usual.when.time) {
            (HabitTime::After(of, _), HabitTime::After(after, _)) => usual.activity == Activity::WashUp && of != after,
            _ => false,
        };
        let is_help =
            matches!(usual.activity, Activity::Shower | Activity::Laundry) && self.does.contains(&usual.activity);
        is_help || self.activity == usual.activity && self.visitor.is_none() && !is_long && !is_after_another
    }
}

impl Effect {
    /// Whether its chance is drawn once a day, as opposed to once for each use of a thing.
    pub(crate) fn is_of_a_day(&self) -> bool {
        matches!(self, Effect::Skips { .. } | Effect::KeepsOn { .. } | Effect::Range { .. })
    }
}

impl RoutineChange {
    /// Whether both change the same, so that the later one replaces the other.
    pub(crate) fn is_of_the_same(&self, other: &RoutineChange) -> bool {
        use Effect::{Active, DaysAre, Forgets, Later, Longer, LongerBy, Oftener, Shows, Skips, Spares};
        let is_same_part = self.when.part() == other.when.part();
        match (&self.effect, &other.effect) {
            (Shows { .. }, _) => false,
            (Later { activity, .. }, Later { activity: of, .. })
            | (Longer { activity, .. }, Longer { activity: of, .. })
            | (LongerBy { activity, .. }, LongerBy { activity: of, .. })
            | (Skips { activity }, Skips { activity: of }) => activity == of,
            (Oftener { activity, .. }, Oftener { activity: of, .. }) => activity == of && is_same_part,
            (DaysAre { kind, .. }, DaysAre { kind: of, .. }) => kind == of,
            (Active { .. }, Active { .. }) => is_same_part,
            (Forgets { thing }, Forgets { thing: of }) | (Spares { thing }, Spares { thing: of }) => {
                thing.to_lowercase() == of.to_lowercase()
            }
            (effect, of) => std::mem::discriminant(effect) == std::mem::discriminant(of),
        }
    }
}

impl Default for HabitChance {
    fn default() -> HabitChance {
        HabitChance::ALWAYS
    }
}

impl HabitChance {
    pub const ALWAYS: HabitChance =
        HabitChance { quantifier: Some(Quantifier::Every), probability: 1.0, becomes: None, days_a_week: None };

    pub fn from_quantifier(quantifier: Quantifier) -> HabitChance {
        HabitChance {
            quantifier: Some(quantifier),
            probability: quantifier.probability(),
            becomes: None,
            days_a_week: None,
        }
    }
}

/// Hours of the words for parts of a day (our choice, except that naps peak at 14:30-15:00 and 20:30-21:00).
const MORNING_H: (f64, f64) = (8.0, 11.5);
const NOON_H: (f64, f64) = (11.5, 13.5);
const AFTERNOON_H: (f64, f64) = (13.0, 17.5);
const EVENING_H: (f64, f64) = (18.5, 21.5);
const NIGHT_H: (f64, f64) = (23.5, 29.5);
const DAY_H: (f64, f64) = (9.0, 20.0);

impl PartOfDay {
    /// Start and end in seconds since midnight.
    pub fn hours(self) -> (f64, f64) {
        let (from, to) = match self {
            PartOfDay::Morning => MORNING_H,
            PartOfDay::Noon => NOON_H,
            PartOfDay::Afternoon => AFTERNOON_H,
            PartOfDay::Evening => EVENING_H,
            PartOfDay::Night => NIGHT_H,
            PartOfDay::Day => DAY_H,
        };
        (from * 3600.0, to * 3600.0)
    }

    /// Whether a time is in it, in seconds since midnight.
    pub fn contains(self, time_s: f64) -> bool {
        let (from_s, to_s) = self.hours();
        (0.0..to_s - from_s).contains(&(time_s - from_s).rem_euclid(86_400.0))
    }

    pub fn word(self) -> &'static str {
        match self {
            PartOfDay::Morning => "morning",
            PartOfDay::Noon => "noon",
            PartOfDay::Afternoon => "afternoon",
            PartOfDay::Evening => "evening",
            PartOfDay::Night => "night",
            PartOfDay::Day => "day",
        }
    }
}

/// Usual activities that need no sentence: those of `ordinary.routine`, of needs and of spare time.
pub(crate) const USUAL: [Activity; 19] = [
    Activity::GetUp,
    Activity::Dress,
    Activity::Wash,
    Activity::Prepare(Meal::Breakfast),
    Activity::Eat(Meal::Breakfast),
    Activity::Prepare(Meal::Lunch),
    Activity::Eat(Meal::Lunch),
    Activity::Prepare(Meal::Dinner),
    Activity::Eat(Meal::Dinner),
    Activity::WashUp,
    Activity::GoToBed,
    Activity::Laundry,
    Activity::Leave,
    Activity::Phone,
    Activity::UseBathroom,
    Activity::Drink,
    Activity::Snack,
    Activity::WatchTelevision,
    Activity::Read,
];

pub(crate) fn shows(routine: &Routine) -> impl Iterator<Item = &str> {
    routine.changes.iter().filter_map(|change| match &change.effect {
        Effect::Shows { condition, .. } => Some(condition.as_str()),
        _ => None,
    })
}
