//! Commands and flags that were renamed: their old names work as hidden aliases for one release, with a note.

use crate::failure::Failure;
use crate::print::LogFormat;
use clap::{Command, ValueEnum};
use std::ffi::OsString;

const GONE_IN: &str = "0.2.0";

/// Commands: the old name, the new one, and the command that has it. The empty command is the whole program.
const COMMANDS: [(&str, &str, &str); 11] = [
    ("calibrate", "fit", ""),
    ("health", "sensor-faults", ""),
    ("look", "inspect", ""),
    ("measure", "measures", ""),
    ("numbers", "parameters", ""),
    ("parts", "install-sheet", ""),
    ("place", "suggest-sensors", ""),
    ("strip", "storyboard", ""),
    ("summarise", "summary", ""),
    ("summarize", "summary", ""),
    ("translate", "locate", ""),
];

/// Flags: the old name, the new one, and the commands that have it. The empty command is the whole program.
const FLAGS: [(&str, &str, &[&str]); 19] = [
    ("against", "compare", &["density"]),
    ("at-least", "min-duration", &["find"]),
    ("beside", "compare", &["install-sheet", "summary"]),
    ("days", "training-days", &["fit"]),
    ("every", "poll", &["alerts", "locate"]),
    ("every", "report-every", &["fleet"]),
    ("first", "first-home", &["fleet"]),
    ("for", "audience", &["summary"]),
    ("from", "start", &["live", "fleet"]),
    ("keep-address", "address-file", &["serve"]),
    ("log", "log-format", &[""]),
    ("look", "dry-run", &["mqtt clean"]),
    ("on-sink-down", "on-unavailable", &["run", "live", "fleet", "replay"]),
    ("record", "recording", &["run"]),
    ("residents", "members", &["run"]),
    ("sensors", "count", &["suggest-sensors"]),
    ("storm", "outages", &["fleet"]),
    ("to", "out", &["convert", "label", "locate", "fit"]),
    ("to-see", "goals", &["suggest-sensors"]),
];

/// The command line with all old names as aliases.
pub fn with_aliases(mut whole: Command) -> Command {
    for (old, new, within) in COMMANDS {
        let renamed = |of: Command| of.mut_subcommand(new, |command| command.alias(old));
        whole = if within.is_empty() { renamed(whole) } else { whole.mut_subcommand(within, renamed) };
    }
    for (old, new, paths) in FLAGS {
        for path in paths {
            whole = with_flag(whole, &path.split_whitespace().collect::<Vec<_>>(), (old, new));
        }
    }
    whole
}

fn with_flag(command: Command, path: &[&str], (old, new): (&'static str, &'static str)) -> Command {
    if let [first, rest @ ..] = path {
        return command.mut_subcommand(*first, |command| with_flag(command, rest, (old, new)));
    }
    // In place: the order of the arguments stays.
    command.mut_args(|arg| if arg.get_long() == Some(new) { arg.alias(old) } else { arg })
}

/// A note for each old name among the words of a command line. The first word is the program's name.
pub fn notes(whole: &Command, words: &[OsString]) -> Vec<String> {
    let words: Vec<String> = words.iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
    let mut notes = Vec::new();
    let (mut command, mut path) = (whole, String::new());
    let mut is_value = false;
    for word in words.iter().take_while(|word| *word != "--") {
        let is_flag = word.starts_with('-');
        if std::mem::take(&mut is_value) {
            continue;
        }
        if is_flag {
            // The value of a flag before the command comes first.
            is_value = path.is_empty() && ["--log", "--log-format"].contains(&word.as_str());
            let name = word.trim_start_matches('-').split('=').next().unwrap_or_default();
            let has = |paths: &[&str]| paths.contains(&"") || paths.contains(&path.as_str());
            let renamed = FLAGS.iter().find(|(old, _, paths)| *old == name && word.starts_with("--") && has(paths));
            notes.extend(renamed.map(|(old, new, _)| note(&format!("--{old}"), &format!("--{new}"))));
        } else if let Some(next) = command.find_subcommand(word) {
            let renamed = COMMANDS.iter().find(|(old, _, within)| old == word && path == *within);
            let full = |name: &str| format!("{path} {name}").trim_start().to_owned();
            notes.extend(renamed.map(|(old, new, _)| note(&full(old), &full(new))));
            path = format!("{path} {}", next.get_name()).trim_start().to_owned();
            command = next;
        }
    }
    notes
}

homebody_core::messages! {
    /// Commands that left the program.
    pub enum GoneMessage in "command" {
        /// The experiments judge the claims of Homebody. They are no part of the installed program; the program `homebody-lab` in the
        /// repository runs them:
        ///
        /// ```sh
        /// cargo run --release --package homebody-lab -- realism --data casas
        /// ```
        Experiments { name: String } error "experiments-gone" ("the experiments are no part of this program any more")
            hint ("in a clone of the repository, run `cargo run --release --package homebody-lab -- {name}`");
    }
}

/// The failure if the command of a command line left the program. The first word is the program's name.
pub fn gone(words: &[OsString]) -> Option<Failure> {
    let words = words.iter().skip(1).map(|word| word.to_string_lossy().into_owned());
    let mut names = words.filter(|word| !word.starts_with('-')).skip_while(|word| word == "help" || is_form(word));
    if names.next()? != "experiment" {
        return None;
    }
    let name = match names.next() {
        Some(name) if name == "walk-back" => "locate".to_owned(),
        Some(name) if name == "sensor-health" => "sensor-faults".to_owned(),
        name => name.unwrap_or_else(|| "--help".to_owned()),
    };
    Some(Failure::asked(GoneMessage::Experiments { name }))
}

/// True for a value of `--log-format`, which may come before the command.
fn is_form(word: &str) -> bool {
    LogFormat::from_str(word, false).is_ok()
}

fn note(old: &str, new: &str) -> String {
    format!("note: `{old}` is now `{new}`; the old name goes in {GONE_IN}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Arg;

    fn noted(line: &str) -> Vec<String> {
        let words: Vec<OsString> = line.split(' ').map(OsString::from).collect();
        notes(&crate::command(), &words)
    }

    #[test]
    fn each_old_name_is_an_alias_of_a_name_that_exists() {
        let whole = crate::command();
        for (old, new, within) in COMMANDS {
            let of = if within.is_empty() { Some(&whole) } else { whole.find_subcommand(within) };
            let found = |name: &str| of.and_then(|of| of.find_subcommand(name));
            assert_eq!(found(old).map(Command::get_name), Some(new));
            assert!(found(new).is_some_and(|of| !of.get_visible_aliases().any(|alias| alias == old)));
        }
        for (old, new, paths) in FLAGS {
            for path in paths {
                let of = path.split_whitespace().try_fold(&whole, |command, word| command.find_subcommand(word));
                let arg = of.and_then(|of| of.get_arguments().find(|arg| arg.get_long() == Some(new)));
                let aliases = arg.and_then(Arg::get_all_aliases).unwrap_or_default();
                assert!(aliases.contains(&old), "{path} --{new} has no alias {old}");
            }
        }
    }

    #[test]
    fn the_use_of_an_old_name_is_noted_once_for_each() {
        let gone = "the old name goes in 0.2.0";
        assert_eq!(noted("homebody look week.csv"), [format!("note: `look` is now `inspect`; {gone}")]);
        let flag = |old: &str, new: &str| format!("note: `--{old}` is now `--{new}`; {gone}");
        assert_eq!(noted("homebody convert week.csv --to=csv:a"), [flag("to", "out")]);
        assert_eq!(noted("homebody --log json fleet a --storm x --every 5s").len(), 3);
        assert_eq!(noted("homebody mqtt clean mqtt://host/a --look"), [flag("look", "dry-run")]);
        assert_eq!(noted("homebody translate a --home b --to c").len(), 2);
    }

    #[test]
    fn the_command_experiment_names_the_program_that_has_it() {
        let hint = |line: &str| match gone(&line.split(' ').map(OsString::from).collect::<Vec<_>>()) {
            Some(Failure::Coded(message, 2)) => message.hint,
            _ => None,
        };
        let run = "in a clone of the repository, run `cargo run --release --package homebody-lab -- ";
        for (line, name) in [
            ("homebody experiment realism --data casas", "realism"),
            ("homebody --log-format json experiment walk-back", "locate"),
            ("homebody help experiment", "--help"),
        ] {
            assert_eq!(hint(line), Some(format!("{run}{name}`")), "{line}");
        }
        assert_eq!(hint("homebody run experiment"), None);
    }

    #[test]
    fn new_names_and_other_words_are_not_noted() {
        for line in [
            "homebody inspect look",
            "homebody silhouettes runs/cameras-1 --from 3:12 --to 3:14 --every 1m",
            "homebody run a --for 2d",
            "homebody day a first -- --to",
            "homebody",
        ] {
            assert_eq!(noted(line), [""; 0], "{line}");
        }
    }
}
