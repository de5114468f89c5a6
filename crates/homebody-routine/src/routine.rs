//! A routine, understood: where the language and the living meet.
//!
//! The language makes it from text; the living asks it what to do. It holds what was said, no more: what
//! nobody said, such as how long a breakfast takes, is for the living to fill in.

pub use days::{DayKind, Days, Moment, PartOfDay, Phase};
pub use falling::{FallEnds, Falling, FallsFrom, USUAL_SHARE};
use homebody_core::activity::{self, UsualLength};
use homebody_core::fuzzy::{Fuzzy, Quantifier};
use homebody_core::role::Role;
use serde::Serialize;

mod days;
mod falling;

/// A routine file, or a condition file, which is about nobody in particular.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Routine {
    /// The file's name.
    pub file: String,
    /// Whom it is about; nobody in a condition.
    pub person: Option<Person>,
    /// In the order of the file.
    pub habits: Vec<Habit>,
    pub rules: Vec<Rule>,
    pub changes: Vec<Change>,
    /// What somebody is, has or likes: kept, told by `explain`, and not lived.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<Quote>,
}

/// Whom a routine is about.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Person {
    /// The first sentence about them.
    pub said: Quote,
    pub name: String,
    pub kind: Kind,
    pub age_years: Option<f64>,
    /// Usual walking speed in metres a second.
    pub pace_mps: Option<Fuzzy>,
    /// The sentences that say age and pace.
    pub age_said: Option<Quote>,
    pub pace_said: Option<Quote>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    #[default]
    Person,
    Cat,
    Dog,
}

/// The words that something was understood from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Quote {
    /// Counted from 1.
    pub line: u32,
    /// Counted from 1, in characters.
    pub column: u32,
    /// The sentence as it stands in the file.
    pub text: String,
}

/// Something that is done.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Habit {
    pub said: Quote,
    /// Who does it: nothing for the person themself, else the name of who visits, such as `daughter`.
    pub visitor: Option<String>,
    pub activity: Activity,
    /// Where, if it was said: the name of a place, a piece of furniture or a room.
    pub place: Option<String>,
    pub chance: Chance,
    pub days: Days,
    pub phase: Phase,
    pub when: When,
    /// How long, in seconds, if it was said.
    pub lasts: Option<Fuzzy>,
    /// Until what time of day, in seconds since midnight, if it was said.
    pub until: Option<Fuzzy>,
    /// How many times in each span that `when` names: the least and the most.
    pub times: (u32, u32),
    /// How somebody falls, if more is said than that they do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub falling: Option<Falling>,
}

/// What can be done. Most are done at a place that the home names after them.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Activity {
    GetUp,
    UseBathroom,
    Shower,
    Wash,
    Dress,
    TakeMedicine,
    Prepare(Meal),
    Eat(Meal),
    WashUp,
    WatchTelevision,
    Read,
    Phone,
    Nap,
    Laundry,
    Housework,
    Leave,
    ComeHome,
    /// Somebody who does not live there comes and stays a while.
    Visit,
    GoToBed,
    /// Coffee, tea or water.
    Drink,
    Snack,
    Exercise,
    UseComputer,
    /// Sitting and doing nothing in particular.
    Relax,
    /// Walking without a goal.
    Wander,
    /// Walking to and fro.
    Pace,
    /// Walking round and round.
    Lap,
    /// Lying awake in bed.
    LieAwake,
    /// Losing one's footing, and lying on the floor for a while.
    Fall,
    /// Losing one's footing, and not falling.
    Stumble,
    /// Something that needs no acting out of its own: the label of its row in the table of activities.
    Everyday(&'static str),
    /// What the user names, by place and duration, such as `knits`.
    Other(String),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Meal {
    Breakfast,
    Lunch,
    Dinner,
}

/// How likely something is on each day, night or occasion that it is meant for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Chance {
    /// The word it was understood from, if it was a quantifier.
    pub quantifier: Option<Quantifier>,
    pub probability: f64,
    /// Where it goes, and on which day it gets there, if it changes: "rarely at first, often by day 160".
    pub becomes: Option<(f64, Moment)>,
    /// On exactly so many days of each week, whatever the probability.
    pub days_a_week: Option<u8>,
}

/// When on such a day. Times of day are seconds since local midnight; later than 86,400 is after midnight.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// Whenever it fits.
    AnyTime,
    At(Fuzzy),
    /// At some time between.
    Within(PartOfDay),
    /// So many seconds after the end of something, at once where it is not said.
    After(Activity, Option<Fuzzy>),
    Before(Activity, Option<Fuzzy>),
    /// Together with something: at its beginning.
    With(Activity),
    /// Once the habit before it in the file is done; it is done only if that one is.
    Then,
}

/// Something that interrupts whatever is done.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rule {
    pub said: Quote,
    pub whenever: Trigger,
    /// How long it has to last, in seconds.
    pub lasts: Fuzzy,
    /// What else has to be so as it becomes due.
    pub only_if: Vec<Circumstance>,
    pub probability: f64,
    pub phase: Phase,
    pub response: Response,
    /// What is done after that.
    pub then: Vec<Response>,
    pub lapse: Option<Lapse>,
}

impl Rule {
    /// What is done, one after the other.
    pub fn answers(&self) -> impl Iterator<Item = &Response> {
        std::iter::once(&self.response).chain(&self.then)
    }
}

/// Something that has to be so, or must not be.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Circumstance {
    pub holds: bool,
    pub state: Trigger,
}

/// How often what a rule asks for is forgotten, and how much later, in seconds, it is done then; never, if that was not said.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Lapse {
    pub probability: f64,
    pub later: Option<Fuzzy>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Trigger {
    /// A thing is on, or open.
    On(String),
    /// The person is there: a place, a piece of furniture or a room.
    At(String),
    /// The person is out.
    Away,
    /// The person is in bed.
    InBed,
    /// Anybody has turned a thing on, such as a door bell.
    Rings(String),
    /// It is dark out of doors; of a room, there too, with its lamp off.
    Dark(Option<String>),
    /// Somebody else is at home: anybody, or a visitor by name.
    Company(Option<String>),
    /// Nobody else is at home.
    Alone,
    /// The person sits.
    Sitting,
    /// The person does this.
    Doing(Activity),
    /// The person has done this: it is over.
    Done(Activity),
    /// It is between these times of day, in seconds since midnight.
    Between(f64, f64),
    /// The rule before it in the text has been answered.
    Follows,
}

impl Trigger {
    /// Whether it is looked out for: it begins and ends with what others do, or with the light.
    pub fn is_looked_for(&self) -> bool {
        matches!(
            self,
            Trigger::Rings(_)
                | Trigger::Dark(_)
                | Trigger::Company(_)
                | Trigger::Alone
                | Trigger::Sitting
                | Trigger::Between(..)
        )
    }
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Response {
    /// Goes there and turns it on or opens it (true), or turns it off or closes it (false).
    Turn { thing: String, on: bool },
    /// Does this, there if it was said, for so many seconds if it was said.
    Do { activity: Activity, place: Option<String>, lasts: Option<Fuzzy> },
}

/// A change of how things are done.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    pub said: Quote,
    /// On which days it is so.
    pub days: Days,
    pub phase: Phase,
    pub effect: Effect,
}

/// What changes, at full strength. A factor of 1 changes nothing.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// The changes of a condition file; a severity of 1 is a moderate case.
    Shows { condition: String, severity: f64 },
    /// So many times the walking speed.
    Pace(Fuzzy),
    /// So many metres a second are added to the walking speed for every week that the phase has lasted.
    PaceEachWeek(Fuzzy),
    /// So many seconds later; earlier where negative.
    Later { activity: Activity, by: Fuzzy },
    /// So many times as long.
    Longer { activity: Activity, factor: Fuzzy },
    /// So many seconds longer; shorter where negative.
    LongerBy { activity: Activity, by: Fuzzy },
    /// So many times as often.
    Oftener { activity: Activity, part: Option<PartOfDay>, factor: Fuzzy },
    /// The chance that it is left out on a day.
    Skips { activity: Activity, chance: f64 },
    /// So many times as much variation of times and durations from day to day.
    Irregular(Fuzzy),
    /// So many times the movement while awake and at home, in a part of the day if it was said.
    Active { part: Option<PartOfDay>, factor: Fuzzy },
    /// So many times as much variation of how lively days are.
    DaysDiffer(Fuzzy),
    /// Days of this kind, with how likely each is one; the quiet of very quiet days is that of quiet days, twice.
    DaysAre { kind: DayKind, very: bool, chance: Chance },
    /// Who goes to bed late gets up as much later.
    SleepsIn,
    /// So many times as much turning in bed.
    Restless(Fuzzy),
    /// The chance that a thing is left on, or open, after each use.
    Forgets { thing: String, chance: f64 },
    /// So many beats a minute more.
    Pulse(Fuzzy),
    /// So many breaths a minute more.
    Respiration(Fuzzy),
    /// A motor schema steers whoever wanders: by so much beside a goal of 1, or so many times a minute.
    Shy { of: Shy, gain: f64 },
}

/// What a wanderer shies away from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shy {
    /// Open floor: they keep close to the walls.
    OpenFloor,
    /// Other people: they keep away from them.
    People,
    /// Going on: they stop now and then.
    GoingOn,
}

impl Routine {
    /// Whether it is that of a person, and not of an animal.
    pub fn is_of_person(&self) -> bool {
        self.person.as_ref().is_none_or(|person| person.kind == Kind::Person)
    }

    /// Where somebody sleeps at night, if it is said.
    pub fn sleeps_at(&self) -> Option<&str> {
        let beds = self.habits.iter().filter(|habit| habit.activity == Activity::GoToBed && habit.visitor.is_none());
        beds.filter_map(|habit| habit.place.as_deref()).next()
    }
}

impl Activity {
    /// Those that are acted out in a way of their own.
    pub const OWN_WAYS: [Activity; 34] = {
        use Meal::{Breakfast, Dinner, Lunch};
        [
            Activity::GetUp,
            Activity::UseBathroom,
            Activity::Shower,
            Activity::Wash,
            Activity::Dress,
            Activity::TakeMedicine,
            Activity::Prepare(Breakfast),
            Activity::Prepare(Lunch),
            Activity::Prepare(Dinner),
            Activity::Eat(Breakfast),
            Activity::Eat(Lunch),
            Activity::Eat(Dinner),
            Activity::WashUp,
            Activity::WatchTelevision,
            Activity::Read,
            Activity::Phone,
            Activity::Nap,
            Activity::Laundry,
            Activity::Housework,
            Activity::Leave,
            Activity::ComeHome,
            Activity::Visit,
            Activity::GoToBed,
            Activity::Drink,
            Activity::Snack,
            Activity::Exercise,
            Activity::UseComputer,
            Activity::Relax,
            Activity::Wander,
            Activity::Pace,
            Activity::Lap,
            Activity::LieAwake,
            Activity::Fall,
            Activity::Stumble,
        ]
    };

    /// The activities without ways of their own, by their rows: all that a routine can say but these. What has no usual length
    /// only the living tells of.
    pub fn everyday() -> impl Iterator<Item = Activity> {
        let is_own = |label: &str| Activity::OWN_WAYS.iter().any(|own| own.label() == label);
        let rows = activity::ACTIVITIES.iter().filter(|known| known.usual.is_some()).map(|known| known.label);
        rows.filter(move |label| !is_own(label)).map(Activity::Everyday)
    }

    /// The activity of a label, if a routine can say it.
    pub fn of_label(label: &str) -> Option<Activity> {
        Activity::OWN_WAYS.into_iter().chain(Activity::everyday()).find(|activity| activity.label() == label)
    }

    /// What the truth calls it: `watching_television`; what the user named, as the user named it.
    pub fn label(&self) -> &str {
        match self {
            Activity::GetUp => activity::GETTING_UP,
            Activity::UseBathroom => activity::USING_BATHROOM,
            Activity::Shower => activity::SHOWERING,
            Activity::Wash => activity::WASHING,
            Activity::Dress => activity::DRESSING,
            Activity::TakeMedicine => activity::TAKING_MEDICINE,
            Activity::Prepare(Meal::Breakfast) => activity::PREPARING_BREAKFAST,
            Activity::Prepare(Meal::Lunch) => activity::PREPARING_LUNCH,
            Activity::Prepare(Meal::Dinner) => activity::PREPARING_DINNER,
            Activity::Eat(Meal::Breakfast) => activity::EATING_BREAKFAST,
            Activity::Eat(Meal::Lunch) => activity::EATING_LUNCH,
            Activity::Eat(Meal::Dinner) => activity::EATING_DINNER,
            Activity::WashUp => activity::WASHING_UP,
            Activity::WatchTelevision => activity::WATCHING_TELEVISION,
            Activity::Read => activity::READING,
            Activity::Phone => activity::TELEPHONING,
            Activity::Nap => activity::NAPPING,
            Activity::Laundry => activity::LAUNDRY,
            Activity::Housework => activity::HOUSEWORK,
            Activity::Leave => activity::AWAY,
            Activity::ComeHome => activity::COMING_HOME,
            Activity::Visit => activity::VISIT,
            Activity::GoToBed => activity::GOING_TO_BED,
            Activity::Drink => activity::DRINKING,
            Activity::Snack => activity::HAVING_A_SNACK,
            Activity::Exercise => activity::EXERCISING,
            Activity::UseComputer => activity::USING_COMPUTER,
            Activity::Relax => activity::RELAXING,
            Activity::Wander => activity::WANDERING,
            Activity::Pace => activity::PACING,
            Activity::Lap => activity::LAPPING,
            Activity::LieAwake => activity::LYING_AWAKE,
            Activity::Fall => activity::FALLEN,
            Activity::Stumble => activity::STUMBLING,
            Activity::Everyday(label) => label,
            Activity::Other(words) => words,
        }
    }

    /// How long it usually takes where nothing is said.
    pub fn usual_length(&self) -> UsualLength {
        /// Of what the user names (ours).
        const OWN: UsualLength = UsualLength { median_min: 30.0, sigma: 0.4 };
        match self {
            Activity::Other(_) => OWN,
            _ => activity::known(self.label()).and_then(|known| known.usual).unwrap_or(OWN),
        }
    }

    /// Where it takes somebody, but for rounds and walks that go anywhere.
    pub fn roles(&self) -> &'static [Role] {
        match self {
            // Where it is said, else on a seat.
            Activity::Other(_) => &[Role::Armchair],
            _ => activity::known(self.label()).map_or(&[], |known| known.roles),
        }
    }
}

impl Habit {
    /// Whether it says how often in a day, or in a night, something is done; a time of its own, or what it comes after, says of
    /// one time that there is.
    pub fn is_how_often(&self, activity: &Activity, at_night: bool) -> bool {
        let span = match self.when {
            When::AnyTime | When::Within(PartOfDay::Day) => Some(false),
            When::Within(PartOfDay::Night) => Some(true),
            _ => None,
        };
        self.activity == *activity && self.visitor.is_none() && span == Some(at_night)
    }

    /// Whether it says what a usual habit would fill in: the same, and after the same where that is what tells them apart.
    pub(crate) fn stands_for(&self, usual: &Habit) -> bool {
        // Who is in hospital for a week goes out as usual before and after.
        let is_long = self.lasts.is_some_and(|lasts| lasts.low >= 86_400.0);
        let is_after_another = match (&self.when, &usual.when) {
            (When::After(of, _), When::After(after, _)) => usual.activity == Activity::WashUp && of != after,
            _ => false,
        };
        self.activity == usual.activity && self.visitor.is_none() && !is_long && !is_after_another
    }

    /// Whether it is of what everybody does every day: what is said of Sunday then leaves the other days as they are.
    pub(crate) fn is_of_every_day(&self) -> bool {
        use Activity::{Dress, Eat, GetUp, GoToBed, Prepare, Wash};
        matches!(self.activity, GetUp | GoToBed | Dress | Wash | Prepare(_) | Eat(_))
    }
}

impl Effect {
    /// Whether both change the same: the later one then replaces the other.
    pub(crate) fn is_of_the_same(&self, other: &Effect) -> bool {
        use Effect::{Active, DaysAre, Forgets, Later, Longer, LongerBy, Oftener, Shows, Skips};
        match (self, other) {
            (Shows { .. }, _) => false,
            (Later { activity, .. }, Later { activity: of, .. })
            | (Longer { activity, .. }, Longer { activity: of, .. })
            | (LongerBy { activity, .. }, LongerBy { activity: of, .. })
            | (Skips { activity, .. }, Skips { activity: of, .. }) => activity == of,
            (Oftener { activity, part, .. }, Oftener { activity: of, part: when, .. }) => {
                activity == of && part == when
            }
            (DaysAre { kind, .. }, DaysAre { kind: of, .. }) => kind == of,
            (Active { part, .. }, Active { part: when, .. }) => part == when,
            (Forgets { thing, .. }, Forgets { thing: of, .. }) => thing.to_lowercase() == of.to_lowercase(),
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }
}

impl Meal {
    pub const ALL: [Meal; 3] = [Meal::Breakfast, Meal::Lunch, Meal::Dinner];
}

impl Chance {
    pub const ALWAYS: Chance =
        Chance { quantifier: Some(Quantifier::Every), probability: 1.0, becomes: None, days_a_week: None };

    pub fn of(quantifier: Quantifier) -> Chance {
        Chance { quantifier: Some(quantifier), probability: quantifier.probability(), becomes: None, days_a_week: None }
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
    /// From when to when, in seconds since midnight.
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

/// What everybody does without its being said: what `ordinary.routine` says, what needs drive to, and what fills the time.
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

/// The conditions that a routine shows.
pub(crate) fn shows(routine: &Routine) -> impl Iterator<Item = &str> {
    routine.changes.iter().filter_map(|change| match &change.effect {
        Effect::Shows { condition, .. } => Some(condition.as_str()),
        _ => None,
    })
}
