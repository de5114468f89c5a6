//! Rust files as words: their imports and the names that they use, without comments, texts and code for tests.

pub struct Import {
    /// `*` brings in all.
    pub name: String,
    pub path: Vec<String>,
    pub is_public: bool,
}

/// The names and signs of a text in Rust, without comments, texts and characters.
pub fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if c == '"' {
            quoted(rest)
        } else if let Some(raw) = raw(rest) {
            raw
        } else if c == '\'' {
            character(rest)
        } else if c.is_alphanumeric() || c == '_' {
            let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            words.push(rest[..length].to_owned());
            length
        } else if rest.starts_with("::") {
            words.push("::".to_owned());
            2
        } else {
            if !c.is_whitespace() {
                words.push(c.to_string());
            }
            c.len_utf8()
        };
        rest = &rest[length..];
    }
    words
}

fn quoted(rest: &str) -> usize {
    let mut is_escaped = true;
    for (at, c) in rest.char_indices() {
        match c {
            '"' if !is_escaped => return at + 1,
            _ => is_escaped = at > 0 && c == '\\' && !is_escaped,
        }
    }
    rest.len()
}

/// The length of a text in quotes in which nothing is escaped, where one begins.
fn raw(rest: &str) -> Option<usize> {
    let after = rest.strip_prefix("br").or(rest.strip_prefix('r'))?;
    let marks = after.len() - after.trim_start_matches('#').len();
    after[marks..].strip_prefix('"')?;
    let end = format!("\"{}", &after[..marks]);
    let begin = rest.len() - after.len() + marks + 1;
    Some(rest[begin..].find(&end).map_or(rest.len(), |at| begin + at + end.len()))
}

/// The length of a character in quotes; of the quote alone where it is a lifetime.
fn character(rest: &str) -> usize {
    let mut chars = rest.char_indices().skip(1);
    match chars.next() {
        Some((_, '\\')) => rest[3..].find('\'').map_or(rest.len(), |end| end + 4),
        Some(_) => chars.next().filter(|&(_, c)| c == '\'').map_or(1, |(at, _)| at + 1),
        None => 1,
    }
}

pub fn paths(body: &[String]) -> Vec<Vec<String>> {
    let mut paths: Vec<Vec<String>> = Vec::new();
    let mut goes_on = false;
    for (index, word) in body.iter().enumerate() {
        match &word[..] {
            "::" => goes_on = index > 0 && is_name(&body[index - 1]),
            name if is_name(name) && goes_on => {
                paths.last_mut().expect("a name came before").push(name.to_owned());
                goes_on = false;
            }
            name => {
                goes_on = false;
                if is_name(name) {
                    paths.push(vec![name.to_owned()]);
                }
            }
        }
    }
    paths.retain(|path| path.len() > 1);
    paths
}

fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// The imports among the words of a file, and all else but declarations of modules, attributes, and code for tests.
pub fn parted(words: Vec<String>) -> (Vec<Import>, Vec<String>) {
    let (mut imports, mut body) = (Vec::new(), Vec::new());
    let mut at = 0;
    let is = |at: usize, word: &str| words.get(at).is_some_and(|other| other == word);
    while at < words.len() {
        if is(at, "#") && (is(at + 1, "[") || is(at + 2, "[")) {
            let end = closing(&words, at + 1 + usize::from(is(at + 1, "!")));
            let is_test = words[at..end].join("") == "#[cfg(test)]";
            at = if is_test { item_end(&words, end) } else { end };
        } else if is(at, "pub") || is(at, "use") || is(at, "mod") {
            let is_public = is(at, "pub");
            let begin =
                if is_public && is(at + 1, "(") { closing(&words, at + 1) } else { at + usize::from(is_public) };
            let end = words[begin..].iter().position(|word| word == ";").map_or(words.len(), |end| begin + end);
            if is(begin, "use") && !is(begin + 1, "<") {
                brought_in(&words[begin + 1..end], &[], is_public, &mut imports);
                at = end + 1;
            } else if is(begin, "mod") && end == begin + 2 {
                at = end + 1;
            } else {
                body.extend_from_slice(&words[at..begin.max(at + 1)]);
                at = begin.max(at + 1);
            }
        } else {
            body.push(words[at].clone());
            at += 1;
        }
    }
    (imports, body)
}

/// Past the bracket that closes the one at this place.
fn closing(words: &[String], open: usize) -> usize {
    let mut depth = 0;
    for (index, word) in words.iter().enumerate().skip(open) {
        match &word[..] {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return index + 1;
        }
    }
    words.len()
}

/// Past the item that begins at this place, and its further attributes.
fn item_end(words: &[String], begin: usize) -> usize {
    let mut at = begin;
    while at < words.len() {
        match &words[at][..] {
            ";" => return at + 1,
            "{" if words[begin] != "use" => return closing(words, at),
            "(" | "[" | "{" => at = closing(words, at),
            _ => at += 1,
        }
    }
    at
}

fn brought_in(tree: &[String], before: &[String], is_public: bool, imports: &mut Vec<Import>) {
    let mut path = before.to_vec();
    let mut at = 0;
    while at < tree.len() {
        match &tree[at][..] {
            "::" => {}
            "{" => {
                let end = closing(tree, at);
                let mut begin = at + 1;
                while begin < end - 1 {
                    let mut next = begin;
                    while next < end - 1 && tree[next] != "," {
                        next = if tree[next] == "{" { closing(tree, next) } else { next + 1 };
                    }
                    brought_in(&tree[begin..next], &path, is_public, imports);
                    begin = next + 1;
                }
                return;
            }
            "as" => break,
            "self" if !path.is_empty() => {}
            name => path.push(name.to_owned()),
        }
        at += 1;
    }
    let name = tree.get(at + 1).filter(|_| at < tree.len()).or(path.last());
    imports.extend(name.cloned().map(|name| Import { name, path, is_public }));
}
