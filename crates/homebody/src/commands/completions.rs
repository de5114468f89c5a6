//! `homebody completions`: completion scripts for shells.

use crate::failure::Failure;
use crate::print::print_text;
use clap_complete::{Shell, generate};

/// Print a completion script for a shell
#[derive(clap::Args)]
#[command(after_long_help = "Examples:
  homebody completions bash > ~/.local/share/bash-completion/completions/homebody
  homebody completions zsh > ~/.zfunc/_homebody
  homebody completions fish > ~/.config/fish/completions/homebody.fish")]
pub struct CompletionsArguments {
    /// Name of the shell
    shell: Shell,
}

impl CompletionsArguments {
    pub fn run(self, mut whole: clap::Command) -> Result<(), Failure> {
        let mut script = Vec::new();
        generate(self.shell, &mut whole, "homebody", &mut script);
        print_text(&String::from_utf8_lossy(&script))
    }
}
