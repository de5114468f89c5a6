//! What may be replaced: files have a word of their own, and rows in a server's database another.

use homebody_log::{How, Url};

/// What becomes of what is there already.
#[derive(clap::Args)]
pub struct Replacing {
    /// Replace files that exist; a database file only if it holds nothing but a run
    #[arg(long)]
    pub force: bool,
    /// Replace the rows of this run that a server's database holds already; its other rows stay
    #[arg(long)]
    pub replace_rows: bool,
}

impl Replacing {
    /// What becomes of what is at a place.
    pub fn how(&self, place: &Url) -> How {
        let is_said = if place.server().is_some() { self.replace_rows } else { self.force };
        if is_said { How::Replace } else { How::New }
    }
}
