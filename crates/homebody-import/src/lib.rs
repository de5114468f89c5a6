//! Homes from the plans of other programs, so far those of Sweet Home 3D, and schematic homes from logs.
//!
//! The input is the bytes of a file, the output the text of a `home.json` that passes every check, with remarks on
//! omissions and guesses. Files are not trusted: all sizes have bounds, and no file makes this crate panic. It does not
//! know files on disk, nor the residents of a home. Reading order:

pub mod error;

// From bytes to a drawing: the archive or another form, its XML, its content, one of its levels.
mod file_form;
mod archive;
mod markup;
mod drawing;
mod levels;
mod kinds;

// From the drawing of a level to a floor: walls, rooms, doors, furniture, and the names of all.
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

// From floors to a home: the places of stairs, unfolding, the names of places.
mod exits;
mod stairs;
mod places;

// The text of the home, removal of the parts that the check refuses, and moves of unreachable pieces.
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
