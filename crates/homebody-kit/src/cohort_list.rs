//! The list of a cohort's members, and the file that it stands in.

use homebody_core::recording::Recording;
use homebody_log::truth::TruthKept;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The list of a cohort's members, as it is written into the file [`LIST`](crate::LIST).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CohortList {
    /// The scenario's name.
    pub scenario: String,
    /// The seed of the cohort, from which those of its members follow.
    pub seed: u64,
    /// How many days each was to live.
    pub days: f64,
    /// Those who were lived, in order of their numbers or as they are listed; nobody until the cohort is over.
    pub members: Vec<ListedMember>,
}

/// What has become of one member.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ListedMember {
    /// The name of the member's folder.
    pub name: String,
    /// The number all randomness of this life comes from.
    pub seed: u64,
    /// How many firings there were.
    pub firings: u64,
    /// How many rows are in each place of the log.
    pub rows: u64,
    /// How many days were lived.
    pub days: f64,
    /// What the list said of the member, by column.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<BTreeMap<String, String>>,
    /// A digest of the member's files and their names, where the cohort is a set that is parted by member.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
}

/// The file [`LIST`](crate::LIST): the list, and all that the cohort is gone on with by, which stands from the first instant on.
#[derive(Serialize, Deserialize)]
pub(crate) struct CohortFile {
    #[serde(flatten)]
    pub list: CohortList,
    /// The form of the members' files, where they are a set; none where each has a folder of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub form: Option<String>,
    /// How much of each truth is kept, where that is not all.
    #[serde(default, skip_serializing_if = "Kept::is_all")]
    pub truth: Kept,
    /// Who is to live.
    pub asked: Asked,
    /// What is recorded of each member, but for what is their own; with all texts that any of them needs.
    pub recording: Recording,
}

/// How much of a truth is kept, as it is written.
#[derive(Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Kept {
    #[default]
    All,
    Brief,
}

impl Kept {
    fn is_all(&self) -> bool {
        *self == Kept::All
    }
}

impl From<TruthKept> for Kept {
    fn from(kept: TruthKept) -> Kept {
        match kept {
            TruthKept::All => Kept::All,
            TruthKept::Brief => Kept::Brief,
        }
    }
}

impl From<Kept> for TruthKept {
    fn from(kept: Kept) -> TruthKept {
        match kept {
            Kept::All => TruthKept::All,
            Kept::Brief => TruthKept::Brief,
        }
    }
}

/// Who is to live, as it is written.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Asked {
    /// So many.
    Residents(u32),
    /// Those of this table of profiles.
    Profiles(String),
}
