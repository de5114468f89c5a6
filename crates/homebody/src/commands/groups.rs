//! The groups of commands in `homebody --help`.

use clap::Command;
use std::fmt::Write;

/// The groups in their order: each heading with its commands.
pub const GROUPS: [(&str, &[&str]); 8] = [
    ("Simulate", &["new", "check", "run", "replay", "serve"]),
    ("Homes and sensors", &["import", "plan", "coverage", "devices", "suggest-sensors", "install-sheet"]),
    ("Routines", &["routine", "life", "parameters"]),
    ("Logs", &["inspect", "convert", "anonymise", "label", "compare", "find", "day", "storyboard", "silhouettes"]),
    ("Care", &["measures", "alerts", "summary", "density", "falls"]),
    ("Real time and load", &["live", "fleet", "mqtt"]),
    ("Validate", &["realism", "fit", "locate", "sensor-faults"]),
    ("Set up", &["schema", "doctor", "explain", "completions"]),
];

/// The help of the program. clap lists subcommands without groups, so the template holds the groups as text.
pub fn template(command: &Command) -> String {
    format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n{}\nOptions:\n{{options}}{{after-help}}",
        listed(command)
    )
}

fn listed(command: &Command) -> String {
    let width = GROUPS.iter().flat_map(|(_, names)| names.iter()).map(|name| name.len()).max().unwrap_or(0);
    let about = |name: &str| command.find_subcommand(name).and_then(Command::get_about).map(ToString::to_string);
    let mut text = String::new();
    for (heading, names) in GROUPS {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n{heading}:\n");
        for name in names {
            let _ = writeln!(text, "  {name:width$}  {}", about(name).unwrap_or_default());
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    const LONGEST_SUMMARY: usize = 72;

    #[test]
    fn every_command_is_in_one_group_with_a_short_summary() {
        let whole = crate::command();
        let listed: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        let of_clap: BTreeSet<&str> = whole.get_subcommands().map(Command::get_name).collect();
        assert_eq!(listed.iter().copied().collect::<BTreeSet<_>>(), of_clap);
        assert_eq!(listed.len(), of_clap.len(), "a command is in two groups");
        for command in whole.get_subcommands() {
            let about = command.get_about().map(ToString::to_string).unwrap_or_default();
            let is_short = (1..=LONGEST_SUMMARY).contains(&about.chars().count());
            let is_verb = about.starts_with(char::is_uppercase) && !about.ends_with('.') && !about.contains(['{', '}']);
            assert!(is_short && is_verb, "{}: {about}", command.get_name());
        }
    }

    #[test]
    fn the_help_lists_each_command_below_its_heading() {
        let help = crate::command().render_long_help().to_string();
        for (heading, names) in GROUPS {
            let (_, after) = help.split_once(&format!("\n{heading}:\n")).unwrap_or_else(|| panic!("{heading}\n{help}"));
            let group: Vec<&str> = after.lines().take_while(|line| !line.is_empty()).collect();
            let found: Vec<&str> = group.iter().filter_map(|line| line.split_whitespace().next()).collect();
            assert_eq!(found, names, "{help}");
        }
    }
}
