//! Whether a file has the shape its schema asks for, in the words of people.
//!
//! The walk knows those parts of JSON Schema that the scenario's types produce, no more.

mod messages;

pub use messages::SchemaMessage;
use messages::choice;

use crate::nearest::nearest;
use crate::problem::Problem;
use crate::scenario::source::{JsonNode, JsonSource, Misspelt, NodeKey, NodeValue};
use serde_json::Value as Schema;
use std::collections::{BTreeMap, BTreeSet};

/// The hint for numbers that are written with a decimal comma.
const DECIMAL_POINT: &str = "write a number with a point: 0.5, not 0,5";

/// Largest number of problems searched for in a file (our choice).
const MOST_FOUND: usize = 1_000;

/// The faults of a source's shape.
#[derive(Debug, Default)]
pub struct Misshape {
    /// All faults, in the order of the text.
    pub problems: Vec<Problem>,
    /// The unknown keys, by position, with the intended ones. If there are as many as problems, the rest can be read.
    pub keys: Misspelt,
}

/// Everything about the source's shape that its schema refuses.
pub fn check(source: &JsonSource, schema: &Schema) -> Misshape {
    let mut walk = ShapeCheck { source, root: schema, found: Misshape::default() };
    walk.value(&source.root, schema, "the file");
    walk.found
}

struct ShapeCheck<'a> {
    source: &'a JsonSource,
    root: &'a Schema,
    found: Misshape,
}

impl<'a> ShapeCheck<'a> {
    /// Checks a value; `subject` is what messages call it, such as `"height_m"`.
    fn value(&mut self, node: &JsonNode, schema: &'a Schema, subject: &str) {
        let schema = self.resolve(schema);
        if matches!(node.value, NodeValue::Null) && self.is_optional(schema) {
            return;
        }
        if let Some(branches) = branches(schema, "oneOf") {
            return self.one_of(node, schema, branches, subject);
        }
        if let Some(branches) = branches(schema, "anyOf") {
            let mut fitting = branches.iter().filter(|branch| self.takes(branch, node));
            return match fitting.next() {
                Some(branch) => self.value(node, branch, subject),
                None => self.wrong_type(node, schema, subject),
            };
        }
        if !self.takes(schema, node) {
            return self.wrong_type(node, schema, subject);
        }
        match &node.value {
            NodeValue::Number(number, text) => {
                self.number(node, number.as_ref().and_then(|n| n.as_f64()), text, schema, subject)
            }
            NodeValue::Text(text) => self.text(node, text, schema, subject),
            NodeValue::List(items) => self.list(node, items, schema, subject),
            NodeValue::Object(entries) => self.object(node, entries, schema, subject),
            NodeValue::Null | NodeValue::Bool(_) => {}
        }
    }

    fn number(&mut self, node: &JsonNode, value: Option<f64>, text: &str, schema: &Schema, subject: &str) {
        let Some(value) = value else {
            return self.report(node.start, SchemaMessage::NumberTooLarge { subject: subject.into() });
        };
        let whole = types(schema).any(|name| name == "integer");
        if whole && value.fract() != 0.0 {
            let message = SchemaMessage::NotWhole { subject: subject.into(), written: text.into() };
            return self.report(node.start, message);
        }
        let bound = |name: &str| schema.get(name).and_then(Schema::as_f64);
        let (least, above) = (bound("minimum"), bound("exclusiveMinimum"));
        let (most, below) = (bound("maximum"), bound("exclusiveMaximum"));
        let too_small = least.is_some_and(|least| value < least) || above.is_some_and(|above| value <= above);
        let too_large = most.is_some_and(|most| value > most) || below.is_some_and(|below| value >= below);
        if too_small || too_large {
            let bounds = match (least, most) {
                (Some(least), Some(most)) => format!("from {least} to {most}"),
                _ => {
                    let words = [("at least", least), ("more than", above), ("at most", most), ("less than", below)];
                    let given = words.into_iter().filter_map(|(word, bound)| Some(format!("{word} {}", bound?)));
                    given.collect::<Vec<_>>().join(" and ")
                }
            };
            let message = SchemaMessage::OutOfRange { subject: subject.into(), bounds, written: text.into() };
            self.report(node.start, message);
        }
    }

    fn text(&mut self, node: &JsonNode, text: &str, schema: &Schema, subject: &str) {
        let names: Vec<&str> = names_of(schema).collect();
        if !names.is_empty() && !names.contains(&text) {
            return self.unknown_name(node, text, &names, subject);
        }
        let length = text.chars().count() as u64;
        let limit = |name: &str| schema.get(name).and_then(Schema::as_u64);
        if length == 0 && limit("minLength").is_some() {
            self.report(node.start, SchemaMessage::EmptyText { subject: subject.into() });
        } else if let Some(most) = limit("maxLength").filter(|&most| length > most) {
            self.report(node.start, SchemaMessage::LongText { subject: subject.into(), most_characters: most });
        }
    }

    fn list(&mut self, node: &JsonNode, items: &[JsonNode], schema: &'a Schema, subject: &str) {
        let limit = |name: &str| schema.get(name).and_then(Schema::as_u64);
        let (least, most) = (limit("minItems").unwrap_or(0), limit("maxItems").unwrap_or(u64::MAX));
        let count = items.len() as u64;
        if !(least..=most).contains(&count) {
            let wanted = match (least, most) {
                (least, most) if least == most => format!("exactly {least}"),
                (least, u64::MAX) => format!("at least {least}"),
                (0, most) => format!("at most {most}"),
                (least, most) => format!("{least} to {most}"),
            };
            let noun = if wanted.ends_with(" 1") { "item" } else { "items" };
            let is_number = |item: &JsonNode| matches!(item.value, NodeValue::Number(..));
            let help = match count == 2 * most && items.iter().all(is_number) {
                true => Some(DECIMAL_POINT.into()),
                false => hint_of(schema),
            };
            let (subject, wanted) = (subject.into(), format!("{wanted} {noun}"));
            self.report(node.start, SchemaMessage::WrongCount { subject, wanted, count, help });
        }
        let each = branches(schema, "items");
        for (index, item) in items.iter().enumerate() {
            // Items of a list of a fixed length may each have a schema.
            let Some(schema) = each.map_or_else(|| schema.get("items"), |each| each.get(index)) else { continue };
            self.value(item, schema, &format!("item {} of {subject}", index + 1));
        }
    }

    fn object(&mut self, node: &JsonNode, entries: &[(NodeKey, JsonNode)], schema: &'a Schema, subject: &str) {
        let name = with_article(schema.get("title").and_then(Schema::as_str).unwrap_or("object"));
        let properties = schema.get("properties").and_then(Schema::as_object);
        let known: Vec<&str> = properties.into_iter().flatten().map(|(key, _)| key.as_str()).collect();
        let property = |key: &str| properties.and_then(|properties| properties.get(key));
        if let Some(most) =
            schema.get("maxProperties").and_then(Schema::as_u64).filter(|&most| entries.len() as u64 > most)
        {
            let message = SchemaMessage::TooManyKeys { subject: subject.into(), most, count: entries.len() };
            self.report(node.start, message);
        }
        let mut meant = Vec::new();
        let names: BTreeSet<&str> = entries.iter().map(|(key, _)| &*key.name).collect();
        let mut given: BTreeMap<&str, usize> = BTreeMap::new();
        for (key, value) in entries {
            if let Some(&first) = given.get(&*key.name) {
                let first_line = self.source.line(first);
                self.report(key.start, SchemaMessage::DuplicateKey { key: key.name.clone(), first_line });
                self.found.keys.insert(key.start, None);
                continue;
            }
            given.insert(&key.name, key.start);
            let subject = format!("{:?}", key.name);
            if let Some(schema) = property(&key.name) {
                self.value(value, schema, &subject);
            } else if let Some(schema) = schema.get("additionalProperties").filter(|schema| schema.is_object()) {
                self.value(value, schema, &subject);
            } else {
                // Further problems are not shown, so the program seeks no names for them.
                let is_shown = self.found.problems.len() <= MOST_FOUND;
                let near = is_shown.then(|| nearest(&key.name, known.iter().copied())).flatten();
                let is_free = |near: &&str| !meant.contains(near) && !names.contains(near);
                let free = near.filter(is_free);
                self.found.keys.insert(key.start, free.map(String::from));
                if !near.is_some_and(|near| meant.contains(&near)) {
                    meant.extend(near);
                }
                if is_shown {
                    let (key_name, nearest) = (key.name.clone(), near.map(str::to_owned));
                    let (object, known) = (name.clone(), names_among(&known));
                    self.report(key.start, SchemaMessage::UnknownKey { key: key_name, object, nearest, known });
                }
                if let Some(schema) = free.and_then(property) {
                    self.value(value, schema, &subject);
                }
            }
        }
        for key in branches(schema, "required").into_iter().flatten().filter_map(Schema::as_str) {
            // A required key that was misspelt is one mistake, not two.
            if !names.contains(key) && !meant.contains(&key) {
                let meaning = property(key).and_then(|schema| hint_of(self.resolve_keeping_hint(schema)));
                let (key, object) = (key.to_owned(), name.clone());
                self.report(node.start, SchemaMessage::MissingKey { key, object, meaning, known: Vec::new() });
            }
        }
    }

    /// One of several forms: names, objects that a `kind` tells apart, or objects of a single key.
    fn one_of(&mut self, node: &JsonNode, schema: &'a Schema, branches: &'a [Schema], subject: &str) {
        if let Some(tag) = branches.iter().find_map(tag_of) {
            return self.tagged(node, schema, branches, tag, subject);
        }
        let names: Vec<&str> = branches.iter().flat_map(names_of).collect();
        let keys: Vec<&str> = branches.iter().filter_map(single_key).collect();
        match &node.value {
            NodeValue::Text(text) if names.contains(&text.as_str()) => {}
            NodeValue::Text(text) if keys.contains(&text.as_str()) => {
                self.report(node.start, SchemaMessage::NameAlone { name: text.clone() });
            }
            NodeValue::Text(text) if !names.is_empty() => {
                let all: Vec<&str> = names.iter().chain(&keys).copied().collect();
                self.unknown_name(node, text, &all, subject);
            }
            NodeValue::Object(entries) if !keys.is_empty() => {
                let what = schema.get("title").and_then(Schema::as_str).map_or(subject.to_string(), with_article);
                let [(key, value)] = &entries[..] else {
                    let (count, known) = (entries.len(), names_among(&keys));
                    return self.report(node.start, SchemaMessage::KeyCount { object: what, count, known });
                };
                let branch = branches.iter().find(|branch| single_key(branch) == Some(&key.name));
                match branch.and_then(|branch| branch.get("properties")?.get(&key.name)) {
                    Some(schema) => self.value(value, schema, &format!("{:?}", key.name)),
                    None => self.unknown_kind(key.start, &key.name, noun(&what), &keys),
                }
            }
            _ => self.wrong_type(node, schema, subject),
        }
    }

    fn tagged(&mut self, node: &JsonNode, schema: &'a Schema, branches: &'a [Schema], tag: &str, subject: &str) {
        let NodeValue::Object(entries) = &node.value else {
            return self.wrong_type(node, schema, subject);
        };
        let what = schema.get("title").and_then(Schema::as_str).unwrap_or("object");
        let name_of = |branch: &'a Schema| branch.get("properties")?.get(tag)?.get("const")?.as_str();
        let names: Vec<&str> = branches.iter().filter_map(name_of).collect();
        let Some((_, value)) = entries.iter().find(|(key, _)| key.name == tag) else {
            let (key, object, known) = (tag.to_owned(), with_article(what), names_among(&names));
            return self.report(node.start, SchemaMessage::MissingKey { key, object, meaning: None, known });
        };
        let NodeValue::Text(name) = &value.value else {
            let (wanted, found) = ("a text".to_owned(), kind_of(value));
            let help = Some(choice(&None, &names_among(&names)).text);
            let message = SchemaMessage::WrongType { subject: format!("{tag:?}"), wanted, found, help };
            return self.report(value.start, message);
        };
        match branches.iter().find(|branch| name_of(branch) == Some(name)) {
            Some(branch) => self.value(node, branch, subject),
            None => self.unknown_kind(value.start, name, what, &names),
        }
    }

    fn unknown_kind(&mut self, at: usize, name: &str, object: &str, names: &[&str]) {
        let (nearest, known) = (nearest_among(name, names), names_among(names));
        let (name, object) = (name.to_owned(), object.to_owned());
        self.report(at, SchemaMessage::UnknownKind { name, object, nearest, known });
    }

    fn unknown_name(&mut self, node: &JsonNode, text: &str, names: &[&str], subject: &str) {
        let (nearest, known) = (nearest_among(text, names), names_among(names));
        let (subject, name) = (subject.to_owned(), text.to_owned());
        self.report(node.start, SchemaMessage::UnknownName { subject, name, nearest, known });
    }

    fn wrong_type(&mut self, node: &JsonNode, schema: &'a Schema, subject: &str) {
        let mut wanted = Vec::new();
        self.describe(schema, &mut wanted);
        wanted.dedup();
        let is_number = |text: &str| text.parse::<f64>().is_ok();
        let quoted_number = matches!(&node.value, NodeValue::Text(text) if is_number(text));
        let with_comma = matches!(&node.value, NodeValue::Text(text) if is_number(&text.replacen(',', ".", 1)));
        let wants_number = wanted.iter().any(|wanted| wanted.ends_with("number"));
        let help = match &node.value {
            _ if quoted_number && wants_number => Some("remove the quotes".into()),
            _ if with_comma && wants_number => Some(format!("{DECIMAL_POINT}, and remove the quotes")),
            NodeValue::Text(text) if wanted == ["a list"] => Some(format!("write [{text:?}]")),
            _ => hint_of(schema),
        };
        let (subject, wanted, found) = (subject.to_owned(), wanted.join(" or "), kind_of(node));
        self.report(node.start, SchemaMessage::WrongType { subject, wanted, found, help });
    }

    fn describe(&self, schema: &'a Schema, words: &mut Vec<String>) {
        let schema = self.resolve(schema);
        for branch in branches(schema, "anyOf").or(branches(schema, "oneOf")).into_iter().flatten() {
            self.describe(branch, words);
        }
        for name in types(schema) {
            let word = match name {
                "number" => "a number".into(),
                "integer" => "a whole number".into(),
                "string" => "a text".into(),
                "boolean" => "true or false".into(),
                "array" => self.describe_list(schema),
                "object" => "an object { ... }".into(),
                _ => continue,
            };
            if !words.contains(&word) {
                words.push(word);
            }
        }
    }

    fn describe_list(&self, schema: &'a Schema) -> String {
        let item = schema.get("items").map(|items| self.resolve(items));
        let limit = |name: &str| schema.get(name).and_then(Schema::as_u64);
        match (item.and_then(|item| types(item).next()), limit("minItems"), limit("maxItems")) {
            (Some("number" | "integer"), Some(least), Some(most)) if least == most => {
                format!("a list of {least} numbers")
            }
            _ => "a list".into(),
        }
    }

    /// Whether a value of this JSON type can be right at all.
    fn takes(&self, schema: &'a Schema, node: &JsonNode) -> bool {
        let schema = self.resolve(schema);
        if let Some(branches) = branches(schema, "anyOf").or(branches(schema, "oneOf")) {
            return branches.iter().any(|branch| self.takes(branch, node));
        }
        types(schema).any(|name| match &node.value {
            NodeValue::Null => name == "null",
            NodeValue::Bool(_) => name == "boolean",
            NodeValue::Number(..) => name == "number" || name == "integer",
            NodeValue::Text(_) => name == "string",
            NodeValue::List(_) => name == "array",
            NodeValue::Object(_) => name == "object",
        })
    }

    fn is_optional(&self, schema: &'a Schema) -> bool {
        let is_null = |schema| types(schema).any(|name| name == "null");
        is_null(schema) || branches(schema, "anyOf").is_some_and(|branches| branches.iter().any(is_null))
    }

    fn resolve(&self, schema: &'a Schema) -> &'a Schema {
        if let Some([only]) = branches(schema, "allOf") {
            return self.resolve(only);
        }
        match schema.get("$ref").and_then(Schema::as_str) {
            Some(name) => name.strip_prefix('#').and_then(|name| self.root.pointer(name)).unwrap_or(schema),
            None => schema,
        }
    }

    /// A reference has the words of the key with it, which say more than those of the type.
    fn resolve_keeping_hint(&self, schema: &'a Schema) -> &'a Schema {
        if schema.get("description").is_some() { schema } else { self.resolve(schema) }
    }

    fn report(&mut self, at: usize, message: SchemaMessage) {
        match self.found.problems.len() {
            ..MOST_FOUND => self.found.problems.push(self.source.problem_at(at, message, None)),
            MOST_FOUND => {
                let more = SchemaMessage::TooMany { most: MOST_FOUND };
                self.found.problems.push(Problem::of_file(&self.source.file, more, None));
            }
            _ => {}
        }
    }
}

fn branches<'a>(schema: &'a Schema, keyword: &str) -> Option<&'a [Schema]> {
    schema.get(keyword).and_then(Schema::as_array).map(Vec::as_slice)
}

fn types(schema: &Schema) -> impl Iterator<Item = &str> {
    let (one, many) = match schema.get("type") {
        Some(Schema::Array(names)) => (None, &names[..]),
        Some(name) => (name.as_str(), &[][..]),
        None => (None, &[][..]),
    };
    one.into_iter().chain(many.iter().filter_map(Schema::as_str))
}

/// The texts that a schema accepts, if it accepts certain ones only.
fn names_of(schema: &Schema) -> impl Iterator<Item = &str> {
    schema.get("const").into_iter().chain(branches(schema, "enum").into_iter().flatten()).filter_map(Schema::as_str)
}

/// The key whose constant distinguishes the branch, if it is not the only key.
fn tag_of(branch: &Schema) -> Option<&str> {
    let properties = branch.get("properties")?.as_object()?;
    properties.iter().find(|(_, schema)| schema.get("const").is_some()).map(|(key, _)| key.as_str())
}

fn single_key(branch: &Schema) -> Option<&str> {
    let properties = branch.get("properties")?.as_object()?;
    properties.keys().next().filter(|_| properties.len() == 1).map(String::as_str)
}

/// The first sentence of a schema's description.
fn hint_of(schema: &Schema) -> Option<String> {
    let text = schema.get("description")?.as_str()?;
    let sentence = text.split(". ").next()?.trim_end_matches('.');
    Some(sentence.replace('`', "\""))
}

fn nearest_among(name: &str, known: &[&str]) -> Option<String> {
    nearest(name, known.iter().copied()).map(str::to_owned)
}

/// Known names for a message, without the key of the schema itself.
fn names_among(names: &[&str]) -> Vec<String> {
    names.iter().filter(|name| **name != "$schema").map(|name| (*name).to_owned()).collect()
}

fn kind_of(node: &JsonNode) -> String {
    match &node.value {
        NodeValue::Null => "null".into(),
        NodeValue::Bool(value) => value.to_string(),
        NodeValue::Number(_, text) => format!("the number {text}"),
        NodeValue::Text(text) if text.chars().count() <= 40 => format!("the text {text:?}"),
        NodeValue::Text(_) => "a text".into(),
        NodeValue::List(_) => "a list".into(),
        NodeValue::Object(_) => "an object".into(),
    }
}

fn with_article(noun: &str) -> String {
    let vowel = noun.starts_with(['a', 'e', 'i', 'o', 'u']);
    format!("{} {noun}", if vowel { "an" } else { "a" })
}

fn noun(with_article: &str) -> &str {
    with_article.strip_prefix("a ").or(with_article.strip_prefix("an ")).unwrap_or(with_article)
}
