//! All problems of the files of a scenario, in one list.

use crate::problem::{Diagnose, Diagnostic, MOST_PER_FILE, MOST_PER_URL, Problem, counted};
use serde::Serialize;
use std::fmt;

crate::messages! {
    /// Remarks on a list of problems.
    pub enum ProblemsMessage in "problems" {
        /// A file with very many problems would hide those of other files, so only its first problems are shown. Solve these and check
        /// the scenario again.
        More {
            /// The number of problems that are not shown.
            count: usize,
        } error "more" ("there are {more}", more = counted(*count, "more problem", "more problems"))
            hint ("solve the problems above, and check again");
    }
}

/// Everything that is wrong, in the order of files and places.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Problems(pub Vec<Problem>);

impl Problems {
    /// The first [`MOST_PER_FILE`] problems of each file and a count of the others. The problems of a file must follow each other.
    pub fn truncated(problems: &[Problem]) -> Problems {
        Problems::first(problems, MOST_PER_FILE)
    }

    fn first(problems: &[Problem], most: usize) -> Problems {
        let mut kept = Vec::new();
        for of_file in problems.chunk_by(|a, b| a.file == b.file) {
            kept.extend_from_slice(&of_file[..of_file.len().min(most)]);
            if of_file.len() > most {
                let more = ProblemsMessage::More { count: of_file.len() - most };
                kept.push(Problem::of_file(&of_file[0].file, more, None));
            }
        }
        Problems(kept)
    }

    /// All problems as plain text, each with its source line and carets under the place.
    pub fn render(&self) -> String {
        self.0.iter().map(Problem::render).collect::<Vec<_>>().join("\n")
    }
}

/// The problems of a URL, collected while it is read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct UrlProblems {
    /// The URL without a password, as problems quote it; empty where they do not.
    pub place: String,
    all: Vec<Problem>,
}

impl UrlProblems {
    /// Adds a problem. The message may quote any part of the URL but a password.
    pub fn add(&mut self, message: impl Into<Diagnostic>) {
        self.all.push(Problem::of_file(&self.place, message, None));
    }

    /// Ends the collection.
    ///
    /// # Errors
    ///
    /// The first [`MOST_PER_URL`] problems and a count of the others.
    pub fn refuse(self) -> Result<(), Problems> {
        if self.all.is_empty() { Ok(()) } else { Err(Problems::first(&self.all, MOST_PER_URL)) }
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (index, problem) in self.0.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Problems {}

impl Diagnose for Problems {
    fn diagnostic(&self) -> Diagnostic {
        match &self.0[..] {
            [one] => one.clone(),
            _ => self.to_string().into(),
        }
    }
}
