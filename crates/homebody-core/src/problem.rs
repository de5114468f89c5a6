//! What is wrong with what a user wrote: all of it at once, each with its place and a hint.

use serde::Serialize;
use std::fmt;

/// One thing that is wrong, where, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Problem {
    /// The file, as the scenario names it.
    pub file: String,
    /// Line, counted from 1; 0 where the problem is with the file as a whole.
    pub line: u32,
    /// Column in characters, counted from 1; 0 where the problem is with the file as a whole.
    pub column: u32,
    /// What is wrong.
    pub what: String,
    /// What to do, such as the nearest known name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// The line of the file, where the problem is on a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub excerpt: Option<Excerpt>,
}

/// The part of a source line around a problem.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Excerpt {
    /// The text, without control characters.
    pub text: String,
    /// How many characters of the text come before the problem.
    pub before: u32,
    /// How many characters the problem is about, at least one.
    #[serde(skip_serializing_if = "is_one")]
    pub width: u32,
}

fn is_one(width: &u32) -> bool {
    *width == 1
}

/// Everything that is wrong, in the order of files and places.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Problems(pub Vec<Problem>);

impl Problems {
    /// Of each file, whose problems stand together, no more than anybody reads, and how many more there are.
    pub fn truncated(problems: &[Problem]) -> Problems {
        /// A file that is wrong throughout would bury the others.
        const MOST_PER_FILE: usize = 100;
        let mut kept = Vec::new();
        for of_file in problems.chunk_by(|a, b| a.file == b.file) {
            kept.extend_from_slice(&of_file[..of_file.len().min(MOST_PER_FILE)]);
            if of_file.len() > MOST_PER_FILE {
                let what = format!("there are {} more problems", of_file.len() - MOST_PER_FILE);
                kept.push(Problem::of_file(&of_file[0].file, what, None));
            }
        }
        Problems(kept)
    }

    /// All problems as plain text, each with its source line and carets under the place.
    pub fn render(&self) -> String {
        self.0.iter().map(Problem::render).collect::<Vec<_>>().join("\n")
    }
}

impl Problem {
    /// A problem with a file as a whole.
    pub fn of_file(file: &str, what: impl Into<String>, hint: Option<String>) -> Problem {
        Problem { file: file.into(), line: 0, column: 0, what: what.into(), hint, excerpt: None }
    }

    fn render(&self) -> String {
        let mut text = format!("{}\n", self.headline());
        if let Some(excerpt) = &self.excerpt {
            text += &format!("{:>5} | {}\n", self.line, excerpt.text);
            let (before, carets) = (" ".repeat(excerpt.before as usize), "^".repeat(excerpt.width as usize));
            text += &format!("{:>5} | {before}{carets}\n", "");
        }
        if let Some(hint) = &self.hint {
            text += &format!("  hint: {hint}\n");
        }
        text
    }

    fn headline(&self) -> String {
        match self.line {
            0 => format!("{}: {}", self.file, self.what),
            line => format!("{}:{line}:{}: {}", self.file, self.column, self.what),
        }
    }
}

impl Excerpt {
    /// Cuts a line to what fits beside a line number, with the column (counted from 1) in sight.
    pub fn new(line: &str, column: u32) -> Excerpt {
        const WIDTH: usize = 120;
        const BEFORE: usize = 80;
        let place = (column as usize).saturating_sub(1);
        let start = if line.chars().count() <= WIDTH { 0 } else { place.saturating_sub(BEFORE) };
        let text = line.chars().skip(start).take(WIDTH).map(|c| if c.is_control() { ' ' } else { c }).collect();
        Excerpt { text, before: (place - start) as u32, width: 1 }
    }

    /// The same with so many characters underlined, as far as they are in sight.
    pub fn underlining(self, width: usize) -> Excerpt {
        let left = self.text.chars().count().saturating_sub(self.before as usize);
        Excerpt { width: width.min(left).max(1) as u32, ..self }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.headline())?;
        match &self.hint {
            Some(hint) => write!(f, "\n  hint: {hint}"),
            None => Ok(()),
        }
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

/// How many of what, as a sentence has it.
pub fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
