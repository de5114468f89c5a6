//! Where everything stands in a text of JSON, so that a part of it is written otherwise or taken out and all the rest stays.

use homebody_core::scenario::source::{JsonNode, JsonSource, NodeKey, NodeValue};
use std::ops::Range;

/// A property of an object, or an item of a list.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Keys and numbers from the outside in.
    pub path: Vec<String>,
    /// The key with its quotes; nothing of an item.
    key: Option<Range<usize>>,
    value: Range<usize>,
    /// NodeKey and value.
    pub whole: Range<usize>,
    /// Of a string.
    said: Option<String>,
}

impl Entry {
    /// Whether it stands there; a star is any part.
    pub fn is(&self, path: &[&str]) -> bool {
        self.path.len() == path.len()
            && self.path.iter().zip(path).all(|(part, sought)| *sought == "*" || part == sought)
    }

    /// What a string says.
    pub fn text(&self) -> Option<&str> {
        self.said.as_deref()
    }

    /// Where the name stands: the string, or the key of what is no string, and of an id by a sensor's name.
    pub fn name_range(&self) -> Range<usize> {
        let by_key = matches!(self.path[0].as_str(), "ids" | "sensors") && self.path.len() == 2;
        match &self.key {
            Some(key) if by_key || self.said.is_none() => key.clone(),
            _ => self.value.clone(),
        }
    }
}

/// All entries of a text, in order; none where it is no JSON.
pub fn entries(text: &str) -> Vec<Entry> {
    let Ok(source) = JsonSource::parse("", text) else { return Vec::new() };
    // A byte order mark is no part of what has been read.
    let mut found = Found { mark: text.len() - source.text.len(), path: Vec::new(), entries: Vec::new() };
    found.within(&source.root);
    found.entries
}

struct Found {
    /// How many bytes there are before the text.
    mark: usize,
    path: Vec<String>,
    entries: Vec<Entry>,
}

impl Found {
    fn within(&mut self, node: &JsonNode) {
        match &node.value {
            NodeValue::List(items) => {
                items.iter().enumerate().for_each(|(index, item)| self.add(index.to_string(), None, item))
            }
            NodeValue::Object(all) => all.iter().for_each(|(key, value)| self.add(key.name.clone(), Some(key), value)),
            _ => {}
        }
    }

    fn add(&mut self, part: String, key: Option<&NodeKey>, node: &JsonNode) {
        let in_text = |start: usize, end: usize| self.mark + start..self.mark + end;
        let key = key.map(|key| in_text(key.start, key.end));
        let value = in_text(node.start, node.end);
        let whole = key.as_ref().map_or(value.start, |key| key.start)..value.end;
        let said = if let NodeValue::Text(said) = &node.value { Some(said.clone()) } else { None };
        self.path.push(part);
        self.entries.push(Entry { path: self.path.clone(), key, value, whole, said });
        self.within(node);
        self.path.pop();
    }
}

/// The text without some entries, or lines of a text that is none of JSON, and without the commas that they leave.
pub fn without(text: &str, cut: &[Range<usize>]) -> String {
    let mut sorted = cut.to_vec();
    sorted.sort_by_key(|range| (range.start, std::cmp::Reverse(range.end)));
    let mut cut: Vec<Range<usize>> = Vec::new();
    for range in sorted {
        // What lies within another that goes, or goes twice, is gone with it.
        if cut.last().is_none_or(|outer| range.start >= outer.end) {
            cut.push(range);
        }
    }
    let mut fresh = text.to_owned();
    for Range { start, end } in cut.into_iter().rev() {
        let before = fresh[..start].trim_end();
        let after = fresh[end..].trim_start();
        let is_line = fresh[..end].ends_with('\n');
        let range = if is_line {
            start..end
        } else if let Some(rest) = after.strip_prefix(',') {
            // The next one takes its place.
            start..fresh.len() - rest.trim_start().len()
        } else if before.ends_with(',') {
            before.len() - 1..end
        } else {
            start..end
        };
        fresh.replace_range(range, "");
    }
    fresh
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str =
        "{\n  \"ids\": {\n    \"a\": \"1\",\n    \"b\": \"2\"\n  },\n  \"faults\": [{ \"sensor\": \"a\" }, 3.5]\n}\n";

    #[test]
    fn everything_has_its_place() {
        let all = entries(TEXT);
        let paths: Vec<String> = all.iter().map(|entry| entry.path.join("/")).collect();
        assert_eq!(paths, ["ids", "ids/a", "ids/b", "faults", "faults/0", "faults/0/sensor", "faults/1"]);
        assert_eq!(&TEXT[all[1].name_range()], "\"a\"");
        assert_eq!(&TEXT[all[5].name_range()], "\"a\"");
        for broken in ["", "{", "[1,", "{\"a\" 1}", "{\"a\": \"b}", "[1 2]"] {
            assert_eq!(entries(broken), [], "{broken}");
        }
    }

    #[test]
    fn what_is_taken_out_leaves_no_comma() {
        let all = entries(TEXT);
        let cut = |paths: &[&str]| {
            let ranges: Vec<_> = all
                .iter()
                .filter(|entry| paths.contains(&entry.path.join("/").as_str()))
                .map(|entry| entry.whole.clone())
                .collect();
            without(TEXT, &ranges)
        };
        for paths in [
            &["ids/a"][..],
            &["ids/b"],
            &["ids/a", "ids/b"],
            &["faults/0"],
            &["faults/1"],
            &["ids", "ids/a"],
            &["faults"],
        ] {
            let left = cut(paths);
            let value: serde_json::Value =
                serde_json::from_str(&left).unwrap_or_else(|error| panic!("{paths:?}: {error}: {left}"));
            for path in paths {
                assert!(value.pointer(&format!("/{path}")).is_none() || path.starts_with("faults/0"), "{path}: {left}");
            }
        }
        assert_eq!(cut(&[]), TEXT);
    }
}
