//! Places of entries in a JSON text, so that one can be changed or removed without touching the rest.

use homebody_core::scenario::source::{JsonNode, JsonSource, NodeKey, NodeValue};
use std::ops::Range;

/// A property of an object, or an item of a list.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Keys and indices from the outside in.
    pub path: Vec<String>,
    /// With its quotes; items have none.
    key: Option<Range<usize>>,
    value: Range<usize>,
    pub whole: Range<usize>,
    said: Option<String>,
}

impl Entry {
    /// A star stands for any part.
    pub fn is(&self, path: &[&str]) -> bool {
        self.path.len() == path.len()
            && self.path.iter().zip(path).all(|(part, sought)| *sought == "*" || part == sought)
    }

    pub fn text(&self) -> Option<&str> {
        self.said.as_deref()
    }

    /// The place of a name: the string, or the key if the value is no string; for ids and sensors always the key.
    pub fn name_range(&self) -> Range<usize> {
        let by_key = matches!(self.path[0].as_str(), "ids" | "sensors") && self.path.len() == 2;
        match &self.key {
            Some(key) if by_key || self.said.is_none() => key.clone(),
            _ => self.value.clone(),
        }
    }
}

/// All entries in order; empty for invalid JSON.
pub fn entries(text: &str) -> Vec<Entry> {
    let Ok(source) = JsonSource::parse("", text) else { return Vec::new() };
    // The parsed text lacks the byte order mark.
    let mut found = EntryReader { mark: text.len() - source.text.len(), path: Vec::new(), entries: Vec::new() };
    found.within(&source.root);
    found.entries
}

struct EntryReader {
    /// The number of bytes before the parsed text.
    mark: usize,
    path: Vec<String>,
    entries: Vec<Entry>,
}

impl EntryReader {
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

/// A text without some entries of its JSON, or without some lines, and without the commas that they leave.
pub fn without(text: &str, cut: &[Range<usize>]) -> String {
    let mut sorted = cut.to_vec();
    sorted.sort_by_key(|range| (range.start, std::cmp::Reverse(range.end)));
    let mut cut: Vec<Range<usize>> = Vec::new();
    for range in sorted {
        // Ranges within others, or equal to them, are removed with those.
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
            // The next entry takes its place.
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
    fn finds_the_places_of_entries() {
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
    fn removes_entries_with_their_commas() {
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
