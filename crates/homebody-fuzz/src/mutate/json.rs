//! Mutants of JSON by its grammar: keys, numbers, texts, lists, outlines. The result may break the rules of JSON: keys
//! repeat, and numbers are any text.

use super::outlines::{self, Corner};
use super::{numbers, texts};
use crate::choices::Choices;
use serde_json::Value;

#[derive(Clone, Debug)]
enum Tree {
    Object(Vec<(String, Tree)>),
    List(Vec<Tree>),
    Text(String),
    /// Anything else, in its written form.
    Other(String),
}

/// Changes a text in JSON in a few places; false for other texts. `others` are sources of parts.
pub fn json(text: &mut String, others: &[&str], choices: &mut Choices) -> bool {
    let Ok(value) = serde_json::from_str::<Value>(text) else { return false };
    let mut tree = Tree::from_value(value);
    for _ in 0..choices.size(3) {
        once(&mut tree, others, choices);
    }
    text.clear();
    tree.write(text);
    true
}

fn once(tree: &mut Tree, others: &[&str], choices: &mut Choices) {
    match choices.below(10) {
        0..=2 => keys(tree, others, choices),
        3..=5 => {
            if let Some(Tree::Other(number)) = tree.pick(choices, &|tree| tree.number().is_some()) {
                *number = numbers::other(number.parse().unwrap_or_default(), choices);
            }
        }
        6 => {
            if let Some(Tree::Text(text)) = tree.pick(choices, &|tree| matches!(tree, Tree::Text(_))) {
                *text = texts::other(text, choices);
            }
        }
        7 => list(tree, choices),
        8 => {
            if let Some(found) = tree.pick(choices, &|tree| tree.corners().is_some())
                && let Some(mut corners) = found.corners()
            {
                outlines::outline(&mut corners, choices);
                *found = Tree::List(corners.into_iter().map(Tree::corner).collect());
            }
        }
        _ => {
            let other = anything(tree, others, choices);
            if let Some(found) = tree.pick(choices, &|_| true) {
                *found = other;
            }
        }
    }
}

fn keys(tree: &mut Tree, others: &[&str], choices: &mut Choices) {
    let known = tree.any_key(choices);
    let other = anything(tree, others, choices);
    let Some(Tree::Object(entries)) =
        tree.pick(choices, &|tree| matches!(tree, Tree::Object(entries) if !entries.is_empty()))
    else {
        return;
    };
    let at = choices.below(entries.len());
    match choices.below(8) {
        0 => entries.insert(choices.below(entries.len() + 1), entries[at].clone()),
        1 => drop(entries.remove(at)),
        2 => entries[at].0 = misspelt(&entries[at].0, choices),
        3 => entries[at].0 = known,
        4 => entries.push((known, other)),
        5 => {
            let value = entries[choices.below(entries.len())].1.clone();
            entries[at].1 = value;
        }
        6 => {
            let (key, value) = entries[at].clone();
            let most = super::times(key.len() + value.length(), 2_000);
            entries.extend((0..choices.size(most)).map(|_| (key.clone(), value.clone())));
        }
        _ if choices.is(0.3) => {
            let zero = Tree::Other("0".into());
            entries.extend((0..choices.size(30_000)).map(|number| (format!("k{number}"), zero.clone())));
        }
        _ => entries[at].0 = texts::other(&entries[at].0, choices),
    }
}

fn list(tree: &mut Tree, choices: &mut Choices) {
    let Some(Tree::List(items)) = tree.pick(choices, &|tree| matches!(tree, Tree::List(items) if !items.is_empty()))
    else {
        return;
    };
    let at = choices.below(items.len());
    let item = items[at].clone();
    match choices.below(6) {
        0 => drop(items.remove(at)),
        1 => items.push(item),
        2 => items.clear(),
        3 => items.reverse(),
        4 => {
            // As many as a file of some hundred kilobytes holds.
            let most = super::times(item.length(), usize::MAX);
            items.extend((0..choices.size(most)).map(|_| item.clone()));
        }
        _ => {
            let other = choices.below(items.len());
            items.swap(at, other);
        }
    }
}

/// A value from another place, from another text, or out of place in any file.
fn anything(tree: &mut Tree, others: &[&str], choices: &mut Choices) -> Tree {
    match choices.below(6) {
        0 => Tree::Other(
            (*choices.one(&["null", "true", "false", "0", "-1", "[]", "{}", "\"\"", "[[]]", "{\"\":0}"])).into(),
        ),
        1 => {
            let (open, close) = *choices.one(&[("[", "]"), ("{\"a\":", "}"), ("[{\"steps\":", "}]")]);
            let most = if choices.is(0.2) { 50_000 } else { 200 };
            let depth = choices.size(most);
            Tree::Other(format!("{}0{}", open.repeat(depth), close.repeat(depth)))
        }
        2 => Tree::Text(texts::other("", choices)),
        3 if !others.is_empty() => {
            let other = serde_json::from_str(choices.one::<&str>(others)).map(Tree::from_value);
            other.ok().and_then(|mut other| other.pick(choices, &|_| true).cloned()).unwrap_or(Tree::Other("1".into()))
        }
        _ => tree.pick(choices, &|_| true).cloned().unwrap_or(Tree::Other("1".into())),
    }
}

fn misspelt(key: &str, choices: &mut Choices) -> String {
    let mut chars: Vec<char> = key.chars().collect();
    let at = choices.below(chars.len());
    match choices.below(3) {
        0 if !chars.is_empty() => drop(chars.remove(at)),
        1 if !chars.is_empty() => chars.insert(at, chars[at]),
        _ => chars.push('s'),
    }
    chars.into_iter().collect()
}

impl Tree {
    fn from_value(value: Value) -> Tree {
        match value {
            Value::Object(entries) => {
                Tree::Object(entries.into_iter().map(|(key, value)| (key, Tree::from_value(value))).collect())
            }
            Value::Array(items) => Tree::List(items.into_iter().map(Tree::from_value).collect()),
            Value::String(text) => Tree::Text(text),
            other => Tree::Other(other.to_string()),
        }
    }

    fn corner([x, y]: Corner) -> Tree {
        // Debug writes -0 and tiny numbers as JSON does.
        let number = |number: f64| Tree::Other(if number.is_finite() { format!("{number:?}") } else { "1e309".into() });
        Tree::List(vec![number(x), number(y)])
    }

    fn write(&self, text: &mut String) {
        match self {
            Tree::Object(entries) => {
                text.push('{');
                for (index, (key, value)) in entries.iter().enumerate() {
                    text.push_str(if index > 0 { ",\n" } else { "" });
                    text.push_str(&Value::from(key.as_str()).to_string());
                    text.push(':');
                    value.write(text);
                }
                text.push('}');
            }
            Tree::List(items) => {
                text.push('[');
                for (index, item) in items.iter().enumerate() {
                    text.push_str(if index > 0 { "," } else { "" });
                    item.write(text);
                }
                text.push(']');
            }
            Tree::Text(own) => text.push_str(&Value::from(own.as_str()).to_string()),
            Tree::Other(own) => text.push_str(own),
        }
    }

    fn length(&self) -> usize {
        match self {
            Tree::Object(entries) => entries.iter().map(|(key, value)| key.len() + value.length() + 4).sum(),
            Tree::List(items) => items.iter().map(|item| item.length() + 2).sum(),
            Tree::Text(text) | Tree::Other(text) => text.len(),
        }
    }

    fn number(&self) -> Option<f64> {
        match self {
            Tree::Other(text) => text.parse().ok(),
            _ => None,
        }
    }

    fn corners(&self) -> Option<Vec<Corner>> {
        let Tree::List(items) = self else { return None };
        let corner = |item: &Tree| match item {
            Tree::List(numbers) => match &numbers[..] {
                [x, y] => Some([x.number()?, y.number()?]),
                _ => None,
            },
            _ => None,
        };
        items.iter().map(corner).collect::<Option<Vec<Corner>>>().filter(|corners| corners.len() >= 2)
    }

    fn count(&self, wanted: &dyn Fn(&Tree) -> bool) -> usize {
        let below: usize = match self {
            Tree::Object(entries) => entries.iter().map(|(_, value)| value.count(wanted)).sum(),
            Tree::List(items) => items.iter().map(|item| item.count(wanted)).sum(),
            _ => 0,
        };
        below + usize::from(wanted(self))
    }

    /// One of the wanted items, each with the same probability.
    fn pick(&mut self, choices: &mut Choices, wanted: &dyn Fn(&Tree) -> bool) -> Option<&mut Tree> {
        let mut left = choices.below(self.count(wanted));
        self.nth(&mut left, wanted)
    }

    fn nth(&mut self, left: &mut usize, wanted: &dyn Fn(&Tree) -> bool) -> Option<&mut Tree> {
        if wanted(self) {
            if *left == 0 {
                return Some(self);
            }
            *left -= 1;
        }
        match self {
            Tree::Object(entries) => entries.iter_mut().find_map(|(_, value)| value.nth(left, wanted)),
            Tree::List(items) => items.iter_mut().find_map(|item| item.nth(left, wanted)),
            _ => None,
        }
    }

    fn any_key(&mut self, choices: &mut Choices) -> String {
        match self.pick(choices, &|tree| matches!(tree, Tree::Object(entries) if !entries.is_empty())) {
            Some(Tree::Object(entries)) => choices.one(entries).0.clone(),
            _ => "name".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices;

    #[test]
    fn mutants_differ_and_are_json_as_a_rule() {
        let whole = r#"{"name": "a", "rooms": [{"outline": [[0, 0], [1, 0], [1, 1]]}], "days": 2}"#;
        let (mut changed, mut good, mut repeated) = (0, 0, 0);
        for number in 0..500 {
            let mut text = whole.to_owned();
            assert!(json(&mut text, &[whole], &mut Choices::new(&choices::bytes(number))));
            changed += usize::from(text != whole);
            good += usize::from(serde_json::from_str::<Value>(&text).is_ok());
            repeated += usize::from(text.matches("\"rooms\"").count() > 1);
        }
        assert!(changed > 400 && good > 250 && repeated > 10, "{changed} {good} {repeated}");
    }
}
