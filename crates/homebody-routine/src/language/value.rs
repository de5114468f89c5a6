//! The values of phrases: numbers, times, parts of a sentence, clauses.

use super::parts::Parts;
use super::words::TextSpan;
use crate::routine::{
    Activity, Circumstance, DayKind, Falling, HabitChance, Lapse, PartOfDay, PhaseDay, ResidentKind, Response,
    RuleTrigger, Shy,
};
use homebody_core::activity::Help;
use homebody_core::fuzzy::Fuzzy;

#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Unit,
    Number(f64),
    Range(Range),
    Clock(Clock),
    Time(TimeOfDay),
    Weekdays(u8),
    Months(u16),
    /// A day, and the length of the stretch that begins on it.
    Moment(PhaseDay, i32),
    PartOfDay(Vec<PartOfDay>),
    Chance(Chance),
    DayKind(DayKind),
    /// "Sundays", "winter mornings": which days, and which part of them.
    DayNoun(Option<u8>, Option<PartOfDay>),
    Parts(Box<Parts>),
    Measure(Measure),
    Act(Act),
    Name(String),
    Subject(Subject),
    Verb(Verb),
    Clause(Box<Clause>),
    Clauses(Vec<(Join, Clause)>),
    Join(Join),
    Trigger(RuleTrigger, Option<Fuzzy>),
    Circumstances(Vec<Circumstance>),
    Answers(Vec<Answer>),
    Lapse(Lapse),
    Statement(Box<Statement>),
}

/// A number or a range, with or without "about".
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub from: f64,
    pub to: f64,
    pub about: bool,
}

/// A time of the day in seconds since midnight. An open one is of either half of the day, and below twelve hours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    pub s: f64,
    pub open: bool,
    /// Whether the half of the day was named.
    pub half: bool,
    pub span: TextSpan,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeOfDay {
    pub clock: Clock,
    /// How far the time varies, in seconds.
    pub spread_s: f64,
}

/// Said something is done, with open times.
#[derive(Clone, Debug, PartialEq)]
pub enum Said {
    At(TimeOfDay),
    Between(TimeOfDay, TimeOfDay),
    FromTo(TimeOfDay, TimeOfDay),
    By(TimeOfDay),
    Within(PartOfDay),
    After(Activity, Option<Fuzzy>),
    Before(Activity, Option<Fuzzy>),
    With(Activity),
    Then,
}

/// A probability; a rate counts on all days of a period, whatever the days of the sentence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chance {
    pub chance: HabitChance,
    pub is_rate: bool,
}

/// The amount of a change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    pub of: Of,
    pub by: Fuzzy,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    Later,
    LongerBy,
    Longer,
    Oftener,
    Much,
    Faster,
    FasterBy { each_week: bool },
    Active,
    Restless,
    Beats,
    Breaths,
    Some,
}

/// An activity as said, with what its words add.
#[derive(Clone, Debug, PartialEq)]
pub struct Act {
    pub activity: Activity,
    pub place: Option<String>,
    pub lasts: Option<Fuzzy>,
    pub span: TextSpan,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    Person,
    Visitor(String),
    /// A name that is not the person's.
    Stranger(String),
    Hours,
    Pulse,
    Breathing,
    /// Days that are busy or quiet: "Mondays are busy days".
    Days,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Verb {
    Age(f64),
    Kind(ResidentKind),
    /// "is", with a measure.
    Is,
    Walks,
    Pace(Fuzzy),
    Does(Act),
    /// "Eats", of the meal that was prepared.
    Eats,
    /// Until when somebody stays in bed, or up.
    Stays(Activity),
    Own(String),
    Visits,
    Not(Act),
    Skips(Act),
    Shows(String, f64),
    Forgets(String),
    Sleeps,
    Lively(DayKind, bool),
    Differ,
    SleepsIn,
    Vary,
    Rises(Measure),
    Breathes,
    Shy(Shy),
    /// So many times a minute, while wandering.
    Stops(f64),
    Helps(Act, Help),
    VisitedBy(String),
    Falls(Falling),
    Goes,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Join {
    And,
    Or,
    Then,
    /// "And" with the verb of the clause before.
    Again,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    pub subject: Subject,
    pub verb: Verb,
    pub verb_span: TextSpan,
    pub parts: Parts,
    /// The parts that stand behind the verb.
    pub behind: Parts,
    pub span: TextSpan,
}

/// A response of a rule, with its parts. A thing without a name is "it".
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    pub response: Response,
    pub parts: Parts,
    pub span: TextSpan,
}

#[derive(Clone, Debug, PartialEq)]
pub struct RuleSaid {
    pub trigger: RuleTrigger,
    pub trigger_span: TextSpan,
    pub lasts: Option<Fuzzy>,
    pub only_if: Vec<Circumstance>,
    pub answers: Vec<Answer>,
    pub lapse: Option<Lapse>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    Heading(Parts),
    /// Parts in front of all clauses, and the clauses.
    Clauses(Parts, Vec<(Join, Clause)>),
    Rule(Parts, RuleSaid),
}
