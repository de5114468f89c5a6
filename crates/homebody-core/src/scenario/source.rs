//! The text of a file with its places: what was written, and on which line and column.

use super::json::{JsonMessage, syntax};
use crate::problem::{Diagnostic, Excerpt, Problem, boundary_before};
use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
use serde_json::Number;
use std::collections::BTreeMap;

/// Largest depth of nesting. Deeper text is refused before parsing, so that it cannot overflow the stack.
const GREATEST_DEPTH: usize = 64;

/// Largest number of values of a scenario's file (our choice): keys, items, objects and lists together. Each takes some
/// 200 bytes while the file is read.
pub const MOST_VALUES: usize = 1_000_000;

/// Largest length of a text in a file, in bytes (our choice): names, descriptions, times.
pub const LONGEST_TEXT_BYTES: usize = 10_000;

/// Distance of the places from which columns are counted, in bytes.
const STRIDE_BYTES: usize = 4096;

/// A JSON file: its text and what the text says, with the place of everything.
#[derive(Debug)]
pub struct JsonSource {
    /// The file's name, for problems.
    pub file: String,
    /// The text without a byte order mark, so that offsets count from what a person sees first.
    pub text: String,
    /// The value of the text.
    pub root: JsonNode,
    places: TextPositions,
}

/// The lines and characters of a text, so that a place is found without reading all of the text again.
#[derive(Debug)]
struct TextPositions {
    /// Byte offset at which each line starts.
    lines: Vec<usize>,
    /// The number of characters before each multiple of [`STRIDE_BYTES`].
    chars: Vec<usize>,
}

/// A JSON value and where it stands in the text.
#[derive(Debug)]
pub struct JsonNode {
    /// Byte offset of its first character in the text.
    pub start: usize,
    /// Byte offset behind its last character.
    pub end: usize,
    /// The value.
    pub value: NodeValue,
}

/// A JSON value. Objects keep every key as written, doubles included.
#[derive(Debug)]
pub enum NodeValue {
    /// `null`.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// The number and, for messages, its text; nothing where it is too large for a float.
    Number(Option<Number>, String),
    /// A string, its escapes resolved.
    Text(String),
    /// An array, in the order of the text.
    List(Vec<JsonNode>),
    /// An object: keys and values in the order of the text, also those that stand there twice.
    Object(Vec<(NodeKey, JsonNode)>),
}

/// Unknown keys, by position, with the intended ones if known.
pub type Misspelt = BTreeMap<usize, Option<String>>;

/// A key of an object and where it stands in the text.
#[derive(Debug)]
pub struct NodeKey {
    /// Byte offset of its opening quote in the text.
    pub start: usize,
    /// Byte offset behind its closing quote.
    pub end: usize,
    /// The key, its escapes resolved.
    pub name: String,
}

impl JsonSource {
    /// Reads JSON by the letter of the standard; a byte order mark is passed over.
    pub fn parse(file: &str, text: &str) -> Result<JsonSource, Problem> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let places = TextPositions::new(text);
        let wrong = |at, message: JsonMessage| Err(places.problem(file, text, at, message.into(), None));
        if let Err((at, message)) = scan(text) {
            return wrong(at, message);
        }
        let root = match parse_to_ast(text, &CollectOptions::default(), &strict()) {
            Ok(parsed) => parsed.value,
            Err(error) => {
                let at = error.range().start;
                let message = syntax(error.kind(), text.get(..at).unwrap_or(text), text.get(at..).unwrap_or(""));
                return wrong(at, message);
            }
        };
        let Some(root) = root else {
            return Err(Problem::of_file(file, JsonMessage::Empty, None));
        };
        // The first parser knows better what is meant, the second is stricter about white space and escapes.
        if let Err(error) = serde_json::from_str::<serde::de::IgnoredAny>(text) {
            let at = places.start(error.line()) + error.column().saturating_sub(1);
            let what = error.to_string();
            let what = what.split(" at line ").next().unwrap_or_default();
            return wrong(at, JsonMessage::Invalid { why: what.to_owned() });
        }
        Ok(JsonSource { file: file.into(), text: text.into(), root: node(&root), places })
    }

    /// A problem with the value at a JSON pointer, or with the nearest value around it that is there.
    pub fn problem(&self, pointer: &str, what: impl Into<Diagnostic>, hint: Option<String>) -> Problem {
        self.problem_at(self.find(pointer).1, what, hint)
    }

    /// A problem with the key at a JSON pointer, rather than with its value.
    pub fn problem_with_key(&self, pointer: &str, what: impl Into<Diagnostic>, hint: Option<String>) -> Problem {
        self.problem_at(self.find(pointer).0, what, hint)
    }

    /// A problem at a byte offset.
    pub fn problem_at(&self, at: usize, what: impl Into<Diagnostic>, hint: Option<String>) -> Problem {
        self.places.problem(&self.file, &self.text, at, what.into(), hint)
    }

    /// The line of a byte offset, counted from 1.
    pub fn line(&self, at: usize) -> usize {
        self.places.line(at)
    }

    /// The JSON pointer of the innermost key or item at a line and a column; empty for the whole text.
    pub fn pointer_at(&self, line: u32, column: u32) -> String {
        let start = self.places.start(line as usize);
        let before = self.text.get(start..).unwrap_or_default().chars().take(column.saturating_sub(1) as usize);
        let at = start + before.map(char::len_utf8).sum::<usize>();
        let (mut pointer, mut node) = (String::new(), &self.root);
        loop {
            let inner = match &node.value {
                NodeValue::Object(entries) => {
                    let entry = entries.iter().find(|(key, value)| (key.start..value.end).contains(&at));
                    entry.map(|(key, value)| (pointer_part(&key.name), value))
                }
                NodeValue::List(items) => {
                    let item = items.iter().enumerate().find(|(_, item)| (item.start..item.end).contains(&at));
                    item.map(|(index, item)| (index.to_string(), item))
                }
                _ => None,
            };
            let Some((part, value)) = inner else { return pointer };
            pointer += &format!("/{part}");
            node = value;
        }
    }

    fn find(&self, pointer: &str) -> (usize, usize) {
        let (mut key_start, mut node) = (self.root.start, &self.root);
        for part in pointer.split('/').skip(1) {
            let part = part.replace("~1", "/").replace("~0", "~");
            let found = match &node.value {
                NodeValue::Object(entries) => {
                    entries.iter().find(|(key, _)| key.name == part).map(|(key, value)| (key.start, value))
                }
                NodeValue::List(items) => {
                    part.parse().ok().and_then(|index: usize| items.get(index)).map(|item| (item.start, item))
                }
                _ => None,
            };
            let Some(found) = found else { break };
            (key_start, node) = found;
        }
        (key_start, node.start)
    }
}

impl JsonNode {
    /// Gives misspelt keys the intended names, and removes the other unknown keys.
    pub fn take_as_meant(&mut self, keys: &Misspelt) {
        match &mut self.value {
            NodeValue::List(items) => items.iter_mut().for_each(|item| item.take_as_meant(keys)),
            NodeValue::Object(entries) => {
                entries.retain(|(key, _)| keys.get(&key.start).is_none_or(Option::is_some));
                for (key, value) in entries {
                    if let Some(Some(meant)) = keys.get(&key.start) {
                        key.name.clone_from(meant);
                    }
                    value.take_as_meant(keys);
                }
            }
            _ => {}
        }
    }

    /// The value as plain JSON. A whole number becomes an integer however it is written, as JSON Schema sees it.
    pub fn to_json(&self) -> serde_json::Value {
        match &self.value {
            NodeValue::Null => serde_json::Value::Null,
            NodeValue::Bool(value) => (*value).into(),
            NodeValue::Number(number, _) => number.clone().map_or(serde_json::Value::Null, serde_json::Value::Number),
            NodeValue::Text(text) => text.as_str().into(),
            NodeValue::List(items) => items.iter().map(JsonNode::to_json).collect(),
            NodeValue::Object(entries) => {
                entries.iter().map(|(key, value)| (key.name.clone(), value.to_json())).collect()
            }
        }
    }
}

/// A part of a JSON pointer, escaped.
pub fn pointer_part(name: &str) -> String {
    name.replace('~', "~0").replace('/', "~1")
}

impl TextPositions {
    fn new(text: &str) -> TextPositions {
        let bytes = text.as_bytes();
        let ends = (0..bytes.len())
            .filter(|&i| bytes[i] == b'\n' || bytes[i] == b'\r' && bytes.get(i + 1) != Some(&b'\n'))
            .map(|end| end + 1);
        let mut count = 0;
        let chars = bytes.chunks(STRIDE_BYTES).map(|chunk| {
            let before = count;
            count += begun(chunk);
            before
        });
        TextPositions { chars: chars.collect(), lines: std::iter::once(0).chain(ends).collect() }
    }

    /// Byte offset of the start of a line counted from 1, or the nearest one.
    fn start(&self, line: usize) -> usize {
        self.lines[line.clamp(1, self.lines.len()) - 1]
    }

    fn line(&self, at: usize) -> usize {
        self.lines.partition_point(|&start| start <= at)
    }

    fn chars_before(&self, text: &str, at: usize) -> usize {
        let chunk = (at / STRIDE_BYTES).min(self.chars.len().saturating_sub(1));
        self.chars.get(chunk).map_or(0, |before| before + begun(&text.as_bytes()[chunk * STRIDE_BYTES..at]))
    }

    fn problem(&self, file: &str, text: &str, at: usize, what: Diagnostic, hint: Option<String>) -> Problem {
        let at = boundary_before(text, at);
        let line = self.line(at);
        let start = self.start(line);
        let end = self.lines.get(line).copied().unwrap_or(text.len());
        let column = (self.chars_before(text, at) - self.chars_before(text, start)) as u32 + 1;
        let excerpt = Some(Excerpt::around(&text[start..end], at - start));
        Problem { line: line as u32, column, excerpt, ..Problem::of_file(file, what, hint) }
    }
}

fn begun(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte & 0xc0 != 0x80).count()
}

/// Looks for what the parser would not survive or would explain badly: deep nesting, values without end, and quotes that are
/// not closed.
fn scan(text: &str) -> Result<(), (usize, JsonMessage)> {
    let (mut depth, mut quote, mut escaped, mut values) = (0_usize, None, false, 0_usize);
    for (at, byte) in text.bytes().enumerate() {
        // Each value but the first has a bracket, a colon or a comma before it.
        values += usize::from(quote.is_none() && matches!(byte, b'[' | b'{' | b',' | b':'));
        if values > MOST_VALUES {
            return Err((at, JsonMessage::TooManyValues { most: MOST_VALUES }));
        }
        match (quote, byte) {
            (Some(start), b'\n' | b'\r') => return Err((start, JsonMessage::UnclosedText)),
            (Some(_), ..b' ') => return Err((at, JsonMessage::ControlCharacter)),
            (Some(_), _) if escaped => escaped = false,
            (Some(_), b'\\') => escaped = true,
            (Some(start), b'"') if at - start > LONGEST_TEXT_BYTES => {
                return Err((start, JsonMessage::LongText { most_bytes: LONGEST_TEXT_BYTES }));
            }
            (Some(_), b'"') => quote = None,
            (Some(_), _) => {}
            (None, b'"') => quote = Some(at),
            (None, b'[' | b'{') if depth == GREATEST_DEPTH => {
                return Err((at, JsonMessage::DeepNesting { most: GREATEST_DEPTH }));
            }
            (None, b'[' | b'{') => depth += 1,
            (None, b']' | b'}') => depth = depth.saturating_sub(1),
            (None, _) => {}
        }
    }
    match quote {
        Some(start) => Err((start, JsonMessage::UnclosedText)),
        None => Ok(()),
    }
}

fn strict() -> ParseOptions {
    ParseOptions {
        allow_comments: false,
        allow_loose_object_property_names: false,
        allow_trailing_commas: false,
        allow_missing_commas: false,
        allow_single_quoted_strings: false,
        allow_hexadecimal_numbers: false,
        allow_unary_plus_numbers: false,
        allow_bare_decimal_point_numbers: false,
        allow_non_finite_numbers: false,
        allow_extended_string_escapes: false,
    }
}

fn node(ast: &ast::Value) -> JsonNode {
    let value = match ast {
        ast::Value::NullKeyword(_) => NodeValue::Null,
        ast::Value::BooleanLit(literal) => NodeValue::Bool(literal.value),
        ast::Value::NumberLit(literal) => NodeValue::Number(number(literal.value), literal.value.into()),
        ast::Value::StringLit(literal) => NodeValue::Text(literal.value.to_string()),
        ast::Value::Array(list) => NodeValue::List(list.elements.iter().map(node).collect()),
        ast::Value::Object(object) => NodeValue::Object(object.properties.iter().map(entry).collect()),
    };
    JsonNode { start: ast.start(), end: ast.end(), value }
}

fn entry(property: &ast::ObjectProp) -> (NodeKey, JsonNode) {
    let name = &property.name;
    let key = NodeKey { start: name.start(), end: name.end(), name: name.as_str().into() };
    (key, node(&property.value))
}

fn number(text: &str) -> Option<Number> {
    if let Ok(whole) = text.parse::<u64>() {
        return Some(whole.into());
    }
    if let Ok(whole) = text.parse::<i64>() {
        return Some(whole.into());
    }
    let value: f64 = text.parse().ok()?;
    // Beyond 2^53 a float no longer says which whole number is meant.
    if value.fract() == 0.0 && value.abs() <= 9_007_199_254_740_992.0 {
        return Some((value as i64).into());
    }
    Number::from_f64(value)
}
