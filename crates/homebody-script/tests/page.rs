//! The tables of the page about scripts come from the vocabulary.

use homebody_script::vocabulary::{CHANCE, QUESTIONS, SEEN, STEPS, ScriptWord};
use homebody_script::{Program, ScriptNames, standard_functions};
use std::fmt::Write;
use std::path::PathBuf;

const BEGIN: &str = "<!-- made from the vocabulary -->\n";
const END: &str = "<!-- end -->\n";

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/scripts.md")
}

fn table(text: &mut String, heading: &str, before: &str, words: &[ScriptWord]) {
    let _ = write!(text, "### {heading}\n\n| word | effect |\n|---|---|\n");
    for word in words {
        let wants: Vec<&str> = word.wants.iter().map(|(name, _)| *name).collect();
        let _ = writeln!(text, "| `{before}{}({})` | {} |", word.name, wants.join(", "), word.about);
    }
    text.push('\n');
}

fn tables() -> String {
    let mut text = String::from("\n");
    table(&mut text, "Steps", "", &STEPS);
    text += "### Surroundings\n\n| property | value |\n|---|---|\n";
    for (name, about) in SEEN {
        let _ = writeln!(text, "| `around.{name}` | {about} |");
    }
    text.push('\n');
    table(&mut text, "Questions", "around.", &QUESTIONS);
    table(&mut text, "Chance and numbers", "", &CHANCE);
    let functions: Vec<String> = standard_functions().iter().map(|name| format!("`{name}`")).collect();
    let _ = write!(
        text,
        "### Functions of Rhai\n\nScripts can also use these functions of the language: {}.\n\n",
        functions.join(", ")
    );
    text
}

#[test]
fn the_page_lists_every_word_there_is() {
    let page = std::fs::read_to_string(path()).unwrap();
    let (before, rest) = page.split_once(BEGIN).unwrap();
    let (_, after) = rest.split_once(END).unwrap();
    let made = format!("{before}{BEGIN}{}{END}{after}", tables());
    if std::env::var_os("HOMEBODY_REWRITE").is_some() {
        std::fs::write(path(), &made).unwrap();
    }
    assert!(
        page == made || std::env::var_os("HOMEBODY_REWRITE").is_some(),
        "HOMEBODY_REWRITE=1 writes docs/reference/scripts.md anew"
    );
}

/// Every word with values that fit is understood by check and engine alike, which take it from the table and from Rust.
#[test]
fn the_engine_knows_every_word_of_the_table() {
    let known: Vec<String> = homebody_script::known_words();
    for word in STEPS.iter().chain(&CHANCE).chain(&QUESTIONS) {
        let count = word.wants.len() + usize::from(QUESTIONS.iter().any(|question| question.name == word.name));
        let is_it = |signature: &&String| {
            let values = signature.split_once('(').map_or(0, |(_, rest)| rest.split(')').next().map_or(0, values));
            signature.split('(').next() == Some(word.name) && values == count
        };
        assert!(known.iter().any(|signature| is_it(&signature)), "{} with {count} values", word.name);
    }
    for name in known.iter().filter_map(|signature| signature.split('(').next()).filter(|name| !name.contains(' ')) {
        let property = name.strip_prefix("get$");
        let said = property.is_some_and(|name| SEEN.iter().any(|(known, _)| *known == name))
            || STEPS.iter().chain(&CHANCE).chain(&QUESTIONS).any(|word| word.name == name);
        assert!(said, "{name} is registered, and in no table");
    }
}

fn values(list: &str) -> usize {
    if list.trim().is_empty() { 0 } else { list.split(',').count() }
}

/// The scripts on the page are scripts.
#[test]
fn every_script_on_the_page_can_be_read() {
    let page = std::fs::read_to_string(path()).unwrap();
    let names = |list: &str| list.split(", ").map(String::from).collect::<Vec<_>>();
    let home = ScriptNames {
        places: names("kitchen, hall, armchair, bed, front door, stove"),
        seats: names("armchair, bed"),
        things: names("hall, stove, front door, door bell"),
        rooms: names("kitchen, hall"),
    };
    let blocks: Vec<&str> = page.split("```rhai\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert!(blocks.len() >= 2);
    for block in blocks {
        Program::read("page.rhai", block, &home).unwrap_or_else(|problems| panic!("{problems:?}\n{block}"));
    }
}
