use crate::check;
use crate::engine::ENGINE;
use crate::messages::ScriptMessage;
use crate::moment::{Around, Constants};
use crate::names::{BEGIN, NEXT, NOTICE, ScriptNames};
use homebody_core::problem::{Diagnostic, Excerpt, Problem, readable};
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
    /// Reads and checks a script.
    ///
    /// # Errors
    ///
    /// The problems of the text, each with its position.
    pub fn read(file: &str, text: &str, names: &ScriptNames) -> Result<Program, Vec<Problem>> {
        let at = |position, message: Diagnostic| problem(file, text, position, 1, message);
        let ast = match ENGINE.compile(text) {
            Ok(ast) => ast,
            Err(error) => {
                return Err(vec![at(error.position(), misspelt(error.err_type()).into())]);
            }
        };
        let mut report = |position, width, message: ScriptMessage| problem(file, text, position, width, message.into());
        let stray = check::stray(&ast, &mut report);
        if !stray.is_empty() {
            return Err(stray);
        }
        let constants = match constants(&ast) {
            Ok(constants) => constants,
            Err(error) => {
                let (position, message) = diagnostic(*error);
                return Err(vec![at(position, message)]);
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

    pub fn notices(&self) -> bool {
        self.notices
    }

    pub(crate) fn constants(&self) -> Constants {
        self.constants.clone()
    }

    pub(crate) fn begin(&self, around: &Around) -> Result<Dynamic, String> {
        if !has(&self.ast, BEGIN) {
            return Ok(Dynamic::from(Map::new()));
        }
        let options = CallFnOptions::new().eval_ast(false).with_tag(around.clone());
        let memory = ENGINE.call_fn_with_options::<Dynamic>(options, &mut Scope::new(), &self.ast, BEGIN, ());
        let memory = memory.map_err(|error| self.why(*error))?;
        if memory.is_map() { Ok(memory) } else { Err(self.at_function(BEGIN, ScriptMessage::NotAMap)) }
    }

    pub(crate) fn next(&self, around: &Around, memory: &mut Dynamic) -> Result<Dynamic, String> {
        self.ask(NEXT, around, memory)
    }

    pub(crate) fn notice(&self, around: &Around, memory: &mut Dynamic) -> Result<Dynamic, String> {
        self.ask(NOTICE, around, memory)
    }

    fn ask(&self, function: &str, around: &Around, memory: &mut Dynamic) -> Result<Dynamic, String> {
        let options = CallFnOptions::new().eval_ast(false).bind_this_ptr(memory).with_tag(around.clone());
        let argument = (around.clone(),);
        let answer = ENGINE.call_fn_with_options::<Dynamic>(options, &mut Scope::new(), &self.ast, function, argument);
        answer.map_err(|error| self.why(*error))
    }

    /// The text of an error, with its position.
    pub(crate) fn why(&self, error: EvalAltResult) -> String {
        let (position, message) = diagnostic(error);
        let position = if position.is_none() { self.function(NEXT) } else { position };
        shown(&problem(&self.file, &self.text, position, 1, message))
    }

    pub(crate) fn answered(&self, error: EvalAltResult) -> String {
        let (_, message) = diagnostic(error);
        shown(&problem(&self.file, &self.text, self.function(NEXT), 1, message))
    }

    /// A problem of all decisions, and not of a line.
    pub(crate) fn at_next(&self, message: ScriptMessage) -> String {
        self.at_function(NEXT, message)
    }

    fn at_function(&self, name: &str, message: ScriptMessage) -> String {
        shown(&problem(&self.file, &self.text, self.function(name), 1, message.into()))
    }

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

/// All variables that remain after evaluation.
fn constants(ast: &AST) -> Result<BTreeMap<String, Dynamic>, Box<EvalAltResult>> {
    let mut scope = Scope::new();
    ENGINE.run_ast_with_scope(&mut scope, ast)?;
    Ok(scope.iter().map(|(name, _, value)| (name.to_owned(), value)).collect())
}

fn problem(file: &str, text: &str, position: Position, width: usize, message: Diagnostic) -> Problem {
    let problem = Problem::of_file(file, message, None);
    let Some(line) = position.line() else { return problem };
    let column = position.position().unwrap_or(1);
    let said = text.lines().nth(line - 1).unwrap_or_default();
    let at = said.char_indices().nth(column - 1).map_or(said.len(), |(at, _)| at);
    let excerpt = Some(Excerpt::around(said, at).underlining(width));
    Problem { line: line as u32, column: column as u32, excerpt, ..problem }
}

/// As text: position, code, message and hint.
fn shown(problem: &Problem) -> String {
    let place = match problem.line {
        0 => problem.file.clone(),
        line => format!("{}:{line}:{}", problem.file, problem.column),
    };
    readable(format!("{place}: {}{}", problem.label(), problem.text()))
}

fn misspelt(error: &ParseErrorType) -> ScriptMessage {
    let text = error.to_string();
    let help = match () {
        () if text.contains("eval") => Some("write the statements themselves: there is no eval".to_owned()),
        () if text.contains("**") => Some("multiply instead: there is no **".to_owned()),
        () => None,
    };
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_lowercase().to_string()).unwrap_or_default();
    ScriptMessage::Syntax { what: format!("{first}{}", letters.as_str()), help }
}

fn diagnostic(error: EvalAltResult) -> (Position, Diagnostic) {
    use EvalAltResult as Raised;
    let position = error.position();
    let message = match error {
        Raised::ErrorInFunctionCall(_, _, inner, at) => {
            let (position, message) = diagnostic(*inner);
            return (if position.is_none() { at } else { position }, message);
        }
        Raised::ErrorRuntime(value, _) => {
            if let Some(message) = value.clone().try_cast::<Diagnostic>() {
                return (position, message);
            }
            let what = value.into_string().unwrap_or_else(|of| format!("it throws a value of the type {of}"));
            ScriptMessage::Failed { what }
        }
        Raised::ErrorTooManyOperations(_) | Raised::ErrorTerminated(..) => {
            ScriptMessage::SlowDecision { most: crate::engine::MOST_OPERATIONS }
        }
        Raised::ErrorStackOverflow(_) => ScriptMessage::DeepCalls,
        Raised::ErrorPropertyNotFound(name, _) => ScriptMessage::NotRemembered { name },
        Raised::ErrorVariableNotFound(name, _) => ScriptMessage::UnknownVariable { name, near: None },
        Raised::ErrorFunctionNotFound(signature, _) if signature.contains("()") => {
            ScriptMessage::MissingValue { signature }
        }
        Raised::ErrorFunctionNotFound(name, _) => ScriptMessage::UnknownFunction { name, help: None },
        mut other => {
            other.clear_position();
            let mut what = other.to_string();
            if let Some(first) = what.get(..1) {
                what = first.to_lowercase() + &what[1..];
            }
            ScriptMessage::Failed { what }
        }
    };
    (position, message.into())
}
