//! The trial of statements in their home: the strict reader, then some simulated days.

use crate::messages::FreeTextError;
use crate::model_answer::LONGEST_ENTRY;
use homebody_core::problem::{Problem, Problems, is_unseen};
use homebody_core::resident::DriverFile;
use homebody_routine::behaviour::difference::Difference;
use homebody_routine::explain::{ExplanationRow, explain};
use homebody_simulation::{Cancel, OpenScenario, SimulationError};

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

/// The statements after their trial.
pub struct TriedStatements {
    /// By statement: the reason why it is refused.
    pub refused: Vec<Option<String>>,
    resident: usize,
    /// The scenario with the others as the routine of the resident, and the statement of each line of the routine.
    accepted: Option<(OpenScenario, Vec<usize>)>,
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

    /// Reads statements, and leaves out those that the reader refuses or understands in part only.
    pub fn read(&self, statements: &[String]) -> TriedStatements {
        let mut refused: Vec<Option<String>> = statements.iter().map(|statement| misshapen(statement)).collect();
        loop {
            let kept: Vec<usize> = (0..statements.len()).filter(|&index| refused[index].is_none()).collect();
            let wrong = match self.with_routine(&text_of(statements, &kept)) {
                Ok(opened) => {
                    let wrong = self.unsimulated(&opened);
                    if wrong.is_empty() {
                        return TriedStatements { refused, resident: self.resident, accepted: Some((opened, kept)) };
                    }
                    wrong
                }
                Err(problems) => problems.iter().filter_map(|problem| self.place_of(problem)).collect(),
            };
            let mut are_some = false;
            for (line, why) in wrong {
                if let Some(reason) = kept.get(line).and_then(|&index| refused.get_mut(index)) {
                    reason.get_or_insert(why);
                    are_some = true;
                }
            }
            if !are_some {
                return self.read_one_by_one(statements, refused);
            }
        }
    }

    /// Reads each statement after those that were accepted, for problems that name no line.
    fn read_one_by_one(&self, statements: &[String], mut refused: Vec<Option<String>>) -> TriedStatements {
        let (mut kept, mut accepted) = (Vec::new(), None);
        for (index, reason) in refused.iter_mut().enumerate().filter(|(_, reason)| reason.is_none()) {
            kept.push(index);
            let why = match self.with_routine(&text_of(statements, &kept)) {
                Ok(opened) => match self.unsimulated(&opened).pop() {
                    Some((_, why)) => why,
                    None => {
                        accepted = Some((opened, kept.clone()));
                        continue;
                    }
                },
                Err(problems) => problems.first().map(Problem::text).unwrap_or_default(),
            };
            *reason = Some(why);
            kept.pop();
        }
        TriedStatements { refused, resident: self.resident, accepted }
    }

    /// The scenario with a text as the routine of the resident.
    pub fn with_routine(&self, text: &str) -> Result<OpenScenario, Vec<Problem>> {
        let source = self.opened.source();
        let edit = self.opened.scenario().edit().routine(self.resident, &self.file, text);
        OpenScenario::from_files(&edit.over(source.files()), source.entry()).map_err(|problems| problems.0)
    }

    /// The line of the routine, from 0, and the problem with its hint.
    fn place_of(&self, problem: &Problem) -> Option<(usize, String)> {
        let is_own = problem.file == self.file && problem.line > 0;
        is_own.then(|| (problem.line as usize - 1, problem.text().replace("\n  hint: ", "; hint: ")))
    }

    /// The lines with words that are not simulated.
    fn unsimulated(&self, opened: &OpenScenario) -> Vec<(usize, String)> {
        let remarks = opened.household().routine(self.resident).map(|routine| &routine.remarks[..]).unwrap_or_default();
        let part = |text: &str| {
            let text = text.trim();
            format!("{text:?} is not simulated; hint: leave it out of the statement, and write it into cannot_be_said")
        };
        remarks.iter().map(|remark| (remark.line as usize - 1, part(&remark.text))).collect()
    }
}

impl TriedStatements {
    /// The meaning of the accepted statements, each with its statement.
    pub fn meanings(&self) -> Vec<(usize, ExplanationRow)> {
        let Some((opened, kept)) = &self.accepted else { return Vec::new() };
        let rows = opened.household().routine(self.resident).map_or_else(Vec::new, |of| explain(of).sentences);
        let of_statement = |row: ExplanationRow| {
            let index = *kept.get(row.line.checked_sub(1)? as usize)?;
            Some((index, ExplanationRow { line: index as u32 + 1, ..row }))
        };
        rows.into_iter().filter_map(of_statement).collect()
    }

    /// Simulates the accepted statements. Returns what did not happen as said, each with its statement.
    ///
    /// # Errors
    ///
    /// The error of a run that stops, or [`SimulationError::Cancelled`].
    pub fn simulate(&self, cancel: &Cancel) -> Result<Vec<(usize, Difference)>, SimulationError> {
        let Some((opened, kept)) = &self.accepted else { return Ok(Vec::new()) };
        let mut run = opened.run().days(TRIAL_DAYS).cancel(cancel).start()?;
        while run.next_batch()?.is_some() {}
        if cancel.is_cancelled() {
            return Err(SimulationError::Cancelled);
        }
        let of_statement = |of: Difference| Some((*kept.get(of.line.checked_sub(1)? as usize)?, of));
        // Without effect are the sentences without effect on a run of all days.
        let of_trial = run.differences().into_iter().filter(|of| !of.told);
        let without_effect = opened.household().predicted_differences(opened.scenario().file.days as i32);
        Ok(without_effect.into_iter().chain(of_trial).filter_map(of_statement).collect())
    }
}

/// One statement a line.
fn text_of(statements: &[String], kept: &[usize]) -> String {
    kept.iter().map(|&index| format!("{}\n", statements[index])).collect()
}

/// The reason why a text is no statement, whatever the language says: it could be a comment, or it could hide something.
fn misshapen(statement: &str) -> Option<String> {
    let note = |text: &str| text.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("note:"));
    let why = match statement {
        _ if statement.chars().any(is_unseen) => "it has an invisible character",
        _ if statement.contains('#') || note(statement) => "it is a comment",
        _ if statement.chars().count() > LONGEST_ENTRY => "it is too long; hint: write one deed a sentence",
        _ if !statement.chars().any(char::is_alphabetic) => "it has no words",
        _ => return None,
    };
    Some(why.to_owned())
}
