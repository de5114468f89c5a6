//! The lines of an answer after they were checked: what the reader refuses, what a simulation did otherwise.

use crate::messages::FreeTextWarning;
use crate::trial::TriedStatements;
use homebody_core::messages::Diagnose;
use homebody_core::problem::Diagnostic;
use homebody_routine::behaviour::difference::Difference;
use homebody_routine::explain::ExplanationRow;
use serde::Serialize;

/// A routine in the making, line by line.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct LifeDraft {
    /// In the order of the answer.
    pub lines: Vec<DraftLine>,
    /// Sentences of the text that no line quotes.
    pub left_out: Vec<String>,
    /// The reason why a run with all statements stops.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run_stops: Option<String>,
    /// Whether it was simulated.
    pub is_simulated: bool,
}

/// A source, and the statements that are made of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DraftLine {
    /// As the model quotes it.
    pub source: String,
    /// Whether the text has such a sentence.
    pub is_in_text: bool,
    /// Sentences of the routine language.
    pub statements: Vec<DraftStatement>,
    /// Choices of the model where the text leaves something open.
    pub assumed: Vec<String>,
    /// The parts that the language cannot say.
    pub cannot_be_said: Vec<String>,
    /// The list of the answer that has the statement of this line, where nothing is simulated; `None` for "statements".
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stands_under: Option<&'static str>,
}

/// A sentence of the routine language, or one that the reader refuses.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DraftStatement {
    /// The sentence.
    pub text: String,
    /// Its line in the routine that is made of the answer.
    pub line: u32,
    /// The reason why it is refused.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
    /// Its meaning, as canonical sentences with their numbers, and as data; empty if it is refused.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub meaning: Vec<ExplanationRow>,
    /// The difference between the statement and its simulation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub difference: Option<Difference>,
}

impl LifeDraft {
    /// The statement at a line of the routine.
    pub(crate) fn at(&mut self, line: u32) -> Option<&mut DraftStatement> {
        self.lines.iter_mut().flat_map(|of| &mut of.statements).find(|statement| statement.line == line)
    }

    /// Takes the result of a trial: the refusals and the meanings.
    pub(crate) fn take(&mut self, tried: &TriedStatements) {
        for (line, why) in &tried.refused {
            self.at(*line).into_iter().for_each(|statement| statement.refused = Some(why.clone()));
        }
        for meaning in tried.meanings() {
            self.at(meaning.line).into_iter().for_each(|statement| statement.meaning.push(meaning.clone()));
        }
    }

    /// The corrections that the model has to make: refused statements, sentences without a line, lines without a sentence.
    pub fn problems(&self) -> Vec<String> {
        let refused = self.lines.iter().flat_map(|line| {
            let of_line = line.statements.iter().filter_map(|statement| Some((statement, statement.refused.as_ref()?)));
            of_line.map(|(statement, why)| {
                format!("Of source {:?}: the statement {:?} is refused: {why}", line.source, statement.text)
            })
        });
        let misplaced = self.misplaced().map(|(line, list, statement)| {
            format!(
                "Of source {:?}: the sentence {statement:?} of the language stands under {list:?}, where nothing is simulated. Put \
                 it under \"statements\", or leave it out.",
                line.source
            )
        });
        let invented =
            self.invented().map(|line| format!("The text has no such sentence: {:?}. Remove the line.", line.source));
        let left_out = self.left_out.iter().map(|sentence| format!("Your answer has no line for: {sentence:?}"));
        let stops = self.run_stops.iter().map(|why| format!("With these statements the simulation stops: {why}"));
        refused.chain(misplaced).chain(invented).chain(left_out).chain(stops).collect()
    }

    /// Sentences of the language in a list of the answer that has none, with their lines and that list.
    pub fn misplaced(&self) -> impl Iterator<Item = (&DraftLine, &'static str, &str)> {
        let listed = self.lines.iter().filter_map(|line| Some((line, line.stands_under?)));
        listed.flat_map(|(line, list)| line.accepted().map(move |text| (line, list, text)))
    }

    fn invented(&self) -> impl Iterator<Item = &DraftLine> {
        self.lines.iter().filter(|line| !line.is_in_text && !line.statements.is_empty())
    }

    /// The differences between the statements and their simulation.
    pub fn differences(&self) -> Vec<String> {
        let of_line = |line: &DraftLine| {
            let all = line.statements.iter().filter_map(|statement| statement.difference.as_ref());
            let source = line.source.clone();
            all.map(move |of| {
                let Difference { text, expected, lived, .. } = of;
                format!("Of source {source:?}: {text:?}: expected {expected}; simulated {lived}")
            })
            .collect::<Vec<_>>()
        };
        self.lines.iter().flat_map(of_line).collect()
    }

    /// Warnings for the person who accepts lines.
    pub fn warnings(&self) -> Vec<Diagnostic> {
        let statements = self.lines.iter().flat_map(|line| &line.statements);
        let refused = statements.clone().filter_map(|statement| {
            let (line, statement, why) = (statement.line, statement.text.clone(), statement.refused.clone()?);
            Some(FreeTextWarning::Refused { line, statement, why })
        });
        let misplaced = self.misplaced().map(|(_, list, statement)| FreeTextWarning::Misplaced {
            statement: statement.to_owned(),
            list: list.to_owned(),
        });
        let differences = statements.filter_map(|statement| {
            let Difference { expected, lived, .. } = statement.difference.clone()?;
            Some(FreeTextWarning::NotAsSaid { statement: statement.text.clone(), expected, simulated: lived })
        });
        let invented = self.invented().map(|line| FreeTextWarning::NoSource { said: line.source.clone() });
        let left_out = self.left_out.iter().map(|sentence| FreeTextWarning::LeftOut { sentence: sentence.clone() });
        let stops = self.run_stops.iter().map(|why| FreeTextWarning::RunStops { why: why.clone() });
        let all = refused.chain(misplaced).chain(invented).chain(left_out).chain(stops).chain(differences);
        all.map(|warning| warning.diagnostic()).collect()
    }

    /// By line: whether a person who looks at no line accepts it. A sentence that the model did not mean as a statement needs a look.
    pub fn usable(&self) -> Vec<bool> {
        self.lines.iter().map(|line| line.stands_under.is_none() && line.accepted().next().is_some()).collect()
    }

    /// The number of problems, then that of differences: fewer is better.
    pub(crate) fn faults(&self) -> (usize, usize) {
        (self.problems().len(), self.differences().len())
    }
}

impl DraftLine {
    /// The statements that a routine can have.
    pub fn accepted(&self) -> impl Iterator<Item = &str> {
        self.statements.iter().filter(|statement| statement.refused.is_none()).map(|statement| statement.text.as_str())
    }
}
