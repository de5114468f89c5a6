//! Statements of drafts: those of a routine, and the sentences of one that a form has made.

use super::routines::DraftRoutine;
use super::sentence_edits::{SentenceEdit, adding, applied, places, position, replacing, written};
use super::{DraftService, problems, sentence_view};
use crate::messages::DraftMessage;
use crate::wire::{
    Draft, Explain, FieldFaultView, ProblemView, ReplacedStatement, SentencePlace, StatementView, StatementsView,
    TextEditView, WriteStatement, WrittenStatementView,
};
use homebody_core::problem::{Problem, readable};
use homebody_core::scenario::source::pointer_part;
use homebody_routine::explain::explain;
use homebody_routine::language::is_english;
use homebody_routine::routine::Quote;
use homebody_routine::statement::{Statement, StatementFault, statements};
use serde_json::Value;
use std::ops::Range;

type Placed = (Quote, Statement);

impl DraftService {
    /// The statements of a routine with their places.
    pub fn statements(&self, Explain { draft, file }: Explain) -> StatementsView {
        let files = self.with(draft);
        let routine = match DraftRoutine::open(&files, &self.folders.entry, &file) {
            Ok(routine) => routine,
            Err(wrong) => return StatementsView { problems: problems(&wrong), ..StatementsView::default() },
        };
        let (text, known) = (routine.text(), routine.reading());
        let all = known.map(|known| statements(&known.routine)).unwrap_or_default();
        let view = |(said, statement): &Placed| StatementView {
            places: places(said, statement, text).into_iter().map(|place| sentence_place(text, &place)).collect(),
            statement: json(statement),
            sentences: statement.sentences().into_iter().map(|one| written(text, vec![one])).collect(),
        };
        StatementsView { problems: Vec::new(), statements: all.iter().map(view).collect() }
    }

    /// The sentences of a statement in its routine, their meaning, and the changes that write them. Nothing is written.
    pub fn write_statement(&self, asked: WriteStatement) -> WrittenStatementView {
        let statement = match Statement::read(&format!("{:#}", asked.statement)) {
            Ok(statement) => statement,
            Err(faults) => {
                let faults = faults.into_iter().map(fault_view).collect();
                return WrittenStatementView { faults, ..WrittenStatementView::default() };
            }
        };
        let files = self.with(asked.draft.clone());
        let refused = |wrong: &[Problem]| WrittenStatementView {
            sentences: statement.sentences(),
            problems: problems(wrong),
            ..WrittenStatementView::default()
        };
        match DraftRoutine::open(&files, &self.folders.entry, &asked.file) {
            Ok(routine) => {
                let problem = |message| refused(&[Problem::of_file(&asked.file, message, None)]);
                self.written(&asked, &statement, routine).unwrap_or_else(problem)
            }
            Err(wrong) => refused(&wrong),
        }
    }

    fn written(
        &self,
        asked: &WriteStatement,
        statement: &Statement,
        routine: DraftRoutine,
    ) -> Result<WrittenStatementView, DraftMessage> {
        let text = routine.text().to_owned();
        let before = routine.reading().ok_or(DraftMessage::UnusedRoutine)?;
        let all = statements(&before.routine);
        let edits = edits(asked, statement, &text, &all)?;
        let fresh = applied(&text, &edits);
        let (days, calendar) = (routine.days(), routine.scenario.calendar.clone());
        let after = routine.with_text(&fresh).reading().ok_or(DraftMessage::UnusedRoutine)?;
        let mut view = WrittenStatementView {
            sentences: statement.sentences().into_iter().map(|one| written(&text, vec![one])).collect(),
            problems: problems(&new_problems(&before.problems, after.problems)),
            ..WrittenStatementView::default()
        };
        if !view.problems.is_empty() {
            return Ok(view);
        }
        let read = statements(&after.routine);
        let number = number_of_new(&all, asked.instead.as_ref().map(|old| old.number), &read)?;
        let (said, meant) = &read[number];
        view.meaning = explain(&after.routine)
            .dated(&calendar, days)
            .sentences
            .into_iter()
            .skip(number)
            .take(1)
            .map(sentence_view)
            .collect();
        let mut fields = Vec::new();
        differences(&said_of(statement), &said_of(meant), String::new(), &mut fields);
        view.faults = fields.into_iter().map(not_said).collect();
        if !view.faults.is_empty() {
            return Ok(view);
        }
        let mut draft = asked.draft.clone();
        draft.texts.insert(asked.file.clone(), fresh.clone());
        let lines: Vec<u32> = places(said, meant, &fresh).iter().map(|place| position(&fresh, place.start).0).collect();
        let is_here = |problem: &ProblemView| problem.file == asked.file && lines.contains(&problem.line);
        let checked = self.check(Draft { texts: draft.texts });
        view.problems = checked.problems.into_iter().filter(is_here).collect();
        view.warnings = checked.warnings.into_iter().filter(is_here).collect();
        view.edits = edits.iter().map(|edit| edit_view(&text, edit)).collect();
        Ok(view)
    }
}

/// The changes of the text that write the statement, or the reason why none can.
fn edits(
    asked: &WriteStatement,
    statement: &Statement,
    text: &str,
    all: &[Placed],
) -> Result<Vec<SentenceEdit>, DraftMessage> {
    if !is_english(text) {
        return Err(DraftMessage::OtherLanguage);
    }
    if says_nothing(statement) {
        return Err(DraftMessage::NothingSaid);
    }
    let instead = asked.instead.as_ref().map(|old| old.number as usize);
    let is_there = |old: &ReplacedStatement| {
        all.get(old.number as usize).is_some_and(|(_, now)| is_same(&old.statement, &json(now)))
    };
    if asked.instead.as_ref().is_some_and(|old| !is_there(old)) {
        return Err(DraftMessage::NoStatement);
    }
    let is_person = |statement: &Statement| matches!(statement, Statement::Person(_));
    let mut others = all.iter().enumerate().filter(|(number, _)| Some(*number) != instead);
    if is_person(statement) && others.any(|(_, (_, other))| is_person(other)) {
        return Err(DraftMessage::SecondPerson);
    }
    Ok(match instead {
        Some(number) => replacing(text, all, number, statement),
        None => vec![adding(text, all, asked.line.max(1) as usize, statement)],
    })
}

/// The problems that were not there before. Lines may have moved.
fn new_problems(before: &[Problem], after: Vec<Problem>) -> Vec<Problem> {
    let mut known: Vec<&Problem> = before.iter().collect();
    let is_new = |problem: &Problem| {
        let same = known.iter().position(|old| old.what == problem.what && old.hint == problem.hint);
        same.map(|index| known.swap_remove(index)).is_none()
    };
    after.into_iter().filter(is_new).collect()
}

fn says_nothing(statement: &Statement) -> bool {
    match statement {
        Statement::Note { text } => text.trim().is_empty(),
        other => other.sentences().is_empty(),
    }
}

/// The number of the new statement in the changed text. All other statements have to be as before.
fn number_of_new(before: &[Placed], instead: Option<u32>, after: &[Placed]) -> Result<usize, DraftMessage> {
    let others: Vec<Value> = before
        .iter()
        .enumerate()
        .filter(|(number, _)| Some(*number as u32) != instead)
        .map(|(_, (_, one))| json(one))
        .collect();
    let read: Vec<Value> = after.iter().map(|(_, statement)| json(statement)).collect();
    let number = others.iter().zip(&read).position(|(other, one)| !is_same(other, one)).unwrap_or(others.len());
    let rest = read.get(number + 1..).unwrap_or_default();
    let later = others.get(number..).unwrap_or_default();
    match rest.len() == later.len()
        && later.iter().zip(rest).all(|(other, one)| is_same(other, one))
        && number < read.len()
    {
        true => Ok(number),
        false => Err(DraftMessage::ChangesOthers),
    }
}

fn is_same(a: &Value, b: &Value) -> bool {
    let mut found = Vec::new();
    differences(a, b, String::new(), &mut found);
    found.is_empty()
}

/// The pointers of the values that differ. Numbers are the same up to the accuracy of floating point, texts up to case and the space
/// around them.
fn differences(a: &Value, b: &Value, pointer: String, found: &mut Vec<String>) {
    match (a, b) {
        (Value::Object(one), Value::Object(other)) => {
            for key in one.keys().chain(other.keys().filter(|key| !one.contains_key(*key))) {
                let value = |of: &serde_json::Map<String, Value>| of.get(key).cloned().unwrap_or_default();
                differences(&value(one), &value(other), format!("{pointer}/{}", pointer_part(key)), found);
            }
        }
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            for (index, (one, other)) in one.iter().zip(other).enumerate() {
                differences(one, other, format!("{pointer}/{index}"), found);
            }
        }
        (Value::Number(one), Value::Number(other)) => {
            let (one, other) = (one.as_f64().unwrap_or_default(), other.as_f64().unwrap_or_default());
            if (one - other).abs() > 1e-6 * one.abs().max(other.abs()).max(1.0) {
                found.push(pointer);
            }
        }
        (Value::String(one), Value::String(other)) if one.trim().to_lowercase() == other.trim().to_lowercase() => {}
        (one, other) if one == other => {}
        _ => found.push(pointer),
    }
}

/// A statement without what another field of it makes meaningless.
fn said_of(statement: &Statement) -> Value {
    let mut value = json(statement);
    if let Some(chance) = value.pointer_mut("/when/chance").and_then(Value::as_object_mut)
        && chance.contains_key("days_a_week")
    {
        // So many days of each week, whatever the probability.
        chance.remove("probability");
    }
    value
}

fn json(statement: &Statement) -> Value {
    serde_json::to_value(statement).unwrap_or_default()
}

fn fault_view(StatementFault { field, problem }: StatementFault) -> FieldFaultView {
    FieldFaultView { field, what: readable(problem.what), hint: problem.hint }
}

fn not_said(field: String) -> FieldFaultView {
    let problem = Problem::of_file("", DraftMessage::NotSaid { field: field.clone() }, None);
    FieldFaultView { field, what: problem.what, hint: problem.hint }
}

fn sentence_place(text: &str, place: &Range<usize>) -> SentencePlace {
    let (line, column) = position(text, place.start);
    SentencePlace { line, column, length: text[place.clone()].chars().count() as u32 }
}

fn edit_view(text: &str, edit: &SentenceEdit) -> TextEditView {
    let ((line, column), (to_line, to_column)) = (position(text, edit.range.start), position(text, edit.range.end));
    TextEditView { line, column, to_line, to_column, insert: edit.insert.clone() }
}
