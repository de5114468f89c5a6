//! The list of a cohort's members, and its file.

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
    /// The seed of its run.
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
    /// A digest of the member's files and their names, if the cohort is a data set.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
}

/// The file [`LIST`](crate::LIST): the list, and all that resuming the cohort needs, from its first moment on.
#[derive(Serialize, Deserialize)]
pub(crate) struct CohortFile {
    #[serde(flatten)]
    pub list: CohortList,
    /// The form of a data set; `None` for a folder for each member.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub form: Option<String>,
    /// The kept part of each ground truth.
    #[serde(default, skip_serializing_if = "KeptTruth::is_all")]
    pub truth: KeptTruth,
    /// The members asked for.
    pub asked: AskedMembers,
    /// The shared part of the members' recordings, with all texts that any member needs.
    pub recording: Recording,
}

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

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum AskedMembers {
    /// A number of members.
    Residents(u32),
    /// The members of a table of profiles.
    Profiles(String),
}
