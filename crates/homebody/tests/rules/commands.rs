//! The program accepts the commands in the documents, and the quick ones run.

use super::markdown::Document;
use super::{expect_none, repository};
use clap::Command;
use rayon::prelude::*;
use std::fs;
use std::path::Path;
use std::process::Output;

/// The documents that show commands: those of the root, and all in `docs`.
fn documents() -> Vec<String> {
    let root = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"].map(str::to_owned);
    let is_document = |path: &String| path.starts_with("docs/") && path.ends_with(".md");
    root.into_iter().chain(super::paths().iter().filter(|path| is_document(path)).cloned()).collect()
}

/// The ways in which a document may start a program.
const STARTS: [(&str, &[&str]); 5] = [
    ("homebody", &["cargo", "run", "--release", "--"]),
    ("homebody", &["./target/release/homebody"]),
    ("homebody", &["homebody"]),
    ("homebody-lab", &["cargo", "run", "--release", "--package", "homebody-lab", "--"]),
    ("homebody-lab", &["homebody-lab"]),
];

/// The commands that need only files and take no more than seconds.
const QUICK: &str = "anonymise check compare completions convert coverage day density doctor inspect install-sheet label measures \
    new plan replay routine run schema";

/// The commands that make what they name first.
const MAKERS: [&str; 2] = ["new", "schema"];

/// Words that make a quick command last, or wait for input.
const SLOW: [&str; 5] = ["--speed", "--control", "--paused", "--resume", "scenarios/cameras"];

/// Runs of more days last.
const MOST_DAYS: u32 = 7;

struct Shown {
    document: String,
    line: usize,
    /// `homebody` or `homebody-lab`.
    program: &'static str,
    words: Vec<String>,
    /// True in a block of code, false within a sentence.
    is_in_block: bool,
}

#[test]
fn the_commands_of_the_documents_are_understood() {
    let shown: Vec<Shown> = documents().iter().flat_map(|document| commands(document, &read(document))).collect();
    assert!(shown.iter().any(|command| command.document == "README.md"), "the README shows how to start the program");
    expect_none(shown.iter().flat_map(misunderstood).collect());
}

#[test]
fn a_command_that_is_not_understood_is_found() {
    let wrong = |text: &str| commands("README.md", text).iter().flat_map(misunderstood).collect::<Vec<_>>();
    let right = "```sh\n$ homebody run scenarios/tigerplace --speed=10 --truth a.db  # slowly\nls --none\n\
        homebody new my-home && homebody check my-home --json | less --none\n\
        homebody-lab godsey2009 \\\n  --svg a.svg\nhomebody --help\n```\nThen `homebody check`.\n";
    assert_eq!(wrong(right), [""; 0]);
    assert_eq!(commands("README.md", right).len(), 6);
    assert_eq!(wrong("```\nhomebody walk a\n```"), ["README.md:2: homebody has no command walk"]);
    assert_eq!(wrong("\nTry `homebody walk`."), ["README.md:2: homebody has no command walk"]);
    assert_eq!(wrong("    cargo run --release -- check a --jso"), ["README.md:1: homebody check has no --jso"]);
    let experiment = "```\ncargo run --release --package homebody-lab -- godsey\n```";
    assert_eq!(wrong(experiment), ["README.md:2: homebody-lab has no command godsey"]);
    let over_lines = "```\nhomebody check a && \\\n homebody check -q b\n```";
    assert_eq!(wrong(over_lines), ["README.md:2: homebody check has no -q"]);
}

/// The other tests read the help without the program.
#[test]
fn the_program_prints_the_rendered_help() {
    // The width of the terminal may change the line breaks.
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let paths: [&[&str]; 2] = [&[], &["run"]];
    for path in paths {
        let output = homebody(&repository(), path.iter().copied().chain(["--help"]));
        assert!(output.status.success(), "{path:?}: {output:?}");
        let printed = String::from_utf8_lossy(&output.stdout).replace("homebody.exe", "homebody");
        assert_eq!(words(&printed), words(&help("homebody", path)), "{path:?}");
    }
}

#[test]
fn the_quick_commands_of_the_readme_run() {
    let folder = copy();
    let shown = commands("README.md", &read("README.md"));
    expect_none(shown.iter().filter_map(|command| failing(command, folder.path())).collect());
}

/// Each document is tried in a folder of its own. Many documents use the first run of the example.
#[test]
fn the_quick_commands_of_the_other_documents_run() {
    // The examples of help texts need files of the reader.
    let is_tried = |document: &String| document.starts_with("docs/") && *document != super::reference::PAGE;
    let failing_of = |document: String| {
        let shown = commands(&document, &read(&document));
        let speaks_of = |word: &str| shown.iter().any(|command| command.words.iter().any(|said| said.contains(word)));
        let folder = copy();
        if speaks_of("runs/tigerplace-1") {
            let words = ["run", "scenarios/tigerplace", "--quiet", "--for", "2d"];
            assert!(homebody(folder.path(), words.into_iter()).status.success());
        }
        shown.iter().filter_map(|command| failing(command, folder.path())).collect::<Vec<_>>()
    };
    expect_none(documents().into_par_iter().filter(is_tried).flat_map_iter(failing_of).collect());
}

#[test]
fn a_command_that_fails_is_found() {
    let folder = copy();
    let failing = |text: &str| failing(&commands("README.md", text)[0], folder.path());
    assert_eq!(failing("    homebody check scenarios/tigerplace"), None);
    assert!(failing("    homebody check scenarios/gone").is_some_and(|why| why.contains("no such scenario")));
    assert_eq!(failing("    homebody check my-home"), None, "an example that nothing made is only read");
    assert_eq!(failing("    homebody new my-home"), None);
    fs::write(folder.path().join("my-home/scenario.json"), "{}").expect("the copy can be changed");
    assert!(failing("    homebody check my-home").is_some());
}

/// A document's text; none if it is missing, which another rule tells.
fn read(document: &str) -> String {
    fs::read_to_string(repository().join(document)).unwrap_or_default()
}

/// The scenarios and their schemas in a folder where commands may write.
fn copy() -> tempfile::TempDir {
    let copy = tempfile::tempdir().expect("a folder for the copy");
    for path in super::paths().iter().filter(|path| path.starts_with("scenarios/") || path.starts_with("schemas/")) {
        let to = copy.path().join(path);
        match path.ends_with('/') {
            true => fs::create_dir_all(to).expect("the folder is made"),
            false => {
                fs::create_dir_all(to.parent().expect("a file is in a folder")).expect("the folder is made");
                fs::copy(repository().join(path), to).expect("the file is copied");
            }
        }
    }
    copy
}

/// The commands in the code of a document, and those between backticks, with the line where they begin.
fn commands(document: &str, text: &str) -> Vec<Shown> {
    let parts = Document::new(text);
    let mut lines: Vec<(usize, String)> = Vec::new();
    let mut goes_on = false;
    for (number, line) in &parts.code {
        match lines.last_mut().filter(|_| goes_on) {
            Some((_, whole)) => *whole = format!("{} {line}", whole.trim_end_matches('\\')),
            None => lines.push((*number, line.clone())),
        }
        goes_on = line.ends_with('\\');
    }
    let in_blocks = lines.len();
    lines.extend(parts.spans());
    let split = lines
        .iter()
        .enumerate()
        .flat_map(|(index, (line, text))| split(text).into_iter().map(move |words| (*line, words, index < in_blocks)));
    let shown = split.filter_map(|(line, words, is_in_block)| {
        let is_start = |start: &&[&str]| words.len() >= start.len() && words.iter().zip(*start).all(|(a, b)| a == b);
        let (program, start) = STARTS.iter().find(|(_, start)| is_start(start))?;
        Some(Shown { document: document.to_owned(), line, program, words: words[start.len()..].to_vec(), is_in_block })
    });
    shown.collect()
}

/// The commands of a line, each as its words, without comments and redirections.
fn split(line: &str) -> Vec<Vec<String>> {
    let mut commands = vec![Vec::new()];
    let mut quote = None;
    let mut word = String::new();
    let line = line.trim_start_matches("$ ");
    for c in line.chars().chain([' ']) {
        match c {
            '\'' | '"' if quote == Some(c) => quote = None,
            '\'' | '"' if quote.is_none() => quote = Some(c),
            ' ' if quote.is_none() => match std::mem::take(&mut word).as_str() {
                "" => {}
                "#" => break,
                "&&" | "|" | ";" | "||" | "&" | ">" | ">>" => commands.push(Vec::new()),
                word => commands.last_mut().expect("there is always one").push(word.to_owned()),
            },
            c => word.push(c),
        }
    }
    commands
}

/// The words of a command that the program's help does not have.
fn misunderstood(Shown { document, line, program, words, .. }: &Shown) -> Vec<String> {
    // `help run` is about `run`.
    let words = words.strip_prefix(&["help".to_owned()]).unwrap_or(&words[..]);
    let mut path: Vec<&str> = Vec::new();
    let mut help = help(program, &path);
    while let (Some(list), Some(word)) = (commands_of(&help), words.get(path.len())) {
        // `[OPTIONS]` and `<COMMAND>` stand for what a reader writes.
        if word.starts_with(['-', '[', '<']) {
            break;
        }
        if !list.lines().any(|line| line.split_whitespace().next() == Some(word)) {
            return vec![format!("{document}:{line}: {} has no command {word}", name(program, &path))];
        }
        path.push(word);
        help = self::help(program, &path);
    }
    let flags = words.iter().filter(|word| word.len() > 1 && word.starts_with('-'));
    let flags = flags.map(|flag| flag.split('=').next().unwrap_or_default());
    let known: Vec<&str> = help.split([' ', ',', '\n', '=', '[']).collect();
    let unknown = flags.filter(|flag| !known.contains(flag));
    unknown.map(|flag| format!("{document}:{line}: {} has no {flag}", name(program, &path))).collect()
}

fn name(program: &str, path: &[&str]) -> String {
    [&[program], path].concat().join(" ")
}

fn help(program: &str, path: &[&str]) -> String {
    let mut whole = if program == "homebody" { homebody::command() } else { homebody_lab::command() };
    whole.build();
    let find = |of: &Command, word: &&str| of.find_subcommand(word).expect("a command that is listed").clone();
    path.iter().fold(whole, |of, word| find(&of, word)).render_long_help().to_string()
}

/// The lines of the help that list commands: those of the whole program are in groups, from the first heading to the options.
fn commands_of(help: &str) -> Option<&str> {
    let titles = [("\nSimulate:\n", "\nOptions:\n"), ("\nCommands:\n", "\n\n")];
    let (rest, end) = titles.iter().find_map(|(title, end)| Some((help.split_once(title)?.1, end)))?;
    rest.split(*end).next()
}

/// Runs a command in the folder if it is quick and what it needs is there; what it says if it fails.
fn failing(Shown { document, line, program, words, is_in_block }: &Shown, folder: &Path) -> Option<String> {
    let is_tried = *is_in_block && *program == "homebody";
    let command = words.first().filter(|command| is_tried && QUICK.split(' ').any(|quick| quick == *command))?;
    let is_slow = words.iter().any(|word| SLOW.contains(&word.split('=').next().unwrap_or_default()));
    let lasts = words.iter().skip_while(|word| *word != "--for").nth(1);
    let days = |span: &String| span.strip_suffix('d').and_then(|days| days.parse::<u32>().ok());
    let is_slow = is_slow || lasts.is_some_and(|span| days(span).is_none_or(|days| days > MOST_DAYS));
    // Servers and stores are tried where the tests have some; what this build lacks it says itself.
    let is_elsewhere = words.iter().any(|word| word.contains("://"));
    let lacks =
        !cfg!(feature = "parquet") && words.iter().any(|word| word.contains("parquet:") || word.contains("arrow:"));
    // The reader must supply files that the repository does not have.
    let has = |word: &String| word.starts_with('-') || word.starts_with("scenarios/") || folder.join(word).exists();
    let log = words.iter().skip_while(|word| *word != "--from-log").nth(1);
    let is_complete =
        log.or(words.get(1)).filter(|_| log.is_some() || !MAKERS.contains(&command.as_str())).is_none_or(has);
    if is_slow || is_elsewhere || lacks || !is_complete {
        return None;
    }
    let output = homebody(folder, words.iter().map(String::as_str));
    let said = String::from_utf8_lossy(&output.stderr);
    (!output.status.success()).then(|| format!("{document}:{line}: homebody {}\n{said}", words.join(" ")))
}

fn homebody<'a>(folder: &Path, words: impl Iterator<Item = &'a str>) -> Output {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_homebody")).args(words).current_dir(folder).output();
    output.expect("homebody can be started")
}
