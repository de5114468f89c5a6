//! The check of a script before a run: names, functions and literal values.

use crate::engine::standard_functions;
use crate::messages::ScriptMessage;
use crate::moment::{type_name, unknown_manner, unknown_name};
use crate::names::{ASKED, ScriptNames};
use crate::vocabulary::{self, ArgumentKind, QUESTIONS, SEEN, ScriptWord};
use homebody_core::nearest::nearest;
use homebody_core::problem::{Problem, counted};
use homebody_walk::manner::Manner;
use rhai::{AST, ASTFlags, ASTNode, Dynamic, Expr, FnCallExpr, Position, Stmt};
use std::collections::BTreeMap;

const AROUND: &str = "around";

/// Makes a problem of a position, a number of characters to underline, and a message.
pub type ProblemReporter<'a> = &'a mut dyn FnMut(Position, usize, ScriptMessage) -> Problem;

/// Statements outside of functions that define no constant.
pub fn stray(ast: &AST, report: ProblemReporter) -> Vec<Problem> {
    let is_constant = |stmt: &Stmt| matches!(stmt, Stmt::Var(_, flags, _) if flags.intersects(ASTFlags::CONSTANT));
    let wrong = ast.statements().iter().filter(|stmt| !is_constant(stmt) && !matches!(stmt, Stmt::Noop(_)));
    let mut problems: Vec<Problem> =
        wrong.map(|stmt| report(stmt.position(), 1, ScriptMessage::OutsideFunction)).collect();
    for stmt in ast.statements().iter().filter(|stmt| is_constant(stmt)) {
        if let Stmt::Var(var, ..) = stmt
            && !var.0.name.starts_with(|c: char| c.is_ascii_uppercase())
        {
            let name = &var.0.name;
            problems.push(report(var.0.pos, name.len(), ScriptMessage::ConstantName { name: name.to_string() }));
        }
    }
    problems
}

pub fn check(
    ast: &AST,
    constants: &BTreeMap<String, Dynamic>,
    names: &ScriptNames,
    report: ProblemReporter,
) -> Vec<Problem> {
    let functions = ast.iter_functions().map(|function| (function.name.to_owned(), function.params.len()));
    let mut check = ScriptCheck { functions: functions.collect(), constants, names, report, problems: Vec::new() };
    check.asked();
    ast.walk(&mut |path: &[ASTNode]| {
        match path.last() {
            Some(ASTNode::Expr(expr)) => check.expression(expr),
            Some(ASTNode::Stmt(Stmt::FnCall(call, position))) => check.call(call, *position),
            _ => {}
        }
        true
    });
    check.problems
}

struct ScriptCheck<'a> {
    /// The script's functions, with their numbers of parameters.
    functions: Vec<(String, usize)>,
    constants: &'a BTreeMap<String, Dynamic>,
    names: &'a ScriptNames,
    report: ProblemReporter<'a>,
    problems: Vec<Problem>,
}

impl ScriptCheck<'_> {
    fn say(&mut self, position: Position, width: usize, message: ScriptMessage) {
        let problem = (self.report)(position, width, message);
        self.problems.push(problem);
    }

    fn asked(&mut self) {
        for (name, wanted) in ASKED {
            let form = format!("fn {name}({})", if wanted == 1 { AROUND } else { "" });
            let found: Vec<usize> =
                self.functions.iter().filter(|(known, _)| known == name).map(|(_, count)| *count).collect();
            if found.is_empty() && name == ASKED[0].0 {
                self.say(Position::NONE, 1, ScriptMessage::NoNext { form });
            } else if !found.is_empty() && !found.contains(&wanted) {
                let (function, parameters) = (name.to_owned(), found[0]);
                self.say(Position::NONE, 1, ScriptMessage::Parameters { function, parameters, form });
            }
        }
    }

    fn expression(&mut self, expr: &Expr) {
        match expr {
            Expr::FnCall(call, position) => self.call(call, *position),
            Expr::MethodCall(call, position) => self.method(call, *position),
            Expr::Variable(of, None, position) if of.0.is_none() => self.variable(&of.1, *position),
            Expr::Dot(pair, ..) if matches!(&pair.lhs, Expr::Variable(of, ..) if of.1 == AROUND) => {
                let first = match &pair.rhs {
                    Expr::Dot(rest, ..) | Expr::Index(rest, ..) => &rest.lhs,
                    other => other,
                };
                if let Expr::Property(property, position) = first {
                    self.property(&property.2, *position);
                }
            }
            _ => {}
        }
    }

    fn variable(&mut self, name: &str, position: Position) {
        if self.constants.contains_key(name) {
            return;
        }
        let near = nearest(name, self.constants.keys().map(String::as_str)).map(str::to_owned);
        self.say(position, name.chars().count(), ScriptMessage::UnknownVariable { name: name.to_owned(), near });
    }

    fn property(&mut self, name: &str, position: Position) {
        if SEEN.iter().any(|(known, _)| *known == name) {
            return;
        }
        let help = if QUESTIONS.iter().any(|word| word.name == name) {
            format!("write it with brackets: around.{name}(..)")
        } else {
            let known = SEEN.iter().map(|(known, _)| *known).chain(QUESTIONS.iter().map(|word| word.name));
            nearest(name, known).map_or_else(
                || format!("there are {}", SEEN.map(|(known, _)| known).join(", ")),
                |near| format!("did you mean around.{near}?"),
            )
        };
        self.say(position, name.chars().count(), ScriptMessage::UnknownProperty { name: name.to_owned(), help });
    }

    fn call(&mut self, call: &FnCallExpr, position: Position) {
        if call.is_operator_call() || !call.name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            return;
        }
        let name = call.name.as_str();
        if self.functions.iter().any(|(known, count)| known == name && *count == call.args.len()) {
            return;
        }
        let words: Vec<&ScriptWord> = free_words().filter(|word| word.name == name).collect();
        if !words.is_empty() {
            return self.word(&words, call, position);
        }
        let help = if let Some((_, count)) = self.functions.iter().find(|(known, _)| known == name) {
            format!("the script's own function with this name has {}", counted(*count, "parameter", "parameters"))
        } else if standard_functions().contains(name) {
            return;
        } else if QUESTIONS.iter().any(|word| word.name == name) {
            format!("write around.{name}(..)")
        } else {
            let known = free_words().map(|word| word.name).chain(self.functions.iter().map(|(name, _)| name.as_str()));
            let known: Vec<&str> = known.chain(standard_functions().iter().map(String::as_str)).collect();
            nearest(name, known).map_or_else(
                || "docs/reference/scripts.md lists the functions".to_owned(),
                |near| format!("did you mean {near}?"),
            )
        };
        let message = ScriptMessage::UnknownFunction { name: name.to_owned(), help: Some(help) };
        self.say(position, name.chars().count(), message);
    }

    fn method(&mut self, call: &FnCallExpr, position: Position) {
        let name = call.name.as_str();
        let words: Vec<&ScriptWord> = QUESTIONS.iter().filter(|word| word.name == name).collect();
        if !words.is_empty() {
            return self.word(&words, call, position);
        }
        let is_known = self.functions.iter().any(|(known, _)| known == name)
            || standard_functions().contains(name)
            || free_words().any(|word| word.name == name);
        if is_known {
            return;
        }
        let known = QUESTIONS.iter().map(|word| word.name).chain(self.functions.iter().map(|(name, _)| name.as_str()));
        let near = nearest(name, known.chain(standard_functions().iter().map(String::as_str)));
        let help = near.map_or_else(
            || "docs/reference/scripts.md lists what there is".to_owned(),
            |near| format!("did you mean {near}?"),
        );
        let message = ScriptMessage::UnknownFunction { name: name.to_owned(), help: Some(help) };
        self.say(position, name.chars().count(), message);
    }

    fn word(&mut self, forms: &[&ScriptWord], call: &FnCallExpr, position: Position) {
        let Some(word) = forms.iter().find(|word| word.wants.len() == call.args.len()) else {
            let form = |word: &&ScriptWord| {
                let wants: Vec<&str> = word.wants.iter().map(|(name, _)| *name).collect();
                format!("{}({})", word.name, wants.join(", "))
            };
            let (word, values) = (call.name.to_string(), call.args.len());
            let message = ScriptMessage::ValueCount { word, values, forms: forms.iter().map(form).collect() };
            return self.say(position, call.name.chars().count(), message);
        };
        for ((name, kind), value) in word.wants.iter().zip(&call.args) {
            self.value(word.name, name, *kind, value);
        }
    }

    fn value(&mut self, word: &str, name: &str, kind: ArgumentKind, expr: &Expr) {
        let constant = match expr {
            Expr::Variable(of, None, _) if of.0.is_none() => self.constants.get(of.1.as_str()).cloned(),
            _ => expr.get_literal_value(None),
        };
        let Some(value) = constant else { return };
        let wanted = match kind {
            ArgumentKind::Seconds | ArgumentKind::Number => "a number",
            ArgumentKind::List => "a list",
            _ => "a text",
        };
        let number = value.as_float().or_else(|_| value.as_int().map(|whole| whole as f64)).ok();
        let fits = match kind {
            ArgumentKind::Seconds | ArgumentKind::Number => number.is_some(),
            ArgumentKind::List => value.is_array(),
            _ => value.is_string(),
        };
        let position = expr.position();
        if !fits {
            let [word, parameter, wanted, found] =
                [word, name, wanted, type_name(value.type_name())].map(str::to_owned);
            return self.say(position, 1, ScriptMessage::ValueType { word, parameter, wanted, found });
        }
        if let Some(number) = number.filter(|number| kind == ArgumentKind::Seconds && *number <= 0.0) {
            return self.say(position, 1, ScriptMessage::Duration { duration_s: number });
        }
        let Ok(text) = value.into_string() else { return };
        self.name(kind, &text, position);
    }

    fn name(&mut self, kind: ArgumentKind, text: &str, position: Position) {
        let width = text.chars().count() + 2;
        let (noun, known): (&str, &[String]) = match kind {
            ArgumentKind::Place => ("place", &self.names.places),
            ArgumentKind::Seat => ("seat", &self.names.seats),
            ArgumentKind::Thing => ("thing", &self.names.things),
            ArgumentKind::Room => ("room", &self.names.rooms),
            ArgumentKind::Manner if Manner::named(text).is_none() => {
                return self.say(position, width, unknown_manner(text));
            }
            _ => return,
        };
        if known.iter().any(|known| known.to_lowercase() == text.to_lowercase()) {
            return;
        }
        self.say(position, width, unknown_name(noun, text, known.iter().map(String::as_str)));
    }
}

fn free_words() -> impl Iterator<Item = &'static ScriptWord> {
    vocabulary::STEPS.iter().chain(&vocabulary::CHANCE)
}
