//! Reading and writing files that may be hostile, and what becomes of those that are there already.

pub(crate) mod database;
pub mod fresh;
pub mod lock;
pub mod open;
mod packed;
pub mod plain;
mod replaced;

pub(crate) use fresh::{ExistingFile, FreshFile, all_can_be_written, name_if_free, remove_parts, same_file, whole};
pub(crate) use lock::{FileLock, FolderLock, is_held};
pub(crate) use open::{OpenMode, are_own, companions, open};
pub(crate) use packed::{Packer, Packing, is_packed, unpacked};

/// The treatment of existing files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WriteMode {
    /// Nothing may be there.
    #[default]
    Create,
    /// It is replaced, once there is something to replace it.
    Overwrite,
    /// Existing rows are the beginning of this very run, which is resumed.
    Resume,
}
