//! The acceptance of lines, one by one in a terminal.

use crate::failure::Failure;
use crate::print::print_text;
use homebody_life::LifeDraft;
use std::io::{BufRead, Write};

/// By line: whether it was accepted. `None` if the person quits.
pub fn accept(draft: &LifeDraft, answers: &mut dyn BufRead) -> Result<Option<Vec<bool>>, Failure> {
    let mut accepted = vec![false; draft.lines.len()];
    let mut is_all = false;
    for (index, line) in draft.lines.iter().enumerate() {
        if line.accepted().next().is_none() {
            continue;
        }
        if is_all {
            accepted[index] = true;
            continue;
        }
        print_text(&format!("\n{}", line.row()))?;
        match asked(answers)? {
            LineAnswer::Yes => accepted[index] = true,
            LineAnswer::No => {}
            LineAnswer::All => (accepted[index], is_all) = (true, true),
            LineAnswer::Quit => return Ok(None),
        }
    }
    Ok(Some(accepted))
}

#[derive(Clone, Copy)]
enum LineAnswer {
    Yes,
    No,
    All,
    Quit,
}

/// Asks until the answer is clear. The end of the input quits.
fn asked(answers: &mut dyn BufRead) -> Result<LineAnswer, Failure> {
    loop {
        print_text("accept these statements? [y]es, [n]o, [a]ll, [q]uit: ")?;
        let _ = std::io::stdout().flush();
        let mut answer = String::new();
        if answers.read_line(&mut answer).unwrap_or(0) == 0 {
            return Ok(LineAnswer::Quit);
        }
        match answer.trim().to_lowercase().as_str() {
            "y" | "yes" => return Ok(LineAnswer::Yes),
            "n" | "no" => return Ok(LineAnswer::No),
            "a" | "all" => return Ok(LineAnswer::All),
            "q" | "quit" => return Ok(LineAnswer::Quit),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homebody_life::{DraftLine, DraftStatement};

    fn accepted(answers: &str) -> Option<Vec<bool>> {
        let line = |refused: Option<&str>| DraftLine {
            statements: vec![DraftStatement {
                text: "She naps.".into(),
                refused: refused.map(str::to_owned),
                ..DraftStatement::default()
            }],
            ..DraftLine::default()
        };
        let lines = vec![line(None), line(Some("no")), line(None), line(None)];
        let draft = LifeDraft { lines, ..LifeDraft::default() };
        accept(&draft, &mut answers.as_bytes()).unwrap_or_else(|_| panic!("{answers:?}"))
    }

    #[test]
    fn lines_are_accepted_one_by_one() {
        assert_eq!(accepted("y\nn\ny\n"), Some(vec![true, false, false, true]));
        assert_eq!(accepted("n\nwhat?\nALL\n"), Some(vec![false, false, true, true]));
        assert_eq!(accepted("y\nq\n"), None);
        assert_eq!(accepted("y\n"), None, "the end of the input accepts nothing");
    }
}
