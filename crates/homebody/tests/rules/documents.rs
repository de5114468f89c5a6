//! Files, folders and link targets in the documents exist.

use super::markdown::Document;
use super::{expect_none, files, ignored, paths, repository};
use std::fs;

/// The ends of names that make a word the name of a file.
const EXTENSIONS: [&str; 17] = [
    "rs", "toml", "lock", "json", "md", "rhai", "routine", "sh", "py", "ts", "js", "svelte", "css", "html", "yml",
    "png", "svg",
];

/// Words that look like files of the repository, and their meaning.
const ELSEWHERE: [(&str, &str); 2] = [
    ("recording.json", "a run writes it into its own folder"),
    ("my-home", "what examples call the reader's own scenario"),
];

const PROMISES: &str = "docs/explanation/robustness.md";

#[test]
fn documents_name_only_what_is_there() {
    let documents = ["ARCHITECTURE.md", "README.md", "CONTRIBUTING.md", "CHANGELOG.md", PROMISES];
    expect_none(documents.into_iter().flat_map(wrong_in).collect());
    let all: String = files().into_iter().filter(|file| file.is("rs") || file.is("py")).map(|file| file.text).collect();
    expect_none(tests_not_in(&fs::read_to_string(repository().join(PROMISES)).unwrap(), &all));
}

#[test]
fn a_test_that_is_not_there_is_found() {
    let code = "#[test]\nfn speed_changes_nothing() {}\nmacro! { sources_of_logs: \"source\", }";
    let document = "`speed_changes_nothing`, `sources_of_logs` and `a_test_of_nobody` in `crates/x.rs`";
    assert_eq!(tests_not_in(document, code), ["there is no test a_test_of_nobody"]);
}

/// The tests that a document names and that are not in the code.
fn tests_not_in(document: &str, code: &str) -> Vec<String> {
    let is_name = |word: &&str| {
        word.matches('_').count() >= 2
            && word.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'_' || byte.is_ascii_digit())
    };
    let named = document.split('`').skip(1).step_by(2).filter(is_name);
    let is_gone = |name: &&str| {
        !["fn", "def"].iter().any(|word| code.contains(&format!("{word} {name}(")))
            && !code.contains(&format!("{name}: \""))
    };
    named.filter(is_gone).map(|name| format!("there is no test {name}")).collect()
}

#[test]
fn a_document_that_is_missing_is_found() {
    assert_eq!(wrong_in("NO-SUCH.md"), ["NO-SUCH.md is missing: readers are promised it"]);
}

#[test]
fn a_path_that_is_not_there_is_found() {
    let wrong = |text: &str| dead("README.md", text);
    for right in [
        "`crates/homebody/Cargo.toml`, `homebody-core/src/`, `world.rs`, `crates/*/src/lib.rs`",
        "`sqlite:log.db`, `--json`, `sensor/NAME/timing`, `recording.json`, `a/b c`, `runs/tigerplace-1/log.db`",
        "[a](LICENSE-MIT) [b](https://a.org/b) ![c](docs/pictures/tigerplace.png) [d](#here) [e](README.md#homebody)\n# Here",
        "```\n`crates/gone.rs`\n```",
    ] {
        assert_eq!(wrong(right).len(), 0, "{right}: {:?}", wrong(right));
    }
    assert_eq!(wrong("\nsee `crates/gone.rs`"), ["README.md:2: crates/gone.rs is not there"]);
    for dead in [
        "`gone.rs`",
        "`crates/gone/`",
        "`world.rs/`",
        "`crates/*/gone.rs`",
        "[a](gone.md)",
        "![a](docs/gone.png)",
        "[a](#gone)",
        "[a](README.md#gone)",
        "[a]: gone.md",
    ] {
        assert_eq!(wrong(dead).len(), 1, "{dead}");
    }
}

fn wrong_in(document: &str) -> Vec<String> {
    match fs::read_to_string(repository().join(document)) {
        Ok(text) => dead(document, &text),
        Err(_) => vec![format!("{document} is missing: readers are promised it")],
    }
}

/// The paths and links of a document, which lies in the repository's folder, that lead nowhere.
fn dead(name: &str, text: &str) -> Vec<String> {
    let (paths, ignored, document) = (paths(), ignored(), Document::new(text));
    let spans = document.spans().into_iter().filter(|(_, span)| is_path(span, &ignored) && !is_there(span, &paths));
    let links =
        document.links().into_iter().filter(|(_, link)| !link.contains("://") && !leads_somewhere(link, &document));
    let mut dead: Vec<_> = spans.chain(links).collect();
    dead.sort();
    dead.into_iter().map(|(line, path)| format!("{name}:{line}: {path} is not there")).collect()
}

/// True for a span of code that is a path in the repository.
fn is_path(span: &str, ignored: &[String]) -> bool {
    let is_plain = span.chars().all(|c| c.is_ascii_alphanumeric() || "_-./*".contains(c));
    let first = span.split('/').next().unwrap_or_default();
    let is_elsewhere = ELSEWHERE.iter().any(|(name, _)| *name == first) || ignored.iter().any(|name| name == first);
    // `sensor/NAME/timing` is a pattern of names, `1/60` a number.
    let is_pattern = |part: &str| part.len() > 1 && part.chars().all(|c| c.is_ascii_uppercase());
    let is_number = |part: &str| part.chars().all(|c| c.is_ascii_digit());
    let has_extension = span.rsplit_once('.').is_some_and(|(name, end)| !name.is_empty() && EXTENSIONS.contains(&end));
    is_plain
        && !is_elsewhere
        && !span.starts_with('/')
        && (has_extension || span.contains('/'))
        && !span.split('/').any(is_pattern)
        && !span.split('/').all(is_number)
}

/// True for the path of a file or folder, or the end of one; `*` stands for any one name.
fn is_there(path: &str, paths: &[String]) -> bool {
    let wanted: Vec<&str> = path.trim_start_matches("./").trim_end_matches('/').split('/').collect();
    paths.iter().filter(|there| !path.ends_with('/') || there.ends_with('/')).any(|there| {
        let names: Vec<&str> = there.trim_end_matches('/').split('/').collect();
        let end = names.len().checked_sub(wanted.len()).map(|skipped| &names[skipped..]);
        end.is_some_and(|end| end.iter().zip(&wanted).all(|(name, wanted)| fits(name, wanted)))
    })
}

fn fits(name: &str, pattern: &str) -> bool {
    match pattern.split_once('*') {
        Some((start, end)) => name.len() >= start.len() + end.len() && name.starts_with(start) && name.ends_with(end),
        None => name == pattern,
    }
}

fn leads_somewhere(link: &str, document: &Document) -> bool {
    let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
    let has = |document: &Document| anchor.is_empty() || document.anchors().iter().any(|title| title == anchor);
    if path.is_empty() {
        return has(document);
    }
    let file = repository().join(path);
    match fs::read_to_string(&file) {
        Ok(text) if path.ends_with(".md") => has(&Document::new(&text)),
        _ => file.exists() || link.starts_with("mailto:"),
    }
}
