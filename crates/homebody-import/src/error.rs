//! Why a file is not imported: a sentence, and what to do about it.

use std::fmt::Display;

/// Why there is no home in a file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotImported {
    #[error(
        "this is no Sweet Home 3D file: it is no zip archive\n  hint: name the .sh3d file that Sweet Home 3D has saved"
    )]
    NoArchive,
    #[error(
        "this is no Sweet Home 3D file: it has no Home.xml\n  hint: save it with Sweet Home 3D 5.3 or later, which adds Home.xml"
    )]
    NoHomeXml,
    #[error("the file is too large: it has {found} {unit}, and at most {most} are read\n  hint: {hint}")]
    TooLarge { unit: &'static str, found: u64, most: u64, hint: &'static str },
    #[error("the file's Home.xml cannot be unpacked: {0}\n  hint: open it in Sweet Home 3D and save it again")]
    Damaged(String),
    #[error("the file's Home.xml is not in order: {0}\n  hint: open it in Sweet Home 3D and save it again")]
    Disorder(String),
    #[error("the plan has no level {wanted:?}\n  hint: it has {known}")]
    NoSuchLevel { wanted: String, known: String },
    #[error("the plan has {count} {what}, and a home at most {most}\n  hint: {hint}")]
    TooMany { what: &'static str, count: usize, most: usize, hint: &'static str },
    #[error(
        "the plan has no rooms, and its walls enclose none\n  hint: draw rooms in Sweet Home 3D: a double click inside walls makes one"
    )]
    NoRooms,
    #[error("no sound home could be made of the plan: {0}\n  hint: change that in Sweet Home 3D and save it again")]
    Unsound(String),
}

impl NotImported {
    pub(crate) fn disorder(why: impl Display) -> NotImported {
        NotImported::Disorder(why.to_string())
    }
}
