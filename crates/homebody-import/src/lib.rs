//! Homes from the plans of other programs, so far those of Sweet Home 3D; and schematic ones from what a log tells of its home.
//!
//! A file comes in as bytes and goes out as the text of a `home.json` that passes every check, with remarks on what
//! was left out or guessed. Whoever made the file is not trusted: all sizes have bounds, and no file makes this crate
//! panic. It does not know files on disk, nor who lives in a home. Reading order:

#![warn(missing_docs)]

pub mod error;

// From bytes to a drawing: the archive or what else the bytes are, its XML, what that draws, which level of it.
mod file_form;
mod archive;
mod markup;
mod drawing;
mod levels;
mod kinds;

// From what is drawn on a level to a floor: walls, rooms, doors, furniture, and the names of all.
mod names;
mod walls;
mod outline;
mod rooms;
mod overlaps;
mod spaces;
mod doors;
mod passages;
mod outdoors;
mod meaning;
mod furniture;
mod floor;

// From floors to a home: where stairs lead out of each, how they are unfolded, what places are called.
mod exits;
mod stairs;
mod places;

// The text of the home, what of it has to go so that it passes the check, and what is moved so that people get to it.
mod text;
mod soundness;
mod reachability;

mod sweet_home;

// From the sensors of a log to a schematic home.
pub mod from_log;

pub use archive::MOST_BYTES;
pub use error::ImportError;
pub use sweet_home::{Imported, SCHEMA, sweet_home};
pub use text::home_text;

/// The messages of this crate, for lists of all messages.
pub mod catalogue {
    use crate::error::ImportError;
    use crate::from_log::SchematicError;
    use homebody_core::messages::{Catalogue, CatalogueEntry};

    /// The messages by area.
    pub const MESSAGES: &[&[CatalogueEntry]] = &[ImportError::ENTRIES, SchematicError::ENTRIES];
}
