//! Why a file is not imported: a sentence, and what to do about it.

use std::fmt::Display;

/// Why there is no home in a file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotImported {
    /// The bytes are no zip archive.
    #[error(
        "this is no Sweet Home 3D file: it is no zip archive\n  hint: name the .sh3d file that Sweet Home 3D has saved"
    )]
    NoArchive,
    /// The file is of another form.
    #[error("this is no Sweet Home 3D file: it is {form}\n  hint: {hint}")]
    OtherForm {
        /// Its form, such as a picture in PNG.
        form: &'static str,
        /// The command that takes it.
        hint: &'static str,
    },
    /// The archive has no plan in it.
    #[error(
        "this is no Sweet Home 3D file: it has no Home.xml\n  hint: name the .sh3d file that Sweet Home 3D has saved"
    )]
    NoHomeXml,
    /// An old file, in which the plan is there as Java objects alone.
    #[error(
        "the file is of an old Sweet Home 3D: the plan is in it as Java objects only, and there is no Home.xml\n  hint: open it in Sweet Home 3D 5.3 or later (www.sweethome3d.com), choose File > Save as, and name the new file"
    )]
    OnlyJava,
    /// The file is larger than what is read.
    #[error("the file is too large: it has {found} {unit}, and at most {most} are read\n  hint: {hint}")]
    TooLarge {
        /// What there is too much of, such as bytes.
        unit: &'static str,
        /// How many there are.
        found: u64,
        /// How many are read at most.
        most: u64,
        /// What to do about it.
        hint: &'static str,
    },
    /// The plan cannot be unpacked; the text says why.
    #[error("the file's Home.xml cannot be unpacked: {0}\n  hint: open it in Sweet Home 3D and save it again")]
    Damaged(String),
    /// The plan is no XML that can be read; the text says why.
    #[error("the file's Home.xml is not in order: {0}\n  hint: open it in Sweet Home 3D and save it again")]
    Disorder(String),
    /// The level that was asked for is not there.
    #[error("the plan has no level {wanted:?}\n  hint: it has {known}")]
    NoSuchLevel {
        /// Its name or number, as it was asked for.
        wanted: String,
        /// The levels that are there, in words.
        known: String,
    },
    /// The plan has more of something than a home can have.
    #[error("the plan has {count} {what}, and a home at most {most}\n  hint: {hint}")]
    TooMany {
        /// What it has too many of.
        what: &'static str,
        /// How many it has.
        count: usize,
        /// How many a home can have.
        most: usize,
        /// What to do about it.
        hint: &'static str,
    },
    /// The plan draws no rooms, and its walls enclose none.
    #[error(
        "the plan has no rooms, and its walls enclose none\n  hint: draw rooms in Sweet Home 3D: a double click inside walls makes one"
    )]
    NoRooms,
    /// No sound home could be made of the plan; the text says what is wrong.
    #[error("no sound home could be made of the plan: {0}\n  hint: change that in Sweet Home 3D and save it again")]
    Unsound(String),
}

impl NotImported {
    pub(crate) fn disorder(why: impl Display) -> NotImported {
        NotImported::Disorder(why.to_string())
    }
}
