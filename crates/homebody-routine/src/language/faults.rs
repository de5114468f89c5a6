//! The problems of a text, collected while it is read and reported with line, column and underline.

use super::words::{TextLine, TextSpan};
use homebody_core::nearest::nearest;
use homebody_core::problem::{Advice, Diagnostic, Excerpt, Problem};
use homebody_core::problems::ProblemsMessage;

/// Number of problems above which they are counted instead of listed.
pub const MOST: usize = 100;

#[derive(Clone, Debug, PartialEq)]
pub struct TextFault {
    pub span: TextSpan,
    pub message: Diagnostic,
}

#[derive(Debug, Default)]
pub struct Faults {
    list: Vec<TextFault>,
    more: usize,
}

impl Faults {
    pub fn add(&mut self, span: TextSpan, message: impl Into<Diagnostic>) {
        if self.list.len() < MOST {
            self.list.push(TextFault { span, message: message.into() });
        } else {
            self.more += 1;
        }
    }

    pub fn count(&self) -> usize {
        self.list.len() + self.more
    }

    pub fn problems(mut self, file: &str, lines: &[TextLine]) -> Vec<Problem> {
        self.list.sort_by_key(|fault| fault.span);
        let mut problems: Vec<Problem> = self.list.into_iter().map(|fault| problem(file, lines, fault)).collect();
        if self.more > 0 {
            problems.push(Problem::of_file(file, ProblemsMessage::More { count: self.more }, None));
        }
        problems
    }
}

fn problem(file: &str, lines: &[TextLine], fault: TextFault) -> Problem {
    let index = lines.partition_point(|line| line.start <= fault.span.start).saturating_sub(1);
    let Some(line) = lines.get(index) else { return Problem::of_file(file, fault.message, None) };
    let within = |at: usize| at.saturating_sub(line.start).min(line.text.len());
    let (start, end) = (within(fault.span.start), within(fault.span.end));
    let column = line.text.get(..start).map_or(0, |before| before.chars().count()) as u32 + 1;
    let width = line.text.get(start..end).map_or(1, |words| words.chars().count());
    let excerpt = Some(Excerpt::around(line.text, start).underlining(width));
    Problem { line: index as u32 + 1, column, excerpt, ..Problem::of_file(file, fault.message, None) }
}

pub fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a str> + Clone) -> Option<Advice> {
    const FEW: usize = 12;
    const LONGEST: usize = 60;
    if name.len() <= LONGEST
        && let Some(near) = nearest(name, known.clone())
    {
        return Some(Advice::meant(near));
    }
    let mut names: Vec<String> = known.map(|name| format!("{name:?}")).collect();
    names.sort();
    names.dedup();
    let more = names.len() > FEW;
    names.truncate(FEW);
    if more {
        names.push("...".into());
    }
    (!names.is_empty()).then(|| format!("there are {}", names.join(", ")).into())
}
