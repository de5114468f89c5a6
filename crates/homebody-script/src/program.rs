//! A script that was read and checked, and what becomes of it when it is asked.

use crate::check;
use crate::engine::ENGINE;
use crate::moment::{Around, Constants};
use crate::names::{BEGIN, NEXT, NOTICE, Names};
use homebody_core::problem::{Excerpt, Problem, readable};
use rhai::{AST, CallFnOptions, Dynamic, EvalAltResult, Map, ParseErrorType, Position, Scope};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A script that has passed its check.
#[derive(Clone, Debug)]
pub struct Program {
    file: String,
    text: String,
    ast: AST,
    constants: Constants,
    notices: bool,
}

impl Program {
    /// Reads a script, and says all that can be known to be wrong with it before a run.
    ///
    /// # Errors
    ///
    /// The problems of the text, each with its place.
    pub fn read(file: &str, text: &str, names: &Names) -> Result<Program, Vec<Problem>> {
        let at = |position, what: String, hint| problem(file, text, position, 1, what, hint);
        let ast = match ENGINE.compile(text) {
            Ok(ast) => ast,
            Err(error) => {
                let (what, hint) = misspelt(error.err_type());
                return Err(vec![at(error.position(), what, hint)]);
            }
        };
        let mut report = |position, width, what, hint| problem(file, text, position, width, what, hint);
        let stray = check::stray(&ast, &mut report);
        if !stray.is_empty() {
            return Err(stray);
        }
        let constants = match constants(&ast) {
            Ok(constants) => constants,
            Err(error) => {
                let (position, what, hint) = told(*error);
                return Err(vec![at(position, what, hint)]);
            }
        };
        let mut problems = check::check(&ast, &constants, names, &mut report);
        problems.sort_by_key(|problem| (problem.line, problem.column));
        if !problems.is_empty() {
            return Err(problems);
        }
        let notices = has(&ast, NOTICE);
        Ok(Program { file: file.into(), text: text.into(), ast, constants: Arc::new(constants), notices })
    }

    /// Whether it is to be asked when something has changed.
    pub fn notices(&self) -> bool {
        self.notices
    }

    /// The constants of the script.
    pub(crate) fn constants(&self) -> Constants {
        self.constants.clone()
    }

    /// What is remembered at the beginning.
    pub(crate) fn begin(&self, around: &Around) -> Result<Dynamic, String> {
        if !has(&self.ast, BEGIN) {
            return Ok(Dynamic::from(Map::new()));
        }
        let options = CallFnOptions::new().eval_ast(false).with_tag(around.clone());
        let memory = ENGINE.call_fn_with_options::<Dynamic>(options, &mut Scope::new(), &self.ast, BEGIN, ());
        let memory = memory.map_err(|error| self.why(*error))?;
        if memory.is_map() {
            Ok(memory)
        } else {
            Err(self.at_function(BEGIN, "begin() gives a map, such as #{ rounds: 0 }"))
        }
    }

    /// The answer to what comes next.
    pub(crate) fn next(&self, around: &Around, memory: &mut Dynamic) -> Result<Dynamic, String> {
        self.ask(NEXT, around, memory)
    }

    /// The answer to what has changed.
    pub(crate) fn notice(&self, around: &Around, memory: &mut Dynamic) -> Result<Dynamic, String> {
        self.ask(NOTICE, around, memory)
    }

    fn ask(&self, function: &str, around: &Around, memory: &mut Dynamic) -> Result<Dynamic, String> {
        let options = CallFnOptions::new().eval_ast(false).bind_this_ptr(memory).with_tag(around.clone());
        let argument = (around.clone(),);
        let answer = ENGINE.call_fn_with_options::<Dynamic>(options, &mut Scope::new(), &self.ast, function, argument);
        answer.map_err(|error| self.why(*error))
    }

    /// An error of a run, in words with its place.
    pub(crate) fn why(&self, error: EvalAltResult) -> String {
        let (position, what, hint) = told(error);
        let position = if position.is_none() { self.function(NEXT) } else { position };
        shown(&problem(&self.file, &self.text, position, 1, what, hint))
    }

    /// What is wrong with the answer of `next`.
    pub(crate) fn answered(&self, error: EvalAltResult) -> String {
        let (_, what, hint) = told(error);
        let position = self.function(NEXT);
        shown(&problem(&self.file, &self.text, position, 1, what, hint))
    }

    /// What is wrong with all of the decisions rather than with a line.
    pub(crate) fn at_next(&self, what: &str, hint: &str) -> String {
        shown(&problem(&self.file, &self.text, self.function(NEXT), 1, what.into(), Some(hint.into())))
    }

    fn at_function(&self, name: &str, what: &str) -> String {
        shown(&problem(&self.file, &self.text, self.function(name), 1, what.into(), None))
    }

    /// Where a function of the script begins.
    fn function(&self, name: &str) -> Position {
        let line = self.text.lines().position(|line| {
            let rest = line.trim_start().strip_prefix("fn ").map(str::trim_start);
            rest.is_some_and(|rest| rest.strip_prefix(name).is_some_and(|rest| rest.trim_start().starts_with('(')))
        });
        line.and_then(|line| u16::try_from(line + 1).ok()).map_or(Position::NONE, |line| Position::new(line, 1))
    }
}

fn has(ast: &AST, name: &str) -> bool {
    ast.iter_functions().any(|function| function.name == name)
}

/// The constants of a script, which are what it has besides functions.
fn constants(ast: &AST) -> Result<BTreeMap<String, Dynamic>, Box<EvalAltResult>> {
    let mut scope = Scope::new();
    ENGINE.run_ast_with_scope(&mut scope, ast)?;
    Ok(scope.iter().map(|(name, _, value)| (name.to_owned(), value)).collect())
}

/// A problem at a place of a script.
fn problem(file: &str, text: &str, position: Position, width: usize, what: String, hint: Option<String>) -> Problem {
    let problem = Problem::of_file(file, what, hint);
    let Some(line) = position.line() else { return problem };
    let column = position.position().unwrap_or(1);
    let said = text.lines().nth(line - 1).unwrap_or_default();
    let at = said.char_indices().nth(column - 1).map_or(said.len(), |(at, _)| at);
    let excerpt = Some(Excerpt::around(said, at).underlining(width));
    Problem { line: line as u32, column: column as u32, excerpt, ..problem }
}

/// A problem as it is told in the middle of a run.
fn shown(problem: &Problem) -> String {
    readable(problem.to_string())
}

/// What is wrong with a text that is no script.
fn misspelt(error: &ParseErrorType) -> (String, Option<String>) {
    let text = error.to_string();
    let hint = if text.contains("eval") {
        Some("say what is meant where it is meant: there is no eval".into())
    } else if text.contains("**") {
        Some("multiply instead: there is no **".into())
    } else {
        None
    };
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_lowercase().to_string()).unwrap_or_default();
    (format!("this is no script: {first}{}", letters.as_str()), hint)
}

/// Where an error was raised, what it says, and what can be done.
fn told(error: EvalAltResult) -> (Position, String, Option<String>) {
    use EvalAltResult as Raised;
    let position = error.position();
    match error {
        Raised::ErrorInFunctionCall(_, _, inner, at) => {
            let (position, what, hint) = told(*inner);
            (if position.is_none() { at } else { position }, what, hint)
        }
        Raised::ErrorRuntime(value, _) => {
            let text = value.into_string().unwrap_or_else(|of| format!("it throws a value of the type {of}"));
            match text.split_once("\n  hint: ") {
                Some((what, hint)) => (position, what.into(), Some(hint.into())),
                None => (position, text, None),
            }
        }
        Raised::ErrorTooManyOperations(_) | Raised::ErrorTerminated(..) => {
            let most = crate::engine::MOST_OPERATIONS;
            let hint = "end its loop, or spread the work over several decisions";
            (
                position,
                format!("the script runs away: it takes more than {most} operations to decide"),
                Some(hint.into()),
            )
        }
        Raised::ErrorStackOverflow(_) => {
            (position, "functions call each other too deep".into(), Some("let one of them end".into()))
        }
        Raised::ErrorPropertyNotFound(name, _) => {
            let hint = "give it a value in fn begin(), such as #{ rounds: 0 }";
            (position, format!("nothing is remembered as {name}"), Some(hint.into()))
        }
        Raised::ErrorVariableNotFound(name, _) => (position, format!("there is no variable {name}"), None),
        Raised::ErrorFunctionNotFound(signature, _) if signature.contains("()") => {
            let what = format!("a value is missing in {signature}: () is nothing");
            (position, what, Some("give what is remembered a value in fn begin(), such as #{ rounds: 0 }".into()))
        }
        Raised::ErrorFunctionNotFound(signature, _) => (position, format!("there is no function {signature}"), None),
        mut other => {
            other.clear_position();
            let mut text = other.to_string();
            if let Some(first) = text.get(..1) {
                text = first.to_lowercase() + &text[1..];
            }
            (position, text, None)
        }
    }
}
