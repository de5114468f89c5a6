//! The trial of statements in their home: the strict reader, then some simulated days.

use crate::messages::FreeTextError;
use crate::model_answer::LONGEST_ENTRY;
use homebody_core::problem::{Problem, Problems, is_unseen};
use homebody_core::resident::DriverFile;
use homebody_routine::behaviour::difference::Difference;
use homebody_routine::explain::{ExplanationRow, explain};
use homebody_simulation::{Cancel, OpenScenario, SimulationError};
use std::collections::BTreeMap;

/// Days of a trial: two months show what a week does not, such as every other Thursday.
const TRIAL_DAYS: f64 = 60.0;

/// The resident of a scenario whose routine is tried.
#[derive(Clone)]
pub struct StatementTrial {
    pub opened: OpenScenario,
    pub resident: usize,
    /// The file of the routine in the scenario.
    pub file: String,
}

/// A statement at its place in the routine that is made of an answer.
#[derive(Clone, Debug)]
pub struct PlacedStatement {
    pub text: String,
    /// The sentence of the text that it is made of.
    pub source: String,
    /// The line of the routine, from 1.
    pub line: u32,
}

/// The statements after their trial.
pub struct TriedStatements {
    /// By line of the routine: the reason why its statement is refused.
    pub refused: BTreeMap<u32, String>,
    resident: usize,
    /// The scenario with the others as the routine of the resident.
    accepted: Option<OpenScenario>,
}

impl StatementTrial {
    /// The trial of a resident by name, or of the first with a routine, or of the first.
    pub fn of_resident(opened: OpenScenario, name: Option<&str>) -> Result<StatementTrial, FreeTextError> {
        let residents = &opened.scenario().residents;
        let is_routine = |driver: &DriverFile| matches!(driver, DriverFile::Routine(_));
        let resident = match name {
            Some(name) => {
                residents.iter().position(|one| one.file.name.eq_ignore_ascii_case(name)).ok_or_else(|| {
                    let known = residents.iter().map(|one| one.file.name.clone()).collect();
                    FreeTextError::UnknownResident { name: name.to_owned(), known }
                })?
            }
            None if residents.is_empty() => {
                return Err(FreeTextError::NoResident { scenario: opened.name().to_owned() });
            }
            None => residents.iter().position(|one| is_routine(&one.file.driver)).unwrap_or(0),
        };
        let file = match &residents[resident].file.driver {
            DriverFile::Routine(file) => file.clone(),
            _ => format!("{}.routine", residents[resident].file.name.to_lowercase().replace([' ', '/', '\\'], "-")),
        };
        let trial = StatementTrial { opened, resident, file };
        // A home without room for a life refuses each statement for the same reason.
        trial.with_routine("").map_err(|problems| SimulationError::Problems(Problems(problems)))?;
        Ok(trial)
    }

    /// Reads statements in the order of their lines, and leaves out those that the reader refuses or understands in part only.
    pub fn read(&self, statements: &[PlacedStatement]) -> TriedStatements {
        let why = |statement: &PlacedStatement| Some((statement.line, misshapen(&statement.text)?));
        let mut refused: BTreeMap<u32, String> = statements.iter().filter_map(why).collect();
        let accepted = loop {
            let kept = statements.iter().filter(|statement| !refused.contains_key(&statement.line));
            let wrong: Vec<(u32, String)> = match self.with_routine(&text_of(kept)) {
                Ok(opened) => {
                    let wrong = self.unsimulated(&opened);
                    if wrong.is_empty() {
                        break Some(opened);
                    }
                    wrong
                }
                Err(problems) => problems.iter().filter_map(|problem| self.place_of(problem, statements)).collect(),
            };
            let count = refused.len();
            for (line, why) in wrong.into_iter().filter(|(line, _)| statements.iter().any(|of| of.line == *line)) {
                refused.entry(line).or_insert(why);
            }
            if refused.len() == count {
                break self.read_one_by_one(statements, &mut refused);
            }
        };
        TriedStatements { refused, resident: self.resident, accepted }
    }

    /// Reads each statement after those that were accepted, for problems that name no line.
    fn read_one_by_one(
        &self,
        statements: &[PlacedStatement],
        refused: &mut BTreeMap<u32, String>,
    ) -> Option<OpenScenario> {
        let (mut kept, mut accepted) = (Vec::new(), None);
        for statement in statements {
            if refused.contains_key(&statement.line) {
                continue;
            }
            kept.push(statement);
            let why = match self.with_routine(&text_of(kept.iter().copied())) {
                Ok(opened) => match self.unsimulated(&opened).pop() {
                    Some((_, why)) => why,
                    None => {
                        accepted = Some(opened);
                        continue;
                    }
                },
                Err(problems) => problems.first().map(|of| naming(&of.text(), statements)).unwrap_or_default(),
            };
            refused.insert(statement.line, why);
            kept.pop();
        }
        accepted
    }

    /// The scenario with a text as the routine of the resident.
    pub fn with_routine(&self, text: &str) -> Result<OpenScenario, Vec<Problem>> {
        let source = self.opened.source();
        let edit = self.opened.scenario().edit().routine(self.resident, &self.file, text);
        OpenScenario::from_files(&edit.over(source.files()), source.entry()).map_err(|problems| problems.0)
    }

    /// The line of the routine, and the problem with its hint.
    fn place_of(&self, problem: &Problem, statements: &[PlacedStatement]) -> Option<(u32, String)> {
        let is_own = problem.file == self.file && problem.line > 0;
        is_own.then(|| (problem.line, naming(&problem.text(), statements)))
    }

    /// The lines with words that are not simulated.
    fn unsimulated(&self, opened: &OpenScenario) -> Vec<(u32, String)> {
        let remarks = opened.household().routine(self.resident).map(|routine| &routine.remarks[..]).unwrap_or_default();
        let part = |text: &str| {
            let text = text.trim();
            format!("{text:?} is not simulated; hint: leave it out of the statement, and write it into cannot_be_said")
        };
        remarks.iter().map(|remark| (remark.line, part(&remark.text))).collect()
    }
}

impl TriedStatements {
    /// The meaning of the accepted statements.
    pub fn meanings(&self) -> Vec<ExplanationRow> {
        let routine = self.accepted.as_ref().and_then(|opened| opened.household().routine(self.resident));
        routine.map_or_else(Vec::new, |of| explain(of).sentences)
    }

    /// Simulates the accepted statements. Returns what did not happen as said, each with the line of its statement.
    ///
    /// # Errors
    ///
    /// The error of a run that stops, or [`SimulationError::Cancelled`].
    pub fn simulate(&self, cancel: &Cancel) -> Result<Vec<(u32, Difference)>, SimulationError> {
        let Some(opened) = &self.accepted else { return Ok(Vec::new()) };
        let mut run = opened.run().days(TRIAL_DAYS).cancel(cancel).start()?;
        while run.next_batch()?.is_some() {}
        if cancel.is_cancelled() {
            return Err(SimulationError::Cancelled);
        }
        // Without effect are the sentences without effect on a run of all days.
        let of_trial = run.differences().into_iter().filter(|of| !of.told);
        let without_effect = opened.household().predicted_differences(opened.scenario().file.days as i32);
        Ok(without_effect.into_iter().chain(of_trial).map(|of| (of.line, of)).collect())
    }
}

/// Each statement on its line.
fn text_of<'s>(statements: impl Iterator<Item = &'s PlacedStatement>) -> String {
    let mut text = String::new();
    let mut line = 1;
    for statement in statements {
        text += &"\n".repeat(statement.line.saturating_sub(line) as usize);
        text += &statement.text;
        line = statement.line;
    }
    text + "\n"
}

/// The text of a problem on one line, with the statements behind the numbers of their lines.
fn naming(problem: &str, statements: &[PlacedStatement]) -> String {
    let mut is_numbered = false;
    let words = problem.replace("\n  hint: ", "; hint: ");
    let named = words.split(' ').map(|word| {
        let number = word.trim_end_matches([',', ':', ';']);
        let statement = number.parse().ok().and_then(|line: u32| statements.iter().find(|one| one.line == line));
        let is_line = is_numbered && statement.is_some();
        is_numbered = matches!(word, "line" | "lines") || is_line && word.ends_with(',');
        match statement.filter(|_| is_line) {
            Some(PlacedStatement { text, source, .. }) => {
                format!("{number} ({text:?}, of source {source:?}){}", &word[number.len()..])
            }
            None => word.to_owned(),
        }
    });
    named.collect::<Vec<_>>().join(" ")
}

/// The reason why a text is no statement, whatever the language says: it could be a comment, or it could hide something.
fn misshapen(statement: &str) -> Option<String> {
    let note = |text: &str| text.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("note:"));
    let is_heading = |(at, _): (usize, &str)| !statement[at + 1..].starts_with(|c: char| c.is_ascii_digit());
    let why = match statement {
        _ if statement.chars().any(is_unseen) => "it has an invisible character",
        _ if statement.contains('#') || note(statement) => "it is a comment",
        // "Language: German" is one, too.
        _ if statement.match_indices(':').any(is_heading) => "it is a heading; hint: write one whole sentence",
        _ if statement.chars().count() > LONGEST_ENTRY => "it is too long; hint: write one deed a sentence",
        _ if !statement.chars().any(char::is_alphabetic) => "it has no words",
        _ => return None,
    };
    Some(why.to_owned())
}
