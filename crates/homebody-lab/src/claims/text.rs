//! The claims of `claims.txt`: cases of sentences and their expected results.

use super::measure::ClaimMeasure;
use super::subject::{Filter, Subject};
use std::fmt::Write;

pub const CLAIMS: &str = include_str!("claims.txt");

/// The effects of conditions, by their sources.
pub const CONDITIONS: &str = include_str!("conditions.txt");

#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClaimCase {
    /// Counted from 1.
    pub line: usize,
    pub form: String,
    pub home: ClaimHome,
    /// The resident whose routine gets the sentences; the first resident without it.
    pub whose: Option<String>,
    /// True without the simple routine.
    pub alone: bool,
    /// The first day of the run, if it matters.
    pub start: Option<String>,
    /// Days to simulate, if the number matters.
    pub days: Option<i32>,
    pub said: Vec<String>,
    pub both: Vec<String>,
    pub claims: Vec<Claim>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClaimHome {
    #[default]
    Apartment,
    Couple,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    pub text: String,
    /// The source of the size, if the table names it.
    pub source: String,
    pub what: ClaimContent,
}

#[derive(Clone, Debug, PartialEq)]
pub enum ClaimContent {
    /// A warning before the run with these words.
    Told(String),
    Measured {
        of: Option<String>,
        subject: Subject,
        measure: ClaimMeasure,
        filter: Filter,
        beside: Beside,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beside {
    Itself,
    /// Divided by the value of the twin, whose routine lacks the sentences.
    ShareOfTwin,
    MoreThanTwin,
}

impl ClaimCase {
    pub fn read(text: &str) -> Result<Vec<ClaimCase>, String> {
        let mut cases: Vec<ClaimCase> = Vec::new();
        let (mut form, mut case) = (String::new(), ClaimCase::default());
        for (number, line) in text.lines().enumerate() {
            let trimmed = line.trim();
            let wrong = |why: String| format!("line {}: {why}: {trimmed:?}", number + 1);
            if trimmed.is_empty() || trimmed.starts_with('#') {
                finish(&mut cases, &mut case).map_err(wrong)?;
                if let Some(title) = trimmed.strip_prefix("## ") {
                    title.clone_into(&mut form);
                }
                continue;
            }
            if case.line == 0 {
                (case.line, case.form) = (number + 1, form.clone());
            }
            if let Some(claim) = trimmed.strip_prefix("= ") {
                case.claims.push(Claim::read(claim).map_err(wrong)?);
            } else if let Some(both) = trimmed.strip_prefix("+ ") {
                case.both.push(both.to_owned());
            } else if let Some(setting) = trimmed.strip_prefix("@ ") {
                case.set(setting).map_err(wrong)?;
            } else {
                case.said.push(line.to_owned());
            }
        }
        finish(&mut cases, &mut case).map_err(|why| format!("at the end: {why}"))?;
        Ok(cases)
    }

    fn set(&mut self, setting: &str) -> Result<(), String> {
        match setting.split_once(' ').unwrap_or((setting, "")) {
            ("alone", "") => self.alone = true,
            ("couple", who) => (self.home, self.whose) = (ClaimHome::Couple, Some(who.to_owned())),
            ("start", date) => self.start = Some(date.to_owned()),
            ("days", days) => self.days = Some(days.parse().map_err(|_| "a number of days is missing")?),
            _ => return Err("there is no such setting".into()),
        }
        Ok(())
    }

    pub fn sentence(&self) -> String {
        let words = self.said.iter().flat_map(|line| line.split_whitespace());
        words.fold(String::new(), |mut text, word| {
            let _ = write!(text, "{}{word}", if text.is_empty() { "" } else { " " });
            text
        })
    }

    pub fn has_twin(&self) -> bool {
        let needs =
            |claim: &Claim| matches!(&claim.what, ClaimContent::Measured { beside, .. } if *beside != Beside::Itself);
        self.claims.iter().any(needs)
    }
}

fn finish(cases: &mut Vec<ClaimCase>, case: &mut ClaimCase) -> Result<(), String> {
    let done = std::mem::take(case);
    match (done.line, done.said.is_empty(), done.claims.is_empty()) {
        (0, ..) => {}
        (line, true, _) => return Err(format!("the case of line {line} says nothing")),
        (line, _, true) => return Err(format!("the case of line {line} claims nothing")),
        _ => cases.push(done),
    }
    Ok(())
}

impl Claim {
    fn read(text: &str) -> Result<Claim, String> {
        let (text, source) = text.split_once(" ; ").unwrap_or((text, ""));
        let source = source.to_owned();
        let (subject, said) = text
            .strip_suffix(':')
            .map(|subject| (subject, ""))
            .or(text.split_once(": "))
            .ok_or("a colon is missing")?;
        if subject == "told" {
            return Ok(Claim { text: text.to_owned(), source, what: ClaimContent::Told(said.to_owned()) });
        }
        let (subject, of) = match subject.split_once(" of ") {
            Some((subject, of)) => (subject, Some(of.to_owned())),
            None => (subject, None),
        };
        let (said, filter) = Filter::read(said)?;
        let (said, beside) = if let Some(said) = said.strip_suffix(" of the twin") {
            (said, Beside::ShareOfTwin)
        } else if let Some(said) = said.strip_suffix(" more than the twin") {
            (said, Beside::MoreThanTwin)
        } else {
            (said, Beside::Itself)
        };
        let (subject, measure) = (Subject::read(subject), ClaimMeasure::read(said)?);
        Ok(Claim {
            text: text.to_owned(),
            source,
            what: ClaimContent::Measured { of, subject, measure, filter, beside },
        })
    }
}
