//! The options that allow a command to replace files, and rows in a server's database.

use homebody_log::{Url, WriteMode};

/// Permission to replace files and rows.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct Replacing {
    /// Replace existing files. A database file is replaced only if it contains one run and nothing else
    #[arg(short, long)]
    pub force: bool,
    /// Replace the rows of the same run in a server's database; its other rows stay
    #[arg(long)]
    pub replace_rows: bool,
}

impl Replacing {
    pub fn how(&self, place: &Url) -> WriteMode {
        let is_said = if place.server().is_some() { self.replace_rows } else { self.force };
        if is_said { WriteMode::Overwrite } else { WriteMode::Create }
    }
}
