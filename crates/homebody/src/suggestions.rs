//! Proposals for unknown commands.

use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, Error};
use homebody_core::nearest::nearest;

const GUESSES: [(&[&str], &str); 7] = [
    (
        &["init", "create", "start", "template", "templates"],
        "homebody new makes a scenario; its --help lists templates",
    ),
    (&["list", "ls", "homes"], "homebody new --help lists templates; homebody serve shows your homes"),
    (&["simulate", "sim", "generate", "play"], "homebody run simulates a scenario"),
    (&["view", "show", "open", "ui", "gui", "web"], "homebody serve opens the page of a scenario"),
    (&["validate", "lint"], "homebody check reports the problems of a scenario"),
    (&["info", "stats", "describe"], "homebody inspect describes a log"),
    (&["export"], "homebody convert writes a log in another form"),
];

/// The error with a better tip, if the first word of a command line is an unknown command.
pub fn with_command(mut error: Error, whole: &Command, first: &str) -> Error {
    let is_first =
        matches!(error.get(ContextKind::InvalidSubcommand), Some(ContextValue::String(word)) if word == first);
    if error.kind() != ErrorKind::InvalidSubcommand || !is_first {
        return error;
    }
    let guess = GUESSES.iter().find(|(names, _)| names.contains(&first));
    let names = whole.get_subcommands().flat_map(|of| std::iter::once(of.get_name()).chain(of.get_visible_aliases()));
    if let Some((_, tip)) = guess {
        error.remove(ContextKind::SuggestedSubcommand);
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(*tip)]));
    } else if let Some(near) = nearest(first, names) {
        error.insert(ContextKind::SuggestedSubcommand, ContextValue::Strings(vec![near.to_owned()]));
    }
    error
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(word: &str) -> String {
        let whole = crate::command();
        let error = whole.clone().try_get_matches_from(["homebody", word]).unwrap_err();
        with_command(error, &whole, word).to_string()
    }

    #[test]
    fn a_command_of_other_programs_leads_to_the_one_here() {
        for (word, tip) in [
            ("init", "tip: homebody new makes a scenario"),
            ("list", "tip: homebody new --help lists templates; homebody serve shows your homes"),
            ("rnu", "'run'"),
            ("simulate", "tip: homebody run simulates a scenario"),
            ("inspekt", "'inspect'"),
        ] {
            let text = refusal(word);
            assert!(text.contains(tip) && !text.contains("density"), "{text}");
        }
        assert!(!refusal("xyzzy").contains("tip:"));
    }

    #[test]
    fn no_guess_is_a_command() {
        let whole = crate::command();
        let mut names = GUESSES.iter().flat_map(|(names, _)| names.iter());
        assert!(names.all(|name| whole.find_subcommand(name).is_none()));
    }
}
