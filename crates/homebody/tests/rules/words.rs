//! Words that no file contains: remaining work, paths of its author, and the way of its writing.

use super::{File, RULES, expect_none, files, has_word, numbered};

/// Marks of unfinished work.
const MARKERS: [&str; 4] = ["TODO", "FIXME", "XXX", "HACK"];
const MACROS: [&str; 4] = ["todo!", "unimplemented!", "dbg!", "#[ignore]"];

/// The beginnings of paths that only some machine has.
const MACHINE: [&str; 6] = ["/work/", "/tmp/", "/root/", "/home/", "/Users/", "C:\\Users"];

/// Words about the writing, not about what is written.
const WRITING: [&str; 3] = ["worktree", "AI assistant", "coding agent"];

#[test]
fn no_file_has_leftovers_paths_of_a_machine_or_words_on_its_writing() {
    let files = read();
    let rules = [is_left_over, names_machine, speaks_of_writing];
    expect_none(
        rules.into_iter().flat_map(|is_wrong| files.iter().flat_map(move |file| lines_with(file, is_wrong))).collect(),
    );
}

#[test]
fn finds_leftovers_paths_of_a_machine_and_words_on_the_writing() {
    for line in ["// TODO: later", "let a = todo!();", "    dbg!(a);", "FIXME", "#[ignore]"] {
        assert_eq!(lines_with(&File::new("a.rs", line), is_left_over), [format!("a.rs:1: {}", line.trim())]);
    }
    for line in ["HACK_REGULAR", "mastodon", "#[ignore = \"a measurement\"]", "a to-do list"] {
        assert!(!is_left_over(line), "{line}");
    }
    for line in ["see /work/notes.md", "\"/tmp/log.csv\"", "(/home/ann/a.rs)", "file:///Users/ann", "C:\\Users\\ann"] {
        assert!(names_machine(line), "{line}");
    }
    for line in ["crates/homebody-core/src/home/mod.rs", "../work/a", "https://a.org/home/", "$HOME/home/"] {
        assert!(!names_machine(line), "{line}");
    }
    assert!(speaks_of_writing("as a coding agent wrote") && speaks_of_writing("in the Worktree"));
    assert!(!speaks_of_writing("a session of the live view"));
}

/// The files in which words are looked for; those that programs write are not ours to word.
fn read() -> Vec<File> {
    let is_ours = |file: &File| !file.path.starts_with(RULES) && !file.is("lock") && !file.path.ends_with("-lock.json");
    files().into_iter().filter(is_ours).collect()
}

fn lines_with(file: &File, is_wrong: fn(&str) -> bool) -> Vec<String> {
    let lines = numbered(&file.text).filter(|(_, line)| is_wrong(line));
    lines.map(|(number, line)| format!("{}:{number}: {}", file.path, line.trim())).collect()
}

fn is_left_over(line: &str) -> bool {
    MARKERS.iter().any(|marker| has_word(line, marker)) || MACROS.iter().any(|name| line.contains(name))
}

fn names_machine(line: &str) -> bool {
    let goes_on = |c: char| c.is_alphanumeric() || "_.*}$-".contains(c);
    let begins = |at: usize| !line[..at].ends_with(goes_on);
    MACHINE.iter().any(|path| line.match_indices(path).any(|(at, _)| begins(at)))
}

fn speaks_of_writing(line: &str) -> bool {
    let line = line.to_lowercase();
    WRITING.iter().any(|words| has_word(&line, &words.to_lowercase()))
}
