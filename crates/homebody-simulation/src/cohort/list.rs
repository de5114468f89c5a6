//! The list of a cohort's members, and the file that it stands in.

use homebody_core::recording::Recording;
use homebody_log::table::truth::TruthKept;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The list of a cohort's members, as it is written into the file [`LIST`](crate::LIST).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CohortList {
    /// The scenario's name.
    pub scenario: String,
    /// The seed of the cohort, from which those of its members follow.
    pub seed: u64,
    /// The days of each run.
    pub days: f64,
    /// The simulated members, in the order of their numbers or of the list; empty until the cohort is over.
    pub members: Vec<ListedMember>,
}

/// The result of one member.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ListedMember {
    /// The name of the member's folder.
    pub name: String,
    /// The number all randomness of this life comes from.
    pub seed: u64,
    /// The number of firings.
    pub firings: u64,
    /// The number of rows in each place of the log.
    pub rows: u64,
    /// The simulated days.
    pub days: f64,
    /// The cells of the member in the list, by column.
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
    /// How much of each ground truth is kept, if not all.
    #[serde(default, skip_serializing_if = "KeptTruth::is_all")]
    pub truth: KeptTruth,
    /// The members asked for.
    pub asked: AskedMembers,
    /// The shared part of the members' recordings, with all texts that any member needs.
    pub recording: Recording,
}

/// The kept part of a ground truth, as it is written.
#[derive(Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum KeptTruth {
    #[default]
    All,
    Brief,
}

impl KeptTruth {
    fn is_all(&self) -> bool {
        *self == KeptTruth::All
    }
}

impl From<TruthKept> for KeptTruth {
    fn from(kept: TruthKept) -> KeptTruth {
        match kept {
            TruthKept::All => KeptTruth::All,
            TruthKept::Brief => KeptTruth::Brief,
        }
    }
}

impl From<KeptTruth> for TruthKept {
    fn from(kept: KeptTruth) -> TruthKept {
        match kept {
            KeptTruth::All => TruthKept::All,
            KeptTruth::Brief => TruthKept::Brief,
        }
    }
}

/// The members asked for, as they are written.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum AskedMembers {
    /// So many.
    Residents(u32),
    /// Those of this table of profiles.
    Profiles(String),
}
