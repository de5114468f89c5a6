//! The properties of all error messages.

use homebody_core::problem::Problem;
use homebody_simulation::SimulationError;
use std::collections::BTreeMap;

/// Largest length of a line of a message, in bytes (our choice): a quoted text may have any length.
const LONGEST_LINE_BYTES: usize = 2_000;

/// Largest length of a message, in bytes (our choice): some list a hundred places.
const LONGEST_BYTES: usize = 32 << 10;

/// Checks that an error gives place and reason.
pub fn error(error: &SimulationError, texts: &BTreeMap<String, String>) -> Result<(), String> {
    match error {
        SimulationError::Problems(problems) if problems.0.is_empty() => Err("it is refused, without a reason".into()),
        SimulationError::Problems(problems) => {
            // As the command prints it.
            let _ = problems.render();
            problems.0.iter().try_for_each(|problem| self::problem(problem, texts))
        }
        other => message(&other.to_string()),
    }
}

/// Checks that the place of a problem exists.
pub fn problem(problem: &Problem, texts: &BTreeMap<String, String>) -> Result<(), String> {
    let lacks = |what: &str| Err(format!("a problem {what}: {problem:?}"));
    if problem.file.is_empty() || problem.what.is_empty() {
        return lacks("without a file, or without words");
    }
    if problem.code == "schema::invalid" {
        return lacks("that the schema lets through");
    }
    if let (Some(text), true) = (texts.get(&problem.file), problem.line > 0) {
        let lines = 1 + text.matches(['\n', '\r']).count();
        if problem.line as usize > lines || problem.column == 0 {
            return lacks("beyond its file");
        }
    }
    for text in [Some(&problem.what), problem.hint.as_ref()].into_iter().flatten() {
        message(text)?;
    }
    Ok(())
}

/// Checks the readability of an error.
pub fn refusal(error: &impl std::fmt::Display) -> Result<(), String> {
    message(&error.to_string())
}

/// Checks the readability of a message.
pub fn message(text: &str) -> Result<(), String> {
    let beginning: String = text.chars().take(200).collect();
    if text.trim().is_empty() {
        return Err("an error without words".into());
    }
    if text.len() > LONGEST_BYTES || text.lines().any(|line| line.len() > LONGEST_LINE_BYTES) {
        return Err(format!("a message of {} bytes: {beginning:?} ...", text.len()));
    }
    if text.chars().any(|c| c.is_control() && c != '\n') {
        return Err(format!("a control character in a message: {beginning:?}"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_without_a_place_is_found() {
        let texts: BTreeMap<String, String> = [("a.json".to_owned(), "{\n}".to_owned())].into();
        let good = Problem { line: 2, column: 1, ..Problem::of_file("a.json", "it is wrong", None) };
        assert_eq!(problem(&good, &texts), Ok(()));
        for wrong in [
            Problem { file: String::new(), ..good.clone() },
            Problem { what: String::new(), ..good.clone() },
            Problem { line: 3, ..good.clone() },
            Problem { column: 0, ..good.clone() },
            Problem { hint: Some("a\u{1b}".into()), ..good.clone() },
            Problem { what: "x".repeat(2_001), ..good.clone() },
        ] {
            assert!(problem(&wrong, &texts).is_err(), "{wrong:?}");
        }
        assert!(error(&SimulationError::Problems(homebody_core::problem::Problems(Vec::new())), &texts).is_err());
    }
}
