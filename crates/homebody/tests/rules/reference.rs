//! `docs/reference/commands.md` is generated from the command line: usage, summary, options and examples of each command.
//!
//! `HOMEBODY_REWRITE=1 cargo test -p homebody --test rules reference` writes it anew.

use super::generated::is_generated;
use super::numbers::cell;
use clap::{Arg, Command};
use std::fmt::Write;

pub const PAGE: &str = "docs/reference/commands.md";

const HEAD: &str = "\
# Commands

This page lists the usage, options and examples of each command. The test `crates/homebody/tests/rules/reference.rs` generates it
from the program.

`homebody --help` lists the commands in these groups. `--help` after a command prints its text on this page, and `-h` prints a short
form. Three short options are the same everywhere: `-o` is `--out` (a destination, or a new folder), `-q` is `--quiet`, and `-f` is
`--force`. Every command takes `--log-format json`, which writes progress, notes and errors to standard error as JSON.

Exit codes: 0 success, 1 a file could not be read or written, 2 an argument or a file is invalid. `run`, `live` and `fleet` also end
with 129, 130 or 143 after SIGHUP, SIGINT or SIGTERM. `doctor` also ends with 1 if a check is wrong.
";

#[test]
fn the_page_of_commands_is_that_of_the_program() {
    is_generated(PAGE, &document());
}

#[test]
fn a_command_is_documented_with_usage_options_and_examples() {
    let page = document();
    for part in [
        "\n## Simulate\n",
        "\n### homebody run\n\nSimulate a scenario and write its sensor log.\n",
        "\nhomebody run [OPTIONS] [SCENARIO]\n",
        "| `-o`, `--out DESTINATION` |",
        "| `--on-unavailable ACTION` | `error` |",
        "`spool`: Store rows on disk",
        "\n#### homebody routine check\n",
        "\nhomebody run scenarios/tigerplace --for 2h --speed 60\n",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("on-sink-down"), "an old name is shown");
    assert!(!page.contains("```text\n\n```"), "a block is empty");
}

fn document() -> String {
    let mut whole = homebody::command();
    whole.build();
    let mut text = HEAD.to_owned();
    for (heading, names) in homebody::COMMAND_GROUPS {
        // A string takes whatever is written to it.
        let _ = write!(text, "\n## {heading}\n");
        for name in names {
            let command = whole.find_subcommand(name).expect("each command of a group exists");
            of_command(&mut text, command, &format!("homebody {name}"), "###");
        }
    }
    text
}

/// A section for a command, and one for each command below it.
fn of_command(text: &mut String, command: &Command, name: &str, title: &str) {
    let about = command.get_about().map(ToString::to_string).unwrap_or_default();
    let _ = write!(text, "\n{title} {name}\n\n{}.\n", about.trim_end_matches('.'));
    let usage = command.clone().render_usage().to_string();
    let _ = write!(text, "\n```text\n{}\n```\n", usage.trim_start_matches("Usage: "));
    let long = command.get_long_about().map(ToString::to_string).unwrap_or_default();
    for paragraph in long.split("\n\n").skip(1) {
        let _ = write!(text, "\n{}\n", wrapped(paragraph));
    }
    options(text, command);
    let after = command.get_after_long_help().map(ToString::to_string).unwrap_or_default();
    let is_shown = |part: &&str| !part.trim().is_empty() && !part.trim_start().starts_with("Exit codes:");
    let parts = after.split("\n\n").filter(is_shown);
    let (examples, others): (Vec<&str>, Vec<&str>) = parts.partition(|part| part.starts_with("Example"));
    for examples in examples {
        let lines: Vec<&str> = examples.lines().skip(1).map(|line| line.strip_prefix("  ").unwrap_or(line)).collect();
        let _ = write!(text, "\nExamples:\n\n```sh\n{}\n```\n", lines.join("\n"));
    }
    if !others.is_empty() {
        let _ = write!(text, "\n```text\n{}\n```\n", others.join("\n\n").trim_end());
    }
    for below in command.get_subcommands().filter(|below| below.get_name() != "help") {
        of_command(text, below, &format!("{name} {}", below.get_name()), &format!("{title}#"));
    }
}

/// A table of the arguments and options of a command.
fn options(text: &mut String, command: &Command) {
    let is_own = |arg: &&Arg| !arg.is_hide_set() && !["help", "version", "log_format"].contains(&arg.get_id().as_str());
    let all: Vec<&Arg> = command.get_arguments().filter(is_own).collect();
    if all.is_empty() {
        return;
    }
    let (named, placed): (Vec<&Arg>, Vec<&Arg>) = all.into_iter().partition(|arg| arg.get_long().is_some());
    text.push_str("\n| argument or option | default | meaning |\n|---|---|---|\n");
    for arg in placed.into_iter().chain(named) {
        let has_default = arg.get_action().takes_values() && !arg.is_hide_default_value_set();
        let defaults: Vec<String> = match has_default {
            false => Vec::new(),
            true => arg.get_default_values().iter().map(|value| format!("`{}`", value.to_string_lossy())).collect(),
        };
        let _ = writeln!(text, "| {} | {} | {} |", form(arg), cell(&defaults.join(", ")), cell(&meaning(arg)));
    }
}

/// Such as `-o`, `--out DESTINATION`.
fn form(arg: &Arg) -> String {
    let takes = arg.get_action().takes_values();
    let names: Vec<String> = arg.get_value_names().unwrap_or_default().iter().map(ToString::to_string).collect();
    let names = if names.is_empty() { arg.get_id().as_str().to_uppercase() } else { names.join(" ") };
    let is_optional = arg.get_num_args().is_some_and(|count| count.min_values() == 0);
    let value = match (takes, is_optional) {
        (false, _) => String::new(),
        (true, false) => format!(" {names}"),
        (true, true) => format!(" [{names}]"),
    };
    match (arg.get_short(), arg.get_long()) {
        (Some(short), Some(long)) => format!("`-{short}`, `--{long}{value}`"),
        (None, Some(long)) => format!("`--{long}{value}`"),
        _ => format!("`{names}`"),
    }
}

/// Its help, and what each possible value means.
fn meaning(arg: &Arg) -> String {
    let help = arg.get_long_help().or(arg.get_help()).map(ToString::to_string).unwrap_or_default();
    let mut parts: Vec<String> = help.split("\n\n").map(one_line).collect();
    let is_flag = !arg.get_action().takes_values();
    let values = arg.get_possible_values().into_iter().filter(|value| !is_flag && !value.is_hide_set());
    let value = |value: clap::builder::PossibleValue| match value.get_help() {
        Some(help) => format!("`{}`: {help}", value.get_name()),
        None => format!("`{}`", value.get_name()),
    };
    let values: Vec<String> = values.map(value).collect();
    if !values.is_empty() {
        parts.push(values.join("; "));
    }
    parts.join(". ").replace("..", ".").replace(":. ", ": ")
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").trim_end_matches('.').to_owned()
}

/// A paragraph in lines as long as documents have them.
fn wrapped(paragraph: &str) -> String {
    const WIDTH: usize = 130;
    let mut lines = vec![String::new()];
    for word in paragraph.split_whitespace() {
        let line = lines.last_mut().expect("there is always a line");
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= WIDTH {
            *line += &format!(" {word}");
        } else {
            lines.push(word.to_owned());
        }
    }
    lines.join("\n")
}
