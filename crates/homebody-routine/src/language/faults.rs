//! What is wrong with a text: collected while it is read, told with line, column and underline.

use super::words::{Line, Span};
use homebody_core::problem::{Advice, Diagnostic, Excerpt, Problem};
use homebody_core::problems::ProblemsMessage;
use homebody_core::scenario::nearest::nearest;

/// Number of problems above which they are counted instead of listed.
pub const MOST: usize = 100;

#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    pub span: Span,
    pub message: Diagnostic,
}

/// All that is wrong with one text.
#[derive(Debug, Default)]
pub struct Faults {
    /// Whether nobody will read what is added: hints need not be looked for.
    pub is_trial: bool,
    list: Vec<Fault>,
    more: usize,
}

impl Faults {
    /// For trying whether something is understood.
    pub fn of_trial() -> Faults {
        Faults { is_trial: true, ..Faults::default() }
    }

    pub fn add(&mut self, span: Span, message: impl Into<Diagnostic>) {
        if self.list.len() < MOST {
            // The words of a trial are never read.
            let message = if self.is_trial { Diagnostic::default() } else { message.into() };
            self.list.push(Fault { span, message });
        } else {
            self.more += 1;
        }
    }

    pub fn count(&self) -> usize {
        self.list.len() + self.more
    }

    /// Takes back what was added since there were so many.
    pub fn forget_since(&mut self, count: usize) {
        let listed = count.min(self.list.len());
        self.list.truncate(listed);
        self.more = count - listed;
    }

    /// What was added since there were so many.
    pub fn since(&mut self, count: usize) -> &mut [Fault] {
        let listed = count.min(self.list.len());
        &mut self.list[listed..]
    }

    /// The problems in the order of their places.
    pub fn problems(mut self, file: &str, lines: &[Line]) -> Vec<Problem> {
        self.list.sort_by_key(|fault| fault.span);
        let mut problems: Vec<Problem> = self.list.into_iter().map(|fault| problem(file, lines, fault)).collect();
        if self.more > 0 {
            problems.push(Problem::of_file(file, ProblemsMessage::More { count: self.more }, None));
        }
        problems
    }
}

fn problem(file: &str, lines: &[Line], fault: Fault) -> Problem {
    let index = lines.partition_point(|line| line.start <= fault.span.start).saturating_sub(1);
    let Some(line) = lines.get(index) else { return Problem::of_file(file, fault.message, None) };
    let within = |at: usize| at.saturating_sub(line.start).min(line.text.len());
    let (start, end) = (within(fault.span.start), within(fault.span.end));
    let column = line.text.get(..start).map_or(0, |before| before.chars().count()) as u32 + 1;
    let width = line.text.get(start..end).map_or(1, |words| words.chars().count());
    let excerpt = Some(Excerpt::around(line.text, start).underlining(width));
    Problem { line: index as u32 + 1, column, excerpt, ..Problem::of_file(file, fault.message, None) }
}

/// The known name that was probably meant, or the names that there are.
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
