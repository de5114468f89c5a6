//! Statements as plain data, one for each sentence of a routine, for programs that write and read lives.
//!
//! Their JSON has a kind, the fields of that kind, and `when`: the days, the time, the length and the frequency.

use super::canonical;
use crate::routine::{Activity, Effect, Habit, PhaseDay, Quote, Routine, RoutineChange, RoutinePerson, RoutineRule};
use homebody_core::problem::Problem;
use homebody_core::scenario::shape;
use homebody_core::scenario::source::JsonSource;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A statement about a life.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Statement {
    /// Age, walking speed, or the kind of an animal.
    Person(RoutinePerson),
    /// An activity of the resident.
    Habit(Habit),
    /// Getting up, or going to bed; its place is the place of sleep.
    Sleep(Habit),
    /// A time outside the home.
    Away(Habit),
    /// A visitor comes and stays a while.
    Visit(Habit),
    /// A fall or a stumble.
    Event(Habit),
    /// A change of other statements or of the resident, or a condition.
    Change(RoutineChange),
    /// A thing that stays on or open, or is not used.
    Thing(RoutineChange),
    /// A response to a state or an event.
    Rule(RoutineRule),
    /// A remark without effect.
    Note { text: String },
}

/// A fault in the JSON of a statement.
#[derive(Clone, Debug, PartialEq)]
pub struct StatementFault {
    /// The JSON pointer of the field; empty for the statement as a whole.
    pub field: String,
    pub problem: Problem,
}

/// The fields with a day, such as "day 40".
const DAY_FIELDS: [&str; 3] = ["/when/phase/from", "/when/phase/until", "/when/chance/becomes/1"];

impl Statement {
    /// The statement of a JSON text, or all faults of the text.
    pub fn read(text: &str) -> Result<Statement, Vec<StatementFault>> {
        const NAME: &str = "statement";
        let source =
            JsonSource::parse(NAME, text).map_err(|problem| vec![StatementFault { field: String::new(), problem }])?;
        let (_, mut schema) = Statement::list_schema();
        schema["$ref"] = "#/definitions/Statement".into();
        let fault =
            |problem: Problem| StatementFault { field: source.pointer_at(problem.line, problem.column), problem };
        let mut faults: Vec<StatementFault> = shape::check(&source, &schema).problems.into_iter().map(fault).collect();
        let json = source.root.to_json();
        let days = DAY_FIELDS.into_iter().filter_map(|field| Some((field, json.pointer(field)?.as_str()?)));
        faults.extend(days.filter_map(|(field, day)| {
            let why = PhaseDay::try_from(day.to_owned()).err()?;
            Some(StatementFault { field: field.to_owned(), problem: Problem::of_file(NAME, why, None) })
        }));
        if !faults.is_empty() {
            return Err(faults);
        }
        let whole = |why: serde_json::Error| {
            vec![StatementFault { field: String::new(), problem: Problem::of_file(NAME, why.to_string(), None) }]
        };
        serde_json::from_value(json).map(Statement::with_own_kind).map_err(whole)
    }

    /// With the kind that its sentence has: "she goes to bed" is about sleep.
    fn with_own_kind(self) -> Statement {
        match self {
            Statement::Habit(habit)
            | Statement::Sleep(habit)
            | Statement::Away(habit)
            | Statement::Visit(habit)
            | Statement::Event(habit) => Statement::from_habit(habit),
            Statement::Change(change) | Statement::Thing(change) => Statement::from_change(change),
            other => other,
        }
    }

    pub fn from_habit(habit: Habit) -> Statement {
        match habit.activity {
            _ if habit.visitor.is_some() => Statement::Visit(habit),
            Activity::GetUp | Activity::GoToBed => Statement::Sleep(habit),
            Activity::Leave | Activity::ComeHome => Statement::Away(habit),
            Activity::Fall | Activity::Stumble => Statement::Event(habit),
            _ => Statement::Habit(habit),
        }
    }

    pub fn from_change(change: RoutineChange) -> Statement {
        match change.effect {
            Effect::Forgets { .. } | Effect::KeepsOn { .. } | Effect::Spares { .. } => Statement::Thing(change),
            _ => Statement::Change(change),
        }
    }

    /// The sentences that say it; a person may need several.
    pub fn sentences(&self) -> Vec<String> {
        match self {
            Statement::Person(person) => canonical::person_sentences(person),
            Statement::Habit(habit)
            | Statement::Sleep(habit)
            | Statement::Away(habit)
            | Statement::Visit(habit)
            | Statement::Event(habit) => vec![canonical::habit_sentence(habit)],
            Statement::Change(change) | Statement::Thing(change) => vec![canonical::change_sentence(change)],
            Statement::Rule(rule) => vec![canonical::rule_sentence(rule)],
            Statement::Note { text } => vec![format!("Note: {text}")],
        }
    }

    /// The JSON Schema (draft 7) of a list of statements, and the name of its file.
    pub fn list_schema() -> (&'static str, Value) {
        let schema = SchemaSettings::draft07().into_generator().into_root_schema_for::<Vec<Statement>>();
        ("statements.schema.json", schema.to_value())
    }
}

/// The statements of a routine in the order of its text, each with the words that it was read from.
pub fn statements(routine: &Routine) -> Vec<(Quote, Statement)> {
    let mut all: Vec<(&Quote, Statement)> = Vec::new();
    all.extend(routine.person.iter().map(|person| (&person.said, Statement::Person(person.clone()))));
    all.extend(routine.habits.iter().map(|habit| (&habit.said, Statement::from_habit(habit.clone()))));
    all.extend(routine.rules.iter().map(|rule| (&rule.said, Statement::Rule(rule.clone()))));
    all.extend(routine.changes.iter().map(|change| (&change.said, Statement::from_change(change.clone()))));
    let note = |text: &Quote| Statement::Note { text: text.text.trim().to_owned() };
    all.extend(routine.remarks.iter().map(|remark| (remark, note(remark))));
    all.sort_by_key(|(said, _)| (said.line, said.column));
    all.into_iter().map(|(said, statement)| (said.clone(), statement)).collect()
}

/// The text of statements, a sentence a line, which the language reads back as the same statements.
pub fn text<'a>(statements: impl IntoIterator<Item = &'a Statement>) -> String {
    let sentences = statements.into_iter().flat_map(Statement::sentences);
    sentences.map(|sentence| sentence + "\n").collect()
}
