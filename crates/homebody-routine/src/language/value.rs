//! The values of phrases: numbers, times, parts of a sentence, clauses.

use super::parts::{Chance, ClockTime, Measure, Parts, TimeOfDay};
use super::words::TextSpan;
use crate::routine::{
    Activity, Circumstance, DayKind, Falling, Lapse, PartOfDay, PhaseDay, ResidentKind, Response, RuleTrigger, Shy,
    Weather,
};
use homebody_core::activity::Help;
use homebody_core::fuzzy::Fuzzy;

#[derive(Clone, Debug, PartialEq)]
pub enum PhraseValue {
    Unit,
    Number(f64),
    Range(Range),
    Clock(ClockTime),
    Time(TimeOfDay),
    Weekdays(u8),
    Months(u16),
    /// A day, and the length of the stretch that begins on it.
    Moment(PhaseDay, i32),
    PartOfDay(Vec<PartOfDay>),
    Chance(Chance),
    DayKind(DayKind),
    Weather(Weather),
    /// "Sundays", "winter mornings": which days, and which part of them.
    DayNoun(Option<u8>, Option<PartOfDay>),
    Parts(Box<Parts>),
    Measure(Measure),
    Act(Act),
    Name(String),
    Subject(SentenceSubject),
    Verb(Verb),
    Clause(Box<Clause>),
    Clauses(Vec<(Join, Clause)>),
    Join(Join),
    Trigger(RuleTrigger, Option<Fuzzy>),
    Circumstances(Vec<Circumstance>),
    Answers(Vec<Answer>),
    Lapse(Lapse),
    Statement(Box<SpokenStatement>),
}

/// A number or a range, with or without "about".
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub from: f64,
    pub to: f64,
    pub about: bool,
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
pub enum SentenceSubject {
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
    /// After so many metres.
    Rests(f64),
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
    /// A thing is on, all night or at the time of the sentence.
    KeepsOn(String, bool),
    Spares(String),
    /// Keeps to a room or floor if true, else avoids it.
    Range(String, bool),
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
    pub subject: SentenceSubject,
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
pub enum SpokenStatement {
    Heading(Parts),
    /// Parts in front of all clauses, and the clauses.
    Clauses(Parts, Vec<(Join, Clause)>),
    Rule(Parts, RuleSaid),
}
